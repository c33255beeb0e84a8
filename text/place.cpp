#include "text/place.h"

#include <algorithm>

#include "text/utf8.h"
#include "text/visible_text.h"

namespace gumcert::text {

std::string line_and_column(Place place) {
    return "line " + std::to_string(place.line) + ", column " + std::to_string(place.column);
}

std::string where_in_text(std::string_view file, Place place) {
    return visible(file) + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

Place PlaceFinder::at(std::size_t offset) {
    if (offset < offset_) {
        offset_ = 0;
        place_ = {};
    }
    const std::size_t end = std::min(offset, text_.size());
    for (; offset_ < end; ++offset_) {
        if (text_[offset_] == '\n') {
            ++place_.line;
            place_.column = 1;
        } else if (!is_continuation(text_[offset_])) {
            ++place_.column;
        }
    }
    return place_;
}

}  // namespace gumcert::text
