#include "reports/record/make/certificate/certified_conformity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "gum/rounding.h"

namespace gumcert::reports {
namespace {

using certificate::AgreedSpecification;
using certificate::CertifiedValue;

double standard_normal(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

CertifiedValue by_trials(double y, double u) {
    CertifiedValue value;
    value.value = y;
    value.u = u;
    value.coverage = "monte_carlo";
    value.interval = {y - 2.0 * u, y + 2.0 * u};
    value.printed_value = gum::round_to_quantum(y, 6);
    value.printed_low = gum::round_to_quantum(y - 2.0 * u, 6);
    value.printed_high = gum::round_to_quantum(y + 2.0 * u, 6);
    return value;
}

KnownDistribution distribution_about(double y, double u) {
    return {.function = [=](double x) { return standard_normal((x - y) / u); },
            .below = {},
            .note = "Probabilities are counted from 1000000 Monte Carlo trials.",
            .trials = 1000000};
}

certificate::Verdict decided(const AgreedSpecification& by, double y, double u, std::optional<double> at_estimates,
                             bool is_in_doubt = true) {
    certificate::CertifiedColumn column;
    column.unit = "mm";
    KnownDistribution known = distribution_about(y, u);
    if (at_estimates) {
        known.at_estimates = certificate::ModelValue{.value = *at_estimates, .is_in_doubt = is_in_doubt};
    }
    return verdict_of(by, column, by_trials(y, u), known);
}

// The law: where the model is smooth the verdict of the mean of the trials stands, and is told where the value at the estimates,
// which stands beside it, has another one.
TEST(CertifiedConformity, TellsWhereTheValueAtTheEstimatesHasAnotherVerdict) {
    std::mt19937_64 engine(2);
    std::uniform_real_distribution<double> place(-3.0, 3.0);
    int other = 0;
    for (int i = 0; i < 200; ++i) {
        AgreedSpecification by;
        by.id = "s";
        by.unit = "mm";
        static constexpr std::array<const char*, 5> k_rules{"DR-01", "DR-03", "DR-05", "DR-06", "DR-07"};
        by.rule.id = k_rules.at(static_cast<std::size_t>(i) % k_rules.size());
        if (by.rule.id == "DR-07") {
            by.rule.probability = 0.05;
        }
        (i % 2 == 0 ? by.upper : by.lower) = 10.0;
        const double y = 10.0 + place(engine);
        const double at = y + place(engine);
        const certificate::Verdict of_mean = decided(by, y, 1.0, {});
        const certificate::Verdict stated = decided(by, y, 1.0, at, false);
        const bool is_other =
            decided(by, at, 1.0, {}).verdict != of_mean.verdict && of_mean.verdict != "not_applicable";
        SCOPED_TRACE(by.rule.id + " " + std::to_string(y) + " " + std::to_string(at));
        EXPECT_EQ(stated.verdict, of_mean.verdict);
        EXPECT_EQ(stated.printed.conformance_probability, of_mean.printed.conformance_probability);
        EXPECT_EQ(stated.note.find("and the rule another verdict.") != std::string::npos, is_other);
        other += is_other ? 1 : 0;
    }
    EXPECT_GT(other, 50);
}

// The law: where evidence is against the mean of the trials a verdict stands only where the value at the estimates has the same,
// and both cases are told; else nothing is decided, and no probability is printed.
TEST(CertifiedConformity, IsNotDecidedByAMeanInDoubtAgainstTheValueAtTheEstimates) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> place(-4.0, 4.0);
    int same = 0;
    int open = 0;
    for (int i = 0; i < 300; ++i) {
        AgreedSpecification by;
        by.id = "s";
        by.unit = "mm";
        static constexpr std::array<const char*, 6> k_rules{"DR-01", "DR-03", "DR-05", "DR-06", "DR-07", "DR-08"};
        by.rule.id = k_rules.at(static_cast<std::size_t>(i) % k_rules.size());
        if (by.rule.id == "DR-07") {
            by.rule.probability = 0.05;
        }
        by.upper = 10.0;
        if (i % 2 == 0) {
            by.lower = 0.0;
        }
        const double u = 1.0;
        const double y = 10.0 + place(engine);
        const double at = y - 0.4 - std::abs(place(engine)) / 2.0;
        const certificate::Verdict of_mean = decided(by, y, u, {});
        const certificate::Verdict of_model = decided(by, at, u, {});
        const certificate::Verdict stated = decided(by, y, u, at);
        SCOPED_TRACE(by.rule.id + " " + std::to_string(y) + " " + std::to_string(at));
        EXPECT_EQ(stated.verdict, stated.verdict_from_printed);
        if (of_mean.verdict == of_model.verdict) {
            EXPECT_EQ(stated.verdict, of_mean.verdict);
            EXPECT_NE(stated.note.find("and the rule the same verdict."), std::string::npos);
            ++same;
        } else {
            EXPECT_EQ(stated.verdict,
                      by.rule.id == "DR-06" || by.rule.id == "DR-08" ? "undetermined" : "not_applicable");
            EXPECT_EQ(stated.printed.conformance_probability + stated.printed.specific_risk, "");
            EXPECT_EQ(stated.conformance_probability + stated.specific_risk, 0.0);
            EXPECT_FALSE(stated.largest_specific_risk || stated.false_accept || stated.false_reject);
            EXPECT_NE(stated.note.find("nothing is decided."), std::string::npos);
            ++open;
        }
    }
    EXPECT_GT(same, 80);
    EXPECT_GT(open, 80);
}

}  // namespace
}  // namespace gumcert::reports
