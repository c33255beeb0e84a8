#include "archive/store/file_names.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_name(const fs::path& file, std::string what, const char* action) {
    throw gum::StorageError(
        gum::Diagnostic{.code = "GC-ARCHIVE-0014",
                        .where = file.string(),
                        .what = std::move(what),
                        .rule = "an archive is written by one name: its write-ahead log is named after it",
                        .action = action});
}

}  // namespace

FileIdentity identity_of(const fs::path& file) {
    struct stat found {};
    return ::stat(file.c_str(), &found) == 0 ? FileIdentity{found.st_dev, found.st_ino} : FileIdentity{};
}

bool may_have_another_name(const fs::path& file) {
    struct statx found {};
    if (::statx(AT_FDCWD, file.c_str(), 0, STATX_NLINK, &found) != 0) {
        return false;  // there is none: opening says it
    }
    const bool is_mounted =
        (found.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) != 0 && (found.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
    return is_mounted || ((found.stx_mask & STATX_NLINK) != 0 && found.stx_nlink > 1);
}

void require_one_name(const fs::path& file, const FileIdentity& opened) {
    if (may_have_another_name(file)) {
        refuse_name(file, "has another name: it has several links, or is mounted by itself",
                    "leave it one name: remove the other links, and mount its folder in place of the file; "
                    "nothing was written");
    }
    if (identity_of(file) != opened) {
        refuse_name(file, "was moved away, or another file has its name now",
                    "ask again by the name that the archive has; nothing was written");
    }
}

void require_rights_to_write(const fs::path& file) {
    std::error_code error;
    const fs::path real = fs::canonical(file, error);
    for (const char* const ending : {"", "-wal", "-shm", "-journal"}) {
        const std::string beside = (error ? file : real).string() + ending;
        struct stat found {};
        if (::stat(beside.c_str(), &found) != 0 || ::faccessat(AT_FDCWD, beside.c_str(), W_OK, AT_EACCESS) == 0) {
            continue;
        }
        const std::string why = std::generic_category().message(errno);
        throw gum::StorageError(gum::Diagnostic{
            .code = "GC-ARCHIVE-0006",
            .where = beside,
            .what = "cannot be written: " + why + "; it belongs to the user " + std::to_string(found.st_uid),
            .rule = "an archive can be read, and written by whoever adds to it",
            .action = "check the access rights of the file and of its folder"});
    }
}

}  // namespace gumcert::archive
