#include "archive/head.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/support/archive_folder.h"

namespace gumcert::archive {
namespace {

Head sample_head() {
    return {.archive = std::string(32, '\1'),
            .size = 12,
            .root = std::string(32, '\2'),
            .chain = std::string(32, '\xFF'),
            .at = "2026-11-24T18:52:52Z"};
}

TEST(ArchiveHead, IsReadAsItWasWritten) {
    Head head = sample_head();
    EXPECT_EQ(head_from_json(to_json(head), "head.json"), head);
    const std::string unsigned_text = to_json(head);
    head.signature = Head::Signature{std::string(32, '\3'), std::string(64, '\4')};
    EXPECT_EQ(head_from_json(to_json(head), "head.json"), head);
    EXPECT_EQ(signed_bytes(head), unsigned_text);
}

TEST(ArchiveHead, IsRefusedWhereItHasAnotherForm) {
    const nlohmann::json good = nlohmann::json::parse(to_json(sample_head()));
    const auto code = [](const nlohmann::json& value) {
        return test::code_of([&] { (void)head_from_json(value.dump(), "head.json"); });
    };
    for (const auto& [key, value] : good.items()) {
        nlohmann::json missing = good;
        missing.erase(key);
        EXPECT_EQ(code(missing), "GC-ARCHIVE-0049") << key;
        nlohmann::json other = good;
        other[key] = nullptr;
        EXPECT_EQ(code(other), "GC-ARCHIVE-0049") << key;
    }
    nlohmann::json other = good;
    other["size"] = 0;
    EXPECT_EQ(code(other), "GC-ARCHIVE-0049");
    other = good;
    other["root"] = "zz";
    EXPECT_EQ(code(other), "GC-ARCHIVE-0049");
    other = good;
    other["signature"] = {{"algorithm", "RSA"}};
    EXPECT_EQ(code(other), "GC-ARCHIVE-0049");
    EXPECT_EQ(test::code_of([&] { (void)head_from_json("[", "head.json"); }), "GC-ARCHIVE-0049");
}

TEST(ArchiveHead, GrowsWithTheLog) {
    WalkedLog log;
    EXPECT_EQ(log.head().size, 0);
    LogEntry entry;
    std::vector<std::string> roots;
    for (const char* const hash : {"first", "second"}) {
        entry.hash = hash;
        entry.at = std::string("time of the ") + hash;
        log.add(entry);
        roots.push_back(log.head().root);
    }
    EXPECT_EQ(log.without_root().root, "");
    EXPECT_EQ(log.head().archive, "first");
    EXPECT_EQ(log.head().chain, "second");
    EXPECT_EQ(log.head().at, "time of the second");
    EXPECT_EQ(log.head().size, 2);
    EXPECT_EQ(roots, (std::vector<std::string>{log.tree().root(1), log.tree().root(2)}));
}

}  // namespace
}  // namespace gumcert::archive
