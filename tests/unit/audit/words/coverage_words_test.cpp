#include "audit/words/coverage_words.h"

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

TEST(CoverageIn, KnowsKAndPHoweverTheyAreWritten) {
    for (const char* const text : {"k = 2", "(k=2)", "Normal (k = 2)", "coverage factor of 2",
                                   "Erweiterungsfaktor k = 2", "k95 = 2", "U with k = 2"}) {
        EXPECT_EQ(coverage_in(text).k.substr(0, 1), "2") << text;
    }
    for (const char* const text : {"95 %", "p = 95 %", "k = 2, 95%", "0.95 of it: p = 0.95"}) {
        ASSERT_TRUE(coverage_in(text).p) << text;
        EXPECT_NEAR(*coverage_in(text).p, 0.95, 1e-12) << text;
    }
    EXPECT_NEAR(*coverage_in("95,45 %").p, 0.9545, 1e-12);
    for (const char* const text : {"", "Normal", "0.5 % of the reading", "kPa 2", "100 %", "risk 2", "u = 2 mm"}) {
        EXPECT_FALSE(coverage_in(text).says_any()) << text;
    }
}

TEST(CoverageIn, IsAllThatStandsBesideAUOfTheValue) {
    for (const char* text : {"", "(k = 2)", "k = 2, p = 95 %", "(%)", "in %", "ppm", "µm/m", "normal, k=2",
                             "of reading", "(of the measured value)", "–", "0.044", "0.044 % (k = 2)"}) {
        EXPECT_TRUE(says_coverage_alone(text)) << text;
    }
    for (const char* text : {"(of full scale)", "FS", "% FS", "% of span", "v. E.", "bezogen auf den Messbereich",
                             "related to 10 N·m", "of 10 N·m", "(k = 2) of the nominal torque"}) {
        EXPECT_FALSE(says_coverage_alone(text)) << text;
    }
}

}  // namespace
}  // namespace gumcert::audit
