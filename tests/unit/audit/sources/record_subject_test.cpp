#include "audit/sources/record_subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/budget_outcome.h"
#include "audit/rules/registry.h"
#include "gum/conformity/decision_rule.h"
#include "gum/coverage.h"

namespace gumcert::audit {
namespace {

/// A record of two inputs, u_c = 0.5 µm, k = 2.
reports::EvaluationRecord two_rows() {
    reports::EvaluationRecord record;
    record.kind = "budget";
    record.job_json =
        R"({"inputs": {"a": {"value": 0, "unit": "um", "u": 0.3}, "b": {"value": 1, "unit": "um", "mpe": 0.69282}}})";
    reports::Result result;
    result.name = "y";
    result.unit = "um";
    result.value = 1.0;
    result.u = 0.5;
    result.k = 2.0;
    result.U = 1.0;
    result.coverage = "normal";
    result.reported.value = 1.0;
    result.reported.u = 0.5;
    result.reported.k = 2.0;
    result.reported.U = 1.0;
    reports::BudgetRow a;
    a.input = "a";
    a.value.number = 0.0;
    a.unit = "um";
    a.u.number = 0.3;
    a.type = "B";
    a.sensitivity.number = 1.0;
    a.contribution.number = 0.3;
    a.distribution = "normal";
    reports::BudgetRow b = a;
    b.input = "b";
    b.value.number = 1.0;
    b.u.number = 0.4;
    b.contribution.number = 0.4;
    b.distribution = "uniform";
    result.budget = {a, b};
    record.results = {result};
    return record;
}

TEST(SubjectOfRecord, EvaluatesToWhatTheRecordReports) {
    const AuditSubject subject = subject_of(two_rows(), "record.json");
    EXPECT_EQ(subject.kind, AuditSubject::Kind::record);
    ASSERT_EQ(subject.budgets.size(), 1U);
    const BudgetOutcome outcome = evaluate(subject.budgets.front());
    EXPECT_NEAR(outcome.u_c, 0.5, 1e-12);
    EXPECT_NEAR(outcome.U, 1.0, 1e-5) << "k = 2 is t of 95.45 % but for its last digits";
    EXPECT_TRUE(subject.budgets.front().evaluated_here);
}

/// Tables show the rows of points in an order of their own: groups, and rows that are chosen.
TEST(SubjectOfRecord, TakesWhatIsCertifiedByTheNameOfThePoint) {
    std::mt19937_64 drawn(18);
    for (int trial = 0; trial < 50; ++trial) {
        reports::EvaluationRecord record = two_rows();
        const reports::Result sample = record.results.front();
        record.results.clear();
        record.certificate.emplace();
        record.certificate->tables.resize(2);
        for (certificate::CertifiedTable& table : record.certificate->tables) {
            table.argument = {.name = "point", .unit = "", .printed_unit = "", .values = {}, .printed = {}};
            table.columns.push_back({.result = "y", .name = "y", .unit = "um", .printed_unit = "µm", .values = {}});
        }
        std::vector<std::size_t> order(6);
        std::iota(order.begin(), order.end(), 0U);
        std::shuffle(order.begin(), order.end(), drawn);
        for (std::size_t p = 0; p < order.size(); ++p) {
            reports::Result result = sample;
            result.quantity = "y";
            result.point = std::to_string(p);
            result.name = "y[" + result.point + "]";
            record.results.push_back(result);
            certificate::CertifiedTable& table = record.certificate->tables[p % 2];
            certificate::CertifiedValue value;
            value.U = 1.0 + static_cast<double>(order[p]);
            value.scope_entry = "S";
            value.capability = 0.5 + static_cast<double>(order[p]);
            value.verdict.emplace();
            value.verdict->verdict = order[p] % 2 == 0 ? "pass" : "fail";
            value.verdict->upper = 10.0 * static_cast<double>(order[p]);
            table.argument->printed.push_back(std::to_string(order[p]));
            table.argument->values.emplace_back();
            table.columns.front().values.push_back(value);
        }
        const AuditSubject subject = subject_of(record, "record.json");
        ASSERT_EQ(subject.budgets.size(), order.size());
        for (std::size_t p = 0; p < order.size(); ++p) {
            const AuditedBudget& budget = subject.budgets[p];
            ASSERT_TRUE(budget.claims.U);
            EXPECT_EQ(budget.claims.U->value, 1.0 + static_cast<double>(p)) << budget.name;
            EXPECT_EQ(budget.capability, 0.5 + static_cast<double>(p)) << budget.name;
            EXPECT_EQ(budget.claims.verdict, p % 2 == 0 ? "pass" : "fail") << budget.name;
            EXPECT_EQ(budget.limits.upper, 10.0 * static_cast<double>(p)) << budget.name;
        }
    }
}

TEST(SubjectOfRecord, TakesTheStatementsOfInputsFromTheJob) {
    const AuditSubject subject = subject_of(two_rows(), "record.json");
    const AuditedRow& b = subject.budgets.front().rows.at(1);
    EXPECT_EQ(b.origin, Origin::specification);
    EXPECT_EQ(b.origin_value, 0.69282);
    EXPECT_EQ(b.shape, Shape::rectangular);
    EXPECT_EQ(b.place, "/results/y/budget/1");
}

/// A correlation that the job states, in whichever way, and 0 too, is none that is neglected (S10).
TEST(SubjectOfRecord, KnowsTheCorrelationsThatTheJobStates) {
    const auto finds = [](const std::string& statement) {
        reports::EvaluationRecord record = two_rows();
        record.job_json =
            R"({"inputs": {"a": {"value": 0, "unit": "um", "U": 0.6, "k": 2, "source": "certificate K-17"},
            "b": {"value": 1, "unit": "um", "U": 0.8, "k": 2, "source": "certificate K-17"}})" +
            statement + "}";
        for (reports::BudgetRow& row : record.results[0].budget) {
            row.source = "certificate K-17";
        }
        const AuditReport report = audit(subject_of(record, "record.json"), all_rules());
        return std::any_of(report.findings.begin(), report.findings.end(),
                           [](const AuditFinding& finding) { return finding.rule == "S10"; });
    };
    EXPECT_TRUE(finds(""));
    EXPECT_TRUE(finds(R"(, "correlations": [["a", "c", 0.5]])"));
    for (const char* const statement :
         {R"(, "correlations": [["b", "a", 0.5]])", R"(, "correlations": [["a", "b", 0]])",
          R"(, "simultaneous": [["c", "a", "b"]])",
          R"(, "covariance": {"inputs": ["a", "b"], "matrix": {"file": "v.csv"}})"}) {
        EXPECT_FALSE(finds(statement)) << statement;
    }
}

