#pragma once

#include <string>
#include <vector>

#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The section of a record that a result belongs to; nullptr in a record without sections.
/// \param quantity  name of the result without its point
[[nodiscard]] const SectionSummary* section_of(const EvaluationRecord& record, const std::string& quantity);

/// The title of a section, or its name where it has none.
[[nodiscard]] certificate::LocalisedText title_of(const SectionSummary& section);

/// The title of a record, in the languages in which the job states it.
[[nodiscard]] certificate::LocalisedText title_of(const EvaluationRecord& record);

/// The equations that a result follows from: those of its section, or of the whole budget.
/// \param quantity  name of the result without its point
[[nodiscard]] std::vector<std::string> equations_of(const EvaluationRecord& record, const std::string& quantity);

}  // namespace gumcert::reports
