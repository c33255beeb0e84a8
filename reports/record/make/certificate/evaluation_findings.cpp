#include "reports/record/make/certificate/evaluation_findings.h"

#include <algorithm>
#include <iterator>

#include "reports/record/make/budget/budget_findings.h"
#include "reports/record/make/circle_closure/circle_closure_findings.h"
#include "reports/record/make/rotary_table/rotary_findings.h"

namespace gumcert::reports {

std::vector<certificate::Finding> evaluation_findings(const EvaluationRecord& record) {
    std::vector<certificate::Finding> findings = budget_findings(record);
    std::ranges::move(rotary_findings(record), std::back_inserter(findings));
    std::ranges::move(circle_closure_findings(record), std::back_inserter(findings));
    return findings;
}

}  // namespace gumcert::reports
