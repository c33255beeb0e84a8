#pragma once

#include <filesystem>
#include <string>

namespace gumcert::signing {

/// The whole of a file. \throws gum::StorageError  GC-SIGN-0010 if it cannot be read
[[nodiscard]] std::string read_signing_file(const std::filesystem::path& file);

}  // namespace gumcert::signing
