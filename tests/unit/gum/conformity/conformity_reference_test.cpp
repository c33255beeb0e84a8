#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "gum/conformity/conformity.h"
#include "gum/coverage.h"
#include "gum/distribution_quantile.h"
#include "tests/support/reference_case.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

// Cases on conformity: the value, limits and rule of each job, decided without the program. A kind of number that is not
// known here fails the test.

using gumcert::test::job_of;
using gumcert::test::reference_case;
using nlohmann::json;

const ToleranceLimits k_tolerance_of_table{.lower = -1.0, .upper = 1.0};

/// Within the tolerance that the case states, or half a unit of the last printed digit.
void expect(const json& expected, double value) {
    const double wanted = gumcert::test::expected_number(expected);
    double tolerance = 0.0;
    if (expected.contains("tolerance")) {
        tolerance = expected["tolerance"];
    } else if (expected.contains("relative_tolerance")) {
        tolerance = expected["relative_tolerance"].get<double>() * std::abs(wanted);
    } else {
        tolerance = test::printed(expected["printed"].get<std::string>()).half_unit;
    }
    EXPECT_NEAR(value, wanted, tolerance) << expected["quantity"];
}

MeasuredValue measured(double y, double u) {
    return {.value = y, .standard_uncertainty = u, .expanded_uncertainty = 2.0 * u};
}
/// The only input of a job.
MeasuredValue measured(const json& job) {
    const json& x = job["inputs"]["x"];
    if (x.contains("limits")) {
        const double lower = x["limits"][0];
        const double upper = x["limits"][1];
        const std::string shape = x["distribution"];
        EXPECT_TRUE(shape == "uniform" || shape == "triangular") << shape;
        const Distribution bounded{
            .kind = shape == "uniform" ? DistributionKind::uniform : DistributionKind::triangular,
            .location = 0.5 * (lower + upper),
            .scale = 0.5 * (upper - lower)};
        MeasuredValue y = measured(bounded.location, standard_deviation(bounded));
        y.distribution = [bounded](double value) { return lower_tail_probability(bounded, value); };
        return y;
    }
    MeasuredValue y =
        measured(x["value"], x.contains("u") ? x["u"].get<double>() : x["U"].get<double>() / x["k"].get<double>());
    if (x.contains("nu")) {
        y.degrees_of_freedom = x["nu"].get<double>();
        y.expanded_uncertainty = coverage_factor(0.9545, x["nu"].get<double>()) * y.standard_uncertainty;
    }
    return y;
}

json specification(const json& job) {
    return job["certificate"]["specifications"][0];
}
ToleranceLimits limits_of(const json& job) {
    ToleranceLimits limits;
    for (const auto& [key, limit] : {std::pair{"lower", &limits.lower}, std::pair{"upper", &limits.upper}}) {
        if (specification(job).contains(key)) {
            *limit = specification(job)[key].get<double>();
        }
    }
    return limits;
}

TEST(ConformityReference, ConformityProbability) {
    for (const char* id : {"conformity-nonnormal", "cpk-specific-risk-a", "jcgm106-oil", "jcgm106-zener"}) {
        SCOPED_TRACE(id);
        const json problem = reference_case(id);
        for (const json& expected : problem["expected"]) {
            const std::string kind = expected["kind"];
            if (kind == "cpk") {  // process capability index: not a number of a certificate
                continue;
            }
            const json job = job_of(problem, expected);
            const ConformityDecision decision =
                decide_conformity(DecisionRule::simple_acceptance, {}, limits_of(job), measured(job));
            if (kind == "conformance_probability") {
                expect(expected, decision.conformance_probability);
            } else {
                ASSERT_TRUE(kind == "specific_consumer_risk" || kind == "specific_risk") << kind;
                EXPECT_EQ(decision.verdict, ConformityVerdict::pass);
                expect(expected, decision.specific_risk);
            }
        }
    }
}

TEST(ConformityReference, GuardBandRules) {
    const json problem = reference_case("guard-band-rules");
    for (const json& expected : problem["expected"]) {
        ASSERT_EQ(expected["kind"], "guard_band_factor");
        const json job = job_of(problem, expected);
        const ConformityDecision decision =
            decide_conformity(DecisionRule::z540_3, {.method = specification(job)["rule"]["method"]},
                              k_tolerance_of_table, measured(job));
        expect(expected, decision.acceptance.upper.value());
        expect(expected, -decision.acceptance.lower.value());
    }
}

TEST(ConformityReference, DecisionRule) {
    const std::map<std::string, ConformityVerdict> verdicts{{"pass", ConformityVerdict::pass},
                                                            {"fail", ConformityVerdict::fail},
                                                            {"undetermined", ConformityVerdict::undetermined}};
    const ToleranceLimits limits{9.9, 10.1};
    constexpr double u = 0.02;
    const ConformityDecision solved = decide_conformity(DecisionRule::iso_14253_1, {}, limits, measured(10.0, u));
    // The case calculates its limits with the factor rounded to 1.65: r = 0.825 of U = 2 u.
    const DecisionRuleParameters rounded{.guard_factor = 0.825};
    const ConformityDecision tabled = decide_conformity(DecisionRule::iso_14253_1, rounded, limits, measured(10.0, u));
    const std::map<std::string, double> zones{{"acceptance_low", *tabled.acceptance.lower},
                                              {"acceptance_high", *tabled.acceptance.upper},
                                              {"rejection_low", *tabled.rejection.lower},
                                              {"rejection_high", *tabled.rejection.upper},
                                              {"g", tabled.guard_band},
                                              {"guard band factor", solved.guard_band / u}};
    const json problem = reference_case("iso14253-1-guard-band");
    for (const json& expected : problem["expected"]) {
        const std::string quantity = expected["quantity"];
        if (expected["kind"] == "decision") {
            const MeasuredValue y = measured(test::number(quantity.substr(2)), u);
            const ConformityVerdict verdict = verdicts.at(expected["computed"]);
            EXPECT_EQ(decide_conformity(DecisionRule::iso_14253_1, {}, limits, y).verdict, verdict) << quantity;
            EXPECT_EQ(decide_conformity(DecisionRule::iso_14253_1, rounded, limits, y).verdict, verdict) << quantity;
        } else {
            expect(expected, zones.at(quantity));
        }
    }
}

TEST(ConformityReference, GlobalRisk) {
    const json problem = reference_case("rp19-false-accept-table");
    for (const json& expected : problem["expected"]) {
        const std::string quantity = expected["quantity"];  // "UFAR(0.9)"
        const std::size_t bracket = quantity.find('(');
        const double reliability = test::number(quantity.substr(bracket + 1, quantity.size() - bracket - 2));
        const double deviation = population_deviation(1.0, reliability);
        const GlobalRisk risk =
            global_risk(k_tolerance_of_table, k_tolerance_of_table, 0.0, deviation, deviation / 4.0);
        const std::string kind = expected["kind"];
        if (kind == "false_accept_percent") {
            expect(expected, 100.0 * risk.false_accept);
        } else if (kind == "conditional_false_accept_percent") {
            expect(expected, 100.0 * risk.conditional_false_accept);
        } else {
            ASSERT_EQ(kind, "false_reject_percent");
            expect(expected, 100.0 * risk.false_reject);
        }
    }
}

}  // namespace
}  // namespace gumcert::gum
