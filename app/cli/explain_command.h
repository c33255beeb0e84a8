#pragma once

#include <string>
#include <vector>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// `gumcert explain`: what codes of messages mean; the codes of a family; without a word all families.
/// \throws gum::UsageError    GC-USAGE-0001 for each word that is none, with what may have been meant
/// \throws gum::StorageError  if the register is missing or damaged
[[nodiscard]] ExitCode explain(const std::vector<std::string>& words, const std::string& share);

/// `gumcert limits`: what is refused or ended beyond a size, and where it applies.
[[nodiscard]] ExitCode list_limits();

}  // namespace gumcert::cli
