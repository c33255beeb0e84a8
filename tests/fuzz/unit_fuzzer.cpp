#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tests/fuzz/unit_target.h"

/// Any text is refused by both readers, or means the same to both: size, dimension, kind and zero of a scale.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const gumcert::test::UnitOracle oracle;
    const std::string text = gumcert::test::unit_text(std::string_view(reinterpret_cast<const char*>(data), size));
    if (const std::string difference = gumcert::test::difference_of_readers(oracle, text); !difference.empty()) {
        std::fprintf(stderr, "\"%s\": %s\n", text.c_str(), difference.c_str());
        std::abort();
    }
    return 0;
}
