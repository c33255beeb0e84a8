#include "archive/archive.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "archive/printed_head.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "json/canonical_json.h"

namespace gumcert::archive {

namespace {

using nlohmann::json;

constexpr std::size_t k_hash_size = 32;

[[noreturn]] void refuse_request(const char* code, std::string where, std::string what, std::string rule,
                                 std::string action) {
    throw gum::InputError(gum::Diagnostic{.code = code,
                                          .where = std::move(where),
                                          .what = std::move(what),
                                          .rule = std::move(rule),
                                          .action = std::move(action)});
}

/// What a person does about a rule that a request breaks.
[[noreturn]] void refuse_breach(const Breach& breach, const LogEntry& entry, const std::string& last_at) {
    const std::string where = entry.certificate.empty() ? entry.kind : entry.certificate;
    switch (breach.kind) {
        case Breach::Kind::life:
            refuse_request("GC-ARCHIVE-0021", where, breach.what, breach.rule,
                           "see gumcert archive show, and do what comes first");
        case Breach::Kind::four_eyes:
            refuse_request("GC-ARCHIVE-0022", where, breach.what, breach.rule, "let another person do it");
        case Breach::Kind::role:
            refuse_request("GC-ARCHIVE-0023", where, breach.what, breach.rule,
                           "let a person do it who has the role, or change the settings of the archive");
        case Breach::Kind::number:
            refuse_request("GC-ARCHIVE-0024", where, breach.what, breach.rule,
                           "take a number with gumcert archive number, and state it in the certificate data");
        case Breach::Kind::amendment:
            refuse_request("GC-ARCHIVE-0031", where, breach.what, breach.rule,
                           "see gumcert archive show of the original");
        case Breach::Kind::order:
            if (entry.at < last_at) {
                refuse_request("GC-ARCHIVE-0032", where, "the clock says " + entry.at + ", the last entry " + last_at,
                               breach.rule, "set the clock of this machine right");
            }
            [[fallthrough]];
        case Breach::Kind::form:
        case Breach::Kind::settings:
            refuse_request("GC-ARCHIVE-0020", where, breach.what, breach.rule, "correct the request");
    }
    throw std::logic_error("a breach of no kind");
}

LogEntry entry_for(const Request& request, std::string kind, std::string certificate = "") {
    return {.seq = 0,
            .at = request.at,
            .actor = request.actor,
            .kind = std::move(kind),
            .certificate = std::move(certificate),
            .record = {},
            .request_key = request.request_key,
            .body = {},
            .prev = {},
            .hash = {}};
}

json changed_state(const std::string& before, const std::string& after, const std::string& why) {
    return {{"old", {{"state", before}}}, {"new", {{"state", after}}}, {"why", why}};
}

/// Small steps back of a clock that is set right by a server do not stop a laboratory: the time of the last entry counts.
std::string not_before(const std::string& last, std::string at) {
    constexpr std::size_t k_to_the_minute = 16;  // "2026-11-24T18:52"
    return at < last && at.substr(0, k_to_the_minute) == last.substr(0, k_to_the_minute) ? last : std::move(at);
}

void require_numbering(const Settings& settings) {
    if (!settings.numbering.empty() && !is_numbering(settings.numbering)) {
        refuse_request("GC-ARCHIVE-0025", "numbering", '"' + settings.numbering + '"',
                       "a pattern of numbers has one run of #, and may have YYYY, such as EX-YYYY-####",
                       "correct the pattern");
    }
}

}  // namespace

void refuse_unknown(const std::string& certificate, const std::string& archive) {
    refuse_request("GC-ARCHIVE-0026", certificate, "is not in the archive " + archive,
                   "a certificate is named by its number", "see gumcert archive list");
}

ListedCertificate listed_as(const std::string& number, const CertificateLife& life) {
    return {.number = number, .state = life.state, .since = life.since, .item = life.item, .record = life.record};
}

void list_again(Store& store) {
    LogRules rules;
    store.each_entry([&](const LogEntry& entry) { rules.take(entry); });
    for (const auto& [number, life] : rules.lives()) {
        store.list(listed_as(number, life));
    }
}

LogEntry first_entry(const Settings& settings, const std::string& software, const std::string& nonce,
                     const Request& request) {
    require_numbering(settings);
    LogEntry entry = entry_for(request, "created");
    entry.seq = 1;
    // The hash of this entry names the archive: with the nonce no two archives that begin alike have one name.
    entry.body = gumcert::json::canonical_json({{"schema", "gumcert/archive/1"},
                                                {"settings", to_json(settings)},
                                                {"software", software},
                                                {"nonce", nonce},
                                                {"why", request.why}});
    entry.prev = std::string(k_hash_size, '\0');
    LogRules rules;
    if (const std::optional<Breach> breach = rules.accept(entry)) {
        refuse_breach(*breach, entry, "");
    }
    entry.hash = entry_hash(entry);
    return entry;
}

/// The part of the log that the next entry of some certificates needs.
LogRules Archive::rules_for(const std::vector<std::string>& certificates, const std::string& series) {
    std::vector<LogEntry> needed;
    // The newest settings are enough, but for the first entry, which says that there is a log.
    const auto newest = [&](const LogEntry& entry) {
        needed.push_back(entry);
        return false;
    };
    store_.entries_of_kind("created", newest);
    store_.entries_of_kind("settings", newest);
    if (!series.empty()) {
        store_.entries_of_kind("numbered", [&](const LogEntry& entry) {
            const std::optional<json> body = body_of(entry);
            const bool found = body && text_in(*body, "new", "series") == series;
            if (found) {
                needed.push_back(entry);
            }
            return !found;
        });
    }
    for (const std::string& certificate : certificates) {
        for (LogEntry& entry : store_.entries_of(certificate)) {
            needed.push_back(std::move(entry));
        }
    }
    std::sort(needed.begin(), needed.end(), [](const LogEntry& a, const LogEntry& b) { return a.seq < b.seq; });
    LogRules rules;
    for (const LogEntry& entry : needed) {
        rules.take(entry);
    }
    return rules;
}

LogEntry Archive::append(LogRules& rules, LogEntry entry) {
    const std::optional<LogEntry> last = store_.last_entry();
    if (!last) {
        refuse_request("GC-ARCHIVE-0020", store_.name(), "the log is empty", "an archive has a first entry",
                       "begin an archive with gumcert archive init");
    }
    entry.seq = last->seq + 1;
    entry.at = not_before(last->at, entry.at);
    entry.prev = last->hash;
    if (entry.at < last->at) {
        refuse_breach({Breach::Kind::order, "", "no entry is earlier than the one before"}, entry, last->at);
    }
    if (const std::optional<Breach> breach = rules.accept(entry)) {
        refuse_breach(*breach, entry, last->at);
    }
    entry.hash = entry_hash(entry);
    store_.append(entry);
    if (is_of_life(entry.kind)) {
        store_.list(listed_as(entry.certificate, *rules.life(entry.certificate)));
    }
    return entry;
}

/// \param wanted  an entry with the same key must be of this kind, actor, certificate ("" = any) and record ("" = any)
Written Archive::write(const LogEntry& wanted, const std::function<LogEntry()>& work) {
    Written written;
    store_.write([&] {
        if (!wanted.request_key.empty()) {
            if (std::optional<LogEntry> known = store_.entry_of_request(wanted.request_key)) {
                if (known->kind != wanted.kind || known->actor != wanted.actor ||
                    (!wanted.certificate.empty() && known->certificate != wanted.certificate) ||
                    (!wanted.record.empty() && known->record != wanted.record)) {
                    refuse_request(
                        "GC-ARCHIVE-0027", wanted.request_key,
                        "was the key of \"" + known->kind + "\" " + known->certificate + " by " + known->actor,
                        "a key belongs to one request", "take a new key for a new request");
                }
                written = {std::move(*known), true};
                return;
            }
        }
        written.entry = work();
    });
    return written;
}

void Archive::require_known(const std::string& certificate, const std::vector<LogEntry>& entries) {
    if (entries.empty()) {
        refuse_unknown(certificate, store_.name());
    }
}

Written Archive::take_number(const Request& request) {
    LogEntry entry = entry_for(request, "numbered");
    return write(entry, [&] {
        const std::string numbering = rules_for({}, "").settings().numbering;
        if (numbering.empty()) {
            refuse_request("GC-ARCHIVE-0025", store_.name(), "this archive gives no numbers",
                           "numbers follow a pattern that the settings of the archive state",
                           "state it with gumcert archive init --numbering, or give numbers elsewhere");
        }
        const std::optional<LogEntry> last = store_.last_entry();
        const std::string series = series_of(numbering, not_before(last ? last->at : "", entry.at));
        LogRules rules = rules_for({}, series);
        const long long ordinal = rules.last_ordinal(series) + 1;
        const std::optional<std::string> number = number_in(series, ordinal);
        if (!number) {
            refuse_request("GC-ARCHIVE-0025", series, "all numbers are taken",
                           "a series ends where its ordinal has more digits than its pattern",
                           "state a longer pattern in the settings of the archive");
        }
        for (const LogEntry& known : store_.entries_of(*number)) {
            rules.take(known);
        }
        entry.certificate = *number;
        json body = changed_state("", "numbered", request.why);
        body["new"]["ordinal"] = ordinal;
        body["new"]["series"] = series;
        entry.body = gumcert::json::canonical_json(body);
        return append(rules, entry);
    });
}

Written Archive::take_amendment_number(const std::string& original, const Request& request) {
    const LogEntry wanted = entry_for(request, "numbered");
    return write(wanted, [&] {
        require_known(original, store_.entries_of(original));
        const std::string series = series_of_amendments(original);
        LogRules rules = rules_for({original}, "");
        if (rules.life(original)->state != "issued") {
            refuse_breach({Breach::Kind::amendment, "certificate " + original + " is " + rules.life(original)->state,
                           "an amendment amends or replaces a certificate that is issued and holds"},
                          wanted, "");
        }
        // All before the next one were taken, or chosen by hand.
        long long ordinal = 1;
        for (;; ++ordinal) {
            const std::vector<LogEntry> chosen = store_.entries_of(series + std::to_string(ordinal));
            if (chosen.empty()) {
                break;
            }
            for (const LogEntry& known : chosen) {
                rules.take(known);
            }
        }
        LogEntry entry = wanted;
        entry.certificate = series + std::to_string(ordinal);
        json body = changed_state("", "numbered", request.why);
        body["new"]["amends"] = original;
        body["new"]["ordinal"] = ordinal;
        body["new"]["series"] = series;
        entry.body = gumcert::json::canonical_json(body);
        return append(rules, entry);
    });
}

void Archive::require_heads(const Draft& draft, const std::string& record) {
    std::int64_t drafted = std::numeric_limits<std::int64_t>::max();
    for (const LogEntry& entry : store_.entries_of(draft.number)) {
        if (entry.kind == "drafted" && entry.record == record) {
            drafted = std::min(drafted, entry.seq);
        }
    }
    std::optional<MerkleTree> tree;  // of all entries, where it is needed
    for (const Document& document : draft.documents) {
        for (const PrintedHead& head : printed_heads_in(document.bytes)) {
            if (!tree) {
                store_.each_entry([&, &made = tree.emplace()](const LogEntry& entry) { made.add(entry.hash); });
            }
            const auto size = static_cast<std::size_t>(head.size);
            const bool is_of_log = size <= tree->size() && tree->root(size) == head.root;
            const auto next = static_cast<std::int64_t>(tree->size()) + 1;
            if (std::string fault = fault_of(head, is_of_log, drafted, next); !fault.empty()) {
                refuse_request("GC-ARCHIVE-0037", document.name, std::move(fault),
                               "a document prints a head of its archive that contains a draft of its record",
                               "add the record first, make the document with a head from after it, and add both");
            }
        }
    }
}

Written Archive::draft(const Draft& draft, const Request& request) {
    LogEntry entry = entry_for(request, "drafted", draft.number);
    entry.record = encoding::sha256(draft.record);
    std::vector<Content> contents{{entry.record, draft.record}};
    json documents = json::array();
    for (const Document& document : draft.documents) {
        contents.push_back({encoding::sha256(document.bytes), document.bytes});
        documents.push_back({{"name", document.name},
                             {"media_type", document.media_type},
                             {"sha256", contents.back().sha256},
                             {"bytes", document.bytes.size()}});
    }
    return write(entry, [&] {
        std::vector<std::string> certificates{draft.number};
        if (draft.amends && draft.amends->number != draft.number) {
            certificates.push_back(draft.amends->number);
        }
        LogRules rules = rules_for(certificates, "");
        const CertificateLife* const life = rules.life(draft.number);
        json body = changed_state(life != nullptr ? life->state : "", "drafted", request.why);
        if (life != nullptr) {
            body["old"]["record"] = life->record;
            body["old"]["documents"] = life->documents;
        }
        body["new"]["record"] = entry.record;
        body["new"]["documents"] = documents;
        body["new"]["item"] = draft.item;
        if (draft.amends) {
            json changes = json::array();
            for (const AmendedPlace& place : draft.amends->changes) {
                changes.push_back(
                    {{"kind", place.kind}, {"where", place.where}, {"before", place.before}, {"after", place.after}});
            }
            body["amends"] = {{"number", draft.amends->number}, {"kind", draft.amends->kind}, {"changes", changes}};
        }
        entry.body = gumcert::json::canonical_json(body);
        require_heads(draft, entry.record);
        for (const Content& content : contents) {
            if (!store_.has(content.sha256)) {
                store_.put(content);
            }
        }
        return append(rules, entry);
    });
}

Written Archive::advance(const std::string& certificate, const std::string& kind, const Request& request) {
    LogEntry entry = entry_for(request, kind, certificate);
    return write(entry, [&] {
        const std::vector<LogEntry> entries = store_.entries_of(certificate);
        require_known(certificate, entries);
        LogRules rules = rules_for({certificate}, "");
        const CertificateLife life = *rules.life(certificate);
        if (!life.amends.empty() && life.amends != certificate) {
            rules = rules_for({certificate, life.amends}, "");
        }
        entry.record = life.record;
        entry.body = gumcert::json::canonical_json(changed_state(life.state, kind, request.why));
        LogEntry written = append(rules, entry);
        if (kind == "issued" && !life.amends.empty()) {
            LogEntry of_original =
                entry_for(request, life.amendment_kind == "replaced" ? "superseded" : "amended-by", life.amends);
            // The key belongs to the first of the two entries; both are written by one request.
            of_original.request_key.clear();
            const CertificateLife original = *rules.life(life.amends);
            of_original.record = original.record;
            json body = changed_state(original.state, of_original.kind, request.why);
            body["new"]["by"] = certificate;
            of_original.body = gumcert::json::canonical_json(body);
            (void)append(rules, of_original);
        }
        return written;
    });
}

Written Archive::change_settings(const Settings& settings, const Request& request) {
    require_numbering(settings);
    LogEntry entry = entry_for(request, "settings");
    return write(entry, [&] {
        LogRules rules = rules_for({}, "");
        entry.body = gumcert::json::canonical_json(
            {{"old", to_json(rules.settings())}, {"new", to_json(settings)}, {"why", request.why}});
        return append(rules, entry);
    });
}

Written Archive::note_backup(const std::string& file, const Head& copy, const Request& request) {
    LogEntry entry = entry_for(request, "backed-up");
    entry.body = gumcert::json::canonical_json(
        {{"new", {{"file", file}, {"size", copy.size}, {"root", encoding::hexadecimal(copy.root)}}},
         {"why", request.why}});
    return write(entry, [&] {
        LogRules rules = rules_for({}, "");
        return append(rules, entry);
    });
}

Settings Archive::settings() {
    Settings settings;
    store_.read([&] { settings = rules_for({}, "").settings(); });
    return settings;
}

CertificateLife Archive::life(const std::string& certificate) {
    CertificateLife life;
    store_.read([&] {
        require_known(certificate, store_.entries_of(certificate));
        life = *rules_for({certificate}, "").life(certificate);
    });
    return life;
}

std::vector<LogEntry> Archive::history(const std::string& certificate) {
    std::vector<LogEntry> entries;
    store_.read([&] { entries = store_.entries_of(certificate); });
    require_known(certificate, entries);
    return entries;
}

std::vector<ListedCertificate> Archive::list() {
    std::vector<ListedCertificate> certificates;
    store_.read([&] { certificates = store_.listed(); });
    return certificates;
}

void Archive::each_record(const std::function<void(const std::vector<ListedCertificate>&)>& begin,
                          const std::function<void(const ListedCertificate&, std::string bytes)>& visit) {
    store_.read([&] {
        const std::vector<ListedCertificate> certificates = store_.listed();
        begin(certificates);
        for (const ListedCertificate& one : certificates) {
            if (!one.record.empty()) {
                // A record that is missing is for the verifier to tell; here it is one that says nothing.
                visit(one, store_.content(one.record).value_or(""));
            }
        }
    });
}

std::optional<std::string> Archive::content(const std::string& sha256) {
    std::optional<std::string> bytes;
    store_.read([&] { bytes = store_.content(sha256); });
    return bytes;
}

std::string Archive::record_of(const std::string& certificate) {
    std::optional<std::string> bytes = content(life(certificate).record);
    if (!bytes) {
        refuse_request("GC-ARCHIVE-0026", certificate, "has no record in the archive " + store_.name(),
                       "a certificate is named by its number", "see gumcert archive list");
    }
    return std::move(*bytes);
}

WalkedLog Archive::walked() {
    WalkedLog log;
    store_.read([&] { store_.each_entry([&](const LogEntry& entry) { log.add(entry); }); });
    return log;
}

Head Archive::head() {
    return walked().head();
}

Head Archive::head_since(const Head& earlier) {
    std::optional<Head> head = walked().head_since(earlier);
    if (!head) {
        refuse_request("GC-ARCHIVE-0036", "head of " + std::to_string(earlier.size) + " entries, " + earlier.at,
                       "the archive does not begin with these entries",
                       "an archive begins with what its earlier heads say",
                       "the log was cut off, rewritten, or belongs to another archive: compare with a backup");
    }
    return std::move(*head);
}

}  // namespace gumcert::archive