/// What a job says in words of a u that it states alone counts the same wherever it stands.
TEST(SubjectOfRecord, ReadsTheWordsOfSourceAndNote) {
    for (const std::string words :
         {"data sheet of the balance, MPE 0.3 um", "U = 0.3 um, k = 2", "resolution 0.3 um", "limits ±0.3 um",
          "manufacturer's specification 0.3 um", "certificate K-17", "mean of 10 readings", "nothing to read"}) {
        const auto report = [&words](bool in_source) {
            reports::EvaluationRecord record = two_rows();
            record.job_json = R"({"inputs": {"a": {"value": 0, "unit": "um", "u": 0.3, ")" +
                              std::string(in_source ? "source" : "note") + R"(": ")" + words +
                              R"("}, "b": {"u": 0.4}}})";
            record.results[0].budget[0].source = in_source ? words : "";
            return audit(subject_of(record, "record.json"), all_rules());
        };
        const AuditReport note = report(false), source = report(true);
        const AuditedRow& of_note = note.subject.budgets.at(0).rows.at(0);
        const AuditedRow& of_source = source.subject.budgets.at(0).rows.at(0);
        EXPECT_EQ(of_source.origin, of_note.origin) << words;
        EXPECT_EQ(of_source.origin_value, of_note.origin_value) << words;
        const auto rules = [](const AuditReport& all) {
            std::set<std::string> found;
            for (const AuditFinding& finding : all.findings) {
                if (finding.rule.starts_with("U")) {
                    found.insert(finding.rule);
                }
            }
            return found;
        };
        EXPECT_EQ(rules(source), rules(note)) << words;
        if (words.find("MPE") != std::string::npos) {
            EXPECT_TRUE(rules(source).contains("U10"));
        }
    }
}

TEST(SubjectOfRecord, WhatCorrelationsAddStaysAsItIs) {
    reports::EvaluationRecord record = two_rows();
    record.results[0].u = 0.6;
    record.results[0].reported.u = 0.6;
    record.results[0].U = record.results[0].reported.U = 1.2;
    const AuditSubject subject = subject_of(record, "record.json");
    EXPECT_NEAR(subject.budgets.front().correlation_variance, 0.36 - 0.25, 1e-12);
    EXPECT_NEAR(evaluate(subject.budgets.front()).u_c, 0.6, 1e-12);
}

