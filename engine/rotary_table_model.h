#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/datum.h"
#include "engine/joint_adjustment.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::engine {

/// Reported quantities of a rotary table in their fixed order: the six error motions of every angle (angle by angle),
/// the two offsets and two tilts of the set-up across the axis, and the six reversals where both senses were measured.
struct ReportedQuantities {
    std::vector<gum::OutputQuantity> outputs;
    Eigen::Index errors = 0;    ///< first index, always 0
    Eigen::Index set_up = 0;    ///< first index of the four set-up errors
    Eigen::Index reversal = 0;  ///< first index of the six reversals
    bool has_reversal = false;
};

[[nodiscard]] ReportedQuantities reported_quantities(const RotaryTableMeasurement& measurement, bool has_reversal);

/// Values of the reported quantities, [m] and [rad].
[[nodiscard]] Eigen::VectorXd reported_values(const JointAdjustment& adjustment, const DatumSolution& datum);

/// Their derivatives with respect to the free parameters of an adjustment, m×p.
[[nodiscard]] Eigen::MatrixXd reported_map(const JointAdjustment& adjustment, const NormalEquations& normal,
                                           const DatumSolution& datum);

/// Columns of a pose in the order of the table-repeatability inputs: linear (3), axial (1), tilt (2).
[[nodiscard]] std::array<int, 6> repeatability_order(RotaryAxis axis);

/// What the variance of a source rests on; infinite for a source that is stated.
struct SourceDegreesOfFreedom {
    double length_noise, table_linear, table_axial, table_tilt;
};

/// The adjustment of a rotary table as a measurement model for the GUM layer.
///
/// Inputs: the measured lengths, the deviation of the table at every visit (zero, with its repeatability), the scale of
/// every station, the dead paths, the CMM coordinates of the fixture, its temperature at every station and its
/// expansion. Outputs: `ReportedQuantities`.
///
/// The dead paths are inputs with the values and the covariance that the adjustment finds for them, and the estimator
/// takes them as known. This splits the covariance of the joint estimate exactly: the estimate with known dead paths is
/// uncorrelated with the estimated dead paths (Gauss-Markov), so contributions with known dead paths and the
/// contribution of the dead paths add to the covariance of the joint adjustment. Without it their row of the budget
/// would be zero by construction and hide what not knowing them costs.
class RotaryTableModel final : public gum::MeasurementModel {
public:
    /// \param solved  converged, at its final weights
    RotaryTableModel(RotaryTableMeasurement measurement, const JointAdjustment& solved,
                     const StochasticModel& stochastic, const SourceDegreesOfFreedom& degrees_of_freedom);
    RotaryTableModel(const RotaryTableModel&) = delete;  // the adjustment inside refers to the measurement beside it
    RotaryTableModel& operator=(const RotaryTableModel&) = delete;

    [[nodiscard]] const std::vector<gum::InputGroup>& inputs() const override { return inputs_; }
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return quantities_.outputs; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override;
    [[nodiscard]] const ReportedQuantities& quantities() const { return quantities_; }
    [[nodiscard]] const JointAdjustment& solved() const { return nominal_; }
    /// ∂length/∂pose of a visit at the nominal solution, n×6.
    [[nodiscard]] const Eigen::MatrixXd& visit_pose(std::size_t visit) const { return visit_pose_[visit]; }

private:
    [[nodiscard]] JointAdjustment solve_at(const Eigen::VectorXd& x) const;

    RotaryTableMeasurement measurement_;
    StochasticModel stochastic_;
    RigidMotion set_up_;
    JointAdjustment nominal_;
    std::vector<Eigen::MatrixXd> visit_pose_;  ///< ∂length/∂pose of every visit at the nominal solution
    std::vector<gum::InputGroup> inputs_;
    ReportedQuantities quantities_;
    std::vector<std::size_t> scale_stations_, temperature_stations_;
    bool expansion_is_input_ = false;
};

}  // namespace gumcert::engine
