#include "gum/comparison/agreement.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gum/argument_check.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/propagation.h"
#include "gum/quantity/dense_factors.h"
#include "gum/weighted_t_square.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double k_stated_symmetry_tolerance = 1e-9;  // relative to √(V_ii V_jj)
constexpr double k_largest_correlation = 1.0 + 1e-9;
constexpr double k_negative_eigenvalue = 1e-8;  // relative to the largest: decimal digits of a stated matrix
constexpr double k_rank_tolerance = 1e-10;      // relative to the largest eigenvalue
constexpr double k_well_conditioned = 1e-8;     // smallest pivot of a correlation matrix that Cholesky is used for
constexpr Index k_most_points_of_eigenvectors = 500;  // their cost grows with the cube
constexpr double k_equal_factors = 1e-12;             // of coverage, relative
constexpr double k_tail_of_band = 0.025;              // 95 % between both
constexpr double k_negligible_reference = 1.0 / 3.0;
constexpr double k_rounding_of_statements = 0.05;   // of u of a point
constexpr double k_chance_of_single_points = 0.01;  // of their number, and of the largest of them

std::string point_name(Index i) {
    return "difference at point " + std::to_string(i + 1);
}

void require_sizes(const MethodDifferences& differences) {
    const Index m = differences.d.size();
    if (m == 0) {
        refuse("GC-GUM-0032", "comparison", "no points", "a summary needs at least 1 point",
               "Give the points that both sides measured.");
    }
    if (differences.covariance.rows() != m || differences.covariance.cols() != m || differences.U.size() != m ||
        differences.U_method.size() != m || differences.U_reference.size() != m ||
        (differences.degrees_of_freedom.size() > 0 && differences.degrees_of_freedom.size() != m)) {
        refuse("GC-GUM-0135", "comparison",
               "covariance " + std::to_string(differences.covariance.rows()) + " by " +
                   std::to_string(differences.covariance.cols()) + " and " +
                   text::count_of(differences.U.size(), "uncertainty") + " for " + text::count_of(m, "difference"),
               "every difference has its row, its column and its uncertainty", "Give all of them.");
    }
    // Refused, and not approximated: a χ² with the same mean and variance is wrong by many powers of ten in the lower
    // tail, and p_low is what "uncertainty too large" rests on.
    if (m > static_cast<Index>(k_most_points_of_agreement)) {
        refuse("GC-GUM-0141", "comparison", text::count_of(m, "point"),
               "the joint distribution of up to " + std::to_string(k_most_points_of_agreement) + " points is computed",
               "Split the comparison, or leave out points that lie close together.");
    }
}

void require_covariance(const MatrixXd& covariance) {
    const Index m = covariance.rows();
    for (Index i = 0; i < m; ++i) {
        require_finite(covariance(i, i), "variance of the " + point_name(i));
        if (!(covariance(i, i) > 0.0)) {
            refuse("GC-GUM-0031", "u of the " + point_name(i), "variance " + text::shortest(covariance(i, i)),
                   "a score divides by it, so it must be greater than 0",
                   "State the uncertainty of at least one side.");
        }
    }
    for (Index j = 0; j < m; ++j) {
        for (Index i = j + 1; i < m; ++i) {
            const double scale = std::sqrt(covariance(i, i)) * std::sqrt(covariance(j, j));
            const auto where = [&] {
                return "covariance of points " + std::to_string(j + 1) + " and " + std::to_string(i + 1);
            };
            if (!std::isfinite(covariance(i, j)) || !std::isfinite(covariance(j, i))) {
                refuse("GC-GUM-0001", where(), text::shortest(covariance(i, j)), "must be a finite number",
                       "Correct the covariance.");
            }
            if (!(std::abs(covariance(i, j) - covariance(j, i)) <= k_stated_symmetry_tolerance * scale)) {
                refuse("GC-GUM-0052", where(),
                       text::shortest(covariance(i, j)) + " below and " + text::shortest(covariance(j, i)) +
                           " above the diagonal",
                       "a covariance matrix is symmetric", "Correct the covariance.");
            }
            if (!(std::abs(covariance(i, j)) <= k_largest_correlation * scale)) {
                refuse("GC-GUM-0053", where(), "a correlation of " + text::shortest(covariance(i, j) / scale),
                       "a correlation coefficient lies between -1 and 1", "Correct the covariance.");
            }
        }
    }
}

void require_differences(const MethodDifferences& differences) {
    require_sizes(differences);
    for (Index i = 0; i < differences.d.size(); ++i) {
        require_finite(differences.d(i), point_name(i));
        require_not_negative(differences.U_method(i), "U of the method at point " + std::to_string(i + 1));
        require_not_negative(differences.U_reference(i), "U of the reference at point " + std::to_string(i + 1));
        require_finite(differences.U(i), "U of the " + point_name(i));
        if (!(differences.U(i) > 0.0)) {
            refuse("GC-GUM-0031", "U of the " + point_name(i), text::shortest(differences.U(i)),
                   "a score divides by it, so it must be greater than 0",
                   "State the uncertainty of at least one side.");
        }
    }
    require_covariance(differences.covariance);
    for (Index i = 0; i < differences.degrees_of_freedom.size(); ++i) {
        require_degrees_of_freedom(differences.degrees_of_freedom(i), "degrees of freedom of the " + point_name(i));
    }
}

