#pragma once

#include <string>
#include <string_view>

namespace gumcert::jobs {

/// What the bytes of an image are. Of PNG and JPEG only the frame is looked at: the signature, the chain of chunks or
/// segments to the end, and a width and height from 1 to 10000 pixels; of SVG all (jobs/svg_image.h).
struct ImageFormat {
    std::string media_type;  ///< "image/png", "image/jpeg", "image/svg+xml"; "" where it is none: see `objection`
    std::string objection;   ///< what is wrong, for a message
};
[[nodiscard]] ImageFormat image_format(std::string_view bytes);

}  // namespace gumcert::jobs
