#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "archive/archive.h"
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

/// Numbers of certificates and SHA-256 of their records.
/// \param numbers  empty: all certificates of the archive that have a record
/// \throws gum::InputError  GC-ARCHIVE-0026 where one is not in the archive
[[nodiscard]] std::vector<std::pair<std::string, std::string>> records_to_replay(
    Archive& archive, const std::vector<std::string>& numbers);

/// The differences of one certificate that fit on a terminal, and how many more there are.
[[nodiscard]] std::vector<gum::Diagnostic> first_differences(const std::vector<gum::Diagnostic>& all,
                                                             const std::string& number);

/// By number of the certificate.
using Replays = std::vector<std::pair<std::string, Replay>>;
/// How many give the same as they did.
[[nodiscard]] std::size_t same_again(const Replays& replays);
/// How many this program makes nothing of, or a limit has ended.
[[nodiscard]] std::size_t not_evaluated(const Replays& replays);
/// A line for each, and one for all.
/// \param program  that evaluated them, "0.1.0 (commit …)"
[[nodiscard]] std::string replay_text(const Replays& replays, const std::string& program);
/// The same with all differences, schema "gumcert/archive-replay/1".
[[nodiscard]] nlohmann::json replay_json(const Replays& replays, const std::string& program);

}  // namespace gumcert::archive
