// Conformity of a measured value with its limits, under several decision rules, and the risks of a population of items
// before any of them is measured.
#include <cstdio>
#include <string>

#include "gum/conformity/conformity.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"

using namespace gumcert::gum;

int main() try {
    // The breakdown voltage of a Zener diode, -5.47 V with u = 0.05 V, must not be above -5.40 V (JCGM 106:2012).
    const ToleranceLimits limit{.upper = -5.40};
    MeasuredValue voltage;
    voltage.value = -5.47;
    voltage.standard_uncertainty = 0.05;
    voltage.expanded_uncertainty = 0.10;
    std::printf("probability of conformity %.2f\n", conformance_probability(voltage, limit));
    for (const DecisionRule rule :
         {DecisionRule::simple_acceptance, DecisionRule::guard_band_u, DecisionRule::non_binary}) {
        const ConformityDecision decision = decide_conformity(rule, {}, limit, voltage);
        std::printf("%s: accepted up to %.2f V, %s, risk %.1f %%\n", decision_rule_id(rule).c_str(),
                    *decision.acceptance.upper, verdict_name(decision.verdict).c_str(), 100.0 * decision.specific_risk);
    }
    // ILAC-G8: on the acceptance limit of DR-04 with r = 0.83 and k = 2 the risk is 4.85 %.
    const ConformityDecision guarded =
        decide_conformity(DecisionRule::guard_band_factor, {.guard_factor = 0.83}, limit, voltage);
    std::printf("DR-04, r = 0.83: largest risk %.2f %%\n", 100.0 * *guarded.largest_specific_risk);

    // NCSLI RP-19 (draft table): 80 % of the items are inside of ±1, and u is a quarter of their standard deviation.
    const ToleranceLimits tolerance{.lower = -1.0, .upper = 1.0};
    const double deviation = population_deviation(1.0, 0.8);
    const GlobalRisk risk = global_risk(tolerance, tolerance, 0.0, deviation, 0.25 * deviation);
    std::printf("falsely accepted %.5f %% of all, %.5f %% of those accepted\n", 100.0 * risk.false_accept,
                100.0 * risk.conditional_false_accept);
    return 0;
} catch (const DiagnosedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
