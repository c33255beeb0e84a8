#pragma once

#include <string>

#include "evaluation/evaluate_job.h"
#include "gum/quantity/progress.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/forms/study_document.h"

namespace gumcert::evaluation {

/// `gumcert plan`: what a layout of a rotary-table job will give, before anything is measured. Writes nothing.
///
/// Expected U of every quantity beside the targets of the job, their budget, what single stations, reflectors, angles
/// and uncertainties are worth, and, where the job gives a region, station positions that make the largest U smaller.
///
/// \param job       read with JobUse::plan; measured lengths are not used but for which distances are measured
/// \param job_name  for the document
/// \param threads   0: as many as the machine has. Results do not depend on it
/// \throws gum::NoResultError
[[nodiscard]] reports::StudyDocument plan_job(const jobs::RotaryTableJob& job, const std::string& job_name,
                                              unsigned threads, const gum::Progress& progress = {});

}  // namespace gumcert::evaluation
