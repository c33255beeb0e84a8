#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <mutex>

namespace gumcert::system {

using CleanupLock = std::unique_lock<std::recursive_timed_mutex>;

/// While it is held nothing is cleaned up: what is made and remembered under it is never missed, and what is begun under
/// it is brought to its end. For moments only.
[[nodiscard]] CleanupLock hold_cleanup();

/// What this process leaves to nobody: files and folders that are removed, and child processes that are ended, when a
/// signal ends the program. Who made them forgets them when they are gone.
void remember_file(const std::filesystem::path& file);
void forget_file(const std::filesystem::path& file);
void remember_folder(const std::filesystem::path& folder);
/// A folder that is removed only while it is empty.
void remember_new_folder(const std::filesystem::path& folder);
void forget_folder(const std::filesystem::path& folder);
void remember_child(pid_t child);
void forget_child(pid_t child);

/// Ends the children, then removes files and folders. For a thread that ends the program next, not for a handler of
/// signals. Other threads may still be at work: while the lock is held they make nothing new. SIGPIPE is ignored from here on.
/// \param patience  how long it waits for work that holds the lock
/// \return the lock; not owned: it was not to be had, and nothing was cleaned up
[[nodiscard]] CleanupLock clean_up(std::chrono::milliseconds patience);

}  // namespace gumcert::system
