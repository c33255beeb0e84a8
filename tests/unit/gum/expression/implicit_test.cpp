#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "equations.h"
#include "tests/support/reference_case.h"

namespace gumcert::gum {
namespace {

/// JCGM GUM-5:2026, example 13, as transcribed in the reference file; R0, A, B, RS, W.
EquationSystem thermometer() {
    return system_of({"0 = R0*(1 + A*t + B*t^2) - W*RS"},
                     {input("R0", "ohm"), input("A", "1/K"), input("B", "1/K2"), input("RS", "ohm"), input("W")},
                     {unknown("t", 20, "degC")});
}

TEST(Implicit, ThermometerOfTheReference) {
    const nlohmann::json reference = gumcert::test::reference_case("gum5-ex13-implicit-rtd");
    // The computed value of the kind, and of the input where there is one.
    const auto expected_value = [&](const std::string& kind, const std::string& input) {
        for (const nlohmann::json& expected : reference["expected"]) {
            if (expected["kind"] == kind && expected.value("input", "") == input && expected.contains("computed")) {
                return expected["computed"].get<double>();
            }
        }
        return std::nan("");
    };
    const EquationSystem system = thermometer();
    const Eigen::VectorXd x = vector({99.9961, 0.0039096, -6e-07, 99.99947, 1.0780057});
    EXPECT_NEAR(system.evaluate(x)(0), expected_value("y", ""), 1e-12);
    const Eigen::MatrixXd jacobian = system.jacobian(x);
    Eigen::Index i = 0;
    for (const char* name : {"R0", "A", "B", "RS", "W"}) {
        const double expected = expected_value("sensitivity", name);
        EXPECT_NEAR(jacobian(0, i), expected, 1e-12 * std::fabs(expected)) << name;
        ++i;
    }
}

TEST(Implicit, DerivativesOfThermometerByHand) {
    const EquationSystem system = thermometer();
    const Eigen::VectorXd x = vector({99.9961, 0.0039096, -6e-07, 99.99947, 1.0780057});
    // The quadratic equation solved: t = (−A + √(A² − 4B(1 − W·RS/R0)))/(2B).
    const EquationSystem solved =
        system_of({"t = (-A + sqrt(A^2 - 4*B*(1 - W*RS/R0)))/(2*B)"}, numbers({"R0", "A", "B", "RS", "W"}));
    EXPECT_EQ(system.output_unit(0).text(), "degC");
    EXPECT_NEAR(system.evaluate(x)(0), solved.evaluate(x)(0), 1e-11);
    const Eigen::MatrixXd jacobian = system.jacobian(x);
    const Eigen::MatrixXd expected = solved.jacobian(x);
    const Eigen::MatrixXd second = system.hessians(x).front();
    const Eigen::MatrixXd second_expected = solved.hessians(x).front();
    for (Eigen::Index i = 0; i < 5; ++i) {
        EXPECT_NEAR(jacobian(0, i), expected(0, i), 1e-9 * std::fabs(expected(0, i)));
        for (Eigen::Index j = 0; j < 5; ++j) {
            // √ and division by B lose six digits in the solved form.
            EXPECT_NEAR(second(i, j), second_expected(i, j), 1e-4 * std::fabs(second_expected(i, j))) << i << j;
        }
    }
}

TEST(Implicit, TwoUnknownsWithIntermediateQuantities) {
    // u + v = s, u·v = p: u, v = s/2 ± √(s²/4 − p). The residuals and the output go through intermediate quantities.
    const EquationSystem system =
        system_of({"total = u + v", "0 = total - s", "0 = product - p", "product = u*v", "y = u^2*v + s"},
                  numbers({"s", "p"}), {unknown("u", 10), unknown("v", 0)}, {output("y", "1"), output("u", "1")});
    const EquationSystem solved =
        system_of({"root = sqrt(s^2/4 - p)", "u = s/2 + root", "v = s/2 - root", "y = u^2*v + s"}, numbers({"s", "p"}),
                  {}, {output("y", "1"), output("u", "1")});
    const Eigen::VectorXd x = vector({5.0, 6.25 - 1.44});
    EXPECT_TRUE(system.evaluate(x).isApprox(solved.evaluate(x), 1e-14));
    EXPECT_TRUE(system.jacobian(x).isApprox(solved.jacobian(x), 1e-13)) << system.jacobian(x) << "\n"
                                                                        << solved.jacobian(x);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_TRUE(system.hessians(x)[k].isApprox(solved.hessians(x)[k], 1e-12));
    }
    EXPECT_TRUE(system.solve(x).isApprox(vector({3.7, 1.3}), 1e-14));
}

TEST(Implicit, UnitsOfVeryDifferentSizeAreNoTrouble) {
    // Nanometres and gigapascals: in SI the unknowns differ by 10^18.
    const EquationSystem system = system_of({"0 = p*l - f", "0 = p/l - g"}, {input("f", "N/m"), input("g", "N/m3")},
                                            {unknown("p", 2e9, "Pa"), unknown("l", 1e-9, "m")});
    const Eigen::VectorXd solution = system.solve(vector({6.0, 6e18}));  // p² = f·g, l² = f/g
    EXPECT_NEAR(solution(0), 6e9, 1e-4);
    EXPECT_NEAR(solution(1), 1e-9, 1e-23);
}

TEST(Implicit, FarStartsConvergeByShorterSteps) {
    const EquationSystem arc = system_of({"0 = atan(z - a)/rad"}, numbers({"a"}), {unknown("z", 20)});
    EXPECT_NEAR(arc.evaluate(vector({1.5}))(0), 1.5, 1e-15);
    // The logarithm has no value where the full step leads.
    const EquationSystem logarithm = system_of({"0 = ln(z) - a"}, numbers({"a"}), {unknown("z", 50)});
    EXPECT_NEAR(logarithm.evaluate(vector({-1.0}))(0), std::exp(-1.0), 1e-16);
    // A solution at zero.
    const EquationSystem zero = system_of({"0 = sin(z) - a"}, numbers({"a"}), {unknown("z", 0.5, "rad")});
    EXPECT_NEAR(zero.evaluate(vector({0.0}))(0), 0.0, 1e-16);
}

TEST(Implicit, WhatCannotBeSolvedIsSaid) {
    const auto code = [](const std::vector<std::string>& texts, const std::vector<UnknownSymbol>& unknowns, double a) {
        const EquationSystem system = system_of(texts, numbers({"a"}), unknowns);
        return no_result_code([&] { (void)system.jacobian(vector({a})); });
    };
    EXPECT_EQ(code({"0 = z^2 + 1 + a"}, {unknown("z", 1.3)}, 0.0), "0061");
    EXPECT_EQ(code({"0 = (z - 1)^2 - a"}, {unknown("z", 2)}, 0.0), "0062");  // double solution
    EXPECT_EQ(code({"0 = z^2 - a"}, {unknown("z", 0)}, 4.0), "0062");        // no slope at the start
    EXPECT_EQ(code({"0 = z + w - a", "0 = 2*z + 2*w - a"}, {unknown("z", 1), unknown("w", 1)}, 1.0), "0062");
    EXPECT_EQ(code({"0 = ln(z) - a"}, {unknown("z", -1)}, 1.0), "0060");
    EXPECT_EQ(code({"0 = z + abs(a - z) - 1"}, {unknown("z", 1)}, 1.0), "0063");  // a kink at the solution
    EXPECT_EQ(code({"0 = exp(z) - a"}, {unknown("z", 1)}, -1.0).substr(0, 3), "006");
}

TEST(Implicit, AStartValueIsANumber) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(codes(problems_of({"0 = z - a"}, numbers({"a"}), {unknown("z", none)})), "0045 unknown z");
}

TEST(Implicit, TrialsStartFromTheGivenSolution) {
    const EquationSystem system = system_of({"0 = z^2 - a"}, numbers({"a"}), {unknown("z", 1)});
    Eigen::MatrixXd x(4, 1);
    x << 4.0, 9.0, -1.0, 16.0;
    Eigen::MatrixXd y(4, 1);
    system.evaluate_trials(x, y);
    EXPECT_NEAR(y(0, 0), 2.0, 1e-15);
    EXPECT_NEAR(y(1, 0), 3.0, 1e-15);
    EXPECT_TRUE(std::isnan(y(2, 0)));
    EXPECT_NEAR(y(3, 0), 4.0, 1e-15);
    system.evaluate_trials(x, y, vector({-2.0}));
    EXPECT_NEAR(y(3, 0), -4.0, 1e-15);
}

}  // namespace
}  // namespace gumcert::gum
