#pragma once

#include <string>
#include <vector>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// `gumcert import dcc`: the numbers of a digital certificate become inputs of a budget.
/// \param standard     identification: they become a file of the register in place of a job; "": a job
/// \param trust_store  "": nobody is named whom the reader trusts
[[nodiscard]] ExitCode import_certificate(const std::string& file, const std::string& output,
                                          const std::string& standard, const std::string& trust_store,
                                          const CommonOptions& common);

/// `gumcert check`: what is wrong with jobs and records, or with digital certificates; nothing is written.
[[nodiscard]] ExitCode check_files(const std::vector<std::string>& files, bool certificates,
                                   const std::string& trust_store, const std::string& share,
                                   const std::string& laboratory, const CommonOptions& common);

/// `gumcert verify`: signatures of digital certificates and PDF files, and whose documents they are.
/// \param revocation_lists  files
[[nodiscard]] ExitCode verify_files(const std::vector<std::string>& files, const std::string& trust_store,
                                    const std::vector<std::string>& revocation_lists, const CommonOptions& common);

}  // namespace gumcert::cli
