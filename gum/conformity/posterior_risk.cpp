#include "gum/conformity/posterior_risk.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace gumcert::gum {

namespace {

constexpr int k_parts = 2048;
constexpr double k_no_tail = 1e-12;          // what is left out of the measurement on either side
constexpr double k_widest = 1e9;             // [u], of a distribution whose tails do not end
constexpr double k_unknown_tail = 1e-9;      // of a distribution: no model is right so far out
constexpr double k_trials_that_tell = 30.0;  // in a tail of trials
constexpr double k_least_mass = 1e-280;      // of the product: below it prior and measurement exclude each other

/// How far the measurement reaches from its value, either side alike, in terms of u.
double reach_of(const MeasuredValue& y) {
    double reach = 4.0;
    while (reach < k_widest && (distribution_function(y, y.value - reach * y.standard_uncertainty) > k_no_tail ||
                                distribution_function(y, y.value + reach * y.standard_uncertainty) < 1.0 - k_no_tail)) {
        reach *= 2.0;
    }
    return reach;
}

/// Probability of a normal distribution between two of its values, from the smaller tails: a difference of probabilities
/// near 1 has no digits left. Written out: some hundred thousand of these tails are asked for one decision, and a
/// distribution would be checked, and its kind looked for, each time.
class NormalMass {
public:
    explicit NormalMass(const Population& population) : centre_(population.centre), deviation_(population.deviation) {}

    [[nodiscard]] double tail(double x) const {
        return 0.5 * std::erfc(std::abs((x - centre_) / deviation_) / std::numbers::sqrt2);
    }
    [[nodiscard]] double between(double a, double tail_a, double b, double tail_b) const {
        if (b <= centre_) {
            return tail_b - tail_a;
        }
        return a > centre_ ? tail_a - tail_b : 1.0 - tail_a - tail_b;
    }

private:
    double centre_, deviation_;
};

}  // namespace

bool has_long_tails(const MeasuredValue& y) {
    constexpr double k_far = 16.0;
    return reach_of(y) > k_far;
}

PosteriorRisk::PosteriorRisk(const MeasuredValue& y, const ToleranceLimits& limits, const Population& population)
    : y_(y), limits_(limits), population_(population) {
    if (!y.distribution && std::isinf(y.degrees_of_freedom)) {
        return;
    }
    // Narrow parts where the density is high, wide ones in tails that do not end.
    const double most = std::asinh(reach_of(y));
    for (int i = 0; i <= k_parts; ++i) {
        offsets_.push_back(y.standard_uncertainty * std::sinh(most * (2.0 * i / k_parts - 1.0)));
        under_.push_back(probability_below(y, y.value + offsets_.back()));
    }
}

OutsideProbabilities PosteriorRisk::of_normal(double value) const {
    const double u = y_.standard_uncertainty;
    const double s0 = population_.deviation;
    const double weight = s0 * s0 / (s0 * s0 + u * u);
    // Product of two normal densities: 1/u'² = 1/s0² + 1/u², so u'² = w u² with w = s0²/(s0² + u²), and the value moves
    // towards the centre of the population by the same weight.
    const MeasuredValue after{.value = population_.centre + weight * (value - population_.centre),
                              .standard_uncertainty = u * std::sqrt(weight),
                              .expanded_uncertainty = y_.expanded_uncertainty * std::sqrt(weight)};
    const auto one_sided = [&](const ToleranceLimits& limit) { return nonconformance_probability(after, limit); };
    return {limits_.lower ? one_sided({.lower = limits_.lower}) : 0.0,
            limits_.upper ? one_sided({.upper = limits_.upper}) : 0.0};
}

PosteriorRisk::Masses PosteriorRisk::masses_at(double value) const {
    const double tail = y_.trials > 0.0 ? std::max(k_unknown_tail, k_trials_that_tell / y_.trials) : k_unknown_tail;
    const NormalMass prior(population_);
    Masses masses;
    OutsideProbabilities& outside = masses.outside;
    double a = value + offsets_.front();
    double tail_a = prior.tail(a);
    double under_a = under_.front();
    // The density of the population is its mean over a part, and that of the measurement is not needed.
    const auto add = [&](double b, double under_b) {
        const double tail_b = prior.tail(b);
        const double mass = a < b ? (under_b - under_a) * prior.between(a, tail_a, b, tail_b) / (b - a) : 0.0;
        masses.all += mass;
        masses.in_tail += under_b < tail || under_a > 1.0 - tail ? mass : 0.0;
        outside.below += limits_.lower && b <= *limits_.lower ? mass : 0.0;
        outside.above += limits_.upper && a >= *limits_.upper ? mass : 0.0;
        a = b;
        tail_a = tail_b;
        under_a = under_b;
    };
    for (std::size_t i = 1; i < offsets_.size(); ++i) {
        const double b = value + offsets_[i];
        // A limit divides its part. A value on a limit conforms: P(Y < T_L) below, P(Y ≤ T_U) inside.
        if (limits_.lower && a < *limits_.lower && *limits_.lower < b) {
            add(*limits_.lower, probability_below(y_, *limits_.lower - value + y_.value));
        }
        if (limits_.upper && a < *limits_.upper && *limits_.upper < b) {
            add(*limits_.upper, distribution_function(y_, *limits_.upper - value + y_.value));
        }
        add(b, under_[i]);
    }
    return masses;
}

bool PosteriorRisk::rests_on_tail(double value) const {
    constexpr double k_share = 0.1;
    if (offsets_.empty()) {
        return false;
    }
    const Masses masses = masses_at(value);
    return masses.all > k_least_mass && masses.in_tail > k_share * masses.all;
}

OutsideProbabilities PosteriorRisk::at(double value) const {
    if (offsets_.empty()) {
        return of_normal(value);
    }
    const Masses masses = masses_at(value);
    if (!(masses.all > k_least_mass)) {
        const bool is_below = limits_.lower && (!limits_.upper || value < 0.5 * (*limits_.lower + *limits_.upper));
        return is_below ? OutsideProbabilities{1.0, 0.0} : OutsideProbabilities{0.0, 1.0};
    }
    return {masses.outside.below / masses.all, masses.outside.above / masses.all};
}

}  // namespace gumcert::gum
