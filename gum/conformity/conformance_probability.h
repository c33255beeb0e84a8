#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "gum/conformity/tolerance_limits.h"

namespace gumcert::gum {

/// Knowledge about the measurand after the measurement. All numbers in one unit.
struct MeasuredValue {
    double value = 0.0;                 ///< y
    double standard_uncertainty = 0.0;  ///< u > 0
    double expanded_uncertainty = 0.0;  ///< U > 0, for a coverage probability of about 95 %
    double degrees_of_freedom = std::numeric_limits<double>::infinity();  ///< ν > 0
    /// P(Y ≤ x) where Y is neither normal nor t-distributed, e.g. from a convolution or from Monte Carlo; empty else
    std::function<double(double)> distribution = {};
    /// P(Y < x) where single values have a probability of their own, as those of trials and samples; empty: P(Y ≤ x)
    std::function<double(double)> distribution_below = {};
    /// Trials that `distribution` counts: its probabilities scatter by their number. 0: it has no scatter
    double trials = 0.0;
    /// `distribution` tells nothing of probabilities below it; 0: it has all of them
    double least_probability = 0.0;
};

/// \throws InputError  GC-GUM-0081 if a number is out of range
void require_measured_value(const MeasuredValue& y);

/// P(Y ≤ x): `distribution` where there is one, else the t-distribution scaled by u and shifted to y, or the normal one
/// for infinite degrees of freedom.
[[nodiscard]] double distribution_function(const MeasuredValue& y, double x);

/// P(Y < x): less than P(Y ≤ x) by the probability of x itself. A limit belongs to the tolerance.
[[nodiscard]] double probability_below(const MeasuredValue& y, double x);

/// Whether a value has a probability of its own, as 0 of max(x, 0), and not by the chance of one trial.
[[nodiscard]] bool has_probability_of_its_own(const MeasuredValue& y, double x);

/// The limits without those that the quantity itself cannot pass: its distribution goes up to such a bound and not beyond, and
/// the bound has a probability of its own or is the 0 of an amount. Another value has no such distribution moved. Where hardly
/// anything lies within 0.1 u of the limit, nothing beyond it is the chance of the trials, and no bound.
[[nodiscard]] ToleranceLimits limits_that_can_be_passed(const MeasuredValue& y, const ToleranceLimits& limits);

/// p_c = P(T_L ≤ Y ≤ T_U)                                                        (JCGM 106:2012, 7.1 and 7.2)
/// \throws InputError  GC-GUM-0080 limits, GC-GUM-0081 measured value
/// Accuracy: relative error below 1e-11, also far out in a tail (docs/accuracy.md#conformity-and-global-risk).
/// Example: examples/api/conformity.cpp
[[nodiscard]] double conformance_probability(const MeasuredValue& y, const ToleranceLimits& limits);

/// 1 − p_c, added up from the two tails, so that it keeps its digits when it is small.
[[nodiscard]] double nonconformance_probability(const MeasuredValue& y, const ToleranceLimits& limits);

/// The same for a measurement with the same dispersion and another value.
[[nodiscard]] double nonconformance_probability_at(double value, const MeasuredValue& y, const ToleranceLimits& limits);

/// Limits of the measured values for which the probability of nonconformity is not above a risk.
///
/// Both tails count. Where the tolerance is wide against u, each limit is a one-sided quantile away from the tolerance
/// limit (1.645 u for a normal distribution and a risk of 5 %). Where the distribution has several peaks, the values that
/// are accepted may have gaps: the limits are then those around y, where y is accepted, else around the best value.
/// \param risk  0 < risk ≤ 0.5
/// \return nothing where no value has so small a risk
[[nodiscard]] std::optional<ToleranceLimits> acceptance_limits_for_risk(const MeasuredValue& y,
                                                                        const ToleranceLimits& limits, double risk);

/// The measured values around an accepted one, up to where a risk first crosses a level on either side.
/// \param risk  of a measured value; not above the level at `accepted`
/// \param low, high  where the search ends
/// \param tested  a value of which the risk is known to matter: no crossing between it and `accepted` is overlooked
[[nodiscard]] ToleranceLimits accepted_around(const std::function<double(double)>& risk, double level, double accepted,
                                              double low, double high, double tested);

/// Limits of the measured values beyond which nonconformity has at least a given probability: they lie outside of the
/// tolerance.
/// \param probability  0.5 < probability < 1
[[nodiscard]] ToleranceLimits rejection_limits_for_probability(const MeasuredValue& y, const ToleranceLimits& limits,
                                                               double probability);

}  // namespace gumcert::gum
