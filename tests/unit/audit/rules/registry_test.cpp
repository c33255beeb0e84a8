#include "audit/rules/registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

namespace gumcert::audit {
namespace {

TEST(Registry, HasEachIdOnce) {
    std::set<std::string_view> ids;
    for (const Rule& rule : all_rules()) {
        EXPECT_TRUE(ids.insert(rule.id).second) << rule.id;
    }
    for (const RuleLeftOut& left : rules_left_out()) {
        EXPECT_TRUE(ids.insert(left.id).second) << left.id;
        EXPECT_FALSE(left.title.empty());
        EXPECT_FALSE(left.because.empty());
    }
    EXPECT_LE(rules_left_out().size(), 10U);
}

TEST(Registry, KnowsAllOfTheCatalogue) {
    std::set<std::string> known;
    for (const Rule& rule : all_rules()) {
        known.emplace(rule.id);
    }
    for (const RuleLeftOut& left : rules_left_out()) {
        known.emplace(left.id);
    }
    const auto expect_family = [&known](char letter, int last) {
        for (int i = 1; i <= last; ++i) {
            const std::string id = letter + std::string(i < 10 ? "0" : "") + std::to_string(i);
            EXPECT_TRUE(known.contains(id)) << id;
        }
    };
    expect_family('U', 26);
    expect_family('S', 19);
    expect_family('K', 13);
    expect_family('B', 8);
    expect_family('X', 8);
    expect_family('T', 12);
    expect_family('E', 7);
    expect_family('R', 12);
    expect_family('D', 8);
    expect_family('N', 10);
    expect_family('P', 10);
}

TEST(Registry, SaysEverythingOfARule) {
    for (const Rule& rule : all_rules()) {
        EXPECT_FALSE(rule.title.empty()) << rule.id;
        EXPECT_FALSE(rule.clause.text.empty()) << rule.id;
        EXPECT_FALSE(rule.detection.empty()) << rule.id;
        EXPECT_FALSE(rule.correction.empty()) << rule.id;
        EXPECT_NE(rule.question.find('?'), std::string_view::npos) << rule.id;
        EXPECT_TRUE(rule.examine != nullptr || rule.examine_rest != nullptr || rule.conclude != nullptr) << rule.id;
    }
}

TEST(Registry, FamiliesAreInOrder) {
    for (const std::vector<Rule>& family : {input_rules(), model_rules(), coverage_rules(), type_a_rules()}) {
        EXPECT_TRUE(
            std::is_sorted(family.begin(), family.end(), [](const Rule& a, const Rule& b) { return a.id < b.id; }));
    }
}

}  // namespace
}  // namespace gumcert::audit
