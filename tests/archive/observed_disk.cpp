#include "tests/archive/observed_disk.h"

#include <sqlite3.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace gumcert::archive::test {

namespace {

constexpr int k_sector = 512;

struct DiskState {
    sqlite3_vfs* system = nullptr;
    std::vector<DiskCall>* calls = nullptr;
    bool lies = false;
    std::optional<DiskFault> fault;
    long met = 0;  // calls of the kind that fails
};
DiskState g_disk;

/// An open file; that of the system lies behind it.
struct ObservedFile {
    sqlite3_file head;
    const char* path;  // SQLite keeps it until the file is closed; nullptr: a temporary file
    bool is_journal;   // its first sync synchronises the folder
};
constexpr std::size_t k_alignment = alignof(std::max_align_t);
constexpr int k_head_size = (sizeof(ObservedFile) + k_alignment - 1) / k_alignment * k_alignment;

ObservedFile& observed(sqlite3_file* file) {
    return *reinterpret_cast<ObservedFile*>(file);  // NOLINT: SQLite hands out the first member
}

sqlite3_file* inner(sqlite3_file* file) {
    return reinterpret_cast<sqlite3_file*>(reinterpret_cast<char*>(file) + k_head_size);  // NOLINT
}

bool meets_fault(DiskFault::Call call) {
    if (!g_disk.fault || g_disk.fault->call != call) {
        return false;
    }
    ++g_disk.met;
    const bool fails = g_disk.fault->stays ? g_disk.met >= g_disk.fault->at : g_disk.met == g_disk.fault->at;
    if (fails) {
        errno = g_disk.fault->full ? ENOSPC : EIO;
    }
    return fails;
}

void note(DiskCall::Kind kind, const char* path, std::int64_t at = 0, std::string bytes = "") {
    if (g_disk.calls != nullptr && path != nullptr) {
        const char* const slash = std::strrchr(path, '/');
        g_disk.calls->push_back({kind, slash == nullptr ? path : slash + 1, at, std::move(bytes)});
    }
}

int pass_write(sqlite3_file* file, const void* data, int size, sqlite3_int64 at) {
    const int result = inner(file)->pMethods->xWrite(inner(file), data, size, at);
    if (result == SQLITE_OK) {
        note(DiskCall::Kind::write, observed(file).path, at,
             {static_cast<const char*>(data), static_cast<std::size_t>(size)});
    }
    return result;
}

int close_file(sqlite3_file* file) {
    return inner(file)->pMethods->xClose(inner(file));
}

int read_file(sqlite3_file* file, void* data, int size, sqlite3_int64 at) {
    return meets_fault(DiskFault::Call::read) ? SQLITE_IOERR_READ
                                              : inner(file)->pMethods->xRead(inner(file), data, size, at);
}

int write_file(sqlite3_file* file, const void* data, int size, sqlite3_int64 at) {
    if (!meets_fault(DiskFault::Call::write)) {
        return pass_write(file, data, size, at);
    }
    const int trouble = errno;
    const bool full = g_disk.fault->full;
    if (const int some = size / 2 / k_sector * k_sector; some > 0) {  // a part is written, as disks do
        (void)pass_write(file, data, some, at);
    }
    errno = trouble;
    return full ? SQLITE_FULL : SQLITE_IOERR_WRITE;
}

int truncate_file(sqlite3_file* file, sqlite3_int64 size) {
    if (meets_fault(DiskFault::Call::truncate)) {
        return SQLITE_IOERR_TRUNCATE;
    }
    const int result = inner(file)->pMethods->xTruncate(inner(file), size);
    note(DiskCall::Kind::truncate, observed(file).path, size);
    return result;
}

int sync_file(sqlite3_file* file, int /*flags*/) {
    ObservedFile& self = observed(file);
    if (meets_fault(DiskFault::Call::sync)) {
        note(DiskCall::Kind::failed_sync, self.path);
        return SQLITE_IOERR_FSYNC;
    }
    if (!g_disk.lies) {
        note(DiskCall::Kind::sync, self.path);
        if (std::exchange(self.is_journal, false)) {
            note(DiskCall::Kind::sync_folder, "");
        }
    }
    return SQLITE_OK;
}

int file_size(sqlite3_file* file, sqlite3_int64* size) {
    return inner(file)->pMethods->xFileSize(inner(file), size);
}
int lock_file(sqlite3_file* file, int lock) {
    return inner(file)->pMethods->xLock(inner(file), lock);
}
int unlock_file(sqlite3_file* file, int lock) {
    return inner(file)->pMethods->xUnlock(inner(file), lock);
}
int has_reserved_lock(sqlite3_file* file, int* answer) {
    return inner(file)->pMethods->xCheckReservedLock(inner(file), answer);
}
int control_file(sqlite3_file* file, int what, void* value) {
    return inner(file)->pMethods->xFileControl(inner(file), what, value);
}
int sector_size(sqlite3_file* file) {
    return inner(file)->pMethods->xSectorSize(inner(file));
}
int characteristics(sqlite3_file* file) {
    return inner(file)->pMethods->xDeviceCharacteristics(inner(file));
}
int map_shared(sqlite3_file* file, int page, int size, int extend, void volatile** where) {
    if (extend != 0 && meets_fault(DiskFault::Call::share)) {
        return SQLITE_IOERR_SHMSIZE;
    }
    return inner(file)->pMethods->xShmMap(inner(file), page, size, extend, where);
}
int lock_shared(sqlite3_file* file, int offset, int n, int flags) {
    return inner(file)->pMethods->xShmLock(inner(file), offset, n, flags);
}
void order_shared(sqlite3_file* file) {
    inner(file)->pMethods->xShmBarrier(inner(file));
}
int unmap_shared(sqlite3_file* file, int remove) {
    return inner(file)->pMethods->xShmUnmap(inner(file), remove);
}

/// Version 2: without files that are mapped into memory.
const sqlite3_io_methods k_methods = {
    2,           close_file,   read_file,         write_file,   truncate_file, sync_file,       file_size,
    lock_file,   unlock_file,  has_reserved_lock, control_file, sector_size,   characteristics, map_shared,
    lock_shared, order_shared, unmap_shared,      nullptr,      nullptr};

int open_file(sqlite3_vfs* /*vfs*/, const char* path, sqlite3_file* file, int flags, int* flags_taken) {
    file->pMethods = nullptr;
    if ((flags & SQLITE_OPEN_CREATE) != 0 && meets_fault(DiskFault::Call::open)) {
        return SQLITE_CANTOPEN;
    }
    int there = 0;
    if (path != nullptr) {
        (void)g_disk.system->xAccess(g_disk.system, path, SQLITE_ACCESS_EXISTS, &there);
    }
    const int result = g_disk.system->xOpen(g_disk.system, path, inner(file), flags, flags_taken);
    if (result != SQLITE_OK) {
        return result;
    }
    // As the VFS of the system: it synchronises the folder with a journal that it was to create (sqlite3, os_unix.c, unixOpen).
    const bool is_journal = (flags & SQLITE_OPEN_CREATE) != 0 &&
                            (flags & (SQLITE_OPEN_MAIN_JOURNAL | SQLITE_OPEN_WAL | SQLITE_OPEN_SUPER_JOURNAL)) != 0;
    observed(file) = {{&k_methods}, path, is_journal};
    if (there == 0) {
        note(DiskCall::Kind::create, path);
    }
    return SQLITE_OK;
}

int remove_file(sqlite3_vfs* /*vfs*/, const char* path, int sync_folder) {
    if (meets_fault(DiskFault::Call::remove)) {
        return SQLITE_IOERR_DELETE;
    }
    const int result = g_disk.system->xDelete(g_disk.system, path, 0);
    if (result == SQLITE_OK) {
        note(DiskCall::Kind::remove, path);
    }
    if (sync_folder != 0 && !g_disk.lies) {
        note(DiskCall::Kind::sync_folder, "");
    }
    return result;
}

sqlite3_vfs g_vfs;

}  // namespace

ObservedDisk::ObservedDisk() {
    g_disk = DiskState{};
    g_disk.system = sqlite3_vfs_find("unix");
    if (g_disk.system == nullptr) {
        std::abort();
    }
    g_vfs = *g_disk.system;
    g_vfs.zName = "observed";
    g_vfs.szOsFile = k_head_size + g_disk.system->szOsFile;
    g_vfs.pNext = nullptr;
    g_vfs.xOpen = open_file;
    g_vfs.xDelete = remove_file;
    (void)sqlite3_vfs_register(&g_vfs, 1);
}

ObservedDisk::~ObservedDisk() {
    (void)sqlite3_vfs_unregister(&g_vfs);
    (void)sqlite3_vfs_register(g_disk.system, 1);
}

void ObservedDisk::record(std::vector<DiskCall>* calls) {
    g_disk.calls = calls;
}

void ObservedDisk::lie_about_sync(bool lies) {
    g_disk.lies = lies;
}

void ObservedDisk::fail(const std::optional<DiskFault>& fault) {
    g_disk.fault = fault;
    g_disk.met = 0;
}

bool ObservedDisk::has_failed() const {
    return g_disk.fault && g_disk.met >= g_disk.fault->at;
}

}  // namespace gumcert::archive::test
