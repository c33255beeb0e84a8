#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace gumcert::reports {

/// A drawing (SVG, as reports/plots makes them) with the symbols in its texts as tables have them: letters in italics,
/// indices upright, smaller and below. A letter before " / " is the quantity of an axis, and U is the expanded uncertainty.
/// \param view  with the symbols of symbols_in(); without them single letters alone are set
[[nodiscard]] std::string typeset_drawing(const std::string& svg, const nlohmann::json& view);

/// The view with all of its drawings so.
[[nodiscard]] nlohmann::json with_typeset_drawings(nlohmann::json view);

}  // namespace gumcert::reports
