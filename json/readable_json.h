#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace gumcert::json {

/// A value as people write it: keys in their order, two blanks a level, and what fits into a line of 120 columns on one.
/// \param indent  blanks before the line on which the value begins
/// \param column  where on that line it begins
[[nodiscard]] std::string readable_json(const nlohmann::ordered_json& value, std::size_t indent = 0,
                                        std::size_t column = 0);

}  // namespace gumcert::json
