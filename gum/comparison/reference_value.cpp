#include "gum/comparison/reference_value.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "gum/argument_check.h"
#include "gum/comparison/correlated_results.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/golden_section.h"
#include "gum/quantity/special_values.h"
#include "gum/weighted_t_square.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

using Eigen::Index;

constexpr double k_diagonal_tolerance = 1e-9;            // of u², for a covariance that was written with some digits
constexpr double k_computed_symmetry_tolerance = 1e-12;  // of u_i u_j, for a covariance that was computed
constexpr double k_smallest_reciprocal_condition = 1e-12;
constexpr double k_largest_magnitude = 1e150;  // of what is squared

std::string name_of(Index i) {
    return "result " + std::to_string(i + 1);
}

/// Collects the problems of results, so that all of them reach the user at once.
class Problems {
public:
    void add(std::string code, std::string where, std::string what, std::string rule, std::string action) {
        list_.push_back(Diagnostic{.code = std::move(code),
                                   .where = std::move(where),
                                   .what = std::move(what),
                                   .rule = std::move(rule),
                                   .action = std::move(action)});
    }
    void throw_if_any() const {
        if (!list_.empty()) {
            throw InputError(list_);
        }
    }

private:
    std::vector<Diagnostic> list_;
};

void check_values(const LaboratoryResults& results, Problems& problems) {
    for (Index i = 0; i < results.x.size(); ++i) {
        if (!std::isfinite(results.x(i))) {
            problems.add("GC-GUM-0001", name_of(i), "value " + text::shortest(results.x(i)), "must be a finite number",
                         "Correct the value, or leave the laboratory out.");
        }
        const double u = results.u(i);
        // 1e300, the square of 1e150, is still a number, and so is its inverse.
        if (std::abs(results.x(i)) > k_largest_magnitude || u > k_largest_magnitude ||
            (u > 0.0 && u < 1.0 / k_largest_magnitude)) {
            problems.add("GC-GUM-0142", name_of(i),
                         "value " + text::shortest(results.x(i)) + ", standard uncertainty " + text::shortest(u),
                         "magnitudes from 1e-150 to 1e+150 can be squared", "State the results in another unit.");
        }
        if (!std::isfinite(u)) {
            problems.add("GC-GUM-0001", name_of(i), "standard uncertainty " + text::shortest(u),
                         "must be a finite number", "Correct the uncertainty, or leave the laboratory out.");
        } else if (u <= 0.0) {
            problems.add("GC-GUM-0003", name_of(i), "standard uncertainty " + text::shortest(u),
                         "must be greater than 0", "Ask the laboratory for its uncertainty, or leave it out.");
        }
    }
}

void check_elements(const LaboratoryResults& results, Problems& problems) {
    const Eigen::MatrixXd& V = results.covariance;
    for (Index j = 0; j < V.cols(); ++j) {
        const double variance = results.u(j) * results.u(j);
        if (std::abs(V(j, j) - variance) > k_diagonal_tolerance * variance) {
            problems.add("GC-GUM-0143", "covariance of the results",
                         "variance of " + name_of(j) + " is " + text::shortest(V(j, j)) +
                             " for a standard uncertainty " + text::shortest(results.u(j)),
                         "the diagonal holds the squares of the standard uncertainties", "Correct one of the two.");
        }
        for (Index i = j + 1; i < V.rows(); ++i) {
            const double scale = results.u(i) * results.u(j);
            const std::string pair = "of " + name_of(j) + " and " + name_of(i);
            if (std::abs(V(i, j) - V(j, i)) > k_computed_symmetry_tolerance * scale) {
                problems.add("GC-GUM-0052", "covariance of the results",
                             "element " + pair + " is " + text::shortest(V(i, j)) + " below and " +
                                 text::shortest(V(j, i)) + " above the diagonal",
                             "a covariance matrix is symmetric", "Correct the covariance.");
            } else if (std::abs(V(i, j)) > (1.0 + k_diagonal_tolerance) * scale) {
                problems.add("GC-GUM-0053", "covariance of the results",
                             "element " + pair + " is " + text::shortest(V(i, j)) + ", a correlation of " +
                                 text::shortest(V(i, j) / scale),
                             "a correlation coefficient lies between -1 and 1", "Correct the correlation.");
            }
        }
    }
}

