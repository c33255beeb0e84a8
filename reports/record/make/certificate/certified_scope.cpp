#include "reports/record/make/certificate/certified_scope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "certificate/capability.h"
#include "certificate/gates/held_against.h"
#include "certificate/result_names.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "reports/record/make/record_parts.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using certificate::ArgumentValue;
using certificate::CapabilityArgument;
using certificate::ScopeEntry;
using gum::Unit;

constexpr double k_same_probability = 0.01;  // 95 % and 95.45 % are both "about 95 %"
constexpr double k_range_noise = 1e-12;      // a limit of a range that a conversion of units has moved

const std::vector<std::optional<double>> k_no_values;

/// A value, or a sentence that says why there is none.
struct Found {
    std::optional<double> value;
    std::string why;
};

/// A value in another unit of the same kind.
Found converted(double value, const std::string& from, const std::string& to, const std::string& what) {
    const Unit source = Unit::parse(from);
    const Unit target = Unit::parse(to);
    if (!(source.dimension() == target.dimension()) ||
        source.is_celsius_temperature() != target.is_celsius_temperature()) {
        return {.value = {}, .why = what + " has the unit \"" + from + "\", and the scope states \"" + to + "\""};
    }
    return {.value = from == to ? value : target.from_si(source.to_si(value)), .why = {}};
}

/// Whether a line of the scope covers negative values of an argument, e.g. temperatures from −40 °C.
bool has_negative(const ScopeEntry& entry, const std::string& argument) {
    const auto of_argument = [&](const ScopeEntry::Range& r) { return r.argument.name == argument && r.low < 0.0; };
    if (std::any_of(entry.ranges.begin(), entry.ranges.end(), of_argument)) {
        return true;
    }
    const certificate::Capability& c = entry.capability;
    if (!c.arguments.empty() && c.arguments.front().name == argument) {
        return (!c.points.empty() && c.points.front().at < 0.0) || (!c.rows.empty() && c.rows.front() < 0.0);
    }
    return c.arguments.size() > 1 && c.arguments[1].name == argument && !c.columns.empty() && c.columns.front() < 0.0;
}

/// Value of an argument of a scope, in the unit that the scope states for it.
Found argument_of(const certificate::CertificateData& data, const ScopeEntry& entry, const ScopePlace& place,
                  const certificate::CapabilityInputs& inputs, const CapabilityArgument& argument) {
    const std::string what = "the argument \"" + argument.name + "\"";
    if (argument.of == "value") {
        const certificate::Measured measured =
            certificate::measured_at(place.table, place.column, place.row, Unit::parse(argument.unit));
        Found found = converted(measured.value, measured.unit, argument.unit, what);
        // A Celsius temperature has no magnitude: −30 °C is not the 30 °C of a scope.
        const bool signed_value = Unit::parse(argument.unit).is_celsius_temperature();
        if (found.value && !signed_value && !has_negative(entry, argument.name)) {
            found.value = std::abs(*found.value);
        }
        return found;
    }
    if (argument.of == "argument") {
        const auto& of_table = place.table.argument;
        if (!of_table || place.row >= of_table->values.size() || !of_table->values[place.row]) {
            return {.value = {}, .why = what + " is the argument of a table, and the result has none"};
        }
        return converted(*of_table->values[place.row], of_table->unit, argument.unit, what);
    }
    if (const auto input = inputs.values.find(argument.of); input != inputs.values.end()) {
        const std::vector<std::optional<double>>& values = input->second.values;
        const std::optional<double> value = values.size() == 1     ? values.front()
                                            : place.table.argument ? values.at(place.point)
                                                                   : input->second.without_point;
        return value ? converted(*value, input->second.unit, argument.unit, what)
                     : Found{.value = {},
                             .why = what + " comes from \"" + argument.of + "\", which this result does not rest on"};
    }
    const auto parameter = std::find_if(data.parameters.begin(), data.parameters.end(),
                                        [&](const certificate::Parameter& p) { return p.name == argument.of; });
    if (parameter != data.parameters.end()) {
        return converted(parameter->value, parameter->unit, argument.unit, what);
    }
    return {.value = {},
            .why = what + " comes from \"" + argument.of +
                   "\", which is neither an input of the budget nor one of the parameters of the certificate"};
}

std::string with_unit(double value, const std::string& unit) {
    const std::string shown = gum::unit_for_people(unit);
    return text::shortest_plain(value) + (shown.empty() ? "" : " " + shown);
}

std::string out_of_range(const ScopeEntry& entry, const ScopeEntry::Range& range, double at) {
    const double noise = k_range_noise * std::max(std::abs(range.low), std::abs(range.high));
    if (at >= range.low - noise && at <= range.high + noise) {
        return {};
    }
    return range.argument.name + " = " + with_unit(at, range.argument.unit) + " is not in " +
           with_unit(range.low, range.argument.unit) + " to " + with_unit(range.high, range.argument.unit) +
           " of the scope entry \"" + entry.id + "\"";
}

