#pragma once

#include <functional>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/variance_components.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// Codes of the messages that the distances refute the repeatability that a job gives: from above, and from below, where
/// what is given is on the safe side.
constexpr const char* k_repeatability_too_small = "GC-VARIANCE-0010";
constexpr const char* k_repeatability_too_large = "GC-VARIANCE-0011";

/// A component of the repeatability that the distances refute.
struct RefutedRepeatability {
    ComponentRow row = table_linear;
    double given = 0.0;  ///< standard deviation, [m] or [rad]
    bool larger = true;  ///< the distances give more than is given, else less than half of it
};

/// Components of the repeatability of the table that are given, or that the job says there are none of, against what the
/// distances give of them: the variance that one step of the estimate from the given weights comes to. Where the given weights are
/// true it differs from the given one by chance: a quadratic form of the residuals, which is taken for chi-square with the degrees
/// of freedom of that form, in the scale of the standard deviation of the estimate. So what the distances hardly determine is
/// refuted by nothing that they may give by chance. The level is 0.1 % of all three together. A component is refuted from above
/// where it is a quarter larger as well, what one digit of a statement stands for (JCGM 100:2008, 7.2.6), and from below where it
/// is less than half.
///
/// \param step                   estimates of the three, from the weights of `mode`
/// \param chi_square_upper_tail  by value and degrees of freedom
[[nodiscard]] std::vector<RefutedRepeatability> refuted_repeatability(
    const VarianceComponentStep& step, const TableRepeatability& given,
    const std::function<double(double, double)>& chi_square_upper_tail);

/// Whether what the estimate comes to in the end says the same as the step that refuted: a quarter larger than what is given, or
/// less than half of it. [m] or [rad]
[[nodiscard]] bool is_refuted_by(const RefutedRepeatability& refuted, double distances_give);

/// What a reader is told of it.
/// \param distances_give  what the estimate comes to in the end, [m] or [rad]
[[nodiscard]] gum::Diagnostic repeatability_note(const RefutedRepeatability& refuted, double distances_give);

}  // namespace gumcert::engine
