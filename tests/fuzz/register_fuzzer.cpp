#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/register_target.h"

/// Any file of the register is refused with reasons, or is a standard whose lines the library can use.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::jobs::fuzz::register_file(bytes);
    return 0;
}
