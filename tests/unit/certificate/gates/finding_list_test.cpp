#include "certificate/gates/finding_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

TEST(FindingList, KeepsWhatAGateFindsInItsOrder) {
    const CertificateData data;
    FindingList list(data);
    list.critical("X01", "7.1", "/number", "is missing", "State it.");
    list.major("X02", "7.2", "/item", "is none", "Mend it.");
    list.add(FindingSeverity::minor, "X03", "7.3", "", "a", "b");
    Finding other;
    other.id = "X04";
    list.append({other});
    const std::vector<Finding> found = list.take();
    EXPECT_EQ(ids(found), (std::vector<std::string>{"X01", "X02", "X03", "X04"}));
    expect_finding(found[0], "X01", "7.1", k_critical, "/number");
    EXPECT_EQ(found[0].what, "is missing");
    EXPECT_EQ(found[0].action, "State it.");
    expect_finding(found[1], "X02", "7.2", k_major, "/item");
    EXPECT_TRUE(list.take().empty()) << "taken once";
}

TEST(FindingList, ItemIsLeftOutForAStatedReason) {
    CertificateData data;
    data.omissions = {{.clause = "7.8.2.1 h", .reason = "The item stays installed."},
                      {.clause = "7.8.2.1 e", .reason = "The owner wishes not to be named on paper."},
                      {.clause = "7.8.2.1 n", .reason = "-"},
                      {.clause = "7.8.2.1 f", .reason = "The customer asked for it in writing."}};
    FindingList list(data);
    for (const char letter : {'h', 'e', 'n', 'f'}) {
        list.item(k_critical, letter, "/place", "is missing", "State it.");
    }
    const std::vector<Finding> found = list.take();
    ASSERT_EQ(found.size(), 4U);
    expect_finding(found[0], "R07-h", "ISO/IEC 17025:2017, 7.8.2.1 h", FindingSeverity::information, "/place");
    EXPECT_EQ(found[0].what, "is missing; left out for the reason: The item stays installed.");
    EXPECT_EQ(found[0].action, "");
    EXPECT_EQ(found[1].severity, k_major) << "the customer is still not named";
    EXPECT_EQ(found[1].action, "State it, unless the reason is one that an assessor accepts.");
    EXPECT_EQ(found[2].severity, k_critical) << "a dash is no reason";
    EXPECT_EQ(found[2].what, "is missing");
    EXPECT_EQ(found[3].severity, k_critical) << "no reason replaces the method";
}

TEST(FindingList, TellsItemsThatMayBeLeftOut) {
    std::string may;
    for (char letter = 'a'; letter <= 'z'; ++letter) {
        may += may_be_left_out(std::string("7.8.2.1 ") + letter) ? std::string(1, letter) : "";
    }
    EXPECT_EQ(may, "cehknp");
    for (const char* clause : {"", "7.8.2.1", "7.8.2.1 ", "7.8.4.1 c", "7.8.2.1 cc", "c"}) {
        EXPECT_FALSE(may_be_left_out(clause)) << clause;
    }
    EXPECT_EQ(severity_of_omission("7.8.2.1 p"), k_major);
    EXPECT_EQ(severity_of_omission("7.8.2.1 c"), FindingSeverity::minor);
    EXPECT_EQ(severity_of_omission("7.8.2.1 k"), FindingSeverity::information);
    EXPECT_EQ(severity_of_omission(""), FindingSeverity::information);
}

TEST(FindingList, PlacesAndClausesInText) {
    EXPECT_EQ(iso_17025("7.8.2.1 e"), "ISO/IEC 17025:2017, 7.8.2.1 e");
    EXPECT_EQ(place_in("/standards", 3, "valid_to"), "/standards/3/valid_to");
    EXPECT_EQ(place_in("/remarks", 0), "/remarks/0");
    Dates dates;
    dates.performed_from = "2026-11-02";
    EXPECT_EQ(last_day(dates), "2026-11-02") << "one day of work";
    dates.performed_to = "2026-11-03";
    EXPECT_EQ(last_day(dates), "2026-11-03");
}

