#include "audit/tables/open_sums.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "audit/claims.h"
#include "audit/words/column_heads.h"
#include "audit/words/unit_words.h"
#include "gum/quantity/unit.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

class OpenSums {
public:
    OpenSums(const TableSoFar& table, std::vector<Sentence>& not_read) : table_(table), not_read_(not_read) {}

    [[nodiscard]] bool any() const { return needs_unread_column() || needs_relative_column() || has_no_sum(); }

private:
    /// Whether a row has another unit than the result and nothing that brings it there, and a column is not read: what a budget in which
    /// it is added as it stands would say, nobody wants to know.
    [[nodiscard]] bool needs_unread_column() const {
        if (table_.budget.unread_columns.empty() || table_.budget.unit.empty()) {
            return false;
        }
        const auto row =
            std::find_if(table_.budget.rows.begin(), table_.budget.rows.end(), [this](const AuditedRow& one) {
                return !one.sensitivity && !one.contribution && !one.unit.empty() && known_unit(one.unit) &&
                       known_unit(table_.budget.unit) && !factor_between(one.unit, table_.budget.unit);
            });
        if (row == table_.budget.rows.end()) {
            return false;
        }
        not_read_.push_back(
            say("{cell}: {text} has another unit than the result and no coefficient that is read; the "
                "table is not looked at; is it in the column {head}?",
                row->place, text::in_quotes(row->quantity), text::in_quotes(table_.budget.unread_columns.front())));
        return true;
    }
    /// Whether a column of relative uncertainties stands beside u, as of products in chemistry, and nothing shows that u is what was added: the
    /// rows state no unit that they share, and what is stated does not follow from them.
    [[nodiscard]] bool needs_relative_column() const {
        const auto relative = std::find_if(table_.budget.unread_columns.begin(), table_.budget.unread_columns.end(),
                                           [](const std::string& head) { return is_of_relative_uncertainty(head); });
        const bool has_coefficients =
            table_.heads->columns.contains(Column::sensitivity) || table_.heads->columns.contains(Column::contribution);
        if (relative == table_.budget.unread_columns.end() || has_coefficients || table_.budget.rows.empty()) {
            return false;
        }
        const std::string& unit = table_.budget.rows.front().unit;
        const bool have_one_unit = !unit.empty() && unit != "1" &&
                                   std::all_of(table_.budget.rows.begin(), table_.budget.rows.end(),
                                               [&unit](const AuditedRow& row) { return row.unit == unit; });
        const ClaimCheck check = check_claims(table_.budget);
        const bool is_stated = table_.budget.claims.u_c || table_.budget.claims.U;
        const bool follows = is_stated && check.allowed && !check.u_c_outside && !check.U_outside;
        if (have_one_unit || (follows && !table_.budget.unit.empty())) {
            return false;
        }
        not_read_.push_back(
            say("{table}: the table is not looked at; the column {head} has relative uncertainties and is not read, "
                "and u of the rows has no unit that all of them state, or does not give what is stated; is the result "
                "made up of that column?",
                table_.budget.place, text::in_quotes(*relative)));
        return true;
    }
    /// Whether the dimensions of the rows may make up that of the result as a product: those that are not in its unit by themselves, or
    /// together with it; as squares, too, where no row is in its unit.
    [[nodiscard]] bool may_be_product() const {
        constexpr std::size_t k_most = 4'096;
        const std::optional<gum::Unit> result = known_unit(table_.budget.unit);
        if (!result) {
            return true;
        }
        std::vector<gum::Dimension> reached(1), others;
        for (const AuditedRow& row : table_.budget.rows) {
            const std::optional<gum::Unit> unit = known_unit(row.unit);
            if (unit && !(unit->dimension() == result->dimension())) {
                others.push_back(unit->dimension());
            }
        }
        const bool may_be_squares = others.size() == table_.budget.rows.size();
        for (const gum::Dimension& other : others) {
            std::vector<gum::Dimension> next;
            for (const gum::Dimension& so_far : reached) {
                for (const double exponent : {1.0, -1.0, 2.0, -2.0}) {
                    const gum::Dimension product = so_far * other.power(exponent);
                    const bool is_new = std::find(next.begin(), next.end(), product) == next.end();
                    if (is_new && (may_be_squares || std::abs(exponent) < 2.0)) {
                        next.push_back(product);
                    }
                }
            }
            if (next.size() > k_most) {
                return true;
            }
            reached = std::move(next);
        }
        return std::any_of(reached.begin(), reached.end(), [&](const gum::Dimension& product) {
            return product == result->dimension() || (!may_be_squares && product.is_one());
        });
    }
    /// Whether nothing says how rows make up a result: they have no coefficients and no contributions, and their units cannot be added, or
    /// are not there beside a column that is not read. A sum of their u is a number of nobody. Where something is stated, that is known
    /// where it does not follow from the rows as they stand, no more than half of them are in its unit, and a product of them is; of rows
    /// of one dimension a quotient or power may be, where none is in its unit.
    [[nodiscard]] bool has_no_sum() const {
        std::set<std::string> units;
        bool differ = false;
        std::size_t in_its_unit = 0;
        const bool is_stated = table_.budget.claims.u_c || table_.budget.claims.U;
        for (const AuditedRow& row : table_.budget.rows) {
            // One that is the conversion of a unit says nothing of the model.
            if (table_.have_coefficients || (!is_stated && row.sensitivity) || row.contribution ||
                (row.unit != "1" && !row.unit.empty() && !known_unit(row.unit))) {
                return false;
            }
            differ = differ || (!units.empty() && !factor_between(row.unit, *units.begin()));
            in_its_unit += factor_between(row.unit, table_.budget.unit) ? 1U : 0U;
            units.insert(row.unit);
        }
        if (is_stated) {
            differ = differ || (in_its_unit == 0 && known_unit(table_.budget.unit));
            if (!differ || 2 * in_its_unit > table_.budget.rows.size() || !may_be_product() ||
                table_.follows_from_rows()) {
                return false;
            }
            not_read_.push_back(
                say("{table}: the table is not looked at; its rows have no coefficients, and their units are not that "
                    "of the result, which does not follow from them as a sum or as a product of their values; how do "
                    "they make it up?",
                    table_.budget.place));
            return true;
        }
        const bool have_none = units.size() == 1 && units.contains("") && table_.budget.unit.empty();
        if (!differ && !(have_none && !table_.budget.unread_columns.empty())) {
            return false;
        }
        not_read_.push_back(say(
            "{table}: the table is not looked at; its rows have no coefficients, their units cannot be added or are "
            "not stated, and no result is; how do they make it up?",
            table_.budget.place));
        return true;
    }

    const TableSoFar& table_;
    std::vector<Sentence>& not_read_;
};

}  // namespace

bool has_open_sum(const TableSoFar& table, std::vector<Sentence>& not_read) {
    return OpenSums(table, not_read).any();
}

}  // namespace gumcert::audit
