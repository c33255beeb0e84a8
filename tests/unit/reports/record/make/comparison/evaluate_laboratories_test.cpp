// Comparisons between laboratories as their record holds them. Numbers without another source were computed with NumPy
// and SciPy from the formula in the comment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "gum/coverage.h"
#include "gum/expression/name_spelling.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/make/comparison/evaluate_comparison.h"

namespace gumcert::reports {
namespace {

using gum::AssignedValueMethod;
using gum::ResultUncertainty;
using jobs::ComparisonJob;
using jobs::ComparisonResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ResultUncertainty u_and_k(double u, double k = 2.0) {
    return {.u = u, .U = k * u, .k = k, .stated_as_expanded = true};
}

gum::AssignedValueRequest given(double value, std::optional<ResultUncertainty> uncertainty) {
    gum::AssignedValueRequest request;
    request.method = AssignedValueMethod::given;
    request.value = value;
    request.uncertainty = uncertainty;
    return request;
}

gum::ComparisonItem item_in(const std::string& id, const std::string& unit) {
    gum::ComparisonItem item;
    item.id = id;
    item.unit = gum::Unit::parse(unit);
    return item;
}

std::size_t add_participant(ComparisonJob& job, const std::string& id, const std::string& group = "") {
    job.participants.push_back({.id = id, .name = id, .group = group, .cmc_U = std::nullopt});
    return job.participants.size() - 1;
}

ComparisonResult& add_result(ComparisonJob& job, std::size_t participant, double value,
                             std::optional<ResultUncertainty> uncertainty, std::size_t item = 0) {
    ComparisonResult result;
    result.participant = participant;
    result.item = item;
    result.value = value;
    result.uncertainty = uncertainty;
    job.results.push_back(std::move(result));
    return job.results.back();
}

ComparisonJob job_of(const std::vector<double>& x, const std::vector<double>& u) {
    ComparisonJob job;
    job.rounds = {""};
    job.items = {item_in("block", "mm")};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::size_t p = add_participant(job, "L" + std::to_string(i + 1));
        add_result(job, p, x[i], u.empty() ? std::nullopt : std::optional(u_and_k(u[i])));
    }
    return job;
}

/// Golden vector 6: a key comparison with an inconsistent fifth laboratory.
ComparisonJob key_comparison() {
    return job_of({12.31, 12.18, 12.42, 12.25, 12.95, 12.05}, {0.10, 0.15, 0.20, 0.12, 0.15, 0.30});
}

/// Golden vector 7: twelve results without uncertainties.
ComparisonJob twelve_results() {
    return job_of({20.31, 20.12, 20.53, 20.24, 19.95, 20.41, 20.22, 21.96, 20.03, 20.72, 20.36, 20.17}, {});
}

reports::Comparison evaluated(const ComparisonJob& job) {
    return evaluate_laboratories(job, {});
}

std::vector<gum::Diagnostic> messages_of(const ComparisonJob& job) {
    std::vector<gum::Diagnostic> notes;
    (void)evaluate_laboratories(job, {}, &notes);
    return notes;
}

/// What is refused, or has no result, as its first message.
gum::Diagnostic refusal(const ComparisonJob& job) {
    try {
        (void)evaluated(job);
    } catch (const gum::DiagnosedError& failure) {
        return failure.diagnostics().front();
    }
    ADD_FAILURE() << "was evaluated";
    return {};
}

std::vector<double> numbers_of(const reports::Comparison& comparison,
                               reports::Shown<std::optional<double>> reports::ComparisonPoint::*member) {
    std::vector<double> numbers;
    for (const reports::ComparisonPoint& point : comparison.points) {
        numbers.push_back((point.*member).number.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    return numbers;
}

std::vector<std::string> printed_En(const reports::Comparison& comparison) {
    std::vector<std::string> texts;
    for (const reports::ComparisonPoint& point : comparison.points) {
        texts.push_back(point.En.text);
    }
    return texts;
}

TEST(EvaluateLaboratories, KeyComparisonByWeightedMean) {
    const ComparisonJob job = key_comparison();
    const reports::Comparison comparison = evaluated(job);
    ASSERT_EQ(comparison.items.size(), 1U);
    const reports::ComparisonItemEvaluation& item = comparison.items.front();
    EXPECT_EQ(item.method, "weighted_mean");
    EXPECT_NEAR(item.value.number, 12.37236, 5e-6);
    EXPECT_NEAR(*item.u.number, 0.05828, 5e-6);
    EXPECT_EQ(item.value.text, "12.37");
    EXPECT_EQ(item.U.text, "0.12");
    EXPECT_EQ(item.k.text, "2.00");
    ASSERT_TRUE(item.consistency);
    EXPECT_NEAR(item.consistency->chi_square.number, 19.1142, 5e-5);
    EXPECT_EQ(item.consistency->degrees_of_freedom, 5);
    EXPECT_NEAR(item.consistency->critical_value.number, 11.0705, 5e-5);
    EXPECT_NEAR(item.consistency->p_value.number, 0.00183, 5e-6);
    EXPECT_FALSE(item.consistency->consistent);
    EXPECT_NEAR(item.consistency->birge_ratio.number, 1.9552, 5e-5);
    EXPECT_EQ(item.consistency->chi_square.text, "19.11");
    EXPECT_EQ(item.consistency->p_value.text, "0.0018");
    EXPECT_EQ(*item.consistency->pairs, 15);
    const std::vector<double> En = numbers_of(comparison, &reports::ComparisonPoint::En);
    const std::array<double, 6> expected{-0.384, -0.696, 0.125, -0.583, 2.090, -0.548};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(En[i], expected[i], 6e-4) << i;
    }
    EXPECT_THAT(printed_En(comparison), ElementsAre("-0.38", "-0.70", "0.12", "-0.58", "2.09", "-0.55"));
    EXPECT_EQ(item.score, "En");
    EXPECT_EQ(comparison.points[4].signal, "action");
    EXPECT_EQ(comparison.points[0].signal, "none");
    double weights = 0.0;
    for (const reports::ResultWeight& weight : item.weights) {
        weights += weight.weight.number;
    }
    EXPECT_NEAR(weights, 1.0, 1e-14);
    const std::vector<gum::Diagnostic> messages = messages_of(job);
    ASSERT_FALSE(messages.empty());
    EXPECT_EQ(messages.front().code, "GC-COMPARE-0120");
    EXPECT_EQ(messages.front().severity, gum::Severity::warning);
    EXPECT_THAT(messages.front().action, HasSubstr("largest_consistent_subset"));
    EXPECT_EQ(item.pairs.size(), 15U);
    // d_15 = 12.31 − 12.95 with √(0.1² + 0.15²).
    EXPECT_NEAR(item.pairs[3].d.number, -0.64, 1e-14);
    EXPECT_NEAR(*item.pairs[3].En.number, -0.64 / (2.0 * std::hypot(0.10, 0.15)), 1e-12);
}

TEST(EvaluateLaboratories, KeyComparisonByLargestConsistentSubset) {
    ComparisonJob job = key_comparison();
    job.items[0].assigned_value.method = AssignedValueMethod::largest_consistent_subset;
    const reports::Comparison comparison = evaluated(job);
    const reports::ComparisonItemEvaluation& item = comparison.items.front();
    EXPECT_NEAR(item.value.number, 12.26967, 5e-6);
    EXPECT_NEAR(*item.u.number, 0.06325, 5e-6);
    EXPECT_THAT(item.not_consistent, ElementsAre("L5"));
    EXPECT_EQ(item.contributing, 5);
    EXPECT_NEAR(item.consistency->chi_square.number, 1.6480, 5e-5);
    EXPECT_NEAR(item.consistency->p_value.number, 0.8001, 5e-5);
    const std::vector<double> En = numbers_of(comparison, &reports::ComparisonPoint::En);
    const std::array<double, 6> expected{0.260, -0.330, 0.396, -0.096, 2.090, -0.375};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(En[i], expected[i], 6e-4) << i;
    }
    EXPECT_NEAR(*comparison.points[4].correlation, 0.0, 1e-15) << "outside: the plus sign";
    EXPECT_GT(*comparison.points[0].correlation, 0.5) << "inside: the minus sign";
    EXPECT_THAT(comparison.remarks, testing::Contains(HasSubstr("19.11")));
    EXPECT_THAT(messages_of(job), IsEmpty());
}

TEST(EvaluateLaboratories, EstimatesStandSideBySide) {
    ComparisonJob job = key_comparison();
    job.items[0].kernel_bandwidth = 0.1;
    for (ComparisonResult& result : job.results) {
        result.standard_deviation = 0.2;
        result.observations = 4;
    }
    const reports::Comparison comparison = evaluated(job);
    std::vector<std::string> methods;
    for (const reports::ReferenceEstimate& estimate : comparison.items[0].estimates) {
        methods.push_back(estimate.method);
        EXPECT_EQ(estimate.used, estimate.method == "weighted_mean") << estimate.method;
        EXPECT_GT(estimate.value.number, 12.0) << estimate.method;
        EXPECT_LT(estimate.value.number, 12.7) << estimate.method;
        EXPECT_FALSE(estimate.value.text.empty()) << estimate.method;
        EXPECT_EQ(estimate.results, estimate.method == "largest_consistent_subset" ? 5 : 6) << estimate.method;
    }
    EXPECT_THAT(methods, ElementsAre("arithmetic_mean", "median", "niqr", "algorithm_a", "q_hampel", "weighted_mean",
                                     "largest_consistent_subset", "dersimonian_laird", "mandel_paule", "vangel_rukhin",
                                     "power_moderated_mean", "kernel_mode"));
}

TEST(EvaluateLaboratories, AlgorithmAWithRobustSigma) {
    ComparisonJob job = twelve_results();
    job.items[0].assigned_value.method = AssignedValueMethod::algorithm_a;
    job.items[0].sigma_pt.emplace().method = gum::SigmaPtMethod::robust;
    const reports::Comparison comparison = evaluated(job);
    const reports::ComparisonItemEvaluation& item = comparison.items.front();
    EXPECT_NEAR(item.value.number, 20.317012, 5e-7);
    EXPECT_NEAR(*item.s_star.number, 0.284752, 5e-7);
    EXPECT_NEAR(*item.u.number, 0.102751, 5e-7);
    EXPECT_NEAR(*item.sigma_pt.number, 0.284752, 5e-7);
    // u(X)/σ_pt = 1.25/√12 = 0.361: z' decides.
    EXPECT_EQ(item.score, "z_prime");
    EXPECT_EQ(item.criterion_met, false);
    EXPECT_EQ(item.criterion.text, "0.361");
    const reports::ComparisonPoint& eighth = comparison.points[7];
    EXPECT_NEAR(*eighth.z.number, (21.96 - 20.317012) / 0.284752, 1e-4);
    EXPECT_NEAR(*eighth.z_prime.number, (21.96 - 20.317012) / std::hypot(0.284752, 0.102751), 1e-4);
    EXPECT_EQ(eighth.signal, "action");
    EXPECT_FALSE(eighth.En.number);
    EXPECT_EQ(eighth.En.text, "");
    EXPECT_EQ(eighth.z.text, "5.77");
    EXPECT_TRUE(comparison.summary.empty()) << "no En, nothing to sum up";
    EXPECT_FALSE(item.consistency);
    EXPECT_EQ(messages_of(job).front().code, "GC-COMPARE-0121");
}

// 359.9999° and 0.0002° may be one direction: D of 360° stands with a warning.
TEST(EvaluateLaboratories, DirectionsOnBothSidesOfATurn) {
    ComparisonJob job;
    job.rounds = {""};
    job.items = {item_in("north", "deg")};
    job.items[0].assigned_value = given(0.0, u_and_k(0.001));
    add_result(job, add_participant(job, "A"), 0.0002, u_and_k(0.001));
    EXPECT_THAT(messages_of(job), testing::IsEmpty());
    add_result(job, add_participant(job, "B"), 359.9999, u_and_k(0.001));
    bool said = false;
    for (const gum::Diagnostic& message : messages_of(job)) {
        said = said || (message.code == "GC-COMPARE-0131" &&
                        message.what == "angles from 0 to 359.9999 ° lie a full turn apart, or nearly");
    }
    EXPECT_TRUE(said);
}

TEST(EvaluateLaboratories, AuditedUncertainty) {
    // Golden vector 8: the maximum permissible error taken as a standard uncertainty, and as it should be.
    ComparisonJob job;
    job.rounds = {""};
    job.items = {item_in("table", "um")};
    job.items[0].assigned_value = given(100.0, u_and_k(2.5));
    add_result(job, add_participant(job, "A"), 118.0, u_and_k(10.0)).audited =
        gum::AuditedUncertainty{u_and_k(10.0 / std::sqrt(3.0)), "MPE is a limit"};
    add_result(job, add_participant(job, "B"), 101.0, u_and_k(2.5));
    job.participants[0].cmc_U = 5.0;
    const reports::Comparison comparison = evaluated(job);
    const reports::ComparisonPoint& point = comparison.points.front();
    EXPECT_NEAR(*point.En.number, 0.873, 5e-4);
    EXPECT_NEAR(*point.U_D.number, 20.62, 5e-3);
    EXPECT_NEAR(*point.En_audited.number, 1.430, 5e-4);
    EXPECT_EQ(point.En_audited.text, "1.43");
    EXPECT_DOUBLE_EQ(*point.U_over_CMC, 4.0);
    EXPECT_DOUBLE_EQ(*point.U_over_median, 4.0);
    EXPECT_EQ(comparison.audit_finding, "A: MPE is a limit");
    ASSERT_EQ(comparison.summary.size(), 1U);
    EXPECT_EQ(*comparison.summary[0].count_above_1_audited, 1);
    EXPECT_EQ(comparison.summary[0].count_above_1, 0);
    EXPECT_EQ(comparison.items[0].contributing, 0);
    EXPECT_DOUBLE_EQ(*comparison.points[1].zeta.number, 2.0 * *comparison.points[1].En.number) << "k = 2 on both sides";
}

TEST(EvaluateLaboratories, CorrelationsOfParticipants) {
    // Generalised weighted mean, r(1, 2) = 0.6.
    ComparisonJob job = key_comparison();
    job.correlations = {{0, 1, 0.6}};
    const reports::Comparison comparison = evaluated(job);
    EXPECT_NEAR(comparison.items[0].value.number, 12.402686980609419, 1e-12);
    EXPECT_NEAR(*comparison.items[0].u.number, 0.06315789473684211, 1e-14);
    EXPECT_NEAR(comparison.items[0].weights[1].weight.number, 0.0277008310249308, 1e-14);
    EXPECT_NEAR(comparison.items[0].consistency->chi_square.number, 18.52798168667279, 1e-9);
    const std::array<double, 6> u_d{0.07753115717187493, 0.13605543110221646, 0.18976585660336787,
                                    0.10203470160886428, 0.13605543110221646, 0.2932764571737902};
    for (std::size_t i = 0; i < u_d.size(); ++i) {
        EXPECT_NEAR(*comparison.points[i].u_D, u_d[i], 1e-12) << i;
    }
    EXPECT_NEAR(*comparison.points[1].correlation, 0.4210526315789474, 1e-12);
    EXPECT_NEAR(comparison.items[0].pairs[0].u, std::sqrt(0.01 + 0.0225 - 1.2 * 0.1 * 0.15), 1e-14);

    // The same by a group.
    ComparisonJob grouped = key_comparison();
    grouped.participants[0].group = grouped.participants[1].group = "NMI-X";
    grouped.group_correlation = {{"NMI-X", 0.6}};
    EXPECT_DOUBLE_EQ(evaluated(grouped).items[0].value.number, comparison.items[0].value.number);
    // A number for the pair itself takes the place of that of the group.
    grouped.group_correlation = {{"NMI-X", 0.1}};
    grouped.correlations = {{1, 0, 0.6}};
    EXPECT_DOUBLE_EQ(evaluated(grouped).items[0].value.number, comparison.items[0].value.number);
}

TEST(EvaluateLaboratories, SharedSources) {
    ComparisonJob job = key_comparison();
    job.results[0].sources = {{"laser 7", "", 0.08}};
    job.results[1].sources = {{"laser 7", "", 0.08}};
    job.results[2].sources = {{"laser 7", "", -0.05}, {"thermometer", "", 0.1}};
    job.results[3].sources = {{"thermometer", "", 0.1}};
    ComparisonJob independent = job;
    job.independent_sources = {"thermometer"};
    const reports::Comparison comparison = evaluated(job);
    EXPECT_NEAR(comparison.items[0].value.number, 12.389104607283313, 1e-12);
    EXPECT_NEAR(*comparison.items[0].u.number, 0.05920223305785878, 1e-14);
    ASSERT_EQ(comparison.shared_sources.size(), 3U);
    EXPECT_EQ(comparison.shared_sources[0].source, "laser 7");
    EXPECT_EQ(comparison.shared_sources[0].first, "L1");
    EXPECT_EQ(comparison.shared_sources[0].second, "L2");
    EXPECT_NEAR(comparison.shared_sources[0].covariance, 0.0064, 1e-16);
    EXPECT_NEAR(comparison.shared_sources[0].correlation.number, 0.4266666666666667, 1e-14);
    EXPECT_NEAR(comparison.shared_sources[1].covariance, -0.004, 1e-16);
    independent.independent_sources = {"laser 7", "thermometer"};
    EXPECT_DOUBLE_EQ(evaluated(independent).items[0].value.number, evaluated(key_comparison()).items[0].value.number);
    EXPECT_THAT(evaluated(independent).shared_sources, IsEmpty());
    // A correlation that the job states for a pair is the whole of it.
    job.correlations = {{0, 1, 0.0}};
    EXPECT_EQ(evaluated(job).shared_sources.size(), 2U);
}

TEST(EvaluateLaboratories, UnknownCorrelationInsideAGroup) {
    ComparisonJob job = key_comparison();
    job.items[0].assigned_value.method = AssignedValueMethod::reference;
    job.items[0].assigned_value.participant = "L1";
    job.participants[0].group = job.participants[4].group = "NMI-X";
    const reports::Comparison comparison = evaluated(job);
    const reports::ComparisonPoint& fifth = comparison.points[4];
    // U = 0.2 and 0.3, r from 0 to 2/3: U_D = √(0.09 + 0.04 − 2 · 0.04).
    EXPECT_NEAR(*fifth.En.number, 0.64 / std::sqrt(0.13), 1e-12);
    EXPECT_NEAR(*fifth.En_worst.number, 0.64 / std::sqrt(0.05), 1e-12);
    EXPECT_FALSE(comparison.points[1].En_worst.number);
    EXPECT_EQ(*comparison.summary[0].count_above_1_worst, 1);
    EXPECT_FALSE(comparison.summary[0].p_low.number) << "nobody knows how the results hang together";
    // Of a weighted mean with both inside: u²(d) falls by 2 (1 − w_i) w_j u_min² (and nothing else of the group).
    ComparisonJob mean = key_comparison();
    mean.participants[0].group = mean.participants[4].group = "NMI-X";
    const reports::Comparison of_mean = evaluated(mean);
    const double w_1 = of_mean.items[0].weights[0].weight.number;
    const double w_5 = of_mean.items[0].weights[4].weight.number;
    const double u_D = *of_mean.points[4].u_D;
    const double worst = std::sqrt(u_D * u_D - 2.0 * (1.0 - w_5) * w_1 * 0.01);
    EXPECT_NEAR(*of_mean.points[4].En_worst.number, of_mean.points[4].D.number / (2.0 * worst), 2e-5);
}

TEST(EvaluateLaboratories, ReferenceLaboratoryHasNoScore) {
    ComparisonJob job = key_comparison();
    job.items[0].assigned_value.method = AssignedValueMethod::reference;
    job.items[0].assigned_value.participant = "L2";
    const reports::Comparison comparison = evaluated(job);
    EXPECT_EQ(comparison.items[0].reference_participant, "L2");
    EXPECT_EQ(comparison.items[0].contributing, 1);
    EXPECT_DOUBLE_EQ(comparison.items[0].value.number, 12.18);
    EXPECT_DOUBLE_EQ(*comparison.items[0].U.number, 0.30);
    EXPECT_FALSE(comparison.points[1].En.number);
    EXPECT_EQ(comparison.points[1].signal, "");
    EXPECT_EQ(comparison.participants[1].scored, 0);
    EXPECT_NEAR(*comparison.points[0].En.number, 0.13 / std::hypot(0.20, 0.30), 1e-12);
    EXPECT_DOUBLE_EQ(*comparison.points[0].correlation, 0.0);
}

TEST(EvaluateLaboratories, LeaveOneOutIdentity) {
    // d_i/U(d_i) of a laboratory inside the weighted mean is that against the mean of all others (Cox 2002).
    std::mt19937_64 draws(20260);  // NOLINT(cert-msc32-c,cert-msc51-cpp)
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::uniform_real_distribution<double> spread(0.1, 1.0);
    for (int repeat = 0; repeat < 50; ++repeat) {
        std::vector<double> x;
        std::vector<double> u;
        for (int i = 0; i < 7; ++i) {
            x.push_back(value(draws));
            u.push_back(spread(draws));
        }
        ComparisonJob job = job_of(x, u);
        const double inside = *evaluated(job).points[3].zeta.number;
        job.results[3].contributes = false;
        job.results[3].reason = "left out";
        const reports::Comparison outside = evaluated(job);
        EXPECT_NEAR(*outside.points[3].zeta.number, inside, 1e-12);
        EXPECT_THAT(outside.items[0].not_contributing, ElementsAre("L4"));
        EXPECT_FALSE(outside.points[3].contributes);
    }
}

TEST(EvaluateLaboratories, ItemsThatDifferAndDrift) {
    ComparisonJob job = key_comparison();
    job.items[0].sigma_pt = {.method = gum::SigmaPtMethod::given, .value = 0.3};
    Eigen::MatrixXd homogeneity(10, 2);
    homogeneity << 10.02, 10.06, 9.95, 9.91, 10.11, 10.07, 9.99, 10.03, 10.08, 10.02, 9.93, 9.97, 10.05, 10.01, 9.96,
        10.02, 10.10, 10.06, 9.98, 9.94;
    Eigen::MatrixXd stability(3, 2);
    stability << 10.20, 10.24, 10.22, 10.18, 10.25, 10.19;
    job.items[0].homogeneity = homogeneity;
    job.items[0].stability = stability;
    const reports::Comparison comparison = evaluated(job);
    const reports::ComparisonItemEvaluation& item = comparison.items.front();
    EXPECT_NEAR(item.homogeneity->s_x.number, 0.05478239782184711, 1e-14);
    EXPECT_NEAR(item.homogeneity->s_w.number, 0.031622776601683736, 1e-14);
    EXPECT_NEAR(item.homogeneity->s_s.number, 0.050011109876817575, 1e-13);
    EXPECT_TRUE(item.homogeneity->sufficient) << "0.050 against 0.3 · 0.3";
    EXPECT_NEAR(item.stability->difference.number, 0.20033333333333303, 1e-14);
    EXPECT_FALSE(item.stability->stable_expanded);
    EXPECT_NEAR(*item.u_stability.number, 0.20033333333333303 / std::sqrt(3.0), 1e-14);
    const double u = std::sqrt(0.058277151741435856 * 0.058277151741435856 +
                               0.050011109876817575 * 0.050011109876817575 + std::pow(0.20033333333333303, 2) / 3.0);
    EXPECT_NEAR(*item.u.number, u, 1e-12);
    EXPECT_NEAR(*item.u_characterisation.number, 0.058277151741435856, 1e-12);
    // The correlation with the results is that of the characterisation alone.
    EXPECT_NEAR(*comparison.points[0].u_D, std::sqrt(0.01 + u * u - 2.0 * std::pow(0.058277151741435856, 2)), 1e-12);
    EXPECT_EQ(messages_of(job).back().code, "GC-COMPARE-0123");
    const auto says = [&](const char* code) {
        const std::vector<gum::Diagnostic> messages = messages_of(job);
        return std::any_of(messages.begin(), messages.end(), [&](const auto& message) { return message.code == code; });
    };
    EXPECT_FALSE(says("GC-COMPARE-0132"));
    job.items[0].homogeneity = homogeneity / 1000.0;
    job.items[0].stability = stability / 1000.0;
    EXPECT_TRUE(says("GC-COMPARE-0132")) << "in another unit";
    job.items[0].homogeneity = -homogeneity;
    EXPECT_TRUE(says("GC-COMPARE-0132")) << "with the other sign";
    job.items[0].homogeneity = homogeneity.array() - homogeneity(0, 0);
    job.items[0].stability = stability.array() - homogeneity(0, 0);
    EXPECT_FALSE(says("GC-COMPARE-0132")) << "differences from an item, in the unit of the results";
    // Deviations about 0 differ by many times themselves, and by little in terms of sigma_pt.
    job.items[0].homogeneity = homogeneity.array() - 9.9;
    job.items[0].stability = stability.array() - 9.9;
    for (auto& result : job.results) {
        result.value -= 10.05;
    }
    EXPECT_FALSE(says("GC-COMPARE-0132"));
    for (auto& result : job.results) {
        result.value += 10.05;
    }
    job.items[0].homogeneity = homogeneity;
    job.items[0].stability = stability;

    job.items[0].sigma_pt.reset();
    EXPECT_EQ(refusal(job).code, "GC-COMPARE-0104");
    job.items[0].delta_E = 0.9;
    EXPECT_NEAR(evaluated(job).items[0].homogeneity->limit.number, 0.09, 1e-15);
    job.items[0].homogeneity.reset();
    EXPECT_EQ(refusal(job).code, "GC-COMPARE-0108");
}

TEST(EvaluateLaboratories, StandardDeviationForAssessment) {
    ComparisonJob job = key_comparison();
    const auto sigma = [&](const gum::SigmaPtRequest& request) {
        job.items[0].sigma_pt = request;
        return *evaluated(job).items[0].sigma_pt.number;
    };
    EXPECT_DOUBLE_EQ(sigma({.method = gum::SigmaPtMethod::given, .value = 0.25}), 0.25);
    EXPECT_NEAR(sigma({.method = gum::SigmaPtMethod::percent_of_assigned, .value = 2.0}), 0.02 * 12.372358490566038,
                1e-14);
    EXPECT_NEAR(
        sigma({.method = gum::SigmaPtMethod::precision, .reproducibility = 0.5, .repeatability = 0.3, .replicates = 3}),
        std::sqrt(0.25 - 0.09 * 2.0 / 3.0), 1e-14);
    // 0.02 c^0.8495 at c = 12.37 · 1e-6 g/g.
    EXPECT_NEAR(sigma({.method = gum::SigmaPtMethod::mass_fraction, .mass_fraction_per_unit = 1e-6}),
                0.02 * std::pow(12.372358490566038e-6, 0.8495) / 1e-6, 1e-10);
    EXPECT_NEAR(sigma({.method = gum::SigmaPtMethod::standard_deviation}), 0.3145790838565078, 1e-12);
    job.items[0].sigma_pt = {.method = gum::SigmaPtMethod::given, .value = 0.2};
    const reports::Comparison at_limit = evaluated(job);
    EXPECT_EQ(at_limit.items[0].score, "z") << "u(X)/σ_pt = 0.291";
    EXPECT_TRUE(at_limit.points[0].z_prime.number) << "both are kept";
}

TEST(EvaluateLaboratories, PercentOnlyOnARatioScale) {
    ComparisonJob job = key_comparison();
    job.items[0].delta_E = 0.5;
    const reports::Comparison lengths = evaluated(job);
    EXPECT_NEAR(*lengths.points[4].D_percent.number, 100.0 * (12.95 / 12.372358490566038 - 1.0), 1e-10);
    EXPECT_NEAR(*lengths.points[4].P_A.number, 100.0 * (12.95 - 12.372358490566038) / 0.5, 1e-10);
    job.items[0].unit = gum::Unit::parse("degC");
    const reports::Comparison temperatures = evaluated(job);
    EXPECT_FALSE(temperatures.points[4].D_percent.number);
    EXPECT_EQ(temperatures.items[0].difference_unit, "K");
}

TEST(EvaluateLaboratories, EqualResults) {
    ComparisonJob job = job_of({1.0, 1.0, 1.0, 1.0, 1.2}, {});
    job.items.push_back(item_in("second", "mm"));
    for (std::size_t p = 0; p < 5; ++p) {
        add_result(job, p, 2.0, std::nullopt, 1);
    }
    for (gum::ComparisonItem& item : job.items) {
        item.assigned_value.method = AssignedValueMethod::algorithm_a;
    }
    try {
        (void)evaluated(job);
        FAIL() << "was evaluated";
    } catch (const gum::InputError& refused) {
        ASSERT_EQ(refused.diagnostics().size(), 2U) << "of every item";
        EXPECT_EQ(refused.diagnostics()[0].code, "GC-GUM-0102");
        EXPECT_THAT(refused.diagnostics()[0].where, HasSubstr("item \"block\""));
        EXPECT_THAT(refused.diagnostics()[1].where, HasSubstr("item \"second\""));
    }
    // The median exists; its uncertainty does not.
    for (gum::ComparisonItem& item : job.items) {
        item.assigned_value.method = AssignedValueMethod::median;
        item.sigma_pt = {.method = gum::SigmaPtMethod::given, .value = 0.1};
    }
    const reports::Comparison comparison = evaluated(job);
    EXPECT_FALSE(comparison.items[0].u.number);
    EXPECT_FALSE(comparison.items[0].criterion_met) << "nothing is met that cannot be formed";
    EXPECT_EQ(comparison.items[0].U.text, "");
    EXPECT_NEAR(*comparison.points[4].z.number, 2.0, 1e-12);
    EXPECT_EQ(messages_of(job).front().code, "GC-COMPARE-0126");
}

TEST(EvaluateLaboratories, Refusals) {
    ComparisonJob nothing = key_comparison();
    for (ComparisonResult& result : nothing.results) {
        result.contributes = false;
    }
    EXPECT_EQ(refusal(nothing).code, "GC-COMPARE-0100");
    EXPECT_EQ(refusal(nothing).where, "item \"block\"");

    ComparisonJob bare = key_comparison();
    bare.results[2].uncertainty.reset();
    EXPECT_EQ(refusal(bare).code, "GC-COMPARE-0101");
    EXPECT_THAT(refusal(bare).what, HasSubstr("L3"));
    bare.results[2].contributes = false;
    EXPECT_EQ(evaluated(bare).points[2].value.text, "12.42") << "as stated";
    EXPECT_FALSE(evaluated(bare).points[2].En.number);

    ComparisonJob correlated = key_comparison();
    correlated.correlations = {{0, 1, 0.5}};
    correlated.items[0].assigned_value.method = AssignedValueMethod::mandel_paule;
    EXPECT_EQ(refusal(correlated).code, "GC-COMPARE-0102");

    ComparisonJob replicates = key_comparison();
    replicates.items[0].assigned_value.method = AssignedValueMethod::vangel_rukhin;
    EXPECT_EQ(refusal(replicates).code, "GC-COMPARE-0105");

    ComparisonJob reference = key_comparison();
    reference.items[0].assigned_value.method = AssignedValueMethod::reference;
    reference.items[0].assigned_value.participant = "L1";
    reference.results.erase(reference.results.begin());
    EXPECT_EQ(refusal(reference).code, "GC-COMPARE-0106");

    ComparisonJob one = job_of({1.0}, {0.1});
    EXPECT_EQ(refusal(one).code, "GC-GUM-0131");

    ComparisonJob impossible = key_comparison();  // r = 1 with 2, r = 1 with 3, and yet 2 and 3 independent
    impossible.correlations = {{0, 1, 1.0}, {0, 2, 1.0}};
    EXPECT_EQ(refusal(impossible).code, "GC-GUM-0054");
    ComparisonJob singular = job_of({1.0, 1.1}, {0.1, 0.1});
    singular.correlations = {{0, 1, 1.0}};
    EXPECT_EQ(refusal(singular).code, "GC-GUM-0132");
    EXPECT_THAT(refusal(singular).where, HasSubstr("item \"block\""));
}

TEST(EvaluateLaboratories, OrderOfTheResultsDoesNotMatter) {
    ComparisonJob job = key_comparison();
    const reports::Comparison comparison = evaluated(job);
    std::reverse(job.results.begin(), job.results.end());
    const reports::Comparison reversed = evaluated(job);
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        EXPECT_EQ(comparison.points[i].participant, reversed.points[i].participant);
        EXPECT_EQ(comparison.points[i].En.number, reversed.points[i].En.number);
    }
}

