#include "archive/archive.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "archive/names.h"
#include "archive/printed_head.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "json/canonical_json.h"
#include "text/lists.h"
#include "text/visible_text.h"

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
                refuse_request(
                    "GC-ARCHIVE-0032", where, "the clock says " + entry.at + ", the last entry " + last_at, breach.rule,
                    "set the clock of this machine right; where it is right, and was ahead before, add --today " +
                        entry.at.substr(0, 10) + ": the entry gets the time of the last one");
            }
            [[fallthrough]];
        case Breach::Kind::clock:
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

/// An entry that counts has the fields that were hashed.
void require_whole(const LogEntry& entry) {
    if (entry_hash(entry) != entry.hash) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-ARCHIVE-0013",
                                                .where = "entry " + std::to_string(entry.seq),
                                                .what = "its fields give another hash than the one it has",
                                                .rule = "an entry is as it was when it was written",
                                                .action =
                                                    "see what gumcert archive verify says, and restore the newest "
                                                    "backup that can be verified"});
    }
}

/// Digits of a time, as a number.
int part_of_time(std::string_view at, std::size_t from, std::size_t length) {
    int value = 0;
    for (const char c : at.substr(std::min(from, at.size()), length)) {
        value = c >= '0' && c <= '9' ? 10 * value + (c - '0') : value;
    }
    return value;
}

/// "2026-11-24…" as days since 1970-01-01.
std::int64_t day_number(std::string_view at) {
    const std::chrono::year_month_day day{std::chrono::year(part_of_time(at, 0, 4)),
                                          std::chrono::month(static_cast<unsigned>(part_of_time(at, 5, 2))),
                                          std::chrono::day(static_cast<unsigned>(part_of_time(at, 8, 2)))};
    return std::chrono::sys_days(day).time_since_epoch().count();
}

/// "2026-11-24T18:52:07Z" as seconds since 1970-01-01.
std::int64_t second_number(std::string_view at) {
    constexpr std::int64_t k_minutes_of_hour = 60;
    constexpr std::int64_t k_seconds_of_minute = 60;
    constexpr std::int64_t k_hours_of_day = 24;
    const std::int64_t hours = day_number(at) * k_hours_of_day + part_of_time(at, 11, 2);
    return (hours * k_minutes_of_hour + part_of_time(at, 14, 2)) * k_seconds_of_minute + part_of_time(at, 17, 2);
}

/// Whether a person has looked at a calendar. The day before and the day after are days of other places.
bool is_confirmed(const Request& request) {
    return !request.confirmed_day.empty() && std::abs(day_number(request.at) - day_number(request.confirmed_day)) <= 1;
}

/// A machine whose clock is ahead would close the archive until then, and over New Year give numbers of another year. Nobody can
/// tell a pause from a wrong clock but a person with a calendar.
/// \param kind  of the entry
void require_no_jump(const std::string& last, const Request& request, const std::string& kind) {
    constexpr std::int64_t k_pause = 7;  // [d]
    const std::int64_t days = day_number(request.at) - day_number(last);
    const bool is_of_another_year = kind == "numbered" && request.at.substr(0, 4) != last.substr(0, 4);
    if ((days > k_pause || (days > 1 && is_of_another_year)) && !is_confirmed(request)) {
        refuse_request("GC-ARCHIVE-0065", "the clock of this machine",
                       "says " + request.at + ", " + text::count_of(days, "day") + " after the last entry, " + last,
                       "an entry more than a week after the last one, or a number more than a day after an entry of "
                       "another year, states the day by hand, because no later entry may be earlier",
                       "look at a calendar: set the clock right, or add --today " + request.at.substr(0, 10));
    }
}

void require_clear_name(const std::string& where, const std::string& name) {
    if (const std::string objection = objection_to_name(name); !objection.empty()) {
        refuse_request("GC-ARCHIVE-0033", where, text::in_quotes(name) + ' ' + objection,
                       "names and numbers can be told apart by who reads them",
                       "write it in letters of one script, with single plain blanks");
    }
}

