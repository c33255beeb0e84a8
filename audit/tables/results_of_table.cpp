#include "audit/tables/results_of_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "audit/claims.h"
#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "audit/tables/claims_of_table.h"
#include "audit/tables/parts_of_value.h"
#include "audit/tables/product_of_table.h"
#include "audit/tables/result_lines.h"
#include "audit/tables/row_units.h"
#include "audit/tables/stated_results.h"
#include "audit/tables/table_sums.h"
#include "audit/words/certificate_in.h"
#include "audit/words/column_heads.h"
#include "audit/words/coverage_words.h"
#include "audit/words/named_statement.h"
#include "audit/words/unit_words.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

class StatementsOfTable {
public:
    StatementsOfTable(TableSoFar& table, std::vector<Sentence>& not_read) : table_(table), not_read_(not_read) {}

    /// A row of which no uncertainty was read is missing, unless the others make up what is stated.
    void settle_lost_row() {
        if (!table_.lost_a_row || table_.budget.rows.empty()) {
            return;
        }
        const std::optional<StatedResult> of = table_.sums().stated_of_sum();
        const std::optional<Interval> sum = of ? table_.sums().sum_above(*of) : std::nullopt;
        table_.is_unusable = table_.is_unusable || !sum || !table_.sums().gives_statements(*sum).value_or(false);
    }
    void settle_statements() {
        std::string of_contributions = table_.heads->units[Column::contribution];
        for (const RowUnits& units : table_.units) {
            of_contributions = of_contributions.empty() ? units.contribution : of_contributions;
        }
        for (auto& [statement, result] : table_.statements.numbers) {
            const auto of_head = table_.heads->all_units.find(result.column);
            if (result.unit.empty() && is_of_result(statement) && of_head != table_.heads->all_units.end()) {
                result.unit = of_head->second;
            }
        }
        settle_parts_of_value(of_contributions);
        settle_k_of_product();
        const bool has_no_units = std::all_of(table_.units.begin(), table_.units.end(), [](const RowUnits& units) {
            return units.stated.empty() && units.u.empty() && units.contribution.empty() && units.sensitivity.empty();
        });
        state_claims(table_.budget, table_.statements, of_contributions,
                     has_no_units ? table_.unit_in_words : unit_of_rows(), not_read_);
        table_.have_coefficients = std::any_of(table_.budget.rows.begin(), table_.budget.rows.end(),
                                               [](const AuditedRow& row) { return row.sensitivity.has_value(); });
        table_.is_unusable =
            !settle_units(table_.budget.rows, table_.units, table_.budget.unit, not_read_) || table_.is_unusable;
        for (AuditedRow& row : table_.budget.rows) {
            settle_words(row);
            ask_for_divisor(row);
            if (row.open_expansion && !row.origin_value && row.origin == Origin::certificate) {
                not_read_.push_back(
                    say("{cell}: the words of {text} state U of a certificate, and its size does not follow from them; "
                        "what it was divided by is not checked; how large is U?",
                        row.place, text::in_quotes(row.quantity)));
            }
            note_row_facts(row);
            if (row.source.empty() && row.origin == Origin::certificate) {
                row.source = certificate_in(row.comment);
            }
        }
        take_conversions();
    }

private:
    /// Of "U = k·u_c = 2.65·2" either number may be k: the other one is u_c of the rows.
    void settle_k_of_product() {
        std::string& coverage = table_.statements.coverage;
        constexpr std::string_view k_begin = "k = ";
        const auto U = table_.statements.numbers.find(Statement::U);
        const std::string other = std::exchange(table_.statements.other_k, {});
        if (other.empty() || table_.product || table_.budget.rows.empty() || !coverage.starts_with(k_begin) ||
            U == table_.statements.numbers.end()) {
            return;
        }
        const std::size_t end = coverage.find_first_not_of("0123456789.,", k_begin.size());
        const std::string k = coverage.substr(k_begin.size(), end - k_begin.size());
        const std::optional<Interval> sum = table_.sums().sum_above(U->second);
        const auto is_u_c = [&sum](const std::string& text) {
            const std::optional<LeadingNumber> number = read_leading_number(text, "", Percent::unit);
            return number && as_rounded(number->number, 1.0).meets(*sum);
        };
        if (sum && is_u_c(k) && !is_u_c(other)) {
            coverage.replace(k_begin.size(), k.size(), other);
        }
    }

