#include "manual/command_description.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "text/split.h"

namespace gumcert::manual {

namespace {

/// CLI11 tells kind and check of a value in one text: "FORM:{html,pdf}", "INT:INT in [1 - 1024]", "FILE".
void describe_value(const std::string& kind_and_check, ArgumentDescription& argument) {
    const std::size_t colon = kind_and_check.find(':');
    argument.value = kind_and_check.substr(0, colon);
    const std::string check = colon == std::string::npos ? "" : kind_and_check.substr(colon + 1);
    if (check.starts_with('{') && check.ends_with('}')) {
        argument.choices = text::split(check.substr(1, check.size() - 2), ',');
    } else {
        argument.limits = check;
    }
}

ArgumentDescription described(const CLI::Option& option) {
    ArgumentDescription argument;
    argument.explanation = option.get_description();
    argument.required = option.get_required();
    argument.many = option.get_items_expected_max() > 1;
    argument.list = option.get_delimiter() != '\0';
    if (option.get_items_expected_max() > 0) {
        describe_value(option.get_type_name(), argument);
    }
    if (option.get_positional()) {
        argument.names = {option.get_name(true, false)};
        argument.value.clear();
    } else {
        argument.names = text::split(option.get_name(false, true), ',');
    }
    return argument;
}

CommandDescription described_command(const CLI::App& command) {
    CommandDescription result{command.get_name(), command.get_description(), command.get_footer(), {}, {}};
    for (const CLI::Option* const option : command.get_options()) {
        (option->get_positional() ? result.positionals : result.options).push_back(described(*option));
    }
    return result;
}

}  // namespace

ProgramDescription described(const CLI::App& program) {
    ProgramDescription result{described_command(program), {}};
    for (const CLI::App* const command : program.get_subcommands({})) {
        result.commands.push_back(described_command(*command));
    }
    return result;
}

}  // namespace gumcert::manual
