#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "gum/quantity/diagnostic.h"
#include "workbook/read_csv.h"

/// Somebody's table, audited with all rules: it is refused or audited, and every effect that is stated is a number.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const gumcert::audit::AuditReport report =
            gumcert::audit::audit(gumcert::audit::subject_of(gumcert::workbook::read_csv(text, "t.csv", "t"), "t.csv"),
                                  gumcert::audit::all_rules());
        for (const gumcert::audit::AuditFinding& finding : report.findings) {
            if (finding.effect && !(std::isfinite(finding.effect->alone.U) && std::isfinite(finding.effect->share))) {
                std::abort();
            }
        }
    } catch (const gumcert::gum::InputError&) {
        return 0;
    }
    return 0;
}
