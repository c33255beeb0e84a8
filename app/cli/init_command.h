#pragma once

#include <string>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// `gumcert init METHOD [DIR]`: a folder with a job of this method that runs; without a method, the list of them.
/// \param folder  "" is one with the name of the method
/// \throws gum::UsageError    GC-USAGE-0001 for a method that there is not, with what may have been meant
/// \throws gum::StorageError  GC-STORE-0007 if the folder is not empty; -0010 if the methods are not found
[[nodiscard]] ExitCode init(const std::string& method, const std::string& folder, const std::string& share,
                            const CommonOptions& common);

}  // namespace gumcert::cli
