#include "reports/record/make/certificate/certified_conformity.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "certificate/agreed_rule.h"
#include "certificate/statement_of_uncertainty.h"
#include "gum/conformity/conformance_probability.h"
#include "gum/conformity/conformity.h"
#include "gum/conformity/tolerance_limits.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rounding.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using certificate::AgreedSpecification;
using certificate::CertifiedValue;
using certificate::Verdict;
using gum::ConformityDecision;

/// The numbers of a value that its decision rests on.
struct DecisionNumbers {
    gum::MeasuredValue unrounded, printed;
    bool raised = false;  ///< U is the capability in place of a smaller one
};

/// U of a value: stated, or the larger distance of an end of its interval from it, so that neither end is nearer to a
/// limit than a rule with U believes.
std::optional<double> half_width(std::optional<double> U, double y, std::optional<double> low,
                                 std::optional<double> high) {
    if (U) {
        return U;
    }
    return low && high ? std::optional(std::max(y - *low, *high - y)) : std::nullopt;
}

/// Whether a limit is a value that the quantity takes with a probability of its own, or one that it cannot pass.
bool has_bound_at(const gum::MeasuredValue& y, const gum::ToleranceLimits& limits) {
    const auto has_own = [&y](const std::optional<double>& limit) {
        return limit && gum::has_probability_of_its_own(y, *limit);
    };
    const gum::ToleranceLimits passable = gum::limits_that_can_be_passed(y, limits);
    return has_own(limits.lower) || has_own(limits.upper) || passable.lower != limits.lower ||
           passable.upper != limits.upper;
}

std::optional<DecisionNumbers> numbers_of(const CertifiedValue& from, const KnownDistribution& known,
                                          const gum::ToleranceLimits& limits) {
    constexpr double k_usual_factor = 2.0;
    const std::optional<double> y = certificate::number_of(from.printed_value);
    const bool by_interval = !from.U && from.interval && known.function;
    if (!y || (!by_interval && (!from.U || !from.k))) {
        return std::nullopt;
    }
    const std::optional<double> U =
        by_interval ? half_width({}, from.value, from.interval->first, from.interval->second) : from.U;
    const std::optional<double> U_printed = by_interval ? half_width({}, *y, certificate::number_of(from.printed_low),
                                                                     certificate::number_of(from.printed_high))
                                                        : certificate::number_of(from.printed_U);
    // An interval has no k. Where the distribution is known, u only says how far a search for a limit has to go.
    const double k = by_interval ? (from.u > 0.0 ? *U / from.u : k_usual_factor) : *from.k;
    const std::optional<double> k_printed = by_interval ? std::optional(k) : certificate::number_of(from.printed_k);
    if (!U || !U_printed || !k_printed || !(k > 0.0) || !(*k_printed > 0.0) || !(*U_printed > 0.0)) {
        return std::nullopt;
    }
    DecisionNumbers out;
    // Also where rounding alone has lifted U to the capability.
    out.raised = !by_interval && certificate::states_capability(*U, from.printed_U, from.capability);
    out.unrounded.value = from.value;
    out.unrounded.expanded_uncertainty = out.raised ? *from.capability : *U;
    out.unrounded.standard_uncertainty = out.unrounded.expanded_uncertainty / k;
    out.unrounded.degrees_of_freedom = from.nu_eff.value_or(std::numeric_limits<double>::infinity());
    out.printed = out.unrounded;
    out.printed.value = *y;
    out.printed.expanded_uncertainty = *U_printed;
    out.printed.standard_uncertainty = *U_printed / *k_printed;
    if (known.function && *U > 0.0) {
        // The same shape about the value, as wide as the stated U: k and p hold for it as they do for the evaluated U.
        const auto place = [&](gum::MeasuredValue& numbers, bool as_it_is, double stated_U) {
            const auto stretched = [&](const std::function<double(double)>& function) {
                return [function, stretch = *U / stated_U, centre = from.value, value = numbers.value](double x) {
                    return function(centre + (x - value) * stretch);
                };
            };
            numbers.trials = static_cast<double>(known.trials);
            numbers.least_probability = known.least_probability;
            numbers.distribution = as_it_is ? known.function : stretched(known.function);
            if (known.below) {
                numbers.distribution_below = as_it_is ? known.below : stretched(known.below);
            }
        };
        place(out.unrounded, !out.raised, out.unrounded.expanded_uncertainty);
        // A limit that the quantity itself cannot pass stays where it is when y is rounded.
        place(out.printed, !out.raised && has_bound_at(out.unrounded, limits), *U_printed);
    }
    return out;
}

