#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/monte_carlo/worker_threads.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"
#include "gum/rotary_table/studies/difference_tally.h"
#include "gum/rotary_table/studies/simulation_request.h"

namespace gumcert::gum {

/// A method with the datum in which its result is seen.
struct Estimator {
    engine::AdjustmentMethod method;
    engine::Datum datum;
};
constexpr std::array<Estimator, 4> k_estimators{
    {{engine::AdjustmentMethod::joint, engine::Datum::axis_average_line},
     {engine::AdjustmentMethod::joint, engine::Datum::home},
     {engine::AdjustmentMethod::sequential, engine::Datum::axis_average_line},
     {engine::AdjustmentMethod::sequential, engine::Datum::home}}};

/// Evaluated campaigns of one layout, all with or all without noise.
struct CampaignResults {
    std::array<Tallies, k_estimators.size()> tallies;
    std::array<std::size_t, 2> evaluated{};  ///< campaigns with a result, by method: joint, sequential
    /// Why the first campaign without a result has none, by method.
    std::array<std::optional<Diagnostic>, 2> failure;
    double sum_chi_square = 0.0, sum_degrees_of_freedom = 0.0;               ///< of the joint adjustments
    std::size_t planted = 0, planted_found = 0, good = 0, good_flagged = 0;  ///< distances
    std::vector<std::size_t> histogram;  ///< normalised errors of the joint error motions, k_histogram_cells
};
constexpr int k_histogram_cells = 36;  ///< of a quarter, from -4.5 to 4.5
constexpr double k_histogram_first = -4.5;
constexpr double k_histogram_width = 0.25;

/// What a study of one number of angles found.
struct AngleStudy {
    std::size_t angles = 0;
    std::size_t lengths = 0;  ///< a campaign
    /// The assumed values of all campaigns carried to both datums exactly (axis average line, home): what a measurement
    /// without any error would calculate.
    std::array<Tallies, 2> datum_only;
    std::size_t adjusted = 0;  ///< campaigns that were adjusted jointly, the first ones
    bool sequential = false;   ///< the same campaigns were evaluated by the sequential method
    CampaignResults exact, noisy;
};

/// The sequential method propagates every input through its stages, which is costly: more angles leave it out.
constexpr std::size_t k_most_sequential_angles = 120;
/// More angles are compared by their datum alone.
constexpr std::size_t k_most_adjusted_angles = 720;

/// How many of the campaigns of a study are adjusted: all of them up to k_most_sequential_angles, above it as many as
/// take the time of all of them with 36 angles, but ten at least; none above k_most_adjusted_angles.
[[nodiscard]] std::size_t adjusted_campaigns(std::size_t angles, std::size_t runs);

/// \param layout  with lengths and station positions; its options are those of the evaluations
[[nodiscard]] AngleStudy study_layout(const engine::RotaryTableMeasurement& layout, const SimulationRequest& request,
                                      const engine::TableRepeatability& table, double coverage_probability,
                                      std::uint64_t stream, WorkerThreads& workers, const Progress& progress = {});

}  // namespace gumcert::gum
