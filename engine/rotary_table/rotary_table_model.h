#pragma once

#include <Eigen/Core>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/joint_adjustment.h"
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

/// Values in the order of `reported_quantities`: errors angle by angle, the set-up across the axis, and the reversal.
/// \param reversal  null: there is none
[[nodiscard]] Eigen::VectorXd reported_order(const RotaryTableMeasurement& measurement, const Eigen::MatrixXd& errors,
                                             const Eigen::Matrix<double, 6, 1>& set_up,
                                             const Eigen::Matrix<double, 6, 1>* reversal);

/// Values of the reported quantities, [m] and [rad].
[[nodiscard]] Eigen::VectorXd reported_values(const JointAdjustment& adjustment, const DatumSolution& datum);

/// Columns of a pose in the order of the table-repeatability inputs: linear (3), axial (1), tilt (2).
[[nodiscard]] std::array<int, 6> repeatability_order(RotaryAxis axis);

/// What the variance of a source rests on; infinite for a source that is stated.
struct SourceDegreesOfFreedom {
    double length_noise, table_linear, table_axial, table_tilt;
    double fixture = std::numeric_limits<double>::infinity();
};

/// First index of every group of inputs of `RotaryTableModel`. A group that is not there has the index of the next one.
struct RotaryTableInputs {
    Eigen::Index lengths = 0;      ///< one a length, in the order of the visits
    Eigen::Index scale = 0;        ///< one a station with a prior
    Eigen::Index dead_paths = 0;   ///< one each
    Eigen::Index fixture = 0;      ///< x1 y1 z1 x2 …
    Eigen::Index temperature = 0;  ///< one a station with an uncertain temperature
    Eigen::Index expansion = 0;    ///< none or one
    Eigen::Index linear = 0;       ///< deviations of the table: three a visit, then
    Eigen::Index axial = 0;        ///< one a visit, then
    Eigen::Index tilt = 0;         ///< two a visit, see `repeatability_order`
    Eigen::Index resolution = 0;   ///< one a length, or none
    Eigen::Index size = 0;         ///< of all inputs
};

/// Most sensitivity coefficients of the reported quantities that are held at a time: two such matrices, as the law of
/// propagation needs them, take 3.2 GB.
constexpr double k_most_sensitivity_coefficients = 2e8;

/// Number of the sensitivity coefficients of the reported quantities of a measurement by all its inputs: grows with the
/// square of the angles. An upper bound where distances are left out.
[[nodiscard]] double sensitivity_coefficient_count(const RotaryTableMeasurement& measurement);

/// Refuses, before anything is computed, a measurement whose sensitivity coefficients cannot be held.
/// \throws gum::NoResultError  GC-ADJUST-0008 with the number of angles that can be evaluated
void require_evaluable_size(const RotaryTableMeasurement& measurement);

/// The adjustment of a rotary table as a measurement model for the GUM layer.
///
/// Inputs: the measured lengths, the deviation of the table at every visit (zero, with its repeatability), the scale of
/// every station, the dead paths, the CMM coordinates of the fixture, its temperature at every station, its expansion,
/// and what the resolution of the display takes from every length (zero). Outputs: `ReportedQuantities`.
///
/// The lengths are corrected for their inputs: l - A δ + r with the deviation δ of the visit (A = ∂l/∂δ) and the
/// part r that the display rounded away.
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
    /// `linearise()` of `solved()`, and the covariance of its parameters.
    [[nodiscard]] const NormalEquations& equations() const { return equations_; }
    [[nodiscard]] const BorderedCovariance& parameter_covariance() const { return parameter_covariance_; }
    /// ∂length/∂deviation of the table at a visit, at the nominal solution, n×6
    /// (JointAdjustment::repeatability_jacobian).
    [[nodiscard]] const Eigen::MatrixXd& visit_pose(std::size_t visit) const { return visit_pose_[visit]; }
    [[nodiscard]] const RotaryTableMeasurement& measurement() const { return measurement_; }
    [[nodiscard]] const StochasticModel& stochastic() const { return stochastic_; }
    [[nodiscard]] const RotaryTableInputs& layout() const { return layout_; }

    /// The adjustment solved for other values of the inputs; it refers to this model and must not outlive it.
    /// \throws gum::NoResultError  if it does not converge
    [[nodiscard]] JointAdjustment solve_at(const Eigen::VectorXd& x) const;

    /// ∂y/∂inputs, k×inputs, of any quantities y = a·x̂ + b·(l - f(x̂)) of a solution: free parameters x̂ of the
    /// estimator with known dead paths, lengths l corrected for the inputs, predicted lengths f.
    ///
    /// Costs one inverse of the normal equations and then grows with k; the 6N rows of the reported quantities are not
    /// formed.
    /// \param adjustment    from `solve_at` or `solved()`
    /// \param normal        `linearise()` of the same
    /// \param by_parameter  a, k×p, in the order of the free parameters of `normal`
    /// \param by_residual   b, k×lengths in the order of the visits; or without columns: b = 0
    [[nodiscard]] Eigen::MatrixXd input_sensitivity(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                    const Eigen::Ref<const Eigen::MatrixXd>& by_parameter,
                                                    const Eigen::Ref<const Eigen::MatrixXd>& by_residual) const;

private:
    RotaryTableMeasurement measurement_;
    StochasticModel stochastic_;
    RigidMotion set_up_;
    JointAdjustment nominal_;
    NormalEquations equations_;
    BorderedCovariance parameter_covariance_;
    std::vector<Eigen::MatrixXd> visit_pose_;  ///< ∂length/∂deviation of every visit, as `visit_pose`
    std::vector<gum::InputGroup> inputs_;
    RotaryTableInputs layout_;
    ReportedQuantities quantities_;
    std::vector<std::size_t> scale_stations_, temperature_stations_;
    bool expansion_is_input_ = false;
};

}  // namespace gumcert::engine
