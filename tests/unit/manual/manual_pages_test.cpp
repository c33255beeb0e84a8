#include "manual/manual_pages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace gumcert::manual {
namespace {

using testing::HasSubstr;
using testing::Not;

const ManualImprint k_imprint{.version = "1.2.3", .day = "2026-11-29", .summary = "measures"};

ProgramDescription measuring_program() {
    const ArgumentDescription output{
        .names = {"-o", "--output"}, .value = "FOLDER", .choices = {}, .limits = {}, .explanation = "Where to: ±5 %"};
    const ArgumentDescription trust{.names = {"--trust"},
                                    .value = "FILE",
                                    .choices = {},
                                    .limits = "one of them",
                                    .explanation = "Whom",
                                    .required = true};
    const ArgumentDescription job{.names = {"JOB"},
                                  .value = {},
                                  .choices = {},
                                  .limits = {},
                                  .explanation = "Job files.",
                                  .required = true,
                                  .many = true};
    return {.program = {.name = "measure",
                        .explanation = "Measures",
                        .footer = "Start here:\n  gumcert run job.json   evaluates it\n\nExit codes: 0 done.",
                        .positionals = {},
                        .options = {}},
            .commands = {
                {.name = "run-it",
                 .explanation = "Measure well-known things",
                 .footer = "Example: gumcert run a\\b.json\n.hidden is no request\n  {\"kind\": 1}\nThat is a job.",
                 .positionals = {job},
                 .options = {output, trust}}}};
}

TEST(ManualPages, AreOneOfTheProgramAndOneOfEachCommand) {
    const auto pages = manual_pages(measuring_program(), k_imprint);
    ASSERT_EQ(pages.size(), 2U);
    const std::string& program = pages.at("measure.1");
    EXPECT_THAT(
        program,
        HasSubstr(".TH MEASURE 1 \"2026-11-29\" \"gumcert 1.2.3\" \"gumcert\"\n.SH NAME\nmeasure \\- measures\n"));
    EXPECT_THAT(program, HasSubstr(".SH COMMANDS\n.TP\n\\fBrun\\-it\\fR\nMeasure well-known things\n"));
    EXPECT_THAT(program, HasSubstr(".SH EXAMPLES\n.TP\n\\fBgumcert run job.json\\fR\nevaluates it\n"));
    EXPECT_THAT(program, HasSubstr(".SH EXIT STATUS\nExit codes: 0 done.\n"));
    EXPECT_THAT(program, Not(HasSubstr("Start here"))) << "the heading of the examples says it";
    EXPECT_THAT(program, HasSubstr(".BR measure\\-run\\-it (1)\n"));
}

TEST(ManualPages, NameTheArgumentsOfACommand) {
    const std::string page = manual_pages(measuring_program(), k_imprint).at("measure-run-it.1");
    EXPECT_THAT(page, HasSubstr("\\fBgumcert run\\-it\\fR [\\fIOPTIONS\\fR] \\fIJOB\\fR...\n"));
    EXPECT_THAT(page, HasSubstr(".SH ARGUMENTS\n.TP\n\\fIJOB\\fR\nJob files.\n.SH OPTIONS\n"))
        << "a sentence gets no second full stop";
    EXPECT_THAT(page, HasSubstr(".TP\n\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fIFOLDER\\fR\nWhere to: \\[u00B1]5 %.\n"));
    EXPECT_THAT(page, HasSubstr("Whom.\none of them.\nRequired.\n"));
}

TEST(ManualPages, TakeNoTextForARequest) {
    const std::string page = manual_pages(measuring_program(), k_imprint).at("measure-run-it.1");
    EXPECT_THAT(page, HasSubstr("\\fBgumcert run a\\eb.json\\fR\n"));
    EXPECT_THAT(page, HasSubstr("\n\\&.hidden is no request\n")) << "a full stop at the beginning would be one";
    EXPECT_THAT(page, HasSubstr(".PP\n.EX\n  {\"kind\": 1}\n.EE\n.PP\nThat is a job.\n"));
    EXPECT_TRUE(std::all_of(page.begin(), page.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }));
}

}  // namespace
}  // namespace gumcert::manual
