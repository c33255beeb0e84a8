#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/evaluate_job.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"

namespace gumcert::evaluation {

/// What was found out about a file.
struct FileCheck {
    std::string kind;                       ///< "job of kind budget", "record of kind rotary_table"
    std::vector<gum::Diagnostic> findings;  ///< of severity error where something is wrong
};

/// Use case of `gumcert check FILE`. A job is read with all its files, and everything that its reader refuses or warns
/// of is reported; it is not evaluated. A record is read, its digest compared, its job evaluated again and the two
/// compared. A file of the laboratory folder, a standard or laboratory.json, is read.
/// \throws gum::StorageError  if a file cannot be read
/// \throws gum::InputError    GC-CHECK-0001 if it is neither
/// \param laboratory  as of evaluate_job()
[[nodiscard]] FileCheck check_file(const std::filesystem::path& file, unsigned threads,
                                   const std::filesystem::path& templates, const gum::Progress& progress = {},
                                   const std::filesystem::path& laboratory = {});

}  // namespace gumcert::evaluation
