#pragma once

#include <cstddef>

#include "gum/budget/evaluate_budget.h"

namespace gumcert::gum {

/// Expanded uncertainty of a result of Monte Carlo about its value: the smallest U with which value ± U holds the share
/// p of its trials, coherent SI.
///
/// A coverage interval of trials need not lie symmetric about the value (JCGM 101:2008, 7.7). What takes U alone, as a
/// score does, then takes this one: it covers p about the value, which half the width of the interval does not.
/// \param output  position in point.outputs; with Monte Carlo and a mean
[[nodiscard]] double expanded_about_value(const BudgetPointResult& point, std::size_t output, double p);

}  // namespace gumcert::gum
