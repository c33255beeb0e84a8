#include <cstddef>
#include <cstdint>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "self_test/reference_case.h"

/// Any text is refused with a diagnostic or is a case, whose values have digits and half units.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        for (const auto& value :
             gumcert::self_test::reference_case_from_json(std::string(data, data + size), "case").expected) {
            (void)value.digits();
            (void)value.half_unit();
            (void)value.name();
        }
    } catch (const gumcert::gum::InputError&) {
    }
    return 0;
}
