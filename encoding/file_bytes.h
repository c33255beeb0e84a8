#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace gumcert::encoding {

/// What a file held when it was opened, and why it could not be read.
struct FileBytes {
    std::string bytes;      ///< at most as many as were asked for
    std::string failure;    ///< "" = read; else what is wrong, for a message
    bool too_long = false;  ///< the file is longer than that
    unsigned mode = 0;      ///< permissions, the lowest nine bits: 0600
};

/// The bytes of a regular file, read once through one descriptor. A device, a pipe or a socket, which could be endless
/// or wait for ever, is not opened; symbolic links are followed.
/// \param most  [byte]; no more than this is read
[[nodiscard]] FileBytes read_regular_file(const std::filesystem::path& file, std::size_t most);

}  // namespace gumcert::encoding
