#include "reports/record/make/comparison/refuted_side.h"

#include <iterator>
#include <utility>

namespace gumcert::reports {

std::vector<RefutedSide> refuted_by(const std::vector<certificate::Finding>& findings, const std::string& side,
                                    const std::string& file) {
    std::vector<RefutedSide> refuted;
    for (const certificate::Finding& finding : findings) {
        if (finding.severity == certificate::FindingSeverity::major ||
            finding.severity == certificate::FindingSeverity::critical) {
            refuted.push_back({.side = side,
                               .file = file,
                               .id = finding.id,
                               .message = {},
                               .what = finding.where.empty() ? finding.what : finding.where + ": " + finding.what});
        }
    }
    return refuted;
}

void withhold_agreement(std::vector<RefutedSide> refuted, Comparison& comparison) {
    if (refuted.empty()) {
        return;
    }
    for (const RefutedSide& by : refuted) {
        comparison.remarks.push_back((by.side.empty() ? "The measurement" : by.side) + " contradicts what it states: " +
                                     by.what + " [" + (by.id.empty() ? by.message : by.id) + "].");
    }
    for (ComparisonSummary& row : comparison.summary) {
        if (!row.verdict.empty() && row.verdict != "disagreement") {
            row.verdict = k_side_refuted;
        }
    }
    comparison.refuted.insert(comparison.refuted.end(), std::make_move_iterator(refuted.begin()),
                              std::make_move_iterator(refuted.end()));
}

}  // namespace gumcert::reports
