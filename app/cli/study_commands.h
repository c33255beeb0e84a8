#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// `gumcert simulate`
[[nodiscard]] ExitCode simulate(const std::filesystem::path& job, std::optional<std::size_t> runs,
                                std::optional<std::int64_t> seed, const std::string& output, const std::string& share,
                                const CommonOptions& common);

/// `gumcert plan`
[[nodiscard]] ExitCode plan(const std::filesystem::path& job, const std::string& output, const std::string& share,
                            const CommonOptions& common);

}  // namespace gumcert::cli
