#include "audit/tables/sum_rows.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>

#include "audit/row_meaning.h"
#include "audit/words/column_heads.h"
#include "audit/words/coverage_words.h"
#include "audit/words/named_statement.h"
#include "audit/words/sum_names.h"
#include "text/small_letters.h"
#include "text/visible_text.h"

namespace gumcert::audit {

namespace {

/// \param but_normal  that u_c of a sum is normal, the layout of UKAS M3003 says in the line of the result
bool has_columns_of_a_row(const AuditedRow& row, bool but_normal = false) {
    const bool is_normal = row.shape == Shape::normal || row.shape == Shape::student_t;
    return row.stated || row.divisor || row.sensitivity || row.type_a ||
           (!row.shape_text.empty() && !(but_normal && is_normal));
}
bool is_amount_alone(const AuditedRow& row) {
    return !has_columns_of_a_row(row, true) && (row.u || row.contribution);
}
bool is_named_as_influence(const AuditedRow& row) {
    return contributor_of(name_in_words(row), row.comment, row.source) != Contributor::other;
}

class SumRows {
public:
    SumRows(const TableSums& table, bool has_result_line, std::vector<Sentence>& not_read)
        : table_(table), has_result_line_(has_result_line), not_read_(not_read) {}

    bool settle() {
        settle_sums_between();
        settle_parts_of_amounts();
        settle_totals_of_parts();
        settle_last_lines();
        settle_last_row();
        return is_open_;
    }

private:
    /// Sums of rows that stand between them are no contributions: "Subtotal type A", "Zwischensumme", "Temperature total". What is
    /// named so, has an amount alone, and is the root of the sum of squares of rows directly above it is one; of a name that
    /// says nothing of a sum, and of one row alone, what is stated has to say so.
    void settle_sums_between() {
        constexpr std::size_t k_least = 3, k_most_lines = 40, k_most_looks = 200;
        const std::size_t count = table_.rows.size();
        if (count < k_least) {
            return;
        }
        drop_squares();
        std::size_t end = table_.rows.size(), lines = 0, looks = 0, begin = 0;
        while (end > 0 && is_amount_alone(table_.rows[end - 1])) {
            --end;  // behind it are lines that may be u_c and U
        }
        std::vector<std::size_t> sums, named, certain, parts, of_type;
        std::size_t matches = 0;
        bool is_any_of_type = false, is_any_of_several = false;
        for (std::size_t i = 1; i < table_.rows.size() && lines < k_most_lines && looks < k_most_looks; ++i) {
            const AuditedRow& row = table_.rows[i];
            const SumName name = sum_name(row.quantity);
            if (!is_amount_alone(row) || (name == SumName::none && i >= end)) {
                continue;
            }
            ++lines;
            if (name == SumName::of_type) {
                of_type.push_back(i);
            }
            const StatedResult amount = table_.amount_of(i);
            // From the last sum on, and where the name says that it is one, from any row on.
            const std::size_t last_begin = name == SumName::none ? begin : i - 1;
            bool is_sum = false, is_of_several = false, is_certain = name == SumName::part;
            for (std::size_t from = begin; from <= last_begin && looks < k_most_looks && !is_sum; ++from) {
                const bool is_last = end > 0 ? i >= end : table_.is_stated_u_c(amount) || !table_.stated_of_sum();
                const bool is_of_all = from == 0 && sums.empty() && is_last && name != SumName::part;
                const bool is_one = i - from < 2;
                if (is_one && (name == SumName::none || name == SumName::of_quantity)) {
                    continue;  // a number that only looks like another one
                }
                std::vector<std::size_t> block(i - from);
                std::iota(block.begin(), block.end(), from);
                ++looks;
                const std::optional<Interval> sum = table_.sum_of(amount, block);
                is_sum = sum && as_rounded(amount.number, 1.0).meets(*sum);
                if (is_sum && is_of_all) {
                    is_sum = false;
                    break;  // u_c
                }
                is_of_several = is_of_several || (is_sum && !is_one);
                is_certain = is_certain || (is_sum && !is_one && (name == SumName::whole || name == SumName::of_type));
                is_any_of_type = is_any_of_type || (is_sum && name == SumName::of_type);
            }
            if (is_sum || is_certain) {
                sums.push_back(i);
                begin = i + 1;
            }
            const auto keep = [i](std::vector<std::size_t>& rows, bool is_one_of_them) {
                if (is_one_of_them) {
                    rows.push_back(i);
                }
            };
            keep(named, (is_sum || is_certain) && name != SumName::none);
            keep(certain, is_certain);
            keep(parts, is_sum && name == SumName::part);
            matches += is_sum && name != SumName::none ? 1U : 0U;
            is_any_of_several = is_any_of_several || (is_of_several && name != SumName::none);
        }
        // Where "Type A" is a sum, so is "Type B", whatever its number; two that fit are none by chance, though the stated u_c
        // was made of all.
        if (is_any_of_type) {
            std::vector<std::size_t> all;
            std::set_union(named.begin(), named.end(), of_type.begin(), of_type.end(), std::back_inserter(all));
            named = std::move(all);
        }
        const bool are_several = matches > 1 || (is_any_of_type && of_type.size() > 1);
        // One that fits, or numbers that are those of one row each, may be so by chance: "Type A" is a contribution then, if what is
        // stated follows with it alone.
        const bool may_be_rows = (matches < 2 || !is_any_of_several) && has_types_alone(named);
        if (are_several && !holds_by(sums, false)) {
            if (!may_be_rows || !holds_by(named, true)) {
                drop_sums(named);
            }
        } else if (!sums.empty() && holds_by(sums, false)) {
            drop_sums(sums);
        } else if (!certain.empty()) {
            drop_sums(holds_by(certain, true) ? parts : certain);
        }
    }
    /// Rows without coefficients and contributions beside one that has them, whose u is the root of the sum of their squares: that one has
    /// them in it, and they are in the unit of its quantity, not of the result. They stand below it, or above it.
    void settle_parts_of_amounts() {
        constexpr std::size_t k_most_parts = 20;
        const auto is_part = [this](std::size_t i) {
            const AuditedRow& row = table_.rows[i];
            return !row.contribution && !row.sensitivity && u_of(row).has_value();
        };
        std::vector<std::size_t> parts, certain;
        std::vector<std::string> wholes, of_certain;  // names, as rows are dropped
        std::size_t behind = 0;                       // the parts so far
        for (std::size_t i = 0; i < table_.rows.size(); ++i) {
            if (!table_.rows[i].contribution || !table_.rows[i].u) {
                continue;
            }
            for (const bool are_below : {true, false}) {
                std::size_t first = are_below ? i + 1 : i, end = first;
                while (are_below && end < table_.rows.size() && end - first < k_most_parts && is_part(end)) {
                    ++end;
                }
                while (!are_below && first > behind && end - first < k_most_parts && is_part(first - 1)) {
                    --first;
                }
                if (end - first > 1 && is_u_of(i, first, end)) {
                    // What is in kelvins is no contribution in micrometres by itself.
                    const bool are_of_other_kind = !factor_between(table_.units[i].u, table_.units[i].contribution);
                    for (std::size_t part = first; part < end; ++part) {
                        parts.push_back(part);
                        wholes.push_back(table_.rows[i].quantity);
                        if (are_of_other_kind) {
                            certain.push_back(part);
                            of_certain.push_back(table_.rows[i].quantity);
                        }
                    }
                    behind = end;
                    break;
                }
            }
        }
        // In one unit a blank coefficient is 1 as well, and numbers may fit by chance: what is stated has to follow without the parts only.
        if (parts.empty() || holds_by(parts, false)) {
            drop_parts(parts, wholes);
        } else if (!certain.empty() && !holds_by(certain, true)) {
            drop_parts(certain, of_certain);
        }
    }
    [[nodiscard]] static std::optional<Interval> u_of(const AuditedRow& row) {
        if (row.u) {
            return as_rounded(*row.u, 1.0);
        }
        const bool is_divided = row.stated && row.divisor && row.divisor->value > 0.0;
        return is_divided ? std::optional(as_rounded(*row.stated, row.divisor->value)) : std::nullopt;
    }
    /// Whether u of a row is the root of the sum of squares of those of some others, in one unit.
    [[nodiscard]] bool is_u_of(std::size_t row, std::size_t first, std::size_t end) const {
        double low = 0.0, high = 0.0;
        for (std::size_t i = first; i < end; ++i) {
            const Interval u = *u_of(table_.rows[i]);
            if (table_.units[i].u != table_.units[row].u) {
                return false;
            }
            low += std::max(0.0, u.low) * std::max(0.0, u.low);
            high += u.high * u.high;
        }
        return as_rounded(*table_.rows[row].u, 1.0).meets({std::sqrt(low), std::sqrt(high)});
    }
    void drop_parts(const std::vector<std::size_t>& parts, const std::vector<std::string>& wholes) {
        for (std::size_t i = parts.size(); i > 0; --i) {
            const AuditedRow& row = table_.rows[parts[i - 1]];
            not_read_.push_back(say("{cell}: {text} is taken for a part of {other}, and is not added again", row.place,
                                    text::in_quotes(row.quantity), text::in_quotes(wholes[i - 1])));
            drop_row(parts[i - 1]);
        }
    }

