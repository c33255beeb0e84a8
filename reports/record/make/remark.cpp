#include "reports/record/make/remark.h"

#include <utility>

namespace gumcert::reports {

std::vector<gum::Diagnostic> messages_of(std::vector<Remark> remarks) {
    std::vector<gum::Diagnostic> messages;
    for (Remark& remark : remarks) {
        messages.push_back(std::move(remark.message));
    }
    return messages;
}

std::vector<certificate::Finding> findings_of(std::vector<Remark> remarks, const reports::EvaluationRecord& record) {
    const bool accredited = record.certificate && record.certificate->data.status == "accredited";
    std::vector<certificate::Finding> findings;
    for (Remark& remark : remarks) {
        findings.push_back({.id = std::move(remark.id),
                            .clause = std::move(remark.clause),
                            .severity = accredited ? remark.accredited : remark.severity,
                            .where = std::move(remark.message.where),
                            .what = std::move(remark.message.what),
                            .action = std::move(remark.message.action)});
    }
    return findings;
}

}  // namespace gumcert::reports
