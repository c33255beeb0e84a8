#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "system/temporary.h"

namespace gumcert::system {

/// Gives a file or folder a name that nothing has.
/// \throws std::system_error  EEXIST where something has it, and others
void rename_to_new(const std::filesystem::path& from, const std::filesystem::path& to);

/// A file that others fill under a temporary name, in a folder beside its place, and that appears whole or not at all. What
/// a killed program leaves of it goes when the next one is made.
class NewFile {
public:
    /// \param place  in a folder that is there
    /// \throws std::system_error  of the system
    explicit NewFile(std::filesystem::path place);

    /// Where it is filled; nothing is there yet.
    [[nodiscard]] const std::filesystem::path& part() const { return part_; }
    [[nodiscard]] const std::filesystem::path& place() const { return place_; }
    /// What is filled, and closed, gets its place; a file that came there meanwhile is not replaced. Not cleaned up between
    /// that and the end of `told`.
    /// \throws std::system_error  as rename_to_new()
    void put_in_place(const std::function<void()>& told = {});

private:
    std::filesystem::path place_;
    std::optional<TemporaryFolder> folder_;
    std::filesystem::path part_;
};

}  // namespace gumcert::system
