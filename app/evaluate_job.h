#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/covariance_file.h"
#include "engine/job/file_source.h"
#include "gum/quantity/progress.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// Where the covariance file of a record will stand, which decides its name. The name never depends on that of the
/// record: a job gives the same record wherever it is written.
enum class CovarianceFile {
    none,         ///< it will not be written
    own_folder,   ///< alone in its folder: covariance.csv, .npy or -parts.npy by its form
    with_others,  ///< beside those of other jobs: covariance-<digest of the files of the job>.csv …
};

/// The covariance file that is asked for.
struct CovarianceOutput {
    CovarianceFile file = CovarianceFile::none;
    CovarianceForm form = CovarianceForm::automatic;

    // NOLINTNEXTLINE(google-explicit-constructor): a place alone asks for the form that suits the size
    CovarianceOutput(CovarianceFile place, CovarianceForm as = CovarianceForm::automatic) : file(place), form(as) {}
};

struct Evaluation {
    reports::EvaluationRecord record;
    std::string covariance;       ///< contents of the file that the record names; empty: there is none
    std::string covariance_file;  ///< its name; empty where `covariance` is
    bool negative = false;        ///< evaluated, and the answer is no: not validated where validation was demanded
    bool blocked = false;         ///< critical findings block the issue of the certificate
};

/// The files that a record names as read, as paths beside the job.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const std::filesystem::path& job_file,
                                                             const reports::EvaluationRecord& record);

/// Refuses a job of another kind than `comparison`; what is wrong with its text is left for the reader to tell.
/// \throws gum::InputError  GC-COMPARE-0140
void require_comparison_job(const std::filesystem::path& job_file);

/// Reads a job with all its files as one of a kind, any other word than "budget", "comparison" and "circle_closure" as
/// one of a rotary table.
/// \return what the reader warns of
/// \throws gum::InputError  with all that the reader refuses
[[nodiscard]] std::vector<gum::Diagnostic> warnings_of_job(const std::string& kind, const engine::FileSource& source,
                                                           const std::string& job_file);

/// Reads a job with all its files, evaluates it and makes its record. Writes nothing.
///
/// \param threads    of Monte Carlo; 0: as many as the machine has. Results do not depend on it
/// \param templates  folder with profiles/<id>.json, for certificate data that name a profile by its id
/// \throws gum::InputError  GC-CERT-0300 for a profile that is not in the folder, and those of the readers
/// \throws gum::NoResultError, gum::StorageError
[[nodiscard]] Evaluation evaluate_job(const std::filesystem::path& job_file, const CovarianceOutput& covariance,
                                      unsigned threads, const std::filesystem::path& templates,
                                      const gum::Progress& progress = {});
/// The same of a job in any source of files, under its name there. Every file is read once, so that the digests in the
/// record are those of the bytes that were evaluated.
[[nodiscard]] Evaluation evaluate_job(const engine::FileSource& source, const std::string& job_file,
                                      const CovarianceOutput& covariance, unsigned threads,
                                      const std::filesystem::path& templates, const gum::Progress& progress = {});

}  // namespace gumcert::app
