#include "encoding/npy.h"

#include <bit>
#include <cstdint>

namespace gumcert::encoding {

std::string npy_header(std::size_t rows, std::size_t columns) {
    constexpr std::size_t k_alignment = 64;
    std::string dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", " +
                             std::to_string(columns) + "), }";
    std::string file = "\x93NUMPY";
    file += '\x01';
    file += '\x00';
    const std::size_t used = file.size() + 2 + dictionary.size() + 1;
    dictionary.append((k_alignment - used % k_alignment) % k_alignment, ' ');
    dictionary += '\n';
    file += static_cast<char>(dictionary.size() & 0xFFU);
    file += static_cast<char>(dictionary.size() >> 8U);
    return file + dictionary;
}

void append_npy(std::string& file, std::span<const double> elements) {
    for (const double element : elements) {
        std::uint64_t bits = std::bit_cast<std::uint64_t>(element);
        for (int i = 0; i < 8; ++i, bits >>= 8U) {
            file += static_cast<char>(bits & 0xFFU);
        }
    }
}

}  // namespace gumcert::encoding
