#include "archive/verification.h"

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "archive/archive.h"
#include "archive/log_rules.h"
#include "archive/printed_head.h"
#include "archive/stated_number.h"
#include "encoding/sha2.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::archive {

namespace {

constexpr std::size_t k_between_reports = 4096;

std::string entry_name(std::int64_t seq) {
    return "entry " + std::to_string(seq);
}

class StoreVerifier {
public:
    StoreVerifier(Store& store, const std::function<void(const std::string&)>& progress)
        : store_(store), progress_(progress) {}

    Verification verify(const std::vector<Head>& heads) {
        store_.read([&] {
            for (const std::string& problem : store_.own_problems()) {
                add("GC-ARCHIVE-0046", store_.name(), problem, "the file of an archive is as gumcert made it",
                    "keep the file as it is, and restore the newest backup that can be verified");
            }
            store_.each_entry([&](const LogEntry& entry) { look_at(entry); });
            if (const std::string due = rules_.due(); !due.empty()) {
                add("GC-ARCHIVE-0043", "the end of the log", "\"" + due + "\" is missing",
                    "an amendment is issued together with the entry of its original",
                    "something was removed: compare with a backup");
            }
            look_at_list();
            store_.each_content([&](const Content& content) { look_at(content); });
            for (const auto& [sha256, naming] : needed_) {
                if (!kept_.contains(sha256)) {
                    add("GC-ARCHIVE-0044", entry_name(naming.seq), "the content " + sha256 + " is not there",
                        "records and documents that the log names are kept",
                        "restore it from a backup, or from whoever received it");
                }
            }
            for (const Head& head : heads) {
                compare_with(head);
            }
        });
        found_.entries = log_.tree().size();
        found_.contents = kept_.size();
        found_.certificates = rules_.lives().size();
        found_.set_back = times_.set_back();
        if (log_.tree().size() > 0) {
            found_.head = log_.head();
        } else {
            add("GC-ARCHIVE-0042", store_.name(), "the log is empty", "the log has the entries 1, 2, 3 … without gaps",
                "restore the newest backup that can be verified");
        }
        if (left_out_ > 0) {
            found_.findings.push_back({.code = "GC-ARCHIVE-0043",
                                       .where = store_.name(),
                                       .what = text::count_of(static_cast<std::int64_t>(left_out_), "more finding"),
                                       .rule = "the first " + std::to_string(k_most_findings) + " are listed",
                                       .action = "restore the newest backup that can be verified"});
        }
        return std::move(found_);
    }

private:
    Store& store_;
    const std::function<void(const std::string&)>& progress_;
    Verification found_;
    std::size_t left_out_ = 0;
    LogRules rules_;
    LogTimes times_;
    WalkedLog log_;
    struct LastEntry {
        std::string chain, at, clock;
    };
    std::vector<LastEntry> chains_;  // of the log up to every entry
    std::set<std::string> keys_;
    struct Naming {
        std::int64_t seq = 0;      // of the entry that names a content first
        std::int64_t drafted = 0;  // of the one that drafted its record first
    };
    std::map<std::string, Naming> needed_;                               // by content
    std::map<std::string, std::map<std::string, std::int64_t>> drafts_;  // record → certificate → its first draft
    std::set<std::string> kept_;

    void add(const char* code, std::string where, std::string what, std::string rule, std::string action) {
        if (found_.findings.size() >= k_most_findings) {
            ++left_out_;
            return;
        }
        found_.findings.push_back({.code = code,
                                   .where = std::move(where),
                                   .what = std::move(what),
                                   .rule = std::move(rule),
                                   .action = std::move(action)});
    }

    void look_at(const LogEntry& entry) {
        const std::string where = entry_name(entry.seq);
        // Three tests, for each sees another thing: the number an entry that was removed, the hash before it one that
        // was put in its place, its own hash a field that was changed.
        const std::string expected_prev = log_.tree().size() == 0 ? std::string(32, '\0') : log_.without_root().chain;
        if (entry.seq != static_cast<std::int64_t>(log_.tree().size()) + 1) {
            add("GC-ARCHIVE-0042", where, "stands where entry " + std::to_string(log_.tree().size() + 1) + " belongs",
                "the log has the entries 1, 2, 3 … without gaps", "compare with a backup what was removed or added");
        }
        if (entry.prev != expected_prev) {
            add("GC-ARCHIVE-0041", where, "does not follow the entry before it",
                "an entry holds the hash of the one before", "compare with a backup what was removed or added");
        }
        if (entry_hash(entry) != entry.hash) {
            add("GC-ARCHIVE-0040", where, "its fields give another hash than the one it has",
                "an entry is as it was when it was written", "compare with a backup what was changed");
        }
        if (const std::optional<Breach> breach = rules_.accept(entry)) {
            add("GC-ARCHIVE-0043", where, breach->what, breach->rule,
                "find out who wrote this entry, and with which program");
            // Taken all the same: one breach would else make a breach of every entry that follows.
            rules_.take(entry);
        }
        if (std::string fault = times_.take(entry); !fault.empty()) {
            add("GC-ARCHIVE-0043", where, std::move(fault), k_clock_rule,
                "find out who wrote this entry, and whether the clock was set back on purpose");
        }
        if (!entry.request_key.empty() && !keys_.insert(entry.request_key).second) {
            add("GC-ARCHIVE-0043", where, "its key \"" + entry.request_key + "\" was used before",
                "a key belongs to one request", "find out who wrote this entry, and with which program");
        }
        if (entry.kind == "drafted") {
            const std::int64_t drafted = drafts_[entry.record].emplace(entry.certificate, entry.seq).first->second;
            needed_.emplace(entry.record, Naming{entry.seq, drafted});
            for (const std::string& sha256 : documents_in(body_of(entry).value_or(nlohmann::json::object()))) {
                needed_.emplace(sha256, Naming{entry.seq, drafted});
            }
        }
        log_.add(entry);
        chains_.push_back({entry.hash, entry.at, clock_of(entry)});
        if (progress_ && log_.tree().size() % k_between_reports == 0) {
            progress_(text::count_of(static_cast<std::int64_t>(log_.tree().size()), "entry"));
        }
    }

