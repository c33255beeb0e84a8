#include "archive/evidence.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "archive/archive.h"
#include "archive/log_rules.h"
#include "archive/printed_head.h"
#include "archive/stated_number.h"
#include "archive/store/merkle.h"
#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "json/canonical_json.h"
#include "json/strict_parser.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::archive {

namespace {

using nlohmann::json;

constexpr const char* k_evidence_schema = "gumcert/archive-evidence/1";
constexpr std::size_t k_largest_base64 = std::size_t{512} << 20U;

json hexadecimal_list(const std::vector<std::string>& hashes) {
    json list = json::array();
    for (const std::string& hash : hashes) {
        list.push_back(encoding::hexadecimal(hash));
    }
    return list;
}

/// Names and SHA-256 of the documents that the body of a draft names.
std::vector<std::pair<std::string, std::string>> named_documents_in(const json& body) {
    std::vector<std::pair<std::string, std::string>> named;
    const auto text_of_document = [](const json& document, const char* key) {
        const auto found = document.is_object() ? document.find(key) : document.end();
        return document.is_object() && found != document.end() && found->is_string() ? found->get<std::string>()
                                                                                     : std::string();
    };
    const json now = body.value("new", json());
    const json documents = now.is_object() ? now.value("documents", json()) : json();
    for (const json& document : documents.is_array() ? documents : json::array()) {
        named.emplace_back(text_of_document(document, "name"), text_of_document(document, "sha256"));
    }
    return named;
}

/// Reads the parts of an evidence; whatever has another form is refused with its place.
class EvidenceReader {
public:
    explicit EvidenceReader(std::string name) : name_(std::move(name)) {}

    [[noreturn]] void refuse(const std::string& at, const char* what = "is missing or has another form") const {
        throw gum::InputError(gum::Diagnostic{.code = "GC-ARCHIVE-0047",
                                              .where = at.empty() ? name_ : name_ + "#" + at,
                                              .what = at.empty() ? "is no evidence" : what,
                                              .rule = "evidence is the JSON that gumcert archive export writes",
                                              .action = "name a file that gumcert archive export has written"});
    }

    /// Nothing stands in evidence of which nothing would be proved.
    void require_known(const json& object, const std::string& at, std::initializer_list<std::string_view> known) const {
        if (const std::string other = member_beside(object, known); !other.empty()) {
            refuse(at + "/" + text::visible(other), "is no member of evidence that this version knows");
        }
    }
    [[nodiscard]] const json& member(const json& object, const std::string& at, const char* key) const {
        const auto found = object.is_object() ? object.find(key) : object.end();
        if (!object.is_object() || found == object.end()) {
            refuse(at + "/" + key);
        }
        return *found;
    }
    [[nodiscard]] std::string text(const json& object, const std::string& at, const char* key) const {
        const json& value = member(object, at, key);
        if (!value.is_string()) {
            refuse(at + "/" + key);
        }
        return value.get<std::string>();
    }
    [[nodiscard]] std::int64_t integer(const json& object, const std::string& at, const char* key) const {
        const json& value = member(object, at, key);
        if (!value.is_number_integer()) {
            refuse(at + "/" + key);
        }
        return value.get<std::int64_t>();
    }
    [[nodiscard]] const json& list(const json& object, const std::string& at, const char* key) const {
        const json& value = member(object, at, key);
        if (!value.is_array()) {
            refuse(at + "/" + key);
        }
        return value;
    }
    [[nodiscard]] std::string hash(const std::string& digits, const std::string& at) const {
        std::optional<std::string> bytes = encoding::bytes_from_hexadecimal(digits);
        if (!bytes || bytes->size() != 32) {
            refuse(at);
        }
        return std::move(*bytes);
    }

