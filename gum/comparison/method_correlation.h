#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gum/comparison/method_comparison.h"

namespace gumcert::gum {

/// Whether values of covariances V and W can have the covariance C with each other: V, W and C together are positive
/// semi-definite but for rounding.
/// \param V, W, C  m×m
[[nodiscard]] bool is_possible_covariance(const Eigen::MatrixXd& V, const Eigen::MatrixXd& W, const Eigen::MatrixXd& C);

/// What one coefficient r of two methods is taken to come from.
enum class CorrelationFrom {
    each_point,          ///< an effect of each point apart
    all_points,          ///< an effect that all points share
    points_of_one_name,  ///< an effect that the points with the same name in `may_share` share
};
struct StatedCorrelation {
    Eigen::MatrixXd covariance;  ///< m×m, cov(method i, reference j)
    CorrelationFrom from = CorrelationFrom::each_point;
};

/// Covariance of two methods, cov(method i, reference j), from one coefficient r that is stated for equal points.
///
/// An effect of each point apart, C_ii = r u_i u_ref,i, counts the points least. Where the points of the methods share
/// so much that this cannot be, it is an effect that points share, C_ij = r u_i u_ref,j.
/// \param comparison   the covariance of each method is taken from it
/// \param may_share    one a point: only points with the same name share such an effect
/// \param where        place of r, for messages
/// \throws InputError  GC-COMPARE-0204 neither can be
[[nodiscard]] StatedCorrelation stated_correlation(double r, const MethodComparison& comparison,
                                                   const std::vector<std::string>& may_share, const std::string& where);

}  // namespace gumcert::gum