void check_semidefinite(const LaboratoryResults& results, Problems& problems) {
    const Eigen::MatrixXd R = correlations_of(results);
    if (Eigen::LLT<Eigen::MatrixXd>(R).info() == Eigen::Success) {
        return;  // at a thirtieth of the cost of the eigenvalues
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(R, Eigen::EigenvaluesOnly);
    const double smallest = eigen.eigenvalues()(0);
    // Two limits, the larger one counts: rounding of the eigenvalues, which grows with n, and the digits of a matrix
    // that was written to a file. A singular R (r = 1) is a covariance.
    const double tolerance = 10.0 * static_cast<double>(R.rows()) * k_epsilon;
    if (!(smallest >= -std::max(tolerance, k_diagonal_tolerance) * eigen.eigenvalues().tail(1)(0))) {
        problems.add("GC-GUM-0054", "covariance of the results",
                     "smallest eigenvalue of the correlation matrix is " + text::shortest(smallest),
                     "a covariance matrix is positive semi-definite",
                     "Correct the correlations; they contradict each other.");
    }
}

/// Values less that of the most precise result, in units of its u; 1/u in the same unit.
struct CentredResults {
    double centre = 0.0, unit = 0.0;
    Eigen::VectorXd x = {};        // (x_i − centre) / unit
    Eigen::VectorXd inverse = {};  // unit / u_i, at most 1
};

CentredResults centred(const LaboratoryResults& results) {
    // A common value is taken off and the smallest u is the unit: squares stay in the range of numbers, and a mean far
    // from 0 costs no digits.
    const Index precise = most_precise(results);
    CentredResults c{.centre = results.x(precise), .unit = results.u(precise)};
    c.x = (results.x.array() - c.centre) / c.unit;
    c.inverse = c.unit / results.u.array();
    return c;
}

/// Weighted mean relative to the centre, in the unit of CentredResults, and the chi-square about it.
struct LeastSquares {
    double value = 0.0, u = 0.0;
    Eigen::VectorXd weights;
    double chi_square = 0.0;
};

LeastSquares independent_least_squares(const CentredResults& c) {
    LeastSquares fit;
    fit.weights = c.inverse.array().square();
    const double total = fit.weights.sum();
    fit.weights /= total;
    fit.u = 1.0 / std::sqrt(total);
    fit.value = fit.weights.dot(c.x);
    fit.chi_square = ((c.x.array() - fit.value) * c.inverse.array()).square().sum();
    return fit;
}

LeastSquares correlated_least_squares(const LaboratoryResults& results, const CentredResults& c) {
    const Eigen::MatrixXd R = correlations_of(results);
    const Eigen::LLT<Eigen::MatrixXd> cholesky(R);
    // On the correlation matrix, so that laboratories of very different u are judged alike. Results that are fully
    // correlated give weights without meaning, large and of both signs.
    const double reciprocal_condition = cholesky.info() == Eigen::Success ? cholesky.rcond() : 0.0;
    if (!(reciprocal_condition >= k_smallest_reciprocal_condition)) {
        throw NoResultError(Diagnostic{
            .code = "GC-GUM-0132",
            .where = "covariance of the results",
            .what = "singular: the reciprocal condition number of the correlation matrix is " +
                    text::shortest(reciprocal_condition),
            .rule = "the weighted mean of correlated results needs the inverse of their covariance",
            .action = "Leave out one of the results that are fully correlated, or correct the correlations."});
    }
    LeastSquares fit;
    const Eigen::VectorXd solved = cholesky.solve(c.inverse);
    const double total = c.inverse.dot(solved);
    // w = V⁻¹1/(1ᵀV⁻¹1) with V = D R D: the weighted mean of correlated results.
    fit.weights = c.inverse.array() * solved.array() / total;
    fit.u = 1.0 / std::sqrt(total);
    fit.value = fit.weights.dot(c.x);
    const Eigen::VectorXd residuals = (c.x.array() - fit.value) * c.inverse.array();
    fit.chi_square = cholesky.matrixL().solve(residuals).squaredNorm();
    return fit;
}

LeastSquares least_squares(const LaboratoryResults& results, const CentredResults& c) {
    return results.covariance.size() == 0 ? independent_least_squares(c) : correlated_least_squares(results, c);
}

bool has_finite_degrees(const LaboratoryResults& results) {
    return results.degrees_of_freedom.size() != 0 && !results.degrees_of_freedom.array().isInf().all();
}

/// Σ z² of results that have t distributions about one value, z the normal quantity with the same tail.
class NormalScores {
public:
    explicit NormalScores(const LaboratoryResults& results) : c_(centred(results)), nu_(results.degrees_of_freedom) {
        // In the order of the values: the order in which they are listed must not decide the last digit of a sum.
        for (Index i = 0; i < c_.x.size(); ++i) {
            order_.push_back(i);
        }
        std::sort(order_.begin(), order_.end(), [&](Index a, Index b) {
            return std::tuple(c_.x(a), c_.inverse(a), nu_(a)) < std::tuple(c_.x(b), c_.inverse(b), nu_(b));
        });
    }

    /// u of every result that gives its z at the best value.
    [[nodiscard]] Eigen::VectorXd u_of_normal() const {
        constexpr double k_least_t = 1e-3;  // t/z is level there, and 0/0 at 0
        const double y = best();
        Eigen::VectorXd u(c_.x.size());
        for (Index i = 0; i < u.size(); ++i) {
            const double t = std::max(k_least_t, std::abs((c_.x(i) - y) * c_.inverse(i)));
            u(i) = c_.unit / c_.inverse(i) * (t / normal_score(t, nu_(i)));
        }
        return u;
    }

private:
    [[nodiscard]] double sum_at(double y) const {
        double sum = 0.0;
        for (const Index i : order_) {
            const double z = normal_score((c_.x(i) - y) * c_.inverse(i), nu_(i));
            sum += z * z;
        }
        return sum;
    }

    /// The y with the least sum. There may be a minimum near every value, so that values are tried first.
    [[nodiscard]] double best() const {
        constexpr std::size_t k_most_tried = 64;
        std::vector<double> tried;
        const std::size_t step = order_.size() / k_most_tried + 1;
        for (std::size_t i = 0; i < order_.size(); i += step) {
            tried.push_back(c_.x(order_[i]));
        }
        tried.push_back(c_.x(order_.back()));
        tried.push_back(independent_least_squares(c_).value);
        std::sort(tried.begin(), tried.end());
        std::size_t at = 0;
        double least = k_infinity;
        for (std::size_t i = 0; i < tried.size(); ++i) {
            if (const double sum = sum_at(tried[i]); sum < least) {
                least = sum;
                at = i;
            }
        }
        constexpr int k_steps = 48;
        return least_by_golden_section([this](double x) { return sum_at(x); }, tried[at == 0 ? 0 : at - 1],
                                       tried[std::min(at + 1, tried.size() - 1)], k_steps);
    }

    CentredResults c_;
    const Eigen::VectorXd& nu_;
    std::vector<Index> order_;
};

}  // namespace

