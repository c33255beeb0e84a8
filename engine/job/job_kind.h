#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/job/file_source.h"

namespace gumcert::json {
struct JsonDocument;
}

namespace gumcert::engine {

class ProblemList;

/// One object of the job document and the keys that it may have.
struct JobKeys {
    std::string_view pointer;
    std::span<const std::string_view> keys;
};

/// "budget", "rotary_table", "circle_closure" or "comparison".
/// \throws InputError    if the file is not a job of this schema
/// \throws StorageError  if it cannot be read
[[nodiscard]] std::string job_kind(const std::filesystem::path& job_file);
[[nodiscard]] std::string job_kind(const FileSource& source, const std::string& job_file);

/// `schema` and `kind` of a job that is read already; problems go to the list.
/// \return the kind when it is one of these
[[nodiscard]] std::optional<std::string> read_kind(const gumcert::json::JsonDocument& document, ProblemList& problems);

/// The kind that a job seems to be of, also where its text has faults: the reader of that kind then reports what is
/// wrong with it.
/// \return nothing when that cannot be seen
[[nodiscard]] std::optional<std::string> probable_job_kind(const std::filesystem::path& job_file);
[[nodiscard]] std::optional<std::string> probable_job_kind(const FileSource& source, const std::string& job_file);

}  // namespace gumcert::engine
