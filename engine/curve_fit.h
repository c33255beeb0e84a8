#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace gumcert::engine {

/// A curve y = f(x; a) with p parameters, as the fit sees it. Coherent SI.
class Curve {
public:
    virtual ~Curve() = default;

    /// Value and derivatives at one point. Must be safe to call from one thread at a time.
    /// \param x           abscissa, one number a regressor (one for a plain curve)
    /// \param parameters  p values
    /// \param by_parameter  receives ∂f/∂a, p values; has that size on entry
    /// \param by_x          receives ∂f/∂x, one a regressor; has that size on entry; read only for errors in both
    /// variables
    /// \return f; not finite where the curve has no value
    virtual double evaluate(const Eigen::VectorXd& x, const Eigen::VectorXd& parameters, Eigen::VectorXd& by_parameter,
                            Eigen::VectorXd& by_x) const = 0;
    /// True when f is a linear function of the parameters (a term without parameters is allowed): solved directly then,
    /// without start values.
    [[nodiscard]] virtual bool is_linear() const = 0;
};

/// Points of a curve and what is known of their uncertainty.
struct CurveData {
    Eigen::MatrixXd x;  ///< n×q, q regressors
    Eigen::VectorXd y;  ///< n
    /// Standard uncertainties or covariance of y: empty (unknown and equal: ordinary least squares), n×1 standard
    /// uncertainties, or n×n covariance. A single number (n = 1) is a standard uncertainty.
    Eigen::MatrixXd y_uncertainty;
    /// The same of x (q = 1 only, and only beside y_uncertainty): empty means x is exact. Errors of x and of y are
    /// taken as independent of each other.
    Eigen::MatrixXd x_uncertainty;
    /// The stated uncertainties are true up to one common factor, which the residuals tell (relative weights). Without
    /// y_uncertainty this is always so.
    bool scale_by_residuals = false;
};

struct CurveFit {
    Eigen::VectorXd parameters;  ///< p
    Eigen::MatrixXd covariance;  ///< p×p, of the parameters
    /// p×p, lower triangular, L with L Lᵀ = covariance. Of a result of the curve, ‖c L‖² keeps the digits that c V cᵀ
    /// loses where x lies far from 0 beside its range: V, rounded, is singular there (docs/accuracy.md#fits-of-curves).
    Eigen::MatrixXd factor;
    Eigen::MatrixXd factor_by_x;      ///< p×p, the same of the part that uncertain x make; empty where x is exact
    double degrees_of_freedom = 0.0;  ///< n − p
    double sum_of_squares = 0.0;      ///< Σ r², weighted where weights were given: χ² then (x and y together)
    double residual_standard_deviation = 0.0;  ///< √(sum_of_squares / (n − p)); 0 when n = p
    /// 1 − RSS/TSS, TSS about the (weighted) mean; about 0 without intercept. Empty where all y are equal (TSS = 0) and
    /// with errors in both variables, where it has no agreed meaning.
    std::optional<double> r_squared;
    Eigen::VectorXd residuals;       ///< n, y − f, [unit of y]
    Eigen::MatrixXd adjusted_x;      ///< n×q, errors in both variables: estimated abscissae; else x
    double condition_number = 0.0;   ///< of the weighted design matrix at the solution, columns scaled to unit length
    int iterations = 0;              ///< all attempts together; 0 for a linear curve with exact x
    bool covariance_scaled = false;  ///< by the residuals, not by stated uncertainties alone
    /// Convergence reached: length of the next Gauss–Newton step, measured in the residuals, over
    /// residual_standard_deviation. No parameter would move by more than this part of its standard uncertainty (scaled
    /// by the residuals). 0 for a direct solution and for n = p.
    double relative_offset = 0.0;
    /// Attempts from the same start ended in different minima. The lowest is returned, but the start values decide.
    bool several_minima = false;
};

/// Smallest ratio of singular values of the weighted design matrix (columns scaled to unit length) at which the points
/// count as determining every parameter. Below it, the rounding of the data alone changes the parameters.
inline constexpr double k_curve_rank_tolerance = 1e-12;

/// Least-squares fit of a curve (ordinary, weighted, generalised, errors in both variables).
///
/// Minimises (y − f)ᵀ V_y⁻¹ (y − f), with x uncertain (x − ξ)ᵀ V_x⁻¹ (x − ξ) + (y − f(ξ))ᵀ V_y⁻¹ (y − f(ξ)) over the
/// parameters and the abscissae ξ. Straight lines: ISO/TS 28037:2010, clause 6 (weighted), clause 7 (uncertain x).
/// Covariance (JᵀV⁻¹J)⁻¹ with V = V_y + F V_x Fᵀ, F = diag ∂f/∂x at the solution, first order in the curvature; times
/// sum_of_squares / (n − p) where scaled by the residuals.
///
/// A curve that is linear, with exact x, is solved directly by a Householder factorisation with column pivoting and one
/// step of refinement, in long double. Every other problem is approached from the start values in several ways
/// (Levenberg–Marquardt and dogleg by Ceres, damped Gauss–Newton of our own), polished by Gauss–Newton steps, and
/// accepted only if it converged: relative_offset at most 1e-9, or no longer to be told from the rounding of the curve
/// (a fit that is exact to 15 digits). The last iterate of a search that did not converge is never returned.
///
/// \param start      p values; not read for a linear curve
/// \param names      p names of the parameters, for messages; their count is p
/// \param has_intercept  whether R² is taken about the mean
/// \throws gum::InputError     GC-FIT-0001 sizes; -0002 not finite; -0003 too few points; -0004 standard uncertainties
///                             that are not positive; -0005 covariance not symmetric or not positive definite; -0006
///                             start values; -0007 uncertain x with several regressors or beside unknown uncertainty of
///                             y
/// \throws gum::NoResultError  GC-FIT-0010 rank deficient (with the parameters that are not determined); -0011 not
///                             converged; -0012 a lower sum was met where no minimum was found; -0013 curve not finite
///                             at the start; -0014 curve not linear though said to be
/// Valid as an uncertainty evaluation when the curve is near-linear over the uncertainties of the parameters.
/// Least squares over a curve that is not linear may have several minima: see several_minima, and choose start values
/// from knowledge of the curve.
/// Accuracy: 11 correct digits of the NIST StRD linear sets (9 of Filip), 9 of parameters and 8 of their standard
/// deviations of the nonlinear ones (docs/accuracy.md#fits-of-curves).
/// Example: examples/api/calibration_line.cpp
[[nodiscard]] CurveFit fit_curve(const Curve& curve, const CurveData& data, const Eigen::VectorXd& start,
                                 const std::vector<std::string>& names, bool has_intercept = true);

}  // namespace gumcert::engine