    [[nodiscard]] Evidence::ProvenEntry entry(const json& object, const std::string& at) const {
        require_known(
            object, at,
            {"seq", "at", "actor", "kind", "certificate", "record", "request_key", "body", "prev", "hash", "proof"});
        Evidence::ProvenEntry read;
        read.entry = {.seq = integer(object, at, "seq"),
                      .at = text(object, at, "at"),
                      .actor = text(object, at, "actor"),
                      .kind = text(object, at, "kind"),
                      .certificate = text(object, at, "certificate"),
                      .record = text(object, at, "record"),
                      .request_key = text(object, at, "request_key"),
                      .body = text(object, at, "body"),
                      .prev = hash(text(object, at, "prev"), at + "/prev"),
                      .hash = hash(text(object, at, "hash"), at + "/hash")};
        read.proof = proof(object, at);
        return read;
    }
    [[nodiscard]] StateStatement states(const json& object) const {
        const std::string at = "/states";
        require_known(object, at, {"at", "certificates", "signature"});
        StateStatement read{.at = text(object, at, "at"), .certificates = {}};
        std::size_t index = 0;
        for (const json& one : list(object, at, "certificates")) {
            const std::string place = at + "/certificates/" + std::to_string(index++);
            require_known(one, place, {"certificate", "state", "later", "entries"});
            StateStatement::Certificate stated{
                text(one, place, "certificate"), text(one, place, "state"), text(one, place, "later"), {}};
            for (const json& seq : list(one, place, "entries")) {
                if (!seq.is_number_integer()) {
                    refuse(place + "/entries");
                }
                stated.entries.push_back(seq.get<std::int64_t>());
            }
            read.certificates.push_back(std::move(stated));
        }
        const std::optional<Head::Signature> signature = signature_in(member(object, at, "signature"));
        if (!signature) {
            refuse(at + "/signature");
        }
        read.signature = *signature;
        return read;
    }
    [[nodiscard]] Head::Extension extension(const json& object, const std::string& at) const {
        require_known(object, at, {"size", "root", "proof"});
        return {integer(object, at, "size"), hash(text(object, at, "root"), at + "/root"), proof(object, at)};
    }

private:
    std::string name_;

    [[nodiscard]] std::vector<std::string> proof(const json& object, const std::string& at) const {
        std::vector<std::string> nodes;
        for (const json& node : list(object, at, "proof")) {
            if (!node.is_string()) {
                refuse(at + "/proof");
            }
            nodes.push_back(hash(node.get<std::string>(), at + "/proof"));
        }
        return nodes;
    }
};

class EvidenceVerifier {
public:
    explicit EvidenceVerifier(const Evidence& evidence) : evidence_(evidence) {}

    EvidenceVerdict verify(const std::vector<Head>& heads, std::vector<Head> known) {
        known.insert(known.end(), heads.begin(), heads.end());
        for (const Evidence::ProvenEntry& proven : evidence_.entries) {
            look_at(proven);
        }
        for (const Head::Extension& one : evidence_.printed_heads) {
            if (leads_to_the_head(one)) {
                proven_heads_.emplace(one.size, one.root);
            }
        }
        look_at_contents();
        const CertificateLife* const life = rules_.life(evidence_.certificate);
        if (life == nullptr || life->record.empty()) {
            add("GC-ARCHIVE-0048", evidence_.certificate, "no entry with a record is about this certificate",
                "evidence holds the entries of its certificate");
        } else {
            follow(evidence_.certificate);
        }
        for (EvidenceVerdict::Part& part : verdict_.parts) {
            part.holds = life != nullptr &&
                         (part.sha256 == life->record || std::find(life->documents.begin(), life->documents.end(),
                                                                   part.sha256) != life->documents.end());
        }
        if (evidence_.states) {
            look_at_states(*evidence_.states);
        }
        if (evidence_.head.extends && !proves_its_extension(evidence_.head)) {
            add("GC-ARCHIVE-0051", "head of " + text::count_of(evidence_.head.size, "entry"),
                "its proof does not lead to its root",
                "a later head proves that the log begins with what an earlier one says");
        }
        for (const Head& head : heads) {
            compare_with(head, known);
        }
        return std::move(verdict_);
    }

private:
    const Evidence& evidence_;
    EvidenceVerdict verdict_;
    LogRules rules_;
    std::int64_t last_ = 0;  // entry that stands where it may
    std::set<std::string> keys_;
    std::map<std::string, const LogEntry*> needed_;                // content → entry that names it first
    std::map<std::string, std::int64_t> drafts_;                   // record → its first draft
    std::set<std::pair<std::int64_t, std::string>> proven_heads_;  // printed ones that lead to the head
    std::set<std::pair<std::string, std::string>> told_of_;        // names and SHA-256 of the parts of the verdict

    void add(const char* code, std::string where, std::string what, std::string rule) {
        verdict_.findings.push_back({.code = code,
                                     .where = std::move(where),
                                     .what = std::move(what),
                                     .rule = std::move(rule),
                                     .action = "do not rely on this evidence; ask the laboratory for a new one"});
    }

