#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "archive/archive.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"
#include "reports/record/evaluation_record.h"
#include "signing/signer.h"

namespace gumcert::archive {

/// How files are looked at before they come into an archive.
struct ArchiveChecks {
    unsigned threads = 0;  ///< as of evaluate_job()
    std::filesystem::path templates;
    std::optional<std::vector<signing::Bytes>> trusted;  ///< certificates, DER; none: nobody was named
    std::int64_t now = 0;                                ///< seconds since 1970-01-01 UTC
    gum::Progress progress;
    /// Does some work on files that others may have made, within walls of time and memory; empty: without any.
    std::function<void(const std::vector<std::filesystem::path>& files, const std::function<void()>& work)>
        within_walls = {};
    /// The same of the evaluation of the record, which may take longer: how long is said by its job, and that is of others too.
    std::function<void(const std::function<void()>& work)> evaluates_within = {};
};

/// A draft and what its record says of the certificate.
struct CheckedDraft {
    Draft draft;
    reports::EvaluationRecord record;
    std::vector<gum::Diagnostic> remarks;  ///< warnings and notes
};

/// The certificate data of a record. Of a comparison those that its report prints: number, laboratory, day of issue,
/// languages; nothing where it has none.
[[nodiscard]] certificate::CertificateData stated_identity(const reports::EvaluationRecord& record);

/// Reads a record and the documents that belong to it. What `gumcert check` finds wrong with the record, or `gumcert
/// check dcc` and `gumcert verify` with a document, is refused, and so is a document of another certificate.
/// \param documents  PDF, digital certificates (XML), HTML
/// \throws gum::StorageError  if a file cannot be read
/// \throws gum::InputError    GC-ARCHIVE-0028 for a record without a number, -0029 for a document that does not
///                            belong to it, and what the checks found
[[nodiscard]] CheckedDraft checked_draft(const std::filesystem::path& record,
                                         const std::vector<std::filesystem::path>& documents,
                                         const ArchiveChecks& checks);

/// Puts the machine-made list of changes into the draft of an amendment.
/// \param original  bytes of the archived record of the certificate that it names
/// \throws gum::InputError  GC-ARCHIVE-0035 where it was compared with another record than the archived one, nothing has
///                          changed, or one of the two is the report of a comparison and the other one is none
void state_amendment(CheckedDraft& amendment, const std::string& original);

/// Whether a certificate may be issued today.
/// \param record  its bytes, as archived
/// \param day     "2026-11-24"
/// \throws gum::InputError  GC-ARCHIVE-0030 for a specimen, a certificate that findings block, or one dated ahead
void require_issuable(const std::string& record, const std::string& number, const std::string& day);

/// Whether a record names the person who reviews or authorises it (ISO/IEC 17025:2017, 7.8.2.1): documents print who it was.
/// \param kind    of the entry: "reviewed", "authorised"
/// \param person  of the log
/// \throws gum::InputError  GC-ARCHIVE-0039 where it names another person
void require_named_person(const std::string& record, const std::string& number, const std::string& kind,
                          const std::string& person);

/// GC-ARCHIVE-0072 where a record prints an earlier day of authorisation or issue than that of the entry.
/// \param kind  of the entry: "authorised", "issued"; others have no day on the certificate
/// \param day   of the entry: "2026-11-24"
[[nodiscard]] std::vector<gum::Diagnostic> doubts_about_days(const std::string& record, const std::string& number,
                                                             const std::string& kind, const std::string& day);

/// Whether a text that is given as a reason says something: "-", "n/a" and "tbd" do not, nor do blanks.
[[nodiscard]] bool states_a_reason(const std::string& text);

}  // namespace gumcert::archive
