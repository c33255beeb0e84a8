#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/expression/equation_system.h"
#include "gum/expression/operation.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

struct SyntaxNode {
    Operation operation = Operation::number;
    std::int32_t left = -1;    ///< index of the first operand, -1: none
    std::int32_t right = -1;   ///< index of the second one
    double value = 0.0;        ///< of a number
    std::uint32_t name = 0;    ///< of a quantity: index into SyntaxTree::names
    std::uint32_t column = 1;  ///< of the operator, function, name or number; in characters, from 1
    std::uint32_t begin = 0;   ///< the sub-expression in the text: bytes [begin, end), with its parentheses
    std::uint32_t end = 0;
};

/// One equation as a flat tree: operands stand before their operator, the whole right-hand side is the last node.
/// Passes over it are loops, so its depth costs no stack.
struct SyntaxTree {
    std::string text;
    std::string where;
    std::string defines;  ///< left-hand side; empty for "0 = …"
    std::uint32_t defines_column = 1;
    std::vector<SyntaxNode> nodes;   ///< empty when the equation could not be read to its end
    std::vector<std::string> names;  ///< quantities that it uses, each once, in order
    bool has_left_side = false;      ///< `defines` is meaningful even when the equation was refused

    bool refused = false;  ///< something is wrong; with nodes, its names can still be looked at

    [[nodiscard]] bool is_whole() const { return !nodes.empty() && !refused; }
    [[nodiscard]] bool is_implicit() const { return has_left_side && defines.empty(); }
    /// The sub-expression as it was written, shortened to some forty characters.
    [[nodiscard]] std::string excerpt(const SyntaxNode& node) const;
};

/// "where, column N"
[[nodiscard]] std::string place(const std::string& where, std::uint32_t column);

/// Whether a name is a quantity of the system, so that "d(x)" is a forgotten "*"; may be empty.
using IsQuantity = std::function<bool(std::string_view)>;

/// Reads one equation; what is wrong is added to `problems`.
[[nodiscard]] SyntaxTree parse_equation(const EquationText& equation, const ExpressionLimits& limits,
                                        std::vector<Diagnostic>& problems, const IsQuantity& is_quantity = {});

/// The equation as text, with the fewest parentheses.
[[nodiscard]] std::string print_equation(const SyntaxTree& tree);

/// Name of a function of the language as it is written, e.g. "ln", or nothing.
[[nodiscard]] std::string_view function_name(Operation operation);
/// True for functions and pi, which cannot be names of quantities.
[[nodiscard]] bool is_reserved_name(std::string_view name);

}  // namespace gumcert::gum
