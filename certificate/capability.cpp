#include "certificate/capability.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "certificate/capability_equation.h"
#include "gum/argument_check.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "text/numbers.h"

namespace gumcert::certificate {
namespace {

using gum::Diagnostic;

// A value that was converted into the unit of the scope may miss a point of it by a few roundings.
constexpr double k_rounding = 16.0 * std::numeric_limits<double>::epsilon();

bool same(double a, double b) {
    return std::abs(a - b) <= k_rounding * std::max(std::abs(a), std::abs(b));
}

/// Where a value lies among rising points: between first and second, or on one where both are equal.
struct Neighbours {
    std::size_t first = 0, second = 0;
    double share = 0.0;  ///< of the second one, 0 … 1
};

std::optional<Neighbours> neighbours(const std::vector<double>& points, double value) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        // On a point its own U holds, and no other: a scope may step there.
        if (same(points[i], value)) {
            return Neighbours{i, i, 0.0};
        }
        if (value < points[i]) {
            if (i == 0) {
                return std::nullopt;
            }
            return Neighbours{i - 1, i, (value - points[i - 1]) / (points[i] - points[i - 1])};
        }
    }
    return std::nullopt;
}

double linear(double first, double second, double share) {
    return share == 0.0 ? first : first + (second - first) * share;
}

std::string with_unit(double value, const std::string& unit) {
    return text::shortest(value) + (unit.empty() || unit == "1" ? "" : " " + unit);
}

std::string outside(const CapabilityArgument& argument, double value, const std::vector<double>& points) {
    return argument.name + " = " + with_unit(value, argument.unit) + " is outside of " +
           with_unit(points.front(), argument.unit) + " to " + with_unit(points.back(), argument.unit);
}

std::vector<double> places(const std::vector<CapabilityPoint>& points) {
    std::vector<double> at;
    for (const CapabilityPoint& point : points) {
        at.push_back(point.at);
    }
    return at;
}

}  // namespace

gum::EquationSystem compile_capability(const Capability& capability, const std::string& expanded) {
    const std::string where = "expression of the capability";
    // A name that no argument can have by chance, for the left side of the equation.
    std::string name = "U_of_capability";
    while (std::any_of(capability.arguments.begin(), capability.arguments.end(),
                       [&](const CapabilityArgument& argument) { return argument.name == name; })) {
        name += '_';
    }
    const std::vector<gum::EquationText> equations{{name + " = " + expanded, where}};
    std::vector<gum::InputSymbol> inputs;
    for (const CapabilityArgument& argument : capability.arguments) {
        inputs.push_back({argument.name, gum::Unit(), std::nullopt, where});
    }
    const std::vector<gum::OutputSymbol> outputs{{name, gum::Unit(), where}};
    return gum::EquationSystem::compile(equations, inputs, {}, outputs);
}

struct CapabilityEvaluator::Prepared {
    Capability capability;
    std::optional<gum::EquationSystem> equation;

    [[nodiscard]] CapabilityAt of_share(double value) const;
    [[nodiscard]] CapabilityAt of_table(double value) const;
    [[nodiscard]] CapabilityAt of_matrix(double row, double column) const;
    [[nodiscard]] CapabilityAt of_function(const Eigen::VectorXd& arguments) const;
};

CapabilityAt CapabilityEvaluator::Prepared::of_share(double value) const {
    const gum::Unit of = gum::Unit::parse(capability.arguments[0].unit);
    const gum::Unit unit = gum::Unit::parse(capability.unit);
    const double whole = unit.difference_from_si(of.difference_to_si(std::abs(value)));
    const double U = capability.U + (capability.percent_of_value ? *capability.percent_of_value / 100.0 * whole
                                                                 : *capability.ppm_of_value / 1e6 * whole);
    if (U > 0.0) {
        return {U, ""};
    }
    return {std::nullopt, "the capability is a share of " + capability.arguments[0].name + ", which is 0 here"};
}

