// What must hold for every measurement model: on equations, inputs and correlations that are made at random.
//
// The seed is fixed, so that one tree gives one verdict; RC_PARAMS="seed=…" in the environment looks elsewhere.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gum/coverage.h"
#include "gum/expression/equation_model.h"
#include "gum/expression/equation_system.h"
#include "gum/expression/syntax_tree.h"
#include "gum/monte_carlo/monte_carlo.h"
#include "gum/propagation.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

constexpr double k_epsilon = std::numeric_limits<double>::epsilon();

template <class Property>
void check_property(int cases, Property&& property) {
    setenv("RC_PARAMS", "seed=20080101", 0);  // read by rapidcheck when it is first used
    rc::detail::TestParams parameters = rc::detail::configuration().testParams;
    parameters.maxSuccess = cases;
    rc::detail::TestMetadata metadata;
    metadata.description = testing::UnitTest::GetInstance()->current_test_info()->name();
    const auto result = rc::detail::checkTestable(std::forward<Property>(property), metadata, parameters);
    if (!result.template is<rc::detail::SuccessResult>()) {
        std::ostringstream text;
        rc::detail::printResultMessage(result, text);
        FAIL() << text.str();
    }
}

// Building blocks. Numbers come from their whole range in every case, not only in the late ones.

/// low … high − 1
int pick(int low, int high) {
    return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high));
}
double pick_number(double low, double high) {
    constexpr int k_steps = 1'000'000;
    return low + (high - low) * pick(0, k_steps) / k_steps;
}
template <class T>
const T& pick_from(const std::vector<T>& items) {
    return items[static_cast<std::size_t>(pick(0, static_cast<int>(items.size())))];
}
std::vector<std::size_t> pick_order(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) {
        std::swap(order[i - 1], order[static_cast<std::size_t>(pick(0, static_cast<int>(i)))]);
    }
    return order;
}
template <class T>
std::vector<T> in_order(const std::vector<T>& items, const std::vector<std::size_t>& order) {
    std::vector<T> result;
    for (const std::size_t i : order) {
        result.push_back(items[i]);
    }
    return result;
}

/// An expression with the value that the C library gives it, far from every place where it has no derivative.
struct Expression {
    std::string text;
    double value = 0.0;
};

bool is_tame(double value) {
    return std::abs(value) < 20.0;
}

/// One of the operations that the value of the operand allows. Whole powers are products, by repeated squaring.
Expression pick_unary(const Expression& a) {
    const double v = a.value;
    std::vector<Expression> choices{{"-" + a.text, -v},
                                    {"sin(" + a.text + "*rad)", std::sin(v)},
                                    {"cos(" + a.text + "*rad)", std::cos(v)},
                                    {"atan(" + a.text + ")/rad", std::atan(v)},
                                    {"tanh(" + a.text + ")", std::tanh(v)},
                                    {a.text + "^2", v * v}};
    if (std::abs(v) < 2.5) {
        choices.push_back({"exp(" + a.text + ")", std::exp(v)});
        choices.push_back({"sinh(" + a.text + ")", std::sinh(v)});
        choices.push_back({"cosh(" + a.text + ")", std::cosh(v)});
        choices.push_back({a.text + "^3", v * (v * v)});
    }
    if (std::abs(v) < 0.8) {
        choices.push_back({"asin(" + a.text + ")/rad", std::asin(v)});
        choices.push_back({"acos(" + a.text + ")/rad", std::acos(v)});
    }
    if (std::abs(v) < 1.2) {
        choices.push_back({"tan(" + a.text + "*rad)", std::tan(v)});
    }
    if (std::abs(v) > 0.3) {
        choices.push_back({"abs(" + a.text + ")", std::abs(v)});
        choices.push_back({"1/" + a.text, 1.0 / v});
    }
    if (v > 0.3) {
        choices.push_back({"sqrt(" + a.text + ")", std::sqrt(v)});
        choices.push_back({"ln(" + a.text + ")", std::log(v)});
        choices.push_back({"log10(" + a.text + ")", std::log10(v)});
        choices.push_back({a.text + "^-0.5", std::pow(v, -0.5)});
    }
    return pick_from(choices);
}