SplitNumber split_sum(double a, double b) {
    const double sum = a + b;
    const double of_b = sum - a;
    return {sum, (a - (sum - of_b)) + (b - of_b)};
}

Eigen::Index most_precise(const LaboratoryResults& results) {
    Index precise = 0;
    results.u.minCoeff(&precise);
    return precise;
}

Eigen::MatrixXd correlations_of(const LaboratoryResults& results) {
    const Eigen::VectorXd inverse = results.u.cwiseInverse();
    Eigen::MatrixXd R = inverse.asDiagonal() * results.covariance * inverse.asDiagonal();
    // Written digits may take |r| above 1 and the diagonal off 1 by the tolerance that require_results() allows; what
    // is built on R must not see that.
    R = (0.5 * (R + R.transpose())).cwiseMin(1.0).cwiseMax(-1.0).eval();
    R.diagonal().setOnes();
    return R;
}

Eigen::MatrixXd root_of_correlations(const Eigen::MatrixXd& correlations) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky(correlations);
    if (cholesky.info() == Eigen::Success) {
        return cholesky.matrixL();
    }
    // Laboratories that share everything, r = 1, stop Cholesky. The root of the eigenvalues exists all the same; those
    // that rounding makes negative are 0.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlations);
    return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

void require_results(const LaboratoryResults& results, std::size_t fewest) {
    const Index n = results.x.size();
    if (results.u.size() != n) {
        refuse("GC-GUM-0135", "results",
               text::count_of(n, "value") + " and " + std::to_string(results.u.size()) + " standard uncertainties",
               "every value has one standard uncertainty", "Give both for every result.");
    }
    if (n < static_cast<Index>(fewest)) {
        refuse("GC-GUM-0131", "results", "only " + std::to_string(n),
               "a comparison needs at least " + std::to_string(fewest), "Give the results of more laboratories.");
    }
    Problems problems;
    check_values(results, problems);
    const Eigen::MatrixXd& V = results.covariance;
    if (V.size() != 0 && (V.rows() != n || V.cols() != n)) {
        problems.add("GC-GUM-0135", "covariance of the results",
                     text::count_of(V.rows(), "row") + " and " + text::count_of(V.cols(), "column") + " for " +
                         text::count_of(n, "result"),
                     "one row and one column for every result", "Correct the covariance.");
    } else if (!V.allFinite()) {
        problems.add("GC-GUM-0001", "covariance of the results", "a number that is not finite",
                     "must be finite numbers", "Correct the covariance.");
    }
    problems.throw_if_any();
    const double largest = std::max(results.x.maxCoeff() - results.x.minCoeff(), results.u.maxCoeff());
    if (largest / results.u.minCoeff() > k_largest_magnitude) {
        refuse(
            "GC-GUM-0142", "results",
            "range " + text::shortest(largest) + " with a standard uncertainty " + text::shortest(results.u.minCoeff()),
            "magnitudes up to 1e+150 times the smallest uncertainty can be squared", "Correct the uncertainty.");
    }
    if (V.size() != 0) {
        check_elements(results, problems);
        problems.throw_if_any();
        check_semidefinite(results, problems);
        problems.throw_if_any();
    }
}

