#include "reports/record/make/budget/budget_reported_result.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "gum/monte_carlo/monte_carlo.h"
#include "reports/record/reported_result.h"

namespace gumcert::reports {

namespace {

/// As many digits as were asked for, or as the error leaves; two of a number that begins with 1 or 2, of which one digit
/// would leave too little: 14 is not 10.
int held_digits_of(double number, double error, int asked) {
    constexpr double k_least_of_one_digit = 2.95;
    if (!(number > 0.0)) {
        return asked;
    }
    const double unit = 2.0 * gum::numerical_tolerance(number, 1);
    const bool one = asked == 1 || gum::numerical_tolerance(number, 2) < error;
    return one && number >= k_least_of_one_digit * unit ? 1 : 2;
}

}  // namespace

double recorded_value(double si, double rounding, const gum::Unit& unit) {
    // BudgetModel::rounding() counts one rounding of every input and step; the inputs themselves are means and converted
    // numbers, and the result is converted once more.
    constexpr double k_roundings = 8.0;
    const double lost = k_roundings * rounding + std::numeric_limits<double>::epsilon() * std::abs(si);
    return gum::settled_decimal(unit.from_si(si), unit.difference_from_si(lost));
}

reports::ReportedResult reported_of(const gum::BudgetOutputResult& output, double y, const gum::Unit& unit,
                                    const gum::Budget& budget) {
    reports::ReportedResult reported;
    reports::ReportedRounding printed{.digits = 2, .rounding = budget.rounding};
    if (output.by_monte_carlo) {
        const gum::MonteCarloOutput& trials = *output.monte_carlo;
        const std::array<double, 2> interval{unit.from_si(trials.symmetric.low), unit.from_si(trials.symmetric.high)};
        const int asked = budget.monte_carlo ? budget.monte_carlo->digits : printed.digits;
        const gum::NumericalError& error = trials.numerical_error;
        const double ends = std::max(error.symmetric.low, error.symmetric.high);
        const double half_width = 0.5 * (interval[1] - interval[0]);
        const double mean = output.has_u ? unit.from_si(trials.mean) : y;
        printed.value_error = output.has_u ? unit.difference_from_si(error.mean) : 0.0;
        // Beside U the value ends where U does, hence U where the value is held.
        const bool as_one = half_width > 0.0 && reports::is_symmetric_as_printed(mean, interval);
        printed.digits = held_digits_of(
            half_width, std::max(unit.difference_from_si(ends), as_one ? printed.value_error : 0.0), asked);
        if (printed.digits == 1) {
            printed.rounding = gum::RoundingMode::up;  // half a unit is up to a sixth of U: never less than it is
        }
        printed.digits_of_u = held_digits_of(unit.difference_from_si(trials.standard_uncertainty),
                                             unit.difference_from_si(error.standard_uncertainty), asked);
        reported = reports::monte_carlo_result(
            mean,
            output.has_u ? std::optional<double>(unit.difference_from_si(trials.standard_uncertainty)) : std::nullopt,
            interval, output.coverage_probability, output.because);
    } else {
        const auto difference = [&](const std::optional<double>& of) {
            return of ? std::optional<double>(unit.difference_from_si(*of)) : std::nullopt;
        };
        reported = reports::law_of_propagation_result(y, unit.difference_from_si(output.standard_uncertainty),
                                                      difference(output.expanded_uncertainty), output.coverage_factor,
                                                      output.coverage_probability);
        reported.against = output.against;
    }
    reports::print_reported(reported, unit.text(), printed);
    return reported;
}

}  // namespace gumcert::reports
