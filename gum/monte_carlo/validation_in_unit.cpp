#include "gum/monte_carlo/validation_in_unit.h"

namespace gumcert::gum {

Validation validation_in_unit(double value, double u, double U, const MonteCarloOutput& output, const ToUnit& to_unit,
                              int digits) {
    // Half a unit of a decimal digit is another length in micrometres than in inches: what is validated is what is
    // printed.
    const CoverageInterval& interval = output.symmetric;
    const CoverageInterval& error = output.numerical_error.symmetric;
    return validate(to_unit.value(value), to_unit.difference(u), to_unit.difference(U),
                    {to_unit.value(interval.low), to_unit.value(interval.high)},
                    {to_unit.difference(error.low), to_unit.difference(error.high)}, digits);
}

}  // namespace gumcert::gum
