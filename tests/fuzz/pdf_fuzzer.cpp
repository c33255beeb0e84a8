#include "gum/quantity/diagnostic.h"
#include "signing/verify.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

/// Any bytes, PDF or XML, are refused with diagnostics or looked at; without a trusted certificate nothing is ever
/// valid.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    const std::string bytes(data, data + size);
    constexpr std::int64_t k_now = 1774958400;
    try {
        if (signing::verify_signatures(bytes, "fuzz", {}, k_now).valid) {
            std::abort();
        }
    } catch (const gum::InputError&) {
        return 0;
    }
    return 0;
}
