#pragma once

#include <sys/stat.h>

#include <filesystem>

namespace gumcert::archive {

/// Which file a name leads to.
struct FileIdentity {
    dev_t device = 0;
    ino_t number = 0;

    friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};

/// \return that of no file where there is none
[[nodiscard]] FileIdentity identity_of(const std::filesystem::path& file);

/// Whether the file of an archive may have another name, as far as can be seen from this one: it has several links, or is
/// mounted by itself (a bind mount). SQLite names the write-ahead log after the name of the file: writers by two names have
/// two logs, know nothing of each other, and answer two requests with one number.
[[nodiscard]] bool may_have_another_name(const std::filesystem::path& file);

/// Before entries are written, and again before they are kept.
/// \param opened  the file that was opened by this name
/// \throws gum::StorageError  GC-ARCHIVE-0014 where the file may have another name, or the name leads to another file now
void require_one_name(const std::filesystem::path& file, const FileIdentity& opened);

/// Files of SQLite beside the archive, and the archive itself, which somebody else made and this process cannot write.
/// \throws gum::StorageError  GC-ARCHIVE-0006, which names the file
void require_rights_to_write(const std::filesystem::path& file);

}  // namespace gumcert::archive
