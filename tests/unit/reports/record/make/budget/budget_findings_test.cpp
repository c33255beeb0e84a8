#include "reports/record/make/budget/budget_findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "gum/budget/budget_covariance.h"
#include "gum/budget/evaluate_budget.h"
#include "reports/record/make/budget/budget_record.h"
#include "tests/support/budget_campaign.h"
#include "tests/support/sample_certificate.h"

namespace gumcert::reports {
namespace {

using certificate::FindingSeverity;
using testing::HasSubstr;

reports::EvaluationRecord record_of(const std::string& keys) {
    const jobs::BudgetJob job = jobs::test::read_budget(keys);
    const gum::BudgetResult result = gum::evaluate_budget(job, 1);
    return budget_record(job, result, {}, gum::budget_covariance(result), "");
}

std::string line(const std::string& more) {
    return R"("fits": {"f": {"equation": "y = a + b*x", "parameters": {"a": {"unit": "mV"}, "b": {"unit": "mV"}},
        "units": {"y": "mV"}, "data": {"x": [0, 1, 2, 3, 4], "y": [0, 1.1, 1.9, 3.2, 3.9], )" +
           more + "}}";
}

/// Findings of a record whose certificate has a status, "id severity; …".
std::string findings(reports::EvaluationRecord record, const std::string& status) {
    record.certificate.emplace();
    record.certificate->data.status = status;
    std::string list;
    for (const certificate::Finding& finding : budget_findings(record)) {
        const char* severity = finding.severity == FindingSeverity::critical ? "critical"
                               : finding.severity == FindingSeverity::major  ? "major"
                               : finding.severity == FindingSeverity::minor  ? "minor"
                                                                             : "information";
        list += (list.empty() ? "" : "; ") + finding.id + " " + severity;
        EXPECT_FALSE(finding.where.empty() || finding.what.empty() || finding.action.empty() || finding.clause.empty());
    }
    return list;
}

TEST(BudgetFindings, ARefutedFitBlocksAnAccreditedCertificate) {
    const reports::EvaluationRecord record = record_of(line(R"("u_y": 0.001})"));
    EXPECT_EQ(findings(record, "accredited"), "F01 critical");
    EXPECT_EQ(findings(record, "not_accredited"), "F01 major");
    EXPECT_EQ(findings(record, "specimen"), "F01 major");
    const gum::Diagnostic message = budget_remarks(record).at(0);
    EXPECT_EQ(message.code, "GC-BUDGET-0032");
    EXPECT_EQ(message.severity, gum::Severity::warning);
    EXPECT_EQ(message.where, "fit f");
    EXPECT_THAT(message.action, HasSubstr("\"scale_by_residuals\": true"));
    EXPECT_THAT(message.action, HasSubstr("u(a) = 0.12 mV in place of 0.00077"));
}

/// What the message promises is what the keyword gives.
TEST(BudgetFindings, TheRemedyOfARefutedFitIsTrue) {
    const reports::EvaluationRecord scaled = record_of(line(R"("u_y": 0.001}, "scale_by_residuals": true)"));
    EXPECT_EQ(findings(scaled, "accredited"), "");
    EXPECT_EQ(scaled.fits.at(0).parameters.at(0).u.text, "0.12");
}

TEST(BudgetFindings, UncertaintiesThatAreFarTooLargeAreANote) {
    const reports::EvaluationRecord record = record_of(line(R"("u_y": 100})"));
    EXPECT_EQ(findings(record, "accredited"), "F02 information");
    EXPECT_EQ(budget_remarks(record).at(0).severity, gum::Severity::note);
    EXPECT_EQ(findings(record_of(line(R"("u_y": 0.15})")), "accredited"), "");
}

TEST(BudgetFindings, OutliersAndDriftAreOneMessageAnInput) {
    const std::string drift = R"({"observations": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]})";
    const std::string slip = R"({"observations": [5.00, 5.01, 4.99, 5.00, 49.99, 5.01, 4.99]})";
    const reports::EvaluationRecord record =
        record_of(R"("model": ["z = x + y"], "inputs": {"x": {"unit": "mV"}, "y": {"unit": "mV"}}, "points": [
            {"point": "A", "x": )" +
                  drift + R"(, "y": )" + slip + R"(}, {"point": "B", "x": )" + drift + R"(, "y": )" + slip + "}]");
    EXPECT_EQ(findings(record, "accredited"), "A02 minor; A01 major");
    const auto messages = budget_remarks(record);
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_EQ(messages[0].where, "readings of x at points A, B");
    EXPECT_EQ(messages[1].where, "readings of y at points A, B");
    EXPECT_THAT(messages[1].what, HasSubstr("reading 5 at point A, 49.99 mV, is an outlier among 7 readings"));
}

TEST(BudgetFindings, TemperaturesAndLostDigitsOfTheRecordAreFindings) {
    const reports::EvaluationRecord hot = record_of(R"("model": ["y = p/t"], "inputs": {
        "p": {"value": 1, "u": 0.1}, "t": {"value": 20, "u": 0.1, "unit": "degC"}})");
    EXPECT_EQ(findings(hot, "accredited"), "M01 major");
    const reports::EvaluationRecord lost = record_of(R"("model": ["y = x - f"], "inputs": {
        "x": {"value": 1000000000, "u": 1e-9}, "f": {"value": 999999999.9, "constant": true}})");
    EXPECT_EQ(findings(lost, "accredited"), "M02 critical");
    // As the message advises.
    const reports::EvaluationRecord held = record_of(R"("model": ["y = (x - f_0) - f"], "inputs": {
        "x": {"value": 1000000000, "u": 1e-9}, "f_0": {"value": 1000000000, "constant": true},
        "f": {"value": -0.1, "constant": true}})");
    EXPECT_EQ(findings(held, "accredited"), "");
    EXPECT_EQ(held.results.at(0).value, 0.1);
    // The parts added up before: the digits are lost on the way.
    const reports::EvaluationRecord added = record_of(R"j("model": ["y = x - (f_0 + f)"], "inputs": {
        "x": {"value": 1000000000, "u": 1e-9}, "f_0": {"value": 1000000000, "constant": true},
        "f": {"value": -0.1, "constant": true}})j");
    EXPECT_EQ(findings(added, "accredited"), "M02 critical");
    // Whole numbers of 15 digits, as of optical frequencies, are held.
    const reports::EvaluationRecord optical = record_of(R"("model": ["y = x - f"], "inputs": {
        "x": {"value": 429228004229873, "u": 0.1}, "f": {"value": 429228004229000, "constant": true}})");
    EXPECT_EQ(findings(optical, "accredited"), "");
    EXPECT_EQ(optical.results.at(0).value, 873.0);
}

