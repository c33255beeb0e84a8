// Limits of memory and time, and the log of refusals.
#include <sys/stat.h>

#include <chrono>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class Ceilings : public ProgramTest {
protected:
    /// A job that takes minutes.
    [[nodiscard]] std::string endless_job() const {
        const fs::path job = folder() / "job.json";
        nlohmann::json document = {
            {"schema", "gumcert/job/1"},
            {"kind", "budget"},
            {"title", "Endless"},
            {"model", "y = a + b"},
            {"inputs",
             {{"a", {{"unit", "m"}, {"value", 1}, {"u", 0.1}}},
              {"b", {{"unit", "m"}, {"value", 1}, {"half_width", 0.1}, {"distribution", "uniform"}}}}},
            {"monte_carlo", {{"trials", 10'000'000'000}}}};
        write_bytes(job, document.dump(1));
        return job.string();
    }
};

TEST_F(Ceilings, TimeEndsACommandAndLeavesNothing) {
    const fs::path record = folder() / "record.json";
    const auto begin = std::chrono::steady_clock::now();
    const Ended ended = gumcert({"evaluate", endless_job(), "-o", record.string(), "--share", GUMCERT_SOURCE_DIR,
                                 "--time-limit", "1", "--json-messages"});
    EXPECT_EQ(ended.code, 5) << ended.err;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
    const std::vector<Message> messages = json_messages(ended);
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0].code, "GC-STORE-0024");
    EXPECT_EQ(messages[0].where, "--time-limit");
    EXPECT_FALSE(fs::exists(record));
}

TEST_F(Ceilings, MemoryEndsACommandAndSaysWhichLimit) {
    const Ended ended = gumcert({"evaluate", endless_job(), "-o", (folder() / "record.json").string(), "--share",
                                 GUMCERT_SOURCE_DIR, "--memory-limit", "1MB"});
    EXPECT_EQ(ended.code, 5);
    EXPECT_NE(ended.err.find("--memory-limit"), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(folder() / "record.json"));
}

TEST_F(Ceilings, WideOnesChangeNothingAndWrongOnesAreRefused) {
    const std::string job = (fs::path(GUMCERT_SOURCE_DIR) / "examples" / "certificate" / "end_gauge.json").string();
    const auto evaluate = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"evaluate", job, "-o", "-", "-q", "--share", GUMCERT_SOURCE_DIR});
        return gumcert(more);
    };
    const Ended without = evaluate({});
    const Ended with = evaluate({"--memory-limit", "4GiB", "--time-limit", "1000"});
    EXPECT_EQ(with.code, without.code) << with.err;
    EXPECT_EQ(with.out, without.out);
    EXPECT_EQ(evaluate({"--memory-limit", "0", "--time-limit", "0"}).out, without.out);
    for (const char* const size : {"much", "-1", "-5GB", "18446744073709551616", "1e99", ""}) {
        EXPECT_EQ(evaluate({std::string("--memory-limit=") + size}).code, 2) << size;
    }
    EXPECT_EQ(evaluate({"--time-limit", "-1"}).code, 2);
}

TEST_F(Ceilings, ForeignFilesHaveWallsThatCanBeMoved) {
    const fs::path table = folder() / "table.csv";
    std::string text = "name,value,u\n";
    for (int i = 0; i < 20; ++i) {
        text += "x" + std::to_string(i) + ",1,0.1\n";
    }
    write_bytes(table, text);
    const std::vector<std::string> audit = {"audit", table.string(), "--share", GUMCERT_SOURCE_DIR};
    std::vector<std::string> narrow = audit;
    narrow.insert(narrow.end(), {"--memory-limit", "1MB"});
    const Ended usual = gumcert(audit);
    EXPECT_EQ(usual.code, 0) << usual.err;
    EXPECT_EQ(gumcert(narrow).code, 5);
}

/// Each of 900 inputs is a result with 900 rows: 450 MB, told before they are taken.
TEST_F(Ceilings, AJobThatNeedsMoreMemoryIsRefusedBeforeItIsEvaluated) {
    nlohmann::json document = {{"schema", "gumcert/job/1"}, {"kind", "budget"}, {"title", "Many"}};
    for (int i = 0; i < 900; ++i) {
        document["inputs"]["x" + std::to_string(i)] = {{"value", i}, {"u", 0.1}};
    }
    const fs::path job = folder() / "many.json";
    write_bytes(job, document.dump(1));
    const fs::path record = folder() / "record.json";
    const auto begin = std::chrono::steady_clock::now();
    const Ended ended = gumcert({"evaluate", job.string(), "-o", record.string(), "--share", GUMCERT_SOURCE_DIR,
                                 "--memory-limit", "400MB", "--json-messages"});
    EXPECT_EQ(ended.code, 5) << ended.err;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
    const std::vector<Message> messages = json_messages(ended);
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0].code, "GC-STORE-0026");
    EXPECT_NE(messages[0].what.find("463 MB"), std::string::npos) << messages[0].what;
    EXPECT_FALSE(fs::exists(record));
}

TEST_F(Ceilings, RefusalsAreLoggedWithoutWhatTheFilesSay) {
    const fs::path log = folder() / "refusals.jsonl";
    const fs::path job = folder() / "job.json";
    write_bytes(job, R"({"schema": "gumcert/job/1", "kind": "budget", "title": "secret customer", "modle": "y = a"})");
    const std::vector<std::string> command = {"evaluate", job.string(), "-o", "-", "--share", GUMCERT_SOURCE_DIR};
    std::vector<std::string> with_log = command;
    with_log.insert(with_log.end(), {"--refusal-log", log.string()});
    EXPECT_EQ(gumcert(with_log).code, 3);
    const std::vector<std::string> first = lines_of(bytes_of(log));
    ASSERT_FALSE(first.empty());
    for (const std::string& text : first) {
        const nlohmann::json line = nlohmann::json::parse(text);
        EXPECT_EQ(line["command"], "evaluate");
        EXPECT_TRUE(std::regex_match(line["code"].get<std::string>(), std::regex("GC-[A-Z]+-[0-9]{4}"))) << text;
        EXPECT_EQ(line.size(), 4U);
    }
    EXPECT_EQ(bytes_of(log).find("secret"), std::string::npos);
    EXPECT_EQ(gumcert(command, {.environment = {{"GUMCERT_REFUSAL_LOG", log.string()}}}).code, 3);
    EXPECT_EQ(lines_of(bytes_of(log)).size(), 2 * first.size());
    // A file that is no log stays as it is, and the refusal is what it was.
    const std::string before = bytes_of(job);
    with_log.back() = job.string();
    const Ended refused = gumcert(with_log);
    EXPECT_EQ(refused.code, 3);
    EXPECT_NE(refused.err.find("[GC-STORE-0025]"), std::string::npos) << refused.err;
    EXPECT_EQ(bytes_of(job), before);
}

}  // namespace
}  // namespace gumcert::cli
