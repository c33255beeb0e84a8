#include "reports/record/make/certificate/environment_findings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "certificate/stated_text.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/make/record_parts.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using certificate::Condition;
using certificate::Finding;
using certificate::FindingSeverity;
using reports::StationEnvironment;

constexpr double k_coverage = 2.0;
constexpr double k_ice_point = 273.15;           // [K]
constexpr double k_coarsest_temperature = 0.05;  // half of the last digit of a stated temperature, at most, [K]

/// One kind of values of the environment file, in its unit.
struct Observed {
    std::string name;        ///< "the temperature of the fixture"
    std::string kind, unit;  ///< of the conditions that state it; the unit of the values
    double lowest = 0.0, highest = 0.0;
    double U = 0.0;  ///< of one value
};

std::optional<Observed> observed(const std::vector<StationEnvironment>& rows, const std::string& name,
                                 const std::string& kind, const std::string& unit,
                                 Shown<std::optional<double>> StationEnvironment::*member) {
    std::optional<Observed> result;
    for (const StationEnvironment& row : rows) {
        if (const std::optional<double> value = (row.*member).number) {
            if (!result) {
                result = Observed{name, kind, unit, *value, *value, 0.0};
            }
            result->lowest = std::min(result->lowest, *value);
            result->highest = std::max(result->highest, *value);
        }
    }
    return result;
}

Observed observed_fixture(const std::vector<StationEnvironment>& rows) {
    const auto fixture = [](const StationEnvironment& row) { return row.fixture_degC.number; };
    const auto u = [](const StationEnvironment& row) { return row.u_fixture_K.number; };
    const auto [low, high] = std::ranges::minmax(rows, {}, fixture);
    return {"the temperature of the fixture",
            "temperature",
            "degC",
            fixture(low),
            fixture(high),
            k_coverage * u(std::ranges::max(rows, {}, u))};
}

/// Half a unit of the last decimal place of a number as it is written.
double half_of_last_place(double value) {
    const std::string text = text::shortest(value);
    if (text.find_first_of("eE") != std::string::npos) {
        return 0.0;
    }
    const std::size_t point = text.find('.');
    const auto decimals = point == std::string::npos ? 0.0 : static_cast<double>(text.size() - point - 1);
    return 0.5 * std::pow(10.0, -decimals);
}

/// A condition in the unit of what was observed.
struct Range {
    double low = 0.0, high = 0.0, slack = 0.0;
    std::optional<double> lower_limit, upper_limit;
    double slack_of_limits = 0.0;
};

/// Nothing where the unit of the condition is of another kind; the plausibility of conditions reports that (E02).
std::optional<Range> range_of(const Condition& condition, const Observed& of) {
    gum::Unit stated;
    const gum::Unit wanted = gum::Unit::parse(of.unit);
    try {
        stated = gum::Unit::parse(condition.unit);
    } catch (const gum::InputError&) {
        return std::nullopt;
    }
    if (!(stated.dimension() == wanted.dimension())) {
        return std::nullopt;
    }
    // A temperature in kelvin counts from absolute zero, one in degrees from the ice point.
    const double origin = of.unit == "degC" && !stated.is_celsius_temperature() ? k_ice_point : 0.0;
    const auto to = [&](double value) { return wanted.from_si(stated.to_si(value) - origin); };
    const auto difference = [&](double value) { return wanted.difference_from_si(stated.difference_to_si(value)); };
    Range range;
    range.low = to(condition.minimum);
    range.high = to(condition.maximum);
    const double U = std::hypot(condition.U ? difference(*condition.U) : 0.0, of.U);
    double last = difference(std::min(half_of_last_place(condition.minimum), half_of_last_place(condition.maximum)));
    if (of.unit == "degC") {
        last = std::min(last, k_coarsest_temperature);
    }
    range.slack = U + last;
    range.slack_of_limits = U;
    if (condition.lower_limit) {
        range.lower_limit = to(*condition.lower_limit);
    }
    if (condition.upper_limit) {
        range.upper_limit = to(*condition.upper_limit);
    }
    return range;
}