[[noreturn]] void refuse_indefinite(double smallest) {
    refuse("GC-GUM-0054", "covariance of the differences",
           "smallest eigenvalue of the correlation matrix is " + text::shortest(smallest),
           "a covariance matrix is positive semi-definite",
           "Correct the correlations of the points and of both methods; they contradict each other.");
}

void require_semidefinite(double smallest, double largest) {
    // Of a correlation matrix, whose eigenvalues do not depend on units: in a covariance of points with very different
    // u a contradiction between the small ones would be lost in the rounding of the large ones.
    if (!(smallest >= -k_negative_eigenvalue * largest)) {
        refuse_indefinite(smallest);
    }
}

/// Eigenvalues of a symmetric matrix, ascending, those below 0 by rounding set to 0.
std::vector<double> spectrum(const MatrixXd& matrix) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(matrix, Eigen::EigenvaluesOnly);
    const VectorXd& values = eigen.eigenvalues();
    require_semidefinite(values(0), values(values.size() - 1));
    std::vector<double> weights(values.data(), values.data() + values.size());
    for (double& weight : weights) {
        weight = std::max(weight, 0.0);
    }
    return weights;
}

/// Columns B as W B, where WᵀW is the inverse of the correlation matrix R, or its pseudo-inverse where R is singular.
struct Whitened {
    MatrixXd columns;
    Index rank = 0;
    VectorXd beyond;  ///< size of each column outside the range of R: what R says cannot be
};

Whitened whitened_by_spectrum(const MatrixXd& R, const MatrixXd& B) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(R);
    const VectorXd& values = eigen.eigenvalues();
    const Index m = R.rows();
    require_semidefinite(values(0), values(m - 1));
    // In these directions R says that the points differ by nothing. Dividing by the root of such an eigenvalue would
    // make a large Mahalanobis number of nothing but rounding, so they are kept apart (`beyond`).
    const auto first = std::count_if(values.data(), values.data() + m,
                                     [&](double value) { return value <= k_rank_tolerance * values(m - 1); });
    const MatrixXd rotated = eigen.eigenvectors().transpose() * B;
    Whitened result;
    result.rank = m - first;
    result.columns = values.tail(result.rank).cwiseSqrt().cwiseInverse().asDiagonal() * rotated.bottomRows(result.rank);
    result.beyond = rotated.topRows(first).colwise().norm();
    return result;
}

/// L with R = L Lᵀ and as many columns as R has rank: Cholesky with the largest remaining variance first.
MatrixXd root_by_pivots(const MatrixXd& R) {
    const Index m = R.rows();
    MatrixXd L(m, m);
    VectorXd remaining = R.diagonal();
    Index rank = 0;
    // The point with the largest variance that the points taken so far leave unexplained comes next. When the loop ends
    // no point has more than the tolerance left, so that the number of columns is the rank. In the given order a point
    // that follows from earlier ones would be divided by rounding.
    for (Index pivot = 0; rank < m && remaining.maxCoeff(&pivot) > k_rank_tolerance; ++rank) {
        VectorXd column = R.col(pivot);
        column.noalias() -= L.leftCols(rank) * L.row(pivot).head(rank).transpose();
        L.col(rank) = column / std::sqrt(remaining(pivot));
        remaining -= L.col(rank).cwiseAbs2();
        // A variance that becomes negative shows that R is no correlation matrix. m is the trace of R, and so a bound
        // of its largest eigenvalue, which is not known here.
        require_semidefinite(remaining.minCoeff(), static_cast<double>(m));
        // It is 0 but for rounding; with a rest of it the same point could be taken again.
        remaining(pivot) = 0.0;
    }
    return L.leftCols(rank);
}

/// The same for matrices too large for their eigenvectors. With L = Q T, the pseudo-inverse of L is T⁻¹Qᵀ.
Whitened whitened_by_pivots(const MatrixXd& R, const MatrixXd& B) {
    const MatrixXd L = root_by_pivots(R);
    // Orthogonal, and not by (LᵀL)⁻¹Lᵀ: that would square the condition number of an almost singular R.
    const Eigen::HouseholderQR<MatrixXd> qr(L);
    const MatrixXd rotated = qr.householderQ().transpose() * B;
    Whitened result;
    result.rank = L.cols();
    result.columns = qr.matrixQR()
                         .topLeftCorner(result.rank, result.rank)
                         .triangularView<Eigen::Upper>()
                         .solve(rotated.topRows(result.rank));
    result.beyond = rotated.bottomRows(R.rows() - result.rank).colwise().norm();
    return result;
}

Whitened whitened(const MatrixXd& R, const MatrixXd& B) {
    const Eigen::LLT<MatrixXd> factor(R);
    if (factor.info() == Eigen::Success && factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() > k_well_conditioned) {
        return {.columns = factor.matrixL().solve(B), .rank = R.rows(), .beyond = VectorXd::Zero(B.cols())};
    }
    // Cholesky where the matrix allows it; else the pseudo-inverse: points that share everything are one point, and
    // what differs between them contradicts their covariance (`beyond`).
    return R.rows() > k_most_points_of_eigenvectors ? whitened_by_pivots(R, B) : whitened_by_spectrum(R, B);
}

