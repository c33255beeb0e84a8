#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/comparison_job_target.h"

/// The files of any comparison are refused with reasons, or are results of laboratories or methods that fit each other.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::jobs::fuzz::comparison_job(bytes);
    return 0;
}
