#pragma once

#include <functional>

#include "archive/store/entry.h"
#include "archive/store/store.h"

namespace gumcert::archive {

/// Makes another store of the entries and contents of one, as it is at one moment.
/// \param create  makes it, with the first entry and what the second argument adds
/// \param finish  adds what lists say, which is not copied
/// \throws gum::StorageError  GC-ARCHIVE-0007 where the log is empty, and those of both stores
void replay(Store& from, const std::function<void(const LogEntry&, const Fill&)>& create, const Fill& finish);

}  // namespace gumcert::archive
