#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "app/evaluate_job.h"
#include "gum/quantity/progress.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/forms/study_document.h"

namespace gumcert::app {

/// Simulation study of a job of kind `rotary_table` (docs/simulation.md): campaigns with known truth, evaluated as the
/// job asks, compared with the truth.
///
/// Every run draws from a stream of its own, so that results do not depend on threads.
/// \param runs     number of campaigns; nothing: as the job states it
/// \param seed     of all random numbers; nothing: as the job states it
/// \param threads  0: as many as the machine has
/// \throws gum::InputError, gum::NoResultError, gum::StorageError
[[nodiscard]] reports::StudyDocument simulate_job(const std::filesystem::path& job, std::optional<std::size_t> runs,
                                                  std::optional<std::uint64_t> seed, unsigned threads,
                                                  const gum::Progress& progress = {});

/// The same for a job that is read already.
/// \param job_name  for the document
[[nodiscard]] reports::StudyDocument simulate_job(const jobs::RotaryTableJob& job, const std::string& job_name,
                                                  std::optional<std::size_t> runs, std::optional<std::uint64_t> seed,
                                                  unsigned threads, const gum::Progress& progress = {});

}  // namespace gumcert::app
