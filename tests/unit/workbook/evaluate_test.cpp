#include "workbook/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>

#include "tests/support/shown_value.h"
#include "tests/support/workbook_of.h"

namespace gumcert::workbook {
namespace {

using test::Contents;

/// The value of one cell of a sheet, as shown().
std::string evaluated(const Contents& contents, const std::string& address) {
    const Workbook workbook = test::workbook_of(contents);
    const Evaluation evaluation = evaluate_workbook(workbook);
    return test::shown(evaluation, workbook, find_evaluated(evaluation, workbook, 0, *read_a1(address)));
}

/// The value of a formula in Z99 of a sheet.
std::string value_of_formula(const std::string& formula, Contents contents = {}) {
    contents.emplace_back("Z99", "=" + formula);
    return evaluated(contents, "Z99");
}

double number_of_formula(const std::string& formula) {
    const Workbook workbook = test::workbook_of({{"Z99", "=" + formula}});
    const Evaluation evaluation = evaluate_workbook(workbook);
    EXPECT_EQ(evaluation.cells.at(0).value.kind, CellKind::number)
        << formula << ": " << test::shown(evaluation, workbook, &evaluation.cells[0]);
    return evaluation.cells.at(0).value.number;
}

/// A number as it is printed, and half a unit of its last digit.
struct PrintedNumber {
    double value = 0.0, half_unit = 0.0;
};

PrintedNumber printed_number(const std::string& digits) {
    const std::size_t exponent_mark = digits.find('E');
    const std::string mantissa = digits.substr(0, exponent_mark);
    const std::size_t point = mantissa.find('.');
    int exponent = exponent_mark == std::string::npos ? 0 : std::stoi(digits.substr(exponent_mark + 1));
    exponent -= point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
    return {std::stod(digits), 0.5 * std::pow(10.0, exponent)};
}

/// A result that somebody else printed. Pages are those of "Excel functions (by category)", support.microsoft.com, where
/// each function has the example that stands here; "arithmetic" is worked out beside it.
struct KnownResult {
    const char* formula;
    const char* printed;
    const char* source;
};

constexpr KnownResult k_known[] = {
    {"-2^2", "4", "operator precedence: negation before exponentiation"},
    {"2^3^2", "64", "arithmetic: (2^3)^2"},
    {"0-2^2", "-4", "arithmetic: 0 - 4"},
    {"1*(0.5-0.4-0.1)", "-2.77556E-17", "Floating-point arithmetic may give inaccurate results: in brackets"},
    {"0.5-0.4-0.1", "0", "the same: the last operation of a formula"},
    {"\"5\"+1", "6", "text that is a number, in arithmetic"},
    {"TRUE+1", "2", "TRUE is 1"},
    {"ABS(-4)", "4", "ABS"},
    {"ACOS(-0.5)", "2.094395102", "ACOS"},
    {"ACOSH(10)", "2.9932228", "ACOSH"},
    {"ASIN(-0.5)", "-0.523598776", "ASIN"},
    {"ASINH(-2.5)", "-1.647231146", "ASINH"},
    {"ATAN(1)", "0.785398163", "ATAN"},
    {"ATAN2(1,1)", "0.785398163", "ATAN2: x first, y second"},
    {"ATAN2(-1,-1)", "-2.35619449", "ATAN2"},
    {"ATAN2(1,2)", "1.107148718", "arithmetic: atan(2/1), x first"},
    {"ATANH(-0.1)", "-0.100335348", "ATANH"},
    {"AVERAGE(10,7,9,27,2)", "11", "AVERAGE"},
    {"CEILING(2.5,1)", "3", "CEILING"},
    {"CEILING(-2.5,-2)", "-4", "CEILING"},
    {"CEILING(-2.5,2)", "-2", "CEILING"},
    {"CEILING(1.5,0.1)", "1.5", "CEILING"},
    {"CEILING(0.234,0.01)", "0.24", "CEILING"},
    {"CHIINV(0.050001,10)", "18.306973", "CHIINV"},
    {"CHISQ.INV.RT(0.050001,10)", "18.306973", "CHISQ.INV.RT"},
    {"CHISQ.INV(0.6,2)", "1.832581464", "CHISQ.INV: -2 ln 0.4"},
    {"CORREL({3,2,4,5,6},{9,7,12,15,17})", "0.997054486", "CORREL"},
    {"COS(1.047)", "0.5001711", "COS"},
    {"COSH(4)", "27.308233", "COSH"},
    {"COVAR({3,2,4,5,6},{9,7,12,15,17})", "5.2", "COVAR"},
    {"COVARIANCE.S({2,4,8},{5,11,12})", "9.666666667", "COVARIANCE.S"},
    {"DATE(2008,1,1)", "39448", "DATE: 1 January 2008 is day 39448"},
    {"DATEVALUE(\"2011-02-23\")", "40597", "DATEVALUE of 2011/02/23"},
    {"YEAR(39448)+MONTH(39448)/100", "2008.01", "DATE, back"},
    {"DAY(40597)", "23", "DATEVALUE, back"},
    {"DEGREES(PI())", "180", "DEGREES"},
    {"DEVSQ(4,5,8,7,11,4,3)", "48", "DEVSQ"},
    {"EXP(1)", "2.71828183", "EXP"},
    {"EXP(2)", "7.3890561", "EXP"},
    {"F.INV.RT(0.01,6,4)", "15.20686", "F.INV.RT"},
    {"FINV(0.01,6,4)", "15.206865", "FINV"},
    {"FLOOR(3.7,2)", "2", "FLOOR"},
    {"FLOOR(-2.5,-2)", "-2", "FLOOR"},
    {"FLOOR(1.58,0.1)", "1.5", "FLOOR"},
    {"FLOOR(0.234,0.01)", "0.23", "FLOOR"},
    {"FORECAST(30,{6,7,9,15,21},{20,28,31,38,40})", "10.607253", "FORECAST"},
    {"INT(8.9)", "8", "INT"},
    {"INT(-8.9)", "-9", "INT"},
    {"INTERCEPT({2,3,9,1,8},{6,5,11,7,5})", "0.0483871", "INTERCEPT"},
    {"LN(86)", "4.4543473", "LN"},
    {"LOG(10)", "1", "LOG"},
    {"LOG(8,2)", "3", "LOG"},
    {"LOG10(86)", "1.9345", "LOG10"},
    {"MEDIAN(1,2,3,4,5)", "3", "MEDIAN"},
    {"MEDIAN(1,2,3,4,5,6)", "3.5", "MEDIAN"},
    {"MOD(3,2)", "1", "MOD"},
    {"MOD(-3,2)", "1", "MOD: the sign of the divisor"},
    {"MOD(3,-2)", "-1", "MOD"},
    {"MOD(-3,-2)", "-1", "MOD"},
    {"MROUND(10,3)", "9", "MROUND"},
    {"MROUND(-10,-3)", "-9", "MROUND"},
    {"MROUND(1.3,0.2)", "1.4", "MROUND"},
    {"NORM.DIST(42,40,1.5,TRUE)", "0.9087888", "NORM.DIST"},
    {"NORM.DIST(42,40,1.5,FALSE)", "0.10934", "NORM.DIST"},
    {"NORM.INV(0.908789,40,1.5)", "42.000002", "NORM.INV"},
    {"NORMINV(0.908789,40,1.5)", "42.000002", "NORMINV"},
    {"NORM.S.DIST(1.333333,TRUE)", "0.908788726", "NORM.S.DIST"},
    {"NORM.S.DIST(1.333333,FALSE)", "0.164010148", "NORM.S.DIST"},
    {"NORM.S.INV(0.908789)", "1.3333347", "NORM.S.INV"},
    {"NORMSDIST(1.333333)", "0.908788726", "NORMSDIST"},
    {"NORMSINV(0.9088)", "1.3334", "NORMSINV"},
    {"POWER(5,2)", "25", "POWER"},
    {"POWER(98.6,3.2)", "2401077.222", "POWER"},
    {"POWER(4,5/4)", "5.656854249", "POWER"},
    {"PRODUCT(5,15,30)", "2250", "PRODUCT"},
    {"RADIANS(270)", "4.712389", "RADIANS"},
    {"ROUND(2.15,1)", "2.2", "ROUND: the double next to 2.15 lies below it"},
    {"ROUND(2.149,1)", "2.1", "ROUND"},
    {"ROUND(-1.475,2)", "-1.48", "ROUND"},
    {"ROUND(21.5,-1)", "20", "ROUND"},
    {"ROUND(626.3,-3)", "1000", "ROUND"},
    {"ROUND(1.98,-1)", "0", "ROUND"},
    {"ROUND(-50.55,-2)", "-100", "ROUND"},
    {"ROUND(9.96,1)", "10", "arithmetic: a carry through all digits"},
    {"ROUNDDOWN(76.9,0)", "76", "ROUNDDOWN"},
    {"ROUNDDOWN(3.14159,3)", "3.141", "ROUNDDOWN"},
    {"ROUNDDOWN(-3.14159,1)", "-3.1", "ROUNDDOWN"},
    {"ROUNDDOWN(31415.92654,-2)", "31400", "ROUNDDOWN"},
    {"ROUNDUP(3.2,0)", "4", "ROUNDUP"},
    {"ROUNDUP(3.14159,3)", "3.142", "ROUNDUP"},
    {"ROUNDUP(-3.14159,1)", "-3.2", "ROUNDUP"},
    {"ROUNDUP(31415.92654,-2)", "31500", "ROUNDUP"},
    {"ROUNDUP(0.25,2)", "0.25", "arithmetic: nothing is cut off"},
    {"RSQ({2,3,9,1,8,7,5},{6,5,11,7,5,4,4})", "0.05795", "RSQ"},
    {"SIGN(-0.00001)", "-1", "SIGN"},
    {"SIN(30*PI()/180)", "0.5", "SIN"},
    {"SINH(1)", "1.1752012", "SINH"},
    {"SLOPE({2,3,9,1,8,7,5},{6,5,11,7,5,4,4})", "0.305556", "SLOPE"},
    {"SQRT(16)", "4", "SQRT"},
    {"SQRTPI(1)", "1.772454", "SQRTPI"},
    {"SQRTPI(2)", "2.506628", "SQRTPI"},
    {"STDEV(1345,1301,1368,1322,1310,1370,1318,1350,1303,1299)", "27.46391572", "STDEV"},
    {"STDEV.S(1345,1301,1368,1322,1310,1370,1318,1350,1303,1299)", "27.46391572", "STDEV.S"},
    {"STDEVP(1345,1301,1368,1322,1310,1370,1318,1350,1303,1299)", "26.05455814", "STDEVP"},
    {"STEYX({2,3,9,1,8,7,5},{6,5,11,7,5,4,4})", "3.305719", "STEYX"},
    {"SUM({1,2;3,4}*2)", "20", "arithmetic: 2 + 4 + 6 + 8"},
    {"SUMPRODUCT({3,4;8,6;1,9},{2,7;6,7;5,3})", "156", "SUMPRODUCT: 6 + 28 + 48 + 42 + 5 + 27"},
    {"SUMSQ(3,4)", "25", "SUMSQ"},
    {"SUMXMY2({2,3,9,1,8,7,5},{6,5,11,7,5,4,4})", "79", "SUMXMY2"},
    {"T.DIST(60,1,TRUE)", "0.99469533", "T.DIST"},
    {"T.DIST(8,3,FALSE)", "0.00073691", "T.DIST"},
    {"T.DIST.2T(1.959999998,60)", "0.05464493", "T.DIST.2T"},
    {"T.INV(0.75,2)", "0.8164966", "T.INV"},
    {"T.INV.2T(0.546449,60)", "0.606533", "T.INV.2T"},
    {"TAN(0.785)", "0.99920", "TAN"},
    {"TANH(-2)", "-0.964028", "TANH"},
    {"TDIST(1.959999998,60,2)", "0.054645", "TDIST"},
    {"TDIST(1.959999998,60,1)", "0.027322", "TDIST"},
    {"TINV(0.054645,60)", "1.96", "TINV"},
    {"TINV(1-0.9545,10.9)", "2.28", "JCGM 100:2008, table G.2, 10 degrees of freedom: cut to a whole number"},
    {"TRUNC(8.9)", "8", "TRUNC"},
    {"TRUNC(-8.9)", "-8", "TRUNC"},
    {"VAR(1345,1301,1368,1322,1310,1370,1318,1350,1303,1299)", "754.2667", "VAR"},
    {"VARP(1345,1301,1368,1322,1310,1370,1318,1350,1303,1299)", "678.84", "VARP: 9/10 of VAR"},
    {"LOOKUP(\"C\",{\"a\",\"b\",\"c\",\"d\";1,2,3,4})", "3", "LOOKUP"},
    {"LOOKUP(\"bump\",{\"a\",1;\"b\",2;\"c\",3})", "2", "LOOKUP"},
    {"MATCH(39,{25,38,40,41},1)", "2", "MATCH"},
    {"MATCH(41,{25,38,40,41},0)", "4", "MATCH"},
    {"INDEX({1,2;3,4},2,2)", "4", "INDEX"},
};

TEST(EvaluateWorkbook, GivesKnownResults) {
    EXPECT_GE(std::size(k_known), 60U);
    for (const KnownResult& known : k_known) {
        const PrintedNumber expected = printed_number(known.printed);
        EXPECT_NEAR(number_of_formula(known.formula), expected.value, expected.half_unit * (1 + 1e-9))
            << known.formula << " (" << known.source << ")";
    }
}

TEST(EvaluateWorkbook, GivesTextsAndErrorsOfSpreadsheets) {
    const struct {
        const char* formula;
        const char* value;
    } cases[] = {
        {"HLOOKUP(3,{1,2,3;\"a\",\"b\",\"c\";\"d\",\"e\",\"f\"},2,TRUE)", "\"c\""},  // page of HLOOKUP
        {"CHOOSE(2,\"1st\",\"2nd\",\"3rd\")", "\"2nd\""},
        {"FLOOR(2.5,-2)", "#NUM!"},  // page of FLOOR
        {"MROUND(5,-2)", "#NUM!"},   // page of MROUND
        {"SQRT(-16)", "#NUM!"},      // page of SQRT
        {"\"abc\"+1", "#VALUE!"},
        {"-\"abc\"", "#VALUE!"},
        {"1/0", "#DIV/0!"},
        {"0^0", "#NUM!"},
        {"0^-1", "#DIV/0!"},
        {"(-8)^(1/3)", "#NUM!"},
        {"LN(0)", "#NUM!"},
        {"EXP(1000)", "#NUM!"},
        {"ASIN(2)", "#NUM!"},
        {"ATAN2(0,0)", "#DIV/0!"},
        {"MOD(1,0)", "#DIV/0!"},
        {"LOG(5,1)", "#DIV/0!"},
        {"TINV(0,5)", "#NUM!"},
        {"TINV(0.05,0.5)", "#NUM!"},
        {"NORMSINV(1)", "#NUM!"},
        {"STDEV(5)", "#DIV/0!"},
        {"VARP()", "not evaluated: VARP with 0 arguments"},
        {"unknown_name", "#NAME?"},
        {"Nowhere!A1", "#REF!"},
        {"#REF!+1", "#REF!"},
        {"#N/A+#REF!", "#N/A"},
        {"NA()", "#N/A"},
        {"IFERROR(1/0,\"none\")", "\"none\""},
        {"IFERROR(5,1/0)", "5.000000"},
        {"IFNA(1/0,1)", "#DIV/0!"},
        {"IF(TRUE,1,1/0)", "1.000000"},
        {"IF(FALSE,1)", "FALSE"},
        {"IF(0,1,)", "0.000000"},
        {"IF(\"x\",1,2)", "#VALUE!"},
        {"AND(TRUE,1,5>4)", "TRUE"},
        {"OR(FALSE,0)", "FALSE"},
        {"NOT(1>2)", "TRUE"},
        {"AND(\"x\")", "#VALUE!"},
        {"ISERROR(1/0)", "TRUE"},
        {"ISNUMBER(\"5\")", "FALSE"},
        {"ISNUMBER(1/0)", "FALSE"},
        {"1&\"a\"&TRUE&0.1", "\"1aTRUE0.1\""},
        {"\"A\"=\"a\"", "TRUE"},
        {"\"10\"<5", "FALSE"},   // numbers before texts
        {"TRUE>\"z\"", "TRUE"},  // texts before truth values
        {"VLOOKUP(2,{1,\"a\";2,\"b\"},3,FALSE)", "#REF!"},
        {"VLOOKUP(9,{1,\"a\";2,\"b\"},2,FALSE)", "#N/A"},
        {"VLOOKUP(9,{1,\"a\";2,\"b\"},2)", "\"b\""},
        {"VLOOKUP(0,{1,\"a\";2,\"b\"},2)", "#N/A"},
        {"CHOOSE(4,1,2,3)", "#VALUE!"},
        {"INDEX({1,2;3,4},3,1)", "#REF!"},
        {"SUMPRODUCT({1,2},{1;2})", "#VALUE!"},
        {"SLOPE({1,2},{3,3})", "#DIV/0!"},
        {"SLOPE({1,2},{3,3,3})", "#N/A"},
    };
    for (const auto& one : cases) {
        EXPECT_EQ(value_of_formula(one.formula), one.value) << one.formula;
    }
}

TEST(EvaluateWorkbook, LeavesTextInRangesOut) {
    const Contents readings{{"A1", "800.8"}, {"A2", "800.9"}, {"A3", "TRUE"}, {"A4", "800.0.2"}, {"A6", "801.0"}};
    EXPECT_EQ(value_of_formula("SUM(A1:A6)", readings), "2402.700000");
    EXPECT_EQ(value_of_formula("COUNT(A1:A6)", readings), "3.000000");
    EXPECT_EQ(value_of_formula("COUNTA(A1:A6)", readings), "5.000000");
    EXPECT_EQ(value_of_formula("AVERAGE(A1:A6)", readings), "800.900000");
    EXPECT_EQ(value_of_formula("STDEV(A1:A6)", readings), "0.100000");
    EXPECT_EQ(value_of_formula("AVERAGEA(A1:A6)", readings), "480.740000") << "(2402.7 + 1 + 0) / 5";
    EXPECT_EQ(value_of_formula("MAX(A4:A5)", readings), "0.000000") << "no number at all";
    EXPECT_EQ(value_of_formula("A4+1", readings), "not evaluated: a text in place of a number");
    EXPECT_EQ(value_of_formula("A5+1", readings), "1.000000") << "blank is 0";
    EXPECT_EQ(value_of_formula("A5", readings), "0.000000");
    EXPECT_EQ(value_of_formula("ISBLANK(A5)", readings), "TRUE");
    EXPECT_EQ(value_of_formula("SUM(A:A)", readings), "2402.700000");
    EXPECT_EQ(value_of_formula("SUM(A3,A1)", readings), "800.800000") << "a truth value in a cell is none of SUM's";
    EXPECT_EQ(value_of_formula("SUM(TRUE,A1)", readings), "801.800000");
}

TEST(EvaluateWorkbook, FollowsReferencesInAnyOrder) {
    EXPECT_EQ(evaluated({{"A1", "=B1+1"}, {"B1", "=C2*2"}, {"A2", "=SUM(A1:B1)"}, {"C2", "21"}}, "A2"), "85.000000");
    Workbook workbook = test::workbook_of({{"A1", "=Budget!B2+'My data'!A1"}});
    workbook.sheets.push_back(test::sheet_of("budget", {{"B2", "=u_ref*k"}}));
    workbook.sheets.push_back(test::sheet_of("My data", {{"A1", "0.5"}}));
    workbook.defined_names = {{.name = "U_REF", .formula = "'My data'!$A$1", .sheet = {}},
                              {.name = "k", .formula = "2", .sheet = {}},
                              {.name = "k", .formula = "3", .sheet = 1},
                              {.name = "moves", .formula = "budget!B2", .sheet = {}}};
    const Evaluation evaluation = evaluate_workbook(workbook);
    EXPECT_EQ(test::shown(evaluation, workbook, find_evaluated(evaluation, workbook, 0, {1, 1})), "2.000000");
    workbook.sheets[0].cells[0].formula = "moves";
    const Evaluation other = evaluate_workbook(workbook);
    EXPECT_EQ(test::shown(other, workbook, &other.cells[0]),
              "not evaluated: a name that means another cell in each cell");
}

TEST(EvaluateWorkbook, TakesTheCellBesideOfARange) {
    const Contents column{{"A1", "1"}, {"A2", "2"}, {"B2", "=A1:A3*10"}, {"A3", "3"}, {"B9", "=A1:A3*10"}};
    EXPECT_EQ(evaluated(column, "B2"), "20.000000");
    EXPECT_EQ(evaluated(column, "B9"), "#VALUE!");
}

TEST(EvaluateWorkbook, ComputesArrayFormulasOfOneCell) {
    Workbook workbook = test::workbook_of({{"A1", "3"},
                                           {"B1", "=SQRT(SUM(A1:A3^2))"},
                                           {"A2", "4"},
                                           {"B2", "=SUM(IF(A1:A3>3,A1:A3))"},
                                           {"C2", "=A1:A2*2"}});
    for (Cell& cell : workbook.sheets[0].cells) {
        cell.formula_kind = cell.formula.empty() ? FormulaKind::none : FormulaKind::array;
    }
    workbook.sheets[0].array_ranges = {{{2, 3}, {3, 3}}};
    const Evaluation evaluation = evaluate_workbook(workbook);
    EXPECT_EQ(test::shown(evaluation, workbook, &evaluation.cells[0]), "5.000000");
    EXPECT_EQ(test::shown(evaluation, workbook, &evaluation.cells[1]), "4.000000");
    EXPECT_EQ(test::shown(evaluation, workbook, &evaluation.cells[2]),
              "not evaluated: an array formula over several cells");
    EXPECT_EQ(value_of_formula("SUMPRODUCT((A1:A3>1)*B1:B3)",
                               {{"A1", "1"}, {"B1", "5"}, {"A2", "2"}, {"B2", "6"}, {"A3", "3"}, {"B3", "7"}}),
              "13.000000");
    EXPECT_EQ(value_of_formula("SUMPRODUCT(A:A,B:B)", {{"A1", "2"}, {"B1", "5"}, {"A2", "3"}, {"B2", "6"}}),
              "28.000000");
}

TEST(EvaluateWorkbook, LooksUpInCells) {
    const Contents table{{"A1", "400"},   {"B1", "0.03"}, {"A2", "800"},
                         {"B2", "-0.14"}, {"A3", "1000"}, {"B3", "=B1*2"}};
    EXPECT_EQ(value_of_formula("VLOOKUP(900,A1:B3,2)", table), "-0.140000");
    EXPECT_EQ(value_of_formula("VLOOKUP(1000,A:B,2,0)", table), "0.060000");
    EXPECT_EQ(value_of_formula("INDEX(B1:B3,MATCH(800,A1:A3,0))", table), "-0.140000");
    EXPECT_EQ(value_of_formula("SUM(INDEX(A1:B3,0,2))", table), "-0.050000");
    EXPECT_EQ(value_of_formula("LOOKUP(850,A1:A3,B1:B3)", table), "-0.140000");
    EXPECT_EQ(value_of_formula("MATCH(800,A3:A3,1)", table), "#N/A");
    EXPECT_EQ(value_of_formula("MATCH(3,{5,1,4})"), "not evaluated: a lookup in a list that is not sorted");
    EXPECT_EQ(value_of_formula("MATCH(\"a*\",{\"ab\"},0)"), "not evaluated: a lookup with wildcards");
}

TEST(EvaluateWorkbook, NamesWhatItDoesNotCompute) {
    EXPECT_EQ(value_of_formula("OFFSET(A1,1,0)"), "not evaluated: OFFSET");
    EXPECT_EQ(evaluated({{"A1", "=TEXT(1,\"0.0\")"}, {"B1", "=IFERROR(A1,0)+SUM(A1:A9)"}, {"C1", "=B1"}}, "C1"),
              "not evaluated: TEXT in Sheet1!A1");
    EXPECT_EQ(value_of_formula("[1]Standards!B2*2"), "not evaluated: another workbook");
    EXPECT_EQ(value_of_formula("Table1[u]"), "not evaluated: a reference to a table");
    EXPECT_EQ(value_of_formula("SUM(Sheet1:Sheet1!A1)"), "not evaluated: a reference over several sheets");
    EXPECT_EQ(value_of_formula("LINEST({1,2},{3,4})"), "not evaluated: LINEST");
    EXPECT_EQ(value_of_formula("SUM((A1,B1))"), "not evaluated: references put together");
    EXPECT_EQ(value_of_formula("VALUE(\"$1,000\")"), "not evaluated: a text in place of a number");
    EXPECT_EQ(value_of_formula("1+"), "not evaluated: a formula that is not understood");
    EXPECT_EQ(value_of_formula("IF(TRUE,1,OFFSET(A1,1,0))"), "1.000000") << "what is not asked for is not missed";
    EXPECT_EQ(value_of_formula("0.1+0.2=0.3"), "not evaluated: a comparison that only rounding decides");
    EXPECT_EQ(value_of_formula("MATCH(0.1+0.2,{0.3},0)"), "not evaluated: a comparison that only rounding decides");
}

TEST(EvaluateWorkbook, KnowsTheFunctionsOfBudgets) {
    for (const char* const name :
         {"SUM",       "SUMSQ",        "SUMPRODUCT", "SUMXMY2",   "SQRT",     "SQRTPI",    "AVERAGE", "AVERAGEA",
          "MEDIAN",    "STDEV",        "STDEV.S",    "STDEVA",    "STDEV.P",  "STDEVP",    "VAR",     "VAR.S",
          "VAR.P",     "VARP",         "DEVSQ",      "MIN",       "MAX",      "COUNT",     "COUNTA",  "IF",
          "IFERROR",   "AND",          "OR",         "NOT",       "ISNUMBER", "ISBLANK",   "ISERROR", "ABS",
          "SIGN",      "ROUND",        "ROUNDUP",    "ROUNDDOWN", "CEILING",  "FLOOR",     "TRUNC",   "INT",
          "MROUND",    "MOD",          "EXP",        "LN",        "LOG",      "LOG10",     "POWER",   "PI",
          "SIN",       "COS",          "TAN",        "ASIN",      "ACOS",     "ATAN",      "ATAN2",   "SINH",
          "COSH",      "TANH",         "DEGREES",    "RADIANS",   "PRODUCT",  "LOOKUP",    "VLOOKUP", "HLOOKUP",
          "MATCH",     "INDEX",        "CHOOSE",     "TINV",      "T.INV",    "T.INV.2T",  "TDIST",   "T.DIST",
          "T.DIST.2T", "NORMSINV",     "NORM.S.INV", "NORMINV",   "NORM.INV", "NORMSDIST", "CHIINV",  "CHISQ.INV.RT",
          "FINV",      "F.INV.RT",     "SLOPE",      "INTERCEPT", "CORREL",   "RSQ",       "STEYX",   "FORECAST",
          "COVAR",     "COVARIANCE.S", "VALUE",      "DATE",      "YEAR",     "MONTH",     "DAY"}) {
        EXPECT_TRUE(is_evaluated_function(name)) << name;
    }
    for (const char* const name : {"OFFSET", "INDIRECT", "LINEST", "TREND", "TEXT", "NOW", "sum", ""}) {
        EXPECT_FALSE(is_evaluated_function(name)) << name;
    }
}

TEST(EvaluateWorkbook, NamesCircles) {
    const Contents circle{{"A1", "=B1"}, {"B1", "=C1+1"}, {"C1", "=SUM(A1:A3)"},
                          {"D1", "=A1"}, {"E1", "=E1"},   {"F1", "=1"}};
    for (const char* const address : {"A1", "B1", "C1", "E1"}) {
        EXPECT_EQ(evaluated(circle, address).rfind("not evaluated: a circular reference", 0), 0U) << address;
    }
    EXPECT_EQ(evaluated(circle, "D1"), "not evaluated: a circular reference in Sheet1!A1");
    EXPECT_EQ(evaluated(circle, "F1"), "1.000000");
    Workbook names = test::workbook_of({{"A1", "=x"}});
    names.defined_names = {{.name = "x", .formula = "y+1", .sheet = {}}, {.name = "y", .formula = "x+1", .sheet = {}}};
    const Evaluation evaluation = evaluate_workbook(names);
    EXPECT_EQ(test::shown(evaluation, names, &evaluation.cells[0]), "not evaluated: a circular reference");
}

TEST(EvaluateWorkbook, TakesTheStoredValueOfVolatileFunctions) {
    Workbook workbook = test::workbook_of({{"A1", "=NOW()-1"}, {"B1", "=A1*2"}, {"C1", "=IF(FALSE,RAND(),3)"}});
    workbook.sheets[0].cells[0].value = {.kind = CellKind::number, .number = 45000.5};
    workbook.sheets[0].cells[1].value = {.kind = CellKind::number, .number = 90001.0};
    const Evaluation evaluation = evaluate_workbook(workbook);
    EXPECT_EQ(evaluation.cells[0].state, EvaluationState::volatile_value);
    EXPECT_EQ(evaluation.cells[0].agreement, Agreement::not_compared);
    EXPECT_EQ(evaluation.cells[1].value.number, 90001.0);
    EXPECT_EQ(evaluation.cells[1].state, EvaluationState::volatile_value) << "it reads one";
    EXPECT_EQ(evaluation.cells[1].agreement, Agreement::agrees);
    EXPECT_EQ(evaluation.cells[2].state, EvaluationState::evaluated);
    EXPECT_EQ(value_of_formula("NOW()"), "not evaluated: NOW, which has no stored value");
}

TEST(EvaluateWorkbook, ComparesWithStoredValues) {
    Workbook workbook =
        test::workbook_of({{"A1", "=1/3"}, {"B1", "=1/3"}, {"C1", "=\"a\"&\"b\""}, {"D1", "=1/0"}, {"E1", "=1/3"}});
    std::vector<Cell>& cells = workbook.sheets[0].cells;
    cells[0].value = {.kind = CellKind::number, .number = 0.33333333333333331};
    cells[1].value = {.kind = CellKind::number, .number = 0.3333333};
    cells[2].value = {.kind = CellKind::text, .text = "ab"};
    cells[3].value = {.kind = CellKind::number, .number = 5};
    const auto agreement = [&](std::size_t cell, double tolerance) {
        return evaluate_workbook(workbook, {.relative_tolerance = tolerance}).cells.at(cell).agreement;
    };
    EXPECT_EQ(agreement(0, 1e-9), Agreement::agrees);
    EXPECT_EQ(agreement(1, 1e-9), Agreement::differs);
    EXPECT_EQ(agreement(1, 1e-6), Agreement::agrees);
    EXPECT_EQ(agreement(2, 1e-9), Agreement::agrees);
    EXPECT_EQ(agreement(3, 1e-9), Agreement::differs) << "an error where a number was stored";
    EXPECT_EQ(agreement(4, 1e-9), Agreement::nothing_stored);
}

TEST(EvaluateWorkbook, CountsDaysFromTheDayOfTheWorkbook) {
    EXPECT_EQ(value_of_formula("DATE(1900,2,28)"), "59.000000");
    EXPECT_EQ(value_of_formula("DATE(1900,3,1)"), "61.000000");
    EXPECT_EQ(value_of_formula("DAY(60)"), "not evaluated: a day that there was not");
    EXPECT_EQ(value_of_formula("DATE(2024,14,0)"), "45688.000000") << "the day before 2025-02-01";
    Workbook mac = test::workbook_of({{"A1", "=DATE(1904,1,2)"}, {"B1", "=YEAR(0)"}});
    mac.metadata.dates_from_1904 = true;
    const Evaluation evaluation = evaluate_workbook(mac);
    EXPECT_EQ(evaluation.cells[0].value.number, 1.0);
    EXPECT_EQ(evaluation.cells[1].value.number, 1904.0);
}

// Workbooks that are made to take all the time and memory there is.

TEST(HostileWorkbook, ALongChainOfCellsIsComputed) {
    Workbook workbook = test::workbook_of({});
    constexpr std::uint32_t k_length = 200'000;
    for (std::uint32_t row = 1; row <= k_length; ++row) {  // each reads the one below, the last one first
        Cell cell;
        cell.address = {row, 1};
        cell.formula = row == k_length ? "1" : "A" + std::to_string(row + 1) + "+1";
        cell.formula_kind = FormulaKind::plain;
        workbook.sheets[0].cells.push_back(std::move(cell));
    }
    EXPECT_EQ(evaluate_workbook(workbook).cells[0].value.number, k_length);
}

TEST(HostileWorkbook, WorkHasAnEnd) {
    Contents sums;
    for (int row = 1; row <= 5000; ++row) {
        sums.emplace_back("A" + std::to_string(row), "1");
        sums.emplace_back("B" + std::to_string(row), "=SUM(A$1:A$5000)");
    }
    const Workbook workbook = test::workbook_of(sums);
    const Evaluation evaluation = evaluate_workbook(workbook, {.most_steps = 1'000'000});
    EXPECT_EQ(evaluation.cells.front().value.number, 5000.0);
    EXPECT_THAT(test::shown(evaluation, workbook, &evaluation.cells.back()),
                testing::StartsWith("not evaluated: more work than a workbook is given"));
}

TEST(HostileWorkbook, TextsAndNamesDoNotGrowWithoutEnd) {
    Contents doubling{{"A1", "x"}};
    for (int row = 2; row <= 60; ++row) {
        const std::string above = "A" + std::to_string(row - 1);
        doubling.emplace_back("A" + std::to_string(row), "=" + above + "&" + above);
    }
    EXPECT_EQ(evaluated(doubling, "A60"), "#VALUE!");
    Workbook laughs = test::workbook_of({{"A1", "=name_0"}});
    for (int i = 0; i < 60; ++i) {
        const std::string next = "name_" + std::to_string(i + 1);
        laughs.defined_names.push_back(
            {.name = "name_" + std::to_string(i), .formula = i == 59 ? "1" : next + "+" + next, .sheet = {}});
    }
    EXPECT_EQ(evaluate_workbook(laughs).cells[0].value.number, std::ldexp(1.0, 59));
}

TEST(HostileWorkbook, FormulasOfAnyShapeAreComputed) {
    std::string long_sum = "1";
    for (int i = 0; i < 4000; ++i) {
        long_sum += "+1";
    }
    EXPECT_EQ(value_of_formula(long_sum), "4001.000000");
    std::string percents = "1";
    for (int i = 0; i < 60; ++i) {
        percents = "(" + percents + std::string(static_cast<std::size_t>(i + 1), '%') + ")";
    }
    EXPECT_EQ(value_of_formula(percents), "0.000000");
    EXPECT_EQ(value_of_formula("SUMPRODUCT((A:A=1)*1)"),
              "not evaluated: arithmetic with a range of more than 500000 cells");
    EXPECT_EQ(value_of_formula("SUM(1:1048576)"), "not evaluated: a circular reference")
        << "it lies in the range itself";
    EXPECT_EQ(value_of_formula("ROUND(1,-1E300)+ROUNDUP(5,1E300)"), "5.000000");
    EXPECT_EQ(value_of_formula("DATE(9999,1E9,1)"), "#NUM!");
}

}  // namespace
}  // namespace gumcert::workbook
