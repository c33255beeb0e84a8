#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

// Which distances a search looks at: one flag a length of the measurement, true = used.

/// \param pass  only those of this pass; absent: of all
[[nodiscard]] std::vector<bool> lengths_of_station(const RotaryTableMeasurement& measurement, std::size_t station,
                                                   std::optional<std::size_t> pass = {});

[[nodiscard]] std::vector<bool> lengths_without_reflector(const RotaryTableMeasurement& measurement,
                                                          std::size_t reflector);

/// Of the visits of some distances as many as tell labels, evenly over all of them: a time that does not grow with the
/// measurement.
/// \param active  distances of one station
[[nodiscard]] std::vector<bool> lengths_of_some_visits(const RotaryTableMeasurement& measurement,
                                                       const std::vector<bool>& active);

}  // namespace gumcert::engine
