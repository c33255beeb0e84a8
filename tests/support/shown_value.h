#pragma once

#include <string>

#include "workbook/evaluate.h"
#include "workbook/workbook.h"

namespace gumcert::test {

/// A value as a test writes it: shortest digits, texts in quotes, "not evaluated: …".
[[nodiscard]] inline std::string shown(const workbook::Evaluation& evaluation, const workbook::Workbook& of,
                                       const workbook::EvaluatedCell* cell) {
    using namespace workbook;
    if (cell == nullptr) {
        return "no formula";
    }
    if (cell->state == EvaluationState::not_evaluated) {
        return "not evaluated: " + why_not_evaluated(evaluation, of, *cell);
    }
    switch (cell->value.kind) {
        case CellKind::number:
            return std::to_string(cell->value.number);
        case CellKind::text:
            return "\"" + cell->value.text + "\"";
        case CellKind::boolean:
            return cell->value.number != 0.0 ? "TRUE" : "FALSE";
        case CellKind::error:
            return std::string(error_text(cell->value.error));
        case CellKind::blank:
            break;
    }
    return "blank";
}

}  // namespace gumcert::test