/// What trials show beyond the law of propagation has no part in ν_eff, and the stated one is what is claimed.
TEST(SubjectOfRecord, ClaimsTheNuThatIsStatedBesideTrials) {
    for (const double u : {0.5, 0.55, 0.8, 2.0}) {
        reports::EvaluationRecord record = two_rows();
        reports::Result& result = record.results[0];
        result.budget[0].nu.number = 4.0;
        result.nu_eff = std::pow(0.5, 4) / (std::pow(0.3, 4) / 4.0);
        result.reported.method = "monte_carlo";
        result.reported.u = u;
        result.reported.U = 1.9 * u;
        result.reported.k = 1.9;
        const AuditReport report = audit(subject_of(record, "record.json"), all_rules());
        const AuditedResult& audited = report.results.at(0);
        EXPECT_NEAR(audited.claimed.nu_eff, *result.nu_eff, 1e-9) << u;
        EXPECT_NEAR(audited.audited.nu_eff, *result.nu_eff, 1e-9) << u;
        EXPECT_TRUE(audited.allowed.nu_eff.contains(*result.nu_eff) ||
                    std::abs(audited.allowed.nu_eff.low / *result.nu_eff - 1.0) < 1e-9);
        EXPECT_NEAR(audited.audited.U, 1.9 * u, 1e-9) << u;
        result.nu_eff = 482.0;
        EXPECT_EQ(audit(subject_of(record, "record.json"), all_rules()).results.at(0).claimed.nu_eff, 482.0);
    }
}

/// Correlated inputs are one contribution of the evaluation: its ν_eff is not what the formula of Welch and Satterthwaite gives for
/// the rows as independent ones, and the audit says the same number as the record.
TEST(SubjectOfRecord, HasTheDegreesOfFreedomOfTheEvaluation) {
    for (const double nu : {1.2, 4.0, 28.8, 900.0}) {
        reports::EvaluationRecord record = two_rows();
        reports::Result& result = record.results[0];
        for (reports::BudgetRow& row : result.budget) {
            row.nu.number = 4.0;
        }
        result.u = result.reported.u.emplace(0.2);  // r below 0
        result.nu_eff = nu;
        result.k = result.reported.k.emplace(gum::coverage_factor(0.9545, nu));
        result.U = result.reported.U.emplace(0.2 * *result.k);
        const AuditReport report = audit(subject_of(record, "record.json"), all_rules());
        const AuditedResult& audited = report.results.at(0);
        EXPECT_NEAR(audited.recomputed.nu_eff, nu, 1e-6 * nu);
        EXPECT_NEAR(audited.allowed.nu_eff.low, nu, 1e-6 * nu);
        EXPECT_NEAR(audited.recomputed.k, *result.k, 1e-9);
        EXPECT_EQ(report.subject.budgets[0].coverage.kind, CoverageRule::Kind::student_t);
    }
    reports::EvaluationRecord cancelled = two_rows();  // what has degrees of freedom cancels
    cancelled.results[0].budget[0].nu.number = 4.0;
    cancelled.results[0].u = cancelled.results[0].reported.u.emplace(0.2);
    EXPECT_TRUE(std::isinf(evaluate(subject_of(cancelled, "record.json").budgets[0]).nu_eff));
}

/// Where an interval is stated and no U, certificate and audit decide with one width: the larger distance of an end from the value.
TEST(SubjectOfRecord, DecidesByTheIntervalThatIsStated) {
    std::mt19937_64 drawn(5);
    std::uniform_real_distribution<double> part(0.2, 3.0);
    for (int trial = 0; trial < 30; ++trial) {
        reports::EvaluationRecord record = two_rows();
        reports::Result& result = record.results[0];
        reports::ReportedResult& reported = result.reported;
        const double below = part(drawn), above = part(drawn), width = std::max(below, above);
        reported.method = "monte_carlo";
        reported.U.reset();
        reported.k.reset();
        reported.u = trial % 3 == 0 ? std::nullopt : std::optional(0.4 * part(drawn));
        reported.interval = std::array{reported.value - below, reported.value + above};
        AuditSubject subject = subject_of(record, "record.json");
        AuditedBudget& budget = subject.budgets.front();
        EXPECT_FALSE(budget.claims.U || budget.claims.k);
        EXPECT_NEAR(evaluate(budget).U, width, 1e-9);
        budget.rule = gum::DecisionRule::guard_band_u;
        budget.limits.upper = reported.value + 1.001 * width;
        EXPECT_EQ(evaluate(budget).verdict, "pass");
        budget.limits.upper = reported.value + 0.999 * width;
        EXPECT_EQ(evaluate(budget).verdict, "fail");
    }
}

