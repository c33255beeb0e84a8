#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"

namespace gumcert::archive {

/// At most so many places of one record are told, those of its audit last.
inline constexpr std::size_t k_most_differences = 1000;

/// What this program makes of an archived record today.
struct Replay {
    std::string made_by;  ///< version and commit of the program that made the record
    bool evaluated = false;
    std::vector<gum::Diagnostic> differences;  ///< GC-ARCHIVE-0073; or why it could not be evaluated, GC-ARCHIVE-0061
};

/// Evaluates the job of an archived record with this program, whichever version made the record, and compares every
/// number, text and verdict: the evidence that a laboratory keeps at each update (ISO/IEC 17025:2017, 7.11.2). Numbers
/// are the same as in disagreements(). Who made the record is not compared.
/// \param record   its bytes
/// \param name     for messages
/// \param threads, templates, progress  as of evaluate_job()
[[nodiscard]] Replay replay_record(const std::string& record, const std::string& name, unsigned threads,
                                   const std::filesystem::path& templates, const gum::Progress& progress = {});

}  // namespace gumcert::archive
