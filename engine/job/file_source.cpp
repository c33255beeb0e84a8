#include "engine/job/file_source.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "engine/job/input_codes.h"
#include "engine/job/input_text.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

namespace {

[[noreturn]] void not_readable(const std::string& name, const std::string& reason) {
    throw gum::StorageError(gum::Diagnostic{std::string{k_file_not_readable.code}, printable(name),
                                            "cannot be read: " + reason, "every file of a job must be a readable file",
                                            "check the name and the rights of the file", gum::Severity::error});
}

}  // namespace

std::string DiskFileSource::read(const std::string& name) const {
    const std::filesystem::path path = folder_ / std::filesystem::path(name);
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(path, code);
    if (!std::filesystem::exists(status)) {
        not_readable(name,
                     code && code != std::errc::no_such_file_or_directory ? code.message() : "there is no such file");
    }
    // A device or a pipe could be endless or wait for ever.
    if (!std::filesystem::is_regular_file(status)) {
        not_readable(name, "it is not a regular file");
    }
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
        const std::error_code reason(errno, std::generic_category());
        not_readable(name, reason ? reason.message() : "it cannot be opened");
    }
    std::string bytes;
    const std::uintmax_t size = std::filesystem::file_size(path, code);
    bytes.resize(code ? k_file_limit + 1 : static_cast<std::size_t>(std::min<std::uintmax_t>(size, k_file_limit) + 1));
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (stream.bad()) {
        not_readable(name, "reading failed");
    }
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    return bytes;
}

std::string MemoryFileSource::read(const std::string& name) const {
    const auto found = files_.find(name);
    if (found == files_.end()) {
        not_readable(name, "there is no such file");
    }
    return found->second.substr(0, k_file_limit + 1);
}

}  // namespace gumcert::engine