void add_scores(const MethodDifferences& differences, const VectorXd& zeta, Agreement& result) {
    std::vector<ComparisonScore> scores;
    for (Index i = 0; i < differences.d.size(); ++i) {
        scores.push_back({.en = differences.d(i) / differences.U(i), .zeta = zeta(i)});
    }
    const ComparisonSummary summary = summarise(scores);
    result.count_above_1 = summary.count_above_1;
    result.mean_absolute_en = summary.mean_absolute_en;
    result.largest_absolute_en = summary.largest_absolute_en;
    result.rms_en = summary.rms_en;
    result.sum_of_squared_zeta = summary.sum_of_squared_zeta;
    result.p_low_independent = summary.p_low;
    result.p_high_independent = summary.p_high;
    result.d_fail_smallest = differences.U.minCoeff();
    result.d_fail_largest = differences.U.maxCoeff();
    const double of_method = differences.U_method.norm();
    result.ratio_reference =
        of_method > 0.0 ? differences.U_reference.norm() / of_method : std::numeric_limits<double>::infinity();
}

/// Covariance of the differences where the uncertainty of the method is `factor` times the stated one, in units of the
/// stated u of each difference. What both sides share scales with the method.
MatrixXd scaled_correlations(const MethodDifferences& differences, const VectorXd& u, const MatrixXd& R,
                             double factor) {
    const MatrixXd& method = differences.method_covariance;
    const MatrixXd& reference = differences.reference_covariance;
    if (method.size() == 0) {
        return factor * factor * R;
    }
    // V = M + N − (C + Cᵀ) for the covariances M of the method, N of the reference and C of one with the other. With a
    // factor on the method it stands squared in M and once in C.
    const MatrixXd shared = method + reference - differences.covariance;
    const VectorXd inverse_u = u.cwiseInverse();
    const MatrixXd V = factor * factor * method + reference - factor * shared;
    return inverse_u.asDiagonal() * V * inverse_u.asDiagonal();
}

/// How the uncertainties of the points were estimated.
enum class EstimatesBy {
    exact,  ///< infinite degrees of freedom: normal scores
    apart,  ///< each by itself: t with the ν of each point, for points that do not correlate
    one,    ///< one estimate for all: multivariate t
};

bool have_finite_degrees(const MethodDifferences& differences) {
    return differences.degrees_of_freedom.size() > 0 && !differences.degrees_of_freedom.array().isInf().all();
}

double degrees_of(const MethodDifferences& differences, Index i) {
    return differences.degrees_of_freedom.size() > 0 ? differences.degrees_of_freedom(i)
                                                     : std::numeric_limits<double>::infinity();
}

/// The ν of one estimate that makes Σ ζ² vary as estimates with the ν of the points do that are all wrong together: the
/// relative standard deviation √(2/ν) of a variance, averaged.
double degrees_of_one_estimate(const MethodDifferences& differences) {
    const double mean = differences.degrees_of_freedom.cwiseInverse().cwiseSqrt().mean();
    return 1.0 / (mean * mean);
}

/// The laws that the joint tests are held against: the exact one, or bounds.
std::vector<EstimatesBy> laws_of(const MethodDifferences& differences, const MatrixXd& R) {
    constexpr double k_no_correlation = 1e-9;
    if (!have_finite_degrees(differences)) {
        return {EstimatesBy::exact};
    }
    const MatrixXd beside = R - MatrixXd(R.diagonal().asDiagonal());
    if (!differences.one_estimate && beside.cwiseAbs().maxCoeff() <= k_no_correlation) {
        return {EstimatesBy::apart};
    }
    return {EstimatesBy::exact, EstimatesBy::apart, EstimatesBy::one};
}

/// The distribution of a sum of squared scores.
class SumOfSquaredScores {
public:
    /// \param weights  eigenvalues of the covariance of the scores
    /// \param terms    its diagonal, with the ν of the points
    SumOfSquaredScores(EstimatesBy estimates, std::vector<double> weights, std::vector<SquaredT> terms,
                       double nu_of_one)
        : estimates_(estimates), weights_(std::move(weights)), terms_(std::move(terms)), nu_(nu_of_one) {}

    [[nodiscard]] double lower_tail(double x) const {
        return estimates_ == EstimatesBy::apart ? squared_t_lower_tail(terms_, x)
               : estimates_ == EstimatesBy::one ? common_t_lower_tail(weights_, nu_, x)
                                                : weighted_chi_square_lower_tail(weights_, x);
    }
    [[nodiscard]] double upper_tail(double x) const {
        return estimates_ == EstimatesBy::apart ? squared_t_upper_tail(terms_, x)
               : estimates_ == EstimatesBy::one ? common_t_upper_tail(weights_, nu_, x)
                                                : weighted_chi_square_upper_tail(weights_, x);
    }
    [[nodiscard]] double quantile(double p) const {
        return estimates_ == EstimatesBy::apart ? squared_t_quantile(terms_, p)
               : estimates_ == EstimatesBy::one ? common_t_quantile(weights_, nu_, p)
                                                : weighted_chi_square_quantile(weights_, p);
    }

private:
    EstimatesBy estimates_;
    std::vector<double> weights_;
    std::vector<SquaredT> terms_;
    double nu_ = 0.0;
};

