#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/budget_job_target.h"

/// The files of any budget job are refused with reasons, or are a job whose numbers are finite and whose names fit.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::jobs::fuzz::budget_job(bytes);
    return 0;
}
