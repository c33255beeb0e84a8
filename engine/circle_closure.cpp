#include "engine/circle_closure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Ratio of the eigenvalues of the normal equations below which deviations count as not determined. A design that
// determines them has a ratio above 1/(4 n²).
constexpr double k_rank_tolerance = 1e-9;

Index at(std::size_t i) {
    return static_cast<Index>(i);
}

/// The readings of every series, by their positions in the list.
std::vector<std::vector<std::size_t>> by_series(const CircleClosureMeasurement& m) {
    std::vector<std::vector<std::size_t>> all(m.series.size());
    for (std::size_t r = 0; r < m.readings.size(); ++r) {
        all[m.readings[r].series].push_back(r);
    }
    return all;
}

/// Rows of T and P that a reading compares, with the sign of P.
struct Row {
    Index table = 0, side = 0;
    double sign = 1.0;
};

Row row_of(const CircleClosureMeasurement& m, const ClosureReading& reading) {
    return {.table = at(reading.step % m.steps),
            .side = at(m.steps + m.side_at(m.series[reading.series].position, reading.step)),
            .sign = m.against ? -1.0 : 1.0};
}

/// Orthonormal columns of what a series has of its own: its zero, and its slope where drift is removed.
MatrixXd own_columns(const CircleClosureMeasurement& m, const std::vector<std::size_t>& rows) {
    const Index count = at(rows.size());
    MatrixXd own(count, m.removes_drift ? 2 : 1);
    own.col(0).setConstant(1.0 / std::sqrt(static_cast<double>(count)));
    if (m.removes_drift) {
        for (Index r = 0; r < count; ++r) {
            own(r, 1) =
                static_cast<double>(m.readings[rows[static_cast<std::size_t>(r)]].step) / static_cast<double>(m.steps);
        }
        own.col(1).array() -= own.col(1).mean();
        own.col(1).normalize();
    }
    return own;
}

/// Removes from the columns of a matrix (one a reading) what every series has of its own.
void remove_own(const CircleClosureMeasurement& m, MatrixXd& matrix) {
    for (const std::vector<std::size_t>& rows : by_series(m)) {
        const MatrixXd own = own_columns(m, rows);
        MatrixXd part(matrix.rows(), own.rows());
        for (Index r = 0; r < own.rows(); ++r) {
            part.col(r) = matrix.col(at(rows[static_cast<std::size_t>(r)]));
        }
        // The projection off the columns of a series is what is left after its zero and slope have been fitted.
        // Eliminated so, hundreds of series add no unknowns.
        part -= (part * own).eval() * own.transpose();
        for (Index r = 0; r < own.rows(); ++r) {
            matrix.col(at(rows[static_cast<std::size_t>(r)])) = part.col(r);
        }
    }
}

/// Normal equations of T and P, without what every series has of its own.
MatrixXd normal_equations(const CircleClosureMeasurement& m) {
    MatrixXd R = MatrixXd::Zero(at(2 * m.steps), at(2 * m.steps));
    for (const std::vector<std::size_t>& rows : by_series(m)) {
        MatrixXd A = MatrixXd::Zero(at(rows.size()), R.cols());
        for (Index r = 0; r < A.rows(); ++r) {
            const Row row = row_of(m, m.readings[rows[static_cast<std::size_t>(r)]]);
            A(r, row.table) += 1.0;
            A(r, row.side) += row.sign;
        }
        const MatrixXd own = own_columns(m, rows);
        const MatrixXd shared = own.transpose() * A;
        // Zeros and slopes are eliminated by projecting the readings off the own columns: they are no unknowns of R.
        R += A.transpose() * A - shared.transpose() * shared;
    }
    return R;
}

