#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "workbook/workbook.h"

namespace gumcert::workbook {

/// evaluated: computed here. volatile_value: it holds a function that gives another value each time (NOW, RAND) or reads a
/// cell that does; that function's cell has its stored value, and what reads it is computed. Without a stored value NOW and
/// TODAY are the day on which the file was stored, where it says so. not_evaluated: see the reason.
enum class EvaluationState : std::uint8_t { evaluated, volatile_value, not_evaluated };

/// Of the value that was computed with the value that the file stored.
enum class Agreement : std::uint8_t {
    agrees,
    differs,
    nothing_stored,  ///< the file was stored by a program that does not compute
    not_compared     ///< not evaluated, or the stored value itself
};

struct EvaluatedCell {
    std::size_t sheet = 0, cell = 0;  ///< places in Workbook::sheets and Sheet::cells
    CellValue value{};                ///< blank where it is not evaluated
    EvaluationState state = EvaluationState::evaluated;
    Agreement agreement = Agreement::not_compared;
    std::uint32_t reason = 0;  ///< place in Evaluation::reasons, where it is not evaluated
};

/// Why cells are not evaluated: one that has the reason itself, and all that read it.
struct NotEvaluated {
    std::string what;  ///< a function, "OFFSET", or words, "a circular reference"
    std::size_t sheet = 0, cell = 0;
};

struct EvaluationOptions {
    double relative_tolerance = 1e-9;      ///< up to which a computed number agrees with a stored one
    std::size_t most_steps = 100'000'000;  ///< cells that formulas read and operations that they take, all together
};

struct Evaluation {
    std::vector<EvaluatedCell> cells;  ///< those with formulas, sheet by sheet, row by row
    std::vector<NotEvaluated> reasons;
};

/// Computes the formulas of a workbook, each once, in the order that their references ask for.
///
/// Arithmetic, comparison and functions are those of spreadsheets: text in a range is left out by SUM and its like and is
/// #VALUE! in arithmetic, a blank cell is 0, errors go on to what reads them, dates are days. Functions are looked up by
/// their English names, as files store them; which ones are computed is told by is_evaluated_function(). What is not
/// computed is named, and so is everything that reads it: other functions, other workbooks, references that depend on values
/// (OFFSET), array formulas over several cells, circular references, tables, text that only a language tells to be a number.
/// A difference that is all rounding counts as 0 where it is the last operation of a formula, as spreadsheets do it.
/// Accuracy: functions of distributions by Boost.Math; standard deviations in two passes. Stored values of spreadsheets
/// agree to 1e-9.
[[nodiscard]] Evaluation evaluate_workbook(const Workbook& workbook, const EvaluationOptions& options = {});

/// Whether a function is computed here.
/// \param name  in capitals, without `_xlfn.`
[[nodiscard]] bool is_evaluated_function(const std::string& name);

/// The entry of a cell; nullptr where it holds no formula.
[[nodiscard]] const EvaluatedCell* find_evaluated(const Evaluation& evaluation, const Workbook& workbook,
                                                  std::size_t sheet, const CellAddress& address);

/// "OFFSET in Budget!C3", or "OFFSET" where the cell has the reason itself.
/// \param cell  one that is not evaluated
[[nodiscard]] std::string why_not_evaluated(const Evaluation& evaluation, const Workbook& workbook,
                                            const EvaluatedCell& cell);

}  // namespace gumcert::workbook
