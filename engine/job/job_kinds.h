#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/job/file_source.h"
#include "engine/job/job_kind.h"

namespace gumcert::engine {

// The words that `kind` of a job may be. Each one has a reader of its own.
inline constexpr std::string_view k_budget_kind = "budget";
inline constexpr std::string_view k_rotary_table_kind = "rotary_table";
inline constexpr std::string_view k_circle_closure_kind = "circle_closure";
inline constexpr std::string_view k_comparison_kind = "comparison";
inline constexpr std::array<std::string_view, 4> k_job_kinds{k_budget_kind, k_rotary_table_kind, k_circle_closure_kind,
                                                             k_comparison_kind};

// As the functions of the same names in engine/job/job_kind.h, which take the words above, for other kinds.

[[nodiscard]] std::string job_kind(const FileSource& source, const std::string& job_file,
                                   std::span<const std::string_view> kinds);
[[nodiscard]] std::optional<std::string> read_kind(const gumcert::json::JsonDocument& document, ProblemList& problems,
                                                   std::span<const std::string_view> kinds);
[[nodiscard]] std::optional<std::string> probable_job_kind(const FileSource& source, const std::string& job_file,
                                                           std::span<const std::string_view> kinds);

}  // namespace gumcert::engine
