#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace gumcert::gum {

/// Differences between calculated and assumed values of one kind of quantity, over runs, components and angles.
struct DifferenceTally {
    std::size_t count = 0;
    double sum_absolute = 0.0, sum_squares = 0.0, maximum = 0.0;
    std::size_t campaigns = 0;
    double sum_largest = 0.0;              ///< of the largest difference of each campaign
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
    /// Mean over the campaigns of the largest difference of each.
    [[nodiscard]] double mean_largest() const;
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

void add(Tallies& sum, const Tallies& run);

/// Differences of one campaign, its values in the order of `engine::reported_quantities`.
///
/// \param value      as calculated
/// \param assumed    what the campaign was simulated with
/// \param in_datum   the assumed values carried to the datum of the calculated ones
/// \param u, k       stated standard uncertainties and their coverage factors; empty where none is looked at
/// \param errors     number of values that are error motions, 6 an angle
[[nodiscard]] Tallies tally_of_campaign(const Eigen::VectorXd& value, const Eigen::VectorXd& assumed,
                                        const Eigen::VectorXd& in_datum, const Eigen::VectorXd& u,
                                        const Eigen::VectorXd& k, Eigen::Index errors);

}  // namespace gumcert::gum
