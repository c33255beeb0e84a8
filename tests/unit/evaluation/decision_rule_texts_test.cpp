#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "gum/conformity/decision_rule.h"
#include "tests/support/file_content.h"

// The rules stand in gum/conformity/decision_rule.cpp. What repeats their ids for people and for other programs agrees with it.

namespace gumcert::evaluation {
namespace {

using testing::ElementsAreArray;

std::string content_of(const std::string& file) {
    return test::file_content(std::filesystem::path(GUMCERT_SOURCE_DIR) / file);
}

TEST(DecisionRuleTexts, TheSchemaOfJobsAllowsTheRulesThatThereAre) {
    std::size_t lists = 0;
    const std::function<void(const nlohmann::json&)> walk = [&](const nlohmann::json& node) {
        if (node.is_object() && node.contains("enum") && node["enum"].dump().find("\"DR-") != std::string::npos) {
            std::vector<std::string> rules = node["enum"].get<std::vector<std::string>>();
            std::erase(rules, "");  // an alternative may be none
            EXPECT_THAT(rules, ElementsAreArray(gum::decision_rule_ids()));
            ++lists;
        }
        for (const nlohmann::json& below : node.is_structured() ? node : nlohmann::json::array()) {
            walk(below);
        }
    };
    walk(nlohmann::json::parse(content_of("schemas/job-1.schema.json")));
    EXPECT_EQ(lists, 2U);  // of the rule and of its alternative
}

TEST(DecisionRuleTexts, EveryLanguageNamesTheRules) {
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        const auto wording = nlohmann::json::parse(content_of("templates/wording/" + std::string(language) + ".json"));
        std::vector<std::string> named;
        for (const auto& [rule, name] : wording.at("rule_name").items()) {
            named.push_back(rule);
            EXPECT_FALSE(name.get<std::string>().empty()) << language << " " << rule;
        }
        EXPECT_THAT(named, ElementsAreArray(gum::decision_rule_ids())) << language;
    }
}

TEST(DecisionRuleTexts, TheDocumentHasARowForEach) {
    const std::string document = content_of("docs/certificate_data.md");
    const std::regex row(R"(\n\| `(DR-\d\d)` \|)");
    std::vector<std::string> rows;
    for (std::sregex_iterator found(document.begin(), document.end(), row), end; found != end; ++found) {
        rows.push_back((*found)[1]);
    }
    EXPECT_THAT(rows, ElementsAreArray(gum::decision_rule_ids()));
}

TEST(DecisionRuleTexts, SentencesThatNameTheFirstAndTheLastRuleAreRight) {
    const std::vector<std::string_view> ids = gum::decision_rule_ids();
    const std::string from_to = std::string(ids.front()) + " to " + std::string(ids.back());
    // The gate is a sentence with translations, the others are texts of files.
    EXPECT_NE(content_of("certificate/gates/specifications_gate.cpp").find("(" + from_to + ")"), std::string::npos);
    EXPECT_NE(content_of("templates/wording/sentences.json").find("(" + from_to + ")"), std::string::npos);
    EXPECT_NE(content_of("templates/messages.json").find("Take one of " + from_to), std::string::npos);
}

}  // namespace
}  // namespace gumcert::evaluation