/// A single value that was found from all rows of the other tables (the set-up of a rotary table from all angles): each
/// of them has to be in range.
std::string all_rows_out_of_range(const ScopeEntry& entry, const ScopeEntry::Range& range, const ScopePlace& place) {
    bool any = false;
    for (const certificate::CertifiedTable& table : place.tables) {
        for (const std::optional<double>& at : table.argument ? table.argument->values : k_no_values) {
            if (!at) {
                continue;
            }
            any = true;
            const Found found = converted(*at, table.argument->unit, range.argument.unit, range.argument.name);
            std::string why = found.value ? out_of_range(entry, range, *found.value) : found.why;
            if (!why.empty()) {
                return why;
            }
        }
    }
    return any ? "" : "the argument \"" + range.argument.name + "\" is the argument of a table, and there is none";
}

/// "" where the value lies in every range.
std::string out_of_ranges(const certificate::CertificateData& data, const ScopeEntry& entry, const ScopePlace& place,
                          const certificate::CapabilityInputs& inputs) {
    for (const ScopeEntry::Range& range : entry.ranges) {
        std::string why;
        if (range.argument.of == "argument" && !place.table.argument) {
            why = all_rows_out_of_range(entry, range, place);
        } else {
            const Found at = argument_of(data, entry, place, inputs, range.argument);
            why = at.value ? out_of_range(entry, range, *at.value) : at.why;
        }
        if (!why.empty()) {
            return why;
        }
    }
    return {};
}

Found capability_of(const certificate::CertificateData& data, const ScopeEntry& entry, const ScopePlace& place,
                    const certificate::CapabilityInputs& inputs) {
    std::vector<ArgumentValue> arguments;
    for (const CapabilityArgument& argument : entry.capability.arguments) {
        const Found at = argument_of(data, entry, place, inputs, argument);
        if (!at.value) {
            return at;
        }
        arguments.push_back({.name = argument.name, .value = *at.value});
    }
    certificate::CapabilityAt at;
    try {
        at = certificate::capability_at(entry.capability, arguments);
    } catch (const gum::InputError& error) {
        const gum::Diagnostic& first = error.diagnostics().front();
        return {.value = {}, .why = "the capability of \"" + entry.id + "\" cannot be used: " + first.what};
    }
    if (!at.U) {
        return {.value = {}, .why = at.reason};
    }
    const Unit unit = Unit::parse(entry.capability.unit);
    const Unit column = Unit::parse(place.column.unit);
    if (!(unit.dimension() == column.dimension())) {
        return {.value = {},
                .why = "the capability has the unit \"" + entry.capability.unit + "\", and the result \"" +
                       place.column.unit + "\""};
    }
    double U =
        entry.capability.unit == place.column.unit ? *at.U : column.difference_from_si(unit.difference_to_si(*at.U));
    if (std::abs(place.coverage_probability - entry.capability.coverage_probability) > k_same_probability) {
        constexpr double k_normal = std::numeric_limits<double>::infinity();
        U *= gum::coverage_factor(place.coverage_probability, k_normal) /
             gum::coverage_factor(entry.capability.coverage_probability, k_normal);
    }
    return {.value = U, .why = {}};
}

/// "" where method and place are those of the entry.
std::string other_work(const certificate::CertificateData& data, const ScopeEntry& entry) {
    const auto has = [](const std::vector<std::string>& all, const std::string& one) {
        return std::find(all.begin(), all.end(), one) != all.end();
    };
    if (!entry.methods.empty() && !has(entry.methods, data.method.identification)) {
        return "the scope entry \"" + entry.id + "\" does not name the method \"" + data.method.identification + "\"";
    }
    const bool place = entry.places.empty() ? data.place.kind == "laboratory" : has(entry.places, data.place.kind);
    if (!place) {
        return "the scope entry \"" + entry.id + "\" does not cover work at the place \"" + data.place.kind + "\"";
    }
    return {};
}

ScopeAnswer answer_of(const certificate::CertificateData& data, const ScopeEntry& entry, const ScopePlace& place,
                      const certificate::CapabilityInputs& inputs) {
    std::string why = other_work(data, entry);
    if (why.empty()) {
        why = out_of_ranges(data, entry, place, inputs);
    }
    if (!why.empty()) {
        return {.entry = {}, .outside_because = why, .capability = {}};
    }
    Found capability = capability_of(data, entry, place, inputs);
    if (!capability.value) {
        return {.entry = {}, .outside_because = capability.why, .capability = {}};
    }
    return {.entry = entry.id, .outside_because = {}, .capability = capability.value};
}

}  // namespace

ScopeAnswer scope_of(const certificate::CertificateData& data, const ScopePlace& place,
                     const certificate::CapabilityInputs& inputs) {
    ScopeAnswer best;
    for (const ScopeEntry& entry : data.accreditation->scope) {
        if (!certificate::is_covered(entry.results, place.column.result)) {
            continue;
        }
        ScopeAnswer answer = answer_of(data, entry, place, inputs);
        const bool first = best.entry.empty() && best.outside_because.empty();
        const bool inside = !answer.entry.empty();
        if (first || (inside && (best.entry.empty() || *answer.capability > *best.capability))) {
            best = std::move(answer);
        }
    }
    if (best.entry.empty() && best.outside_because.empty()) {
        best.outside_because = "no entry of the scope names the result \"" + place.column.result + "\"";
    }
    return best;
}

}  // namespace gumcert::reports