/// The inverse under Σ T = 0 and Σ P = 0, and the condition number.
std::pair<MatrixXd, double> cofactors_of(const CircleClosureMeasurement& m) {
    const MatrixXd R = normal_equations(m);
    const Index n = at(m.steps);
    MatrixXd datum = MatrixXd::Zero(2 * n, 2 * n);
    datum.topLeftCorner(n, n).setConstant(1.0 / static_cast<double>(n));
    datum.bottomRightCorner(n, n).setConstant(1.0 / static_cast<double>(n));
    // The datum Σ T = Σ P = 0 is added as a matrix in the two directions that no reading knows, with the mean weight of
    // the others so that it does not decide the condition number, and is taken off the inverse again.
    const double weight = R.trace() / static_cast<double>(2 * n);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(R + weight * datum));
    const double least = eigen.eigenvalues()(0);
    const double most = eigen.eigenvalues()(2 * n - 1);
    // That the positions suffice is arithmetic (common_divisor). What missing readings leave open shows only in the
    // eigenvalues.
    if (!(least > k_rank_tolerance * most)) {
        throw gum::NoResultError(gum::Diagnostic{
            .code = "GC-CLOSURE-0010",
            .where = "readings",
            .what = "the deviations of the two circles are not determined by the readings",
            .rule = m.removes_drift ? "a drift can be told from the deviations only by readings after a full turn"
                                    : "every step and every side must be tied to all others by readings in different "
                                      "positions",
            .action = m.removes_drift ? "Measure step n, the closing reading, in the series; or leave \"drift\" out."
                                      : "Measure further positions, or the steps that are missing."});
    }
    MatrixXd inverse =
        eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
    // In the two directions of the datum the eigenvalue is the weight that was put there: what it makes of the inverse
    // is no variance.
    inverse -= datum / weight;
    return {0.5 * (inverse + inverse.transpose()), most / least};
}

/// Zero and slope of every series, and the residuals of its readings.
void fill_series(const CircleClosureMeasurement& m, CircleClosureSolution& solution) {
    solution.residuals = VectorXd::Zero(at(m.readings.size()));
    solution.zero = VectorXd::Zero(at(m.series.size()));
    solution.drift = VectorXd::Zero(at(m.series.size()));
    const auto all = by_series(m);
    for (std::size_t s = 0; s < all.size(); ++s) {
        const Index count = at(all[s].size());
        VectorXd left(count);
        VectorXd turn(count);
        for (Index r = 0; r < count; ++r) {
            const ClosureReading& reading = m.readings[all[s][static_cast<std::size_t>(r)]];
            const Row row = row_of(m, reading);
            left(r) =
                m.sense * reading.value - solution.deviations(row.table) - row.sign * solution.deviations(row.side);
            turn(r) = static_cast<double>(reading.step) / static_cast<double>(m.steps);
        }
        const VectorXd centred = turn.array() - turn.mean();
        const double slope = m.removes_drift ? centred.dot(left) / centred.squaredNorm() : 0.0;
        solution.drift(at(s)) = slope;
        solution.zero(at(s)) = left.mean() - slope * turn.mean();
        for (Index r = 0; r < count; ++r) {
            solution.residuals(at(all[s][static_cast<std::size_t>(r)])) =
                left(r) - solution.zero(at(s)) - slope * turn(r);
        }
    }
}

/// 1 − leverage of every reading.
VectorXd redundancy_of(const CircleClosureMeasurement& m, const CircleClosureSolution& solution) {
    VectorXd redundancy = VectorXd::Ones(at(m.readings.size()));
    for (const std::vector<std::size_t>& rows : by_series(m)) {
        const MatrixXd own = own_columns(m, rows);
        for (Index r = 0; r < own.rows(); ++r) {
            const std::size_t reading = rows[static_cast<std::size_t>(r)];
            const Row row = row_of(m, m.readings[reading]);
            const double fitted = solution.from_readings(row.table, at(reading)) +
                                  row.sign * solution.from_readings(row.side, at(reading));
            // What the zero of the series takes over of the deviations is in the columns of from_readings already: they
            // are orthogonal to the own columns, so that the projections add up.
            double own_of_fit = 0.0;
            for (Index other = 0; other < own.rows(); ++other) {
                const std::size_t one = rows[static_cast<std::size_t>(other)];
                const Row of = row_of(m, m.readings[one]);
                own_of_fit += own.row(r).dot(own.row(other)) * (solution.from_readings(of.table, at(reading)) +
                                                                of.sign * solution.from_readings(of.side, at(reading)));
            }
            redundancy(at(reading)) =
                std::clamp(1.0 - own.row(r).squaredNorm() - m.sense * (fitted - own_of_fit), 0.0, 1.0);
        }
    }
    return redundancy;
}

