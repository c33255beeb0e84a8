#pragma once

#include <map>
#include <string>

#include "manual/command_description.h"

namespace gumcert::manual {

/// What the manual says beside the command line.
struct ManualImprint {
    std::string version;  ///< "0.1.0"
    std::string day;      ///< "2026-11-22", day of the commit; "" = not known
    std::string summary;  ///< what the program is, in a few words
};

/// Pages of the manual in the macros of man(7): one of the program, one of each command.
/// \return file name ("gumcert-run.1") and page, in ASCII
[[nodiscard]] std::map<std::string, std::string> manual_pages(const ProgramDescription& program,
                                                              const ManualImprint& imprint);

}  // namespace gumcert::manual
