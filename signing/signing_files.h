#pragma once

#include <filesystem>
#include <string>

namespace gumcert::signing {

/// The whole of a regular file of at most 16 MiB.
/// \throws gum::StorageError  GC-SIGN-0010 if it cannot be read, is no regular file, or is larger
[[nodiscard]] std::string read_signing_file(const std::filesystem::path& file);

}  // namespace gumcert::signing
