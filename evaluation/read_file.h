#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "reports/record/record_rules.h"

namespace gumcert::evaluation {

/// Largest record, certificate or profile that is read, [byte]: what is written as a record is read again.
inline constexpr std::size_t k_largest_file = reports::k_max_record_bytes;

/// The whole of a regular file, read once.
/// \throws gum::StorageError  GC-STORE-0001 if it cannot be read, is no regular file, or is larger than the limit
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

}  // namespace gumcert::evaluation
