#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gum/expression/equation_system.h"

namespace gumcert::gum {

class Tape;

/// What the tangent of an equation leaves out over a box of its inputs, in the unit of the output.
struct TangentBound {
    double low = 0.0, high = 0.0;  ///< f − tangent lies between them everywhere in the box
    double certain = 0.0;          ///< somewhere in the box |f − tangent| is at least this

    /// The largest |f − tangent| that is possible.
    [[nodiscard]] double largest() const { return low < -high ? -low : high; }
};

/// The bound of one root of a tape, or the step that allows none.
struct TapeBound {
    std::optional<TangentBound> bound;
    std::optional<std::size_t> step;  ///< none beside no bound: the sum of all of them is not finite
};

/// The bound of one output of a tape without residuals.
///
/// Taylor's theorem with the remainder of Lagrange: f(x) − f(x0) − J (x − x0) = ½ Σ_ij H_ij(ξ) d_i d_j for a ξ between x0
/// and x. The Hessian is enclosed over the whole box by the rules of derivation in interval arithmetic
/// (R. E. Moore, R. B. Kearfott, M. J. Cloud: Introduction to Interval Analysis, SIAM 2009), every rounding on the
/// outside. `certain` is the largest |f − tangent| that is sure at the ends of each input alone, and at the two points
/// x ± V c/u_r where the tangent changes by u_r: c the slope, r half the box, V = diag(r²), u_r² = cᵀ V c. With r = k u
/// these are the ends of the coverage interval, where a normal distribution is densest.
/// \param root       position of the output
/// \param x          centre, n leaves
/// \param low, high  the box, low ≤ x ≤ high; a leaf with low = high does not vary
[[nodiscard]] TapeBound tangent_bound(const Tape& tape, std::size_t root, const Eigen::VectorXd& x,
                                      const Eigen::VectorXd& low, const Eigen::VectorXd& high);

/// The bound of one output, or why there is none, as a phrase.
struct OutputBound {
    std::optional<TangentBound> bound;  ///< in coherent SI
    std::string why_not;                ///< "" where there is one
};
/// The bound of one output of explicit equations.
/// \param output     its position, in the order of EquationSystem::compile()
/// \param low, high  a box about the estimates x, low ≤ x ≤ high; all in coherent SI
/// \throws InputError  as EquationSystem::compile()
[[nodiscard]] OutputBound tangent_bound(std::span<const EquationText> equations, std::span<const InputSymbol> inputs,
                                        std::size_t output, const Eigen::VectorXd& x, const Eigen::VectorXd& low,
                                        const Eigen::VectorXd& high);

/// Steps times leaves that vary, at most: more would take too long.
inline constexpr std::size_t k_largest_bounded_model = 20'000'000;

}  // namespace gumcert::gum
