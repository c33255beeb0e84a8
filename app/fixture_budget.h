#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "engine/job/rotary_table_job.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/measurement_model.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// All points of a budget as one model: what the points have in common is one input, so that its outputs, one a point,
/// are drawn together as they are correlated.
///
/// An input that the points share with one distribution is one quantity. Where its distribution differs between them (a
/// percentage of the reading), it is a group of quantities with one probability for all.
class JointBudgetModel final : public gum::MeasurementModel {
public:
    /// \param result   of one output
    /// \param names    of the outputs, one a point
    /// \throws NoResultError  GC-FIXTURE-0001 where correlated inputs have other distributions at other points
    JointBudgetModel(const gum::BudgetResult& result, const std::vector<std::string>& names);

    [[nodiscard]] const std::vector<gum::InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override;
    void evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const override;

private:
    std::vector<gum::InputGroup> groups_;
    std::vector<gum::OutputQuantity> outputs_;
    struct Point {
        std::shared_ptr<const gum::BudgetModel> model;
        std::vector<Eigen::Index> inputs;  ///< of this model, one for each input of the point
    };
    std::vector<Point> points_;
    Eigen::Index size_ = 0;  ///< number of inputs
};

/// Where the uncertainty of the fixture coordinates comes from.
struct FixtureUncertainty {
    reports::FixtureBudget record;            ///< for the record of the job; also without a budget
    std::vector<gum::Diagnostic> notes;       ///< of the evaluation of the budget
    std::optional<gum::BudgetResult> budget;  ///< one point a coordinate, in the order x1 y1 z1 x2 …
    /// Of all 3n coordinates in the same order, [m], for Monte Carlo; null without a budget.
    std::shared_ptr<const gum::MeasurementModel> model;
};

/// Evaluates the budget of the fixture, if the job has one, and puts its covariance into the measurement.
///
/// Call it before anything uses `measurement.fixture_covariance`; without a budget it changes nothing.
/// \throws InputError     GC-INPUT-0230 the budget has not one output of the unit of a length; GC-INPUT-0231 a value
///                        differs from the coordinates file by more than 0.1 µm
/// \throws NoResultError  where the budget has no result, or a coordinate without uncertainty (GC-FIXTURE-0002)
[[nodiscard]] FixtureUncertainty apply_fixture_budget(engine::RotaryTableJob& job);

}  // namespace gumcert::app
