#include "app/certified_conformity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "certificate/statement_of_uncertainty.h"
#include "gum/conformity.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"

namespace gumcert::app {

namespace {

using certificate::AgreedSpecification;
using certificate::CertifiedValue;
using certificate::Verdict;
using gum::ConformityDecision;
using gum::ConformityVerdict;
using gum::Unit;

const char* name_of(ConformityVerdict verdict) {
    switch (verdict) {
        case ConformityVerdict::pass:
            return "pass";
        case ConformityVerdict::fail:
            return "fail";
        case ConformityVerdict::conditional_pass:
            return "conditional_pass";
        case ConformityVerdict::conditional_fail:
            return "conditional_fail";
        case ConformityVerdict::undetermined:
            return "undetermined";
        case ConformityVerdict::not_applicable:
            break;
    }
    return "not_applicable";
}

/// A specification in the unit of a column.
struct Agreed {
    gum::DecisionRule rule = gum::DecisionRule::simple_acceptance;
    gum::DecisionRuleParameters parameters;
    gum::ToleranceLimits limits;
    std::string problem;  ///< why it cannot be applied; "" where it can
};

std::optional<double> mapped(const std::optional<double>& from, const std::function<double(double)>& map) {
    return from ? std::optional(map(*from)) : std::nullopt;
}

Agreed agreed(const AgreedSpecification& from, const std::string& unit) {
    Agreed out;
    const std::optional<gum::DecisionRule> rule = gum::decision_rule_from_id(from.rule.id);
    if (!rule) {
        out.problem = "the decision rule \"" + from.rule.id + "\" is not known";
        return out;
    }
    out.rule = *rule;
    const Unit stated = Unit::parse(from.unit);
    const Unit column = Unit::parse(unit);
    if (!(stated.dimension() == column.dimension()) ||
        stated.is_celsius_temperature() != column.is_celsius_temperature()) {
        out.problem = "the specification has the unit \"" + from.unit + "\", and the result \"" + unit + "\"";
        return out;
    }
    const bool same = from.unit == unit;
    const auto value = [&](double v) { return same ? v : column.from_si(stated.to_si(v)); };
    const auto difference = [&](double v) { return same ? v : column.difference_from_si(stated.difference_to_si(v)); };
    out.limits = {.lower = mapped(from.lower, value), .upper = mapped(from.upper, value)};
    out.parameters.guard_factor = from.rule.guard_factor;
    out.parameters.guard_band = mapped(from.rule.guard_band, difference);
    out.parameters.probability = from.rule.probability;
    out.parameters.test_uncertainty_ratio = from.rule.test_uncertainty_ratio;
    out.parameters.largest_U = mapped(from.rule.largest_U, difference);
    out.parameters.alternative = gum::decision_rule_from_id(from.rule.alternative);
    out.parameters.population_reliability = from.rule.population_reliability;
    out.parameters.population_deviation = mapped(from.rule.population_deviation, difference);
    out.parameters.population_centre = mapped(from.rule.population_centre, value);
    out.parameters.method = from.rule.method;
    for (const std::string& sentence : gum::check_decision_rule(out.rule, out.parameters, out.limits)) {
        out.problem += (out.problem.empty() ? "" : "; ") + sentence;
    }
    return out;
}

/// The numbers of a value that its decision rests on.
struct DecisionNumbers {
    gum::MeasuredValue unrounded, printed;
};

std::optional<DecisionNumbers> numbers_of(const CertifiedValue& from, const KnownDistribution& known) {
    const std::optional<double> y = certificate::number_of(from.printed_value);
    const std::optional<double> U = certificate::number_of(from.printed_U);
    const std::optional<double> k = certificate::number_of(from.printed_k);
    if (!from.U || !from.k || !y || !U || !k || !(*from.k > 0.0) || !(*k > 0.0) || !(*U > 0.0)) {
        return std::nullopt;
    }
    DecisionNumbers out;
    out.unrounded.value = from.value;
    out.unrounded.expanded_uncertainty = from.raised && from.capability ? *from.capability : *from.U;
    out.unrounded.standard_uncertainty = out.unrounded.expanded_uncertainty / *from.k;
    out.unrounded.degrees_of_freedom = from.nu_eff.value_or(std::numeric_limits<double>::infinity());
    out.printed = out.unrounded;
    out.printed.value = *y;
    out.printed.expanded_uncertainty = *U;
    out.printed.standard_uncertainty = *U / *k;
    if (known.function && !from.raised) {
        out.unrounded.distribution = known.function;
        // The same shape about the printed value, as wide as the printed U.
        const double stretch = *from.U / *U;
        out.printed.distribution = [known, stretch, centre = from.value, y = *y](double x) {
            return known.function(centre + (x - y) * stretch);
        };
    }
    return out;
}

std::string printed_ratio(double ratio) {
    return gum::round_significant(ratio, 3);
}

void print(Verdict& verdict, int decimals) {
    const auto limit = [&](const std::optional<double>& l) {
        return l ? certificate::printed_limit(*l, decimals) : std::string();
    };
    verdict.printed.lower = limit(verdict.lower);
    verdict.printed.upper = limit(verdict.upper);
    // Acceptance limits follow from U: they end where value and limits end.
    int finest = decimals;
    for (const std::string& text : {verdict.printed.lower, verdict.printed.upper}) {
        finest = text.empty() ? finest : std::max(finest, certificate::decimals_of(text));
    }
    const auto acceptance = [&](const std::optional<double>& l) {
        return l ? gum::round_to_quantum(*l, finest) : std::string();
    };
    verdict.printed.acceptance_lower = acceptance(verdict.acceptance_lower);
    verdict.printed.acceptance_upper = acceptance(verdict.acceptance_upper);
    verdict.printed.guard_band = gum::round_to_quantum(verdict.guard_band, finest);
    const auto risk = [](const std::optional<double>& p) { return p ? certificate::printed_risk(*p) : std::string(); };
    verdict.printed.conformance_probability = certificate::printed_conformance(verdict.conformance_probability);
    verdict.printed.specific_risk = certificate::printed_risk(verdict.specific_risk);
    verdict.printed.largest_specific_risk = risk(verdict.largest_specific_risk);
    verdict.printed.false_accept = risk(verdict.false_accept);
    verdict.printed.false_reject = risk(verdict.false_reject);
    verdict.printed.test_uncertainty_ratio =
        verdict.test_uncertainty_ratio ? printed_ratio(*verdict.test_uncertainty_ratio) : std::string();
}

void fill(Verdict& verdict, const ConformityDecision& decision) {
    verdict.rule = gum::decision_rule_id(decision.rule);
    verdict.formula = decision.formula;
    verdict.acceptance_lower = decision.acceptance.lower;
    verdict.acceptance_upper = decision.acceptance.upper;
    verdict.guard_band = decision.guard_band;
    verdict.verdict = name_of(decision.verdict);
    verdict.conformance_probability = decision.conformance_probability;
    verdict.specific_risk = decision.specific_risk;
    verdict.largest_specific_risk = decision.largest_specific_risk;
    verdict.false_accept = decision.false_accept;
    verdict.false_reject = decision.false_reject;
    verdict.test_uncertainty_ratio = decision.test_uncertainty_ratio;
    verdict.note = decision.note;
}

Verdict& not_applicable(Verdict& verdict, const std::string& why) {
    verdict.verdict = verdict.verdict_from_printed = "not_applicable";
    verdict.note = why;
    return verdict;
}

}  // namespace

Verdict verdict_of(const AgreedSpecification& specification, const certificate::CertifiedColumn& column,
                   const CertifiedValue& value, const KnownDistribution& known) {
    Verdict verdict;
    verdict.specification = specification.id;
    verdict.rule = specification.rule.id;
    const Agreed rule = agreed(specification, column.unit);
    verdict.lower = rule.limits.lower;
    verdict.upper = rule.limits.upper;
    if (!rule.problem.empty()) {
        return not_applicable(verdict, rule.problem);
    }
    const std::optional<DecisionNumbers> numbers = numbers_of(value, known);
    if (!numbers) {
        return not_applicable(verdict, "no expanded uncertainty is stated for the value");
    }
    try {
        fill(verdict, gum::decide_conformity(rule.rule, rule.parameters, rule.limits, numbers->unrounded));
        verdict.verdict_from_printed =
            name_of(gum::decide_conformity(rule.rule, rule.parameters, rule.limits, numbers->printed).verdict);
    } catch (const gum::DiagnosedError& error) {
        const gum::Diagnostic& first = error.diagnostics().front();
        return not_applicable(verdict, first.what + ": " + first.rule);
    }
    if (!known.note.empty() && (!known.function || numbers->unrounded.distribution)) {
        verdict.note += (verdict.note.empty() ? "" : " ") + known.note;
    }
    print(verdict, certificate::decimals_of(value.printed_value));
    return verdict;
}

}  // namespace gumcert::app