    /// A number alone above the rows that make it up, "Temperature, total" and below it what it is made of: it is no contribution of its own.
    /// Rows that are called parts say so, as do two such numbers with names of sums; else what is stated has to follow without it only.
    void settle_totals_of_parts() {
        constexpr std::size_t k_least_parts = 2, k_most_parts = 20, k_most_looks = 200;
        std::vector<std::size_t> totals, named, certain;
        std::size_t looks = 0;
        for (std::size_t i = 0; i + k_least_parts < table_.rows.size() && looks < k_most_looks; ++i) {
            const AuditedRow& row = table_.rows[i];
            const SumName name = sum_name(row.quantity);
            if (!may_be_total(row)) {
                continue;
            }
            const StatedResult amount = table_.amount_of(i);
            std::vector<std::size_t> parts;
            bool are_called_so = true;
            for (std::size_t part = i + 1; part < table_.rows.size() && parts.size() < k_most_parts; ++part) {
                const AuditedRow& next = table_.rows[part];
                are_called_so = are_called_so && is_called_part(next.quantity);
                if (!are_called_so && name == SumName::none && !has_more_than(next, row)) {
                    break;
                }
                parts.push_back(part);
                if (parts.size() < k_least_parts) {
                    continue;
                }
                ++looks;
                const std::optional<Interval> sum = table_.sum_of(amount, parts);
                if (!sum || !as_rounded(amount.number, 1.0).meets(*sum)) {
                    continue;
                }
                totals.push_back(i);
                if (name != SumName::none) {
                    named.push_back(i);
                }
                if (are_called_so) {
                    certain.push_back(i);
                }
                i = part;
                break;
            }
        }
        if (totals.empty()) {
            return;
        }
        if (holds_by(totals, false)) {
            drop_sums(totals, true);
        } else if (named.size() > 1 && !holds_by(named, true)) {
            drop_sums(named, true);
        } else if (!certain.empty()) {
            drop_sums(certain, true);
        } else if (named.size() > 1 && !has_types_alone(named)) {
            drop_sums(named, true);
        }
    }
    /// A number of a row without what it was divided from.
    [[nodiscard]] static bool may_be_total(const AuditedRow& row) {
        const bool is_normal = row.shape == Shape::normal || row.shape_text.empty();
        return (row.u || row.contribution) && !row.stated && !row.divisor && is_normal && !row.nu;
    }
    /// Whether a row says more of what it comes from than a total does.
    [[nodiscard]] static bool has_more_than(const AuditedRow& part, const AuditedRow& total) {
        const bool is_divided = part.stated || part.divisor || (!part.shape_text.empty() && total.shape_text.empty());
        return is_divided || (part.sensitivity && !total.sensitivity) || (part.u && !total.u);
    }
    /// Whether what is stated follows only with sums of other rows added once more (`with`), or only without them.
    [[nodiscard]] bool holds_by(const std::vector<std::size_t>& sums, bool with) const {
        const std::optional<StatedResult> of = table_.stated_of_sum();
        if (!of) {
            return false;
        }
        std::vector<std::size_t> all(table_.rows.size()), others;
        std::iota(all.begin(), all.end(), std::size_t{0});
        std::set_difference(all.begin(), all.end(), sums.begin(), sums.end(), std::back_inserter(others));
        const std::optional<Interval> sum_of_all = table_.sum_of(*of, all), of_others = table_.sum_of(*of, others);
        const bool holds_with = sum_of_all && table_.gives_statements(*sum_of_all).value_or(false);
        const bool holds_without = of_others && table_.gives_statements(*of_others).value_or(false);
        return with ? holds_with && !holds_without : holds_without && !holds_with;
    }
    [[nodiscard]] bool has_types_alone(const std::vector<std::size_t>& sums) const {
        return std::all_of(sums.begin(), sums.end(),
                           [this](std::size_t row) { return sum_name(table_.rows[row].quantity) == SumName::of_type; });
    }
    /// \param of_rows_below  and not of rows above them
    void drop_sums(const std::vector<std::size_t>& sums, bool of_rows_below = false) {
        for (auto sum = sums.rbegin(); sum != sums.rend(); ++sum) {
            const AuditedRow& row = table_.rows[*sum];
            not_read_.push_back(of_rows_below
                                    ? say("{cell}: {text} is taken for a sum of rows below it, and is not added again",
                                          row.place, text::in_quotes(row.quantity))
                                    : taken_for_a_sum(row.place, row.quantity));
            drop_row(*sum);
        }
    }
    void drop_row(std::size_t row) {
        table_.rows.erase(table_.rows.begin() + static_cast<std::ptrdiff_t>(row));
        table_.units.erase(table_.units.begin() + static_cast<std::ptrdiff_t>(row));
    }
    /// "Sum of squares | 0.0344" is a square, and neither a contribution nor u_c.
    void drop_squares() {
        for (std::size_t i = table_.rows.size(); i > 1; --i) {
            const AuditedRow& row = table_.rows[i - 1];
            if (!has_columns_of_a_row(row, true) && sum_name(row.quantity) == SumName::of_squares) {
                not_read_.push_back(
                    say("{cell}: {text} has a number, and is no row and no statement that is known; it is not used",
                        row.place, text::in_quotes(row.quantity)));
                drop_row(i - 1);
            }
        }
    }
    /// A table of names and u alone ends with u_c and U where a line is the root of the sum of squares of all above it, and those
    /// behind it are what k makes of it; or where the last two have one name but for their first letter, "u(f)" and "U(f)".
    /// What is taken is told. Numbers of one digit fit many sums by chance: without a name of a sum they are asked about. Where u_c
    /// or U is stated elsewhere, the rows above these lines have to give it.
    /// \return whether these lines were taken, or asked about
    [[nodiscard]] bool settle_plain_last_lines() {
        constexpr std::size_t k_least = 2, k_most_results = 3;
        const std::size_t count = table_.rows.size();
        if (count >= k_least + 2 && are_u_and_U(table_.rows[count - 2].quantity, table_.rows[count - 1].quantity)) {
            table_.state(Statement::u_c, table_.amount_of(count - 2));
            table_.state(Statement::U, table_.amount_of(count - 1));
            tell_taken(table_.rows[count - 2], "u_c");
            tell_taken(table_.rows[count - 1], "U");
            table_.rows.resize(count - 2);
            table_.units.resize(count - 2);
            return true;
        }
        for (std::size_t i = count > k_most_results + k_least ? count - k_most_results : k_least; i + 1 < count; ++i) {
            const StatedResult amount = table_.amount_of(i);
            const std::optional<Interval> sum = table_.sum_of_first(amount, i);
            if (!sum || !as_rounded(amount.number, 1.0).meets(*sum) || is_named_as_influence(table_.rows[i])) {
                continue;
            }
            if (table_.stated_of_sum() && !table_.gives_statements(*sum, &amount).value_or(false)) {
                continue;
            }
            const auto is_U = [&](std::size_t row) {
                if (is_named_as_influence(table_.rows[row])) {
                    return false;
                }
                if (table_.k_to(table_.amount_of(row), table_.rows[row].quantity, *sum) > 0.0) {
                    return true;
                }
                for (const double k : {2.0, 3.0}) {
                    const StatedNumber &of = amount.number, &by_k = table_.amount_of(row).number;
                    const double step = k * printed_half_step(of) + printed_half_step(by_k) + 1e-9 * std::abs(of.value);
                    if (std::abs(std::abs(by_k.value) - k * std::abs(of.value)) <= step) {
                        return true;
                    }
                }
                return false;
            };
            bool are_U = true, is_any_of_one_digit = has_one_digit(amount.number);
            for (std::size_t row = i + 1; row < count; ++row) {
                are_U = are_U && is_U(row);
                is_any_of_one_digit = is_any_of_one_digit || has_one_digit(table_.amount_of(row).number);
            }
            const SumName name = sum_name(table_.rows[i].quantity);
            const bool is_named_sum = name == SumName::whole || name == SumName::of_quantity;
            if (are_U && (is_named_sum || !is_any_of_one_digit)) {
                take_last_lines(i, *sum, true);
            } else {
                ask_for_row(table_.rows[i]);
            }
            return true;
        }
        return false;
    }
    [[nodiscard]] static bool has_one_digit(const StatedNumber& number) {
        constexpr double k_two_digits = 9.99;  // units of the last digit
        return std::abs(number.value) < k_two_digits * 2.0 * printed_half_step(number);
    }
    /// \param symbol  of what a line was taken for
    void tell_taken(const AuditedRow& row, const std::string& symbol) {
        not_read_.push_back(say("{cell}: {text} is taken for {symbol} of the rows above it, and for no contribution",
                                row.place, text::in_quotes(row.quantity), symbol));
    }
    void ask_for_row(const AuditedRow& row) {
        is_open_ = true;
        not_read_.push_back(
            say("{cell}: {text} may be the result of the rows above it, or one more contribution; the table is not "
                "looked at; which one is it?",
                row.place, text::in_quotes(row.quantity)));
    }
    /// Lines at the end of the rows that have an amount alone, where the rows above them have what makes up theirs, are results
    /// whatever their names: u_c where their number is the root of the sum of squares of the rows above, U where it is k times that.
    void settle_last_lines() {
        constexpr std::size_t k_least = 2, k_most = 6;
        settle_divided_result();
        const std::size_t count = table_.rows.size();
        std::size_t first = count;
        while (first > 0 && is_amount_alone(table_.rows[first - 1])) {
            --first;
        }
        const bool is_distinct =
            std::all_of(table_.rows.begin(), table_.rows.begin() + static_cast<std::ptrdiff_t>(first),
                        [](const AuditedRow& row) { return has_columns_of_a_row(row); });
        if (first == count || count < k_least) {
            return;
        }
        const StatedResult last = table_.amount_of(count - 1);
        const std::optional<Interval> all = table_.sum_of_first(last, count);
        if (all && table_.gives_statements(*all, &last).value_or(false)) {
            return;
        }
        if (first == 0 && settle_plain_last_lines()) {
            return;
        }
        if (first < k_least || count - first > k_most || !is_distinct) {
            return;
        }
        for (std::size_t i = first; i < count; ++i) {
            const StatedResult amount = table_.amount_of(i);
            const std::optional<Interval> sum = table_.sum_of_first(amount, i);
            if (!sum) {
                return;
            }
            const bool is_u_c = as_rounded(amount.number, 1.0).meets(*sum);
            const bool is_last = i + 1 == count;
            if (is_u_c && is_last) {
                return;  // settle_last_row() knows more of one line
            }
            if ((is_u_c || table_.k_to(amount, table_.rows[i].quantity, *sum) > 0.0) &&
                have_no_influence(i + 1, *sum)) {
                take_last_lines(i, *sum);
                return;
            }
        }
        ask_for_last_lines(first);
    }
    /// Whether no row from one on is named as an influence and has a number that is not U of a sum.
    [[nodiscard]] bool have_no_influence(std::size_t from, const Interval& sum) const {
        for (std::size_t i = from; i < table_.rows.size(); ++i) {
            const AuditedRow& row = table_.rows[i];
            if (is_named_as_influence(row) && !(table_.k_to(table_.amount_of(i), row.quantity, sum) > 0.0)) {
                return false;
            }
        }
        return true;
    }
    /// \param are_told  that nothing but their numbers says what these lines are
    void take_last_lines(std::size_t from, const Interval& sum, bool are_told = false) {
        const std::vector<AuditedRow> lines(table_.rows.begin() + static_cast<std::ptrdiff_t>(from), table_.rows.end());
        std::vector<StatedResult> amounts;
        for (std::size_t i = from; i < table_.rows.size(); ++i) {
            amounts.push_back(table_.amount_of(i));
        }
        constexpr double k_least_k = 1.6, k_most_k = 3.5;  // of a U without a k in its line
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const double k = table_.k_to(amounts[i], lines[i].quantity, sum);
            const double ratio = amounts[i].number.value / sum.high;
            const bool is_u_c = as_rounded(amounts[i].number, 1.0).meets(sum);
            const CoverageText said = coverage_in(lines[i].quantity);
            const bool is_U = k > 0.0 || (i > 0 && (said.says_any() || (ratio > k_least_k && ratio < k_most_k)));
            if (are_told && (is_u_c || is_U)) {
                tell_taken(lines[i], is_u_c ? "u_c" : "U");
            }
            if (is_u_c) {
                table_.state(Statement::u_c, amounts[i]);
                if (lines[i].nu) {
                    table_.state(
                        Statement::nu_eff,
                        StatedResult{.number = *lines[i].nu, .unit = "", .column = table_.column_of(Column::nu)});
                }
            } else if (is_U) {
                table_.state(Statement::U, amounts[i]);
                if (said.says_any() && table_.statements.coverage.empty()) {
                    table_.statements.coverage = lines[i].quantity;
                    table_.statements.coverage_place = lines[i].place;
                }
            } else {
                not_read_.push_back(
                    say("{cell}: {text} has a number, and is no row and no statement that is known; it is not used",
                        lines[i].place, text::in_quotes(lines[i].quantity)));
            }
        }
        table_.rows.resize(from);
        table_.units.resize(from);
    }
    /// Lines at the end that are called an uncertainty, and give no result of the rows above them, may be one all the same.
    void ask_for_last_lines(std::size_t first) {
        for (std::size_t i = first; i < table_.rows.size(); ++i) {
            const AuditedRow& row = table_.rows[i];
            const std::string name = text::in_small_letters(row.quantity);
            constexpr std::string_view k_words[] = {"uncertaint", "unsicherheit", "incertidumbre",
                                                    "不確定",     "u =",          "u="};
            const bool is_called_so =
                std::any_of(std::begin(k_words), std::end(k_words),
                            [&name](std::string_view word) { return name.find(word) != name.npos; });
            if (is_called_so && !is_named_as_influence(row)) {
                ask_for_row(row);
                return;
            }
        }
    }
    /// "Total | 0.64 | 2 | 0.32" below rows with coefficients: U, k and u_c in one line, where the last is the sum of the rows.
    void settle_divided_result() {
        constexpr std::size_t k_least = 3;
        if (table_.rows.size() < k_least) {
            return;
        }
        const AuditedRow last = table_.rows.back();
        const bool has_all = last.stated && last.divisor && last.divisor->value > 1.0 && (last.u || last.contribution);
        const bool is_distinct = !last.sensitivity && last.shape_text.empty() && !last.type_a &&
                                 std::all_of(table_.rows.begin(), table_.rows.end() - 1,
                                             [](const AuditedRow& row) { return row.sensitivity.has_value(); });
        if (!has_all || !is_distinct || is_named_as_influence(last)) {
            return;
        }
        const StatedResult amount = table_.amount_of(table_.rows.size() - 1);
        const std::optional<Interval> sum = table_.sum_above(amount, true);
        if (!sum || !as_rounded(amount.number, 1.0).meets(*sum)) {
            return;
        }
        const RowUnits units = table_.units.back();
        table_.rows.pop_back();
        table_.units.pop_back();
        table_.state(Statement::u_c, amount);
        table_.state(
            Statement::U,
            StatedResult{.number = *last.stated, .unit = units.stated, .column = table_.column_of(Column::stated)});
        table_.state(Statement::k,
                     StatedResult{.number = *last.divisor, .unit = "", .column = table_.column_of(Column::divisor)});
    }

