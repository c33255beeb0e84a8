// Where output goes, and that it appears whole or not at all.
#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class Output : public ProgramTest {
protected:
    void SetUp() override { job_ = ExactCampaign{}.write(folder() / "job"); }

    /// A command that cannot write ends with 5, one message with the code, and leaves everything as it was.
    Message trouble(std::vector<std::string> arguments, const Surroundings& where = {}) const {
        arguments.emplace_back("--json-messages");
        const auto before = contents_of(folder());
        const Ended ended = gumcert(arguments, where);
        EXPECT_EQ(ended.code, 5) << ended.err;
        EXPECT_EQ(ended.out, "");
        EXPECT_EQ(contents_of(folder()), before);
        const std::vector<Message> messages = json_messages(ended);
        EXPECT_EQ(messages.size(), 1U) << ended.err;
        return messages.empty() ? Message{} : messages[0];
    }
    void need_pdf() const {
        if (!why_no_pdf().empty()) {
            GTEST_SKIP() << why_no_pdf();
        }
    }

    fs::path job_;
};

TEST_F(Output, PlaceThatCannotBeWrittenIsToldBeforeAnythingIsComputed) {
    // The job is refused, too: that the place is told shows that it was looked at first.
    write_bytes(folder() / "job" / "lengths.csv", "");
    write_bytes(folder() / "a file", "kept");
    const std::string below = (folder() / "a file" / "out").string();
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"run", job_.string(), "-o", below},
                                               {"run", job_.string(), "-o", (folder() / "a file").string()},
                                               {"run", job_.string(), "-o", below + "/deeper"},
                                               {"evaluate", job_.string(), "-o", below},
                                               {"evaluate", job_.string(), "-o", (folder() / "job").string()}}) {
        const Message message = trouble(arguments);
        EXPECT_EQ(message.code, "GC-STORE-0002");
        EXPECT_EQ(message.severity, "error");
        EXPECT_NE(message.what.find("folder"), std::string::npos) << message.what;
        EXPECT_NE(message.action.find("-o"), std::string::npos) << message.action;
    }
}

/// A name of a file is one line on a terminal that does nothing: no command prints what such a name tells the terminal to do,
/// or a line of its own.
TEST_F(Output, NamesOfFilesAreOneHonestLine) {
    const fs::path odd = folder() / "a\x1b[31m\nb: valid";
    write_bytes(
        odd / "job.json",
        R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["y = x"], "inputs": {"x": {"value": 1, "u": 0.1}}})");
    const std::string job = (odd / "job.json").string();
    const std::string record = (odd / "record.json").string();
    const std::string share = GUMCERT_SOURCE_DIR;
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"evaluate", job, "-o", record, "--share", share},
             {"render", record, "--format", "dcc", "-o", (odd / "c.xml").string(), "--share", share},
             {"check", job, record, "--share", share},
             {"check", "dcc", (odd / "c.xml").string()},
             {"import", "dcc", (odd / "c.xml").string(), "-o", (odd / "i.json").string()},
             {"audit", job, "-o", (odd / "a.json").string(), "--share", share},
             {"rerun", record, "--share", share},
             {"init", "multimeter", (odd / "m").string(), "--share", share}}) {
        const Ended ended = gumcert(arguments);
        EXPECT_LE(ended.code, 1) << arguments[0] << ended.err;
        EXPECT_NE(ended.out, "") << arguments[0];
        for (const std::string& told : {ended.out, ended.err}) {
            EXPECT_EQ(told.find('\x1b'), std::string::npos) << arguments[0] << told;
            for (const std::string& line : lines_of(told)) {
                EXPECT_FALSE(line.starts_with("b: valid")) << arguments[0] << told;
            }
        }
    }
}

/// Where standard output takes nothing, "-" is no name of a file or folder either.
TEST_F(Output, StandardOutputIsNoFolderAndNoArchive) {
    const std::string store = (folder() / "a.archive").string();
    ASSERT_EQ(gumcert({"archive", "init", "--store", store, "--by", "K"}).code, 0);
    const auto before = contents_of(folder());
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"run", job_.string(), "-o", "-"},
                                               {"run", job_.string(), job_.string(), "-o", "-"},
                                               {"self-test", "-o", "-"},
                                               {"init", "multimeter", "-"},
                                               {"archive", "init", "--store", "-", "--by", "K"},
                                               {"archive", "backup", "--store", store, "--by", "K", "-o", "-"},
                                               {"archive", "migrate", "--store", store, "--to", "-"},
                                               {"archive", "affected", "--store", store, "--source", "S", "--since",
                                                "2026-01-01", "--register", ".", "-o", "-"}}) {
        const Ended ended = gumcert(arguments, {.working_folder = folder()});
        EXPECT_EQ(ended.code, 2) << arguments[0] << ended.err;
        EXPECT_NE(ended.err.find(" -"), std::string::npos);
        EXPECT_EQ(ended.out, "");
        EXPECT_EQ(contents_of(folder()), before) << arguments[0];
    }
    // Where it takes one document it gets it, and a name with a folder is a name.
    EXPECT_EQ(gumcert({"archive", "head", "--store", store, "-o", "-"}).code, 0);
    EXPECT_EQ(
        gumcert({"archive", "backup", "--store", store, "--by", "K", "-o", "./-"}, {.working_folder = folder()}).code,
        0);
    EXPECT_TRUE(fs::is_regular_file(folder() / "-"));
}

