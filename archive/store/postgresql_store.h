#pragma once

#include <memory>
#include <string>

#include "archive/store/entry.h"
#include "archive/store/store.h"

namespace gumcert::archive {

/// A new archive in the schema gumcert_archive of a database of PostgreSQL, with its first entry.
/// \param fill  adds more to it; all of it or nothing
/// \throws gum::StorageError  GC-ARCHIVE-0002 where the database has an archive, and others
[[nodiscard]] std::unique_ptr<Store> create_postgresql_store(const std::string& address, const LogEntry& first,
                                                             const Fill& fill = {});

/// An archive that is there. Writing is durable when Store::write() returns: fsync, full_page_writes and
/// synchronous_commit are read before they are relied on.
/// \throws gum::StorageError  GC-ARCHIVE-0003 where the database has no archive or one of a later program, -0009 where a
///                            setting loses entries in a power cut, and others
[[nodiscard]] std::unique_ptr<Store> open_postgresql_store(const std::string& address, Access access);

/// SHA-256 of what the schema of this version has, by the catalogue of the server, hexadecimal.
[[nodiscard]] std::string postgresql_schema_digest();

}  // namespace gumcert::archive
