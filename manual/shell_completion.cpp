#include "manual/shell_completion.h"

#include <fmt/core.h>

#include <string_view>
#include <vector>

namespace gumcert::manual {

namespace {

std::string joined(const std::vector<std::string>& words, std::string_view separator = " ") {
    std::string out;
    for (const std::string& word : words) {
        out += (out.empty() ? "" : std::string(separator)) + word;
    }
    return out;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
        text.replace(at, what.size(), by);
    }
    return text;
}

/// The word "run" of the command, "" of the program: what stands before the options of each.
std::vector<std::pair<std::string, const CommandDescription*>> by_word(const ProgramDescription& described) {
    std::vector<std::pair<std::string, const CommandDescription*>> all{{"", &described.program}};
    for (const CommandDescription& command : described.commands) {
        all.emplace_back(command.name, &command);
    }
    return all;
}

constexpr std::string_view k_bash_head =
    R"(# Completion of gumcert for bash, made from its command line when the program is built.
_gumcert() {
    local word=${COMP_WORDS[COMP_CWORD]} command='' awaits='' position=0 i before
    COMPREPLY=()
    # What stands before the word: the command, an option that awaits its value, and how many arguments.
    # Bash takes --option=value for three words.
    for ((i = 1; i < COMP_CWORD; ++i)); do
        before=${COMP_WORDS[i]}
        if [[ $before == '=' ]]; then
            continue
        elif [[ -n $awaits ]]; then
            awaits=''
        elif [[ $before == -* ]]; then
            case "$command $before" in
)";

constexpr std::string_view k_bash_middle = R"(                awaits=$before
                ;;
            esac
        elif [[ -z $command ]]; then
            command=$before
        else
            ((++position))
        fi
    done
    if [[ $word == '=' ]]; then
        word=''
    fi
    local replies='' list=''
    if [[ -n $awaits ]]; then
        case "$command $awaits" in
)";

constexpr std::string_view k_bash_options = R"(        esac
    elif [[ $word == -* ]]; then
        case $command in
)";

constexpr std::string_view k_bash_arguments = R"(        esac
    else
        case "$command $position" in
)";

constexpr std::string_view k_bash_tail = R"(        esac
    fi
    # Behind a comma stands the next value of a list.
    if [[ -n $list && $word == *,* ]]; then
        list=${word%,*},
        word=${word##*,}
    else
        list=''
    fi
    local IFS=$' \n'
    COMPREPLY=($(compgen -P "$list" -W "$replies" -- "$word"))
}
complete -o default -F _gumcert gumcert
)";

}  // namespace

std::string bash_completion(const ProgramDescription& described) {
    std::string awaiting, values, options, arguments;
    for (const auto& [word, command] : by_word(described)) {
        std::vector<std::string> names;
        for (const ArgumentDescription& option : command->options) {
            names.insert(names.end(), option.names.begin(), option.names.end());
            if (option.value.empty()) {
                continue;
            }
            std::vector<std::string> patterns;
            for (const std::string& name : option.names) {
                patterns.push_back(fmt::format("'{} {}'", word, name));
            }
            awaiting += (awaiting.empty() ? "            " : " | \\\n            ") + joined(patterns, " | ");
            if (!option.choices.empty()) {
                values += fmt::format("        {}) replies='{}'{} ;;\n", joined(patterns, " | "),
                                      joined(option.choices), option.list ? " list=yes" : "");
            }
        }
        options += fmt::format("        '{}') replies='{}' ;;\n", word, joined(names));
        for (std::size_t i = 0; i < command->positionals.size(); ++i) {
            if (!command->positionals[i].choices.empty()) {
                arguments +=
                    fmt::format("        '{} {}') replies='{}' ;;\n", word, i, joined(command->positionals[i].choices));
            }
        }
    }
    std::vector<std::string> commands;
    for (const CommandDescription& command : described.commands) {
        commands.push_back(command.name);
    }
    arguments += fmt::format("        ' 0') replies='{}' ;;\n", joined(commands));
    return std::string(k_bash_head) + awaiting + ")\n" + std::string(k_bash_middle) + values +
           std::string(k_bash_options) + options + std::string(k_bash_arguments) + arguments + std::string(k_bash_tail);
}