/// Makes the distributions of one law, for the scores as they are and for those of other uncertainties.
class ScoreLaw {
public:
    ScoreLaw(EstimatesBy estimates, const MethodDifferences& differences, const VectorXd& u, const MatrixXd& R,
             const std::vector<double>& of_zeta)
        : estimates_(estimates), differences_(differences), u_(u), R_(R), of_zeta_(of_zeta) {
        if (estimates == EstimatesBy::one) {
            nu_of_one_ = degrees_of_one_estimate(differences);
        }
    }

    [[nodiscard]] SumOfSquaredScores of_zeta() const { return made(of_zeta_, VectorXd::Ones(u_.size())); }

    /// Where the uncertainty of the method is `factor` times the stated one.
    [[nodiscard]] SumOfSquaredScores of_scaled(double factor) const {
        const MatrixXd scaled = scaled_correlations(differences_, u_, R_, factor);
        if (estimates_ == EstimatesBy::apart) {
            return made({}, scaled.diagonal());
        }
        if (differences_.method_covariance.size() > 0 && R_.rows() <= k_most_points_of_eigenvectors) {
            return made(spectrum(0.5 * (scaled + scaled.transpose())), {});
        }
        // The sum of the eigenvalues is the expected value of Σ ζ²: the ratio of the traces keeps it right, and only
        // the form of the distribution is taken from R. Where all of V belongs to the method this is exact.
        std::vector<double> weights = of_zeta_;
        const double ratio = scaled.trace() / R_.trace();
        for (double& weight : weights) {
            weight *= ratio;
        }
        return made(std::move(weights), {});
    }

    /// Of Σ E_n², E_n = ζ u/U.
    [[nodiscard]] SumOfSquaredScores of_en(const VectorXd& inverse_k) const {
        return estimates_ == EstimatesBy::apart
                   ? made({}, inverse_k.cwiseAbs2())
                   : made(spectrum(inverse_k.asDiagonal() * R_ * inverse_k.asDiagonal()), {});
    }

    /// Of the Mahalanobis distance, squared.
    [[nodiscard]] SumOfSquaredScores of_distance(std::size_t rank) const {
        return made(std::vector<double>(rank, 1.0), VectorXd::Ones(static_cast<Index>(rank)));
    }

    [[nodiscard]] EstimatesBy estimates() const { return estimates_; }

private:
    [[nodiscard]] SumOfSquaredScores made(std::vector<double> weights, const VectorXd& diagonal) const {
        std::vector<SquaredT> terms;
        if (estimates_ == EstimatesBy::apart) {
            for (Index i = 0; i < diagonal.size(); ++i) {
                terms.push_back({std::max(diagonal(i), 0.0), degrees_of(differences_, i)});
            }
        }
        return {estimates_, std::move(weights), std::move(terms), nu_of_one_};
    }

    EstimatesBy estimates_;
    const MethodDifferences& differences_;
    const VectorXd& u_;
    const MatrixXd& R_;
    const std::vector<double>& of_zeta_;
    double nu_of_one_ = std::numeric_limits<double>::infinity();
};

/// Whether the sum of squares tells a right uncertainty from one that is wrong by a factor of 2.
void add_test_of_uncertainty(const ScoreLaw& law, const SumOfSquaredScores& of_zeta, Agreement& result) {
    constexpr double k_factor = 2.0;
    // Two one-sided tests, as for equivalence: that a test does not refute a right uncertainty would be no proof, for a
    // test of few points refutes hardly anything (ADR 0028, decision 6).
    const SumOfSquaredScores if_too_small = law.of_scaled(k_factor);
    const SumOfSquaredScores if_too_large = law.of_scaled(1.0 / k_factor);
    result.p_if_too_small = if_too_small.lower_tail(result.sum_of_squared_zeta);
    result.p_if_too_large = if_too_large.upper_tail(result.sum_of_squared_zeta);
    // The range of Σ ζ² in which both a doubled and a halved uncertainty are refuted while the stated one is not.
    const double high =
        std::min(if_too_small.quantile(k_error_of_confirmation), of_zeta.quantile(1.0 - k_chance_of_size));
    const double low =
        std::max(if_too_large.quantile(1.0 - k_error_of_confirmation), of_zeta.quantile(k_chance_of_size));
    // high ≤ low: whatever the sum is, it cannot refute both. Few points, or points that share much, confirm nothing.
    // Where both are nearly one, the tails differ by no more than their accuracy.
    result.power_to_confirm = high > low ? std::max(0.0, of_zeta.lower_tail(high) - of_zeta.lower_tail(low)) : 0.0;
}

void add_band(const ScoreLaw& law, const SumOfSquaredScores& of_zeta, const VectorXd& inverse_k, Agreement& result) {
    const auto m = static_cast<double>(inverse_k.size());
    // E_n = ζ u/U: another spectrum only where the coverage factors of the points differ.
    const bool equal = inverse_k.maxCoeff() - inverse_k.minCoeff() <= k_equal_factors * inverse_k.maxCoeff();
    const SumOfSquaredScores of_en = equal ? of_zeta : law.of_en(inverse_k);
    const double scale = equal ? inverse_k(0) : 1.0;
    const auto rms = [&](double probability) { return scale * std::sqrt(of_en.quantile(probability) / m); };
    result.rms_en_low = rms(k_tail_of_band);
    result.rms_en_high = rms(1.0 - k_tail_of_band);
}