Expression pick_binary(const Expression& a, const Expression& b) {
    const double v = a.value;
    const double w = b.value;
    std::vector<Expression> choices{
        {a.text + " + " + b.text, v + w}, {a.text + " - " + b.text, v - w}, {a.text + "*" + b.text, v * w}};
    if (std::abs(w) > 0.3) {
        choices.push_back({a.text + "/" + b.text, v / w});
    }
    if (std::hypot(v, w) > 0.3) {
        choices.push_back({"hypot(" + a.text + ", " + b.text + ")", std::hypot(v, w)});
    }
    if (std::hypot(v, w) > 0.3 && (w > 0.0 || std::abs(v) > 0.3)) {  // away from the cut
        choices.push_back({"atan2(" + a.text + ", " + b.text + ")/rad", std::atan2(v, w)});
    }
    if (std::abs(v - w) > 0.3) {
        choices.push_back({"min(" + a.text + ", " + b.text + ")", std::min(v, w)});
        choices.push_back({"max(" + a.text + ", " + b.text + ")", std::max(v, w)});
    }
    if (v > 0.3 && v < 4.0 && std::abs(w) < 2.0) {
        choices.push_back({a.text + "^" + b.text, std::pow(v, w)});
        choices.push_back({"pow(" + a.text + ", " + b.text + ")", std::pow(v, w)});
    }
    return pick_from(choices);
}

Expression pick_expression(const std::vector<Expression>& leaves, int depth) {
    if (depth == 0 || pick(0, 6) == 0) {
        return pick_from(leaves);
    }
    const Expression a = pick_expression(leaves, depth - 1);
    const Expression result = pick(0, 3) == 0 ? pick_unary(a) : pick_binary(a, pick_expression(leaves, depth - 1));
    return is_tame(result.value) ? Expression{"(" + result.text + ")", result.value} : a;
}

/// Equations in some order, with several results that use intermediate quantities; sometimes one is implicit.
struct Equations {
    std::vector<EquationText> texts;
    std::vector<InputSymbol> inputs;
    std::vector<UnknownSymbol> unknowns;
    std::vector<OutputSymbol> outputs;
    Eigen::VectorXd x;
    Eigen::VectorXd expected;  ///< outputs by the C library; empty of an implicit model

    [[nodiscard]] EquationSystem compile() const { return EquationSystem::compile(texts, inputs, unknowns, outputs); }
};

Equations pick_equations(bool may_be_implicit) {
    Equations result;
    std::vector<Expression> leaves{{"2.5", 2.5}};
    const int inputs = pick(1, 6);
    result.x.resize(inputs);
    for (int i = 0; i < inputs; ++i) {
        const double value = pick_number(0.4, 3.0) * (pick(0, 2) == 0 ? 1.0 : -1.0);
        result.inputs.push_back({.name = "x" + std::to_string(i), .unit = {}, .constant = {}});
        result.x[i] = value;
        leaves.push_back({result.inputs.back().name, value});
    }
    const int steps = pick(0, 3);
    for (int i = 0; i < steps; ++i) {
        const std::string name = "q" + std::to_string(i);
        const Expression step = pick_expression(leaves, 3);
        result.texts.push_back({name + " = " + step.text, name});
        leaves.push_back({name, step.value});
    }
    const bool implicit = may_be_implicit && pick(0, 4) == 0;
    if (implicit) {
        // t³ + t = e has one solution and no singular point, whatever e is.
        result.texts.push_back({"0 = t^3 + t - " + pick_expression(leaves, 3).text, "implicit"});
        result.unknowns.push_back({.name = "t", .start = 0.1, .unit = {}});
    }
    const int outputs = pick(1, 4);
    result.expected.resize(implicit ? 0 : outputs);
    for (int i = 0; i < outputs; ++i) {
        const std::string name = "y" + std::to_string(i);
        const Expression output = pick_expression(leaves, 4);
        result.texts.push_back({name + " = " + output.text + (implicit ? " + sin(t*rad)*x0" : ""), name});
        result.outputs.push_back({.name = name, .unit = {}, .where = name});
        if (!implicit) {
            result.expected[i] = output.value;
        }
    }
    result.texts = in_order(result.texts, pick_order(result.texts.size()));
    for (const EquationText& text : result.texts) {
        RC_LOG() << text.text << '\n';
    }
    for (const double x : result.x) {
        RC_LOG() << "x = " << text::shortest(x) << '\n';
    }
    return result;
}

/// Correlation matrix of some rank: half of them are singular.
Eigen::MatrixXd pick_correlation(Eigen::Index size) {
    const Eigen::Index rank = pick(0, 2) == 0 ? size : std::max<Eigen::Index>(1, size - 1);
    Eigen::MatrixXd root(size, rank);
    for (Eigen::Index i = 0; i < size; ++i) {
        for (Eigen::Index k = 0; k < rank; ++k) {
            root(i, k) = pick_number(-1.0, 1.0);
        }
        root(i, pick(0, static_cast<int>(rank))) += 1.5;  // no row is nearly zero
        root.row(i).normalize();
    }
    Eigen::MatrixXd correlation = root * root.transpose();
    correlation = (0.5 * (correlation + correlation.transpose())).eval();
    correlation.diagonal().setOnes();
    return correlation;
}

