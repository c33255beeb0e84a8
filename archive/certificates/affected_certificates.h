#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "archive/archive.h"
#include "archive/certificates/standard_references.h"
#include "certificate/certified_results.h"
#include "evaluation/rerun_record.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"
#include "outputs/output_files.h"
#include "reports/forms/read_wordings.h"

namespace gumcert::archive {

/// A standard that was found wrong, and since when.
struct WrongStandard {
    std::string name;   ///< identification in the register, or number of its certificate
    std::string since;  ///< first day of use that is affected, "2026-03-01"
    std::string until;  ///< last one; "" without
};

/// What a certificate becomes with the corrected standard.
struct Recalculation {
    evaluation::RerunRecord
        rerun;           ///< not_evaluated where nothing can be said, GC-ARCHIVE-0062; of the changes it lists those of
                         ///< printed digits and verdicts
    double shift = 0.0;  ///< largest change of a value or of its U, relative to the U that was issued
    /// Texts and numbers of the certificate data that change, such as certificate and U of the standard in a row of
    /// traceability; the first ones. Their kind is `other`.
    std::vector<evaluation::RecordChange> texts = {};
    /// All that an amendment would tell, as its list has it; the first ones.
    std::vector<certificate::Change> stated = {};
    /// Of a record of another version of the program: what an amendment would tell as well, and what this version states otherwise
    /// with the files of the record, too; the first ones. None of it is an effect of the correction, nor among `rerun`.
    std::vector<certificate::Change> of_version = {};
    std::string version_in_words = {};  ///< what a person should know of the other version; "" where there is nothing
    /// A value, uncertainty or verdict that the certificate or report states changes; digits of the budget of a certificate are
    /// none.
    bool results_change = false;
    /// Where the job states something of the standard itself, which is not corrected: "job.json#/inputs/d/source". Where nothing
    /// else changes either, nothing can be said.
    std::vector<std::string> not_corrected = {};
    bool takes_standard = true;  ///< its job reads the file of the register; where it does not, it is not evaluated
    std::string not_read = {};   ///< why its job was not read as a whole; "" where it was
    /// Where it does not take the standard: what it names as sources, each once, but what its files of the register are of.
    std::vector<std::string> sources = {};

    /// Whether the certificate would state anything else than it does, outside of its annexes: what an amendment tells.
    [[nodiscard]] bool states_otherwise() const { return !rerun.not_evaluated && (results_change || !texts.empty()); }
};

/// Another certificate that was found, and on which one rests.
struct FoundBefore {
    std::string number, state;
    bool is_same = false;  ///< after recalculate(): it comes out the same, and all on which it rests itself
};

/// A certificate that rests on it.
struct AffectedCertificate {
    ListedCertificate certificate;
    std::string used_from, used_to;          ///< days of the work; "" where the record states none
    std::vector<StandardReference> because;  ///< what its record says
    std::string through;        ///< number of the certificate that it rests on itself; "" where on the standard
    std::string through_state;  ///< of that certificate, which may be withdrawn
    std::vector<FoundBefore> rests_on = {};  ///< all of them; withdrawn ones, too
    std::string withdrawn_amendment;         ///< number of what took its place and was withdrawn; "" else
    std::string withdrawn_record;            ///< SHA-256 of the record of that; "" else
    std::string amendment_under_way;  ///< number of a draft that amends or replaces it and is not issued yet; "" else
    std::vector<std::string> taken_numbers;  ///< for amendments of it, under which nothing is drafted yet
    std::string draft_number;                ///< the next free number of an amendment of it
    std::string draft_name = {};  ///< of a folder for its draft, another one for each certificate that was found

    std::optional<Recalculation> recalculated = {};
    std::string draft_folder =
        {};                     ///< of the amendment, after recalculate(); "" where none is needed, or nobody writes it
    std::string no_draft = {};  ///< why there is none, where something changes and drafts are written; "" else
};

/// Every certificate of an archive whose record names the standard, with a day of use in the period or without any, and
/// every one that rests on a certificate that was found, from the first day on. What names() says of references_of() is
/// "rests on" (docs/archive.md). Certificates of all states but withdrawn ones; what rests on a withdrawn one, or on one whose
/// record cannot be read, is found through it.
/// \param remarks  none, or GC-ARCHIVE-0064, warnings: names in records that differ from the standard in their spelling alone,
///                 and that no record names it
[[nodiscard]] std::vector<AffectedCertificate> find_affected(Archive& archive, const WrongStandard& standard,
                                                             unsigned threads, const gum::Progress& progress = {},
                                                             std::vector<gum::Diagnostic>* remarks = nullptr);

/// How affected certificates are calculated again.
struct Correction {
    std::string standard;   ///< identification
    std::string corrected;  ///< bytes of its file in the register, with what holds
    std::string reason;     ///< of the amendments
    std::filesystem::path templates;
    /// Asked before each evaluation for its progress, which may end it: such a certificate is one of which nothing can be said.
    std::function<gum::Progress()> watch = {};
    std::shared_ptr<reports::ReadWordings> wordings =
        std::make_shared<reports::ReadWordings>();  ///< of all that is drafted
};

/// On which certificate one rests that may not be right itself: "EX-1, which is listed, too"; "" where on the standard alone, or
/// on such ones that come out the same.
[[nodiscard]] std::string waits_for(const AffectedCertificate& certificate);

/// Evaluates the job of an affected record with the corrected standard, and compares with what was issued. On which other
/// certificates it rests is no part of it: recalculate() looks at that when all are calculated.
/// \param original  bytes of the record
[[nodiscard]] Recalculation recalculation_of(const std::string& number, const std::string& original,
                                             const Correction& correction);

/// Where drafts of amendments go.
struct DraftSink {
    /// Gets the files of a draft, below a folder of its own. Several threads call it at the same time.
    std::function<void(const std::vector<outputs::OutputFile>&)> write = {};
    /// Makes what was written since the last time last.
    std::function<void()> finish = {};
};

/// Calculates all certificates again that are not yet, drafts an amendment of each one that is issued, or whose amendment was
/// withdrawn, and of which a printed digit, a verdict or a text changes, and ranks them; on several cores, with the same result for
/// any number of threads. One that rests on others of the list comes out the same where they do, its job was read, and one
/// that rests on them alone names no other source. None is drafted beside an amendment that is under way, nor one that would take back what a withdrawn
/// amendment had stated otherwise.
/// \param archive  in which they were found
void recalculate(std::vector<AffectedCertificate>& affected, Archive& archive, const Correction& correction,
                 unsigned threads, const DraftSink& drafts = {}, const gum::Progress& progress = {});

/// Ranks what was calculated again: verdicts that changed first, then printed digits, each by shift, then texts, then those of
/// which nothing can be said, before those that stay.
void rank(std::vector<AffectedCertificate>& affected);

/// For people, for programs (schema gumcert/archive-affected/1), as a table.
[[nodiscard]] std::string affected_text(const std::vector<AffectedCertificate>& affected);
[[nodiscard]] std::string affected_json(const std::vector<AffectedCertificate>& affected,
                                        const WrongStandard& standard);
[[nodiscard]] std::string affected_csv(const std::vector<AffectedCertificate>& affected);

}  // namespace gumcert::archive
