#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/json_target.h"

/// Any text is refused with a reason, or is JSON that another parser reads alike and that comes back unchanged.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::json::fuzz::json_text(bytes);
    return 0;
}
