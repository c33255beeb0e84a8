#pragma once

#include <string>

#include "app/cli/command_description.h"

namespace gumcert::cli {

/// Scripts that complete commands, options and those values of options that are one of a few; file names elsewhere.
[[nodiscard]] std::string bash_completion(const ProgramDescription& described);
[[nodiscard]] std::string zsh_completion(const ProgramDescription& described);
[[nodiscard]] std::string fish_completion(const ProgramDescription& described);

}  // namespace gumcert::cli
