#include "jobs/file_source.h"

#include <utility>

#include "encoding/file_bytes.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/input_codes.h"
#include "jobs/input_text.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

[[noreturn]] void leads_out(const std::string& name) {
    throw gum::StorageError(gum::Diagnostic{
        std::string{k_file_leads_out.code}, text::visible(name),
        "a symbolic link in it leads out of the folder at which the name begins",
        "the name of a file in a job shows where the file is (docs/budget_job.md)",
        "put the file there, or write in the job where it is, with .. between folders", gum::Severity::error});
}

/// A name whose `..` stand at its beginning, and the folder to which they lead.
struct Beginning {
    std::filesystem::path folder, name;
};

Beginning beginning_of(std::filesystem::path folder, const std::filesystem::path& name) {
    const std::filesystem::path plain = name.lexically_normal();
    auto part = plain.begin();
    for (; part != plain.end() && *part == ".."; ++part) {
        folder /= "..";
    }
    std::filesystem::path rest;
    for (; part != plain.end(); ++part) {
        rest /= *part;
    }
    return {.folder = std::move(folder), .name = rest.empty() ? std::filesystem::path(".") : std::move(rest)};
}

[[noreturn]] void not_readable(const std::string& name, const std::string& reason) {
    throw gum::StorageError(gum::Diagnostic{std::string{k_file_not_readable.code}, text::visible(name),
                                            "cannot be read: " + reason, "every file of a job must be a readable file",
                                            "check the name and the rights of the file", gum::Severity::error});
}

}  // namespace

std::vector<std::string> FileSource::json_files(const std::string& /*folder*/) const {
    return {};
}

std::string DiskFileSource::read(const std::string& name) const {
    const bool is_of_laboratory = has_laboratory() && name.starts_with(k_laboratory_prefix);
    const auto [folder, path] = is_of_laboratory ? beginning_of(laboratory_, name.substr(k_laboratory_prefix.size()))
                                                 : beginning_of(folder_, name);
    const bool is_job = !job_.empty() && name == job_;
    encoding::FileBytes file = is_job ? encoding::read_regular_file(folder_ / name, k_file_limit + 1)
                                      : encoding::read_file_beneath(folder, path, k_file_limit + 1);
    if (file.leads_out) {
        leads_out(name);
    }
    if (!file.failure.empty()) {
        // "a/" has no name of a file, "" nothing at all: the message names the place as it was given.
        const std::string place = folder_.string();
        not_readable(!name.empty() ? name : place.empty() ? "the name \"\"" : place + "/", file.failure);
    }
    return std::move(file.bytes);
}

std::vector<std::string> DiskFileSource::json_files(const std::string& folder) const {
    const bool is_of_laboratory = has_laboratory() && folder.starts_with(k_laboratory_prefix);
    const auto [beginning, path] = is_of_laboratory
                                       ? beginning_of(laboratory_, folder.substr(k_laboratory_prefix.size()))
                                       : beginning_of(folder_, folder);
    return encoding::json_files_in(beginning / path);
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

std::vector<std::string> MemoryFileSource::json_files(const std::string& folder) const {
    constexpr std::string_view k_extension = ".json";
    std::vector<std::string> names;
    for (auto file = files_.lower_bound(folder); file != files_.end() && file->first.starts_with(folder); ++file) {
        const std::string name = file->first.substr(folder.size());
        if (name.ends_with(k_extension) && name.find('/') == std::string::npos) {
            names.push_back(name.substr(0, name.size() - k_extension.size()));
        }
    }
    return names;
}

std::string ReadOnceSource::read(const std::string& name) const {
    const std::lock_guard guard(lock_);
    const auto found = read_.find(name);
    return found != read_.end() ? found->second : read_.emplace(name, source_.read(name)).first->second;
}

}  // namespace gumcert::jobs
