#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "text/place.h"

namespace gumcert::json {

/// What can be wrong with a text that should be JSON. Those of the second group let reading go on.
enum class Fault {
    empty,
    syntax,
    trailing_text,
    comment,
    not_utf8,
    nul_character,
    depth,
    string_too_long,
    too_many_values,

    duplicate_key,
    number_range,
    inexact_integer,
    not_finite
};

/// One fault, in words for the author of the text. The caller chooses the code of the message, and may say it otherwise
/// for a text of another kind.
struct ParsingProblem {
    Fault fault = Fault::syntax;
    text::Place place;       ///< of the first character that is wrong
    std::size_t offset = 0;  ///< the same, [byte], after a byte order mark
    std::string pointer;     ///< of the value that is read there
    std::string what;
    std::string rule;
    std::string action;
};

/// What a text may hold beyond JSON (RFC 8259), and how much. nlohmann-json copies and destroys recursively, so the
/// depth is limited while the text is read.
struct ParserOptions {
    std::size_t depth = 64;                            ///< objects and arrays inside each other
    std::size_t string_bytes = std::size_t{1} << 20U;  ///< one string or key
    std::size_t values = 2'000'000;                    ///< all values together
    bool comments = false;                             ///< from // to the end of the line
    bool byte_order_mark = false;                      ///< of UTF-8, before everything else
    /// Whole numbers that double precision would change are kept where 64 bits hold them; else they are a fault.
    bool long_integers = false;
};

/// Where a value begins.
struct ValuePlace : text::Place {
    std::size_t offset = 0;  ///< [byte] in the text

    friend bool operator==(const ValuePlace&, const ValuePlace&) = default;
};

/// JSON pointer (RFC 6901) → first character of the value.
using Places = std::unordered_map<std::string, ValuePlace>;

/// Reads a text strictly as JSON: UTF-8 only, no duplicate keys, no NaN, no numbers that double precision cannot hold,
/// no integer that it would change, no NUL.
///
/// \param report  is called for every fault, in the order of the text
/// \param places  when there is one, receives where the values stand; not those below very long keys
/// \return the value; nothing when the text cannot be read to its end. With faults that let reading go on it is returned
///         all the same: of two equal keys the first is kept, and a number that was refused has the nlohmann type
///         `discarded`.
/// Example: examples/api/records.cpp
[[nodiscard]] std::optional<nlohmann::json> parse(std::string_view text, const ParserOptions& options,
                                                  const std::function<void(ParsingProblem)>& report,
                                                  Places* places = nullptr);

/// The value of a text without any fault; nothing for every other.
[[nodiscard]] std::optional<nlohmann::json> parse_faultless(std::string_view text, const ParserOptions& options);

}  // namespace gumcert::json