std::string readings_of_pool(const std::vector<std::string>& sets, const std::string& s) {
    std::string points;
    for (std::size_t i = 0; i < sets.size(); ++i) {
        points += (i == 0 ? "" : ", ") + std::string(R"({"point": "P)") + std::to_string(i + 1) +
                  R"(", "x": {"observations": [)" + sets[i] + R"(], "pooled": {"s": )" + s + R"(, "nu": 20}}})";
    }
    return R"("model": ["y = x"], "inputs": {"x": {"unit": "mV"}}, "points": [)" + points + "]";
}

TEST(BudgetFindings, ReadingsThatRefuteTheirPoolBlockAnAccreditedCertificate) {
    const std::string scattered = R"j("model": ["y = x"], "inputs": {"x": {"unit": "mV",
        "observations": [5.0, 5.9, 4.2, 5.4, 4.6], "pooled": {"s": 0.1, "nu": 20}}})j";
    const reports::EvaluationRecord record = record_of(scattered);
    EXPECT_EQ(findings(record, "accredited"), "A03 critical");
    EXPECT_EQ(findings(record, "not_accredited"), "A03 major");
    const gum::Diagnostic message = budget_remarks(record).at(0);
    EXPECT_EQ(message.code, "GC-BUDGET-0037");
    EXPECT_EQ(message.where, "readings of x");
    // s = 0.66483, F = 44.2 with 4 and 20 degrees of freedom.
    EXPECT_THAT(message.what, HasSubstr("scatter 6.6 times as much"));
    EXPECT_THAT(message.what, HasSubstr("F = 44.2 with 4 and 20 degrees of freedom, p-value < 0.0001"));
    // Infinite degrees of freedom are no obstacle; less scatter than the pool is none of our business.
    EXPECT_EQ(findings(record_of(R"("model": ["y = x"], "inputs": {"x": {
        "observations": [5.0, 5.9, 4.2], "pooled": {"s": 0.1, "nu": "inf"}}})"),
                       "accredited"),
              "A03 critical");
    EXPECT_EQ(findings(record_of(R"("model": ["y = x"], "inputs": {"x": {
        "observations": [5.0, 5.0, 5.0], "pooled": {"s": 0.1, "nu": 50}}})"),
                       "accredited"),
              "");
    // The cure: without `pooled` there is nothing to tell.
    EXPECT_EQ(findings(record_of(R"("model": ["y = x"], "inputs": {"x": {"observations": [5.0, 5.9, 4.2, 5.4, 4.6]}})"),
                       "accredited"),
              "");
}

