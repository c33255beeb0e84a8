#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gum/quantity/unit.h"
#include "reports/dcc/d_si_unit.h"
#include "tests/fuzz/demand.h"

namespace gumcert::fuzz {
namespace {

/// A text from bytes: as it stands, or, where the first byte is above 127, words of D-SI one behind the other.
std::string d_si_text(std::string_view bytes) {
    static constexpr std::array<std::string_view, 56> k_words{
        "\\metre",       "\\kilogram", "\\gram",      "\\second",      "\\ampere",    "\\kelvin",   "\\mole",
        "\\radian",      "\\hertz",    "\\volt",      "\\ohm",         "\\pascal",    "\\newton",   "\\joule",
        "\\watt",        "\\degree",   "\\arcminute", "\\arcsecond",   "\\minute",    "\\hour",     "\\day",
        "\\litre",       "\\tonne",    "\\percent",   "\\ppm",         "\\decibel",   "\\one",      "\\degreecelsius",
        "\\kilo",        "\\milli",    "\\micro",     "\\nano",        "\\mega",      "\\deca",     "\\femto",
        "\\centi",       "\\yotta",    "\\per",       "\\per",         "\\per",       "\\tothe{2}", "\\tothe{-1}",
        "\\tothe{0.5}",  "\\tothe{3}", "\\tothe{99}", "\\tothe{-0.2}", "\\tothe{0}",  "\\neper",    "\\dalton",
        "\\tothe{0.12}", "|",          " ",           "\\hectare",     "\\steradian", "\\candela",  "\\bar"};
    if (bytes.empty() || static_cast<unsigned char>(bytes.front()) < 0x80U) {
        return std::string(bytes);
    }
    std::string text;
    for (const char c : bytes.substr(1)) {
        text += k_words[static_cast<unsigned char>(c) % k_words.size()];
    }
    return text;
}

void read_unit(const std::string& text) {
    const std::optional<std::string> unit = reports::unit_from_d_si(text);
    if (!unit) {
        (void)reports::is_d_si(text);
        return;
    }
    // A foreign certificate may begin with the denominator, which says what it means and breaks a rule.
    demand(reports::is_d_si(text) || text.starts_with("\\per"), "a unit that is not of D-SI");
    const gum::Unit read = gum::Unit::parse(*unit);
    const std::optional<std::string> written = gum::unit_in_d_si(*unit);
    if (!written) {
        return;
    }
    demand(reports::is_d_si(*written), "a unit is written in words that D-SI does not have");
    const std::optional<std::string> again = reports::unit_from_d_si(*written);
    demand(again.has_value(), "a unit that was written is not read");
    const gum::Unit second = gum::Unit::parse(*again);
    const double ratio = second.difference_to_si(1.0) / read.difference_to_si(1.0);
    constexpr double k_rounding = 1e-11;  // of hundreds of factors
    demand(second.dimension() == read.dimension() && second.is_celsius_temperature() == read.is_celsius_temperature() &&
               std::abs(ratio - 1.0) < k_rounding,
           "another unit comes back");
}

}  // namespace
}  // namespace gumcert::fuzz

/// Any text is no unit of D-SI, or one that the program knows, writes again and reads as the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gumcert::fuzz::read_unit(gumcert::fuzz::d_si_text({reinterpret_cast<const char*>(data), size}));
    return 0;
}