/// The numbers of one law, beside those of no law that `result` has.
Agreement under(const ScoreLaw& law, const VectorXd& inverse_k, const Whitened& distance, double square_of_pattern,
                double coverage_probability, Agreement result) {
    const SumOfSquaredScores of_zeta = law.of_zeta();
    result.p_low = of_zeta.lower_tail(result.sum_of_squared_zeta);
    result.p_high = of_zeta.upper_tail(result.sum_of_squared_zeta);
    add_test_of_uncertainty(law, of_zeta, result);
    add_band(law, of_zeta, inverse_k, result);
    const SumOfSquaredScores of_distance = law.of_distance(result.rank);
    if (law.estimates() == EstimatesBy::exact) {
        result.p_mahalanobis = chi_square_upper_tail(result.mahalanobis_square, static_cast<double>(result.rank));
        result.vector_en =
            std::sqrt(result.mahalanobis_square) /
            ellipsoid_coverage_factor(coverage_probability, result.rank, std::numeric_limits<double>::infinity());
        result.p_pattern = chi_square_upper_tail(square_of_pattern, static_cast<double>(result.points));
    } else {
        result.p_mahalanobis = of_distance.upper_tail(result.mahalanobis_square);
        result.vector_en = std::sqrt(result.mahalanobis_square / of_distance.quantile(coverage_probability));
        result.p_pattern = law.of_distance(result.points).upper_tail(square_of_pattern);
    }
    // Only what is refuted can be refuted by less than rounding: one number where no pattern is in question.
    if (result.p_mahalanobis >= k_chance_of_bias_and_pattern && distance.beyond(0) == 0.0) {
        result.p_pattern = result.p_mahalanobis;
    }
    return result;
}

/// Of several bounds the one that objects least, and how much any of them objects.
void add_bound(const Agreement& bound, Agreement& result) {
    result.p_low_least = std::min(result.p_low_least, bound.p_low);
    result.p_high_least = std::min(result.p_high_least, bound.p_high);
    result.p_mahalanobis_least = std::min(result.p_mahalanobis_least, bound.p_mahalanobis);
    for (double Agreement::*largest :
         {&Agreement::p_low, &Agreement::p_high, &Agreement::p_mahalanobis, &Agreement::p_pattern,
          &Agreement::p_if_too_small, &Agreement::p_if_too_large, &Agreement::rms_en_high}) {
        result.*largest = std::max(result.*largest, bound.*largest);
    }
    for (double Agreement::*smallest : {&Agreement::power_to_confirm, &Agreement::rms_en_low, &Agreement::vector_en}) {
        result.*smallest = std::min(result.*smallest, bound.*smallest);
    }
}

/// The |E_n| that the largest of all points exceeds with k_chance_of_single_points.
double largest_by_chance(const MethodDifferences& differences, const VectorXd& inverse_k, double coverage_probability,
                         std::size_t family) {
    const double chance = chance_in_family(k_chance_of_single_points, family);
    constexpr double k_normal = std::numeric_limits<double>::infinity();
    const auto points = static_cast<std::size_t>(inverse_k.size());
    if (!have_finite_degrees(differences)) {
        // largest_en_by_chance() counts in units of the factor of its own probability, 0.99 of one set of points. E_n counts in units
        // of the factor for the coverage probability, hence the quotient of the two.
        return largest_en_by_chance(points, 1.0 - chance) * coverage_factor(1.0 - chance, k_normal) /
               coverage_factor(coverage_probability, k_normal);
    }
    // Π P(|T_ν| ≤ L U/u) = 0.99: Šidák's limit with the t distribution and the factor of each point.
    const auto excess = [&](double limit) {
        double logarithm = -std::log1p(-chance);
        for (Index i = 0; i < inverse_k.size(); ++i) {
            logarithm += std::log1p(-two_sided_tail_of_t(limit / inverse_k(i), degrees_of(differences, i)));
        }
        return logarithm;
    };
    double low = 0.0;
    double high = 1.0;
    constexpr double k_beyond_all = 1e12;
    while (excess(high) < 0.0 && high < k_beyond_all) {
        low = high;
        high *= 2.0;
    }
    constexpr int k_bisections = 60;
    for (int i = 0; i < k_bisections; ++i) {
        const double middle = 0.5 * (low + high);
        (excess(middle) < 0.0 ? low : high) = middle;
    }
    return std::max(1.0, high);
}

void add_deviations_that_are_found(const MethodDifferences& differences, const VectorXd& u, Agreement& result) {
    // For a true deviation δ, D is about δ with standard uncertainty u: |D| > U has the probability P at δ = U + t_P u,
    // t_P the quantile of the distribution of D. What lies beyond −U on the other side is left out, which makes the
    // true probability larger. The largest of all points: a deviation of this size is found wherever it occurs.
    const auto found = [&](double probability) {
        double largest = 0.0;
        for (Index i = 0; i < u.size(); ++i) {
            // One-sided: P(T ≤ t) = P where ±t has the probability 2 P − 1.
            const double nu = degrees_of(differences, i);
            const double t =
                std::isinf(nu) ? standard_normal_quantile(probability) : coverage_factor(2.0 * probability - 1.0, nu);
            largest = std::max(largest, differences.U(i) + t * u(i));
        }
        return largest;
    };
    result.found_with_80_percent = found(0.80);
    result.found_with_95_percent = found(0.95);
}

