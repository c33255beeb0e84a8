#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "certificate/statement_of_uncertainty.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

constexpr const char* k_policy = "ILAC-P14:09/2020";

CertifiedValue& length(Certificate& c) {
    return c.tables[0].columns[0].values[0];
}

TEST(UncertaintyGate, HasNothingToSayOfAGoodStatement) {
    EXPECT_THAT(ids(uncertainty_findings(passed_certificate())), testing::IsEmpty());
}

TEST(UncertaintyGate, CountsTheDigitsOfU) {
    Certificate c = passed_certificate();
    length(c).printed_value = "50000838.0";
    length(c).printed_U = "92.6";
    expect_finding(only(uncertainty_findings(c)), "R01", k_policy, FindingSeverity::major, "l");
    length(c).printed_value = "5.0001E+7";
    length(c).printed_U = "1.4E+3";  // ends at the hundreds, the value at the thousands
    expect_finding(only(uncertainty_findings(c)), "R02", k_policy, FindingSeverity::major, "l");
}

TEST(UncertaintyGate, HoldsTheProfileToOneDigit) {
    Certificate c = passed_certificate();
    c.profile.digits = 1;
    const Finding found = only(uncertainty_findings(c));
    expect_finding(found, "R01", k_policy, FindingSeverity::major, "l, EAA");
    EXPECT_TRUE(found.what.ends_with("; the numbers are those of \"l\"")) << found.what;
    for (CertifiedColumn& column : c.tables[0].columns) {
        column.values[0].raised = true;  // a capability keeps its two digits
    }
    EXPECT_THAT(ids(uncertainty_findings(c)), testing::IsEmpty());
}

TEST(UncertaintyGate, WantsTheCoverageFactor) {
    Certificate c = passed_certificate();
    length(c).printed_k.clear();
    expect_finding(only(uncertainty_findings(c)), "R04", k_policy, FindingSeverity::critical, "l");
    length(c).coverage = "monte_carlo";
    EXPECT_THAT(ids(uncertainty_findings(c)), testing::IsEmpty());
}

TEST(UncertaintyGate, FindsANegativeZero) {
    Certificate c = passed_certificate();
    c.tables[0].columns[1].values[0].printed_value = "-0.00";
    expect_finding(only(uncertainty_findings(c)), "R06", k_policy, FindingSeverity::minor, "EAA");
}

TEST(UncertaintyGate, FindsAVerdictThatThePrintedNumbersDoNotGive) {
    Certificate c = passed_certificate();
    length(c).verdict->verdict_from_printed = "fail";
    const Finding found = only(uncertainty_findings(c));
    expect_finding(found, "D04", "ISO/IEC 17025:2017, 7.8.6.1", FindingSeverity::critical, "l");
    EXPECT_THAT(found.what, testing::HasSubstr("\"pass\""));
}

TEST(UncertaintyGate, FindsARuleThatCannotBeApplied) {
    Certificate c = passed_certificate();
    length(c).verdict->verdict = length(c).verdict->verdict_from_printed = "not_applicable";
    length(c).verdict->note = "the ratio is 1.2";
    const Finding found = only(uncertainty_findings(c));
    expect_finding(found, "D05", "ISO/IEC 17025:2017, 7.8.6.1", FindingSeverity::major, "l");
    EXPECT_THAT(found.what, testing::HasSubstr("the ratio is 1.2"));
    EXPECT_THAT(found.action, testing::HasSubstr("another rule"));
    // A specification in mA of a voltage is a slip, and no rule mends it.
    length(c).verdict->note = "the specification has the unit \"mA\", and the result \"mV\"";
    EXPECT_EQ(only(uncertainty_findings(c)).action,
              "Correct the unit of the specification, or the results that it names.");
}

