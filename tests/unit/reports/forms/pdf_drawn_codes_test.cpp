#include "reports/forms/pdf_drawn_codes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {
namespace {

/// "font:codes font:codes", codes as they are.
std::string drawn(std::string_view content) {
    std::string all;
    for (const DrawnCodes& one : drawn_codes(content)) {
        all += (all.empty() ? "" : " ") + one.font + ":" + one.codes;
    }
    return all;
}

TEST(DrawnCodes, AreThoseOfEveryOperatorThatDraws) {
    EXPECT_EQ(drawn("BT /f0 12 Tf 1 0 0 -1 0 0 Tm (a) Tj [(b) -10 <63> 7(d)]TJ /f1 8.5 Tf (e) ' 1 2 (f) \" ET"),
              "f0:a f0:bcd f1:e f1:f");
    EXPECT_EQ(drawn("(x) Tj"), ":x");
    EXPECT_EQ(drawn(""), "");
}

TEST(DrawnCodes, StringsOfOtherOperatorsAreNotDrawn) {
    EXPECT_EQ(drawn("/Span << /MCID 3 /Alt (words) /E <616263> >> BDC /f0 9 Tf (a) Tj EMC"), "f0:a");
    EXPECT_EQ(drawn("/Span << /Alt (a > \\(words\\) Tj (b) Tj) >> BDC /f0 9 Tf (a) Tj EMC"), "f0:a");
    EXPECT_EQ(drawn("% (words) Tj\n/f0 9 Tf (a) Tj"), "f0:a");
    EXPECT_EQ(drawn("BI /W 1 /H 1 ID (\\(( EI /f0 9 Tf (a) Tj"), "f0:a");
}

TEST(DrawnCodes, TextsBesideThemAreTold) {
    const auto beside = [](std::string_view content) {
        std::string all;
        for (const TextBesideDrawn& one : texts_beside_drawn_codes(content)) {
            all += one.text + (one.replaces ? "!;" : ";");
        }
        return all;
    };
    EXPECT_EQ(beside("/Span << /MCID 3 /Alt (words) /E <616263> /Lang (de) >> BDC /f0 9 Tf (a) Tj EMC"), "words;abc;");
    EXPECT_EQ(beside("/Span <</ActualText(a(b))>>BDC (c) Tj EMC /Span << /Actual#54ext (d) >> DP"), "a(b)!;d!;");
    EXPECT_EQ(beside("/E 12 Tf (a) Tj /Alt BMC (b) Tj EMC /P << /MCID 0 >> BDC (c) Tj EMC"), "");
    EXPECT_EQ(beside("/ActualText"), "");
    EXPECT_EQ(beside("/ActualText (a"), "a!;");
}

TEST(DrawnCodes, ATextStandsInPlaceOfWhatItsMarkedContentDraws) {
    const auto in_place_of = [](std::string_view content) {
        std::string all;
        for (const TextBesideDrawn& one : texts_beside_drawn_codes(content)) {
            all += one.text + "=";
            for (const DrawnCodes& drawn : one.drawn) {
                all += drawn.font + ":" + drawn.codes + " ";
            }
            all += ";";
        }
        return all;
    };
    EXPECT_EQ(in_place_of("/f 9 Tf (x) Tj /Span <</ActualText (a)>> BDC (b) Tj [(c) 1 (d)] TJ EMC (y) Tj"),
              "a=f:b f:cd ;");
    EXPECT_EQ(in_place_of("/S <</ActualText (a)>> BDC (b) Tj /S <</ActualText (c)>> BDC (d) Tj EMC (e) Tj EMC"),
              "a=:b :d :e ;c=:d ;");
    EXPECT_EQ(in_place_of("/S <</ActualText (a)>> BDC /P BMC (b) Tj EMC (c) Tj EMC (d) Tj"), "a=:b :c ;");
    EXPECT_EQ(in_place_of("/S <</ActualText (a)>> BDC (b) Tj"), "a=:b ;");  // nor does a program that copies it stop
    EXPECT_EQ(in_place_of("/S <</ActualText (a)>> DP (b) Tj EMC EMC"), "a=;");
    EXPECT_EQ(in_place_of("EMC EMC /S <</ActualText (a) /E (b)>> BDC (c) Tj EMC"), "a=:c ;b=:c ;");
}

/// A thousand marked contents within each other would copy a thousand times what the innermost draws.
TEST(DrawnCodes, MarkedContentsWithinEachOtherStayBounded) {
    std::string content;
    for (int i = 0; i < 3000; ++i) {
        content += "/S <</ActualText (a)>> BDC ";
    }
    for (int i = 0; i < 3000; ++i) {
        content += "(b) Tj ";
    }
    std::size_t kept = 0;
    const std::vector<TextBesideDrawn> all = texts_beside_drawn_codes(content);
    for (const TextBesideDrawn& one : all) {
        kept += one.drawn.size();
    }
    EXPECT_EQ(all.size(), 3000U);
    EXPECT_LE(kept, 1'000'000U);
}

TEST(DrawnCodes, AStringIsDecoded) {
    EXPECT_EQ(drawn("<6 16\n2 5> Tj"), ":abP");  // a digit that is missing is 0
    EXPECT_EQ(drawn("(a(b)c) Tj"), ":a(b)c");
    EXPECT_EQ(drawn("(\\(\\)\\\\\\n\\101\\1012\\x\\\nz) Tj"), ":()\\\nAA2xz");
    EXPECT_EQ(drawn("(\\0501\\)) Tj"), ":(1)");
}

/// Whatever is cut off, the reader ends, and what it has read before is a beginning of the whole.
TEST(DrawnCodes, ContentMayEndAnywhere) {
    const std::string content = "/f0 12 Tf [<0001> -10 (a\\)b(c))] TJ % end\n/f1 9 Tf BI ID x EI <61> Tj (\\7";
    const std::string whole = drawn(content);
    for (std::size_t length = 0; length <= content.size(); ++length) {
        const std::string part = drawn(std::string_view(content).substr(0, length));
        EXPECT_EQ(whole.substr(0, part.size()), part) << length;
    }
}

}  // namespace
}  // namespace gumcert::reports
