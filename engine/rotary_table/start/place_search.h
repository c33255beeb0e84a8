#pragma once

#include <cstddef>
#include <vector>

#include "engine/rotary_table/start/observed_stations.h"
#include "engine/rotary_table/start/robust_descent.h"

namespace gumcert::engine {

/// Stations one by one, each with a set-up of its own: from the closed solution, and where it is singular or explains the
/// distances badly, from the line that is open, from a grid of directions and distances, and from all sides.
class PlaceSearch {
public:
    /// \param active  one flag a length: false = left out; empty: all are used
    explicit PlaceSearch(const RotaryTableMeasurement& measurement, const std::vector<bool>& active = {})
        : observed_(measurement, active) {}

    [[nodiscard]] const ObservedStations& observed() const { return observed_; }
    [[nodiscard]] const StationDistances& distances(std::size_t station) const { return observed_.stations()[station]; }
    /// Whether a station has distances enough to tell one cause from another.
    [[nodiscard]] bool tells_causes(std::size_t station) const { return engine::tells_causes(distances(station)); }

    /// \param closely  down narrow valleys too
    [[nodiscard]] StationFit fit_of(std::size_t station, bool closely) const;
    /// All, closely, in their order.
    [[nodiscard]] std::vector<StationFit> fit_each() const;
    /// From where the station was found with nearly the same distances.
    [[nodiscard]] StationFit fit_near(std::size_t station, const StationFit& from) const;
    /// The best from all sides, from a grid and from where the station was found.
    [[nodiscard]] StationFit fit_from_all_sides(std::size_t station, const StationFit& found) const;
    /// Places of a station by plain least squares of all its distances, from all sides and from where it was found: what
    /// weights have left out is in.
    [[nodiscard]] std::vector<StationFit> plain_fits(std::size_t station, const StationFit& found) const;

    /// Deviations of a station from a fit of its own.
    [[nodiscard]] Deviations deviations(std::size_t station, const StationFit& fit) const {
        return observed_.deviations(station, fit.set_up, fit.position);
    }

private:
    ObservedStations observed_;
};

}  // namespace gumcert::engine
