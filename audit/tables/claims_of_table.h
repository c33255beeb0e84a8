#pragma once

#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/sentence.h"
#include "audit/tables/stated_results.h"

namespace gumcert::audit {

/// Puts statements into a budget, in the unit of its result.
/// \param of_contributions  the unit that contributions state
/// \param of_rows  the unit "1" where all rows that are added as they are have it; else ""
void state_claims(AuditedBudget& budget, const Statements& statements, const std::string& of_contributions,
                  const std::string& of_rows, std::vector<Sentence>& not_read);

/// How the table comes from u_c to U: by the k that it claims. Whether that is t_p of its ν_eff, note_unexplained() sees.
void state_coverage(AuditedBudget& budget);

}  // namespace gumcert::audit
