#include "archive/store/open_store.h"

#include <optional>

#include "archive/store/postgresql_store.h"
#include "archive/store/replay.h"
#include "archive/store/sqlite_store.h"

namespace gumcert::archive {

bool is_postgresql(const std::string& address) {
    return address.starts_with("postgresql://") || address.starts_with("postgres://");
}

std::unique_ptr<Store> create_store(const std::string& address, const LogEntry& first, const Fill& fill) {
    return is_postgresql(address) ? create_postgresql_store(address, first, fill)
                                  : create_sqlite_store(address, first, fill);
}

std::unique_ptr<Store> open_store(const std::string& address, Access access) {
    return is_postgresql(address) ? open_postgresql_store(address, access) : open_sqlite_store(address, access);
}

std::unique_ptr<Store> replay_into(Store& from, const std::string& address, const Fill& finish) {
    std::unique_ptr<Store> made;
    replay(
        from, [&](const LogEntry& first, const Fill& fill) { made = create_store(address, first, fill); }, finish);
    return made;
}

}  // namespace gumcert::archive
