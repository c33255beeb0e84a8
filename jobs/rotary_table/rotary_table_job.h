#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificate/certificate_data.h"
#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/coverage_choice.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"
#include "gum/rotary_table/rotary_table_request.h"
#include "gum/rotary_table/studies/plan_request.h"
#include "gum/rotary_table/studies/simulation_request.h"
#include "jobs/file_source.h"
#include "jobs/job_kind.h"
#include "jobs/rotary_table/rotary_table_exclusion.h"

namespace gumcert::jobs {

struct BudgetJob;

/// The air about one station, as the environment file states it; for documents, the adjustment does not use it.
struct StationAir {
    std::optional<double> temperature_degC;
    std::optional<double> pressure_hPa;
    std::optional<double> humidity_percent;
};

/// What is done with a job: only an evaluation needs measured lengths.
enum class JobUse { evaluate, simulate, plan };

/// A job of kind `rotary_table`: the request, and the job as it was read.
///
/// Monte Carlo is in the request also where `coverage` asks for its result and nothing else is said of it. The fixture
/// covariance is zero where a budget gives it, until that is evaluated.
struct RotaryTableJob : gum::RotaryTableRequest {
    certificate::LocalisedText title;  ///< empty when the job has none
    gum::CoverageChoice coverage = gum::CoverageChoice::as_validated;
    /// `fixture_budget` of the request, with what a job of kind `budget` has beside it.
    std::shared_ptr<const BudgetJob> fixture_budget_job;
    /// Budget of the reference value, kind `budget`, with one output, a length, and the mean reading at one point as
    /// the value of its input `reading`. Its points are those of reference_points(), in that order; the application
    /// evaluates it.
    std::shared_ptr<const BudgetJob> reference_budget;
    std::string reference_budget_file;
    /// The fixture covariance is that of the source paper, eqs. (10) to (12), on purpose.
    bool source_paper_fixture = false;
    std::optional<gum::SimulationRequest> simulation;
    std::optional<gum::PlanRequest> plan;
    std::vector<Exclusion> exclusions;         ///< what the laboratory left out; not in `measurement`
    bool has_lengths = true;                   ///< false: a layout for `plan` or `simulate` without measured lengths
    std::vector<StationAir> air;               ///< per station; empty without an environment file
    double reference_temperature_degC = 20.0;  ///< of the fixture coordinates
    nlohmann::json document;                   ///< the job file as read
    std::optional<certificate::CertificateData> certificate;  ///< from the job or a file of its own
    /// Names as the job gives them, each once: the job file, lengths, stations, environment, fixture coordinates,
    /// fixture covariance, points of the machine frame, readings and description of the reference method, budget of the
    /// reference with its files, certificate, fixture budget with its files.
    std::vector<std::string> files;
    std::vector<gum::Diagnostic> warnings;
};

/// The keys of a job of kind `rotary_table`, object by object. schemas/job-1.schema.json states the same ones.
[[nodiscard]] std::span<const JobKeys> rotary_table_job_keys();

/// Reads a job of kind `rotary_table` with all its files, checks it completely and converts it to SI.
///
/// Stations, passes and dead paths come in the order in which the lengths file first names them, reflectors in the
/// order of the fixture file, angles ascending (angles that agree within 1e-9° are one).
///
/// Without lengths, which only `plan` and `simulate` allow, the stations are those of the stations file and the angles
/// those of `plan`; lengths, passes and dead paths stay empty.
/// \throws InputError    with every problem of every file, those of the job file first
/// \throws StorageError  if a file cannot be read; with the problems of the other files after it
[[nodiscard]] RotaryTableJob read_rotary_table_job(const std::filesystem::path& job_file,
                                                   JobUse use = JobUse::evaluate);

/// The same from any source.
/// \param job_file  the name of the job in the source
[[nodiscard]] RotaryTableJob read_rotary_table_job(const FileSource& source, const std::string& job_file,
                                                   JobUse use = JobUse::evaluate);

}  // namespace gumcert::jobs
