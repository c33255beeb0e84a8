#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/studies/line_of_sight.h"
#include "engine/rotary_table/studies/measurement_plan.h"
#include "engine/rotary_table/studies/station_proposal.h"
#include "gum/monte_carlo/worker_threads.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"
#include "gum/rotary_table/document_units.h"
#include "gum/rotary_table/rotary_table_request.h"
#include "gum/rotary_table/studies/plan_parameters.h"
#include "gum/rotary_table/studies/plan_request.h"

/// What `gumcert plan` computes; its documents are made by reports/studies.
namespace gumcert::gum::plan {

/// What is planned, and with what it is compared.
struct Setting {
    std::string where;  ///< of the request, for messages
    double coverage_probability = 0.9545;
    engine::RotaryTableMeasurement layout;     ///< with predicted lengths, and without what no station sees
    engine::RotaryTableMeasurement whole;      ///< the same with all distances, as if nothing stood in the way
    std::optional<engine::LineOfSight> sight;  ///< none: nothing is known of what stands in the way
    PlanRequest request;
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

/// Completes the layout of a request: budget of the fixture, planned angles, positions of the stations, predicted lengths.
/// \param request  measured lengths tell which distances are measured, and where stations stand that have no position;
///                 without lengths, every station measures every reflector
/// \throws InputError, NoResultError
/// Example: examples/api/rotary_table.cpp
[[nodiscard]] Setting setting_of(RotaryTableRequest request, const PlanRequest& plan, const Progress& progress);

/// Says in the notes which components of the repeatability an evaluation of this layout will hardly determine, where it
/// estimates them: its U is then larger than that of the plan.
/// \param setting  of a layout that determines its parameters
void note_undetermined_repeatability(Setting& setting);

struct Expected {
    engine::ExpectedUncertainty uncertainty;
    std::array<Motion, 6> motions;
    double ratio = 0.0;  ///< largest U of an error motion in units of its target
    ExpectedParameters parameters;
};

/// What is wanted of a quantity, and whether a layout gives it.
struct Target {
    std::string name;
    bool met = false;
};
/// Of the six error motions, then of the parameters that have one.
[[nodiscard]] std::vector<Target> targets_of(const Setting& setting, const Expected& expected);

/// Distances that a station does not see.
struct SightCount {
    std::size_t distances = 0, by_obstacles = 0, by_reflectors = 0, not_accepted = 0;

    [[nodiscard]] std::size_t seen() const { return distances - by_obstacles - by_reflectors - not_accepted; }
};
/// One a station.
/// \param whole  with all distances, and positions of the stations
[[nodiscard]] std::vector<SightCount> sight_counts(const engine::RotaryTableMeasurement& whole,
                                                   const engine::LineOfSight& sight);

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
    std::optional<Diagnostic> why;                           ///< of not being determined
    double ratio = std::numeric_limits<double>::infinity();  ///< largest U in units of its target
};

/// The layout as planned, and with one thing changed at a time.
[[nodiscard]] std::vector<Variant> variants_of(const Setting& setting, WorkerThreads& workers);

struct Proposal {
    engine::StationCandidates candidates;
    engine::StationProposal stations;
    engine::RotaryTableMeasurement layout;  ///< without what no station sees
    engine::RotaryTableMeasurement whole;   ///< with all distances
    Expected expected;
    std::size_t angles_of_search = 0;
    std::vector<std::string> broken;  ///< targets that the planned layout meets and the proposed one misses
    std::size_t taken_back = 0;       ///< exchanges that would have broken one that is to be kept
};

/// Better positions of the stations in the region of the job; nothing without a region. Adds its notes to the setting.
/// \throws InputError  GC-PLAN-0002 when no position of the region is allowed
/// \param now  of the planned layout
[[nodiscard]] std::optional<Proposal> propose(Setting& setting, const Expected& now, WorkerThreads& workers,
                                              const Progress& progress);

}  // namespace gumcert::gum::plan
