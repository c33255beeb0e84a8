#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gumcert::text {

/// A place in a text: line and column in characters, both from 1.
struct Place {
    std::size_t line = 1;
    std::size_t column = 1;

    friend bool operator==(const Place&, const Place&) = default;
};

/// `line 3, column 26`.
[[nodiscard]] std::string line_and_column(Place place);
/// `file:line:column`, with nothing hidden in the name of the file.
[[nodiscard]] std::string where_in_text(std::string_view file, Place place);

/// Walks through a text that is UTF-8 and tells the places of offsets, in one pass when they ascend.
class PlaceFinder {
public:
    explicit PlaceFinder(std::string_view text) : text_(text) {}
    [[nodiscard]] Place at(std::size_t offset);

private:
    std::string_view text_;
    std::size_t offset_ = 0;
    Place place_;
};

}  // namespace gumcert::text