/// Groups of one to three quantities, the larger ones correlated.
std::vector<InputGroup> pick_groups(const Eigen::VectorXd& x, double largest_u) {
    std::vector<InputGroup> groups;
    for (Eigen::Index first = 0; first < x.size();) {
        const Eigen::Index size = std::min<Eigen::Index>(x.size() - first, pick(1, 4));
        Eigen::VectorXd u(size);
        for (Eigen::Index i = 0; i < size; ++i) {
            u[i] = largest_u * pick_number(0.01, 1.0);
        }
        InputGroup group;
        group.name = "g" + std::to_string(groups.size());
        group.unit = "1";
        group.value = x.segment(first, size);
        group.covariance = u.asDiagonal() * pick_correlation(size) * u.asDiagonal();
        group.covariance = (0.5 * (group.covariance + group.covariance.transpose())).eval();
        groups.push_back(std::move(group));
        first += size;
    }
    return groups;
}

/// Covariance of all inputs, and the sum of the magnitudes that c V cᵀ is made of: what its rounding is measured by.
Eigen::MatrixXd joint_covariance(const std::vector<InputGroup>& groups, Eigen::Index size) {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
    Eigen::Index first = 0;
    for (const InputGroup& group : groups) {
        result.block(first, first, group.size(), group.size()) = group.covariance;
        first += group.size();
    }
    return result;
}

// The language.

/// Any text of the grammar, with spaces and parentheses that nobody needs. Only its form matters.
std::string pick_text(int depth) {
    static const std::vector<std::string> leaves{"a", "b_1", "Δt", "x'", "pi", "2", "0.1", "1e-3", ".5", "6.02e23"};
    static const std::vector<std::string> functions{"sqrt", "exp",  "ln",   "log",  "log10", "sin",  "cos",     "tan",
                                                    "asin", "acos", "atan", "sinh", "cosh",  "tanh", "celsius", "abs"};
    const auto spaces = [] { return std::string(static_cast<std::size_t>(pick(0, 2)), ' '); };
    if (depth == 0) {
        return pick_from(leaves);
    }
    const std::string a = pick_text(depth - pick(1, 3) < 0 ? 0 : depth - 1);
    switch (pick(0, 9)) {
        case 0:
            return "(" + spaces() + a + ")";
        case 1:
            return (pick(0, 2) == 0 ? "-" : "+") + spaces() + a;
        case 2:
            return pick_from(functions) + spaces() + "(" + a + ")";
        case 3:
            return pick_from(std::vector<std::string>{"hypot", "atan2", "min", "max", "pow"}) + "(" + a + "," +
                   spaces() + pick_text(depth - 1) + ")";
        case 4:  // a sign may stand in an exponent and after * and /, but an operand of ^ on the left is an atom
            return "(" + a + ")" + spaces() + "^" + spaces() + pick_text(depth - 1);
        default:
            return a + spaces() + pick_from(std::vector<std::string>{"+", "-", "*", "/"}) + spaces() +
                   pick_text(depth - 1);
    }
}

SyntaxTree parse(const std::string& text) {
    std::vector<Diagnostic> problems;
    SyntaxTree tree = parse_equation({text, "test"}, {}, problems);
    if (!tree.is_whole()) {
        RC_FAIL(text + ": " + (problems.empty() ? "no tree" : message(problems.front())));
    }
    return tree;
}

void expect_same_tree(const SyntaxTree& a, const SyntaxTree& b) {
    RC_ASSERT(a.defines == b.defines);
    RC_ASSERT(a.names == b.names);
    RC_ASSERT(a.nodes.size() == b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
        RC_ASSERT(a.nodes[i].operation == b.nodes[i].operation);
        RC_ASSERT(a.nodes[i].left == b.nodes[i].left);
        RC_ASSERT(a.nodes[i].right == b.nodes[i].right);
        RC_ASSERT(a.nodes[i].name == b.nodes[i].name);
        RC_ASSERT(a.nodes[i].value == b.nodes[i].value);
    }
}

TEST(EquationLanguage, PrintedEquationsReadBackAsTheSameTree) {
    check_property(2000, [] {
        const std::string text = "y = " + pick_text(pick(0, 6));
        const SyntaxTree tree = parse(text);
        const std::string printed = print_equation(tree);
        const SyntaxTree again = parse(printed);
        expect_same_tree(tree, again);
        RC_ASSERT(print_equation(again) == printed);
        RC_ASSERT(printed.size() <= text.size() + 2 * tree.nodes.size());  // spaces about + and −
    });
}

