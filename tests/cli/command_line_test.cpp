// The command line itself: help, version, refused usage, the form of messages.
#include <regex>
#include <set>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class CommandLine : public ProgramTest {};

TEST_F(CommandLine, WithoutArgumentsPrintsHelp) {
    const Ended ended = gumcert({});
    EXPECT_EQ(ended.code, 0);
    EXPECT_EQ(ended.err, "");
    for (const char* const word : {"run", "evaluate", "render", "--version", "Exit codes"}) {
        EXPECT_NE(ended.out.find(word), std::string::npos) << word;
    }
}

TEST_F(CommandLine, HelpOfTheProgramAndOfEachCommand) {
    const Ended whole = gumcert({"--help"});
    EXPECT_EQ(whole.code, 0);
    EXPECT_EQ(whole.err, "");
    EXPECT_EQ(whole.out, gumcert({}).out);
    const std::map<std::string, std::vector<std::string>> options{
        {"run", {"JOB", "--output", "--quiet", "--threads", "--json-messages"}},
        {"evaluate", {"JOB", "--output", "--quiet", "--threads", "--json-messages"}},
        {"render", {"RECORD", "--format", "--output", "--language", "--quiet", "--threads", "--json-messages"}}};
    for (const auto& [command, words] : options) {
        const Ended help = gumcert({command, "--help"});
        EXPECT_EQ(help.code, 0) << command;
        EXPECT_EQ(help.err, "") << command;
        for (const std::string& word : words) {
            EXPECT_NE(help.out.find(word), std::string::npos) << command << ": " << word;
        }
    }
}