TEST(EvaluateLaboratories, MeanOfEqualResultsWithLargeUncertainties) {
    // s/√n is 0.0025 where the stated uncertainties give 1/√4: with that u(X) a result would correlate with the mean by
    // more than 1.
    ComparisonJob job = job_of({10.00, 10.01, 10.00, 10.00}, {1.0, 1.0, 1.0, 1.0});
    job.items[0].assigned_value.method = AssignedValueMethod::arithmetic_mean;
    const reports::Comparison comparison = evaluated(job);
    EXPECT_DOUBLE_EQ(*comparison.points[0].correlation, 0.5);
    EXPECT_NEAR(*comparison.points[0].u_D, std::sqrt(0.75), 1e-12);
    EXPECT_EQ(comparison.items[0].k.text, "2.00");
    EXPECT_THAT(comparison.remarks, testing::Contains(HasSubstr("u(X) is the larger one")));
}

TEST(EvaluateLaboratories, SeveralItemsAndRounds) {
    ComparisonJob job;
    job.rounds = {"spring", "autumn"};
    job.items = {item_in("first", "mm"), item_in("second", "mm")};
    for (gum::ComparisonItem& item : job.items) {
        item.assigned_value = given(0.0, u_and_k(0.5));
    }
    const std::array<double, 5> first{0.2, -0.4, 1.0, 0.1, 3.0};
    const std::array<double, 5> second{0.3, -0.1, 0.8, -0.2, 2.0};
    for (std::size_t p = 0; p < 5; ++p) {
        add_participant(job, "L" + std::to_string(p + 1));
        add_result(job, p, first[p], u_and_k(0.5), 0);
        add_result(job, p, second[p], u_and_k(0.5), 1);
    }
    add_result(job, 1, 0.7, u_and_k(0.5), 1).round = 1;
    add_result(job, 4, 0.1, u_and_k(0.5), 1).round = 1;
    job.vectors = {{.name = "point",
                    .items = {0, 1},
                    .correlation = Eigen::MatrixXd::Identity(2, 2),
                    .reference_correlation = Eigen::MatrixXd::Identity(2, 2)}};
    job.youden = {{0, 1}};
    const reports::Comparison comparison = evaluated(job);
    ASSERT_EQ(comparison.items.size(), 3U) << "nobody measured the first item in autumn";
    EXPECT_EQ(comparison.items[2].round, "autumn");
    EXPECT_THAT(comparison.items[2].missing, ElementsAre("L1", "L3", "L4"));
    ASSERT_EQ(comparison.participants.size(), 5U);
    EXPECT_EQ(comparison.participants[4].results, 3);
    EXPECT_EQ(comparison.participants[4].actions, 2);
    EXPECT_NEAR(*comparison.participants[4].max_abs_En.number, 3.0 / std::sqrt(2.0), 1e-12);
    ASSERT_EQ(comparison.vectors.size(), 5U) << "one a participant, in spring";
    // Independent components with u_D² = 0.5 each; k_p² = −2 ln(1 − 0.9545).
    EXPECT_NEAR(comparison.vectors[4].mahalanobis_square, (9.0 + 4.0) / 0.5, 1e-9);
    // U_D has the stated k = 2, which is 2.00002 for this probability.
    const double k_1 = gum::coverage_factor(0.9545, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(comparison.vectors[4].vector_En.number, k_1 / 2.0 * std::sqrt(26.0 / (-2.0 * std::log(0.0455))), 1e-9);
    ASSERT_EQ(comparison.youden.size(), 1U);
    const reports::YoudenDiagram& youden = comparison.youden.front();
    EXPECT_DOUBLE_EQ(youden.centre_first, 0.2);
    EXPECT_DOUBLE_EQ(youden.centre_second, 0.3);
    EXPECT_NEAR(youden.scale_first, 1.483 * 0.6, 1e-12);
    // Ranks 3 1 4 2 5 and 3 2 4 1 5: ρ = 1 − 6 · 2/(5 · 24).
    EXPECT_NEAR(youden.correlation, 2.0 * std::sin(std::numbers::pi / 6.0 * 0.9), 1e-12);
    ASSERT_EQ(youden.ellipse.size(), 73U);
    EXPECT_EQ(youden.ellipse.front(), youden.ellipse.back());
    EXPECT_NEAR(youden.ellipse.front().first, 0.2 + 1.483 * 0.6 * std::sqrt(-2.0 * std::log(0.05)), 1e-12);
    EXPECT_FALSE(comparison.summary[0].p_low.number) << "results of several items share their laboratories";
}

TEST(EvaluateLaboratories, ProbabilityOfAllScoresTogether) {
    // An exactly known value and independent results: Σ ζ² is chi-square with 3 degrees of freedom.
    ComparisonJob job = job_of({1.1, 0.8, 1.3}, {0.1, 0.2, 0.1});
    job.items[0].assigned_value = given(1.0, std::nullopt);
    const reports::Comparison comparison = evaluated(job);
    ASSERT_TRUE(comparison.summary[0].p_high.number);
    EXPECT_NEAR(*comparison.summary[0].p_high.number, 0.0117258755784214, 1e-8) << "P(chi-square of 3 is at least 11)";
    EXPECT_NEAR(*comparison.summary[0].p_low.number + *comparison.summary[0].p_high.number, 1.0, 1e-8);
    EXPECT_EQ(comparison.summary[0].D_fail.text, "0.20");
    // The median is not linear: how its differences hang together is not computed.
    job.items[0].assigned_value.method = AssignedValueMethod::median;
    EXPECT_FALSE(evaluated(job).summary[0].p_high.number);
}

TEST(EvaluateLaboratories, MedianByTrials) {
    ComparisonJob job = key_comparison();
    job.items[0].assigned_value.method = AssignedValueMethod::median;
    job.items[0].assigned_value.median_by_trials = true;
    job.items[0].assigned_value.trials = 20000;
    job.items[0].assigned_value.seed = 3;
    const reports::Comparison comparison = evaluated(job);
    EXPECT_NEAR(comparison.items[0].value.number, 12.29, 0.03);
    EXPECT_GT(*comparison.items[0].u.number, 0.04);
    EXPECT_TRUE(comparison.points[0].correlation);
    EXPECT_GT(*comparison.points[0].correlation, 0.2) << "the median moves with its results";
    EXPECT_EQ(*evaluated(job).items[0].u.number, *comparison.items[0].u.number) << "the same numbers every time";
}

TEST(EvaluateLaboratories, ScoresExactlyAtTheirLimits) {
    // 10.2 − 10 over 0.1 is 2, which double precision makes 1.999999999999993; 10.3 − 10 makes 3.000000000000007.
    ComparisonJob z = job_of({10.2, 9.8, 10.3, 9.7, 10.19}, {});
    z.items[0].assigned_value = given(10.0, u_and_k(0.01));
    z.items[0].sigma_pt = {.method = gum::SigmaPtMethod::given, .value = 0.1};
    const std::array<std::string, 5> of_z{"none", "none", "action", "action", "none"};
    const reports::Comparison by_z = evaluated(z);
    for (std::size_t i = 0; i < of_z.size(); ++i) {
        EXPECT_EQ(by_z.points[i].signal, of_z[i]) << i;
    }
    EXPECT_EQ(*by_z.points[0].z.number, 2.0);
    EXPECT_EQ(*by_z.points[3].z.number, -3.0);
    // U_D = √(0.16² + 0.12²) = 0.2: |E_n| of 1 is not above 1.
    ComparisonJob En = job_of({10.3, 9.9, 10.30001}, {0.08, 0.08, 0.08});
    En.items[0].assigned_value = given(10.1, u_and_k(0.06));
    const reports::Comparison by_En = evaluated(En);
    EXPECT_EQ(*by_En.points[0].En.number, 1.0);
    EXPECT_EQ(by_En.points[0].signal, "none");
    EXPECT_EQ(by_En.points[1].signal, "none");
    EXPECT_EQ(by_En.points[2].signal, "action");
    EXPECT_EQ(by_En.summary[0].count_above_1, 1);
    // |D| = δ_E is allowed.
    ComparisonJob D = job_of({10.3, 9.9, 10.30001}, {});
    D.items[0].assigned_value = given(10.1, std::nullopt);
    D.items[0].delta_E = 0.2;
    const reports::Comparison by_D = evaluated(D);
    EXPECT_EQ(*by_D.points[0].P_A.number, 100.0);
    EXPECT_EQ(by_D.points[0].signal, "none");
    EXPECT_EQ(by_D.points[1].signal, "none");
    EXPECT_EQ(by_D.points[2].signal, "action");
}

TEST(EvaluateLaboratories, CriterionAtItsLimit) {
    ComparisonJob job = job_of({10.2, 9.8}, {});
    job.items[0].sigma_pt = {.method = gum::SigmaPtMethod::given, .value = 0.7};
    for (const double u : {0.21, 0.21000000000000002}) {
        job.items[0].assigned_value = given(10.0, u_and_k(u));
        EXPECT_EQ(evaluated(job).items[0].score, "z") << u;
    }
    job.items[0].assigned_value = given(10.0, u_and_k(0.21003));
    const reports::Comparison above = evaluated(job);
    EXPECT_EQ(above.items[0].score, "z_prime");
    EXPECT_EQ(above.items[0].criterion.text, "0.30004") << "0.300 would say the contrary";
}

TEST(EvaluateLaboratories, AuditOfTheReferenceLaboratory) {
    ComparisonJob job = job_of({10.0, 10.3, 9.9}, {0.1, 0.1, 0.1});
    job.items[0].assigned_value.method = AssignedValueMethod::reference;
    job.items[0].assigned_value.participant = "L1";
    job.results[0].audited = gum::AuditedUncertainty{u_and_k(0.05), "resolution counted twice"};
    job.results[1].audited = gum::AuditedUncertainty{u_and_k(0.2), "drift missing"};
    const reports::Comparison comparison = evaluated(job);
    EXPECT_NEAR(*comparison.points[1].En_audited.number, 0.3 / std::sqrt(0.4 * 0.4 + 0.1 * 0.1), 1e-12);
    EXPECT_NEAR(*comparison.points[2].En_audited.number, -0.1 / std::sqrt(0.2 * 0.2 + 0.1 * 0.1), 1e-12);
    EXPECT_THAT(comparison.remarks, testing::Contains(HasSubstr("findings corrected")));
}

TEST(EvaluateLaboratories, EqualResultsHaveNoStandardDeviation) {
    ComparisonJob job = job_of({10.3, 10.3, 10.3}, {0.1, 0.2, 0.1});
    job.items[0].assigned_value.method = AssignedValueMethod::arithmetic_mean;
    job.items[0].delta_E = 0.5;
    const reports::Comparison comparison = evaluated(job);
    EXPECT_FALSE(comparison.items[0].u.number) << "0 would say that the value is exactly known";
    EXPECT_FALSE(comparison.points[0].En.number);
    EXPECT_EQ(messages_of(job).front().code, "GC-COMPARE-0126");
    // The standard deviation of seven equal numbers is 0, not the rounding of their mean.
    ComparisonJob large = job_of(std::vector<double>(7, 1000000.1), {});
    large.items[0].assigned_value.method = AssignedValueMethod::median;
    large.items[0].delta_E = 0.5;
    const reports::Comparison far = evaluated(large);
    EXPECT_EQ(*far.items[0].estimates.front().scale.number, 0.0);
    EXPECT_FALSE(far.items[0].estimates.front().u.number);
}

TEST(EvaluateLaboratories, EqualResultsThatNothingCanScoreAreRefused) {
    for (const AssignedValueMethod method : {AssignedValueMethod::arithmetic_mean, AssignedValueMethod::median}) {
        ComparisonJob job = job_of({10.3, 10.3, 10.3, 10.4}, {0.1, 0.2, 0.1, 0.1});
        if (method == AssignedValueMethod::arithmetic_mean) {
            job.results.pop_back();
        }
        job.items[0].assigned_value.method = method;
        const gum::Diagnostic refused = refusal(job);
        EXPECT_EQ(refused.code, "GC-COMPARE-0109");
        EXPECT_EQ(refused.where, "item \"block\"");
        EXPECT_THAT(refused.what, HasSubstr("are equal"));
    }
}

TEST(EvaluateLaboratories, OneUncertaintyInAnArithmeticMean) {
    // u(X) = s/√3 = 0.12018504…, cov = u²/3: r = 0.1/(3 · 0.12018504…).
    ComparisonJob job = job_of({10.3, 9.9, 10.0}, {});
    job.results[0].uncertainty = u_and_k(0.1);
    job.items[0].assigned_value.method = AssignedValueMethod::arithmetic_mean;
    const reports::Comparison comparison = evaluated(job);
    EXPECT_NEAR(*comparison.points[0].correlation, 0.27735009811261424, 1e-12);
    EXPECT_NEAR(*comparison.points[0].u_D, 0.13333333333333333, 1e-12);
}

TEST(EvaluateLaboratories, FewDegreesOfFreedomOfAWeightedMean) {
    // Two results with ν = 2 and equal u: ν_eff = 4, t_0.9545(4) = 2.869315… (SciPy), not 2.
    ComparisonJob job = job_of({10.0, 10.1}, {0.1, 0.1});
    for (ComparisonResult& result : job.results) {
        result.uncertainty = ResultUncertainty{.u = 0.1, .U = 0.45265507600819926, .k = 4.5265507600819926};
        result.uncertainty->degrees_of_freedom = 2.0;
    }
    for (const AssignedValueMethod method :
         {AssignedValueMethod::weighted_mean, AssignedValueMethod::largest_consistent_subset}) {
        job.items[0].assigned_value.method = method;
        const reports::Comparison comparison = evaluated(job);
        EXPECT_NEAR(*comparison.items[0].k.number, 2.8693151696963852, 1e-9);
        EXPECT_NEAR(*comparison.items[0].U.number, 2.8693151696963852 * 0.1 / std::numbers::sqrt2, 1e-9);
    }
}

TEST(EvaluateLaboratories, MedianByTrialsOfOtherResults) {
    // D does not contribute and has r = 0.9 with C, which does: cov(D, X) = 0.9 u_D/u_C cov(C, X).
    ComparisonJob job = job_of({10.3, 9.9, 10.0, 10.0}, {0.1, 0.1, 0.1, 0.2});
    job.items[0].assigned_value.method = AssignedValueMethod::median;
    job.items[0].assigned_value.median_by_trials = true;
    job.items[0].assigned_value.trials = 20000;
    job.results[3].contributes = false;
    job.results[3].reason = "late";
    job.correlations = {{2, 3, 0.9}};
    const reports::Comparison comparison = evaluated(job);
    EXPECT_NEAR(*comparison.points[3].correlation, 0.9 * *comparison.points[2].correlation, 1e-9);
}

TEST(EvaluateLaboratories, WhatIsLeftOutIsSaid) {
    // One source whole in both: their difference has no uncertainty, and is 0.
    ComparisonJob job = job_of({10.0, 10.0, 9.9}, {0.1, 0.1, 0.1});
    job.items[0].assigned_value.method = AssignedValueMethod::reference;
    job.items[0].assigned_value.participant = "L1";
    job.correlations = {{0, 1, 1.0}};
    EXPECT_FALSE(evaluated(job).points[1].En.number);
    EXPECT_THAT(evaluated(job).remarks, testing::Contains(HasSubstr("1 result has no Eₙ")));
    job.results[1].value = 10.3;  // what is the same in both cannot differ
    EXPECT_THROW((void)evaluated(job), gum::InputError);

    // A vector whose quantities are one quantity.
    ComparisonJob vectors = job_of({10.0, 10.3}, {0.1, 0.1});
    vectors.items.push_back(item_in("second", "mm"));
    add_result(vectors, 0, 10.1, u_and_k(0.1), 1);
    add_result(vectors, 1, 10.2, u_and_k(0.1), 1);
    for (gum::ComparisonItem& item : vectors.items) {
        item.assigned_value = given(10.0, u_and_k(0.1));
    }
    vectors.vectors = {{.name = "both",
                        .items = {0, 1},
                        .correlation = Eigen::MatrixXd::Ones(2, 2),
                        .reference_correlation = Eigen::MatrixXd::Ones(2, 2)}};
    EXPECT_THAT(evaluated(vectors).vectors, IsEmpty());
    EXPECT_THAT(evaluated(vectors).remarks, testing::Contains(HasSubstr("2 vectors have no Eₙ")));

    // What the job says of a given value and of a result.
    ComparisonJob given_value = job_of({10.0, 10.3}, {0.1, 0.1});
    given_value.items[0].assigned_value = given(10.0, u_and_k(0.1));
    given_value.items[0].assigned_value.sources = {{"block 3", "standard", 0.08}};
    given_value.results[0].sources = {{"block 3", "length", 0.05}};
    EXPECT_THAT(evaluated(given_value).remarks, testing::Contains(HasSubstr("The assigned value and some results")));
    given_value.results[0].sources = {{"block 3", "length", 0.05}, {"block 3", "expansion", 0.05}};
    EXPECT_THAT(evaluated(given_value).remarks, testing::Contains(HasSubstr("cannot be told")));

    // Two results with one source in several inputs of different names.
    ComparisonJob shared = job_of({10.0, 10.3}, {0.1, 0.1});
    shared.results[0].sources = {{"block 3", "length", 0.05}, {"block 3", "expansion", 0.05}};
    shared.results[1].sources = {{"block 3", "standard", 0.05}};
    EXPECT_THAT(evaluated(shared).remarks, testing::Contains(HasSubstr("(block 3)")));
}

TEST(EvaluateLaboratories, PairsOfManyItems) {
    const auto with_items = [](std::size_t items) {
        ComparisonJob job = job_of({10.0, 10.1, 10.2, 10.3, 10.4, 10.5, 10.6, 10.7, 10.8, 10.9},
                                   {0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1});
        for (std::size_t i = 1; i < items; ++i) {
            job.items.push_back(item_in("item " + std::to_string(i), "mm"));
            for (std::size_t p = 0; p < 10; ++p) {
                add_result(job, p, 10.0 + 0.1 * static_cast<double>(p), u_and_k(0.1), i);
            }
        }
        return evaluated(job);
    };
    EXPECT_EQ(with_items(222).items.back().pairs.size(), 45U);  // 9990 pairs
    const reports::Comparison many = with_items(223);
    EXPECT_THAT(many.items.front().pairs, IsEmpty());
    EXPECT_THAT(many.remarks, testing::Contains(HasSubstr("more than 10000 pairs")));
}

TEST(EvaluateLaboratories, RealismOfUncertainties) {
    ComparisonJob job = key_comparison();
    job.results[0].uncertainty = u_and_k(0.02);
    job.results[5].uncertainty = u_and_k(3.0);
    job.items[0].assigned_value.method = AssignedValueMethod::algorithm_a;
    const reports::Comparison comparison = evaluated(job);
    EXPECT_EQ(comparison.points[0].realism, "small");
    EXPECT_EQ(comparison.points[2].realism, "plausible");
    EXPECT_EQ(comparison.points[5].realism, "large");
    EXPECT_TRUE(comparison.points[0].correlation) << "that of the mean";
    EXPECT_THAT(comparison.remarks, testing::Contains(HasSubstr("not linear")));
    EXPECT_THAT(comparison.remarks, testing::Contains(HasSubstr("Fewer than 12")));
}

TEST(EvaluateLaboratories, ConsensusAgainstAnIndependentValue) {
    ComparisonJob job = key_comparison();
    job.items[0].reference_value = 12.0;
    job.items[0].u_reference_value = 0.05;
    const reports::Comparison comparison = evaluated(job);
    ASSERT_TRUE(comparison.items[0].consensus);
    EXPECT_NEAR(comparison.items[0].consensus->ratio.number, 0.372358490566038 / std::hypot(0.058277151741435856, 0.05),
                1e-10);
    EXPECT_FALSE(comparison.items[0].consensus->consistent);
    const std::vector<gum::Diagnostic> messages = messages_of(job);
    EXPECT_TRUE(std::any_of(messages.begin(), messages.end(),
                            [](const gum::Diagnostic& message) { return message.code == "GC-COMPARE-0124"; }));
}

// ---- what scores may say
// ---------------------------------------------------------------------------------------------

TEST(WhatScoresSay, AGrossOutlierDoesNotHideBehindTheUncertaintyThatItCauses) {
    // 10^6 u away from two others that agree; by every way to a value that rests on the scatter.
    for (const AssignedValueMethod method :
         {AssignedValueMethod::arithmetic_mean, AssignedValueMethod::median, AssignedValueMethod::algorithm_a,
          AssignedValueMethod::q_hampel, AssignedValueMethod::dersimonian_laird, AssignedValueMethod::mandel_paule}) {
        ComparisonJob job = job_of({10.0, 10.001, 1000.0}, {0.001, 0.001, 0.001});
        job.items[0].assigned_value.method = method;
        const reports::Comparison comparison = evaluated(job);
        EXPECT_EQ(comparison.points[2].signal, "action") << comparison.items[0].method;
        for (const std::size_t other : {0U, 1U}) {  // the outlier may be the one that is right
            EXPECT_EQ(comparison.points[other].signal, "inconclusive") << comparison.items[0].method;
        }
        EXPECT_FALSE(comparison.items[0].consistency->consistent);
        EXPECT_EQ(comparison.items[0].U_rests_on, "scatter");
        EXPECT_THAT(comparison.remarks, testing::Contains(HasSubstr("clear none of them")));
    }
}

TEST(WhatScoresSay, CoverageFactorsAreBroughtToOne) {
    // D = 0.24, u = 0.1, X = 10 with u = 0.05: U = 0.2 whatever factor was stated.
    std::vector<double> scores;
    for (const double k : {1.0, 2.0, 3.0}) {
        ComparisonJob job = job_of({10.24, 10.0}, {0.1, 0.1});
        job.results[0].uncertainty = u_and_k(0.1, k);
        job.items[0].assigned_value = given(10.0, u_and_k(0.05));
        const reports::Comparison comparison = evaluated(job);
        scores.push_back(*comparison.points[0].En.number);
        EXPECT_DOUBLE_EQ(*comparison.points[0].U.number, 0.1 * k) << "as stated";
        EXPECT_EQ(comparison.points[0].U_of_scores.number.has_value(), k != 2.0);
        const auto said = testing::Contains(HasSubstr("L1 are not those of about 95 %"));
        if (k == 2.0) {
            EXPECT_THAT(comparison.remarks, testing::Not(said));
        } else {
            EXPECT_THAT(comparison.remarks, said);
        }
    }
    EXPECT_NEAR(scores[0], scores[1], 1e-4);
    EXPECT_NEAR(scores[2], scores[1], 1e-4);
    ComparisonJob half = job_of({10.24, 10.0}, {0.1, 0.1});
    half.coverage_probability = 0.5;
    half.items[0].assigned_value = given(10.0, u_and_k(0.05));
    EXPECT_NEAR(*evaluated(half).points[0].En.number, scores[1], 1e-4);
    EXPECT_EQ(evaluated(half).score_probability, 0.9545);
}

/// A remark names an assigned value as what it is: given with its U, or computed. "X" may be a laboratory.
TEST(WhatScoresSay, FactorsOfAssignedValuesAreThoseOfNoLaboratory) {
    const auto remarks_for = [](const std::optional<gum::AssignedValueRequest>& request, double p) {
        ComparisonJob job = job_of({10.24, 10.0, 10.1}, {0.1, 0.1, 0.1});
        job.participants[0].id = "X";
        job.coverage_probability = p;
        if (request) {
            job.items[0].assigned_value = *request;
        }
        return evaluated(job).remarks;
    };
    const auto says = [](const std::string& text) { return testing::Contains(HasSubstr(text)); };
    EXPECT_THAT(remarks_for(given(10.0, u_and_k(0.05, 1.0)), 0.9545),
                testing::AllOf(says("factor of a given assigned value"), testing::Not(says("factors of X")),
                               testing::Not(says("computed assigned value"))));
    EXPECT_THAT(remarks_for(std::nullopt, 0.99),
                testing::AllOf(says("factor of a computed assigned value"), testing::Not(says("factors of X")),
                               testing::Not(says("stated U")), testing::Not(says("given U(X)"))));
    EXPECT_THAT(remarks_for(std::nullopt, 0.9545), testing::Not(says("assigned value is not that of about 95 %")));
}

TEST(WhatScoresSay, ASignalOfAnyScoreIsTheSignal) {
    // z is small, and the laboratory claims more than it can: E_n = 0.3/√(0.1² + 0.02²).
    ComparisonJob job = job_of({10.3, 10.0, 10.05}, {0.05, 0.05, 0.05});
    job.items[0].assigned_value = given(10.0, u_and_k(0.01));
    job.items[0].sigma_pt = {.method = gum::SigmaPtMethod::given, .value = 0.5};
    job.results[2].audited = gum::AuditedUncertainty{u_and_k(0.01), "counted twice"};
    const reports::Comparison comparison = evaluated(job);
    EXPECT_EQ(comparison.items[0].score, "z");
    EXPECT_EQ(comparison.points[0].signal, "action");
    EXPECT_THAT(comparison.points[0].signal_by, ElementsAre("En", "zeta"));
    EXPECT_EQ(comparison.points[1].signal, "none");
    EXPECT_THAT(comparison.points[1].signal_by, IsEmpty());
    EXPECT_THAT(comparison.points[2].signal_by, ElementsAre("En_audited"));
    EXPECT_EQ(comparison.participants[2].actions, 1);
}

TEST(WhatScoresSay, AReferenceThatIsWorseClearsNobody) {
    ComparisonJob job = job_of({10.0, 10.1}, {0.1, 0.4});
    job.items[0].assigned_value = given(10.0, u_and_k(0.2));
    const reports::Comparison comparison = evaluated(job);
    EXPECT_EQ(comparison.points[0].signal, "inconclusive");
    EXPECT_EQ(comparison.points[1].signal, "none");
    EXPECT_EQ(comparison.participants[0].inconclusive, 1);
    bool told = false;
    for (const gum::Diagnostic& message : messages_of(job)) {
        told = told || message.code == "GC-COMPARE-0128";
    }
    EXPECT_TRUE(told);
}

TEST(WhatScoresSay, UOfStatedUncertaintiesSaysWhatItDoesNotKnow) {
    const reports::Comparison comparison = evaluated(job_of({1.0, 1.1, 0.9}, {0.1, 0.1, 0.1}));
    EXPECT_EQ(comparison.items[0].U_rests_on, "uncertainties");
    EXPECT_NEAR(*comparison.items[0].coverage_with_scatter.number, 0.8427, 1e-4);  // P(|Z| < 2/√2)
    EXPECT_THAT(comparison.remarks, testing::Contains(HasSubstr("84.3 % of all cases in place of 95.45 %")));
}

TEST(WhatScoresSay, UOfTheScatterHasItsDegreesOfFreedom) {
    ComparisonJob job = job_of({1.0, 1.3, 0.9}, {0.1, 0.1, 0.1});
    job.items[0].assigned_value.method = AssignedValueMethod::mandel_paule;
    const reports::ComparisonItemEvaluation item = evaluated(job).items[0];
    // equal u: y ± t_0.9545(2) s/√3 = 1.0666… ± 4.5265507600819926 · 0.20816659994661327/√3
    EXPECT_NEAR(*item.U.number, 0.5440237, 1e-6);
    EXPECT_EQ(*item.nu.number, 2.0);
    EXPECT_NEAR(*item.k.number * *item.u.number, *item.U.number, 1e-12);
}

TEST(WhatScoresSay, IntervalsOfTrialsAreKept) {
    ComparisonJob job = key_comparison();
    job.items[0].assigned_value.method = AssignedValueMethod::median;
    job.items[0].assigned_value.median_by_trials = true;
    job.items[0].assigned_value.trials = 20000;
    const reports::Comparison comparison = evaluated(job);
    EXPECT_LT(*comparison.items[0].low.number, comparison.items[0].value.number);
    EXPECT_GT(*comparison.items[0].high.number, comparison.items[0].value.number);
    for (const reports::ComparisonPoint& point : comparison.points) {
        EXPECT_LT(*point.D_low.number, *point.D_high.number);
        EXPECT_NE(point.D_low.text, "");
    }
}

/// Of results with few degrees of freedom trials draw t distributions: U(X) of a median is that of its interval.
TEST(WhatScoresSay, TrialsOfAMedianKnowDegreesOfFreedom) {
    ComparisonJob job = job_of({10.0, 10.1, 9.9, 10.05, 9.95}, std::vector<double>(5, 0.1));
    job.items[0].assigned_value.method = AssignedValueMethod::median;
    job.items[0].assigned_value.median_by_trials = true;
    const reports::ComparisonItemEvaluation normal = evaluated(job).items[0];
    for (ComparisonResult& result : job.results) {
        result.uncertainty->degrees_of_freedom = 3.0;
    }
    const reports::ComparisonItemEvaluation item = evaluated(job).items[0];
    EXPECT_EQ(*item.u.number, *normal.u.number) << "u is that of the stated u";
    EXPECT_THAT(evaluated(job).remarks, testing::Not(testing::Contains(HasSubstr("scale of a robust"))))
        << "it has none";
    EXPECT_EQ(item.value.number, normal.value.number);
    EXPECT_FALSE(normal.nu.number);
    EXPECT_GT(*item.k.number, 2.1);
    EXPECT_NEAR(*item.k.number, gum::coverage_factor(0.9545, *item.nu.number), 1e-6);
    EXPECT_NEAR(*item.U.number, 0.5 * (*item.high.number - *item.low.number), 0.03 * *item.U.number);
    job.correlations = {{0, 1, 0.3}};
    EXPECT_THAT(evaluated(job).remarks, testing::Contains(HasSubstr("whatever their degrees of freedom")));
}

TEST(WhatScoresSay, OneItemWithoutItsReferenceDoesNotLoseTheOthers) {
    ComparisonJob job = job_of({1.0, 1.1, 0.9}, {0.1, 0.1, 0.1});
    job.items.push_back(item_in("alone", "mm"));
    job.items[1].assigned_value.method = AssignedValueMethod::reference;
    job.items[1].assigned_value.participant = "nobody";
    for (std::size_t p = 0; p < 3; ++p) {
        add_result(job, p, 2.0, u_and_k(0.1), 1);
    }
    const reports::Comparison comparison = evaluated(job);
    EXPECT_EQ(comparison.items.size(), 1U);
    ASSERT_EQ(comparison.items_without_result.size(), 1U);
    EXPECT_EQ(comparison.items_without_result[0].code, "GC-COMPARE-0106");
}

TEST(WhatScoresSay, OneItemDoesNotLoseTheOthers) {
    ComparisonJob job = job_of({1.0, 1.1, 0.9}, {0.1, 0.1, 0.1});
    job.items.push_back(item_in("equal", "mm"));
    job.items[1].assigned_value.method = AssignedValueMethod::algorithm_a;
    for (std::size_t p = 0; p < 3; ++p) {
        add_result(job, p, 2.0, u_and_k(0.1), 1);
    }
    std::vector<gum::Diagnostic> notes;
    const reports::Comparison comparison = evaluate_laboratories(job, {}, &notes);
    ASSERT_EQ(comparison.items.size(), 1U);
    EXPECT_EQ(comparison.points.size(), 3U);
    ASSERT_EQ(comparison.items_without_result.size(), 1U);
    EXPECT_EQ(comparison.items_without_result[0].id, "equal");
    EXPECT_EQ(comparison.items_without_result[0].code, "GC-GUM-0102");
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_THAT(notes[0].where, HasSubstr("item \"equal\""));
}

/// A subset of fewer than half of the results is no value of theirs.
TEST(WhatScoresSay, MoreResultsAgainstASubsetThanForItLeaveNoValue) {
    // The first three agree; the others lie apart from these and from each other.
    const std::vector<double> x = {10.0, 10.05, 9.95, 11.0, 12.0, 13.0, 14.0, 15.0};
    for (std::size_t n = 4; n <= x.size(); ++n) {
        ComparisonJob job =
            job_of({x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n)}, std::vector<double>(n, 0.1));
        job.items[0].assigned_value.method = AssignedValueMethod::largest_consistent_subset;
        if (n <= 6) {  // three of six are half of them
            const reports::Comparison comparison = evaluated(job);
            EXPECT_EQ(comparison.items[0].contributing, 3) << n;
            const auto said = testing::Contains(HasSubstr("As many results stand against the value as for it."));
            if (n == 6) {
                EXPECT_THAT(comparison.remarks, said);
            } else {
                EXPECT_THAT(comparison.remarks, testing::Not(said)) << n;
            }
            continue;
        }
        job.items.push_back(item_in("other", "mm"));
        for (std::size_t p = 0; p < n; ++p) {
            add_result(job, p, 10.0 + 0.01 * static_cast<double>(p), u_and_k(0.1), 1);
        }
        const reports::Comparison comparison = evaluated(job);
        ASSERT_EQ(comparison.items_without_result.size(), 1U) << n;
        EXPECT_EQ(comparison.items_without_result[0].code, "GC-COMPARE-0114");
        EXPECT_EQ(comparison.items_without_result[0].what,
                  "the largest consistent subset holds 3 of " + std::to_string(n) + " results");
    }
}

