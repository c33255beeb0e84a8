#include "jobs/input_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "jobs/file_source.h"

namespace gumcert::jobs {
namespace {

using namespace std::string_literals;
using testing::HasSubstr;

/// The one message on a text; nothing where it is taken.
std::vector<gum::Diagnostic> told_of(const std::string& bytes) {
    ProblemList problems("p.csv");
    const bool taken = check_text(bytes, problems).has_value();
    EXPECT_EQ(taken, problems.refusals() == 0);
    return problems.refused();
}

TEST(InputText, IsUtf8WithLinesOfUnixOrWindows) {
    for (const std::string& text :
         {""s, "x"s, "a,b\n1,2\n"s, "a,b\r\n1,2\r\n"s, "\u00B5m \u8F49\u53F0 \U0001F600\n"s}) {
        EXPECT_TRUE(told_of(text).empty()) << text;
        ProblemList problems("p.csv");
        EXPECT_EQ(check_text("\xEF\xBB\xBF" + text, problems), text) << "without the byte order mark";
    }
}

TEST(InputText, TellsWhatItIsAndWhere) {
    const std::vector<std::tuple<std::string, std::string, std::string>> wrong{
        {"a\nb\xB5m\n", "GC-INPUT-0002", "p.csv:2:2"},
        {"\xC3", "GC-INPUT-0002", "p.csv:1:1"},
        {"\xED\xA0\x80", "GC-INPUT-0002", "p.csv:1:1"},
        {"\xFF\xFE"
         "a\0"s,
         "GC-INPUT-0003", "p.csv:1:1"},
        {"a\0b\0"s, "GC-INPUT-0003", "p.csv:1:1"},
        {"\0a\0b"s, "GC-INPUT-0003", "p.csv:1:1"},
        {"ab\n\0"s, "GC-INPUT-0004", "p.csv:2:1"},
        {"a\rb", "GC-INPUT-0005", "p.csv:1:2"},
        {"a\n\r", "GC-INPUT-0005", "p.csv:2:1"}};
    for (const auto& [bytes, code, where] : wrong) {
        const std::vector<gum::Diagnostic> told = told_of(bytes);
        ASSERT_EQ(told.size(), 1U) << code;
        EXPECT_EQ(told[0].code, code);
        EXPECT_EQ(told[0].where, where);
    }
    EXPECT_THAT(told_of("\xEF\xBB\xBF"
                        "ab\xE4")[0]
                    .what,
                HasSubstr("0xE4 at byte offset 5"))
        << "of the file";
}

TEST(InputText, HasAtMost64Megabytes) {
    EXPECT_TRUE(told_of(std::string(k_file_limit, 'x')).empty());
    EXPECT_EQ(told_of(std::string(k_file_limit + 1, 'x')).front().code, "GC-INPUT-0001");
}

/// What a rule says holds for what it lets through, at its ends too.
TEST(InputText, AdvisesWhatANumberIs) {
    EXPECT_EQ(advice_for_number("5.0"), "write the number without quotes");
    EXPECT_THAT(advice_for_number("-0° 00' 02.50\""),
                testing::HasSubstr("signs of degrees, minutes or seconds: it is -2.5 in arcsec"));
    EXPECT_THAT(advice_for_number("12:30:05"), testing::HasSubstr("05.0\u2033"));
    EXPECT_THAT(advice_for_number("5' 3°"), testing::EndsWith("or seconds"));
}

TEST(NumberRanges, SayWhatTheyAllow) {
    const double next = std::nextafter(0.0, 1.0);
    const std::vector<std::tuple<NumberRange, std::string, double, double>> ranges{
        {above_zero("\u00B5m"), "must be greater than 0 \u00B5m", next, 0.0},
        {not_negative("K"), "must be at least 0 K", 0.0, -next},
        {between(0.1, 5.0, ""), "must be at least 0.1 and at most 5", 5.0, std::nextafter(5.0, 6.0)},
        {{.low = 0.0, .high = 1.0, .low_open = true, .high_open = true},
         "must be greater than 0 and less than 1",
         std::nextafter(1.0, 0.0),
         1.0},
        {{.high = 2.0, .unit = "s"}, "must be finite; must be at most 2 s", 2.0, std::nextafter(2.0, 3.0)},
        {{}, "must be finite", std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity()}};
    for (const auto& [range, rule, inside, outside] : ranges) {
        EXPECT_EQ(range.rule(), rule);
        EXPECT_TRUE(range.contains(inside)) << rule;
        EXPECT_FALSE(range.contains(outside)) << rule;
        EXPECT_FALSE(range.contains(std::nan(""))) << rule;
        EXPECT_FALSE(range.contains(-std::numeric_limits<double>::infinity())) << rule;
        EXPECT_EQ(range.action(), "correct the value, and check its unit");
    }
    EXPECT_EQ((NumberRange{.hint = "state it in mm"}.action()), "state it in mm");
}

}  // namespace
}  // namespace gumcert::jobs