TEST(SubjectOfRecord, KnowsWhatIsMeasured) {
    reports::EvaluationRecord record = two_rows();
    EXPECT_FALSE(subject_of(record, "record.json").budgets[0].rows[0].is_measured);
    record.results[0].budget[0].standard = "TS-2";
    record.job_json = R"({"inputs": {"b": {"value": 1, "unit": "um", "mpe": 0.7, "role": "indication"}}})";
    const std::vector<AuditedRow> rows = subject_of(record, "record.json").budgets[0].rows;
    EXPECT_TRUE(rows[0].is_measured);
    EXPECT_TRUE(rows[1].is_measured);
}

/// A comparison at two points, E_n = −0.5 and 0.8; the reference has a budget in a file of the job.
reports::EvaluationRecord compared() {
    reports::EvaluationRecord record;
    record.kind = "rotary_table";
    record.job_json = R"({"reference_method": {"budget": "indicator.json"}})";
    reports::InputFile file;
    file.name = "indicator.json";
    file.content = R"({"inputs": {"b": {"value": 0, "unit": "um", "u": 0.4, "note": "MPE 0.4 um"}}})";
    record.job_files = {file};
    reports::Comparison& comparison = record.comparison.emplace();
    comparison.unit = "um";
    comparison.reference_name = "indicator";
    comparison.score_probability = 0.9545;
    for (const double difference : {-0.5, 0.8}) {
        reports::ComparisonPoint point;
        point.value.number = difference;
        point.reference_value.number = 0.0;
        point.u = 0.3;
        point.U.number = 0.6;
        point.reference_u = 0.4;
        point.reference_U.number = 0.8;
        point.En.number = difference;
        comparison.points.push_back(point);
    }
    comparison.reference_budget = {two_rows().results[0].budget[1]};
    comparison.method_budget = {two_rows().results[0].budget[0]};
    return record;
}

TEST(SubjectOfRecord, ReadsTheStatementsOfAReference) {
    const AuditSubject subject = subject_of(compared(), "record.json");
    ASSERT_EQ(subject.budgets.size(), 2U);
    EXPECT_EQ(subject.budgets[1].name, "indicator");
    EXPECT_EQ(subject.budgets[1].rows.at(0).origin, Origin::specification);
    const AuditReport report = audit(subject, all_rules());
    const auto mpe = std::find_if(report.findings.begin(), report.findings.end(),
                                  [](const AuditFinding& finding) { return finding.rule == "U10"; });
    ASSERT_NE(mpe, report.findings.end());
    ASSERT_TRUE(mpe->effect && mpe->effect->alone.en);
    EXPECT_NEAR(*mpe->effect->alone.en, 0.8 / std::hypot(0.6, 0.8 / std::sqrt(3.0)), 1e-9);
}

TEST(SubjectOfRecord, ComparesAtThePointThatIsAskedFor) {
    const AuditSubject largest = subject_of(compared(), "record.json");
    EXPECT_EQ(largest.budgets[0].reference->point, 1U);
    EXPECT_FALSE(largest.budgets[0].reference->largest_difference);
    EXPECT_NEAR(evaluate(largest.budgets[0]).en.value_or(0.0), 0.8, 1e-9);
    EXPECT_NEAR(evaluate(largest.budgets[1]).en.value_or(0.0), 0.8, 1e-9) << "of the reference: the same sign";
    const AuditSubject first = subject_of(compared(), "record.json", 0);
    EXPECT_EQ(first.budgets[0].value, -0.5);
    EXPECT_NEAR(evaluate(first.budgets[0]).en.value_or(0.0), 0.8, 1e-9) << "of the other point";
}

