#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/archive/archive_command.h"
#include "app/cli/audit_command.h"
#include "app/cli/issue_commands.h"
#include "app/cli/terminal/terminal.h"

namespace CLI {
class App;
}

namespace gumcert::cli {

/// What the command line may say.
struct Arguments {
    std::string command;  ///< "run", "evaluate", …; "" = none
    CommonOptions common;
    std::vector<std::string> jobs, records, files, revocation_lists, codes, cases;
    std::string job, file, output, format, share, trust_store, standard, date, method, folder, language;
    DocumentOptions documents;
    AuditOptions audit;
    ArchiveOptions archive;
    std::optional<std::size_t> runs;
    std::optional<std::int64_t> seed;
};

/// Every command with its options and what --help says of them: the one source of help, manual and completion.
/// \param arguments  filled when a command line is parsed; must outlive what is returned
/// \param version    answers --version
[[nodiscard]] std::unique_ptr<CLI::App> command_line(Arguments& arguments, std::string (*version)());

/// Reads the command line.
/// \return the exit code where help or version was asked for and printed; nothing where there is work to do
/// \throws std::invalid_argument  says what is wrong
[[nodiscard]] std::optional<ExitCode> read_command_line(int argc, char** argv, std::string (*version)(),
                                                        Arguments& arguments);

}  // namespace gumcert::cli
