#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "gum/budget/budget.h"
#include "gum/budget/evaluate_budget.h"

namespace gumcert::gum {

/// Joint coverage region of the results η of one point about their reported values y (JCGM 102:2011, 6.5 and 7.7), in terms of
/// the standard uncertainties u and the covariance V that are reported beside them.
struct JointRegion {
    bool of_trials = false;  ///< k_q, and k_p where there is one, come from draws of results of Monte Carlo
    /// k_p: (η − y)ᵀ V⁻¹ (η − y) ≤ k_p²
    std::optional<double> ellipsoid_factor;
    double ellipsoid_error = 0.0;  ///< standard uncertainty of a k_p that was found by draws; 0: a closed form
    /// Of the one scale or matrix that all results share; none: infinite, or there is no such thing.
    std::optional<double> degrees_of_freedom;
    /// Why there is no k_p: "singular", or "distribution" where the joint distribution of the results is not known.
    std::string no_ellipsoid_because;
    /// k_q: |η_j − y_j| ≤ k_q u(y_j) for all j
    std::optional<double> rectangle_factor;
    double rectangle_error = 0.0;
};

/// k_p of the law of propagation, for V of its own.
///
/// Normal inputs: χ² (JCGM 102:2011, 6.5.2.3). One group of inputs with one estimated scale, a fit for example: t, k_p² =
/// m F_p(m, ν). One covariance matrix that was estimated from simultaneous readings: Hotelling's T². Any others have no
/// closed form: J (X − x) is drawn. None where readings that were taken together stand beside other inputs: what is
/// drawn of them is right for one result at a time (ADR 0030).
/// \return ellipsoid_factor with what belongs to it
[[nodiscard]] JointRegion law_ellipsoid(const Budget& budget, const BudgetPointResult& point,
                                        double coverage_probability);

/// The region of all results of a point, for the coverage probability of the budget.
///
/// Where trials were made for the same p, and their means and covariance are those that are reported within 1 % of u: the
/// region of the trials (JCGM 102:2011, 7.7). Else, all by the law of propagation: k_p as above; k_q the largest of the factors that the results have for 1 − (1 − p)/m
/// by the distributions that their k comes from, so that all intervals hold together with p at least (Bonferroni). All
/// by Monte Carlo: those of its trials. Else a result of the law is y + J (X − x), one of Monte Carlo that of its
/// model, and both factors are those that hold the fraction p of 10^6 draws about what is reported.
/// \param covariance  reported_covariance
/// \return nothing where results of Monte Carlo have no variance, or come from readings that were taken together
/// Accuracy: ellipsoid_error, rectangle_error.
[[nodiscard]] std::optional<JointRegion> joint_region(const Budget& budget, const BudgetPointResult& point,
                                                      const Eigen::MatrixXd& covariance);

}  // namespace gumcert::gum