/// Never above the ratio, so that it does not seem to reach a least one that it misses.
std::string printed_ratio(double ratio) {
    return certificate::printed_at_most(ratio, certificate::decimals_of(gum::round_significant(ratio, 3)));
}

void print_limits(Verdict& verdict, int decimals) {
    const auto limit = [&](const std::optional<double>& l) {
        return l ? certificate::printed_limit(*l, decimals) : std::string();
    };
    verdict.printed.lower = limit(verdict.lower);
    verdict.printed.upper = limit(verdict.upper);
}

/// Behind the point for two significant digits of a guard band; none more where the second one is 0.
int decimals_of_width(double w) {
    constexpr int k_most = 18;
    const std::string two = gum::round_significant(w, 2);
    const std::string one = gum::round_significant(w, 1);
    constexpr double k_noise = 1e-9;  // relative
    const bool one_says_it = std::abs(certificate::number_of(one).value_or(0.0) - w) <= k_noise * std::abs(w);
    return std::min(certificate::decimals_of(one_says_it ? one : two), k_most);
}

/// Whether a rule keeps a distance from the limits, of whatever width: "AL = TL, AU = TU" has none, "AL = TL + M·U" has one
/// where M is 0, too.
bool has_guard_band(const ConformityDecision& decision) {
    const std::string& formula = decision.formula;
    return decision.guard_band != 0.0 || formula.find("TL ") != std::string::npos ||
           formula.find("TU ") != std::string::npos;
}

/// Guard band, acceptance limits and ratio are those of the printed value and U, so that they can be checked by hand
/// with what stands beside them, and that the printed value is inside of them where the verdict says so.
/// \param shown  the decision from the printed numbers
/// \param is_converted  the limits were agreed in another unit than that of the result
void print(Verdict& verdict, const ConformityDecision& shown, int decimals, bool is_converted) {
    // A limit in °F has digits without an end in °C: they are none of the guard band.
    constexpr int k_digits_of_a_stated_limit = 9;
    // Acceptance limits follow from U: they end where value and limits end, or where w ends, of which two digits say what
    // it is: 0.5·U is 0.55 and not 0.6 for U = 1.1.
    int finest = decimals;
    for (const std::string& text : {verdict.printed.lower, verdict.printed.upper}) {
        const bool is_endless = is_converted && certificate::significant_digits(text) > k_digits_of_a_stated_limit;
        finest = text.empty() || is_endless ? finest : std::max(finest, certificate::decimals_of(text));
    }
    // A discrete distribution about the printed value may leave room where that about the value leaves none.
    const gum::ToleranceLimits& accepted = shown.acceptance;
    const bool has_zone = verdict.acceptance_lower || verdict.acceptance_upper;
    const bool has_lower = has_zone && accepted.lower.has_value();
    const bool has_upper = has_zone && accepted.upper.has_value();
    const bool guarded = has_lower || has_upper;  // else no value is accepted, and there is no band
    if (shown.guard_band != 0.0 && guarded) {
        finest = std::max(finest, decimals_of_width(shown.guard_band));
    }
    verdict.printed.acceptance_lower = has_lower ? certificate::printed_at_least(*accepted.lower, finest) : "";
    verdict.printed.acceptance_upper = has_upper ? certificate::printed_at_most(*accepted.upper, finest) : "";
    verdict.printed.guard_band =
        guarded && has_guard_band(shown) ? certificate::printed_at_least(shown.guard_band, finest) : "";
    verdict.printed.test_uncertainty_ratio =
        shown.test_uncertainty_ratio ? printed_ratio(*shown.test_uncertainty_ratio) : "";
    const auto percent = [](const std::optional<double>& p) {
        return p ? certificate::printed_probability(*p) : std::string();
    };
    verdict.printed.conformance_probability = certificate::printed_probability(verdict.conformance_probability);
    verdict.printed.specific_risk = certificate::printed_probability(verdict.specific_risk);
    verdict.printed.largest_specific_risk = percent(verdict.largest_specific_risk);
    verdict.printed.false_accept = percent(verdict.false_accept);
    verdict.printed.false_reject = percent(verdict.false_reject);
}

