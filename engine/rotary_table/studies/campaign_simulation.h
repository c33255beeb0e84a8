#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

/// What is true in a simulated campaign, coherent SI. Frames are those of the contract, section 4.
struct CampaignTruth {
    Eigen::MatrixXd errors;                                                      ///< 6×angles, [m] and [rad]
    Eigen::Matrix<double, 6, 1> set_up = Eigen::Matrix<double, 6, 1>::Zero();    ///< O and S of T_s, [m] and [rad]
    Eigen::Matrix<double, 6, 1> reversal = Eigen::Matrix<double, 6, 1>::Zero();  ///< E(+) - E(-), [m] and [rad]
    std::vector<Eigen::Vector3d> stations;                                       ///< in T, [m]
    Eigen::VectorXd scale_deviation;                                             ///< s - 1, per station, [1]
    Eigen::VectorXd dead_paths;                                                  ///< l0, [m]
    Eigen::MatrixX3d fixture;                                                    ///< at the reference temperature, [m]
    Eigen::VectorXd temperature_difference;                                      ///< per station, [K]
    double expansion = 0.0;                                                      ///< [1/K]
};

/// An error that is added to one length on purpose.
struct PlantedOutlier {
    std::size_t length = 0;  ///< index into RotaryTableMeasurement::lengths
    double error = 0.0;      ///< [m]
};

/// What differs from visit to visit and from length to length. Whoever simulates draws it; nothing here is random.
struct CampaignNoise {
    /// 6×visits: deviation of the table from its mean pose at each visit, about `repeatability_point`, in the order of
    /// `visits_of` with all lengths active, [m] and [rad]; empty: none.
    Eigen::MatrixXd table;
    Eigen::VectorXd lengths;  ///< per length, [m]; empty: none
    std::vector<PlantedOutlier> outliers;
};

/// The layout with the lengths that would be measured: l = s |P - q| - l0 with P by the exact kinematics.
///
/// Everything else stays as the layout states it: what is known of fixture, temperature and expansion is the
/// statement, the truth differs from it.
/// Accuracy: lengths within 4e-15 m of an independent kinematics (campaign_simulation_test).
/// Example: examples/api/simulated_campaign.cpp
[[nodiscard]] RotaryTableMeasurement simulate_campaign(const RotaryTableMeasurement& layout, const CampaignTruth& truth,
                                                       const CampaignNoise& noise);

/// The lengths of a layout without their noise, [m]; of use where the noise depends on the distance.
[[nodiscard]] Eigen::VectorXd true_distances(const RotaryTableMeasurement& layout, const CampaignTruth& truth);

/// The truth as a campaign can know it: carried to a datum exactly, in the order of `reported_quantities`.
///
/// Distances do not tell the assumed error motions from others that differ by a motion of the world and by the set-up
/// of the fixture (datum.h). Only the truth carried to the datum of a result can be compared with the result.
[[nodiscard]] Eigen::VectorXd truth_in_datum(const RotaryTableMeasurement& layout, const CampaignTruth& truth,
                                             Datum datum, bool has_reversal);

/// Reported quantities with their covariance in one datum.
struct DatumView {
    Eigen::VectorXd values;      ///< in the order of `reported_quantities`
    Eigen::MatrixXd covariance;  ///< of the values
};

/// A result carried to another datum with its covariance.
///
/// \param values      in the order of `reported_quantities`, with or without a reversal
/// \param covariance  of the values
[[nodiscard]] DatumView seen_in_datum(const RotaryTableMeasurement& measurement, const Eigen::VectorXd& values,
                                      const Eigen::MatrixXd& covariance, Datum datum);

}  // namespace gumcert::engine
