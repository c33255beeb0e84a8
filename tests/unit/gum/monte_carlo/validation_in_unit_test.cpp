#include "gum/monte_carlo/validation_in_unit.h"

#include <gtest/gtest.h>

namespace gumcert::gum {
namespace {

// Calibration of a mass standard, JCGM 101:2008, 9.3, table 6: numbers as printed, in mg; here they come in kg.
MonteCarloOutput mass_trials() {
    MonteCarloOutput trials;
    trials.symmetric = {1.0834e-6, 1.3825e-6};
    trials.numerical_error.symmetric = {1e-11, 1e-11};
    return trials;
}

Validation validated(double u, double U) {
    const auto in_mg = [](double kilograms) { return kilograms * 1e6; };
    return validation_in_unit(1.2340e-6, u, U, mass_trials(), {in_mg, in_mg}, 2);
}

TEST(ValidationInUnit, HasTheToleranceOfTheUnitThatIsPrinted) {
    const Validation first_order = validated(0.0539e-6, 0.1055e-6);
    EXPECT_NEAR(first_order.tolerance, 0.0005, 1e-15);
    EXPECT_NEAR(first_order.distance_low, 0.0451, 5e-5);
    EXPECT_NEAR(first_order.distance_high, 0.0430, 5e-5);
    EXPECT_FALSE(first_order.validated);
    EXPECT_TRUE(first_order.precise_enough);
}

// The tolerance is half a unit of a decimal digit: in inches another one than in millimetres.
TEST(ValidationInUnit, DependsOnTheUnit) {
    MonteCarloOutput trials;
    trials.symmetric = {-0.00196, 0.00196};
    trials.numerical_error.symmetric = {1e-9, 1e-9};
    const auto tolerance = [&](double metres_per_unit) {
        const auto converted = [=](double metres) { return metres / metres_per_unit; };
        return metres_per_unit * validation_in_unit(0.0, 0.00098, 0.00196, trials, {converted, converted}, 2).tolerance;
    };
    EXPECT_NEAR(tolerance(0.001), 5e-6, 1e-18);              // 0.98 mm
    EXPECT_NEAR(tolerance(0.0254), 0.0254 * 0.0005, 1e-18);  // 0.039 inches
}

}  // namespace
}  // namespace gumcert::gum
