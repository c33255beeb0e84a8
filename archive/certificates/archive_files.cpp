#include "archive/certificates/archive_files.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "archive/certificates/message_json.h"
#include "archive/evidence.h"
#include "archive/verification.h"
#include "encoding/sha2.h"
#include "evaluation/read_file.h"
#include "json/members.h"
#include "signing/ed25519.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::archive {

namespace {

using nlohmann::json;
using Signature = std::optional<Head::Signature>;

constexpr const char* k_schema_of_verification = "gumcert/archive-verification/1";

/// What is wrong with a signature: it is there where there is a key, fits, and is of that key.
/// \param what  is signed, in words
std::optional<gum::Diagnostic> fault_of_signature(const Signature& signature, const std::string& bytes,
                                                  const std::string& key, const std::string& name,
                                                  const std::string& what) {
    const bool fits = signature && signing::is_signed_ed25519(bytes, {signature->public_key, signature->value});
    if ((!signature && key.empty()) || (fits && (key.empty() || signature->public_key == key))) {
        return std::nullopt;
    }
    return gum::Diagnostic{.code = "GC-ARCHIVE-0050",
                           .where = name,
                           .what = !signature ? "the " + what + " is not signed"
                                   : !fits    ? "the signature is not one of this " + what
                                              : "the " + what + " is signed with another key than the trusted one",
                           .rule = "a signed head is one that the laboratory made",
                           .action = "ask the laboratory for its head and its public key"};
}

std::string hexadecimal_key(const Signature& signature) {
    return signature ? encoding::hexadecimal(signature->public_key) : std::string();
}

/// "issued", or "superseded, see EX-1/A1, which is issued".
std::string state_in_words(const std::vector<EvidenceVerdict::Certificate>& chain) {
    std::string words = chain.empty() ? "of unknown state" : text::one_line(chain.front().state);
    for (std::size_t i = 1; i < chain.size(); ++i) {
        words += ", see " + text::one_line(chain[i].number) + ", which is " +
                 (chain[i].state.empty() ? "of unknown state" : text::one_line(chain[i].state));
    }
    return words;
}

/// Who stands for a head.
std::string signer_in_words(const Signature& signature, const std::string& key, bool with_states) {
    if (!signature) {
        return "the head is not signed: whoever writes such a file can invent all of it";
    }
    return std::string(with_states ? "head and states are" : "the head is") + " signed by " +
           hexadecimal_key(signature) +
           (key.empty()                    ? "; no trusted key was named"
            : signature->public_key == key ? ", the trusted key"
                                           : ", which is not the trusted key");
}

std::string name_of(const EvidenceVerdict::Part& part) {
    return part.name.empty() ? "record" : "document " + text::one_line(part.name);
}

/// \return lines: what the certificate consists of, and which of it is in hand
std::vector<std::string> tell_documents(const std::string& certificate, const std::vector<EvidenceVerdict::Part>& parts,
                                        std::vector<DocumentInHand>& documents) {
    std::vector<std::string> lines;
    for (const EvidenceVerdict::Part& part : parts) {
        lines.push_back(name_of(part) + ": " + text::one_line(part.sha256) +
                        (part.holds ? "" : ", of an earlier draft"));
    }
    for (DocumentInHand& document : documents) {
        const auto found = [&](bool holds) {
            return std::find_if(parts.begin(), parts.end(), [&document, holds](const auto& part) {
                return part.sha256 == document.sha256 && part.holds == holds;
            });
        };
        if (const auto part = found(true); part != parts.end()) {
            lines.push_back(text::one_line(document.file) + ": is the " + name_of(*part) + " of " +
                            text::one_line(certificate));
            document.is_told = true;
        } else if (found(false) != parts.end()) {
            document.earlier_of = certificate;
        }
    }
    return lines;
}

void add_line(std::vector<std::string>& lines, std::string line) {
    if (!line.empty()) {
        lines.push_back(std::move(line));
    }
}

json shown_chain(const std::vector<EvidenceVerdict::Certificate>& chain) {
    json list = json::array();
    for (const EvidenceVerdict::Certificate& one : chain) {
        list.push_back({{"number", one.number}, {"state", one.state}, {"since", one.since}});
    }
    return list;
}

json shown_parts(const std::vector<EvidenceVerdict::Part>& parts) {
    json list = json::array();
    for (const EvidenceVerdict::Part& part : parts) {
        list.push_back({{"name", part.name}, {"sha256", part.sha256}, {"holds", part.holds}});
    }
    return list;
}

}  // namespace

