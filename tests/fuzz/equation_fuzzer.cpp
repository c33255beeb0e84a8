#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "gum/expression/equation_system.h"
#include "gum/expression/syntax_tree.h"

/// Any lines of text are refused with diagnostics or are a measurement model: it can be evaluated and differentiated,
/// or the failure is explained; trials agree with single evaluations; the printed equation means the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert::gum;
    std::vector<EquationText> equations(1);
    for (std::size_t i = 0; i < size; ++i) {
        if (data[i] == '\n') {
            equations.emplace_back();
        } else {
            equations.back().text += static_cast<char>(data[i]);
        }
    }
    // A model that is found by chance has names that are given here; unit 1 and another unit, a constant, a
    // temperature.
    static const std::vector<InputSymbol> inputs{{.name = "a", .unit = Unit(), .constant = {}},
                                                 {.name = "b", .unit = Unit(), .constant = {}},
                                                 {.name = "l", .unit = Unit::parse("mm"), .constant = {}},
                                                 {.name = "t", .unit = Unit::parse("degC"), .constant = {}},
                                                 {.name = "n", .unit = Unit(), .constant = 2.0}};
    std::vector<UnknownSymbol> unknowns;
    for (const EquationText& equation : equations) {
        try {
            const EquationNames names = equation_names(equation);
            if (names.defines.empty() && unknowns.size() < 3) {
                unknowns.push_back({.name = "z" + std::to_string(unknowns.size()), .start = 0.5, .unit = Unit()});
            }
            std::vector<Diagnostic> problems;
            const SyntaxTree tree = parse_equation(equation, {}, problems);
            const ExpressionLimits wide{.bytes = 1U << 20U};
            const SyntaxTree again = parse_equation({.text = print_equation(tree), .where = ""}, wide, problems);
            const auto same = [](const SyntaxNode& a, const SyntaxNode& b) {
                return a.operation == b.operation && a.left == b.left && a.right == b.right && a.value == b.value &&
                       a.name == b.name;
            };
            if (!problems.empty() || tree.names != again.names ||
                !std::equal(tree.nodes.begin(), tree.nodes.end(), again.nodes.begin(), again.nodes.end(), same)) {
                std::abort();
            }
        } catch (const InputError&) {
            continue;
        }
    }
    try {
        const EquationSystem system = EquationSystem::compile(equations, inputs, unknowns);
        const Eigen::VectorXd x = (Eigen::VectorXd(5) << 0.7, -1.25, 0.05, 20.0, 2.0).finished();
        (void)system.is_affine_in(std::vector<std::size_t>{0, 2});
        Eigen::MatrixXd y(3, static_cast<Eigen::Index>(system.output_count()));
        system.evaluate_trials(x.transpose().replicate(3, 1), y);
        try {
            const Eigen::VectorXd value = system.evaluate(x);
            if (value != y.row(2).transpose()) {
                std::abort();
            }
            (void)system.jacobian(x);
            (void)system.hessians(x);
        } catch (const NoResultError&) {
            return 0;
        }
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
