#pragma once

#include "workbook/evaluate.h"
#include "workbook/workbook.h"

namespace gumcert::audit {

/// A workbook with its formulas, as the rules of worksheets look at it.
struct AuditedWorkbook {
    workbook::Workbook workbook;
    workbook::Evaluation evaluation;  ///< of it
};

}  // namespace gumcert::audit
