#include "engine/rotary_table/start/interrupted_beams.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/degrees_text.h"
#include "engine/median.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/place_search.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

/// Where the beam of a station was interrupted.
struct Interruption {
    std::size_t first = 0;                                  ///< length after it, of the measurement
    double size = 0.0;                                      ///< [m]
    double left = std::numeric_limits<double>::infinity();  ///< mean absolute deviation with it, [m]
};

// Every candidate is fitted anew. Steps of the medians of visits at one set of start values were tried, and are fooled
// by start values that the step itself has moved (ADR 0031).
class InterruptionSearch {
public:
    explicit InterruptionSearch(const RotaryTableMeasurement& measurement)
        : split_(measurement), declared_(measurement.dead_paths.size()) {}

    /// The interruption of a station that leaves least of its deviations, where that is little enough.
    [[nodiscard]] std::optional<Interruption> of_station(std::size_t station) {
        constexpr double k_smallest = 0.1 * gum::k_millimetre;
        constexpr double k_share_left = 0.2;
        active_.clear();
        std::map<std::size_t, std::vector<std::vector<std::size_t>>> by_path;  // visits of each, in their order
        std::map<std::pair<std::size_t, std::size_t>, std::pair<std::size_t, std::size_t>> places;
        for (std::size_t i = 0; i < split_.lengths.size(); ++i) {
            const LengthObservation& length = split_.lengths[i];
            active_.push_back(length.station == station);
            if (active_.back()) {
                const auto [place, is_new] = places.try_emplace({length.pass, length.angle}, length.dead_path, 0);
                auto& visits = by_path[place->second.first];
                if (is_new) {
                    place->second.second = visits.size();
                    visits.emplace_back();
                }
                visits[place->second.second].push_back(i);
            }
        }
        const double before = deviation(station, {}).left;
        Interruption best;
        for (const auto& [path, visits] : by_path) {
            const Interruption found = best_of(station, visits);
            if (found.left < best.left) {
                best = found;
            }
        }
        // A fifth or less of what it was (ADR 0031): an additional dead path alone takes up some of any misfit. And next
        // to nothing: where distances in inch begin a jump of a metre leaves a fifth as well.
        if (best.left < std::min(k_share_left * before, k_wrong_labels) && std::abs(best.size) > k_smallest) {
            return best;
        }
        return std::nullopt;
    }

private:
    /// Every visit of a short sequence; of a long one equal steps first, and then the neighbours of the best.
    Interruption best_of(std::size_t station, const std::vector<std::vector<std::size_t>>& visits) {
        constexpr std::size_t k_steps = 24;
        constexpr std::size_t k_fewest = 2;  // on either side: of one visit it is that visit
        if (visits.size() < 2 * k_fewest) {
            return {};
        }
        std::size_t from = k_fewest;
        std::size_t to = visits.size() - k_fewest;
        Interruption best;
        for (std::size_t step = (to - from) / k_steps + 1; step > 0; step = step == 1 ? 0 : step / k_steps + 1) {
            std::size_t place = from;
            for (std::size_t k = from; k <= to; k += step) {
                const Interruption found = interrupted_at(station, visits, k);
                if (found.left < best.left) {
                    best = found;
                    place = k;
                }
            }
            from = std::max(k_fewest, place - std::min(place, step));
            to = std::min(visits.size() - k_fewest, place + step);
        }
        return best;
    }

    Interruption interrupted_at(std::size_t station, const std::vector<std::vector<std::size_t>>& visits,
                                std::size_t first) {
        std::vector<std::pair<std::size_t, std::size_t>> before;  // length and its dead path
        // Each dead path that is met goes on as one of its own: a station may have one for each reflector, and an
        // interrupted beam moves all of them.
        SplitPaths split;
        for (std::size_t k = first; k < visits.size(); ++k) {
            for (const std::size_t i : visits[k]) {
                std::size_t& path = split_.lengths[i].dead_path;
                before.emplace_back(i, path);
                const auto [own, is_new] = split.try_emplace(path, declared_ + split.size());
                if (is_new && own->second == split_.dead_paths.size()) {
                    split_.dead_paths.emplace_back();
                }
                path = own->second;
            }
        }
        Interruption found = deviation(station, split);
        found.first = visits[first].front();
        for (const auto& [i, path] : before) {
            split_.lengths[i].dead_path = path;
        }
        return found;
    }

    using SplitPaths = std::map<std::size_t, std::size_t>;  // as declared, and what it is from an interruption on

    /// What a fit of the station leaves, and by how much the dead paths that were split go on differently: the median.
    [[nodiscard]] Interruption deviation(std::size_t station, const SplitPaths& split) const {
        const PlaceSearch search(split_, active_);
        Interruption result;
        // What a few distances beyond the unknowns leave is next to nothing with any further dead path.
        if (!split.empty() && !search.tells_causes(station)) {
            return result;
        }
        const StationFit fit = search.fit_of(station, split.empty());
        const auto [deviations, centres] = search.deviations(station, fit);
        // The mean of all deviations. The misfit leaves out the largest ones, which are just those of an interrupted
        // beam.
        result.left = deviations.cwiseAbs().mean();
        const std::vector<std::size_t>& names = search.distances(station).path_name;
        const auto place_of = [&](std::size_t path) {
            return static_cast<std::size_t>(std::ranges::find(names, path) - names.begin());
        };
        std::vector<double> steps;
        for (const auto& [declared, own] : split) {
            const std::size_t a = place_of(declared);
            const std::size_t b = place_of(own);
            if (a < names.size() && b < names.size()) {  // a path that begins after the interruption tells nothing
                steps.push_back(centres[static_cast<Eigen::Index>(a)] - centres[static_cast<Eigen::Index>(b)]);
            }
        }
        result.size = steps.empty() ? 0.0 : median(steps);
        return result;
    }

    RotaryTableMeasurement split_;
    std::size_t declared_;  // dead paths of the measurement; those behind are split off
    std::vector<bool> active_;
};

}  // namespace

void refuse_interrupted_beams(const RotaryTableMeasurement& measurement) {
    std::vector<gum::Diagnostic> problems;
    InterruptionSearch search(measurement);
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        const std::optional<Interruption> found = search.of_station(j);
        if (!found) {
            continue;
        }
        const LengthObservation& length = measurement.lengths[found->first];
        problems.push_back({"GC-ADJUST-0014",
                            "station " + measurement.stations[j] + ", pass " + measurement.passes[length.pass] + ", " +
                                degrees_text(measurement.angles_deg[length.angle]),
                            "from this visit on all distances of the station are off by about " +
                                text::fixed(std::abs(found->size) / gum::k_micrometre, 0) + " µm alike",
                            "distances of one dead path have one constant",
                            "the beam was interrupted there: give the distances from there on a dead path of their own",
                            gum::Severity::error});
    }
    if (!problems.empty()) {
        throw gum::NoResultError(std::move(problems));
    }
}

}  // namespace gumcert::engine
