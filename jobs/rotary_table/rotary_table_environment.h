#pragma once

#include "jobs/rotary_table/rotary_table_reading.h"

namespace gumcert::jobs {

// The files that have a row for each station.

/// Start values of the places of the stations; without lengths, the stations of the layout.
/// \param places  receives the stations of a layout
void read_stations(const RotaryTableReading& reading, JobFiles::File&& file, MeasuredPlaces& places);

/// Temperatures of the fixture, and the air about the stations.
void read_environment(const RotaryTableReading& reading, JobFiles::File&& file, const MeasuredPlaces& places);

/// Without an environment file the fixture is at its reference temperature.
void assume_reference_temperature(const RotaryTableReading& reading, const MeasuredPlaces& places);

}  // namespace gumcert::jobs
