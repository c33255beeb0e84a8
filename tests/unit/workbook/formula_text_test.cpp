#include "workbook/formula_text.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::workbook {
namespace {

std::string printed(const std::string& text) {
    return print_formula(parse_formula(text, "A1"));
}

TEST(PrintFormula, WritesNoBracketTooMany) {
    EXPECT_EQ(printed("((1+2))*(3*4)"), "(1+2)*(3*4)");
    EXPECT_EQ(printed("(1*2)+3"), "1*2+3");
    EXPECT_EQ(printed("-(2^2)"), "-(2^2)");
    EXPECT_EQ(printed("(-2)^2"), "-2^2");
    EXPECT_EQ(printed("2^(3^2)"), "2^(3^2)");
    EXPECT_EQ(printed("(-5)%"), "(-5)%");
    EXPECT_EQ(printed("1-(2-3)"), "1-(2-3)");
}

TEST(PrintFormula, MeansTheSameAsWhatWasRead) {
    for (const char* const text :
         {"SUM(A1:B$2,,{1,2;\"a\"\"b\",TRUE})%&\"x\"", "'My sheet'!A1+[1]Old!$B$5*'[a b.xlsx]U 95'!C:C",
          "Jan:Dec!A1-2:3", "A1:INDEX(A:A,3)", "SUM((A1,B2:C3),A1:C3 B2:D4)", "A1:(B2)", "a:(b)",
          "Table1[[#All],[u]]<>u_ref", "'C:\\x\\[b.xlsx]S'!A1", "--A1+-B1%", "IF(A1>=2,1,#N/A)",
          "[1]!u_ref+Sheet1!u_ref"}) {
        EXPECT_TRUE(same_formula(parse_formula(text, "A1"), parse_formula(printed(text), "A1"))) << printed(text);
    }
}

TEST(R1c1Text, IsTheSameForCopiesOfAFormula) {
    const auto r1c1 = [](const std::string& text, const CellAddress& at) {
        return r1c1_text(parse_formula(text, ""), at);
    };
    EXPECT_EQ(r1c1("E5*F5/$D$2", {5, 7}), "RC[-2]*RC[-1]/R2C4");
    EXPECT_EQ(r1c1("E5*F5/$D$2", {5, 7}), r1c1("E9*F9/$D$2", {9, 7}));
    EXPECT_NE(r1c1("E5*F5/$D$2", {5, 7}), r1c1("E9*F8/$D$2", {9, 7}));
    EXPECT_EQ(r1c1("SUM(Old!A1:$B2,C:C,$3:4)", {2, 2}), "SUM(Old!R[-1]C[-1]:RC2,C[1]:C[1],R3:R[2])");
}

TEST(CopiedFormula, MovesWhatIsRelative) {
    const std::string text = "SUM( A1:$B2 )*Old!C$3 + LOG10(D4)&\"A1\"";
    const auto copied = [&](const CellAddress& to) {
        return copied_formula(text, parse_formula(text, ""), {10, 10}, to);
    };
    EXPECT_EQ(copied({10, 10}), text);
    EXPECT_EQ(copied({12, 11}), "SUM( B3:$B4 )*Old!D$3 + LOG10(E6)&\"A1\"");
    EXPECT_EQ(copied({9, 10}), "SUM( A1048576:$B1 )*Old!C$3 + LOG10(D3)&\"A1\"") << "over the edge of the sheet";
}

TEST(LiteralNumbers, SayWhereTheyStand) {
    const Formula formula = parse_formula("C5/1.73+IF(A1>2,-0.50,{3,4})", "");
    const auto literals = literal_numbers(formula);
    ASSERT_EQ(literals.size(), 5U);
    EXPECT_EQ(literals[0].text, "1.73");
    EXPECT_EQ(formula.nodes[literals[0].parent].kind, FormulaNodeKind::divide);
    EXPECT_EQ(literals[0].argument, 1U);
    EXPECT_EQ(literals[2].text, "-0.50");
    EXPECT_EQ(literals[2].number, -0.5);
    EXPECT_EQ(formula.nodes[literals[2].parent].text, "IF");
    EXPECT_EQ(literals[2].argument, 1U);
    EXPECT_EQ(formula.nodes[literals[4].parent].kind, FormulaNodeKind::array);
    const Formula alone = parse_formula("-2", "");
    EXPECT_EQ(literal_numbers(alone).at(0).parent, alone.root()) << "nothing reads it";
}

}  // namespace
}  // namespace gumcert::workbook
