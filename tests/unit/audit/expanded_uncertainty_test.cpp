#include "audit/expanded_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/row_meaning.h"
#include "text/numbers.h"

namespace gumcert::audit {
namespace {

AuditedRow row_in(const std::string& unit) {
    AuditedRow row;
    row.unit = unit;
    return row;
}
std::optional<ExpandedInWords> words(const std::string& text, const std::string& unit = "bar") {
    return expanded_uncertainty_in(pieces_of(text, DecimalSign::each), row_in(unit));
}

TEST(ExpandedUncertainty, IsTheExpressionDirectlyBehindItsSign) {
    const std::vector<std::pair<std::string, double>> cases{
        {"U = 0.20 bar, k = 2", 0.20},
        {"U=0.20bar", 0.20},
        {"U95: 0,20 bar", 0.20},
        {"U(k = 2) = 0.20 bar", 0.20},
        {"U (0.20 bar, k = 2)", 0.20},
        {"U(100 bar) = 0.20 bar, k = 2", 0.20},
        {"U at 100 bar is 0.20 bar, k = 2", 0.20},
        {"U bei 100 bar: 20 kPa", 0.20},
        {"U = 20 kPa (range 0 bar to 200 bar), k = 2", 0.20},
        {"expanded uncertainty 0.20 bar at 100 bar, k = 2", 0.20},
        {"expanded uncertainty (k = 2) U = 0.20 bar", 0.20},
        {"erweiterte Messunsicherheit (k = 2): 0,20 bar", 0.20},
        {"U = 0.1 % FS, FS = 200 bar, k = 2, certificate R-7", 0.20},
        {"U = 0,1 % v.E. (Endwert 200 bar), k = 2", 0.20},
        {"expanded uncertainty 0.1 % FS (200 bar), k = 2", 0.20},
        {"U = 0.1 % of 200 bar, k = 2", 0.20},
        {"U = 0.1 % of span (200 bar), k = 2", 0.20},
        {"U = 0.1 % of range 0 bar to 200 bar, k = 2", 0.20},
        {"U = 0.1 % FS, k = 2, FS = 200 bar", 0.20},
        {"U = 0.2 % of reading at 100 bar, k = 2", 0.20},
        {"expanded uncertainty 0.2 % at 100 bar, k = 2", 0.20},
        {"U = 2000 ppm of 100 bar, k = 2", 0.20},
        {"U = 0.002 × 100 bar, k = 2", 0.20},
        {"U = 0.001·FS, FS = 200 bar, k = 2", 0.20},
        {"U = 0.05 bar + 0.1 % of 150 bar, k = 2", 0.20},
        {"U = 0.05 bar plus 15 kPa", 0.20},
        {"U = (0.05 + 0.15) bar", 0.20},
    };
    for (const auto& [text, expected] : cases) {
        const std::optional<ExpandedInWords> U = words(text);
        ASSERT_TRUE(U) << text;
        ASSERT_TRUE(U->value) << text;
        EXPECT_NEAR(*U->value, expected, 1e-12) << text;
    }
    const std::optional<ExpandedInWords> length = words("U = 0.12 µm + 0.5e-6 L, L = 400 mm, k = 2", "µm");
    ASSERT_TRUE(length && length->value);
    EXPECT_NEAR(*length->value, 0.32, 1e-12);
}

TEST(ExpandedUncertainty, IsLeftOpenWhereAPartHasNoNumber) {
    for (const char* text :
         {"U = 0.12 µm + 0.5e-6 L, k = 2", "U = 0.12 µm + 0.5·10^-6·L, k = 2", "U = (0.12 + 0.5 L/m) µm, k = 2",
          "U = 0.12 µm + 0.5·10⁻⁶·l; k = 2", "U = 0.12 µm + L/300", "U = 0.12 µm + 0.5 times L",
          "U = 0.12 µm + 0.5 10-6 L", "U = 0.12 µm + 0.5 µm/m, k = 2", "U = 0.12 µm plus 0.5 µm/m"}) {
        const std::optional<ExpandedInWords> U = words(text, "µm");
        ASSERT_TRUE(U) << text;
        EXPECT_FALSE(U->value) << text;
        ASSERT_TRUE(U->open.at_least) << text;
        EXPECT_NEAR(*U->open.at_least, 0.12, 1e-12) << text;
    }
    for (const char* text : {"U = 0.12 µm up to 100 mm and 0.32 µm up to 500 mm, k = 2",
                             "certificate: U = 0.12 µm (0 to 100 mm), U = 0.32 µm (100 mm to 500 mm), k = 2"}) {
        const std::optional<ExpandedInWords> U = words(text, "µm");
        ASSERT_TRUE(U) << text;
        EXPECT_FALSE(U->value) << text;
        EXPECT_EQ(U->open.may_be, (std::vector<double>{0.12, 0.32})) << text;
    }
    const std::optional<ExpandedInWords> of_nothing = words("U = 0.2 %, k = 2");
    ASSERT_TRUE(of_nothing && of_nothing->open.part);
    EXPECT_FALSE(of_nothing->value);
    EXPECT_NEAR(*of_nothing->open.part, 0.002, 1e-15);
}

TEST(ExpandedUncertainty, IsNoneOfOtherWords) {
    for (const char* text :
         {"", "k = 2", "certificate R-7", "U = 20 °C", "U = R I", "U see certificate, resolution 0.1 bar",
          "resolution 0.1 bar", "U", "U =", "U = see certificate"}) {
        EXPECT_FALSE(words(text)) << text;
    }
}

/// The law: whatever U is a function of, and however it is stated, no number but that of U is taken.
/// The law: whatever number a certificate has, U is what is stated beside it, or nothing.
TEST(ExpandedUncertainty, IsNeverTheNumberOfACertificate) {
    for (const std::string name : {"certificate", "calibration certificate No.", "cert.", "Kalibrierschein",
                                   "Zertifikat Nr.", "certificate number", "report"}) {
        for (const std::string number : {"12", "4711", "2025"}) {
            for (const std::string opening :
                 {"expanded uncertainty of ", "Expanded U from ", "erweiterte Unsicherheit aus "}) {
                for (const std::string behind : {"", " (k = 2)", " k=2", ", k = 2"}) {
                    const std::string text = opening + name + " " + number + behind;
                    const std::optional<ExpandedInWords> none = words(text);
                    EXPECT_TRUE(!none || none->value != std::stod(number)) << text;
                    const std::optional<ExpandedInWords> U = words(text + ": 0.20 bar");
                    EXPECT_TRUE(!U || U->value == 0.20) << text;
                }
            }
        }
    }
    EXPECT_EQ(words("expanded uncertainty of certificate 4711: 0.20 bar, k = 2")->value, 0.20);
    EXPECT_EQ(words("expanded uncertainty of certificate 3 bar")->value, 3.0) << "its unit says what it is";
    EXPECT_EQ(words("expanded uncertainty from certificate 0.20")->value, 0.20);
}

TEST(ExpandedUncertainty, IsNeverAnArgument) {
    const auto number = [](double value) { return text::shortest_plain(value); };
    for (const double U : {0.004, 0.2, 2.5}) {
        for (const double base : {10.0, 200.0, 1500.0}) {
            const std::string part = number(std::round(1e9 * 100.0 * U / base) / 1e9), at = number(base) + " bar";
            for (const std::string& text :
                 {"U = " + part + " % of " + at, "U = " + part + " % FS, FS = " + at,
                  "U = " + part + " % FS (" + at + ")", "U = " + part + " % of reading at " + at,
                  "U(" + at + ") = " + number(U) + " bar", "U at " + at + " is " + number(U) + " bar",
                  "U = " + number(U) + " bar at " + at, "U = " + number(U) + " bar (" + at + ")",
                  "U = " + number(U / base) + " × " + at, "U = " + number(U) + " bar, range 0 bar to " + at,
                  "expanded uncertainty " + part + " % at " + at}) {
                for (const char* const behind : {"", ", k = 2", "; p = 50 bar", ", k = 2, 95 %, certificate R-7"}) {
                    const std::optional<ExpandedInWords> found = words("certificate 12: " + text + behind);
                    ASSERT_TRUE(found && found->value) << text << behind;
                    EXPECT_NEAR(*found->value, U, 2e-6 * U) << text << behind;
                }
            }
        }
    }
}

AuditedRow completed(const std::string& comment, double stated, double divisor, const std::string& unit,
                     double estimate = 0.0) {
    AuditedRow row;
    row.comment = comment;
    row.unit = unit;
    row.stated = exact_number(stated, "");
    row.divisor = exact_number(divisor, "");
    row.estimate = exact_number(estimate, "");
    read_comment(row);
    complete_row(row);
    return row;
}

TEST(ExpandedUncertainty, IsThatOfTheColumnWhereWordsAllowIt) {
    for (const double divisor : {1.0, 2.0, 3.0}) {
        for (const char* text : {"U = 0.12 µm + 0.5e-6 L, k = 2", "U = 0.12 µm + 0.5 µm/m, k = 2",
                                 "U = 0.12 µm up to 100 mm and 0.32 µm up to 500 mm, k = 2"}) {
            const AuditedRow row = completed(text, 0.32, divisor, "µm");
            EXPECT_EQ(row.origin, Origin::certificate) << text;
            EXPECT_EQ(row.origin_value, 0.32) << text << ", divided by " << divisor;
            EXPECT_EQ(row.certificate_k, 2.0) << text;
        }
    }
    EXPECT_EQ(completed("U = 0.2 % of reading, k = 2", 0.2, 1.0, "bar", 100.0).origin_value, 0.2);
    EXPECT_EQ(completed("U = 0.2 %, k = 2", 0.1, 1.0, "bar", 100.0).origin_value, 0.2) << "u is U/k already";
    EXPECT_EQ(completed("U = 1.2 %, k = 2", 1.2, 2.0, "cd", 285.4).origin_value, 1.2) << "a row in percent";
}

TEST(ExpandedUncertainty, StaysOpenWhereNothingGivesIt) {
    EXPECT_FALSE(completed("U = 0.2 %, k = 2", 0.2, 1.0, "bar").origin_value);
    EXPECT_FALSE(completed("U = 0.12 µm + 0.5e-6 L, k = 2", 0.05, 2.0, "µm").origin_value);
    EXPECT_FALSE(completed("certificate R-7: U = 0.2 %, p = 100 bar", 5.0, 2.0, "bar").origin_value)
        << "100 bar is no uncertainty";
}

}  // namespace
}  // namespace gumcert::audit
