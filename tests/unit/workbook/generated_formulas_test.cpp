// A law: a formula made at random means the same after it was printed and read, and its value is that of a second evaluation
// of the tree, which knows nothing of cells, texts or order of evaluation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tests/support/workbook_of.h"
#include "workbook/evaluate.h"
#include "workbook/formula_text.h"

namespace gumcert::workbook {
namespace {

/// A number, a truth value or an error.
struct Outcome {
    double number = 0.0;
    bool is_truth = false;
    std::optional<CellError> error = {};
};

constexpr double k_cells[] = {2.0, -0.5, 0.0, 1e3};  // A1 to A4

class FormulaMaker {
public:
    explicit FormulaMaker(std::uint64_t seed) : random_(seed) {}

    Formula make() {
        made_ = {};
        any(5);
        return made_;
    }

private:
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

    std::uint32_t add(FormulaNode node, const std::vector<std::uint32_t>& children = {}) {
        node.first_child = static_cast<std::uint32_t>(made_.children.size());
        node.children = static_cast<std::uint32_t>(children.size());
        made_.children.insert(made_.children.end(), children.begin(), children.end());
        made_.nodes.push_back(node);
        return made_.root();
    }

    std::uint32_t any(std::size_t depth) {
        switch (depth == 0 ? below(3) : below(10)) {
            case 0:
                return add({.kind = FormulaNodeKind::number, .number = static_cast<double>(below(40)) / 8});
            case 1: {
                Reference reference;
                reference.first = reference.last = {.address = {static_cast<std::uint32_t>(1 + below(4)), 1},
                                                    .column_is_absolute = below(2) == 0};
                made_.references.push_back(reference);
                return add({.kind = FormulaNodeKind::reference,
                            .reference = static_cast<std::uint32_t>(made_.references.size() - 1)});
            }
            case 2:
                return add({.kind = FormulaNodeKind::boolean, .number = static_cast<double>(below(2))});
            case 3: {
                const std::uint32_t child = any(depth - 1);
                return add({.kind = below(3) == 0 ? FormulaNodeKind::percent : FormulaNodeKind::negate}, {child});
            }
            case 4: {
                static const char* const k_names[] = {"SUM", "MAX", "MIN", "IF", "ABS", "SQRT", "IFERROR", "PRODUCT"};
                const std::string name = k_names[below(8)];
                const std::size_t count = name == "IF"                      ? 3
                                          : name == "IFERROR"               ? 2
                                          : name == "ABS" || name == "SQRT" ? 1
                                                                            : 1 + below(3);
                std::vector<std::uint32_t> arguments;
                for (std::size_t i = 0; i < count; ++i) {
                    arguments.push_back(any(depth - 1));
                }
                return add({.kind = FormulaNodeKind::call, .text = name}, arguments);
            }
            default: {
                const std::uint32_t left = any(depth - 1);
                const std::uint32_t right = any(depth - 1);
                static constexpr FormulaNodeKind k_kinds[] = {
                    FormulaNodeKind::add,      FormulaNodeKind::subtract,   FormulaNodeKind::multiply,
                    FormulaNodeKind::divide,   FormulaNodeKind::power,      FormulaNodeKind::less,
                    FormulaNodeKind::equal,    FormulaNodeKind::not_equal,  FormulaNodeKind::add,
                    FormulaNodeKind::multiply, FormulaNodeKind::less_equal, FormulaNodeKind::greater};
                return add({.kind = k_kinds[below(12)]}, {left, right});
            }
        }
    }

