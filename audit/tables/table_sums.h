#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/tables/row_units.h"
#include "audit/tables/stated_results.h"
#include "audit/tables/table_heads.h"
#include "audit/words/column_heads.h"

namespace gumcert::audit {

/// Reads what the words of a row say in its numbers: what it is of, its comment, and what follows from its distribution.
void settle_words(AuditedRow& row);

/// A printed number over k, as wide as a laboratory may have rounded it: by a whole unit of its last digit.
[[nodiscard]] Interval as_rounded(const StatedNumber& number, double k);

/// The rows of a table that is read, and what it states of their sum.
struct TableSums {
    std::vector<AuditedRow>& rows;
    std::vector<RowUnits>& units;  ///< of the rows
    const Heads& heads;
    Statements& statements;

    /// The unit of a number, or that of its head; "" where neither states one.
    [[nodiscard]] std::string unit_of(const StatedResult& of) const;
    /// The column of the sheet under a head; 0 where there is none.
    [[nodiscard]] std::uint32_t column_of(Column column) const;

    /// The root of the sum of squares of the rows, in the unit of a number.
    /// \param without_last  not of the last one
    [[nodiscard]] std::optional<Interval> sum_above(const StatedResult& of, bool without_last = false) const;
    /// \param count  rows from the first one on
    [[nodiscard]] std::optional<Interval> sum_of_first(const StatedResult& of, std::size_t count) const;
    /// \param which  places of rows
    [[nodiscard]] std::optional<Interval> sum_of(const StatedResult& of, const std::vector<std::size_t>& which) const;

    /// Takes a number for a statement that no other line has made.
    void state(Statement statement, std::optional<StatedResult> result);
    [[nodiscard]] std::optional<StatedNumber> stated(Statement statement) const;

    /// The number that rows are held against: u_c, else U.
    [[nodiscard]] std::optional<StatedResult> stated_of_sum() const;
    /// Whether rows that add up to this have the u_c or the U that is stated; nothing where neither is.
    /// \param of  the number in whose unit the sum is; the stated one itself where none is given
    [[nodiscard]] std::optional<bool> gives_statements(const Interval& sum, const StatedResult* of = nullptr) const;

    /// Whether a number is the u_c, or the U over k, that is stated elsewhere, within the digits of both.
    [[nodiscard]] bool is_stated_u_c(const StatedResult& of) const;

    /// The number of a row under the contributions, or under u, as a statement has it.
    [[nodiscard]] StatedResult amount_of(std::size_t row) const;
    /// The k that makes U of a sum of this number: that of its name, or the one that is stated. 0 where none does.
    [[nodiscard]] double k_to(const StatedResult& amount, const std::string& name, const Interval& sum) const;
};

}  // namespace gumcert::audit
