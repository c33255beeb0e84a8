#include "self_test/case_formula.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "gum/quantity/diagnostic.h"

namespace gumcert::self_test {
namespace {

CaseValue at(const std::string& path) {
    static const std::map<std::string, CaseValue> k_values{{"a", 2.0},
                                                           {"b/c", -3.0},
                                                           {"row", std::vector<double>{1.0, 2.0, 6.0}},
                                                           {"short", std::vector<double>{1.0, 2.0}},
                                                           {"text", std::string("0.1014")},
                                                           {"u", std::string("0.0018")},
                                                           {"yes", true},
                                                           {"infinite", std::numeric_limits<double>::infinity()}};
    const auto found = k_values.find(path);
    if (found == k_values.end()) {
        throw gum::InputError(gum::Diagnostic{"GC-SELF-0001", path, "nothing", "", "", gum::Severity::error});
    }
    return found->second;
}

CaseValue value(const std::string& formula) {
    return value_of_formula(formula, at);
}

double number(const std::string& formula) {
    return std::get<double>(value(formula));
}

TEST(CaseFormula, PathAloneIsWhatStandsThere) {
    EXPECT_EQ(number("b/c"), -3.0);
    EXPECT_EQ(std::get<std::string>(value("text")), "0.1014");
    EXPECT_TRUE(std::get<bool>(value("yes")));
    EXPECT_TRUE(std::isinf(number("infinite")));
}

TEST(CaseFormula, OperatorsBindAsInMathematics) {
    EXPECT_EQ(number("1 + 2 * {a} ^ 3"), 17.0);
    EXPECT_EQ(number("-{a}^2"), -4.0);
    EXPECT_EQ(number("2^-{a}"), 0.25);
    EXPECT_EQ(number("2 ^ 3 ^ {a}"), 512.0);
    EXPECT_EQ(number("8 / {a} / {a}"), 2.0);
    EXPECT_EQ(number("({a} - {b/c}) * 1e-3"), 5e-3);
    EXPECT_EQ(number("10 - {a} - 1"), 7.0);
}

TEST(CaseFormula, ComparisonIsAnAnswer) {
    EXPECT_TRUE(std::get<bool>(value("abs({b/c}) <= 3")));
    EXPECT_FALSE(std::get<bool>(value("abs({b/c}) < 3")));
    EXPECT_TRUE(std::get<bool>(value("{a} == 2")));
    EXPECT_TRUE(std::get<bool>(value("{a} >= 2")));
    EXPECT_FALSE(std::get<bool>(value("{a} > 2")));
}

TEST(CaseFormula, FunctionsOfNumbers) {
    EXPECT_EQ(number("max(0.5, {a}, {b/c})"), 2.0);
    EXPECT_EQ(number("floor({a} + 0.75)"), 2.0);
    EXPECT_EQ(number("hypot({b/c}, 4)"), 5.0);
    EXPECT_DOUBLE_EQ(number("pi * {a}"), 2.0 * std::numbers::pi);
    EXPECT_DOUBLE_EQ(number("ln(sqrt({a}))"), 0.5 * std::numbers::ln2);
    EXPECT_NEAR(number("normal_quantile({a} - 1.025)"), 1.959963984540054, 1e-14);
}

TEST(CaseFormula, RowsAreComputedElementByElement) {
    EXPECT_EQ(std::get<std::vector<double>>(value("2 * {row} + {a}")), (std::vector<double>{4.0, 6.0, 14.0}));
    EXPECT_EQ(number("sum(({row} - mean({row}))^2)"), 14.0);
    EXPECT_EQ(number("sum({row} * {row})"), 41.0);
}

TEST(CaseFormula, SumLosesNothing) {
    const auto large = [](const std::string&) { return CaseValue(std::vector<double>{1e16, 1.0, -1e16}); };
    EXPECT_EQ(std::get<double>(value_of_formula("sum({x})", large)), 1.0);
}

TEST(CaseFormula, PrintedValueAndUncertaintyInShort) {
    EXPECT_EQ(std::get<std::string>(value("shorthand({text}, {u})")), "0.1014(18)");
}

TEST(CaseFormula, WhatIsNoFormulaIsRefused) {
    for (const std::string formula :
         {"{a", "{a} +", "({a}", "{a} {a}", "{a} / 0", "{a} + {text}", "{row} - {short}", "power({a})", "{a} * k",
          "sum({a})", "abs({a}, {a})", "shorthand({a}, {u})", "normal_quantile({a})", "{none}", "max()", "{a} + nan"}) {
        EXPECT_THROW((void)value(formula), gum::InputError) << formula;
    }
    EXPECT_THROW((void)value(std::string(100'000, '(') + "{a}"), gum::InputError);
    EXPECT_THROW((void)value(std::string(100'000, '-') + "{a}"), gum::InputError);
    EXPECT_THROW((void)value("{a}" + std::string(100'000, '^')), gum::InputError);
}

}  // namespace
}  // namespace gumcert::self_test
