#include "outputs/refusal_log.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace gumcert::outputs {
namespace {

namespace fs = std::filesystem;

class RefusalLog : public testing::Test {
protected:
    RefusalLog() { fs::remove(log_); }
    ~RefusalLog() override { fs::remove(log_); }
    [[nodiscard]] std::string text() const {
        std::ifstream stream(log_, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    }
    fs::path log_ =
        fs::path(testing::TempDir()) /
        (std::string("gumcert-") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".jsonl");
};

TEST_F(RefusalLog, IsNoFileBesideAnArchive) {
    std::ofstream(log_, std::ios::binary) << std::string("SQLite format 3\0", 16);
    for (const char* const ending : {"-wal", "-shm", "-journal"}) {
        const fs::path beside = log_.string() + ending;
        EXPECT_NE(append_refusal(beside, {"2026-11-27T20:00:00Z", "run", "GC-INPUT-0023", "job.json"}), "");
        EXPECT_FALSE(fs::exists(beside));
    }
}

TEST_F(RefusalLog, ALineIsAnObjectForItsUserOnly) {
    EXPECT_EQ(append_refusal(log_, {"2026-11-27T20:00:00Z", "run", "GC-INPUT-0023", "job.json#/a\n\xff"}), "");
    const nlohmann::json line = nlohmann::json::parse(text());
    EXPECT_EQ(line["command"], "run");
    EXPECT_EQ(line["code"], "GC-INPUT-0023");
    EXPECT_EQ(line.size(), 4U);
    EXPECT_EQ(text().find('\n'), text().size() - 1);
    struct stat status = {};
    ASSERT_EQ(stat(log_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST_F(RefusalLog, LinesOfManyDoNotMix) {
    constexpr int k_each = 200;
    std::vector<std::thread> writers;
    for (int i = 0; i < 4; ++i) {
        writers.emplace_back([&, i] {
            for (int n = 0; n < k_each; ++n) {
                EXPECT_EQ(append_refusal(log_, {"t", "run", "GC-X-" + std::to_string(i), std::string(500, 'p')}), "");
            }
        });
    }
    for (std::thread& writer : writers) {
        writer.join();
    }
    std::istringstream lines(text());
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        EXPECT_EQ(nlohmann::json::parse(line)["where"], std::string(500, 'p'));
    }
    EXPECT_EQ(count, 4 * k_each);
}

TEST_F(RefusalLog, WhatIsNoLogIsLeftAlone) {
    std::ofstream(log_) << "{\"schema\": \"gumcert/job/1\"}";
    const std::string before = text();
    EXPECT_EQ(append_refusal(log_, {"t", "run", "GC-X-1", "p"}), "it is no log of refusals");
    EXPECT_EQ(text(), before);
    EXPECT_NE(append_refusal(fs::path(testing::TempDir()), {"t", "run", "GC-X-1", "p"}), "");
    EXPECT_NE(append_refusal("/nowhere/log", {"t", "run", "GC-X-1", "p"}), "");
    EXPECT_NE(append_refusal("/dev/null", {"t", "run", "GC-X-1", "p"}), "");
}

}  // namespace
}  // namespace gumcert::outputs
