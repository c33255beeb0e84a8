#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "jobs/problem_list.h"

namespace gumcert::jobs {

/// Checks what holds for every text file: size, UTF-8 without NUL, and lines that end in LF or CRLF.
///
/// \param bytes  the file; a byte order mark of UTF-8 is accepted
/// \return the text without byte order mark; nothing when it was refused, with the problem in the list
[[nodiscard]] std::optional<std::string_view> check_text(std::string_view bytes, ProblemList& problems);

/// Why a name is not acceptable: empty, more than 256 bytes, spaces around it, control, bidirectional or hidden
/// characters; nothing when it is.
/// \param longest  [byte]
[[nodiscard]] std::optional<std::string> name_objection(std::string_view name, std::size_t longest = 256);

/// The known word nearest to a word by edit distance, when it is near enough to be meant.
[[nodiscard]] std::optional<std::string_view> nearest_word(std::string_view word,
                                                           std::span<const std::string_view> known);

/// What to write where a text stands in place of a number: of an angle in degrees, minutes and seconds its number of seconds.
[[nodiscard]] std::string advice_for_number(std::string_view text);

/// The numbers that a key or a column allows.
struct NumberRange {
    double low = -std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::max();
    bool low_open = false;   ///< `low` itself is not allowed
    bool high_open = false;  ///< `high` itself is not allowed
    std::string_view unit = {};
    std::string_view hint = {};  ///< what to do when a number is outside; a general advice when empty

    [[nodiscard]] bool contains(double value) const;
    [[nodiscard]] std::string with_unit(double value) const;
    [[nodiscard]] std::string rule() const;  ///< e.g. "must be greater than 0 µm"
    [[nodiscard]] std::string action() const;
};

[[nodiscard]] constexpr NumberRange above_zero(std::string_view unit) {
    return {.low = 0.0, .low_open = true, .unit = unit};
}
[[nodiscard]] constexpr NumberRange not_negative(std::string_view unit) {
    return {.low = 0.0, .unit = unit};
}
[[nodiscard]] constexpr NumberRange between(double low, double high, std::string_view unit) {
    return {.low = low, .high = high, .unit = unit};
}

}  // namespace gumcert::jobs
