#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "evaluation/evaluate_job.h"
#include "evaluation/recompute_record.h"
#include "gum/circle_closure/evaluate_circle_closure.h"
#include "gum/coverage.h"
#include "jobs/circle_closure/circle_closure_job.h"
#include "jobs/file_source.h"
#include "reports/forms/record_sentences.h"
#include "reports/record/make/circle_closure/circle_closure_findings.h"
#include "reports/record/make/circle_closure/circle_closure_record.h"
#include "reports/record/make/comparison/compared_job_side.h"

namespace gumcert::evaluation {
namespace {

using jobs::MemoryFileSource;
using nlohmann::json;
using reports::EvaluationRecord;

const std::filesystem::path k_closure_templates = std::filesystem::path(GUMCERT_SOURCE_DIR) / "templates";
const std::filesystem::path k_closure_examples = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples";

/// A simulated comparison, in arcsec; its truth is 3 sin and 2 cos.
struct Campaign {
    std::size_t steps = 8, repetitions = 1;
    double sigma = 0.2, drift = 0.0, outlier = 0.0, moved = 0.0;
    bool closing = true;
    std::uint64_t seed = 1;
};

double table_of(std::size_t j, std::size_t n) {
    return 3.0 * std::sin(2.0 * M_PI * static_cast<double>(j % n) / static_cast<double>(n));
}

double side_of(std::size_t i, std::size_t n) {
    return 2.0 * std::cos(4.0 * M_PI * static_cast<double>(i % n) / static_cast<double>(n));
}

std::string csv_of(const Campaign& c) {
    std::mt19937_64 random(c.seed);
    std::normal_distribution<double> noise(0.0, c.sigma);
    std::string csv = "position,step,reading,repetition\n";
    for (std::size_t k = 0; k < c.steps; ++k) {
        for (std::size_t r = 0; r < c.repetitions; ++r) {
            for (std::size_t j = 0; j < c.steps + (c.closing ? 1 : 0); ++j) {
                double reading = table_of(j, c.steps) + side_of(k + c.steps - j % c.steps, c.steps) + noise(random) +
                                 static_cast<double>(k) +
                                 c.drift * static_cast<double>(j) / static_cast<double>(c.steps);
                reading += k == 2 && r == 0 && j == 3 ? c.outlier : 0.0;
                reading += k == 1 && j % 2 == 0 ? c.moved : 0.0;
                csv += std::to_string(k) + "," + std::to_string(j) + "," + std::to_string(reading) + "," +
                       std::to_string(r) + "\n";
            }
        }
    }
    return csv;
}

MemoryFileSource files_of(const Campaign& campaign, const std::string& more = "") {
    return MemoryFileSource({{"job.json", R"({"schema": "gumcert/job/1", "kind": "circle_closure", "axis": "C",
        "readings": "r.csv", "numbering": "with", "steps": )" +
                                              std::to_string(campaign.steps) + more + "}"},
                             {"r.csv", csv_of(campaign)}});
}

EvaluationRecord record_of(const Campaign& campaign, const std::string& more = "") {
    return evaluate_job(files_of(campaign, more), "job.json", CovarianceFile::none, 1, k_closure_templates).record;
}

std::vector<std::string> codes(const EvaluationRecord& record) {
    std::vector<std::string> all;
    for (const gum::Diagnostic& diagnostic : record.diagnostics) {
        all.push_back(diagnostic.code);
    }
    return all;
}

const reports::Result& result_named(const EvaluationRecord& record, const std::string& name) {
    return *std::find_if(record.results.begin(), record.results.end(), [&](const auto& r) { return r.name == name; });
}

TEST(CircleClosureRecord, StatesTheClosedFormWithItsBudget) {
    const Campaign campaign{.closing = false};
    const EvaluationRecord record = record_of(
        campaign, R"(, "effects": [{"name": "scale", "acts_on": "scale", "u": 0.01, "source": "certificate 17"},
                                   {"name": "seating", "acts_on": "step", "u": 0.05, "nu": 10},
                                   {"name": "drift", "acts_on": "turn", "half_width": 0.04}])");
    ASSERT_EQ(record.results.size(), 18U);
    ASSERT_TRUE(record.circle_closure);
    const reports::CircleClosure& closure = *record.circle_closure;
    EXPECT_TRUE(closure.full);
    EXPECT_EQ(closure.degrees_of_freedom, 42.0);
    const reports::Result& at45 = result_named(record, "ECC[45]");
    EXPECT_EQ(at45.quantity, "ECC");
    EXPECT_EQ(at45.point, "45");
    ASSERT_EQ(at45.budget.size(), 4U);
    const double scatter = closure.residual_standard_deviation.number * std::sqrt(7.0) / 8.0;
    const double seating = 0.05 * std::sqrt(7.0 / 8.0);
    const double drift = 0.04 / std::sqrt(3.0) * std::abs(1.0 - 3.5) / 8.0;  // (j − mean j)/n of a full turn
    EXPECT_NEAR(at45.budget[0].contribution.number, scatter, 1e-12);
    EXPECT_NEAR(at45.budget[1].contribution.number, 0.01 * std::abs(at45.value), 1e-12);
    EXPECT_NEAR(*at45.budget[1].sensitivity.number, at45.value, 1e-9);
    EXPECT_NEAR(at45.budget[2].contribution.number, seating, 1e-12);
    EXPECT_NEAR(at45.budget[3].contribution.number, drift, 1e-12);
    EXPECT_EQ(at45.budget[1].source, "certificate 17");
    EXPECT_EQ(at45.budget[0].type, "A");
    EXPECT_EQ(*at45.budget[0].nu.number, 42.0);
    const double u = std::sqrt(scatter * scatter + std::pow(0.01 * at45.value, 2) + seating * seating + drift * drift);
    EXPECT_NEAR(at45.u, u, 1e-12);
    const double nu = std::pow(u, 4) / (std::pow(scatter, 4) / 42.0 + std::pow(seating, 4) / 10.0);
    EXPECT_NEAR(*at45.nu_eff, nu, 1e-9 * nu);
    // t with 10 degrees of freedom dominates: k is that of the convolution, and not far from that of ν_eff.
    EXPECT_EQ(at45.coverage, "convolution");
    EXPECT_NEAR(*at45.k, gum::coverage_factor(0.9545, nu), 0.1);
    EXPECT_NEAR(*at45.U, *at45.k * u, 1e-12);
    const EvaluationRecord alone = record_of(campaign);
    EXPECT_EQ(alone.results[1].coverage, "student_t");
    EXPECT_NEAR(*alone.results[1].k, gum::coverage_factor(0.9545, 42.0), 1e-12);
    EXPECT_LT(std::abs(at45.value - table_of(1, 8)), 4.0 * u);
    const reports::Result& range = result_named(record, "range_ECC");
    double most = -1e9;
    double least = 1e9;
    for (std::size_t j = 0; j < 8; ++j) {
        most = std::max(most, record.results[j].value);
        least = std::min(least, record.results[j].value);
    }
    EXPECT_NEAR(range.value, most - least, 1e-12);
    ASSERT_TRUE(record.covariance);
    EXPECT_NEAR(record.covariance->matrix[1][1], u * u, 1e-12);
    // The scatter alone gives −s²/n² between two steps; seating and drift come on top.
    EXPECT_NEAR(record.covariance->matrix[0][8], 0.0, 1e-4);
    EXPECT_THAT(codes(record), testing::IsEmpty());
}

