#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "gum/conformity.h"
#include "gum/coverage.h"
#include "gum/distribution_quantile.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

// Cases of the four procedures on conformity, from the folder of reference problems beside the tree. Each case is read
// by its procedure; a kind of number that is not known here fails the test.

using nlohmann::json;

const ToleranceLimits k_tolerance_of_table{.lower = -1.0, .upper = 1.0};

std::filesystem::path folder() {
    return std::filesystem::path(GUMCERT_SHARED_DIR) / "reference";
}

std::map<std::string, json> cases_of(const std::string& procedure) {
    std::map<std::string, json> cases;
    for (const auto& entry : std::filesystem::directory_iterator(folder())) {
        if (entry.path().extension() != ".json") {
            continue;
        }
        std::ifstream file(entry.path());
        json problem = json::parse(file);
        if (problem.value("procedure", "") == procedure) {
            cases.emplace(problem["id"], std::move(problem));
        }
    }
    return cases;
}

#define SKIP_WITHOUT_CASES()                        \
    if (!std::filesystem::exists(folder())) {       \
        GTEST_SKIP() << "no shared reference data"; \
    }                                               \
    static_assert(true)

std::optional<double> number_of(const json& object, const char* key) {
    return object.contains(key) && !object[key].is_null() ? std::optional(object[key].get<double>()) : std::nullopt;
}

/// Within the tolerance that the case states.
void expect(const json& expected, double value) {
    EXPECT_NEAR(value, expected["value"].get<double>(), expected["tolerance"].get<double>()) << expected["quantity"];
}

MeasuredValue measured(double y, double u) {
    return {.value = y, .standard_uncertainty = u, .expanded_uncertainty = 2.0 * u};
}
MeasuredValue measured(const json& distribution) {
    const std::string type = distribution["type"];
    if (type == "t") {
        const double nu = distribution["dof"];
        const double scale = distribution["scale"];
        return {.value = distribution["location"],
                .standard_uncertainty = scale,
                .expanded_uncertainty = coverage_factor(0.9545, nu) * scale,
                .degrees_of_freedom = nu};
    }
    const double lower = distribution["lower"];
    const double upper = distribution["upper"];
    const Distribution bounded{.kind = type == "rectangular" ? DistributionKind::uniform : DistributionKind::triangular,
                               .location = 0.5 * (lower + upper),
                               .scale = 0.5 * (upper - lower)};
    EXPECT_TRUE(type == "rectangular" || type == "triangular") << type;
    MeasuredValue y = measured(bounded.location, standard_deviation(bounded));
    y.distribution = [bounded](double x) { return lower_tail_probability(bounded, x); };
    return y;
}

TEST(ConformityReference, ConformityProbability) {
    SKIP_WITHOUT_CASES();
    const auto cases = cases_of("conformity_probability");
    EXPECT_GE(cases.size(), 4U);
    for (const auto& [id, problem] : cases) {
        SCOPED_TRACE(id);
        const json data = problem.value("data", json::object());
        for (const json& expected : problem["expected"]) {
            const json given = expected.value("given", json::object());
            ToleranceLimits limits{number_of(data, "lower_limit"), number_of(data, "upper_limit")};
            if (data.contains("limits")) {
                limits = {data["limits"][0].get<double>(), data["limits"][1].get<double>()};
            }
            if (given.contains("distribution")) {
                limits = {number_of(given, "lower"), number_of(given, "upper")};
            }
            const MeasuredValue y = given.contains("distribution") ? measured(given["distribution"])
                                    : given.contains("mean")       ? measured(given["mean"], given["std"])
                                                                   : measured(data["y"], data["u"]);
            const ConformityDecision decision = decide_conformity(DecisionRule::simple_acceptance, {}, limits, y);
            const std::string kind = expected["kind"];
            if (kind.starts_with("conformance_probability")) {
                expect(expected, decision.conformance_probability);
            } else if (kind == "specific_consumer_risk" || kind == "specific_risk") {
                EXPECT_EQ(decision.verdict, ConformityVerdict::pass);
                expect(expected, decision.specific_risk);
            } else {
                // A process capability index is not a number of a certificate: min(TU − y, y − TL)/(3 u).
                EXPECT_EQ(kind, "cpk");
            }
        }
    }
}

