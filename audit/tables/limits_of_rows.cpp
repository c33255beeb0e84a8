#include "audit/tables/limits_of_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "audit/row_meaning.h"
#include "audit/words/column_heads.h"
#include "audit/words/unit_words.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;

std::string unit_beside(const SheetView& sheet, const Heads& heads, const SheetView::Row& row,
                        const std::string& of_cell, const std::string& of_head) {
    const auto units = heads.columns.find(Column::unit);
    const Cell* of_row = units == heads.columns.end() ? nullptr : cell_in(row, units->second);
    return !of_cell.empty() ? of_cell : !of_head.empty() ? of_head : of_row != nullptr ? sheet.words(*of_row) : "";
}

/// What u of a row says of its limits.
enum class Fit {
    none,      ///< u was not made of them
    slip,      ///< by a divisor that is not that of the distribution, and that people use
    right,     ///< by that of the distribution, in too few digits to prove it
    is_proof,  ///< in three digits
};

std::optional<double> divisor_in(const SheetView& sheet, const Heads& heads, const SheetView::Row& row) {
    for (const Column column : {Column::distribution, Column::type}) {
        const auto at = heads.columns.find(column);
        const Cell* cell = at == heads.columns.end() ? nullptr : cell_in(row, at->second);
        if (cell != nullptr && !says_nothing(sheet.words(*cell))) {
            if (const std::optional<double> divisor = divisor_of_shape(shape_of(sheet.words(*cell)))) {
                return divisor;
            }
        }
    }
    return std::nullopt;
}

Fit fit_of(const SheetView& sheet, const Heads& heads, const SheetView::Row& row) {
    const std::optional<NumberWithUnit> half = half_width_of_limits(sheet, heads, row);
    const std::optional<double> divisor = divisor_in(sheet, heads, row);
    const Cell* cell = cell_in(row, heads.columns.at(Column::u));
    const std::optional<NumberWithUnit> u = cell == nullptr ? std::nullopt : sheet.number_with_unit(*cell);
    if (!half || !divisor || !u || u->is_open || !(u->number.value > 0.0)) {
        return Fit::none;
    }
    const std::optional<double> factor =
        factor_between(unit_beside(sheet, heads, row, half->unit, heads.units.at(Column::stated)),
                       unit_beside(sheet, heads, row, u->unit, heads.units.at(Column::u)));
    if (!factor) {
        return Fit::none;
    }
    constexpr double k_of_root = 0.003;  // √3 as 1.73
    const double size = u->number.value, open_of_u = printed_half_step(u->number);
    const auto is_over = [&](double by) {
        const double expected = half->number.value * *factor / by;
        const double open = open_of_u + half->number.half_step * *factor / by + k_of_root * expected;
        return std::abs(size - expected) <= open;
    };
    constexpr double k_proof = 0.01, k_least = 0.06;  // relative: three digits, and two
    if (is_over(*divisor)) {
        return open_of_u <= k_proof * size ? Fit::is_proof : Fit::right;
    }
    // Not divided, divided as the whole width, by the number in place of its root, or as another distribution.
    const std::array<double, 6> slips = {1.0, *divisor / 2.0, 2.0, 3.0, std::sqrt(3.0), std::sqrt(6.0)};
    return open_of_u <= k_least * size && std::any_of(slips.begin(), slips.end(), is_over) ? Fit::slip : Fit::none;
}

/// Whether u of the rows below heads shows that their limits are those of what is divided.
bool are_divided(const SheetView& sheet, const SheetView::Row& row, const Heads& heads) {
    constexpr std::size_t k_most = 2'000;  // rows
    std::uint32_t last = 0;
    for (const Cell* cell : row) {
        last = std::max(last, cell->address.row);
    }
    std::size_t proofs = 0, right = 0, slips = 0, looked = 0;
    for (auto at = sheet.rows().upper_bound(last); at != sheet.rows().end() && looked < k_most; ++at, ++looked) {
        if (at->first > last + 2) {
            break;  // two empty lines
        }
        last = at->first;
        const std::array<const Cell*, 2> cells = {cell_in(at->second, heads.limits->first),
                                                  cell_in(at->second, heads.limits->second)};
        const auto is_head = [&sheet](const Cell* cell) {
            return cell != nullptr && limit_head(sheet.words(*cell)).has_value();
        };
        if (std::any_of(cells.begin(), cells.end(), is_head)) {
            break;  // of the next table
        }
        if (std::all_of(cells.begin(), cells.end(),
                        [&sheet](const Cell* cell) { return cell == nullptr || says_nothing(sheet.words(*cell)); })) {
            continue;
        }
        const Fit fit = fit_of(sheet, heads, at->second);
        if (fit == Fit::none) {
            return false;
        }
        proofs += fit == Fit::is_proof ? 1U : 0U;
        right += fit == Fit::right ? 1U : 0U;
        slips += fit == Fit::slip ? 1U : 0U;
    }
    constexpr std::size_t k_least_right = 2;  // of two digits
    return (proofs > 0 || right >= k_least_right) && slips <= proofs + right / k_least_right;
}

