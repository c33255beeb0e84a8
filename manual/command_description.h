#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace gumcert::manual {

/// An option or a positional argument, as --help prints it.
struct ArgumentDescription {
    std::vector<std::string> names;    ///< "-o", "--output", or "JOB"
    std::string value;                 ///< kind of its value, "FILE"; "" = a flag, or a positional argument
    std::vector<std::string> choices;  ///< the values that are allowed; empty = not one of a few
    std::string limits;                ///< "INT in [1 - 1024]"; "" = none
    std::string explanation;
    bool required = false;
    bool many = false;  ///< may be given more than once
    bool list = false;  ///< several values with commas between them
};

struct CommandDescription {
    std::string name;  ///< "run"; "gumcert" of the program itself
    std::string explanation;
    std::string footer;  ///< what --help says below the options
    std::vector<ArgumentDescription> positionals, options;
};

struct ProgramDescription {
    CommandDescription program;
    std::vector<CommandDescription> commands;
};

[[nodiscard]] ProgramDescription described(const CLI::App& program);

}  // namespace gumcert::manual
