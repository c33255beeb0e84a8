#pragma once

#include <cstddef>
#include <optional>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/start/label_hypothesis.h"
#include "engine/rotary_table/start/robust_descent.h"

namespace gumcert::engine {

/// What is wrong with the labels of all distances of a station: the hypothesis that leaves next to nothing of its misfit.
/// \param misfit  of the distances as they are stated, [m]
/// \return nothing where none does, or where the station has too few distances to tell
[[nodiscard]] std::optional<LabelHypothesis> labels_of_station(const RotaryTableMeasurement& measurement,
                                                               std::size_t station, double misfit);

/// Whether labels, as those of another station, leave next to nothing of the misfit of a station.
[[nodiscard]] bool labels_explain_station(const RotaryTableMeasurement& measurement, std::size_t station, double misfit,
                                          const LabelHypothesis& labels);

/// The factor on the distances of a station that makes its misfit vanish, from 0.8 to 1.25 and off 1 by 0.0005 or more.
/// \param fit  of the distances as they are stated
[[nodiscard]] std::optional<LabelHypothesis> scale_of_station(const RotaryTableMeasurement& measurement,
                                                              std::size_t station, const StationFit& fit);

}  // namespace gumcert::engine
