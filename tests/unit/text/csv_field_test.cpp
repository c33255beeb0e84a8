#include "text/csv_field.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gumcert::text {
namespace {

TEST(CsvField, IsQuotedWhereItMustBe) {
    EXPECT_EQ(csv_field(""), "");
    EXPECT_EQ(csv_field("L_s"), "L_s");
    EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
    EXPECT_EQ(csv_field("5\" gauge"), "\"5\"\" gauge\"");
    EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
}

TEST(CsvField, NoSpreadsheetTakesItForAFormula) {
    EXPECT_EQ(csv_field("=1+1"), "'=1+1");
    EXPECT_EQ(csv_field("@SUM(A1)"), "'@SUM(A1)");
    EXPECT_EQ(csv_field("＝1"), "'＝1");
    EXPECT_EQ(csv_field("x;=1"), "\"x;'=1\"") << "where the semicolon separates";
    EXPECT_EQ(csv_field("="), "'=");
}

TEST(CsvField, NumbersStayNumbers) {
    for (const char* number : {"-0.5", "+3", "1e-05", "-1"}) {
        EXPECT_EQ(csv_field(number), number);
    }
    for (const char* text : {"-a", "+-5", "++5", "-+5", "+"}) {
        EXPECT_EQ(csv_field(text), std::string_view(text) == "+" ? "+" : "'" + std::string(text)) << text;
    }
}

TEST(CsvField, QuotedIsTheSameInQuotes) {
    for (const char* const field : {"", "L_s", "-0.5", "5\" gauge", "=1+1", "x;=1", "a,b"}) {
        const std::string plain = csv_field(field);
        EXPECT_EQ(quoted_csv_field(field), plain.starts_with('"') ? plain : '"' + plain + '"') << field;
    }
    EXPECT_EQ(quoted_csv_field("=\""), "\"'=\"\"\"");
}

TEST(SeparatorLine, IsAFirstLineThatStatesOneSeparator) {
    for (const char* text : {"sep=;", "sep=;\nx;y\n", "SEP=;\r\nx", "\"sep=;\"\nx", "sep=;;;\nx"}) {
        const std::optional<SeparatorLine> line = separator_line(text);
        ASSERT_TRUE(line) << text;
        EXPECT_EQ(line->separator, ';') << text;
        EXPECT_EQ(line->length, std::min(std::string_view(text).find_first_of("\r\n"), std::string_view(text).size()));
    }
    EXPECT_EQ(separator_line("sep=,\nx")->separator, ',');
    EXPECT_EQ(separator_line("sep=\t\nx")->separator, '\t');
    EXPECT_EQ(separator_line("sep=|\nx")->separator, '|');
    for (const char* text : {"", "sep=", "sep", "sep=x", "sep=;x", "sep=;,", "\nsep=;", "sep;x\n", "sep=1;2\n"}) {
        EXPECT_FALSE(separator_line(text)) << text;
    }
}

}  // namespace
}  // namespace gumcert::text
