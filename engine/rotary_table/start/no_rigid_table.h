#pragma once

#include <optional>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

struct StationFit;  // robust_descent.h

/// The station that fits its distances worst, each on its own, where it is worse than error motions let any fit. To be asked
/// before a measurement is refused for its layout: what is open where the distances of a station fit no place to a millimetre
/// is no property of the layout.
/// \param fits  one a station of the measurement, each on its own
/// \return GC-ADJUST-0015
[[nodiscard]] std::optional<gum::Diagnostic> no_rigid_table(const RotaryTableMeasurement& measurement,
                                                            const std::vector<StationFit>& fits);

}  // namespace gumcert::engine
