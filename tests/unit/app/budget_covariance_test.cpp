#include "app/budget_covariance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "gum/random_draws.h"
#include "tests/unit/engine/job/budget_campaign.h"

namespace gumcert::app {
namespace {

BudgetResult evaluate_keys(const std::string& keys) {
    return evaluate_budget(engine::test::read_budget(keys), 1);
}

Eigen::MatrixXd covariance(const std::string& keys) {
    return budget_covariance(evaluate_keys(keys));
}

void expect_equal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance, const std::string& of) {
    ASSERT_EQ(a.rows(), b.rows()) << of;
    EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance * b.cwiseAbs().maxCoeff()) << of << "\n" << a << "\n\n" << b;
}

const std::string k_a = R"("a": {"value": 0, "u": 1})";
const std::string k_b = R"("b": {"value": 0, "u": 1})";
const std::string k_own_b = R"("points": [{"b": {"value": 1, "u": 1}}, {"b": {"value": 2, "u": 2}}])";

std::string job_text(const std::string& inputs, const std::string& model, double r) {
    return R"("model": ["y = )" + model + R"("], "inputs": {)" + inputs + R"(}, "correlations": [["a", "b", )" +
           std::to_string(r) + "]], " + k_own_b;
}

// b = r a + what is of the point alone: cov(b1, b2) = r² u1 u2, cov(a + b1, a + b2) = (1 + r u1)(1 + r u2).
TEST(BudgetCovariance, OfInputsThatThePointsStateGivenThoseThatTheyShare) {
    for (const double r : {0.5, -0.25, 0.99}) {
        for (const std::string& inputs : {k_a + ", " + k_b, k_b + ", " + k_a}) {
            const Eigen::MatrixXd sum = covariance(job_text(inputs, "a + b", r));
            EXPECT_NEAR(sum(0, 1), (1.0 + r) * (1.0 + 2.0 * r), 1e-14);
            EXPECT_NEAR(sum(0, 0), 2.0 + 2.0 * r, 1e-14);
            const Eigen::MatrixXd alone = covariance(job_text(inputs, "b", r));
            EXPECT_NEAR(alone(0, 1), r * r * 2.0, 1e-14);
            EXPECT_NEAR(alone(1, 1), 4.0, 1e-14);
        }
    }
}

TEST(BudgetCovariance, WithoutCorrelationPointsShareWhatTheyDoNotState) {
    const Eigen::MatrixXd V = covariance(R"("model": ["y = a + b"], "inputs": {)" + k_a + ", " + k_b + "}, " + k_own_b);
    EXPECT_NEAR(V(0, 1), 1.0, 1e-15);
    EXPECT_NEAR(V(1, 1), 5.0, 1e-15);
}

std::string digits(double value) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// A generated table: four inputs with correlations, some of them stated by the points.
struct Table {
    std::vector<std::string> names{"a", "b", "c", "d"};
    std::vector<double> u;
    std::vector<double> r;  // ab ac ad bc bd cd
    std::vector<bool> own;
    std::vector<bool> split;  // into two components

    [[nodiscard]] std::string keys(const std::vector<std::size_t>& order) const {
        std::string inputs;
        for (const std::size_t i : order) {
            const std::string U = digits(u[i]);
            inputs += (inputs.empty() ? "\"" : ", \"") + names[i] + "\": ";
            inputs += split[i] ? R"({"components": [{"name": "p", "value": 1, "u": )" + digits(0.6 * u[i]) +
                                     R"(}, {"name": "q", "value": 0, "u": )" + digits(0.8 * u[i]) + "}]}"
                               : R"({"value": 1, "u": )" + U + "}";
        }
        std::string correlations;
        std::size_t pair = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j, ++pair) {
                correlations += (correlations.empty() ? "[\"" : ", [\"") + names[i] + "\", \"" + names[j] + "\", " +
                                digits(r[pair]) + "]";
            }
        }
        std::string points;
        for (int p = 1; p <= 3; ++p) {
            std::string stated = R"({"point": ")" + std::to_string(p) + "\"";
            for (std::size_t i = 0; i < 4; ++i) {
                if (own[i] && !split[i] && !(p == 3 && i == 1)) {  // b is shared by point 3 all the same
                    stated += ", \"" + names[i] + R"(": {"value": )" + std::to_string(p) + R"(, "u": )" +
                              digits(u[i] * p) + "}";
                }
            }
            points += (points.empty() ? "" : ", ") + stated + "}";
        }
        return "\"model\": [\"y = " + names[0] + " + 2*" + names[1] + " - " + names[2] + "*" + names[3] +
               "\", \"z = " + names[0] + " - " + names[3] + "\"], \"inputs\": {" + inputs + "}, \"correlations\": [" +
               correlations + "], \"coverage\": \"law_of_propagation\", \"points\": [" + points + "]";
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
    for (int round = 0; round < 40; ++round) {
        Table table = random_table(random);
        std::iota(order.begin(), order.end(), std::size_t{0});
        const BudgetResult result = evaluate_keys(table.keys(order));
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
        same(evaluate_keys(table.keys(order)), "order");
        table.names = {"zeta", "Y", "b", "a"};
        same(evaluate_keys(table.keys(order)), "names");
        for (std::size_t i = 0; i < 4; ++i) {
            if (!table.own[i]) {
                table.split[i] = !table.split[i];
            }
        }
        same(evaluate_keys(table.keys(order)), "splitting");
    }
}

// The law: what Monte Carlo draws for two points has their covariance, too.
TEST(BudgetCovariance, IsThatOfTheTrialsOfThePoints) {
    std::mt19937 random(9);
    std::vector<std::size_t> order(4);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int round = 0; round < 6; ++round) {
        const Table table = random_table(random);
        std::string keys = table.keys(order);
        keys.replace(keys.find(table.names[2] + "*"), 2, "c - ");  // a linear model
        const BudgetResult result = evaluate_keys(keys);
        const Eigen::MatrixXd V = budget_covariance(result);
        constexpr Eigen::Index k_trials = 20000;
        Eigen::MatrixXd y(k_trials, V.rows());
        for (Eigen::Index p = 0; p < 3; ++p) {
            const BudgetPointResult& point = result.points[static_cast<std::size_t>(p)];
            const gum::InputDraws draws(point.model->inputs(), 1, point.streams);
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
}  // namespace gumcert::app
