#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "archive/head.h"
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
};

/// \param certificate  number
/// \throws gum::InputError  GC-ARCHIVE-0026 where it is not in the archive
[[nodiscard]] Evidence evidence_of(Store& store, const std::string& certificate);

/// Canonical JSON, schema "gumcert/archive-evidence/1", with bytes in Base64.
[[nodiscard]] std::string to_json(const Evidence& evidence);
/// \param name  of the file, for messages
/// \throws gum::InputError  GC-ARCHIVE-0047 where it is no evidence, -0049 where its head is none
[[nodiscard]] Evidence evidence_from_json(std::string_view text, const std::string& name);

/// What a reader finds out without the archive.
struct EvidenceVerdict {
    std::string state;  ///< of the certificate by this evidence: "issued", "superseded" …
    std::string later;  ///< number of the certificate that amends or replaces it; "" else
    std::vector<gum::Diagnostic> findings;
};

/// Hashes of entries and contents, inclusion in the tree of the head, the life of the certificate, heads that its documents
/// print. GC-ARCHIVE-0040, -0043, -0044, -0048, -0053; against heads from elsewhere -0045.
/// \param heads  from elsewhere: one of the same size must be the same
[[nodiscard]] EvidenceVerdict verify_evidence(const Evidence& evidence, const std::vector<Head>& heads = {});

}  // namespace gumcert::archive
