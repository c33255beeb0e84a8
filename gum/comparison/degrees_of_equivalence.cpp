#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>

#include "gum/argument_check.h"
#include "gum/comparison/correlated_results.h"
#include "gum/comparison/reference_value.h"
#include "text/counts.h"

namespace gumcert::gum {
namespace {

using Eigen::Index;

constexpr double k_rounding_of_sums = 1e-12;  // relative, of sums over some thousand results
constexpr double k_weights_rounding = 1e-9;   // of Σ w, for weights that were read from a file

void require_reference(const LaboratoryResults& results, const ReferenceValue& reference) {
    require_finite(reference.value, "reference value");
    require_not_negative(reference.u, "standard uncertainty of the reference value");
    if (reference.weights.size() != 0 && reference.weights.size() != results.x.size()) {
        refuse(
            "GC-GUM-0135", "reference value",
            text::count_of(reference.weights.size(), "weight") + " for " + text::count_of(results.x.size(), "result"),
            "one weight for every result, or none at all",
            "Spread the weights over all results, with 0 for those outside the reference value.");
    }
    for (Index i = 0; i < reference.weights.size(); ++i) {
        require_finite(reference.weights(i), "weight of result " + std::to_string(i + 1));
    }
}

/// Σ over all others, for every element: no total from which the element itself would have to be taken off again.
Eigen::VectorXd sums_of_others(const Eigen::VectorXd& terms) {
    const Index n = terms.size();
    Eigen::VectorXd others = Eigen::VectorXd::Zero(n);
    double before = 0.0;
    double after = 0.0;
    for (Index i = 0; i < n; ++i) {
        others(i) += before;
        before += terms(i);
        others(n - 1 - i) += after;
        after += terms(n - 1 - i);
    }
    return others;
}

bool sums_to_one(const Eigen::VectorXd& weights) {
    return std::abs(weights.sum() - 1.0) <= k_weights_rounding;
}

/// x − y, from differences to the result with the greatest weight where y is the weighted sum of the results: the
/// rounding of y itself, which counts where all values share many digits, stays out.
Eigen::VectorXd differences(const LaboratoryResults& results, const ReferenceValue& reference,
                            const Eigen::VectorXd& w) {
    Index heaviest = 0;
    w.cwiseAbs().maxCoeff(&heaviest);
    const double centre = results.x(heaviest);
    const Eigen::VectorXd from_centre = results.x.array() - centre;
    double value = reference.value - centre;
    if (sums_to_one(w)) {
        const double by_weights = w.dot(from_centre);
        const double rounding =
            k_rounding_of_sums * (w.cwiseAbs().dot(from_centre.cwiseAbs()) + std::abs(reference.value));
        // A value that is not the weighted sum, because it was rounded for print, say, stays as it was stated.
        if (std::abs(by_weights - value) <= rounding) {
            value = by_weights;
        }
    }
    return from_centre.array() - value;
}

/// Variances as the weights give them: of y, of every x_i − y, and the covariance of x_i with y.
struct Propagated {
    double y = 0.0;
    Eigen::VectorXd d, with_y;
};

Propagated propagate_independent(const Eigen::VectorXd& u, const Eigen::VectorXd& w) {
    const Eigen::VectorXd terms = (w.array() * u.array()).square();
    const Eigen::VectorXd rest =
        sums_to_one(w) ? sums_of_others(w) : Eigen::VectorXd(1.0 - w.array());  // 1 − w_i where it counts
    // (1 − w_i)² u_i² + Σ_j≠i w_j² u_j²: squares alone. In u_i² − 2 w_i u_i² + u²(y) nearly everything cancels where
    // one laboratory has most of the weight.
    return {.y = terms.sum(),
            .d = (rest.array() * u.array()).square() + sums_of_others(terms).array(),
            .with_y = w.array() * u.array().square()};
}

Propagated propagate_correlated(const LaboratoryResults& results, const Eigen::VectorXd& u, const Eigen::VectorXd& w) {
    // V = L Lᵀ: u²(x_i − y) is the square of row i of L less the weighted row. A sum of squares cannot become negative,
    // which u_i² − 2 cov + u²(y) can for results that correlate strongly.
    const Eigen::MatrixXd root = u.asDiagonal() * root_of_correlations(correlations_of(results));
    const Eigen::RowVectorXd of_y = w.transpose() * root;
    return {.y = of_y.squaredNorm(),
            .d = (root.rowwise() - of_y).rowwise().squaredNorm(),
            .with_y = root * of_y.transpose()};
}

}  // namespace

DegreesOfEquivalence degrees_of_equivalence(const LaboratoryResults& results, const ReferenceValue& reference) {
    require_results(results, 1);
    require_reference(results, reference);
    const Index n = results.x.size();
    const Eigen::VectorXd w = reference.weights.size() == 0 ? Eigen::VectorXd::Zero(n) : reference.weights;
    // Squares of u stay in the range of numbers then, in any unit of the item.
    const double unit = std::max(results.u.maxCoeff(), reference.u);
    const Eigen::VectorXd u = results.u / unit;
    const double u_y = reference.u / unit;
    const Propagated propagated =
        results.covariance.size() == 0 ? propagate_independent(u, w) : propagate_correlated(results, u, w);
    // What u²(y) has in addition: a variance between laboratories, say. For the weighted mean it is rounding.
    double additional = u_y * u_y - propagated.y;
    if (std::abs(additional) <= k_rounding_of_sums * propagated.y) {
        additional = 0.0;
    }
    DegreesOfEquivalence degrees{
        .d = differences(results, reference, w), .u = Eigen::VectorXd(n), .correlation = Eigen::VectorXd::Zero(n)};
    for (Index i = 0; i < n; ++i) {
        const double product = u(i) * u_y;
        const double covariance = propagated.with_y(i);
        double variance = propagated.d(i) + additional;
        if (product > 0.0) {
            degrees.correlation(i) = std::clamp(covariance / product, -1.0, 1.0);
        }
        // u(y) is smaller than the weights and the stated u_i allow. With r = ±1, the largest that can be, u²(d) is the
        // square of the difference, or of the sum, of the two uncertainties.
        if (std::abs(covariance) > (1.0 + k_rounding_of_sums) * product) {
            const double gap = product > 0.0 ? u(i) - std::copysign(u_y, covariance) : u(i);
            variance = gap * gap;
        }
        degrees.u(i) = unit * std::sqrt(std::max(variance, 0.0));
    }
    return degrees;
}

}  // namespace gumcert::gum
