#include "audit/finding.h"

#include <algorithm>

namespace gumcert::audit {

const Correction* correction_of(const AuditFinding& finding, std::size_t budget) {
    const auto other = finding.correct_others.find(budget);
    if (other != finding.correct_others.end()) {
        return &other->second;
    }
    const bool touched = std::find(finding.budgets.begin(), finding.budgets.end(), budget) != finding.budgets.end();
    return touched && finding.correct ? &finding.correct : nullptr;
}

}  // namespace gumcert::audit
