#pragma once

#include <string>
#include <vector>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// `gumcert rerun`: lists what this version changes in records of any version.
/// \param format  "text", "json", "csv"; "" is text
/// \return negative_answer where a printed digit or a verdict changed, or a record cannot be evaluated; the class of the
///         failure where a file is no record
[[nodiscard]] ExitCode rerun_records(const std::vector<std::string>& records, const std::string& format,
                                     const std::string& share, const CommonOptions& common);

}  // namespace gumcert::cli