    /// Rows in mm, µm and nm, without coefficients, were converted before they were added where what is stated follows from them in
    /// one unit.
    void take_conversions() {
        std::vector<AuditedRow>& rows = table_.budget.rows;
        const bool is_stated = table_.budget.claims.u_c || table_.budget.claims.U;
        std::vector<double> factors;
        for (const AuditedRow& row : rows) {
            const std::optional<double> factor = factor_between(row.unit, table_.budget.unit);
            if (!is_stated || table_.have_coefficients || row.contribution || row.unit.empty() || !factor) {
                return;
            }
            factors.push_back(*factor);
        }
        if (std::all_of(factors.begin(), factors.end(), [](double factor) { return factor == 1.0; })) {
            return;
        }
        const std::vector<AuditedRow> as_they_stand = rows;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i].sensitivity = exact_number(factors[i], rows[i].place);
            complete_row(rows[i]);
        }
        if (!table_.follows_from_rows()) {
            rows = as_they_stand;
        }
    }

    /// Rows that are parts of the value, "w (%)", make up its relative u_c and U: those are what the rows are held against, whatever
    /// stands beside them in the unit of the value.
    void settle_parts_of_value(const std::string& of_contributions) {
        const bool are_parts = std::all_of(table_.budget.rows.begin(), table_.budget.rows.end(),
                                           [](const AuditedRow& row) { return is_unit_of_part(row.unit); });
        const bool are_added = std::all_of(
            table_.budget.rows.begin(), table_.budget.rows.end(),
            [](const AuditedRow& row) { return !row.sensitivity || std::abs(row.sensitivity->value) == 1.0; });
        const bool have_units_of_coefficients = std::any_of(
            table_.units.begin(), table_.units.end(),
            [](const RowUnits& units) { return !says_nothing(units.sensitivity) && units.sensitivity != "1"; });
        const bool is_sum_of_parts = is_unit_of_part(of_contributions) || (of_contributions.empty() && are_added);
        if (table_.budget.rows.empty() || !are_parts || have_units_of_coefficients || !is_sum_of_parts) {
            return;
        }
        // Without a value that has parts, and with nothing that says that the sum is one, a unit of another kind is a contradiction.
        const auto value = table_.statements.numbers.find(Statement::value);
        const bool has_value =
            value != table_.statements.numbers.end() && has_parts(value->second.number, value->second.unit);
        bool is_said = is_unit_of_part(of_contributions);
        for (const Statement statement : {Statement::u_c, Statement::U, Statement::reported_U}) {
            const auto number = table_.statements.numbers.find(statement);
            is_said = is_said || table_.statements.parts.contains(statement) ||
                      (number != table_.statements.numbers.end() && is_unit_of_part(number->second.unit));
        }
        if (!has_value && !is_said) {
            return;
        }
        table_.statements.unit_of_parts = of_contributions.empty() ? table_.budget.rows.front().unit : of_contributions;
        for (const Statement statement : {Statement::u_c, Statement::U, Statement::reported_U}) {
            const auto number = table_.statements.numbers.find(statement),
                       part = table_.statements.parts.find(statement);
            if (number != table_.statements.numbers.end() && part != table_.statements.parts.end()) {
                std::swap(number->second, part->second);
            }
        }
    }

    /// What is divided by a number that nobody knows has no u: neither a divisor is stated, nor a distribution that has one.
    void ask_for_divisor(const AuditedRow& row) {
        const bool is_open = row.stated && !row.divisor && !row.u && !row.contribution && !row.certificate_k;
        const bool is_expanded = row.shape == Shape::normal && coverage_in(row.shape_text).p;  // "normal (95 %)"
        const bool has_no_divisor = row.shape == Shape::other || row.shape == Shape::trapezoidal || is_expanded;
        if (is_open && has_no_divisor && table_.heads->columns.contains(Column::distribution)) {
            table_.is_told = true;
            not_read_.push_back(
                say("{cell}: no divisor is stated, and {text} is no distribution that has one; the table is not looked "
                    "at; what is the number divided by?",
                    row.place, text::in_quotes(row.shape_text)));
        }
    }
    /// The unit that all rows state which are added as they are: what is added up has one unit, and the result has it. "1" where all
    /// are of dimension one, whatever their coefficients.
    [[nodiscard]] std::string unit_of_rows() const {
        const auto is_one = [](const std::string& unit) { return unit == "1" || unit == "-" || unit == "–"; };
        if (!table_.budget.rows.empty() && std::all_of(table_.budget.rows.begin(), table_.budget.rows.end(),
                                                       [&is_one](const AuditedRow& row) { return is_one(row.unit); })) {
            return "1";
        }
        std::optional<std::string> shared;
        std::size_t as_they_are = 0;
        for (const AuditedRow& row : table_.budget.rows) {
            const bool as_it_is = !row.sensitivity || std::abs(row.sensitivity->value) == 1.0;
            const std::string unit = is_one(row.unit) ? "1" : row.unit;
            if (as_it_is && (unit.empty() || (shared && *shared != unit))) {
                return "";
            }
            shared = as_it_is ? unit : shared;
            as_they_are += as_it_is ? 1U : 0U;
        }
        // One row alone may have a coefficient of 1/A beside another one's of 10 V/A².
        return as_they_are == table_.budget.rows.size() || as_they_are > 1 ? shared.value_or("") : "";
    }

    TableSoFar& table_;
    std::vector<Sentence>& not_read_;
};

}  // namespace

