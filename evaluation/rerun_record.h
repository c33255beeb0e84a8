#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluation/kinds.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::evaluation {

/// At most so many places of one record are listed; all are counted.
inline constexpr std::size_t k_most_changes = 10'000;

/// What a difference between two versions concerns.
enum class ChangeKind {
    printed,  ///< digits that documents print, or a result that is not there any more
    verdict,  ///< a decision: conformity, consistency, validation, which result is reported, whether a certificate is blocked
    number,  ///< an unrounded number, beyond 1e-9 of its size
    other,   ///< words, options, the audit, members that only one version has
};
inline constexpr std::size_t k_change_kinds = 4;

/// The word of a kind: "printed", "verdict", "number", "other".
[[nodiscard]] const char* word_of(ChangeKind kind);

struct RecordChange {
    ChangeKind kind = ChangeKind::other;
    std::string place = {};             ///< JSON pointer
    std::string before = {}, now = {};  ///< as people read it; "" where nothing stands there
};

/// What this version of the program makes of the job in a record of any version.
struct RerunRecord {
    std::string name = {};                              ///< of the record
    reports::Software made_by = {};                     ///< as the record states it
    std::string kind = {};                              ///< of its job
    std::optional<gum::Diagnostic> not_evaluated = {};  ///< why this version makes nothing of the job
    std::vector<RecordChange> changes = {};             ///< the first ones, in the order of the record
    std::array<std::size_t, k_change_kinds> counts{};   ///< of all of them, by ChangeKind

    [[nodiscard]] std::size_t count(ChangeKind of) const { return counts.at(static_cast<std::size_t>(of)); }
    /// "same", "numbers" where unrounded numbers alone changed, "changed", "not_evaluated".
    [[nodiscard]] const char* outcome() const;
    /// A limit ended its evaluation, which says nothing of the record.
    [[nodiscard]] bool was_ended() const;
    /// A printed digit or a verdict changed, or nothing could be evaluated.
    [[nodiscard]] bool is_negative() const;
};

/// Compares a record with another one of the same measurement, both as JSON, and puts what differs into `rerun`.
void tell_changes(const nlohmann::json& before, const nlohmann::json& now, RerunRecord& rerun);

/// Evaluates the job in a record with this version of the program and compares. The version that made the record does not
/// matter; its own digest, where it states one, and those of its files do. Where `progress` ends it with GC-STORE-0024, or the
/// job is refused, it is not evaluated.
/// \param text  of the record
/// \param name  for messages
/// \throws gum::InputError  what record_from_json() refuses, and GC-RECORD-0023 if a file is not that of its digest
[[nodiscard]] RerunRecord rerun_record(const std::string& text, const std::string& name, unsigned threads,
                                       const std::filesystem::path& templates, const gum::Progress& progress = {},
                                       std::span<const Kind> kinds = program_kinds());

/// For people: what changed in numbers, digits and verdicts; other changes are counted.
/// \param refused  how many more were asked for, and are no records that can be read
[[nodiscard]] std::string rerun_text(std::span<const RerunRecord> records, std::size_t refused = 0);
/// For programs, schema gumcert/rerun/1: all changes.
[[nodiscard]] std::string rerun_json(std::span<const RerunRecord> records);
/// One row a change, and one of each record without any.
[[nodiscard]] std::string rerun_csv(std::span<const RerunRecord> records);

}  // namespace gumcert::evaluation