TEST(WhatScoresSay, NamesOfSourcesThatLookAlikeAreAskedAbout) {
    ComparisonJob job = job_of({1.0, 1.1, 0.9}, {0.1, 0.1, 0.1});
    job.results[0].sources = {{.source = "Std 17", .input = "", .contribution = 0.05}};
    job.results[1].sources = {{.source = "std-17", .input = "", .contribution = 0.05}};
    job.results[2].sources = {{.source = "Std 18", .input = "", .contribution = 0.05}};
    std::vector<gum::Diagnostic> notes;
    (void)evaluate_laboratories(job, {}, &notes);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].code, "GC-COMPARE-0129");
    EXPECT_THAT(notes[0].what, HasSubstr("\"Std 17\", \"std-17\""));
    // The cure that it names: one spelling, or said to be different.
    ComparisonJob different = job;
    different.different_sources = {"Std 17", "std-17"};
    notes.clear();
    (void)evaluate_laboratories(different, {}, &notes);
    EXPECT_THAT(notes, IsEmpty());
    job.results[1].sources[0].source = "Std 17";
    (void)evaluate_laboratories(job, {}, &notes);
    EXPECT_THAT(notes, IsEmpty());
}

TEST(WhatScoresSay, ManySpellingsOfOneNameAreOneQuestion) {
    std::mt19937 random(5);
    const std::string separators = " -_./";
    for (int run = 0; run < 200; ++run) {
        std::set<std::string> names;
        for (int spelling = 0; spelling < 3; ++spelling) {
            std::string name;
            for (const char c : std::string("Mass Standard 0017")) {
                const bool blank = c == ' ';
                const bool upper = random() % 2 == 0;
                name += blank   ? separators[random() % separators.size()]
                        : upper ? static_cast<char>(std::toupper(c))
                                : static_cast<char>(std::tolower(c));
            }
            names.insert(name);
        }
        EXPECT_EQ(gum::similar_source_names(names, {}).size(), names.size() > 1 ? 1U : 0U);
    }
    EXPECT_THAT(gum::similar_source_names({"Std 17", "Std 170", "Std 71"}, {}), IsEmpty());
    EXPECT_EQ(gum::similar_source_names({"Std 17", "Std 017"}, {}).size(), 1U);
}

