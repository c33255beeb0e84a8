#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/stated_number.h"

namespace gumcert::audit {

/// One word, number or sign of a comment.
struct Piece {
    enum class Kind { word, number, sign };
    Kind kind = Kind::sign;
    std::string word;  ///< small letters without accents
    std::string raw;   ///< a word or sign as it stands
    double value = 0.0;
    std::string unit;    ///< of a number: what stands behind it, if it may be a unit
    std::string behind;  ///< of a number: the beginning of what follows, for units of several words
    bool percent = false, plus_minus = false;
    bool plus = false;  ///< of a number: a plus sign stands in front of it, and no minus sign

    [[nodiscard]] bool is_number() const { return kind == Kind::number; }
    [[nodiscard]] bool is_sign(std::string_view sign) const { return kind == Kind::sign && raw == sign; }
    [[nodiscard]] bool begins(std::string_view beginning) const {
        return kind == Kind::word && word.starts_with(beginning);
    }
};
using Pieces = std::vector<Piece>;

/// The pieces of a text, of which 400 bytes are read; none of a text that is no UTF-8.
/// \param sign  the decimal sign of its numbers
[[nodiscard]] Pieces pieces_of(std::string_view all, DecimalSign sign);

/// A number of a comment in the unit of the row.
struct NumberOfRow {
    double value = 0.0;
    bool has_unit = false;  ///< stated behind it, and of the kind of the row
};
/// Nothing where the number is of another kind, or is 0.
[[nodiscard]] std::optional<NumberOfRow> in_unit_of_row(const Piece& piece, const AuditedRow& row);

/// Whether a number is one of a quantity: "mean of 3 °C" are no 3 readings; "mean of 3 in air", "of 3 days" and "of 5 turns" may be.
[[nodiscard]] bool has_unit(const Piece& number);

/// Words and signs that may stand between a keyword and its number.
[[nodiscard]] bool is_filler(const Piece& piece);
[[nodiscard]] bool ends_sentence(const Piece& piece);

/// Whether the number at a place of a text is what something is a function of, and no uncertainty: "at 100 bar",
/// "FS = 200 bar", "range 0 bar to 200 bar", "up to 500 mm".
[[nodiscard]] bool is_argument(const Pieces& pieces, std::size_t place);

}  // namespace gumcert::audit