void settle_result_line(const SheetView& sheet, TableSoFar& table, std::vector<Sentence>& not_read) {
    if (!table.result_line) {
        return;
    }
    const auto number = [&](Column column, Statement statement) -> std::optional<StatedResult> {
        const auto found = table.result_line->find(column);
        std::vector<Sentence> unused;
        return found == table.result_line->end() ? std::nullopt : result_in(sheet, *found->second, statement, unused);
    };
    std::optional<StatedResult> amount = number(Column::contribution, Statement::u_c);
    amount = amount ? amount : number(Column::u, Statement::u_c);
    if (amount && table.product && is_u_c_beside_product(table, *amount)) {
        const auto value = table.statements.numbers.find(Statement::value);
        if (value != table.statements.numbers.end() && table.sums().unit_of(*amount).empty()) {
            amount->unit = table.sums().unit_of(value->second);  // whatever U is stated in
        }
        table.sums().state(Statement::u_c, std::move(amount));
        table.sums().state(Statement::nu_eff, number(Column::nu, Statement::nu_eff));
        return;
    }
    const std::optional<Interval> sum = amount ? table.sums().sum_above(*amount) : std::nullopt;
    if (!sum) {
        return;
    }
    const std::optional<StatedResult> divisor = number(Column::divisor, Statement::k);
    const std::optional<StatedResult> last = number(Column::nu, Statement::k);
    if (as_rounded(amount->number, 1.0).meets(*sum)) {
        table.sums().state(Statement::u_c, std::move(amount));
        table.sums().state(Statement::nu_eff, number(Column::nu, Statement::nu_eff));
        return;
    }
    const std::optional<StatedNumber> k = table.sums().stated(Statement::k);
    for (const std::optional<StatedNumber>& by : {divisor ? std::optional(divisor->number) : std::nullopt, k,
                                                  last ? std::optional(last->number) : std::nullopt}) {
        if (!by || !(by->value > 1.0) || !as_rounded(amount->number, by->value).meets(*sum)) {
            continue;
        }
        table.sums().state(Statement::U, std::move(amount));
        if (divisor && by->place == divisor->number.place) {
            table.sums().state(Statement::k, divisor);
        } else if (last && by->place == last->number.place) {
            table.sums().state(Statement::k, last);
        }
        return;
    }
    constexpr double k_still_u_c = 1.6;  // no coverage factor is as small
    if (!table.product && amount->number.value < k_still_u_c * sum->high) {
        table.sums().state(Statement::u_c, std::move(amount));
        table.sums().state(Statement::nu_eff, number(Column::nu, Statement::nu_eff));
        return;
    }
    table.is_open = true;
    not_read.push_back(
        say("{cell}: beside the value of the result stands {text}, which is neither u_c of the rows nor U with a k "
            "that is stated; the table is not looked at; what is it?",
            amount->number.place, text::in_quotes(amount->number.text)));
}

void settle_statements(TableSoFar& table, std::vector<Sentence>& not_read) {
    StatementsOfTable statements(table, not_read);
    statements.settle_lost_row();
    statements.settle_statements();
}

}  // namespace gumcert::audit
