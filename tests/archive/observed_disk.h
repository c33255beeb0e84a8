#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gumcert::archive::test {

/// A call of SQLite that matters for what is on the disk after a power cut.
struct DiskCall {
    enum class Kind { create, write, truncate, sync, failed_sync, sync_folder, remove };
    Kind kind = Kind::write;
    std::string file;     ///< its name; all lie in one folder
    std::int64_t at = 0;  ///< offset of what is written; size that a file is cut to, in bytes
    std::string bytes;    ///< that are written
};

/// Trouble that the disk makes.
struct DiskFault {
    enum class Call { read, write, sync, truncate, open, remove, share };
    Call call = Call::write;
    long at = 0;         ///< the first one that fails: 1, 2, 3 …
    bool stays = false;  ///< all that follow fail, too
    bool full = false;   ///< ENOSPC, else EIO
};

/// The disk as SQLite sees it: a VFS over that of the system, and the one that is used by default while this object lives
/// (one in a program). Files are those of the system; nothing is synchronised really. Reads, writes, locks and memory that
/// processes share are passed on.
class ObservedDisk {
public:
    ObservedDisk();
    ~ObservedDisk();
    ObservedDisk(const ObservedDisk&) = delete;
    ObservedDisk& operator=(const ObservedDisk&) = delete;

    /// Calls are added to a list; nullptr: they are forgotten.
    void record(std::vector<DiskCall>* calls);
    /// The disk says that it has synchronised, and has not.
    void lie_about_sync(bool lies);
    void fail(const std::optional<DiskFault>& fault);
    /// Whether the fault was met since fail().
    [[nodiscard]] bool has_failed() const;
};

}  // namespace gumcert::archive::test
