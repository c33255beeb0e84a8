#include "evaluation/fixture_budget_audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "evaluation/audit_evaluation.h"
#include "evaluation/audit_files.h"
#include "evaluation/evaluate_job.h"
#include "jobs/file_source.h"
#include "tests/support/file_content.h"
#include "text/numbers.h"

namespace gumcert::evaluation {
namespace {

namespace fs = std::filesystem;

const fs::path k_rotary_table = fs::path(GUMCERT_SOURCE_DIR) / "examples/rotary_table";
constexpr const char* k_job = "job_with_paper_fixture_budget.json";
constexpr const char* k_points = "paper_fixture_points.csv";

std::map<std::string, std::string> files_of_example() {
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(k_rotary_table)) {
        files[entry.path().filename().string()] = test::file_content(entry.path());
    }
    return files;
}

/// The example with other standard uncertainties of the CMM, written into the file of the points as a person would.
/// \param u  of the uncertainty of a coordinate as the file states it, [µm]
reports::EvaluationRecord corrected_by_hand(const std::function<double(double)>& u) {
    std::map<std::string, std::string> files = files_of_example();
    std::istringstream lines(files.at(k_points));
    std::string line, changed;
    std::getline(lines, line);
    changed = line + "\n";
    while (std::getline(lines, line)) {
        const std::size_t comma = line.rfind(',');
        changed += line.substr(0, comma + 1) + text::shortest_plain(u(std::stod(line.substr(comma + 1)))) + "\n";
    }
    files.at(k_points) = changed;
    return evaluate_job(jobs::MemoryFileSource(std::move(files)), k_job, CovarianceFile::none, 1,
                        fs::path(GUMCERT_SOURCE_DIR) / "templates")
        .record;
}

double divided(double mpe) {
    return mpe / std::sqrt(3.0);
}
/// 1.176E-6 of the length in place of 1.176E-7.
double another_power_of_ten(double mpe) {
    return 0.4 + 10.0 * (mpe - 0.4);
}

const audit::AuditReport& audited_example() {
    static const audit::AuditReport report =
        audit_file(k_rotary_table / k_job, 1, fs::path(GUMCERT_SOURCE_DIR) / "templates").report;
    return report;
}

const audit::AuditFinding& finding(const std::string& rule) {
    const std::vector<audit::AuditFinding>& all = audited_example().findings;
    return *std::find_if(all.begin(), all.end(), [&rule](const auto& one) { return one.rule == rule; });
}

double largest_score(const reports::EvaluationRecord& record) {
    double largest = 0.0;
    for (const reports::ComparisonPoint& point : record.comparison->points) {
        largest = std::max(largest, std::abs(point.En.number.value_or(0.0)));
    }
    return largest;
}

double U_of(const reports::EvaluationRecord& record, const std::string& name) {
    for (const reports::Result& result : record.results) {
        if (result.name == name) {
            return result.reported.U.value_or(0.0);
        }
    }
    return 0.0;
}

/// What an outcome says of the displacement of the contact point against the record of the same correction by hand.
void expect_same_score(const audit::BudgetOutcome& outcome, const reports::EvaluationRecord& by_hand) {
    ASSERT_TRUE(outcome.en);
    EXPECT_NEAR(std::abs(*outcome.en), largest_score(by_hand), 1e-9);
}

void expect_the_whole_measurement_for_each_correction(const reports::EvaluationRecord& claimed) {
    const reports::EvaluationRecord u10 = corrected_by_hand(divided);
    const reports::EvaluationRecord s15 = corrected_by_hand(another_power_of_ten);
    const reports::EvaluationRecord both =
        corrected_by_hand([](double mpe) { return divided(another_power_of_ten(mpe)); });
    for (const auto& [rule, alone] : {std::pair("U10", &u10), std::pair("S15", &s15)}) {
        SCOPED_TRACE(rule);
        const audit::AuditFinding& found = finding(rule);
        ASSERT_TRUE(found.effect && found.effect_on_score);
        const std::string name = audited_example().subject.budgets[found.effect->budget].name;
        EXPECT_NEAR(found.effect->claimed.U, U_of(claimed, name), 1e-12);
        EXPECT_NEAR(found.effect->alone.U, U_of(*alone, name), 1e-9 * found.effect->alone.U);
        EXPECT_NEAR(found.effect->audited.U, U_of(both, name), 1e-9 * found.effect->audited.U);
        expect_same_score(found.effect_on_score->claimed, claimed);
        expect_same_score(found.effect_on_score->alone, *alone);
        expect_same_score(found.effect_on_score->audited, both);
    }
    EXPECT_NE(largest_score(claimed), largest_score(u10)) << "else nothing was shown";
    for (const audit::AuditedResult& result : audited_example().results) {
        if (audited_example().subject.budgets[result.budget].place.starts_with("/results/")) {
            EXPECT_NEAR(result.audited.U, U_of(both, result.name), 1e-9 * result.audited.U) << result.name;
        }
    }
}

void expect_the_file_of_what_is_found() {
    EXPECT_TRUE(finding("U10").where.starts_with("paper_fixture_budget.json#/results/x[R1.x]/budget/1"))
        << finding("U10").where;
    std::size_t nested = 0;
    for (const audit::AuditedResult& result : audited_example().results) {
        nested += result.is_nested ? 1U : 0U;
    }
    EXPECT_EQ(nested, 18U) << "three coordinates of six reflectors";
}

void expect_the_same_of_the_record(const reports::EvaluationRecord& record) {
    const fs::path folder = fs::path(::testing::TempDir()) / "fixture_budget_audit";
    fs::create_directories(folder);
    std::ofstream(folder / "record.json") << reports::to_canonical_json(record);
    const audit::AuditReport report =
        audit_file(folder / "record.json", 1, fs::path(GUMCERT_SOURCE_DIR) / "templates").report;
    const auto found =
        std::find_if(report.findings.begin(), report.findings.end(), [](const auto& one) { return one.rule == "U10"; });
    ASSERT_NE(found, report.findings.end());
    ASSERT_TRUE(found->effect_on_score);
    EXPECT_EQ(found->effect_on_score->alone.en, finding("U10").effect_on_score->alone.en);
}

// One test: ctest runs each by itself, and the audit of the example takes seconds.
TEST(FixtureBudgetAudit, EvaluatesTheWholeMeasurementForEachCorrectionAlsoOfTheRecord) {
    const reports::EvaluationRecord claimed = corrected_by_hand([](double mpe) { return mpe; });
    expect_the_whole_measurement_for_each_correction(claimed);
    expect_the_file_of_what_is_found();
    expect_the_same_of_the_record(claimed);
}

TEST(FixtureBudgetAudit, RefutesTheResultWithAReferenceAndWithout) {
    for (const bool has_reference : {true, false}) {
        std::map<std::string, std::string> files = files_of_example();
        nlohmann::json job = nlohmann::json::parse(files.at(k_job), nullptr, true, true);
        if (!has_reference) {
            job.erase("reference_method");
        }
        files.at(k_job) = job.dump();
        const Evaluation evaluation = evaluate_job(jobs::MemoryFileSource(std::move(files)), k_job,
                                                   CovarianceFile::none, 1, fs::path(GUMCERT_SOURCE_DIR) / "templates");
        EXPECT_EQ(evaluation.record.comparison.has_value(), has_reference);
        EXPECT_TRUE(is_refuted_by_audit(evaluation)) << "S15 is critical, whatever the result is compared with";
    }
}

TEST(FixtureBudgetAudit, ScalesNothingThatIsNoInput) {
    gum::Budget budget;
    gum::BudgetInput input;
    input.name = "a";
    input.unit = gum::Unit::parse("m");
    input.components = {gum::state_uncertainty(1.0, 0.2)};
    budget.inputs = {input};
    budget.points = {{.name = "1", .inputs = {}}, {.name = "2", .inputs = {}}};
    audit::AuditedBudget rows;
    rows.rows.resize(1);
    rows.rows[0].input = "a";
    const std::optional<gum::Budget> scaled = with_scaled_uncertainties(budget, {rows, rows}, {{1.0}, {0.5}});
    ASSERT_TRUE(scaled);
    EXPECT_TRUE(scaled->points[0].inputs.empty());
    ASSERT_EQ(scaled->points[1].inputs.size(), 1U);
    EXPECT_DOUBLE_EQ(scaled->points[1].inputs[0].second.components[0].u, 0.1);
    rows.rows[0].input = "slope";
    EXPECT_TRUE(with_scaled_uncertainties(budget, {rows, rows}, {{1.0}, {1.0}}));
    EXPECT_FALSE(with_scaled_uncertainties(budget, {rows, rows}, {{1.0}, {0.5}}));
}

}  // namespace
}  // namespace gumcert::evaluation