    /// From amendment to amendment: what a certificate says holds as long as the last one of them does.
    void follow(const std::string& certificate) {
        std::set<std::string> seen;
        for (std::string number = certificate; !number.empty() && seen.insert(number).second;) {
            const CertificateLife* const life = rules_.life(number);
            verdict_.chain.push_back(life == nullptr ? EvidenceVerdict::Certificate{number, "", ""}
                                                     : EvidenceVerdict::Certificate{number, life->state, life->since});
            number = life == nullptr ? "" : life->later;
        }
    }

    void compare_with(const Head& head, const std::vector<Head>& known) {
        const Head& own = evidence_.head;
        const std::string where = "head of " + text::count_of(head.size, "entry") + ", " + head.at;
        if (head.archive != own.archive || (head.size == own.size && !is_same_log(head, own)) ||
            (head.size < own.size ? head.at > own.at : head.at < own.at)) {
            add("GC-ARCHIVE-0045", where, "the evidence is of another archive, or of a log that was rewritten",
                "heads of one archive agree");
            return;
        }
        const auto proves = [&](const Head& later, const Head& earlier) {
            const bool is_printed = &later == &own && proven_heads_.contains({earlier.size, earlier.root});
            return is_printed || proves_extension(later, earlier);
        };
        const bool is_extended_here =
            head.size == own.size ||
            (head.size < own.size ? leads_to(own, head, known, proves) : leads_to(head, own, known, proves));
        if (!is_extended_here) {
            verdict_.findings.push_back(
                {.code = "GC-ARCHIVE-0051",
                 .where = where,
                 .what = head.size < own.size ? "the evidence does not prove that its log begins with that of this head"
                                              : "it does not prove that its log begins with that of the evidence",
                 .rule = "a later head proves that the log begins with what an earlier one says",
                 .action = head.size < own.size
                               ? "ask for evidence that is made with gumcert archive export --since and this head"
                               : "ask for a head that is made with gumcert archive head --since and this evidence"});
        }
    }

    [[nodiscard]] bool leads_to_the_head(const Head::Extension& one) const {
        return one.size >= 1 &&
               is_extended(static_cast<std::size_t>(one.size), one.root, static_cast<std::size_t>(evidence_.head.size),
                           evidence_.head.root, one.proof);
    }

    void look_at(const Evidence::ProvenEntry& proven) {
        const LogEntry& entry = proven.entry;
        const std::string where = "entry " + std::to_string(entry.seq);
        if (entry.seq <= last_ || entry.seq > evidence_.head.size) {
            add("GC-ARCHIVE-0048", where, "stands at a wrong place", "entries stand in their order, up to the head");
            return;
        }
        last_ = entry.seq;
        if (entry_hash(entry) != entry.hash) {
            add("GC-ARCHIVE-0040", where, "its fields give another hash than the one it has",
                "an entry is as it was when it was written");
        }
        if ((entry.seq == 1) != (entry.hash == evidence_.head.archive) || entry.at > evidence_.head.at ||
            (entry.seq == evidence_.head.size && !ends_with(evidence_.head, entry.hash, entry.at, clock_of(entry))) ||
            root_of_proof(entry.hash, static_cast<std::size_t>(entry.seq - 1),
                          static_cast<std::size_t>(evidence_.head.size), proven.proof) != evidence_.head.root) {
            add("GC-ARCHIVE-0048", where, "its proof does not lead to the head",
                "the proof of an entry leads to the root in the head (RFC 6962, 2.1.1)");
        }
        // Entries of other certificates are not there, so numbers are not judged; the archive itself judges them.
        if (const std::optional<Breach> breach = rules_.accept(entry)) {
            // Taken all the same: what the entries show is told, and said to be no more than that.
            rules_.take(entry);
            if (breach->kind == Breach::Kind::number) {
                look_at_role(entry);
            } else if (breach->kind != Breach::Kind::clock) {
                add("GC-ARCHIVE-0043", where, breach->what, breach->rule);
            }
        }
        if (!entry.request_key.empty() && !keys_.insert(entry.request_key).second) {
            add("GC-ARCHIVE-0043", where, "its key " + text::in_quotes(entry.request_key) + " was used before",
                "a key belongs to one request");
        }
        if (entry.kind == "drafted" && entry.certificate == evidence_.certificate) {
            drafts_.emplace(entry.record, entry.seq);
            needed_.emplace(entry.record, &entry);
            tell_of("", entry.record);
            const json body = body_of(entry).value_or(json::object());
            for (const std::string& sha256 : documents_in(body)) {
                needed_.emplace(sha256, &entry);
            }
            for (const auto& [name, sha256] : named_documents_in(body)) {
                tell_of(name, sha256);
            }
        }
    }

