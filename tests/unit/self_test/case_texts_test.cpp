#include "self_test/case_texts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace gumcert::self_test {
namespace {

using testing::HasSubstr;

/// Two values of a case, the second of which disagrees.
CaseOutcome outcome_of_two_values() {
    ExpectedValue u;
    u.quantity = "l";
    u.kind = "u";
    u.text = "32";
    u.wanted = 32.0;
    u.found = {"results.l.u"};
    ExpectedValue U = u;
    U.kind = "U";
    U.text = "93";
    U.wanted = 93.0;
    U.is_printed = false;
    U.found = {"results.l.U"};
    ExpectedValue nu = u;
    nu.kind = "nu_eff";
    nu.found = {};
    nu.not_compared = "the source rounds\nit before";
    CaseOutcome outcome;
    outcome.reference.id = "gum-h1-end-gauge";
    outcome.reference.document = "JCGM 100:2008";
    outcome.reference.place = "H.1";
    outcome.reference.expected = {u, U, nu};
    outcome.values = {{.expected = u, .computed = 31.71, .was_found = true, .digits_reached = 2, .agrees = true},
                      {.expected = U,
                       .computed = 95.0,
                       .was_found = true,
                       .digits_reached = 1,
                       .agrees = false,
                       .because = "95, not 93"}};
    return outcome;
}

TEST(CaseTexts, HaveALineForACase) {
    CaseOutcome outcome = outcome_of_two_values();
    EXPECT_EQ(case_line(outcome), "FAIL  gum-h1-end-gauge  JCGM 100:2008, H.1  1 of 2 values");
    outcome.values[1].agrees = true;
    outcome.reference.place = "";
    outcome.reference.is_place_seen = false;
    EXPECT_EQ(case_line(outcome), "pass  gum-h1-end-gauge  JCGM 100:2008 (not looked up)  2 of 2 values");
}

TEST(CaseTexts, HaveALineForEachValueAndForWhatIsNotCompared) {
    const CaseOutcome outcome = outcome_of_two_values();
    const std::string lines = value_lines(outcome);
    EXPECT_THAT(lines, HasSubstr("      pass  " + outcome.values[0].expected.name() +
                                 ": 31.71, printed 32, 2 of 2 digits  (results.l.u)\n"));
    EXPECT_THAT(lines, HasSubstr("      FAIL  " + outcome.values[1].expected.name() +
                                 ": 95, expected 93, 1 of 2 digits  (results.l.U)\n"));
    EXPECT_THAT(lines,
                HasSubstr("      not compared  " + outcome.reference.expected[2].name() + ": the source rounds"));
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 3) << "no text of a case brings a line of its own";
}

TEST(CaseTexts, TellOfACaseThatFailsTheFirstValueThatDisagrees) {
    CaseOutcome outcome = outcome_of_two_values();
    gum::Diagnostic why = failure_of(outcome);
    EXPECT_EQ(why.code, "GC-SELF-0003");
    EXPECT_EQ(why.where, "gum-h1-end-gauge");
    EXPECT_EQ(why.what, outcome.values[1].expected.name() + ": 95, not 93");
    EXPECT_EQ(why.severity, gum::Severity::error);
    outcome.values.push_back(outcome.values[1]);
    EXPECT_THAT(failure_of(outcome).what, testing::EndsWith("; and 1 more value"));
    outcome.values.clear();
    outcome.refused = "its job is refused";
    EXPECT_EQ(failure_of(outcome).what, "its job is refused");
}

}  // namespace
}  // namespace gumcert::self_test
