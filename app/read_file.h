#pragma once

#include <filesystem>
#include <string>

namespace gumcert::app {

/// The whole of a file. \throws gum::StorageError if it cannot be read
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

}  // namespace gumcert::app