    void tell_of(const std::string& name, const std::string& sha256) {
        if (told_of_.emplace(name, sha256).second) {
            verdict_.parts.push_back({name, sha256, false});
        }
    }

    /// The number is asked before the role: where that is not judged, the role still is.
    void look_at_role(const LogEntry& entry) {
        const std::map<std::string, std::set<std::string>>& persons = rules_.settings().persons;
        const auto person = persons.find(entry.actor);
        const std::string role = role_of(entry.kind);
        if (!persons.empty() && (person == persons.end() || !person->second.contains(role))) {
            add("GC-ARCHIVE-0043", "entry " + std::to_string(entry.seq),
                text::in_quotes(entry.actor) + " is no " + role + " of this archive",
                "whoever does something has the role for it");
        }
    }

    /// A head that a document prints is one that the head of the evidence extends.
    void look_at_printed_heads(const Content& content, const LogEntry& naming) {
        for (const PrintedHead& printed : printed_heads_in(content.bytes)) {
            const bool is_of_log = proven_heads_.contains({printed.size, printed.root});
            if (std::string fault = fault_of(printed, is_of_log, drafts_.at(naming.record), naming.seq);
                !fault.empty()) {
                add("GC-ARCHIVE-0053", "content " + content.sha256, std::move(fault),
                    "a document prints a head of its archive that contains a draft of its record");
            }
        }
    }

    void look_at_number(const Content& content) {
        const auto drafted = drafts_.find(content.sha256);
        const std::string number = drafted == drafts_.end() ? "" : number_stated_in(content.bytes);
        if (!number.empty() && number != evidence_.certificate) {
            add("GC-ARCHIVE-0043", "entry " + std::to_string(drafted->second),
                "its record states the number " + text::in_quotes(number), k_number_rule);
        }
    }

    /// The statement names every entry that the log has of its certificates: one that was left out, or planted, shows.
    void look_at_states(const StateStatement& states) {
        if (!is_utc_time(states.at) || states.at < time_of(evidence_.head)) {
            add("GC-ARCHIVE-0056", "statement of states", "its time is none, or before that of the head",
                "a statement of states is made of the log that its head speaks of");
        }
        if (!evidence_.head.signature || evidence_.head.signature->public_key != states.signature.public_key) {
            add("GC-ARCHIVE-0056", "statement of states", "is signed with another key than the head",
                "head and statement of states are signed with one key");
        }
        const StateStatement found = states_in(evidence_, states.at);
        if (std::none_of(found.certificates.begin(), found.certificates.end(),
                         [&](const auto& one) { return one.number == evidence_.certificate; })) {
            return;  // said already: no entry is about it
        }
        for (const StateStatement::Certificate& stated : states.certificates) {
            const auto own = std::find_if(found.certificates.begin(), found.certificates.end(),
                                          [&](const auto& one) { return one.number == stated.number; });
            if (own == found.certificates.end() || own->entries != stated.entries) {
                add("GC-ARCHIVE-0056", "certificate " + text::visible(stated.number),
                    "the entries at hand are not those that the laboratory states",
                    "evidence holds every entry that its statement of states names, and no other one");
            } else if (*own != stated) {
                add("GC-ARCHIVE-0056", "certificate " + text::visible(stated.number),
                    "its entries lead to another state than the one that the laboratory states",
                    "a statement of states says what its entries say");
            }
        }
        const auto number_of = [](const StateStatement::Certificate& one) { return one.number; };
        std::vector<std::string> stated_numbers;
        std::vector<std::string> own_numbers;
        std::transform(states.certificates.begin(), states.certificates.end(), std::back_inserter(stated_numbers),
                       number_of);
        std::transform(found.certificates.begin(), found.certificates.end(), std::back_inserter(own_numbers),
                       number_of);
        if (stated_numbers != own_numbers) {
            add("GC-ARCHIVE-0056", "statement of states", "is of other certificates than the entries at hand",
                "a statement of states names each certificate of its evidence once, by number");
        }
    }

