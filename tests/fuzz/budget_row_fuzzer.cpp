#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "audit/row_meaning.h"

/// A unit in the first line, a comment in the rest: whatever they say, what is read are numbers greater than 0, and what
/// is evaluated is finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const std::size_t end = text.find('\n');
    gumcert::audit::AuditedRow row;
    row.unit = std::string(text.substr(0, end));
    row.comment = end == std::string_view::npos ? std::string() : std::string(text.substr(end + 1));
    row.u = gumcert::audit::read_number(row.comment, "");
    row.divisor = gumcert::audit::read_number(row.unit, "");
    gumcert::audit::read_comment(row);
    gumcert::audit::complete_row(row);
    static_cast<void>(gumcert::audit::shape_of(row.comment));
    const bool sound = std::isfinite(row.used_u) && row.used_u >= 0.0 && std::isfinite(row.used_sensitivity) &&
                       row.used_nu > 0.0 && (!row.origin_value || *row.origin_value > 0.0);
    if (!sound) {
        std::abort();
    }
    return 0;
}
