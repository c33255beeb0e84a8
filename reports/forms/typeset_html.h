#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace gumcert::reports {

/// HTML with symbols in italics and their indices below, and with the digits of long numbers in cells of class "number"
/// in groups of three. The gaps are drawn by the style (class "g"): who copies a number gets it without them. Head,
/// drawings, and what stands inside of tags are left alone.
/// \param view  with the symbols of symbols_in(); without them only numbers are set
[[nodiscard]] std::string typeset_html(const std::string& html, const nlohmann::json& view);

}  // namespace gumcert::reports
