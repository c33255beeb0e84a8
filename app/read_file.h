#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gumcert::app {

/// SHA-256 of some bytes, 64 hexadecimal digits in lower case (FIPS 180-4).
[[nodiscard]] std::string sha256(std::string_view bytes);

/// The whole of a file. \throws gum::StorageError if it cannot be read
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

}  // namespace gumcert::app