void require_results(const LaboratoryResults& results) {
    require_results(results, 2);
}

LaboratoryResults as_normal_results(const LaboratoryResults& results) {
    LaboratoryResults normal = results;
    if (!has_finite_degrees(results)) {
        normal.degrees_of_freedom.resize(0);
    } else if (results.covariance.size() == 0) {
        normal.u = NormalScores(results).u_of_normal();
        normal.degrees_of_freedom.resize(0);
    } else {
        // Of one estimate that makes χ² vary as estimates with these ν do that are all wrong together.
        const double mean = results.degrees_of_freedom.cwiseInverse().cwiseSqrt().mean();
        normal.degrees_of_freedom.setConstant(1.0 / (mean * mean));
    }
    return normal;
}

double critical_chi_square(std::size_t results, double alpha, double degrees_of_freedom) {
    const std::size_t of_chi_square = results - 1;
    using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;  // ADR 0058
    const boost::math::chi_squared_distribution<double, InDouble> distribution(static_cast<double>(of_chi_square));
    const double critical = boost::math::quantile(boost::math::complement(distribution, alpha));
    return std::isinf(degrees_of_freedom)
               ? critical
               : std::max(critical,
                          common_t_quantile(std::vector<double>(of_chi_square, 1.0), degrees_of_freedom, 1.0 - alpha));
}

double ItemUncertainty::total() const {
    return std::hypot(between, drift);
}

LaboratoryResults with_items(const LaboratoryResults& results, const ItemUncertainty& items) {
    const double of_items = items.total();
    LaboratoryResults whole = results;
    if (!(of_items > 0.0)) {
        return whole;
    }
    if (std::isfinite(items.degrees_of_freedom) && whole.degrees_of_freedom.size() == 0) {
        whole.degrees_of_freedom = Eigen::VectorXd::Constant(whole.x.size(), k_infinity);
    }
    for (Index i = 0; i < whole.x.size(); ++i) {
        whole.u(i) = std::hypot(results.u(i), of_items);
        if (whole.degrees_of_freedom.size() != 0) {
            const double nu = results.degrees_of_freedom.size() == 0 ? k_infinity : results.degrees_of_freedom(i);
            const std::vector<UncertaintyContribution> parts = {
                {results.u(i), nu}, {items.between, items.degrees_of_freedom}, {items.drift}};
            whole.degrees_of_freedom(i) = effective_degrees_of_freedom(parts);
        }
        if (whole.covariance.size() != 0) {
            whole.covariance(i, i) = whole.u(i) * whole.u(i);
        }
    }
    return whole;
}

