#include "archive/head.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "archive/log_times.h"
#include "encoding/sha2.h"
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

/// After a clock that was ahead a head says what the clock of its last entry said; others have the bytes that they ever had.
TEST(ArchiveHead, SaysWhatTheClockSaid) {
    Head head = sample_head();
    EXPECT_EQ(signed_bytes(head).find("clock"), std::string::npos);
    EXPECT_EQ(time_of(head), head.at);
    EXPECT_EQ(time_in_words(head), head.at);
    head.clock = "2026-10-24T18:52:52Z";
    EXPECT_EQ(head_from_json(to_json(head), "head.json"), head);
    EXPECT_NE(signed_bytes(head).find(head.clock), std::string::npos) << "it is signed";
    EXPECT_EQ(time_of(head), head.clock);
    EXPECT_EQ(time_in_words(head), "2026-10-24T18:52:52Z (by its log 2026-11-24T18:52:52Z, of a clock that was ahead)");
    EXPECT_TRUE(is_same_log(head, sample_head())) << "a head from before it was stated";
    EXPECT_TRUE(ends_with(head, head.chain, head.at, head.clock));
    EXPECT_FALSE(ends_with(head, head.chain, head.at, "")) << "the entry states none";
    EXPECT_TRUE(ends_with(sample_head(), head.chain, head.at, head.clock));
    EXPECT_FALSE(ends_with(sample_head(), head.chain, head.clock, ""));
    Head other = head;
    other.clock = "2026-10-24T18:52:51Z";
    EXPECT_FALSE(is_same_log(head, other));
    EXPECT_FALSE(proves_extension(head, other));
    for (const nlohmann::json& none : {nlohmann::json(), nlohmann::json(1), nlohmann::json(""), nlohmann::json(head.at),
                                       nlohmann::json("2026-10-24"), nlohmann::json("2027-10-24T18:52:52Z")}) {
        nlohmann::json value = nlohmann::json::parse(to_json(head));
        value["clock"] = none;
        EXPECT_EQ(test::code_of([&] { (void)head_from_json(value.dump(), "head.json"); }), "GC-ARCHIVE-0049") << none;
    }
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

TEST(ArchiveHead, HoldsNothingThatIsNotProved) {
    Head head = sample_head();
    head.clock = "2026-10-24T18:52:52Z";
    head.signature = Head::Signature{std::string(32, '\3'), std::string(64, '\4')};
    head.extends = Head::Extension{3, std::string(32, '\5'), {}};
    const nlohmann::json good = nlohmann::json::parse(to_json(head));
    for (const char* const place : {"", "/signature", "/extends"}) {
        nlohmann::json more = good;
        more[nlohmann::json::json_pointer(place)]["remark"] = "valid until 2031";
        EXPECT_EQ(test::code_of([&] { (void)head_from_json(more.dump(), "head.json"); }), "GC-ARCHIVE-0049") << place;
    }
}

TEST(MemberBeside, IsTheFirstThatIsNotKnown) {
    const nlohmann::json object = {{"b", 1}, {"a", 2}, {"c", 3}};
    EXPECT_EQ(member_beside(object, {"a", "b", "c", "d"}), "");
    EXPECT_EQ(member_beside(object, {"a"}), "b");
    EXPECT_EQ(member_beside({{"", 1}}, {"a"}), "\"\"");
    EXPECT_EQ(member_beside(nlohmann::json::array({1}), {"a"}), "");
}

/// What a clock can say, and nothing else: of every month its last day, and not the one behind it.
TEST(UtcTime, IsOneThatThereIs) {
    const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    for (const char* const year : {"0001", "1900", "2000", "2024", "2026", "9999"}) {
        const bool is_leap = std::string_view(year) == "2000" || std::string_view(year) == "2024";
        for (int month = 0; month <= 13; ++month) {
            const int last = month < 1 || month > 12 ? 0 : days[month - 1] + (month == 2 && is_leap ? 1 : 0);
            for (int day = 0; day <= 32; ++day) {
                const auto two = [](int number) { return (number < 10 ? "0" : "") + std::to_string(number); };
                const std::string text = std::string(year) + "-" + two(month) + "-" + two(day) + "T23:59:59Z";
                EXPECT_EQ(is_utc_time(text), day >= 1 && day <= last) << text;
            }
        }
    }
    for (const char* const none :
         {"2026-11-24T24:00:00Z", "2026-11-24T25:00:00Z", "2026-11-24T12:60:00Z", "2026-11-24T23:59:60Z",
          "0000-01-01T00:00:00Z", "2026-11-24T12:00:00", "2026-11-24 12:00:00Z", "2026-11-24T12:00:00.5Z",
          "2026-11-24T12:00:00+00:00", "+026-11-24T12:00:00Z", "", "2026-11-24T1 :00:00Z"}) {
        EXPECT_FALSE(is_utc_time(none)) << none;
        Head head = sample_head();
        head.at = none;
        EXPECT_EQ(test::code_of([&] { (void)head_from_json(to_json(head), "head.json"); }), "GC-ARCHIVE-0049") << none;
    }
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

// Each head proves that it extends the one before. What the log was before a fork leads to both ends, and neither to the other.
TEST(ArchiveHead, ProofsLeadThroughHeadsBetween) {
    WalkedLog log;
    WalkedLog fork;
    std::vector<Head> heads;
    std::vector<Head> forked;
    for (int i = 0; i < 20; ++i) {
        LogEntry entry;
        entry.hash = encoding::sha256_bytes(std::to_string(i));
        entry.at = "2026-01-01T00:00:00Z";
        log.add(entry);
        entry.hash = i < 10 ? entry.hash : encoding::sha256_bytes("other " + std::to_string(i));
        fork.add(entry);
        heads.push_back(heads.empty() ? log.head() : *log.head_since(heads.back()));
        forked.push_back(forked.empty() ? fork.head() : *fork.head_since(forked.back()));
    }
    std::vector<Head> all = heads;
    all.insert(all.end(), forked.begin(), forked.end());
    for (std::size_t later = 0; later < heads.size(); ++later) {
        for (std::size_t earlier = 0; earlier < heads.size(); ++earlier) {
            EXPECT_EQ(leads_to(heads[later], heads[earlier], all), earlier <= later) << later << ' ' << earlier;
            EXPECT_EQ(leads_to(heads[later], forked[earlier], all), earlier <= later && earlier < 10)
                << later << ' ' << earlier;
        }
    }
    std::vector<Head> gap = heads;
    gap.erase(gap.begin() + 5);
    EXPECT_FALSE(leads_to(heads[8], heads[2], gap));
    EXPECT_TRUE(leads_to(heads[8], heads[6], gap));
}

TEST(ArchiveHead, ProvesThatItExtendsEveryEarlierOne) {
    WalkedLog log;
    std::vector<Head> heads;
    for (int i = 0; i < 20; ++i) {
        LogEntry entry;
        entry.hash = encoding::sha256_bytes(std::to_string(i));
        entry.at = "2026-01-01T00:00:00Z";
        log.add(entry);
        heads.push_back(log.head());
    }
    for (std::size_t i = 0; i < heads.size(); ++i) {
        const std::optional<Head> later = log.head_since(heads[i]);
        ASSERT_TRUE(later);
        const Head read = head_from_json(to_json(*later), "head.json");
        EXPECT_EQ(read, *later);
        EXPECT_EQ(signed_bytes(read), signed_bytes(log.head())) << "a proof needs no signature";
        for (std::size_t j = 0; j < heads.size(); ++j) {
            // Of its own size it is a copy, which needs no proof.
            EXPECT_EQ(proves_extension(read, heads[j]), i == j || j + 1 == heads.size());
        }
        Head other = read;
        other.extends->size = 21;
        EXPECT_FALSE(proves_its_extension(other));
        other = read;
        other.root = heads[0].root;
        EXPECT_FALSE(proves_its_extension(other));
    }
    for (const Head& head : heads) {
        EXPECT_TRUE(proves_extension(head, head)) << head.size;
        Head is_signed = head;
        is_signed.signature = Head::Signature{std::string(32, 'k'), std::string(64, 's')};
        EXPECT_TRUE(proves_extension(is_signed, head)) << head.size;
        EXPECT_TRUE(proves_extension(head, is_signed)) << head.size;
        for (std::string Head::*const part : {&Head::archive, &Head::root, &Head::chain, &Head::at}) {
            Head other = head;
            other.*part += 'x';
            EXPECT_FALSE(proves_extension(other, head)) << head.size;
            EXPECT_FALSE(proves_extension(head, other)) << head.size;
        }
    }
    Head rewritten = heads[4];
    rewritten.root = heads[5].root;
    EXPECT_FALSE(log.head_since(rewritten));
    rewritten = heads[4];
    rewritten.archive = heads[5].chain;
    EXPECT_FALSE(log.head_since(rewritten));
    EXPECT_FALSE(proves_its_extension(log.head()));
    nlohmann::json object = nlohmann::json::parse(to_json(*log.head_since(heads[4])));
    object["extends"]["proof"][0] = "00";
    EXPECT_EQ(test::code_of([&] { (void)head_from_json(object.dump(), "head.json"); }), "GC-ARCHIVE-0049");
}

}  // namespace
}  // namespace gumcert::archive
