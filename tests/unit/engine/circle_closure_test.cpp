#include "engine/circle_closure.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index at(std::size_t i) {
    return static_cast<Index>(i);
}

struct Truth {
    VectorXd table, artefact;
};

/// Deviations of which each circle adds up to zero.
Truth truth_of(std::size_t n, std::mt19937_64& random) {
    std::normal_distribution<double> normal(0.0, 5.0);
    Truth truth{VectorXd(at(n)), VectorXd(at(n))};
    for (VectorXd* const circle : {&truth.table, &truth.artefact}) {
        for (Index i = 0; i < at(n); ++i) {
            (*circle)(i) = normal(random);
        }
        circle->array() -= circle->mean();
    }
    return truth;
}

struct Design {
    std::size_t steps = 12;
    std::vector<std::size_t> positions;
    std::size_t repetitions = 1;
    bool against = false, closing = false, drift = false;
    double sense = 1.0;
};

std::vector<std::size_t> all_positions(std::size_t n) {
    std::vector<std::size_t> positions(n);
    for (std::size_t k = 0; k < n; ++k) {
        positions[k] = k;
    }
    return positions;
}

CircleClosureMeasurement measured(const Design& design, const Truth& truth, double sigma, std::mt19937_64& random) {
    std::normal_distribution<double> noise(0.0, sigma > 0.0 ? sigma : 1.0);
    CircleClosureMeasurement m;
    m.steps = design.steps;
    m.against = design.against;
    m.sense = design.sense;
    m.removes_drift = design.drift;
    for (const std::size_t position : design.positions) {
        for (std::size_t repetition = 0; repetition < design.repetitions; ++repetition) {
            const std::size_t series = m.series.size();
            m.series.push_back({position, design.repetitions > 1 ? std::to_string(repetition) : ""});
            const double zero = 10.0 * static_cast<double>(series) - 7.0;
            const double slope = design.drift ? 3.0 + static_cast<double>(series) : 0.0;
            for (std::size_t j = 0; j < design.steps + (design.closing ? 1 : 0); ++j) {
                const double side = truth.artefact(at(m.side_at(position, j)));
                const double angle = truth.table(at(j % design.steps)) + (design.against ? -side : side) + zero +
                                     slope * static_cast<double>(j) / static_cast<double>(design.steps);
                m.readings.push_back({series, j, design.sense * (angle + (sigma > 0.0 ? noise(random) : 0.0))});
            }
        }
    }
    return m;
}

/// The same problem without anything of its own: all unknowns in one design matrix, two conditions as heavy rows.
struct Dense {
    VectorXd deviations, residuals;
    MatrixXd cofactors;
    double degrees_of_freedom = 0.0;
};

Dense solved_densely(const CircleClosureMeasurement& m) {
    const Index n = at(m.steps);
    const Index own = m.removes_drift ? 2 : 1;
    const Index N = at(m.readings.size());
    const Index unknowns = 2 * n + own * at(m.series.size());
    MatrixXd A = MatrixXd::Zero(N, unknowns);
    VectorXd y(N);
    for (std::size_t r = 0; r < m.readings.size(); ++r) {
        const ClosureReading& reading = m.readings[r];
        const std::size_t position = m.series[reading.series].position;
        const std::size_t j = reading.step % m.steps;
        const std::size_t side = m.against ? (position + j) % m.steps : (position + m.steps - j) % m.steps;
        A(at(r), at(j)) = 1.0;
        A(at(r), n + at(side)) = m.against ? -1.0 : 1.0;
        A(at(r), 2 * n + own * at(reading.series)) = 1.0;
        if (m.removes_drift) {
            A(at(r), 2 * n + own * at(reading.series) + 1) =
                static_cast<double>(reading.step) / static_cast<double>(m.steps);
        }
        y(at(r)) = m.sense * reading.value;
    }
    // Substitution T_{n-1} = -Σ others, likewise P.
    MatrixXd Z = MatrixXd::Zero(unknowns, unknowns - 2);
    Z.block(0, 0, n - 1, n - 1).setIdentity();
    Z.row(n - 1).head(n - 1).setConstant(-1.0);
    Z.block(n, n - 1, n - 1, n - 1).setIdentity();
    Z.row(2 * n - 1).segment(n - 1, n - 1).setConstant(-1.0);
    Z.bottomRightCorner(unknowns - 2 * n, unknowns - 2 * n).setIdentity();
    const MatrixXd B = A * Z;
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(B);
    const VectorXd solution = Z * qr.solve(y);
    const MatrixXd Q = Z * (B.transpose() * B).inverse() * Z.transpose();
    return {.deviations = solution.head(2 * n),
            .residuals = y - A * solution,
            .cofactors = Q.topLeftCorner(2 * n, 2 * n),
            .degrees_of_freedom = static_cast<double>(N - qr.rank())};
}

