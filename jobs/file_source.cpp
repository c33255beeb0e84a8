#include "jobs/file_source.h"

#include <utility>

#include "encoding/file_bytes.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/input_codes.h"
#include "jobs/input_text.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

[[noreturn]] void not_readable(const std::string& name, const std::string& reason) {
    throw gum::StorageError(gum::Diagnostic{std::string{k_file_not_readable.code}, text::visible(name),
                                            "cannot be read: " + reason, "every file of a job must be a readable file",
                                            "check the name and the rights of the file", gum::Severity::error});
}

}  // namespace

std::string DiskFileSource::read(const std::string& name) const {
    const bool is_of_laboratory = has_laboratory() && name.starts_with(k_laboratory_prefix);
    const std::filesystem::path path =
        is_of_laboratory ? laboratory_ / std::filesystem::path(name.substr(k_laboratory_prefix.size()))
                         : folder_ / std::filesystem::path(name);
    encoding::FileBytes file = encoding::read_regular_file(path, k_file_limit + 1);
    if (!file.failure.empty()) {
        // "a/" has no name of a file, "" nothing at all: the message names the place as it was given.
        const std::string folder = folder_.string();
        not_readable(!name.empty() ? name : folder.empty() ? "the name \"\"" : folder + "/", file.failure);
    }
    return std::move(file.bytes);
}

std::string MemoryFileSource::read(const std::string& name) const {
    const auto found = files_.find(name);
    if (found == files_.end()) {
        not_readable(name, "there is no such file");
    }
    return found->second.substr(0, k_file_limit + 1);
}

bool MemoryFileSource::has_laboratory() const {
    const auto first = files_.lower_bound(std::string(k_laboratory_prefix));
    return first != files_.end() && first->first.starts_with(k_laboratory_prefix);
}

std::string ReadOnceSource::read(const std::string& name) const {
    const std::lock_guard guard(lock_);
    const auto found = read_.find(name);
    return found != read_.end() ? found->second : read_.emplace(name, source_.read(name)).first->second;
}

}  // namespace gumcert::jobs
