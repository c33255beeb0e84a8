#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "jobs/file_source.h"

namespace gumcert::json {
struct JsonDocument;
}

namespace gumcert::jobs {

class JsonObject;
class ProblemList;

/// One object of the job document and the keys that it may have.
struct JobKeys {
    std::string_view pointer;
    std::span<const std::string_view> keys;
};

// The words that `kind` of a job may be. Each one has a reader of its own.
inline constexpr std::string_view k_budget_kind = "budget";
inline constexpr std::string_view k_rotary_table_kind = "rotary_table";
inline constexpr std::string_view k_circle_closure_kind = "circle_closure";
inline constexpr std::string_view k_comparison_kind = "comparison";
inline constexpr std::array<std::string_view, 4> k_job_kinds{k_budget_kind, k_rotary_table_kind, k_circle_closure_kind,
                                                             k_comparison_kind};

// Who has kinds of jobs that are not among these states the words in `kinds`.

/// Of a file that require_job_file() lets through.
/// \throws InputError    if its schema or its kind is another one
/// \throws StorageError  if it cannot be read
[[nodiscard]] std::string job_kind(const std::filesystem::path& job_file);
[[nodiscard]] std::string job_kind(const FileSource& source, const std::string& job_file,
                                   std::span<const std::string_view> kinds = k_job_kinds);

/// \throws InputError  GC-INPUT-0027 when the file is recognisably another one that this program knows: a record, data of
///                     a certificate or of a laboratory, XML, a PDF, a workbook. The message says what it is, and which
///                     command reads it; GC-INPUT-0002 when its name is not UTF-8, which its record could not hold
void require_job_file(const FileSource& source, const std::string& job_file);

/// `schema` and `kind` of a job that is read already; problems go to the list.
/// \return the kind when it is one of these
[[nodiscard]] std::optional<std::string> read_kind(const gumcert::json::JsonDocument& document, ProblemList& problems,
                                                   std::span<const std::string_view> kinds = k_job_kinds);

/// What a job of any kind may say and the program does not look at: `notes`, for people, and `$schema`, where an editor
/// finds the JSON Schema of the job. Both are texts.
void read_unused_texts(const JsonObject& root);

/// The kind that a job seems to be of, also where its text has faults: the reader of that kind then reports what is
/// wrong with it.
/// \return nothing when that cannot be seen
[[nodiscard]] std::optional<std::string> probable_job_kind(const std::filesystem::path& job_file);
[[nodiscard]] std::optional<std::string> probable_job_kind(const FileSource& source, const std::string& job_file,
                                                           std::span<const std::string_view> kinds = k_job_kinds);

}  // namespace gumcert::jobs