ArchiveFile archive_file_of(std::string_view text) {
    const json value = json::parse(text, nullptr, false);
    const json schema = value.is_object() ? value.value("schema", json()) : json();
    return schema == "gumcert/archive-head/1"       ? ArchiveFile::head
           : schema == "gumcert/archive-evidence/1" ? ArchiveFile::evidence
                                                    : ArchiveFile::other;
}

std::string file_name_of_number(std::string number) {
    std::replace_if(
        number.begin(), number.end(), [](char c) { return c == '/' || c == '\\' || c == ':' || c == ' '; }, '_');
    return number;
}

std::string certificate_of_evidence(std::string_view text) {
    const json value = json::parse(text, nullptr, false);
    return value.is_object() && value.value("schema", json()) == "gumcert/archive-evidence/1"
               ? gumcert::json::text_of(value, "certificate")
               : std::string();
}

std::string time_to_come(const std::string& what, const std::string& at, const std::string& latest) {
    return at > latest ? what + " is of " + text::one_line(at) + ", which has not come by the clock of this machine"
                       : std::string();
}

std::vector<std::string> TrustedHeads::times_to_come() const {
    std::vector<std::string> lines;
    for (const Head& head : heads_) {
        add_line(lines, time_to_come("a given head", time_of(head), latest_));
    }
    return lines;
}

TrustedHeads::TrustedHeads(const std::vector<std::string>& files, const std::string& trust, std::string latest)
    : key_(trust.empty() ? "" : signing::ed25519_public_key(trust)), latest_(std::move(latest)) {
    for (const std::string& file : files) {
        const Head& head = heads_.emplace_back(head_from_json(evaluation::read_file(file), file));
        if (auto fault = fault_of_signature(head.signature, signed_bytes(head), key_, file, "head")) {
            findings_.push_back(std::move(*fault));
        }
    }
    known_ = heads_;
}

void TrustedHeads::know(const std::string& text, const std::string& file) {
    try {
        known_.push_back(head_from_json(text, file));
    } catch (const gum::InputError&) {  // said where the file is verified
    }
}

std::vector<gum::Diagnostic> findings_of(const std::vector<DocumentInHand>& documents) {
    std::vector<gum::Diagnostic> findings;
    for (const DocumentInHand& document : documents) {
        if (!document.is_told) {
            findings.push_back({.code = "GC-ARCHIVE-0057",
                                .where = document.file,
                                .what = document.earlier_of.empty()
                                            ? "the evidence before it does not name its SHA-256 " + document.sha256
                                            : "is of an earlier draft of " + text::one_line(document.earlier_of),
                                .rule = "a document of a certificate is one that its last draft names",
                                .action = "ask the laboratory for the certificate that it issued"});
        }
    }
    return findings;
}

