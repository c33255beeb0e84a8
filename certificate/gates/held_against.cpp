#include "certificate/gates/held_against.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "certificate/capability.h"
#include "gum/argument_check.h"
#include "gum/quantity/diagnostic.h"
#include "text/numbers.h"

namespace gumcert::certificate {

using gum::Unit;

bool has_sign(const Unit& unit, double low) {
    // Scopes state magnitudes, "up to 1000 V"; the sign of a temperature in degrees Celsius is part of the place on its
    // scale, and so is that of a level in a range from -70 dB.
    return unit.is_celsius_temperature() || low < 0.0;
}

double value_for_scope(double value, const Unit& of, const Unit& unit, double low) {
    const double in_unit = unit.from_si(of.to_si(value));
    return has_sign(unit, low) ? in_unit : std::abs(in_unit);
}

namespace {

/// Roles of columns at whose values an error is measured, the one that says it best first.
constexpr std::array<std::string_view, 5> k_places{"nominal", "setting", "reference", "indication", "measured_value"};

constexpr double k_a_little = 0.01;         // of a range
constexpr double k_same_capability = 0.02;  // what two digits of U do not show

/// Values of the other arguments of a capability, so far as the scope states them: nodes of a matrix, ends of ranges.
std::vector<std::vector<ArgumentValue>> places_of_others(const ScopeEntry& entry, const std::string& argument) {
    const Capability& capability = entry.capability;
    std::vector<std::vector<ArgumentValue>> places = {{}};
    for (std::size_t a = 0; a < capability.arguments.size(); ++a) {
        const CapabilityArgument& other = capability.arguments[a];
        if (other.name == argument) {
            continue;
        }
        std::vector<double> values;
        if (capability.form == "matrix") {
            values = a == 0 ? capability.rows : capability.columns;
        } else {
            for (const ScopeEntry::Range& range : entry.ranges) {
                if (range.argument.name == other.name && range.argument.unit == other.unit) {
                    values = {range.low, range.high};
                }
            }
        }
        std::vector<std::vector<ArgumentValue>> more;
        for (const std::vector<ArgumentValue>& place : places) {
            for (const double value : values) {
                more.push_back(place);
                more.back().push_back({.name = other.name, .value = value});
            }
        }
        places = std::move(more);
    }
    return places;
}

/// Whether a scope allows at one value of an argument, but for what two digits do not show, no less than at another: of 0.49 °C and 0 °C the
/// number is another one, and the capability the same.
bool allows_no_less(const ScopeEntry& entry, const std::string& argument, double claimed, double value) {
    try {
        const CapabilityEvaluator evaluator(entry.capability);
        const auto at = [&](std::vector<ArgumentValue> place, double own) {
            place.push_back({.name = argument, .value = own});
            return evaluator.at(place).U;
        };
        const std::vector<std::vector<ArgumentValue>> places = places_of_others(entry, argument);
        return !places.empty() && std::all_of(places.begin(), places.end(), [&](const auto& place) {
            const std::optional<double> there = at(place, claimed), here = at(place, value);
            return there && here && *here <= *there * (1.0 + k_same_capability);
        });
    } catch (const gum::InputError&) {
        return false;  // a finding of its own
    }
}

/// The column of a result as its table shows it; nullptr where it is not shown, or is no error, deviation or correction.
const ShownColumn* error_column(const CertifiedTable& table, const std::string& result) {
    if (!table.layout) {
        return nullptr;
    }
    const auto& shown = table.layout->shown;
    const auto found = std::find_if(shown.begin(), shown.end(), [&](const ShownColumn& one) {
        return one.show == "value" && one.of == result && is_role_of_difference(one.role);
    });
    return found == shown.end() ? nullptr : &*found;
}

}  // namespace

Measured measured_at(const CertifiedTable& table, const CertifiedColumn& column, std::size_t row, const Unit& unit) {
    // An error of 2 µV at 10 V was measured at 10 V: held against the range by its own value it would be at the lower
    // end of every scope.
    if (const ShownColumn* error = error_column(table, column.result)) {
        for (const std::string_view role : k_places) {
            for (const PointColumn& place : table.layout->columns) {
                if (place.role != role || (!place.stage.empty() && place.stage != error->stage) ||
                    row >= place.values.size() || !place.values[row] || !of_one_kind(Unit::parse(place.unit), unit)) {
                    continue;
                }
                const std::string shown =
                    row < place.printed.size() ? place.printed[row] : text::shortest(*place.values[row]);
                return {{.name = place.name, .value = *place.values[row], .unit = place.unit},
                        "the result \"" + column.result + "\" was measured at \"" + place.name + "\" = " + shown + " " +
                            place.unit,
                        true};
            }
        }
    }
    const CertifiedValue& value = column.values[row];
    return {{.name = column.result, .value = value.value, .unit = column.unit},
            "the result \"" + column.result + "\" is " + value.printed_value + " " + column.unit,
            false};
}

bool is_nominal_of(double claimed, double value) {
    // The true value of an item is near its nominal value, but is never the same number.
    constexpr double k_same = 0.1;
    return std::abs(value - claimed) <= k_same * std::max(std::abs(value), std::abs(claimed));
}

bool is_nominal_in(double claimed, double value, double low, double high) {
    // Near 0 nothing is a tenth of anything: 0.49 °C was measured at the ice point.
    return is_nominal_of(claimed, value) || std::abs(value - claimed) <= k_a_little * (high - low);
}

bool is_beyond(double value, double low, double high) {
    // An item whose nominal value is the end of the range may measure a little more.
    const double little = k_a_little * (high - low);
    return value > high + little || value < low - little;
}

std::string action_of_range(const Measured& measured) {
    return measured.is_place
               ? "Hold the range against the result (\"of\": \"value\"), or state the true parameter."
               : "Where the result is an error, a deviation, a correction or a hysteresis, state its role in the "
                 "outputs of the job, and at least one point (\"points\"): it is then held against the place where it "
                 "was measured. Else hold the range against the result (\"of\": \"value\"), or state the true "
                 "parameter.";
}

std::optional<Finding> capability_taken_elsewhere(const ScopeEntry& entry, std::size_t i,
                                                  const CapabilityArgument& argument, const HeldAgainst& held,
                                                  const Measured& measured) {
    const Unit unit = Unit::parse(argument.unit);
    const Unit result = Unit::parse(measured.unit);
    const Unit stated = Unit::parse(held.unit);
    if (!of_one_kind(result, unit) || !of_one_kind(stated, unit)) {
        return std::nullopt;
    }
    const double value = value_for_scope(measured.value, result, unit, 0.0);
    const double claimed = value_for_scope(held.value, stated, unit, 0.0);
    if (is_nominal_of(claimed, value)) {
        return std::nullopt;
    }
    // A capability mostly grows with the quantity: taken at a smaller number it would allow a smaller U than the scope
    // does.
    const bool larger = std::abs(value) > std::abs(claimed);
    if (larger && allows_no_less(entry, argument.name, unit.from_si(stated.to_si(held.value)),
                                 unit.from_si(result.to_si(measured.value)))) {
        return std::nullopt;
    }
    return Finding{
        .id = "X12",
        .clause = "ILAC-P14:09/2020",
        .severity = larger ? FindingSeverity::critical : FindingSeverity::minor,
        .where = place_in("/accreditation/scope", i, "capability"),
        .what = "the capability of \"" + entry.id + "\" is taken at \"" + held.name +
                "\" = " + text::shortest(held.value) + " " + held.unit + ", and " + measured.in_words,
        .action =
            measured.is_place
                ? "Take the capability at the result (\"of\": \"value\"), or state the true parameter."
                : "Where the result is an error, a deviation, a correction or a hysteresis, state its role in the "
                  "outputs of the job (\"role\": \"error\" or \"deviation\"), and at least one point "
                  "(\"points\"): it is then held against the place where it was measured. Else take the "
                  "capability at the result (\"of\": \"value\"), or state the true parameter."};
}

}  // namespace gumcert::certificate
