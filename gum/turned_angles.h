#pragma once

#include <Eigen/Core>

#include <utility>
#include <vector>

#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

/// An angle with the number of full turns that brings it nearest to another one, both in rad.
[[nodiscard]] double nearest_turn(double angle, double to);

/// A model some of whose outputs are angles that leap by full turns, as atan2 does at ±180°: they are taken as near to their
/// estimates as turns bring them, so that 179° and −179° lie 2° apart.
class TurnedAngles final : public MeasurementModel {
public:
    /// \param of      must outlive this object
    /// \param leaps   one an output of `of`, in rad where true
    /// \param values  estimates of the outputs
    TurnedAngles(const MeasurementModel& of, std::vector<bool> leaps, Eigen::VectorXd values)
        : of_(of), leaps_(std::move(leaps)), values_(std::move(values)) {}

    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return of_.inputs(); }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return of_.outputs(); }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override { return of_.jacobian(x); }
    [[nodiscard]] std::vector<Eigen::MatrixXd> hessians(const Eigen::VectorXd& x) const override {
        return of_.hessians(x);
    }
    void evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const override;

private:
    const MeasurementModel& of_;
    std::vector<bool> leaps_;
    Eigen::VectorXd values_;
};

}  // namespace gumcert::gum
