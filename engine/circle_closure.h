#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gum/quantity/measurement_model.h"

namespace gumcert::engine {

/// One reading of the instrument that compares two divided circles.
struct ClosureReading {
    std::size_t series = 0;  ///< its run over the steps, with one setting of the artefact against the table
    std::size_t step = 0;    ///< of the table, 0 … n; step n is step 0 after a full turn
    double value = 0.0;      ///< [rad]
};

/// One run over the steps of the table. Its zero is of its own.
struct ClosureSeries {
    std::size_t position = 0;  ///< side of the artefact that is in the line of sight at step 0
    std::string repetition;    ///< "" where the position was measured once
};

/// What an effect that is stated moves.
enum class ClosurePattern {
    scale,    ///< every reading in proportion to itself, [1]
    reading,  ///< every reading by an error of its own, [rad]
    step,     ///< all readings at one step of the table by one error, [rad]
    side,     ///< all readings at one side of the artefact by one error, [rad]
    turn,     ///< every reading in proportion to the part of the turn, the same in all series; at a full turn [rad]
    once_per_turn,  ///< a cosine and a sine of the angle of the table, of one amplitude each, [rad]
};

/// An influence quantity that the readings do not show: a row of the budget.
struct ClosureEffect {
    std::string name, source;
    ClosurePattern pattern = ClosurePattern::reading;
    gum::Evaluation evaluation = gum::Evaluation::type_b;
    double value = 0.0, u = 0.0;
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
    gum::Distribution distribution;
};

/// A divided circle compared with another one at n equal steps, in several relative positions.
///
/// Series s has the artefact at position k_s. At step j of the table side i is in the line of sight, and the sense σ of
/// the reading is that in which the table turns:
///   σ m_sj = T_j + P_i + a_s + e,  i = (k_s − j) mod n   sides numbered in the sense in which the table turns
///   σ m_sj = T_j − P_i + a_s + e,  i = (k_s + j) mod n   sides numbered against it
/// T_j and P_i are deviations of angles from j and i times 360°/n; Σ T_j = Σ P_i = 0 is the datum, a_s any zero.
///                                                  (dual closure: Estler 1998, J. Res. NIST 103, 141-151)
struct CircleClosureMeasurement {
    std::size_t steps = 0;       ///< n
    bool against = false;        ///< sides are numbered against the sense of the table
    double sense = 1.0;          ///< σ: +1 or −1
    bool removes_drift = false;  ///< every series has a slope of its own; it needs closing readings (step n)
    std::vector<ClosureSeries> series;
    std::vector<ClosureReading> readings;
    std::vector<ClosureEffect> effects;
    /// Standard uncertainty of one reading, where earlier work states it, [rad]
    std::optional<double> stated_u;
    double stated_degrees_of_freedom = std::numeric_limits<double>::infinity();
    bool uses_stated_u = false;  ///< in place of the scatter of the residuals

    [[nodiscard]] std::size_t side_at(std::size_t position, std::size_t step) const {
        const std::size_t j = step % steps;
        return against ? (position + j) % steps : (position + steps - j) % steps;
    }
};

/// Test of a ratio of variances.
struct ClosureTest {
    double statistic = 0.0;  ///< F: ratio of the variances
    double nu = 0.0, nu_reference = std::numeric_limits<double>::infinity();
};

/// Least-squares solution. All angles [rad].
struct CircleClosureSolution {
    Eigen::MatrixXd from_readings;  ///< 2n×N: T, then P, from the readings m
    Eigen::MatrixXd cofactors;      ///< 2n×2n: covariance of T and P for readings of variance 1
    Eigen::VectorXd deviations;     ///< 2n, of the readings as they are
    Eigen::VectorXd residuals;      ///< N
    Eigen::VectorXd redundancy;     ///< N, part of an error of a reading that its residual shows, 0 … 1
    Eigen::VectorXd zero, drift;    ///< one a series, a_s and the slope over a full turn
    double degrees_of_freedom = 0.0;
    double residual_standard_deviation = 0.0;  ///< s; 0 without degrees of freedom
    double condition_number = 1.0;             ///< of the normal equations
    double u_reading = 0.0;                    ///< standard uncertainty of one reading, as used
    double nu_reading = 0.0;
    std::optional<ClosureTest> against_stated;      ///< scatter of the residuals, and the stated u
    std::optional<ClosureTest> against_repetition;  ///< misfit of the model, and the scatter of repetitions
};

/// Greatest common divisor of all differences of positions and n. 1: all deviations are determined. g > 1: those that
/// repeat g times a turn look alike in all positions.
[[nodiscard]] std::size_t common_divisor(const CircleClosureMeasurement& measurement);

/// Solves the comparison of two circles by least squares: the zeros (and slopes) of the series are eliminated, and the
/// normal equations of T and P, 2n with the two conditions of closure, are solved by an eigenvalue decomposition.
/// With all n positions and no gaps it is the closed form T_j = mean over the positions − mean of all, and
/// u(T_j) = s √(n − 1)/n with (n − 1)(n − 2) degrees of freedom.
/// \throws gum::NoResultError  GC-CLOSURE-0010 deviations that the readings do not determine, -0011 no scatter to take
///                             an uncertainty from
/// Accuracy: that of the dense solution of all unknowns within 1e-10 of the unit of the readings
/// (docs/accuracy.md#adjustment-of-distances).
/// Example: examples/api/distances.cpp
[[nodiscard]] CircleClosureSolution solve_circle_closure(const CircleClosureMeasurement& measurement);

/// The solution as a measurement model of the GUM layer: readings and effects → T_0 …, P_0 …, range of T, range of P.
///
/// The equations are linear in the readings, so that solving them again is one product; the ranges are those of the
/// solution at hand.
class CircleClosureModel final : public gum::MeasurementModel {
public:
    enum class Inputs {
        readings,  ///< group 0: the N readings
        /// Group 0: the 2n deviations as one quantity with the covariance that the readings give them, drawn together
        /// with one variance (JCGM 102:2011, 5.3.2): the same propagation, and what Monte Carlo draws from.
        deviations,
    };
    CircleClosureModel(const CircleClosureMeasurement& measurement,
                       std::shared_ptr<const CircleClosureSolution> solution, Inputs inputs);

    [[nodiscard]] const std::vector<gum::InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override;
    void evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const override;

private:
    void add_effects(const CircleClosureMeasurement& measurement);

    std::shared_ptr<const CircleClosureSolution> solution_;
    Eigen::Index steps_ = 0, basis_ = 0;  ///< n; inputs of group 0
    Eigen::MatrixXd from_basis_;          ///< 2n×basis
    Eigen::MatrixXd from_effects_;        ///< 2n×effects without the scales
    std::vector<Eigen::Index> scales_;    ///< positions of scale factors in x
    std::vector<Eigen::Index> additive_;  ///< positions in x of the columns of from_effects_
    std::vector<gum::InputGroup> groups_;
    std::vector<gum::OutputQuantity> outputs_;
};

}  // namespace gumcert::engine
