#include "reports/dcc/ref_types.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "gum/quantity/diagnostic.h"

namespace gumcert::reports {
namespace {

namespace fs = std::filesystem;

RenderAssets templates_with_ref_types(const std::string& text) {
    RenderAssets assets;
    assets.templates = fs::path(testing::TempDir()) / "templates_with_ref_types";
    fs::create_directories(assets.templates / "dcc");
    std::ofstream(assets.templates / "dcc" / "ref_types.json") << text;
    return assets;
}

std::string refusal_of_ref_types(const std::string& text) {
    try {
        (void)RefTypes::read(templates_with_ref_types(text));
    } catch (const gum::StorageError& error) {
        return error.diagnostics().front().code + " " + error.diagnostics().front().what;
    }
    return "";
}

constexpr const char* k_definition = R"("definitions": [{"namespace": "basic", "name": "n", "link": "l"}])";

TEST(RefTypes, AreTheWordsOfTheFile) {
    const RefTypes types = RefTypes::read(templates_with_ref_types(
        std::string("{") + k_definition + R"(, "names": {"temperature": "basic_temperature basic_air"}})"));
    ASSERT_EQ(types.definitions().size(), 1U);
    EXPECT_EQ(types.definitions().front().space, "basic");
    EXPECT_EQ(types("temperature"), "basic_temperature basic_air");
    EXPECT_EQ(types("pressure"), "") << "a word that the file does not have";
}

TEST(RefTypes, OfTheReleaseCanBeRead) {
    RenderAssets assets;
    assets.templates = fs::path(GUMCERT_SOURCE_DIR) / "templates";
    EXPECT_FALSE(RefTypes::read(assets).definitions().empty());
}

TEST(RefTypes, RefuseADamagedFile) {
    EXPECT_TRUE(refusal_of_ref_types("{").starts_with("GC-DCC-0201 "));
    EXPECT_EQ(refusal_of_ref_types("[]"), "GC-DCC-0201 not an object with `definitions` and `names`");
    EXPECT_EQ(refusal_of_ref_types(R"({"definitions": [{"namespace": "basic", "name": "n"}], "names": {}})"),
              "GC-DCC-0201 no text `link`");
    EXPECT_EQ(refusal_of_ref_types(std::string("{") + k_definition + R"(, "names": {"a": "other_b"}})"),
              "GC-DCC-0201 the prefix of `other_b` is not defined");
}

}  // namespace
}  // namespace gumcert::reports