VerifiedFile verified_evidence(const std::string& text, const std::string& file, const TrustedHeads& heads,
                               std::vector<DocumentInHand>& documents) {
    const Evidence evidence = evidence_from_json(text, file);
    const Head& head = evidence.head;
    EvidenceVerdict verdict = verify_evidence(evidence, heads.all(), heads.known());
    VerifiedFile said{.findings = std::move(verdict.findings), .text = {}, .json = {}};
    if (auto fault = fault_of_signature(head.signature, signed_bytes(head), heads.key(), file + "#/head", "head")) {
        said.findings.push_back(std::move(*fault));
    }
    if (evidence.states) {
        if (auto fault = fault_of_signature(evidence.states->signature,
                                            signed_bytes(*evidence.states, head, evidence.certificate), heads.key(),
                                            file + "#/states", "statement of states")) {
            said.findings.push_back(std::move(*fault));
        }
    }
    said.findings.insert(said.findings.end(), heads.findings().begin(), heads.findings().end());
    const std::vector<std::string> parts = tell_documents(evidence.certificate, verdict.parts, documents);
    const bool is_trusted = heads.has_key() && said.sound();
    const bool is_proved = is_trusted && evidence.states;
    const auto newest = std::max_element(heads.all().begin(), heads.all().end(),
                                         [](const auto& a, const auto& b) { return a.size < b.size; });
    std::vector<std::string> to_come;
    add_line(to_come, time_to_come("the head", time_of(head), heads.latest()));
    if (evidence.states) {
        add_line(to_come, time_to_come("the statement of states", evidence.states->at, heads.latest()));
    }
    for (std::string& line : heads.times_to_come()) {
        to_come.push_back(std::move(line));
    }
    const bool is_outdated = newest != heads.all().end() && newest->size > head.size;
    said.json = {{"schema", k_schema_of_verification},
                 {"sound", said.sound()},
                 {"certificate", evidence.certificate},
                 {"state", verdict.chain.empty() ? "" : verdict.chain.front().state},
                 {"state_is_proved", is_proved},
                 {"amended_by", verdict.chain.size() > 1 ? verdict.chain[1].number : ""},
                 {"chain", shown_chain(verdict.chain)},
                 {"signed_by", hexadecimal_key(head.signature)},
                 {"trusted", is_trusted},
                 {"newer_head", is_outdated ? json{{"size", newest->size}, {"at", newest->at}} : json()},
                 {"documents", shown_parts(verdict.parts)},
                 {"entries", evidence.entries.size()},
                 {"contents", evidence.contents.size()},
                 {"times_to_come", to_come},
                 {"findings", as_json(said.findings)}};
    const std::string when =
        ", as the archive stood at " + time_in_words(head) + " (" + text::count_of(head.size, "entry") + ")";
    std::vector<std::string> lines = {"certificate " + text::one_line(evidence.certificate) +
                                          (is_proved      ? ", "
                                           : said.sound() ? ": these entries show it "
                                                          : ": these entries, which cannot be relied on, show it ") +
                                          state_in_words(verdict.chain) + when +
                                          (is_proved ? "" : "; that no other entry followed is not proved"),
                                      signer_in_words(head.signature, heads.key(), evidence.states.has_value())};
    if (!evidence.states) {
        lines.emplace_back("no statement of states: gumcert archive export --sign makes one");
    }
    lines.insert(lines.end(), parts.begin(), parts.end());
    if (is_outdated) {
        lines.push_back("a newer head is given, of " + text::count_of(newest->size, "entry") + ", " + newest->at +
                        ": what came since is not in this evidence");
    }
    lines.insert(lines.end(), to_come.begin(), to_come.end());
    said.text = text::one_line(file) + ": " + (said.sound() ? "sound" : "NOT SOUND") + "\n";
    for (const std::string& line : lines) {
        said.text += "  " + line + "\n";
    }
    return said;
}

