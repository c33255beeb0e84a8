#pragma once

#include <vector>

#include "engine/rotary_table/group_tests.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// Code of the messages on suspicious groups.
inline constexpr const char* k_suspicious_group = "GC-GROUP-0001";

/// Code of the message that the errors which are told do not explain everything.
inline constexpr const char* k_unexplained_rest = "GC-GROUP-0002";

/// What a reader must know of the groups that are suspicious, the least probable one first, up to five: which, by how
/// much, and what to do; and last whether the distances contradict the model without them. Warnings.
/// \param measurement  that the groups are of
[[nodiscard]] std::vector<gum::Diagnostic> group_notes(const GroupTests& groups,
                                                       const RotaryTableMeasurement& measurement);

}  // namespace gumcert::engine