TEST(CircleClosure, FullClosureIsTheClosedForm) {
    std::mt19937_64 random(17);
    for (const std::size_t n : {3U, 8U, 12U}) {
        const Truth truth = truth_of(n, random);
        const CircleClosureMeasurement m = measured({.steps = n, .positions = all_positions(n)}, truth, 1.0, random);
        const CircleClosureSolution solution = solve_circle_closure(m);
        double mean = 0.0;
        VectorXd rows = VectorXd::Zero(at(n));
        for (const ClosureReading& reading : m.readings) {
            mean += reading.value / static_cast<double>(n * n);
            rows(at(reading.step)) += reading.value / static_cast<double>(n);
        }
        const auto size = static_cast<double>(n);
        EXPECT_EQ(solution.degrees_of_freedom, (size - 1.0) * (size - 2.0));
        for (Index j = 0; j < at(n); ++j) {
            EXPECT_NEAR(solution.deviations(j), rows(j) - mean, 1e-12);
            EXPECT_NEAR(std::sqrt(solution.cofactors(j, j)), std::sqrt(size - 1.0) / size, 1e-14);
            EXPECT_NEAR(std::sqrt(solution.cofactors(j + at(n), j + at(n))), std::sqrt(size - 1.0) / size, 1e-14);
        }
        // Table and artefact are independent of each other; steps of one circle have covariance −s²/n².
        EXPECT_LT(solution.cofactors.topRightCorner(at(n), at(n)).cwiseAbs().maxCoeff(), 1e-14);
        EXPECT_NEAR(solution.cofactors(0, 1), -1.0 / (size * size), 1e-14);
    }
}

TEST(CircleClosure, AgreesWithADenseSolutionOfAllUnknowns) {
    std::mt19937_64 random(18);
    const std::vector<Design> designs{
        {.steps = 12, .positions = all_positions(12), .against = true, .sense = -1.0},
        {.steps = 12, .positions = {0, 1}},
        {.steps = 12, .positions = {0, 1, 5, 8}, .repetitions = 3, .against = true},
        {.steps = 9, .positions = {2, 4, 8}, .closing = true, .drift = true},
        {.steps = 10, .positions = {0, 3, 4}, .repetitions = 2, .closing = true, .drift = true, .sense = -1.0}};
    for (const Design& design : designs) {
        CircleClosureMeasurement m = measured(design, truth_of(design.steps, random), 0.7, random);
        if (design.repetitions == 3) {  // gaps
            m.readings.erase(m.readings.begin() + 7);
            m.readings.erase(m.readings.begin() + 61);
        }
        if (design.positions.size() == 2) {  // as many unknowns as readings
            m.stated_u = 0.7;
            m.uses_stated_u = true;
        }
        const CircleClosureSolution solution = solve_circle_closure(m);
        const Dense dense = solved_densely(m);
        EXPECT_LT((solution.deviations - dense.deviations).cwiseAbs().maxCoeff(), 1e-10);
        EXPECT_LT((solution.residuals - dense.residuals).cwiseAbs().maxCoeff(), 1e-10);
        EXPECT_LT((solution.cofactors - dense.cofactors).cwiseAbs().maxCoeff(), 1e-10);
        EXPECT_EQ(solution.degrees_of_freedom, dense.degrees_of_freedom);
        // From the readings in one product, and what the residuals show of them.
        VectorXd values(at(m.readings.size()));
        for (std::size_t r = 0; r < m.readings.size(); ++r) {
            values(at(r)) = m.readings[r].value;
        }
        EXPECT_LT((solution.from_readings * values - dense.deviations).cwiseAbs().maxCoeff(), 1e-10);
        EXPECT_LT((solution.from_readings * solution.from_readings.transpose() - dense.cofactors).cwiseAbs().maxCoeff(),
                  1e-10);
        EXPECT_NEAR(solution.redundancy.sum(), solution.degrees_of_freedom, 1e-9);
    }
}

TEST(CircleClosure, FindsTheTruthWithoutNoise) {
    std::mt19937_64 random(19);
    for (const bool against : {false, true}) {
        const Truth truth = truth_of(10, random);
        CircleClosureMeasurement m = measured(
            {.steps = 10, .positions = {0, 1, 4}, .against = against, .closing = true, .drift = true, .sense = -1.0},
            truth, 0.0, random);
        m.stated_u = 1.0;
        m.uses_stated_u = true;
        const CircleClosureSolution solution = solve_circle_closure(m);
        EXPECT_LT((solution.deviations.head(10) - truth.table).cwiseAbs().maxCoeff(), 1e-11);
        EXPECT_LT((solution.deviations.tail(10) - truth.artefact).cwiseAbs().maxCoeff(), 1e-11);
        EXPECT_NEAR(solution.drift(1), 4.0, 1e-10);
        EXPECT_LT(solution.residuals.cwiseAbs().maxCoeff(), 1e-11);
    }
}

