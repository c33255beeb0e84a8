#include "reports/dcc/d_si_unit.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace gumcert::reports {

namespace {

using Name = std::pair<std::string_view, std::string_view>;  // D-SI, UDUNITS-2

constexpr std::array k_prefixes{
    Name{"deca", "da"}, Name{"hecto", "h"}, Name{"kilo", "k"},  Name{"mega", "M"},  Name{"giga", "G"},
    Name{"tera", "T"},  Name{"peta", "P"},  Name{"exa", "E"},   Name{"zetta", "Z"}, Name{"yotta", "Y"},
    Name{"deci", "d"},  Name{"centi", "c"}, Name{"milli", "m"}, Name{"micro", "u"}, Name{"nano", "n"},
    Name{"pico", "p"},  Name{"femto", "f"}, Name{"atto", "a"},  Name{"zepto", "z"}, Name{"yocto", "y"},
};

constexpr std::array k_units{
    Name{"metre", "m"},         Name{"kilogram", "kg"},  Name{"gram", "g"},           Name{"second", "s"},
    Name{"ampere", "A"},        Name{"kelvin", "K"},     Name{"mole", "mol"},         Name{"candela", "cd"},
    Name{"radian", "rad"},      Name{"steradian", "sr"}, Name{"hertz", "Hz"},         Name{"newton", "N"},
    Name{"pascal", "Pa"},       Name{"joule", "J"},      Name{"watt", "W"},           Name{"coulomb", "C"},
    Name{"volt", "V"},          Name{"farad", "F"},      Name{"ohm", "ohm"},          Name{"siemens", "S"},
    Name{"weber", "Wb"},        Name{"tesla", "T"},      Name{"henry", "H"},          Name{"degreecelsius", "degC"},
    Name{"lumen", "lm"},        Name{"lux", "lx"},       Name{"becquerel", "Bq"},     Name{"gray", "Gy"},
    Name{"sievert", "Sv"},      Name{"katal", "kat"},    Name{"minute", "min"},       Name{"hour", "h"},
    Name{"day", "d"},           Name{"degree", "deg"},   Name{"arcminute", "arcmin"}, Name{"arcsecond", "arcsec"},
    Name{"litre", "L"},         Name{"tonne", "t"},      Name{"electronvolt", "eV"},  Name{"bar", "bar"},
    Name{"percent", "percent"}, Name{"ppm", "ppm"},      Name{"decibel", "dB"},       Name{"hectare", "hectare"},
    Name{"one", "1"},
};

template <std::size_t size>
std::optional<std::string_view> look_up(const std::array<Name, size>& names, std::string_view name) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const Name& n) { return n.first == name; });
    return found == names.end() ? std::nullopt : std::optional(found->second);
}

/// Walks over "\kilo\gram\per\metre\tothe{3}".
class Tokens {
public:
    explicit Tokens(std::string_view text) : rest_(text) {}

    [[nodiscard]] bool empty() const { return rest_.empty(); }
    /// The word behind the next backslash; nothing where there is none.
    std::optional<std::string_view> word() {
        if (rest_.empty() || rest_.front() != '\\') {
            return std::nullopt;
        }
        std::size_t end = 1;
        while (end < rest_.size() && rest_[end] >= 'a' && rest_[end] <= 'z') {
            ++end;
        }
        const std::string_view found = rest_.substr(1, end - 1);
        rest_.remove_prefix(end);
        return found.empty() ? std::nullopt : std::optional(found);
    }
    [[nodiscard]] bool at_power() const { return rest_.starts_with(k_power); }
    /// A whole exponent in braces; nothing for any other.
    std::optional<int> power() {
        rest_.remove_prefix(k_power.size());
        const std::size_t end = rest_.find('}');
        if (end == std::string_view::npos) {
            return std::nullopt;
        }
        int value = 0;
        const char* const last = rest_.data() + end;
        const auto [stop, failure] = std::from_chars(rest_.data(), last, value);
        rest_.remove_prefix(end + 1);
        constexpr int k_largest = 99;
        return failure == std::errc() && stop == last && value >= -k_largest && value <= k_largest
                   ? std::optional(value)
                   : std::nullopt;
    }

private:
    static constexpr std::string_view k_power = "\\tothe{";
    std::string_view rest_;
};

}  // namespace

std::optional<std::string> unit_from_d_si(std::string_view text) {
    Tokens tokens(text);
    std::string result;
    int sign = 1;  // -1 behind \per, for the one unit that follows
    if (tokens.empty()) {
        return std::nullopt;
    }
    while (!tokens.empty()) {
        auto word = tokens.word();
        if (word == "per" && sign == 1) {
            sign = -1;
            continue;
        }
        const auto prefix = word ? look_up(k_prefixes, *word) : std::nullopt;
        if (prefix) {
            word = tokens.word();
        }
        const auto unit = word ? look_up(k_units, *word) : std::nullopt;
        if (!unit) {
            return std::nullopt;
        }
        int power = sign;
        sign = 1;
        if (tokens.at_power()) {
            const std::optional<int> stated = tokens.power();
            if (!stated) {
                return std::nullopt;
            }
            power *= *stated;
        }
        if (*unit == "1" && !prefix) {
            continue;  // a factor of one says nothing
        }
        result += (result.empty() ? "" : " ") + std::string(prefix.value_or("")) + std::string(*unit);
        result += power == 1 ? "" : std::to_string(power);
    }
    if (sign == -1) {
        return std::nullopt;  // \per without a unit behind it
    }
    return result.empty() ? "1" : result;
}

}  // namespace gumcert::reports
