#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/workbook_targets.h"

/// Any formula is refused, or means the same after it was printed and copied, and has a value or a reason.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::test::read_any_formula(bytes);
    return 0;
}
