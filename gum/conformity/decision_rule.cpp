#include "gum/conformity/decision_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "gum/argument_check.h"
#include "gum/conformity/global_risk.h"
#include "text/numbers.h"

namespace gumcert::gum {

// A rule is a row of a table: which parameters it looks at, and what it needs of them. All checks read the rows, so
// that a new rule has them all.

namespace {

constexpr std::array<std::string_view, 8> k_methods = {"1", "2", "3", "4", "5", "6", "rds", "rp10"};

bool is_method(const std::string& method) {
    for (const std::string_view known : k_methods) {
        if (method == known) {
            return true;
        }
    }
    return false;
}
bool rests_on_population(const std::string& method) {
    return method == "1" || method == "2" || method == "3" || method == "4";
}
bool rests_on_ratio(const std::string& method) {
    return method == "6" || method == "rds" || method == "rp10";
}

/// What `probability` of a rule is.
enum class Probability { none, largest_risk, to_prove };

/// The parameters that a rule looks at.
struct Uses {
    bool factor = false, band = false, ratio = false, largest_U = false, alternative = false, method = false;
    Probability probability = Probability::none;
};

using Sentences = std::vector<std::string>;
/// Says what is missing or contradictory.
using Needs = void (*)(const DecisionRuleParameters& p, const ToleranceLimits& limits, Sentences& say);

void ratio_or_largest_U(const DecisionRuleParameters& p, const ToleranceLimits& /*limits*/, Sentences& say) {
    if (!p.test_uncertainty_ratio && !p.largest_U) {
        say.emplace_back("DR-02 needs test_uncertainty_ratio (the least ratio) or largest_U.");
    }
}

void factor(const DecisionRuleParameters& p, const ToleranceLimits& /*limits*/, Sentences& say) {
    if (!p.guard_factor) {
        say.emplace_back("DR-04 needs guard_factor, the r of w = r·U.");
    }
}

void factor_or_band_or_none(const DecisionRuleParameters& p, const ToleranceLimits& /*limits*/, Sentences& say) {
    if (p.guard_factor && p.guard_band) {
        say.emplace_back("guard_factor and guard_band are both stated; DR-05 takes one of them, or none for w = U.");
    }
}

void largest_risk(const DecisionRuleParameters& p, const ToleranceLimits& /*limits*/, Sentences& say) {
    if (!p.probability) {
        say.emplace_back("DR-07 needs probability, the largest risk that is accepted.");
    }
}

void factor_or_probability(const DecisionRuleParameters& p, const ToleranceLimits& /*limits*/, Sentences& say) {
    if (p.guard_factor && p.probability) {
        say.emplace_back("guard_factor and probability are both stated; the one follows from the other in DR-08.");
    }
    if (p.guard_factor && *p.guard_factor == 0.0) {
        say.emplace_back("guard_factor is 0; in DR-08 it must be greater than 0.");
    }
}

void z540_3(const DecisionRuleParameters& p, const ToleranceLimits& limits, Sentences& say);

void factor_or_ratio(const DecisionRuleParameters& p, const ToleranceLimits& /*limits*/, Sentences& say) {
    if (!p.guard_factor && !p.test_uncertainty_ratio) {
        say.emplace_back("DR-10 needs guard_factor (the guard band as a part of U), test_uncertainty_ratio, or both.");
    }
}

void factor_or_band(const DecisionRuleParameters& p, const ToleranceLimits& /*limits*/, Sentences& say) {
    if (p.guard_factor.has_value() == p.guard_band.has_value()) {
        say.emplace_back("DR-13 needs guard_factor or guard_band, and not both.");
    }
}

void nothing(const DecisionRuleParameters& /*p*/, const ToleranceLimits& /*limits*/, Sentences& /*say*/) {}

struct Row {
    DecisionRule rule;
    std::string_view id;
    Uses uses = {};
    Needs needs = nothing;
    bool outwards = false;  ///< the guard band may reach beyond the limits
};

constexpr std::array<Row, 13> k_rules{{
    {.rule = DecisionRule::simple_acceptance, .id = "DR-01"},
    {.rule = DecisionRule::simple_acceptance_with_ratio,
     .id = "DR-02",
     .uses = {.ratio = true, .largest_U = true, .alternative = true},
     .needs = ratio_or_largest_U},
    {.rule = DecisionRule::guard_band_u, .id = "DR-03"},
    {.rule = DecisionRule::guard_band_factor, .id = "DR-04", .uses = {.factor = true}, .needs = factor},
    {.rule = DecisionRule::non_binary,
     .id = "DR-05",
     .uses = {.factor = true, .band = true},
     .needs = factor_or_band_or_none},
    {.rule = DecisionRule::three_way, .id = "DR-06"},
    {.rule = DecisionRule::specific_risk,
     .id = "DR-07",
     .uses = {.probability = Probability::largest_risk},
     .needs = largest_risk},
    {.rule = DecisionRule::iso_14253_1,
     .id = "DR-08",
     .uses = {.factor = true, .probability = Probability::to_prove},
     .needs = factor_or_probability},
    {.rule = DecisionRule::z540_3,
     .id = "DR-09",
     .uses = {.ratio = true, .alternative = true, .method = true, .probability = Probability::largest_risk},
     .needs = z540_3},
    {.rule = DecisionRule::b89_7_3_1,
     .id = "DR-10",
     .uses = {.factor = true, .ratio = true, .alternative = true},
     .needs = factor_or_ratio,
     .outwards = true},
    {.rule = DecisionRule::relaxed, .id = "DR-11"},
    {.rule = DecisionRule::prescribed, .id = "DR-12"},
    {.rule = DecisionRule::agreed,
     .id = "DR-13",
     .uses = {.factor = true, .band = true},
     .needs = factor_or_band,
     .outwards = true},
}};

constexpr bool is_in_order_of_enumeration() {
    for (std::size_t i = 0; i < k_rules.size(); ++i) {
        if (static_cast<std::size_t>(k_rules[i].rule) != i) {
            return false;
        }
    }
    return true;
}
static_assert(is_in_order_of_enumeration());

const Row& row_of(DecisionRule rule) {
    return k_rules.at(static_cast<std::size_t>(rule));
}
const Uses& uses_of(DecisionRule rule) {
    return row_of(rule).uses;
}
bool uses_probability(const Uses& uses) {
    return uses.probability != Probability::none;
}

void z540_3(const DecisionRuleParameters& p, const ToleranceLimits& limits, Sentences& say) {
    if (p.method.empty()) {
        if (!p.test_uncertainty_ratio) {
            say.emplace_back(
                "DR-09 needs method (1 to 6, rds or rp10), or test_uncertainty_ratio where a risk is impracticable.");
        }
        if (p.probability && !(p.alternative && uses_probability(uses_of(*p.alternative)))) {
            say.emplace_back("probability is stated, but without a method no risk is calculated.");
        }
        return;
    }
    if (!is_method(p.method)) {
        say.emplace_back("method is \"" + p.method + "\"; it must be 1, 2, 3, 4, 5, 6, rds or rp10.");
        return;
    }
    if (p.test_uncertainty_ratio) {
        say.emplace_back(
            "method and test_uncertainty_ratio are both stated; the ratio stands in the place of a method.");
    }
    if (rests_on_population(p.method)) {
        if (!p.population_reliability && !p.population_deviation) {
            say.emplace_back("Method " + p.method + " of DR-09 needs population_reliability or population_deviation.");
        }
    } else if (p.probability && *p.probability != 0.02 && !p.alternative) {
        // The guard bands of these methods are made for a global risk of 2 %. With an alternative the probability may
        // be meant for that rule.
        say.emplace_back("Method " + p.method +
                         " of DR-09 has a guard band of its own; a probability other than 0.02 cannot be " +
                         "kept by it.");
    }
    // The ratio is that of the width of the tolerance to U; one limit has no width.
    if (rests_on_ratio(p.method) && !limits.two_sided()) {
        say.emplace_back("Method " + p.method + " of DR-09 needs two limits.");
    }
}

/// Collects sentences about one rule.
class Check {
public:
    Check(DecisionRule rule, const DecisionRuleParameters& parameters, const ToleranceLimits& limits)
        : rule_(rule), id_(decision_rule_id(rule)), p_(parameters), limits_(limits) {}

