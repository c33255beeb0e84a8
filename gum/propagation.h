#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

/// What one group of inputs, or one source, contributes to every output.
struct BudgetContribution {
    std::string name;          ///< name of the group, or of the source
    Eigen::VectorXd variance;  ///< m, diagonal of c_g V_g c_gᵀ, [unit of y²]; its root is the uncertainty contribution
    Eigen::VectorXd share;     ///< m, variance / u²(y), [1]; 0 where u(y) is 0
};

/// Uncertainty budget (VIM 2.33) of m outputs. All vectors are in the order of the model's outputs.
struct UncertaintyBudget {
    double coverage_probability = 0.0;
    Eigen::VectorXd value;                 ///< m, y = f(x)
    Eigen::VectorXd standard_uncertainty;  ///< m, u(y)
    /// m, ν_eff; infinite where no contribution has finite ones; NaN, as k and U then are, where none can be stated
    /// because a group that contributes has none (InputGroup::no_degrees_of_freedom_because)
    Eigen::VectorXd effective_degrees_of_freedom;
    Eigen::VectorXd coverage_factor;                   ///< m, k = t_p(ν_eff)
    Eigen::VectorXd expanded_uncertainty;              ///< m, U = k u(y)
    std::vector<BudgetContribution> budget;            ///< one a group, in the order of the model's groups
    std::vector<BudgetContribution> shares_by_source;  ///< groups of one source added up, in order of first appearance
};

/// Result of the law of propagation for m outputs and n inputs.
struct Propagation : UncertaintyBudget {
    Eigen::MatrixXd jacobian;    ///< m×n, sensitivity coefficients ∂y/∂x
    Eigen::MatrixXd covariance;  ///< m×m, symmetric, of the outputs, given the input covariances
};

/// Uncertainty budget from what every group of inputs contributes: u² = Σ_g variance_g, and ν_eff by
/// Welch–Satterthwaite over the groups (JCGM 100:2008, G.4.1), k = t_p(ν_eff) with ν_eff not cut to an integer.
///
/// \param value      m, of the outputs of the model
/// \param variances  one a group of the model's inputs, in their order, m each: diagonal of c_g V_g c_gᵀ
/// \throws InputError     if the probability is not between 0 and 1
/// \throws NoResultError  GC-GUM-0057 if a variance is not finite
[[nodiscard]] UncertaintyBudget uncertainty_budget(const MeasurementModel& model, Eigen::VectorXd value,
                                                   std::vector<Eigen::VectorXd> variances, double coverage_probability);

/// Law of propagation of uncertainty through a measurement model.
///
/// V_y = C V_x Cᵀ = Σ_g c_g V_g c_gᵀ    (JCGM 100:2008, 5.2.2, eq. 13 in matrix form; JCGM 102:2011, 6.2)
/// ν_eff by Welch–Satterthwaite over the groups (JCGM 100:2008, G.4.1), k = t_p(ν_eff) with ν_eff not cut to an
/// integer. A group counts as one contribution with one number of degrees of freedom, whatever the correlations in it.
///
/// \param coverage_probability  p, 0 < p < 1
/// \throws InputError     with every group that is wrong: sizes, numbers that are not finite (GC-GUM-0050), degrees of
///                        freedom (GC-GUM-0005), negative variance (GC-GUM-0051), not symmetric (GC-GUM-0052),
///                        correlation above 1 (GC-GUM-0053), not positive semi-definite (GC-GUM-0054)
/// \throws NoResultError  GC-GUM-0055 to -0057 if the model has no finite value, sensitivity or variance at the
///                        estimates
///
/// Positive semi-definite is judged on the correlation matrix of a group, so that quantities of very different size are
/// judged alike: an eigenvalue below −10 n ε λ_max is refused, one between that and 0 is rounding and taken as 0. A
/// source that is empty counts as a source of the group's name.
///
/// Valid when the model is near-linear over the uncertainties.
/// Accuracy: contributions sum to u² within 1e-12 relative; the covariance within 1e-13 of the sum of the magnitudes
/// that it is made of (docs/accuracy.md#law-of-propagation).
/// Example: examples/api/budget_by_hand.cpp
[[nodiscard]] Propagation propagate(const MeasurementModel& model, double coverage_probability);

/// Effective degrees of freedom of the joint covariance matrix of several outputs.
///
/// ν_eff = T(V) / Σ_g T(V_g)/ν_g with T(V) = Σ_{i≤j} (v_ii v_jj + v_ij²), where V_g = c_g V_x,g c_gᵀ is what group g
/// contributes: the total variance of the elements of V, as Welch–Satterthwaite does it for one output
///                                                         (Willink and Hall 2002, Metrologia 39, 361-369)
/// Outputs of different units are weighted by the largest standard uncertainty among those of the same unit.
/// \return ν_eff; infinite where no contribution has finite ones; NaN where none can be stated
[[nodiscard]] double joint_effective_degrees_of_freedom(const MeasurementModel& model, const Propagation& propagation);

/// Second-order terms of the law of propagation, for m outputs.
struct SecondOrderPropagation {
    Eigen::VectorXd standard_uncertainty;  ///< m, with first- and second-order terms
    Eigen::VectorXd shift;                 ///< m, expectation of y minus f(x)
};

/// First- and second-order terms together, with the moments of the distributions of inputs of their own.
///
/// u² = c V cᵀ + ½ tr(H V H V) + Σ_jk V_jk ∂H_jk/∂s, s along V cᵀ;  shift = ½ tr(H V)
/// For uncorrelated inputs: Σ c_i² u_i² + ΣΣ [½ (∂²f/∂x_i∂x_j)² + ∂f/∂x_i ∂³f/∂x_i∂x_j²] u_i² u_j²
///                                                                            (JCGM 100:2008, 5.1.2 note)
/// for normal ones (others: propagation.cpp). Third derivatives by central differences of the exact second ones.
/// \return nothing when the model offers no second derivatives, or they are not finite
/// Accuracy: u to this order within 1e-11 relative (docs/accuracy.md#law-of-propagation).
/// Example: examples/api/budget_by_hand.cpp
[[nodiscard]] std::optional<SecondOrderPropagation> propagate_to_second_order(const MeasurementModel& model,
                                                                              const Propagation& first_order);

/// The root of the correlation matrix of a group whose factor is known: its rows over the standard uncertainties.
/// \pre group.factor is not empty
/// \return n×n, lower triangular; a row of zeros for a quantity without uncertainty
[[nodiscard]] Eigen::MatrixXd known_correlation_root(const InputGroup& group);

/// Correlation matrix of a covariance matrix.
/// \param covariance  m×m, symmetric, diagonal ≥ 0
/// \return m×m; 1 on the diagonal, 0 beside a zero variance; clamped to −1 … 1
[[nodiscard]] Eigen::MatrixXd correlation_matrix(const Eigen::MatrixXd& covariance);

}  // namespace gumcert::gum
