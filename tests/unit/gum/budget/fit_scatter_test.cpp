#include "gum/budget/fit_scatter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

using test::tells;
using testing::HasSubstr;

/// A straight line V = a + b x, and a result of it.
BudgetResult on_line(const std::vector<double>& y, double u_y = 0.0, bool scaled = false) {
    Budget of = test::budget({"z = a + b*q"}, {test::input("q", state_uncertainty(2, 0.000001))});
    of.fits = {test::line(y, u_y)};
    of.fits.front().scale_by_residuals = scaled;
    return evaluate_budget(of, 1);
}

const std::vector<double> k_perfect{1, 3, 5, 7, 9};
const std::vector<double> k_nearly{1.0001, 3, 5.0001, 7, 9.0001};

TEST(FitScatter, ResidualsFarTooSmallDoNotLowerTheStatedUncertainties) {
    for (const std::vector<double>& y : {k_perfect, k_nearly}) {
        const BudgetResult scaled = on_line(y, 0.1, true);
        const BudgetResult stated = on_line(y, 0.1);
        EXPECT_EQ(scaled.fits[0].covariance, stated.fits[0].covariance);
        EXPECT_FALSE(scaled.fits[0].covariance_scaled);
        EXPECT_EQ(scaled.points[0].outputs[0].expanded_uncertainty, stated.points[0].outputs[0].expanded_uncertainty);
        EXPECT_GT(*scaled.points[0].outputs[0].expanded_uncertainty, 0.05);
        EXPECT_TRUE(tells(scaled, "GC-BUDGET-0035"));
        EXPECT_FALSE(tells(stated, "GC-BUDGET-0035"));
        EXPECT_FALSE(tells(scaled, "GC-BUDGET-0028")) << "what was fitted is not exact by definition";
    }
}

TEST(FitScatter, ResidualsThatChanceExplainsStillScale) {
    const BudgetResult result = on_line({1, 3.1, 4.9, 7.2, 8.9}, 0.2, true);
    EXPECT_TRUE(result.fits[0].covariance_scaled);
    EXPECT_FALSE(tells(result, "GC-BUDGET-0035"));
}

/// The cure that the message names is followed.
TEST(FitScatter, ResidualsOfZeroAreNoUncertainty) {
    EXPECT_TRUE(tells(on_line({0.1, 0.3, 0.5, 0.7, 0.9}), "GC-BUDGET-0036")) << "rounding only";
    EXPECT_FALSE(tells(on_line(k_perfect, 0.01), "GC-BUDGET-0036"));
    EXPECT_FALSE(tells(on_line(k_nearly), "GC-BUDGET-0036"));
    const BudgetResult perfect = on_line(k_perfect);
    const auto note = std::find_if(perfect.notes.begin(), perfect.notes.end(),
                                   [](const Diagnostic& n) { return n.code == "GC-BUDGET-0036"; });
    ASSERT_NE(note, perfect.notes.end());
    EXPECT_THAT(note->action, HasSubstr("\"u_V\""));
}

/// Where residuals are rounding, the parameters have no uncertainty, in place of one of 1e-19.
TEST(FitScatter, RoundingOfResidualsIsNoUncertaintyOfTheParameters) {
    for (const std::vector<double>& y :
         {std::vector<double>{0.1, 0.3, 0.5, 0.7, 0.9}, {2.1, 5.2, 8.3, 11.4}, k_perfect}) {
        const BudgetResult result = on_line(y);
        EXPECT_TRUE(tells(result, "GC-BUDGET-0036"));
        EXPECT_EQ(result.fits[0].covariance.cwiseAbs().maxCoeff(), 0.0);
        EXPECT_EQ(result.fits[0].factor.cwiseAbs().maxCoeff(), 0.0);
        const double slope = y[1] - y[0];  // what is left is the uncertainty of q
        EXPECT_NEAR(result.points[0].outputs[0].standard_uncertainty, slope * 1e-6, 1e-20);
    }
    EXPECT_GT(on_line(k_nearly).fits[0].covariance(0, 0), 0.0);
}

/// The cures of the warning: uncertainties that the data have, or none.
TEST(FitScatter, TheCuresOfKeptUncertaintiesHold) {
    EXPECT_FALSE(tells(on_line(k_nearly, 0.0001, true), "GC-BUDGET-0035"));
    const BudgetResult none = on_line(k_nearly);
    EXPECT_FALSE(tells(none, "GC-BUDGET-0035"));
    EXPECT_TRUE(none.fits[0].covariance_scaled);
}

// 1e12 has four digits behind the point in double precision.
TEST(FitScatter, TellsOfDigitsThatAreLost) {
    std::vector<double> far = k_nearly;
    std::for_each(far.begin(), far.end(), [](double& y) { y += 1e12; });
    EXPECT_TRUE(tells(on_line(far, 0.0001), "GC-BUDGET-0034"));
    EXPECT_FALSE(tells(on_line(far, 1.0), "GC-BUDGET-0034"));
    EXPECT_FALSE(tells(on_line(k_nearly, 0.0001), "GC-BUDGET-0034"));
}

}  // namespace
}  // namespace gumcert::gum
