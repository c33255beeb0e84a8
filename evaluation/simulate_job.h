#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "evaluation/evaluate_job.h"
#include "gum/quantity/progress.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/forms/study_document.h"

namespace gumcert::evaluation {

/// Simulation study of a job of kind `rotary_table` (docs/simulation.md): campaigns with known truth, evaluated as the
/// job asks, compared with the truth.
///
/// Every run draws from a stream of its own, so that results do not depend on threads.
/// \param job_name  for the document
/// \param runs     number of campaigns; nothing: as the job states it
/// \param seed     of all random numbers; nothing: as the job states it
/// \param threads  0: as many as the machine has
/// \throws gum::InputError, gum::NoResultError
[[nodiscard]] reports::StudyDocument simulate_job(const jobs::RotaryTableJob& job, const std::string& job_name,
                                                  std::optional<std::size_t> runs, std::optional<std::uint64_t> seed,
                                                  unsigned threads, const gum::Progress& progress = {});

}  // namespace gumcert::evaluation