TEST(CircleClosureRecord, IsReadAgainAndEvaluatedAgain) {
    for (const char* const job : {"job.json", "indexing_tables.json", "comparison.json"}) {
        const EvaluationRecord record =
            evaluate_job(k_closure_examples / "circle_closure" / job, CovarianceFile::none, 1, k_closure_templates)
                .record;
        const std::string text = reports::to_canonical_json(record);
        EvaluationRecord again = reports::record_from_json(text, "record.json");
        EXPECT_EQ(reports::to_canonical_json(again), text) << job;
        EXPECT_FALSE(recompute_record(again, "record.json", 1, k_closure_templates)) << job;
    }
}

/// Truth of an example, column by column.
std::vector<std::vector<double>> truth_of(const std::string& file) {
    const std::string text = jobs::DiskFileSource(k_closure_examples / "circle_closure").read(file);
    std::vector<std::vector<double>> rows;
    std::size_t at = text.find('\n') + 1;
    while (at < text.size()) {
        std::vector<double> row;
        const std::size_t end = text.find('\n', at);
        while (at < end) {
            const std::size_t comma = std::min(text.find(',', at), end);
            row.push_back(std::stod(text.substr(at, comma - at)));
            at = comma + 1;
        }
        at = end + 1;
        rows.push_back(std::move(row));
    }
    return rows;
}

