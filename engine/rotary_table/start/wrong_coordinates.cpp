#include "engine/rotary_table/start/wrong_coordinates.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/labels_of_station.h"
#include "engine/rotary_table/start/millimetres_text.h"
#include "engine/rotary_table/start/place_of_reflector.h"
#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/selected_lengths.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

[[noreturn]] void refuse_coordinates(const RotaryTableMeasurement& measurement, std::size_t m,
                                     const std::optional<Eigen::Vector3d>& place) {
    std::string what = "the distances of the stations agree when this reflector is left out";
    if (place) {
        const Eigen::Vector3d way = *place - measurement.fixture.row(static_cast<Eigen::Index>(m)).transpose();
        what = "the distances put it near (" + millimetres(place->x(), 1) + ", " + millimetres(place->y(), 1) + ", " +
               millimetres(place->z(), 1) + ") mm in the fixture, " + millimetres(way.norm(), 1) +
               " mm away from its stated coordinates";
    }
    throw gum::NoResultError(gum::Diagnostic{
        "GC-ADJUST-0013", "fixture, reflector " + measurement.reflectors[m], what,
        "a reflector stands in the fixture where its coordinates say",
        "compare its coordinates with the report of the CMM, digit by digit and with their signs, and see whether "
        "its name in the lengths is that of another point and whether it was moved",
        gum::Severity::error});
}

}  // namespace

void refuse_wrong_coordinates(const RotaryTableMeasurement& measurement, const std::vector<std::size_t>& stations,
                              const std::vector<double>& misfits) {
    constexpr std::size_t k_fewest_reflectors = 4;  // three that are left make a frame
    if (measurement.reflectors.size() < k_fewest_reflectors) {
        return;
    }
    std::optional<std::size_t> wrong;
    std::vector<StationFit> fits(measurement.stations.size());
    double least = 1.0;
    for (std::size_t m = 0; m < measurement.reflectors.size(); ++m) {
        const PlaceSearch search(measurement, lengths_without_reflector(measurement, m));
        std::vector<StationFit> found(measurement.stations.size());
        double largest = 0.0;  // of all stations, as a part of what is allowed
        for (const std::size_t j : stations) {
            if (!search.tells_causes(j)) {
                continue;
            }
            found[j] = search.fit_of(j, false);
            largest = std::max(
                largest, found[j].upright_misfit() / std::min(k_share_with_right_labels * misfits[j], k_good_misfit));
            if (largest > least) {
                break;
            }
        }
        if (largest > 0.0 && largest < least) {
            least = largest;
            wrong = m;
            fits = std::move(found);
        }
    }
    // Three points and their mirror image have the same distances: of four the other sense leaves one that fits nowhere.
    if (!wrong || labels_of_station(measurement, stations.front(), misfits[stations.front()])) {
        return;
    }
    refuse_coordinates(measurement, *wrong, place_of_reflector(measurement, *wrong, stations, fits));
}

void refuse_stray_reflector(const RotaryTableMeasurement& measurement, const std::vector<StationFit>& fits,
                            bool has_no_result) {
    constexpr double k_times_deviation = 20.0;
    constexpr double k_least = 0.05 * gum::k_millimetre;
    constexpr double k_least_way = 0.5 * gum::k_millimetre;  // below it the tests of groups tell it, with its u
    constexpr double k_share_of_stray = 0.3;
    constexpr double k_share_of_others = 0.1;
    const PlaceSearch search(measurement);
    std::vector<std::size_t> strays(measurement.reflectors.size(), 0);  // stations that say so
    std::size_t asked = 0;
    for (std::size_t j = 0; j < fits.size(); ++j) {
        if (!fits[j].is_settled() || !search.tells_causes(j)) {
            continue;
        }
        ++asked;
        // Shares of the distances of each reflector that are off.
        const auto off_at = [&](const StationFit& fit) {
            const Eigen::VectorXd deviation = search.deviations(j, fit).each;
            const double limit = std::max(k_least, k_times_deviation * k_mad_to_deviation * median_size(deviation));
            std::vector<double> off(measurement.reflectors.size(), 0.0);
            std::vector<double> of = off;
            const std::vector<std::size_t>& observation = search.distances(j).observation;
            for (std::size_t k = 0; k < observation.size(); ++k) {
                const std::size_t m = measurement.lengths[observation[k]].reflector;
                of[m] += 1.0;
                off[m] += std::abs(deviation[static_cast<Eigen::Index>(k)]) > limit ? 1.0 : 0.0;
            }
            for (std::size_t m = 0; m < off.size(); ++m) {
                off[m] /= std::max(of[m], 1.0);
            }
            return off;
        };
        const std::vector<double> off = off_at(fits[j]);
        for (std::size_t m = 0; m < off.size(); ++m) {
            bool alone = off[m] > k_share_of_stray;
            for (std::size_t n = 0; n < off.size(); ++n) {
                alone = alone && (n == m || off[n] <= k_share_of_others);
            }
            // A weak layout may have left the right place for one at which most distances agree by chance.
            const auto agrees_at = [&](const StationFit& fit) {
                return fit.is_settled() && off_at(fit)[m] <= k_share_of_others;
            };
            if (alone && std::ranges::none_of(search.plain_fits(j, fits[j]), agrees_at)) {
                ++strays[m];
            }
        }
    }
    const auto most = std::ranges::max_element(strays);
    if (asked < 2 || most == strays.end() || 2 * *most <= asked) {
        return;
    }
    const auto m = static_cast<std::size_t>(most - strays.begin());
    const PlaceSearch without(measurement, lengths_without_reflector(measurement, m));
    std::vector<std::size_t> stations;
    std::vector<StationFit> found = fits;
    for (std::size_t j = 0; j < fits.size(); ++j) {
        found[j] = without.fit_near(j, fits[j]);
        if (found[j].is_settled() && without.tells_causes(j)) {
            stations.push_back(j);
        }
    }
    const std::optional<Eigen::Vector3d> place = place_of_reflector(measurement, m, stations, found);
    // Without one place it is no coordinate but a reflector that moves: the tests of groups name it, where there is a
    // result.
    if (place ? (*place - measurement.fixture.row(static_cast<Eigen::Index>(m)).transpose()).norm() > k_least_way
              : has_no_result) {
        refuse_coordinates(measurement, m, place);
    }
}

}  // namespace gumcert::engine