/// Whether a table may have limits: nothing else is divided, and its u stand in one column beside their distributions.
bool may_have_limits(const Heads& heads) {
    const auto has = [&heads](Column column) { return heads.columns.contains(column); };
    return !has(Column::stated) && !has(Column::divisor) && has(Column::u) &&
           (has(Column::distribution) || has(Column::type)) && !heads.unit_columns.contains(Column::u) &&
           !heads.type_b.contains(Column::u);
}

/// Whether two numbers of one of the rows below heads are not of one size.
bool differ_in_size(const SheetView& sheet, const SheetView::Row& row,
                    const std::pair<std::uint32_t, std::uint32_t>& columns) {
    std::uint32_t last = 0;
    for (const Cell* cell : row) {
        last = std::max(last, cell->address.row);
    }
    for (auto at = sheet.rows().upper_bound(last); at != sheet.rows().end() && at->first <= last + 2; ++at) {
        last = at->first;
        const Cell *one = cell_in(at->second, columns.first), *other = cell_in(at->second, columns.second);
        const std::optional<NumberWithUnit> a = one == nullptr ? std::nullopt : sheet.number_with_unit(*one),
                                            b = other == nullptr ? std::nullopt : sheet.number_with_unit(*other);
        if (a && b &&
            std::abs(std::abs(a->number.value) - std::abs(b->number.value)) >
                a->number.half_step + b->number.half_step) {
            return true;
        }
    }
    return false;
}

}  // namespace

std::optional<NumberWithUnit> half_width_of_limits(const SheetView& sheet, const Heads& heads,
                                                   const SheetView::Row& row) {
    if (!heads.limits) {
        return std::nullopt;
    }
    const auto number = [&](std::uint32_t column) -> std::optional<NumberWithUnit> {
        const Cell* cell = cell_in(row, column);
        const std::optional<NumberWithUnit> read = cell == nullptr ? std::nullopt : sheet.number_with_unit(*cell);
        return read && !read->is_open ? std::optional(sheet.as_shown(*read, *cell)) : std::nullopt;
    };
    const std::optional<NumberWithUnit> lower = number(heads.limits->first), upper = number(heads.limits->second);
    if (!lower || !upper || lower->unit != upper->unit || !(upper->number.value > lower->number.value)) {
        return std::nullopt;
    }
    constexpr double k_arithmetic = 1e-9;
    const double low = lower->number.value, high = upper->number.value, middle = 0.5 * (low + high);
    double open = 0.5 * (lower->number.half_step + upper->number.half_step) +
                  k_arithmetic * std::max(std::abs(low), std::abs(high));
    const auto estimates = heads.columns.find(Column::estimate);
    const std::optional<NumberWithUnit> estimate =
        estimates == heads.columns.end() ? std::nullopt : number(estimates->second);
    const bool are_about = std::abs(middle) <= open || !estimate ||
                           std::abs(middle - estimate->number.value) <= open + estimate->number.half_step;
    if (!are_about) {
        return std::nullopt;
    }
    NumberWithUnit half{
        .number = exact_number(0.5 * (high - low), sheet.place(cell_in(row, heads.limits->second)->address)),
        .unit = upper->unit};
    half.number.half_step = open;
    return half;
}

void take_limits(const SheetView& sheet, const SheetView::Row& row, Heads& heads) {
    std::vector<const Cell*> lower, upper;
    for (const Cell* cell : row) {
        if (const std::optional<LimitHead> limit =
                sheet.head(*cell).is_text ? limit_head(sheet.words(*cell)) : std::nullopt) {
            (*limit == LimitHead::lower ? lower : upper).push_back(cell);
        }
    }
    if (lower.size() != 1 || upper.size() != 1) {
        return;
    }
    const std::pair limits(lower.front()->address.column, upper.front()->address.column);
    // "a-" alone is the head of half-widths, and stays it where the two are not taken.
    Heads taken = heads;
    const auto stated = heads.columns.find(Column::stated);
    const bool is_half_width =
        stated != heads.columns.end() && (stated->second == limits.first || stated->second == limits.second);
    if (is_half_width) {
        taken.columns.erase(Column::stated);
        taken.units.erase(Column::stated);
    }
    if (may_have_limits(taken) &&
        unit_in_head(sheet.words(*lower.front())) == unit_in_head(sheet.words(*upper.front()))) {
        taken.limits = limits;
        taken.units[Column::stated] = unit_in_head(sheet.words(*upper.front()));
        if (are_divided(sheet, row, taken)) {
            for (const Cell* cell : {lower.front(), upper.front()}) {
                std::erase(taken.unknown, cell);
                std::erase(taken.second, cell);
            }
            heads = std::move(taken);
            return;
        }
    }
    // Neither of two that differ in size is a half-width.
    if (is_half_width && differ_in_size(sheet, row, limits)) {
        heads.columns.erase(Column::stated);
        heads.units.erase(Column::stated);
        for (const Cell* cell : {lower.front(), upper.front()}) {
            std::erase(heads.second, cell);
            std::erase(heads.unknown, cell);
            heads.unknown.push_back(cell);
        }
    }
}

}  // namespace gumcert::audit