TEST(CircleClosureExamples, HoldTheirTruth) {
    for (const auto& [job, truth_file] :
         {std::pair("job.json", "truth.csv"), std::pair("indexing_tables.json", "indexing_tables_truth.csv")}) {
        const EvaluationRecord record =
            evaluate_job(k_closure_examples / "circle_closure" / job, CovarianceFile::none, 1, k_closure_templates)
                .record;
        const auto truth = truth_of(truth_file);
        double sum = 0.0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            for (const std::size_t circle : {0U, 1U}) {
                const reports::Result& result = record.results.at(circle * truth.size() + i);
                // The stated effects are not in the simulated readings: the scatter alone is held against the truth.
                const double z = (result.value - truth[i][2 + circle]) / result.budget.front().contribution.number;
                EXPECT_LT(std::abs(z), 4.5) << result.name;
                sum += z * z;
            }
        }
        const double rms = std::sqrt(sum / static_cast<double>(2 * truth.size()));
        EXPECT_GT(rms, 0.7) << job;
        EXPECT_LT(rms, 1.3) << job;
        EXPECT_THAT(codes(record), testing::IsEmpty()) << job;
    }
}

TEST(CircleClosureRecord, MonteCarloConfirmsTheLawOfPropagation) {
    const EvaluationRecord record = record_of({.steps = 5}, R"(, "monte_carlo": {"trials": 250000}, "effects": [
        {"name": "seating", "acts_on": "step", "u": 0.02, "nu": 5}, {"name": "scale", "acts_on": "scale", "u": 0.001}])");
    for (std::size_t i = 0; i < 10; ++i) {
        const reports::Result& result = record.results[i];
        ASSERT_TRUE(result.monte_carlo) << result.name;
        const double half_width =
            0.5 * (result.monte_carlo->symmetric.number[1] - result.monte_carlo->symmetric.number[0]);
        EXPECT_NEAR(half_width, *result.U, 0.02 * *result.U) << result.name;
    }
    // The readings share one s: drawn with independent t-distributions, u would be too small by the root of ν/(ν − 2).
    const double nu = record.circle_closure->degrees_of_freedom;
    const EvaluationRecord alone = record_of({.steps = 5}, R"(, "monte_carlo": {"trials": 250000})");
    EXPECT_NEAR(*alone.results[0].monte_carlo->u.number, alone.results[0].u * std::sqrt(nu / (nu - 2.0)),
                0.01 * alone.results[0].u);
}

TEST(CircleClosureRecord, TellsWhatItsReadingsBetray) {
    EXPECT_THAT(codes(record_of({})), testing::IsEmpty());
    EXPECT_THAT(codes(record_of({.closing = false})), testing::ElementsAre("GC-CLOSURE-0024"));
    EXPECT_THAT(codes(record_of({.outlier = 2.0})), testing::ElementsAre("GC-CLOSURE-0022"));
    EXPECT_THAT(codes(record_of({.drift = 1.0})), testing::Contains("GC-CLOSURE-0023"));
    EXPECT_THAT(codes(record_of({.drift = 1.0}, R"(, "drift": "linear")")), testing::IsEmpty());
    EXPECT_THAT(codes(record_of({}, R"(, "repeatability": {"u": 0.1, "nu": 50})")),
                testing::Contains("GC-CLOSURE-0020"));
    EXPECT_THAT(codes(record_of({}, R"(, "repeatability": {"u": 0.2, "nu": 50})")), testing::IsEmpty());
    EXPECT_THAT(codes(record_of({.repetitions = 2, .moved = 0.8})), testing::Contains("GC-CLOSURE-0021"));
    EXPECT_THAT(codes(record_of({.repetitions = 2})), testing::IsEmpty());
    const EvaluationRecord record = record_of({.outlier = 2.0});
    EXPECT_TRUE(record.diagnostics.front().what.starts_with("the reading at step 3 in position 2, repetition 0, "))
        << record.diagnostics.front().what;
}

