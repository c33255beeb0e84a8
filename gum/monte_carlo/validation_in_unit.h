#pragma once

#include <functional>

#include "gum/monte_carlo/monte_carlo.h"

namespace gumcert::gum {

/// Carries a value, and a difference of values, from SI to the unit in which it is stated.
struct ToUnit {
    std::function<double(double)> value, difference;
};

/// Comparison of the law of propagation with Monte Carlo in the unit in which the result is stated, where the tolerance
/// is half a unit of a decimal digit (JCGM 101:2008, clause 8).
/// \param value, u, U  of the law of propagation, SI
/// \param digits       of u that count
/// \throws InputError  as validate()
[[nodiscard]] Validation validation_in_unit(double value, double u, double U, const MonteCarloOutput& output,
                                            const ToUnit& to_unit, int digits);

}  // namespace gumcert::gum