/// Dᵀ (V + s² diag V)⁻¹ D with the s that rounding of stated numbers may make.
double square_beyond_rounding(const MatrixXd& R, const VectorXd& zeta) {
    MatrixXd widened = R;
    widened.diagonal().array() += k_rounding_of_statements * k_rounding_of_statements;
    return whitened(widened, zeta).columns.squaredNorm();
}

void add_distributions(const MethodDifferences& differences, const VectorXd& u, const VectorXd& zeta, const MatrixXd& R,
                       double coverage_probability, Agreement& result) {
    const auto m = static_cast<double>(u.size());
    // Σ ζ² has mean m and variance 2 ΣΣ r_ij². A χ² of ν independent points, stretched to the same mean, has the
    // variance 2 m²/ν.
    result.effective_points = m * m / R.squaredNorm();
    const VectorXd inverse_k = u.cwiseQuotient(differences.U);
    if (result.points > 1 || result.family > 1) {
        result.largest_en_by_chance = largest_by_chance(differences, inverse_k, coverage_probability, result.family);
    }
    result.count_by_chance = count_above_1_by_chance(result.points, std::clamp(result.effective_points, 1.0, m),
                                                     coverage_probability, result.family);
    add_deviations_that_are_found(differences, u, result);
    const Whitened distance = whitened(R, zeta);
    result.rank = static_cast<std::size_t>(distance.rank);
    result.mahalanobis_square = distance.columns.squaredNorm();
    result.beyond_covariance = distance.beyond(0);
    const double square_of_pattern = square_beyond_rounding(R, zeta);
    // Σ ζ² of correlated points is a sum of χ² with the eigenvalues of their correlation matrix as weights. As if they
    // were independent, many sound comparisons would be called suspicious.
    const std::vector<double> of_zeta = spectrum(R);
    const std::vector<EstimatesBy> laws = laws_of(differences, R);
    std::optional<Agreement> found;
    for (const EstimatesBy estimates : laws) {
        const Agreement bound = under(ScoreLaw(estimates, differences, u, R, of_zeta), inverse_k, distance,
                                      square_of_pattern, coverage_probability, result);
        if (!found) {
            found = bound;
        }
        add_bound(bound, *found);
    }
    result = *found;
    result.is_bounded = laws.size() > 1;
    if (have_finite_degrees(differences) && result.power_to_confirm < k_least_power_to_confirm) {
        const ScoreLaw normal(EstimatesBy::exact, differences, u, R, of_zeta);
        Agreement of_normal = result;
        add_test_of_uncertainty(normal, normal.of_zeta(), of_normal);
        result.power_lacks_degrees = of_normal.power_to_confirm >= k_least_power_to_confirm;
    }
}

}  // namespace

double chance_in_family(double chance, std::size_t family) {
    return family > 1 ? -std::expm1(std::log1p(-chance) / static_cast<double>(family)) : chance;
}

Agreement agreement(const MethodDifferences& differences, double coverage_probability, std::size_t family) {
    require_probability(coverage_probability, "coverage probability");
    require_differences(differences);
    const VectorXd u = differences.covariance.diagonal().cwiseSqrt();
    const VectorXd zeta = differences.d.cwiseQuotient(u);
    const MatrixXd R = correlation_matrix(differences.covariance);
    Agreement result;
    result.points = static_cast<std::size_t>(u.size());
    result.family = std::max<std::size_t>(1, family);
    add_scores(differences, zeta, result);
    add_distributions(differences, u, zeta, R, coverage_probability, result);
    return result;
}

double largest_en_by_chance(std::size_t points, double coverage_probability) {
    require_probability(coverage_probability, "coverage probability");
    if (points == 0) {
        refuse("GC-GUM-0032", "comparison", "no points", "the largest of several scores needs at least 1 point",
               "Give the points that both methods measured.");
    }
    constexpr double k_normal = std::numeric_limits<double>::infinity();
    // Šidák's limit: all points together stay below it with the probability of one. It holds for correlated points as
    // well.
    const double of_each = std::pow(coverage_probability, 1.0 / static_cast<double>(points));
    return coverage_factor(of_each, k_normal) / coverage_factor(coverage_probability, k_normal);
}

std::size_t count_above_1_by_chance(std::size_t points, double effective_points, double coverage_probability,
                                    std::size_t family) {
    require_probability(coverage_probability, "coverage probability");
    if (points == 0) {
        refuse("GC-GUM-0032", "comparison", "no points", "a number of scores needs at least 1 point",
               "Give the points that both methods measured.");
    }
    if (points == 1 && family <= 1) {
        return 0;
    }
    // Correlated points exceed the limit together: they count as fewer, and each of these stands for several points.
    const double independent = std::clamp(std::round(effective_points), 1.0, static_cast<double>(points));
    using Up = boost::math::policies::policy<
        boost::math::policies::promote_double<false>,  // ADR 0058
        boost::math::policies::discrete_quantile<boost::math::policies::integer_round_up>>;
    const boost::math::binomial_distribution<double, Up> above(independent, 1.0 - coverage_probability);
    // Rounded up: a smaller number would be exceeded in more than 1 of 100 comparisons.
    const double limit = boost::math::quantile(above, 1.0 - chance_in_family(k_chance_of_single_points, family));
    return static_cast<std::size_t>(std::floor(limit * static_cast<double>(points) / independent));
}

