#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/job_targets.h"

/// Any text is refused with reasons, or is a table or a matrix whose numbers are finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::jobs::fuzz::csv_table(bytes);
    return 0;
}
