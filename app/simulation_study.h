#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/evaluate_job.h"
#include "engine/campaign_simulation.h"
#include "engine/job/rotary_table_job.h"
#include "gum/quantity/diagnostic.h"
#include "gum/random_draws.h"
#include "gum/worker_threads.h"

namespace gumcert::app {

/// Draws truth and noise of the campaigns of one layout. Run `r` is the same whoever asks for it, and when.
///
/// Truth: error motions uniform within ± their amplitudes, independent at every angle and zero at home; the set-up as
/// requested; stations within ±10 mm of their start values; dead paths 0.15 m … 0.25 m. With noise also: fixture,
/// scales, temperatures and expansion by their stated uncertainties about their stated values; the table of every
/// visit by its repeatability; length noise, resolution and outliers.
class CampaignDraws {
public:
    /// \param layout    with lengths and a position of every station, as its start value
    /// \param table     repeatability of the simulated table
    /// \param stream    number of the study: different numbers give independent campaigns
    CampaignDraws(const engine::RotaryTableMeasurement& layout, const engine::SimulationRequest& request,
                  const engine::TableRepeatability& table, std::uint64_t seed, std::uint64_t stream);

    struct Campaign {
        engine::RotaryTableMeasurement measurement;
        engine::CampaignTruth truth;
        std::vector<std::size_t> planted;  ///< indices of lengths with an outlier, ascending
    };
    /// The truth without what noise adds to it.
    [[nodiscard]] engine::CampaignTruth exact_truth(std::uint64_t run) const;
    [[nodiscard]] Campaign campaign(std::uint64_t run, bool with_noise) const;

private:
    [[nodiscard]] Eigen::VectorXd draw(std::size_t group, std::uint64_t run) const;

    engine::RotaryTableMeasurement layout_;
    engine::SimulationRequest request_;
    engine::TableRepeatability table_;
    std::vector<gum::InputDraws> draws_;  ///< one a group, so that a group can be drawn alone
    std::size_t visits_ = 0;
};

/// Differences between calculated and assumed values of one kind of quantity, over runs, components and angles.
struct DifferenceTally {
    std::size_t count = 0;
    double sum_absolute = 0.0, sum_squares = 0.0, maximum = 0.0;
    double sum_datum_squares = 0.0;        ///< of the assumed value carried to the datum, minus the assumed value
    double sum_measurement_squares = 0.0;  ///< of the calculated value minus the assumed value carried to the datum
    double sum_stated_squares = 0.0;       ///< of stated standard uncertainties
    std::size_t judged = 0;                ///< values with an uncertainty
    double sum_normalised_squares = 0.0;
    std::size_t covered = 0;  ///< within the expanded uncertainty
    std::size_t runs = 0;
    double sum_coverage = 0.0, sum_coverage_squares = 0.0;  ///< of the share covered in each run

    void add(const DifferenceTally& other);
    [[nodiscard]] double mean_absolute() const;
    [[nodiscard]] double rms() const;
    [[nodiscard]] double datum_rms() const;
    [[nodiscard]] double measurement_rms() const;
    [[nodiscard]] double stated_rms() const;
    [[nodiscard]] double normalised_rms() const;
    [[nodiscard]] double coverage() const;
    /// Standard error of the coverage from its scatter between runs; 0 with fewer than two. Errors within one campaign
    /// are correlated, so that the number of values says too little.
    [[nodiscard]] double coverage_standard_error() const;
};

/// The six error motions, then both offsets and both tilts of the set-up, then sums of kinds.
constexpr std::size_t k_linear_tally = 10, k_angular_tally = 11, k_offset_tally = 12, k_tilt_tally = 13,
                      k_reversal_tally = 14, k_all_tally = 15, k_tallies = 16;
using Tallies = std::array<DifferenceTally, k_tallies>;

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
    std::array<std::optional<gum::Diagnostic>, 2> failure;
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
    /// The assumed values carried to both datums exactly (axis average line, home): what a measurement without any
    /// error would calculate.
    std::array<Tallies, 2> datum_only;
    bool evaluated = false;  ///< else the layout is too large for a study
    CampaignResults exact, noisy;
};

/// Layouts with more angles are compared by their datum alone.
constexpr std::size_t k_most_evaluated_angles = 120;

/// \param layout  with lengths and station positions; its options are those of the evaluations
[[nodiscard]] AngleStudy study_layout(const engine::RotaryTableMeasurement& layout,
                                      const engine::SimulationRequest& request, const engine::TableRepeatability& table,
                                      double coverage_probability, std::uint64_t stream, gum::WorkerThreads& workers,
                                      const Progress& progress = {});

}  // namespace gumcert::app
