#include "gum/budget/budget_covariance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "gum/monte_carlo/random_draws.h"
#include "tests/support/case_count.h"
#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

using test::correlate;
using test::input;

Eigen::MatrixXd covariance(const Budget& of) {
    return budget_covariance(evaluate_budget(of, 1));
}

void expect_equal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance, const std::string& of) {
    ASSERT_EQ(a.rows(), b.rows()) << of;
    EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance * b.cwiseAbs().maxCoeff()) << of << "\n" << a << "\n\n" << b;
}

/// Inputs a and b of u = 1, of which two points state b with u = 1 and u = 2.
Budget two_points(const std::vector<std::string>& names, const std::string& model) {
    Budget of = test::budget({"y = " + model}, {});
    for (const std::string& name : names) {
        of.inputs.push_back(input(name, state_uncertainty(0, 1)));
    }
    of.points = {test::point(of, "1", {{"b", state_uncertainty(1, 1)}}),
                 test::point(of, "2", {{"b", state_uncertainty(2, 2)}})};
    return of;
}

// b = r a + what is of the point alone: cov(b1, b2) = r² u1 u2, cov(a + b1, a + b2) = (1 + r u1)(1 + r u2).
TEST(BudgetCovariance, OfInputsThatThePointsStateGivenThoseThatTheyShare) {
    for (const double r : {0.5, -0.25, 0.99}) {
        for (const std::vector<std::string>& names : {std::vector<std::string>{"a", "b"}, {"b", "a"}}) {
            const auto of = [&](const std::string& model) {
                Budget made = two_points(names, model);
                correlate(made, "a", "b", r);
                return covariance(made);
            };
            const Eigen::MatrixXd sum = of("a + b");
            EXPECT_NEAR(sum(0, 1), (1.0 + r) * (1.0 + 2.0 * r), 1e-14);
            EXPECT_NEAR(sum(0, 0), 2.0 + 2.0 * r, 1e-14);
            const Eigen::MatrixXd alone = of("b");
            EXPECT_NEAR(alone(0, 1), r * r * 2.0, 1e-14);
            EXPECT_NEAR(alone(1, 1), 4.0, 1e-14);
        }
    }
}

TEST(BudgetCovariance, WithoutCorrelationPointsShareWhatTheyDoNotState) {
    const Eigen::MatrixXd V = covariance(two_points({"a", "b"}, "a + b"));
    EXPECT_NEAR(V(0, 1), 1.0, 1e-15);
    EXPECT_NEAR(V(1, 1), 5.0, 1e-15);
}

/// A generated table: four inputs with correlations, some of them stated by the points.
struct Table {
    std::vector<std::string> names{"a", "b", "c", "d"};
    std::vector<double> u;
    std::vector<double> r;  // ab ac ad bc bd cd
    std::vector<bool> own;
    std::vector<bool> split;  // into two components
    bool linear = false;

    [[nodiscard]] Budget in(const std::vector<std::size_t>& order) const {
        Budget of =
            test::budget({"y = " + names[0] + " + 2*" + names[1] + " - " + names[2] + (linear ? " - " : "*") + names[3],
                          "z = " + names[0] + " - " + names[3]},
                         {});
        for (const std::size_t i : order) {
            of.inputs.push_back(split[i] ? test::sum_of(names[i], {state_uncertainty(1.0, 0.6 * u[i]),
                                                                   state_uncertainty(0.0, 0.8 * u[i])})
                                         : input(names[i], state_uncertainty(1.0, u[i])));
        }
        std::size_t pair = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j, ++pair) {
                correlate(of, names[i], names[j], r[pair]);
            }
        }
        of.coverage = CoverageChoice::law_of_propagation;
        for (int p = 1; p <= 3; ++p) {
            std::vector<std::pair<std::string, StatedQuantity>> stated;
            for (std::size_t i = 0; i < 4; ++i) {
                if (own[i] && !split[i] && !(p == 3 && i == 1)) {  // b is shared by point 3 all the same
                    stated.emplace_back(names[i], state_uncertainty(p, u[i] * p));
                }
            }
            of.points.push_back(test::point(of, std::to_string(p), stated));
        }
        return of;
    }
};

