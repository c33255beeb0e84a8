#pragma once

#include <optional>

#include "jobs/comparison/comparison_reading.h"
#include "jobs/comparison/comparison_side.h"

namespace gumcert::jobs {

/// Reads the keys `job` and `of` of a side of a comparison of methods: a job of kind `rotary_table`, whose axial error
/// motion is compared, or `circle_closure`. The points of the side are its angles, named by the shortest text of the
/// angle in degrees from 0 to 360.
/// \param unit  of the comparison; nothing: it was refused
void read_compared_job(const ComparisonReading& reading, const JsonObject& object, const std::optional<gum::Unit>& unit,
                       SideReading& side);

}  // namespace gumcert::jobs
