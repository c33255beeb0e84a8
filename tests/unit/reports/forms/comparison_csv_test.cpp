#include "reports/forms/comparison_csv.h"

#include "tests/support/sample_comparison_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Rows of fields as RFC 4180 reads them: an oracle that knows nothing of the writer.
std::vector<std::vector<std::string>> parse(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> row;
    std::string field;
    bool quoted = false;
    for (std::size_t i = 0; i < csv.size(); ++i) {
        const char c = csv[i];
        if (quoted) {
            if (c == '"' && i + 1 < csv.size() && csv[i + 1] == '"') {
                field += '"';
                ++i;
            } else if (c == '"') {
                quoted = false;
            } else {
                field += c;
            }
        } else if (c == '"') {
            quoted = true;
        } else if (c == ',' || c == '\n') {
            row.push_back(field);
            field.clear();
            if (c == '\n') {
                rows.push_back(row);
                row.clear();
            }
        } else {
            field += c;
        }
    }
    return rows;
}

double number(const std::string& text) {
    double v = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
    EXPECT_TRUE(error == std::errc() && end == text.data() + text.size()) << text;
    return v;
}

std::map<std::string, std::string> row_of(const std::vector<std::vector<std::string>>& rows, std::size_t i) {
    std::map<std::string, std::string> row;
    EXPECT_EQ(rows.at(i).size(), rows.front().size()) << "row " << i;
    for (std::size_t c = 0; c < rows.front().size(); ++c) {
        row[rows.front()[c]] = rows.at(i).at(c);
    }
    return row;
}

TEST(ComparisonCsv, HoldsEveryNumberOfEveryResult) {
    const EvaluationRecord r = test::sample_laboratories_record();
    const auto rows = parse(comparison_csv(r));
    ASSERT_EQ(rows.size(), r.comparison->points.size() + 1);
    for (std::size_t i = 0; i < r.comparison->points.size(); ++i) {
        auto row = row_of(rows, i + 1);
        const ComparisonPoint& p = r.comparison->points[i];
        EXPECT_EQ(row["participant"], p.participant);
        EXPECT_EQ(number(row["value"]), p.value.number);
        EXPECT_EQ(number(row["D"]), p.D.number);
        EXPECT_EQ(row["En"].empty(), !p.En.number.has_value());
        EXPECT_EQ(row["contributes"], p.contributes ? "true" : "false");
        if (p.En.number) {
            EXPECT_EQ(number(row["En"]), *p.En.number);
            EXPECT_NEAR(number(row["D"]) / number(row["U_D"]), number(row["En"]),
                        1e-15 + 1e-14 * std::abs(*p.En.number));
        }
        EXPECT_NEAR(number(row["D"]) / number(row["sigma_pt"]), number(row["z"]), 1e-14);
    }
    EXPECT_EQ(row_of(rows, 4)["reason"], "artefact damaged, stated before the results were known");
    EXPECT_EQ(row_of(rows, 1)["unit"], "um");
    EXPECT_FALSE(row_of(rows, 1).contains("angle_deg"));
    EXPECT_FALSE(row_of(rows, 1).contains("direction"));
}

TEST(ComparisonCsv, ColumnsThatNoRowHasAreLeftOut) {
    const std::string methods = comparison_csv(test::sample_methods_record());
    EXPECT_THAT(methods,
                StartsWith("point,direction,position,unit,value,u,U,k,nu,reference_value,reference_u,reference_U,"
                           "reference_k,correlation,D,u_D,U_D,En,En_worst,En_audited,zeta,signal\n"
                           "up 1,up,0,um,"));
    EXPECT_THAT(comparison_csv(test::sample_record()),
                StartsWith("direction,angle_deg,unit,value,u,U,reference_value,reference_u,reference_U,D,u_D,U_D,En,"
                           "zeta\nx,0,um,"));
}

/// "comparison.csv and record.json hold all": also which scores give a signal, and what has no result.
TEST(ComparisonCsv, SaysWhichScoresGiveASignalAndWhichItemsHaveNoResult) {
    EvaluationRecord record = test::sample_laboratories_record();
    record.comparison->points.front().signal_by = {"En", "z_prime"};
    record.comparison->items_without_result = {{.id = "block, 50 mm",
                                                .name = "",
                                                .round = "",
                                                .code = "GC-GUM-0134",
                                                .what = "no two of the 3 results are consistent with each other",
                                                .rule = "",
                                                .action = ""}};
    const auto rows = parse(comparison_csv(record));
    ASSERT_EQ(rows.size(), record.comparison->points.size() + 2);
    EXPECT_EQ(row_of(rows, 1).at("signal_by"), "En z_prime");
    EXPECT_EQ(row_of(rows, 1).at("no_result_because"), "");
    auto last = row_of(rows, rows.size() - 1);
    EXPECT_EQ(last.at("item"), "block, 50 mm");
    EXPECT_EQ(last.at("no_result_because"), "no two of the 3 results are consistent with each other [GC-GUM-0134]");
    last.erase("item");
    last.erase("no_result_because");
    for (const auto& [head, cell] : last) {
        EXPECT_EQ(cell, "") << head;
    }
}

TEST(ComparisonCsv, NoTextBecomesAFormula) {
    EvaluationRecord r = test::sample_laboratories_record();
    std::vector<ComparisonPoint>& p = r.comparison->points;
    const std::vector<std::pair<std::string, std::string>> texts = {
        {"=cmd|'/c calc'!A1", "'=cmd|'/c calc'!A1"},
        {"+1+1", "'+1+1"},
        {"-2+3", "'-2+3"},
        {"@SUM(A1)", "'@SUM(A1)"},
        {"\t=1", "'\t'=1"},
        {"a;=1+1", "a;'=1+1"},
        {"two\nlines, \"quoted\"", "two\nlines, \"quoted\""},
        {"＝1+1", "'＝1+1"},
        {"-30", "-30"},
        {"+", "+"},
        {"=", "'="},
        {"plain-text+more=x@y", "plain-text+more=x@y"}};
    ASSERT_GE(p.size(), texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
        p[i].reason = texts[i].first;
    }
    const auto rows = parse(comparison_csv(r));
    for (std::size_t i = 0; i < texts.size(); ++i) {
        EXPECT_EQ(row_of(rows, i + 1)["reason"], texts[i].second);
    }
    p[0].participant = "=1+1";
    EXPECT_THAT(comparison_csv(r), HasSubstr("\n'=1+1,A,1,"));
}

TEST(ComparisonCsv, NumbersAreTheShortestThatReadBackTheSame) {
    EvaluationRecord r = test::sample_methods_record(1);
    r.comparison->points[0].value.number = 0.1;
    r.comparison->points[0].D.number = -2.5e-7;
    const auto rows = parse(comparison_csv(r));
    EXPECT_EQ(row_of(rows, 1)["value"], "0.1");
    EXPECT_EQ(row_of(rows, 1)["D"], "-2.5e-07");
}

TEST(ComparisonCsv, RefusesARecordWithoutComparison) {
    EvaluationRecord r = test::sample_record();
    r.comparison.reset();
    try {
        static_cast<void>(comparison_csv(r));
        FAIL() << "accepted";
    } catch (const gum::InputError& e) {
        EXPECT_EQ(e.diagnostics().front().code, "GC-REPORT-0040");
        EXPECT_THAT(gum::message(e.diagnostics().front()), HasSubstr("holds no comparison"));
    }
}

}  // namespace
}  // namespace gumcert::reports
