#include "engine/rotary_table/start/start_values.h"

#include <cstddef>

#include "engine/rotary_table/start/common_set_up.h"
#include "engine/rotary_table/start/open_places.h"
#include "engine/rotary_table/start/place_search.h"

namespace gumcert::engine {

StartValues find_start_values(const RotaryTableMeasurement& measurement, const std::vector<bool>& active) {
    const PlaceSearch search(measurement, active);
    const ObservedStations& observed = search.observed();
    return start_values_of(observed, settled_places(observed, search.fit_each()));
}

StartValues start_values_of(const ObservedStations& observed, const CommonFit& found) {
    StartValues start;
    start.dead_paths = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observed.measurement().dead_paths.size()));
    // JointAdjustment starts with T_s = 1: its table frame is the fixture frame at home.
    start.set_up = observed.set_up_motion(found.set_up);
    const RigidMotion fixture_from_table = start.set_up.inverse();
    for (std::size_t j = 0; j < found.stations.size(); ++j) {
        start.stations.emplace_back(fixture_from_table * found.stations[j].position);
        const Eigen::VectorXd centres = observed.deviations(j, found.set_up, found.stations[j].position).dead_paths;
        const std::vector<std::size_t>& names = observed.stations()[j].path_name;
        for (std::size_t d = 0; d < names.size(); ++d) {
            start.dead_paths[static_cast<Eigen::Index>(names[d])] = centres[static_cast<Eigen::Index>(d)];
        }
    }
    return start;
}

}  // namespace gumcert::engine
