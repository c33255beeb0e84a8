#include "gum/turned_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gumcert::gum {
namespace {

constexpr double k_degree = std::numbers::pi / 180.0;

/// The angle of a direction, and a length.
class Direction final : public MeasurementModel {
public:
    const std::vector<InputGroup>& inputs() const override { return inputs_; }
    const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override {
        return Eigen::Vector2d(std::atan2(x(0), x(1)), 7.0 * x(0));
    }
    Eigen::MatrixXd jacobian(const Eigen::VectorXd& /*x*/) const override { return Eigen::MatrixXd::Zero(2, 2); }

private:
    std::vector<InputGroup> inputs_;
    std::vector<OutputQuantity> outputs_ = {{"t", "rad"}, {"l", "m"}};
};

TEST(NearestTurn, IsWithinHalfATurn) {
    EXPECT_NEAR(nearest_turn(-179.0 * k_degree, 179.0 * k_degree), 181.0 * k_degree, 1e-12);
    EXPECT_EQ(nearest_turn(1.0, 0.5), 1.0);
    for (double angle = -20.0; angle < 20.0; angle += 0.37) {
        for (double to = -20.0; to < 20.0; to += 0.41) {
            const double turned = nearest_turn(angle, to);
            EXPECT_LE(std::abs(turned - to), std::numbers::pi + 1e-12);
            EXPECT_NEAR(std::remainder(turned - angle, 2.0 * std::numbers::pi), 0.0, 1e-12);
        }
    }
}

TEST(TurnedAngles, LeaveOtherOutputsAlone) {
    const Direction of;
    const TurnedAngles turned(of, {true, false}, Eigen::Vector2d(179.0 * k_degree, 0.0));
    Eigen::MatrixXd x(2, 2);
    x << -0.01, -1.0, 0.01, -1.0;
    Eigen::MatrixXd y(2, 2);
    turned.evaluate_trials(x, y);
    EXPECT_GT(y(0, 0), std::numbers::pi);
    EXPECT_LT(y(1, 0), std::numbers::pi);
    EXPECT_NEAR(y(0, 0) - y(1, 0), 0.02, 1e-5);
    EXPECT_EQ(y(0, 1), -0.07);
    EXPECT_EQ(turned.evaluate(x.row(0).transpose()), y.row(0).transpose());
}

}  // namespace
}  // namespace gumcert::gum
