#include "reports/record/make/reported_choice.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/support/sample_record.h"

namespace gumcert::reports {
namespace {

using gum::CoverageChoice;
using reports::EvaluationRecord;
using reports::MonteCarloSummary;

/// The sample, whose trials confirm the law of propagation for the quantity that a test looks at, changed.
EvaluationRecord record_with(const std::function<void(MonteCarloSummary&)>& change) {
    EvaluationRecord record = test::sample_record();
    change(*record.rotary->errors[2].errors[1].monte_carlo);
    return record;
}

const reports::StatedValue& changed(const EvaluationRecord& record) {
    return record.rotary->errors[2].errors[1];
}

/// Trials about 7 ± 2, far from the law of propagation.
void refute(MonteCarloSummary& trials) {
    trials.mean.number = 7.0;
    trials.u.number = 1.0;
    trials.symmetric.number = {5.0, 9.0};
    trials.validation->precise_enough = true;
    trials.validation->validated = false;
}

TEST(ReportedChoice, AreThoseOfTheLawOfPropagationWhereTrialsConfirmIt) {
    EvaluationRecord record = test::sample_record();
    const std::string before = changed(record).printed.U;
    report_rotary_results(record, CoverageChoice::as_validated);
    EXPECT_FALSE(changed(record).reported);
    EXPECT_EQ(changed(record).printed.U, before);
}

TEST(ReportedChoice, AreThoseOfMonteCarloWhereItRefutesTheLaw) {
    EvaluationRecord record = record_with(refute);
    const double law = changed(record).value;
    report_rotary_results(record, CoverageChoice::as_validated);
    ASSERT_TRUE(changed(record).reported);
    EXPECT_EQ(changed(record).reported->method, "monte_carlo");
    EXPECT_EQ(changed(record).reported->because, "contradicted");
    EXPECT_EQ(changed(record).printed.value, "7.0");
    EXPECT_EQ(changed(record).printed.U, "2.0");
    EXPECT_EQ(changed(record).reported->k, 2.0);
    EXPECT_EQ(changed(record).value, law) << "the number of the law stays beside it";
}

TEST(ReportedChoice, AreAnIntervalWhereThatIsNotSymmetric) {
    EvaluationRecord record = record_with([](MonteCarloSummary& trials) {
        refute(trials);
        trials.symmetric.number = {6.0, 9.0};
    });
    report_rotary_results(record, CoverageChoice::as_validated);
    EXPECT_EQ(changed(record).printed.U, "");
    EXPECT_EQ(changed(record).reported->printed_low, "6.0");
    EXPECT_EQ(changed(record).reported->printed_high, "9.0");
}

TEST(ReportedChoice, TooFewTrialsRefuteNothing) {
    EvaluationRecord record = record_with([](MonteCarloSummary& trials) {
        refute(trials);
        trials.validation->precise_enough = false;
    });
    report_rotary_results(record, CoverageChoice::as_validated);
    EXPECT_FALSE(changed(record).reported);
}

TEST(ReportedChoice, OfTheLawSayWhatSpeaksAgainstIt) {
    EvaluationRecord record = record_with(refute);
    const std::string before = changed(record).printed.U;
    report_rotary_results(record, CoverageChoice::law_of_propagation);
    ASSERT_TRUE(changed(record).reported);
    EXPECT_EQ(changed(record).reported->method, "law_of_propagation");
    EXPECT_EQ(changed(record).reported->against, "contradicted");
    EXPECT_EQ(changed(record).printed.U, before);
}

TEST(ReportedChoice, AreAllThoseOfMonteCarloWhereTheJobAsksForIt) {
    EvaluationRecord record = test::sample_record();
    report_rotary_results(record, CoverageChoice::monte_carlo);
    for (const reports::ErrorsAtAngle& at : record.rotary->errors) {
        for (const reports::StatedValue& error : at.errors) {
            ASSERT_EQ(error.reported.has_value(), error.monte_carlo.has_value());
            if (error.reported) {
                EXPECT_EQ(error.reported->because, "asked");
                EXPECT_EQ(error.printed.value, error.reported->printed.value);
            }
        }
    }
    for (const reports::Result& result : record.results) {
        EXPECT_EQ(result.reported.method == "monte_carlo", result.monte_carlo.has_value()) << result.name;
    }
}

}  // namespace
}  // namespace gumcert::reports
