// What a signal leaves behind: nothing in the temporary folder, no half of a set beside the outputs.
#include <signal.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <thread>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class Interruption : public ProgramTest {
protected:
    void SetUp() override {
        job_ = copy_of_example(folder() / "example");
        fs::create_directory(folder() / "tmp");
    }

    /// Starts `gumcert run`, sends a signal when a condition holds, and waits for the end.
    template <class Condition>
    int run_until(const Condition& condition, int signal) const {
        const std::string program = GUMCERT_PROGRAM;
        const std::string job = job_.string();
        const std::string out = (folder() / "out").string();
        const std::string temporary = "TMPDIR=" + (folder() / "tmp").string();
        const std::string search = std::string("PATH=") + std::getenv("PATH");
        std::array<std::string, 6> words{program, "run", job, "-o", out, "--share=" GUMCERT_SOURCE_DIR};
        std::array<std::string, 2> settings{temporary, search};
        std::vector<char*> argv;
        std::vector<char*> envp;
        for (std::string& word : words) {
            argv.push_back(word.data());
        }
        for (std::string& setting : settings) {
            envp.push_back(setting.data());
        }
        argv.push_back(nullptr);
        envp.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        const std::string said = (folder() / "said").string();
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        pid_t child = 0;
        EXPECT_EQ(posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), envp.data()), 0);
        posix_spawn_file_actions_destroy(&actions);
        int status = 0;
        for (int i = 0; i < 60'000 && !condition(); ++i) {
            if (waitpid(child, &status, WNOHANG) == child) {
                ADD_FAILURE() << "it ended before the signal: " << bytes_of(said);
                return status;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        kill(child, signal);
        waitpid(child, &status, 0);
        return status;
    }
    [[nodiscard]] bool page_is_being_set() const {
        std::error_code error;
        for (fs::recursive_directory_iterator at(folder() / "tmp", error), end; !error && at != end;
             at.increment(error)) {
            constexpr std::uintmax_t k_page_of_characters = 10'000;  // [byte], which is set before the evaluation
            std::error_code gone;
            if (at->path().filename() == "view.json" && fs::file_size(at->path(), gone) > k_page_of_characters &&
                !gone) {
                return true;
            }
        }
        return false;
    }
    [[nodiscard]] std::string said() const { return bytes_of(folder() / "said"); }

    fs::path job_;
};

TEST_F(Interruption, SignalsLeaveNothing) {
    if (!why_no_pdf().empty()) {
        GTEST_SKIP() << why_no_pdf();
    }
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        const int status = run_until([&] { return page_is_being_set(); }, signal);
        EXPECT_TRUE(WIFSIGNALED(status)) << said();
        EXPECT_EQ(WTERMSIG(status), signal);
        EXPECT_TRUE(fs::is_empty(folder() / "tmp")) << "after signal " << signal;
        EXPECT_FALSE(fs::exists(folder() / "out"));
        const std::vector<std::string> lines = lines_of(said());
        ASSERT_FALSE(lines.empty());
        EXPECT_TRUE(is_message_line(lines.back())) << lines.back();
        EXPECT_NE(lines.back().find("documents; nothing was written"), std::string::npos) << lines.back();
        EXPECT_NE(lines.back().find("[GC-STORE-0021]"), std::string::npos);
    }
}

TEST_F(Interruption, WhatAKilledProcessLeavesIsRemovedByTheNext) {
    if (!why_no_pdf().empty()) {
        GTEST_SKIP() << why_no_pdf();
    }
    const int status = run_until([&] { return page_is_being_set(); }, SIGKILL);
    EXPECT_EQ(WTERMSIG(status), SIGKILL);
    const Ended ended =
        gumcert({"evaluate", (folder() / "missing.json").string(), "-o", (folder() / "r.json").string()},
                {.environment = {{"TMPDIR", (folder() / "tmp").string()}}});
    EXPECT_EQ(ended.code, 5);
    EXPECT_TRUE(fs::is_empty(folder() / "tmp"));
}

TEST_F(Interruption, AnIgnoredSignalStaysIgnored) {
    const fs::path record = folder() / "record.json";
    // As nohup does it: the hang-up arrives at once, and the work goes on.
    const Ended ended =
        run_process("/bin/sh",
                    {"-c", "trap '' HUP; \"$0\" evaluate \"$1\" -o \"$2\" -q & sleep 0.1; kill -HUP $!; wait $!",
                     GUMCERT_PROGRAM, job_.string(), record.string()},
                    {}, folder());
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(fs::exists(record));
}

TEST_F(Interruption, AClosedPipeEndsQuietly) {
    const Ended ended =
        run_process("/bin/bash",
                    {"-c", "\"$0\" evaluate \"$1\" -o - --share \"$2\" | true; echo \"${PIPESTATUS[0]}\"",
                     GUMCERT_PROGRAM, job_.string(), GUMCERT_SOURCE_DIR},
                    {}, folder());
    EXPECT_EQ(ended.out, std::to_string(128 + SIGPIPE) + "\n");
    EXPECT_EQ(ended.err.find("GC-STORE"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace gumcert::cli
