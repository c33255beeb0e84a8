#include "audit/tables/table_sums.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "audit/stated_number.h"
#include "audit/words/column_heads.h"
#include "audit/words/coverage_words.h"
#include "audit/words/named_statement.h"

namespace gumcert::audit {

void settle_words(AuditedRow& row) {
    row.contributor = contributor_of(name_in_words(row), row.comment, row.source);
    read_comment(row);
    complete_row(row);
}

Interval as_rounded(const StatedNumber& number, double k) {
    constexpr double k_of_digits = 1e-3;
    const double half = 2.0 * printed_half_step(number) + k_of_digits * std::abs(number.value);
    return {(std::abs(number.value) - half) / k, (std::abs(number.value) + half) / k};
}

std::uint32_t TableSums::column_of(Column column) const {
    const auto found = heads.columns.find(column);
    return found == heads.columns.end() ? 0 : found->second;
}

std::string TableSums::unit_of(const StatedResult& of) const {
    const auto head = heads.all_units.find(of.column);
    return of.unit.empty() && head != heads.all_units.end() ? head->second : of.unit;
}

std::optional<Interval> TableSums::sum_above(const StatedResult& of, bool without_last) const {
    return sum_of_first(of, rows.size() - (without_last ? 1U : 0U));
}

std::optional<Interval> TableSums::sum_of_first(const StatedResult& of, std::size_t count) const {
    std::vector<std::size_t> first(count);
    std::iota(first.begin(), first.end(), std::size_t{0});
    return sum_of(of, first);
}

std::optional<Interval> TableSums::sum_of(const StatedResult& of, const std::vector<std::size_t>& which) const {
    const std::string unit = unit_of(of);
    std::vector<AuditedRow> added;
    std::vector<RowUnits> added_units;
    for (const std::size_t row : which) {
        added.push_back(rows[row]);
        added_units.push_back(units[row]);
    }
    std::vector<Sentence> unused;
    if (added.empty() || !settle_units(added, added_units, unit, unused)) {
        return std::nullopt;
    }
    double low = 0.0, high = 0.0;
    for (AuditedRow& row : added) {
        settle_words(row);
        const double c = std::abs(row.used_sensitivity);
        const double least = std::max(0.0, c - row.sensitivity_half_step) * std::max(0.0, row.used_u - row.u_half_step);
        const double most = (c + row.sensitivity_half_step) * (row.used_u + row.u_half_step);
        low += least * least;
        high += most * most;
    }
    return Interval{std::sqrt(low), std::sqrt(high)};
}

void TableSums::state(Statement statement, std::optional<StatedResult> result) {
    if (result) {
        statements.numbers.emplace(statement, std::move(*result));
    }
}

std::optional<StatedNumber> TableSums::stated(Statement statement) const {
    const auto found = statements.numbers.find(statement);
    return found == statements.numbers.end() ? std::nullopt : std::optional(found->second.number);
}

std::optional<StatedResult> TableSums::stated_of_sum() const {
    for (const Statement statement : {Statement::u_c, Statement::U}) {
        if (const auto found = statements.numbers.find(statement); found != statements.numbers.end()) {
            return found->second;
        }
    }
    return std::nullopt;
}

std::optional<bool> TableSums::gives_statements(const Interval& sum, const StatedResult* of) const {
    const auto is_given = [&](Statement statement, double k) {
        const StatedResult& stated = statements.numbers.at(statement);
        const double factor = of == nullptr ? 1.0 : factor_between(unit_of(*of), unit_of(stated)).value_or(1.0);
        return as_rounded(stated.number, k).meets({factor * sum.low, factor * sum.high});
    };
    if (stated(Statement::u_c)) {
        return is_given(Statement::u_c, 1.0);
    }
    const std::optional<StatedNumber> of_line = stated(Statement::k);
    const std::optional<LeadingNumber> of_words =
        read_leading_number(coverage_in(statements.coverage).k, "", Percent::unit);
    const double k = of_line ? of_line->value : of_words ? of_words->number.value : 0.0;
    if (stated(Statement::U) && k > 0.0) {
        return is_given(Statement::U, k);
    }
    return std::nullopt;
}

bool TableSums::is_stated_u_c(const StatedResult& of) const {
    const auto is = [&](Statement statement, double k) {
        const auto found = statements.numbers.find(statement);
        const std::optional<double> factor =
            found == statements.numbers.end() ? std::nullopt : factor_between(of.unit, found->second.unit);
        if (!factor || !(k > 0.0)) {
            return false;
        }
        const StatedNumber& number = found->second.number;
        const double size = std::abs(number.value) / k;
        const double half = printed_half_step(number) / k + *factor * printed_half_step(of.number) + 1e-6 * size;
        return std::abs(size - *factor * std::abs(of.number.value)) <= half;
    };
    const std::optional<StatedNumber> k = stated(Statement::k);
    return is(Statement::u_c, 1.0) || (k && (is(Statement::U, k->value) || is(Statement::reported_U, k->value)));
}

StatedResult TableSums::amount_of(std::size_t row) const {
    const AuditedRow& of = rows[row];
    const bool by_u = !of.contribution;
    const Column column = by_u ? Column::u : Column::contribution;
    return {.number = by_u ? *of.u : *of.contribution,
            .unit = by_u ? units[row].u : units[row].contribution,
            .column = column_of(column)};
}

double TableSums::k_to(const StatedResult& amount, const std::string& name, const Interval& sum) const {
    const std::string_view in_name = coverage_in(name).k;
    const std::optional<LeadingNumber> named =
        in_name.empty() ? std::nullopt : read_leading_number(in_name, "", Percent::unit);
    for (const std::optional<StatedNumber>& k :
         {named ? std::optional(named->number) : std::nullopt, stated(Statement::k)}) {
        if (k && k->value > 1.0 && as_rounded(amount.number, k->value).meets(sum)) {
            return k->value;
        }
    }
    return 0.0;
}

}  // namespace gumcert::audit