/// What a finite number of trials leaves open of a probability that is counted. One trial stands for "none" and "all".
std::string error_of_count(const KnownDistribution& known, const Verdict& verdict) {
    if (known.trials == 0) {
        return "";
    }
    const auto trials = static_cast<double>(known.trials);
    const double p = std::clamp(verdict.conformance_probability, 1.0 / trials, 1.0 - 1.0 / trials);
    // A reader of a page has no use for 1E-5.
    const std::string one_digit = gum::round_significant(100.0 * std::sqrt(p * (1.0 - p) / trials), 1);
    const double rounded = certificate::number_of(one_digit).value_or(0.0);
    return " The standard uncertainty of the conformance probability from their number is " +
           text::shortest_plain(rounded, 0.0) + " %.";
}

/// Whether a formula has the letter U as a quantity, or the ratio that is made with it: not TU, the limit, nor AU.
bool names_U(const std::string& formula) {
    const auto is_letter = [&](std::size_t at) {
        return at < formula.size() && std::isalnum(static_cast<unsigned char>(formula[at])) != 0;
    };
    for (std::size_t at = formula.find('U'); at != std::string::npos; at = formula.find('U', at + 1)) {
        const bool alone = !is_letter(at + 1) && (at == 0 || !is_letter(at - 1));
        if (alone || formula.compare(at - std::min<std::size_t>(at, 1), 3, "TUR") == 0) {
            return true;
        }
    }
    return false;
}

void fill(Verdict& verdict, const ConformityDecision& decision) {
    verdict.rule = gum::decision_rule_id(decision.rule);
    verdict.formula = decision.formula;
    verdict.acceptance_lower = decision.acceptance.lower;
    verdict.acceptance_upper = decision.acceptance.upper;
    verdict.guard_band = decision.guard_band;
    verdict.verdict = gum::verdict_name(decision.verdict);
    verdict.conformance_probability = decision.conformance_probability;
    verdict.specific_risk = decision.specific_risk;
    verdict.largest_specific_risk = decision.largest_specific_risk;
    verdict.false_accept = decision.false_accept;
    verdict.false_reject = decision.false_reject;
    verdict.test_uncertainty_ratio = decision.test_uncertainty_ratio;
    verdict.note = decision.note;
}

/// The same measurement with another value: its distribution is moved by as much.
gum::MeasuredValue moved_to(const gum::MeasuredValue& y, double value) {
    gum::MeasuredValue other = y;
    other.value = value;
    const auto moved = [by = value - y.value](const std::function<double(double)>& function) {
        return function ? [function, by](double x) { return function(x - by); } : std::function<double(double)>();
    };
    other.distribution = moved(y.distribution);
    other.distribution_below = moved(y.distribution_below);
    return other;
}

void add_sentence(std::string& note, const std::string& sentence) {
    note += (note.empty() ? "" : " ") + sentence;
}

