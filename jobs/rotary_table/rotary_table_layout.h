#pragma once

#include <string>

#include "jobs/rotary_table/rotary_table_reading.h"

namespace gumcert::jobs {

// What must hold of stations and angles, measured or planned.

inline constexpr std::size_t k_least_at_angle = 6;    // a pose has six unknowns
inline constexpr std::size_t k_least_reflectors = 3;  // three points fix a rigid body

/// A layout without lengths: stations from their file and angles from the plan; distances are not there yet.
/// \param places  with the stations; receives the angles
void read_layout(const RotaryTableReading& reading, const JsonObject& observations, const FixtureNames& fixture,
                 MeasuredPlaces& places);

/// \param where_angles  place of the first angle
/// \param where_all  place for a warning of all angles
void check_angles(const RotaryTableReading& reading, const MeasuredPlaces& places, const std::string& where_angles,
                  const std::string& where_all, ProblemList& problems);

/// Puts the angles into the measurement.
void store_angles(const RotaryTableReading& reading, const MeasuredPlaces& places);

/// A plan beside measured lengths has angles of its own; home is one of them, too.
void check_home_of_plan(const RotaryTableReading& reading);

/// Keys of a plan that measured lengths leave without use in a study.
void warn_of_idle_plan(const RotaryTableReading& reading, JobUse use);

/// What is planned or simulated must fit into memory as a measurement does.
void check_sizes(const RotaryTableReading& reading, const FixtureNames& fixture, const MeasuredPlaces& places);

/// A reversal of each angle needs both senses at each angle, and at each station, whose place would else take part
/// in it.
void check_reversal(const RotaryTableReading& reading);

}  // namespace gumcert::jobs
