#pragma once

#include <string>
#include <string_view>

namespace gumcert::jobs {

/// What the bytes of an image are. Only its frame is looked at: the signature, the chain of chunks or segments to the
/// end, and a width and height from 1 to 10000 pixels.
struct ImageFormat {
    std::string media_type;  ///< "image/png", "image/jpeg"; "" where it is neither: see `objection`
    std::string objection;   ///< what is wrong, for a message
};
[[nodiscard]] ImageFormat image_format(std::string_view bytes);

}  // namespace gumcert::jobs