    std::mt19937_64 random_;
    Formula made_;
};

Outcome finite(double number) {
    return std::isfinite(number) ? Outcome{number} : Outcome{.error = CellError::number};
}

Outcome joined_directly(FormulaNodeKind kind, const Outcome& a, const Outcome& b) {
    if (a.error || b.error) {
        return a.error ? a : b;
    }
    const int rank = static_cast<int>(a.is_truth) - static_cast<int>(b.is_truth);
    const int order = rank != 0 ? rank : a.number < b.number ? -1 : a.number > b.number ? 1 : 0;
    switch (kind) {
        case FormulaNodeKind::add:
            return finite(a.number + b.number);
        case FormulaNodeKind::subtract:
            return finite(a.number - b.number);
        case FormulaNodeKind::multiply:
            return finite(a.number * b.number);
        case FormulaNodeKind::divide:
            return b.number == 0.0 ? Outcome{.error = CellError::division_by_zero} : finite(a.number / b.number);
        case FormulaNodeKind::power:
            if (a.number == 0.0 && b.number <= 0.0) {
                return {.error = b.number == 0.0 ? CellError::number : CellError::division_by_zero};
            }
            return finite(std::pow(a.number, b.number));
        case FormulaNodeKind::less:
            return {order < 0 ? 1.0 : 0.0, true};
        case FormulaNodeKind::less_equal:
            return {order <= 0 ? 1.0 : 0.0, true};
        case FormulaNodeKind::greater:
            return {order > 0 ? 1.0 : 0.0, true};
        case FormulaNodeKind::equal:
            return {order == 0 ? 1.0 : 0.0, true};
        default:
            return {order != 0 ? 1.0 : 0.0, true};
    }
}

Outcome evaluated_directly(const Formula& formula, std::uint32_t place) {
    const FormulaNode& node = formula.nodes[place];
    const auto child = [&](std::size_t i) { return evaluated_directly(formula, formula.children_of(node)[i]); };
    switch (node.kind) {
        case FormulaNodeKind::number:
            return {node.number};
        case FormulaNodeKind::boolean:
            return {node.number, true};
        case FormulaNodeKind::reference:
            return {k_cells[formula.references[node.reference].first.address.row - 1]};
        case FormulaNodeKind::negate:
        case FormulaNodeKind::percent: {
            const Outcome one = child(0);
            return one.error ? one : Outcome{node.kind == FormulaNodeKind::negate ? -one.number : one.number / 100};
        }
        case FormulaNodeKind::call:
            break;
        default:
            return joined_directly(node.kind, child(0), child(1));
    }
    const Outcome first = child(0);
    if (node.text == "IFERROR") {
        return first.error ? child(1) : first;
    }
    if (first.error) {
        return first;
    }
    if (node.text == "IF") {
        return first.number != 0.0 ? child(1) : child(2);
    }
    if (node.text == "ABS") {
        return {std::abs(first.number)};
    }
    if (node.text == "SQRT") {
        return finite(std::sqrt(first.number));
    }
    double total = first.number;
    for (std::uint32_t i = 1; i < node.children; ++i) {
        const Outcome one = child(i);
        if (one.error) {
            return one;
        }
        total = node.text == "SUM"       ? total + one.number
                : node.text == "PRODUCT" ? total * one.number
                : node.text == "MAX"     ? std::max(total, one.number)
                                         : std::min(total, one.number);
    }
    return finite(total);
}

TEST(GeneratedFormulas, MeanTheSameWhenPrintedAndRead) {
    std::size_t numbers = 0, errors = 0, unknown = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        const Formula formula = FormulaMaker(seed).make();
        const std::string text = print_formula(formula);
        const Formula again = parse_formula(text, "B1");
        ASSERT_TRUE(same_formula(formula, again)) << seed << ": " << text;
        ASSERT_EQ(print_formula(again), text);

        // Times 1, so that the last operation is none that takes rounding off.
        const Workbook workbook =
            test::workbook_of({{"A1", "2"}, {"B1", "=(" + text + ")*1"}, {"A2", "-0.5"}, {"A3", "0"}, {"A4", "1000"}});
        const Evaluation evaluation = evaluate_workbook(workbook);
        const CellValue& value = evaluation.cells.at(0).value;
        if (evaluation.cells[0].state == EvaluationState::not_evaluated) {
            ASSERT_EQ(why_not_evaluated(evaluation, workbook, evaluation.cells[0]),
                      "a comparison that only rounding decides")
                << text;
            ++unknown;
            continue;
        }
        const Outcome expected = evaluated_directly(formula, formula.root());
        if (expected.error) {
            ASSERT_EQ(value.kind, CellKind::error) << text;
            ASSERT_EQ(value.error, *expected.error) << text;
            ++errors;
        } else {
            ASSERT_EQ(value.kind, CellKind::number) << text;
            ASSERT_EQ(value.number, expected.number) << text;
            ++numbers;
        }
    }
    EXPECT_GT(numbers, 1000U);
    EXPECT_GT(errors, 100U);
    EXPECT_LT(unknown, 40U);
}

}  // namespace
}  // namespace gumcert::workbook
