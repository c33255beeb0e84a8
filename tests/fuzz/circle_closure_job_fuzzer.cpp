#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/circle_closure_job_target.h"

/// The files of any circle closure are refused with reasons, or are a design that can be evaluated.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::jobs::fuzz::circle_closure_job(bytes);
    return 0;
}