TEST_F(CommandLine, VersionNamesCommitAndDigestOfTheProgram) {
    const Ended ended = gumcert({"--version"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_EQ(ended.err, "");
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(ended.out, parts,
                                 std::regex("gumcert ([0-9]+\\.[0-9]+\\.[0-9]+)\n"
                                            "commit ([0-9a-f]{12}(-modified)?|unknown)\n"
                                            "sha256 ([0-9a-f]{64})\n")))
        << ended.out;
    const fs::path other = on_search_path("sha256sum");
    if (other.empty()) {
        GTEST_SKIP() << "sha256sum is not installed: the digest was not compared";
    }
    const Ended second = run_process(other, {GUMCERT_PROGRAM}, {}, folder());
    EXPECT_EQ(second.out.substr(0, 64), parts[4].str());
}

class WrongCommandLine : public ProgramTest {
protected:
    void SetUp() override {
        job_ = copy_of_example(folder() / "job");
        write_bytes(folder() / "record.json", "{}");
    }
    fs::path job_;
};

TEST_F(WrongCommandLine, IsRefusedAndNothingIsWritten) {
    const std::string job = job_.string();
    const std::string record = (folder() / "record.json").string();
    const std::vector<std::vector<std::string>> wrong{
        {"frobnicate"},
        {"frobnicate", job},
        {"--frobnicate"},
        {"run"},
        {"run", "--frobnicate", job},
        {"run", job, job},
        {"run", job, "--language", "en,de,es"},
        {"run", job, "-o"},
        {"run", job, "--threads", "0"},
        {"run", job, "--threads", "-1"},
        {"run", job, "--threads", "two"},
        {"run", job, "--threads"},
        {"run", job, "--quiet=maybe"},
        {"evaluate"},
        {"evaluate", job, "another.json"},
        {"import", "dcc"},
        {"import", "pdf", job},
        {"verify", record},
        {"render"},
        {"render", record},
        {"render", "--format", "html"},
        {"render", record, "--format", "docx"},
        {"render", record, "--format", "html", "--language", "fr"},
    };
    const auto before = contents_of(folder());
    for (const std::vector<std::string>& arguments : wrong) {
        std::string command = "gumcert";
        for (const std::string& argument : arguments) {
            command += " " + argument;
        }
        SCOPED_TRACE(command);
        const Ended ended = gumcert(arguments, {.working_folder = folder()});
        EXPECT_EQ(ended.code, 2);
        EXPECT_EQ(ended.out, "");
        const std::vector<std::string> lines = lines_of(ended.err);
        ASSERT_EQ(lines.size(), 1U) << ended.err;
        EXPECT_TRUE(is_message_line(lines[0])) << lines[0];
        EXPECT_TRUE(lines[0].ends_with("[GC-USAGE-0001]")) << lines[0];
        EXPECT_EQ(contents_of(folder()), before);
    }
}

/// A variable of the shell that is not set must not leave out a signature, a mark or a head: of every command, each option
/// with a value and each word.
TEST_F(WrongCommandLine, AnEmptyWordIsNoOptionThatIsNotThere) {
    const std::map<std::string, std::vector<std::string>> words{{"run", {"job.json"}},
                                                                {"evaluate", {"job.json"}},
                                                                {"compare", {"job.json"}},
                                                                {"render", {"record.json"}},
                                                                {"import", {"dcc", "c.xml"}},
                                                                {"check", {"job.json"}},
                                                                {"audit", {"job.json"}},
                                                                {"verify", {"c.xml"}},
                                                                {"archive", {"list"}},
                                                                {"simulate", {"job.json"}},
                                                                {"plan", {"job.json"}},
                                                                {"laboratory", {"."}},
                                                                {"self-test", {}},
                                                                {"rerun", {"record.json"}},
                                                                {"init", {"multimeter"}},
                                                                {"explain", {"GC-RANK"}},
                                                                {"fonts", {}},
                                                                {"limits", {}}};
    const auto before = contents_of(folder());
    const auto expect_refused = [&](const std::vector<std::string>& arguments, const std::string& name) {
        const Ended ended = gumcert(arguments, {.working_folder = folder()});
        EXPECT_EQ(ended.code, 2) << arguments[0] << " " << name;
        EXPECT_NE(ended.err.find(name), std::string::npos) << arguments[0] << " " << name << ended.err;
        EXPECT_TRUE(ended.err.ends_with("[GC-USAGE-0001]\n")) << ended.err;
        EXPECT_EQ(ended.out, "");
        EXPECT_EQ(contents_of(folder()), before);
    };
    const std::vector<std::string> help = lines_of(gumcert({"--help"}).out);
    std::size_t options = 0;
    std::set<std::string> common;
    for (auto line = std::find(help.begin(), help.end(), "Subcommands:") + 1; !line->empty(); ++line) {
        std::smatch of_command;
        if (!std::regex_search(*line, of_command, std::regex("^  ([a-z-]+) "))) {
            continue;
        }
        const std::string command = of_command[1];
        ASSERT_TRUE(words.contains(command)) << command;
        std::vector<std::string> base{command};
        base.insert(base.end(), words.at(command).begin(), words.at(command).end());
        for (const std::string& text : lines_of(gumcert({command, "--help"}).out)) {
            std::smatch of_option;
            if (!std::regex_search(text, of_option, std::regex("^ +(-[a-z],)?(--[a-z-]+)[ :][A-Z]"))) {
                continue;
            }
            const std::string option = of_option[2];
            const bool everywhere = option == "--threads" || option.ends_with("-limit") || option == "--refusal-log";
            if (everywhere && !common.insert(option).second) {
                continue;
            }
            std::vector<std::string> arguments = base;
            for (const auto& [needed, value] : {std::pair("--format", "text"), std::pair("--trust", "t.pem")}) {
                const bool is_needed = (command == "render" && needed == std::string("--format")) ||
                                       (command == "verify" && needed == std::string("--trust"));
                if (is_needed && option != needed) {
                    arguments.insert(arguments.end(), {needed, value});
                }
            }
            arguments.insert(arguments.end(), {option, ""});
            expect_refused(arguments, option);
            ++options;
        }
    }
    EXPECT_GT(options, 60U) << "the help is not read";
    const std::vector<std::pair<std::vector<std::string>, std::string>> positional{
        {{"run", ""}, "JOB"},
        {{"run", "job.json", ""}, "JOB"},
        {{"evaluate", ""}, "JOB"},
        {{"check", ""}, "FILE"},
        {{"rerun", ""}, "RECORD"},
        {{"explain", ""}, "CODE"},
        {{"init", "multimeter", ""}, "DIR"},
        {{"import", "dcc", ""}, "FILE"},
        {{"archive", "show", "", "--store", "s"}, "NAME"},
        {{"archive", "review", "", "--store", "s", "--by", "B"}, "NAME"}};
    for (const auto& [arguments, name] : positional) {
        expect_refused(arguments, name);
    }
}

/// What an option asks for is done, or it is said that it is not.
TEST_F(WrongCommandLine, AnOptionThatSaysNothingIsRefused) {
    for (const char* const form : {"html", "text", "csv", "report", "report-html", "label", "label-svg"}) {
        const Ended ended =
            gumcert({"render", "record.json", "--format", form, "--sign", "signer.json"}, {.working_folder = folder()});
        EXPECT_EQ(ended.code, 2) << form;
        EXPECT_NE(ended.err.find("--sign"), std::string::npos) << ended.err;
    }
    for (const char* const form : {"pdf", "dcc"}) {  // what is wrong here is the record
        EXPECT_NE(
            gumcert({"render", "record.json", "--format", form, "--sign", "signer.json"}, {.working_folder = folder()})
                .code,
            2)
            << form;
    }
    const std::vector<std::pair<std::vector<std::string>, std::string>> others{
        {{"check", "job/job.json", "--trust", "t.pem"}, "--trust"},
        {{"check", "dcc", "c.xml", "--laboratory", "."}, "--laboratory"},
        {{"self-test", "--case", "gum-h1-end-gauge", "-o", "out"}, "--output"},
        {{"self-test", "--case", "gum-h1-end-gauge", "--language", "de"}, "--language"}};
    for (const auto& [arguments, option] : others) {
        const Ended ended = gumcert(arguments, {.working_folder = folder()});
        EXPECT_EQ(ended.code, 2) << option;
        EXPECT_NE(ended.err.find(option), std::string::npos) << ended.err;
    }
}

TEST_F(WrongCommandLine, NamesWhatIsWrong) {
    const std::string job = job_.string();
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{"frobnicate"}, "frobnicate"},
        {{"run", job, "--frobnicate"}, "--frobnicate"},
        {{"run"}, "JOB"},
        {{"render", "record.json"}, "--format"},
        {{"render", "record.json", "--format", "docx"}, "docx"},
        {{"run", job, "--threads", "two"}, "two"},
    };
    for (const auto& [arguments, word] : wrong) {
        EXPECT_NE(gumcert(arguments).err.find(word), std::string::npos) << gumcert(arguments).err;
    }
}

