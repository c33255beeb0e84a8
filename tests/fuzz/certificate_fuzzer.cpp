#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/certificate_target.h"

/// Any certificate data, waiver or profile is refused with reasons, or has what a certificate needs.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::jobs::fuzz::certificate_data(bytes);
    return 0;
}
