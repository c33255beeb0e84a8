#include "gum/linearity_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "gum/expression/equation_model.h"
#include "gum/expression/equation_system.h"

namespace gumcert::gum {
namespace {

InputGroup input(const std::string& name, double value, double u, Distribution marginal = {}) {
    InputGroup group;
    group.name = name;
    group.unit = "1";
    group.value = Eigen::VectorXd::Constant(1, value);
    group.covariance = Eigen::MatrixXd::Constant(1, 1, u * u);
    group.marginals = {marginal.kind == DistributionKind::constant ? Distribution::normal(value, u) : marginal};
    return group;
}

class Model final : public MeasurementModel {
public:
    Model(const std::string& expression, std::vector<InputGroup> inputs) : inputs_(std::move(inputs)) {
        std::vector<InputSymbol> symbols;
        for (const InputGroup& group : inputs_) {
            symbols.push_back({.name = group.name, .unit = Unit(), .constant = {}});
        }
        const EquationText text{.text = "y = " + expression, .where = "model"};
        system_.emplace(EquationSystem::compile({&text, 1}, symbols));
    }
    const std::vector<InputGroup>& inputs() const override { return inputs_; }
    const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override { return system_->evaluate(x); }
    Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override { return system_->jacobian(x); }
    void evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const override {
        system_->evaluate_trials(x, y);
    }
    void unit_of_output(const std::string& unit) { outputs_.front().unit = unit; }

private:
    std::vector<InputGroup> inputs_;
    std::vector<OutputQuantity> outputs_{{"y", "1"}};
    std::optional<EquationSystem> system_;
};

LinearityCheck check(const std::string& expression, const std::vector<InputGroup>& inputs) {
    const Model model(expression, inputs);
    return check_linearity(model, propagate(model, 0.9545), {}).at(0);
}

TEST(LinearityCheck, AcceptsWhatIsLinear) {
    EXPECT_TRUE(check("3*a - 2*b + 1e9", {input("a", 1.0, 0.5), input("b", -4.0, 2.0)}).adequate);
    EXPECT_TRUE(check("a*b", {input("a", 1e6, 1.0), input("b", 3.0, 1e-6)}).adequate);
    EXPECT_TRUE(check("(1e9 + a) - 1e9", {input("a", 1.0, 1e-3)}).adequate) << "rounding is no curvature";
    EXPECT_TRUE(check("a/b", {input("a", 1.0, 0.01), input("b", 1.0, 0.01)}).adequate);
    EXPECT_TRUE(check("a^2 - a^2", {input("a", 1.0, 1.0)}).adequate);
}

// The Hessian of each of these vanishes, or says nothing of what happens within U.
TEST(LinearityCheck, SeesWhatSecondDerivativesDoNot) {
    EXPECT_FALSE(check("a^3", {input("a", 0.0, 1.0)}).adequate);
    EXPECT_FALSE(check("sin(a*rad)", {input("a", 0.0, 1.0)}).adequate);
    EXPECT_FALSE(check("max(a, 0)", {input("a", 0.01, 1.0)}).adequate);
    EXPECT_FALSE(check("abs(a - b)", {input("a", 1.0, 1.0), input("b", 0.999, 1.0)}).adequate);
    EXPECT_FALSE(
        check("a + b*c*d", {input("a", 0.0, 1.0), input("b", 0.0, 1.0), input("c", 0.0, 1.0), input("d", 0.0, 1.0)})
            .adequate);
    EXPECT_FALSE(check("a + 3*tanh(20*b)", {input("a", 0.0, 1.0), input("b", 0.0, 1.0)}).adequate);
    EXPECT_FALSE(check("min(a, 1.5)", {input("a", 0.0, 1.0)}).adequate) << "a kink inside of U";
    EXPECT_TRUE(check("min(a, 3)", {input("a", 0.0, 1.0)}).adequate) << "a kink outside of U";
}

TEST(LinearityCheck, AnAngleThatLeapsIsTheSameAngle) {
    const auto check = [](double s, double u, const char* unit) {
        Model model("atan2(s, c)", {input("s", s, u), input("c", -1.0, u)});
        model.unit_of_output(unit);
        return check_linearity(model, propagate(model, 0.9545), {}).front();
    };
    EXPECT_TRUE(check(0.001, 0.02, "rad").adequate);
    EXPECT_TRUE(check(0.001, 0.02, "rad").leaps);
    EXPECT_FALSE(check(0.001, 0.02, "1").adequate) << "a number does not come round";
    EXPECT_TRUE(check(0.5, 0.02, "rad").adequate);
    EXPECT_FALSE(check(0.5, 0.02, "rad").leaps);
    EXPECT_FALSE(check(0.001, 0.6, "rad").adequate) << "an angle that is hardly known";
}

// Its trials would fill the circle, 10° ± 180° in place of 179° ± 23°. A curve that is as steep has values on the way.
TEST(LinearityCheck, AnAngleThatIsBentLeapsAllTheSame) {
    const auto leaps = [](const std::string& equation, std::vector<InputGroup> inputs) {
        Model model(equation, std::move(inputs));
        model.unit_of_output("rad");
        return check_linearity(model, propagate(model, 0.9545), {}).front().leaps;
    };
    for (const double u : {0.2, 0.25, 0.4}) {
        for (const double angle : {3.14, 3.0, -2.9, -3.1}) {
            EXPECT_TRUE(leaps("atan2(s, c)", {input("s", std::sin(angle), u), input("c", std::cos(angle), u)}))
                << u << ", " << angle;
        }
        EXPECT_FALSE(leaps("atan2(s, c)", {input("s", 0.01, 20.0 * u), input("c", -1.0, 20.0 * u)}))
            << "not known at all";
    }
    EXPECT_FALSE(leaps("2*rad*exp(a)", {input("a", 0.0, 0.5)}));
    EXPECT_FALSE(leaps("rad*a^3", {input("a", 0.0, 2.0)}));
    EXPECT_FALSE(leaps("rad*a*abs(a)", {input("a", 1.0, 0.5)}));
    EXPECT_FALSE(leaps("rad*10*tanh(3*a)", {input("a", 1.0, 0.5)}));
}

TEST(LinearityCheck, StaysInsideOfTheLimitsOfAnInput) {
    // The logarithm has no value below 0: the half-normal probe at 2 u would be there, the uniform input is not.
    const std::vector<InputGroup> bounded{input("a", 1.0, 0.9 / std::sqrt(3.0), Distribution::uniform(1.0, 0.9)),
                                          input("b", 0.0, 30.0)};
    EXPECT_TRUE(check("ln(a) + b", bounded).adequate);
    EXPECT_FALSE(check("ln(a)", {input("a", 1.0, 0.6)}).adequate) << "U reaches outside of the domain";
}

TEST(LinearityCheck, MeasuresTheDeviationAtTheEndsOfU) {
    InputGroup pair;
    pair.name = "a";
    pair.unit = "1";
    pair.value = Eigen::VectorXd::Zero(1);
    pair.covariance = Eigen::MatrixXd::Constant(1, 1, 1.0);
    pair.marginals = {Distribution::normal(0.0, 1.0)};
    const LinearityCheck flat = check("exp(a)", {pair});
    EXPECT_FALSE(flat.adequate);
    EXPECT_NEAR(flat.end_deviation, std::exp(2.0) - 3.0, 1e-12) << "at a = 2, where the tangent is 3";
}

TEST(LinearSkewness, IsThatOfTheOnlyInput) {
    const Distribution gamma{.kind = DistributionKind::gamma, .location = 0.0, .scale = 1.0, .shape = 4.0};
    const Model one("2*a", {input("a", 4.0, 2.0, gamma)});
    EXPECT_NEAR(linear_skewness(one, propagate(one, 0.95), 0), 1.0, 1e-12);  // 2/√4
    const Model difference("-a + b", {input("a", 4.0, 2.0, gamma), input("b", 0.0, 2.0)});
    EXPECT_NEAR(linear_skewness(difference, propagate(difference, 0.95), 0), -1.0 / std::pow(2.0, 1.5), 1e-12);
}

/// y = f(w), w = a + T b, of a line that is known best at T: its factor says u(w) = 1, and its covariance, in which T² + 1 is
/// rounded, does not.
class OfALineFarAway final : public MeasurementModel {
public:
    OfALineFarAway(double w, double (*f)(double), double (*slope)(double)) : f_(f), slope_(slope) {
        InputGroup line;
        line.name = "line";
        line.unit = "1";
        line.value = Eigen::Vector2d(0.0, w);
        line.factor = Eigen::Matrix2d{{1.0, 0.0}, {-k_far, 1.0}};
        line.covariance = line.factor * line.factor.transpose();
        inputs_ = {line};
    }
    const std::vector<InputGroup>& inputs() const override { return inputs_; }
    const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override {
        return Eigen::VectorXd::Constant(1, f_(x(1) + k_far * x(0)));
    }
    Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
        return slope_(x(1) + k_far * x(0)) * Eigen::RowVector2d(k_far, 1.0);
    }

private:
    static constexpr double k_far = 1048576.0;  // 2^20
    double (*f_)(double);
    double (*slope_)(double);
    std::vector<InputGroup> inputs_;
    std::vector<OutputQuantity> outputs_{{"y", "1"}};
};

TEST(LinearityCheck, ProbesAlongAFactorThatIsKnown) {
    const auto checked = [](double w, double (*f)(double), double (*slope)(double)) {
        const OfALineFarAway model(w, f, slope);
        return check_linearity(model, propagate(model, 0.9545), {}).at(0);
    };
    const auto square = [](double w) { return w * w; };
    const auto twice = [](double w) { return 2.0 * w; };
    EXPECT_TRUE(checked(
                    3.0, [](double w) { return 5.0 * w; }, [](double) { return 5.0; })
                    .adequate);
    EXPECT_TRUE(checked(1000.0, square, twice).adequate) << "u/w = 0.1 %";
    const LinearityCheck bent = checked(3.0, square, twice);
    EXPECT_FALSE(bent.adequate);
    // At w ± k u the square differs from its tangent by (k u)².
    EXPECT_NEAR(bent.end_deviation, 4.0, 0.01) << "k = 2.000";
}

TEST(LinearSkewness, IsNoneWithoutUncertaintyOrWeight) {
    const Distribution skewed{.kind = DistributionKind::exponential, .location = 0.0, .scale = 1.0};
    const auto skewness_of = [](const std::string& expression, const std::vector<InputGroup>& inputs) {
        const Model model(expression, inputs);
        return linear_skewness(model, propagate(model, 0.9545), 0);
    };
    EXPECT_EQ(skewness_of("0*a", {input("a", 1.0, 1.0, skewed)}), 0.0);
    // γ(y) = Σ (c u/u(y))³ γ_i with γ = 2 of the exponential one: a + 2 b, b of no weight in the skewness but in u.
    EXPECT_NEAR(skewness_of("a + 2*b + 0*c",
                            {input("a", 1.0, 1.0, skewed), input("b", 0.0, 1.0), input("c", 1.0, 1.0, skewed)}),
                2.0 / (5.0 * std::sqrt(5.0)), 1e-12);
}

}  // namespace
}  // namespace gumcert::gum
