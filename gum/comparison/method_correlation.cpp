#include "gum/comparison/method_correlation.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "gum/quantity/diagnostic.h"
#include "text/numbers.h"

namespace gumcert::gum {

namespace {

// Below it an eigenvalue of a correlation matrix of m quantities is rounding: m times this.
constexpr double k_rounding_of_diagonal = 1e-10;

}  // namespace

bool is_possible_covariance(const Eigen::MatrixXd& V, const Eigen::MatrixXd& W, const Eigen::MatrixXd& C) {
    const Eigen::Index m = V.rows();
    Eigen::MatrixXd joint(2 * m, 2 * m);
    joint << V, C, C.transpose(), W;
    // As correlations, so that one tolerance fits points of very different u. A point without variance keeps its row: a
    // covariance with it other than 0 is impossible, and stays visible.
    const Eigen::VectorXd scale =
        joint.diagonal().unaryExpr([](double variance) { return variance > 0.0 ? 1.0 / std::sqrt(variance) : 0.0; });
    joint = scale.asDiagonal() * joint * scale.asDiagonal();
    // r = 1 and points that share everything make the matrix singular, which is allowed; Cholesky alone would refuse it
    // by rounding.
    joint.diagonal().array() += k_rounding_of_diagonal * static_cast<double>(2 * m);
    return Eigen::LLT<Eigen::MatrixXd>(joint).info() == Eigen::Success;
}

StatedCorrelation stated_correlation(double r, const MethodComparison& comparison,
                                     const std::vector<std::string>& may_share, const std::string& where) {
    Eigen::MatrixXd common = r * comparison.covariance.diagonal().cwiseSqrt() *
                             comparison.reference_covariance.diagonal().cwiseSqrt().transpose();
    bool all_share = true;
    for (Eigen::Index i = 0; i < common.rows(); ++i) {
        for (Eigen::Index j = 0; j < common.cols(); ++j) {
            if (may_share[static_cast<std::size_t>(i)] != may_share[static_cast<std::size_t>(j)]) {
                common(i, j) = 0.0;
                all_share = false;
            }
        }
    }
    // Tried first because it claims least: nothing is said of different points.
    const Eigen::MatrixXd apart = common.diagonal().asDiagonal();
    if (is_possible_covariance(comparison.covariance, comparison.reference_covariance, apart)) {
        return {.covariance = apart, .from = CorrelationFrom::each_point};
    }
    if (is_possible_covariance(comparison.covariance, comparison.reference_covariance, common)) {
        return {.covariance = common,
                .from = all_share ? CorrelationFrom::all_points : CorrelationFrom::points_of_one_name};
    }
    throw InputError(Diagnostic{
        .code = "GC-COMPARE-0204",
        .where = where,
        .what = "the value is " + text::shortest(r) +
                ", and neither an effect of each point apart nor one that all points share can have that correlation",
        .rule = "the covariance matrix of both methods together is positive semi-definite",
        .action = "State a smaller correlation, or \"unknown\", or give budgets that name the shared sources."});
}

}  // namespace gumcert::gum
