#include "archive/log_rules.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "archive/names.h"
#include "encoding/sha2.h"
#include "json/strict_parser.h"
#include "text/utf8.h"

namespace gumcert::archive {

namespace {

using nlohmann::json;

/// state → kinds of entries that may follow.
const std::map<std::string, std::set<std::string>, std::less<>>& ways() {
    static const std::map<std::string, std::set<std::string>, std::less<>> k_ways = {
        {"", {"numbered", "drafted"}},
        {"numbered", {"drafted", "withdrawn"}},
        {"drafted", {"drafted", "reviewed", "withdrawn"}},
        {"reviewed", {"drafted", "authorised", "withdrawn"}},
        {"authorised", {"drafted", "issued", "withdrawn"}},
        {"issued", {"amended-by", "superseded", "withdrawn"}},
        {"amended-by", {"amended-by", "superseded", "withdrawn"}},  // where its amendment was withdrawn
        {"superseded", {"amended-by", "superseded", "withdrawn"}},
        {"withdrawn", {}}};
    return k_ways;
}

bool is_plain(std::string_view text) {
    return text::is_utf8(text) && std::none_of(text.begin(), text.end(), [](char c) {
               const auto byte = static_cast<unsigned char>(c);
               return byte < 0x20 || byte == 0x7F;
           });
}

std::string text_of(const json& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

const json& member(const json& object, const char* key) {
    static const json k_none;
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found != object.end() ? *found : k_none;
}

bool has_ended(const CertificateLife& life) {
    return life.state == "amended-by" || life.state == "superseded";
}

}  // namespace

std::string worded_state(const CertificateLife* life) {
    if (life == nullptr || life->state.empty()) {
        return "not in the archive";
    }
    const std::string state = life->state == "amended-by" ? "amended" : life->state;
    return has_ended(*life) && !life->later.empty() ? state + " by " + life->later : state;
}

std::string series_of_amendments(const std::string& original) {
    return original + "/A";
}

std::optional<json> body_of(const LogEntry& entry) {
    std::optional<json> body = gumcert::json::parse_faultless(entry.body, {});
    return body && body->is_object() ? body : std::nullopt;
}

std::string text_in(const json& body, const char* part, const char* key) {
    return text_of(member(body, part), key);
}

std::vector<std::string> documents_in(const json& body) {
    std::vector<std::string> documents;
    if (const json& named = member(member(body, "new"), "documents"); named.is_array()) {
        for (const json& document : named) {
            documents.push_back(text_of(document, "sha256"));
        }
    }
    return documents;
}

const std::vector<std::string>& kinds_of_life() {
    static const std::vector<std::string> k_kinds = {"numbered", "drafted",    "reviewed",   "authorised",
                                                     "issued",   "amended-by", "superseded", "withdrawn"};
    return k_kinds;
}

bool is_of_life(std::string_view kind) {
    const std::vector<std::string>& kinds = kinds_of_life();
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

std::string role_of(std::string_view kind) {
    return kind == "numbered" || kind == "drafted"                          ? "author"
           : kind == "reviewed"                                             ? "reviewer"
           : kind == "created" || kind == "settings" || kind == "backed-up" ? "keeper"
                                                                            : "authoriser";
}

const CertificateLife* LogRules::life(const std::string& certificate) const {
    const auto found = lives_.find(certificate);
    return found == lives_.end() ? nullptr : &found->second;
}

bool LogRules::may_be_amended(const std::string& certificate) const {
    const CertificateLife* const own = life(certificate);
    const CertificateLife* const later = own != nullptr && has_ended(*own) ? life(own->later) : nullptr;
    return own != nullptr && (own->state == "issued" || (later != nullptr && later->state == "withdrawn"));
}

long long LogRules::last_ordinal(const std::string& series) const {
    const auto found = ordinals_.find(series);
    return found == ordinals_.end() ? 0 : found->second;
}

long long LogRules::next_amendment(const std::string& original) const {
    const std::string series = series_of_amendments(original);
    long long ordinal = last_ordinal(series) + 1;
    // Drafts may carry such a number by hand; it is passed over and given to nobody else.
    while (life(series + std::to_string(ordinal)) != nullptr) {
        ++ordinal;
    }
    return ordinal;
}

bool LogRules::is_next_number(const LogEntry& entry, const json& body) const {
    const std::string series = text_of(member(body, "new"), "series");
    const json& ordinal = member(member(body, "new"), "ordinal");
    if (!ordinal.is_number_integer()) {
        return false;
    }
    const auto number = ordinal.get<long long>();
    const std::string amends = text_of(member(body, "new"), "amends");
    if (!amends.empty()) {
        return may_be_amended(amends) && series == series_of_amendments(amends) && number == next_amendment(amends) &&
               entry.certificate == series + std::to_string(number);
    }
    const std::string clock = text_of(body, k_clock);
    return !settings_.numbering.empty() && series == series_of(settings_.numbering, clock.empty() ? entry.at : clock) &&
           number == last_ordinal(series) + 1 && number_in(series, number) == entry.certificate;
}

std::string LogRules::due() const {
    return due_kind_.empty() ? "" : due_kind_ + ' ' + due_certificate_;
}

std::optional<Breach> LogRules::accept(const LogEntry& entry) {
    const std::optional<json> body = body_of(entry);
    if (!body) {
        return Breach{Breach::Kind::form, "the body is no JSON object", "an entry says what happened"};
    }
    if (std::optional<Breach> breach = breach_of(entry, *body)) {
        return breach;
    }
    apply(entry, *body);
    return std::nullopt;
}

void LogRules::take(const LogEntry& entry) {
    apply(entry, body_of(entry).value_or(json::object()));
    due_kind_.clear();  // it was written together with what was due
}

void LogRules::go_on_after(const std::string& last_at) {
    last_at_ = std::max(last_at_, last_at);
}

std::optional<Breach> LogRules::breach_of(const LogEntry& entry, const json& body) const {
    const auto form = [](std::string what, std::string rule) {
        return Breach{Breach::Kind::form, std::move(what), std::move(rule)};
    };
    for (const std::string* const text : {&entry.actor, &entry.kind, &entry.certificate, &entry.request_key}) {
        if (!is_plain(*text)) {
            return form("a text with control characters, or not UTF-8", "names and keys are plain text");
        }
    }
    if (entry.actor.empty()) {
        return form("nobody is named", "an entry says who");
    }
    if (!is_utc_time(entry.at)) {
        return form("the time is \"" + entry.at + "\"", "an entry says when, such as 2026-11-24T18:52:52Z");
    }
    if (!entry.record.empty() && !encoding::is_sha256(entry.record)) {
        return form("the record is \"" + entry.record + "\"", "a record is named by its SHA-256");
    }
    if (created_ == (entry.kind == "created")) {
        return Breach{Breach::Kind::order, "\"" + entry.kind + "\" stands here",
                      "the first entry, and no other one, is \"created\""};
    }
    // As text: all times have one form, in UTC, so that their order is that of their characters.
    if (entry.at < last_at_) {
        return Breach{Breach::Kind::order, "the time " + entry.at + " is before " + last_at_,
                      "no entry is earlier than the one before"};
    }
    const json& clock = member(body, k_clock);
    if (!clock.is_null() && (!is_utc_time(text_of(body, k_clock)) || text_of(body, k_clock) >= entry.at)) {
        return form("its clock is no time before its own",
                    "an entry after a clock that was ahead states the time of its own clock");
    }
    // Both entries or none: between them an original would hold beside its replacement.
    if (!due_kind_.empty() && (entry.kind != due_kind_ || entry.certificate != due_certificate_)) {
        return Breach{Breach::Kind::amendment, "\"" + entry.kind + "\" " + entry.certificate + " stands here",
                      "an amendment is issued together with the entry of its original"};
    }
    if (std::optional<Breach> breach =
            is_of_life(entry.kind) ? breach_of_life(entry, body) : breach_of_archive(entry, body)) {
        return breach;
    }
    if (std::optional<Breach> breach = breach_of_person(entry)) {
        return breach;
    }
    if (!clock.is_null() && entry.at != last_at_) {
        return Breach{Breach::Kind::clock, "the clock said " + text_of(body, k_clock) + ", and the time is another one",
                      "an entry after a clock that was ahead has the time of the entry before"};
    }
    return std::nullopt;
}

std::optional<Breach> LogRules::breach_of_archive(const LogEntry& entry, const json& body) const {
    const auto form = [](std::string what, std::string rule) {
        return Breach{Breach::Kind::form, std::move(what), std::move(rule)};
    };
    if (!entry.certificate.empty() || !entry.record.empty()) {
        return form("a certificate or record is named", "an entry of the archive itself concerns no certificate");
    }
    if (entry.kind == "created") {
        if (text_of(body, "schema") != "gumcert/archive/1" || !settings_from_json(member(body, "settings"))) {
            return form("schema or settings have another form", "the first entry states schema and settings");
        }
        return std::nullopt;
    }
    if (entry.kind == "settings") {
        // The old settings are repeated, so that a reader of one entry sees what changed and a removed entry is
        // noticed.
        if (member(body, "old") != to_json(settings_) || !settings_from_json(member(body, "new"))) {
            return Breach{Breach::Kind::settings, "old or new settings are others",
                          "a change of settings states the old and the new ones"};
        }
        return std::nullopt;
    }
    if (entry.kind == "backed-up") {
        return std::nullopt;
    }
    return form("\"" + entry.kind + "\" is no kind of entry", "kinds of entries are those of docs/archive.md");
}

std::optional<Breach> LogRules::breach_of_life(const LogEntry& entry, const json& body) const {
    const auto breach = [](Breach::Kind kind, std::string what, std::string rule) {
        return Breach{kind, std::move(what), std::move(rule)};
    };
    if (entry.certificate.empty()) {
        return breach(Breach::Kind::form, "no certificate is named", "an entry of a certificate names it");
    }
    static const CertificateLife k_none;
    const CertificateLife* const found = life(entry.certificate);
    const CertificateLife& life = found != nullptr ? *found : k_none;
    if (!ways().at(life.state).contains(entry.kind) || (has_ended(life) && !may_be_amended(entry.certificate))) {
        return breach(Breach::Kind::life,
                      "certificate " + entry.certificate + " is " + worded_state(&life) + ", and not to be " +
                          (entry.kind == "amended-by" ? "amended" : entry.kind),
                      "a certificate is drafted, reviewed, authorised, issued; then amended, superseded or withdrawn");
    }
    if (text_of(member(body, "old"), "state") != life.state || text_of(member(body, "new"), "state") != entry.kind) {
        return breach(Breach::Kind::form, "old or new state is another one",
                      "an entry states the old and the new state");
    }
    if (entry.kind == "numbered") {
        if (!is_next_number(entry, body)) {
            return breach(Breach::Kind::number, "the number is " + entry.certificate,
                          "certificate numbers follow each other without gaps");
        }
        return std::nullopt;
    }
    if (entry.kind == "drafted") {
        return breach_of_draft(entry, body);
    }
    if (entry.record != life.record) {
        return breach(Breach::Kind::life, "the record is another one than that of the draft",
                      "what is reviewed, authorised and issued is what was drafted");
    }
    if (entry.kind == "issued") {
        if (life.documents.empty()) {
            return breach(Breach::Kind::life, "there is no document", "a certificate is issued with its documents");
        }
        if (!life.amends.empty()) {
            const CertificateLife* const original = this->life(life.amends);
            if (!may_be_amended(life.amends)) {
                return breach(Breach::Kind::amendment, "certificate " + life.amends + " is " + worded_state(original),
                              k_amendable_rule);
            }
        }
    }
    if (entry.kind == "amended-by" || entry.kind == "superseded") {
        if (due_kind_ != entry.kind || due_certificate_ != entry.certificate ||
            text_of(member(body, "new"), "by") != due_by_) {
            return breach(Breach::Kind::amendment, "no amendment was issued just before",
                          "an original is amended or superseded when its amendment is issued");
        }
    }
    if (entry.kind == "withdrawn" && text_of(body, "why").empty()) {
        return breach(Breach::Kind::form, "no reason is given", "a certificate or number is withdrawn with a reason");
    }
    return std::nullopt;
}

std::optional<Breach> LogRules::breach_of_draft(const LogEntry& entry, const json& body) const {
    const auto breach = [](Breach::Kind kind, std::string what, std::string rule) {
        return Breach{kind, std::move(what), std::move(rule)};
    };
    const CertificateLife* const life = this->life(entry.certificate);
    const json& now = member(body, "new");
    const json& documents = member(now, "documents");
    bool well_formed = !entry.record.empty() && text_of(now, "record") == entry.record && documents.is_array() &&
                       text_of(member(body, "old"), "record") == (life != nullptr ? life->record : "");
    for (const json& document : documents) {
        well_formed =
            well_formed && encoding::is_sha256(text_of(document, "sha256")) && !text_of(document, "name").empty();
    }
    if (!well_formed) {
        return breach(Breach::Kind::form, "record or documents have another form",
                      "a draft names the record and the documents by their SHA-256");
    }
    const json& amends = member(body, "amends");
    const std::string original_number = text_of(amends, "number");
    if (!amends.is_null()) {
        const std::string kind = text_of(amends, "kind");
        const CertificateLife* const original = this->life(original_number);
        if (!may_be_amended(original_number) || original_number == entry.certificate) {
            return breach(Breach::Kind::amendment, "certificate " + original_number + " is " + worded_state(original),
                          k_amendable_rule);
        }
        if ((kind != "amended" && kind != "replaced") || text_of(body, "why").empty() ||
            !member(amends, "changes").is_array() || member(amends, "changes").empty()) {
            return breach(Breach::Kind::amendment, "kind, reason or changes are missing",
                          "an amendment states its kind, the reason and what has changed");
        }
    }
    if (life != nullptr && !life->number_amends.empty() && life->number_amends != original_number) {
        return breach(Breach::Kind::amendment,
                      "the number was taken for an amendment of " + life->number_amends + ", and the draft " +
                          (original_number.empty() ? "amends nothing" : "amends " + original_number),
                      "a number that was taken for an amendment is one of its original");
    }
    const bool numbered = life != nullptr;
    const bool follows_original = !original_number.empty() && entry.certificate.starts_with(original_number + "/");
    if (!settings_.numbering.empty() && !numbered && !follows_original) {
        return breach(Breach::Kind::number, "the number " + entry.certificate + " was not taken",
                      "certificates have a number that this archive gave, amendments that or the number of the "
                      "original with / behind it");
    }
    return std::nullopt;
}

std::optional<Breach> LogRules::breach_of_person(const LogEntry& entry) const {
    const std::string role = role_of(entry.kind);
    if (!settings_.persons.empty()) {
        const auto person = settings_.persons.find(entry.actor);
        if (person == settings_.persons.end() || !person->second.contains(role)) {
            return Breach{Breach::Kind::role, "\"" + entry.actor + "\" is no " + role + " of this archive",
                          "whoever does something has the role for it"};
        }
    }
    const CertificateLife* const life = this->life(entry.certificate);
    const bool judged = entry.kind == "reviewed" || entry.kind == "authorised";
    // Of all drafts, not only the last one: who drafted once knows what he wanted to see.
    const bool is_author = judged && life != nullptr &&
                           std::any_of(life->authors.begin(), life->authors.end(), [&](const std::string& author) {
                               return name_key(author) == name_key(entry.actor);
                           });
    if (settings_.four_eyes && is_author) {
        return Breach{Breach::Kind::four_eyes, "\"" + entry.actor + "\" has drafted it",
                      "nobody reviews or authorises what he has drafted (four eyes)"};
    }
    return std::nullopt;
}

void LogRules::apply(const LogEntry& entry, const json& body) {
    last_at_ = std::max(last_at_, entry.at);
    if (entry.kind == "created" || entry.kind == "settings") {
        created_ = true;
        settings_ = settings_from_json(member(body, entry.kind == "created" ? "settings" : "new")).value_or(settings_);
    }
    if (entry.certificate.empty() || !is_of_life(entry.kind)) {
        return;
    }
    CertificateLife& life = lives_[entry.certificate];
    life.state = entry.kind;
    life.since = entry.at;
    if (entry.kind == "authorised") {
        life.authorised_by = entry.actor;
    } else if (entry.kind == "issued") {
        const std::string clock = text_of(body, k_clock);
        life.issued_at = clock.empty() ? entry.at : clock;
    }
    due_kind_.clear();
    due_certificate_.clear();
    due_by_.clear();
    if (entry.kind == "numbered") {
        const json& ordinal = member(member(body, "new"), "ordinal");
        if (ordinal.is_number_integer()) {
            long long& last = ordinals_[text_of(member(body, "new"), "series")];
            last = std::max(last, ordinal.get<long long>());
        }
        life.number_amends = text_of(member(body, "new"), "amends");
    } else if (entry.kind == "drafted") {
        life.authors.insert(entry.actor);
        life.authorised_by.clear();
        life.record = entry.record;
        life.item = text_of(member(body, "new"), "item");
        life.documents = documents_in(body);
        life.amends = text_of(member(body, "amends"), "number");
        life.amendment_kind = text_of(member(body, "amends"), "kind");
    } else if (entry.kind == "issued" && !life.amends.empty()) {
        due_kind_ = life.amendment_kind == "replaced" ? "superseded" : "amended-by";
        due_certificate_ = life.amends;
        due_by_ = entry.certificate;
    } else if (entry.kind == "amended-by" || entry.kind == "superseded") {
        life.later = text_of(member(body, "new"), "by");
    }
}

}  // namespace gumcert::archive
