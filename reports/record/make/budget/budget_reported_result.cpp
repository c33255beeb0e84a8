#include "reports/record/make/budget/budget_reported_result.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "reports/record/reported_result.h"

namespace gumcert::reports {

double recorded_value(double si, double rounding, const gum::Unit& unit) {
    // BudgetModel::rounding() counts one rounding of every input and step; the inputs themselves are means and converted
    // numbers, and the result is converted once more.
    constexpr double k_roundings = 8.0;
    const double lost = k_roundings * rounding + std::numeric_limits<double>::epsilon() * std::abs(si);
    return gum::settled_decimal(unit.from_si(si), unit.difference_from_si(lost));
}

reports::ReportedResult reported_of(const gum::BudgetOutputResult& output, double y, const gum::Unit& unit,
                                    gum::RoundingMode rounding) {
    reports::ReportedResult reported;
    if (output.by_monte_carlo) {
        const gum::MonteCarloOutput& trials = *output.monte_carlo;
        const std::array<double, 2> interval{unit.from_si(trials.symmetric.low), unit.from_si(trials.symmetric.high)};
        reported = reports::monte_carlo_result(
            output.has_u ? unit.from_si(trials.mean) : y,
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
    reports::print_reported(reported, unit.text(), {.digits = 2, .rounding = rounding});
    return reported;
}

}  // namespace gumcert::reports