LaboratoryResults selected_results(const LaboratoryResults& results, const std::vector<std::size_t>& members) {
    const auto size = static_cast<Index>(members.size());
    const bool correlated = results.covariance.size() != 0;
    LaboratoryResults selected{.x = Eigen::VectorXd(size),
                               .u = Eigen::VectorXd(size),
                               .covariance = correlated ? Eigen::MatrixXd(size, size) : Eigen::MatrixXd()};
    const bool finite = results.degrees_of_freedom.size() != 0;
    selected.degrees_of_freedom.resize(finite ? size : 0);
    for (Index i = 0; i < size; ++i) {
        const auto from = static_cast<Index>(members[static_cast<std::size_t>(i)]);
        selected.x(i) = results.x(from);
        selected.u(i) = results.u(from);
        if (finite) {
            selected.degrees_of_freedom(i) = results.degrees_of_freedom(from);
        }
        for (Index j = 0; correlated && j < size; ++j) {
            selected.covariance(i, j) =
                results.covariance(from, static_cast<Index>(members[static_cast<std::size_t>(j)]));
        }
    }
    return selected;
}

ReferenceValue spread_weights(ReferenceValue reference, const std::vector<std::size_t>& members, std::size_t results) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Index>(results));
    for (std::size_t i = 0; i < members.size(); ++i) {
        weights(static_cast<Index>(members[i])) = reference.weights(static_cast<Index>(i));
    }
    reference.weights = std::move(weights);
    return reference;
}

ReferenceValue weighted_mean(const LaboratoryResults& results) {
    require_results(results);
    const CentredResults c = centred(results);
    LeastSquares fit = least_squares(results, c);
    const SplitNumber mean = split_sum(c.centre, c.unit * fit.value);
    return {.value = mean.value, .u = c.unit * fit.u, .weights = std::move(fit.weights), .rest = mean.rest};
}

ReferenceValue arithmetic_mean(const Eigen::VectorXd& x) {
    const Index n = x.size();
    if (n < 2) {
        refuse("GC-GUM-0131", "results", "only " + std::to_string(n), "a standard deviation needs at least 2",
               "Give the results of more laboratories.");
    }
    for (Index i = 0; i < n; ++i) {
        require_finite(x(i), name_of(i));
    }
    const auto count = static_cast<double>(n);
    // Any of the results will do as origin, for there are no uncertainties here to choose by.
    const double centre = x(0);
    Eigen::ArrayXd from_centre = x.array() - centre;
    const double range = from_centre.abs().maxCoeff();
    require_finite(range, "range of the results");
    const double unit = range > 0.0 ? std::scalbn(1.0, std::ilogb(range)) : 1.0;  // a power of 2: no rounding
    from_centre /= unit;
    const double mean = from_centre.mean();
    const double sum_of_squares = (from_centre - mean).square().sum();
    const SplitNumber value = split_sum(centre, unit * mean);
    return {.value = value.value,
            .u = unit * std::sqrt(sum_of_squares / ((count - 1.0) * count)),
            .weights = Eigen::VectorXd::Constant(n, 1.0 / count),
            .rest = value.rest};
}

