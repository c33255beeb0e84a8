#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace gumcert::system {

/// Writes all of it, in as many pieces as it takes; not on the disk yet.
/// \return 0, or what errno says of why not
[[nodiscard]] int write_whole(int descriptor, std::string_view bytes);

/// A new file in a folder, `.gumcert-<16 hexadecimal digits>.part`, with a name that nobody can know beforehand. Nothing
/// that is there already is opened. Removed at the end, and by clean_up(), unless it was kept.
class TemporaryFile {
public:
    /// \param mode  as of open()
    /// \throws std::system_error  of the system, with the folder in no text
    TemporaryFile(const std::filesystem::path& folder, mode_t mode);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// Writes all of it, brings it to the disk and closes the file.
    /// \throws std::system_error  of the system
    void fill(std::string_view bytes);
    /// From here on it is not removed: it has another name, or somebody else needs it.
    void keep();
    /// \return whether it is gone
    bool remove();

    /// Whether a name in a folder is that of such a file.
    [[nodiscard]] static bool is_name(std::string_view name);

private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

/// A folder that only this user can enter, `gumcert-work-XXXXXX`; removed with everything in it at the end, and by
/// clean_up(). It is locked while its process lives, so that others see whether it is dead.
class TemporaryFolder {
public:
    /// Removes the dead ones beside it first.
    /// \throws std::system_error  of the system
    explicit TemporaryFolder(const std::filesystem::path& parent);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    int lock_ = -1;
};

/// Removes folders of this user whose processes ended without doing so; never one of a living process or of another
/// user.
/// \return how many
std::size_t remove_dead_folders(const std::filesystem::path& parent);

}  // namespace gumcert::system