/// Readings of one position and step that were repeated, less the zeros (and slopes) of their series: what is left is
/// the scatter of the instrument alone. Nothing without repetitions.
std::optional<ClosureTest> misfit_of(const CircleClosureMeasurement& m, const CircleClosureSolution& solution) {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> cells;
    std::map<std::size_t, std::size_t> series_of_position;
    for (const ClosureSeries& series : m.series) {
        ++series_of_position[series.position];
    }
    for (std::size_t r = 0; r < m.readings.size(); ++r) {
        cells[{m.series[m.readings[r].series].position, m.readings[r].step}].push_back(r);
    }
    // Within a position the residuals of its series are fitted by means of the cells and zeros of the series, which are
    // orthogonal where no reading is missing; only then the sums of squares part.
    double within = 0.0;
    double nu = 0.0;
    std::map<std::size_t, std::size_t> steps_of_position;
    for (const auto& [cell, members] : cells) {
        if (members.size() != series_of_position[cell.first]) {
            return std::nullopt;
        }
        ++steps_of_position[cell.first];
        double mean = 0.0;
        for (const std::size_t r : members) {
            mean += solution.residuals(at(r)) / static_cast<double>(members.size());
        }
        for (const std::size_t r : members) {
            within += std::pow(solution.residuals(at(r)) - mean, 2);
        }
    }
    const double own = m.removes_drift ? 2.0 : 1.0;
    for (const auto& [position, count] : steps_of_position) {
        nu += static_cast<double>(series_of_position[position] - 1) * (static_cast<double>(count) - own);
    }
    // F: what steps and sides leave unexplained, over the scatter of repetitions.
    const double left = solution.degrees_of_freedom - nu;
    const double misfit = solution.residuals.squaredNorm() - within;
    if (!(nu > 0.0) || !(left > 0.0) || !(within > 0.0)) {
        return std::nullopt;
    }
    return ClosureTest{.statistic = std::max(misfit, 0.0) / left / (within / nu), .nu = left, .nu_reference = nu};
}

void fill_scatter(const CircleClosureMeasurement& m, CircleClosureSolution& solution) {
    // N readings, less a zero (and a slope) a series, less T and P with n − 1 free deviations each.
    // One sum of T and one of P is fixed by the datum.
    const double own = static_cast<double>(m.series.size()) * (m.removes_drift ? 2.0 : 1.0);
    solution.degrees_of_freedom =
        static_cast<double>(m.readings.size()) - own - 2.0 * (static_cast<double>(m.steps) - 1.0);
    const bool has_scatter = solution.degrees_of_freedom >= 1.0;
    solution.residual_standard_deviation =
        has_scatter ? std::sqrt(solution.residuals.squaredNorm() / solution.degrees_of_freedom) : 0.0;
    if (m.stated_u && has_scatter) {
        solution.against_stated =
            ClosureTest{.statistic = std::pow(solution.residual_standard_deviation / *m.stated_u, 2),
                        .nu = solution.degrees_of_freedom,
                        .nu_reference = m.stated_degrees_of_freedom};
    }
    solution.against_repetition = misfit_of(m, solution);
    if (m.uses_stated_u) {
        solution.u_reading = *m.stated_u;
        solution.nu_reading = m.stated_degrees_of_freedom;
        return;
    }
    solution.u_reading = solution.residual_standard_deviation;
    solution.nu_reading = solution.degrees_of_freedom;
    double largest = 0.0;
    for (const ClosureReading& reading : m.readings) {
        largest = std::max(largest, std::abs(reading.value));
    }
    // Residuals of pure rounding would give an uncertainty of 10⁻¹² of the readings, which no instrument has.
    constexpr double k_rounding = 1e-12;  // of the readings
    if (!has_scatter || !(solution.u_reading > k_rounding * largest)) {
        throw gum::NoResultError(gum::Diagnostic{
            .code = "GC-CLOSURE-0011",
            .where = "readings",
            .what = has_scatter ? "the residuals are all 0"
                                : "there are no more readings than unknowns, so that no scatter can be seen",
            .rule = "the uncertainty of a reading comes from the residuals, or from earlier work",
            .action = "State \"repeatability\" with \"use\": \"stated\", or measure more positions."});
    }
}

double range_of(const VectorXd& values, Index first, Index count) {
    return values.segment(first, count).maxCoeff() - values.segment(first, count).minCoeff();
}

}  // namespace

std::size_t common_divisor(const CircleClosureMeasurement& m) {
    // Positions whose differences all have a divisor g with n never bring sides together that lie less than g apart:
    // deviations that repeat g times a turn look alike in all of them.
    std::size_t divisor = m.steps;
    for (const ClosureSeries& series : m.series) {
        const std::size_t first = m.series.front().position;
        divisor = std::gcd(divisor, series.position > first ? series.position - first : first - series.position);
    }
    return divisor;
}

