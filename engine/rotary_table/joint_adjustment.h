#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/adjustment.h"
#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/rotation.h"

namespace gumcert::engine {

/// Start values of the adjustment, in T.
struct StartValues {
    std::vector<Eigen::Vector3d> stations;  ///< [m]
    Eigen::VectorXd dead_paths;             ///< [m]
    RigidMotion set_up = {};                ///< T_s that was found with them; the positions do not contain it
};

/// Variances of the observations: what the weights of the adjustment are made of.
struct StochasticModel {
    double length_factor = 1.0;    ///< factor on the stated variance of a length
    double variance_linear = 0.0;  ///< of each translation of one visit of the table, [m²]
    double variance_axial = 0.0;   ///< of the rotation about the axis, [rad²]
    double variance_tilt = 0.0;    ///< of each rotation across the axis, [rad²]
    double fixture_factor = 1.0;   ///< factor on the stated covariance of the fixture
};

/// Distances that share one visit of the table to an angle, hence its pose (same `pass` and `angle`).
struct Visit {
    std::size_t station = 0;
    std::size_t angle = 0;
    std::size_t pass = 0;
    Approach approach = Approach::positive;
    std::vector<std::size_t> observations;  ///< indices into RotaryTableMeasurement::lengths
};

/// Joint adjustment of one rotary-table measurement: stations, dead paths, fixture, temperatures, expansion, reversal
/// and the six error motions of every angle at once, with the exact kinematics
///
///   P = E(θ) R(θ) T_s p (1 + α ΔT),   l + l0 = s |P - q|      (contract, section 4)
///
/// The measurement must outlive the adjustment. E(home) and T_s are held here; they are the datum of the solver, and
/// `datum.h` carries the solution to the datum of the result. The two senses of approach share E; half their mean
/// difference is added and subtracted (reversal). The reversal is one of all angles, or where the measurement asks for
/// it (ReversalModel::by_angle) one of each angle, with its pose.
class JointAdjustment {
public:
    /// \param active  one flag a length: false = left out
    /// \param set_up  T_s, held
    JointAdjustment(const RotaryTableMeasurement& measurement, std::vector<bool> active, const RigidMotion& set_up,
                    const StartValues& start, const StochasticModel& stochastic);

    [[nodiscard]] Adjustment& adjustment() { return adjustment_; }
    [[nodiscard]] const Adjustment& adjustment() const { return adjustment_; }
    [[nodiscard]] const std::vector<Visit>& visits() const { return visits_; }
    [[nodiscard]] const RigidMotion& set_up() const { return set_up_; }
    [[nodiscard]] const std::vector<bool>& active() const { return active_; }
    [[nodiscard]] bool has_reversal() const { return has_reversal_; }
    /// Every angle has a reversal of its own: components 6 to 11 of its pose.
    [[nodiscard]] bool reversal_by_angle() const { return reversal_by_angle_; }
    /// Parameters of a pose: 6, or 12 with its reversal.
    [[nodiscard]] int pose_size() const { return reversal_by_angle_ ? 12 : 6; }
    [[nodiscard]] const RotaryTableMeasurement& measurement() const { return *measurement_; }

    // Parameter blocks. A station is x, y, z [m], scale deviation s - 1 [1], temperature difference [K].
    [[nodiscard]] Adjustment::BlockId station_block(std::size_t station) const { return station_blocks_[station]; }
    [[nodiscard]] Adjustment::BlockId dead_path_block(std::size_t path) const { return dead_path_blocks_[path]; }
    [[nodiscard]] Adjustment::BlockId pose_block(std::size_t angle) const { return pose_blocks_[angle]; }
    [[nodiscard]] Adjustment::BlockId fixture_block() const { return fixture_block_; }
    [[nodiscard]] Adjustment::BlockId expansion_block() const { return expansion_block_; }
    /// Of all angles; held at zero where every angle has its own.
    [[nodiscard]] Adjustment::BlockId reversal_block() const { return reversal_block_; }

    // Groups of observations: visits come first and have the same index; then the priors.
    static constexpr std::size_t k_none = static_cast<std::size_t>(-1);
    [[nodiscard]] std::size_t fixture_prior() const { return fixture_prior_; }
    [[nodiscard]] std::size_t expansion_prior() const { return expansion_prior_; }                       ///< or k_none
    [[nodiscard]] std::size_t scale_prior(std::size_t station) const { return scale_priors_[station]; }  ///< or k_none
    [[nodiscard]] std::size_t temperature_prior(std::size_t station) const { return temperature_priors_[station]; }

