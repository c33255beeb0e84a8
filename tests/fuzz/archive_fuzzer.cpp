#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/archive_target.h"

/// Any text is refused with diagnostics, or is evidence of a certificate or a head that can be verified.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    (void)gumcert::archive::fuzz::evidence_or_head(text);
    return 0;
}
