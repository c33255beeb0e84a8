#include "manual/manual_pages.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string_view>
#include <vector>

#include "text/utf8.h"

namespace gumcert::manual {

namespace {

/// A text as roff input. A hyphen inside a word may end a line and a minus may not: what a reader types is a minus.
std::string roff(std::string_view prose, bool typed = false) {
    std::string out = prose.starts_with('.') || prose.starts_with('\'') ? "\\&" : "";
    bool in_word = false;
    while (!prose.empty()) {
        const auto [character, bytes] = text::decode_utf8(prose, 0);
        prose.remove_prefix(std::max<std::size_t>(bytes, 1));
        if (character == '\\') {
            out += "\\e";
        } else if (character == '-' && (typed || !in_word)) {
            out += "\\-";
        } else if (character < 0x80) {
            out += static_cast<char>(character);
        } else {
            out += fmt::format("\\[u{:04X}]", static_cast<std::uint32_t>(character));
        }
        in_word = character < 0x80 && std::isalnum(static_cast<int>(character)) != 0;
    }
    return out;
}

std::string bold(std::string_view text) {
    return "\\fB" + roff(text, true) + "\\fR";
}

std::string italic(std::string_view text) {
    return "\\fI" + roff(text, true) + "\\fR";
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        lines.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    return lines;
}

/// A text of --help, which may end without a full stop.
std::string sentence(const std::string& text) {
    std::string out;
    for (const std::string& line : lines_of(text)) {
        out += (out.empty() ? "" : "\n") + roff(line);
    }
    return out + (text.ends_with('.') ? "\n" : ".\n");
}

/// The parts of a footer of --help.
struct Footer {
    std::string prose;     ///< roff; blocks that are indented stay as they are
    std::string examples;  ///< roff: commands, each with what it does
};

/// "gumcert plan plan.json   what to expect": a command, and after three spaces or more what it does.
std::string example(std::string_view line) {
    const std::size_t gap = line.find("   ");
    const std::string_view command = line.substr(0, gap);
    std::string explanation = "\\&";
    if (gap != std::string_view::npos) {
        explanation = roff(line.substr(line.find_first_not_of(' ', gap)));
    }
    return ".TP\n" + bold(command) + "\n" + explanation + "\n";
}

Footer read_footer(const std::string& footer) {
    Footer result;
    bool verbatim = false;
    for (const std::string& line : lines_of(footer)) {
        constexpr std::string_view k_mark = "Example: ";
        const std::string_view behind_mark =
            line.starts_with(k_mark) ? std::string_view(line).substr(k_mark.size()) : std::string_view(line);
        const std::size_t text = std::min(behind_mark.find_first_not_of(' '), behind_mark.size());
        const bool set_apart = text > 0 || behind_mark.size() < line.size();
        if (set_apart && behind_mark.substr(text).starts_with("gumcert ")) {
            result.examples += example(behind_mark.substr(text));
            continue;
        }
        if (line.empty() || line == "Start here:") {  // the heading of the examples says it
            continue;
        }
        if (set_apart != verbatim) {
            result.prose += set_apart ? ".PP\n.EX\n" : ".EE\n.PP\n";
            verbatim = set_apart;
        }
        result.prose += roff(line, verbatim) + "\n";
    }
    return {result.prose + (verbatim ? ".EE\n" : ""), result.examples};
}

std::string argument_entry(const ArgumentDescription& argument) {
    std::string names;
    for (const std::string& name : argument.names) {
        names += (names.empty() ? "" : ", ") + (name.starts_with('-') ? bold(name) : italic(name));
    }
    std::string entry = ".TP\n" + names + (argument.value.empty() ? "" : " " + italic(argument.value)) + "\n" +
                        sentence(argument.explanation);
    if (!argument.limits.empty()) {
        entry += roff(argument.limits) + ".\n";
    }
    if (argument.required && argument.names.front().starts_with('-')) {
        entry += "Required.\n";
    }
    return entry;
}

std::string arguments_section(const std::string& title, const std::vector<ArgumentDescription>& arguments) {
    std::string section;
    for (const ArgumentDescription& argument : arguments) {
        section += argument_entry(argument);
    }
    return section.empty() ? "" : ".SH " + title + "\n" + section;
}

std::string head(const std::string& name, const std::string& what, const ManualImprint& imprint) {
    std::string upper = name;
    for (char& letter : upper) {
        letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    }
    return fmt::format(".TH {} 1 \"{}\" \"gumcert {}\" \"gumcert\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
                       roff(upper, true), imprint.day, imprint.version, roff(name, true), roff(what));
}

std::string command_page(const CommandDescription& command, const ManualImprint& imprint) {
    std::string page = head("gumcert-" + command.name, command.explanation, imprint);
    page += bold("gumcert " + command.name) + " [" + italic("OPTIONS") + "]";
    for (const ArgumentDescription& argument : command.positionals) {
        page += " " + italic(argument.names.front()) + (argument.many ? "..." : "");
    }
    const Footer footer = read_footer(command.footer);
    page += "\n.SH DESCRIPTION\n" + sentence(command.explanation) + ".PP\n" + footer.prose;
    page += arguments_section("ARGUMENTS", command.positionals) + arguments_section("OPTIONS", command.options);
    page += ".SH EXAMPLES\n" + footer.examples;
    return page + ".SH SEE ALSO\n.BR gumcert (1),\nwhich says the exit status and where documents and examples are\n";
}

std::string program_page(const ProgramDescription& described, const ManualImprint& imprint) {
    const CommandDescription& program = described.program;
    std::string page = head(program.name, imprint.summary, imprint);
    page += bold(program.name) + " [" + italic("OPTIONS") + "] [" + italic("COMMAND") + "]\n.SH DESCRIPTION\n" +
            sentence(program.explanation) + ".SH COMMANDS\n";
    std::string also;
    for (const CommandDescription& command : described.commands) {
        page += ".TP\n" + bold(command.name) + "\n" + roff(command.explanation) + "\n";
        also += ".BR " + roff(program.name + "-" + command.name, true) +
                (&command == &described.commands.back() ? " (1)\n" : " (1),\n");
    }
    const Footer footer = read_footer(program.footer);
    page += arguments_section("OPTIONS", program.options) + ".SH EXAMPLES\n" + footer.examples;
    page += ".SH EXIT STATUS\n" + footer.prose;
    page +=
        ".SH FILES\nBelow the folder that holds\n.IR bin/gumcert ,\nwhich is\n.I /usr\nof a package:\n"
        ".TP\n.I share/gumcert\nTemplates of documents, their wording, and the schemas of jobs and records.\n"
        ".TP\n.I share/doc/gumcert/docs\nWhat this manual names as docs/...\n"
        ".TP\n.I share/doc/gumcert/examples\n"
        "What this manual names as examples/... Copy a folder to write beside its jobs, or name another with\n"
        ".BR \\-o .\n";
    return page + ".SH SEE ALSO\n" + also;
}

}  // namespace

std::map<std::string, std::string> manual_pages(const ProgramDescription& program, const ManualImprint& imprint) {
    std::map<std::string, std::string> pages{{program.program.name + ".1", program_page(program, imprint)}};
    for (const CommandDescription& command : program.commands) {
        pages[program.program.name + "-" + command.name + ".1"] = command_page(command, imprint);
    }
    return pages;
}

}  // namespace gumcert::manual
