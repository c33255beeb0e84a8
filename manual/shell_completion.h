#pragma once

#include <string>

#include "manual/command_description.h"

namespace gumcert::manual {

/// Scripts that complete commands, options and those values of options that are one of a few; file names elsewhere.
[[nodiscard]] std::string bash_completion(const ProgramDescription& described);
[[nodiscard]] std::string zsh_completion(const ProgramDescription& described);
[[nodiscard]] std::string fish_completion(const ProgramDescription& described);

}  // namespace gumcert::manual
