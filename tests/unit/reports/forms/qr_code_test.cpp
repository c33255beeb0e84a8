#include "reports/forms/qr_code.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

bool is_dark(const QrCode& code, int row, int column) {
    return code.dark[static_cast<std::size_t>(row * code.size + column)];
}

/// A picture of the code, eight pixels a module, with its margin.
std::string picture_of(const QrCode& code) {
    constexpr int k_pixels = 8;
    constexpr int k_margin = 4;
    const int side = (code.size + 2 * k_margin) * k_pixels;
    std::string pixels = "P5\n" + std::to_string(side) + " " + std::to_string(side) + "\n255\n";
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const int row = y / k_pixels - k_margin;
            const int column = x / k_pixels - k_margin;
            const bool inside = row >= 0 && column >= 0 && row < code.size && column < code.size;
            pixels += inside && is_dark(code, row, column) ? '\0' : '\xFF';
        }
    }
    return pixels;
}

TEST(QrCode, HasThePatternsThatReadersLookFor) {
    const QrCode code = qr_code("EX-2026-0042");
    ASSERT_EQ(code.size, 21);  // version 1 holds it (ISO/IEC 18004:2015, table 7: 20 characters at M)
    ASSERT_EQ(code.dark.size(), 441U);
    for (const auto& [top, left] : {std::pair(0, 0), std::pair(0, 14), std::pair(14, 0)}) {
        for (int i = 0; i < 7; ++i) {  // a dark frame, a light one in it, and a dark square
            EXPECT_TRUE(is_dark(code, top, left + i) && is_dark(code, top + 6, left + i));
            EXPECT_TRUE(is_dark(code, top + i, left) && is_dark(code, top + i, left + 6));
        }
        EXPECT_FALSE(is_dark(code, top + 1, left + 1));
        EXPECT_TRUE(is_dark(code, top + 3, left + 3));
    }
    for (int i = 8; i < 13; ++i) {
        EXPECT_EQ(is_dark(code, 6, i), i % 2 == 0) << "timing pattern";
    }
}

TEST(QrCode, IsReadByAnotherProgram) {
    const std::filesystem::path reader = program("zbarimg");
    if (reader.empty()) {
        GTEST_SKIP() << "zbarimg (zbar-tools) is not installed";
    }
    const std::string text = "EX-2026-0042/a SHA-256 " + std::string(64, 'A');
    const std::filesystem::path file =
        std::filesystem::path(::testing::TempDir()) / ("gumcert-qr-" + std::to_string(getpid()) + ".pgm");
    std::ofstream(file, std::ios::binary) << picture_of(qr_code(text));
    const std::string command = reader.string() + " --raw -q '" + file.string() + "' 2>/dev/null";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::array<char, 1024> buffer{};
    const std::size_t count = pipe == nullptr ? 0 : std::fread(buffer.data(), 1, buffer.size(), pipe.get());
    std::filesystem::remove(file);
    EXPECT_EQ(std::string(buffer.data(), count), text + "\n");
}

TEST(QrCode, OfNothingOrTooMuchIsRefused) {
    EXPECT_THROW((void)qr_code(""), gum::NoResultError);
    EXPECT_THROW((void)qr_code(std::string(2001, 'x')), gum::NoResultError);
    EXPECT_NO_THROW((void)qr_code(std::string(2000, 'x')));
}

TEST(QrCode, AsSvgDrawsEveryDarkModuleOnce) {
    const QrCode code = qr_code("1");
    const std::string svg = svg_of(code, 1.0, 2.0, 25.0);
    EXPECT_NE(svg.find("x=\"1\" y=\"2\" width=\"25\""), std::string::npos);
    EXPECT_NE(svg.find("viewBox=\"0 0 29 29\""), std::string::npos);
    EXPECT_NE(svg.find("M4 4h7v1h-7z"), std::string::npos) << "the first row of the first finder pattern";
}

}  // namespace
}  // namespace gumcert::reports