    /// A list says of every certificate what the log says, and of no other one anything.
    void look_at_list() {
        std::map<std::string, ListedCertificate> listed;
        for (ListedCertificate& one : store_.listed()) {
            listed.emplace(one.number, std::move(one));
        }
        const auto tell = [&](const std::string& number, std::string what) {
            add("GC-ARCHIVE-0052", "list of certificates, " + number, std::move(what),
                "a list says what the entries of the log say",
                "the log holds: make a new archive of it with gumcert archive migrate");
        };
        for (const auto& [number, life] : rules_.lives()) {
            const auto found = listed.find(number);
            if (found == listed.end()) {
                tell(number, "is not listed");
            } else {
                if (found->second != listed_as(number, life)) {
                    tell(number, "is listed otherwise");
                }
                listed.erase(found);
            }
        }
        for (const auto& [number, one] : listed) {
            tell(number, "is listed, and no entry is about it");
        }
    }

    void look_at(const Content& content) {
        if (encoding::sha256(content.bytes) != content.sha256) {
            add("GC-ARCHIVE-0044", "content " + content.sha256, "its bytes have another hash",
                "a content is found by the hash of its bytes", "restore it from a backup");
        } else if (const auto named = needed_.find(content.sha256); named == needed_.end()) {
            add("GC-ARCHIVE-0044", "content " + content.sha256, "no entry of the log names it",
                "the archive holds what its log names", "find out who put it there");
        } else {
            look_at_printed_heads(content, named->second);
            look_at_number(content);
        }
        kept_.insert(content.sha256);
        if (progress_ && kept_.size() % k_between_reports == 0) {
            progress_(text::count_of(static_cast<std::int64_t>(kept_.size()), "content"));
        }
    }

    void look_at_number(const Content& content) {
        const auto drafted = drafts_.find(content.sha256);
        const std::string number = drafted == drafts_.end() ? "" : number_stated_in(content.bytes);
        if (number.empty()) {
            return;
        }
        for (const auto& [certificate, seq] : drafted->second) {
            if (certificate != number) {
                add("GC-ARCHIVE-0043", entry_name(seq), "its record states the number " + text::in_quotes(number),
                    k_number_rule, "find out who wrote this entry, and which certificate the record is of");
            }
        }
    }

    void look_at_printed_heads(const Content& content, const Naming& naming) {
        for (const PrintedHead& head : printed_heads_in(content.bytes)) {
            const auto size = static_cast<std::size_t>(head.size);
            const bool is_of_log = size <= log_.tree().size() && log_.tree().root(size) == head.root;
            if (std::string fault = fault_of(head, is_of_log, naming.drafted, naming.seq); !fault.empty()) {
                add("GC-ARCHIVE-0053", "content " + content.sha256, std::move(fault),
                    "a document prints a head of its archive that contains a draft of its record",
                    "the log was rewritten after the document was made: compare with a backup");
            }
        }
    }

    void compare_with(const Head& head) {
        const std::string where = "head of " + text::count_of(head.size, "entry") + ", " + head.at;
        const char* const rule = "an archive begins with what its earlier heads say";
        const char* const action =
            "the log was cut off, rewritten, or belongs to another archive: compare with a backup";
        if (log_.tree().size() == 0 || head.archive != log_.without_root().archive) {
            add("GC-ARCHIVE-0045", where, "is one of another archive", rule, action);
        } else if (head.size < 1 || static_cast<std::size_t>(head.size) > log_.tree().size()) {
            add("GC-ARCHIVE-0045", where,
                "the archive has " + text::count_of(static_cast<std::int64_t>(log_.tree().size()), "entry"), rule,
                action);
        } else if (const auto& [chain, at, clock] = chains_[static_cast<std::size_t>(head.size) - 1];
                   log_.tree().root(static_cast<std::size_t>(head.size)) != head.root ||
                   !ends_with(head, chain, at, clock)) {
            add("GC-ARCHIVE-0045", where, "the entries of the archive up to there are others", rule, action);
        }
    }
};

}  // namespace

Verification verify_store(Store& store, const std::vector<Head>& heads,
                          const std::function<void(const std::string&)>& progress) {
    return StoreVerifier(store, progress).verify(heads);
}

}  // namespace gumcert::archive