/// Persons that are told apart, and one who may change the settings.
void require_persons(const Settings& settings) {
    bool is_kept = settings.persons.empty();
    for (auto one = settings.persons.begin(); one != settings.persons.end(); ++one) {
        require_clear_name("persons", one->first);
        is_kept = is_kept || one->second.contains("keeper");
        for (auto other = settings.persons.begin(); other != one; ++other) {
            if (may_be_one_person(other->first, one->first)) {
                refuse_request(
                    "GC-ARCHIVE-0033", "persons",
                    text::in_quotes(other->first) + " and " + text::in_quotes(one->first) + " may be one person",
                    "names and numbers can be told apart by who reads them",
                    "state the roles of one person together, and tell others apart by more letters");
            }
        }
    }
    if (!is_kept) {
        refuse_request("GC-ARCHIVE-0033", "persons", "nobody is a keeper",
                       "somebody may change the settings and make backups, where persons are stated",
                       "state a person with the role keeper");
    }
}

constexpr const char* k_request = "request";  // member of a body: digest of what was asked for with a key

std::string digest_of_request(const LogEntry& wanted, const std::string& why, const json& what) {
    return encoding::sha256(gumcert::json::canonical_json({{"actor", wanted.actor},
                                                           {"certificate", wanted.certificate},
                                                           {"kind", wanted.kind},
                                                           {"record", wanted.record},
                                                           {"what", what},
                                                           {"why", why}}));
}

json changed_state(const std::string& before, const std::string& after, const std::string& why) {
    return {{"old", {{"state", before}}}, {"new", {{"state", after}}}, {"why", why}};
}

/// Small steps back of a clock that is set right by a server, or of another machine that writes, do not stop a laboratory: the
/// time of the last entry counts.
std::string not_before(const std::string& last, std::string at) {
    constexpr std::int64_t k_small = 60;  // [s]
    return at < last && second_number(last) - second_number(at) < k_small ? last : std::move(at);
}

/// Whether the last entry is of a clock that was ahead, as a person says who has looked at a calendar.
bool is_after_wrong_clock(const std::string& last, const Request& request) {
    return not_before(last, request.at) < last && is_confirmed(request);
}

/// The time of an entry: its own, or that of the last one, where its body says what the clock said.
std::string time_after(const LogEntry& last, const LogEntry& entry) {
    const std::string at = not_before(last.at, entry.at);
    const std::optional<json> body = at < last.at ? body_of(entry) : std::nullopt;
    return body && body->value(k_clock, json()) == entry.at ? last.at : at;
}

