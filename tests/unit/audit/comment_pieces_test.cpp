#include "audit/comment_pieces.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gumcert::audit {
namespace {

/// Numbers as "#unit", words as they stand, signs as they are.
std::vector<std::string> read_pieces(const std::string& text) {
    std::vector<std::string> all;
    for (const Piece& piece : pieces_of(text, DecimalSign::each)) {
        all.push_back(piece.is_number() ? "#" + piece.unit : piece.raw);
    }
    return all;
}

TEST(PiecesOf, ATextAreWordsNumbersAndSigns) {
    using Texts = std::vector<std::string>;
    EXPECT_EQ(read_pieces("U = 0.36 µm, k = 2"), (Texts{"U", "=", "#µm", "µm", ",", "k", "=", "#"}));
    EXPECT_EQ(read_pieces("MPE ±0.4"), (Texts{"MPE", "#"}));
    EXPECT_EQ(read_pieces("12.3.4"), (Texts{}));
    EXPECT_EQ(read_pieces(""), (Texts{}));
    EXPECT_EQ(read_pieces("\xFF"), (Texts{}));
}

TEST(PiecesOf, ASumHaveItsPlusSigns) {
    for (const char* text : {"0.12 µm + 0.5", "0.12 µm +0.5"}) {
        const Pieces pieces = pieces_of(text, DecimalSign::each);
        ASSERT_FALSE(pieces.empty());
        EXPECT_FALSE(pieces.front().plus) << text;
        EXPECT_TRUE(pieces.back().is_number()) << text;
        EXPECT_TRUE(pieces.back().plus) << text;
        EXPECT_DOUBLE_EQ(pieces.back().value, 0.5) << text;
    }
    for (const char* const both : {"+/- 0.5", "+-0.5", "+- 0.5"}) {
        EXPECT_FALSE(pieces_of(both, DecimalSign::each).back().plus) << both;
        EXPECT_TRUE(pieces_of(both, DecimalSign::each).back().plus_minus) << both;
    }
}

TEST(InUnitOfRow, ConvertsAndLeavesOtherKinds) {
    AuditedRow row;
    row.unit = "um";
    const auto number = [&row](const std::string& text) {
        return in_unit_of_row(pieces_of(text, DecimalSign::each).front(), row);
    };
    EXPECT_DOUBLE_EQ(number("0.36 nm")->value, 0.36e-3);
    EXPECT_TRUE(number("0.36 nm")->has_unit);
    EXPECT_FALSE(number("0.36")->has_unit);
    EXPECT_FALSE(number("20 K"));
    EXPECT_FALSE(number("0 um"));
    EXPECT_FALSE(number("5 %"));
}

TEST(IsArgument, OfWhatSomethingIsAFunctionOf) {
    for (const char* text :
         {"at 100 bar", "FS = 200 bar", "range 0 bar to 200 bar", "up to 500 mm", "bei 20 °C", "L: 400 mm"}) {
        const Pieces pieces = pieces_of(text, DecimalSign::each);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            EXPECT_TRUE(!pieces[i].is_number() || is_argument(pieces, i)) << text;
        }
    }
    for (const char* text : {"U = 100 bar", "100 bar", "MPE 0.4", "certificate: 0.36"}) {
        const Pieces pieces = pieces_of(text, DecimalSign::each);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            EXPECT_FALSE(pieces[i].is_number() && is_argument(pieces, i)) << text;
        }
    }
    const Pieces filled = pieces_of("= of ; x", DecimalSign::each);
    EXPECT_TRUE(is_filler(filled[0]) && is_filler(filled[1]) && ends_sentence(filled[2]));
    EXPECT_FALSE(is_filler(filled[3]));
}

TEST(HasUnit, KnowsUnitsFromWords) {
    for (const char* const text : {"3 °C", "20 mV", "5 min", "20 degrees", "20 Grad"}) {
        EXPECT_TRUE(has_unit(pieces_of(text, DecimalSign::each).at(0))) << text;
    }
    for (const char* const text : {"3", "3 readings", "3 in air", "5 days", "5 turns", "3 weeks", "10, ν = 9"}) {
        EXPECT_FALSE(has_unit(pieces_of(text, DecimalSign::each).at(0))) << text;
    }
}

}  // namespace
}  // namespace gumcert::audit
