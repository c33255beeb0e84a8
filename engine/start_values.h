#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "engine/rotary_table_measurement.h"

namespace gumcert::engine {

/// Start values of the adjustment, in T.
struct StartValues {
    std::vector<Eigen::Vector3d> stations;  ///< [m]
    Eigen::VectorXd dead_paths;             ///< [m]
};

/// Start values of stations and dead paths without an operator: linear in (q, l0, |q|² - l0²) with the ideal positions
/// of the reflectors at all angles. A given start value of a station is used where it explains the distances better.
///
/// \param active  one flag a length: false = left out; empty: all are used
/// \throws gum::NoResultError if the reflectors of a station are seen on a cone or in too few directions
[[nodiscard]] StartValues find_start_values(const RotaryTableMeasurement& measurement,
                                            const std::vector<bool>& active = {});

/// The lengths that cannot be of this measurement: off by centimetres and far more than all others of their station.
///
/// A linearised adjustment does not survive such an error, so these are found before it, one at a time, from the
/// deviations of the start values (median and median absolute deviation of every dead path). Returned in the order
/// found.
[[nodiscard]] std::vector<std::size_t> find_gross_errors(const RotaryTableMeasurement& measurement);

}  // namespace gumcert::engine