TEST(EquationLanguage, ValuesAreThoseOfTheCLibraryToTheLastBit) {
    check_property(1000, [] {
        const Equations equations = pick_equations(false);
        const Eigen::VectorXd y = equations.compile().evaluate(equations.x);
        RC_ASSERT(y.size() == equations.expected.size());
        for (Eigen::Index i = 0; i < y.size(); ++i) {
            RC_ASSERT(y[i] == equations.expected[i]);
        }
        // Trials give the same bits, and so does the text that the program prints.
        Eigen::MatrixXd trials(1, y.size());
        equations.compile().evaluate_trials(equations.x.transpose(), trials);
        RC_ASSERT(trials == y.transpose());
        Equations printed = equations;
        for (EquationText& text : printed.texts) {
            text.text = print_equation(parse(text.text));
        }
        RC_ASSERT(printed.compile().evaluate(equations.x) == y);
    });
}

// Derivatives.

/// ∂/∂x_i by central differences, extrapolated to step 0 (Richardson), with what the two steps differ by as its error.
struct Difference {
    Eigen::VectorXd value, error;
};
template <class Function>
Difference difference(const Function& function, const Eigen::VectorXd& x, Eigen::Index i) {
    const auto central = [&](double step) -> Eigen::VectorXd {
        Eigen::VectorXd above = x;
        Eigen::VectorXd below = x;
        above[i] += step;
        below[i] -= step;
        return (function(above) - function(below)) / (above[i] - below[i]);
    };
    constexpr double k_step = 1e-4;
    const Eigen::VectorXd coarse = central(k_step);
    const Eigen::VectorXd fine = central(0.5 * k_step);
    return {(4.0 * fine - coarse) / 3.0, (fine - coarse).cwiseAbs()};
}

/// Differences say something only where the two steps nearly agree.
bool differences_hold(const Difference& by_steps) {
    return (by_steps.error.array() < 1e-4 * (1.0 + by_steps.value.array().abs())).all();
}

TEST(EquationDerivatives, JacobianAgreesWithCentralDifferences) {
    check_property(1000, [] {
        const Equations equations = pick_equations(true);
        const EquationSystem system = equations.compile();
        const Eigen::MatrixXd jacobian = system.jacobian(equations.x);
        RC_ASSERT(jacobian.rows() == static_cast<Eigen::Index>(equations.outputs.size()));
        RC_ASSERT(jacobian.cols() == equations.x.size());
        for (Eigen::Index i = 0; i < equations.x.size(); ++i) {
            const Difference by_steps =
                difference([&](const Eigen::VectorXd& at) { return system.evaluate(at); }, equations.x, i);
            RC_PRE(differences_hold(by_steps));
            for (Eigen::Index k = 0; k < jacobian.rows(); ++k) {
                RC_ASSERT(std::abs(jacobian(k, i) - by_steps.value[k]) <=
                          1e-8 * (1.0 + std::abs(jacobian(k, i))) + by_steps.error[k]);
            }
        }
    });
}

TEST(EquationDerivatives, SecondDerivativesAreSymmetricAndThoseOfTheJacobian) {
    check_property(1000, [] {
        const Equations equations = pick_equations(true);
        const EquationSystem system = equations.compile();
        const std::vector<Eigen::MatrixXd> hessians = system.hessians(equations.x);
        RC_ASSERT(hessians.size() == equations.outputs.size());
        for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(hessians.size()); ++k) {
            const Eigen::MatrixXd& hessian = hessians[static_cast<std::size_t>(k)];
            RC_ASSERT(hessian == hessian.transpose());  // to the last bit
            for (Eigen::Index i = 0; i < equations.x.size(); ++i) {
                const Difference by_steps =
                    difference([&](const Eigen::VectorXd& at) -> Eigen::VectorXd { return system.jacobian(at).row(k); },
                               equations.x, i);
                RC_PRE(differences_hold(by_steps));
                for (Eigen::Index j = 0; j < equations.x.size(); ++j) {
                    RC_ASSERT(std::abs(hessian(i, j) - by_steps.value[j]) <=
                              1e-8 * (1.0 + std::abs(hessian(i, j)) + std::abs(by_steps.value[j])) + by_steps.error[j]);
                }
            }
        }
        // An affine model has none, and a model with a second derivative is not said to be affine.
        std::vector<std::size_t> all(equations.inputs.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        if (system.is_affine_in(all)) {
            for (const Eigen::MatrixXd& hessian : hessians) {
                RC_ASSERT(hessian.isZero(0.0));
            }
        }
    });
}

