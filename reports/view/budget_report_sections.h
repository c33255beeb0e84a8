#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

#include <nlohmann/json_fwd.hpp>

namespace gumcert::reports {

// What the budget report shows beside the sections of a certificate, see budget_report_view().

/// Whose certificate it is about, and the record that it is made of.
void report_subject(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

/// Stated U, capability and scope entry of every certified value; nothing where no accreditation is stated.
void capability_of_values(CertificateBuilder& builder, const Wording& words,
                          const certificate::Certificate& certificate);

/// The lines of the CSV files of the job, as they were read, where the record holds them.
void files_as_read(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

/// {header_left, header_right, footer_left}
[[nodiscard]] nlohmann::json budget_report_running_texts(const Wording& words, const EvaluationRecord& record);

}  // namespace gumcert::reports