TEST(WhatScoresSay, SpellingsBeyondAsciiAreAskedAbout) {
    for (const std::set<std::string>& names :
         std::vector<std::set<std::string>>{{"Std 17", "Std\u00a017"},                 // no-break space
                                            {"Std 17", "Std\u201317", "Std\u221217"},  // en dash, minus sign
                                            {"Normal \u00c4", "normal \u00e4", "Normal A\u0308"},
                                            {"Stra\u00dfe 3", "STRASSE 3", "STRA\u1e9eE 3"},
                                            {"\u03a3 1", "\u03c3 1", "\u03c2 1"},              // sigma
                                            {"\u041d\u0418\u0418 1", "\u043d\u0438\u0438 1"},  // Cyrillic
                                            {"Std 17", "\u0405td 17"},            // a Cyrillic letter that looks like S
                                            {"\uff33\uff54\uff44 17", "Std 17"},  // full width
                                            {"Std \u246017", "Std 117"}}) {
        EXPECT_EQ(gum::similar_source_names(names, {}).size(), 1U) << *names.begin();
    }
    EXPECT_THAT(gum::similar_source_names({"\u5206\u9285 1", "\u7802\u78bc 1", "\u03a3 1", "\u03a9 1"}, {}), IsEmpty());
}

TEST(WhatScoresSay, AnAssignedValueWithALargerUClearsNobody) {
    ComparisonJob job = job_of({10.0, 10.1, 10.9}, {0.1, 0.1, 0.1});
    ResultUncertainty poor{.u = 0.09, .U = 13.97 * 0.09, .k = 13.97};
    poor.degrees_of_freedom = 1.0;
    job.items[0].assigned_value = given(10.05, poor);
    const reports::Comparison of_given = evaluated(job);
    EXPECT_EQ(of_given.points[0].signal, "inconclusive");
    EXPECT_EQ(of_given.points[1].signal, "inconclusive");
    EXPECT_EQ(of_given.points[2].signal, "action");  // a signal stays one
    ComparisonJob consensus = job_of({10.0, 10.1, 10.2}, {0.1, 0.1, 0.1});
    consensus.items[0].assigned_value.method = AssignedValueMethod::mandel_paule;
    const reports::Comparison three = evaluated(consensus);
    ASSERT_GT(*three.items[0].U.number, *three.points[0].U.number);
    for (const reports::ComparisonPoint& point : three.points) {
        EXPECT_EQ(point.signal, "inconclusive");
    }
}