TEST(ConformityReference, GuardBandRules) {
    SKIP_WITHOUT_CASES();
    const std::map<std::string, std::string> methods{
        {"rss", "rds"}, {"test95", "5"}, {"rp10", "rp10"}, {"dobbert", "6"}};
    const auto cases = cases_of("guard_band_rules");
    EXPECT_GE(cases.size(), 1U);
    for (const auto& [id, problem] : cases) {
        SCOPED_TRACE(id);
        for (const json& expected : problem["expected"]) {
            ASSERT_EQ(expected["kind"], "guard_band_factor");
            const std::string quantity = expected["quantity"];
            const std::string method = methods.at(quantity.substr(0, quantity.find('(')));
            const double ratio = expected["given"]["TUR"];
            const ConformityDecision decision = decide_conformity(DecisionRule::z540_3, {.method = method},
                                                                  k_tolerance_of_table, measured(0.0, 0.5 / ratio));
            expect(expected, decision.acceptance.upper.value());
            expect(expected, -decision.acceptance.lower.value());
        }
    }
}

TEST(ConformityReference, DecisionRule) {
    SKIP_WITHOUT_CASES();
    const std::map<std::string, ConformityVerdict> verdicts{{"conformity", ConformityVerdict::pass},
                                                            {"nonconformity", ConformityVerdict::fail},
                                                            {"undecided", ConformityVerdict::undetermined}};
    const auto cases = cases_of("decision_rule");
    EXPECT_GE(cases.size(), 1U);
    for (const auto& [id, problem] : cases) {
        SCOPED_TRACE(id);
        // The limits are not among its data: 9.9 and 10.1, from the stated acceptance and rejection limits.
        const ToleranceLimits limits{9.9, 10.1};
        constexpr double u = 0.02;
        const ConformityDecision solved = decide_conformity(DecisionRule::iso_14253_1, {}, limits, measured(10.0, u));
        // The case calculates its limits with the factor rounded to 1.65: r = 0.825 of U = 2 u.
        const DecisionRuleParameters rounded{.guard_factor = 0.825};
        const ConformityDecision tabled =
            decide_conformity(DecisionRule::iso_14253_1, rounded, limits, measured(10.0, u));
        const std::map<std::string, double> zones{{"acceptance_low", *tabled.acceptance.lower},
                                                  {"acceptance_high", *tabled.acceptance.upper},
                                                  {"rejection_low", *tabled.rejection.lower},
                                                  {"rejection_high", *tabled.rejection.upper},
                                                  {"g", tabled.guard_band},
                                                  {"guard band factor", solved.guard_band / u}};
        for (const json& expected : problem["expected"]) {
            const std::string quantity = expected["quantity"];
            if (expected["kind"] == "decision") {
                const MeasuredValue y = measured(test::number(quantity.substr(2)), u);
                const ConformityVerdict verdict = verdicts.at(expected["value"]);
                EXPECT_EQ(decide_conformity(DecisionRule::iso_14253_1, {}, limits, y).verdict, verdict) << quantity;
                EXPECT_EQ(decide_conformity(DecisionRule::iso_14253_1, rounded, limits, y).verdict, verdict)
                    << quantity;
            } else {
                expect(expected, zones.at(quantity));
            }
        }
    }
}

TEST(ConformityReference, GlobalRisk) {
    SKIP_WITHOUT_CASES();
    const auto cases = cases_of("global_risk");
    EXPECT_GE(cases.size(), 1U);
    for (const auto& [id, problem] : cases) {
        SCOPED_TRACE(id);
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
}

}  // namespace
}  // namespace gumcert::gum