LogTimes taken_times(Store& store) {
    LogTimes times;
    store.each_entry([&](const LogEntry& entry) { (void)times.take(entry); });
    return times;
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
    require_persons(settings);
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
    std::set<std::string> known(certificates.begin(), certificates.end());
    for (const std::string& certificate : certificates) {
        std::string later;  // what took its place may be withdrawn
        for (LogEntry& entry : store_.entries_of(certificate)) {
            if (entry.kind == "amended-by" || entry.kind == "superseded") {
                later = text_in(body_of(entry).value_or(json::object()), "new", "by");
            }
            needed.push_back(std::move(entry));
        }
        if (!later.empty() && known.insert(later).second) {
            for (LogEntry& entry : store_.entries_of(later)) {
                needed.push_back(std::move(entry));
            }
        }
    }
    std::sort(needed.begin(), needed.end(), [](const LogEntry& a, const LogEntry& b) { return a.seq < b.seq; });
    LogRules rules;
    for (const LogEntry& entry : needed) {
        require_whole(entry);
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
    entry.at = time_after(*last, entry);
    entry.prev = last->hash;
    if (entry.at < last->at) {
        refuse_breach({Breach::Kind::order, "", "no entry is earlier than the one before"}, entry, last->at);
    }
    rules.go_on_after(last->at);
    require_sound_clock(entry);
    require_distinct(entry, rules);
    if (const std::optional<Breach> breach = rules.accept(entry)) {
        refuse_breach(*breach, entry, last->at);
    }
    entry.hash = entry_hash(entry);
    store_.append(entry);
    numbers_as_of_ = numbers_as_of_ == entry.seq - 1 ? entry.seq : -1;
    if (is_of_life(entry.kind)) {
        store_.list(listed_as(entry.certificate, *rules.life(entry.certificate)));
    }
    return entry;
}

/// What a request asks beside actor, kind, certificate, record and reason.
struct Archive::Asked {
    json what;
    /// Whether the entry with the same key has it too: of an earlier version, without a digest of its request, it says it.
    std::function<bool(const LogEntry& entry, const json& body)> is_in;
};

/// \param wanted  an entry with the same key must be of this kind, actor, certificate ("" = any) and record ("" = any)
/// \param work    is given the beginning of a body, with the digest of a request that has a key
Written Archive::write(const LogEntry& wanted, const Request& request, const Asked& asked,
                       const std::function<LogEntry(json)>& work) {
    Written written;
    const std::string& why = request.why;
    const std::string digest = digest_of_request(wanted, why, asked.what);
    const auto whole = [&] {
        std::optional<LogEntry> known =
            wanted.request_key.empty() ? std::nullopt : store_.entry_of_request(wanted.request_key);
        if (!known) {
            json begun = json::object();
            if (const std::optional<LogEntry> last = store_.last_entry()) {
                require_no_jump(last->at, request, wanted.kind);
                if (is_after_wrong_clock(last->at, request)) {
                    begun[k_clock] = request.at;
                }
            }
            if (!wanted.request_key.empty()) {
                begun[k_request] = digest;
            }
            written.entry = work(std::move(begun));
            return;
        }
        require_whole(*known);
        const json body = body_of(*known).value_or(json::object());
        const auto text_of_body = [&](const char* key) {
            const auto found = body.find(key);
            return found != body.end() && found->is_string() ? found->get<std::string>() : std::string();
        };
        const std::string stated = text_of_body(k_request);
        const bool is_same = known->kind == wanted.kind && known->actor == wanted.actor &&
                             (wanted.certificate.empty() || known->certificate == wanted.certificate) &&
                             (wanted.record.empty() || known->record == wanted.record) &&
                             (stated.empty() ? text_of_body("why") == why : stated == digest) &&
                             asked.is_in(*known, body);
        if (!is_same) {
            refuse_request("GC-ARCHIVE-0027", wanted.request_key,
                           "was the key of another request, or of one that was undone since: \"" + known->kind + "\" " +
                               known->certificate + " by " + known->actor + ", entry " + std::to_string(known->seq),
                           "a key belongs to one request", "take a new key for a new request");
        }
        written = {std::move(*known), true};
    };
    try {
        store_.write(whole);
    } catch (...) {
        numbers_as_of_ = -1;  // what was taken for known did not come in
        throw;
    }
    return written;
}

/// Record and documents, as they were archived: whoever judges them, judges these.
void Archive::require_contents(const CertificateLife& life, const Judge& judge) {
    const auto kept = [&](const std::string& sha256) {
        std::optional<std::string> bytes = store_.content(sha256);
        if (!bytes) {
            throw gum::StorageError(
                gum::Diagnostic{.code = "GC-ARCHIVE-0012",
                                .where = store_.name() + ", content " + sha256,
                                .what = "is not there",
                                .rule = "a record or document is what was archived under its SHA-256",
                                .action = "see what gumcert archive verify says, and restore the "
                                          "newest backup that can be verified"});
        }
        return std::move(*bytes);
    };
    for (const std::string& document : life.documents) {
        (void)kept(document);
    }
    if (!life.record.empty()) {
        const std::string record = kept(life.record);
        if (judge) {
            judge(record, life);
        }
    }
}

/// A clock that was set right after it was ahead is held against all times of the log: rarely, and then each of them counts.
void Archive::require_sound_clock(const LogEntry& entry) {
    if (clock_of(entry).empty()) {
        return;
    }
    LogTimes times = taken_times(store_);
    if (std::string fault = times.take(entry); !fault.empty()) {
        refuse_request("GC-ARCHIVE-0032", entry.certificate.empty() ? entry.kind : entry.certificate, std::move(fault),
                       k_clock_rule,
                       "look at a calendar, and set the clock of this machine right; where it is right, wait");
    }
}

/// What the log cannot tell apart later does not come in: names of persons, numbers of certificates.
void Archive::require_distinct(const LogEntry& entry, const LogRules& rules) {
    if (!entry.actor.empty() && !rules.settings().persons.contains(entry.actor)) {
        require_clear_name("--by", entry.actor);
    }
    if (entry.certificate.empty()) {
        return;
    }
    const CertificateLife* const life = rules.life(entry.certificate);
    if (life == nullptr) {
        require_clear_name("number", entry.certificate);
        if (numbers_as_of_ != entry.seq - 1) {
            numbers_by_form_.clear();
            for (const ListedCertificate& known : store_.listed()) {
                numbers_by_form_.emplace(confusable_form(known.number), known.number);
            }
            numbers_as_of_ = entry.seq - 1;
        }
        const auto [known, is_new] = numbers_by_form_.emplace(confusable_form(entry.certificate), entry.certificate);
        if (!is_new && known->second != entry.certificate) {
            refuse_request("GC-ARCHIVE-0024", entry.certificate,
                           "the number cannot be told from " + text::in_quotes(known->second),
                           "no number is given twice, and none that looks like another one",
                           "take a number with gumcert archive number, and state it in the certificate data");
        }
        return;
    }
    const bool is_judged = entry.kind == "reviewed" || entry.kind == "authorised";
    for (const std::string& author : life->authors) {
        const bool may_be = author != entry.actor && may_be_one_person(author, entry.actor);
        if (rules.settings().four_eyes && is_judged && may_be) {
            refuse_request(
                "GC-ARCHIVE-0022", entry.certificate,
                text::in_quotes(author) + " has drafted it, and may be who is called " + text::in_quotes(entry.actor),
                "nobody reviews or authorises what he has drafted (four eyes)", "let another person do it");
        }
    }
}

void Archive::require_known(const std::string& certificate, const std::vector<LogEntry>& entries) {
    // Entries of the archive itself have no certificate: "" finds them, and is none.
    if (certificate.empty() || entries.empty()) {
        refuse_unknown(certificate, store_.name());
    }
}

Written Archive::take_number(const Request& request) {
    LogEntry entry = entry_for(request, "numbered");
    const Asked asked{.what = {}, .is_in = [&](const LogEntry& known, const json& body) {
                          return still_holds(known) && text_in(body, "new", "amends").empty();
                      }};
    return write(entry, request, asked, [&](json body) {
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
        body.update(changed_state("", "numbered", request.why));
        body["new"]["ordinal"] = ordinal;
        body["new"]["series"] = series;
        entry.body = gumcert::json::canonical_json(body);
        return append(rules, entry);
    });
}

Written Archive::take_amendment_number(const std::string& original, const Request& request) {
    const LogEntry wanted = entry_for(request, "numbered");
    const Asked asked{.what = {{"amends", original}}, .is_in = [&](const LogEntry& known, const json& body) {
                          return still_holds(known) && text_in(body, "new", "amends") == original;
                      }};
    return write(wanted, request, asked, [&](json body) {
        require_known(original, store_.entries_of(original));
        const std::string series = series_of_amendments(original);
        LogRules rules = rules_for({original}, "");
        if (!rules.may_be_amended(original)) {
            LogEntry of_original = wanted;
            of_original.certificate = original;
            refuse_breach({Breach::Kind::amendment,
                           "certificate " + original + " is " + worded_state(rules.life(original)), k_amendable_rule},
                          of_original, "");
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
        body.update(changed_state("", "numbered", request.why));
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

/// Whether what an entry has brought about still holds: steps that go on from it leave it alone, and a new draft, a withdrawal or
/// a replacement undoes it. A draft is its entry, not its record: the same record may be drafted again with other documents, or by
/// another person.
bool Archive::still_holds(const LogEntry& known) {
    const std::vector<LogEntry> entries = store_.entries_of(known.certificate);
    return std::none_of(entries.begin(), entries.end(), [&](const LogEntry& entry) {
        const bool is_undone = entry.kind == "withdrawn" || entry.kind == "superseded" ||
                               (entry.kind == "drafted" && known.kind != "numbered");
        return is_undone && entry.seq > known.seq;
    });
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
    json amends;
    if (draft.amends) {
        json changes = json::array();
        for (const AmendedPlace& place : draft.amends->changes) {
            changes.push_back(
                {{"kind", place.kind}, {"where", place.where}, {"before", place.before}, {"after", place.after}});
        }
        amends = {{"number", draft.amends->number}, {"kind", draft.amends->kind}, {"changes", std::move(changes)}};
    }
    const Asked asked{.what = {{"amends", amends}, {"documents", documents}, {"item", draft.item}},
                      .is_in = [&](const LogEntry& known, const json& body) {
                          const json now = body.value("new", json::object());
                          return still_holds(known) && now.value("documents", json()) == documents &&
                                 now.value("item", json()) == draft.item && body.value("amends", json()) == amends;
                      }};
    return write(entry, request, asked, [&](json body) {
        std::vector<std::string> certificates{draft.number};
        if (draft.amends && draft.amends->number != draft.number) {
            certificates.push_back(draft.amends->number);
        }
        LogRules rules = rules_for(certificates, "");
        const CertificateLife* const life = rules.life(draft.number);
        body.update(changed_state(life != nullptr ? life->state : "", "drafted", request.why));
        if (life != nullptr) {
            body["old"]["record"] = life->record;
            body["old"]["documents"] = life->documents;
        }
        body["new"]["record"] = entry.record;
        body["new"]["documents"] = documents;
        body["new"]["item"] = draft.item;
        if (draft.amends) {
            body["amends"] = amends;
        }
        entry.body = gumcert::json::canonical_json(body);
        require_heads(draft, entry.record);
        for (const Content& content : contents) {
            if (!store_.has(content.sha256)) {
                store_.put(content);
            } else {
                (void)store_.content(content.sha256);  // and it is what it is named
            }
        }
        return append(rules, entry);
    });
}

Written Archive::advance(const std::string& certificate, const std::string& kind, const Request& request,
                         const Judge& judge) {
    LogEntry entry = entry_for(request, kind, certificate);
    // Asked again after a new draft it is another request: something else is to be judged, if only another document. After a
    // withdrawal the answer "issued" would be wrong.
    const Asked asked{.what = {}, .is_in = [&](const LogEntry& known, const json&) { return still_holds(known); }};
    return write(entry, request, asked, [&](json body) {
        const std::vector<LogEntry> entries = store_.entries_of(certificate);
        require_known(certificate, entries);
        LogRules rules = rules_for({certificate}, "");
        const CertificateLife life = *rules.life(certificate);
        if (!life.amends.empty() && life.amends != certificate) {
            rules = rules_for({certificate, life.amends}, "");
        }
        entry.record = life.record;
        body.update(changed_state(life.state, kind, request.why));
        entry.body = gumcert::json::canonical_json(body);
        if (kind != "withdrawn") {
            require_contents(life, judge);
        }
        LogEntry written = append(rules, entry);
        if (kind == "issued" && !life.amends.empty()) {
            LogEntry of_original =
                entry_for(request, life.amendment_kind == "replaced" ? "superseded" : "amended-by", life.amends);
            // The key belongs to the first of the two entries; both are written by one request.
            of_original.request_key.clear();
            const CertificateLife original = *rules.life(life.amends);
            of_original.record = original.record;
            json change = changed_state(original.state, of_original.kind, request.why);
            change["new"]["by"] = certificate;
            if (body.contains(k_clock)) {
                change[k_clock] = body[k_clock];
            }
            of_original.body = gumcert::json::canonical_json(change);
            (void)append(rules, of_original);
        }
        return written;
    });
}

Written Archive::change_settings(const Settings& settings, const Request& request) {
    require_numbering(settings);
    require_persons(settings);
    LogEntry entry = entry_for(request, "settings");
    // Where the settings were changed since, the answer that these are the settings would be wrong.
    const Asked asked{.what = to_json(settings), .is_in = [&](const LogEntry& known, const json& body) {
                          std::int64_t newest = 0;
                          store_.entries_of_kind("settings", [&](const LogEntry& one) {
                              newest = one.seq;
                              return false;
                          });
                          return newest == known.seq && body.value("new", json()) == to_json(settings);
                      }};
    return write(entry, request, asked, [&](json body) {
        LogRules rules = rules_for({}, "");
        body.update({{"old", to_json(rules.settings())}, {"new", to_json(settings)}, {"why", request.why}});
        entry.body = gumcert::json::canonical_json(body);
        return append(rules, entry);
    });
}

Written Archive::note_backup(const std::string& file, const Head& copy, const Request& request) {
    LogEntry entry = entry_for(request, "backed-up");
    // Each copy is another one: a key that was used belongs to the copy that the log knows.
    const json made{{"file", file}, {"size", copy.size}, {"root", encoding::hexadecimal(copy.root)}};
    const Asked asked{.what = made,
                      .is_in = [&](const LogEntry&, const json& body) { return body.value("new", json()) == made; }};
    return write(entry, request, asked, [&](json body) {
        LogRules rules = rules_for({}, "");
        body.update({{"new", made}, {"why", request.why}});
        entry.body = gumcert::json::canonical_json(body);
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

LogTimes Archive::times() {
    LogTimes times;
    store_.read([&] { times = taken_times(store_); });
    return times;
}

std::vector<ListedCertificate> Archive::list() {
    std::vector<ListedCertificate> certificates;
    store_.read([&] { certificates = store_.listed(); });
    return certificates;
}

std::map<std::string, CertificateLife> Archive::stated_by_log() {
    LogRules rules;
    std::string before(k_hash_size, '\0');
    store_.each_entry([&](const LogEntry& entry) {
        require_whole(entry);
        if (entry.prev != before) {
            throw gum::StorageError(gum::Diagnostic{.code = "GC-ARCHIVE-0013",
                                                    .where = "entry " + std::to_string(entry.seq),
                                                    .what = "does not follow the entry before it",
                                                    .rule = "an entry is as it was when it was written",
                                                    .action = "see what gumcert archive verify says, and restore the "
                                                              "newest backup that can be verified"});
        }
        before = entry.hash;
        rules.take(entry);
    });
    return rules.lives();
}

std::vector<ListedCertificate> Archive::certificates() {
    std::vector<ListedCertificate> certificates;
    store_.read([&] {
        for (const auto& [number, life] : stated_by_log()) {
            certificates.push_back(listed_as(number, life));
        }
    });
    return certificates;
}

void Archive::each_record(const std::function<void(const std::map<std::string, CertificateLife>&)>& begin,
                          const std::function<void(const ListedCertificate&, std::string bytes)>& visit) {
    store_.read([&] {
        const std::map<std::string, CertificateLife> lives = stated_by_log();
        begin(lives);
        for (const auto& [number, life] : lives) {
            if (!life.record.empty()) {
                // A record that is missing is for the verifier to tell; here it is one that says nothing.
                visit(listed_as(number, life), store_.content(life.record).value_or(""));
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
        refuse_request("GC-ARCHIVE-0036", "head of " + text::count_of(earlier.size, "entry") + ", " + earlier.at,
                       "the archive does not begin with these entries",
                       "an archive begins with what its earlier heads say",
                       "the log was cut off, rewritten, or belongs to another archive: compare with a backup");
    }
    return std::move(*head);
}

}  // namespace gumcert::archive
