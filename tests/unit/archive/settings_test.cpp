#include "archive/settings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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

TEST(ArchiveRoles, AreFour) {
    EXPECT_TRUE(is_role("author"));
    EXPECT_TRUE(is_role("keeper"));
    EXPECT_FALSE(is_role("Author"));
}

}  // namespace
}  // namespace gumcert::archive