// The law of propagation.

TEST(LawOfPropagation, ContributionsAndCovariancesSumToTheVariance) {
    check_property(1000, [] {
        const Equations equations = pick_equations(true);
        const EquationModel model(equations.compile(), pick_groups(equations.x, 0.05));
        const Propagation result = propagate(model, 0.9545);
        const Eigen::MatrixXd V = joint_covariance(model.inputs(), equations.x.size());
        for (Eigen::Index k = 0; k < result.value.size(); ++k) {
            const double variance = result.standard_uncertainty[k] * result.standard_uncertainty[k];
            double groups = 0.0;
            double shares = 0.0;
            for (const BudgetContribution& row : result.budget) {
                RC_ASSERT(row.variance[k] >= 0.0);
                groups += row.variance[k];
                shares += row.share[k];
            }
            RC_ASSERT(std::abs(groups - variance) <= 1e-14 * variance);
            RC_ASSERT(std::abs(shares - (variance > 0.0 ? 1.0 : 0.0)) <= 1e-12);
            // As a person adds up the budget: Σ c_i² u_i² and 2 Σ c_i c_j u(x_i, x_j).
            double sum = 0.0;
            double magnitude = 0.0;
            for (Eigen::Index i = 0; i < equations.x.size(); ++i) {
                for (Eigen::Index j = 0; j < equations.x.size(); ++j) {
                    const double term = result.jacobian(k, i) * result.jacobian(k, j) * V(i, j);
                    sum += term;
                    magnitude += std::abs(term);
                }
            }
            RC_ASSERT(std::abs(sum - variance) <= 100.0 * k_epsilon * magnitude);
            RC_ASSERT(std::abs(result.covariance(k, k) - variance) <= 4.0 * k_epsilon * variance);
            RC_ASSERT(result.expanded_uncertainty[k] == result.coverage_factor[k] * result.standard_uncertainty[k]);
        }
        RC_ASSERT(result.covariance == result.covariance.transpose());
        const double smallest =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(result.covariance).eigenvalues().minCoeff();
        RC_ASSERT(smallest >= -1e-14 * (1e-300 + result.covariance.trace()));
    });
}

TEST(LawOfPropagation, ConstantsGiveNoUncertainty) {
    check_property(200, [] {
        const Equations equations = pick_equations(true);
        InputGroup constants;
        constants.name = "constants";
        constants.unit = "1";
        constants.value = equations.x;
        constants.covariance = Eigen::MatrixXd::Zero(equations.x.size(), 1);
        const Propagation result = propagate(EquationModel(equations.compile(), {constants}), 0.95);
        RC_ASSERT(result.standard_uncertainty.isZero(0.0));
        RC_ASSERT(result.expanded_uncertainty.isZero(0.0));
    });
}

/// Order of inputs: values and sensitivity coefficients keep every bit; u, a sum in another order, keeps all but the
/// rounding of its terms. Order of equations: values keep every bit, sensitivity coefficients all but rounding.
TEST(LawOfPropagation, OrderOfInputsAndEquationsDoesNotMatter) {
    check_property(1000, [] {
        const Equations equations = pick_equations(true);
        const std::vector<InputGroup> groups = pick_groups(equations.x, 0.05);
        const Propagation result = propagate(EquationModel(equations.compile(), groups), 0.95);

        // Groups in another order, and the inputs of each in another order.
        std::vector<std::vector<std::size_t>> members;
        for (std::size_t first = 0, g = 0; g < groups.size(); ++g) {
            members.emplace_back(static_cast<std::size_t>(groups[g].size()));
            std::iota(members[g].begin(), members[g].end(), first);
            first += members[g].size();
        }
        std::vector<std::size_t> order;
        std::vector<InputGroup> other_groups;
        for (const std::size_t g : pick_order(groups.size())) {
            InputGroup group = groups[g];
            const std::vector<std::size_t> inside = pick_order(members[g].size());
            for (std::size_t i = 0; i < inside.size(); ++i) {
                const auto row = static_cast<Eigen::Index>(i);
                group.value[row] = groups[g].value[static_cast<Eigen::Index>(inside[i])];
                for (std::size_t j = 0; j < inside.size(); ++j) {
                    group.covariance(row, static_cast<Eigen::Index>(j)) = groups[g].covariance(
                        static_cast<Eigen::Index>(inside[i]), static_cast<Eigen::Index>(inside[j]));
                }
                order.push_back(members[g][inside[i]]);
            }
            other_groups.push_back(std::move(group));
        }
        Equations other = equations;
        other.inputs = in_order(equations.inputs, order);
        const Propagation permuted = propagate(EquationModel(other.compile(), other_groups), 0.95);
        RC_ASSERT(permuted.value == result.value);
        const Eigen::MatrixXd V = joint_covariance(groups, equations.x.size()).cwiseAbs();
        for (Eigen::Index k = 0; k < result.value.size(); ++k) {
            for (std::size_t i = 0; i < order.size(); ++i) {
                RC_ASSERT(permuted.jacobian(k, static_cast<Eigen::Index>(i)) ==
                          result.jacobian(k, static_cast<Eigen::Index>(order[i])));
            }
            const Eigen::VectorXd c = result.jacobian.row(k).cwiseAbs();
            const double rounding = 20.0 * k_epsilon * c.dot(V * c);
            RC_ASSERT(std::abs(permuted.covariance(k, k) - result.covariance(k, k)) <= rounding);
        }

        other = equations;
        other.texts = in_order(equations.texts, pick_order(equations.texts.size()));
        const Propagation reordered = propagate(EquationModel(other.compile(), groups), 0.95);
        RC_ASSERT(reordered.value == result.value);
        RC_ASSERT((reordered.jacobian - result.jacobian).cwiseAbs().maxCoeff() <=
                  1e-13 * (1.0 + result.jacobian.cwiseAbs().maxCoeff()));
    });
}

