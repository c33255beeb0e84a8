#include "text/utf8.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace gumcert::text {
namespace {

TEST(Utf8, EveryScalarValueIsReadBack) {
    for (char32_t code = 0; code <= 0x10FFFF; ++code) {
        if (code >= 0xD800 && code <= 0xDFFF) {
            continue;
        }
        const std::string text = encode_utf8(code);
        const Character read = decode_utf8(text, 0);
        ASSERT_EQ(read.code, code);
        ASSERT_EQ(read.bytes, text.size());
    }
}

// The Unicode Standard, Table 3-7: each pair of a lead byte and a second byte is allowed or not.
TEST(Utf8, SecondBytesAreThoseOfTheTable) {
    for (unsigned lead = 0x80; lead <= 0xFF; ++lead) {
        for (unsigned second = 0; second <= 0xFF; ++second) {
            const unsigned low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
            const unsigned high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
            const bool allowed = lead >= 0xC2 && lead <= 0xF4 && second >= low && second <= high;
            const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
            std::string text = {static_cast<char>(lead), static_cast<char>(second), '\x80', '\x80'};
            text.resize(bytes);
            EXPECT_EQ(decode_utf8(text, 0).bytes, allowed ? bytes : 0U) << lead << " " << second;
            text.pop_back();
            EXPECT_EQ(decode_utf8(text, 0).bytes, 0U) << "cut off";
        }
    }
}

TEST(Utf8, TextsAreCheckedWhole) {
    EXPECT_TRUE(is_utf8(""));
    EXPECT_TRUE(is_utf8("µ″−校😀"));
    for (const std::string bad : {"\xC0\x80", "a\xFF", "\xED\xA0\x80", "\xE2\x82", "\xF4\x90\x80\x80", "\x80"}) {
        EXPECT_FALSE(is_utf8(bad));
    }
    EXPECT_EQ(character_count("µ″−校😀a"), 6U);
}

TEST(Utf8, HiddenCharactersAreThoseThatNobodySees) {
    for (const char32_t hidden :
         {U'\0', U'\n', U'\x7F', U'\x85', U'\xAD', U'\u034F', U'\u061C', U'\u180E', U'\u200B', U'\u200D', U'\u200E',
          U'\u2028', U'\u202E', U'\u2060', U'\u2066', U'\uFEFF', U'\uFFF9', U'\uFFFE', U'\U000E0041'}) {
        EXPECT_TRUE(is_hidden(hidden)) << std::hex << static_cast<unsigned>(hidden);
    }
    for (const char32_t shown : {U' ', U'a', U'\xA0', U'µ', U'\u0301', U'\u2009', U'\u202F', U'−', U'校', U'\uFFFD',
                                 U'😀', U'\uFE0F', U'\U000E0101'}) {
        EXPECT_FALSE(is_hidden(shown)) << std::hex << static_cast<unsigned>(shown);
    }
    for (const char32_t blank : {U' ', U'\xA0', U'\u2000', U'\u200A', U'\u202F', U'\u3000'}) {
        EXPECT_TRUE(is_blank(blank)) << std::hex << static_cast<unsigned>(blank);
    }
    for (const char32_t other : {U'\0', U'\n', U'a', U'\u200B', U'\u1FFF'}) {
        EXPECT_FALSE(is_blank(other)) << std::hex << static_cast<unsigned>(other);
    }
    EXPECT_TRUE(is_joiner(U'\u200D'));
    EXPECT_FALSE(is_joiner(U'\u200B'));
}

}  // namespace
}  // namespace gumcert::text