TEST(CircleClosure, PositionsWithACommonDivisorLeaveHarmonicsOpen) {
    std::mt19937_64 random(20);
    for (const auto& [positions, divisor] : std::vector<std::pair<std::vector<std::size_t>, std::size_t>>{
             {{0, 1}, 1}, {{3, 7}, 4}, {{0, 4, 8}, 4}, {{0, 2, 6}, 2}, {{1, 4, 6}, 1}, {{5}, 12}}) {
        CircleClosureMeasurement m = measured({.steps = 12, .positions = positions}, truth_of(12, random), 1.0, random);
        m.stated_u = 1.0;
        m.uses_stated_u = true;
        EXPECT_EQ(common_divisor(m), divisor);
        if (divisor == 1) {
            EXPECT_NO_THROW((void)solve_circle_closure(m));
        } else {
            EXPECT_THROW((void)solve_circle_closure(m), gum::NoResultError);
        }
    }
}

TEST(CircleClosure, DriftNeedsAClosingReading) {
    std::mt19937_64 random(21);
    Design design{.steps = 8, .positions = all_positions(8), .drift = true};
    EXPECT_THROW((void)solve_circle_closure(measured(design, truth_of(8, random), 1.0, random)), gum::NoResultError);
    design.closing = true;
    EXPECT_NO_THROW((void)solve_circle_closure(measured(design, truth_of(8, random), 1.0, random)));
}

TEST(CircleClosure, ScatterHasToComeFromSomewhere) {
    std::mt19937_64 random(22);
    CircleClosureMeasurement m = measured({.steps = 6, .positions = {0, 1}}, truth_of(6, random), 1.0, random);
    EXPECT_THROW((void)solve_circle_closure(m), gum::NoResultError);
    m.stated_u = 0.5;
    m.stated_degrees_of_freedom = 30.0;
    m.uses_stated_u = true;
    const CircleClosureSolution solution = solve_circle_closure(m);
    EXPECT_EQ(solution.u_reading, 0.5);
    EXPECT_EQ(solution.nu_reading, 30.0);
}

TEST(CircleClosure, TestOfTheModelIsAnFTestOfTwoFits) {
    std::mt19937_64 random(23);
    const Design design{.steps = 7, .positions = {0, 1, 3}, .repetitions = 3};
    const CircleClosureMeasurement m = measured(design, truth_of(7, random), 1.0, random);
    const CircleClosureSolution solution = solve_circle_closure(m);
    ASSERT_TRUE(solution.against_repetition);
    // Within a position: one mean a step and one zero a series, two-way without interaction.
    double within = 0.0;
    for (std::size_t p = 0; p < 3; ++p) {
        MatrixXd table(3, 7);
        for (const ClosureReading& reading : m.readings) {
            if (reading.series / 3 == p) {
                table(at(reading.series % 3), at(reading.step)) = reading.value;
            }
        }
        const MatrixXd left =
            ((table.rowwise() - table.colwise().mean()).colwise() - table.rowwise().mean()).array() + table.mean();
        within += left.squaredNorm();
    }
    const double nu = 3.0 * 2.0 * 6.0;
    const double left_nu = solution.degrees_of_freedom - nu;
    const double F = (solution.residuals.squaredNorm() - within) / left_nu / (within / nu);
    EXPECT_EQ(solution.against_repetition->nu, left_nu);
    EXPECT_EQ(solution.against_repetition->nu_reference, nu);
    EXPECT_NEAR(solution.against_repetition->statistic, F, 1e-9 * F);
}

TEST(CircleClosure, StatedIntervalsHoldTheTruthAsOftenAsTheySay) {
    std::mt19937_64 random(24);
    constexpr int k_campaigns = 1500;
    // t_0.9545 for the degrees of freedom of both designs: (6 − 1)(6 − 2) = 20 and 18 − 3 − 10 = 5.
    const std::vector<std::pair<Design, double>> designs{{{.steps = 6, .positions = all_positions(6)}, 2.1330},
                                                         {{.steps = 6, .positions = {0, 1, 3}}, 2.6487}};
    for (const auto& [design, k] : designs) {
        int inside = 0;
        int all = 0;
        for (int campaign = 0; campaign < k_campaigns; ++campaign) {
            const Truth truth = truth_of(design.steps, random);
            const CircleClosureSolution solution = solve_circle_closure(measured(design, truth, 0.4, random));
            for (const Index j : {Index{0}, Index{3}}) {
                const double u = solution.u_reading * std::sqrt(solution.cofactors(j, j));
                inside += std::abs(solution.deviations(j) - truth.table(j)) <= k * u ? 1 : 0;
                ++all;
            }
        }
        // Two steps of a campaign share s: four standard deviations of as many independent campaigns.
        const double share = static_cast<double>(inside) / static_cast<double>(all);
        EXPECT_NEAR(share, 0.9545, 4.0 * std::sqrt(0.9545 * 0.0455 / k_campaigns)) << design.positions.size();
    }
}