TEST(FindingList, KnowsTheResultsOfTheCertificate) {
    const Certificate certificate = passed_certificate();
    EXPECT_TRUE(names_a_result(certificate, {"x", "l"}));
    EXPECT_TRUE(names_a_result(certificate, {"E*"}));
    EXPECT_FALSE(names_a_result(certificate, {"x", "EBB"}));
    EXPECT_FALSE(names_a_result(certificate, {}));
    EXPECT_THAT(names_of_no_result(certificate, {"x", "l", "E*", "l[1]"}), testing::ElementsAre("x", "l[1]"));
    EXPECT_THAT(result_names(certificate, {"x"}), testing::ElementsAre("\"l\"", "\"EAA\""));
}

TEST(FindingList, NamesThePointsWhereAPointWasMeant) {
    Certificate certificate = passed_certificate();
    certificate.tables[0].argument =
        CertifiedTable::Argument{.name = "point", .unit = "", .printed_unit = "", .values = {{}}, .printed = {"pH 4"}};
    EXPECT_THAT(result_names(certificate, {"l[pH4]"}), testing::ElementsAre("\"l[pH 4]\"", "\"EAA\""));
    EXPECT_THAT(names_of_no_result(certificate, {"l[pH4]", "l[pH 4]"}), testing::ElementsAre("l[pH4]"));
}

TEST(FindingList, AddsTheGravestOfManyAndTheFirstOfEquals) {
    const Certificate certificate = passed_certificate();
    FindingList list(certificate.data);
    EXPECT_FALSE(list.add_gravest({}));
    const auto finding = [](const char* what, FindingSeverity severity) {
        Finding one;
        one.what = what;
        one.severity = severity;
        return one;
    };
    EXPECT_TRUE(list.add_gravest({finding("a", FindingSeverity::minor), finding("b", FindingSeverity::critical),
                                  finding("c", FindingSeverity::critical), finding("d", FindingSeverity::major)}));
    const std::vector<Finding> found = list.take();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].what, "b");
}

TEST(FindingList, TellsOneCauseOfManyPointsOnce) {
    Certificate certificate = passed_certificate();
    CertifiedTable& table = certificate.tables[0];
    table.argument = CertifiedTable::Argument{
        .name = "point", .unit = "", .printed_unit = "", .values = {{}, {}, {}, {}}, .printed = {"1", "2", "3", "4"}};
    const auto finding = [](const std::string& id, const std::string& what, FindingSeverity severity = k_major) {
        Finding one;
        one.id = id;
        one.what = what;
        one.severity = severity;
        return one;
    };
    FindingList list(certificate.data);
    const auto found = [&](std::size_t row, Finding one, double badness = 0.0, std::size_t column = 0) {
        return FoundInRow{.table = &table,
                          .column = &table.columns[column],
                          .row = row,
                          .finding = std::move(one),
                          .badness = badness};
    };
    list.add_by_cause(
        {found(0, finding("D05", "no value can pass \"MPE 1\" by DR-03")),
         found(1, finding("D05", "no value can pass \"MPE 1\" by DR-03")),
         found(1, finding("D08", "probability of 12.5 %"), -0.125),
         found(2, finding("D08", "probability of 9 %"), -0.09), found(3, finding("D08", "probability of 11 %"), -0.11),
         found(2, finding("D05", "no value can pass \"MPE 2\" by DR-03")),
         found(3, finding("D05", "no value can pass \"MPE 1\" by DR-04")),
         found(1, finding("R02", "value 1.20 ends elsewhere")), found(0, finding("R02", "value 3.1 ends elsewhere")),
         found(3, finding("D08", "probability of 1E-5 %", FindingSeverity::critical))});
    std::vector<std::string> told;
    for (const Finding& f : list.take()) {
        told.push_back(f.where + ": " + f.what);
    }
    EXPECT_THAT(told, testing::ElementsAre(
                          "l, points 1, 2: no value can pass \"MPE 1\" by DR-03",
                          "l, points 2, 3, 4: probability of 9 %; the numbers are those of point 3, the worst of 3",
                          "l, point 3: no value can pass \"MPE 2\" by DR-03",
                          "l, point 4: no value can pass \"MPE 1\" by DR-04",
                          "l, points 2, 1: value 1.20 ends elsewhere; the numbers are those of point 2",
                          "l, point 4: probability of 1E-5 %"))
        << "names keep their numbers apart, and what is graver is another finding";
    const CertifiedTable without_points;
    list.add_by_cause({{.table = &without_points,
                        .column = &table.columns[1],
                        .row = 0,
                        .finding = finding("R06", "the value is printed as -0.00")}});
    EXPECT_EQ(only(list.take()).where, "EAA") << "of a table without points";
    std::vector<FoundInRow> many;
    table.argument->name = "angle";
    table.argument->printed.clear();
    for (std::size_t i = 0; i < 22; ++i) {
        table.argument->printed.push_back(std::to_string(10 * i));
        many.push_back(found(i, finding("R06", "the value is printed as -0.00"), 0.0, 1));
    }
    list.add_by_cause(many);
    const std::string where = only(list.take()).where;
    EXPECT_TRUE(where.starts_with("EAA, angles 0, 10, 20") && where.ends_with("180, 190 and 2 more")) << where;
}