namespace {

/// For a text in single quotes of zsh or fish; a line feed in it is a space.
std::string quoted(const std::string& text, std::string_view quote) {
    return "'" + replaced(replaced(text, "\n", " "), "'", quote) + "'";
}

/// One argument of _arguments: '(-o --output)'{-o,--output}'[what it is]:FILE:_files'.
std::string zsh_option(const ArgumentDescription& option) {
    std::string explanation = option.explanation;
    for (const std::string_view special : {"\\", "[", "]", ":"}) {
        explanation = replaced(explanation, special, "\\" + std::string(special));
    }
    std::string rest = "[" + explanation + "]";
    if (!option.value.empty()) {
        rest += ":" + option.value + ":";
        rest += option.list                ? "_sequence compadd - " + joined(option.choices)
                : !option.choices.empty()  ? "(" + joined(option.choices) + ")"
                : !option.limits.empty()   ? " "
                : option.value == "FOLDER" ? "_files -/"
                                           : "_files";
    }
    const std::string names = option.names.size() > 1 ? "{" + joined(option.names, ",") + "}" : option.names.front();
    return "'" + (option.many && !option.list ? std::string("*") : "(" + joined(option.names) + ")") + "'" + names +
           quoted(rest, R"('\'')");
}

}  // namespace

std::string zsh_completion(const ProgramDescription& described) {
    std::string commands, arguments;
    for (const auto& [word, command] : by_word(described)) {
        std::vector<std::string> words;
        for (const ArgumentDescription& option : command->options) {
            words.push_back(zsh_option(option));
        }
        if (word.empty()) {
            words.insert(words.end(), {"'1:command:->command'", "'*::argument:->argument'"});
            arguments = "    _arguments -C " + joined(words, " \\\n        ") + "\n";
            continue;
        }
        for (const ArgumentDescription& positional : command->positionals) {
            words.push_back(fmt::format(
                "'{}:{}:{}'", positional.many ? "*" : "", positional.names.front(),
                positional.choices.empty() ? std::string("_files") : "(" + joined(positional.choices) + ")"));
        }
        commands += "            " + quoted(word + ":" + command->explanation, R"('\'')") + "\n";
        if (arguments.find("case $words[1]") == std::string::npos) {
            arguments += "    if [[ $state == argument ]]; then\n        case $words[1] in\n";
        }
        arguments += "        " + word + ") _arguments " + joined(words, " \\\n            ") + " ;;\n";
    }
    return "#compdef gumcert\n"
           "# Completion of gumcert for zsh, made from its command line when the program is built.\n"
           "_gumcert() {\n    local context state state_descr line\n    typeset -A opt_args\n" +
           arguments + "        esac\n    elif [[ $state == command ]]; then\n        local -a commands=(\n" +
           commands + "        )\n        _describe command commands\n    fi\n}\n_gumcert \"$@\"\n";
}

std::string fish_completion(const ProgramDescription& described) {
    std::string out = "# Completion of gumcert for fish, made from its command line when the program is built.\n";
    for (const auto& [word, command] : by_word(described)) {
        const std::string condition =
            word.empty() ? "-n __fish_use_subcommand" : "-n '__fish_seen_subcommand_from " + word + "'";
        for (const ArgumentDescription& argument : command->options) {
            out += "complete -c gumcert " + condition;
            for (const std::string& name : argument.names) {
                out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            }
            if (!argument.choices.empty()) {
                out += " -x -a " + quoted(joined(argument.choices), "\\'");
            } else if (!argument.value.empty()) {
                out += argument.limits.empty() ? " -r -F" : " -x";
            }
            out += " -d " + quoted(argument.explanation, "\\'") + "\n";
        }
        for (const ArgumentDescription& positional : command->positionals) {
            if (!positional.choices.empty()) {
                out += "complete -c gumcert " + condition + " -a " + quoted(joined(positional.choices), "\\'") + "\n";
            }
        }
        if (!word.empty()) {
            out += "complete -c gumcert -f -n __fish_use_subcommand -a " + word + " -d " +
                   quoted(command->explanation, "\\'") + "\n";
        }
    }
    return out;
}

}  // namespace gumcert::manual