TEST(BudgetFindings, StepsOfADisplayDoNotRefuteAPool) {
    EXPECT_EQ(findings(record_of(R"("model": ["y = x"], "inputs": {"x": {"components": [
        {"name": "readings", "observations": [5.0, 5.1], "pooled": {"s": 0.01, "nu": 20}},
        {"name": "display", "value": 0, "resolution": 0.1}]}})"),
                       "accredited"),
              "");
    EXPECT_EQ(findings(record_of(R"("model": ["y = x"], "inputs": {"x": {"components": [
        {"name": "readings", "observations": [5.0, 5.2], "pooled": {"s": 0.01, "nu": 20}},
        {"name": "display", "value": 0, "resolution": 0.1}]}})"),
                       "accredited"),
              "A03 critical");
}

TEST(BudgetFindings, APoolIsHeldAgainstAllPointsTogether) {
    // Each F of 6.1 with 1 degree of freedom is nothing by itself.
    const std::vector<std::string> each(12, "5.0, 5.35");
    const auto together = budget_remarks(record_of(readings_of_pool(each, "0.1")));
    ASSERT_EQ(together.size(), 1U);
    EXPECT_THAT(together[0].where, HasSubstr("readings of x at points P1, P2"));
    EXPECT_EQ(findings(record_of(readings_of_pool({"5.0, 5.3", "5.0, 5.1"}, "0.1")), "accredited"), "");
    const auto one = budget_remarks(record_of(readings_of_pool({"5.0, 5.1", "5.0, 7.0", "5.0, 5.05"}, "0.1")));
    ASSERT_EQ(one.size(), 1U);
    EXPECT_THAT(one[0].where, HasSubstr("P2"));
}

/// Readings that do belong to the pool are told less than once in a thousand times.
TEST(BudgetFindings, AGoodPoolIsLeftAlone) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    int told = 0;
    for (int job = 0; job < 300; ++job) {
        std::vector<std::string> sets;
        for (int i = 0; i < 4; ++i) {
            sets.push_back(std::to_string(0.1 * normal(random)) + ", " + std::to_string(0.1 * normal(random)) + ", " +
                           std::to_string(0.1 * normal(random)));
        }
        for (const gum::Diagnostic& message : budget_remarks(record_of(readings_of_pool(sets, "0.1")))) {
            told += message.code == "GC-BUDGET-0037" ? 1 : 0;
        }
    }
    EXPECT_LE(told, 3);
}

