#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/workbook_targets.h"

/// Any bytes, or the parts of a workbook, are refused, or are sheets whose formulas have one value or one reason each.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    (void)gumcert::test::read_any_xlsx(bytes);
    return 0;
}