TEST_F(Output, MissingJobIsAFileTrouble) {
    for (const char* const command : {"run", "evaluate"}) {
        const Message message =
            trouble({command, (folder() / "missing.json").string(), "-o", (folder() / "out").string()});
        EXPECT_EQ(message.code, "GC-STORAGE-0001");
        EXPECT_NE(message.where.find("missing.json"), std::string::npos);
        // A folder in place of a job: nothing is written into what is read.
        EXPECT_EQ(trouble({command, folder().string(), "-o", (folder() / "out").string()}).code, "GC-STORE-0004");
    }
}

TEST_F(Output, ReadOnlyFolderIsTold) {
    const fs::path closed = folder() / "closed";
    fs::create_directory(closed);
    fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec);
    if (access(closed.c_str(), W_OK) == 0) {
        GTEST_SKIP() << "this user may write into read-only folders";
    }
    EXPECT_EQ(trouble({"run", job_.string(), "-o", (closed / "out").string()}).code, "GC-STORE-0002");
}

TEST_F(Output, WithoutTheTypstPackageTheSetUpIsNamed) {
    fs::create_directories(folder() / "share" / "node_modules");  // without any, that of the program is used
    fs::copy(fs::path(GUMCERT_SOURCE_DIR) / "templates", folder() / "share" / "templates", fs::copy_options::recursive);
    const Message message =
        trouble({"run", job_.string(), "-o", (folder() / "out").string(), "--share", (folder() / "share").string()});
    EXPECT_TRUE(message.code.starts_with("GC-REPORT-")) << message.code;
    EXPECT_NE(message.action.find("scripts/setup"), std::string::npos) << message.action;
    EXPECT_EQ(message.severity, "error");
}

TEST_F(Output, WithoutNodeTheSetUpIsNamed) {
    const Message message =
        trouble({"run", job_.string(), "-o", (folder() / "out").string(), "--share", GUMCERT_SOURCE_DIR},
                {.environment = {{"PATH", folder().string()}}});
    EXPECT_TRUE(message.code.starts_with("GC-REPORT-")) << message.code;
    EXPECT_NE(message.action.find("scripts/setup"), std::string::npos) << message.action;
    // What needs no PDF works without it.
    EXPECT_EQ(gumcert({"evaluate", job_.string(), "-o", (folder() / "record.json").string()},
                      {.environment = {{"PATH", folder().string()}}})
                  .code,
              0);
}

TEST_F(Output, WithoutTemplatesTheOptionIsNamed) {
    // A program that was taken out of its installation.
    const fs::path lonely = folder() / "a" / "b" / "c" / "d" / "e" / "f" / "g" / "gumcert";
    fs::create_directories(lonely.parent_path());
    fs::copy_file(GUMCERT_PROGRAM, lonely);
    const auto before = contents_of(folder());
    const fs::path scratch = folder().parent_path();
    const Ended ended = run_process(lonely, {"run", job_.string(), "-o", (folder() / "out").string()}, {}, scratch);
    EXPECT_EQ(ended.code, 5);
    EXPECT_NE(ended.err.find("--share"), std::string::npos) << ended.err;
    EXPECT_EQ(contents_of(folder()), before);
}

TEST_F(Output, InstalledProgramFindsItsTemplates) {
    const fs::path installed = folder() / "installed";
    fs::create_directories(installed / "bin");
    fs::create_directories(installed / "share" / "gumcert");
    fs::copy_file(GUMCERT_PROGRAM, installed / "bin" / "gumcert");
    fs::create_directory_symlink(fs::path(GUMCERT_SOURCE_DIR) / "templates",
                                 installed / "share" / "gumcert" / "templates");
    const fs::path record = folder() / "record.json";
    ASSERT_EQ(gumcert({"evaluate", job_.string(), "-o", record.string()}).code, 0);
    const Ended ended = run_process(installed / "bin" / "gumcert", {"render", record.string(), "--format", "html"}, {},
                                    folder().parent_path());
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(fs::exists(folder() / "record.html"));
}

