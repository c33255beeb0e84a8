#pragma once

#include <memory>
#include <span>
#include <string>

#include "archive/store/entry.h"
#include "archive/store/store.h"

namespace gumcert::archive {

/// Whether an address is one of PostgreSQL, "postgresql://…" or "postgres://…"; every other one is a file of SQLite.
[[nodiscard]] bool is_postgresql(const std::string& address);

/// Overwrites with x the passwords of addresses (SCHEME://USER:PASSWORD@…) and behind password=, wherever in a word of the
/// command line they stand: other users of the machine can read those words. Every other word stays as it is.
void hide_passwords(std::span<char> word);

/// A new archive with its first entry, and with what `fill` adds: all of it or nothing.
/// \throws gum::StorageError  GC-ARCHIVE-0002 where it is there already, -0006 where the address is one of something else, and
///                            others
[[nodiscard]] std::unique_ptr<Store> create_store(const std::string& address, const LogEntry& first,
                                                  const Fill& fill = {});

/// An archive that is there.
/// \throws gum::StorageError  GC-ARCHIVE-0001, -0003 where there is none, -0006 as above, and others
[[nodiscard]] std::unique_ptr<Store> open_store(const std::string& address, Access access);

/// A new archive with the log and the contents of another one: the same entries with the same hashes, so that heads and
/// evidence hold for both.
/// \param finish  adds what lists say (archive::list_again)
/// \throws gum::StorageError  as both of them
[[nodiscard]] std::unique_ptr<Store> replay_into(Store& from, const std::string& address, const Fill& finish);

}  // namespace gumcert::archive
