#include "system/cleanup.h"

#include <unistd.h>

#include <csignal>
#include <set>
#include <system_error>

namespace gumcert::system {

namespace {

namespace fs = std::filesystem;

struct Register {
    std::recursive_timed_mutex mutex;
    std::set<fs::path> files;
    std::set<fs::path> folders;
    std::set<fs::path> new_folders;
    std::set<pid_t> children;
};

/// Never destroyed: a signal may come while the program is ending.
Register& everything() {
    static auto* const all = new Register;
    return *all;
}

/// Other threads may write into it until it is gone.
void remove_folder(const fs::path& folder) {
    constexpr int k_most_tries = 100;
    std::error_code error;
    for (int i = 0; i < k_most_tries; ++i) {
        fs::remove_all(folder, error);
        if (!error) {
            return;
        }
    }
}

}  // namespace

CleanupLock hold_cleanup() {
    return CleanupLock(everything().mutex);
}

void remember_file(const fs::path& file) {
    const CleanupLock lock = hold_cleanup();
    everything().files.insert(file);
}

void forget_file(const fs::path& file) {
    const CleanupLock lock = hold_cleanup();
    everything().files.erase(file);
}

void remember_folder(const fs::path& folder) {
    const CleanupLock lock = hold_cleanup();
    everything().folders.insert(folder);
}

void remember_new_folder(const fs::path& folder) {
    const CleanupLock lock = hold_cleanup();
    everything().new_folders.insert(folder);
}

void forget_folder(const fs::path& folder) {
    const CleanupLock lock = hold_cleanup();
    everything().folders.erase(folder);
    everything().new_folders.erase(folder);
}

void remember_child(pid_t child) {
    const CleanupLock lock = hold_cleanup();
    everything().children.insert(child);
}

void forget_child(pid_t child) {
    const CleanupLock lock = hold_cleanup();
    everything().children.erase(child);
}

CleanupLock clean_up(std::chrono::milliseconds patience) {
    // What is said at the end may have no reader any more: the handler would wait for the end that this thread is to bring. Not blocked
    // in this thread: it would not end by the signal itself then.
    (void)std::signal(SIGPIPE, SIG_IGN);
    CleanupLock lock(everything().mutex, std::defer_lock);
    if (!lock.try_lock_for(patience)) {
        return lock;
    }
    Register& all = everything();
    for (const pid_t child : all.children) {
        ::kill(-child, SIGKILL);  // where it leads a process group: with what it has started
        ::kill(child, SIGKILL);
    }
    for (const fs::path& file : all.files) {
        ::unlink(file.c_str());
    }
    for (const fs::path& folder : all.folders) {
        remove_folder(folder);
    }
    for (auto folder = all.new_folders.rbegin(); folder != all.new_folders.rend(); ++folder) {  // the deeper ones first
        ::rmdir(folder->c_str());
    }
    all.children.clear();
    all.files.clear();
    all.folders.clear();
    all.new_folders.clear();
    return lock;
}

}  // namespace gumcert::system
