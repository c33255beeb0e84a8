#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "jobs/image_format.h"
#include "jobs/svg_image.h"
#include "tests/fuzz/json_target.h"

namespace gumcert::jobs::fuzz {

using gumcert::json::fuzz::demand;

/// A drawing without its comments and texts for people, which may say anything.
inline std::string without_words(std::string_view drawing) {
    std::string rest(drawing);
    for (const auto& [begin, end] :
         {std::pair<std::string_view, std::string_view>{"<!--", "-->"}, {"<title", "</title"}, {"<desc", "</desc"}}) {
        for (std::size_t at = rest.find(begin); at != std::string::npos; at = rest.find(begin, at)) {
            const std::size_t close = rest.find(end, at);
            rest.erase(at, close == std::string::npos ? std::string::npos : close + end.size() - at);
        }
    }
    return rest;
}

inline bool svg_image(std::string_view bytes) {
    const std::string objection = svg_objection(bytes);
    demand(objection == svg_objection(bytes), "two answers");
    if (!objection.empty()) {
        demand(objection.starts_with("an SVG drawing"), "words of a message");
        return false;
    }
    const std::string rest = without_words(bytes);
    for (const std::string_view mark : {"<script", "<image", "<foreignObject", "<use", "<!DOCTYPE", "<!ENTITY", "&#",
                                        "@import", "<text", "<animate"}) {
        demand(rest.find(mark) == std::string::npos, "something that acts");
    }
    if (looks_like_svg(bytes)) {
        demand(image_format(bytes).media_type == "image/svg+xml", "a picture");
    }
    return true;
}

}  // namespace gumcert::jobs::fuzz
