#include "archive/settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "text/utf8.h"

namespace gumcert::archive {
namespace {

TEST(ArchiveSettings, AreReadAsTheyWereWritten) {
    const Settings settings{
        .four_eyes = false, .numbering = "EX-YYYY-####", .persons = {{"R. Lin", {"author", "keeper"}}}};
    EXPECT_EQ(settings_from_json(to_json(settings)), settings);
}

TEST(ArchiveSettings, RefuseAnotherForm) {
    const nlohmann::json good = to_json(Settings{});
    for (const char* const wrong :
         {"[]", "{}", R"({"four_eyes":1,"numbering":"","persons":{}})",
          R"({"four_eyes":true,"numbering":"","persons":[]})", R"({"four_eyes":true,"numbering":"EX","persons":{}})",
          R"({"four_eyes":true,"numbering":"","persons":{"a":["boss"]}})",
          R"({"four_eyes":true,"numbering":"","persons":{"a":"author"}})",
          R"({"four_eyes":true,"numbering":"","persons":{},"more":1})"}) {
        EXPECT_EQ(settings_from_json(nlohmann::json::parse(wrong)), std::nullopt) << wrong;
    }
    EXPECT_TRUE(settings_from_json(good).has_value());
}

TEST(ArchiveNumbers, FollowTheirPattern) {
    EXPECT_TRUE(is_numbering("EX-YYYY-####"));
    EXPECT_TRUE(is_numbering("#"));
    EXPECT_FALSE(is_numbering("EX-YYYY"));
    EXPECT_FALSE(is_numbering("##-##"));
    EXPECT_FALSE(is_numbering("YYYY-YYYY-#"));
    EXPECT_FALSE(is_numbering("EX\n#"));
    EXPECT_FALSE(is_numbering("\xFF#"));
    EXPECT_EQ(series_of("EX-YYYY-####", "2026-11-24T18:52:52Z"), "EX-2026-####");
    EXPECT_EQ(number_in("EX-2026-####", 42), "EX-2026-0042");
    EXPECT_EQ(number_in("EX-2026-####", 9999), "EX-2026-9999");
    EXPECT_EQ(number_in("EX-2026-####", 10000), std::nullopt);
    EXPECT_EQ(number_in("#/EX", 3), "3/EX");
    EXPECT_EQ(number_in("#", 0), std::nullopt);
    EXPECT_EQ(number_in("EX", 1), std::nullopt);
}

/// The list of docs/adr/0053-the-archive.md, 5, over all of Unicode: logs that are there obey it, and the other verifier has it.
TEST(ArchiveNumbers, HaveNoCharacterThatNobodySees) {
    struct Range {
        char32_t first, last;
    };
    constexpr std::array hidden{Range{0x0, 0x1F},       Range{0x7F, 0x9F},     Range{0xAD, 0xAD},
                                Range{0x34F, 0x34F},    Range{0x61C, 0x61C},   Range{0x180E, 0x180E},
                                Range{0x200B, 0x200F},  Range{0x2028, 0x202E}, Range{0x2060, 0x206F},
                                Range{0xFEFF, 0xFEFF},  Range{0xFFF9, 0xFFFB}, Range{0xFFFE, 0xFFFF},
                                Range{0xE0000, 0xE00FF}};
    for (char32_t code = 0; code <= 0x10FFFF; ++code) {
        if (code >= 0xD800 && code <= 0xDFFF) {
            continue;  // no character
        }
        const bool is_hidden = std::any_of(hidden.begin(), hidden.end(), [code](const Range& range) {
            return range.first <= code && code <= range.last;
        });
        if (code != U'#' && is_numbering("EX" + text::encode_utf8(code) + "#") == is_hidden) {
            ADD_FAILURE() << std::hex << static_cast<unsigned>(code);
        }
    }
}

TEST(ArchiveRoles, AreFour) {
    EXPECT_TRUE(is_role("author"));
    EXPECT_TRUE(is_role("keeper"));
    EXPECT_FALSE(is_role("Author"));
}

}  // namespace
}  // namespace gumcert::archive
