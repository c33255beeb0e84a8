// Documented limits: told, and refused with a code beyond.
#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class Limits : public ProgramTest {
protected:
    /// A budget whose input a is stated by some text, with more keys.
    [[nodiscard]] Ended evaluated(const std::string& a, const std::string& more = "") const {
        const fs::path job = folder() / "job.json";
        write_bytes(job, R"({"schema": "gumcert/job/1", "kind": "budget", "title": "t", "model": ["y = a"],
                            "inputs": {"a": )" +
                             a + "}" + more + "}");
        return gumcert({"evaluate", job.string(), "-o", (folder() / "record.json").string(), "--json-messages", "-q",
                        "--share", GUMCERT_SOURCE_DIR});
    }
    static std::string repeated(const std::string& text, std::size_t times, const std::string& between = ",") {
        std::string all;
        for (std::size_t i = 0; i < times; ++i) {
            all += (i == 0 ? "" : between) + text;
        }
        return all;
    }
    static void expect_refused(const Ended& ended, const std::string& code) {
        EXPECT_EQ(ended.code, 3) << ended.err.substr(0, 1000);
        const std::vector<Message> messages = json_messages(ended);
        ASSERT_FALSE(messages.empty());
        EXPECT_EQ(messages.front().code, code) << messages.front().what;
    }
};

constexpr const char* k_input = R"({"value": 1, "u": 0.1})";

TEST_F(Limits, AreListed) {
    const Ended ended = gumcert({"limits"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    for (const char* text : {"files of a job:", "64 MiB  a file", "100 000  points", "30 s  time", "4 GiB  memory"}) {
        EXPECT_NE(ended.out.find(text), std::string::npos) << text << " is missing in\n" << ended.out;
    }
}

TEST_F(Limits, OneBeyondIsRefusedWithItsCode) {
    expect_refused(evaluated(k_input, ", \"notes\": " + repeated("[", 65, "") + repeated("]", 65, "")),
                   "GC-INPUT-0011");
    expect_refused(evaluated(k_input, ", \"notes\": \"" + std::string((1U << 20U) + 1, 'x') + '"'), "GC-INPUT-0015");
    expect_refused(evaluated(k_input, std::string(std::size_t{64} << 20U, ' ')), "GC-INPUT-0001");
    expect_refused(evaluated(R"({"components": [)" + repeated(k_input, 1001) + "]}"), "GC-INPUT-0030");
}

/// One point more than a job may have.
TEST_F(Limits, OnePointBeyondIsRefused) {
    std::string text = "a\n";
    for (std::size_t i = 0; i < 100'001; ++i) {
        text += std::to_string(i) + ".5\n";
    }
    write_bytes(folder() / "points.csv", text);
    expect_refused(evaluated(k_input, R"(, "points": {"file": "points.csv"})"), "GC-INPUT-0107");
}

}  // namespace
}  // namespace gumcert::cli