// Columns of one cause may have other units: 20 mV of 10 mV is worse than 1 V of 5 V, and 30 is more than 1.
TEST(UncertaintyGate, TellsTheWorstByWhatItIsToDecideOn) {
    Certificate c = passed_certificate();
    CertifiedTable& table = c.tables[0];
    table.columns.resize(1);
    table.columns.push_back(table.columns[0]);
    table.columns[1].result = "E";
    const auto put = [&](std::size_t column, double U, double tolerance, const std::string& unit) {
        CertifiedValue& v = table.columns[column].values[0];
        v.U = U;
        v.verdict->lower = -0.5 * tolerance;
        v.verdict->upper = 0.5 * tolerance;
        v.verdict->verdict = v.verdict->verdict_from_printed = "not_applicable";
        v.verdict->note = "U is " + std::to_string(U / tolerance) + " of the tolerance";
        table.columns[column].unit = unit;
    };
    put(0, 6.0, 5.0, "V");
    put(1, 1.5, 1.0, "mV");
    EXPECT_THAT(only(uncertainty_findings(c)).what, testing::HasSubstr("those of \"E\", the worst of 2"));
    put(0, 0.006, 0.005, "kV");
    EXPECT_THAT(only(uncertainty_findings(c)).what, testing::HasSubstr("those of \"E\", the worst of 2"));
}

TEST(UncertaintyGate, SaysThatADefinedValueIsNotDecided) {
    Certificate c = passed_certificate();
    CertifiedValue& v = length(c);
    v.verdict->verdict = v.verdict->verdict_from_printed = "not_applicable";
    v.verdict->note = "the value is defined";
    v.U.reset();
    v.u = 0.0;
    EXPECT_EQ(only(uncertainty_findings(c)).severity, FindingSeverity::information);
    v.external = true;
    EXPECT_EQ(only(uncertainty_findings(c)).severity, FindingSeverity::major);
}

TEST(UncertaintyGate, TellsOfAPassThatIsMoreProbablyNone) {
    Certificate c = passed_certificate();
    length(c).verdict->rule = "DR-01";
    length(c).verdict->conformance_probability = 0.158;
    length(c).verdict->printed.conformance_probability = "15.8";
    const Finding found = only(uncertainty_findings(c));
    expect_finding(found, "D08", "ISO/IEC 17025:2017, 7.8.6.1", FindingSeverity::major, "l");
    EXPECT_THAT(found.what, testing::HasSubstr("15.8 %"));
    // On the limit itself, and where the other limit takes a little of it: both are printed as 50 %.
    for (const double even : {0.5, 0.4999, 0.4951}) {
        ASSERT_EQ(printed_probability(even), "50");
        length(c).verdict->conformance_probability = even;
        EXPECT_THAT(ids(uncertainty_findings(c)), testing::IsEmpty()) << even;
    }
    length(c).verdict->conformance_probability = 0.4949;
    ASSERT_EQ(printed_probability(0.4949), "49");
    EXPECT_THAT(ids(uncertainty_findings(c)), testing::ElementsAre("D08"));
    length(c).verdict->conformance_probability = 0.5;
    length(c).verdict->test_uncertainty_ratio = 0.9;
    expect_finding(only(uncertainty_findings(c)), "D08", "ISO/IEC 17025:2017, 7.8.6.1", FindingSeverity::major, "l");
    length(c).verdict->rule = "DR-03";
    EXPECT_THAT(ids(uncertainty_findings(c)), testing::IsEmpty());
}

/// No rule accepts what its verdict does not pass.
TEST(UncertaintyGate, NamesARuleThatAcceptsOnlyWhereItDoes) {
    for (const char* const rule : {"DR-01", "DR-02", "DR-03", "DR-07", "DR-12"}) {
        for (const char* const verdict : {"pass", "conditional_pass", "fail", "conditional_fail", "undetermined"}) {
            for (const double risk : {0.01, 0.06, 0.4}) {
                Certificate c = passed_certificate();
                Verdict& v = *length(c).verdict;
                v.rule = rule;
                v.verdict = v.verdict_from_printed = verdict;
                v.conformance_probability = 0.6;
                v.specific_risk = risk;
                v.test_uncertainty_ratio = 0.9;
                for (const Finding& finding : uncertainty_findings(c)) {
                    EXPECT_TRUE(finding.id != "D08" || std::string_view(verdict).ends_with("pass"))
                        << rule << " " << verdict << ": " << finding.what;
                }
            }
        }
    }
}

TEST(UncertaintyGate, NamesTheRow) {
    Certificate c = passed_certificate();
    CertifiedTable& table = c.tables[0];
    table.argument = CertifiedTable::Argument{
        .name = "angle", .unit = "deg", .printed_unit = "°", .values = {30.0}, .printed = {"30"}};
    length(c).printed_k.clear();
    EXPECT_EQ(only(uncertainty_findings(c)).where, "l, angle 30");
}

}  // namespace
}  // namespace gumcert::certificate
