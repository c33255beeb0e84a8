#pragma once

#include <string>
#include <vector>

#include "certificate/certified_results.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// One thing that an evaluation has to say, in both forms: a message, and a finding of a certificate.
struct Remark {
    gum::Diagnostic message;
    std::string id, clause;  ///< of the finding; its place, text and action are those of the message
    certificate::FindingSeverity severity = certificate::FindingSeverity::major;
    certificate::FindingSeverity accredited = certificate::FindingSeverity::major;  ///< on an accredited certificate
};

[[nodiscard]] std::vector<gum::Diagnostic> messages_of(std::vector<Remark> remarks);

/// \param record  whose certificate, if any, says how grave they are
[[nodiscard]] std::vector<certificate::Finding> findings_of(std::vector<Remark> remarks,
                                                            const reports::EvaluationRecord& record);

}  // namespace gumcert::reports