/// Comparisons between laboratories with whatever an evaluation may leave out.
reports::Comparison drawn_comparison(std::mt19937& random) {
    const auto happens = [&random](double share) { return std::uniform_real_distribution<>(0.0, 1.0)(random) < share; };
    reports::Comparison comparison;
    comparison.form = "laboratories";
    const bool by_scatter = happens(0.5), has_u = happens(0.8);
    for (const char* const round : {"1", "2"}) {
        reports::ComparisonItemEvaluation item;
        item.id = "gauge";
        item.round = round;
        if (happens(0.7)) {
            item.consistency.emplace();
            item.consistency->chi_square.number = happens(0.5) ? 30.0 : 8.0;
            item.consistency->degrees_of_freedom = 9;
            item.consistency->p_value.number = item.consistency->chi_square.number > 10.0 ? 0.0004 : 0.53;
            item.consistency->consistent = item.consistency->p_value.number >= item.consistency->alpha;
        }
        if (happens(0.5)) {
            item.u_stability.number = 0.1;
        }
        comparison.items.push_back(item);
        for (const char* const laboratory : {"A", "B", "C", "D", "E"}) {
            reports::ComparisonPoint point;
            point.participant = laboratory;
            point.item = item.id;
            point.round = round;
            point.value.number = std::normal_distribution<>(0.0, 3.0)(random);
            point.z.number = point.value.number;
            point.signal = "none";
            if (has_u) {
                point.reference_u = 0.2;
                point.reference_U.number = 0.9;
                point.reference_k = 4.5;
            }
            if (happens(0.6)) {
                point.u = 0.5;
                point.U.number = 1.0;
                point.k.number = 2.0;
                point.U_of_scores.number = happens(0.3) ? std::optional(1.1) : std::nullopt;
                if (has_u) {
                    point.En.number = point.value.number / 1.2;
                    point.zeta.number = point.value.number / 0.6;
                    point.correlation = 0.0;
                    point.u_others = by_scatter ? std::optional(0.3) : std::nullopt;
                    point.signal = std::abs(*point.En.number) <= 1.0 ? "none"
                                   : happens(0.7)                    ? "action"
                                                                     : "inconclusive";
                    point.signal_by = {"En"};
                }
            }
            comparison.points.push_back(point);
        }
    }
    return comparison;
}

/// The audit of an evaluated comparison has the signals, the tests and the gaps of the evaluation, and no others.
TEST(SubjectOfRecord, FindsOfAComparisonWhatItsEvaluationSays) {
    std::mt19937 random(7);
    for (int trial = 0; trial < 200; ++trial) {
        reports::EvaluationRecord record;
        record.kind = "comparison";
        record.comparison = drawn_comparison(random);
        record.comparison->artefact_stability = trial % 4 == 0 ? "no drift in two years" : "";
        const reports::Comparison& comparison = *record.comparison;
        std::set<std::string> signals, inconsistent, without_stability;
        for (const reports::ComparisonPoint& point : comparison.points) {
            if (point.En.number && std::abs(*point.En.number) > 1.0 && point.signal == "action") {
                signals.insert(point.participant + ", gauge, round " + point.round);
            }
        }
        for (const reports::ComparisonItemEvaluation& item : comparison.items) {
            if (item.consistency && !item.consistency->consistent) {
                inconsistent.insert("gauge, round " + item.round);
            }
            if (!item.u_stability.number && comparison.artefact_stability.empty()) {
                without_stability.insert("gauge, round " + item.round);
            }
        }
        std::set<std::string> found_signals, found_inconsistent, found_without;
        for (const AuditFinding& finding : audit(subject_of(record, "record.json"), all_rules()).findings) {
            std::set<std::string> places(finding.other_places.begin(), finding.other_places.end());
            places.insert(finding.where);
            EXPECT_NE(finding.rule, "N02") << finding.what.english();
            if (finding.rule == "N06") {
                found_signals = places;
            } else if (finding.rule == "N07") {
                found_without = places;
            } else if (finding.rule == "N09") {
                found_inconsistent.insert(places.begin(), places.end());
            }
        }
        EXPECT_EQ(found_signals, signals) << trial;
        EXPECT_EQ(found_inconsistent, inconsistent) << trial;
        EXPECT_EQ(found_without, without_stability) << trial;
    }
}

TEST(SubjectOfRecord, ExplainsByChanceWhatTheVerdictOfItsDirectionDoesNotObjectTo) {
    reports::EvaluationRecord record = compared();
    reports::Comparison& comparison = *record.comparison;
    for (const char* const direction : {"x", "y", "all"}) {
        reports::ComparisonSummary& row = comparison.summary.emplace_back();
        row.direction = direction;
        row.points = 12;
        row.count_above_1 = 3;
        row.count_by_chance = 3;
        row.verdict = direction == std::string("y") ? "agreement_few_points" : "disagreement";
    }
    comparison.points[0].direction = "x";
    comparison.points[0].En.number = 6.54;
    comparison.points[1].direction = "y";
    comparison.points[1].En.number = 1.22;
    const std::vector<AuditedScore> scores = subject_of(record, "record.json").comparison->scores;
    EXPECT_FALSE(scores[0].is_without_objection);
    EXPECT_TRUE(scores[1].is_without_objection);
    comparison.summary[1].count_above_1 = 4;
    EXPECT_FALSE(subject_of(record, "record.json").comparison->scores[1].is_without_objection);
    for (const char* const objection : {"", "points_above_1", "side_refuted", "disagreement"}) {
        comparison.summary[1].count_above_1 = 3;
        comparison.summary[1].verdict = objection;
        EXPECT_FALSE(subject_of(record, "record.json").comparison->scores[1].is_without_objection) << objection;
    }
}

