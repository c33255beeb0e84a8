#pragma once

#include <string>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// `gumcert laboratory FOLDER`: prints what runs out in it.
/// \param day     "" is today by UTC
/// \param format  "text", "json", "csv"; "" is text
/// \return negative_answer where a standard is overdue, or a signatory or the accreditation has run out
[[nodiscard]] ExitCode show_laboratory(const std::string& folder, const std::string& day, const std::string& format);

}  // namespace gumcert::cli