TEST_F(Output, DefaultFolderStandsBesideTheJob) {
    need_pdf();
    const Ended ended = gumcert({"run", "job/job.json", "--share", GUMCERT_SOURCE_DIR}, {.working_folder = folder()});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(contents_of(folder() / "job" / "job-out").size(), 7U) << "with the manifest";
}

TEST_F(Output, SecondRunReplacesItsOwnFilesOnly) {
    need_pdf();
    write_bytes(folder() / "out" / "record.json", "old");
    write_bytes(folder() / "out" / "notes.txt", "mine");
    ASSERT_EQ(run(job_, folder() / "out").code, 0);
    const auto first = contents_of(folder() / "out");
    ASSERT_EQ(run(job_, folder() / "out").code, 0);
    EXPECT_EQ(contents_of(folder() / "out"), first);
    EXPECT_EQ(first.size(), 8U) << "with the manifest";
    EXPECT_EQ(first.at("notes.txt"), "mine");
    EXPECT_NE(first.at("record.json"), "old");
}

TEST_F(Output, RefusedJobLeavesTheOldFilesAsTheyWere) {
    need_pdf();
    ASSERT_EQ(run(job_, folder() / "out").code, 0);
    const auto first = contents_of(folder() / "out");
    replace_in(folder() / "job" / "lengths.csv", ",R2,", ",R9,");
    EXPECT_EQ(run(job_, folder() / "out").code, 3);
    EXPECT_EQ(contents_of(folder() / "out"), first);
}

// What a PDF lacks is told before an evaluation is lost, but never in place of what is wrong with the job.
TEST_F(Output, AMachineWithoutNodeIsToldAtOnceAndAFaultOfTheJobBefore) {
    const Surroundings nothing_on_the_path{.environment = {{"PATH", (folder() / "empty").string()}}};
    const std::vector<std::string> run = {"run",     job_.string(),     "-o", (folder() / "out").string(),
                                          "--share", GUMCERT_SOURCE_DIR};
    const Ended without = gumcert(run, nothing_on_the_path);
    EXPECT_EQ(without.code, 5) << without.err;
    EXPECT_NE(without.err.find("node"), std::string::npos) << without.err;
    EXPECT_FALSE(fs::exists(folder() / "out"));
    replace_in(folder() / "job" / "lengths.csv", ",R2,", ",R9,");
    const Ended wrong = gumcert(run, nothing_on_the_path);
    EXPECT_EQ(wrong.code, 3) << wrong.err;
    EXPECT_NE(wrong.err.find("R9"), std::string::npos) << wrong.err;
}

// A character without a glyph is found when the page is set, after everything was computed.
TEST_F(Output, TheRecordIsKeptWhenADocumentCannotBeMade) {
    need_pdf();
    const fs::path out = folder() / "out";
    ASSERT_EQ(run(job_, out).code, 0);
    const std::map<std::string, std::string> old = contents_of(out);
    change_json(job_, [](nlohmann::json& job) { job["title"] = "Table \U0001F600"; });
    const Ended failed = run(job_, out);
    EXPECT_EQ(failed.code, 5) << "a file could not be made; the result is there: " << failed.err;
    EXPECT_LT(failed.err.find("[GC-REPORT-0045]"), failed.err.find("[GC-STORE-0022]")) << "told before: " << failed.err;
    EXPECT_NE(failed.err.find("job.json#/title"), std::string::npos) << failed.err;
    EXPECT_LT(failed.err.find("[GC-STORE-0022]"), failed.err.find("[GC-REPORT-0011]")) << failed.err;
    std::map<std::string, std::string> after = contents_of(out);
    for (const auto& [name, bytes] : old) {
        EXPECT_EQ(after[name], bytes) << name << " belongs to the old set";
    }
    const fs::path kept = out / "record-kept";
    EXPECT_TRUE(fs::exists(kept / "covariance.csv"));
    EXPECT_EQ(gumcert({"check", kept.string()}).code, 0) << "a set of its own";
    EXPECT_EQ(gumcert({"check", out.string()}).code, 0);
    const fs::path page = folder() / "page.html";
    const Ended rendered = gumcert({"render", (kept / "record.json").string(), "--format", "html", "-o", page.string(),
                                    "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(rendered.code, 0) << rendered.err;
    change_json(job_, [](nlohmann::json& job) { job["title"] = "Table"; });
    const Ended good = run(job_, out);
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_NE(good.err.find("[GC-STORE-0023]"), std::string::npos) << "what was kept is older: " << good.err;
}

}  // namespace
}  // namespace gumcert::cli
