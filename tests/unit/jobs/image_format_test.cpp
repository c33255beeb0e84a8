#include "jobs/image_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace gumcert::jobs {
namespace {

using testing::HasSubstr;

std::string big_endian(std::uint32_t number, int bytes) {
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
        text += static_cast<char>(number >> static_cast<unsigned>(shift) & 0xFFU);
    }
    return text;
}

/// Check sums are not looked at.
std::string chunk(const std::string& type, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size()), 4) + type + data + "sum.";
}

std::string png(std::uint32_t width, std::uint32_t height, const std::string& data = "pixels") {
    const std::string header =
        chunk("IHDR", big_endian(width, 4) + big_endian(height, 4) + std::string("\x08\x02\0\0\0", 5));
    return "\x89PNG\r\n\x1A\n" + header + (data.empty() ? "" : chunk("IDAT", data)) + chunk("IEND", "");
}

std::string segment(unsigned char marker, const std::string& data) {
    return std::string("\xFF") + static_cast<char>(marker) +
           big_endian(static_cast<std::uint32_t>(data.size() + 2), 2) + data;
}

std::string jpeg(std::uint32_t width, std::uint32_t height, unsigned char frame = 0xC0) {
    return "\xFF\xD8" + segment(0xE0, std::string("JFIF\0\x01\x01", 7)) +
           segment(frame, std::string("\x08") + big_endian(height, 2) + big_endian(width, 2) +
                              std::string("\x01\x01\x11\0", 4)) +
           segment(0xDA, std::string("\x01\x01\0\0\x3F\0", 6)) + "scan\xFF\xD9";
}

TEST(ImageFormat, IsSeenInTheBytes) {
    EXPECT_EQ(image_format(png(16, 9)).media_type, "image/png");
    EXPECT_EQ(image_format(jpeg(16, 9)).media_type, "image/jpeg");
    EXPECT_EQ(image_format(jpeg(16, 9, 0xC2)).media_type, "image/jpeg") << "progressive";
    for (const std::string& other :
         {std::string("GIF89a"), std::string("BM"), std::string("%PDF-1.7"), std::string("x")}) {
        EXPECT_EQ(image_format(other).media_type, "");
        EXPECT_EQ(image_format(other).objection, "a file of another format") << other;
    }
    EXPECT_EQ(image_format("").objection, "an empty file");
}

TEST(ImageFormat, HasOneToTenThousandPixelsASide) {
    for (const auto& [width, height, is_taken] :
         {std::tuple(1U, 1U, true), std::tuple(10000U, 10000U, true), std::tuple(0U, 5U, false),
          std::tuple(5U, 0U, false), std::tuple(10001U, 5U, false), std::tuple(5U, 10001U, false)}) {
        for (const std::string& image : {png(width, height), jpeg(width, height)}) {
            const ImageFormat found = image_format(image);
            EXPECT_EQ(found.objection.empty(), is_taken) << width << " " << height;
            EXPECT_EQ(found.media_type.empty(), !is_taken);
            if (!is_taken) {
                EXPECT_EQ(found.objection,
                          "an image of " + std::to_string(width) + " by " + std::to_string(height) + " pixels");
            }
        }
    }
    EXPECT_THAT(image_format(png(0xFFFFFFFFU, 1)).objection, HasSubstr("4294967295"));
}

/// A picture that is cut off anywhere is none, nor is one with something behind its end.
TEST(ImageFormat, IsWhole) {
    for (const std::string& image : {png(16, 9), jpeg(16, 9)}) {
        for (std::size_t size = 0; size < image.size(); ++size) {
            const ImageFormat found = image_format(image.substr(0, size));
            EXPECT_EQ(found.media_type, "") << size << " of " << image.size();
            EXPECT_NE(found.objection, "") << size;
        }
        EXPECT_EQ(image_format(image + "more").media_type, "");
    }
    EXPECT_EQ(image_format(png(16, 9, "")).objection, "a PNG file without pixels");
    EXPECT_EQ(image_format("\x89PNG\r\n\x1A\n" + chunk("IDAT", "x") + chunk("IEND", "")).objection,
              "a PNG file that does not begin with its header");
}

/// Lengths of chunks and segments lead nowhere outside of the file.
TEST(ImageFormat, BelievesNoLength) {
    const std::string image = png(16, 9);
    for (const std::uint32_t length : {0U, 12U, 14U, 0x7FFFFFFFU, 0xFFFFFFF4U, 0xFFFFFFFFU}) {
        std::string wrong = image;
        wrong.replace(8, 4, big_endian(length, 4));
        EXPECT_EQ(image_format(wrong).media_type, "") << length;
        wrong = image;
        wrong.replace(8 + 25, 4, big_endian(length, 4));  // of the pixels, which are 6
        EXPECT_EQ(image_format(wrong).media_type, "") << length;
    }
    const std::string photo = jpeg(16, 9);
    for (const std::uint32_t length : {0U, 1U, 3U, 0xFFFFU}) {
        std::string wrong = photo;
        wrong.replace(4, 2, big_endian(length, 2));
        EXPECT_EQ(image_format(wrong).media_type, "") << length;
    }
}

}  // namespace
}  // namespace gumcert::jobs
