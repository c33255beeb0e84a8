#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "equations.h"

namespace gumcert::gum {
namespace {

struct Case {
    std::string expression;
    double a, b;
    std::function<long double(long double, long double)> f;
};

const std::vector<Case>& cases() {
    using L = long double;
    static const std::vector<Case> table{
        {"a + b", 1.3, 0.7, [](L a, L b) { return a + b; }},
        {"a - 2*b", 1.3, 0.7, [](L a, L b) { return a - 2 * b; }},
        {"a*b*a", 1.3, 0.7, [](L a, L b) { return a * b * a; }},
        {"a/b", 1.3, 0.7, [](L a, L b) { return a / b; }},
        {"-a/(a + b)", 1.3, -0.7, [](L a, L b) { return -a / (a + b); }},
        {"a^3*b", -1.3, 0.7, [](L a, L b) { return a * a * a * b; }},
        {"a^-2*b^7", -1.3, 0.7, [](L a, L b) { return std::pow(b, 7.0L) / (a * a); }},
        {"a^2.5*b", 1.3, 0.7, [](L a, L b) { return std::pow(a, 2.5L) * b; }},
        {"a^b", 1.3, 0.7, [](L a, L b) { return std::pow(a, b); }},
        {"a^100", 1.01, 0.7, [](L a, L) { return std::pow(a, 100.0L); }},
        {"2^(a*b)", 1.3, 0.7, [](L a, L b) { return std::pow(2.0L, a * b); }},
        {"sqrt(a*b)", 1.3, 0.7, [](L a, L b) { return std::sqrt(a * b); }},
        {"exp(a*b)", 1.3, -0.7, [](L a, L b) { return std::exp(a * b); }},
        {"ln(a + b^2)", 1.3, 0.7, [](L a, L b) { return std::log(a + b * b); }},
        {"log10(a*b)", 1.3, 0.7, [](L a, L b) { return std::log10(a * b); }},
        {"sin(a*b*rad)", 1.3, 0.7, [](L a, L b) { return std::sin(a * b); }},
        {"cos(a*b*rad)", 1.3, 0.7, [](L a, L b) { return std::cos(a * b); }},
        {"tan(a*b*rad)", 1.3, 0.7, [](L a, L b) { return std::tan(a * b); }},
        {"asin(a*b)/rad", 0.8, 0.7, [](L a, L b) { return std::asin(a * b); }},
        {"acos(a*b)/rad", 0.8, -0.7, [](L a, L b) { return std::acos(a * b); }},
        {"atan(a*b)/rad", 1.3, 0.7, [](L a, L b) { return std::atan(a * b); }},
        {"atan2(a, b)/rad", 1.3, -0.7, [](L a, L b) { return std::atan2(a, b); }},
        {"sinh(a*b)", 1.3, 0.7, [](L a, L b) { return std::sinh(a * b); }},
        {"cosh(a*b)", 1.3, 0.7, [](L a, L b) { return std::cosh(a * b); }},
        {"tanh(a*b)", 1.3, 0.7, [](L a, L b) { return std::tanh(a * b); }},
        {"abs(a*b)", 1.3, -0.7, [](L a, L b) { return std::fabs(a * b); }},
        {"min(a*b, a^2)", 1.3, 0.7, [](L a, L b) { return std::fmin(a * b, a * a); }},
        {"max(a*b, a^2, b)", 1.3, 0.7, [](L a, L b) { return std::fmax(a * b, a * a); }},
        {"hypot(a^2, b)", 1.3, -0.7, [](L a, L b) { return std::hypot(a * a, b); }},
        {"a*a + a*a*sin(a*a*rad)", 1.3, 0.7, [](L a, L) { return a * a + a * a * std::sin(a * a); }},
    };
    return table;
}

/// Derivatives by differences of the sixth order, in long double, as second opinion: good to 1e-13.
long double first_difference(const std::function<long double(long double)>& f, long double x) {
    const long double h = 2e-3L;
    return (45 * (f(x + h) - f(x - h)) - 9 * (f(x + 2 * h) - f(x - 2 * h)) + (f(x + 3 * h) - f(x - 3 * h))) / (60 * h);
}

TEST(Derivatives, AgreeWithDifferencesInLongDouble) {
    for (const Case& one : cases()) {
        const EquationSystem system = system_of({"y = " + one.expression}, numbers({"a", "b"}));
        const Eigen::VectorXd x = vector({one.a, one.b});
        EXPECT_NEAR(system.evaluate(x)(0), static_cast<double>(one.f(one.a, one.b)),
                    1e-14 * std::fabs(system.evaluate(x)(0)))
            << one.expression;
        const auto da = [&](long double a, long double b) {
            return first_difference([&](long double t) { return one.f(t, b); }, a);
        };
        const auto db = [&](long double a, long double b) {
            return first_difference([&](long double t) { return one.f(a, t); }, b);
        };
        const Eigen::MatrixXd jacobian = system.jacobian(x);
        const auto near = [&](double exact, long double difference, double tolerance) {
            EXPECT_NEAR(exact, static_cast<double>(difference), tolerance * (1.0 + std::fabs(exact))) << one.expression;
        };
        // Truncation of the differences is far below these, except at a^100, whose seventh derivative is 1e13.
        const double tolerance = one.expression == "a^100" ? 1e-6 : 1e-12;
        near(jacobian(0, 0), da(one.a, one.b), tolerance);
        near(jacobian(0, 1), db(one.a, one.b), tolerance);
        const Eigen::MatrixXd hessian = system.hessians(x).front();
        near(hessian(0, 0), first_difference([&](long double t) { return da(t, one.b); }, one.a), 100 * tolerance);
        near(hessian(1, 1), first_difference([&](long double t) { return db(one.a, t); }, one.b), 100 * tolerance);
        near(hessian(0, 1), first_difference([&](long double t) { return da(one.a, t); }, one.b), 100 * tolerance);
        EXPECT_EQ(hessian(0, 1), hessian(1, 0));
    }
}

TEST(Derivatives, OfElementaryFunctionsByHand) {
    struct Hand {
        std::string expression;
        double first, second;
    };
    const double x = 0.3;
    const std::vector<Hand> table{
        {"x^7", 7 * std::pow(x, 6), 42 * std::pow(x, 5)},
        {"x^-1", -1 / (x * x), 2 / (x * x * x)},
        {"x^0.5", 0.5 / std::sqrt(x), -0.25 / (x * std::sqrt(x))},
        {"sqrt(x)", 0.5 / std::sqrt(x), -0.25 / (x * std::sqrt(x))},
        {"1/(1 + x)", -1 / (1.3 * 1.3), 2 / (1.3 * 1.3 * 1.3)},
        {"exp(2*x)", 2 * std::exp(0.6), 4 * std::exp(0.6)},
        {"ln(x)", 1 / x, -1 / (x * x)},
        {"sin(2*x*rad)", 2 * std::cos(0.6), -4 * std::sin(0.6)},
        {"tan(x*rad)", 1 / (std::cos(x) * std::cos(x)), 2 * std::tan(x) / (std::cos(x) * std::cos(x))},
        {"asin(x)/rad", 1 / std::sqrt(1 - x * x), x / std::pow(1 - x * x, 1.5)},
        {"acos(x)/rad", -1 / std::sqrt(1 - x * x), -x / std::pow(1 - x * x, 1.5)},
        {"atan(x)/rad", 1 / (1 + x * x), -2 * x / ((1 + x * x) * (1 + x * x))},
        {"tanh(x)", 1 - std::tanh(x) * std::tanh(x), -2 * std::tanh(x) * (1 - std::tanh(x) * std::tanh(x))},
    };
    for (const Hand& hand : table) {
        const EquationSystem system = system_of({"y = " + hand.expression}, numbers({"x"}));
        EXPECT_NEAR(system.jacobian(vector({x}))(0, 0), hand.first, 1e-14 * std::fabs(hand.first)) << hand.expression;
        EXPECT_NEAR(system.hessians(vector({x})).front()(0, 0), hand.second, 1e-14 * std::fabs(hand.second) + 1e-15)
            << hand.expression;
    }
}

TEST(Derivatives, PowersAtZero) {
    const auto at_zero = [](const std::string& expression) {
        const EquationSystem system = system_of({"y = " + expression}, numbers({"x"}));
        return std::pair(system.jacobian(vector({0.0}))(0, 0), system.hessians(vector({0.0})).front()(0, 0));
    };
    EXPECT_EQ(at_zero("x^2"), std::pair(0.0, 2.0));
    EXPECT_EQ(at_zero("x^1"), std::pair(1.0, 0.0));
    EXPECT_EQ(at_zero("x^0"), std::pair(0.0, 0.0));
    EXPECT_EQ(at_zero("x^3"), std::pair(0.0, 0.0));
    EXPECT_EQ(at_zero("x^2.5"), std::pair(0.0, 0.0));
    EXPECT_EQ(at_zero("x*x"), std::pair(0.0, 2.0));
    EXPECT_EQ(at_zero("1 + 5*x^2 - x"), std::pair(-1.0, 10.0));
    const EquationSystem root = system_of({"y = x^0.5"}, numbers({"x"}));
    EXPECT_EQ(root.evaluate(vector({0.0}))(0), 0.0);
    EXPECT_EQ(no_result_code([&] { (void)root.jacobian(vector({0.0})); }), "0064");
    const EquationSystem steep = system_of({"y = x^1.5"}, numbers({"x"}));
    EXPECT_EQ(steep.jacobian(vector({0.0}))(0, 0), 0.0);
    EXPECT_EQ(no_result_code([&] { (void)steep.hessians(vector({0.0})); }), "0064");
    // x^n with n declared constant: no logarithm of a negative base is asked for.
    const EquationSystem constant = system_of({"y = x^n"}, {input("x"), input("n", "1", 3.0)});
    EXPECT_EQ(constant.jacobian(vector({-2.0, 3.0})), (Eigen::MatrixXd(1, 2) << 12.0, 0.0).finished());
    // The product of two zeros: the mixed derivative is not lost.
    const EquationSystem product = system_of({"y = a*b"}, numbers({"a", "b"}));
    EXPECT_EQ(product.hessians(vector({0.0, 0.0})).front()(0, 1), 1.0);
    const EquationSystem chain = system_of({"y = (a*b)^2*a"}, numbers({"a", "b"}));
    EXPECT_TRUE(chain.hessians(vector({0.0, 0.0})).front().isZero(0.0));
}

TEST(Derivatives, TiesAreRefused) {
    const std::vector<std::string> ties{"abs(a - b)", "min(a, b)", "max(2*a, b + 1)", "sqrt((a - b)^2)"};
    for (const std::string& tie : ties) {
        const EquationSystem system = system_of({"y = " + tie}, numbers({"a", "b"}));
        const Eigen::VectorXd x = vector({1.0, 1.0});
        EXPECT_NO_THROW((void)system.evaluate(x)) << tie;
        const std::string expected = tie.starts_with("sqrt") ? "0064" : "0063";
        EXPECT_EQ(no_result_code([&] { (void)system.jacobian(x); }), expected) << tie;
        EXPECT_EQ(no_result_code([&] { (void)system.hessians(x); }), expected) << tie;
    }
    // … where they do not matter, they do not.
    const EquationSystem harmless = system_of({"y = c*abs(a) + b"}, numbers({"a", "b", "c"}));
    EXPECT_EQ(harmless.jacobian(vector({0.0, 1.0, 0.0}))(0, 1), 1.0);
    const EquationSystem same = system_of({"y = min(a, a)"}, numbers({"a"}));
    EXPECT_EQ(same.jacobian(vector({1.0}))(0, 0), 1.0);
}

TEST(Evaluation, SaysWhichOperationHasNoValue) {
    const auto text = [](const std::string& expression, const Eigen::VectorXd& x) {
        try {
            (void)system_of({"z = 1 + " + expression, "y = 2*z"}, numbers({"a", "b"})).evaluate(x);
        } catch (const NoResultError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(
        text("a/(b - 3)", vector({2.0, 3.0})),
        "m/0, column 10 — \"a/(b - 3)\" of 2 and 0 (coherent SI units) has no finite value — every operation of the "
        "model has a finite value at the estimates — Correct the equation, or the values of its inputs.");
    EXPECT_TRUE(text("ln(a - b)", vector({2.0, 3.0})).starts_with("m/0, column 9 — \"ln(a - b)\" of -1 (coherent"));
    EXPECT_NE(text("sqrt(a - b)", vector({2.0, 3.0})), "");
    EXPECT_NE(text("atan(1/(b - 3))/rad", vector({2.0, 3.0})), "");  // π/2 is no answer
    EXPECT_NE(text("1/0", vector({2.0, 3.0})), "");
    EXPECT_NE(text("exp(a)^2", vector({700.0, 3.0})), "");
    EXPECT_NE(text("a", vector({NAN, 3.0})), "");
}

TEST(Evaluation, RefusesAnotherNumberOfInputs) {
    const EquationSystem system = system_of({"y = a + b"}, numbers({"a", "b"}));
    EXPECT_THROW((void)system.evaluate(vector({1.0})), InputError);
    EXPECT_THROW((void)system.jacobian(vector({1.0, 2.0, 3.0})), InputError);
    Eigen::MatrixXd y(2, 1);
    EXPECT_THROW(system.evaluate_trials(Eigen::MatrixXd::Zero(2, 3), y), InputError);
}

TEST(EquationNames, AreFoundWithoutCompiling) {
    const EquationNames names = equation_names({.text = "y = a*sin(b*rad) + a^pi", .where = ""});
    EXPECT_EQ(names.defines, "y");
    EXPECT_EQ(names.uses, (std::vector<std::string>{"a", "b", "rad"}));
    EXPECT_EQ(equation_names({.text = "0 = a - b", .where = ""}).defines, "");
    EXPECT_THROW((void)equation_names({.text = "y = ", .where = ""}), InputError);
}

TEST(Derivatives, OfManyOutputs) {
    // Each output needs its own part of the tape only.
    std::vector<std::string> texts;
    std::vector<InputSymbol> inputs{input("common")};
    for (int i = 0; i < 200; ++i) {
        const std::string n = std::to_string(i);
        inputs.push_back(input("x" + n));
        texts.push_back("y" + n + " = exp(common)*x" + n + "^2");
    }
    const EquationSystem system = system_of(texts, inputs);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(201, 0.5, 1.5);
    const Eigen::MatrixXd jacobian = system.jacobian(x);
    const std::vector<Eigen::MatrixXd> hessians = system.hessians(x);
    for (Eigen::Index i = 0; i < 200; ++i) {
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(201);
        row(0) = std::exp(0.5) * x(i + 1) * x(i + 1);
        row(i + 1) = 2 * std::exp(0.5) * x(i + 1);
        EXPECT_TRUE(jacobian.row(i).isApprox(row, 1e-15));
        EXPECT_NEAR(hessians[static_cast<std::size_t>(i)](0, i + 1), row(i + 1), 1e-14);
        EXPECT_NEAR(hessians[static_cast<std::size_t>(i)].cwiseAbs().sum(),
                    std::fabs(row(0)) + 2 * row(i + 1) + 2 * std::exp(0.5), 1e-13);
    }
}

TEST(EquationSystem, EvaluatesTrialsAsChosenAtTheEstimates) {
    const EquationSystem system = system_of({"y = max(a, b) + abs(a)", "z = max(a, 0)"}, {input("a"), input("b")});
    EXPECT_TRUE(system.has_choices());
    EXPECT_FALSE(system_of({"y = hypot(a, b)"}, {input("a"), input("b")}).has_choices());
    Eigen::MatrixXd x(3, 2);
    x << 2.0, 1.0, 1.0, 3.0, -1.0, -2.0;
    Eigen::MatrixXd y(3, 2);
    system.evaluate_as_chosen(Eigen::Vector2d(2.0, 1.0), x, y);
    Eigen::MatrixXd expected(3, 2);
    expected << 4.0, 2.0, 2.0, 1.0, -2.0, 0.0;
    EXPECT_EQ(y, expected);
    // The solution of implicit equations that choose otherwise is not known.
    const EquationSystem implicit =
        system_of({"0 = 2*v - max(a, b)", "y = v + min(a, b)"}, {input("a"), input("b")}, {unknown("v", 1.0)});
    Eigen::MatrixXd of_implicit(3, 1);
    implicit.evaluate_as_chosen(Eigen::Vector2d(2.0, 1.0), x, of_implicit);
    EXPECT_DOUBLE_EQ(of_implicit(0), 2.0);
    EXPECT_TRUE(std::isnan(of_implicit(1)));
    EXPECT_DOUBLE_EQ(of_implicit(2), -2.5);
}

}  // namespace
}  // namespace gumcert::gum
