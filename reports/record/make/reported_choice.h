#pragma once

#include "gum/coverage_choice.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Which result of every quantity of a rotary table holds: that of the law of propagation, or that of Monte Carlo
/// (docs/adr/0024). Documents print what is reported; value, u, U and k beside it stay those of the law.
///
/// Monte Carlo is reported where the job asks for it, or where trials contradict the law of propagation by
/// JCGM 101:2008, clause 8; the law of propagation, with what speaks against it, where the job asks for that.
/// \param record  of a rotary table, with its Monte Carlo where there is one
void report_rotary_results(reports::EvaluationRecord& record, gum::CoverageChoice choice);

/// The same of a result with a coverage probability of its own: `reported` of it, where its trials have something to
/// say.
void report_result(reports::Result& result, gum::CoverageChoice choice);

/// Puts the texts of a result of the set-up, "O_y", into the set-up of the table as people read it, and with the other
/// sign into the axis as seen from the fixture. Other results have no place there.
void print_set_up(reports::RotaryTable& rotary, const reports::Result& result);

}  // namespace gumcert::reports
