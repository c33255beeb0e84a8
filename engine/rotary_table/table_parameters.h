#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/positioning_accuracy.h"
#include "engine/rotary_table/rotary_table_model.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::engine {

/// How the axial deviation of each visit of the table is found from the residuals of its lengths.
struct VisitPositionGains {
    /// One a visit: g with g·(l_v - f_v) the unbiased estimate of the axial rotation of the visit beyond the adjusted
    /// pose, n of the visit, [rad/m]. Empty where the lengths of the visit do not see the rotation.
    std::vector<Eigen::VectorXd> gains;

    [[nodiscard]] bool determined(std::size_t visit) const { return gains[visit].size() > 0; }
};

/// g' = (a'M⁻¹a)⁻¹ a'M⁻¹ of every visit: a = ∂l/∂(axial rotation of the pose), M = covariance of the lengths of the
/// visit without the axial repeatability (length noise, resolution, linear and tilt repeatability). g'a = 1.
///
/// A visit whose lengths tell its rotation to no better than a milliradian (lines of sight through the axis) is not
/// determined.
[[nodiscard]] VisitPositionGains visit_position_gains(const JointAdjustment& solved, const StochasticModel& stochastic);

/// Axial deviation of the table in every visit v (pass and angle), V, [rad]:
///
///   x_v = e_axial(angle of v) ± reversal_axial/2 + g_v'(l_v - f_v(x̂))
///
/// The upper sign is that of the positive approach; zero where a visit is not determined. The measurand is the position
/// that the table really took in that run: x_v from lengths that hold the deviation δ_v of the visit estimates
/// E + δ_v, so that its error is x_v - (E + δ_v).
///
/// \param solved    adjustment of lengths as read
/// \param reported  `reported_values` of the same
[[nodiscard]] Eigen::VectorXd visit_positions(const JointAdjustment& solved,
                                              const Eigen::Ref<const Eigen::VectorXd>& reported,
                                              const VisitPositionGains& gains);

/// Quantities that are derived from the reported ones and from the positions of the single visits, in a fixed order.
class DerivedQuantities {
public:
    virtual ~DerivedQuantities() = default;
    [[nodiscard]] virtual const std::vector<gum::OutputQuantity>& outputs() const = 0;
    /// Safe to call from several threads at a time.
    /// \param reported         values of `ReportedQuantities`, [m] and [rad]
    /// \param visit_positions  x_v of every visit, V, [rad]; in a model whose inputs hold the deviations δ_v of the
    /// table
    ///     and whose lengths are corrected for them (RotaryTableModel: l - A δ), that is
    ///     e ± reversal/2 + g'(l - A δ_v - f) + δ_v
    /// \param result           receives the values of `outputs()`
    virtual void values(const Eigen::Ref<const Eigen::VectorXd>& reported,
                        const Eigen::Ref<const Eigen::VectorXd>& visit_positions,
                        Eigen::Ref<Eigen::VectorXd> result) const = 0;
};

/// Where the kinds of parameters stand among the outputs of `TableParameters`.
struct TableParameterLayout {
    Eigen::Index ranges = 0;        ///< six ISO 230-7 ranges, always first
    Eigen::Index axis_line = 6;     ///< four
    Eigen::Index positioning = 10;  ///< ISO 230-2, those that the runs allow
    Eigen::Index positioning_count = 0;
};

/// Parameters of a rotary table: ranges of the error motions, the axis average line in the frame of the fixture, and
/// accuracy and repeatability of positioning.
///
/// - "range of EXA" …: max - min of each error motion over the angles, in the datum of the result (ISO 230-7).
/// - axis_y axis_z axis_b axis_c for A, and so on: the axis average line in the frame of the fixture, which the set-up
///   makes and which is no property of the machine (LocationErrorModel is): the point where it pierces the plane
///   through the origin of the fixture across the axis, and its direction as right-handed tilts about the two cross
///   axes, each the angle of its projection along that cross axis. To first order -O and -S of T_s, whose inverse they
///   are made of. They belong to the axis average line whatever the datum of the result.
/// - M, E, E_up … A_down (ISO 230-2): of the axial rotation. A run is a pass; the runs of a target are all visits of
///   that angle in one sense. The deviations hold the noise of the measurement besides that of the table.
///
/// A range and every maximum rest on the angles that are extreme in the estimate. Where noise can change them, the law
/// of propagation alone is not valid (JCGM 101:2008, 5.8.1), and Monte Carlo about the estimate does not repair it: the estimate holds
/// noise that makes it larger, and a trial adds as much once more (ADR 0015). gum/monte_carlo/extreme_uncertainty.h adds what is not
/// known of the angles (ADR 0090).
class TableParameters final : public DerivedQuantities {
public:
    /// \param datum     the nominal solution in the datum of the result
    /// \param reported  its reported values
    /// \param visits    of the adjustment; empty where there are no positions of visits (sequential method)
    /// \param gains     of the same visits
    TableParameters(const RotaryTableMeasurement& measurement, const DatumSolution& datum,
                    const Eigen::VectorXd& reported, std::vector<Visit> visits, const VisitPositionGains& gains);

    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] const std::vector<std::string>& short_names() const {
        return short_names_;
    }  ///< "EXA", "axis_y", "M"
    [[nodiscard]] const std::vector<std::string>& descriptions() const { return descriptions_; }
    [[nodiscard]] const TableParameterLayout& layout() const { return layout_; }
    /// One target an angle; of visits whose position is determined.
    [[nodiscard]] const PositioningRuns& runs() const { return runs_; }

    void values(const Eigen::Ref<const Eigen::VectorXd>& reported,
                const Eigen::Ref<const Eigen::VectorXd>& visit_positions,
                Eigen::Ref<Eigen::VectorXd> result) const override;

    struct Derivatives {
        Eigen::MatrixXd by_reported;  ///< k×m
        Eigen::MatrixXd by_position;  ///< k×V, [1]
    };
    [[nodiscard]] Derivatives derivatives(const Eigen::Ref<const Eigen::VectorXd>& reported,
                                          const Eigen::Ref<const Eigen::VectorXd>& visit_positions) const;

