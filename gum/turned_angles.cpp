#include "gum/turned_angles.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace gumcert::gum {

double nearest_turn(double angle, double to) {
    constexpr double k_turn = 2.0 * std::numbers::pi;
    return angle - k_turn * std::round((angle - to) / k_turn);
}

Eigen::VectorXd TurnedAngles::evaluate(const Eigen::VectorXd& x) const {
    Eigen::VectorXd y = of_.evaluate(x);
    for (Eigen::Index k = 0; k < y.size(); ++k) {
        if (leaps_[static_cast<std::size_t>(k)]) {
            y(k) = nearest_turn(y(k), values_(k));
        }
    }
    return y;
}

void TurnedAngles::evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const {
    of_.evaluate_trials(x, y);
    for (Eigen::Index k = 0; k < y.cols(); ++k) {
        if (leaps_[static_cast<std::size_t>(k)]) {
            y.col(k) = y.col(k).unaryExpr([&](double angle) { return nearest_turn(angle, values_(k)); });
        }
    }
}

}  // namespace gumcert::gum
