#pragma once

#include <string>
#include <string_view>

namespace gumcert::gum {

/// What to write for a name that is no unit, where people write it for one: "rpm" for "RPM", "N m" for "Nm"; "" where nothing is near.
/// The name alone is looked at, and stays refused: "MHZ" is nearer to MHz than to mHz only for people.
/// Example: unit_meant("RPM") is "Write rpm: capital letters tell units apart."
/// \param below_a_line  whether the name follows "/", where a product has to stand in brackets: "(N m)"
[[nodiscard]] std::string unit_meant(std::string_view name, bool below_a_line = false);

}  // namespace gumcert::gum
