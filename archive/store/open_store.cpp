#include "archive/store/open_store.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "archive/store/postgresql_store.h"
#include "archive/store/replay.h"
#include "archive/store/sqlite_store.h"

namespace gumcert::archive {

bool is_postgresql(const std::string& address) {
    return address.starts_with("postgresql://") || address.starts_with("postgres://");
}

void hide_passwords(std::span<char> word) {
    const std::string_view text(word.data(), word.size());
    const std::size_t scheme = std::min(text.find("postgresql://"), text.find("postgres://"));
    if (scheme == std::string_view::npos) {
        return;
    }
    const auto hide = [&](std::size_t from, std::size_t to) {
        std::fill(word.begin() + static_cast<std::ptrdiff_t>(from), word.begin() + static_cast<std::ptrdiff_t>(to),
                  'x');
    };
    // postgresql://USER:PASSWORD@HOST/DATABASE?password=PASSWORD&…: as libpq, the first @ ends what is before the host.
    const std::size_t begin = text.find("//", scheme) + 2;
    const std::size_t at = text.find('@', begin);
    if (const std::size_t colon = text.find(':', begin); at != std::string_view::npos && colon < at) {
        hide(colon + 1, at);
    }
    constexpr std::string_view k_key = "password=";
    for (std::size_t key = text.find(k_key, begin); key != std::string_view::npos; key = text.find(k_key, key + 1)) {
        hide(key + k_key.size(), std::min(text.find('&', key), text.size()));
    }
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
