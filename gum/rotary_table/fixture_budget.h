#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/measurement_model.h"
#include "gum/rotary_table/rotary_table_request.h"

namespace gumcert::gum {

/// All points of a budget as one model: what the points have in common is one input, so that its outputs, one a point,
/// are drawn together as they are correlated.
///
/// An input that the points share with one distribution is one quantity. Where its distribution differs between them (a
/// percentage of the reading), it is a group of quantities with one probability for all.
class JointBudgetModel final : public MeasurementModel {
public:
    /// \param result   of one output
    /// \param names    of the outputs, one a point
    /// \throws NoResultError  GC-FIXTURE-0001 where correlated inputs have other distributions at other points
    JointBudgetModel(const BudgetResult& result, const std::vector<std::string>& names);

    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override;
    void evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const override;

private:
    std::vector<InputGroup> groups_;
    std::vector<OutputQuantity> outputs_;
    struct Point {
        std::shared_ptr<const BudgetModel> model;
        std::vector<Eigen::Index> inputs;  ///< of this model, one for each input of the point
    };
    std::vector<Point> points_;
    Eigen::Index size_ = 0;  ///< number of inputs
};

/// Standard uncertainty of one fixture coordinate as the source paper states it, eq. (11):
/// u_c = sqrt(0.401² + (3.32e-7 L)²) µm with L in µm. It is kept to reproduce the paper, not because it is right.
/// \param coordinate  [m]
/// \return [m]
[[nodiscard]] double source_paper_fixture_uncertainty(double coordinate);

/// The name that a fixture budget gives a coordinate: "R1.x".
/// \param axis  0, 1, 2 for x, y, z
[[nodiscard]] std::string fixture_coordinate_name(const std::string& reflector, std::size_t axis);

/// The points of a fixture budget in the order x1 y1 z1 x2 …
/// \param file  of the budget, for messages
/// \throws InputError  GC-FIXTURE-0003 where they are not the coordinates of the reflectors
[[nodiscard]] std::vector<BudgetPoint> in_order_of_coordinates(std::vector<BudgetPoint> points,
                                                               const std::vector<std::string>& reflectors,
                                                               const std::string& file);

/// Where the uncertainty of the fixture coordinates comes from.
struct FixtureUncertainty {
    std::vector<Diagnostic> notes;       ///< of the evaluation of the budget
    std::optional<BudgetResult> budget;  ///< one point a coordinate, in the order x1 y1 z1 x2 …
    std::size_t largest = 0;             ///< point of the largest standard uncertainty; with a budget
    /// Of all 3n coordinates in the same order, [m], for Monte Carlo; null without a budget.
    std::shared_ptr<const MeasurementModel> model;
};

/// Evaluates the budget of the fixture, if there is one, and puts its covariance into the measurement.
///
/// Call it before anything uses `measurement.fixture_covariance`; without a budget it changes nothing.
/// \throws InputError     GC-INPUT-0230 the budget has not one output of the unit of a length; GC-INPUT-0231 a value
///                        differs from the coordinates of the measurement by more than 0.1 µm; GC-FIXTURE-0003
/// \throws NoResultError  where the budget has no result, or a coordinate without uncertainty (GC-FIXTURE-0002)
[[nodiscard]] FixtureUncertainty apply_fixture_budget(RotaryTableRequest& request);

}  // namespace gumcert::gum
