// What is computed from a curve whose x lie far from 0 beside their range.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "gum/budget/evaluate_budget.h"
#include "gum/propagation.h"
#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

using test::input;

struct Far {
    int degree = 1;
    double centre = 0.0;  ///< of x
    double step = 1.0;    ///< between the points
    bool scaled = false;  ///< by the residuals
};

/// A polynomial through seven points about a centre, and its value near one of them.
Budget predicted(const Far& of) {
    std::string curve = "a + b*x";
    std::string model = "z = a + b*q";
    std::vector<std::string> names{"a", "b"};
    for (int power = 2; power <= of.degree; ++power) {
        const std::string name(1, static_cast<char>('a' + power));
        curve += " + " + name + "*x^" + std::to_string(power);
        model += " + " + name + "*q^" + std::to_string(power);
        names.push_back(name);
    }
    Budget made = test::budget({model}, {input("q", state_constant(of.centre + 0.25 * of.step))});
    BudgetFit fit = test::line({1.2, 1.5, 1.9, 2.1, 2.6, 2.9, 3.0}, of.scaled ? 0.0 : 0.1);
    fit.equation.text = "V = " + curve;
    fit.parameters.clear();
    for (const std::string& name : names) {
        fit.parameters.push_back({.name = name, .unit = {}, .start = {}});
    }
    fit.x = (of.step * Eigen::VectorXd::LinSpaced(7, -3.0, 3.0)).array() + of.centre;
    made.fits = {fit};
    made.coverage = CoverageChoice::law_of_propagation;
    return made;
}

std::vector<Far> places() {
    std::vector<Far> all;
    for (const bool scaled : {false, true}) {
        for (const double centre : {2.0, 1550.0, 2459000.0, 100000000.0}) {
            for (const double step : {0.015625, 0.25, 1.0, 16.0}) {
                all.push_back({.degree = 1, .centre = centre, .step = step, .scaled = scaled});
                all.push_back({.degree = 2, .centre = centre, .step = step, .scaled = scaled});
                all.push_back({.degree = 3, .centre = centre, .step = step, .scaled = scaled});
            }
        }
    }
    return all;
}

/// Shifting x changes the parameters and no prediction: x − x₀ is the same curve, about its middle.
TEST(FitFarFromZero, UncertaintyIsThatOfTheCurveAboutItsMiddle) {
    int compared = 0;
    for (const Far& far : places()) {
        SCOPED_TRACE("degree " + std::to_string(far.degree) + ", x " + test::digits(far.centre) + " by " +
                     test::digits(far.step));
        Far near = far;
        near.centre = 0.0;
        const BudgetOutputResult expected = test::first_result(predicted(near));
        try {
            const BudgetResult result = evaluate_budget(predicted(far), 1);
            const double relative = 1e-15 * result.fits[0].condition_number + 1e-12;
            const BudgetOutputResult& output = result.points[0].outputs[0];
            EXPECT_NEAR(output.standard_uncertainty / expected.standard_uncertainty, 1.0, relative);
            EXPECT_LT(relative, 2e-3);
            // The fit is all that the result depends on: its row is u².
            const Propagation& propagation = result.points[0].propagation;
            double sum = 0.0;
            for (const BudgetContribution& row : propagation.budget) {
                sum += row.variance(0);
            }
            EXPECT_DOUBLE_EQ(std::sqrt(sum), output.standard_uncertainty);
            EXPECT_NEAR(
                (result.fits[0].factor.transpose() * propagation.jacobian.rightCols(far.degree + 1).transpose()).norm(),
                output.standard_uncertainty, relative * output.standard_uncertainty);
            ++compared;
        } catch (const NoResultError& refused) {
            EXPECT_EQ(refused.diagnostics().front().code, "GC-FIT-0010") << "refused, never wrong";
        }
    }
    EXPECT_GT(compared, 50);
}

TEST(FitFarFromZero, TrialsAreDrawnFromTheSameCurve) {
    for (const bool scaled : {false, true}) {
        Budget far = predicted({.degree = 2, .centre = 1550.0, .step = 0.015625, .scaled = scaled});
        far.coverage = CoverageChoice::monte_carlo;
        far.monte_carlo.emplace().trials = 20000;
        const BudgetOutputResult output = test::first_result(far);
        const double nu = 4.0;
        const double wider = scaled ? std::sqrt(nu / (nu - 2.0)) : 1.0;  // standard deviation of a t-distribution
        ASSERT_TRUE(output.monte_carlo);
        EXPECT_NEAR(output.monte_carlo->standard_uncertainty, wider * output.standard_uncertainty,
                    0.2 * output.standard_uncertainty);
    }
}

// Exact least squares in fractions: U = 1.96 u = 0.123 for six points from 1550.10 to 1550.20 with u(y) = 0.1.
TEST(FitFarFromZero, QuadraticOfWavelengths) {
    Budget of = predicted({.degree = 2, .centre = 1550.0, .step = 1.0, .scaled = false});
    of.inputs = {input("q", state_constant(1550.15))};
    of.coverage_probability = 0.95;
    BudgetFit& fit = of.fits[0];
    fit.x.resize(6, 1);
    fit.x << 1550.10, 1550.12, 1550.14, 1550.16, 1550.18, 1550.20;
    fit.y.resize(6);
    fit.y << 1.2, 1.5, 1.9, 2.1, 2.6, 2.9;
    fit.y_uncertainty = Eigen::MatrixXd::Constant(6, 1, 0.1);
    EXPECT_NEAR(test::first_result(of).expanded_uncertainty.value_or(0.0), 0.123, 0.0005);
}

}  // namespace
}  // namespace gumcert::gum
