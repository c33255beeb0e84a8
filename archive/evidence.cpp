#include "archive/evidence.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "archive/archive.h"
#include "archive/log_rules.h"
#include "archive/printed_head.h"
#include "archive/store/merkle.h"
#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "json/canonical_json.h"
#include "json/strict_parser.h"

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

/// Reads the parts of an evidence; whatever has another form is refused with its place.
class EvidenceReader {
public:
    explicit EvidenceReader(std::string name) : name_(std::move(name)) {}

    [[noreturn]] void refuse(const std::string& at) const {
        throw gum::InputError(gum::Diagnostic{.code = "GC-ARCHIVE-0047",
                                              .where = at.empty() ? name_ : name_ + "#" + at,
                                              .what = at.empty() ? "is no evidence" : "is missing or has another form",
                                              .rule = "evidence is the JSON that gumcert archive export writes",
                                              .action = "name a file that gumcert archive export has written"});
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
    [[nodiscard]] Head::Extension extension(const json& object, const std::string& at) const {
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

    EvidenceVerdict verify(const std::vector<Head>& heads) {
        std::int64_t last = 0;
        for (const Evidence::ProvenEntry& proven : evidence_.entries) {
            look_at(proven, last);
            last = proven.entry.seq;
        }
        look_at_contents();
        const CertificateLife* const life = rules_.life(evidence_.certificate);
        if (life == nullptr || life->record.empty()) {
            add("GC-ARCHIVE-0048", evidence_.certificate, "no entry with a record is about this certificate",
                "evidence holds the entries of its certificate");
        } else {
            verdict_.state = life->state;
            verdict_.later = life->later;
        }
        for (const Head& head : heads) {
            if (head.archive != evidence_.head.archive ||
                (head.size == evidence_.head.size &&
                 (head.root != evidence_.head.root || head.chain != evidence_.head.chain))) {
                add("GC-ARCHIVE-0045", "head of " + std::to_string(head.size) + " entries, " + head.at,
                    "the evidence is of another archive, or of a log that was rewritten", "heads of one archive agree");
            }
        }
        return std::move(verdict_);
    }

private:
    const Evidence& evidence_;
    EvidenceVerdict verdict_;
    LogRules rules_;
    std::map<std::string, const LogEntry*> needed_;  // content → entry that names it first
    std::map<std::string, std::int64_t> drafts_;     // record → its first draft

    void add(const char* code, std::string where, std::string what, std::string rule) {
        verdict_.findings.push_back({.code = code,
                                     .where = std::move(where),
                                     .what = std::move(what),
                                     .rule = std::move(rule),
                                     .action = "do not rely on this evidence; ask the laboratory for a new one"});
    }

    void look_at(const Evidence::ProvenEntry& proven, std::int64_t last) {
        const LogEntry& entry = proven.entry;
        const std::string where = "entry " + std::to_string(entry.seq);
        if (entry.seq <= last || entry.seq > evidence_.head.size) {
            add("GC-ARCHIVE-0048", where, "stands at a wrong place", "entries stand in their order, up to the head");
            return;
        }
        if (entry_hash(entry) != entry.hash) {
            add("GC-ARCHIVE-0040", where, "its fields give another hash than the one it has",
                "an entry is as it was when it was written");
        }
        if ((entry.seq == 1) != (entry.hash == evidence_.head.archive) ||
            (entry.seq == evidence_.head.size &&
             (entry.hash != evidence_.head.chain || entry.at != evidence_.head.at)) ||
            root_of_proof(entry.hash, static_cast<std::size_t>(entry.seq - 1),
                          static_cast<std::size_t>(evidence_.head.size), proven.proof) != evidence_.head.root) {
            add("GC-ARCHIVE-0048", where, "its proof does not lead to the head",
                "the proof of an entry leads to the root in the head (RFC 6962, 2.1.1)");
        }
        // Entries of other certificates are not there, so numbers are not judged; the archive itself judges them.
        if (const std::optional<Breach> breach = rules_.accept(entry); breach && breach->kind != Breach::Kind::number) {
            add("GC-ARCHIVE-0043", where, breach->what, breach->rule);
        } else if (breach) {
            rules_.take(entry);
        }
        if (entry.kind == "drafted" && entry.certificate == evidence_.certificate) {
            drafts_.emplace(entry.record, entry.seq);
            needed_.emplace(entry.record, &entry);
            for (const std::string& sha256 : documents_in(body_of(entry).value_or(json::object()))) {
                needed_.emplace(sha256, &entry);
            }
        }
    }

    /// A head that a document prints is one that the head of the evidence extends.
    void look_at_printed_heads(const Content& content, const LogEntry& naming) {
        for (const PrintedHead& printed : printed_heads_in(content.bytes)) {
            const bool is_of_log = std::any_of(
                evidence_.printed_heads.begin(), evidence_.printed_heads.end(), [&](const Head::Extension& one) {
                    return one.size == printed.size && one.root == printed.root &&
                           is_extended(static_cast<std::size_t>(one.size), one.root,
                                       static_cast<std::size_t>(evidence_.head.size), evidence_.head.root, one.proof);
                });
            if (std::string fault = fault_of(printed, is_of_log, drafts_.at(naming.record), naming.seq);
                !fault.empty()) {
                add("GC-ARCHIVE-0053", "content " + content.sha256, std::move(fault),
                    "a document prints a head of its archive that contains a draft of its record");
            }
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

Evidence evidence_of(Store& store, const std::string& certificate) {
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
        if (entries.empty()) {
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
        evidence.head = log.head();
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
    return gumcert::json::canonical_json(object);
}

Evidence evidence_from_json(std::string_view text, const std::string& name) {
    const EvidenceReader reader(name);
    const std::optional<json> object = gumcert::json::parse_faultless(text, {.string_bytes = k_largest_base64});
    if (!object || !object->is_object() || object->value("schema", json()) != k_evidence_schema) {
        reader.refuse("");
    }
    Evidence evidence;
    evidence.certificate = reader.text(*object, "", "certificate");
    evidence.head = head_from_json(reader.member(*object, "", "head").dump(), name);
    std::size_t index = 0;
    for (const json& entry : reader.list(*object, "", "entries")) {
        evidence.entries.push_back(reader.entry(entry, "/entries/" + std::to_string(index++)));
    }
    index = 0;
    for (const json& content : reader.list(*object, "", "contents")) {
        const std::string at = "/contents/" + std::to_string(index++);
        std::optional<std::string> bytes = encoding::bytes_from_base64(reader.text(content, at, "base64"));
        if (!bytes) {
            reader.refuse(at + "/base64");
        }
        evidence.contents.push_back({reader.text(content, at, "sha256"), std::move(*bytes)});
    }
    index = 0;
    for (const json& head : object->value("printed_heads", json::array())) {
        evidence.printed_heads.push_back(reader.extension(head, "/printed_heads/" + std::to_string(index++)));
    }
    return evidence;
}

EvidenceVerdict verify_evidence(const Evidence& evidence, const std::vector<Head>& heads) {
    return EvidenceVerifier(evidence).verify(heads);
}

}  // namespace gumcert::archive
