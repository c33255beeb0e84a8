#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gum/propagation.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

/// How far a model is from its tangent over the uncertainties of its inputs, for one output, in terms of the U of the
/// law of propagation and of its u.
struct LinearityCheck {
    bool adequate = true;
    double end_deviation =
        0.0;              ///< larger of |f − tangent| at the two points where the tangent gives y ± U, [unit of y]
    double spread = 0.0;  ///< root mean square of f − y at the probes, [unit of y]
    /// An angle that leaps by full turns within the uncertainties, as atan2 does at ±180°; all else is said of the angle on
    /// the turn of the tangent.
    bool leaps = false;
};

/// Probes a model at points near its estimates, and compares with the tangent: what second derivatives at one point
/// cannot see (a kink inside of ±U, an inflection, x³ at 0, terms of the third and fourth order) is seen there.
///
/// Points: x ± V c/u and x ± k V c/u of every output, where the tangent changes by u and by U and a normal distribution
/// is densest; and 64 pairs x ± δ with all inputs off at once, each by a fixed pseudo-random number between −√3 u and
/// √3 u. Bounded inputs stay inside of their limits. Adequate: at the first ones |f − tangent| is at most 5 % of U; at
/// the pairs its mean is at most 0.15 u, its root mean square 0.35 u, and the dispersion of f within 8 % of that of the
/// tangent. 2048 more points, as the inputs scatter: the ends of the symmetric interval of f there are within 5 % of U
/// of those of the tangent at the same points. The choice is ours (docs/adr/0024): 5 % of U is what two digits of U
/// show. Rounding is allowed for. A probe where the model has no value counts at the ends only: U reaches outside its
/// domain.
/// \param coverage_factor  k of each output; none: 2
/// \return one an output
[[nodiscard]] std::vector<LinearityCheck> check_linearity(const MeasurementModel& model, const Propagation& propagation,
                                                          std::span<const std::optional<double>> coverage_factor);

/// Skewness of an output as its tangent gives it: Σ c³ γ u³ / u³(y) over the inputs of their own, each with the
/// skewness γ of its distribution. Infinite where an input has none.
[[nodiscard]] double linear_skewness(const MeasurementModel& model, const Propagation& propagation,
                                     Eigen::Index output);

}  // namespace gumcert::gum
