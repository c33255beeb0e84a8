#pragma once

#include "jobs/comparison/comparison_reading.h"

namespace gumcert::jobs {

/// Reads a method against a reference method, the keys `lab` and `reference` of the job.
void read_methods(const ComparisonReading& reading, const JsonObject& root);

}  // namespace gumcert::jobs