TEST(CircleClosureModel, SensitivitiesAreThoseOfCentralDifferences) {
    std::mt19937_64 random(25);
    CircleClosureMeasurement m = measured({.steps = 6, .positions = {0, 1, 3}, .against = true, .sense = -1.0},
                                          truth_of(6, random), 0.4, random);
    const std::vector<ClosurePattern> patterns{ClosurePattern::scale, ClosurePattern::reading,
                                               ClosurePattern::step,  ClosurePattern::side,
                                               ClosurePattern::turn,  ClosurePattern::once_per_turn};
    for (const ClosurePattern pattern : patterns) {
        const double value = pattern == ClosurePattern::scale || pattern == ClosurePattern::turn ? 0.02 : 0.0;
        m.effects.push_back({.name = "effect " + std::to_string(m.effects.size()),
                             .source = "",
                             .pattern = pattern,
                             .value = value,
                             .u = 0.01,
                             .distribution = gum::Distribution::normal(value, 0.01)});
    }
    const auto solution = std::make_shared<const CircleClosureSolution>(solve_circle_closure(m));
    for (const auto inputs : {CircleClosureModel::Inputs::readings, CircleClosureModel::Inputs::deviations}) {
        const CircleClosureModel model(m, solution, inputs);
        const VectorXd x = gum::input_estimates(model);
        const MatrixXd J = model.jacobian(x);
        for (Index i = 0; i < x.size(); ++i) {
            constexpr double k_step = 1e-5;
            VectorXd up = x;
            VectorXd down = x;
            up(i) += k_step;
            down(i) -= k_step;
            const VectorXd difference = (model.evaluate(up) - model.evaluate(down)) / (2.0 * k_step);
            EXPECT_LT((difference - J.col(i)).cwiseAbs().maxCoeff(), 1e-8) << i;
        }
    }
    // An error of a reading moves the result as the readings themselves, with the other sign; a known drift is taken
    // off.
    const CircleClosureModel model(m, solution, CircleClosureModel::Inputs::readings);
    VectorXd x = gum::input_estimates(model);
    const VectorXd before = model.evaluate(x);
    for (std::size_t r = 0; r < m.readings.size(); ++r) {
        x(at(r)) += 0.5 * static_cast<double>(m.readings[r].step) / 6.0;
    }
    x(at(m.readings.size()) + 1 + at(m.readings.size()) + 6 + 6) += 0.5 * 1.02;  // scale, readings, steps, sides, turn
    EXPECT_LT((model.evaluate(x) - before).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CircleClosureModel, EffectsOfStepsAndSidesAreThemselves) {
    std::mt19937_64 random(26);
    CircleClosureMeasurement m =
        measured({.steps = 5, .positions = all_positions(5)}, truth_of(5, random), 0.4, random);
    const gum::Distribution distribution = gum::Distribution::normal(0.0, 0.1);
    m.effects = {
        {.name = "step", .source = "", .pattern = ClosurePattern::step, .u = 0.1, .distribution = distribution},
        {.name = "side", .source = "", .pattern = ClosurePattern::side, .u = 0.1, .distribution = distribution}};
    const auto solution = std::make_shared<const CircleClosureSolution>(solve_circle_closure(m));
    const CircleClosureModel model(m, solution, CircleClosureModel::Inputs::readings);
    const MatrixXd J = model.jacobian(gum::input_estimates(model));
    const Index first = at(m.readings.size());
    for (Index i = 0; i < 5; ++i) {
        for (Index j = 0; j < 5; ++j) {
            const double self = i == j ? -0.8 : 0.2;  // −(δ_ij − 1/n)
            EXPECT_NEAR(J(i, first + j), self, 1e-12);
            EXPECT_NEAR(J(5 + i, first + 5 + j), self, 1e-12);
            EXPECT_NEAR(J(i, first + 5 + j), 0.0, 1e-12);
            EXPECT_NEAR(J(5 + i, first + j), 0.0, 1e-12);
        }
    }
}

}  // namespace
}  // namespace gumcert::engine
