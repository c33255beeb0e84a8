#include "engine/rotary_table/start/two_places.h"

#include <Eigen/Core>

#include <optional>
#include <utility>

#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/millimetres_text.h"
#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/selected_lengths.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

void refuse_two_places(const RotaryTableMeasurement& measurement, std::size_t station, double misfit) {
    constexpr double k_same_place = 0.02;  // [m]
    // From one place with dead paths of each pass, as after an interruption between them: places that a weak layout
    // hardly tells apart are not two.
    RotaryTableMeasurement split = measurement;
    for (LengthObservation& length : split.lengths) {
        length.dead_path += length.pass * measurement.dead_paths.size();
    }
    if (PlaceSearch(split, lengths_of_station(measurement, station)).fit_of(station, true).upright_misfit() <
        k_share_with_right_labels * misfit) {
        return;
    }
    std::optional<std::pair<std::size_t, Eigen::Vector3d>> first;
    for (std::size_t pass = 0; pass < measurement.passes.size(); ++pass) {
        const PlaceSearch search(measurement, lengths_of_station(measurement, station, pass));
        if (!search.tells_causes(station)) {
            continue;
        }
        const StationFit fit = search.fit_of(station, true);
        if (!(fit.upright_misfit() < k_share_with_right_labels * misfit)) {
            return;
        }
        if (!first) {
            first = {pass, fit.position};
        } else if ((fit.position - first->second).norm() > k_same_place) {
            throw gum::NoResultError(gum::Diagnostic{
                "GC-ADJUST-0013", "lengths, station " + measurement.stations[station],
                "its passes were measured from places that are " +
                    millimetres((fit.position - first->second).norm(), 0) +
                    " mm apart: " + measurement.passes[first->first] + " and " + measurement.passes[pass],
                "a station stands in one place",
                "see whether stations are interchanged in one of the passes, or "
                "give the place of its own a station name of its own",
                gum::Severity::error});
        }
    }
}

}  // namespace gumcert::engine