    void look_at_contents() {
        std::set<std::string> kept;
        for (const Content& content : evidence_.contents) {
            if (encoding::sha256(content.bytes) != content.sha256) {
                add("GC-ARCHIVE-0044", "content " + content.sha256, "its bytes have another hash",
                    "a content is found by the hash of its bytes");
            } else if (const auto named = needed_.find(content.sha256); named == needed_.end()) {
                add("GC-ARCHIVE-0044", "content " + content.sha256, "no entry names it",
                    "evidence holds what its entries name");
            } else {
                look_at_printed_heads(content, *named->second);
                look_at_number(content);
            }
            kept.insert(content.sha256);
        }
        for (const auto& [sha256, entry] : needed_) {
            if (!kept.contains(sha256)) {
                add("GC-ARCHIVE-0044", "entry " + std::to_string(entry->seq), "the content " + sha256 + " is not there",
                    "records and documents that the log names are kept");
            }
        }
    }
};

/// A head that the log never had has no proof: who verifies the evidence says so.
void prove_printed_heads(Evidence& evidence, const std::string& document, const MerkleTree& tree) {
    for (const PrintedHead& printed : printed_heads_in(document)) {
        const auto size = static_cast<std::size_t>(printed.size);
        if (size <= tree.size() && tree.root(size) == printed.root) {
            Head::Extension proven{printed.size, printed.root, tree.consistency_proof(size, tree.size())};
            if (std::find(evidence.printed_heads.begin(), evidence.printed_heads.end(), proven) ==
                evidence.printed_heads.end()) {
                evidence.printed_heads.push_back(std::move(proven));
            }
        }
    }
}

}  // namespace

Evidence evidence_of(Store& store, const std::string& certificate, const std::optional<Head>& since) {
    Evidence evidence{.certificate = certificate, .head = {}, .entries = {}, .contents = {}};
    store.read([&] {
        // The certificate, what it amends, what amends it, and so on.
        std::set<std::string> chain{certificate};
        std::map<std::int64_t, LogEntry> entries;
        for (std::vector<std::string> next{certificate}; !next.empty();) {
            const std::string number = std::move(next.back());
            next.pop_back();
            for (const LogEntry& entry : store.entries_of(number)) {
                const json body = body_of(entry).value_or(json::object());
                for (const std::string& other : {text_in(body, "amends", "number"), text_in(body, "new", "by")}) {
                    if (!other.empty() && chain.insert(other).second) {
                        next.push_back(other);
                    }
                }
                entries.emplace(entry.seq, entry);
            }
        }
        if (certificate.empty() || entries.empty()) {  // "" finds the entries of the archive itself
            refuse_unknown(certificate, store.name());
        }
        WalkedLog log;
        store.each_entry([&](const LogEntry& entry) {
            // Who may do what follows from the settings of that time, so a reader of the evidence needs all of them.
            if (entry.kind == "created" || entry.kind == "settings") {
                entries.emplace(entry.seq, entry);
            }
            log.add(entry);
        });
        const std::optional<Head> head = since ? log.head_since(*since) : log.head();
        if (!head) {
            throw gum::InputError(gum::Diagnostic{
                .code = "GC-ARCHIVE-0036",
                .where = "head of " + text::count_of(since->size, "entry") + ", " + since->at,
                .what = "the archive does not begin with these entries",
                .rule = "an archive begins with what its earlier heads say",
                .action = "the log was cut off, rewritten, or belongs to another archive: compare with a backup"});
        }
        evidence.head = *head;
        const MerkleTree& tree = log.tree();
        std::set<std::string> named;
        for (const auto& [seq, entry] : entries) {
            evidence.entries.push_back({entry, tree.inclusion_proof(static_cast<std::size_t>(seq - 1), tree.size())});
            if (entry.kind != "drafted" || entry.certificate != certificate) {
                continue;
            }
            std::vector<std::string> contents = documents_in(body_of(entry).value_or(json::object()));
            contents.insert(contents.begin(), entry.record);
            for (const std::string& sha256 : contents) {
                std::optional<std::string> bytes = store.content(sha256);
                if (bytes && named.insert(sha256).second) {
                    prove_printed_heads(evidence, *bytes, tree);
                    evidence.contents.push_back({sha256, std::move(*bytes)});
                }
            }
        }
    });
    return evidence;
}

