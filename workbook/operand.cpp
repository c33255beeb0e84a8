#include "workbook/operand.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "text/numbers.h"
#include "workbook/letters.h"

namespace gumcert::workbook {

namespace {

std::optional<double> plain_number(std::string_view text) {
    while (!text.empty() && text.front() == ' ') {
        text.remove_prefix(1);
    }
    while (!text.empty() && text.back() == ' ') {
        text.remove_suffix(1);
    }
    const bool begins_well = !text.empty() && (is_digit(text.front()) || text.front() == '-' || text.front() == '.');
    double number = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    return begins_well && failure == std::errc() && end == text.data() + text.size() && std::isfinite(number)
               ? std::optional(number)
               : std::nullopt;
}

/// Numbers before texts before truth values.
int rank(const Operand& value) {
    return value.kind == OperandKind::boolean ? 2 : value.kind == OperandKind::text ? 1 : 0;
}

}  // namespace

Operand Operand::of(double number) {
    if (!std::isfinite(number)) {
        return of(CellError::number);
    }
    Operand operand;
    operand.kind = OperandKind::number;
    operand.number = number;
    return operand;
}

Operand Operand::of(bool truth) {
    Operand operand;
    operand.kind = OperandKind::boolean;
    operand.number = truth ? 1.0 : 0.0;
    return operand;
}

Operand Operand::of(CellError error) {
    Operand operand;
    operand.kind = OperandKind::error;
    operand.error = error;
    return operand;
}

Operand Operand::of(std::string text) {
    Operand operand;
    operand.kind = OperandKind::text;
    operand.text = std::move(text);
    return operand;
}

Operand Operand::of(const Area& area) {
    Operand operand;
    operand.kind = OperandKind::area;
    operand.area = area;
    return operand;
}

const Operand& OperandArray::at(std::size_t row, std::size_t column) const {
    static const Operand k_blank;
    return row < stored_rows && column < stored_columns ? items[row * stored_columns + column] : k_blank;
}

Operand as_number(const Operand& value, CellReader& reader) {
    switch (value.kind) {
        case OperandKind::number:
            return value;
        case OperandKind::boolean:
            return Operand::of(value.number);
        case OperandKind::blank:
        case OperandKind::missing:
            return Operand::of(0.0);
        case OperandKind::text:
            if (const std::optional<double> number = plain_number(value.text)) {
                return Operand::of(*number);
            }
            if (std::any_of(value.text.begin(), value.text.end(), is_digit)) {
                return reader.not_evaluated("a text in place of a number");
            }
            return Operand::of(CellError::value);
        default:
            return value.stops() ? value : Operand::of(CellError::value);
    }
}

Operand as_truth(const Operand& value, CellReader& reader) {
    if (value.kind == OperandKind::text) {
        const std::string folded = folded_text(value.text);
        return folded == "TRUE" || folded == "FALSE" ? Operand::of(folded == "TRUE") : Operand::of(CellError::value);
    }
    const Operand number = as_number(value, reader);
    return number.is_number() ? Operand::of(number.number != 0.0) : number;
}

Operand as_text(const Operand& value, CellReader& reader) {
    switch (value.kind) {
        case OperandKind::text:
            return value;
        case OperandKind::boolean:
            return Operand::of(std::string(value.number != 0.0 ? "TRUE" : "FALSE"));
        case OperandKind::blank:
        case OperandKind::missing:
            return Operand::of(std::string());
        case OperandKind::number: {
            const double size = std::abs(value.number);
            if (size != 0.0 && (size < 1e-4 || size >= 1e15)) {
                return reader.not_evaluated("a number as text");
            }
            return Operand::of(text::significant(value.number, 15));
        }
        default:
            return value.stops() ? value : Operand::of(CellError::value);
    }
}

Operand power_of(double x, double y) {
    if (x == 0.0 && y == 0.0) {
        return Operand::of(CellError::number);
    }
    return x == 0.0 && y < 0.0 ? Operand::of(CellError::division_by_zero) : Operand::of(std::pow(x, y));
}

int compared(const Operand& a, const Operand& b) {
    const bool a_is_blank = a.kind == OperandKind::blank || a.kind == OperandKind::missing;
    const bool b_is_blank = b.kind == OperandKind::blank || b.kind == OperandKind::missing;
    if (a_is_blank && b_is_blank) {
        return 0;
    }
    const int a_rank = a_is_blank ? rank(b) : rank(a);
    const int b_rank = b_is_blank ? rank(a) : rank(b);
    if (a_rank != b_rank) {
        return a_rank < b_rank ? -1 : 1;
    }
    if (a_rank == 1) {
        const int order = folded_text(a.text).compare(folded_text(b.text));
        return order < 0 ? -1 : order > 0 ? 1 : 0;
    }
    return a.number < b.number ? -1 : a.number > b.number ? 1 : 0;
}

bool only_rounding_decides(const Operand& a, const Operand& b) {
    return a.is_number() && b.is_number() && a.number != b.number &&
           std::abs(a.number - b.number) <= 1e-14 * std::max(std::abs(a.number), std::abs(b.number));
}

}  // namespace gumcert::workbook