/// A specification over ten columns whose U is too large is one cause, and not ten.
TEST(FindingList, TellsOneCauseOfManyResultsOnce) {
    Certificate certificate = passed_certificate();
    CertifiedTable& table = certificate.tables[0];
    table.argument = CertifiedTable::Argument{
        .name = "point", .unit = "", .printed_unit = "", .values = {{}, {}}, .printed = {"1", "2"}};
    table.columns.resize(10, table.columns[0]);
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        table.columns[c].result = "E" + std::to_string(c);
    }
    CertifiedTable of_another_range = table;
    of_another_range.argument->printed = {"3", "4"};
    FindingList list(certificate.data);
    const auto told = [&](const auto& is_found) {
        std::vector<FoundInRow> found;
        for (const CertifiedTable* of : {&table, &of_another_range}) {
            for (const CertifiedColumn& column : of->columns) {
                for (std::size_t row = 0; row < 2; ++row) {
                    if (const double badness = is_found(*of, column, row); badness != 0.0) {
                        Finding one;
                        one.id = "D05";
                        one.what = "U is " + std::to_string(static_cast<int>(badness)) + " mV";
                        found.push_back(
                            {.table = of, .column = &column, .row = row, .finding = one, .badness = badness});
                    }
                }
            }
        }
        list.add_by_cause(found);
        const Finding one = only(list.take());
        return one.where + ": " + one.what;
    };
    EXPECT_EQ(told([](const auto&, const auto&, std::size_t) { return 7.0; }),
              "E0, E1, E2, E3, E4, E5, E6, E7, E8, E9, points 1, 2, 3, 4: U is 7 mV");
    EXPECT_EQ(
        told([](const auto&, const CertifiedColumn& c, std::size_t row) {
            return c.result == "E7" && row == 1 ? 9.0 : 7.0;
        }),
        "E0, E1, E2, E3, E4, E5, E6, E7, E8, E9, points 1, 2, 3, 4: U is 9 mV; the numbers are those of \"E7\" at "
        "point 2, the worst of 40");
    EXPECT_EQ(told([&](const CertifiedTable& t, const CertifiedColumn& c, std::size_t row) {
                  const bool first = &t == &table && c.result == "E0";
                  const bool second = &t == &of_another_range && c.result == "E1" && row == 0;
                  return first || second ? 5.0 : 0.0;
              }),
              "E0[1], E0[2], E1[3]: U is 5 mV");
}

}  // namespace
}  // namespace gumcert::certificate
