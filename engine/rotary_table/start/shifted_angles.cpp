#include "engine/rotary_table/start/shifted_angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/degrees_text.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

void refuse_shifted_angles(const RotaryTableMeasurement& measurement) {
    constexpr double k_alike = 1e-6 * gum::k_degree;
    constexpr double k_most_shared = 0.5;
    constexpr double k_explained = 0.8;
    const auto turns = [](double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); };
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        std::vector<bool> own(measurement.angles.size(), false);
        std::vector<bool> others = own;
        for (const LengthObservation& length : measurement.lengths) {
            (length.station == j ? own : others)[length.angle] = true;
        }
        // How many of its angles are those of the others when they are shifted.
        const auto shared = [&](double shift) {
            double count = 0.0;
            double all = 0.0;
            for (std::size_t a = 0; a < own.size(); ++a) {
                if (own[a]) {
                    all += 1.0;
                    for (std::size_t b = 0; b < own.size(); ++b) {
                        if (others[b] &&
                            std::abs(turns(measurement.angles[a] + shift - measurement.angles[b])) < k_alike) {
                            count += 1.0;
                            break;
                        }
                    }
                }
            }
            return all > 2.0 ? count / all : 1.0;
        };
        if (shared(0.0) > k_most_shared) {
            continue;
        }
        const auto first = static_cast<std::size_t>(std::ranges::find(own, true) - own.begin());
        std::optional<double> best;
        for (std::size_t b = 0; b < own.size(); ++b) {
            const double shift = turns(measurement.angles[b] - measurement.angles[first]);
            if (others[b] && (!best || std::abs(shift) < std::abs(*best)) && shared(shift) > k_explained) {
                best = shift;
            }
        }
        if (best) {
            const double degrees = std::round(std::abs(*best) / gum::k_degree * 1e6) / 1e6;
            throw gum::NoResultError(gum::Diagnostic{
                "GC-ADJUST-0013", "lengths, station " + measurement.stations[j],
                "its angles are those of the other stations when they are " + degrees_text(degrees) +
                    (*best > 0.0 ? " higher" : " lower"),
                "an angle that several stations measure is stated alike for all of them",
                "state the angles to which the table was driven, from the same origin and rounded alike",
                gum::Severity::error});
        }
    }
}

}  // namespace gumcert::engine
