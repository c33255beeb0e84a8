#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gum/comparison/laboratory_data.h"

namespace gumcert::gum {

/// More correlated results of one item than this are refused: their covariance is a full matrix.
inline constexpr std::size_t k_most_correlated_laboratories = 500;

/// Covariance of the results of one item in one round: from the sources that several results name, the correlation
/// coefficient of a group, and the coefficients that are stated pair by pair; each of them takes the place of the
/// ones before.
/// \param shared     receives what was found in common sources, each pair of participants and each source once
/// \param ambiguous  receives the sources that act in more than one way, so that the largest covariance was taken
/// \return n×n, in the square of the unit of the item; empty where nothing correlates
/// \throws InputError  GC-COMPARE-0103
[[nodiscard]] Eigen::MatrixXd laboratory_covariance(const ComparisonScheme& scheme, const LaboratoryData& data,
                                                    std::vector<SharedSource>& shared,
                                                    std::set<std::string>& ambiguous);

/// Variance of x_i − Σ w_j x_j with the largest correlation that is plausible inside groups of unknown correlation,
/// less the variance without it: never positive. cov = min(u_i, u_j)² is the whole of the smaller uncertainty.
/// \param weights  n, of the assigned value
/// \return n; nothing for a result that is in no such group, or whose correlations with all others in it are known
[[nodiscard]] std::vector<std::optional<double>> least_variance_of_unknown_groups(const ComparisonScheme& scheme,
                                                                                  const LaboratoryData& data,
                                                                                  const Eigen::VectorXd& weights);

}  // namespace gumcert::gum
