#pragma once

#include "jobs/rotary_table/rotary_table_reading.h"

namespace gumcert::jobs {

/// The lengths file, without the distances that the job leaves out.
/// \return the stations and angles that were measured
[[nodiscard]] MeasuredPlaces read_lengths(const RotaryTableReading& reading, const FixtureNames& fixture,
                                          JobFiles::File&& file);

}  // namespace gumcert::jobs