    /// Derivatives of the lengths of a visit with respect to the pose that the table had (x, y, z, a, b, c), n×6, [1]
    /// and [m/rad].
    [[nodiscard]] Eigen::MatrixXd pose_jacobian(std::size_t visit) const;
    /// The same with respect to what the table deviates by at a visit, n×6: translations of `repeatability_point` and
    /// rotations about it, in the order of a pose.
    [[nodiscard]] Eigen::MatrixXd repeatability_jacobian(std::size_t visit) const;
    /// Pose by the deviation of the table, 6×6 (`pose_by_deviation`).
    [[nodiscard]] const Eigen::Matrix<double, 6, 6>& pose_of_deviation() const { return pose_of_deviation_; }
    /// Stated variance of each length of a visit, n, [m²], without the factor.
    [[nodiscard]] Eigen::VectorXd stated_variance(std::size_t visit) const;
    /// Covariance of the lengths of a visit: length noise, resolution and the shared repeatability of the table, n×n,
    /// [m²].
    [[nodiscard]] Eigen::MatrixXd visit_covariance(std::size_t visit, const StochasticModel& stochastic) const;
    /// New weights of the lengths and of the fixture, from derivatives at the present parameters.
    void set_weights(const StochasticModel& stochastic);

    /// Six error motions at every angle with respect to the solver's datum, 6×angles, [m] and [rad].
    [[nodiscard]] Eigen::MatrixXd poses() const;
    /// Positive minus negative approach of the same at an angle; zero without a reversal.
    [[nodiscard]] Eigen::Matrix<double, 6, 1> reversal(std::size_t angle) const;
    /// Its mean over the angles.
    [[nodiscard]] Eigen::Matrix<double, 6, 1> mean_reversal() const;
    /// Other error motions of an angle; its reversal stays.
    void set_pose(std::size_t angle, const Eigen::Matrix<double, 6, 1>& motions);
    /// The error motions of a table without any that turns about the axis of another set-up than the one that is held: E R T_s p = T_s T⁻¹ R T p.
    /// \param set_up  T
    void turn_about(const RigidMotion& set_up);
    [[nodiscard]] StartValues present_values() const;
    void copy_parameters_from(const JointAdjustment& other);

private:
    const RotaryTableMeasurement* measurement_;
    std::vector<bool> active_;
    RigidMotion set_up_;
    Eigen::Matrix<double, 6, 6> pose_of_deviation_;
    bool has_reversal_ = false, reversal_by_angle_ = false;
    std::vector<Visit> visits_;
    Adjustment adjustment_;
    std::vector<Adjustment::BlockId> station_blocks_, dead_path_blocks_, pose_blocks_;
    Adjustment::BlockId fixture_block_ = 0, expansion_block_ = 0, reversal_block_ = 0;
    std::size_t fixture_prior_ = k_none, expansion_prior_ = k_none;
    std::vector<std::size_t> scale_priors_, temperature_priors_;
};

/// Where the repeatability of the table acts, in the frame of the table, [m]: the point of the axis that is stated; else, of
/// one that is estimated, the foot on the axis of the centroid of the reflectors, and of one that is given, the foot of the
/// origin of the fixture, of which the error motions are. A translation of "the table" is one of a point, and the same deviation seen from another point of
/// the axis has other translations. The origin of the fixture coordinates is where a CMM happened to put it; the centroid
/// moves with the reflectors (ADR 0071).
[[nodiscard]] Eigen::Vector3d repeatability_point(const RotaryTableMeasurement& measurement, const RigidMotion& set_up);
/// The same as a coordinate along the axis in the frame of the fixture, as TableRepeatability::axial_position states it,
/// [m].
[[nodiscard]] double repeatability_position(const RotaryTableMeasurement& measurement);

/// Pose (of the origin) by a deviation whose translations are those of a point, 6×6: d = d_c + ω × (0 − c).
[[nodiscard]] Eigen::Matrix<double, 6, 6> pose_by_deviation(const Eigen::Vector3d& point);

/// Visits of the active distances, in the order of their first distance.
[[nodiscard]] std::vector<Visit> visits_of(const RotaryTableMeasurement& measurement, const std::vector<bool>& active);

/// Nominal rotation R(θ) of the table at an angle, identity at home.
[[nodiscard]] Eigen::Matrix3d nominal_rotation(const RotaryTableMeasurement& measurement, std::size_t angle);

}  // namespace gumcert::engine
