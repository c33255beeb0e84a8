#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "archive/store/entry.h"
#include "archive/store/store.h"

namespace gumcert::archive {

/// Before an archive is made anywhere that gets a name.
/// \throws gum::StorageError  GC-ARCHIVE-0002 where the name is taken, or one of a file that SQLite keeps beside it; -0010 on
///                            a network share
void require_place_of_archive(const std::filesystem::path& file);

/// A new archive in one file of SQLite, with its first entry.
/// \param fill  adds more to it; all of it or nothing
/// \throws gum::StorageError  GC-ARCHIVE-0002 where the file is there already, -0010 on a network share, and others
[[nodiscard]] std::unique_ptr<Store> create_sqlite_store(const std::filesystem::path& file, const LogEntry& first,
                                                         const Fill& fill = {});

/// An archive that is there. Writing is durable when Store::write() returns: write-ahead log, synchronous = FULL, each
/// setting read back before it is relied on.
/// \throws gum::StorageError  GC-ARCHIVE-0001 where there is no file, -0003 where it is no archive or one of a later
///                            program, -0009 where a setting did not take, and others
[[nodiscard]] std::unique_ptr<Store> open_sqlite_store(const std::filesystem::path& file, Access access);

/// Makes a store that nobody has open one file, which can be read from a disc that nobody writes.
void close_sqlite_file(const std::filesystem::path& file);

/// SHA-256 of the tables, indices and triggers that a store of this version has, hexadecimal: lines
/// "type TAB name TAB sql", sorted, with LF between them.
[[nodiscard]] std::string schema_digest();

}  // namespace gumcert::archive