TEST(CircleClosureFindings, HoldAnAccreditedCertificateBack) {
    EvaluationRecord record = record_of({.drift = 1.0});
    const auto found = [&](const std::string& status) {
        record.certificate.emplace();
        record.certificate->data.status = status;
        std::map<std::string, certificate::FindingSeverity> all;
        for (const certificate::Finding& finding : reports::circle_closure_findings(record)) {
            all.emplace(finding.id, finding.severity);
        }
        return all;
    };
    EXPECT_EQ(found("accredited").at("C04"), certificate::FindingSeverity::critical);
    EXPECT_EQ(found("not_accredited").at("C04"), certificate::FindingSeverity::major);
    record = record_of({.closing = false});
    EXPECT_EQ(found("accredited").at("C05"), certificate::FindingSeverity::major);
    record = record_of({});
    EXPECT_TRUE(found("accredited").empty());
}

TEST(CircleClosureRecord, SpeaksItsSentencesInEveryLanguage) {
    for (const Campaign& campaign : {Campaign{.outlier = 2.0}, Campaign{.drift = 1.0}, Campaign{.closing = false},
                                     Campaign{.repetitions = 2, .moved = 0.8}}) {
        const EvaluationRecord record = record_of(campaign, R"(, "repeatability": {"u": 0.05})");
        std::vector<std::string> known;
        for (const reports::IdentifiedSentence& sentence : record.statements) {
            known.push_back(sentence.text);
        }
        for (const gum::Diagnostic& diagnostic : record.diagnostics) {
            EXPECT_THAT(known, testing::Contains(diagnostic.what));
            EXPECT_THAT(known, testing::Contains(diagnostic.rule));
            EXPECT_THAT(known, testing::Contains(diagnostic.action));
        }
    }
}

TEST(CircleClosureRecord, FalseAlarmsAreRare) {
    int alarms = 0;
    constexpr int k_campaigns = 200;
    for (int campaign = 0; campaign < k_campaigns; ++campaign) {
        const auto job = jobs::read_circle_closure_job(
            files_of({.steps = 6, .repetitions = 2, .seed = 100 + static_cast<std::uint64_t>(campaign)},
                     R"(, "repeatability": {"u": 0.2})"),
            "job.json");
        alarms += reports::circle_closure_record(job, gum::evaluate_circle_closure(job, 1), {}, "").diagnostics.empty()
                      ? 0
                      : 1;
    }
    EXPECT_LE(alarms, 4);  // four tests at 0.001 each: 0.8 are to be expected
}

TEST(ComparedJobSide, TakesTheMeanOffWithItsCovariance) {
    reports::MethodSide side;
    side.value = {1.0, 2.0, 6.0};
    side.uncertainty.resize(3);
    for (gum::ResultUncertainty& u : side.uncertainty) {
        u = {.u = 0.5, .U = 1.0, .k = 2.0, .degrees_of_freedom = 8.0};
    }
    side.covariance = 0.25 * Eigen::Matrix3d::Identity();
    reports::take_off_mean(side, 0.95);
    EXPECT_NEAR(side.value[0], -2.0, 1e-15);
    EXPECT_NEAR(side.value[2], 3.0, 1e-15);
    EXPECT_NEAR(side.uncertainty[0].u, 0.5 * std::sqrt(2.0 / 3.0), 1e-15);
    EXPECT_NEAR(side.uncertainty[0].U, side.uncertainty[0].u * gum::coverage_factor(0.95, 8.0), 1e-12);
    EXPECT_NEAR(side.covariance(0, 1), -0.25 / 3.0, 1e-15);
    // A part that all points share goes with the mean.
    side.covariance = Eigen::Matrix3d::Constant(4.0);
    reports::take_off_mean(side, 0.95);
    EXPECT_LT(side.covariance.cwiseAbs().maxCoeff(), 1e-14);
}

