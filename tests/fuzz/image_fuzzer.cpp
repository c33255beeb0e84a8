#include <cstddef>
#include <cstdint>
#include <string_view>

#include "jobs/image_format.h"
#include "tests/fuzz/demand.h"

/// Any bytes are an image of a kind that documents can show, or there is an objection to them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    const jobs::ImageFormat format = jobs::image_format({reinterpret_cast<const char*>(data), size});
    fuzz::demand(format.media_type.empty() != format.objection.empty(), "neither an image nor an objection, or both");
    fuzz::demand(format.media_type.empty() || format.media_type == "image/png" || format.media_type == "image/jpeg" ||
                     format.media_type == "image/svg+xml",
                 "a kind of image");
    return 0;
}
