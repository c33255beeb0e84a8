#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/job_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::jobs::fuzz::csv_table(bytes);
    return 0;
}
