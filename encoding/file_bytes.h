#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gumcert::encoding {

/// What a file held when it was opened, and why it could not be read.
struct FileBytes {
    std::string bytes;       ///< at most as many as were asked for
    std::string failure;     ///< "" = read; else what is wrong, for a message
    bool too_long = false;   ///< the file is longer than that
    bool leads_out = false;  ///< its name leads out of the folder that it has to stay in; `failure` says so
    unsigned mode = 0;       ///< permissions, the lowest nine bits: 0600
};

/// The bytes of a regular file, read once through one descriptor. A device, a pipe or a socket, which could be endless
/// or wait for ever, is not opened; symbolic links are followed.
/// \param most  [byte]; no more than this is read
[[nodiscard]] FileBytes read_regular_file(const std::filesystem::path& file, std::size_t most);

/// How a name is kept beneath a folder.
enum class Walk {
    by_kernel,     ///< openat2 with RESOLVE_BENEATH; step by step where there is no such call
    step_by_step,  ///< the same with every part of the name opened by itself
};

/// The same of a file beneath a folder. Neither an absolute name nor `..` nor a symbolic link in it leads out of the folder,
/// also where somebody exchanges parts of it meanwhile; links that stay in it are followed. The folder itself may be a link.
/// \param folder  "" is the current one
[[nodiscard]] FileBytes read_file_beneath(const std::filesystem::path& folder, const std::filesystem::path& name,
                                          std::size_t most, Walk walk = Walk::by_kernel);

/// Names without ".json" of the JSON files in a folder, in their order; none where the folder cannot be read.
[[nodiscard]] std::vector<std::string> json_files_in(const std::filesystem::path& folder);

}  // namespace gumcert::encoding