/// The model gives another value at the estimates than the mean of the trials that is stated. What the rule says of it is told
/// where it differs. Where evidence is against that mean nothing is decided then, and no probability is stated.
/// \param other  what the rule says of that value
/// \return whether nothing is decided by it
bool is_withheld(Verdict& verdict, bool is_in_doubt, const ConformityDecision& other) {
    const bool has_word = other.rule == gum::DecisionRule::three_way || other.rule == gum::DecisionRule::iso_14253_1;
    const bool is_same = verdict.verdict == gum::verdict_name(other.verdict);
    if (verdict.verdict == "not_applicable" || (is_same && !is_in_doubt)) {
        return false;
    }
    const std::string model_gives =
        "At the estimates of the input quantities the measurement model gives another value than the mean of the Monte "
        "Carlo trials, and the rule ";
    if (is_same || !is_in_doubt) {
        add_sentence(verdict.note, model_gives + (is_same ? "the same verdict." : "another verdict."));
        return false;
    }
    verdict.verdict = verdict.verdict_from_printed = has_word ? "undetermined" : "not_applicable";
    verdict.largest_specific_risk.reset();
    verdict.false_accept.reset();
    verdict.false_reject.reset();
    verdict.note = model_gives + "another verdict: nothing is decided.";
    return true;
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
    const certificate::AgreedRule rule = certificate::agreed_rule(specification, column.unit);
    verdict.lower = rule.limits.lower;
    verdict.upper = rule.limits.upper;
    if (!rule.problem.empty()) {
        return not_applicable(verdict, rule.problem);
    }
    verdict.formula = gum::decision_formula(rule.rule, rule.parameters, rule.limits);
    const int decimals = value.printed_value.empty() ? 0 : certificate::decimals_of(value.printed_value);
    print_limits(verdict, decimals);  // they were agreed for the value, whether or not it can be decided
    if (value.external) {
        return not_applicable(verdict,
                              "another laboratory provided the result, and its conformity is not decided here");
    }
    const std::optional<DecisionNumbers> numbers = numbers_of(value, known, rule.limits);
    if (!numbers) {
        // U = 0 of constants, or none at all; what cancels has u = 0 too, and was measured.
        const bool is_defined = value.U ? *value.U == 0.0 : value.u == 0.0 && value.coverage != "none";
        return not_applicable(verdict, is_defined ? "the value is defined, not measured: it has no uncertainty"
                                                  : "no expanded uncertainty is stated for the value");
    }
    ConformityDecision shown;
    try {
        shown = gum::decide_conformity(rule.rule, rule.parameters, rule.limits, numbers->unrounded);
        fill(verdict, shown);
        const ConformityDecision by_hand =
            gum::decide_conformity(rule.rule, rule.parameters, rule.limits, numbers->printed);
        verdict.verdict_from_printed = gum::verdict_name(by_hand.verdict);
        if (by_hand.rule == shown.rule && by_hand.accepts_nothing &&
            by_hand.verdict == gum::ConformityVerdict::not_applicable) {
            fill(verdict, by_hand);  // nobody could follow that a value fails where none can pass
        }
        // Where rounding has moved U or a ratio past the condition of the rule, and both rules say the same, the page states
        // the one whose condition the printed U keeps or not; where they say different things, that is a finding (D04).
        if (by_hand.rule != shown.rule && by_hand.verdict == shown.verdict) {
            fill(verdict, by_hand);
            shown = by_hand;
        } else if (by_hand.rule == shown.rule) {
            shown = by_hand;
        }
    } catch (const gum::DiagnosedError& error) {
        const gum::Diagnostic& first = error.diagnostics().front();
        return not_applicable(verdict, first.what + ": " + first.rule);
    }
    const bool withheld = known.at_estimates &&
                          is_withheld(verdict, known.at_estimates->is_in_doubt,
                                      gum::decide_conformity(rule.rule, rule.parameters, rule.limits,
                                                             moved_to(numbers->unrounded, known.at_estimates->value)));
    // Where nothing was decided no probability is printed, and none has to be explained.
    const bool is_open = withheld || (verdict.verdict == "not_applicable" && !verdict.largest_specific_risk);
    if (!known.note.empty() && !is_open && (!known.function || numbers->unrounded.distribution)) {
        verdict.note += (verdict.note.empty() ? "" : " ") + known.note + error_of_count(known, verdict);
        if (numbers->raised && numbers->unrounded.distribution) {
            verdict.note +=
                " Its deviations from the value are widened in the ratio of the stated to the evaluated U, because the "
                "capability of the laboratory is stated: k and the coverage probability hold for the stated U.";
        }
        if (!value.U && names_U(verdict.formula)) {
            verdict.note +=
                " U in the formula of the rule is the larger distance of an end of the coverage interval "
                "from the value.";
        }
    }
    print(verdict, shown, decimals, specification.unit != column.unit);
    if (is_open) {
        // A record has no place for "none" where a probability stands (record/1): it has 0, as where a rule does not apply.
        verdict.conformance_probability = verdict.specific_risk = 0.0;
        verdict.printed.conformance_probability.clear();
        verdict.printed.specific_risk.clear();
    }
    return verdict;
}

}  // namespace gumcert::reports
