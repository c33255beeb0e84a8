#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "equations.h"
#include "gum/expression/syntax_tree.h"

namespace gumcert::gum {
namespace {

using testing::HasSubstr;

double value_of(const std::string& expression) {
    return system_of({"y = " + expression}, numbers({"a", "b", "c"})).evaluate(vector({2.0, 3.0, 5.0}))(0);
}

TEST(Grammar, PrecedenceAndAssociativity) {
    const std::vector<std::pair<std::string, double>> table{
        {"a + b*c", 17},
        {"a*b + c", 11},
        {"a - b - c", -6},
        {"a - (b - c)", 4},
        {"a/b/c", 2.0 / 3.0 / 5},
        {"a/(b/c)", 2 / 0.6},
        {"a*b/c", 6.0 / 5},
        {"a/b*c", 2.0 / 3.0 * 5},
        {"-a^2", -4},
        {"(-a)^2", 4},
        {"2^-1", 0.5},
        {"2^3^2", 512},
        {"(2^3)^2", 64},
        {"-2^-2", -0.25},
        {"2^-2^2", 0.0625},
        {"a*-b", -6},
        {"a - -b", 5},
        {"- - -a", -2},
        {"+a", 2},
        {"--a", 2},
        {"a*b^2", 18},
        {"-a*b", -6},
        {"2 - 3 + 4", 3},
        {".5*a", 1},
        {"5.*a", 10},
        {"1e3", 1000},
        {"1.5E-2", 0.015},
        {"1e+2", 100},
        {"pi", M_PI},
        {"log(a)", std::log(2)},
        {"ln(a)", std::log(2)},
        {"log10(1000)", 3},
        {"min(c, a, b)", 2},
        {"max(a, c, b)", 5},
        {"pow(a, b)", 8},
        {"hypot(b, 4)", 5},
        {"abs(-a)", 2},
        {"sqrt(4)", 2},
        {"exp(0)", 1},
        {"atan2(0, 1)/rad", 0},
        {"0^0", 1},
        {"a^0", 1},
        {"a^1", 2},
        {"sin(pi/2*rad)", 1},
        {"\t(\r\n a )", 2},
        {"celsius(0)/celsius(0)", 1},
    };
    for (const auto& [expression, expected] : table) {
        EXPECT_DOUBLE_EQ(value_of(expression), expected) << expression;
    }
}

TEST(Grammar, EveryProblemHasItsCodeAndColumn) {
    const std::string deep_parentheses = "y = " + std::string(201, '(') + "a";
    const std::vector<std::pair<std::string, std::string>> table{
        {"", "0001 m/0, column 1"},
        {"   ", "0001 m/0, column 1"},
        {"y", "0002 m/0, column 1"},
        {"y = a = b", "0002 m/0, column 7"},
        {"y = (a = b)", "0002 m/0, column 8"},
        {"a + b = c", "0003 m/0, column 1"},
        {"= a", "0003 m/0, column 1"},
        {"1 = a", "0003 m/0, column 1"},
        {"y =", "0004 m/0, column 4"},
        {"y = a +", "0004 m/0, column 8"},
        {"y = a * / b", "0004 m/0, column 9"},
        {"y = ()", "0004 m/0, column 6"},
        {"y = a, b", "0004 m/0, column 6"},
        {"y = (a + b", "0005 m/0, column 11"},
        {"y = a)", "0005 m/0, column 6"},
        {"y = a $ b", "0006 m/0, column 7"},
        {"y = a\x01", "0006 m/0, column 6"},
        {"y = a \u202e b", "0006 m/0, column 7"},
        {"y = a\u200b", "0006 m/0, column 6"},
        {"y = a \xff", "0007 m/0, column 7"},
        {"y = 1e999", "0008 m/0, column 5"},
        {"y = 1e-999", "0008 m/0, column 5"},
        {"y = 1.2.3", "0008 m/0, column 5"},
        {"y = 9007199254740993", "0008 m/0, column 5"},
        {"y = 1,5*a", "0009 m/0, column 6"},
        {"y = (1,5)*a", "0009 m/0, column 7"},
        {"y = 2a", "0010 m/0, column 6"},
        {"y = 2 a", "0010 m/0, column 7"},
        {"y = a b", "0010 m/0, column 7"},
        {"y = (a)(b)", "0010 m/0, column 8"},
        {"y = 1 000*a", "0010 m/0, column 7"},
        {"y = b*a(b + c)", "0010 m/0, column 8"},
        {"y = a**2", "0011 m/0, column 6"},
        {"y := a", "0011 m/0, column 3"},
        {"y = a − b", "0011 m/0, column 7"},
        {"y = a × b", "0011 m/0, column 7"},
        {"y = a²", "0011 m/0, column 6"},
        {"y = sine(a)", "0012 m/0, column 5"},
        {"y = sqrt()", "0013 m/0, column 5"},
        {"y = sqrt(1,5)", "0013 m/0, column 5"},
        {"y = min(a)", "0013 m/0, column 5"},
        {"y = hypot(a, b, c)", "0013 m/0, column 5"},
        {"y = a + аb", "0014 m/0, column 9"},  // the first letter is Cyrillic
        {"y = e\u0301", "0014 m/0, column 5"},
        {"y = \u0301", "0014 m/0, column 5"},
        {deep_parentheses, "0016 m/0, column 205"},
        {"y = sin + a", "0023 m/0, column 5"},
        {"sin = a", "0023 m/0, column 1"},
        {"pi = a", "0023 m/0, column 1"},
        {"y = é + d", "0020 m/0, column 5; 0020 m/0, column 9"},
    };
    for (const auto& [text, expected] : table) {
        EXPECT_EQ(codes(problems_of({text}, numbers({"a", "b", "c"}))), expected) << text;
    }
}

TEST(Grammar, ExcerptsAreShortAndCutNoCharacter) {
    SyntaxTree tree;
    const auto excerpt = [&](const std::string& text) {
        tree.text = text;
        return tree.excerpt({.begin = 0, .end = static_cast<std::uint32_t>(text.size())});
    };
    EXPECT_EQ(excerpt(std::string(44, 'a')), std::string(44, 'a'));
    EXPECT_EQ(excerpt(std::string(25, 'a') + std::string(20, 'b')),
              std::string(20, 'a') + " … " + std::string(20, 'b'));
    EXPECT_EQ(excerpt(std::string(19, 'a') + "é" + std::string(10, 'b') + "é" + std::string(19, 'c')),
              std::string(19, 'a') + " … " + std::string(19, 'c'));
}

TEST(Grammar, MessagesSayWhatToDo) {
    const std::vector<InputSymbol> inputs = numbers({"l_s", "alpha"});
    const auto text = [&](const std::string& equation) { return messages(problems_of({equation}, inputs)); };
    EXPECT_EQ(text("y = 2l_s"),
              "m/0, column 6 — \"2l_s\": an operator is missing — a product is written with \"*\" — Write 2*l_s.\n");
    EXPECT_EQ(text("y = l_s**2"), "m/0, column 8 — \"**\" — powers are written with \"^\" — Write \"^\" for \"**\".\n");
    EXPECT_THAT(text("y = 1,5*l_s"), HasSubstr("Write 1.5."));
    EXPECT_THAT(text("y = sqr(l_s)"), HasSubstr("Write sqrt(…)"));
    EXPECT_THAT(text("y = l_S"), HasSubstr("Write \"l_s\" if that is meant"));
    EXPECT_THAT(text("y = aplha"), HasSubstr("Write \"alpha\" if that is meant"));
    EXPECT_THAT(text("y = π*l_s"), HasSubstr("Write \"pi\"."));
    EXPECT_THAT(text("y = l_s²"), HasSubstr("Write \"^2\"."));
    EXPECT_THAT(text("y = sqrt(1,5)"), HasSubstr("the decimal sign is a point"));
    EXPECT_THAT(text("y = l_s(alpha)"), HasSubstr("Write l_s*(…)"));
}

TEST(Grammar, AllProblemsOfAllEquationsAtOnce) {
    EXPECT_EQ(codes(problems_of({"y = 2a + q**2", "z = (a", "w = a + m", "v = a^b^"}, numbers({"a"}))),
              "0010 m/0, column 6; 0011 m/0, column 11; 0005 m/1, column 7; 0004 m/3, column 9; 0020 m/0, column 10; "
              "0020 m/2, column 9");
    const std::vector<Diagnostic> problems =
        problems_of({"y = a$ b$ " + std::string("# $ ") + "# $ # $ # $ # $ # $ # $ # $ # $ # $ # $"}, numbers({"a"}));
    EXPECT_EQ(problems.size(), 21U);
    EXPECT_EQ(problems.back().code, "GC-MODEL-0018");
}

TEST(Grammar, LimitsHoldAgainstExhaustion) {
    const ExpressionLimits wide{.bytes = 10'000'000};
    const auto code = [&](const std::string& text) {
        return codes(problems_of({text}, numbers({"a"}), {}, {}, wide)).substr(0, 4);
    };
    EXPECT_EQ(code("y = " + std::string(1'000'000, '(')), "0016");
    EXPECT_EQ(code("y = " + std::string(1'000'000, '-') + "a"), "0016");
    EXPECT_EQ(code("y = a" + std::string(1'000'000, '+') + "a"), "0016");
    std::string powers = "y = a";
    std::string calls = "y = ";
    for (int i = 0; i < 1'000'000; ++i) {
        powers += "^a";
        calls += "sin(";
    }
    EXPECT_EQ(code(powers), "0016");
    EXPECT_EQ(code(calls), "0016");
    std::string sum = "y = a";
    for (int i = 0; i < 60'000; ++i) {
        sum += "+a";
    }
    EXPECT_EQ(code(sum), "0017");
    EXPECT_EQ(codes(problems_of({sum}, numbers({"a"}))), "0015 m/0, column 1");
    // Within the limits nothing is refused, however lopsided.
    EXPECT_EQ(codes(problems_of({sum.substr(0, 64'001)}, numbers({"a"}))), "");
    const std::string deepest = "y = " + std::string(200, '(') + "a" + std::string(200, ')');
    EXPECT_EQ(codes(problems_of({deepest}, numbers({"a"}))), "");
    EXPECT_EQ(codes(problems_of({"y = a + " + std::string(300, 'x')}, numbers({"a"}))).substr(0, 4), "0014");
}

TEST(Printing, HasTheFewestParentheses) {
    const std::vector<std::pair<std::string, std::string>> table{
        {"y=((a)+((b)*(c)))", "y = a + b*c"}, {"y=(a+b)*c", "y = (a + b)*c"},
        {"y=a-(b-c)", "y = a - (b - c)"},     {"y=(a-b)-c", "y = a - b - c"},
        {"y=a/(b*c)", "y = a/(b*c)"},         {"y=(a^b)^c", "y = (a^b)^c"},
        {"y=a^(b^c)", "y = a^b^c"},           {"y=a^(-b)", "y = a^-b"},
        {"y=(-a)^2", "y = (-a)^2"},           {"y=-(a^2)", "y = -a^2"},
        {"y=-(a*b)", "y = -(a*b)"},           {"y=(-a)*b", "y = -a*b"},
        {"y=pow(a+1,b)", "y = (a + 1)^b"},    {"y=log(a)", "y = ln(a)"},
        {"y=max(a,b,c)", "y = max(a, b, c)"}, {"y=max(a,max(b,c))", "y = max(a, max(b, c))"},
        {"0=1e3*pi-a", "0 = 1000*pi - a"},
    };
    for (const auto& [text, expected] : table) {
        EXPECT_EQ(equation_text({.text = text, .where = ""}), expected);
    }
}

/// A random expression with many needless parentheses.
std::string random_expression(std::mt19937& random, int depth) {
    static const std::vector<std::string> unary{"sqrt", "exp", "ln", "sin", "abs", "celsius"};
    static const std::vector<std::string> binary{"atan2", "min", "max", "hypot", "pow"};
    const auto pick = [&](std::size_t n) { return random() % n; };
    if (depth == 0) {
        static const std::vector<std::string> atoms{"a", "b", "c", "pi", "1", "2.5e-7", "0.1", "1e300"};
        return atoms[pick(atoms.size())];
    }
    const std::string x = random_expression(random, depth - 1);
    switch (pick(9)) {
        case 0:
            return "(" + x + ")";
        case 1:
            return "-" + x;
        case 2:
            return unary[pick(unary.size())] + "(" + x + ")";
        case 3:
            return binary[pick(binary.size())] + "(" + x + "," + random_expression(random, depth - 1) + ")";
        case 4:
            return "(" + x + ")^" + random_expression(random, 0);
        default:
            return "(" + x + ")" + "+-*/"[pick(4)] + "(" + random_expression(random, depth - 1) + ")";
    }
}

SyntaxTree tree_of(const std::string& text) {
    std::vector<Diagnostic> problems;
    SyntaxTree tree = parse_equation({.text = text, .where = ""}, {}, problems);
    EXPECT_EQ(messages(problems), "") << text;
    return tree;
}

TEST(Printing, IsReadAgainAsTheSameTree) {
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        const SyntaxTree tree = tree_of("y = " + random_expression(random, 1 + i % 7));
        const std::string printed = print_equation(tree);
        const SyntaxTree again = tree_of(printed);
        ASSERT_EQ(tree.nodes.size(), again.nodes.size()) << tree.text << "\n" << printed;
        EXPECT_EQ(tree.names, again.names);
        for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
            const SyntaxNode& a = tree.nodes[n];
            const SyntaxNode& b = again.nodes[n];
            ASSERT_TRUE(a.operation == b.operation && a.left == b.left && a.right == b.right && a.value == b.value &&
                        a.name == b.name)
                << tree.text << "\n"
                << printed << "\nnode " << n;
        }
    }
}

}  // namespace
}  // namespace gumcert::gum
