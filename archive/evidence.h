#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "archive/head.h"
#include "archive/state_statement.h"
#include "archive/store/entry.h"
#include "archive/store/store.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

/// One certificate taken out of an archive, with what proves that it stood there: whoever has the file needs nothing of
/// the archive.
struct Evidence {
    std::string certificate;
    Head head;  ///< of the archive when the certificate was taken out
    struct ProvenEntry {
        LogEntry entry;
        std::vector<std::string> proof;  ///< archive/store/merkle.h
    };
    std::vector<ProvenEntry> entries;  ///< the first one, every change of settings, those of the certificate, and those
                                       ///< of certificates that it amends or that amend it
    std::vector<Content> contents;     ///< records and documents that its entries name
    std::vector<Head::Extension> printed_heads = {};  ///< those that its documents print, with the proof that the head
                                                      ///< extends them
    std::optional<StateStatement> states = {};        ///< where the laboratory signed it
};

/// \param certificate  number
/// \param since        an earlier head: the head of the evidence proves that it extends it
/// \throws gum::InputError  GC-ARCHIVE-0026 where it is not in the archive; -0036 where that does not begin with what the
///                          earlier head says
[[nodiscard]] Evidence evidence_of(Store& store, const std::string& certificate,
                                   const std::optional<Head>& since = std::nullopt);
/// What the entries of an evidence say of its certificates, to be signed by whoever has just taken it out of the archive.
/// \param at  now, as entries have it
[[nodiscard]] StateStatement states_in(const Evidence& evidence, const std::string& at);

/// Canonical JSON, schema "gumcert/archive-evidence/1", with bytes in Base64.
[[nodiscard]] std::string to_json(const Evidence& evidence);
/// \param name  of the file, for messages
/// \throws gum::InputError  GC-ARCHIVE-0047 where it is no evidence, -0049 where its head is none
[[nodiscard]] Evidence evidence_from_json(std::string_view text, const std::string& name);

/// What a reader finds out without the archive. Without a statement of states that the laboratory signed, the state is the
/// one to which the entries at hand lead: a later entry may have been left out.
struct EvidenceVerdict {
    struct Certificate {
        std::string number;
        std::string state;  ///< "issued", "superseded" …
        std::string since;  ///< time of the entry that led there
    };
    /// The certificate, then the one that amends or replaces it, and so on to the end.
    std::vector<Certificate> chain;
    struct Part {
        std::string name;  ///< of the file of a document; "" of a record
        std::string sha256;
        bool holds = false;  ///< of the newest draft; the others were replaced before the issue
    };
    std::vector<Part> parts;  ///< records and documents of the certificate
    std::vector<gum::Diagnostic> findings;
};

/// Hashes of entries and contents, inclusion in the tree of the head, the life of the certificate, heads that its documents
/// print, the entries that a statement of states names (its signature is another matter). GC-ARCHIVE-0040, -0043, -0044,
/// -0048, -0053, -0056; against heads from elsewhere -0045 and -0051.
/// \param heads  from elsewhere: one of the same size must be the same; for every other one there must be proofs that the
///               larger log extends the smaller one, in the evidence or in the heads
/// \param known  others, through which proofs may lead
[[nodiscard]] EvidenceVerdict verify_evidence(const Evidence& evidence, const std::vector<Head>& heads = {},
                                              const std::vector<Head>& known = {});

}  // namespace gumcert::archive