CapabilityAt CapabilityEvaluator::Prepared::of_table(double value) const {
    const std::vector<double> at = places(capability.points);
    const std::optional<Neighbours> n = neighbours(at, value);
    if (!n) {
        return {std::nullopt, outside(capability.arguments[0], value, at)};
    }
    const double first = capability.points[n->first].U;
    const double second = capability.points[n->second].U;
    return {capability.lookup == "next_worse" ? std::max(first, second) : linear(first, second, n->share), ""};
}

CapabilityAt CapabilityEvaluator::Prepared::of_matrix(double row, double column) const {
    const std::optional<Neighbours> r = neighbours(capability.rows, row);
    if (!r) {
        return {std::nullopt, outside(capability.arguments[0], row, capability.rows)};
    }
    const std::optional<Neighbours> c = neighbours(capability.columns, column);
    if (!c) {
        return {std::nullopt, outside(capability.arguments[1], column, capability.columns)};
    }
    const std::vector<double>& first = capability.matrix[r->first];
    const std::vector<double>& second = capability.matrix[r->second];
    // Between its points such a scope vouches for the larger of the two uncertainties only.
    if (capability.lookup == "next_worse") {
        return {std::max({first[c->first], first[c->second], second[c->first], second[c->second]}), ""};
    }
    return {linear(linear(first[c->first], first[c->second], c->share),
                   linear(second[c->first], second[c->second], c->share), r->share),
            ""};
}

CapabilityAt CapabilityEvaluator::Prepared::of_function(const Eigen::VectorXd& arguments) const {
    try {
        const double U = equation->evaluate(arguments)(0);
        // An expression may fall to 0 or below at an end of its range: no capability can be claimed there.
        if (std::isfinite(U) && U > 0.0) {
            return {U, ""};
        }
        return {std::nullopt, "the expression of the capability gives U = " + with_unit(U, capability.unit) +
                                  " here, which is not greater than 0"};
    } catch (const gum::NoResultError& error) {
        return {std::nullopt,
                "the expression of the capability has no value here: " + error.diagnostics().front().what};
    }
}

CapabilityEvaluator::CapabilityEvaluator(const Capability& capability) {
    std::vector<Diagnostic> problems;
    for (const CapabilityProblem& problem : check_capability(capability)) {
        problems.push_back({.code = "GC-CERT-0201",
                            .where = "capability#" + problem.key,
                            .what = problem.what,
                            .rule = problem.rule,
                            .action = problem.action});
    }
    if (!problems.empty()) {
        throw gum::InputError(std::move(problems));
    }
    Prepared prepared{capability, std::nullopt};
    if (capability.form == "function") {
        std::string problem;
        prepared.equation =
            compile_capability(capability, expanded_capability_expression(capability.expression, problem));
    }
    prepared_ = std::make_shared<const Prepared>(std::move(prepared));
}

CapabilityAt CapabilityEvaluator::at(const std::vector<ArgumentValue>& arguments) const {
    const Capability& capability = prepared_->capability;
    Eigen::VectorXd values(static_cast<Eigen::Index>(capability.arguments.size()));
    for (std::size_t i = 0; i < capability.arguments.size(); ++i) {
        const std::string& name = capability.arguments[i].name;
        const auto found = std::find_if(arguments.begin(), arguments.end(),
                                        [&](const ArgumentValue& argument) { return argument.name == name; });
        if (found == arguments.end() || !std::isfinite(found->value)) {
            gum::refuse("GC-CERT-0202", "capability, argument " + name,
                        found == arguments.end() ? "no value" : "the value " + text::shortest(found->value),
                        "each argument of a capability has a finite value", "State where the value comes from.");
        }
        values(static_cast<Eigen::Index>(i)) = found->value;
    }
    if (capability.form == "value") {
        return capability.arguments.empty() ? CapabilityAt{capability.U, ""} : prepared_->of_share(values(0));
    }
    if (capability.form == "function") {
        return prepared_->of_function(values);
    }
    return capability.form == "matrix" ? prepared_->of_matrix(values(0), values(1)) : prepared_->of_table(values(0));
}

CapabilityAt capability_at(const Capability& capability, const std::vector<ArgumentValue>& arguments) {
    return CapabilityEvaluator(capability).at(arguments);
}

}  // namespace gumcert::certificate
