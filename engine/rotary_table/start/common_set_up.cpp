#include "engine/rotary_table/start/common_set_up.h"

#include <numeric>
#include <utility>

#include "engine/rotary_table/start/candidate_places.h"
#include "engine/rotary_table/start/closed_solution.h"
#include "engine/rotary_table/start/fit_limits.h"

namespace gumcert::engine {

namespace {

/// True when the place of a station was changed.
bool choose_again(const ObservedStations& observed, CommonFit& found) {
    bool changed = false;
    std::vector<StationFit>& fits = found.stations;
    for (std::size_t j = 0; j < fits.size(); ++j) {
        const StationDistances& data = observed.stations()[j];
        const std::vector<Eigen::Vector3d> points = observed.positions(j, found.set_up, false).point;
        std::vector<Eigen::Vector3d> others;
        if (const Eigen::Vector3d image = mirror_image(points, fits[j].position);
            !is_hopeless(data, points, image, fits[j].misfit)) {
            others.push_back(image);
        }
        if (fits[j].misfit > k_good_misfit) {
            const ClosedSolution closed = closed_solution(data, points);
            others.push_back(closed.position);
        }
        const auto consider = [&](const StationFit& fit) {
            if (fit.misfit * k_rival_factor < fits[j].misfit) {
                fits[j] = fit;
                changed = true;
            }
        };
        for (const Eigen::Vector3d& other : others) {
            consider(refined(observed, j, other, found.set_up, false));
        }
        for (const Eigen::Vector3d& other : all_sides(closed_solution(data, points).centre)) {
            if (fits[j].misfit > k_good_misfit) {
                const StationFit fit = refined(observed, j, other, found.set_up, false, Pull::of_all);
                // Another bad place is none: the set-up may be that of an inclined fixture, which they share yet.
                if (fit.misfit <= k_good_misfit) {
                    consider(fit);
                }
            }
        }
    }
    return changed;
}

}  // namespace

CommonFit fit_together(const ObservedStations& observed, std::vector<StationFit> alone) {
    std::vector<std::size_t> all(alone.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    CommonFit found;
    found.stations = std::move(alone);
    descend(observed, all, found.set_up, found.stations, true);
    if (choose_again(observed, found)) {
        descend(observed, all, found.set_up, found.stations, true);
    }
    return found;
}

}  // namespace gumcert::engine