StateStatement states_in(const Evidence& evidence, const std::string& at) {
    LogRules rules;
    std::map<std::string, std::vector<std::int64_t>> entries;
    for (const auto& [entry, proof] : evidence.entries) {
        if (rules.accept(entry)) {
            rules.take(entry);
        }
        if (!entry.certificate.empty()) {
            entries[entry.certificate].push_back(entry.seq);
        }
    }
    StateStatement statement{.at = at, .certificates = {}};
    for (auto& [number, own] : entries) {
        const CertificateLife* const life = rules.life(number);
        statement.certificates.push_back(
            {number, life == nullptr ? "" : life->state, life == nullptr ? "" : life->later, std::move(own)});
    }
    return statement;
}

std::string to_json(const Evidence& evidence) {
    json entries = json::array();
    for (const auto& [entry, proof] : evidence.entries) {
        entries.push_back({{"seq", entry.seq},
                           {"at", entry.at},
                           {"actor", entry.actor},
                           {"kind", entry.kind},
                           {"certificate", entry.certificate},
                           {"record", entry.record},
                           {"request_key", entry.request_key},
                           {"body", entry.body},
                           {"prev", encoding::hexadecimal(entry.prev)},
                           {"hash", encoding::hexadecimal(entry.hash)},
                           {"proof", hexadecimal_list(proof)}});
    }
    json contents = json::array();
    for (const Content& content : evidence.contents) {
        contents.push_back({{"sha256", content.sha256}, {"base64", encoding::base64(content.bytes)}});
    }
    json object{{"schema", k_evidence_schema},
                {"certificate", evidence.certificate},
                {"head", json::parse(to_json(evidence.head))},
                {"entries", entries},
                {"contents", contents}};
    for (const Head::Extension& one : evidence.printed_heads) {
        object["printed_heads"].push_back(
            {{"size", one.size}, {"root", encoding::hexadecimal(one.root)}, {"proof", hexadecimal_list(one.proof)}});
    }
    if (evidence.states) {
        json stated = json::array();
        for (const StateStatement::Certificate& one : evidence.states->certificates) {
            stated.push_back(
                {{"certificate", one.number}, {"state", one.state}, {"later", one.later}, {"entries", one.entries}});
        }
        object["states"] = {{"at", evidence.states->at},
                            {"certificates", std::move(stated)},
                            {"signature", to_json(evidence.states->signature)}};
    }
    return gumcert::json::canonical_json(object);
}

Evidence evidence_from_json(std::string_view text, const std::string& name) {
    const EvidenceReader reader(name);
    const std::optional<json> object = gumcert::json::parse_faultless(text, {.string_bytes = k_largest_base64});
    if (!object || !object->is_object() || object->value("schema", json()) != k_evidence_schema) {
        reader.refuse("");
    }
    reader.require_known(*object, "",
                         {"schema", "certificate", "head", "entries", "contents", "printed_heads", "states"});
    Evidence evidence;
    evidence.certificate = reader.text(*object, "", "certificate");
    evidence.head = head_in(reader.member(*object, "", "head"), name);
    std::size_t index = 0;
    for (const json& entry : reader.list(*object, "", "entries")) {
        evidence.entries.push_back(reader.entry(entry, "/entries/" + std::to_string(index++)));
    }
    index = 0;
    for (const json& content : reader.list(*object, "", "contents")) {
        const std::string at = "/contents/" + std::to_string(index++);
        reader.require_known(content, at, {"sha256", "base64"});
        const std::string digits = reader.text(content, at, "base64");
        std::optional<std::string> bytes = encoding::bytes_from_base64(digits);
        // One text for the same bytes: no blanks, no line breaks, no bits behind the last byte.
        if (!bytes || encoding::base64(*bytes) != digits) {
            reader.refuse(at + "/base64");
        }
        evidence.contents.push_back({reader.text(content, at, "sha256"), std::move(*bytes)});
    }
    index = 0;
    if (object->contains("printed_heads")) {
        for (const json& head : reader.list(*object, "", "printed_heads")) {
            evidence.printed_heads.push_back(reader.extension(head, "/printed_heads/" + std::to_string(index++)));
        }
    }
    if (const auto states = object->find("states"); states != object->end()) {
        evidence.states = reader.states(*states);
    }
    return evidence;
}

EvidenceVerdict verify_evidence(const Evidence& evidence, const std::vector<Head>& heads,
                                const std::vector<Head>& known) {
    return EvidenceVerifier(evidence).verify(heads, known);
}

}  // namespace gumcert::archive
