#include "reports/record/make/certificate/certified_scope.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "certificate/capability.h"
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

/// What was measured where a result stands, of the kind of a unit.
certificate::HeldAgainst measured_of(const ScopePlace& place, const Unit& unit) {
    return place.assumed ? *place.assumed : certificate::measured_at(place.table, place.column, place.row, unit);
}

/// Value of an argument of a scope, in the unit that the scope states for it.
Found argument_of(const certificate::CertificateData& data, const ScopeEntry& entry, const ScopePlace& place,
                  const certificate::CapabilityInputs& inputs, const CapabilityArgument& argument) {
    const std::string what = "the argument \"" + argument.name + "\"";
    if (argument.of == "value") {
        const certificate::HeldAgainst measured = measured_of(place, Unit::parse(argument.unit));
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

/// Why a value is not in the scope, and how far.
struct Outside {
    std::string why;  ///< "": it is
    double by = 0.0;  ///< as ScopeAnswer::outside_by
};

Outside out_of_range(const ScopeEntry& entry, const ScopeEntry::Range& range, double at) {
    const double farther = std::max(std::abs(range.low), std::abs(range.high));
    const double noise = k_range_noise * farther;
    if (at >= range.low - noise && at <= range.high + noise) {
        return {};
    }
    const std::string why = range.argument.name + " = " + with_unit(at, range.argument.unit) + " is not in " +
                            with_unit(range.low, range.argument.unit) + " to " +
                            with_unit(range.high, range.argument.unit) + " of the scope entry \"" + entry.id + "\"";
    return {why, farther > 0.0 ? std::max(at - range.high, range.low - at) / farther : 0.0};
}

/// A single value that was found from all rows of the other tables (the set-up of a rotary table from all angles): each
/// of them has to be in range.
Outside all_rows_out_of_range(const ScopeEntry& entry, const ScopeEntry::Range& range, const ScopePlace& place) {
    bool any = false;
    for (const certificate::CertifiedTable& table : place.tables) {
        for (const std::optional<double>& at : table.argument ? table.argument->values : k_no_values) {
            if (!at) {
                continue;
            }
            any = true;
            const Found found = converted(*at, table.argument->unit, range.argument.unit, range.argument.name);
            Outside outside = found.value ? out_of_range(entry, range, *found.value) : Outside{found.why};
            if (!outside.why.empty()) {
                return outside;
            }
        }
    }
    return any ? Outside()
               : Outside{"the argument \"" + range.argument.name + "\" is the argument of a table, and there is none"};
}

/// Of the first range in which a value does not lie.
Outside out_of_ranges(const certificate::CertificateData& data, const ScopeEntry& entry, const ScopePlace& place,
                      const certificate::CapabilityInputs& inputs) {
    for (const ScopeEntry::Range& range : entry.ranges) {
        Outside outside;
        if (range.argument.of == "argument" && !place.table.argument) {
            outside = all_rows_out_of_range(entry, range, place);
        } else {
            const Found at = argument_of(data, entry, place, inputs, range.argument);
            outside = at.value ? out_of_range(entry, range, *at.value) : Outside{at.why};
        }
        if (!outside.why.empty()) {
            return outside;
        }
    }
    return {};
}

/// The role of a result in its table; "" where the job states none.
std::string role_of(const ScopePlace& place) {
    const certificate::ShownColumn* const shown = certificate::column_of_values(place.table, place.column.result);
    return shown == nullptr ? std::string() : shown->role;
}

/// Whether the job says by its role that a result is the quantity itself.
bool is_quantity_by_role(const ScopePlace& place) {
    const std::string role = role_of(place);
    return !role.empty() && !certificate::is_role_of_difference(role);
}

/// An input beside which a result is small.
struct InputBeside {
    certificate::HeldAgainst input;
    double size = 0.0;       ///< in the unit of the result
    bool is_stated = false;  ///< the result does not rest on it: it may be its nominal value
};

/// What a result may be an error of: the largest input of its kind beside which it is small. Of several that are equal but
/// for such errors the one that is stated only, else the first by its name: at all points the same.
/// \param small  the result is less than this share of what the input makes of it
std::optional<certificate::HeldAgainst> input_beside(const ScopePlace& place,
                                                     const certificate::CapabilityInputs& inputs, double small) {
    const Unit column = Unit::parse(place.column.unit);
    const double value = std::abs(place.column.values[place.row].value);
    const auto of_result = inputs.sensitivities.find(place.result);
    std::vector<InputBeside> beside;
    for (const auto& [name, input] : inputs.values) {
        const Unit unit = Unit::parse(input.unit);
        const bool has_point = place.table.argument && input.values.size() > 1;
        const std::optional<double> at = input.values.size() == 1 ? input.values.front()
                                         : has_point              ? input.values.at(place.point)
                                                                  : input.without_point;
        // A column "range" says what the item was set to.
        if (name == "range" || !at || !gum::of_one_kind(unit, column)) {
            continue;
        }
        const double size = std::abs(column.from_si(unit.to_si(*at)));
        const double* c = nullptr;
        if (of_result != inputs.sensitivities.end()) {
            const auto coefficient = of_result->second.find(name);
            c = coefficient == of_result->second.end() ? nullptr : &coefficient->second;
        }
        if (value < small * (c != nullptr ? std::abs(*c) * size : size)) {
            beside.push_back({.input = {.name = name, .value = *at, .unit = input.unit},
                              .size = size,
                              .is_stated = c == nullptr && of_result != inputs.sensitivities.end()});
        }
    }
    if (beside.empty()) {
        return std::nullopt;
    }
    constexpr double k_equal = 0.9;
    const double largest = std::ranges::max_element(beside, {}, &InputBeside::size)->size;
    std::erase_if(beside, [&](const InputBeside& one) { return one.size < k_equal * largest; });
    return std::ranges::max_element(beside, {}, &InputBeside::is_stated)->input;
}

/// Whether the job says at which value a result was measured: the result itself, or another one beside it.
bool is_place_known(const ScopePlace& place) {
    return place.assumed ||
           certificate::measured_at(place.table, place.column, place.row, Unit::parse(place.column.unit)).is_place ||
           is_quantity_by_role(place);
}

/// Why a capability is no share of the result itself: small beside an input of its kind it may be an error of it, unless
/// its role says otherwise, and a share of an error would be far less than the scope states. "": it is one.
std::string no_share_of_result(const ScopeEntry& entry, const ScopePlace& place,
                               const certificate::CapabilityInputs& inputs) {
    constexpr double k_small = 0.1;
    const auto beside = is_place_known(place) ? std::nullopt : input_beside(place, inputs, k_small);
    return beside ? "the capability of \"" + entry.id + "\" is a share, and a result that is small beside \"" +
                        beside->name + "\" may be an error of it"
                  : "";
}

/// The quantity of which a capability in % or ppm is a share, in the unit of the result.
Found whole_of_share(const certificate::CertificateData& data, const ScopeEntry& entry, const ScopePlace& place,
                     const certificate::CapabilityInputs& inputs) {
    const Unit column = Unit::parse(place.column.unit);
    std::vector<CapabilityArgument> arguments = entry.capability.arguments;
    for (const ScopeEntry::Range& range : entry.ranges) {
        arguments.push_back(range.argument);
    }
    const certificate::HeldAgainst measured = measured_of(place, column);
    for (const CapabilityArgument& argument : arguments) {
        if (!gum::of_one_kind(Unit::parse(argument.unit), column)) {
            continue;
        }
        if (std::string why = argument.of == "value" ? no_share_of_result(entry, place, inputs) : ""; !why.empty()) {
            return {.value = {}, .why = std::move(why)};
        }
        const Found at = argument_of(data, entry, place, inputs, argument);
        Found whole = at.value ? converted(*at.value, argument.unit, place.column.unit, argument.name) : at;
        const Found here = converted(measured.value, measured.unit, place.column.unit, place.column.result);
        // A parameter that is not the nominal value of what was measured makes no share less than that of this.
        if (whole.value && here.value && std::abs(*here.value) > std::abs(*whole.value) &&
            !certificate::is_nominal_of(std::abs(*whole.value), std::abs(*here.value))) {
            return here;
        }
        return whole;
    }
    if (place.assumed || certificate::measured_at(place.table, place.column, place.row, column).is_place) {
        return converted(measured.value, measured.unit, place.column.unit, place.column.result);
    }
    // Whether the result is the quantity or an error of it, nobody can say here: a share of an error would be far less
    // than the scope states.
    return {.value = {},
            .why = "the capability of \"" + entry.id + "\" is a share (\"" + entry.capability.unit +
                   "\"), and the scope entry has no range of the quantity of which it is one"};
}

/// \param U  in the unit of the capability
Found in_unit_of_result(double U, const certificate::CertificateData& data, const ScopeEntry& entry,
                        const ScopePlace& place, const certificate::CapabilityInputs& inputs) {
    const Unit unit = Unit::parse(entry.capability.unit);
    const Unit column = Unit::parse(place.column.unit);
    if (unit.dimension() == column.dimension()) {
        return {.value = entry.capability.unit == place.column.unit
                             ? U
                             : column.difference_from_si(unit.difference_to_si(U)),
                .why = {}};
    }
    // Nothing is a share of a place on a scale with an origin of its own: a Celsius temperature, a level.
    if (!unit.dimension().is_one() || column.is_celsius_temperature() ||
        column.dimension() == Unit::parse("dB").dimension()) {
        return {.value = {},
                .why = "the capability has the unit \"" + entry.capability.unit + "\", and the result \"" +
                       place.column.unit + "\""};
    }
    const Found whole = whole_of_share(data, entry, place, inputs);
    if (!whole.value) {
        return whole;
    }
    if (*whole.value == 0.0) {
        return {.value = {},
                .why = "the capability of \"" + entry.id + "\" is a share (\"" + entry.capability.unit +
                       "\"), and here one of 0"};
    }
    return {.value = unit.difference_to_si(U) * std::abs(*whole.value), .why = {}};
}

Found capability_of(const certificate::CertificateData& data, const ScopeEntry& entry, const ScopePlace& place,
                    const certificate::CapabilityInputs& inputs) {
    std::vector<ArgumentValue> arguments;
    const certificate::Capability& stated = entry.capability;
    if ((stated.percent_of_value || stated.ppm_of_value) && !stated.arguments.empty() &&
        stated.arguments.front().of == "value") {
        if (std::string why = no_share_of_result(entry, place, inputs); !why.empty()) {
            return {.value = {}, .why = std::move(why)};
        }
    }
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
    Found in_column = in_unit_of_result(*at.U, data, entry, place, inputs);
    if (!in_column.value) {
        return in_column;
    }
    double U = *in_column.value;
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
    Outside outside{other_work(data, entry)};
    if (outside.why.empty()) {
        outside = out_of_ranges(data, entry, place, inputs);
    }
    if (!outside.why.empty()) {
        return {.entry = {}, .outside_because = outside.why, .capability = {}, .outside_by = outside.by};
    }
    Found capability = capability_of(data, entry, place, inputs);
    if (!capability.value) {
        return {.entry = {}, .outside_because = capability.why, .capability = {}};
    }
    return {.entry = entry.id, .outside_because = {}, .capability = capability.value};
}

/// A range of the item in words, "10 V", in a unit; nothing where it is none of its kind.
std::optional<double> size_of(std::string_view words, const std::string& unit) {
    for (const std::string_view sign : {"±", "+"}) {
        if (words.starts_with(sign)) {
            words.remove_prefix(sign.size());
        }
    }
    words.remove_prefix(std::min(words.find_first_not_of(' '), words.size()));
    double number = 0.0;
    const auto [end, failure] = std::from_chars(words.data(), words.data() + words.size(), number);
    std::string_view rest(end, static_cast<std::size_t>(words.data() + words.size() - end));
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    if (failure != std::errc() || rest.empty() ||
        std::string_view("0123456789+-.,/").find(rest.front()) != std::string_view::npos) {
        return std::nullopt;
    }
    try {
        const Unit of = Unit::parse(rest);
        const Unit to = Unit::parse(unit);
        return gum::of_one_kind(of, to) ? std::optional(to.from_si(of.to_si(number))) : std::nullopt;
    } catch (const gum::InputError&) {
        return std::nullopt;
    }
}

bool is_end(double at, double end) {
    return std::abs(at - end) <= k_range_noise * std::max(std::abs(at), std::abs(end));
}

/// Where a line of the scope begins and ends: its ranges, and the first and the last point of its capability.
std::vector<ScopeEntry::Range> ends_of(const ScopeEntry& entry) {
    std::vector<ScopeEntry::Range> ends = entry.ranges;
    const certificate::Capability& c = entry.capability;
    if ((c.form == "range" || c.form == "table") && !c.arguments.empty() && !c.points.empty()) {
        ends.push_back({.argument = c.arguments[0], .low = c.points.front().at, .high = c.points.back().at});
    } else if (c.form == "matrix" && c.arguments.size() == 2 && !c.rows.empty() && !c.columns.empty()) {
        ends.push_back({.argument = c.arguments[0], .low = c.rows.front(), .high = c.rows.back()});
        ends.push_back({.argument = c.arguments[1], .low = c.columns.front(), .high = c.columns.back()});
    }
    return ends;
}

/// One line of the scope that covers a value, and where the value lies in it.
struct Covering {
    ScopeAnswer answer;
    std::vector<ScopeEntry::Range> ends = {};
    std::vector<std::optional<double>> at = {};  ///< in the unit of each of `ends`; none: of several rows
};

/// Where one line ends and another one begins at the value: the range of the one that begins; nullptr where they do not.
const ScopeEntry::Range* range_beyond(const Covering& below, const Covering& above) {
    for (std::size_t i = 0; i < below.ends.size(); ++i) {
        const ScopeEntry::Range& ends = below.ends[i];
        for (std::size_t j = 0; j < above.ends.size(); ++j) {
            const ScopeEntry::Range& begins = above.ends[j];
            // Below 0 and at it a scope is read in more ways than one.
            if (ends.argument.of == begins.argument.of && below.at[i] && above.at[j] && ends.low >= 0.0 &&
                ends.low < ends.high && begins.low > 0.0 && begins.low < begins.high &&
                is_end(*below.at[i], ends.high) && is_end(*above.at[j], begins.low)) {
                return &begins;
            }
        }
    }
    return nullptr;
}

/// Whether the value belongs to another line at whose end or beginning it lies.
bool gives_way(const Covering& one, const Covering& other, const std::string& range) {
    const auto goes_beyond = [&](const ScopeEntry::Range& r) {
        const std::optional<double> size = range.empty() ? std::nullopt : size_of(range, r.argument.unit);
        return size && *size > r.low && !is_end(*size, r.low);
    };
    const ScopeEntry::Range* const begins = range_beyond(other, one);  // the value ends `other`
    const ScopeEntry::Range* const ends = range_beyond(one, other);
    if (begins != nullptr && ends != nullptr) {
        return false;  // each ends where the other one begins, of two quantities
    }
    return (begins != nullptr && !goes_beyond(*begins)) || (ends != nullptr && goes_beyond(*ends));
}

}  // namespace

ScopeAnswer scope_of(const certificate::CertificateData& data, const ScopePlace& place,
                     const certificate::CapabilityInputs& inputs) {
    std::vector<Covering> inside;
    ScopeAnswer outside;
    for (const ScopeEntry& entry : data.accreditation->scope) {
        if (!certificate::is_covered(entry.results, place.column.result)) {
            continue;
        }
        ScopeAnswer answer = answer_of(data, entry, place, inputs);
        if (answer.entry.empty()) {
            // Of ranges that were left, the nearest one is the one to tell.
            if (outside.outside_because.empty() ||
                (answer.outside_by > 0.0 && answer.outside_by < outside.outside_by)) {
                outside = std::move(answer);
            }
            continue;
        }
        Covering& covering = inside.emplace_back(Covering{.answer = std::move(answer), .ends = ends_of(entry)});
        for (const ScopeEntry::Range& range : covering.ends) {
            covering.at.push_back(argument_of(data, entry, place, inputs, range.argument).value);
        }
    }
    std::vector<const Covering*> left;
    for (const Covering& one : inside) {
        if (std::ranges::none_of(inside, [&](const Covering& other) { return gives_way(one, other, place.range); })) {
            left.push_back(&one);
        }
    }
    if (left.empty()) {  // lines that give way in a circle
        std::ranges::transform(inside, std::back_inserter(left), [](const Covering& one) { return &one; });
    }
    if (!left.empty()) {
        return (*std::ranges::max_element(left, {}, [](const Covering* c) { return *c->answer.capability; }))->answer;
    }
    if (outside.outside_because.empty()) {
        outside.outside_because = "no entry of the scope names the result \"" + place.column.result + "\"";
    }
    return outside;
}

bool is_difference_by_role(const ScopePlace& place) {
    return certificate::is_role_of_difference(role_of(place));
}

std::optional<certificate::HeldAgainst> doubtful_place(const ScopePlace& place,
                                                       const certificate::CapabilityInputs& inputs) {
    constexpr double k_difference = 0.5;
    return is_place_known(place) ? std::nullopt : input_beside(place, inputs, k_difference);
}

}  // namespace gumcert::reports
