#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "evaluation/evaluation_task.h"
#include "evaluation/kinds.h"
#include "gum/quantity/progress.h"
#include "jobs/file_source.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::evaluation {

/// The files that a record names as read, as paths beside the job.
/// \param laboratory  the folder that evaluate_job() was given
[[nodiscard]] std::vector<std::filesystem::path> input_files(const std::filesystem::path& job_file,
                                                             const reports::EvaluationRecord& record,
                                                             const std::filesystem::path& laboratory = {});

/// Refuses a job of another kind than `comparison`; what is wrong with its text is left for the reader to report.
/// \throws gum::InputError  GC-COMPARE-0140
void require_comparison_job(const std::filesystem::path& job_file);

/// Reads a job with all its files, evaluates it and makes its record. Writes nothing.
///
/// \param threads    of Monte Carlo; 0: as many as the machine has. Results do not depend on it
/// \param templates  folder with profiles/<id>.json, for certificate data that name a profile by its id
/// \param kinds      that a job may be of
/// \param laboratory folder with the data of the laboratory, before the one that the job names; "": none
/// \param before     is called when the job was read, before it is evaluated; what it throws ends the evaluation
/// \throws gum::InputError  GC-CERT-0300 for a profile that is not in the folder, and those of the readers
/// \throws gum::NoResultError, gum::StorageError
[[nodiscard]] Evaluation evaluate_job(const std::filesystem::path& job_file, const CovarianceOutput& covariance,
                                      unsigned threads, const std::filesystem::path& templates,
                                      const gum::Progress& progress = {}, std::span<const Kind> kinds = program_kinds(),
                                      const std::filesystem::path& laboratory = {},
                                      const BeforeEvaluation& before = {});
/// The same of a job in any source of files, under its name there. Every file is read once, so that the digests in the
/// record are those of the bytes that were evaluated.
[[nodiscard]] Evaluation evaluate_job(const jobs::FileSource& source, const std::string& job_file,
                                      const CovarianceOutput& covariance, unsigned threads,
                                      const std::filesystem::path& templates, const gum::Progress& progress = {},
                                      std::span<const Kind> kinds = program_kinds(),
                                      const BeforeEvaluation& before = {});

}  // namespace gumcert::evaluation
