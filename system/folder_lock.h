#pragma once

#include <chrono>
#include <filesystem>

namespace gumcert::system {

/// The lock of a folder, on the folder itself: no file comes or stays for it, and it goes with its process.
class FolderLock {
public:
    enum class State {
        held,
        busy,        ///< another process has it
        unsupported  ///< the file system has no such locks, or the folder cannot be opened
    };
    /// \param shared    others may have it shared, too: for reading
    /// \param patience  how long it waits for the others
    FolderLock(const std::filesystem::path& folder, bool shared, std::chrono::milliseconds patience);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

    [[nodiscard]] State state() const { return state_; }

private:
    int descriptor_ = -1;
    State state_ = State::unsupported;
};

}  // namespace gumcert::system