TEST_F(WrongCommandLine, IsToldAsJsonWhenAsked) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"--json-messages", "frobnicate"},
                                               {"--json-messages", "run", "--frobnicate"},
                                               {"--json-messages", "render", "record.json", "--format", "docx"},
                                               {"render", "record.json", "--format", "docx", "--json-messages"}}) {
        const Ended ended = gumcert(arguments);
        EXPECT_EQ(ended.code, 2);
        const std::vector<Message> messages = json_messages(ended);
        ASSERT_EQ(messages.size(), 1U) << ended.err;
        EXPECT_EQ(messages[0].code, "GC-USAGE-0001");
        EXPECT_EQ(messages[0].severity, "error");
        EXPECT_FALSE(messages[0].rule.empty());
    }
}

class Messages : public ProgramTest {
protected:
    void SetUp() override { job_ = ExactCampaign{}.write(folder() / "job"); }
    fs::path job_;
};

TEST_F(Messages, JsonAndTextSayTheSame) {
    replace_in(job_.parent_path() / "lengths.csv", ",R2,", ",R9,");
    change_json(job_, [](nlohmann::json& job) { job["axsis"] = "A"; });
    const Ended text = gumcert({"run", job_.string(), "-o", (folder() / "out").string()});
    const Ended as_json = gumcert({"run", job_.string(), "-o", (folder() / "out").string(), "--json-messages"});
    EXPECT_EQ(text.code, 3);
    EXPECT_EQ(as_json.code, 3);
    EXPECT_EQ(text.out, "");
    EXPECT_EQ(as_json.out, "");
    const std::vector<Message> messages = json_messages(as_json);
    const std::vector<std::string> lines = lines_of(text.err);
    ASSERT_EQ(messages.size(), 2U) << as_json.err;
    ASSERT_EQ(lines.size(), 2U) << text.err;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Message& m = messages[i];
        EXPECT_EQ(m.severity, "error");
        EXPECT_EQ(lines[i], m.where + " — " + m.what + " — " + m.rule + " — " + m.action + " [" + m.code + "]");
    }
}

TEST_F(Messages, WarningsAreToldAndStandInTheRecord) {
    // A column that the program does not use.
    const fs::path fixture = job_.parent_path() / "fixture.csv";
    std::string text;
    for (const std::string& line : lines_of(bytes_of(fixture))) {
        text += line + (text.empty() ? ",remark\n" : ",ok\n");
    }
    write_bytes(fixture, text);
    const std::string record = (folder() / "record.json").string();
    const Ended ended = gumcert({"evaluate", job_.string(), "-o", record, "--json-messages", "--quiet"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out, "") << "--quiet";
    const std::vector<Message> messages = json_messages(ended);
    const nlohmann::json document = nlohmann::json::parse(bytes_of(record));
    const auto is_remark = [](const Message& m) {
        return m.code == "GC-WARN-0001" && m.severity == "warning" && m.where.starts_with("fixture.csv:1:") &&
               m.what.find("remark") != std::string::npos;
    };
    EXPECT_EQ(std::count_if(messages.begin(), messages.end(), is_remark), 1) << ended.err;
    EXPECT_EQ(std::count_if(
                  document["diagnostics"].begin(), document["diagnostics"].end(),
                  [](const nlohmann::json& d) { return d["code"] == "GC-WARN-0001" && d["severity"] == "warning"; }),
              1);
    const Ended in_text = gumcert({"evaluate", job_.string(), "-o", record});
    EXPECT_NE(in_text.err.find("warning: fixture.csv:1:"), std::string::npos) << in_text.err;
    EXPECT_NE(in_text.out.find(record), std::string::npos) << in_text.out;
}

TEST_F(Messages, QuietSaysNothingWhenThereIsNothingToSay) {
    const fs::path job = copy_of_example(folder() / "example");
    const Ended ended = gumcert({"--quiet", "evaluate", job.string(), "-o", (folder() / "record.json").string()});
    EXPECT_EQ(ended.code, 0);
    EXPECT_EQ(ended.out, "");
    for (const std::string& line : lines_of(ended.err)) {
        EXPECT_TRUE(line.starts_with("warning: ")) << line;
    }
    // An error is told all the same.
    const Ended refused = gumcert({"--quiet", "run", (folder() / "missing.json").string()});
    EXPECT_EQ(refused.code, 5);
    EXPECT_NE(refused.err, "");
}

}  // namespace
}  // namespace gumcert::cli
