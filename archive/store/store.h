#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "archive/store/entry.h"

namespace gumcert::archive {

enum class Access { read_only, read_and_write };

/// Bytes that are kept under their hash.
struct Content {
    std::string sha256;  ///< name, 64 hexadecimal digits
    std::string bytes;
};

/// A certificate as lists show it. It stands in a table of its own, so that a list need not read the log, and says nothing
/// that the log does not say: it is made of the entries above the store, and verify_store() makes it again.
struct ListedCertificate {
    std::string number, state, since, item, record;

    friend bool operator==(const ListedCertificate&, const ListedCertificate&) = default;
};

/// Where an archive is kept: a log to which entries are added, and contents under their hashes. Nothing of these is changed
/// or removed. What entries mean, and their hashes, is made above it, so that every store holds the same bytes.
///
/// Every function throws gum::StorageError, GC-ARCHIVE-0001 to -0010 and -0034, where the store has trouble.
class Store {
public:
    Store() = default;
    Store(const Store&) = delete;
    Store& operator=(const Store&) = delete;
    virtual ~Store() = default;

    [[nodiscard]] virtual std::string name() const = 0;  ///< for messages

    /// Does some work that sees one state of the store.
    virtual void read(const std::function<void()>& work) = 0;
    /// Does some work that adds entries, alone among all writers: all of it is durable when this returns, or nothing is
    /// kept where it throws.
    virtual void write(const std::function<void()>& work) = 0;

    // Inside of write() only.
    virtual void append(const LogEntry& entry) = 0;
    virtual void put(const Content& content) = 0;  ///< \pre has(content.sha256) is false
    /// What lists say of a certificate from now on.
    virtual void list(const ListedCertificate& certificate) = 0;

    [[nodiscard]] virtual bool has(const std::string& sha256) = 0;
    /// Bytes under their hash, which is computed again: nobody goes on with others.
    /// \throws gum::StorageError  GC-ARCHIVE-0012 where the bytes have another hash
    [[nodiscard]] std::optional<std::string> content(const std::string& sha256);
    [[nodiscard]] virtual std::optional<LogEntry> last_entry() = 0;
    [[nodiscard]] virtual std::optional<LogEntry> entry_of_request(const std::string& request_key) = 0;
    /// Of one certificate, the oldest first.
    [[nodiscard]] virtual std::vector<LogEntry> entries_of(const std::string& certificate) = 0;
    /// Of one kind, the newest first, until `more` returns false.
    virtual void entries_of_kind(const std::string& kind, const std::function<bool(const LogEntry&)>& more) = 0;
    /// All certificates that list() was told of, by number.
    [[nodiscard]] virtual std::vector<ListedCertificate> listed() = 0;
    /// All, in the order of the store, which is that of seq.
    virtual void each_entry(const std::function<void(const LogEntry&)>& visit) = 0;
    virtual void each_content(const std::function<void(const Content&)>& visit) = 0;

    /// What the store finds wrong with its own files and tables: one sentence each.
    [[nodiscard]] virtual std::vector<std::string> own_problems() = 0;
    /// A copy as it is at one moment, while others write.
    /// \param file  a name that is not there yet
    virtual void copy_to(const std::filesystem::path& file) = 0;

private:
    /// As they are stored.
    [[nodiscard]] virtual std::optional<std::string> stored_bytes(const std::string& sha256) = 0;
};

/// Adds entries and contents to a store that is being made.
using Fill = std::function<void(Store&)>;

}  // namespace gumcert::archive
