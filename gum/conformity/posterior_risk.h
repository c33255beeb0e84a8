#pragma once

#include <vector>

#include "gum/conformity/conformance_probability.h"
#include "gum/conformity/decision_rule.h"

namespace gumcert::gum {

/// Probabilities that a measurand lies below and above its tolerance.
struct OutsideProbabilities {
    double below = 0.0, above = 0.0;

    [[nodiscard]] double both() const { return below + above; }
};

/// Whether more than 1e-12 of a measurement lies beyond 16 u on one side.
[[nodiscard]] bool has_long_tails(const MeasuredValue& y);

/// What is known of an item of a normal population after its measurement: the product of the density of the population and
/// that of the measurement, over its integral (Bayes' theorem; JCGM 106:2012, clause 6).
///
/// Closed where the measurement is normal; else integrated numerically over 2048 parts, absolute error below 2e-6.
class PosteriorRisk {
public:
    /// \param y  dispersion of the measurement; must outlive this object
    PosteriorRisk(const MeasuredValue& y, const ToleranceLimits& limits, const Population& population);

    /// \param value  that a measurement with the dispersion of y shows
    /// Where population and measurement exclude each other: 1 on the side of the value.
    [[nodiscard]] OutsideProbabilities at(double value) const;
    /// Whether what is known then rests on the farthest tail of the measurement, beyond a probability of 1e-9, or of 30
    /// trials: the population lies where the measurement says next to nothing, and any answer is one of its model.
    [[nodiscard]] bool rests_on_tail(double value) const;

private:
    struct Masses {
        OutsideProbabilities outside;
        double all = 0.0, in_tail = 0.0;
    };

    [[nodiscard]] Masses masses_at(double value) const;
    [[nodiscard]] OutsideProbabilities of_normal(double value) const;

    const MeasuredValue& y_;
    ToleranceLimits limits_;
    Population population_;
    std::vector<double> offsets_;  ///< borders of the parts, from the value of the measurement; empty: it is normal
    std::vector<double> under_;    ///< P(Y − y < offset)
};

}  // namespace gumcert::gum