    std::vector<std::string> run();

private:
    void say(const std::string& sentence) { sentences_.push_back(sentence); }
    void ranges();
    void range(bool fine, const char* key, const std::optional<double>& value, const char* rule);
    void unused();
    void needs();
    void population();
    void alternative();

    DecisionRule rule_;
    std::string id_;
    const DecisionRuleParameters& p_;
    const ToleranceLimits& limits_;
    std::vector<std::string> sentences_;
};

void Check::range(bool fine, const char* key, const std::optional<double>& value, const char* rule) {
    if (value && !(std::isfinite(*value) && fine)) {
        say(std::string(key) + " is " + text::shortest(*value) + "; it must be " + rule + ".");
    }
}

void Check::ranges() {
    // A negative guard band accepts values outside of the limits: only rules that publish this may have one.
    const bool outwards = row_of(rule_).outwards || (p_.alternative && row_of(*p_.alternative).outwards);
    range(outwards || p_.guard_factor.value_or(0.0) >= 0.0, "guard_factor", p_.guard_factor,
          outwards ? "finite" : "finite and not negative");
    range(outwards || p_.guard_band.value_or(0.0) >= 0.0, "guard_band", p_.guard_band,
          outwards ? "finite" : "finite and not negative");
    range(p_.test_uncertainty_ratio.value_or(1.0) > 0.0, "test_uncertainty_ratio", p_.test_uncertainty_ratio,
          "finite and greater than 0");
    range(p_.largest_U.value_or(1.0) > 0.0, "largest_U", p_.largest_U, "finite and greater than 0");
    range(p_.population_deviation.value_or(1.0) > 0.0, "population_deviation", p_.population_deviation,
          "finite and greater than 0");
    range(true, "population_centre", p_.population_centre, "finite");
    const double reliability = p_.population_reliability.value_or(0.5);
    range(reliability > 0.0 && reliability < 1.0, "population_reliability", p_.population_reliability,
          "greater than 0 and less than 1");
    if (!p_.probability) {
        return;
    }
    const double probability = *p_.probability;
    switch (uses_of(rule_).probability) {
        case Probability::largest_risk:
            range(probability > 0.0 && probability <= 0.5, "probability", p_.probability,
                  "the largest risk, greater than 0 and not above 0.5");
            break;
        case Probability::to_prove:
            range(probability > 0.5 && probability < 1.0, "probability", p_.probability,
                  "the probability to prove, above 0.5 and below 1");
            break;
        case Probability::none:
            range(probability > 0.0 && probability < 1.0, "probability", p_.probability,
                  "greater than 0 and less than 1");
    }
}

void Check::unused() {
    // A parameter that a rule does not look at is refused: who states a guard band must not believe that it was kept.
    const Uses own = uses_of(rule_);
    // Ratio, largest U and the alternative itself are never those of the alternative: they decide whether it applies.
    const Uses other = p_.alternative && own.alternative ? uses_of(*p_.alternative) : Uses{};
    const auto refuse_unused = [&](bool stated, bool used, const char* key) {
        if (stated && !used) {
            say(std::string(key) + " is stated, but " + id_ + " does not use it.");
        }
    };
    refuse_unused(p_.guard_factor.has_value(), own.factor || other.factor, "guard_factor");
    refuse_unused(p_.guard_band.has_value(), own.band || other.band, "guard_band");
    refuse_unused(p_.probability.has_value(), uses_probability(own) || uses_probability(other), "probability");
    refuse_unused(p_.test_uncertainty_ratio.has_value(), own.ratio, "test_uncertainty_ratio");
    refuse_unused(p_.largest_U.has_value(), own.largest_U, "largest_U");
    refuse_unused(p_.alternative.has_value(), own.alternative, "alternative");
    refuse_unused(!p_.method.empty(), own.method || other.method, "method");
}

void Check::needs() {
    if (p_.test_uncertainty_ratio && uses_of(rule_).ratio && !limits_.two_sided()) {
        say("test_uncertainty_ratio is stated, but with one limit alone there is no such ratio.");
    }
    row_of(rule_).needs(p_, limits_, sentences_);
}

void Check::population() {
    if (p_.population_reliability && p_.population_deviation) {
        say("population_reliability and population_deviation are both stated; the one follows from the other.");
        return;
    }
    if (!p_.population_reliability && !p_.population_deviation) {
        if (p_.population_centre) {
            say("population_centre is stated without population_reliability or population_deviation.");
        }
        return;
    }
    if (!limits_.two_sided() && !p_.population_centre) {
        say("A population needs two limits, between which it is centred, or population_centre.");
        return;
    }
    // Solved for only with parameters that are in their ranges.
    if (sentences_.empty() && !stated_population(p_, limits_)) {
        say("No population with this population_centre has this population_reliability.");
    }
}

void Check::alternative() {
    if (!p_.alternative || !uses_of(rule_).alternative) {
        return;
    }
    if (*p_.alternative == rule_) {
        say("The alternative of " + id_ + " is the same rule again.");
        return;
    }
    // An alternative has none of its own (parameters_of_alternative): this goes one level deep.
    for (const std::string& sentence : check_decision_rule(*p_.alternative, parameters_of_alternative(p_), limits_)) {
        say("Alternative: " + sentence);
    }
}

std::vector<std::string> Check::run() {
    if (const std::string problem = limits_problem(limits_); !problem.empty()) {
        return {"The limits cannot be used: " + problem + "."};
    }
    ranges();
    unused();
    needs();
    population();
    // It looks at the same parameters, and would say the same again.
    if (sentences_.empty()) {
        alternative();
    }
    return std::move(sentences_);
}

}  // namespace

std::string decision_rule_id(DecisionRule rule) {
    return std::string(row_of(rule).id);
}

std::optional<DecisionRule> decision_rule_from_id(const std::string& id) {
    const auto found = std::ranges::find(k_rules, id, &Row::id);
    return found == k_rules.end() ? std::nullopt : std::optional(found->rule);
}

std::vector<std::string_view> decision_rule_ids() {
    std::vector<std::string_view> ids;
    for (const Row& row : k_rules) {
        ids.push_back(row.id);
    }
    return ids;
}

DecisionRuleParameters parameters_of_alternative(const DecisionRuleParameters& parameters) {
    DecisionRuleParameters others = parameters;
    // The alternative is taken because the ratio was not kept: asked again it would be refused by the same condition.
    others.test_uncertainty_ratio.reset();
    others.largest_U.reset();
    others.alternative.reset();
    const Uses uses = parameters.alternative ? uses_of(*parameters.alternative) : Uses{};
    if (!uses.factor) {
        others.guard_factor.reset();
    }
    if (!uses.band) {
        others.guard_band.reset();
    }
    if (!uses_probability(uses)) {
        others.probability.reset();
    }
    if (!uses.method) {
        others.method.clear();
    }
    return others;
}

std::optional<Population> stated_population(const DecisionRuleParameters& parameters, const ToleranceLimits& limits) {
    if (!parameters.population_centre && !limits.two_sided()) {
        return std::nullopt;
    }
    const double centre = parameters.population_centre ? *parameters.population_centre
                                                       : *limits.lower + 0.5 * (*limits.upper - *limits.lower);
    if (parameters.population_deviation) {
        return Population{centre, *parameters.population_deviation};
    }
    if (!parameters.population_reliability) {
        return std::nullopt;
    }
    const std::optional<double> deviation = population_deviation(limits, centre, *parameters.population_reliability);
    return deviation ? std::optional(Population{centre, *deviation}) : std::nullopt;
}

bool decides_by_probability(DecisionRule rule, const DecisionRuleParameters& parameters) {
    return rule == DecisionRule::specific_risk || (rule == DecisionRule::iso_14253_1 && !parameters.guard_factor) ||
           (rule == DecisionRule::z540_3 && parameters.method == "4");
}

std::vector<std::string> check_decision_rule(DecisionRule rule, const DecisionRuleParameters& parameters,
                                             const ToleranceLimits& limits) {
    return Check(rule, parameters, limits).run();
}

}  // namespace gumcert::gum
