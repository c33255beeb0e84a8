#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gum/propagation.h"
#include "gum/quantity/distribution.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

/// A term c X of a sum of independent quantities; only the distribution about its centre matters.
struct ConvolutionTerm {
    double sensitivity = 1.0;   ///< c, [unit of y / unit of x]
    Distribution distribution;  ///< symmetric about its location
};

/// Half-width U with P(|Σ c_i (X_i − x_i)| ≤ U) = p, for independent quantities with symmetric distributions.
///
/// The distributions are convolved numerically: probabilities of cells of a grid, multiplied as Fourier transforms. All
/// normal terms enter as one.
/// \return U, [unit of y]
/// \throws InputError  GC-GUM-0004 for p; GC-GUM-0060 without a term of scale > 0, or with one that is not symmetric
/// Accuracy: relative error below 2e-6 where no term has a t-distribution with fewer than 3 degrees of freedom.
[[nodiscard]] double convolution_half_width(std::span<const ConvolutionTerm> terms, double coverage_probability);

/// P(Σ c_i (X_i − x_i) ≤ x), for independent quantities with symmetric distributions: what a decision on conformity
/// needs where bounded inputs dominate.
///
/// The widest term enters by its own distribution function, so that the edges of a rectangular distribution stay where
/// they are; the others are convolved numerically about it. Copies share the table and are cheap; threads may share it.
class ConvolutionDistribution {
public:
    /// \throws InputError  GC-GUM-0060 without a term of scale > 0, or with one that is not symmetric
    explicit ConvolutionDistribution(std::span<const ConvolutionTerm> terms);

    /// \param x  [unit of y], not NaN
    /// Accuracy: absolute error below 1e-6 where no term has a t-distribution with fewer than 3 degrees of freedom.
    [[nodiscard]] double operator()(double x) const;

private:
    struct Table;
    std::shared_ptr<const Table> table_;
};

/// The same for one x. \throws InputError  as the class
[[nodiscard]] double convolution_distribution(std::span<const ConvolutionTerm> terms, double x);

/// Expanded uncertainty of an output whose distribution is not normal because bounded inputs dominate it.
struct DominatedOutput {
    double expanded_uncertainty = 0.0;
    double coverage_factor = 0.0;         ///< U / u(y)
    std::vector<std::size_t> dominating;  ///< groups, one or two, the larger one first
    std::vector<ConvolutionTerm> terms;   ///< all inputs: the distribution of Y − y is their convolution
};

/// One or two inputs with bounded distributions dominate an output when all other contributions together are not more
/// than 0.3 of theirs: the criterion of EA-4/02, S9.14 (one rectangular) and S10.13 (two). A factor k taken from the
/// normal or t-distribution would claim too much then; the exact convolution of all inputs gives the right one.
///
/// \return nothing when none dominates, so that k = t_p(ν_eff) stands; or when a distribution that is not symmetric
///         contributes, which only Monte Carlo can add
[[nodiscard]] std::optional<DominatedOutput> expand_dominated_output(const MeasurementModel& model,
                                                                     const Propagation& propagation,
                                                                     Eigen::Index output);

}  // namespace gumcert::gum
