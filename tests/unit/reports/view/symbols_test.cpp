#include "reports/view/symbols.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/sample_budget_record.h"

namespace gumcert::reports {
namespace {

std::string drawing_of(const std::string& name) {
    const Symbol symbol = symbol_of(name);
    return symbol.base + "|" + symbol.index;
}

TEST(Symbols, AreLettersWithIndices) {
    EXPECT_EQ(drawing_of("l_s"), "l|s");
    EXPECT_EQ(drawing_of("alpha_s"), "α|s");
    EXPECT_EQ(drawing_of("d_theta"), "d|θ");
    EXPECT_EQ(drawing_of("ν_eff"), "ν|eff");
    EXPECT_EQ(drawing_of("dV_x"), "dV|x");
    EXPECT_EQ(drawing_of("T_1_ref"), "T|1,ref");
    EXPECT_EQ(drawing_of("theta"), "θ|");
    EXPECT_EQ(drawing_of("l"), "l|");
}

TEST(Symbols, WordsAreNone) {
    for (const char* name : {"offset_2", "fit", "E, 1 V", "EXA", "", "_x", "50"}) {
        EXPECT_EQ(drawing_of(name), "|") << name;
    }
}

TEST(Symbols, OfARecordAreThoseOfItsQuantities) {
    EvaluationRecord record = test::sample_budget_record();
    record.inputs.emplace_back();
    record.inputs.back().name = "q_own";
    const std::string all = symbols_in(record).dump();
    EXPECT_NE(all.find("{\"base\":\"q\",\"index\":\"own\",\"text\":\"q_own\"}"), std::string::npos) << all;
    EXPECT_NE(all.find("\"T_L\""), std::string::npos);
}

TEST(Symbols, OfComparisonsAreThoseOfTheirScores) {
    EvaluationRecord record = test::sample_budget_record();
    EXPECT_EQ(symbols_in(record).dump().find("σ_pt"), std::string::npos);
    record.comparison.emplace();
    const std::string all = symbols_in(record).dump();
    for (const char* name : {"σ_pt", "δ_E", "P_A", "D_fail", "p_high", "u_others"}) {
        EXPECT_NE(all.find(std::string("\"") + name), std::string::npos) << name;
    }
    // What an organiser calls a laboratory, an item or a point is a name.
    record.comparison->participants.emplace_back().id = "p_low";
    record.comparison->participants.back().name = "T_L";
    record.comparison->items.emplace_back().id = "D_fail";
    record.comparison->points.emplace_back().name = "A_U";
    const std::string named = symbols_in(record).dump();
    for (const char* name : {"p_low", "T_L", "D_fail", "A_U"}) {
        EXPECT_EQ(named.find(std::string("\"") + name), std::string::npos) << name;
    }
    EXPECT_NE(named.find("\"p_high"), std::string::npos);
}

TEST(Symbols, OfEquationsAreThoseThatTheyDefine) {
    EvaluationRecord record = test::sample_budget_record();
    record.model = ModelSummary{.equations = {"rho_a = one·p", "q_z=2"}, .unknowns = {"w_u"}};
    const std::string all = symbols_in(record).dump();
    for (const char* name : {"\"rho_a\"", "\"q_z\"", "\"w_u\""}) {
        EXPECT_NE(all.find(name), std::string::npos) << name;
    }
}

TEST(Symbols, PiecesAreTheText) {
    const nlohmann::json view = {
        {"symbols",
         {{{"text", "T_L"}, {"base", "T"}, {"index", "L"}}, {{"text", "ν_eff"}, {"base", "ν"}, {"index", "eff"}}}},
        {"letters", {{{"text", "dm"}}}}};
    const SymbolFinder finder(view);
    for (const char* text : {"T_L = ν_eff·β_x + dm", "", "以T_L表", "ν_", "α"}) {
        for (const bool formula : {false, true}) {
            std::string joined;
            for (const SymbolPiece& piece : formula ? finder.pieces_of_formula(text) : finder.pieces(text)) {
                joined += piece.text;
            }
            EXPECT_EQ(joined, text);
        }
    }
    EXPECT_EQ(finder.pieces("dm T_L").size(), 2U);
    EXPECT_EQ(finder.pieces_of_formula("dm T_L").size(), 3U);
    EXPECT_TRUE(finder.is_letter("dm"));
}

}  // namespace
}  // namespace gumcert::reports