CircleClosureSolution solve_circle_closure(const CircleClosureMeasurement& m) {
    CircleClosureSolution solution;
    auto [cofactors, condition] = cofactors_of(m);
    solution.cofactors = std::move(cofactors);
    solution.condition_number = condition;
    // The solution as a matrix, not only as values: uncertainties, effects and residuals all need how each reading
    // acts.
    solution.from_readings.resize(at(2 * m.steps), at(m.readings.size()));
    VectorXd values(at(m.readings.size()));
    for (std::size_t r = 0; r < m.readings.size(); ++r) {
        const Row row = row_of(m, m.readings[r]);
        solution.from_readings.col(at(r)) =
            m.sense * (solution.cofactors.col(row.table) + row.sign * solution.cofactors.col(row.side));
        values(at(r)) = m.readings[r].value;
    }
    remove_own(m, solution.from_readings);
    solution.deviations = solution.from_readings * values;
    fill_series(m, solution);
    solution.redundancy = redundancy_of(m, solution);
    fill_scatter(m, solution);
    return solution;
}

CircleClosureModel::CircleClosureModel(const CircleClosureMeasurement& m,
                                       std::shared_ptr<const CircleClosureSolution> solution, Inputs inputs)
    : solution_(std::move(solution)), steps_(at(m.steps)) {
    const bool readings = inputs == Inputs::readings;
    const CircleClosureSolution& solved = *solution_;
    gum::InputGroup group;
    group.name = "scatter of the readings";
    group.source = "scatter of the readings";
    group.unit = "rad";
    group.evaluation = gum::Evaluation::type_a;
    group.degrees_of_freedom = solved.nu_reading;
    const bool normal = std::isinf(solved.nu_reading);
    group.distribution = normal ? "normal" : "student_t";
    const double variance = solved.u_reading * solved.u_reading;
    basis_ = readings ? at(m.readings.size()) : 2 * steps_;
    if (readings) {
        from_basis_ = solved.from_readings;
        group.value.resize(basis_);
        for (std::size_t r = 0; r < m.readings.size(); ++r) {
            group.value(at(r)) = m.readings[r].value;
        }
        group.covariance = MatrixXd::Constant(basis_, 1, variance);
    } else {
        // The readings share one s. Drawn one by one, each with a t of its own, they would give deviations with lighter
        // tails than one variance has (ADR 0033): so the deviations are drawn together.
        from_basis_ = MatrixXd::Identity(basis_, basis_);
        group.value = solved.deviations;
        group.covariance = variance * solved.cofactors;
        group.dependence = normal ? gum::Dependence::normal : gum::Dependence::student_t;
        for (Index i = 0; i < basis_; ++i) {
            const double u = std::sqrt(group.covariance(i, i));
            group.marginals.push_back(normal ? gum::Distribution::normal(group.value(i), u)
                                             : gum::Distribution::student_t(group.value(i), u, solved.nu_reading));
        }
    }
    groups_.push_back(std::move(group));
    add_effects(m);
    for (const char* const circle : {"T", "P"}) {
        for (Index i = 0; i < steps_; ++i) {
            outputs_.push_back({circle + std::string("_") + std::to_string(i), "rad"});
        }
    }
    outputs_.push_back({"range of T", "rad"});
    outputs_.push_back({"range of P", "rad"});
}

