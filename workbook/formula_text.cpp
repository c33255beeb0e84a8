#include "workbook/formula_text.h"

#include <algorithm>
#include <array>
#include <utility>

#include "text/numbers.h"
#include "workbook/letters.h"

namespace gumcert::workbook {

namespace {

using NodeKind = FormulaNodeKind;

std::string_view operator_text(NodeKind kind) {
    switch (kind) {
        case NodeKind::power:
            return "^";
        case NodeKind::multiply:
            return "*";
        case NodeKind::divide:
            return "/";
        case NodeKind::add:
        case NodeKind::plus:
            return "+";
        case NodeKind::subtract:
        case NodeKind::negate:
            return "-";
        case NodeKind::concatenate:
            return "&";
        case NodeKind::equal:
            return "=";
        case NodeKind::not_equal:
            return "<>";
        case NodeKind::less:
            return "<";
        case NodeKind::less_equal:
            return "<=";
        case NodeKind::greater:
            return ">";
        case NodeKind::greater_equal:
            return ">=";
        case NodeKind::range:
            return ":";
        case NodeKind::intersection:
            return " ";
        case NodeKind::reunion:
            return ",";
        default:
            return "";
    }
}

constexpr int k_always = 10;  ///< closer than anything binds

/// How close an operator binds; operands that bind less close stand in brackets.
int binding(NodeKind kind) {
    switch (kind) {
        case NodeKind::equal:
        case NodeKind::not_equal:
        case NodeKind::less:
        case NodeKind::less_equal:
        case NodeKind::greater:
        case NodeKind::greater_equal:
            return 1;
        case NodeKind::concatenate:
            return 2;
        case NodeKind::add:
        case NodeKind::subtract:
            return 3;
        case NodeKind::multiply:
        case NodeKind::divide:
            return 4;
        case NodeKind::power:
            return 5;
        case NodeKind::negate:
        case NodeKind::plus:
            return 6;
        case NodeKind::percent:
            return 7;
        case NodeKind::range:
        case NodeKind::intersection:
            return 8;
        default:
            return 9;
    }
}

std::string doubled(std::string_view text, char mark) {
    std::string out(1, mark);
    for (const char c : text) {
        out.append(c == mark ? 2 : 1, c);
    }
    return out + mark;
}

/// Name of a sheet or a span of sheets, and of the workbook before it, with the exclamation mark.
std::string sheet_text(const Reference& reference) {
    if (reference.workbook.empty() && reference.sheet.empty()) {
        return "";
    }
    const bool is_plain =
        (reference.sheet.empty() || quoted_sheet(reference.sheet) == reference.sheet) &&
        (reference.last_sheet.empty() || quoted_sheet(reference.last_sheet) == reference.last_sheet) &&
        std::all_of(reference.workbook.begin(), reference.workbook.end(), is_digit);
    std::string name = reference.workbook.empty() ? "" : "[" + reference.workbook + "]";
    name += reference.sheet;
    if (!reference.last_sheet.empty()) {
        name += ":" + reference.last_sheet;
    }
    return (is_plain ? name : doubled(name, '\'')) + "!";
}

std::string a1_part(const ReferenceCorner& corner, bool row, bool column) {
    std::string text;
    if (column) {
        text += (corner.column_is_absolute ? "$" : "") + column_letters(corner.address.column);
    }
    if (row) {
        text += (corner.row_is_absolute ? "$" : "") + std::to_string(corner.address.row);
    }
    return text;
}

std::string relative_part(char letter, bool is_absolute, std::uint32_t place, std::uint32_t from) {
    if (is_absolute) {
        return letter + std::to_string(place);
    }
    const std::int64_t distance = static_cast<std::int64_t>(place) - static_cast<std::int64_t>(from);
    return distance == 0 ? std::string(1, letter) : letter + ("[" + std::to_string(distance) + "]");
}

std::string r1c1_part(const ReferenceCorner& corner, const CellAddress& at, bool row, bool column) {
    return (row ? relative_part('R', corner.row_is_absolute, corner.address.row, at.row) : "") +
           (column ? relative_part('C', corner.column_is_absolute, corner.address.column, at.column) : "");
}

/// \param at  nullptr for A1 style
std::string reference_text(const Reference& reference, const CellAddress* at) {
    const bool row = reference.shape != ReferenceShape::columns;
    const bool column = reference.shape != ReferenceShape::rows;
    const auto part = [&](const ReferenceCorner& corner) {
        return at == nullptr ? a1_part(corner, row, column) : r1c1_part(corner, *at, row, column);
    };
    std::string text = sheet_text(reference) + part(reference.first);
    if (reference.shape != ReferenceShape::cell) {
        text += ":" + part(reference.last);
    }
    return text;
}

class FormulaPrinter {
public:
    FormulaPrinter(const Formula& formula, const CellAddress* at) : formula_(formula), at_(at) {}