TEST(BudgetFindings, DataOfFitsWhoseDigitsAreLostAreFindings) {
    const auto fit = [](const std::string& y, const std::string& more) {
        return R"("fits": {"f": {"equation": "y = a + b*x", "parameters": {"a": {}, "b": {}},
            "data": {"x": [0, 1, 2, 3, 4], "y": )" +
               y + more + "}}}";
    };
    const std::string large = "[1000000000.1, 1000000001.3, 1000000001.9, 1000000003.2, 1000000004.1]";
    const std::string tiny = "[1000000000.1, 1000000001.1, 1000000002.1, 1000000003.1, 1000000004.1000003]";
    EXPECT_THAT(findings(record_of(fit(large, R"(, "u_y": 1e-7)")), "accredited"), HasSubstr("M02 critical"));
    EXPECT_EQ(findings(record_of(fit(large, R"(, "u_y": 0.3)")), "accredited"), "");
    EXPECT_EQ(findings(record_of(fit(large, "")), "accredited"), "");
    // Residuals of a rounding or two are no scatter: no uncertainty is made of them that digits could be held against.
    EXPECT_EQ(findings(record_of(fit(tiny, "")), "accredited"), "F03 critical");
    // As the message advises: the whole number is subtracted from the data.
    EXPECT_EQ(findings(record_of(fit("[0.1, 1.1, 2.1, 3.1, 4.1000003]", "")), "accredited"), "");
}

/// Exact results have the digits that double precision holds, and no others.
TEST(BudgetFindings, ExactResultsHaveTheDigitsThatAreHeld) {
    const auto exact = [](const std::string& model, const std::string& a, const std::string& b) {
        return record_of(R"("model": ["y = )" + model + R"("], "inputs": {"a": {"value": )" + a +
                         R"(, "constant": true}, "b": {"value": )" + b + R"(, "constant": true}})");
    };
    const auto printed = [&](const std::string& model, const std::string& a, const std::string& b) {
        return exact(model, a, b).results.at(0).reported.printed.value;
    };
    EXPECT_EQ(printed("a + b", "0.1", "0.2"), "0.3");
    EXPECT_EQ(printed("a - b", "1000000000.1", "1000000000"), "0.1");
    EXPECT_EQ(printed("a*a*b", "0.1", "3"), "0.03");
    EXPECT_EQ(printed("a*b", "3", "7"), "21");
    EXPECT_EQ(printed("a/b", "1", "3"), "0.333333333333333");
    EXPECT_EQ(printed("a - b", "0.30001", "0.3"), "1e-05");
    EXPECT_EQ(findings(exact("a - b", "1000000000.1", "1000000000"), "accredited"), "");
    EXPECT_EQ(findings(exact("(a + b) - a", "10000000000000000", "0.3"), "accredited"), "M02 critical");
    // A thousand sums of decimals, as a person adds them.
    std::mt19937 random(3);
    for (int i = 0; i < 1000; ++i) {
        const int a = static_cast<int>(random() % 100000);
        const int b = static_cast<int>(random() % 100000);
        const double sum = (a + b) / 1000.0;
        const auto text = [](int thousandths) { return std::to_string(thousandths / 1000.0); };
        EXPECT_EQ(exact("a + b", text(a), text(b)).results.at(0).value, sum) << a << " " << b;
    }
}

// GC-BUDGET-0044
TEST(BudgetFindings, TellsWhatTrialsChooseOtherwise) {
    const auto amount = [](const std::string& value) {
        return record_of(R"_("model": ["y = abs(a)"], "monte_carlo": {"trials": 20000}, "inputs": {"a": {"value": )_" +
                         value + R"_(, "u": 1, "unit": "mm"}})_");
    };
    EXPECT_EQ(findings(amount("0.5"), "accredited"), "S18 major");
    EXPECT_EQ(findings(amount("0.5"), "not_accredited"), "S18 major");
    EXPECT_EQ(findings(amount("9"), "accredited"), "");
    // GC-BUDGET-0045
    EXPECT_EQ(findings(record_of(R"_("model": ["y = hypot(a, b)"], "monte_carlo": {"trials": 20000}, "inputs": {
                  "a": {"value": 0.02, "u": 1, "unit": "mm"}, "b": {"value": 0, "u": 1, "unit": "mm"}})_"),
                       "accredited"),
              "S18 major");
}
}  // namespace
}  // namespace gumcert::reports
