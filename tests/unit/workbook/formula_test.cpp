#include "workbook/formula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "gum/quantity/diagnostic.h"
#include "workbook/formula_text.h"

namespace gumcert::workbook {
namespace {

using testing::StartsWith;

/// The tree with all of its brackets: "(1+(2*3))", "SUM[A1:B2;3]".
std::string tree_of(const Formula& formula, std::uint32_t place) {
    const FormulaNode& node = formula.nodes[place];
    const auto child = [&](std::size_t i) { return tree_of(formula, formula.children_of(node)[i]); };
    if (is_binary(node.kind)) {
        static const char* const k_signs[] = {"^", "*",  "/", "+",  "-", "&", "=", "<>",
                                              "<", "<=", ">", ">=", ":", "_", "u"};
        return "(" + child(0) + k_signs[static_cast<int>(node.kind) - static_cast<int>(FormulaNodeKind::power)] +
               child(1) + ")";
    }
    switch (node.kind) {
        case FormulaNodeKind::negate:
            return "neg(" + child(0) + ")";
        case FormulaNodeKind::percent:
            return "pct(" + child(0) + ")";
        case FormulaNodeKind::missing:
            return "none";
        case FormulaNodeKind::call: {
            std::string text = node.text + "[";
            for (std::uint32_t i = 0; i < node.children; ++i) {
                text += (i > 0 ? ";" : "") + child(i);
            }
            return text + "]";
        }
        default: {
            Formula one;
            one.references = formula.references;
            one.children = formula.children;
            one.nodes.assign(formula.nodes.begin(), formula.nodes.begin() + place + 1);
            return print_formula(one);
        }
    }
}

std::string tree(const std::string& text) {
    const Formula formula = parse_formula(text, "A1");
    return tree_of(formula, formula.root());
}

std::string formula_refusal(const std::string& text) {
    try {
        static_cast<void>(parse_formula(text, "Budget!C3"));
    } catch (const gum::InputError& error) {
        return error.diagnostics().front().code + " " + gum::message(error.diagnostics().front());
    }
    return "accepted";
}

TEST(ParseFormula, BindsAsSpreadsheetsDo) {
    EXPECT_EQ(tree("1+2*3"), "(1+(2*3))");
    EXPECT_EQ(tree("-2^2"), "(neg(2)^2)") << "a sign binds closer than a power";
    EXPECT_EQ(tree("2^-2"), "(2^neg(2))");
    EXPECT_EQ(tree("2^3^2"), "((2^3)^2)") << "powers go from the left";
    EXPECT_EQ(tree("1-2-3"), "((1-2)-3)");
    EXPECT_EQ(tree("10%^2"), "(pct(10)^2)");
    EXPECT_EQ(tree("-5%"), "neg(pct(5))");
    EXPECT_EQ(tree("1+2&3*4=5"), "(((1+2)&(3*4))=5)");
    EXPECT_EQ(tree("1<=2<>TRUE"), "((1<=2)<>TRUE)");
    EXPECT_EQ(tree("=(1+2)*3"), "((1+2)*3)");
    EXPECT_EQ(tree(" 1 +\n2 "), "(1+2)");
}

TEST(ParseFormula, ReadsReferences) {
    const auto reference = [](const std::string& text) {
        const Formula formula = parse_formula(text, "A1");
        EXPECT_EQ(formula.references.size(), 1U) << text;
        return formula.references.at(0);
    };
    EXPECT_EQ(area(reference("B5")), (CellRange{{5, 2}, {5, 2}}));
    const Reference mixed = reference("$B5:C$9");
    EXPECT_TRUE(mixed.first.column_is_absolute && !mixed.first.row_is_absolute);
    EXPECT_TRUE(!mixed.last.column_is_absolute && mixed.last.row_is_absolute);
    EXPECT_EQ(area(reference("C9:B5")), (CellRange{{5, 2}, {9, 3}})) << "corners in order";
    EXPECT_EQ(reference("A:$C").shape, ReferenceShape::columns);
    EXPECT_EQ(area(reference("A:$C")), (CellRange{{1, 1}, {k_most_rows, 3}}));
    EXPECT_EQ(area(reference("$2:3")), (CellRange{{2, 1}, {3, k_most_columns}}));
    EXPECT_EQ(reference("Budget!B5").sheet, "Budget");
    EXPECT_EQ(reference("'Bob''s sheet'!B5").sheet, "Bob's sheet");
    EXPECT_EQ(reference("[1]Old!B5").workbook, "1");
    EXPECT_EQ(reference("'[2024 standards.xlsx]U 95'!$B$5").workbook, "2024 standards.xlsx");
    EXPECT_EQ(reference("'[2024 standards.xlsx]U 95'!$B$5").sheet, "U 95");
    EXPECT_EQ(reference("Jan:Dec!B5").last_sheet, "Dec");
    EXPECT_EQ(tree("LOG10(B5)+SIN1"), "(LOG10[B5]+SIN1)") << "SIN1 is a cell, LOG10( is a function";
    EXPECT_EQ(tree("A1:INDEX(A:A,3)"), "(A1:INDEX[A:A;3])");
    EXPECT_EQ(tree("SUM((A1,B2),A1:C3 B2:D4)"), "SUM[(A1uB2);(A1:C3_B2:D4)]");
}

TEST(ParseFormula, ReadsNamesTablesConstantsAndCalls) {
    EXPECT_EQ(tree("u_ref*k.2+Grösse"), "((u_ref*k.2)+Grösse)");
    EXPECT_EQ(tree("Table1[u]+Table1[[#All],[a b]]"), "(Table1[u]+Table1[[#All],[a b]])");
    EXPECT_EQ(tree("_xlfn.STDEV.S(A1:A3)"), "STDEV.S[A1:A3]");
    EXPECT_EQ(tree("if(A1,,2)"), "IF[A1;none;2]");
    EXPECT_EQ(tree("PI()"), "PI[]");
    EXPECT_EQ(tree("SUM({1,-2;3,\"x\"})"), "SUM[{1,-2;3,\"x\"}]");
    EXPECT_EQ(tree("\"say \"\"x\"\"\"&TRUE"), "(\"say \"\"x\"\"\"&TRUE)");
    EXPECT_EQ(tree("#N/A+Old!#REF!+1.5E-3"), "((#N/A+#REF!)+0.0015)");
    EXPECT_EQ(tree("@A1:A3"), "A1:A3");
}

TEST(ParseFormula, SaysWhereItDoesNotUnderstand) {
    EXPECT_THAT(formula_refusal("1+"),
                StartsWith("GC-WORKBOOK-0014 Budget!C3 — a value is missing at byte 3 of \"1+\""));
    EXPECT_THAT(formula_refusal("SUM(A1"), StartsWith("GC-WORKBOOK-0014 Budget!C3 — `)` is missing at byte 7"));
    for (const char* const bad : {"", "=", "1 2", "A1)", "\"x", "{1,2;3}", "{}", "'a", "'a'", "[1]", "1.5.2", "5e999",
                                  "$", "#XYZ", "1,2", "Sheet1!", "T[a", "!A1", "{A1}"}) {
        EXPECT_THAT(formula_refusal(bad), StartsWith("GC-WORKBOOK-0014")) << bad;
    }
}

TEST(ParseFormula, HasLimits) {
    EXPECT_EQ(formula_refusal("1" + std::string(8191, ' ')), "accepted");
    EXPECT_THAT(formula_refusal("1" + std::string(8192, ' ')),
                StartsWith("GC-WORKBOOK-0013 Budget!C3 — a formula of 8193 bytes"));
    EXPECT_EQ(formula_refusal(std::string(64, '(') + "1" + std::string(64, ')')), "accepted");
    for (const char c : {'(', '-', '+', '@'}) {
        EXPECT_THAT(formula_refusal(std::string(8000, c)), StartsWith("GC-WORKBOOK-0015")) << c;
    }
    EXPECT_THAT(formula_refusal("1" + std::string(65, '%')), StartsWith("GC-WORKBOOK-0015"));
    std::string calls;
    for (int i = 0; i < 65; ++i) {
        calls += "SUM(";
    }
    EXPECT_THAT(formula_refusal(calls), StartsWith("GC-WORKBOOK-0015"));
    std::string long_sum = "1";
    for (int i = 0; i < 4000; ++i) {
        long_sum += "+1";
    }
    EXPECT_EQ(formula_refusal(long_sum), "accepted") << "a long sum is not deep";
}

TEST(SameFormula, LooksAtTheMeaningOnly) {
    EXPECT_TRUE(same_formula(parse_formula("1.0+ a", ""), parse_formula("1+A", "")));
    EXPECT_FALSE(same_formula(parse_formula("$A1", ""), parse_formula("A1", "")));
    EXPECT_FALSE(same_formula(parse_formula("SUM(A1)", ""), parse_formula("MAX(A1)", "")));
    EXPECT_FALSE(same_formula(parse_formula("{1,2}", ""), parse_formula("{1;2}", "")));
}

}  // namespace
}  // namespace gumcert::workbook
