#pragma once

#include <string_view>

#include "audit/audited_budget.h"
#include "audit/sentence.h"

namespace gumcert::audit {

/// What a constant of nature or of a material lies between, in SI units.
struct ConstantRange {
    Sentence kind;          ///< "thermal expansion of steel"
    std::string_view unit;  ///< coherent SI, as Unit reads it
    double low = 0.0, high = 0.0;
};

/// The range of the constant that a row stands for, by the words of its quantity, source and comment.
/// \return nullptr where the words name none
/// The ranges are wide: they hold every common grade of a material at ordinary temperatures, and are there to find slips
/// of a power of ten. They are common knowledge of handbooks (W. M. Haynes, CRC Handbook of Chemistry and Physics), not
/// reference values.
[[nodiscard]] const ConstantRange* constant_range(const AuditedRow& row);

}  // namespace gumcert::audit
