#include <cstddef>
#include <cstdint>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "self_test/case_formula.h"

/// Any text is refused with a diagnostic or has a value; paths lead to numbers, texts and rows in turn.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using gumcert::self_test::CaseValue;
    const std::string formula(data, data + size);
    try {
        (void)gumcert::self_test::value_of_formula(formula, [](const std::string& path) {
            switch (path.size() % 4) {
                case 0:
                    return CaseValue(0.5);
                case 1:
                    return CaseValue(path);
                case 2:
                    return CaseValue(std::vector<double>(path.size(), -2.0));
                default:
                    return CaseValue(true);
            }
        });
    } catch (const gumcert::gum::InputError&) {
    }
    return 0;
}
