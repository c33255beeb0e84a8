#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/finding.h"
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

// One error of a u that several rules see is corrected once: what multiplies u by a factor by which another correction has
// multiplied or set it already, within 1 %, changes nothing. Factors that differ are different errors, and multiply.
[[nodiscard]] Correction set_u(std::size_t row, double u);
/// Of a job that states u alone, what u should be made of says its distribution too, and k may rest on it. Tables of others
/// keep the shape that they state.
[[nodiscard]] Correction set_u_and_shape(std::size_t row, double u, Shape shape);
/// \param factor  > 0
[[nodiscard]] Correction scale_u(std::size_t row, double factor);
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

/// True where the u that a row uses is another number than it should be: further away than a relative deviation, the
/// digits of u, and what is left open of the expected number itself.
[[nodiscard]] bool u_differs(const AuditedRow& row, double expected, double relative = 0.01, double left_open = 0.0);

/// A place as readers name it: "row 3" can be said in other languages, "Budget!D5" need not be.
[[nodiscard]] Sentence place_in_words(const std::string& place);
/// "row 3 (drift)": the place of a row, or its position where it has none, with its quantity.
[[nodiscard]] Sentence name_of_row(const AuditedBudget& budget, std::size_t row);

/// True where two numbers are the same but for a relative deviation.
[[nodiscard]] bool is_about(double a, double b, double tolerance = 0.01);

}  // namespace gumcert::audit