TEST(WhatScoresSay, EqualResultsClaimNoLessThanTheyState) {
    ComparisonJob job = job_of({10.0, 10.0, 10.0}, {0.1, 0.1, 0.1});
    job.items[0].assigned_value.method = AssignedValueMethod::mandel_paule;
    const reports::Comparison comparison = evaluated(job);
    EXPECT_NEAR(*comparison.items[0].k.number, 2.0, 1e-4);
    EXPECT_FALSE(comparison.items[0].nu.number);
    for (const reports::ReferenceEstimate& estimate : comparison.items[0].estimates) {
        EXPECT_TRUE(std::isfinite(estimate.nu.value_or(1.0))) << estimate.method;
    }
}

TEST(WhatScoresSay, AnUnknownUncertaintyOfTheAssignedValueClearsNobody) {
    ComparisonJob job = job_of({10.0, 10.0, 10.0, 10.2}, {});
    job.items[0].assigned_value.method = AssignedValueMethod::median;
    job.items[0].delta_E = 0.15;
    const reports::Comparison by_D = evaluated(job);
    ASSERT_FALSE(by_D.items[0].u.number);
    EXPECT_EQ(by_D.points[0].signal, "inconclusive");
    EXPECT_EQ(by_D.points[3].signal, "action");
}

TEST(WhatScoresSay, TwoResultsKeepTheirDegreesOfFreedom) {
    ComparisonJob job = job_of({10.0, 10.36}, {0.1, 0.1});
    job.items[0].assigned_value.method = AssignedValueMethod::mandel_paule;
    for (ComparisonResult& result : job.results) {
        result.uncertainty->degrees_of_freedom = 2.0;
        result.uncertainty->k = 4.5266;  // t with 2 degrees of freedom
        result.uncertainty->U = 4.5266 * 0.1;
    }
    // 0.36/(t(4) 0.1 sqrt(2)), t(4) = 2.8693 for 95.45 %
    EXPECT_NEAR(*evaluated(job).points[1].En.number, 0.36 / (2.8693 * 0.1 * std::numbers::sqrt2), 1e-4);
}

