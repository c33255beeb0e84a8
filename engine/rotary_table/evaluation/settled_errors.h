#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>

#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

/// What an adjustment says of the sizes of an error, linearised at its solution.
struct SizesLeft {
    Eigen::VectorXd sizes;
    Eigen::VectorXd u = Eigen::VectorXd::Zero(sizes.size());  ///< standard uncertainties; 0: not asked for
};

/// An error of a measurement that is looked for by the adjustment without it.
struct ErrorModel {
    Eigen::Index count = 1;  ///< of its sizes
    /// Takes errors of these sizes off a measurement.
    std::function<void(RotaryTableMeasurement&, const Eigen::VectorXd&)> take_off;
    std::function<SizesLeft(const JointAdjustment&, const NormalEquations&, const BorderedCovariance&)> sizes;
};

/// Sizes of an error, and the measurement without it.
struct SettledErrors {
    Eigen::VectorXd sizes;
    Eigen::VectorXd taken_off;                            ///< the sizes before the last correction
    std::unique_ptr<RotaryTableMeasurement> measurement;  ///< of the adjustment
    std::unique_ptr<JointAdjustment> without;             ///< at its solution
};

/// Sizes of an error of which the adjustment without it says that nothing is left. A scale error of hundreds of ppm moves
/// temperatures and expansion coefficient, of which the distances know the product only, so far from what is stated
/// that the linearised size is half as large again, and that the adjustment without it comes to no end. The first size is
/// therefore that of fixed temperatures, where the model is nearly linear; the others are those of the whole model, by
/// secants.
/// Several sizes by Broyden's method (C. Broyden, Math. Comp. 19, 1965, 577–593), which of one is that of secants.
/// \return none where an adjustment does not converge, or the sizes do not settle to a thousandth, or to a hundredth of their
///         standard uncertainty: then nothing is known of them but that they are there
[[nodiscard]] std::optional<SettledErrors> settle_errors(const ErrorModel& model, const JointAdjustment& adjustment,
                                                         const StochasticModel& stochastic,
                                                         const SolverOptions& solver);

}  // namespace gumcert::engine