/// Lengths that make numbers and lengths: every sum balances.
struct Typed {
    std::string text;
    bool is_length = false;
};

Typed pick_typed(int lengths, bool is_length, int depth) {
    if (depth == 0) {
        return is_length ? Typed{"L" + std::to_string(pick(0, lengths)), true} : Typed{pick(0, 2) == 0 ? "n" : "1.5"};
    }
    const auto length = [&] { return pick_typed(lengths, true, depth - 1).text; };
    const auto number = [&] { return pick_typed(lengths, false, depth - 1).text; };
    const auto chosen = pick(0, 5);
    std::string text;
    if (is_length) {
        text = chosen == 0   ? length() + " + " + length()
               : chosen == 1 ? length() + "*cos(" + number() + "*rad)"
               : chosen == 2 ? "hypot(" + length() + ", " + length() + ")"
               : chosen == 3 ? "sqrt(" + length() + "^2 + " + length() + "^2)"
                             : length() + " - " + length() + "/(2 + " + number() + "^2)";
    } else {
        text = chosen == 0   ? length() + "/sqrt(" + length() + "^2 + L0^2)"
               : chosen == 1 ? "sin(" + length() + "/L0*rad)"
               : chosen == 2 ? "atan2(" + length() + ", L0)/rad"
               : chosen == 3 ? "exp(-" + length() + "^2/(L0^2 + " + length() + "^2))"
                             : number() + "*" + number();
    }
    return {"(" + text + ")", is_length};
}

