#pragma once

#include <functional>
#include <string>

#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// A breach of a rule between the parts of a record.
using RecordBreach = std::function<void(const std::string& pointer, std::string what, std::string rule)>;

/// What must hold between the parts of a comparison, so that a document can be made of it: ids are listed once, and
/// every id that is named is one of those.
/// \param report  called for each breach, with its JSON pointer inside the comparison
void check_comparison(const Comparison& comparison, const RecordBreach& report);

}  // namespace gumcert::reports
