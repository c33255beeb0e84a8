#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "tests/fuzz/job_targets.h"

namespace gumcert::fuzz {

/// A folder of this process in the temporary folder, for what is read from files only; removed at the end.
class BundleFolder {
public:
    explicit BundleFolder(const std::string& name)
        : path_(std::filesystem::temp_directory_path() / ("gumcert_fuzz_" + name + "." + std::to_string(::getpid()))) {}
    ~BundleFolder() { clear(); }
    BundleFolder(const BundleFolder&) = delete;
    BundleFolder& operator=(const BundleFolder&) = delete;

    /// Empties the folder and writes the files of a bundle; those whose names lead out of it are left out.
    void fill(std::string_view bundle) const {
        clear();
        std::filesystem::create_directories(path_);
        for (const auto& [name, bytes] : jobs::fuzz::files_of_bundle(bundle)) {
            if (stays_inside(name)) {
                write(name, bytes);
            }
        }
    }
    void write(const std::string& name, std::string_view bytes) const {
        std::error_code ignored;  // a file stands where a folder should
        std::filesystem::create_directories((path_ / name).parent_path(), ignored);
        std::ofstream(path_ / name, std::ios::binary) << bytes;
    }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const { return path_ / name; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    static bool stays_inside(const std::string& name) {
        return !name.empty() && name.size() < 64 && name.front() != '/' && !name.ends_with('/') &&
               name.find("..") == std::string::npos && name != "." && std::ranges::all_of(name, [](char c) {
                   return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
                          c == '_' || c == '-' || c == '/';
               });
    }
    void clear() const {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    std::filesystem::path path_;
};

}  // namespace gumcert::fuzz
