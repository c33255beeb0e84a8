#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "engine/job/file_source.h"

namespace gumcert::engine {

/// Another source of which every file is read once: what is parsed, parsed again and digested are the same bytes, also
/// where a file changes meanwhile. Two spellings of a name ("a.csv", "x/../a.csv") are two names.
class ReadOnceSource : public FileSource {
public:
    explicit ReadOnceSource(const FileSource& source) : source_(source) {}
    [[nodiscard]] std::string read(const std::string& name) const override;
    /// SHA-256 of the bytes that were read under a name, hexadecimal. \throws StorageError  as read() does
    [[nodiscard]] std::string digest(const std::string& name) const;

private:
    const FileSource& source_;
    mutable std::mutex lock_;
    mutable std::map<std::string, std::string> read_;
};

/// The kind that a job of a source seems to be of, as probable_job_kind() of a file.
[[nodiscard]] std::optional<std::string> probable_job_kind(const FileSource& source, const std::string& job_file);

}  // namespace gumcert::engine
