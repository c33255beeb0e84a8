#include "certificate/gates/worded_verdicts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

/// The sample with two points of the length, one of which fails, and a column of words.
Certificate with_words(const LocalisedText& heading, const std::vector<std::string>& words) {
    Certificate c = passed_certificate();
    CertifiedTable& table = c.tables[0];
    table.argument = {.name = "point", .unit = "", .printed_unit = "", .values = {{}, {}}, .printed = {"a", "b"}};
    table.columns.pop_back();
    table.columns[0].values.push_back(c.tables[0].columns[0].values[0]);
    CertifiedValue& second = table.columns[0].values[1];
    second.verdict->verdict = second.verdict->verdict_from_printed = "fail";
    table.layout.emplace();
    table.layout->columns = {{.name = "own",
                              .heading = heading,
                              .role = "",
                              .stage = "",
                              .unit = "",
                              .printed_unit = "",
                              .values = {{}, {}},
                              .printed = words}};
    return c;
}

// No word on a certificate may contradict what its rule has decided.
TEST(WordedVerdicts, AreHeldAgainstTheRule) {
    const auto told = [](const LocalisedText& heading, const std::vector<std::string>& words) {
        std::string all;
        for (const Finding& one : uncertainty_findings(with_words(heading, words))) {
            all +=
                one.id == "D12" ? (one.severity == FindingSeverity::critical ? "critical " : "major ") + one.what : "";
        }
        return all;
    };
    const LocalisedText verdict = test::in_two_languages("Old remark", "Aussage");
    for (const auto& [right, wrong] : std::vector<std::pair<std::string, std::string>>{{"pass", "fail"},
                                                                                       {"Bestanden", "nicht bestanden"},
                                                                                       {"i. O.", "n.i.O."},
                                                                                       {"合格", "不合格"},
                                                                                       {"OK", "NOK"}}) {
        EXPECT_EQ(told(verdict, {right, wrong}), "") << right;
        EXPECT_THAT(told(verdict, {right, right}),
                    testing::AllOf(testing::StartsWith("critical "), testing::EndsWith("point \"b\"")));
        EXPECT_THAT(told(verdict, {wrong, wrong}), testing::EndsWith("point \"a\"")) << right;
        EXPECT_EQ(told("Alarm", {wrong, right}), "") << "a test of functions is no statement of conformity";
        EXPECT_EQ(told("Old verdict", {wrong, right}), "") << "that of an earlier certificate";
    }
    EXPECT_EQ(told("Verdict", {"see remark 2", ""}), "");
    Certificate adjusted = with_words("Verdict", {"fail", ""});
    TableLayout& layout = *adjusted.tables[0].layout;
    layout.columns[0].stage = "as_found";
    layout.shown = {{.show = "value", .of = "l", .heading = {}, .role = "", .stage = "as_left"}};
    EXPECT_EQ(only(uncertainty_findings(adjusted)).severity, FindingSeverity::major)
        << "the rule has decided of another stage";
    layout.shown[0].stage = "as_found";
    EXPECT_EQ(only(uncertainty_findings(adjusted)).severity, FindingSeverity::critical);
    Certificate undecided = with_words("Verdict", {"pass", ""});
    undecided.tables[0].columns[0].values[0].verdict.reset();
    expect_finding(only(uncertainty_findings(undecided)), "D12", "ISO/IEC 17025:2017, 7.8.6.2", FindingSeverity::major,
                   "own");
}

}  // namespace
}  // namespace gumcert::certificate
