#include "audit/tables/beside_number.h"

#include <string_view>

#include "audit/row_meaning.h"
#include "audit/words/coverage_words.h"
#include "audit/words/unit_words.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;

/// Whether a word beside a number may be a unit that this program does not know, as "HRC": no distribution, nothing that is said
/// of coverage, no sentence.
bool may_be_unit(const std::string& text) {
    constexpr std::size_t k_longest = 16;
    const Shape shape = shape_of(text);
    const bool begins_like_a_number =
        !text.empty() &&
        (std::string_view("<>=+.").find(text[0]) != std::string_view::npos || (text[0] >= '0' && text[0] <= '9') ||
         text.starts_with("≥") || text.starts_with("≤") || text.starts_with("±"));
    return text.size() <= k_longest && !begins_like_a_number && (shape == Shape::not_stated || shape == Shape::other) &&
           text.find('=') == std::string::npos && !coverage_in(text).says_any();
}

}  // namespace

std::string BesideNumber::unit(const Cell* number, bool by_head) const {
    std::string known, word, dash;
    for (std::size_t i = from_; i < row_.size(); ++i) {
        const std::string held = sheet_.words(*row_[i]);
        const std::uint32_t column = row_[i]->address.column;
        const bool is_directly_beside =
            number != nullptr && (column + 1 == number->address.column || number->address.column + 1 == column);
        if (held == "-" || held == "–") {  // of a quantity without dimension
            const bool is_unit = is_under(Column::unit, *row_[i]) || (is_directly_beside && !by_head);
            dash = is_unit && dash.empty() ? held : dash;
        }
        if (i == named_ || row_[i] == number || says_nothing(held)) {
            continue;
        }
        const bool is_number = sheet_.number_with_unit(*row_[i]).has_value();
        if (is_under(Column::unit, *row_[i]) && (is_number ? held == "1" : may_be_unit(held))) {
            return held;
        }
        if (is_number) {
            continue;
        }
        const bool is_beside = is_next(number, i);
        if (is_under_words(*row_[i]) && !(is_directly_beside && !by_head && known_unit(held))) {
            continue;
        }
        if (known.empty() && known_unit(held)) {
            known = held;
        }
        // "u_c | 0.187 | U | 0.37": what names the next number is no unit of the one before it.
        const bool is_name = i + 1 < row_.size() && row_[i + 1] != number && sheet_.number_with_unit(*row_[i + 1]) &&
                             named_statement(held);
        if (word.empty() && is_beside && !is_name && may_be_unit(held)) {
            word = held;
        }
    }
    known = known.empty() ? word : known;
    return known.empty() ? dash : known;
}

std::string BesideNumber::one(const Cell* number, bool by_head) const {
    for (std::size_t i = from_; i < row_.size() && !by_head; ++i) {
        if (sheet_.words(*row_[i]) != "1" || row_[i] == number) {
            continue;
        }
        const bool before = i + 1 < row_.size() && row_[i + 1] == number;
        const bool behind = i > 0 && row_[i - 1] == number && i + 1 == row_.size();
        if (before || behind) {
            return "1";
        }
    }
    return "";
}

bool BesideNumber::is_under(Column column, const Cell& cell) const {
    if (heads_ == nullptr) {
        return false;
    }
    const auto position = heads_->columns.find(column);
    return position != heads_->columns.end() && position->second == cell.address.column;
}

bool BesideNumber::is_under_words(const Cell& cell) const {
    return is_under(Column::distribution, cell) || is_under(Column::type, cell) || is_under(Column::source, cell) ||
           is_under(Column::comment, cell);
}

bool BesideNumber::is_next(const Cell* number, std::size_t i) const {
    const auto holds = [this](std::size_t at) { return !sheet_.words(*row_[at]).empty(); };
    std::size_t right = i + 1;
    while (right < row_.size() && !holds(right)) {
        ++right;
    }
    std::size_t left = i;
    while (left > from_ && !holds(left - 1)) {
        --left;
    }
    return (right < row_.size() && row_[right] == number) || (left > 0 && row_[left - 1] == number);
}

}  // namespace gumcert::audit
