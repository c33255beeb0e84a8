#pragma once

#include <optional>
#include <string>

#include "gum/conformity/conformance_probability.h"
#include "gum/conformity/decision_rule.h"
#include "gum/conformity/global_risk.h"
#include "gum/conformity/tolerance_limits.h"

namespace gumcert::gum {

// Conformity of a measured value with tolerance limits, under a decision rule (JCGM 106:2012; ILAC-G8:09/2019; ISO
// 14253-1; ANSI/NCSL Z540.3). All numbers of one call are in one unit; a change of the unit changes no verdict.

enum class ConformityVerdict { pass, fail, conditional_pass, conditional_fail, undetermined, not_applicable };

/// "pass", "conditional_pass" … as records write it.
[[nodiscard]] std::string verdict_name(ConformityVerdict verdict);

struct ConformityDecision {
    ConformityVerdict verdict = ConformityVerdict::not_applicable;
    /// the one applied: the alternative where the first one cannot be
    DecisionRule rule = DecisionRule::simple_acceptance;
    std::string formula = {};  ///< "AL = TL + r·U, AU = TU − r·U, r = 0.5"
    double guard_band = 0.0;   ///< w, below 0 outwards; the larger one where the two sides differ; 0 without limits
    ToleranceLimits acceptance = {};  ///< AL, AU; AL ≥ AU, or neither: no value can pass
    bool accepts_nothing = false;     ///< no value can pass, because the zone of acceptance has no width
    /// DR-05, DR-06, DR-08: beyond them, nonconformity is stated; also where no value can pass. Else empty
    ToleranceLimits rejection = {};
    double conformance_probability = 0.0;  ///< p_c; DR-09 method 4: with the population as prior
    /// p_c where rejected, also conditionally; else 1 − p_c, which is what an acceptance would risk
    double specific_risk = 0.0;
    /// 1 − p_c of a value at the worse acceptance limit; not where no value can pass, or the rule is not applicable; nor
    /// where a limit is a bound of the quantity itself, and the rule holds no risk: of another value the distribution is not known
    std::optional<double> largest_specific_risk = {};
    /// Global risks, unconditional, of the stated population, measured with a normal distribution. DR-09 methods 5, 6,
    /// rds and rp10 without a population: the largest false accept probability of any centred one (`note` says so)
    std::optional<double> false_accept = {}, false_reject = {};
    std::optional<double> test_uncertainty_ratio = {};  ///< (T_U − T_L)/(2 U); two-sided limits only
    std::string note = {};                              ///< why a rule is not applicable, or an alternative was taken
};

/// Applies a decision rule to one measured value.
///
/// A value on an acceptance limit passes, and one within the rounding of the arithmetic of double precision counts as
/// on it: with T_U = 0.3 and U = 0.1, y = 0.2 passes DR-03. Where A_L ≥ A_U within that rounding, or the rule cannot be
/// applied, no value can pass; the verdict is not_applicable then, because an item does not fail for a poor measurement, and fail where
/// nonconformity is proven: y beyond the limits by more than U, or where the rule itself begins to reject (DR-05,
/// DR-06, DR-08, DR-09 by method 4). So far out every rule says fail. Where the probability of a rule by risk is counted
/// from trials and lies within three standard uncertainties of the count from that of the rule, nothing is decided:
/// undetermined with DR-08, else not_applicable.
/// \throws InputError  GC-GUM-0080 limits, GC-GUM-0081 measured value, GC-GUM-0082 every fault that
///     `check_decision_rule` finds with the rule
/// Accuracy: probabilities and acceptance limits within 1e-11 relative where the distribution is normal or t
/// (docs/accuracy.md#conformity-and-global-risk).
/// Example: examples/api/conformity.cpp
[[nodiscard]] ConformityDecision decide_conformity(DecisionRule rule, const DecisionRuleParameters& parameters,
                                                   const ToleranceLimits& limits, const MeasuredValue& y);

/// How a rule decides, as ConformityDecision::formula, where there is no value to decide on. "" where the limits or the
/// parameters cannot be used.
[[nodiscard]] std::string decision_formula(DecisionRule rule, const DecisionRuleParameters& parameters,
                                           const ToleranceLimits& limits);

}  // namespace gumcert::gum
