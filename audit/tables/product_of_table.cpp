#include "audit/tables/product_of_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "audit/claims.h"
#include "audit/row_facts.h"
#include "audit/tables/product_of_rows.h"
#include "audit/words/column_heads.h"
#include "audit/words/coverage_words.h"
#include "audit/words/named_statement.h"
#include "audit/words/unit_words.h"
#include "text/numbers.h"

namespace gumcert::audit {
namespace {

class ProductOfTable {
public:
    ProductOfTable(TableSoFar& table, std::vector<Sentence>& not_read) : table_(table), not_read_(not_read) {}

    [[nodiscard]] std::optional<ProductOfRows> take_product() {
        std::vector<AuditedRow>& rows = table_.budget.rows;
        const auto headed = [this](Column column) { return table_.heads->columns.contains(column); };
        if (table_.is_open || rows.empty() || headed(Column::sensitivity) || headed(Column::contribution) ||
            !headed(Column::u)) {
            return std::nullopt;
        }
        std::vector<Factor> factors;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::string &of_u = table_.units[i].u, &of_value = table_.units[i].estimate;
            if (!rows[i].estimate || !rows[i].u || is_part_beside(of_u, of_value) || !factor_between(of_u, of_value)) {
                return std::nullopt;
            }
            factors.push_back(factor_of(*rows[i].estimate, of_value));
        }
        if (const auto value = table_.statements.numbers.find(Statement::value);
            value != table_.statements.numbers.end()) {
            return product_of_rows(factors, factor_of(value->second.number, table_.sums().unit_of(value->second)));
        }
        if (rows.back().stated || rows.back().divisor || table_.statements.numbers.contains(Statement::u_c)) {
            return std::nullopt;
        }
        const Factor last = factors.back();
        factors.pop_back();
        std::optional<ProductOfRows> product = product_of_rows(factors, last);
        const StatedResult u{.number = *rows.back().u, .unit = table_.units.back().u},
            value{.number = *rows.back().estimate, .unit = table_.units.back().estimate};
        if (!product || product->has_equal_factors || !is_u_c_of_stated_U(u)) {
            return std::nullopt;
        }
        const std::optional<Interval> sum = table_.sums().sum_above(u);
        const bool is_sum = sum && table_.sums().gives_statements(*sum, &u).value_or(false);
        rows.pop_back();
        table_.units.pop_back();
        table_.statements.numbers.emplace(Statement::value, value);
        table_.statements.numbers.emplace(Statement::u_c, u);
        if (is_sum && !is_u_c_of_product(u)) {
            leave_product();  // the last row may be one of a sum as well
        }
        return product;
    }
    void settle_product() {
        const std::optional<StatedNumber>& value = table_.budget.claims.value;
        if (!table_.product || table_.is_told || table_.is_unusable) {
            table_.product.reset();
            return;
        }
        if (!value) {  // it is in another unit than what the rows are held against, as U in %
            leave_product();
            return;
        }
        const std::vector<AuditedRow> as_they_stand = table_.budget.rows;
        const auto take = [&](const std::vector<double>& exponents) {
            for (std::size_t i = 0; i < exponents.size(); ++i) {
                const AuditedRow& row = as_they_stand[i];
                table_.budget.rows[i] =
                    with_coefficient(row, exponents[i] * value->value / row.estimate->value, *value);
            }
        };
        // u that are parts of the values, or percentages, that a head does not call so.
        const auto may_be_relative = [&](double unit_of_part) {
            for (std::size_t i = 0; i < as_they_stand.size(); ++i) {
                table_.budget.rows[i] = with_coefficient(as_they_stand[i], unit_of_part * value->value, *value);
            }
            return table_.follows_from_rows();
        };
        const bool is_stated = table_.budget.claims.u_c || table_.budget.claims.U;
        const bool states_other = table_.statements.numbers.contains(Statement::u_c) ||
                                  table_.statements.numbers.contains(Statement::U) || !table_.statements.parts.empty();
        const bool is_correlated = !table_.correlation_lines.empty() || table_.covariance_line != nullptr;
        const bool is_a_sum = table_.follows_from_rows();
        take(table_.product->choices.front());
        const bool follows = table_.follows_from_rows();
        if (is_a_sum && !follows) {
            table_.budget.rows = as_they_stand;
            table_.product.reset();
            return;
        }
        const bool is_one = table_.product->choices.size() == 1 && table_.product->has_all_choices;
        bool is_open = (!is_stated && states_other) || (is_correlated && !is_one) ||
                       (has_U_of_open_part() && check_claims(table_.budget).U_outside);
        if (is_stated && !follows && !is_open) {
            is_open = table_.product->has_equal_factors || !table_.product->has_all_choices || may_be_relative(1.0) ||
                      may_be_relative(0.01) ||
                      std::any_of(table_.product->choices.begin() + 1, table_.product->choices.end(),
                                  [&](const auto& choice) {
                                      take(choice);
                                      return table_.follows_from_rows();
                                  });
            take(table_.product->choices.front());
        }
        if (is_open) {
            leave_product();
            return;
        }
        not_read_.push_back(
            say("{table}: the rows have no coefficients, and their values make up that of the result as a product or "
                "quotient; c = y/x is taken for each",
                table_.budget.place));
    }
    /// Whether U is stated and is k times a number, whatever the rows give.
    [[nodiscard]] bool is_u_c_of_stated_U(const StatedResult& amount) {
        const auto U = table_.statements.numbers.find(Statement::U);
        if (U == table_.statements.numbers.end()) {
            return false;
        }
        const std::optional<StatedNumber> stated = table_.sums().stated(Statement::k);
        const CoverageText said = coverage_in(table_.statements.coverage);
        const std::optional<LeadingNumber> in_words =
            said.k.empty() ? std::nullopt : read_leading_number(said.k, "", Percent::unit);
        const double k = stated ? stated->value : in_words ? in_words->number.value : 0.0;
        const std::optional<double> factor =
            factor_between(table_.sums().unit_of(U->second), table_.sums().unit_of(amount));
        return k > 1.0 && factor && as_rounded(U->second.number, k / *factor).meets(as_rounded(amount.number, 1.0));
    }
    /// Whether a number is u_c of the rows with c = y/x, within the digits of all.
    [[nodiscard]] bool is_u_c_of_product(const StatedResult& amount) {
        const StatedResult& result = table_.statements.numbers.at(Statement::value);
        const std::string unit = table_.sums().unit_of(amount);
        const double to_value = unit.empty() ? 1.0 : factor_between(unit, table_.sums().unit_of(result)).value_or(0.0);
        if (to_value == 0.0) {
            return false;
        }
        AuditedBudget product;
        product.claims.u_c = amount.number;
        for (std::size_t i = 0; i < table_.budget.rows.size(); ++i) {
            const double factor = factor_between(table_.units[i].u, table_.units[i].estimate).value_or(0.0);
            const double c = result.number.value / table_.budget.rows[i].estimate->value * factor / to_value;
            product.rows.push_back(with_coefficient(table_.budget.rows[i], c, result.number));
        }
        const ClaimCheck check = check_u_c(product);
        return check.allowed && !check.u_c_outside;
    }

private:
    /// The value of a row, or of the line of a result, as a factor; the unit is that of its cell or head, else of the row.
    [[nodiscard]] static Factor factor_of(const StatedNumber& number, const std::string& unit) {
        return {.value = number.value, .relative_half_step = relative_half_step(number), .unit = unit};
    }
    [[nodiscard]] static double relative_half_step(const StatedNumber& number) {
        return number.value != 0.0 ? std::abs(number.half_step / number.value) : 0.0;
    }
    void leave_product() {
        table_.is_told = true;
        not_read_.push_back(
            say("{table}: the table is not looked at; the values of its rows make up that of the result as a product "
                "or quotient, and nothing shows with which coefficients; what are they?",
                table_.budget.place));
    }
    /// A row with a coefficient as the value of the result and its own one leave it open.
    [[nodiscard]] static AuditedRow with_coefficient(AuditedRow row, double c, const StatedNumber& value) {
        row.sensitivity = exact_number(c, row.place);
        row.sensitivity->half_step = std::abs(c) * (relative_half_step(value) + relative_half_step(*row.estimate));
        complete_row(row);
        return row;
    }
    /// Whether U is a part beside a value that is one as well: 3.1 % of 667 mg/kg, or of what 667 mg/kg are of.
    [[nodiscard]] bool has_U_of_open_part() {
        const auto U = table_.statements.numbers.find(Statement::U),
                   value = table_.statements.numbers.find(Statement::value);
        if (U == table_.statements.numbers.end() || value == table_.statements.numbers.end()) {
            return false;
        }
        const std::string of_U = table_.sums().unit_of(U->second), of_value = table_.sums().unit_of(value->second);
        return is_unit_of_part(of_U) && of_U != of_value && factor_between(of_U, of_value);
    }

    TableSoFar& table_;
    std::vector<Sentence>& not_read_;
};

}  // namespace

void take_product(TableSoFar& table, std::vector<Sentence>& not_read) {
    table.product = ProductOfTable(table, not_read).take_product();
}

void settle_product(TableSoFar& table, std::vector<Sentence>& not_read) {
    ProductOfTable(table, not_read).settle_product();
}

bool is_u_c_beside_product(TableSoFar& table, const StatedResult& amount) {
    std::vector<Sentence> unused;
    ProductOfTable product(table, unused);
    return product.is_u_c_of_stated_U(amount) || product.is_u_c_of_product(amount);
}

}  // namespace gumcert::audit
