#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "gum/propagation.h"

namespace gumcert::gum {

/// Estimates of which the largest is taken, less the smallest of others or the same: a range, the largest of several values.
struct ExtremeValues {
    Eigen::VectorXd value;            ///< n
    Eigen::MatrixXd covariance;       ///< n×n, positive semi-definite
    std::vector<Eigen::Index> upper;  ///< of which the largest is taken, not empty
    std::vector<Eigen::Index> lower;  ///< of which the smallest is taken off; empty: nothing is taken off
};

/// The range of values: each of them may be the largest or the smallest.
[[nodiscard]] ExtremeValues range_of(Eigen::VectorXd value, Eigen::MatrixXd covariance);

struct ExtremeUncertainty {
    double u = 0.0;      ///< [unit of the estimates]
    double law_u = 0.0;  ///< of the law of propagation: of the difference of the estimates that are extreme
};

/// Draws of extreme_uncertainty() where nothing else is asked for: u within three percent.
inline constexpr std::size_t k_draws_of_errors = 16384;

/// Standard uncertainty of y = max y_i (i of `upper`) − min y_j (j of `lower`), for every other estimate that may be the extreme one.
///
/// The law of propagation takes the values that are extreme in the estimates as given. Noise has a part in which they are, and makes y
/// larger: of twelve equal values the interval ± k u of the law holds the range, 0, once in three times. JCGM 101:2008 does not
/// help, because trials about the estimates add noise to noise (ADR 0015). So the errors e of all estimates are drawn, about values
/// that lie as close to the extreme ones as the uncertainty of their difference allows (the least favourable ones):
///
///   γ_i = max(0, y_max − y_i − c u(y_max − y_i)),   δ_j = max(0, y_j − y_min − c u(y_j − y_min))
///   D = max(e_i − γ_i) − min(e_j + δ_j),            u = (quantile p of |D|)/(quantile p of |e_max − e_min|) u(y_max − y_min)
///
/// with c so that all n (n − 1) differences are held, each on one side, with a probability of at least p (Bonferroni), and u at least that of
/// the law. k u with k = t_p(ν) then holds y with a probability of about p or more. p is 0.9545 where U is stated for more: u does not
/// depend on it then, and k u is on the safe side. Where the extremes are clear nothing is drawn, and u is that of the law (ADR 0090).
///
/// \param coverage_probability  of the expanded uncertainty that u is for, 0 < p < 1
/// \param degrees_of_freedom    ν of y, infinite allowed; the errors are drawn from the multivariate t-distribution
/// \param draws                 a multiple of 1024
/// Accuracy: 16 384 draws with one seed for ever; three percent of u where the extremes are not clear.
[[nodiscard]] ExtremeUncertainty extreme_uncertainty(const ExtremeValues& values, double coverage_probability,
                                                     double degrees_of_freedom, std::size_t draws = k_draws_of_errors);

/// What a budget calls the part of u that comes from not knowing which estimates are the extreme ones.
inline constexpr const char* k_which_are_extreme = "which values are extreme";

/// States u of an extreme in place of that of the law of propagation: k stays, U = k u, and what it adds to the variance is a
/// contribution of its own, the last of the budget. Nothing changes where the extremes are clear.
/// \param output  of `budget`, the extreme
void state_extreme(UncertaintyBudget& budget, Eigen::Index output, const ExtremeUncertainty& extreme);

/// Part of the variance of an output that state_extreme() added; 0 of all others.
[[nodiscard]] double share_of_extremes(const UncertaintyBudget& budget, Eigen::Index output);

}  // namespace gumcert::gum
