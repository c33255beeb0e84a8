#include "reports/agreement/numbers_as_printed.h"

#include <gtest/gtest.h>

#include "reports/forms/pdf_page_texts.h"
#include "text/utf8.h"

namespace gumcert::reports {
namespace {

// Law: a number is read the same as the record has it, and as documents set it in each language.
TEST(NumberAsPrinteds, AreThoseOfTheRecord) {
    for (const std::string digits : {"0", "7", "49", "5000083"}) {
        for (std::size_t decimals = 0; decimals < digits.size(); ++decimals) {
            for (const int exponent : {0, -3, 12, -120}) {
                for (const bool negative : {false, true}) {
                    const std::size_t whole = digits.size() - decimals;
                    const auto mantissa = [&](const char* sign) {
                        return digits.substr(0, whole) + (decimals > 0 ? sign + digits.substr(whole) : "");
                    };
                    std::string raised;
                    for (const char c : std::to_string(exponent)) {
                        static const std::string k_raised[] = {"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                                               "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
                        raised += c == '-' ? "\u207B" : k_raised[static_cast<std::size_t>(c - '0')];
                    }
                    const std::string record =
                        (negative ? "-" : "") + mantissa(".") + (exponent != 0 ? "E" + std::to_string(exponent) : "");
                    const std::optional<NumberAsPrinted> expected = only_number_as_printed(record);
                    ASSERT_TRUE(expected) << record;
                    EXPECT_EQ(expected->digits, digits);
                    EXPECT_EQ(expected->decimals, decimals);
                    EXPECT_EQ(expected->exponent, exponent);
                    EXPECT_EQ(expected->negative, negative);
                    for (const char* const sign : {".", ","}) {
                        for (const char* const minus : {"-", "\u2212", "\u2212\u00A0"}) {
                            const std::string page = "l = " + std::string(negative ? minus : "") + mantissa(sign) +
                                                     (exponent != 0 ? "\u00A0\u00D7\u00A010" + raised : std::string()) +
                                                     " nm; a" + ", 1";
                            const std::vector<NumberAsPrinted> numbers = numbers_as_printed(page);
                            ASSERT_FALSE(numbers.empty());
                            EXPECT_TRUE(numbers.front().is(*expected)) << page;
                            EXPECT_EQ(numbers.front().first_digit, 0U);
                            const std::size_t begin = page.find(digits.front());
                            EXPECT_TRUE(is_printed_at(page, begin, *expected)) << page;
                            // In any pieces, as a PDF draws it.
                            for (std::size_t cut = begin + 1; cut < page.find(" nm"); ++cut) {
                                if (!text::is_continuation(page[cut])) {
                                    std::string pieces = page;
                                    pieces.insert(cut, 1, k_end_of_drawn_text);
                                    EXPECT_TRUE(is_printed_at(pieces, begin, *expected)) << page << cut;
                                }
                            }
                            NumberAsPrinted other = *expected;
                            other.negative = !other.negative;
                            EXPECT_FALSE(is_printed_at(page, begin, other)) << page;
                            other = *expected;
                            ++other.exponent;
                            EXPECT_FALSE(is_printed_at(page, begin, other)) << page;
                            other = *expected;
                            other.decimals += other.decimals + 1 < digits.size() ? 1U : 0U;
                            EXPECT_EQ(is_printed_at(page, begin, other), other.is(*expected)) << page;
                            EXPECT_EQ(numbers.back().digits, "1");
                            EXPECT_EQ(numbers.back().first_digit, digits.size() + (exponent != 0 ? 2U : 0U));
                        }
                    }
                }
            }
        }
    }
}

TEST(NumberAsPrinteds, AreNotWhatLooksLikeThem) {
    for (const char* const none : {"", "a", "17.2.1", "1,2,3", "1 2"}) {
        EXPECT_FALSE(only_number_as_printed(none)) << none;
    }
    const auto negative = [](const char* text) { return numbers_as_printed(text).back().negative; };
    EXPECT_FALSE(negative("EX-2026")) << "a hyphen";
    EXPECT_FALSE(negative("1-2"));
    EXPECT_FALSE(negative("\u2013 2")) << "what is absent";
    EXPECT_FALSE(negative("- 2"));
    EXPECT_TRUE(negative("(-2"));
    EXPECT_TRUE(negative("\u2212\n2"));
    EXPECT_EQ(numbers_as_printed("3 \u00B7 10 m").front().exponent, 0);
    EXPECT_EQ(numbers_as_printed("3 \u00D7 4").front().exponent, 0);
    EXPECT_EQ(numbers_as_printed("3 \u00B7 10\n\u22125").front().exponent, -5) << "a raised exponent as it is drawn";
    EXPECT_EQ(only_number_as_printed(">9999")->digits, "9999");
    const std::string joint(1, k_end_of_drawn_text);
    for (const std::string& page :
         {std::string("14.9"), std::string("4.95"), std::string("\u22124.9"), std::string("4.9.1"),
          std::string("4,9 \u00D7 10\u00B3"), std::string("0.4.9"), "2." + joint + "4.9"}) {
        EXPECT_FALSE(is_printed_at(page, page.find('4'), *only_number_as_printed("4.9"))) << page;
    }
    EXPECT_TRUE(begins_a_number("at 4\u00B0", 3, false));
    EXPECT_TRUE(begins_a_number("\u2212 4\u00B0", 4, true));
    EXPECT_TRUE(begins_a_number("-4\u00B0", 1, true));
    for (const char* const other : {"14\u00B0", "2.4\u00B0", "-4\u00B0", "\u22124\u00B0"}) {
        EXPECT_FALSE(begins_a_number(other, std::string(other).find('4'), false)) << other;
    }
    EXPECT_FALSE(is_printed_at("49" + joint + ".5", 0, *only_number_as_printed("49")));
    EXPECT_TRUE(is_printed_at("20" + joint + "4.9" + joint + "1.4", 3, *only_number_as_printed("4.9")));
}

}  // namespace
}  // namespace gumcert::reports
