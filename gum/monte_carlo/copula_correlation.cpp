#include "gum/monte_carlo/copula_correlation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "gum/distribution_quantile.h"

namespace gumcert::gum {

namespace {

constexpr Eigen::Index k_nodes = 1025;      // odd: one of them is 0, and each has its mirror image
constexpr double k_last_node = 8.2;         // P(|Z| > 8.2) is 2e-16
constexpr Eigen::Index k_polynomials = 60;  // what is left is interpolated from the ends, ρ = ±1
constexpr int k_halvings = 60;

double node(Eigen::Index i) {
    return k_last_node * (2.0 * static_cast<double>(i) / static_cast<double>(k_nodes - 1) - 1.0);
}

/// Probabilities of the nodes: the trapezoidal rule converges faster than any power of the step for smooth functions.
const Eigen::VectorXd& weights() {
    static const Eigen::VectorXd k_weights = [] {
        Eigen::VectorXd w(k_nodes);
        for (Eigen::Index i = 0; i < k_nodes; ++i) {
            w(i) = std::exp(-0.5 * node(i) * node(i));
        }
        return Eigen::VectorXd(w / w.sum());
    }();
    return k_weights;
}

/// He_k(z)/√k! at the nodes, a column a polynomial, k = 1 … K.
const Eigen::MatrixXd& polynomials() {
    static const Eigen::MatrixXd k_values = [] {
        Eigen::MatrixXd values(k_nodes, k_polynomials);
        for (Eigen::Index i = 0; i < k_nodes; ++i) {
            double before = 1.0;
            double now = node(i);
            for (Eigen::Index k = 1; k <= k_polynomials; ++k) {
                values(i, k - 1) = now;
                const auto n = static_cast<double>(k);
                const double next = (node(i) * now - std::sqrt(n) * before) / std::sqrt(n + 1.0);
                before = now;
                now = next;
            }
        }
        return values;
    }();
    return k_values;
}

}  // namespace

HermiteProfile::HermiteProfile(const Distribution& distribution) {
    if (distribution.kind == DistributionKind::student_t && !(distribution.shape > 2.0)) {
        has_correlation_ = false;
        return;
    }
    Distribution standard = distribution;
    standard.location = 0.0;
    standard.scale = 1.0;
    values_.resize(k_nodes);
    for (Eigen::Index i = 0; i < k_nodes; ++i) {
        // The nearer tail, which keeps its digits: Φ(8) is 1 in double.
        const double tail = 0.5 * std::erfc(std::abs(node(i)) / std::numbers::sqrt2);
        values_(i) = node(i) > 0.0 ? upper_quantile(standard, tail) : quantile(standard, tail);
    }
    // Mean and variance by the same rule as the sums below: a quantity then has r = 1 with itself, to rounding.
    values_.array() -= weights().dot(values_);
    values_ /= std::sqrt(weights().dot(values_.cwiseAbs2()));
    coefficients_ = polynomials().transpose() * weights().cwiseProduct(values_);
}

std::array<double, 2> HermiteProfile::attainable(const HermiteProfile& a, const HermiteProfile& b) {
    const Eigen::VectorXd weighted = weights().cwiseProduct(a.values_);
    // ρ = 1 gives both quantities one probability, ρ = −1 that of the mirrored node. Shapes that differ keep r from ±1
    // even then.
    return {std::max(-1.0, weighted.dot(b.values_.reverse())), std::min(1.0, weighted.dot(b.values_))};
}

double HermiteProfile::pearson(const HermiteProfile& a, const HermiteProfile& b, double rho) {
    const std::array<double, 2> ends = attainable(a, b);
    double sum = 0.0;
    double sum_of_even = 0.0;  // of all coefficients, for the ends
    double sum_of_odd = 0.0;
    double power = 1.0;
    for (Eigen::Index k = 0; k < k_polynomials; ++k) {
        power *= rho;
        const double product = a.coefficients_(k) * b.coefficients_(k);
        sum += product * power;
        (k % 2 == 0 ? sum_of_odd : sum_of_even) += product;
    }
    // What the series lacks at the ends belongs to higher powers: to the next one, by parity.
    const double lacking_odd = 0.5 * (ends[1] - ends[0]) - sum_of_odd;
    const double lacking_even = 0.5 * (ends[1] + ends[0]) - sum_of_even;
    return sum + power * rho * (lacking_odd + rho * lacking_even);
}

// A stated coefficient is Pearson's. Given to the normal deviates, it would come out smaller in quantities that are not
// normal (ADR 0025).
double HermiteProfile::normal_correlation(const HermiteProfile& a, const HermiteProfile& b, double r) {
    const std::array<double, 2> ends = attainable(a, b);
    // No ρ gives an r beyond these ends: it is the end itself.
    if (r == 0.0 || r <= ends[0] || r >= ends[1]) {
        return r == 0.0 ? 0.0 : r < 0.0 ? -1.0 : 1.0;
    }
    // Halving needs no derivative, which vanishes where the series does, and always ends.
    double low = -1.0;
    double high = 1.0;
    for (int step = 0; step < k_halvings; ++step) {  // Pearson's r grows with ρ
        const double middle = 0.5 * (low + high);
        (pearson(a, b, middle) < r ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace gumcert::gum
