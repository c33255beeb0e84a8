#include "jobs/csv_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "jobs/job_files.h"

namespace gumcert::jobs {
namespace {

using testing::HasSubstr;

constexpr std::array<std::string_view, 3> k_columns{"name", "x_mm", "run"};
constexpr std::array<std::string_view, 1> k_optional{"u_mm"};

/// Reads a table and every cell of it, like a job reader would.
std::vector<gum::Diagnostic> table_refusals(const std::string& text, std::vector<gum::Diagnostic>* warnings = nullptr) {
    ProblemList problems("t.csv");
    const auto table = read_csv_table(text, k_columns, k_optional, problems, {.rows = 5});
    if (table) {
        for (std::size_t row = 0; row < table->rows(); ++row) {
            (void)table->name(row, 0);
            (void)table->number(row, 1, between(-1000.0, 1000.0, "mm"));
            (void)table->integer(row, 2, {});
            (void)table->number_if_any(row, 3, above_zero("mm"));
        }
    }
    if (warnings != nullptr) {
        *warnings = problems.warnings();
    }
    return problems.refused();
}

void expect_refusal(const std::string& text, const InputCode& code, const std::string& where, const std::string& part) {
    SCOPED_TRACE(text.substr(0, 80));
    const auto found = table_refusals(text);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, code.code);
    EXPECT_EQ(found[0].where, where);
    EXPECT_THAT(gum::message(found[0]), HasSubstr(part));
    EXPECT_FALSE(found[0].rule.empty());
    EXPECT_FALSE(found[0].action.empty());
}

TEST(CsvTable, ReadsColumnsInAnyOrderWithBomCrlfQuotesAndBlankLines) {
    ProblemList problems("t.csv");
    const auto table = read_csv_table(
        "\xEF\xBB\xBFrun,\"x_mm\",name,u_mm\r\n1,+2.5,\"Größe, \"\"a\"\"\",\r\n\r\n2,-1e-3,ü,0.5\r\n\r\n", k_columns,
        k_optional, problems);
    ASSERT_TRUE(table);
    ASSERT_EQ(table->rows(), 2U);
    EXPECT_EQ(table->name(0, 0), "Größe, \"a\"");
    EXPECT_EQ(table->number(0, 1, {}), 2.5);
    EXPECT_EQ(table->integer(0, 2, {}), 1);
    EXPECT_EQ(table->number_if_any(0, 3, {}), std::nullopt);
    EXPECT_EQ(table->name(1, 0), "ü");
    EXPECT_EQ(table->number(1, 1, {}), -0.001);
    EXPECT_EQ(table->number_if_any(1, 3, {}), 0.5);
    EXPECT_EQ(table->where(table->cell(0, 0)), "t.csv:2:8");
    EXPECT_EQ(table->where(table->cell(1, 3)), "t.csv:4:11");  // columns count characters: ü is one
    EXPECT_EQ(problems.refusals(), 0U);
    EXPECT_TRUE(problems.warnings().empty());
}

TEST(CsvTable, ReadsALastLineWithoutLineEnd) {
    EXPECT_TRUE(table_refusals("name,x_mm,run\na,1,2").empty());
}

TEST(CsvTable, RefusesWhatIsNotATable) {
    using namespace std::string_literals;
    expect_refusal("", k_empty_file, "t.csv", "the file is empty");
    expect_refusal("\n\n", k_empty_file, "t.csv", "the file is empty");
    expect_refusal("name,x_mm,run\n", k_csv_no_rows, "t.csv", "a header and no rows");
    expect_refusal("name\tx_mm\trun\na\t1\t2\n", k_csv_separator, "t.csv:1:1", "separated by tabs");
    expect_refusal("name,x_mm,run\ra,1,2\r", k_lone_carriage_return, "t.csv:1:14", "carriage return");
    expect_refusal("name,x_mm,run\n\xE4,1,2\n", k_not_utf8, "t.csv:2:1", "byte 0xE4 at byte offset 14");
    expect_refusal("\xFF\xFEn\0"s, k_utf16, "t.csv:1:1", "UTF-16");
    expect_refusal("name,x_mm,run\na,1\0,2\n"s, k_nul_character, "t.csv:2:4", "byte offset 17");
}

TEST(CsvTable, RefusesHeadersThatMissOrRepeatColumns) {
    expect_refusal("name,run\na,1\n", k_csv_missing_column, "t.csv:1:1", "the column \"x_mm\" is missing");
    expect_refusal("Name,x_mm,run\na,1,1\n", k_csv_missing_column, "t.csv:1:1", "is it the column \"Name\"?");
    expect_refusal("name,x_mm,run,x_mm\na,1,1,1\n", k_csv_repeated_column, "t.csv:1:15", "\"x_mm\" occurs twice");
    EXPECT_EQ(table_refusals("foo,bar\n1,2\n").size(), 3U);
}

TEST(CsvTable, WarnsOfColumnsThatNobodyUses) {
    std::vector<gum::Diagnostic> warnings;
    EXPECT_TRUE(table_refusals("name,x_mm,run,colour,u_m\na,1,2,red,1\n", &warnings).empty());
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_EQ(warnings[0].code, k_warn_extra_column.code);
    EXPECT_EQ(warnings[0].severity, gum::Severity::warning);
    EXPECT_EQ(warnings[0].where, "t.csv:1:15");
    EXPECT_THAT(warnings[0].what, HasSubstr("\"colour\""));
    EXPECT_THAT(warnings[1].action, HasSubstr("did you mean \"u_mm\"?"));
}

TEST(CsvTable, RefusesRaggedRowsAndDecimalCommas) {
    expect_refusal("name,x_mm,run\na,1\n", k_csv_ragged_row, "t.csv:2:3", "2 fields where the header has 3");
    expect_refusal("name,x_mm,run\na,1,x,b\n", k_csv_ragged_row, "t.csv:2:7", "4 fields where the header has 3");
    expect_refusal("name,x_mm,run\na,808,831212,2\n", k_csv_decimal_comma, "t.csv:2:14",
                   "\"808,831212\" looks like a number with a decimal comma");
    expect_refusal("name,x_mm,run\na,\"1,234\",2\n", k_csv_decimal_comma, "t.csv:2:3", "\"1,234\" in column x_mm");
    expect_refusal("name,x_mm,run\na,\"1,234.5\",2\n", k_csv_decimal_comma, "t.csv:2:3", "thousands separators");
}

TEST(CsvTable, ReadsSemicolonsWithDecimalCommas) {
    ProblemList problems("t.csv");
    const auto table = read_csv_table("\xEF\xBB\xBF\r\nname;x_mm;run\r\n\"a;b\";+10,50;2\r\nc,d;-,5e-3;3\r\n",
                                      k_columns, {}, problems);
    ASSERT_TRUE(table);
    EXPECT_EQ(table->name(0, 0), "a;b");
    EXPECT_EQ(table->name(1, 0), "c,d");
    EXPECT_EQ(table->number(0, 1, {}), 10.5);
    EXPECT_EQ(table->number_text(0, 1), "10.50");
    EXPECT_EQ(table->number(1, 1, {}), -0.0005);
    EXPECT_EQ(table->integer(1, 2, {}), 3);
    EXPECT_EQ(problems.refusals(), 0U);
}

TEST(CsvTable, ReadsSemicolonsWithDecimalPoints) {
    ProblemList problems("t.csv");
    constexpr std::array<std::string_view, 1> k_one{"x_mm"};
    const auto table = read_csv_table("x_mm;y\n1.234;a\n", k_one, {}, problems);
    ASSERT_TRUE(table);
    EXPECT_EQ(table->number(0, 0, {}), 1.234);
    EXPECT_EQ(table->number_text(0, 0), "1.234");
}

// Spreadsheets read and write a first line that states the separator; it is no header.
TEST(CsvTable, HonoursALineThatStatesTheSeparator) {
    for (const std::string separator : {";", ",", "\t", "|"}) {
        ProblemList problems("t.csv");
        const std::string s = separator;
        const auto table =
            read_csv_table("\xEF\xBB\xBFsep=" + s + "\r\nname" + s + "x_mm" + s + "run\r\nä" + s + "1.5" + s + "2\r\n",
                           k_columns, {}, problems);
        ASSERT_TRUE(table) << separator;
        EXPECT_EQ(table->rows(), 1U);
        EXPECT_EQ(table->number(0, 1, {}), 1.5);
        EXPECT_EQ(table->where(table->cell(0, 1)), "t.csv:3:3") << "lines count as they stand in the file";
        EXPECT_EQ(problems.refusals(), 0U);
        EXPECT_TRUE(problems.warnings().empty());
        EXPECT_EQ(csv_header("sep=" + s + "\nname" + s + "x_mm\n").size(), 2U);
    }
    ProblemList problems("t.csv");
    const auto commas = read_csv_table("sep=\t\nname\tx_mm\trun\na\t1,5\t2\n", k_columns, {}, problems);
    ASSERT_TRUE(commas);
    EXPECT_EQ(commas->number(0, 1, {}), 1.5);
    expect_refusal("sep=,\nname;x_mm;run\na;1;2\n", k_csv_separator, "t.csv:2:1", "separated by semicolons");
    expect_refusal("sep=;\n", k_empty_file, "t.csv", "the file is empty");
    const auto matrix = read_csv_matrix("sep=;\n1,5;2\n3;4\n", 2, "µm²", problems);
    ASSERT_TRUE(matrix);
    EXPECT_EQ((*matrix)(0, 0), 1.5);
}

TEST(CsvTable, RefusesPointsAmongDecimalCommas) {
    expect_refusal("name;x_mm;run\na;1.234;2\nb;1,5;2\n", k_csv_decimal_comma, "t.csv:2:3",
                   "the numbers of this table have decimal commas");
    expect_refusal("name;x_mm;run\na;1.234,5;2\nb;1,5;2\n", k_csv_decimal_comma, "t.csv:2:3",
                   "the numbers of this table have decimal commas");
    EXPECT_EQ(csv_separator("name,x_mm;run\n"), ',') << "what could be read in two ways is read as it was";
    EXPECT_EQ(csv_separator("\n\"a,b\";x\n1,5;2"), ';');
}

TEST(CsvTable, RefusesBadQuotes) {
    expect_refusal("name,x_mm,run\n\"a,1,2\n", k_csv_quote, "t.csv:2:1", "not closed");
    expect_refusal("name,x_mm,run\na\"b,1,2\n", k_csv_quote, "t.csv:2:2", "inside a field");
    expect_refusal("name,x_mm,run\n\"a\"b,1,2\n", k_csv_quote, "t.csv:2:4", "after a closing double quote");
}

TEST(CsvTable, RefusesCellsThatAreNoNumbers) {
    const auto row = [](const std::string& cell) { return "name,x_mm,run\na," + cell + ",1\n"; };
    expect_refusal(row("abc"), k_csv_not_a_number, "t.csv:2:3", "\"abc\" in column x_mm");
    expect_refusal(row("12.5 mm"), k_csv_not_a_number, "t.csv:2:3", "without unit");
    expect_refusal(row(" 12.5"), k_csv_not_a_number, "t.csv:2:3", "remove the spaces");
    expect_refusal(row("12.5 "), k_csv_not_a_number, "t.csv:2:3", "remove the spaces");
    expect_refusal(row("\xE2\x88\x92"
                       "1"),
                   k_csv_not_a_number, "t.csv:2:3", "U+2212");
    expect_refusal(row("+-1"), k_csv_not_a_number, "t.csv:2:3", "must be a number");
    expect_refusal(row("0x1p3"), k_csv_not_a_number, "t.csv:2:3", "must be a number");
    expect_refusal(row("1.2.3"), k_csv_not_a_number, "t.csv:2:3", "must be a number");
    expect_refusal(row(""), k_csv_missing_value, "t.csv:2:3", "an empty cell in column x_mm");
    for (const std::string text : {"nan", "NaN", "-nan", "inf", "+Inf", "-Infinity", "#N/A", "nan(1)"}) {
        expect_refusal(row(text), k_csv_not_finite, "t.csv:2:3", "must be finite");
    }
    expect_refusal(row("1e999"), k_csv_number_range, "t.csv:2:3", "1e999");
    expect_refusal(row("1e-999"), k_csv_number_range, "t.csv:2:3", "1e-999");
    expect_refusal(row("1000.5"), k_csv_out_of_range, "t.csv:2:3",
                   "1000.5 mm in column x_mm — must be at least -1000 mm and at most 1000 mm");
    expect_refusal("name,x_mm,run\na,1,1.5\n", k_csv_not_an_integer, "t.csv:2:5", "must be a whole number");
    expect_refusal("name,x_mm,run,u_mm\na,1,1,0\n", k_csv_out_of_range, "t.csv:2:7", "must be greater than 0 mm");
}

TEST(CsvTable, RefusesNamesThatDeceive) {
    const auto row = [](const std::string& name) { return "name,x_mm,run\n" + name + ",1,1\n"; };
    expect_refusal(row(""), k_csv_missing_value, "t.csv:2:1", "an empty cell in column name");
    expect_refusal(row("P1 "), k_csv_name, "t.csv:2:1", "ends with a space");
    expect_refusal(row("P\t1"), k_csv_name, "t.csv:2:1", "U+0009");
    expect_refusal(row("P\xE2\x80\xAE"
                       "1"),
                   k_csv_name, "t.csv:2:1", "U+202E");
    expect_refusal(row("\"P\n1\""), k_csv_name, "t.csv:2:1", "U+000A");
    expect_refusal(row(std::string(257, 'P')), k_csv_name, "t.csv:2:1", "has 257 bytes");
    EXPECT_TRUE(table_refusals(row(std::string(256, 'P'))).empty());
}

TEST(CsvTable, LimitsRowsAndColumns) {
    std::string text = "name,x_mm,run\n";
    for (int i = 0; i < 5; ++i) {
        text += "a,1,2\n";
    }
    EXPECT_TRUE(table_refusals(text).empty());
    expect_refusal(text + "a,1,2\n", k_csv_too_many_rows, "t.csv:7:1", "more than 5 rows");
    expect_refusal(std::string(20'000, ','), k_csv_too_many_columns, "t.csv:1:10001", "more than 10000 fields");
    EXPECT_EQ(CsvLimits{}.rows, 1'000'000U);
}

TEST(CsvTable, ReportsEveryRowAndClosesALongList) {
    ProblemList problems("t.csv");
    std::string text = "name,x_mm,run\n";
    for (int i = 0; i < 250; ++i) {
        text += "a,1\n";
    }
    (void)read_csv_table(text, k_columns, k_optional, problems);
    const auto found = problems.refused();
    ASSERT_EQ(found.size(), 201U);
    EXPECT_EQ(found[199].where, "t.csv:201:3");
    EXPECT_EQ(gum::message(found[200]), "t.csv — and 50 more");
}

TEST(CsvMatrix, ReadsASquareMatrixWithoutHeader) {
    ProblemList problems("c.csv");
    const auto matrix = read_csv_matrix("1,2\r\n3,4\r\n", 2, "µm²", problems);
    ASSERT_TRUE(matrix);
    EXPECT_EQ((*matrix)(0, 1), 2.0);
    EXPECT_EQ((*matrix)(1, 0), 3.0);
}

TEST(CsvMatrix, RefusesOtherSizes) {
    ProblemList problems("c.csv");
    EXPECT_FALSE(read_csv_matrix("1,2\n3,4.5,5\n6,x\n", 2, "µm²", problems));
    const auto found = problems.refused();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].code, k_csv_ragged_row.code);
    EXPECT_EQ(found[1].code, k_csv_matrix_size.code);
    EXPECT_THAT(found[1].what, HasSubstr("3 rows"));
    ProblemList others("c.csv");
    EXPECT_FALSE(read_csv_matrix("1\t2\n2\t4\n", 2, "µm²", others));
    EXPECT_EQ(others.refused().at(0).code, k_csv_separator.code);
}

TEST(CsvMatrix, ReadsSemicolonsWithDecimalCommasOrPoints) {
    for (const char* text : {"1,5;-0,25\n-0,25;2e-1\n", "1.5;-0.25\n-0.25;2e-1\n"}) {
        ProblemList problems("c.csv");
        const auto matrix = read_csv_matrix(text, 2, "µm²", problems);
        ASSERT_TRUE(matrix) << text;
        EXPECT_EQ((*matrix)(0, 0), 1.5);
        EXPECT_EQ((*matrix)(1, 0), -0.25);
        EXPECT_EQ((*matrix)(1, 1), 0.2);
    }
    ProblemList both("c.csv");
    EXPECT_FALSE(read_csv_matrix("1,5;0.5\n0,5;2\n", 2, "µm²", both));
    EXPECT_EQ(both.refused().at(0).code, k_csv_decimal_comma.code);
    ProblemList thousands("c.csv");
    EXPECT_FALSE(read_csv_matrix("1,000,5;0\n0;2\n", 2, "µm²", thousands));
    EXPECT_THAT(thousands.refused().at(0).rule, HasSubstr("decimal commas"));
}

}  // namespace
}  // namespace gumcert::jobs
