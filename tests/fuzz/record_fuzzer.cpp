#include "reports/record/evaluation_record.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

/// Any text is refused with diagnostics or is a record; a record that was accepted is written and read again unchanged.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    const std::string text(data, data + size);
    try {
        const reports::EvaluationRecord record = reports::record_from_json(text, "fuzz");
        const std::string written = reports::to_canonical_json(record);
        if (reports::to_canonical_json(reports::record_from_json(written, "written")) != written) {
            std::abort();
        }
    } catch (const gum::InputError&) {
        return 0;
    }
    return 0;
}
