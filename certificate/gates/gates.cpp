#include "certificate/gates/gates.h"

#include <algorithm>
#include <iterator>

namespace gumcert::certificate {

namespace {

bool has_accredited_value(const Certificate& certificate) {
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            const bool any = std::any_of(column.values.begin(), column.values.end(), [](const CertifiedValue& value) {
                return !value.scope_entry.empty() && !value.external && (value.U || value.interval);
            });
            if (any) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

void pass_gates(Certificate& certificate, const std::vector<Finding>& audit) {
    std::vector<Finding> all = completeness_findings(certificate);
    for (const std::vector<Finding>& more : {plausibility_findings(certificate), uncertainty_findings(certificate),
                                             symbol_findings(certificate), language_findings(certificate), audit}) {
        all.insert(all.end(), more.begin(), more.end());
    }
    certificate.findings.clear();
    certificate.symbol = certificate.data.status == "accredited" && has_accredited_value(certificate);
    add_findings(certificate, all);
}

void add_findings(Certificate& certificate, const std::vector<Finding>& later) {
    std::vector<Finding>& all = certificate.findings;
    all.insert(all.end(), later.begin(), later.end());
    std::stable_sort(all.begin(), all.end(),
                     [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
    const bool critical = !all.empty() && all.front().severity == FindingSeverity::critical;
    certificate.blocked = critical && certificate.data.status != "specimen";
    certificate.symbol = certificate.symbol && !critical;
}

}  // namespace gumcert::certificate
