#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gum/propagation.h"
#include "gum/quantity/distribution.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

/// A term c X of a sum of independent quantities; only the distribution about its centre matters: the location of a
/// symmetric distribution, the expectation of any other.
struct ConvolutionTerm {
    double sensitivity = 1.0;  ///< c, [unit of y / unit of x]
    Distribution distribution;
    std::uint64_t draws = 0;  ///< whose values stand for the distribution; 0: it is known as it is
};

/// Ends of an interval about 0, [unit of y].
struct ConvolutionInterval {
    double low = 0.0;
    double high = 0.0;
};

/// The probabilistically symmetric interval of Σ c_i (X_i − x_i) for independent quantities: P(below) = P(above) =
/// (1 − p)/2.
///
/// Symmetric distributions with a known characteristic function: the Fourier series of the distribution on a wide
/// interval. Others, and where that series falls slowly: probabilities of cells of a grid, multiplied as Fourier
/// transforms. All normal terms enter as one; a single symmetric term by its quantile.
/// \throws InputError  GC-GUM-0004 for p; GC-GUM-0060 without a term of scale > 0, or with one that has a problem
/// Accuracy: relative error below 2e-6 of symmetric terms, of t-distributions from ν = 2 on; 4e-4 of others, 5e-3 from
/// ν = 1 on (docs/accuracy.md#convolution-of-contributions).
/// Example: examples/api/coverage_factor.cpp
[[nodiscard]] ConvolutionInterval convolution_interval(std::span<const ConvolutionTerm> terms,
                                                       double coverage_probability);

/// Half of its width: of symmetric terms the U with P(|Σ c_i (X_i − x_i)| ≤ U) = p.
[[nodiscard]] double convolution_half_width(std::span<const ConvolutionTerm> terms, double coverage_probability);

/// P(Σ c_i (X_i − x_i) ≤ x), for independent quantities: what a decision on conformity needs, because a k of t_p(ν_eff)
/// that agrees at 95 % says nothing of other probabilities.
///
/// Symmetric terms with known characteristic functions: a Fourier series, as in convolution_interval(). Others, and where
/// that falls slowly: the widest term enters by its own distribution function, so that the edges of a rectangular
/// distribution stay where they are; the others are convolved numerically about it, as far as their tails reach. Copies
/// share the table and are cheap; threads may share it.
class ConvolutionDistribution {
public:
    /// \throws InputError  GC-GUM-0060 without a term of scale > 0, or with one that has a problem
    explicit ConvolutionDistribution(std::span<const ConvolutionTerm> terms);

    /// \param x  [unit of y], not NaN
    /// Accuracy: absolute error below 2e-6 of symmetric terms without samples where t-distributions have 3 degrees of
    /// freedom or more, or one of them 2 or more and all others 10; 1e-4 of others.
    [[nodiscard]] double operator()(double x) const;

    /// P(… < x), which differs where samples are the only term: each of them has a probability of its own.
    [[nodiscard]] double below(double x) const;

    /// Whether possible values of the sum are listed, each with a probability of its own: of samples alone, if not too many.
    [[nodiscard]] bool has_single_values() const;

    /// What is smaller is not known to a hundredth of itself: 1e-9 of most symmetric terms, 1e-7 on cells of a grid, 1e-5
    /// of symmetric ones whose t-distributions have so few degrees of freedom that the series is cut, 1/n of n samples with
    /// 0.1 % of the variance or more. 0 of another single term.
    [[nodiscard]] double least_probability() const;

    /// Draws that stand for a part of the sum with 0.1 % of the variance or more: a probability p scatters by no more than
    /// √(p (1 − p)/draws) about that of more draws. 0: nothing is drawn.
    [[nodiscard]] std::uint64_t draws() const;

private:
    struct Table;
    std::shared_ptr<const Table> table_;
};

/// The same for one x.
/// \throws InputError  as the class
[[nodiscard]] double convolution_distribution(std::span<const ConvolutionTerm> terms, double x);

/// Expanded uncertainty of an output from the distribution of the sum of its contributions.
struct ConvolvedOutput {
    double expanded_uncertainty = 0.0;  ///< half the width of the probabilistically symmetric interval
    double coverage_factor = 0.0;       ///< U / u(y)
    double asymmetry = 0.0;        ///< where the middle of that interval lies beside y, in parts of U; 0: symmetric
    double numerical_error = 0.0;  ///< standard uncertainty of the coverage factor from the draws of groups; 0: none
    std::uint64_t draws = 0;       ///< of a group that is drawn by a copula; 0: none
};

/// True when the convolution certainly moves k by less than 1 % away from t_p(ν_eff): a bound from the shares of the
/// contributions, their shapes and degrees of freedom, far cheaper than the convolution. False says nothing.
[[nodiscard]] bool convolution_changes_little(const MeasurementModel& model, const Propagation& propagation,
                                              Eigen::Index output);
/// The same of terms that are known one by one.
/// \param contributions  standard uncertainty |c| u of each term, [unit of y]
[[nodiscard]] bool convolution_changes_little(std::span<const ConvolutionTerm> terms,
                                              std::span<const double> contributions, double coverage_probability);

/// True where the k of the convolution is so far away from t_p(ν_eff) that it is taken: by more than 1 % (ADR 0025).
[[nodiscard]] bool is_noticed_change(double k_of_convolution, double k);

/// The contributions of all inputs to an output: the distribution of Y − y is their convolution.
///
/// Single quantities enter by their distributions, groups that are normal or t as a whole by the t-distribution of their
/// standard uncertainty and degrees of freedom. Of a copula and of rows, quantities without effect are left out; what is
/// independent of the others enters by itself, normal quantities as a normal one, others through 65 536 draws or their rows.
/// \return nothing when no contribution is left, or the degrees of freedom of a group are not known
[[nodiscard]] std::optional<std::vector<ConvolutionTerm>> convolution_terms(const MeasurementModel& model,
                                                                            const Propagation& propagation,
                                                                            Eigen::Index output);

/// True where that distribution is a normal one or a t-distribution, and no other: the contributions are normal, or a
/// single one has degrees of freedom.
[[nodiscard]] bool is_normal_or_student(const MeasurementModel& model, const Propagation& propagation,
                                        Eigen::Index output);
/// The same of terms that are known one by one.
[[nodiscard]] bool is_normal_or_student(std::span<const ConvolutionTerm> terms);

/// The numerical error comes from 16 batches of the draws: the standard deviation of their U, divided by 4.
/// \return nothing when u(y) is 0, or there are no convolution_terms
[[nodiscard]] std::optional<ConvolvedOutput> expand_by_convolution(const MeasurementModel& model,
                                                                   const Propagation& propagation, Eigen::Index output);

}  // namespace gumcert::gum
