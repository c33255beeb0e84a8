#include "audit/tables/sheet_view.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/workbook_of.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

TEST(SheetView, ShowsWhatFormulasGiveAndHowNumbersArePrinted) {
    const workbook::Workbook workbook = test::workbook_of({{"A1", "0.30"}, {"B1", "=2*A1"}, {"C1", "n/a"}});
    const workbook::Evaluation evaluation = workbook::evaluate_workbook(workbook);
    const SheetView sheet(workbook, evaluation, 0, DecimalSign::point);
    const SheetView::Row& row = sheet.rows().at(1);
    ASSERT_EQ(row.size(), 3U);
    EXPECT_TRUE(sheet.has_formulas());
    EXPECT_EQ(sheet.number(*row[1])->value, 0.6);
    EXPECT_EQ(sheet.place(row[1]->address), "Sheet1!B1");
    EXPECT_FALSE(sheet.number(*row[2]));
    EXPECT_TRUE(says_nothing(sheet.words(*row[2])));
    EXPECT_EQ(cell_in(row, row[1]->address.column), row[1]);
    EXPECT_EQ(cell_in(row, 99), nullptr);
}

TEST(SheetView, SettlesTheDecimalSignOfAFile) {
    const auto sign = [](const std::string& csv) { return decimal_sign_of(workbook::read_csv(csv, "b.csv", "b")); };
    EXPECT_EQ(sign("a;0,5\nb;1,25\n"), DecimalSign::comma);
    EXPECT_EQ(sign("a;0.5\nb;1.25\n"), DecimalSign::point);
    EXPECT_EQ(sign("a;1.200\n"), DecimalSign::open);
    EXPECT_EQ(sign("a,1.200\n"), DecimalSign::point);
}

TEST(SheetView, ReadsNumbersWithUnits) {
    const workbook::Workbook workbook = workbook::read_csv("a,0.36 µm,5 %\n", "b.csv", "b");
    const workbook::Evaluation evaluation = workbook::evaluate_workbook(workbook);
    const SheetView sheet(workbook, evaluation, 0, DecimalSign::point);
    const SheetView::Row& row = sheet.rows().at(1);
    EXPECT_EQ(sheet.number_with_unit(*row[1])->unit, "µm");
    EXPECT_NEAR(without_dimension(*sheet.number_with_unit(*row[2])).value, 0.05, 1e-15);
    EXPECT_NE(open_sign("b!B1", "1.200").english().find("1.200"), std::string::npos);
}

/// What a view says of a sheet whose one cell, 0.30, has a number format.
auto of_cell_with_format(const std::string& format, const auto& say) {
    workbook::Workbook workbook = test::workbook_of({{"A1", "0.30"}});
    workbook.number_formats = {format};
    workbook.sheets[0].cells[0].number_format = 0;
    const workbook::Evaluation evaluation = workbook::evaluate_workbook(workbook);
    const SheetView sheet(workbook, evaluation, 0, DecimalSign::point);
    return say(sheet, *sheet.rows().at(1).front());
}

TEST(SheetView, ShowsTheUnitThatAFormatWritesBehindItsNumbers) {
    const auto shown = [](const std::string& format) {
        return of_cell_with_format(format, [](const SheetView& sheet, const workbook::Cell& cell) {
            return sheet.number_with_unit(cell)->unit;
        });
    };
    for (const char* const format :
         {"0.000\" µm\"", "0.000\\ \"µm\"", "#,##0.00\" µm\"", "General\" µm\"", "0.00\\ µ\\m", "0.0E+00\" µm\"",
          "0.00\" µm\";-0.00\" µm\"", "_-0.00\"µm\"_-", "[Blue]0.0000\" µm\"", "[$-407]0.00\" µm\"",
          "[Color 12]0.00\" µm\";[Red]-0.00\" µm\""}) {
        EXPECT_EQ(shown(format), "µm") << format;
    }
    // Dates, thousands, percentages, words before the digits, and what is no unit.
    for (const char* const format : {"General", "0.00", "yyyy\\-mm\\-dd", "0.00,\" km\"", "0.00%", "\"mm \"0.00",
                                     "0\" readings\"", "[$-409]d/m/yy", "h:mm", "0.00\"", "@", "[h]:mm", "[hh]\" h\"",
                                     "[<1]0.0\" nm\";0.0\" µm\"", "[$€-407]0.00", "[Blue"}) {
        EXPECT_EQ(shown(format), "") << format;
    }
}

TEST(SheetView, MultipliesByAHundredWhereTheFormatDoes) {
    const auto shown = [](const std::string& format) {
        return of_cell_with_format(format, [](const SheetView& sheet, const workbook::Cell& cell) {
            return sheet.as_shown(*sheet.number_with_unit(cell), cell);
        });
    };
    for (const char* const format : {"0.00%", "0%", "0.0 %", "0.00%;-0.00%", "0.00%_)", "[Blue]0.00%"}) {
        EXPECT_DOUBLE_EQ(shown(format).number.value, 30.0) << format;
        EXPECT_EQ(shown(format).unit, "%") << format;
    }
    for (const char* const format : {"0.00\\%", "0.00\"%\"", "0.00_%", "0.00;0.00%"}) {
        EXPECT_DOUBLE_EQ(shown(format).number.value, 0.30) << format;
    }
    EXPECT_EQ(shown("0.00\\%").unit, "%") << "percent as it stands";
}

}  // namespace
}  // namespace gumcert::audit