VerifiedFile verified_head(const std::string& text, const std::string& file, const TrustedHeads& heads) {
    const Head head = head_from_json(text, file);
    VerifiedFile said{.findings = heads.findings(), .text = {}, .json = {}};
    if (auto fault = fault_of_signature(head.signature, signed_bytes(head), heads.key(), file, "head")) {
        said.findings.push_back(std::move(*fault));
    }
    const auto add = [&](std::string what, const char* since = "the earlier head") {
        said.findings.push_back(
            {.code = "GC-ARCHIVE-0051",
             .where = file,
             .what = std::move(what),
             .rule = "a later head proves that the log begins with what an earlier one says",
             .action = std::string("ask for a head that is made with gumcert archive head --since and ") + since});
    };
    if (head.extends && !proves_its_extension(head)) {
        add("its proof does not lead to its root");
    }
    const Head* newest = nullptr;
    for (const Head& other : heads.all()) {
        const std::string named = "the head of " + text::count_of(other.size, "entry") + ", " + other.at;
        if (other.size > head.size) {
            newest = newest == nullptr || other.size > newest->size ? &other : newest;
            if (!leads_to(other, head, heads.known())) {
                add(named + ", does not prove that it extends it", "this one");
            }
        } else if (!leads_to(head, other, heads.known())) {
            add("does not prove that it extends " + named);
        }
    }
    std::vector<std::string> to_come;
    add_line(to_come, time_to_come("the head", time_of(head), heads.latest()));
    for (std::string& line : heads.times_to_come()) {
        to_come.push_back(std::move(line));
    }
    said.json = {{"schema", k_schema_of_verification},
                 {"sound", said.sound()},
                 {"entries", head.size},
                 {"times_to_come", to_come},
                 {"extends", head.extends ? json(head.extends->size) : json()},
                 {"heads", heads.all().size()},
                 {"newer_head", newest != nullptr ? json{{"size", newest->size}, {"at", newest->at}} : json()},
                 {"signed_by", hexadecimal_key(head.signature)},
                 {"trusted", heads.has_key() && said.sound()},
                 {"findings", as_json(said.findings)}};
    said.text = text::one_line(file) + ": " + (said.sound() ? "sound" : "NOT SOUND") + "\n  " +
                text::count_of(head.size, "entry") + ", " + time_in_words(head) +
                (head.extends ? "; extends a head of " + text::count_of(head.extends->size, "entry")
                              : "; extends no earlier head") +
                "\n  " + signer_in_words(head.signature, heads.key(), false) + "\n";
    if (newest != nullptr) {
        said.text += "  a newer head is given, of " + text::count_of(newest->size, "entry") + ", " + newest->at + "\n";
    }
    for (const std::string& line : to_come) {
        said.text += "  " + line + "\n";
    }
    return said;
}

VerifiedFile verified_store(Store& store, const TrustedHeads& heads,
                            const std::function<void(const std::string&)>& progress) {
    Verification verification = verify_store(store, heads.all(), progress);
    VerifiedFile said{.findings = std::move(verification.findings), .text = {}, .json = {}};
    said.findings.insert(said.findings.end(), heads.findings().begin(), heads.findings().end());
    std::vector<std::string> to_come;
    json head;
    if (verification.head) {
        add_line(to_come, time_to_come("the last entry", verification.head->at, heads.latest()));
        head = json::parse(to_json(*verification.head));
    }
    for (std::string& line : heads.times_to_come()) {
        to_come.push_back(std::move(line));
    }
    said.json = {{"schema", k_schema_of_verification},
                 {"sound", said.sound()},
                 {"entries", verification.entries},
                 {"contents", verification.contents},
                 {"certificates", verification.certificates},
                 {"heads", heads.all().size()},
                 {"trusted", heads.has_key() && !heads.all().empty() && heads.findings().empty()},
                 {"head", head},
                 {"clocks_set_back", to_json(verification.set_back)},
                 {"times_to_come", to_come},
                 {"findings", as_json(said.findings)}};
    said.text = text::one_line(store.name()) + ": " + (said.sound() ? "sound" : "NOT SOUND") + "; " +
                text::count_of(static_cast<std::int64_t>(verification.entries), "entry") + ", " +
                text::count_of(static_cast<std::int64_t>(verification.contents), "content") + ", " +
                text::count_of(static_cast<std::int64_t>(verification.certificates), "certificate") + ", " +
                text::count_of(static_cast<std::int64_t>(heads.all().size()), "earlier head") + "\n";
    if (verification.head) {
        said.text += "  head " + encoding::hexadecimal(verification.head->root) + " of " +
                     text::one_line(verification.head->at) + "\n";
    }
    if (const std::string set_back = in_words(verification.set_back); !set_back.empty()) {
        said.text += "  " + set_back + "\n";
    }
    if (heads.all().empty()) {
        said.text +=
            "  Without --head nobody can see whether the end of the log was cut off, or all of it rewritten.\n";
    }
    for (const std::string& line : to_come) {
        said.text += "  " + line + "\n";
    }
    if (heads.has_key() && heads.all().empty()) {
        said.text += "  --trust says nothing here: an archive is not signed, heads are, and none is given.\n";
    }
    return said;
}

}  // namespace gumcert::archive
