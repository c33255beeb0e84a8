#include "certificate/point_limits.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "certificate/capability.h"
#include "certificate/capability_equation.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::certificate {

namespace {

using gum::Unit;

constexpr double k_step_noise = 1e-12;   // of a nominal value that a unit was converted of
constexpr double k_edge_of_step = 0.01;  // of its end: as near as a measured value lies to its nominal one

LimitsAt without_limits(std::string problem) {
    return {.lower = {}, .upper = {}, .problem = std::move(problem)};
}

/// ± half-width about 0, or about a value of the point.
LimitsAt about(const AgreedSpecification& s, const PointLookup& point, double half_width) {
    // Limits that coincide could be kept by nobody, and a negative half-width would turn them round.
    if (!std::isfinite(half_width) || !(half_width > 0.0)) {
        return without_limits("the maximum permissible error is " + text::shortest(half_width) + " " + s.unit +
                              ", which is not greater than 0");
    }
    double centre = 0.0;
    if (!s.limits->about.empty()) {
        const std::optional<double> stated = point.number(s.limits->about, s.unit, false);
        if (!stated) {
            return without_limits("the point has no value of " + text::in_quotes(s.limits->about) + " in " + s.unit);
        }
        centre = *stated;
    }
    return {.lower = centre - half_width, .upper = centre + half_width};
}

LimitsAt of_columns(const AgreedSpecification& s, const PointLookup& point) {
    // A difference: in degrees Celsius the zero of the scale has no part in it.
    const std::optional<double> mpe = point.number("mpe", s.unit, true);
    LimitsAt limits{.lower = point.number("limit_low", s.unit, false),
                    .upper = point.number("limit_high", s.unit, false)};
    if (mpe) {
        LimitsAt of_mpe = about(s, point, *mpe);
        const auto differs = [mpe](const std::optional<double>& stated, const std::optional<double>& own) {
            return stated && own && std::abs(*stated - *own) > k_step_noise * (std::abs(*own) + *mpe);
        };
        // Which of two statements was agreed is not the program's to choose.
        if (differs(limits.lower, of_mpe.lower) || differs(limits.upper, of_mpe.upper)) {
            return without_limits("the point states mpe, and other limits in limit_low or limit_high");
        }
        return of_mpe;
    }
    if (!limits.lower && !limits.upper) {
        limits.problem = "the point states no limit";
    } else if (limits.lower && limits.upper && *limits.lower >= *limits.upper) {
        return without_limits("the lower limit of the point is not below the upper one");
    }
    return limits;
}

LimitsAt of_accuracy(const AgreedSpecification& s, const PointLookup& point) {
    const PointLimits& limits = *s.limits;
    const std::string range = point.word(limits.range_column);
    const auto entry = std::find_if(limits.accuracy.begin(), limits.accuracy.end(), [&](const auto& candidate) {
        return candidate.range.empty() || candidate.range == range;
    });
    if (entry == limits.accuracy.end()) {
        return without_limits("the accuracy is not stated for the range " + text::in_quotes(range));
    }
    const Unit target = Unit::parse(s.unit);
    const Unit stated = entry->unit.empty() ? target : Unit::parse(entry->unit);
    const auto in_unit = [&](double v) {
        return entry->unit.empty() || entry->unit == s.unit ? v : target.difference_from_si(stated.difference_to_si(v));
    };
    // The parts add up and are not taken as the root of squares: each is a limit, and the instrument may be at all of
    // them at once.
    double half_width =
        in_unit(entry->full_scale.value_or(0.0) * entry->percent_of_range.value_or(0.0) / 100.0 +
                entry->digits.value_or(0.0) * entry->digit.value_or(0.0) + entry->constant.value_or(0.0));
    if (entry->percent_of_reading) {
        std::optional<double> reading = point.number(limits.of, s.unit, false);
        if (!reading) {
            // Of an error of a thermometer: what its own scale shows. 68 °F are 68 steps of 1 °F, not 20 of 1 K.
            reading = point.number(limits.of, s.unit, true);
        }
        if (!reading) {
            return without_limits("the point has no value of " + text::in_quotes(limits.of) + " in " + s.unit);
        }
        // Of the magnitude: a negative reading has the same limits as a positive one.
        half_width += std::abs(*reading) * *entry->percent_of_reading / 100.0;
    }
    return about(s, point, half_width);
}

LimitsAt of_steps(const AgreedSpecification& s, const PointLookup& point) {
    const CapabilityArgument& argument = s.limits->arguments.front();
    const std::optional<double> at = point.number(argument.of, argument.unit, false);
    if (!at) {
        return without_limits("the point has no value of " + text::in_quotes(argument.of) + " in " + argument.unit);
    }
    const double size = std::abs(*at);
    const auto step = std::find_if(
        s.limits->steps.begin(), s.limits->steps.end(),
        [&](const PointLimits::Step& candidate) { return size <= candidate.up_to * (1.0 + k_step_noise); });
    std::optional<double> passed;
    if (step != s.limits->steps.begin()) {
        const double end = std::prev(step)->up_to;
        passed = size <= end * (1.0 + k_edge_of_step) ? std::optional(end) : std::nullopt;
    }
    LimitsAt limits =
        step == s.limits->steps.end()
            ? without_limits(text::shortest(size) + " " + argument.unit + " is beyond the last step of the limits")
            : about(s, point, step->mpe);
    limits.passed = passed;
    return limits;
}

/// A limit that an expression gives itself, of any sign.
std::optional<double> limit_of(const std::string& expression, const AgreedSpecification& s,
                               const std::vector<ArgumentValue>& values, std::string& problem) {
    if (expression.empty()) {
        return std::nullopt;
    }
    Capability given;
    given.form = "function";
    given.unit = s.unit;
    given.arguments = s.limits->arguments;
    Eigen::VectorXd numbers(static_cast<Eigen::Index>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
        numbers(static_cast<Eigen::Index>(i)) = values[i].value;
    }
    const double limit =
        compile_capability(given, expanded_capability_expression(expression, problem)).evaluate(numbers)(0);
    if (!std::isfinite(limit)) {
        problem = "the expression of a limit has no value here";
    }
    return limit;
}

LimitsAt of_two_expressions(const AgreedSpecification& s, const std::vector<ArgumentValue>& values) {
    LimitsAt limits;
    try {
        limits.lower = limit_of(s.limits->limit_low, s, values, limits.problem);
        limits.upper = limit_of(s.limits->limit_high, s, values, limits.problem);
    } catch (const gum::NoResultError&) {
        return without_limits("the expression of a limit has no value here");
    }
    if (limits.problem.empty() && limits.lower && limits.upper && *limits.lower >= *limits.upper) {
        limits.problem = "the lower limit " + text::shortest(*limits.lower) + " " + s.unit +
                         " is not below the upper one, " + text::shortest(*limits.upper) + " " + s.unit;
    }
    return limits.problem.empty() ? limits : without_limits(limits.problem);
}

LimitsAt of_expression(const AgreedSpecification& s, const PointLookup& point) {
    Capability mpe;
    mpe.form = "function";
    mpe.unit = s.unit;
    mpe.arguments = s.limits->arguments;
    mpe.expression = s.limits->expression;
    std::vector<ArgumentValue> values;
    for (const CapabilityArgument& argument : mpe.arguments) {
        const std::optional<double> at = point.number(argument.of, argument.unit, false);
        if (!at) {
            return without_limits("the point has no value of " + text::in_quotes(argument.of) + " in " + argument.unit);
        }
        values.push_back({argument.name, *at});
    }
    if (!s.limits->limit_low.empty() || !s.limits->limit_high.empty()) {
        return of_two_expressions(s, values);
    }
    const CapabilityAt found = capability_at(mpe, values);
    return found.U ? about(s, point, *found.U)
                   : without_limits("the expression of the maximum permissible error has no value above 0 here");
}

}  // namespace

