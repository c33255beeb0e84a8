// Loaded before the C library (LD_PRELOAD): makes the n-th call of the system fail, or ends the process there.
//
//   GUMCERT_FAULT_AT     n, counted from 1 over all calls below; 0 or nothing: none fails
//   GUMCERT_FAULT_KIND   number of an error (5 EIO, 28 ENOSPC), or "signal 9"; "memory": allocations count, not calls
//   GUMCERT_FAULT_FOR    how many calls from the n-th on fail; 1 where it is not stated
//   GUMCERT_FAULT_COUNT  file that gets the number of calls when the process ends by itself
//
// Children do not inherit it.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
}

namespace {

std::atomic<long> calls{0};
long fail_at = 0;
long fail_for = 1;
int fault_error = EIO;
int fault_signal = 0;
bool of_memory = false;
bool ready = false;
const char* count_file = nullptr;

__attribute__((constructor)) void begin() {
    const char* at = std::getenv("GUMCERT_FAULT_AT");
    const char* many = std::getenv("GUMCERT_FAULT_FOR");
    const char* kind = std::getenv("GUMCERT_FAULT_KIND");
    count_file = std::getenv("GUMCERT_FAULT_COUNT");
    fail_at = at == nullptr ? 0 : std::atol(at);
    fail_for = many == nullptr ? 1 : std::atol(many);
    if (kind != nullptr && std::strncmp(kind, "signal ", 7) == 0) {
        fault_signal = std::atoi(kind + 7);
    } else if (kind != nullptr && std::strcmp(kind, "memory") == 0) {
        of_memory = true;
    } else if (kind != nullptr) {
        fault_error = std::atoi(kind);
    }
    unsetenv("LD_PRELOAD");
    ready = true;
}

__attribute__((destructor)) void end() {
    const long number = calls;
    ready = false;
    if (count_file == nullptr) {
        return;
    }
    char text[32];
    const int size = std::snprintf(text, sizeof text, "%ld\n", number);
    const long file = syscall(SYS_openat, AT_FDCWD, count_file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file >= 0) {
        syscall(SYS_write, file, text, size);
        syscall(SYS_close, file);
    }
}

/// Whether this call fails; errno is set then.
bool fails(bool memory) {
    if (!ready || memory != of_memory) {
        return false;
    }
    const long number = ++calls;
    if (fail_at <= 0 || number < fail_at || number >= fail_at + fail_for) {
        return false;
    }
    if (fault_signal != 0) {
        kill(getpid(), fault_signal);
        return false;
    }
    errno = memory ? ENOMEM : fault_error;
    return true;
}

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

#define GUMCERT_MODE_OF(flags)            \
    mode_t mode = 0;                      \
    if (((flags)&O_CREAT) != 0) {         \
        va_list arguments;                \
        va_start(arguments, flags);       \
        mode = va_arg(arguments, mode_t); \
        va_end(arguments);                \
    }

int open(const char* path, int flags, ...) {
    GUMCERT_MODE_OF(flags)
    return fails(false) ? -1 : next<int(const char*, int, ...)>("open")(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
    GUMCERT_MODE_OF(flags)
    return fails(false) ? -1 : next<int(const char*, int, ...)>("open64")(path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
    GUMCERT_MODE_OF(flags)
    return fails(false) ? -1 : next<int(int, const char*, int, ...)>("openat")(folder, path, flags, mode);
}
// Whoever closes a descriptor that cannot be closed has lost it all the same.
int close(int descriptor) {
    const bool failed = fails(false);
    const int error = errno;
    const int result = next<int(int)>("close")(descriptor);
    if (failed) {
        errno = error;
        return -1;
    }
    return result;
}
ssize_t read(int descriptor, void* buffer, size_t size) {
    return fails(false) ? -1 : next<ssize_t(int, void*, size_t)>("read")(descriptor, buffer, size);
}
ssize_t write(int descriptor, const void* buffer, size_t size) {
    if (fails(false)) {
        // As on a disk that becomes full: a part arrives.
        if (size > 1) {
            (void)!next<ssize_t(int, const void*, size_t)>("write")(descriptor, buffer, size / 2);
            errno = fault_error;
        }
        return -1;
    }
    return next<ssize_t(int, const void*, size_t)>("write")(descriptor, buffer, size);
}
int fsync(int descriptor) {
    return fails(false) ? -1 : next<int(int)>("fsync")(descriptor);
}
int rename(const char* from, const char* to) {
    return fails(false) ? -1 : next<int(const char*, const char*)>("rename")(from, to);
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
    return fails(false) ? -1
                        : next<int(int, const char*, int, const char*, unsigned)>("renameat2")(from_folder, from,
                                                                                               to_folder, to, flags);
}
int unlink(const char* path) {
    return fails(false) ? -1 : next<int(const char*)>("unlink")(path);
}
int mkdir(const char* path, mode_t mode) {
    return fails(false) ? -1 : next<int(const char*, mode_t)>("mkdir")(path, mode);
}
int rmdir(const char* path) {
    return fails(false) ? -1 : next<int(const char*)>("rmdir")(path);
}
char* mkdtemp(char* pattern) {
    return fails(false) ? nullptr : next<char*(char*)>("mkdtemp")(pattern);
}
int flock(int descriptor, int operation) {
    return fails(false) ? -1 : next<int(int, int)>("flock")(descriptor, operation);
}
int fchmod(int descriptor, mode_t mode) {
    return fails(false) ? -1 : next<int(int, mode_t)>("fchmod")(descriptor, mode);
}
int pipe2(int* ends, int flags) {
    return fails(false) ? -1 : next<int(int*, int)>("pipe2")(ends, flags);
}

void* malloc(std::size_t size) {
    return fails(true) ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
    return fails(true) ? nullptr : __libc_calloc(number, size);
}
void* realloc(void* block, std::size_t size) {
    return fails(true) ? nullptr : __libc_realloc(block, size);
}

}  // extern "C"
