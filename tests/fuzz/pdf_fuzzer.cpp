#include "gum/quantity/diagnostic.h"
#include "reports/forms/pdf_other_parts.h"
#include "signing/verify.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

/// Any bytes, PDF or XML, are refused with diagnostics or looked at; without a trusted certificate nothing is ever
/// valid. What a PDF has beside its pages is found, or it is damaged.
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
    try {
        (void)reports::other_parts_of_pdf(bytes);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        return 0;  // damaged
    }
    return 0;
}
