#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/record_target.h"

/// Any text is refused with diagnostics or is a record.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    (void)gumcert::reports::fuzz::record(text);
    return 0;
}
