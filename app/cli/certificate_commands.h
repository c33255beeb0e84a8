#pragma once

#include <string>
#include <vector>

#include "app/cli/terminal.h"

namespace gumcert::cli {

/// `gumcert import dcc`: the numbers of a digital certificate become inputs of a budget.
[[nodiscard]] ExitCode import_certificate(const std::string& file, const std::string& output,
                                          const CommonOptions& common);

/// `gumcert verify`: signatures of digital certificates and PDF files.
[[nodiscard]] ExitCode verify_files(const std::vector<std::string>& files, const std::string& trust_store,
                                    const CommonOptions& common);

}  // namespace gumcert::cli
