#pragma once

#include <vector>

#include "evaluation/evaluation_task.h"
#include "issuing/output_forms.h"
#include "outputs/output_files.h"

/// The set of files of one job, in a folder of their own. Nothing is written here.
namespace gumcert::issuing {

inline constexpr const char* k_record_file = "record.json";
inline constexpr const char* k_audit_file = "audit.html";

/// Where record, covariance and audit are written.
[[nodiscard]] std::vector<std::filesystem::path> evaluated_places(const std::filesystem::path& folder);
/// Where the documents of a kind of records are written, in the order of issue_documents().
[[nodiscard]] std::vector<std::filesystem::path> document_places(const evaluation::Kind& kind,
                                                                 const std::filesystem::path& folder);

/// Record and covariance as they are on every day: to be asked for before judge_issue().
/// \param record_file  where the record is written; the covariance stands beside it
[[nodiscard]] std::vector<outputs::OutputFile> evaluated_files(const evaluation::Evaluation& evaluation,
                                                               const std::filesystem::path& record_file);
/// The audit of the evaluation as HTML, for the laboratory.
[[nodiscard]] outputs::OutputFile audit_file(const evaluation::Evaluation& evaluation,
                                             const std::filesystem::path& folder, const reports::RenderAssets& assets);
/// issue_documents() in their places.
[[nodiscard]] std::vector<outputs::OutputFile> document_files(const reports::EvaluationRecord& record,
                                                              const std::filesystem::path& folder,
                                                              const IssueOptions& options);

}  // namespace gumcert::issuing