private:
    [[nodiscard]] Eigen::Vector4d set_up_on_average_line(const Eigen::Ref<const Eigen::VectorXd>& reported) const;

    RotaryAxis axis_;
    Eigen::Index angles_;
    Eigen::Matrix<double, 4, Eigen::Dynamic> to_average_line_;  ///< ∂(O, O, S, S)/∂(reported), 4×m
    Eigen::Vector4d nominal_set_up_;                            ///< of the axis average line
    Eigen::VectorXd nominal_reported_;                          ///< where it holds
    PositioningRuns runs_;
    std::vector<std::size_t> stated_;  ///< parameters of ISO 230-2 among the outputs
    std::vector<gum::OutputQuantity> outputs_;
    std::vector<std::string> short_names_, descriptions_;
    TableParameterLayout layout_;
};

/// The axis average line in the frame of the fixture: two [m] and two [rad] in the order of their names, from (O, O, S,
/// S) across the axis in the order of `across_axis`.
[[nodiscard]] Eigen::Vector4d axis_line(RotaryAxis axis, const Eigen::Vector4d& set_up);
/// Names of the same in the same order: "axis_y" ….
[[nodiscard]] std::array<std::string, 4> axis_line_names(RotaryAxis axis);

/// The parameters of a table as a measurement model for the law of propagation: inputs of the model of the table,
/// outputs of `TableParameters`.
class TableParameterModel final : public gum::MeasurementModel {
public:
    /// Of the joint method, with everything that the runs allow.
    TableParameterModel(std::shared_ptr<const RotaryTableModel> table, const DatumSolution& datum);
    /// Of any model of the reported quantities (sequential method): ranges and the axis average line.
    TableParameterModel(std::shared_ptr<const gum::MeasurementModel> table, const RotaryTableMeasurement& measurement,
                        const DatumSolution& datum);

    [[nodiscard]] const std::vector<gum::InputGroup>& inputs() const override { return table_->inputs(); }
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return parameters_->outputs(); }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override;

    /// ∂outputs/∂inputs for a table that shows other values than the nominal solution: the derivatives of the
    /// parameters are taken there, those of the adjustment at the nominal solution (they differ by error motions
    /// against distances). Joint method only.
    /// \param reported   of that table, m
    /// \param positions  of its visits, V, [rad]
    [[nodiscard]] Eigen::MatrixXd jacobian_of_table(const Eigen::VectorXd& reported,
                                                    const Eigen::VectorXd& positions) const;
    /// ∂/∂inputs of combinations of the positions of visits, at the nominal solution. Joint method only.
    /// \param by_position  k×V, [1]
    [[nodiscard]] Eigen::MatrixXd jacobian_of_positions(const Eigen::MatrixXd& by_position) const;
    // Of the adjustment; joint method only.
    [[nodiscard]] const std::vector<Visit>& visits() const { return joint_->solved().visits(); }
    [[nodiscard]] bool has_reversal() const { return joint_->solved().has_reversal(); }

    /// For a Monte Carlo evaluation of the same.
    [[nodiscard]] const std::shared_ptr<const TableParameters>& parameters() const { return parameters_; }
    [[nodiscard]] const VisitPositionGains& gains() const { return gains_; }
    /// x_v of every visit at the estimates of the inputs, V, [rad].
    [[nodiscard]] const Eigen::VectorXd& nominal_positions() const { return nominal_positions_; }
    /// Means, standard deviations and reversals of the targets, one an angle; none for the sequential method.
    [[nodiscard]] PositioningAccuracy positioning() const;
    /// Standard uncertainty of x_v - (E + δ_v), root mean square over the determined visits, [rad].
    [[nodiscard]] double rms_position_uncertainty() const;

private:
    [[nodiscard]] Eigen::MatrixXd by_inputs(const JointAdjustment& adjustment, const NormalEquations& normal,
                                            const DatumSolution& datum, TableParameters::Derivatives by) const;

    std::shared_ptr<const gum::MeasurementModel> table_;
    std::shared_ptr<const RotaryTableModel> joint_;  ///< null for the sequential method
    VisitPositionGains gains_;
    Eigen::VectorXd nominal_positions_;
    std::shared_ptr<const TableParameters> parameters_;
};

}  // namespace gumcert::engine
