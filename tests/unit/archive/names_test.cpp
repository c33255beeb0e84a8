#include "archive/names.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace gumcert::archive {
namespace {

/// Spellings of one name that a reader takes for the same.
const std::vector<std::string>& spellings() {
    static const std::vector<std::string> k_spellings = {
        "rené lin",      "René Lin ",     " René Lin",      "René  Lin", "Rene\u0301 Lin",
        "R\u0435né Lin",  // Cyrillic ie
        "René\u00A0Lin", "René\u200BLin", "René \u202ELin", "RENÉ LIN",  "Rene Lin"};
    return k_spellings;
}

TEST(NamesOfPersons, MayBeOneInWhateverSpelling) {
    for (const std::string& spelled : spellings()) {
        EXPECT_TRUE(may_be_one_person("René Lin", spelled)) << spelled;
    }
    for (const char* const other : {"R. Lin", "René Linn", "Ren Lin", "", "Weber"}) {
        EXPECT_FALSE(may_be_one_person("René Lin", other)) << other;
    }
    EXPECT_TRUE(may_be_one_person("林", "林"));
    EXPECT_FALSE(may_be_one_person("林", "李"));
    EXPECT_FALSE(may_be_one_person("...", "---")) << "names without letters are told apart by their bytes";
}

/// What a person may be called is what nobody can take for another spelling of it, but for its capitals.
TEST(NamesOfPersons, AreRefusedWhereTheyCannotBeToldFromOthers) {
    for (const char* const name : {"René Lin", "R. Lin", "M. Weber-Lin", "A. B. C. O'Neill", "林 美玲", "Иван Петров",
                                   "N_1", "Dr. Ångström, QM", "a", "MÜLLER"}) {
        EXPECT_EQ(objection_to_name(name), "") << name;
    }
    for (const char* const name :
         {"René Lin ", " René Lin", "René  Lin", "Rene\u0301 Lin", "R\u0435né Lin", "René\u00A0Lin", "René\u200BLin",
          "René \u202ELin", "R\xE9n", "Ad\u043Cin", "a\tb"}) {
        EXPECT_NE(objection_to_name(name), "") << name;
    }
}

/// Law: the key of the log is one of capitals and blanks alone.
TEST(NamesOfPersons, HaveAKeyForTheLog) {
    EXPECT_EQ(name_key("  René \u00A0 LIN "), "ren\u00E9 lin");
    EXPECT_EQ(name_key("ÀÖØÞ ×÷ ĀŽŸİ ΑΩ АЯЁ"), "àöøþ ×÷ āžÿİ αω аяё");
    EXPECT_EQ(name_key(""), "");
    EXPECT_NE(name_key("Rene Lin"), name_key("René Lin"));
    for (const std::string& spelled : spellings()) {
        EXPECT_EQ(name_key(name_key(spelled)), name_key(spelled)) << spelled;
    }
}

TEST(NumbersOfCertificates, AreConfusableInTheSameForm) {
    std::set<std::string> forms;
    for (const char* const number : {"X-1", "x-1", "\u0425-1", "X\u20111", "X - 1", "X\u2212\u200B1", "Ｘ－１", "X-１",
                                     "\U0001D417-\U0001D7CF", "\u2169-1", "\u2179-1"}) {
        forms.insert(confusable_form(number));
    }
    EXPECT_EQ(forms.size(), 1U);
    EXPECT_EQ(confusable_form("EX-2026-0001/\u04101"), confusable_form("EX-2026-0001/A1"));
    EXPECT_EQ(confusable_form("Å-Ω-K-VIII/1"), confusable_form("\u212B-\u2126-\u212A-\u2167\u22151"));
    for (const char* const number : {"X-01", "X-11", "X1", "X-1/A", "Y-1", "X-1.", "X/1"}) {
        EXPECT_NE(confusable_form(number), confusable_form("X-1")) << number;
    }
}

}  // namespace
}  // namespace gumcert::archive
