#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace gumcert::app {

/// Largest record, certificate or profile that is read, [byte].
inline constexpr std::size_t k_largest_file = std::size_t{256} << 20U;

/// The whole of a regular file, read once.
/// \throws gum::StorageError  GC-STORE-0001 if it cannot be read, is no regular file, or is larger than the limit
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

}  // namespace gumcert::app
