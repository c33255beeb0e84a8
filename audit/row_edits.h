#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/finding.h"
#include "audit/rule.h"
#include "audit/subject.h"

namespace gumcert::audit {

// What rules have in common: walks over the rows of a subject, words for numbers, and corrections of rows.
//
// Corrections name a row by its position, which is the same at every point of a table. They never take a row away, but
// leave it out of the sum, and add rows at the end, so that the positions of others stay.

/// One row of one budget.
struct RowAt {
    std::size_t budget = 0, row = 0;
    const AuditedBudget& of;
    const AuditedRow& is;
};
void for_each_row(const AuditSubject& subject, const std::function<void(const RowAt&)>& look);

/// A finding about a row: where it is, and which budget it touches. Column "" means the row as a whole.
[[nodiscard]] AuditFinding finding_at(const RowAt& at, const std::string& column, Sentence what);
/// A finding about a budget as a whole.
[[nodiscard]] AuditFinding finding_of(const AuditSubject& subject, std::size_t budget, Sentence what);

/// "0.231 µm": four significant digits, with the unit where there is one.
[[nodiscard]] std::string in_words(double number, const std::string& unit = "");
/// A unit as people write it, "µm" of "um"; "1" stays.
[[nodiscard]] std::string printed_unit(const std::string& unit);

// One error of a u that several rules see is corrected once: what multiplies u by a factor by which another correction has
// multiplied it already, within 1 %, changes nothing; where the other has set u, what the digits of the former u leave open
// of the factor is added to the 1 %. Factors that differ are different errors, and multiply. Where the number that was
// divided is known, set_u is right: it does the same however often it is applied.
[[nodiscard]] Correction set_u(std::size_t row, double u);
/// Of a job that states u alone, what u should be made of says its distribution too, and k may rest on it. Tables of others
/// keep the shape that they state.
[[nodiscard]] Correction set_u_and_shape(std::size_t row, double u, Shape shape);
/// \param factor  > 0
[[nodiscard]] Correction scale_u(std::size_t row, double factor);
/// From the u of the table to another one: a factor, so that a correction of the very number that was divided is kept; and of the
/// printed u, whether or not its rounding was put right before.
/// \param at  with u > 0
[[nodiscard]] Correction change_u(const RowAt& at, double to);
/// Puts in place of a printed u what it was rounded from, unless something else corrects the row.
[[nodiscard]] Correction unround_u(std::size_t row, double u);
[[nodiscard]] Correction set_sensitivity(std::size_t row, double sensitivity);
[[nodiscard]] Correction set_degrees_of_freedom(std::size_t row, double nu);
[[nodiscard]] Correction leave_out(std::size_t row);
[[nodiscard]] Correction put_in(std::size_t row);
/// \param contribution  standard uncertainty in the unit of the result
[[nodiscard]] Correction add_contribution(double contribution, std::string quantity);
/// One after the other.
[[nodiscard]] Correction both(Correction first, Correction second);

/// Quantity, source and comment of a row in small letters, to look for words in.
[[nodiscard]] std::string text_of_row(const AuditedRow& row);
/// Whether a text has one of some words, given in small letters.
[[nodiscard]] bool mentions(const std::string& text_of_row, const std::vector<std::string_view>& words);
[[nodiscard]] bool mentions(const AuditedRow& row, const std::vector<std::string_view>& words);
/// Whether the words of the rows of a budget are read, so that what they do not say is left out; else it is told that nobody knows.
/// \param place  of what is left unchecked: the budget, or a row of it
[[nodiscard]] bool reads_words(const AuditedBudget& budget, const std::string& place, FindingCollector& findings);

/// True where the u that a row uses is another number than it should be: further away than a relative deviation, the
/// digits of u, and what is left open of the expected number itself.
[[nodiscard]] bool u_differs(const AuditedRow& row, double expected, double relative = 0.01, double left_open = 0.0);

/// Whether u may be a number, by its own digits and by those of the columns that give it: a printed "0.1" is 0.0865 as well as
/// 0.1, and 0.173 over 1.732 is not 0.0865.
[[nodiscard]] bool may_be_u(const AuditedRow& row, double number);

/// The number that u was made from, by the words of the row or else by its column; 0 where neither says one.
[[nodiscard]] double number_divided(const AuditedRow& row);
/// Whether the column of what is divided has the number of the words twice, or its decimal sign at another place: no such
/// two numbers mean the same by chance. Half of a number is not looked for: that of a full width.
[[nodiscard]] bool is_slip_of(const AuditedRow& row, double words);
/// The standard uncertainty that the words of a row give, or its column by them: a/√3 of a rectangular distribution,
/// d/√12 of a step, U/k of a certificate, s/√n of readings.
[[nodiscard]] std::optional<double> u_by_words(const AuditedRow& row);
/// Whether the step of a resolution is known from the column of what is divided alone, which may have half of it.
[[nodiscard]] bool is_step_of_column(const AuditedRow& row);
/// The standard uncertainty of what a row divides, by a divisor of its distribution: the same number that the rules on its
/// origin give, so that whoever corrects the row, and however many do, makes it the one right u. Of the words, where the
/// column has their number, or a slip of it beside ±; else of the column.
/// \return nothing where no columns say what is divided, or it is a part of something else
[[nodiscard]] std::optional<double> u_of_divided(const AuditedRow& row, double divisor);

/// A place as readers name it: "row 3" can be said in other languages, "Budget!D5" need not be.
[[nodiscard]] Sentence place_in_words(const std::string& place);
/// "row 3 (drift)": the place of a row, or its position where it has none, with its quantity.
[[nodiscard]] Sentence name_of_row(const AuditedBudget& budget, std::size_t row);

/// True where two numbers are the same but for a relative deviation.
[[nodiscard]] bool is_about(double a, double b, double tolerance = 0.01);

}  // namespace gumcert::audit
