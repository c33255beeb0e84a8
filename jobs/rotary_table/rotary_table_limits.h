#pragma once

#include "jobs/json_object.h"

namespace gumcert::jobs {

/// Two angles that differ by less are one, [°].
inline constexpr double k_same_angle_deg = 1e-9;
/// Angles of a table; ten turns, because a table may be driven on.
inline constexpr NumberRange k_angle{
    .low = -3600.0, .high = 3600.0, .unit = "°", .hint = "check the unit: angles are in degrees"};
inline constexpr NumberRange k_station_coordinate{
    .low = -100'000.0, .high = 100'000.0, .unit = "mm", .hint = "check the unit: coordinates are in millimetres"};
inline constexpr NumberRange k_fixture_coordinate{
    .low = -10'000.0, .high = 10'000.0, .unit = "mm", .hint = "check the unit: coordinates are in millimetres"};
inline constexpr NumberRange k_temperature{
    .low = -50.0, .high = 100.0, .unit = "°C", .hint = "check the unit: temperatures are in degrees Celsius"};

inline constexpr double k_most_planned_angles = 100'000.0;

}  // namespace gumcert::jobs
