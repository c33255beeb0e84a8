#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace gumcert::gum {

/// Dimension of a quantity: exponents of the SI base units, of the radian and of the decibel, which count as base units
/// here so that an angle or a level is not mistaken for a bare number.
class Dimension {
public:
    static constexpr std::size_t k_base_units = 9;
    /// m, kg, s, A, K, mol, cd, rad, dB
    static const std::array<std::string_view, k_base_units> k_symbols;

    Dimension() = default;  ///< dimension one
    explicit Dimension(const std::array<double, k_base_units>& exponents) : exponents_(exponents) {}

    [[nodiscard]] static Dimension angle();
    [[nodiscard]] static Dimension temperature();
    [[nodiscard]] bool is_one() const;
    [[nodiscard]] double exponent(std::size_t base_unit) const { return exponents_[base_unit]; }
    /// As the coherent SI unit that UDUNITS-2 reads, e.g. "kg m s-2", "1"; exponents that are not whole as "m^0.5",
    /// which is for messages only.
    [[nodiscard]] std::string text() const;

    [[nodiscard]] Dimension operator*(const Dimension& other) const;
    [[nodiscard]] Dimension operator/(const Dimension& other) const;
    [[nodiscard]] Dimension power(double exponent) const;
    /// Equal within what rounding leaves of fractional exponents.
    friend bool operator==(const Dimension& a, const Dimension& b);

private:
    std::array<double, k_base_units> exponents_{};
};

/// Unit of measurement as UDUNITS-2 writes it: "um", "nm/K", "arcsec", "degC", "uohm", "1/K", "percent".
///
/// Values inside the engine are in the coherent SI unit of the dimension. A Celsius temperature (unit degC, degF) is
/// held as t = T − 273.15 K in kelvin: what people mean when they write a formula in t. It is another kind of quantity
/// than a thermodynamic temperature or a temperature difference (unit K, delta_degC), which the model checks.
class Unit {
public:
    Unit() = default;  ///< one

    /// \param text  UTF-8, at most 256 bytes
    /// \throws InputError    GC-UNIT-0001 not a unit, -0002 a logarithmic unit, -0003 a point in time, -0004 an origin
    ///                       of a scale other than of temperature, -0005 an exponent that is none, -0006 a number
    ///                       that does not stand at the beginning, -0007 a quotient that may be read in two ways
    [[nodiscard]] static Unit parse(std::string_view text);
    /// The coherent SI unit of a dimension.
    /// \param celsius  degC instead of K, where the dimension is a temperature
    [[nodiscard]] static Unit coherent(const Dimension& dimension, bool celsius = false);

    [[nodiscard]] const std::string& text() const { return text_; }
    [[nodiscard]] const Dimension& dimension() const { return dimension_; }
    [[nodiscard]] bool is_celsius_temperature() const { return celsius_; }

    /// A value in this unit → coherent SI, and back. Whole powers of ten are divided, not multiplied, so that decimal
    /// numbers keep their digits.
    [[nodiscard]] double to_si(double value) const { return difference_to_si(value) + offset_; }
    [[nodiscard]] double from_si(double value) const { return difference_from_si(value - offset_); }
    /// A difference, an uncertainty: without the origin of the scale.
    [[nodiscard]] double difference_to_si(double value) const {
        return divisor_ != 0.0 ? value / divisor_ : value * factor_;
    }
    [[nodiscard]] double difference_from_si(double value) const {
        return divisor_ != 0.0 ? value * divisor_ : value / factor_;
    }

private:
    std::string text_ = "1";
    Dimension dimension_;
    double factor_ = 1.0;   ///< SI units in one of this unit
    double divisor_ = 0.0;  ///< 1/factor where that is a whole number, else 0
    double offset_ = 0.0;
    bool celsius_ = false;
};

/// Whether a number in one unit can be stated in the other: the same dimension, and the origin of a temperature scale in
/// both of them or in neither. A number of °C has none in K: it would be read as a thermodynamic temperature.
[[nodiscard]] bool of_one_kind(const Unit& a, const Unit& b);

/// A unit as people write it: "um" → "µm", "degC" → "°C", "nm K-1" → "nm·K⁻¹", "1" → "".
[[nodiscard]] std::string unit_for_people(std::string_view text);

/// Unit of the uncertainty, the sensitivity's denominator or a difference: "degC" → "K", "degF" → "delta_degF".
[[nodiscard]] std::string unit_of_difference(std::string_view text);

/// A unit in the notation of D-SI 2: "um" → "\micro\metre", "nm/K" → "\nano\metre\kelvin\tothe{-1}", "1" → "\one".
/// \return nothing for a unit that D-SI has no name for
[[nodiscard]] std::optional<std::string> unit_in_d_si(std::string_view text);

}  // namespace gumcert::gum
