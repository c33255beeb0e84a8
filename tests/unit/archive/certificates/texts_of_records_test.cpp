#include "archive/certificates/texts_of_records.h"

#include <gtest/gtest.h>

#include <random>

namespace gumcert::archive {
namespace {

RecordReferences references_with(std::vector<std::string> texts) {
    RecordReferences references;
    for (std::string& text : texts) {
        references.references.push_back({StandardReference::Kind::source, std::move(text)});
    }
    return references;
}

/// Law: the answer is that of a look at every text of every record.
TEST(TextsOfRecords, FindWhatALookAtEachTextFinds) {
    std::mt19937_64 random(31);
    const std::vector<std::string> parts = {"STD", "017", "-", "/", " ", "標", "é", "EX", "1", "„", "..."};
    const auto of_chance = [&](std::size_t most) {
        std::string text;
        for (auto n = 1 + random() % most; n > 0; --n) {
            text += parts[random() % parts.size()];
        }
        return text;
    };
    TextsOfRecords texts;
    std::vector<RecordReferences> records;
    for (std::size_t i = 0; i < 500; ++i) {
        records.push_back(references_with({of_chance(4), of_chance(2), of_chance(6)}));
        texts.add(i, records.back());
    }
    std::size_t found = 0;
    for (int i = 0; i < 1000; ++i) {
        const std::string name = of_chance(3);
        std::set<std::size_t> expected;
        for (std::size_t record = 0; record < records.size(); ++record) {
            for (const StandardReference& one : records[record].references) {
                if (names(one.text, name)) {
                    expected.insert(record);
                }
            }
        }
        EXPECT_EQ(texts.that_name(name), expected) << name;
        found += expected.size();
    }
    EXPECT_GT(found, 5000U);
    EXPECT_TRUE(texts.that_name("").empty());
    EXPECT_TRUE(texts.that_name("STD-018").empty());
}

TEST(TextsOfRecords, TellTextsThatDifferInSpellingOnly) {
    TextsOfRecords texts;
    texts.add(0, references_with({"std-017", "STD\u2011017, certificate 12", "STD-0171", "STD-017"}));
    EXPECT_EQ(texts.that_may_mean("STD-017"), (std::set<std::string>{"std-017", "STD\u2011017, certificate 12"}));
    EXPECT_TRUE(texts.that_may_mean("").empty());
}

/// Each of many certificates has a text of its own, and each is a name that others may rest on: a look at each text for each name
/// would be 40 000 000 000 looks, and would not end in the time that a test has.
TEST(TextsOfRecords, AreNotAllLookedAtForEachName) {
    constexpr std::size_t k_many = 200'000;
    TextsOfRecords texts;
    for (std::size_t i = 0; i < k_many; ++i) {
        texts.add(i, references_with({"protocol of EX-2026-" + std::to_string(i), "STD-017"}));
    }
    for (std::size_t i = 0; i < k_many; ++i) {
        const std::set<std::size_t> found = texts.that_name("EX-2026-" + std::to_string(i));
        ASSERT_TRUE(found.size() == 1 && *found.begin() == i) << i;
    }
}

}  // namespace
}  // namespace gumcert::archive
