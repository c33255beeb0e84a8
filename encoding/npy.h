#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace gumcert::encoding {

/// Start of a NumPy file (format version 1.0) of a matrix of doubles, little-endian, row by row; its elements follow.
[[nodiscard]] std::string npy_header(std::size_t rows, std::size_t columns);

/// Appends elements as eight bytes each, little-endian.
void append_npy(std::string& file, std::span<const double> elements);

}  // namespace gumcert::encoding
