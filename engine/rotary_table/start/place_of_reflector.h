#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/start/robust_descent.h"

namespace gumcert::engine {

/// Where the distances put a reflector in the fixture, from stations whose places the other reflectors tell. [m]
///
/// Damped least squares from its stated coordinates, or from those with other signs or in another order where they fit
/// better.
/// \param stations  those whose distances are used
/// \param fits      one a station of the measurement, found without the reflector; those with an infinite misfit are left out
/// \return nothing for fewer than four distances, or where half of them stay off by more than `k_good_misfit`
[[nodiscard]] std::optional<Eigen::Vector3d> place_of_reflector(const RotaryTableMeasurement& measurement,
                                                                std::size_t reflector,
                                                                const std::vector<std::size_t>& stations,
                                                                const std::vector<StationFit>& fits);

}  // namespace gumcert::engine
