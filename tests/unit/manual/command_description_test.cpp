#include "manual/command_description.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

namespace gumcert::manual {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(CommandDescription, SaysOfEachArgumentWhatHelpSays) {
    CLI::App program("Measures.", "measure");
    program.footer("Exit codes: 0 done.");
    CLI::App& run = *program.add_subcommand("run", "Measure once");
    std::vector<std::string> jobs;
    std::vector<std::string> languages;
    std::string output;
    int threads = 0;
    bool quiet = false;
    run.add_option("JOB", jobs, "Job files")->required();
    run.add_option("-o,--output", output, "Where to")->type_name("FOLDER");
    run.add_option("--language", languages, "Languages")
        ->delimiter(',')
        ->type_name("LANGUAGE")
        ->check(CLI::IsMember({"en", "de"}));
    run.add_option("--threads", threads, "Threads")->check(CLI::Range(1, 8));
    run.add_flag("-q,--quiet", quiet, "Say nothing");

    const ProgramDescription all = described(program);
    EXPECT_EQ(all.program.name, "measure");
    EXPECT_EQ(all.program.explanation, "Measures.");
    EXPECT_EQ(all.program.footer, "Exit codes: 0 done.");
    ASSERT_EQ(all.commands.size(), 1U);
    const CommandDescription& command = all.commands.front();
    EXPECT_EQ(command.name, "run");
    ASSERT_EQ(command.positionals.size(), 1U);
    EXPECT_THAT(command.positionals[0].names, ElementsAre("JOB"));
    EXPECT_EQ(command.positionals[0].value, "") << "an argument without the name of an option is its value";
    EXPECT_TRUE(command.positionals[0].required);
    EXPECT_TRUE(command.positionals[0].many);

    ASSERT_EQ(command.options.size(), 5U);
    EXPECT_THAT(command.options[0].names, ElementsAre("-h", "--help"));
    const ArgumentDescription& to = command.options[1];
    EXPECT_THAT(to.names, ElementsAre("-o", "--output"));
    EXPECT_EQ(to.value, "FOLDER");
    EXPECT_EQ(to.explanation, "Where to");
    EXPECT_THAT(to.choices, IsEmpty());
    EXPECT_FALSE(to.required);
    EXPECT_FALSE(to.many);
    EXPECT_EQ(command.options[2].value, "LANGUAGE");
    EXPECT_THAT(command.options[2].choices, ElementsAre("en", "de"));
    EXPECT_TRUE(command.options[2].list) << "values with commas between them";
    EXPECT_EQ(command.options[3].value, "INT");
    EXPECT_EQ(command.options[3].limits, "INT in [1 - 8]");
    EXPECT_EQ(command.options[4].value, "") << "a flag has none";
}

}  // namespace
}  // namespace gumcert::manual
