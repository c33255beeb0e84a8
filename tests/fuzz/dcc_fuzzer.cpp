#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "reports/dcc/dcc_document.h"
#include "reports/dcc/dcc_reader.h"

/// Any bytes are refused with diagnostics, or are a certificate that is read and held against the business rules.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    bool checked = true;
    try {
        (void)reports::check_dcc(bytes, "fuzz");
        (void)reports::check_dcc_structure(bytes, "fuzz");
    } catch (const gum::InputError&) {
        checked = false;
    }
    try {
        (void)reports::read_dcc(bytes, "fuzz");
    } catch (const gum::InputError&) {
        return 0;
    }
    if (!checked) {
        std::abort();  // what is read can be held against the rules
    }
    return 0;
}
