#pragma once

#include "gum/rotary_table/evaluate_rotary_table.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What a record of a rotary table holds beside its results: tests of groups of distances, deviations of the visits,
/// the curves of each sense of approach, harmonics, temperatures, and the distances of a small measurement.
/// \param rotary  with its other fields filled
void fill_evidence(reports::RotaryTable& rotary, const jobs::RotaryTableJob& job, const gum::RotaryTableResult& result);

/// The word of a kind of groups in a record: "visit_length" …
[[nodiscard]] const char* group_kind_name(engine::GroupKind kind);

}  // namespace gumcert::reports
