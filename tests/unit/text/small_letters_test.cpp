#include "text/small_letters.h"

#include <gtest/gtest.h>

namespace gumcert::text {
namespace {

TEST(SmallLetters, ChangesLettersOfAsciiOnly) {
    EXPECT_EQ(in_small_letters("FS \u00C4"), "fs \u00C4");
    EXPECT_EQ(in_small_letters("AZ@[`{az09"), "az@[`{az09");
    EXPECT_EQ(in_small_letters(""), "");
    for (int byte = 0; byte < 256; ++byte) {
        const char letter = static_cast<char>(byte);
        EXPECT_EQ(small_letter(small_letter(letter)), small_letter(letter));
        EXPECT_EQ(small_letter(letter) != letter, byte >= 'A' && byte <= 'Z') << byte;
    }
}

}  // namespace
}  // namespace gumcert::text
