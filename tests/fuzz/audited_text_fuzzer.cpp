#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "audit/audited_budget.h"
#include "audit/row_facts.h"
#include "audit/stated_number.h"

/// Any text of a table is read or not, and what is read of it is a number.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert::audit;
    const std::string text(reinterpret_cast<const char*>(data), size);
    const std::optional<StatedNumber> number = read_number(text, "");
    if (number && (std::isnan(number->value) || !(number->half_step >= 0.0))) {
        std::abort();
    }
    AuditedRow row;
    row.unit = "bar";
    row.comment = text;
    note_row_facts(row);
    for (const std::optional<double>* fact :
         {&row.relative_uncertainty, &row.full_scale, &row.certificate_low, &row.certificate_high, &row.lower_limit,
          &row.upper_limit, &row.reliability, &row.unapplied_correction}) {
        if (*fact && !std::isfinite(**fact)) {
            std::abort();
        }
    }
    if (row.certificate_low && *row.certificate_low > row.certificate_high.value()) {
        std::abort();
    }
    return 0;
}
