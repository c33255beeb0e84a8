#include "manual/shell_completion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gumcert::manual {
namespace {

using testing::HasSubstr;

ProgramDescription program_of_one_command() {
    const ArgumentDescription quiet{
        .names = {"-q", "--quiet"}, .value = {}, .choices = {}, .limits = {}, .explanation = "Don't speak"};
    const ArgumentDescription format{
        .names = {"--format"}, .value = "FORM", .choices = {"html", "pdf"}, .limits = {}, .explanation = "Form: [one]"};
    const ArgumentDescription languages{.names = {"--language"},
                                        .value = "LANGUAGE",
                                        .choices = {"en", "de"},
                                        .limits = {},
                                        .explanation = "Languages",
                                        .required = false,
                                        .many = true,
                                        .list = true};
    const ArgumentDescription threads{
        .names = {"--threads"}, .value = "INT", .choices = {}, .limits = "INT in [1 - 8]", .explanation = "Threads"};
    const ArgumentDescription folder{
        .names = {"-o"}, .value = "FOLDER", .choices = {}, .limits = {}, .explanation = "Where\nto"};
    const ArgumentDescription kind{
        .names = {"KIND"}, .value = {}, .choices = {"dcc"}, .limits = {}, .explanation = "Kind"};
    return {.program = {.name = "gumcert", .explanation = {}, .footer = {}, .positionals = {}, .options = {quiet}},
            .commands = {{.name = "import",
                          .explanation = "Take numbers over",
                          .footer = {},
                          .positionals = {kind},
                          .options = {format, languages, threads, folder}}}};
}

TEST(BashCompletion, KnowsCommandsOptionsAndTheirValues) {
    const std::string script = bash_completion(program_of_one_command());
    EXPECT_THAT(script, HasSubstr("        ' 0') replies='import' ;;\n"));
    EXPECT_THAT(script, HasSubstr("        '') replies='-q --quiet' ;;\n"));
    EXPECT_THAT(script, HasSubstr("        'import') replies='--format --language --threads -o' ;;\n"));
    EXPECT_THAT(script, HasSubstr("        'import --format') replies='html pdf' ;;\n"));
    EXPECT_THAT(script, HasSubstr("        'import --language') replies='en de' list=yes ;;\n"));
    EXPECT_THAT(script, HasSubstr("        'import 0') replies='dcc' ;;\n"));
    EXPECT_THAT(script, HasSubstr("            'import --format' | \\\n            'import --language' | \\\n"
                                  "            'import --threads' | \\\n            'import -o')\n"))
        << "options that await a value, without flags";
}

TEST(ZshCompletion, SaysWhatAnOptionIsAndWhatItTakes) {
    const std::string script = zsh_completion(program_of_one_command());
    EXPECT_THAT(script, HasSubstr("#compdef gumcert\n"));
    EXPECT_THAT(script, HasSubstr(R"('(-q --quiet)'{-q,--quiet}'[Don'\''t speak]')"));
    EXPECT_THAT(script, HasSubstr(R"('(--format)'--format'[Form\: \[one\]]:FORM:(html pdf)')"));
    EXPECT_THAT(script, HasSubstr("'(--language)'--language'[Languages]:LANGUAGE:_sequence compadd - en de'"));
    EXPECT_THAT(script, HasSubstr("'(--threads)'--threads'[Threads]:INT: '")) << "a number is no file";
    EXPECT_THAT(script, HasSubstr("'(-o)'-o'[Where to]:FOLDER:_files -/'"));
    EXPECT_THAT(script, HasSubstr("':KIND:(dcc)'"));
    EXPECT_THAT(script, HasSubstr("            'import:Take numbers over'\n"));
}

TEST(FishCompletion, SaysWhatAnOptionIsAndWhatItTakes) {
    const std::string script = fish_completion(program_of_one_command());
    EXPECT_THAT(script, HasSubstr("complete -c gumcert -n __fish_use_subcommand -s q -l quiet -d 'Don\\'t speak'\n"));
    const std::string in_import = "complete -c gumcert -n '__fish_seen_subcommand_from import'";
    EXPECT_THAT(script, HasSubstr(in_import + " -l format -x -a 'html pdf' -d 'Form: [one]'\n"));
    EXPECT_THAT(script, HasSubstr(in_import + " -l threads -x -d 'Threads'\n"));
    EXPECT_THAT(script, HasSubstr(in_import + " -s o -r -F -d 'Where to'\n"));
    EXPECT_THAT(script, HasSubstr(in_import + " -a 'dcc'\n"));
    EXPECT_THAT(script,
                HasSubstr("complete -c gumcert -f -n __fish_use_subcommand -a import -d 'Take numbers over'\n"));
}

}  // namespace
}  // namespace gumcert::manual
