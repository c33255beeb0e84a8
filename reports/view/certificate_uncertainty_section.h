#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/view/certified_overview.h"
#include "reports/wording.h"

#include <vector>

namespace gumcert::reports {

/// Coverage probability of some values: "95.45 %"; "95.45 % (E); 99 % (T[2 m])" where results state their own.
[[nodiscard]] Text stated_probability(const EvaluationRecord& record,
                                      const std::vector<const certificate::CertifiedValue*>& values,
                                      const Wording& words);

/// What the uncertainties of the certified tables mean: one sentence for each kind of coverage that occurs, chosen from
/// the record; contributions that were considered, and what is not contained (ILAC-P14:09/2020).
/// \param record  with certificate data
void uncertainty_section(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record,
                         const CertifiedOverview& overview);

}  // namespace gumcert::reports
