#include "signing/external_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "gum/quantity/diagnostic.h"

namespace gumcert::signing {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using testing::HasSubstr;

class ExternalProgram : public testing::Test {
protected:
    ExternalProgram() {
        std::string name = (fs::path(testing::TempDir()) / "gumcert-program-XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    ~ExternalProgram() override { fs::remove_all(folder_); }
    /// A shell script; $0.pid is a file beside it.
    [[nodiscard]] std::string script(const std::string& text) const {
        const fs::path file = folder_ / "sign";
        std::ofstream(file) << "#!/bin/sh\n" << text << "\n";
        chmod(file.c_str(), 0700);
        return file.string();
    }
    static std::string refused(const std::string& program, seconds limit) {
        try {
            return "said " + run_program({program}, "digest", limit);
        } catch (const gum::StorageError& error) {
            return error.what();
        }
    }
    /// Whether the process whose number a script wrote down ends.
    [[nodiscard]] bool has_ended(const std::string& program) const {
        pid_t number = 0;
        std::ifstream(program + ".pid") >> number;
        EXPECT_GT(number, 0);
        for (int i = 0; i < 200; ++i) {
            std::string state;
            std::ifstream status("/proc/" + std::to_string(number) + "/stat");
            std::getline(status, state);
            if (state.empty() || state.find(") Z ") != std::string::npos) {
                return true;
            }
            ::usleep(10'000);
        }
        return false;
    }

    fs::path folder_;
};

TEST_F(ExternalProgram, SaysWhatItIsAsked) {
    EXPECT_EQ(run_program({script("read x; echo \"$x!\"")}, "digest\n", seconds(10)), "digest!\n");
    EXPECT_THAT(refused(script("exit 3"), seconds(10)), HasSubstr("status 3"));
    EXPECT_THAT(refused(script("kill -9 $$"), seconds(10)), HasSubstr("signal 9"));
    EXPECT_THAT(refused("/nowhere/sign", seconds(10)), HasSubstr("cannot be started"));
    EXPECT_THAT(refused(script("head -c 3000000 /dev/zero"), seconds(10)), HasSubstr("more than a signature"));
}

TEST_F(ExternalProgram, EndsAtTheTimeLimitWithWhatItHasStarted) {
    const std::string program = script("sleep 100 & echo $! > $0.pid; sleep 100");
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_THAT(refused(program, seconds(1)), HasSubstr("no answer within 1 s"));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(20));
    EXPECT_TRUE(has_ended(program));
}

TEST_F(ExternalProgram, DoesNotHangOnWhatItLeavesBehind) {
    const std::string program = script("sleep 100 & echo $! > $0.pid; echo answer");
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(run_program({program}, "digest", seconds(60)), "answer\n");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(30)) << "the pipe is open in a process that waits";
    EXPECT_TRUE(has_ended(program));
}

TEST_F(ExternalProgram, ALongAnswerArrivesWhole) {
    EXPECT_EQ(run_program({script("head -c 900000 /dev/zero")}, "digest", seconds(20)).size(), 900'000U);
}

}  // namespace
}  // namespace gumcert::signing
