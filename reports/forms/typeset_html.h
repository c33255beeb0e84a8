#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace gumcert::reports {

/// HTML with symbols in italics and their indices below. Head, drawings, and what stands inside of tags are left alone.
/// Numbers stay in one piece, so that a person or a program that searches the page finds them; the PDF draws gaps between
/// groups of digits.
/// \param view  with the symbols of symbols_in(); without them nothing is set
[[nodiscard]] std::string typeset_html(const std::string& html, const nlohmann::json& view);

}  // namespace gumcert::reports
