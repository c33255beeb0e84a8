#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/job_targets.h"

/// The files of any job of a rotary table are refused with reasons, or are a measurement or a layout whose parts fit.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::jobs::fuzz::rotary_table_job(bytes);
    return 0;
}
