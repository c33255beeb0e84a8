#include "engine/rotary_table/start/selected_lengths.h"

#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

std::vector<bool> lengths_of_station(const RotaryTableMeasurement& measurement, std::size_t station,
                                     std::optional<std::size_t> pass) {
    std::vector<bool> active;
    for (const LengthObservation& length : measurement.lengths) {
        active.push_back(length.station == station && (!pass || length.pass == *pass));
    }
    return active;
}

std::vector<bool> lengths_without_reflector(const RotaryTableMeasurement& measurement, std::size_t reflector) {
    std::vector<bool> active;
    for (const LengthObservation& length : measurement.lengths) {
        active.push_back(length.reflector != reflector);
    }
    return active;
}

std::vector<bool> lengths_of_some_visits(const RotaryTableMeasurement& measurement, const std::vector<bool>& active) {
    constexpr std::size_t k_visits = 24;
    const std::vector<Visit> visits = visits_of(measurement, active);
    if (visits.size() <= k_visits) {
        return active;
    }
    std::vector<bool> some(active.size(), false);
    for (std::size_t k = 0; k < k_visits; ++k) {
        for (const std::size_t i : visits[k * visits.size() / k_visits].observations) {
            some[i] = true;
        }
    }
    return some;
}

}  // namespace gumcert::engine