    /// The last row of a table may be its result: u_c under u or the contributions, without anything that is divided, a distribution
    /// or a coefficient (the layout of EA-4/02, chapter 4 and its examples).
    void settle_last_row() {
        constexpr std::size_t k_least = 3;
        while (table_.rows.size() >= k_least && is_lone_number(table_.rows.back()) && is_no_row()) {
            drop_last_row();
        }
        if (is_open_ || table_.rows.size() < k_least || has_columns_of_a_row(table_.rows.back(), true)) {
            return;
        }
        const bool is_called_normal = has_columns_of_a_row(table_.rows.back());
        const AuditedRow& last = table_.rows.back();
        const bool by_u = !last.contribution;
        const std::optional<StatedNumber>& amount = by_u ? last.u : last.contribution;
        if (!amount ||
            (last.u && last.contribution && !as_rounded(*last.u, 1.0).meets(as_rounded(*last.contribution, 1.0)))) {
            return;
        }
        const StatedResult result{.number = *amount,
                                  .unit = by_u ? table_.units.back().u : table_.units.back().contribution,
                                  .column = table_.column_of(by_u ? Column::u : Column::contribution)};
        // A row that is named as an influence is one, whatever its number.
        const bool is_result = last.estimate && last.estimate->value != 0.0 && !is_named_as_influence(last) &&
                               table_.is_stated_u_c(result);
        const std::optional<Interval> above = table_.sum_above(result, true), all = table_.sum_above(result);
        if (!above || !all) {
            if (is_result) {
                take_last_row(result);
            }
            return;
        }
        const bool is_distinct =
            std::all_of(table_.rows.begin(), table_.rows.end() - 1, [is_called_normal](const AuditedRow& row) {
                return is_called_normal ? row.stated || row.divisor || row.sensitivity : has_columns_of_a_row(row);
            });
        const bool is_sum = as_rounded(*amount, 1.0).meets(*above);
        const std::optional<bool> with = table_.gives_statements(*all, &result),
                                  without = table_.gives_statements(*above, &result);
        const bool is_stated = with.has_value();
        if (is_stated && *with) {
            return;
        }
        if (is_result || (is_sum && (is_distinct || (is_stated && *without)))) {
            if (is_stated && !is_distinct && has_one_digit(*amount)) {
                tell_taken(last, "u_c");  // one digit may be u of one more row as well
            }
            take_last_row(result);
            return;
        }
        if (is_distinct && is_stated && *without && !last.estimate && !is_named_as_influence(last)) {
            drop_last_row();  // the value in the column of u
            return;
        }
        const bool has_u_c = table_.statements.numbers.contains(Statement::u_c);
        const bool looks_like_result =
            is_distinct && last.estimate && !has_u_c && !has_result_line_ && !(is_stated && *without);
        // A volume is no result that is stated as a concentration.
        const auto value = table_.statements.numbers.find(Statement::value);
        const bool is_of_other_kind = value != table_.statements.numbers.end() && last.estimate &&
                                      !factor_between(table_.units.back().estimate, table_.unit_of(value->second));
        if (!is_of_other_kind && (is_sum || looks_like_result)) {
            ask_for_row(last);
        }
    }
    /// A row of which nothing is known but one number in the column of what is divided.
    [[nodiscard]] static bool is_lone_number(const AuditedRow& row) {
        return row.stated && !row.divisor && !row.u && !row.contribution && !row.sensitivity && !row.nu &&
               !row.estimate && row.shape_text.empty() && !row.type_a;
    }
    /// Whether the last row, a lone number, is none: in a table without a column of estimates (UKAS M3003) the value stands
    /// there, and the rows above have what makes them rows. One that is named as an influence is a row, unless the rows above it
    /// give what is stated; one that the statements need is a row whatever its name.
    [[nodiscard]] bool is_no_row() {
        const AuditedRow& last = table_.rows.back();
        std::size_t lone = 0, distinct = 0;
        for (const AuditedRow& row : table_.rows) {
            lone += is_lone_number(row) ? 1U : 0U;
            distinct += row.u || row.contribution || row.divisor || !row.shape_text.empty() ? 1U : 0U;
        }
        if (distinct < 2 || lone + distinct < table_.rows.size()) {
            return false;
        }
        const StatedResult number{
            .number = *last.stated, .unit = table_.units.back().stated, .column = table_.column_of(Column::stated)};
        const std::optional<Interval> above = table_.sum_above(number, true), all = table_.sum_above(number);
        if (all && table_.gives_statements(*all, &number).value_or(false)) {
            return false;
        }
        return (above && table_.gives_statements(*above, &number).value_or(false)) || !is_named_as_influence(last);
    }
    void drop_last_row() {
        const AuditedRow& last = table_.rows.back();
        not_read_.push_back(
            say("{cell}: {text} has a number, and is no row and no statement that is known; it is not used", last.place,
                text::in_quotes(last.quantity)));
        table_.rows.pop_back();
        table_.units.pop_back();
    }
    void take_last_row(const StatedResult& result) {
        const AuditedRow last = table_.rows.back();
        const RowUnits units = table_.units.back();
        table_.rows.pop_back();
        table_.units.pop_back();
        table_.state(Statement::u_c, result);
        if (last.estimate) {
            table_.state(Statement::value, StatedResult{.number = *last.estimate,
                                                        .unit = units.estimate,
                                                        .column = table_.column_of(Column::estimate)});
        }
        if (last.nu) {
            table_.state(Statement::nu_eff,
                         StatedResult{.number = *last.nu, .unit = "", .column = table_.column_of(Column::nu)});
        }
    }

    TableSums table_;
    bool has_result_line_;
    std::vector<Sentence>& not_read_;
    bool is_open_ = false;
};

}  // namespace

Sentence taken_for_a_sum(const std::string& place, const std::string& name) {
    return say("{cell}: {text} is taken for a sum of rows above it, and is not added again", place,
               text::in_quotes(name));
}

bool settle_sums(const TableSums& table, bool has_result_line, std::vector<Sentence>& not_read) {
    return SumRows(table, has_result_line, not_read).settle();
}

}  // namespace gumcert::audit
