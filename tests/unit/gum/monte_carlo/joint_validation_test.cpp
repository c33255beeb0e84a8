#include "gum/monte_carlo/joint_validation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "gum/coverage.h"

namespace gumcert::gum {
namespace {

/// Cartesian to polar coordinates, JCGM 102:2011, 9.3: x_1 with u = 0.010, x_2 = 0 with u = 0.010.
class PolarModel final : public MeasurementModel {
public:
    explicit PolarModel(double x1) {
        for (int i = 0; i < 2; ++i) {
            InputGroup group;
            group.name = "X" + std::to_string(i + 1);
            group.value = Eigen::VectorXd::Constant(1, i == 0 ? x1 : 0.0);
            group.covariance = Eigen::MatrixXd::Constant(1, 1, 1e-4);
            groups_.push_back(group);
        }
    }
    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override {
        return Eigen::Vector2d(x.norm(), std::atan2(x(1), x(0)));
    }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
        const double r2 = x.squaredNorm();
        Eigen::Matrix2d J;
        J << x(0) / std::sqrt(r2), x(1) / std::sqrt(r2), -x(1) / r2, x(0) / r2;
        return J;
    }

private:
    std::vector<InputGroup> groups_;
    std::vector<OutputQuantity> outputs_{{"r", "1"}, {"phi", "rad"}};
};

JointValidation polar(double x1, const Eigen::Vector2d& in_unit = Eigen::Vector2d::Ones()) {
    const PolarModel model(x1);
    MonteCarloOptions options;
    options.trials = 400'000;
    options.coverage_probability = 0.95;
    const Propagation propagation = propagate(model, 0.95);
    return validate_jointly(propagation, ellipsoid_coverage_factor(0.95, 2, std::numeric_limits<double>::infinity()),
                            run_monte_carlo(model, options), in_unit, 1);
}

TEST(JointValidation, FarFromTheOriginTheModelIsLinear) {
    const JointValidation result = polar(1.0);
    EXPECT_TRUE(result.validated);
    // u(r) = 0.010 to one digit: 1·10^-2, hence δ = ½·10^-2.
    EXPECT_DOUBLE_EQ(result.tolerance(0), 0.005);
    EXPECT_DOUBLE_EQ(result.tolerance(1), 0.005);
    EXPECT_DOUBLE_EQ(result.eigenvalue_tolerance, 0.5);
    ASSERT_TRUE(result.factor_distance);
    EXPECT_LT(*result.factor_distance, 0.01);
}

TEST(JointValidation, NearTheOriginItIsNot) {
    // JCGM 102:2011, 9.3, x_1 = 0.001: the law of propagation gives u(θ) = 10 rad, Monte Carlo 1.744 rad.
    const JointValidation result = polar(0.001);
    EXPECT_FALSE(result.validated);
    EXPECT_NEAR(result.u_distance(1), 10.0 - 1.744, 0.02);
}

TEST(JointValidation, TakesTheDigitsInTheUnitOfTheResult) {
    const JointValidation result = polar(1.0, Eigen::Vector2d(1000.0, 180.0 / 3.141592653589793));
    EXPECT_DOUBLE_EQ(result.tolerance(0), 5.0);   // 10 mm to one digit
    EXPECT_DOUBLE_EQ(result.tolerance(1), 0.05);  // 0.6°
    EXPECT_TRUE(result.validated);
}

}  // namespace
}  // namespace gumcert::gum
