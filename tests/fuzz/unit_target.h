#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "tests/support/unit_oracle.h"

namespace gumcert::test {

/// A text from bytes: as it stands, or, where the first byte is above 127, words that make units put one behind the
/// other, so that a search finds long ones.
inline std::string unit_text(std::string_view bytes) {
    if (bytes.empty() || static_cast<unsigned char>(bytes.front()) < 0x80U) {
        return std::string(bytes);
    }
    static const std::vector<std::string> words{
        "m",   "s",    "kg",  "V",    "Hz",     "K",     "degC", "degF", "um",  "nV",    "uohm",   "arcsec", "deg",
        "ft",  "in",   "psi", "mmHg", "eV",     "gon",   "rpm",  "dB",   "%",   "ppm",   "L",      "h",      "min",
        "mol", "inch", "lbf", "kilo", "milli",  "metre", "volt", "k",    "m",   "u",     "µ",      "da",     "°",
        "°C",  "Ω",    "t",   "kt",   "cal_th", "g_n",   "Oe",   "1",    "2",   "3",     "0",      "10",     "12",
        "99",  "e",    "E",   "-",    "+",      ".",     ".",    "*",    "*",   "/",     "/",      "/",      " ",
        " ",   " ",    " ",   "(",    "(",      ")",     ")",    "^",    "^",   "^(",    "/2)",    "/3)",    "**",
        "·",   "⋅",    "²",   "⁻¹",   "⁻",      "³",     "1e-6", "100",  "0.5", "10^-6", "^(1/2)", "^-1",    "2",
        "-1",  "-2",   "^2",  ",",    "_",      "x",     "@",    "from", "1.5", "5"};
    std::string text;
    for (const char c : bytes.substr(1)) {
        text += words[static_cast<unsigned char>(c) % words.size()];
    }
    return text;
}

/// "" where both readers say the same of a text, else what they differ in.
inline std::string difference_of_readers(const UnitOracle& oracle, const std::string& text) {
    const std::optional<UnitOracle::Meaning> expected = oracle.read(text);
    try {
        const gum::Unit unit = gum::Unit::parse(text);
        if (!expected) {
            return "only the program reads it";
        }
        if (unit.is_celsius_temperature() != expected->celsius) {
            return "the kind of temperature";
        }
        constexpr double k_rounding = 1e-11;  // of 256 factors to the power of 99, relative
        const double size = unit.difference_to_si(1.0);
        if (!(std::abs(std::log2(size) - expected->log2_size) <
              k_rounding * std::max(1.0, std::abs(expected->log2_size)))) {
            return "the size: 2^" + std::to_string(std::log2(size)) + ", expected 2^" +
                   std::to_string(expected->log2_size);
        }
        if (std::abs(unit.to_si(0.0) - expected->zero) > 1e-12) {
            return "the zero of the scale";
        }
        for (std::size_t i = 0; i < expected->exponents.size(); ++i) {
            if (std::abs(unit.dimension().exponent(i) - expected->exponents[i]) > 1e-9) {
                return "the exponent of " + std::string(gum::Dimension::k_symbols[i]);
            }
        }
        if (unit.text() != (text.empty() ? "1" : text)) {
            return "the text";
        }
        // What is printed never fails, and the coherent unit reads back where its exponents are those of units.
        (void)gum::unit_for_people(text);
        (void)gum::unit_in_d_si(text);
        if (unit.is_celsius_temperature()) {
            const gum::Unit difference = gum::Unit::parse(gum::unit_of_difference(text));
            if (difference.is_celsius_temperature() || difference.difference_to_si(1.0) != size) {
                return "the unit of a difference";
            }
        }
    } catch (const gum::InputError& error) {
        constexpr double k_limit = 830.0;
        // What may mean two things, "Gs" and "° K" among them, the second reader takes for the one that its table gives.
        const bool is_ambiguous = error.diagnostics().front().what.find(" may be ") != std::string::npos;
        if (expected && !is_ambiguous && std::abs(std::abs(expected->log2_size) - k_limit) > 1e-6) {
            return "only the second reader reads it";
        }
    }
    return {};
}

}  // namespace gumcert::test
