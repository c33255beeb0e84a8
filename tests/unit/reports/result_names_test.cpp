#include "reports/result_names.h"

#include "reports/forms/asset_files.h"
#include "reports/view/decision_formula.h"
#include "tests/unit/reports/document_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace gumcert::reports {
namespace {

class Names : public ::testing::Test {
protected:
    [[nodiscard]] static nlohmann::json wording(const std::string& language) {
        return nlohmann::json::parse(read_asset(assets().templates / "wording" / (language + ".json")));
    }
    nlohmann::json texts_ = nlohmann::json::array({wording("en"), wording("de")});
    Wording words_{texts_};

    [[nodiscard]] std::string german(const std::string& table, const std::string& result) const {
        return result_meaning(table, result, "recorded", words_).in(1);
    }
};

TEST_F(Names, OfTheProgramAreInEveryLanguage) {
    EXPECT_EQ(german("set_up", "O_y"), "Versatz der Vorrichtung längs y gegen die Drehachse");
    EXPECT_EQ(german("set_up", "S_z"), "Neigung der Vorrichtung um z gegen die Drehachse");
    EXPECT_EQ(german("axis_line", "axis_x"),
              "Ort der mittleren Achslinie längs x im Koordinatensystem der Vorrichtung");
    EXPECT_EQ(german("axis_line", "axis_b"),
              "Neigung der mittleren Achslinie um y im Koordinatensystem der Vorrichtung");
    for (const char* parameter :
         {"M", "E", "E_up", "E_down", "R", "R_up", "R_down", "B", "B_mean", "A", "A_up", "A_down"}) {
        EXPECT_NE(german("positioning", parameter), "recorded") << parameter;
    }
    EXPECT_EQ(source_name("length noise", words_).in(1), "Rauschen der Längen");
    EXPECT_EQ(distribution_name("convolution", words_).in(1), "Faltung");
}

/// Bars, the list of sources and the statement of uncertainty named the scatter of a circle closure in English.
TEST_F(Names, OfRowsOfABudgetAreThoseOfTheDocument) {
    BudgetRow scatter;
    scatter.input = "scatter of the readings";
    scatter.source = scatter.input;
    scatter.role = "scatter";
    EXPECT_EQ(name_of_budget_row(scatter, words_).in(1), "Streuung der Ablesungen");
    EXPECT_TRUE(source_of_budget_row(scatter, words_).empty());
    BudgetRow extremes;
    extremes.input = "which values are extreme";
    extremes.source = extremes.input;
    extremes.role = "extremes";
    EXPECT_EQ(name_of_budget_row(extremes, words_).in(1), "welche Werte die äußersten sind");
    EXPECT_TRUE(source_of_budget_row(extremes, words_).empty());
    BudgetRow input;
    input.input = "l_s";
    input.source = "STD-1";
    EXPECT_EQ(name_of_budget_row(input, words_).in(1), "l_s");
    EXPECT_EQ(source_of_budget_row(input, words_).in(1), "STD-1");
    input.role = "fit";
    EXPECT_NE(name_of_budget_row(input, words_).in(0), name_of_budget_row(input, words_).in(1));
}

TEST_F(Names, OfAnythingElseAreThoseOfTheRecord) {
    EXPECT_EQ(german("results", "R"), "recorded") << "a resistance, not the repeatability of positioning";
    EXPECT_EQ(german("results", "O_y"), "recorded");
    EXPECT_EQ(german("set_up", "O_w"), "recorded");
    EXPECT_EQ(german("set_up", "O_"), "recorded");
    EXPECT_EQ(german("axis_line", "EY1A"), "recorded");
    EXPECT_EQ(german("axis_line", ""), "recorded");
    EXPECT_EQ(german("positioning", "Q"), "recorded");
    EXPECT_EQ(source_name("somebody's source", words_).first(), "somebody's source");
    EXPECT_EQ(distribution_name("own", words_).first(), "own");
}

TEST_F(Names, OfRangesAndReversals) {
    EXPECT_EQ(name_in_table("ranges", "range_EXA"), "EXA");
    EXPECT_EQ(name_in_table("reversal", "reversal_EXA"), "EXA");
    EXPECT_EQ(name_in_table("results", "range_EXA"), "range_EXA");
    EXPECT_EQ(name_of_result("ranges", "range_EXA", words_).first(), "range of EXA");
    EXPECT_EQ(name_of_result("reversal", "reversal_EXA", words_).in(1), "Umkehrspanne von EXA");
    EXPECT_EQ(name_of_result("error_motions", "EXA", words_).first(), "EXA");
}

TEST_F(Names, FormulasOfDecisionRulesHaveTheSymbolsOfTheTables) {
    const Text simple = decision_formula("AL = TL + r·U, AU = TU − r·U, r = 0.5, if TUR ≥ 4", words_);
    EXPECT_EQ(simple.in(0), "A_L = T_L + r·U, A_U = T_U − r·U, r = 0.5, if TUR ≥ 4");
    EXPECT_EQ(simple.in(1), "A_L = T_L + r·U, A_U = T_U − r·U, r = 0,5, falls TUR ≥ 4");
    EXPECT_EQ(
        decision_formula("pass: P(TL ≤ Y ≤ TU) ≥ p; fail: P(TL ≤ Y ≤ TU) ≤ 1 − p; else undetermined; p = 0.95", words_)
            .in(1),
        "bestanden: P(T_L ≤ Y ≤ T_U) ≥ p; nicht bestanden: P(T_L ≤ Y ≤ T_U) ≤ 1 − p; sonst unentschieden; p = 0,95");
    EXPECT_EQ(
        decision_formula("conditional pass: up to the limit; conditional fail: up to w beyond the limit; w = U", words_)
            .in(1),
        "bedingt bestanden: bis zur Toleranzgrenze; bedingt nicht bestanden: bis w jenseits der Toleranzgrenze; w = U");
    EXPECT_EQ(decision_formula("y < 3.5 TALL", words_).first(), "y < 3.5 TALL");
}

}  // namespace
}  // namespace gumcert::reports
