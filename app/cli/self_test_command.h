#pragma once

#include <string>
#include <vector>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// `gumcert self-test`: runs the reference cases and writes the report.
/// \param output    folder; "": one with the date in its name
/// \param cases     names of cases that are run alone, without a report; empty: all of them
/// \param language  of HTML and PDF; "" is "en"
/// \return negative_answer where a case fails
[[nodiscard]] ExitCode self_test(const std::string& output, const std::vector<std::string>& cases,
                                 const std::string& language, const std::string& share, const CommonOptions& common);

}  // namespace gumcert::cli