const PointColumn* column_named(const std::vector<PointColumn>& columns, std::string_view name) {
    const auto found =
        std::find_if(columns.begin(), columns.end(), [&](const PointColumn& column) { return column.name == name; });
    return found == columns.end() ? nullptr : &*found;
}

PointLookup lookup_at(const PointTable& table, std::size_t point) {
    const auto find = [&table](const std::string& name) { return column_named(table.columns, name); };
    return {.number = [=](const std::string& name, const std::string& unit, bool difference) -> std::optional<double> {
                const PointColumn* const column = find(name);
                if (column == nullptr || point >= column->values.size() || !column->values[point]) {
                    return std::nullopt;
                }
                const double value = *column->values[point];
                if (column->unit.empty() || column->unit == unit) {
                    return value;
                }
                const Unit from = Unit::parse(column->unit);
                const Unit to = Unit::parse(unit);
                if (!(difference ? from.dimension() == to.dimension() : gum::of_one_kind(from, to))) {
                    return std::nullopt;
                }
                return difference ? to.difference_from_si(from.difference_to_si(value)) : to.from_si(from.to_si(value));
            },
            .word = [=](const std::string& name) -> std::string {
                const PointColumn* const column = find(name);
                return column == nullptr || point >= column->printed.size() ? std::string() : column->printed[point];
            }};
}

LimitsAt limits_at(const AgreedSpecification& specification, const PointLookup& point) {
    if (!specification.limits) {
        return {.lower = specification.lower, .upper = specification.upper};
    }
    const std::string& by = specification.limits->by;
    return by == "accuracy"     ? of_accuracy(specification, point)
           : by == "steps"      ? of_steps(specification, point)
           : by == "expression" ? of_expression(specification, point)
                                : of_columns(specification, point);
}

std::vector<std::string> columns_of_limits(const PointLimits& limits) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
            names.push_back(name);
        }
    };
    add(limits.about);
    if (limits.by == "accuracy") {
        add(limits.of);
        if (std::any_of(limits.accuracy.begin(), limits.accuracy.end(),
                        [](const PointLimits::Accuracy& entry) { return !entry.range.empty(); })) {
            add(limits.range_column);
        }
    }
    for (const CapabilityArgument& argument : limits.arguments) {
        add(argument.of);
    }
    return names;
}

}  // namespace gumcert::certificate
