#include "encoding/npy.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace gumcert::encoding {
namespace {

TEST(Npy, HeaderNamesTypeAndShapeAndEndsOnAnAlignedLine) {
    for (const std::size_t rows : {std::size_t{0}, std::size_t{1}, std::size_t{226}, std::size_t{21604}}) {
        const std::string header = npy_header(rows, 154);
        EXPECT_EQ(header.substr(0, 6), "\x93NUMPY");
        EXPECT_EQ(header.substr(6, 2), std::string("\x01\x00", 2)) << "version 1.0";
        const auto length = static_cast<unsigned char>(header[8]) + 256U * static_cast<unsigned char>(header[9]);
        EXPECT_EQ(header.size(), 10U + length);
        EXPECT_EQ(header.size() % 64, 0U);
        EXPECT_EQ(header.back(), '\n');
        EXPECT_NE(
            header.find("{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", 154), }"),
            std::string::npos);
    }
}

TEST(Npy, ElementsAreLittleEndianDoubles) {
    std::string file;
    const std::array<double, 3> elements{1.0, -0.1, 6.02214076e23};
    append_npy(file, elements);
    EXPECT_EQ(file.substr(0, 8), std::string("\0\0\0\0\0\0\xF0\x3F", 8));
    ASSERT_EQ(file.size(), 24U);
    // The machines of the tests are little-endian.
    std::array<double, 3> back{};
    std::memcpy(back.data(), file.data(), file.size());
    EXPECT_EQ(back, elements);
}

}  // namespace
}  // namespace gumcert::encoding
