#include "text/angle_text.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::text {
namespace {

constexpr AnglePart k_seconds = AnglePart::seconds, k_minutes = AnglePart::minutes;

std::string read(const std::string& text, AnglePart last = k_seconds) {
    return decimal_of_angle(text, last).value_or("none");
}

/// Without the kind of blanks, which are those that do not break.
std::string parts(const std::string& decimal, AnglePart last = k_seconds) {
    std::string text = angle_in_parts(decimal, last);
    for (std::size_t at = text.find("\u00A0"); at != std::string::npos; at = text.find("\u00A0")) {
        text.replace(at, 2, " ");
    }
    return text;
}

TEST(AngleText, ReadsWhatPeopleWrite) {
    for (const char* text : {"12° 30' 05.0\"", "12°30′05.0″", "12º 30’ 05.0”", "12 ° 30 ' 05.0 ''", "+12° 30' 5.0\"",
                             "12°\u00A030′\u202F05,0″", "750' 05.0\"", "45005.0\""}) {
        EXPECT_EQ(read(text), "45005.0") << text;
    }
    EXPECT_EQ(read("30°"), "108000");
    EXPECT_EQ(read("12.5°"), "45000");
    EXPECT_EQ(read("12.5013°"), "45004.68");
    EXPECT_EQ(read("12° 30.5'"), "45030");
    EXPECT_EQ(read("12° 05\""), "43205");
    EXPECT_EQ(read("-0° 00' 03.2\""), "-3.2");
    EXPECT_EQ(read("\u22120° 00' 03.20\""), "-3.20");
    EXPECT_EQ(read("-0° 00' 00.0\""), "0.0");
    EXPECT_EQ(read("360°"), "1296000");
    EXPECT_EQ(read("0°"), "0");
    EXPECT_EQ(read("12° 30.5'", k_minutes), "750.5");
    EXPECT_EQ(read("-0.5°", k_minutes), "-30");
}

TEST(AngleText, RefusesWhatIsNoAngle) {
    for (const char* text : {"",
                             " ",
                             "°",
                             "30",
                             "12.5",
                             "12° 30",
                             "12° 60'",
                             "12° 30' 60\"",
                             "12° 61' 05\"",
                             "30' 12°",
                             "12° 12°",
                             "12.5° 30'",
                             "12° 30.5' 05\"",
                             "12° -30'",
                             "12° 30' 05.\"",
                             "12° .5'",
                             "1.2.3°",
                             "12°x",
                             "x12°",
                             "1e3\"",
                             "12° 30' 05.0\" W",
                             "--1°",
                             "1234567890123456789\"",
                             "999999999999999999°",
                             "N 12°"}) {
        EXPECT_EQ(read(text), "none") << text;
    }
    EXPECT_EQ(read("12° 30' 05\"", k_minutes), "none");
}

TEST(AngleText, SeesSigns) {
    for (const char* text : {"12°", "5'", "5\"", "5″", "5′", "5”", "5’", "5º"}) {
        EXPECT_TRUE(has_angle_sign(text)) << text;
    }
    for (const char* text : {"", "12.5", "-3e-6", "12 deg"}) {
        EXPECT_FALSE(has_angle_sign(text)) << text;
    }
}

TEST(AngleText, PrintsTheNumberInItsParts) {
    EXPECT_EQ(angle_in_parts("45005.0", k_seconds), "12°\u00A030′\u00A005.0″");
    // A number that was rounded to 60.0 is the next minute, and 3600.0 the next degree.
    EXPECT_EQ(parts("60.0"), "0° 01′ 00.0″");
    EXPECT_EQ(parts("3600.0"), "1° 00′ 00.0″");
    EXPECT_EQ(parts("59.9"), "0° 00′ 59.9″");
    EXPECT_EQ(parts("-3.2"), "-0° 00′ 03.2″");
    EXPECT_EQ(parts("-45005"), "-12° 30′ 05″");
    EXPECT_EQ(parts("0"), "0° 00′ 00″");
    EXPECT_EQ(parts("1296000.0"), "360° 00′ 00.0″");
    EXPECT_EQ(parts("750.5", k_minutes), "12° 30.5′");
    for (const char* text : {"0E+1", "4.50E+4", "2.3E+5", "", "-", "words", "1.5E-20", "1.", ".5", "1 000",
                             "9999999999999999999", "1E+100", "1E+"}) {
        EXPECT_EQ(angle_in_parts(text, k_seconds), text);
    }
}

/// The number of units of the last decimal, exactly.
struct Written {
    std::string text;
    std::int64_t units = 0;
    int decimals = 0;
};

std::string decimal_text(std::int64_t units, int decimals) {
    std::string digits = std::to_string(units < 0 ? -units : units);
    const auto behind = static_cast<std::size_t>(decimals);
    digits = digits.size() <= behind ? std::string(behind + 1 - digits.size(), '0') + digits : digits;
    return (units < 0 ? "-" : "") + digits.substr(0, digits.size() - behind) +
           (decimals > 0 ? "." + digits.substr(digits.size() - behind) : "");
}

TEST(AngleText, HoldsEveryDigitOfGeneratedAngles) {
    std::mt19937_64 random(20261130);
    const auto below = [&](std::uint64_t limit) { return static_cast<std::int64_t>(random() % limit); };
    for (int i = 0; i < 3000; ++i) {
        const bool seconds = below(3) > 0;
        const int decimals = static_cast<int>(below(5));
        std::int64_t scale = 1;
        for (int d = 0; d < decimals; ++d) {
            scale *= 10;
        }
        // Near the ends of minutes and degrees as often as anywhere else.
        const std::int64_t last =
            below(2) == 0 ? below(60 * static_cast<std::uint64_t>(scale)) : 60 * scale - 1 - below(2);
        const std::int64_t minutes = seconds ? (below(2) == 0 ? below(60) : 59) : 0;
        const std::int64_t degrees = below(400);
        const std::int64_t magnitude =
            seconds ? (degrees * 60 + minutes) * 60 * scale + last : degrees * 60 * scale + last;
        const std::int64_t units = below(2) == 0 ? magnitude : -magnitude;
        const AnglePart part = seconds ? k_seconds : k_minutes;
        const std::string decimal = decimal_text(units, decimals);
        const std::string written = parts(decimal, part);
        // Written by hand from the parts, which no rounding has touched.
        const auto two = [](std::int64_t n) { return (n < 10 ? "0" : "") + std::to_string(n); };
        const std::string fraction = decimal_text(last, decimals);
        const std::string padded = (last < 10 * scale ? "0" : "") + fraction;
        const std::string expected = (units < 0 ? "-" : "") + std::to_string(degrees) + "° " +
                                     (seconds ? two(minutes) + "′ " + padded + "″" : padded + "′");
        ASSERT_EQ(written, expected) << decimal;
        ASSERT_EQ(read(written, part), decimal) << written;
        ASSERT_EQ(read(angle_in_parts(decimal, part), part), decimal);
    }
}

}  // namespace
}  // namespace gumcert::text
