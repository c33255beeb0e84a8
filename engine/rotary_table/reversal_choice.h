#pragma once

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/variance_components.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// Probability of taking one of the six reversals for dependent on the angle where it is not, over all six.
constexpr double k_reversal_test_level = 0.001;

/// Whether the reversal of one error motion is the same at all angles: F test of the hypothesis that those of all
/// angles are equal, in an adjustment that gives each angle its own (general linear hypothesis; Koch 1999, Parameter
/// Estimation and Hypothesis Testing in Linear Models).
struct ReversalTest {
    std::size_t motion = 0;         ///< 0 to 5, order of `error_motion_names`
    double f = 0.0;                 ///< test value
    double angles = 0.0;            ///< degrees of freedom of the numerator: angles less one
    double residual = 0.0;          ///< of the variance that it is compared with; infinite where it is stated
    double p_value = 1.0;           ///< probability of a larger test value where the reversal is constant
    double spread = 0.0;            ///< root mean square of the reversals about their mean, [m] or [rad]
    bool depends_on_angle = false;  ///< p_value below its share of k_reversal_test_level
};

/// Tests of the six reversals. A drift of each station in its time or order of visits, which separates the senses as a
/// reversal does that grows with the angle, is taken out first.
/// \param by_angle    solved, with a reversal at every angle
/// \param normal      its equations;
/// \param covariance  of their parameters
/// \param components  of the same, one a ComponentRow
/// \param fisher_upper_tail  probability above a value of the F distribution, by value and both degrees of freedom
[[nodiscard]] std::vector<ReversalTest> test_reversals(
    const JointAdjustment& by_angle, const NormalEquations& normal, const BorderedCovariance& covariance,
    const std::vector<VarianceComponent>& components,
    const std::function<double(double, double, double)>& fisher_upper_tail);

/// Whether reversals of single angles could be other than one of all angles, from one Gauss-Newton step at the weights
/// of a solution with one: cheap, and rather once too often than not at all. False where the distances do not determine
/// a reversal at every angle.
/// \param active  distances that take part, one flag a length
[[nodiscard]] bool may_depend_on_angle(const JointAdjustment& constant, const std::vector<bool>& active,
                                       const StochasticModel& stochastic, double rank_tolerance,
                                       const std::function<double(double, double)>& chi_square_upper_tail);

/// What a reader must know of the tests: nothing where no reversal depends on the angle; that each angle has its own
/// where the choice is that of the program, and a warning where the job asks for one of all angles.
[[nodiscard]] std::optional<gum::Diagnostic> reversal_note(const std::vector<ReversalTest>& tests,
                                                           const RotaryTableMeasurement& measurement);

}  // namespace gumcert::engine