/// Lengths are whole numbers of micrometres. In micrometres and in metres they are the same doubles inside, so that
/// every bit of the result is the same; in millimetres they may differ by a rounding, and the printed result is the
/// same.
TEST(LawOfPropagation, UnitsOfInputsDoNotMatter) {
    const auto decimal = [](long micrometres, int places) {
        const std::string text = std::to_string(micrometres) + "e-" + std::to_string(places);
        double value = 0.0;
        std::from_chars(text.data(), text.data() + text.size(), value);
        return value;
    };
    check_property(1000, [&] {
        const int lengths = pick(1, 5);
        const Typed equation = pick_typed(lengths, pick(0, 2) == 0, pick(1, 4));
        RC_LOG() << equation.text << '\n';
        std::vector<long> value;
        std::vector<long> u;
        for (int i = 0; i < lengths; ++i) {
            value.push_back(pick(100'000, 5'000'000));
            u.push_back(pick(1, 999));
            RC_LOG() << value.back() << ", " << u.back() << '\n';
        }
        const auto propagated = [&](const std::string& name, int places) {
            const Unit unit = Unit::parse(name);
            std::vector<InputSymbol> symbols;
            std::vector<InputGroup> groups;
            const auto add = [&](const std::string& symbol, const Unit& in, double x, double u_x) {
                symbols.push_back({.name = symbol, .unit = in, .constant = {}});
                InputGroup group;
                group.name = symbol;
                group.unit = "m";
                group.value = Eigen::VectorXd::Constant(1, in.to_si(x));
                const double u_si = in.difference_to_si(u_x);
                group.covariance = Eigen::MatrixXd::Constant(1, 1, u_si * u_si);
                groups.push_back(std::move(group));
            };
            for (std::size_t i = 0; i < value.size(); ++i) {
                add("L" + std::to_string(i), unit, decimal(value[i], places), decimal(u[i], places));
            }
            add("n", Unit::parse("1"), 0.7, 0.01);
            const std::vector<EquationText> texts{{"y = " + equation.text, "y"}};
            EquationSystem system = EquationSystem::compile(texts, symbols);
            RC_ASSERT(system.output_unit(0).dimension() ==
                      (equation.is_length ? Unit::parse("m") : Unit::parse("1")).dimension());
            return propagate(EquationModel(std::move(system), std::move(groups)), 0.95);
        };
        const Propagation in_micrometres = propagated("um", 0);
        const Propagation in_metres = propagated("m", 6);
        const Propagation in_millimetres = propagated("mm", 3);
        RC_ASSERT(in_metres.value == in_micrometres.value);
        RC_ASSERT(in_metres.jacobian == in_micrometres.jacobian);
        RC_ASSERT(in_metres.expanded_uncertainty == in_micrometres.expanded_uncertainty);
        // hypot(L0, L0)/L0 does not depend on L0: its U is nothing but rounding.
        if (in_metres.expanded_uncertainty[0] > 1e-9 * std::abs(in_metres.value[0])) {
            const Unit unit = Unit::parse(equation.is_length ? "mm" : "1");
            const auto printed = [&](const Propagation& result) {
                return round_to_uncertainty(unit.from_si(result.value[0]),
                                            unit.difference_from_si(result.expanded_uncertainty[0]));
            };
            RC_ASSERT(printed(in_millimetres) == printed(in_metres));
        }
    });
}

// Two methods, one answer.

/// For a linear model with normal inputs the law of propagation is exact, and Monte Carlo must agree within its own
/// numerical errors: 1000 models, each with its own seed. Five standard errors are exceeded once in two million
/// comparisons; the mean square of the deviations is watched as well, so that an error much smaller than that is seen.
TEST(MonteCarloAndLawOfPropagation, AgreeForLinearModelsWithNormalInputs) {
    constexpr int k_models = 1000;
    constexpr double k_trials = 20'000.0;
    constexpr double k_probability = 0.95;
    double squares_of_means = 0.0;
    double squares_of_uncertainties = 0.0;
    int outputs_seen = 0;
    int correlated = 0;
    std::mt19937_64 generator(1);
    const auto number = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(generator() >> 11U) * 0x1p-53;
    };
    const auto whole = [&](int low, int high) { return static_cast<int>(number(low, high)); };
    for (int m = 0; m < k_models; ++m) {
        const int inputs = whole(1, 7);
        std::vector<InputSymbol> symbols;
        std::array<std::string, 2> sums{"0.5", "-3"};
        for (int i = 0; i < inputs; ++i) {
            symbols.push_back({.name = "x" + std::to_string(i), .unit = {}, .constant = {}});
            for (std::string& sum : sums) {
                sum += " + " + text::shortest(std::abs(number(-3.0, 3.0))) + "*" + (whole(0, 2) == 0 ? "" : "-") +
                       symbols.back().name;
            }
        }
        std::vector<InputGroup> groups;
        for (int first = 0; first < inputs;) {
            const int size = std::min(inputs - first, whole(1, 4));
            const int rank = whole(0, 3) == 0 ? 1 : size;  // rank 1: correlation coefficients of ±1
            Eigen::MatrixXd root(size, rank);
            InputGroup group;
            group.name = "g" + std::to_string(first);
            group.unit = "1";
            group.value.resize(size);
            for (int i = 0; i < size; ++i) {
                group.value[i] = number(-10.0, 10.0);
                for (int k = 0; k < rank; ++k) {
                    root(i, k) = number(-1.0, 1.0);
                }
            }
            group.covariance = root * root.transpose();
            group.covariance = (0.5 * (group.covariance + group.covariance.transpose())).eval();
            groups.push_back(std::move(group));
            correlated += size > 1 ? 1 : 0;
            first += size;
        }
        const std::vector<EquationText> texts{{"y = " + sums[0], "y"}, {"z = " + sums[1], "z"}};
        const EquationModel model(EquationSystem::compile(texts, symbols), std::move(groups));
        const Propagation law = propagate(model, k_probability);
        MonteCarloOptions options;
        options.trials = static_cast<std::uint64_t>(k_trials);
        options.seed = static_cast<std::uint64_t>(m) + 1;
        options.coverage_probability = k_probability;
        options.threads = 1;
        options.regions = false;
        const MonteCarloResult trials = run_monte_carlo(model, options);
        for (Eigen::Index k = 0; k < 2; ++k) {
            const MonteCarloOutput& output = trials.outputs[static_cast<std::size_t>(k)];
            const double u = law.standard_uncertainty[k];
            const double U = law.expanded_uncertainty[k];
            SCOPED_TRACE("model " + std::to_string(m) + ": " + texts[static_cast<std::size_t>(k)].text);
            const double z_mean = (output.mean - law.value[k]) / (u / std::sqrt(k_trials));
            const double z_u = (output.standard_uncertainty - u) / (u / std::sqrt(2.0 * k_trials));
            EXPECT_LT(std::abs(z_mean), 5.0);
            EXPECT_LT(std::abs(z_u), 5.0);
            // The errors that the program states are those of a normal distribution, within what they scatter.
            EXPECT_NEAR(output.numerical_error.mean, u / std::sqrt(k_trials), 0.05 * u / std::sqrt(k_trials));
            EXPECT_NEAR(output.numerical_error.standard_uncertainty, u / std::sqrt(2.0 * k_trials),
                        0.1 * u / std::sqrt(2.0 * k_trials));
            // Ends of the interval: √(p(1 − p)/M)/density, with p the part beyond the end.
            const double beyond = 0.5 * (1.0 - k_probability);
            const double density = 0.05844507 / u;  // of the normal distribution at 1.959964 u
            const double error = std::sqrt(beyond * (1.0 - beyond) / k_trials) / density;
            EXPECT_LT(std::abs(output.symmetric.low - (law.value[k] - U)), 5.0 * error);
            EXPECT_LT(std::abs(output.symmetric.high - (law.value[k] + U)), 5.0 * error);
            squares_of_means += z_mean * z_mean;
            squares_of_uncertainties += z_u * z_u;
            ++outputs_seen;
        }
        const double covariance_error = std::sqrt(
            (law.covariance(0, 0) * law.covariance(1, 1) + law.covariance(0, 1) * law.covariance(0, 1)) / k_trials);
        EXPECT_LT(std::abs(trials.covariance(0, 1) - law.covariance(0, 1)), 5.0 * covariance_error) << "model " << m;
    }
    EXPECT_GT(correlated, 500);
    // χ² over its number has the mean 1; the two outputs of a model are correlated, which at most doubles the variance.
    const double scatter = 5.0 * std::sqrt(2.0 * 2.0 / outputs_seen);
    EXPECT_NEAR(squares_of_means / outputs_seen, 1.0, scatter);
    EXPECT_NEAR(squares_of_uncertainties / outputs_seen, 1.0, scatter);
}

/// Second-order terms of quadratic models, which are exact for normal inputs, against Monte Carlo.
TEST(MonteCarloAndLawOfPropagation, AgreeForQuadraticModelsToSecondOrder) {
    constexpr double k_trials = 50'000.0;
    check_property(100, [] {
        const int inputs = pick(1, 4);
        std::vector<InputSymbol> symbols;
        Eigen::VectorXd x(inputs);
        std::string sum = "0";
        for (int i = 0; i < inputs; ++i) {
            symbols.push_back({.name = "x" + std::to_string(i), .unit = {}, .constant = {}});
            x[i] = pick_number(-1.0, 1.0);
            for (int j = 0; j <= i; ++j) {
                sum +=
                    " + " + text::shortest(pick_number(0.1, 2.0)) + "*x" + std::to_string(i) + "*x" + std::to_string(j);
            }
        }
        const std::vector<EquationText> texts{{"y = " + sum, "y"}};
        const EquationModel model(EquationSystem::compile(texts, symbols), pick_groups(x, 1.0));
        const Propagation first = propagate(model, 0.95);
        const auto second = propagate_to_second_order(model, first);
        RC_ASSERT(second.has_value());
        RC_ASSERT(second->standard_uncertainty[0] >= first.standard_uncertainty[0] * (1.0 - 1e-12));
        MonteCarloOptions options;
        options.trials = static_cast<std::uint64_t>(k_trials);
        options.seed = static_cast<std::uint64_t>(pick(1, 1'000'000));
        options.threads = 1;
        options.regions = false;
        const MonteCarloOutput output = run_monte_carlo(model, options).outputs.front();
        RC_ASSERT(std::abs(output.mean - first.value[0] - second->shift[0]) < 5.0 * output.numerical_error.mean);
        RC_ASSERT(std::abs(output.standard_uncertainty - second->standard_uncertainty[0]) <
                  5.0 * output.numerical_error.standard_uncertainty);
    });
}

}  // namespace
}  // namespace gumcert::gum