void CircleClosureModel::add_effects(const CircleClosureMeasurement& m) {
    Index next = basis_;
    std::vector<VectorXd> columns;
    const Index readings = at(m.readings.size());
    for (const ClosureEffect& effect : m.effects) {
        Index count = 1;
        MatrixXd pattern;  // N×count: what each quantity adds to every reading
        const auto angle = [&](std::size_t r) {
            return 2.0 * std::numbers::pi * static_cast<double>(m.readings[r].step) / static_cast<double>(m.steps);
        };
        if (effect.pattern == ClosurePattern::reading) {
            count = readings;
        } else if (effect.pattern == ClosurePattern::step || effect.pattern == ClosurePattern::side) {
            count = steps_;
        } else if (effect.pattern == ClosurePattern::once_per_turn) {
            // The phase of an eccentricity is not known. Cosine and sine of one amplitude have a sum whose uncertainty
            // is the same at every angle.
            count = 2;
        }
        if (effect.pattern == ClosurePattern::scale) {
            scales_.push_back(next);
        } else if (effect.pattern != ClosurePattern::reading) {
            pattern = MatrixXd::Zero(readings, count);
            for (Index r = 0; r < readings; ++r) {
                const auto one = static_cast<std::size_t>(r);
                const Row row = row_of(m, m.readings[one]);
                switch (effect.pattern) {
                    case ClosurePattern::step:
                        pattern(r, row.table) = 1.0;
                        break;
                    case ClosurePattern::side:
                        pattern(r, row.side - steps_) = 1.0;
                        break;
                    case ClosurePattern::turn:
                        pattern(r, 0) = angle(one) / (2.0 * std::numbers::pi);
                        break;
                    default:
                        pattern(r, 0) = std::cos(angle(one));
                        pattern(r, 1) = std::sin(angle(one));
                        break;
                }
            }
        }
        if (effect.pattern != ClosurePattern::scale) {
            const MatrixXd moved = effect.pattern == ClosurePattern::reading
                                       ? solution_->from_readings
                                       : MatrixXd(solution_->from_readings * pattern);
            for (Index c = 0; c < count; ++c) {
                // An effect is in the readings; correcting for it takes it off.
                columns.emplace_back(-moved.col(c));
                additive_.push_back(next + c);
            }
        }
        gum::InputGroup group;
        group.name = effect.name;
        group.source = effect.source;
        group.unit = effect.pattern == ClosurePattern::scale ? "1" : "rad";
        group.evaluation = effect.evaluation;
        group.distribution = std::string(gum::distribution_name(effect.distribution.kind));
        group.value = VectorXd::Constant(count, effect.value);
        group.covariance = MatrixXd::Constant(count, 1, effect.u * effect.u);
        group.degrees_of_freedom = effect.degrees_of_freedom;
        group.marginals.assign(static_cast<std::size_t>(count), effect.distribution);
        groups_.push_back(std::move(group));
        next += count;
    }
    from_effects_.resize(2 * steps_, at(columns.size()));
    for (std::size_t c = 0; c < columns.size(); ++c) {
        from_effects_.col(at(c)) = columns[c];
    }
}

VectorXd CircleClosureModel::evaluate(const VectorXd& x) const {
    MatrixXd y(1, at(outputs_.size()));
    evaluate_trials(x.transpose(), y);
    return y.row(0).transpose();
}

void CircleClosureModel::evaluate_trials(const Eigen::Ref<const MatrixXd>& x, Eigen::Ref<MatrixXd> y) const {
    const Index n = steps_;
    VectorXd factor = VectorXd::Ones(x.rows());
    for (const Index scale : scales_) {
        factor += x.col(scale);
    }
    // A scale acts on deviations as a factor, hence on what the readings give and not on the corrections of other
    // effects.
    MatrixXd deviations = x.leftCols(basis_) * from_basis_.transpose();
    deviations.array().colwise() *= factor.array();
    if (!additive_.empty()) {
        deviations += x(Eigen::all, additive_) * from_effects_.transpose();
    }
    y.leftCols(2 * n) = deviations;
    for (Index trial = 0; trial < x.rows(); ++trial) {
        y(trial, 2 * n) = range_of(deviations.row(trial).transpose(), 0, n);
        y(trial, 2 * n + 1) = range_of(deviations.row(trial).transpose(), n, n);
    }
}

MatrixXd CircleClosureModel::jacobian(const VectorXd& x) const {
    const Index n = steps_;
    double factor = 1.0;
    for (const Index scale : scales_) {
        factor += x(scale);
    }
    MatrixXd J = MatrixXd::Zero(at(outputs_.size()), x.size());
    J.topLeftCorner(2 * n, basis_) = factor * from_basis_;
    const VectorXd unscaled = from_basis_ * x.head(basis_);
    for (const Index scale : scales_) {
        J.col(scale).head(2 * n) = unscaled;
    }
    for (std::size_t c = 0; c < additive_.size(); ++c) {
        J.col(additive_[c]).head(2 * n) = from_effects_.col(at(c));
    }
    const VectorXd y = evaluate(x);
    for (const Index circle : {Index{0}, Index{1}}) {
        // The range follows the two steps that are extreme here. Where two are equally extreme it has no derivative;
        // that of one of them is taken.
        Index most = 0;
        Index least = 0;
        (void)y.segment(circle * n, n).maxCoeff(&most);
        (void)y.segment(circle * n, n).minCoeff(&least);
        J.row(2 * n + circle) = J.row(circle * n + most) - J.row(circle * n + least);
    }
    return J;
}

}  // namespace gumcert::engine
