#include "archive/store/open_store.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "archive/store/postgresql_store.h"
#include "archive/store/replay.h"
#include "archive/store/sqlite_store.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

namespace {

/// What looks like the address of a server and is none that is known: as the name of a file it would stand in messages, with
/// its password.
void refuse_other_addresses(const std::string& address) {
    std::string plain = address;
    std::erase_if(plain, [](char c) { return c == ' ' || c == '\t'; });
    std::transform(plain.begin(), plain.end(), plain.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    const bool is_address = plain.find("://") != std::string::npos || plain.find("password=") != std::string::npos ||
                            (plain.starts_with("postgres") && plain.find('@') != std::string::npos);
    std::error_code error;
    if (!is_postgresql(address) && is_address && !std::filesystem::exists(address, error)) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-ARCHIVE-0006",
                            .where = "the archive",
                            .what = "its name is neither that of a file nor an address that this program reads",
                            .rule = "an archive on a server has an address postgresql://HOST:PORT/DATABASE",
                            .action = "write the address so, and keep the password in ~/.pgpass"});
    }
}

}  // namespace

bool is_postgresql(const std::string& address) {
    return address.starts_with("postgresql://") || address.starts_with("postgres://");
}

void hide_passwords(std::span<char> word) {
    constexpr std::string_view k_blanks = " \t\n\r";
    const std::string_view text(word.data(), word.size());
    const auto hide = [&](std::size_t from, std::size_t to) {
        std::fill(word.begin() + static_cast<std::ptrdiff_t>(from), word.begin() + static_cast<std::ptrdiff_t>(to),
                  'x');
    };
    const auto end_of = [&](std::size_t from, std::string_view ends) {
        return std::min(text.find_first_of(ends, from), text.size());
    };
    // postgresql://USER:PASSWORD@HOST/DATABASE?password=PASSWORD&…: up to the last @, whichever libpq takes.
    constexpr std::string_view k_scheme = "://";
    for (std::size_t at = text.find(k_scheme); at != std::string_view::npos; at = text.find(k_scheme, at + 1)) {
        const std::size_t begin = at + k_scheme.size();
        const std::string_view address = text.substr(begin, end_of(begin, k_blanks) - begin);
        const std::size_t colon = address.find(':');
        if (const std::size_t host = address.rfind('@'); host != std::string_view::npos && colon < host) {
            hide(begin + colon + 1, begin + host);
        }
    }
    // Of an address, and of the other form that libpq has: host=HOST password='PASSWORD'.
    constexpr std::string_view k_key = "password";
    for (std::size_t key = text.find(k_key); key != std::string_view::npos; key = text.find(k_key, key + 1)) {
        const std::size_t equals = std::min(text.find_first_not_of(k_blanks, key + k_key.size()), text.size());
        if (equals == text.size() || text[equals] != '=') {
            continue;
        }
        const std::size_t begin = std::min(text.find_first_not_of(k_blanks, equals + 1), text.size());
        const bool is_quoted = begin < text.size() && text[begin] == '\'';
        hide(begin, is_quoted ? end_of(begin + 1, "'") : end_of(begin, "& \t\n\r"));
    }
}

std::unique_ptr<Store> create_store(const std::string& address, const LogEntry& first, const Fill& fill) {
    refuse_other_addresses(address);
    return is_postgresql(address) ? create_postgresql_store(address, first, fill)
                                  : create_sqlite_store(address, first, fill);
}

std::unique_ptr<Store> open_store(const std::string& address, Access access) {
    refuse_other_addresses(address);
    return is_postgresql(address) ? open_postgresql_store(address, access) : open_sqlite_store(address, access);
}

std::unique_ptr<Store> replay_into(Store& from, const std::string& address, const Fill& finish) {
    std::unique_ptr<Store> made;
    replay(
        from, [&](const LogEntry& first, const Fill& fill) { made = create_store(address, first, fill); }, finish);
    return made;
}

}  // namespace gumcert::archive
