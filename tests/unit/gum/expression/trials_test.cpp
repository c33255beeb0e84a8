#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "equations.h"

namespace gumcert::gum {
namespace {

Eigen::MatrixXd random_trials(Eigen::Index trials, Eigen::Index inputs, unsigned seed) {
    std::mt19937 random(seed);
    Eigen::MatrixXd x(trials, inputs);
    for (Eigen::Index i = 0; i < inputs; ++i) {
        for (Eigen::Index j = 0; j < trials; ++j) {
            x(j, i) = 4.0 * static_cast<double>(random()) / 4294967296.0 - 1.0;
        }
    }
    return x;
}

/// Trials agree with evaluate() to the last bit, or are NaN where it throws.
void expect_same_bits(const EquationSystem& system, const Eigen::MatrixXd& x, const std::string& what) {
    Eigen::MatrixXd y(x.rows(), static_cast<Eigen::Index>(system.output_count()));
    system.evaluate_trials(x, y);
    for (Eigen::Index trial = 0; trial < x.rows(); ++trial) {
        Eigen::VectorXd expected = Eigen::VectorXd::Constant(y.cols(), std::nan(""));
        try {
            expected = system.evaluate(x.row(trial).transpose());
        } catch (const NoResultError&) {
        }
        for (Eigen::Index i = 0; i < y.cols(); ++i) {
            if (std::isnan(expected(i))) {
                ASSERT_TRUE(std::isnan(y(trial, i))) << what << " trial " << trial << " gives " << y(trial, i);
            } else {
                ASSERT_EQ(std::bit_cast<std::uint64_t>(y(trial, i)), std::bit_cast<std::uint64_t>(expected(i)))
                    << what << " trial " << trial;
            }
        }
    }
}

TEST(Trials, EqualSingleEvaluationsToTheLastBit) {
    const std::vector<std::string> expressions{"a + b - c",
                                               "a*b/c",
                                               "2*a - b/3 + 5/c",
                                               "-a",
                                               "abs(a - b)",
                                               "sqrt(a*b)",
                                               "exp(a)*ln(b)",
                                               "log10(a + 2)",
                                               "sin(a*rad) + cos(b*rad)*tan(c*rad)",
                                               "(asin(a) + acos(b) + atan(c))/rad",
                                               "atan2(a, b)/rad",
                                               "sinh(a) + cosh(b) + tanh(c)",
                                               "min(a, b, 0.5)",
                                               "max(0, c, a)",
                                               "hypot(a, b)",
                                               "a^b",
                                               "a^2 + b^3 - c^-5",
                                               "a^17*b^1.5",
                                               "2^a",
                                               "1/(a - b)",
                                               "atan(1/(a - a))/rad",
                                               "exp(-1/(b - b))",
                                               "min(1/(c - c), 1)",
                                               "a",
                                               "7",
                                               "1/0 + a",
                                               "celsius(0)/celsius(0)*a"};
    const Eigen::MatrixXd x = random_trials(1000, 3, 1);
    for (const std::string& expression : expressions) {
        expect_same_bits(system_of({"y = " + expression}, numbers({"a", "b", "c"})), x, expression);
    }
    // Chunks of every length at the end.
    for (const Eigen::Index trials : {0, 1, 2, 3, 255, 256, 257, 511, 513}) {
        expect_same_bits(system_of({"y = (a + b)*sqrt(c + 3)"}, numbers({"a", "b", "c"})), x.topRows(trials), "length");
    }
}

TEST(Trials, SeveralOutputsThatDependOnEachOther) {
    const EquationSystem system = system_of(
        {"p = a*b", "q = p + c", "r = p*q - p", "s = p", "k = 3", "i = c"}, numbers({"a", "b", "c"}), {},
        {output("r", "1"), output("q", "1"), output("p", "1"), output("s", "1"), output("k", "1"), output("i", "1")});
    expect_same_bits(system, random_trials(700, 3, 2), "several outputs");
}

TEST(Trials, NegativeZeroIsKept) {
    const EquationSystem system = system_of({"y = -a"}, numbers({"a"}));
    Eigen::MatrixXd x = Eigen::MatrixXd::Zero(3, 1);
    Eigen::MatrixXd y(3, 1);
    system.evaluate_trials(x, y);
    EXPECT_TRUE(std::signbit(y(1, 0)));
    expect_same_bits(system, x, "-0");
}

TEST(Trials, BlocksOfALargerMatrixAreNotCopied) {
    const EquationSystem system = system_of({"y = a - b"}, numbers({"a", "b"}));
    const Eigen::MatrixXd large = random_trials(1000, 4, 3);
    Eigen::MatrixXd result = Eigen::MatrixXd::Constant(1000, 3, -7.0);
    system.evaluate_trials(large.block(100, 1, 500, 2), result.block(200, 1, 500, 1));
    EXPECT_EQ(result.block(200, 1, 500, 1), large.block(100, 1, 500, 1) - large.block(100, 2, 500, 1));
    EXPECT_EQ((result.array() == -7.0).count(), 2500);
}

/// A sum of products that keeps many values alive, with shared parts.
std::string long_expression(std::mt19937& random, int depth) {
    if (depth == 0) {
        static const std::vector<std::string> atoms{"a", "b", "c", "d", "1.5", "(a*b)", "(c - d)"};
        return atoms[random() % atoms.size()];
    }
    const std::string left = long_expression(random, depth - 1 - static_cast<int>(random() % 2 == 0 && depth > 1));
    const std::string right = long_expression(random, depth - 1);
    switch (random() % 6) {
        case 0:
            return "(" + left + " + " + right + ")";
        case 1:
            return "(" + left + " - " + right + ")";
        case 2:
            return "(" + left + "*" + right + ")";
        case 3:
            return "min(" + left + ", " + right + ")";
        case 4:
            return "(" + left + "/(4 + abs(" + right + ")))";
        default:
            return "hypot(" + left + ", " + right + ")";
    }
}

TEST(Trials, RegistersOfLongRandomExpressions) {
    std::mt19937 random(11);
    for (int i = 0; i < 20; ++i) {
        const std::string expression = long_expression(random, 9);
        expect_same_bits(system_of({"y = " + expression}, numbers({"a", "b", "c", "d"})), random_trials(300, 4, 5),
                         expression.substr(0, 60));
    }
}

TEST(Trials, ThreadsShareASystem) {
    const EquationSystem system = system_of({"y = exp(a)*b^3 + hypot(a, b)"}, numbers({"a", "b"}));
    const Eigen::MatrixXd x = random_trials(5000, 2, 8);
    Eigen::MatrixXd expected(5000, 1);
    system.evaluate_trials(x, expected);
    Eigen::MatrixXd y = Eigen::MatrixXd::Zero(5000, 1);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            system.evaluate_trials(x.middleRows(1250 * t, 1250), y.middleRows(1250 * t, 1250));
            for (Eigen::Index i = 0; i < 50; ++i) {
                (void)system.jacobian(x.row(i).transpose());
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_EQ(y, expected);
}

}  // namespace
}  // namespace gumcert::gum
