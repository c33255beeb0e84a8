#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "system/temporary.h"

namespace gumcert::system {

/// New folders with files in them, each of which appears whole or not at all, also when the power fails: they are filled in
/// a temporary folder beside their places, brought to the disk together, and renamed. To bring many together to the disk
/// takes one wait in place of one for each file.
class WholeFolders {
public:
    /// Makes nothing yet.
    explicit WholeFolders(std::filesystem::path parent);
    /// Removes what was not put in place.
    ~WholeFolders();
    WholeFolders(const WholeFolders&) = delete;
    WholeFolders& operator=(const WholeFolders&) = delete;

    /// A file by its place below the folder that it lies in: "changes.json", "laboratory/logo.svg".
    using File = std::pair<std::filesystem::path, std::string_view>;

    /// Fills a folder; several threads may do it at the same time.
    /// \param name  of the folder, one part
    /// \throws std::system_error  of the system
    void fill(const std::string& name, const std::vector<File>& files);

    /// Brings to the disk what was filled since the last time, and puts it in place, in the order of the names. Meanwhile
    /// other threads may fill more.
    /// \param told  gets the name of each folder that is in place
    /// \throws std::system_error  of the system; EEXIST where something stands in the place. Folders that are in place stay
    ///                            there, whole.
    void put_in_place(const std::function<void(const std::string& name)>& told = {});

private:
    std::filesystem::path parent_;
    std::mutex mutex_;
    std::vector<std::filesystem::path> made_;  // folders that were missing, the deepest first
    std::optional<TemporaryFolder> work_;
    int descriptor_ = -1;  // of parent_: open before anything is written, so that no error of the disk is missed
    std::set<std::string> filled_;

    std::filesystem::path begun();
    void make_parent();
};

}  // namespace gumcert::system
