#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/quantity/units.h"

namespace gumcert::gum {

/// Truth and noise of simulated campaigns (`gumcert simulate`); defaults are those of the source paper, section 4.
struct SimulationRequest {
    std::size_t runs = 100;
    std::uint64_t seed = 1;
    double set_up_offset = 10e-6;               ///< both offsets of the fixture across the axis, [m]
    double set_up_tilt = 20.0 * k_arcsecond;    ///< both tilts, [rad]
    double error_linear = 10e-6;                ///< error motions uniform within ± this, [m]
    double error_angular = 20.0 * k_arcsecond;  ///< [rad]
    /// Repeatability of the simulated table; nothing: as `table_repeatability` of the job states it.
    std::optional<engine::TableRepeatability> table_repeatability;
    std::size_t outliers = 0;               ///< distances with a planted error in every campaign
    double outlier_size = 3e-6;             ///< its absolute value, sign at random, [m]
    std::vector<std::size_t> angle_counts;  ///< studies over full turns of these many angles; empty: angles of the job
};

}  // namespace gumcert::gum
