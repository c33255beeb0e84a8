#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/json_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::json::fuzz::json_text(bytes);
    return 0;
}
