// Promises that were once broken: exit codes in odd surroundings, inputs that an output would have overwritten,
// messages that hid others.
#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class KeptPromises : public ProgramTest {
protected:
    void SetUp() override {
        job_ = ExactCampaign{}.write(folder() / "job");
        record_ = folder() / "record.json";
        EXPECT_EQ(gumcert({"evaluate", job_.string(), "-o", record_.string()}).code, 0);
    }
    fs::path job_;
    fs::path record_;
};

TEST_F(KeptPromises, FolderInsteadOfARecordIsAFileTrouble) {
    EXPECT_EQ(gumcert({"render", folder().string(), "--format", "html", "--share", GUMCERT_SOURCE_DIR}).code, 5);
}

TEST_F(KeptPromises, MissingTemporaryFolderIsNoTroubleForHtml) {
    const Surroundings where{.environment = {{"TMPDIR", (folder() / "missing").string()}}};
    // HTML needs no temporary folder.
    EXPECT_EQ(gumcert({"render", record_.string(), "--format", "html", "--share", GUMCERT_SOURCE_DIR}, where).code, 0);
}

TEST_F(KeptPromises, ClosedStandardErrorKeepsTheExitCode) {
    const Ended ended =
        run_process("/bin/sh", {"-c", "exec \"$0\" run missing.json 2>&-", GUMCERT_PROGRAM}, {}, folder());
    EXPECT_EQ(ended.code, 5);
}

TEST_F(KeptPromises, DuplicateKeyDoesNotHideTheOtherProblems) {
    const fs::path job = copy_of_example(folder() / "example");
    replace_in(job, "\"datum\":", "\"axis\": \"B\", \"frob\": 1, \"datum\":");
    replace_in(folder() / "example" / "lengths.csv", ",R2,", ",R9,");
    EXPECT_EQ(json_messages(run(job, folder() / "out", {"--json-messages"})).size(), 3U);
}

TEST_F(KeptPromises, AllOrNoneOfTheDocumentsAppear) {
    fs::create_directories(folder() / "out" / "certificate.pdf");
    const auto before = contents_of(folder());
    EXPECT_EQ(run(job_, folder() / "out").code, 5);
    EXPECT_EQ(contents_of(folder()), before);
}

TEST_F(KeptPromises, AnInputIsNotOverwritten) {
    const std::string before = bytes_of(job_);
    EXPECT_NE(gumcert({"evaluate", job_.string(), "-o", job_.string()}).code, 0);
    EXPECT_EQ(bytes_of(job_), before);
    const std::string lengths = bytes_of(job_.parent_path() / "lengths.csv");
    EXPECT_NE(gumcert({"evaluate", job_.string(), "-o", (job_.parent_path() / "lengths.csv").string()}).code, 0);
    EXPECT_EQ(bytes_of(job_.parent_path() / "lengths.csv"), lengths);
}

TEST_F(KeptPromises, MissingTemplatesAreNotTakenForALanguage) {
    const Ended ended =
        gumcert({"render", record_.string(), "--format", "html", "--share", (folder() / "nowhere").string()});
    EXPECT_EQ(ended.code, 5);
    EXPECT_NE(ended.err.find("nowhere"), std::string::npos) << ended.err;
}

TEST_F(KeptPromises, AMessageStaysOneLine) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"a\nb"},
                                               {"render", "a\nb.json", "--format", "html"},
                                               {"run", job_.string(), "-o", record_.string() + "/a\nb"}}) {
        EXPECT_EQ(lines_of(gumcert(arguments).err).size(), 1U) << gumcert(arguments).err;
    }
}

TEST_F(KeptPromises, EveryMessageHasARule) {
    const Ended ended = gumcert({"render", "missing.json", "--format", "html"});
    EXPECT_TRUE(is_message_line(lines_of(ended.err).at(0))) << ended.err;
}

TEST_F(KeptPromises, CovarianceIsSymmetricToTheLastBit) {
    const std::vector<std::string> lines =
        lines_of(bytes_of(record_.parent_path() /
                          nlohmann::json::parse(bytes_of(record_))["rotary"]["covariance"]["file"].get<std::string>()));
    std::vector<std::vector<std::string>> cells;
    for (const std::string& line : lines) {
        cells.emplace_back();
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) {
            cells.back().push_back(cell);
        }
    }
    std::size_t different = 0;
    for (std::size_t i = 1; i < cells.size(); ++i) {
        for (std::size_t j = 0; j + 1 < i; ++j) {
            different += cells[i][j] != cells[j + 1][i - 1] ? 1U : 0U;
        }
    }
    EXPECT_EQ(different, 0U);
}

}  // namespace
}  // namespace gumcert::cli
