#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

// The words that `kind` of a record may be: those of its job.
inline constexpr std::string_view k_budget_kind = "budget";
inline constexpr std::string_view k_rotary_table_kind = "rotary_table";
inline constexpr std::string_view k_circle_closure_kind = "circle_closure";
inline constexpr std::string_view k_comparison_kind = "comparison";
inline constexpr std::array<std::string_view, 4> k_record_kinds{k_budget_kind, k_rotary_table_kind,
                                                                k_circle_closure_kind, k_comparison_kind};

/// As record_from_json() of the words above, for records of other kinds.
[[nodiscard]] EvaluationRecord record_from_json(const std::string& text, const std::string& where,
                                                std::span<const std::string_view> kinds);

}  // namespace gumcert::reports
