#pragma once

#include <optional>

#include "gum/conformity/tolerance_limits.h"

namespace gumcert::gum {

// Risks of a population of items, before any of them is measured. All numbers of one call are in one unit.

struct GlobalRisk {
    double false_accept = 0.0;              ///< accepted and bad, unconditional
    double false_reject = 0.0;              ///< rejected and good, unconditional
    double conditional_false_accept = 0.0;  ///< bad among the accepted; 0 where nothing is accepted
};

/// Risks of a normal population that is measured with a normal distribution.
///
/// PFA = ∫ f0(t) P(A_L ≤ y ≤ A_U | t) dt over t outside of the tolerance, PFR likewise inside   (JCGM 106:2012, 9.5)
/// \param acceptance         A_L > A_U: nothing is accepted
/// \param centre, deviation  mean and standard deviation s0 > 0 of the population
/// \param u                  standard uncertainty of the measurement, u > 0
/// \throws InputError  GC-GUM-0080 for the tolerance, GC-GUM-0001 or -0003 for another argument
/// Accuracy: relative error of each risk below 1e-11; Gauss–Legendre panels of one standard deviation of the narrower
/// distribution (docs/accuracy.md#conformity-and-global-risk).
/// Example: examples/api/conformity.cpp
[[nodiscard]] GlobalRisk global_risk(const ToleranceLimits& tolerance, const ToleranceLimits& acceptance, double centre,
                                     double deviation, double u);

/// The largest false accept probability over all normal populations that are centred between two-sided limits, whatever
/// their deviation: what holds where nothing is known about the items.
[[nodiscard]] double largest_false_accept(const ToleranceLimits& tolerance, const ToleranceLimits& acceptance,
                                          double u);

/// s0 = T / Φ⁻¹((1 + EOPR)/2) of a centred population with symmetric limits.
/// \param half_tolerance  T > 0
/// \param reliability     EOPR, the probability that an item is inside its tolerance, 0 … 1
[[nodiscard]] double population_deviation(double half_tolerance, double reliability);

/// The same for any limits and any centre.
/// \return nothing where no deviation gives the reliability: a centre outside of the limits, or one-sided limits and a
///         reliability not above 0.5
[[nodiscard]] std::optional<double> population_deviation(const ToleranceLimits& limits, double centre,
                                                         double reliability);

/// s0² = s_observed² − u²; nothing where that is not above 0: the observed deviation is all measurement.
[[nodiscard]] std::optional<double> population_deviation_from_observed(double observed_deviation, double u);

/// The tolerance moved inwards on each side.
[[nodiscard]] ToleranceLimits guarded_limits(const ToleranceLimits& tolerance, double guard_band);

enum class FalseAccept { unconditional, conditional };

/// The smallest guard band w ≥ 0 with a false accept probability not above a limit.
/// \return nothing where no guard band is wide enough: bad items are too frequent among those that read best
[[nodiscard]] std::optional<double> guard_band_for_global_risk(const ToleranceLimits& tolerance, double centre,
                                                               double deviation, double u, double largest_risk,
                                                               FalseAccept kind);

}  // namespace gumcert::gum