/// The verdict on a circle closure against what is true of it, where the closure is as stated.
TEST(ComparedJobSide, WhatTheJobSaysAgainstItselfStandsInTheComparison) {
    const auto compared = [](const Campaign& campaign, const std::string& repeatability) {
        std::string points;
        for (std::size_t j = 0; j < campaign.steps; ++j) {
            const double truth = table_of(j, campaign.steps);
            points += (j == 0 ? "" : ", ") + (R"({"point": ")" + std::to_string(360 * j / campaign.steps)) +
                      R"(", "value": )" + std::to_string(truth) + R"(, "u": 0.01})";
        }
        return evaluate_job(MemoryFileSource(
                                {{"job.json", R"({"schema": "gumcert/job/1", "kind": "comparison", "unit": "arcsec",
                            "correlation": "none", "lab": {"name": "circle", "job": "closure.json"},
                            "reference": {"name": "truth", "points": [)" +
                                                  points + "]}}"},
                                 {"closure.json", R"({"schema": "gumcert/job/1", "kind": "circle_closure", "axis": "C",
                            "readings": "r.csv", "numbering": "with", "steps": )" +
                                                      std::to_string(campaign.steps) + repeatability + "}"},
                                 {"r.csv", csv_of(campaign)}}),
                            "job.json", CovarianceFile::none, 1, k_closure_templates)
            .record;
    };
    const EvaluationRecord sound = compared({}, R"(, "repeatability": {"u": 0.2, "nu": 50})");
    EXPECT_TRUE(sound.comparison->refuted.empty());
    EXPECT_NE(sound.comparison->summary.back().verdict, "side_refuted");
    // Stated a quarter of what the readings scatter: C01, and a reading that nobody can believe: C03.
    for (const auto& [campaign, repeatability, id] :
         {std::tuple(Campaign{}, std::string(R"(, "repeatability": {"u": 0.05, "nu": 50})"), "C01"),
          std::tuple(Campaign{.outlier = 2.0}, std::string(), "C03"),
          std::tuple(Campaign{.drift = 1.0}, std::string(), "C04")}) {
        const EvaluationRecord record = compared(campaign, repeatability);
        const reports::Comparison& comparison = *record.comparison;
        EXPECT_TRUE(std::any_of(comparison.refuted.begin(), comparison.refuted.end(),
                                [&](const reports::RefutedSide& by) { return by.side == "circle" && by.id == id; }))
            << id;
        EXPECT_THAT(comparison.summary.back().verdict, testing::AnyOf("side_refuted", "disagreement")) << id;
        EXPECT_THAT(codes(record), testing::Contains(testing::StartsWith("GC-CLOSURE-002"))) << id;
    }
}

TEST(ComparedJobSide, BothMethodsAgreeOnTheSameTable) {
    const EvaluationRecord record = evaluate_job(k_closure_examples / "circle_closure/comparison.json",
                                                 CovarianceFile::none, 1, k_closure_templates)
                                        .record;
    ASSERT_TRUE(record.comparison);
    const reports::Comparison& comparison = *record.comparison;
    ASSERT_EQ(comparison.points.size(), 36U);
    double values = 0.0;
    double references = 0.0;
    for (const reports::ComparisonPoint& point : comparison.points) {
        values += point.value.number;
        references += point.reference_value.number;
    }
    EXPECT_NEAR(values, 0.0, 1e-9);
    EXPECT_NEAR(references, 0.0, 1e-9);
    ASSERT_EQ(comparison.summary.size(), 1U);
    // One angle of the tracking interferometer is 3.6 u off its truth, which is in its readings.
    const reports::ComparisonSummary& summary = comparison.summary.front();
    EXPECT_LE(summary.count_above_1, *summary.count_by_chance);
    EXPECT_LT(summary.mean_abs_En.number, 0.7);
    EXPECT_GT(*summary.p_high.number, 0.025);
    ASSERT_TRUE(summary.bias);
    EXPECT_NEAR(summary.bias->constant.number, 0.0, 1e-9);
    EXPECT_LT(std::abs(summary.bias->slope.number), 3.0 * summary.bias->u_slope);
    // Against the truth, both: the datum is that of the sum.
    const auto truth = truth_of("truth.csv");
    for (std::size_t i = 0; i < 36; ++i) {
        EXPECT_LT(std::abs(comparison.points[i].reference_value.number - truth[i][2]),
                  4.5 * *comparison.points[i].reference_u);
        EXPECT_LT(std::abs(comparison.points[i].value.number - truth[i][2]), 4.5 * *comparison.points[i].u);
    }
}

}  // namespace
}  // namespace gumcert::evaluation
