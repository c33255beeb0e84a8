#include "engine/rotary_table/start/no_rigid_table.h"

#include <cstddef>

#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/millimetres_text.h"
#include "engine/rotary_table/start/robust_descent.h"

namespace gumcert::engine {

std::optional<gum::Diagnostic> no_rigid_table(const RotaryTableMeasurement& measurement,
                                              const std::vector<StationFit>& fits) {
    std::size_t worst = 0;
    for (std::size_t j = 1; j < fits.size(); ++j) {
        worst = fits[j].misfit > fits[worst].misfit ? j : worst;
    }
    if (fits.empty() || !(fits[worst].misfit > k_wrong_labels)) {
        return std::nullopt;
    }
    return gum::Diagnostic{
        "GC-ADJUST-0015",
        "station " + measurement.stations[worst],
        "its distances fit no rigid table that turns by the stated angles: from the place that fits best they "
        "differ by " +
            millimetres(fits[worst].misfit, 1) + " mm (root mean square without the largest)",
        "what a place of the station leaves are error motions, far below a millimetre",
        "compare units and signs of distances, angles and fixture, and the names of reflectors and stations, with "
        "the "
        "protocol of the measurement",
        gum::Severity::error};
}

}  // namespace gumcert::engine
