#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/job/file_source.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

struct Evaluation {
    reports::EvaluationRecord record;
    std::string covariance_csv;  ///< contents of the file that the record names; empty: there is none
    bool negative = false;       ///< evaluated, and the answer is no: not validated where validation was demanded
    bool blocked = false;        ///< critical findings block the issue of the certificate
};

/// The files that a record names as read, as paths beside the job.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const std::filesystem::path& job_file,
                                                             const reports::EvaluationRecord& record);

/// Refuses a job of another kind than `comparison`; what is wrong with its text is left for the reader to tell.
/// \throws gum::InputError  GC-COMPARE-0140
void require_comparison_job(const std::filesystem::path& job_file);

/// Called now and then with a sentence on what is being done.
using Progress = std::function<void(const std::string&)>;

/// Reads a job with all its files, evaluates it and makes its record. Writes nothing.
///
/// \param covariance_file  name that the covariance file will have beside the record; "" when none will be written
/// \param threads          of Monte Carlo; 0: as many as the machine has. Results do not depend on it
/// \param templates        folder with profiles/<id>.json, for certificate data that name a profile by its id
/// \throws gum::InputError  GC-CERT-0300 for a profile that is not in the folder, and those of the readers
/// \throws gum::NoResultError, gum::StorageError
[[nodiscard]] Evaluation evaluate_job(const std::filesystem::path& job_file, const std::string& covariance_file,
                                      unsigned threads, const std::filesystem::path& templates,
                                      const Progress& progress = {});
/// The same of a job in any source of files, under its name there. Every file is read once, so that the digests in the
/// record are those of the bytes that were evaluated.
[[nodiscard]] Evaluation evaluate_job(const engine::FileSource& source, const std::string& job_file,
                                      const std::string& covariance_file, unsigned threads,
                                      const std::filesystem::path& templates, const Progress& progress = {});

}  // namespace gumcert::app
