// gumcert explain: what the code of a message means.
#include <regex>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class Explain : public ProgramTest {
protected:
    Ended explained(const std::vector<std::string>& words) {
        std::vector<std::string> arguments{"explain", "--share", GUMCERT_SOURCE_DIR};
        arguments.insert(arguments.end(), words.begin(), words.end());
        return gumcert(arguments);
    }
    std::string text(const std::vector<std::string>& words) {
        const Ended ended = explained(words);
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_EQ(ended.err, "");
        return ended.out;
    }
};

TEST_F(Explain, SaysWhatACodeMeansAndWhatToDo) {
    const std::string out = text({"GC-OUTLIER-0001"});
    EXPECT_EQ(lines_of(out).front(), "GC-OUTLIER-0001: warning");
    for (const char* const label : {"  Meaning ", "  Usual cause ", "  What to do ", "  Rule ", "  Result "}) {
        EXPECT_TRUE(has(out, label)) << label;
    }
    EXPECT_TRUE(has(out, "“more than 5 % of a measurement are hardly single blunders”")) << out;
    EXPECT_TRUE(has(out, "finding G03")) << out;
}

TEST_F(Explain, SaysWhetherACertificateIsHeldBack) {
    const std::string blocked = text({"GC-BUDGET-0034"});
    EXPECT_TRUE(has(blocked, "Finding M02: critical.")) << blocked;
    EXPECT_FALSE(has(blocked, "does not stop")) << blocked;
    EXPECT_TRUE(has(text({"GC-RANK-0001"}), "exit code 4"));
}

TEST_F(Explain, WithoutACodeListsTheFamilies) {
    const std::string out = text({});
    for (const char* const family : {"GC-ADJUST", "GC-GUM", "GC-INPUT", "GC-SIGN", "GC-USAGE"}) {
        EXPECT_TRUE(has(out, family)) << family;
    }
}

TEST_F(Explain, ListsTheCodesOfAFamily) {
    const std::string out = text({"gc-reversal"});
    EXPECT_TRUE(has(out, "GC-REVERSAL-0001  No reversal is reported")) << out;
    EXPECT_TRUE(has(out, "GC-REVERSAL-0002")) << out;
    EXPECT_FALSE(has(out, "GC-RANK")) << out;
}

TEST_F(Explain, UnderstandsCodesAsTheyAreCopied) {
    const std::string out = text({"GC-RANK-0001"});
    for (const char* const word : {"[GC-RANK-0001]", "gc-rank-0001", "RANK-0001"}) {
        EXPECT_EQ(text({word}), out) << word;
    }
    EXPECT_EQ(text({"GC-RANK-0001", "GC-RANK-0002"}), out + "\n" + text({"GC-RANK-0002"}));
}

TEST_F(Explain, TellsOfCodesThatAreNoLongerInUse) {
    EXPECT_TRUE(has(text({"GC-INPUT-0200"}), "no longer in use"));
}

TEST_F(Explain, ProposesWhatIsMeantAndPrintsNothingElse) {
    const Ended wrong = explained({"GC-RANK-0001", "GC-OUTLIER-0010", "nonsense"});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_EQ(wrong.out, "");
    ASSERT_EQ(lines_of(wrong.err).size(), 2U) << wrong.err;
    EXPECT_TRUE(has(wrong.err, "\"GC-OUTLIER-0010\" is no code of a message")) << wrong.err;
    EXPECT_TRUE(has(wrong.err, "perhaps one of GC-OUTLIER-0001, GC-OUTLIER-0002, ")) << wrong.err;
    EXPECT_TRUE(has(wrong.err, "[GC-USAGE-0001]")) << wrong.err;
}

TEST_F(Explain, SendsFindingsToTheirDocument) {
    const Ended finding = explained({"G04"});
    EXPECT_EQ(finding.code, 2);
    EXPECT_TRUE(has(finding.err, "docs/findings.md")) << finding.err;
    EXPECT_TRUE(has(finding.err, "GC-ANGLE-0001, GC-ANGLE-0002, GC-GROUP-0001")) << finding.err;
}

TEST_F(Explain, HelpTeaches) {
    const Ended help = gumcert({"explain", "--help"});
    EXPECT_EQ(help.code, 0);
    for (const char* const word : {"CODE", "Example: gumcert explain GC-OUTLIER-0001", "English", "docs/messages.md"}) {
        EXPECT_TRUE(has(help.out, word)) << word;
    }
    EXPECT_TRUE(has(gumcert({"--help"}).out, "gumcert explain CODE"));
}

TEST_F(Explain, ADamagedRegisterIsATroubleOfTheInstallation) {
    const fs::path share = folder() / "share";
    write_bytes(share / "templates/certificate.html.mustache", "x");
    write_bytes(share / "templates/messages.json", "{}");
    const Ended damaged = gumcert({"explain", "--share", share.string()});
    EXPECT_EQ(damaged.code, 5);
    EXPECT_TRUE(has(damaged.err, "[GC-STORE-0011]")) << damaged.err;
    fs::remove(share / "templates/messages.json");
    EXPECT_EQ(gumcert({"explain", "--share", share.string()}).code, 5);
}

TEST_F(Explain, ExplainsTheCodeOfAMessageThatItPrinted) {
    write_bytes(folder() / "job.json", R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["y = a + b"],
        "inputs": {"a": {"value": 1, "u": 0.1, "unit": "mm"}, "b": {"value": 1}}, "extra": 1})");
    const Ended refused = gumcert({"evaluate", (folder() / "job.json").string(), "-o", "-"});
    EXPECT_EQ(refused.code, 3);
    const std::regex code("\\[(GC-[A-Z]+-[0-9]{4})\\]");
    std::size_t codes = 0;
    for (std::sregex_iterator i(refused.err.begin(), refused.err.end(), code); i != std::sregex_iterator(); ++i) {
        EXPECT_TRUE(has(text({(*i)[0].str()}), (*i)[1].str() + ": error")) << (*i)[1].str();
        ++codes;
    }
    EXPECT_GE(codes, 2U) << refused.err;
}

}  // namespace
}  // namespace gumcert::cli