ConsistencyTest consistency_test(const LaboratoryResults& results, double alpha) {
    require_results(results);
    require_probability(alpha, "alpha of the consistency test");
    const LaboratoryResults normal = as_normal_results(results);
    ConsistencyTest test;
    test.chi_square = least_squares(normal, centred(normal)).chi_square;
    test.degrees_of_freedom = static_cast<std::size_t>(results.x.size()) - 1;
    const auto nu = static_cast<double>(test.degrees_of_freedom);
    const double of_estimate = normal.degrees_of_freedom.size() == 0 ? k_infinity : normal.degrees_of_freedom(0);
    test.critical_value = critical_chi_square(test.degrees_of_freedom + 1, alpha, of_estimate);
    test.p_value = chi_square_upper_tail(test.chi_square, nu);
    if (std::isfinite(of_estimate)) {
        test.p_value = std::max(test.p_value, common_t_upper_tail(std::vector<double>(test.degrees_of_freedom, 1.0),
                                                                  of_estimate, test.chi_square));
    }
    test.consistent = test.chi_square <= test.critical_value;
    // χ²/ν has the mean 1 and the standard deviation √(2/ν): the limit stands two of these above 1, √(1 + 2 √(2/ν)). No
    // uncertainty is multiplied by the ratio.
    test.birge_ratio = std::sqrt(test.chi_square / nu);
    test.birge_limit = std::sqrt(1.0 + std::sqrt(8.0 / nu));
    test.of_finite_degrees = has_finite_degrees(results);
    return test;
}

ConsistencyTest consistency_test(const LaboratoryResults& results, const ItemUncertainty& items, double alpha) {
    require_results(results);
    if (!(items.total() > 0.0)) {
        return consistency_test(results, alpha);
    }
    ItemUncertainty known = items;
    known.degrees_of_freedom = k_infinity;
    const LaboratoryResults whole = with_items(results, known);
    ConsistencyTest test = consistency_test(whole, alpha);
    const double part = (items.between / whole.u.array()).square().mean();
    const double of_estimate = items.degrees_of_freedom / (part * part);
    if (part > 0.0 && std::isfinite(of_estimate)) {
        test.critical_value =
            std::max(test.critical_value, critical_chi_square(test.degrees_of_freedom + 1, alpha, of_estimate));
        test.p_value = std::max(test.p_value, common_t_upper_tail(std::vector<double>(test.degrees_of_freedom, 1.0),
                                                                  of_estimate, test.chi_square));
        test.consistent = test.chi_square <= test.critical_value;
    }
    return test;
}

PairDifference pair_difference(const LaboratoryResults& results, std::size_t i, std::size_t j) {
    const auto n = static_cast<std::size_t>(results.x.size());
    if (i >= n || j >= n || i == j) {
        refuse("GC-GUM-0135", "pair of results",
               std::to_string(i + 1) + " and " + std::to_string(j + 1) + " of " + std::to_string(n),
               "a pair is two different results", "Correct the pair.");
    }
    const auto a = static_cast<Index>(i);
    const auto b = static_cast<Index>(j);
    const double u_a = results.u(a);
    const double u_b = results.u(b);
    const double r =
        results.covariance.size() == 0 ? 0.0 : std::clamp(results.covariance(a, b) / (u_a * u_b), -1.0, 1.0);
    const double gap = u_a - u_b;  // as uncertainty_of_difference(): nothing cancels where r is close to 1
    const double u = r == 0.0 ? std::hypot(u_a, u_b) : std::sqrt(gap * gap + 2.0 * (1.0 - r) * u_a * u_b);
    return {.d = results.x(a) - results.x(b), .u = u};
}

std::size_t incompatible_pairs(const LaboratoryResults& results, double kappa) {
    require_results(results);
    require_positive(kappa, "kappa");
    const Index n = results.x.size();
    const double unit = results.u.maxCoeff();
    const Eigen::ArrayXd u = results.u.array() / unit;
    std::size_t pairs = 0;
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < i; ++j) {
            double variance = u(i) * u(i) + u(j) * u(j);
            if (results.covariance.size() != 0) {
                const double u_d = pair_difference(results, static_cast<std::size_t>(i), static_cast<std::size_t>(j)).u;
                variance = (u_d / unit) * (u_d / unit);
            }
            // Values that are stated to be κ u apart are compatible, however their binary numbers round.
            const double rounding = 2.0 * k_epsilon * std::max(std::abs(results.x(i)), std::abs(results.x(j)));
            const double d = std::max(0.0, std::abs(results.x(i) - results.x(j)) - rounding) / unit;
            pairs += d * d > kappa * kappa * variance ? 1 : 0;
        }
    }
    return pairs;
}

}  // namespace gumcert::gum
