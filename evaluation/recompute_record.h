#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluation/evaluate_job.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::evaluation {

/// At most so many places of one record are reported.
inline constexpr std::size_t k_most_disagreements = 20;

/// A place where a record says something else: pointer (RFC 6901), what stands there, and what its job gives.
using DisagreementSink =
    std::function<void(const std::string& pointer, const std::string& stated, const std::string& evaluated)>;

/// Tells each of disagreements().
void tell_disagreements(const reports::EvaluationRecord& stated, const reports::EvaluationRecord& evaluated,
                        const DisagreementSink& tell);

/// Where a record says something else than the one that its job gives: tell_differences(). Every text, every digit that is
/// printed, every verdict is the same to the letter.
/// \param where  name of the record, for messages
[[nodiscard]] std::vector<gum::Diagnostic> disagreements(const reports::EvaluationRecord& stated,
                                                         const reports::EvaluationRecord& evaluated,
                                                         const std::string& where);

/// Why a record cannot be evaluated again by this program: another program made it, it does not hold all files of its
/// job, it states no digest. None: it can.
[[nodiscard]] std::optional<gum::Diagnostic> not_recomputable(const reports::EvaluationRecord& record,
                                                              const std::string& where);

/// That a record does not hold all files of its job: GC-RECORD-0027. None: it does.
[[nodiscard]] std::optional<gum::Diagnostic> files_not_held(const reports::EvaluationRecord& record,
                                                            const std::string& where);

/// What the job in a record gives: its files as the record holds them, evaluated with this program.
/// \throws gum::InputError    GC-RECORD-0023 if a file is not that of its digest, -0024 if the job cannot be evaluated
/// \throws gum::StorageError  GC-STORE-0024 where the progress ends it, because its time is used up
[[nodiscard]] Evaluation evaluation_of(const reports::EvaluationRecord& record, const std::string& where,
                                       unsigned threads, const std::filesystem::path& templates,
                                       const gum::Progress& progress = {},
                                       std::span<const Kind> kinds = program_kinds());
/// The record of it.
/// \throws gum::InputError  GC-RECORD-0023 if a file is not that of its digest, -0024 if the job cannot be evaluated
[[nodiscard]] reports::EvaluationRecord evaluated_again(const reports::EvaluationRecord& record,
                                                        const std::string& where, unsigned threads,
                                                        const std::filesystem::path& templates,
                                                        const gum::Progress& progress = {},
                                                        std::span<const Kind> kinds = program_kinds());

/// Believes nothing that a record says: evaluates its job again and compares.
/// \param record  becomes the one that its job gives: what is printed from it was computed here
/// \return why it cannot be evaluated again, as a diagnostic; none where it was, and agrees in everything
/// \throws gum::InputError  GC-RECORD-0022 with every place where it disagrees, and those of evaluated_again()
[[nodiscard]] std::optional<gum::Diagnostic> recompute_record(reports::EvaluationRecord& record,
                                                              const std::string& where, unsigned threads,
                                                              const std::filesystem::path& templates,
                                                              const gum::Progress& progress = {},
                                                              std::span<const Kind> kinds = program_kinds());

}  // namespace gumcert::evaluation
