#pragma once

#include <vector>

#include "engine/adjustment.h"
#include "engine/fixed_parts.h"
#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/start/common_set_up.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// What to ask of a measurement that has no result, or one whose noise is many times what is stated. A refractive index that was
/// left out makes all distances of a station 270 ppm too long, which is below what a search without error motions tells of a station,
/// and far above what the tests of an adjustment survive: whatever they leave out, another cause is told than this one. Adjusted is
/// once more with a scale of each station that is free. Where that leaves a quarter of chi-square, and the stations that have a scale
/// at all (20 ppm to 1 %) have the same one within a fifth, the factor is the cause.
///
/// \param places  of the stations of this measurement, with all distances that are active
/// \param active  one flag a length: false = grossly off
/// \return        GC-ADJUST-0013 of all distances, or of each station that has the scale; none where it is not the cause
[[nodiscard]] std::vector<gum::Diagnostic> scaled_lengths(const RotaryTableMeasurement& measurement,
                                                          const CommonFit& places, const std::vector<bool>& active,
                                                          const SolverOptions& solver, const Workers& workers);

}  // namespace gumcert::engine