Table random_table(std::mt19937& random) {
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    Table table;
    // Correlations of random directions always hold together.
    Eigen::MatrixXd x(4, 5);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        x(i) = uniform() - 0.5;
    }
    x.rowwise().normalize();
    const Eigen::MatrixXd R = x * x.transpose();
    for (Eigen::Index i = 0; i < 4; ++i) {
        table.u.push_back(0.2 + uniform());
        table.own.push_back(random() % 2 == 0);
        table.split.push_back(random() % 3 == 0);
        for (Eigen::Index j = i + 1; j < 4; ++j) {
            table.r.push_back(R(i, j));
        }
    }
    return table;
}

// The law: another order, other names, inputs in two components instead of one change no number.
TEST(BudgetCovariance, DoesNotDependOnOrderNamesOrSplitting) {
    std::mt19937 random(5);
    std::vector<std::size_t> order(4);
    const int rounds = gumcert::test::cases(6, 40);
    for (int round = 0; round < rounds; ++round) {
        Table table = random_table(random);
        std::iota(order.begin(), order.end(), std::size_t{0});
        const BudgetResult result = evaluate_budget(table.in(order), 1);
        const Eigen::MatrixXd V = budget_covariance(result);
        EXPECT_LE((V - V.transpose()).cwiseAbs().maxCoeff(), 0.0);
        const auto same = [&](const BudgetResult& other, const std::string& change) {
            expect_equal(budget_covariance(other), V, 1e-12, change);
            for (std::size_t p = 0; p < 3; ++p) {
                for (std::size_t i = 0; i < 2; ++i) {
                    EXPECT_NEAR(*other.points[p].outputs[i].expanded_uncertainty /
                                    *result.points[p].outputs[i].expanded_uncertainty,
                                1.0, 1e-9)
                        << change;
                }
            }
        };
        std::shuffle(order.begin(), order.end(), random);
        same(evaluate_budget(table.in(order), 1), "order");
        table.names = {"zeta", "Y", "b", "a"};
        same(evaluate_budget(table.in(order), 1), "names");
        for (std::size_t i = 0; i < 4; ++i) {
            if (!table.own[i]) {
                table.split[i] = !table.split[i];
            }
        }
        same(evaluate_budget(table.in(order), 1), "splitting");
    }
}

// The law: what Monte Carlo draws for two points has their covariance, too.
TEST(BudgetCovariance, IsThatOfTheTrialsOfThePoints) {
    std::mt19937 random(9);
    std::vector<std::size_t> order(4);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int round = 0; round < 6; ++round) {
        Table table = random_table(random);
        table.linear = true;
        const BudgetResult result = evaluate_budget(table.in(order), 1);
        const Eigen::MatrixXd V = budget_covariance(result);
        constexpr Eigen::Index k_trials = 20000;
        Eigen::MatrixXd y(k_trials, V.rows());
        for (Eigen::Index p = 0; p < 3; ++p) {
            const BudgetPointResult& point = result.points[static_cast<std::size_t>(p)];
            const InputDraws draws(point.model->inputs(), 1, point.streams);
            Eigen::MatrixXd x(k_trials, draws.size());
            draws.draw(0, x);
            Eigen::MatrixXd block(k_trials, 2);
            point.model->evaluate_trials(x, block);
            y.middleCols(2 * p, 2) = block;
        }
        const Eigen::MatrixXd d = y.rowwise() - y.colwise().mean();
        const Eigen::MatrixXd found = d.transpose() * d / static_cast<double>(k_trials - 1);
        for (Eigen::Index i = 0; i < V.rows(); ++i) {
            for (Eigen::Index j = 0; j < V.cols(); ++j) {
                EXPECT_NEAR(found(i, j), V(i, j), 0.04 * std::sqrt(V(i, i) * V(j, j))) << i << ", " << j;
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::gum
