// Limits of memory and time, and the log of refusals.
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <thread>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class Ceilings : public ProgramTest {
protected:
    /// A job that takes minutes.
    [[nodiscard]] std::string endless_job(long long trials = 10'000'000'000) const {
        const fs::path job = folder() / "job.json";
        nlohmann::json document = {
            {"schema", "gumcert/job/1"},
            {"kind", "budget"},
            {"title", "Endless"},
            {"model", "y = a + b"},
            {"inputs",
             {{"a", {{"unit", "m"}, {"value", 1}, {"u", 0.1}}},
              {"b", {{"unit", "m"}, {"value", 1}, {"half_width", 0.1}, {"distribution", "uniform"}}}}},
            {"monte_carlo", {{"trials", trials}}}};
        write_bytes(job, document.dump(1));
        return job.string();
    }
    [[nodiscard]] std::string sha256_of(const std::string& bytes) const {
        write_bytes(folder() / "bytes", bytes);
        std::FILE* const said = ::popen(("sha256sum '" + (folder() / "bytes").string() + "'").c_str(), "r");
        std::array<char, 64> digits{};
        EXPECT_EQ(std::fread(digits.data(), 1, digits.size(), said), digits.size());
        ::pclose(said);
        fs::remove(folder() / "bytes");
        return {digits.data(), digits.size()};
    }
    /// A record that says of itself what a sound one says, with a job that takes minutes.
    [[nodiscard]] std::string endless_record() const {
        const std::string record = (folder() / "record.json").string();
        const std::string job = endless_job(7919);
        const std::string before = sha256_of(bytes_of(job));
        const Ended made = gumcert({"evaluate", job, "-o", record, "--share", GUMCERT_SOURCE_DIR, "-q"});
        EXPECT_EQ(made.code, 0) << made.err;
        std::string text = bytes_of(record);
        const auto replace = [&text](const std::string& old, const std::string& now) {
            EXPECT_NE(text.find(old), std::string::npos) << old;
            for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + now.size())) {
                text.replace(at, old.size(), now);
            }
        };
        replace("7919", "10000000000");
        replace(before, sha256_of(bytes_of(endless_job())));
        const std::size_t digest = text.find("\n \"digest\": {");
        const std::size_t end = text.find("},", digest) + 2;
        const std::size_t value = text.find("\"value\": \"", digest) + 10;
        std::string rest = text;
        rest.erase(digest, end - digest);
        text.replace(value, 64, sha256_of(rest));
        write_bytes(record, text);
        return record;
    }
    /// Whether a command gets a wall of memory that this process has not, before it ends or 60 s are over. It is killed then.
    [[nodiscard]] bool gets_a_wall(std::vector<std::string> words) const {
        rlimit own{};
        EXPECT_EQ(::getrlimit(RLIMIT_DATA, &own), 0);
        words.insert(words.begin(), GUMCERT_PROGRAM);
        words.insert(words.end(), {"--share", GUMCERT_SOURCE_DIR, "-q"});
        std::vector<char*> argv;
        for (std::string& word : words) {
            argv.push_back(word.data());
        }
        argv.push_back(nullptr);
        pid_t child = 0;
        EXPECT_EQ(posix_spawn(&child, GUMCERT_PROGRAM, nullptr, nullptr, argv.data(), environ), 0);
        bool has_wall = false;
        int status = 0;
        for (int i = 0; i < 6000 && !has_wall; ++i) {
            rlimit now{};
            has_wall = ::prlimit(child, RLIMIT_DATA, nullptr, &now) == 0 && now.rlim_cur < own.rlim_cur;
            if (!has_wall && waitpid(child, &status, WNOHANG) == child) {
                return false;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
        return has_wall;
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

/// The job in a record of others says how long its evaluation takes: every command that evaluates it has walls then.
TEST_F(Ceilings, RecordsOfOthersAreEvaluatedWithinWalls) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer reserves terabytes: no wall of memory there";
#endif
    const std::string record = endless_record();
    const std::string out = (folder() / "out").string();
    const std::string page = (folder() / "out.html").string();
    const std::vector<std::vector<std::string>> commands = {{"render", record, "--format", "html", "-o", page},
                                                            {"audit", record, "-o", out},
                                                            {"audit", endless_job(), "-o", out},
                                                            {"rerun", record}};
    for (const std::vector<std::string>& command : commands) {
        EXPECT_TRUE(gets_a_wall(command)) << command.front();
        std::vector<std::string> words = command;
        words.insert(words.end(), {"--time-limit", "1", "--share", GUMCERT_SOURCE_DIR});
        const Ended ended = gumcert(words);
        EXPECT_EQ(ended.code, 5) << command.front() << ": " << ended.err;
        EXPECT_TRUE(has(ended.err, "[GC-STORE-0024]")) << ended.err;
        EXPECT_FALSE(fs::exists(out) || fs::exists(page)) << command.front();
    }
    EXPECT_FALSE(gets_a_wall({"evaluate", endless_job(7919), "-o", (folder() / "own.json").string()}))
        << "who evaluates a job of his own waits for it";
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