std::optional<BiasLine> bias_line(const MethodDifferences& differences, const VectorXd& t) {
    require_differences(differences);
    const Index m = differences.d.size();
    if (t.size() != m) {
        refuse("GC-GUM-0135", "bias line", text::count_of(t.size(), "position") + " for " + text::count_of(m, "point"),
               "every difference has a position", "Give all of them.");
    }
    for (Index i = 0; i < m; ++i) {
        require_finite(t(i), "position of point " + std::to_string(i + 1));
    }
    // About t̄ the constant and the slope hardly correlate, and positions that share many digits lose none of them. In
    // units of the span both columns of the design are of one size, so that the rank can be judged by one threshold.
    const double centre = t.mean();
    const VectorXd from_centre = t.array() - centre;
    const double span = from_centre.cwiseAbs().maxCoeff();
    if (m < 3 || !(t.maxCoeff() > t.minCoeff()) || !std::isfinite(span)) {
        return std::nullopt;
    }
    const VectorXd u = differences.covariance.diagonal().cwiseSqrt();
    MatrixXd columns(m, 3);  // the two of the line, with t in units of the span, and the differences
    columns.col(0) = u.cwiseInverse();
    columns.col(1) = from_centre.cwiseQuotient(u) / span;
    columns.col(2) = differences.d.cwiseQuotient(u);
    const Whitened free = whitened(correlation_matrix(differences.covariance), columns);
    // Two directions for the line, and one that can contradict it.
    if (free.rank < 3) {
        return std::nullopt;
    }
    const MatrixXd design = free.columns.leftCols(2);
    Eigen::ColPivHouseholderQR<MatrixXd> qr;
    qr.setThreshold(k_rank_tolerance);
    qr.compute(design);
    if (qr.rank() < 2) {
        return std::nullopt;
    }
    // Whitened columns: ordinary least squares of them is generalised least squares of the differences.
    const Eigen::Vector2d line = qr.solve(free.columns.col(2));
    const Eigen::Matrix2d covariance = (design.transpose() * design).inverse();
    BiasLine result;
    result.centre = centre;
    result.constant = line(0);
    result.u_constant = std::sqrt(covariance(0, 0));
    result.slope = line(1) / span;
    result.u_slope = std::sqrt(covariance(1, 1)) / span;
    result.covariance = covariance(0, 1) / span;
    result.chi_square = (free.columns.col(2) - design * line).squaredNorm();
    result.p_value = chi_square_upper_tail(result.chi_square, static_cast<double>(free.rank - 2));
    return result;
}

namespace {

/// (value, covariance) of what is asked of a line, as a χ² of so many degrees of freedom.
double square_of_bias(const Eigen::Vector2d& value, const Eigen::Matrix2d& covariance, const BiasQuestion& question) {
    if (question.constant && question.slope) {
        return value.dot(covariance.inverse() * value);
    }
    const Index i = question.constant ? 0 : 1;
    return value(i) * value(i) / covariance(i, i);
}

/// The same for the slope as it is, and without what the uncertainty of the positions makes of it: a slope between both
/// is no evidence.
double least_square_of_bias(const BiasLine& line, const BiasQuestion& question) {
    // In units of its own u the slope has the size of the constant, whatever the unit of the positions.
    const double r = line.u_constant > 0.0 && line.u_slope > 0.0
                         ? std::clamp(line.covariance / (line.u_constant * line.u_slope), -1.0, 1.0)
                         : 0.0;
    const Eigen::Matrix2d covariance{{1.0, r}, {r, 1.0}};
    const double within = std::clamp(question.slope_of_noise, std::min(0.0, line.slope), std::max(0.0, line.slope));
    const Eigen::Vector2d as_is(line.constant / line.u_constant, line.slope / line.u_slope);
    const Eigen::Vector2d without(as_is(0), (line.slope - within) / line.u_slope);
    return std::min(square_of_bias(as_is, covariance, question), square_of_bias(without, covariance, question));
}

/// χ² of a line in t through the normal scores of ζ of points that do not correlate.
double square_of_normal_scores(const MethodDifferences& differences, const VectorXd& t, const BiasQuestion& question) {
    const Index m = t.size();
    const VectorXd from_centre = t.array() - t.mean();
    double sum = 0.0;
    double moment = 0.0;
    for (Index i = 0; i < m; ++i) {
        const double z =
            normal_score(differences.d(i) / std::sqrt(differences.covariance(i, i)), degrees_of(differences, i));
        sum += z;
        moment += z * from_centre(i);
    }
    // Both columns of the design are orthogonal, so that each has its χ² of one degree of freedom.
    return (question.constant ? sum * sum / static_cast<double>(m) : 0.0) +
           (question.slope ? moment * moment / from_centre.squaredNorm() : 0.0);
}

}  // namespace

