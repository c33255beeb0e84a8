#include "certificate/agreed_rule.h"

#include <functional>
#include <optional>
#include <utility>

#include "gum/quantity/unit.h"

namespace gumcert::certificate {

namespace {

std::optional<double> mapped(const std::optional<double>& from, const std::function<double(double)>& map) {
    return from ? std::optional(map(*from)) : std::nullopt;
}

/// Rule and limits in the unit of the results, not yet held against each other.
AgreedRule in_unit_of_results(const AgreedSpecification& from, const std::string& unit) {
    AgreedRule out;
    const std::optional<gum::DecisionRule> rule = gum::decision_rule_from_id(from.rule.id);
    if (!rule) {
        out.problem = "the decision rule \"" + from.rule.id + "\" is not known";
        return out;
    }
    out.rule = *rule;
    const gum::Unit stated = gum::Unit::parse(from.unit);
    const gum::Unit column = gum::Unit::parse(unit);
    if (!(stated.dimension() == column.dimension()) ||
        stated.is_celsius_temperature() != column.is_celsius_temperature()) {
        out.problem = "the specification has the unit \"" + from.unit + "\", and the result \"" + unit + "\"";
        return out;
    }
    const bool same = from.unit == unit;
    const auto value = [&](double v) { return same ? v : column.from_si(stated.to_si(v)); };
    const auto difference = [&](double v) { return same ? v : column.difference_from_si(stated.difference_to_si(v)); };
    out.limits = {.lower = mapped(from.lower, value), .upper = mapped(from.upper, value)};
    out.parameters = stated_parameters(from.rule);
    for (std::optional<double>* const width :
         {&out.parameters.guard_band, &out.parameters.largest_U, &out.parameters.population_deviation}) {
        *width = mapped(*width, difference);
    }
    out.parameters.population_centre = mapped(out.parameters.population_centre, value);
    return out;
}

AgreedRule checked(AgreedRule rule) {
    if (rule.problem.empty()) {
        for (const std::string& sentence : gum::check_decision_rule(rule.rule, rule.parameters, rule.limits)) {
            rule.problem += (rule.problem.empty() ? "" : "; ") + sentence;
        }
    }
    return rule;
}

}  // namespace

gum::DecisionRuleParameters stated_parameters(const AgreedSpecification::Rule& rule) {
    gum::DecisionRuleParameters parameters;
    parameters.guard_factor = rule.guard_factor;
    parameters.guard_band = rule.guard_band;
    parameters.probability = rule.probability;
    parameters.test_uncertainty_ratio = rule.test_uncertainty_ratio;
    parameters.largest_U = rule.largest_U;
    parameters.alternative = gum::decision_rule_from_id(rule.alternative);
    parameters.population_reliability = rule.population_reliability;
    parameters.population_deviation = rule.population_deviation;
    parameters.population_centre = rule.population_centre;
    parameters.method = rule.method;
    return parameters;
}

AgreedRule agreed_rule(const AgreedSpecification& specification, const std::string& unit) {
    return checked(in_unit_of_results(specification, unit));
}

AgreedRule agreed_rule(const AgreedSpecification& specification, const std::string& unit,
                       const gum::ToleranceLimits& limits) {
    AgreedRule rule = in_unit_of_results(specification, unit);
    rule.limits = limits;
    return checked(std::move(rule));
}

}  // namespace gumcert::certificate
