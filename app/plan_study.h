#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/document_units.h"
#include "app/evaluate_job.h"
#include "engine/job/rotary_table_job.h"
#include "engine/measurement_plan.h"
#include "engine/station_proposal.h"
#include "gum/quantity/diagnostic.h"
#include "gum/worker_threads.h"

/// What `gumcert plan` computes. Documents and data files are made from it by plan_document.h and plan_data.h.
namespace gumcert::app::plan {

/// What is planned, and with what it is compared.
struct Setting {
    engine::RotaryTableJob job;
    engine::RotaryTableMeasurement layout;  ///< with predicted lengths
    engine::PlanRequest request;
    engine::StochasticModel stochastic;
    double k = 0.0;                    ///< coverage factor
    std::array<double, 2> wanted{};    ///< standard uncertainties of the targets, linear and angular
    std::array<std::string, 6> names;  ///< of the error motions
    std::string distances_from;        ///< for the document
    std::vector<std::string> notes;
};

/// Expanded uncertainties of one error motion over the angles, [m] or [rad].
struct Motion {
    double rms = 0.0, largest = 0.0;
    std::size_t worst_angle = 0;
};

[[nodiscard]] const DocumentUnit& unit_of_motion(std::size_t motion);
/// Expanded uncertainty wanted, [m] or [rad].
[[nodiscard]] double target_of(const Setting& setting, std::size_t motion);

/// Reads the job and completes the layout: planned angles, positions of the stations, predicted lengths.
/// \throws gum::InputError, gum::NoResultError, gum::StorageError
[[nodiscard]] Setting setting_of(const std::filesystem::path& job_file, const Progress& progress);

struct Expected {
    engine::ExpectedUncertainty uncertainty;
    std::array<Motion, 6> motions;
    double ratio = 0.0;  ///< largest U in units of its target
};

[[nodiscard]] Expected expect(const Setting& setting, const engine::RotaryTableMeasurement& layout);

constexpr std::array<const char*, 6> k_sources{"length noise", "scale",           "dead path",
                                               "fixture CMM",  "fixture thermal", "table repeatability"};

/// What the largest U of each error motion is made of.
struct SourceShares {
    std::array<std::array<double, 6>, 6> of_motion{};  ///< by motion and source, [1]
};

[[nodiscard]] SourceShares source_shares(const Setting& setting, const std::array<Motion, 6>& motions);

/// One thing that is changed in the layout or in what the uncertainties rest on.
enum class Change {
    none,
    without_station,
    without_reflector,
    half_angles,
    twice_angles,
    half_noise,
    half_repeatability
};

struct Variant {
    Change change = Change::none;
    std::string label;
    std::string subject;                                     ///< station or reflector that is left out
    std::optional<std::array<Motion, 6>> motions;            ///< none: not determined
    std::optional<gum::Diagnostic> why;                      ///< of not being determined
    double ratio = std::numeric_limits<double>::infinity();  ///< largest U in units of its target
};

/// The layout as planned, and with one thing changed at a time.
[[nodiscard]] std::vector<Variant> variants_of(const Setting& setting, gum::WorkerThreads& workers);

struct Proposal {
    engine::StationCandidates candidates;
    engine::StationProposal stations;
    engine::RotaryTableMeasurement layout;
    Expected expected;
    std::size_t angles_of_search = 0;
};

/// Better positions of the stations in the region of the job; nothing without a region. Adds its notes to the setting.
/// \throws gum::InputError  GC-PLAN-0002 when no position of the region is allowed
[[nodiscard]] std::optional<Proposal> propose(Setting& setting, gum::WorkerThreads& workers, const Progress& progress);

}  // namespace gumcert::app::plan
