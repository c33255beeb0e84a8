#pragma once

#include <optional>
#include <string>

#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// A score of a result by its name in the record: "En", "zeta", "z", "z_prime", or "D" for the deviation itself.
/// \return no number and no text where the result has no such score
[[nodiscard]] Shown<std::optional<double>> score_of(const ComparisonPoint& point, const std::string& score);

}  // namespace gumcert::reports
