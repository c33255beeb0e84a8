#pragma once

#include <vector>

#include "gum/expression/equation_system.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

/// Equations with their inputs as a measurement model.
/// Accuracy: that of EquationSystem.
/// Example: examples/api/budget_by_hand.cpp
class EquationModel final : public MeasurementModel {
public:
    /// \param groups  inputs in the order of the system's inputs, cut into groups: the sizes add up to its input count
    /// \throws InputError  GC-MODEL-0070 when they do not
    EquationModel(EquationSystem system, std::vector<InputGroup> groups);

    [[nodiscard]] const EquationSystem& system() const { return system_; }
    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override;
    [[nodiscard]] std::vector<Eigen::MatrixXd> hessians(const Eigen::VectorXd& x) const override;
    void evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const override;

private:
    EquationSystem system_;
    std::vector<InputGroup> groups_;
    std::vector<OutputQuantity> outputs_;
    Eigen::VectorXd start_;  // of unknowns in trials: the solution at the estimates
};

}  // namespace gumcert::gum