    std::string print() {
        if (!formula_.nodes.empty()) {
            print(formula_.root());
        }
        return std::move(out_);
    }

private:
    void print(std::uint32_t place) {
        const FormulaNode& node = formula_.nodes[place];
        const auto children = formula_.children_of(node);
        if (is_binary(node.kind)) {
            const int level = binding(node.kind);
            const bool is_reunion = node.kind == NodeKind::reunion;
            if (is_reunion) {
                out_ += '(';
            }
            print_operand(children[0], level);
            out_ += operator_text(node.kind);
            // All operators go from the left. Behind a colon, a plain name or cell would make one reference with what
            // stands before it.
            print_operand(children[1], node.kind == NodeKind::range ? k_always : level + 1);
            if (is_reunion) {
                out_ += ')';
            }
            return;
        }
        switch (node.kind) {
            case NodeKind::number:
                out_ += text::shortest(node.number);
                return;
            case NodeKind::text:
                out_ += doubled(node.text, '"');
                return;
            case NodeKind::boolean:
                out_ += node.number != 0.0 ? "TRUE" : "FALSE";
                return;
            case NodeKind::negate:
            case NodeKind::plus:
                out_ += operator_text(node.kind);
                print_operand(children[0], binding(node.kind));
                return;
            case NodeKind::percent:
                print_operand(children[0], binding(node.kind));
                out_ += '%';
                return;
            case NodeKind::reference:
                out_ += reference_text(formula_.references[node.reference], at_);
                return;
            case NodeKind::call:
                out_ += node.text + "(";
                print_list(children, 0);
                out_ += ')';
                return;
            case NodeKind::array:
                out_ += '{';
                print_list(children, node.columns);
                out_ += '}';
                return;
            default:  // names, errors, tables: as they are; nothing for an argument that is left out
                out_ += node.text;
        }
    }

    void print_operand(std::uint32_t place, int least) {
        const bool in_brackets = binding(formula_.nodes[place].kind) < least;
        if (in_brackets) {
            out_ += '(';
        }
        print(place);
        if (in_brackets) {
            out_ += ')';
        }
    }

    void print_list(std::span<const std::uint32_t> items, std::size_t columns) {
        for (std::size_t i = 0; i < items.size(); ++i) {
            if (i > 0) {
                out_ += columns != 0 && i % columns == 0 ? ';' : ',';
            }
            print(items[i]);
        }
    }

    const Formula& formula_;
    const CellAddress* at_;
    std::string out_;
};

std::uint32_t moved(std::uint32_t place, bool is_absolute, std::uint32_t from, std::uint32_t to, std::uint32_t most) {
    return is_absolute ? place : (place - 1 + most + to - from) % most + 1;
}

ReferenceCorner moved_corner(ReferenceCorner corner, const CellAddress& from, const CellAddress& to) {
    corner.address.row = moved(corner.address.row, corner.row_is_absolute, from.row, to.row, k_most_rows);
    corner.address.column =
        moved(corner.address.column, corner.column_is_absolute, from.column, to.column, k_most_columns);
    return corner;
}

}  // namespace

std::string print_formula(const Formula& formula) {
    return FormulaPrinter(formula, nullptr).print();
}

std::string r1c1_text(const Formula& formula, const CellAddress& at) {
    return FormulaPrinter(formula, &at).print();
}

std::string copied_formula(std::string_view text, const Formula& formula, const CellAddress& from,
                           const CellAddress& to) {
    std::string copied;
    std::size_t done = 0;
    for (const FormulaNode& node : formula.nodes) {  // references stand in the order of the text
        if (node.kind != NodeKind::reference) {
            continue;
        }
        Reference reference = formula.references[node.reference];
        reference.first = moved_corner(reference.first, from, to);
        reference.last = moved_corner(reference.last, from, to);
        copied += text.substr(done, node.offset - done);
        copied += reference_text(reference, nullptr);
        done = node.offset + node.length;
    }
    copied += text.substr(done);
    return copied;
}

std::vector<FormulaLiteral> literal_numbers(const Formula& formula) {
    std::vector<FormulaLiteral> literals;
    std::vector<std::pair<std::uint32_t, std::size_t>> parent(formula.nodes.size());
    for (std::uint32_t i = 0; i < formula.nodes.size(); ++i) {
        parent[i] = {i, 0};
        const auto children = formula.children_of(formula.nodes[i]);
        for (std::size_t k = 0; k < children.size(); ++k) {
            parent[children[k]] = {i, k};
        }
    }
    for (std::uint32_t i = 0; i < formula.nodes.size(); ++i) {
        const FormulaNode& node = formula.nodes[i];
        if (node.kind != NodeKind::number) {
            continue;
        }
        FormulaLiteral literal{.node = i, .number = node.number, .text = node.text};
        std::uint32_t outer = i;
        while (parent[outer].first != outer) {
            const NodeKind kind = formula.nodes[parent[outer].first].kind;
            if (kind != NodeKind::negate && kind != NodeKind::plus) {
                break;
            }
            outer = parent[outer].first;
            literal.number = kind == NodeKind::negate ? -literal.number : literal.number;
            literal.text.insert(0, operator_text(kind));
        }
        literal.parent = parent[outer].first;
        literal.argument = parent[outer].second;
        literals.push_back(std::move(literal));
    }
    return literals;
}

}  // namespace gumcert::workbook