/// By how much values leave a range, 0 where they do not.
double excess(const Observed& values, std::optional<double> low, std::optional<double> high, double slack) {
    const double below = low ? *low - values.lowest : 0.0;
    const double above = high ? values.highest - *high : 0.0;
    const double outside = std::max(below, above);
    return outside > slack * (1.0 + 1e-9) ? outside : 0.0;
}

std::string number(double value, const std::string& unit) {
    return gum::round_to_quantum(value, unit == "degC" ? 2 : 1) + " " + gum::unit_for_people(unit);
}

std::string says(const Observed& values) {
    return "the environment file has " + values.name + " from " + number(values.lowest, values.unit) + " to " +
           number(values.highest, values.unit);
}

Finding not_as_stated(const Observed& values, const Condition& condition, std::size_t index) {
    const std::string unit = " " + gum::unit_for_people(condition.unit);
    return {.id = "E04",
            .clause = "ISO/IEC 17025:2017, 7.8.4.1 b",
            .severity = FindingSeverity::critical,
            .where = "/conditions/" + std::to_string(index),
            .what = says(values) + ", and \"" + condition.quantity.in("en") + "\" is stated from " +
                    text::shortest(condition.minimum) + unit + " to " + text::shortest(condition.maximum) + unit,
            .action = "Correct the condition, or the file: both are of this measurement."};
}

Finding outside_of_limits(const Observed& values, const Condition& condition, double limit, std::size_t index) {
    return {.id = "E05",
            .clause = "ISO/IEC 17025:2017, 7.8.2.1 n",
            .severity = FindingSeverity::critical,
            .where = "/conditions/" + std::to_string(index),
            .what = says(values) + ", beyond the limit of the method, " + text::shortest(limit) + " " +
                    gum::unit_for_people(condition.unit) + ", and no deviation is stated",
            .action = "State the deviation from the method and what it does to the results, or repeat the work."};
}

/// Held against the condition that fits best.
void hold_against(std::vector<Finding>& found, const Observed& values, const std::vector<Condition>& conditions,
                  bool is_deviation_stated) {
    std::optional<std::pair<double, std::size_t>> best;
    std::optional<Range> range;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        const std::optional<Range> candidate =
            conditions[i].kind == values.kind ? range_of(conditions[i], values) : std::nullopt;
        if (candidate) {
            const double outside = excess(values, candidate->low, candidate->high, candidate->slack);
            if (!best || outside < best->first) {
                best = {outside, i};
                range = candidate;
            }
        }
    }
    if (!best) {
        return;
    }
    const Condition& condition = conditions[best->second];
    if (best->first > 0.0) {
        found.push_back(not_as_stated(values, condition, best->second));
    }
    if (is_deviation_stated) {
        return;
    }
    if (excess(values, range->lower_limit, std::nullopt, range->slack_of_limits) > 0.0) {
        found.push_back(outside_of_limits(values, condition, *condition.lower_limit, best->second));
    } else if (excess(values, std::nullopt, range->upper_limit, range->slack_of_limits) > 0.0) {
        found.push_back(outside_of_limits(values, condition, *condition.upper_limit, best->second));
    }
}

}  // namespace

std::vector<Finding> environment_findings(const reports::EvaluationRecord& record) {
    std::vector<Finding> found;
    if (!record.rotary || !record.rotary->environment || !record.certificate) {
        return found;
    }
    const std::vector<StationEnvironment>& rows = record.rotary->environment->stations;
    const certificate::CertificateData& data = record.certificate->data;
    const bool is_deviation_stated = certificate::any_statement(data.method.deviations);
    std::vector<std::optional<Observed>> all{observed_fixture(rows)};
    // Of one stated temperature nothing tells whether it is that of the air.
    if (std::ranges::count(data.conditions, "temperature", &Condition::kind) > 1) {
        all.push_back(
            observed(rows, "the temperature of the air", "temperature", "degC", &StationEnvironment::air_degC));
    }
    all.push_back(observed(rows, "the pressure of the air", "pressure", "hPa", &StationEnvironment::pressure_hPa));
    all.push_back(
        observed(rows, "the humidity of the air", "humidity", "percent", &StationEnvironment::humidity_percent));
    for (const std::optional<Observed>& values : all) {
        if (values) {
            hold_against(found, *values, data.conditions, is_deviation_stated);
        }
    }
    return found;
}

}  // namespace gumcert::reports