TEST(WhatScoresSay, OneGrossOutlierLeavesTheOthersJudged) {
    for (const AssignedValueMethod method : {AssignedValueMethod::median, AssignedValueMethod::algorithm_a}) {
        ComparisonJob job = job_of({10.0, 10.01, 10.02, 10.01, 99.0}, {0.1, 0.1, 0.1, 0.1, 0.1});
        job.items[0].assigned_value.method = method;
        const reports::Comparison comparison = evaluated(job);
        EXPECT_EQ(comparison.points[4].signal, "action");
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(comparison.points[i].signal, "none");
            EXPECT_LT(*comparison.points[i].U_D.number, 0.3);
        }
    }
}

TEST(WhatScoresSay, UncertaintiesAreHeldAgainstEachOtherWithOneFactor) {
    ComparisonJob job = job_of({10.0, 10.1, 10.05}, {0.3, 0.1, 0.1});
    job.results[0].uncertainty->k = 1.0;
    job.results[0].uncertainty->U = 0.3;
    job.participants[0].cmc_U = 0.25;
    const reports::Comparison comparison = evaluated(job);
    EXPECT_NEAR(*comparison.points[0].U_over_CMC, 2.0 * 0.3 / 0.25, 1e-3);
    EXPECT_NEAR(*comparison.points[0].U_over_median, 3.0, 1e-3);
}

TEST(EvaluateComparison, RecordOfAComparison) {
    ComparisonJob job = key_comparison();
    job.title = "Key comparison";
    job.certificate.emplace();
    std::vector<std::string> told;
    const reports::EvaluationRecord record =
        evaluate_comparison(job, {}, [&](const std::string& text) { told.push_back(text); });
    EXPECT_EQ(record.kind, "comparison");
    EXPECT_EQ(record.title, "Key comparison");
    ASSERT_TRUE(record.comparison);
    EXPECT_EQ(record.comparison->form, "laboratories");
    EXPECT_EQ(record.comparison->unit, "mm");
    EXPECT_FALSE(record.certificate) << "a comparison is no certificate";
    EXPECT_EQ(record.diagnostics.front().code, "GC-COMPARE-0120");
    EXPECT_EQ(record.diagnostics.back().code, "GC-COMPARE-0125");
}

}  // namespace
}  // namespace gumcert::reports