TEST(SubjectOfRecord, TakesTheUncertaintiesThatEnTook) {
    reports::EvaluationRecord record = compared();
    reports::ComparisonPoint& point = record.comparison->points[0];
    point.k.number = 3.0;
    point.U_of_scores.number = 0.41;
    point.reference_k = 4.51;
    point.reference_U_of_scores = 0.82;
    AuditedScore score = subject_of(record, "record.json").comparison->scores[0];
    EXPECT_EQ(score.U, 0.41);
    EXPECT_EQ(score.reference_U, 0.82);
    EXPECT_EQ(score.probability, 0.9545);
    EXPECT_EQ(score.reference_probability, 0.9545);
    point.u_others = 0.3;
    EXPECT_FALSE(subject_of(record, "record.json").comparison->scores[0].reference_probability);
    record.comparison->points[1].coverage_probability = 0.95;
    EXPECT_EQ(subject_of(record, "record.json").comparison->scores[1].probability, 0.95);
}

TEST(SubjectOfRecord, ComponentsAreRowsOfTheirOwn) {
    reports::EvaluationRecord record = two_rows();
    reports::BudgetRow& a = record.results[0].budget[0];
    a.components = {a, a};
    a.components[0].input = "first";
    a.components[1].input = "second";
    a.components[0].u.number = a.components[1].u.number = 0.3 / std::sqrt(2.0);
    const AuditSubject subject = subject_of(record, "record.json");
    ASSERT_EQ(subject.budgets.front().rows.size(), 3U);
    EXPECT_EQ(subject.budgets.front().rows[0].quantity, "a: first");
    EXPECT_NEAR(evaluate(subject.budgets.front()).u_c, 0.5, 1e-12);
}

/// A record lists the readings before the components of the job, and those of standards before both.
TEST(SubjectOfRecord, AuditsEachComponentWithTheStatementOfItsName) {
    std::mt19937 random(20261128);
    for (int made = 0; made < 100; ++made) {
        reports::EvaluationRecord record = two_rows();
        reports::BudgetRow& a = record.results[0].budget[0];
        nlohmann::json job{{"inputs", {{"a", {{"unit", "um"}, {"components", nlohmann::json::array()}}}}}};
        nlohmann::json& stated = job["inputs"]["a"];
        const std::size_t count = 2 + static_cast<std::size_t>(made) % 4;
        for (std::size_t c = 0; c < count; ++c) {
            const double U = 0.1 * static_cast<double>(c + 1);
            stated["components"].push_back({{"name", "part " + std::to_string(c)}, {"U", U}, {"k", 2}});
            reports::BudgetRow part = a;
            part.input = "part " + std::to_string(c);
            part.u.number = 0.5 * U;
            a.components.push_back(part);
        }
        if (made % 2 == 0) {
            stated["observations"] = {1.0, 1.2, 1.1};
            a.components.push_back(a.components.front());
            a.components.back().input = "readings";
        }
        if (made % 3 == 0) {
            a.components.push_back(a.components.front());
            a.components.back().input = "part 1";  // of the register, called as one of the job is
            a.components.back().standard = "STD-1";
        }
        std::shuffle(a.components.begin(), a.components.end(), random);
        record.job_json = job.dump();
        const AuditSubject subject = subject_of(record, "record.json");
        for (std::size_t c = 0; c < a.components.size(); ++c) {
            const AuditedRow& row = subject.budgets.front().rows.at(c);
            const reports::BudgetRow& part = a.components[c];
            if (part.input == "readings") {
                EXPECT_EQ(row.origin, Origin::readings);
                EXPECT_EQ(row.readings.size(), 3U);
            } else if (!part.standard.empty()) {
                EXPECT_FALSE(row.origin_value);
            } else {
                EXPECT_EQ(row.origin_value, 2.0 * part.u.number) << part.input;
                EXPECT_TRUE(row.readings.empty());
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::audit
