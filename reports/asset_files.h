#pragma once

#include "reports/render.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace gumcert::reports {

/// The whole of a file of the product. \throws gum::StorageError if it cannot be read
[[nodiscard]] std::string read_asset(const std::filesystem::path& file);

/// The wording of the language that the assets ask for. \throws gum::StorageError if there is none
[[nodiscard]] nlohmann::json read_wording(const RenderAssets& assets);

}  // namespace gumcert::reports
