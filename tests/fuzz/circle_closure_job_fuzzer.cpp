#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/circle_closure_job_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::jobs::fuzz::circle_closure_job(bytes);
    return 0;
}
