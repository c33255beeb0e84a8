#include "audit/words/unit_words.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::audit {
namespace {

TEST(UnitWords, AreThoseOfHeadsAndCells) {
    EXPECT_EQ(unit_in_head("u [µm]"), "µm");
    EXPECT_EQ(unit_in_head("Value ± kPa"), "kPa");
    EXPECT_EQ(unit_in_head("u / nm"), "nm");
    EXPECT_EQ(unit_in_head("result (mm)"), "mm");
    EXPECT_EQ(unit_in_head("u (HRC)"), "HRC");
    EXPECT_EQ(unit_in_head("u (UUT)"), "");
    for (const char* head :
         {"U in µg, k = 2", "U in µg; k = 2", "U in µg (k = 2)", "u_c in µg = 361", "U / µg (k = 2)"}) {
        EXPECT_EQ(unit_in_head(head), "µg") << head;
    }
    // A unit behind a blank: no symbol, no share, and nothing that a number stands before.
    for (const char* head : {"u µg", "Standard uncertainty µg", "Beitrag µg", "U µg (k = 2)", "uc µg"}) {
        EXPECT_EQ(unit_in_head(head), "µg") << head;
    }
    EXPECT_EQ(unit_in_head("u µV/V"), "µV/V");
    EXPECT_EQ(unit_in_head("Relative uncertainty %"), "%");
    EXPECT_EQ(unit_in_head("u, mm"), "mm");
    EXPECT_EQ(unit_in_head("Specification (±mm)"), "mm");
    EXPECT_EQ(unit_in_head("Limits (± mm)"), "mm");
    EXPECT_EQ(unit_in_head("Limits (± 2)"), "");
    EXPECT_EQ(unit_in_head("U (PSI)"), "PSI");
    for (const char* head : {"Uncertainty uA", "Product cu", "Value K", "Contribution ci", "Contribution %",
                             "u at 10 mm", "Value min", "Sensitivity c", "u 10 mV", "Difference T/K", "mm", " mm"}) {
        EXPECT_EQ(unit_in_head(head), "") << head;
    }
    EXPECT_EQ(unit_in_head("U in % of reading"), "");
    EXPECT_EQ(unit_in_head("contribution (y)"), "");
    EXPECT_EQ(unit_in_head("type (A)"), "");
    EXPECT_EQ(unit_in_head("U95 (k = 2)"), "");
    EXPECT_EQ(unit_in_rest("µm, k = 2"), "µm");
    EXPECT_EQ(unit_in_rest("% of the reading"), "");
    EXPECT_EQ(unit_in_rest("HRC"), "HRC");
    EXPECT_EQ(unit_in_rest("see the annex"), "");
    EXPECT_EQ(shared_unit("mK", "degC"), "degC");
    EXPECT_EQ(shared_unit("µm", "mm"), "µm");
}

/// As in a table with a column of u, which says it as U26: s of 10 readings over √10, half of a step.
TEST(UnitWords, AreTheSameHoweverOftenTheyAreAskedFor) {
    for (int i = 0; i < 3'000; ++i) {
        ASSERT_FALSE(known_unit("no unit " + std::to_string(i)));
        ASSERT_FALSE(known_unit("normal"));
        ASSERT_TRUE(known_unit("-"));
        ASSERT_TRUE(known_unit("[mV]") && known_unit(" mV "));
        ASSERT_DOUBLE_EQ(factor_between("mV", "µV").value_or(0.0), 1000.0);
    }
    EXPECT_TRUE(known_unit(std::string(60, ' ') + "mm"));
    EXPECT_FALSE(known_unit(std::string(60, 'x')));
}

TEST(UnitWords, TurnIntoEachOtherWhereTheyAreOfOneKind) {
    EXPECT_DOUBLE_EQ(factor_between("mm", "µm").value_or(0.0), 1000.0);
    EXPECT_DOUBLE_EQ(factor_between("\u03BCm", "um").value_or(0.0), 1.0);
    EXPECT_DOUBLE_EQ(factor_between("k\u2126", "Ω").value_or(0.0), 1000.0);
    EXPECT_DOUBLE_EQ(factor_between("°C", "mK").value_or(0.0), 1000.0);
    EXPECT_DOUBLE_EQ(factor_between("%", "ppm").value_or(0.0), 10000.0);
    EXPECT_DOUBLE_EQ(factor_between("HRC", "HRC").value_or(0.0), 1.0);
    EXPECT_DOUBLE_EQ(factor_between("", "mm").value_or(0.0), 1.0);
    EXPECT_FALSE(factor_between("mm", "mg"));
    EXPECT_FALSE(factor_between("HRC", "N"));
}

}  // namespace
}  // namespace gumcert::audit
