// Drawings of unknown origin: an answer without crash, and whoever reads an accepted one finds nothing that acts in it.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/svg_image_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gumcert::jobs::fuzz::svg_image({reinterpret_cast<const char*>(data), size});
    return 0;
}
