#include "reports/summary/record_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_comparison_record.h"
#include "tests/support/sample_record.h"

namespace gumcert::reports {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Result length_of(const std::string& name) {
    Result result;
    result.name = name;
    result.reported.printed = {.value = "50000203", .U = "57", .unit = "nm"};
    result.reported.k = 2.0;
    result.reported.coverage_probability = 0.9545;
    return result;
}

EvaluationRecord record_of(const std::vector<Result>& results) {
    EvaluationRecord record;
    record.kind = "budget";
    record.results = results;
    return record;
}

TEST(RecordSummary, HasAResultWithItsUncertaintyOnALine) {
    EvaluationRecord record = record_of({length_of("l")});
    EXPECT_EQ(summary_text(record), "  l = 50000203 ± 57 nm   (k = 2.00, p = 95.45 %)\n");
    record.title = "End gauge";
    EXPECT_THAT(summary_text(record), StartsWith("End gauge\n\n  l = "));
}

TEST(RecordSummary, SaysIntervalOrNothingWhereNoUncertaintyHolds) {
    Result interval = length_of("l");
    interval.reported.printed.U = "";
    interval.reported.k.reset();
    interval.reported.method = "monte_carlo";
    interval.reported.printed_low = "1";
    interval.reported.printed_high = "3";
    EXPECT_EQ(summary_text(record_of({interval})),
              "  l = 50000203 nm, no u exists, interval 1 to 3 nm   (p = 95.45 %, Monte Carlo)\n");
    interval.reported.printed_u = "0.5";
    EXPECT_THAT(summary_text(record_of({interval})), HasSubstr(", u = 0.5 nm, interval"));
    interval.reported.printed_low = "";
    EXPECT_EQ(summary_text(record_of({interval})), "  l = 50000203 nm   no expanded uncertainty can be stated\n");
}

TEST(RecordSummary, SaysWhetherTrialsConfirmTheLawOfPropagation) {
    Result result = length_of("l");
    result.monte_carlo = test::trials_of(10.0, 1.0);
    EXPECT_THAT(summary_text(record_of({result})),
                HasSubstr("      Monte Carlo, 100000 trials: u = 1.000, interval 8.00 to 12.00; law of propagation "
                          "validated\n"));
    result.monte_carlo = test::trials_of(10.0, 1.0, false);
    EXPECT_THAT(summary_text(record_of({result})), HasSubstr("; law of propagation NOT validated\n"));
    result.monte_carlo = test::trials_of(10.0, 1.0, true, false);
    EXPECT_THAT(summary_text(record_of({result})), HasSubstr("; too few trials to validate\n"));
}

TEST(RecordSummary, NamesTheFirstOfManyResults) {
    const std::string text = summary_text(record_of(std::vector<Result>(33, length_of("l"))));
    EXPECT_THAT(text, HasSubstr("  … and 3 more, all of them in the record\n"));
    EXPECT_THAT(summary_text(record_of(std::vector<Result>(30, length_of("l")))), Not(HasSubstr("more")));
}

/// Three results of one item, the first of which gives a signal, and the last of which nobody can judge.
EvaluationRecord comparison() {
    EvaluationRecord record = test::comparison_frame("", "{}");
    record.comparison.emplace();
    record.comparison->form = "laboratories";
    ComparisonItemEvaluation item;
    item.id = "block";
    item.round = "2";
    item.unit = "mm";
    item.difference_unit = "mm";
    item.method = "dersimonian_laird";
    item.value.text = "10.05";
    item.U.text = "0.12";
    item.k.text = "2.00";
    item.score = "z_prime";
    item.missing = {"D"};
    record.comparison->items = {item};
    for (const char* const id : {"A", "B", "C"}) {
        ComparisonPoint point;
        point.participant = id;
        point.item = "block";
        point.round = "2";
        point.value.text = "10.31";
        point.D.text = "0.26";
        point.z_prime.text = "3.25";
        point.signal = "none";
        record.comparison->points.push_back(point);
    }
    record.comparison->points[0].signal = "action";
    record.comparison->points[0].signal_by = {"D", "En_audited"};
    record.comparison->points[2].signal = "inconclusive";
    return record;
}

TEST(RecordSummary, HasAssignedValueAndScoresOfAComparison) {
    const std::string text = summary_text(comparison());
    EXPECT_THAT(text,
                StartsWith("\nblock, round 2\n  assigned value (DerSimonian-Laird) 10.05 ± 0.12 mm   (k = 2.00, p = "
                           "95.45 %)\n  without a result: D\n"));
    EXPECT_THAT(text,
                HasSubstr("  A            10.31 mm                   D       0.26   z'   3.25   action (P_A %, En with "
                          "findings corrected)\n"));
    EXPECT_THAT(text, HasSubstr("  B            10.31 mm                   D       0.26   z'   3.25\n"));
    EXPECT_THAT(text, HasSubstr("\n3 results: 1 with an action signal, 0 with a warning signal\n1 cannot be judged: "));
}

TEST(RecordSummary, SaysOfAComparisonOfMethodsWhatItProves) {
    EvaluationRecord record = test::comparison_frame("", "{}");
    record.comparison.emplace();
    record.comparison->form = "methods";
    record.comparison->method_name = "interferometer";
    record.comparison->reference_name = "comparator";
    ComparisonSummary row;
    row.direction = "all";
    row.points = 12;
    row.count_above_1 = 1;
    row.mean_abs_En.text = "0.41";
    row.max_abs_En.text = "1.10";
    row.verdict = "agreement_few_points";
    record.comparison->summary = {row};
    EXPECT_EQ(summary_text(record),
              "\ninterferometer with comparator:\n  all     mean |En| 0.41   max |En| 1.10   above 1: 1 of 12\n"
              "          agreement; too few points to tell whether the uncertainties are right\n");
    record.comparison->summary[0].power_lacks_degrees = true;
    EXPECT_THAT(summary_text(record), HasSubstr("too few degrees of freedom to tell"));
}

TEST(RecordSummary, HasRangesAndAdjustmentOfARotaryTable) {
    EvaluationRecord record = test::sample_record();
    const std::string text = summary_text(record);
    EXPECT_THAT(text, HasSubstr("Set-up of the fixture (value ± U, p = " + record.coverage_probability.text + "):\n"));
    EXPECT_THAT(
        text, HasSubstr("\nAdjustment: " + std::to_string(record.rotary->adjustment.observations) + " observations, "));
    EXPECT_THAT(text, Not(HasSubstr("no expanded uncertainty"))) << "its results are those of the set-up";
}

}  // namespace
}  // namespace gumcert::reports
