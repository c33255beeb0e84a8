#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/support/xlsx_file.h"
#include "workbook/cell_graph.h"
#include "workbook/evaluate.h"
#include "workbook/formula_text.h"
#include "workbook/limits.h"
#include "workbook/read_csv.h"
#include "workbook/read_xlsx.h"

namespace gumcert::test {

inline void expect_of_workbook(bool holds, const char* what) {
    if (!holds) {
        throw std::logic_error(what);
    }
}

/// What must hold of any workbook that was read: cells in order, each formula with one result or one reason.
inline void examine_workbook(const workbook::Workbook& read) {
    using namespace workbook;
    std::size_t formulas = 0;
    for (const Sheet& sheet : read.sheets) {
        for (std::size_t i = 0; i < sheet.cells.size(); ++i) {
            expect_of_workbook(i == 0 || sheet.cells[i - 1].address < sheet.cells[i].address, "cells out of order");
            expect_of_workbook(sheet.cells[i].number_format < read.number_formats.size(), "a format that there is not");
            expect_of_workbook(std::isfinite(sheet.cells[i].value.number), "a number that is not finite");
            formulas += sheet.cells[i].formula.empty() ? 0U : 1U;
        }
    }
    const Evaluation evaluation = evaluate_workbook(read, {.most_steps = 100'000});
    expect_of_workbook(evaluation.cells.size() == formulas, "a formula without a result");
    const CellGraph graph(read, 100'000);
    for (const EvaluatedCell& cell : evaluation.cells) {
        const bool is_evaluated = cell.state != EvaluationState::not_evaluated;
        expect_of_workbook(is_evaluated == (cell.value.kind != CellKind::blank),
                           "a result without a value, or a value without one");
        expect_of_workbook(is_evaluated || !why_not_evaluated(evaluation, read, cell).empty(), "no reason");
        expect_of_workbook(std::isfinite(cell.value.number), "a result that is not finite");
    }
    static_cast<void>(graph.unread_cells());
}

/// \param bytes  an .xlsx file; or, behind "=== name" on a line of its own, the text of each part of one
/// \return whether it is read
inline bool read_any_xlsx(std::string_view bytes) {
    std::string file(bytes);
    if (bytes.starts_with("=== ")) {
        Parts parts;
        for (std::size_t at = 0; at < bytes.size();) {
            const std::size_t end = std::min(bytes.find("\n=== ", at), bytes.size());
            const std::string_view part = bytes.substr(at, end - at);
            const std::size_t line = std::min(part.find('\n'), part.size());
            const std::size_t begin = std::min<std::size_t>(4, line);
            parts.emplace_back(part.substr(begin, line - begin), part.substr(std::min(line + 1, part.size())));
            at = end + 1;
        }
        file = archive_of(parts);
    }
    try {
        examine_workbook(workbook::read_xlsx(file, "file.xlsx"));
        return true;
    } catch (const gum::InputError&) {
        return false;
    }
}

/// A formula means the same after it was printed and copied to its own cell; its value is found, or why there is none.
inline bool read_any_formula(std::string_view text) {
    using namespace workbook;
    try {
        const Formula formula = parse_formula(text, "B2");
        expect_of_workbook(copied_formula(text, formula, {2, 2}, {2, 2}).size() >= text.size() / 8,
                           "a copy that lost its text");
        static_cast<void>(r1c1_text(formula, {2, 2}));
        static_cast<void>(literal_numbers(formula));
        Workbook made;
        made.sheets.emplace_back().name = "Sheet1";
        made.defined_names = {{.name = "u_ref", .formula = "Sheet1!$A$1", .sheet = {}}};
        for (std::uint32_t row = 1; row <= 3; ++row) {
            Cell cell;
            cell.address = {row, 1};
            cell.value = {.kind = row == 3 ? CellKind::text : CellKind::number,
                          .number = row == 3 ? 0.0 : 0.5 * row,
                          .text = "x"};
            made.sheets[0].cells.push_back(cell);
        }
        Cell cell;
        cell.address = {5, 2};
        cell.formula = std::string(text);
        made.sheets[0].cells.push_back(cell);
        examine_workbook(made);
        const std::string printed = print_formula(formula);
        if (printed.size() <= k_longest_formula) {
            expect_of_workbook(same_formula(formula, parse_formula(printed, "")),
                               "a printed formula that means something else");
        }
        return true;
    } catch (const gum::InputError&) {
        return false;
    }
}

inline bool read_any_csv(std::string_view text) {
    try {
        examine_workbook(workbook::read_csv(text, "file.csv", "file"));
        return true;
    } catch (const gum::InputError&) {
        return false;
    }
}

}  // namespace gumcert::test