std::optional<BiasTest> bias_test(const MethodDifferences& differences, const VectorXd& t,
                                  const BiasQuestion& question) {
    const std::optional<BiasLine> line = bias_line(differences, t);
    if (!line || (!question.constant && !question.slope)) {
        return std::nullopt;
    }
    BiasTest result{.degrees_of_freedom = question.constant && question.slope ? 2 : 1};
    const double nu = result.degrees_of_freedom;
    const double square = least_square_of_bias(*line, question);
    const double p_exact = chi_square_upper_tail(square, nu);
    const std::vector<EstimatesBy> laws = laws_of(differences, correlation_matrix(differences.covariance));
    if (laws.front() == EstimatesBy::exact) {
        result.p = result.p_least = p_exact;
    } else {
        result.p = result.p_least = chi_square_upper_tail(square_of_normal_scores(differences, t, question), nu);
    }
    if (laws.size() > 1) {
        const std::vector<double> weights(static_cast<std::size_t>(result.degrees_of_freedom), 1.0);
        const double p_one = common_t_upper_tail(weights, degrees_of_one_estimate(differences), square);
        const double p_apart = chi_square_upper_tail(square_of_normal_scores(differences, t, question), nu);
        result.p = std::max({p_exact, p_one, p_apart});
        result.p_least = std::min({p_exact, p_one, p_apart});
    }
    return result;
}

double vector_en(const VectorXd& d, const MatrixXd& covariance, double coverage_probability) {
    require_probability(coverage_probability, "coverage probability");
    if (d.size() == 0 || covariance.rows() != d.size() || covariance.cols() != d.size()) {
        refuse("GC-GUM-0135", "vector of differences",
               text::count_of(d.size(), "quantity") + " and a covariance " + std::to_string(covariance.rows()) +
                   " by " + std::to_string(covariance.cols()),
               "at least 1 quantity, and as many rows and columns", "Give all of them.");
    }
    for (Index i = 0; i < d.size(); ++i) {
        require_finite(d(i), point_name(i));
    }
    require_covariance(covariance);
    const VectorXd u = covariance.diagonal().cwiseSqrt();
    // In units of u the condition of the matrix is that of the correlations alone, whatever the units of the
    // quantities.
    const Whitened free = whitened(correlation_matrix(covariance), d.cwiseQuotient(u));
    // The pseudo-inverse would leave a direction out without a word, and with it perhaps the one in which the
    // laboratory is wrong.
    if (free.rank < d.size()) {
        refuse("GC-GUM-0031", "covariance of a vector of differences",
               "rank " + std::to_string(free.rank) + " for " + text::count_of(d.size(), "quantity"),
               "the score divides by it, so it must not be singular",
               "Leave out quantities that follow from the others, or correct the correlations.");
    }
    return std::sqrt(free.columns.squaredNorm()) / ellipsoid_coverage_factor(coverage_probability,
                                                                             static_cast<std::size_t>(d.size()),
                                                                             std::numeric_limits<double>::infinity());
}

bool is_too_large(const Agreement& agreement) {
    return !(agreement.p_high >= chance_in_family(k_chance_of_size, agreement.family)) ||
           !(agreement.largest_absolute_en <= agreement.largest_en_by_chance);
}

bool is_refuted_pattern(const Agreement& agreement) {
    return !(agreement.p_pattern >= chance_in_family(k_chance_of_bias_and_pattern, agreement.family));
}

AgreementVerdict agreement_verdict(const Agreement& agreement, std::optional<double> worst_plausible_en,
                                   const std::optional<BiasTest>& bias) {
    // In the order of the objections: what refutes the agreement comes before what limits the proof of it. The
    // conditions are negated, so that a number that is none objects.
    const double significant = chance_in_family(k_chance_of_size, agreement.family);
    const double chance = chance_in_family(k_chance_of_bias_and_pattern, agreement.family);
    const double p_bias = bias ? bias->p : 1.0;
    if (is_too_large(agreement) || is_refuted_pattern(agreement) || !(p_bias >= chance)) {
        return AgreementVerdict::disagreement;
    }
    if (agreement.count_above_1 > agreement.count_by_chance) {
        return AgreementVerdict::points_above_1;
    }
    // What one bound of the joint distribution refutes and another does not is neither agreement nor disagreement. Nor is
    // a pattern that no covariance explains, but rounding of the stated numbers might.
    const double p_bias_least = bias ? bias->p_least : 1.0;
    if (!(agreement.p_high_least >= significant) ||
        !(std::min(agreement.p_mahalanobis, agreement.p_mahalanobis_least) >= chance) || !(p_bias_least >= chance)) {
        return AgreementVerdict::joint_test_open;
    }
    if (worst_plausible_en && !(std::abs(*worst_plausible_en) <= 1.0)) {
        return AgreementVerdict::correlation_unknown;
    }
    if (!(agreement.ratio_reference < 1.0)) {
        return AgreementVerdict::reference_not_better;
    }
    // A sum that is too small is no disagreement, but U is then larger than the method needs: agreement is no proof of
    // it.
    if (!(agreement.p_low >= significant)) {
        return AgreementVerdict::uncertainty_too_large;
    }
    if (!(agreement.p_low_least >= significant)) {
        return AgreementVerdict::joint_test_open;
    }
    // Before the test itself is looked at: with little power its outcome would be one of chance.
    if (!(agreement.power_to_confirm >= k_least_power_to_confirm)) {
        return AgreementVerdict::agreement_few_points;
    }
    if (!(agreement.p_if_too_small <= k_error_of_confirmation && agreement.p_if_too_large <= k_error_of_confirmation)) {
        return AgreementVerdict::uncertainty_not_confirmed;
    }
    return agreement.ratio_reference > k_negligible_reference ? AgreementVerdict::agreement_reference_limited
                                                              : AgreementVerdict::validated;
}

}  // namespace gumcert::gum
