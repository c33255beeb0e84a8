#pragma once

#include <string>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// Prints the fonts that templates may use: a line for each family and folder, with its styles.
/// \param share  what --share names
/// \throws gum::StorageError  node or its package is missing
ExitCode list_fonts(const std::string& share);

}  // namespace gumcert::cli
