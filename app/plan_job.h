#pragma once

#include <filesystem>
#include <string>

#include "app/evaluate_job.h"
#include "gum/quantity/progress.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/forms/study_document.h"

namespace gumcert::app {

/// `gumcert plan`: what a layout of a rotary-table job will give, before anything is measured. Writes nothing.
///
/// Expected U of every quantity beside the targets of the job, their budget, what single stations, reflectors, angles
/// and uncertainties are worth, and, where the job gives a region, station positions that make the largest U smaller.
///
/// \param job      a job of kind `rotary_table` with `plan`; measured lengths are not needed, and not used but for
///                 which distances are measured
/// \param threads  0: as many as the machine has. Results do not depend on it
/// \throws gum::InputError, gum::NoResultError, gum::StorageError
[[nodiscard]] reports::StudyDocument plan_job(const std::filesystem::path& job, unsigned threads,
                                              const gum::Progress& progress = {});

/// The same for a job that is read already.
/// \param job_name  for the document
[[nodiscard]] reports::StudyDocument plan_job(const jobs::RotaryTableJob& job, const std::string& job_name,
                                              unsigned threads, const gum::Progress& progress = {});

}  // namespace gumcert::app
