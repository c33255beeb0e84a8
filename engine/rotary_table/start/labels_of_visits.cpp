#include "engine/rotary_table/start/labels_of_visits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/degrees_text.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/label_hypothesis.h"
#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/selected_lengths.h"

namespace gumcert::engine {

namespace {

// Of distances that a cause explains in a part of the visits: gross errors may be among them.
constexpr double k_share_of_part = 0.85;

/// Place, set-up and dead paths of a station from some of its visits.
struct PlaceOfVisits {
    StationFit fit;
    std::map<std::size_t, double> dead_paths;
    double limit = 0.0;        ///< within which a distance agrees, [m]
    std::size_t agreeing = 0;  ///< distances of all visits
};
using DeviationOfLength = std::map<std::size_t, double>;  ///< by length

/// |P - q| - l - l0 of the distances of a station whose dead path is known.
DeviationOfLength deviations_at(const RotaryTableMeasurement& measurement, const std::vector<bool>& active,
                                std::size_t station, const PlaceOfVisits& reference) {
    const PlaceSearch search(measurement, active);
    const auto [deviation, centre] = search.deviations(station, reference.fit);
    const StationDistances& data = search.distances(station);
    DeviationOfLength result;
    for (std::size_t k = 0; k < data.observation.size(); ++k) {
        const auto known = reference.dead_paths.find(data.path_name[data.path[k]]);
        if (known != reference.dead_paths.end()) {
            result[data.observation[k]] = deviation[static_cast<Eigen::Index>(k)] +
                                          centre[static_cast<Eigen::Index>(data.path[k])] - known->second;
        }
    }
    return result;
}

/// The visits from which a station fits, and with whose place most of all its distances agree: all, one pass, or the
/// first or last part of them.
std::optional<PlaceOfVisits> reference_of(const RotaryTableMeasurement& measurement, std::size_t station,
                                          const std::vector<Visit>& visits, const StationFit& whole) {
    constexpr double k_times_deviation = 10.0;
    const std::vector<bool> all = lengths_of_station(measurement, station);
    std::vector<std::vector<bool>> parts{all};
    for (std::size_t pass = 0; pass < measurement.passes.size(); ++pass) {
        std::vector<bool> part = lengths_of_station(measurement, station, pass);
        if (std::ranges::find(part, true) != part.end() && part != all) {
            parts.push_back(std::move(part));
        }
    }
    for (const std::size_t share : {std::size_t{2}, std::size_t{3}}) {
        for (const bool first : {true, false}) {
            std::vector<bool> part(measurement.lengths.size(), false);
            for (std::size_t v = 0; v < visits.size(); ++v) {
                const std::size_t from_end = first ? v : visits.size() - 1 - v;
                for (const std::size_t i : visits[v].observations) {
                    part[i] = from_end * share < visits.size();
                }
            }
            parts.push_back(std::move(part));
        }
    }
    std::optional<PlaceOfVisits> best;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const PlaceSearch search(measurement, parts[p]);
        if (!search.tells_causes(station)) {
            continue;
        }
        PlaceOfVisits reference;
        reference.fit = p == 0 ? whole : search.fit_of(station, false);
        if (!reference.fit.is_settled()) {
            continue;
        }
        const auto [deviation, centre] = search.deviations(station, reference.fit);
        const StationDistances& data = search.distances(station);
        for (std::size_t d = 0; d < data.path_name.size(); ++d) {
            if (data.members[d].size() > 2) {
                reference.dead_paths[data.path_name[d]] = centre[static_cast<Eigen::Index>(d)];
            }
        }
        reference.limit = std::max(k_good_misfit, k_times_deviation * k_mad_to_deviation * median_size(deviation));
        const DeviationOfLength of_all = deviations_at(measurement, all, station, reference);
        for (const auto& [length, one] : of_all) {
            if (std::abs(one) < reference.limit) {
                ++reference.agreeing;
            }
        }
        if (p == 0 && reference.agreeing == of_all.size()) {
            return reference;  // nothing is wrong
        }
        if (!best || reference.agreeing > best->agreeing) {
            best = std::move(reference);
        }
    }
    return best;
}

/// The measurement with some distances as the hypothesis reads them. What is said of the fixture is said of them.
RotaryTableMeasurement relabelled_in_part(const RotaryTableMeasurement& measurement,
                                          const std::vector<std::size_t>& part, const LabelHypothesis& hypothesis) {
    RotaryTableMeasurement other = measurement;
    std::map<std::size_t, std::size_t> angles;  // as stated, and as read
    const double home = other.angles[other.home];
    for (const std::size_t i : part) {
        LengthObservation& length = other.lengths[i];
        length.length *= hypothesis.lengths / hypothesis.fixture;
        if (hypothesis.other_sense || hypothesis.angles != 1.0) {
            const auto [read, is_new] = angles.try_emplace(length.angle, other.angles.size());
            if (is_new) {
                const double turned = other.angles[length.angle] - home;
                other.angles.push_back(home + (hypothesis.other_sense ? -turned : hypothesis.angles * turned));
            }
            length.angle = read->second;
        }
    }
    return other;
}

/// Of each reflector of some distances which one it is, where most of them agree with another.
std::map<std::size_t, std::size_t> interchanges(const RotaryTableMeasurement& measurement, std::size_t station,
                                                const PlaceOfVisits& reference, const std::vector<std::size_t>& part) {
    const std::vector<bool> active = lengths_of_station(measurement, station);
    std::map<std::size_t, std::size_t> path_of;  // of a reflector, where its own is known
    std::map<std::size_t, std::pair<double, std::map<std::size_t, std::size_t>>> counts;  // all, and by what they are
    const DeviationOfLength stated = deviations_at(measurement, active, station, reference);
    for (const auto& [i, deviation] : stated) {
        if (std::abs(deviation) < reference.limit) {
            path_of[measurement.lengths[i].reflector] = measurement.lengths[i].dead_path;
        }
    }
    for (const std::size_t i : part) {
        counts[measurement.lengths[i].reflector].first += 1.0;
    }
    for (std::size_t to = 0; to < measurement.reflectors.size(); ++to) {
        std::vector<std::size_t> agreeing;
        for (const bool with_path : {false, true}) {
            if (with_path && !path_of.contains(to)) {
                continue;
            }
            RotaryTableMeasurement other = measurement;
            for (const std::size_t i : part) {
                other.lengths[i].reflector = to;
                // The name of a dead path may go with that of its reflector.
                other.lengths[i].dead_path = with_path ? path_of.at(to) : other.lengths[i].dead_path;
            }
            const DeviationOfLength deviations = deviations_at(other, active, station, reference);
            for (const std::size_t i : part) {
                const auto one = deviations.find(i);
                if (one != deviations.end() && std::abs(one->second) < reference.limit &&
                    std::ranges::find(agreeing, i) == agreeing.end()) {
                    agreeing.push_back(i);
                }
            }
        }
        for (const std::size_t i : agreeing) {
            ++counts[measurement.lengths[i].reflector].second[to];
        }
    }
    std::map<std::size_t, std::size_t> result;
    for (const auto& [from, count] : counts) {
        for (const auto& [to, agreeing] : count.second) {
            if (to != from && static_cast<double>(agreeing) > k_share_of_part * count.first) {
                result[from] = to;
            }
        }
    }
    return result;
}

/// Of reflectors whose names are exchanged among each other.
gum::Diagnostic interchanged(const RotaryTableMeasurement& measurement, const std::map<std::size_t, std::size_t>& to) {
    std::string names;
    std::string others;
    std::size_t k = 0;
    for (const auto& [from, reflector] : to) {
        ++k;
        const std::string before = k == 1 ? "" : (k == to.size() ? " and " : ", ");
        names += before + measurement.reflectors[from];
        others += before + measurement.reflectors[reflector];
    }
    return {
        "GC-ADJUST-0013",
        "",
        "the distances agree when the reflectors " + names + (to.size() == 2 ? " are interchanged" : " are " + others),
        "a reflector has the same name in the lengths and in the coordinates of the fixture",
        to.size() == 2 ? "interchange the names in the lengths of this station"
                       : "correct the names in the lengths of this station",
        gum::Severity::error};
}

}  // namespace

std::optional<gum::Diagnostic> labels_of_visits(const RotaryTableMeasurement& measurement, std::size_t station,
                                                const StationFit& whole) {
    constexpr std::size_t k_fewest_visits = 2;
    constexpr std::size_t k_fewest_of_visit = 2;
    constexpr double k_times_limit = 5.0;  // a distance that is off by this much is wrong, and not a little off
    const std::vector<bool> active = lengths_of_station(measurement, station);
    const std::vector<Visit> visits = visits_of(measurement, active);
    const std::optional<PlaceOfVisits> reference = reference_of(measurement, station, visits, whole);
    if (!reference) {
        return std::nullopt;
    }
    const DeviationOfLength stated = deviations_at(measurement, active, station, *reference);
    std::vector<std::size_t> wrong_visits;
    std::vector<std::size_t> wrong;  // distances that are off
    std::vector<std::size_t> all;    // of these visits
    for (std::size_t v = 0; v < visits.size(); ++v) {
        std::vector<std::size_t> off;
        for (const std::size_t i : visits[v].observations) {
            const auto one = stated.find(i);
            if (one != stated.end() && std::abs(one->second) > k_times_limit * reference->limit) {
                off.push_back(i);
            }
        }
        if (off.size() >= k_fewest_of_visit) {
            wrong_visits.push_back(v);
            wrong.insert(wrong.end(), off.begin(), off.end());
            all.insert(all.end(), visits[v].observations.begin(), visits[v].observations.end());
        }
    }
    if (wrong_visits.size() < k_fewest_visits) {
        return std::nullopt;
    }
    const Visit& first = visits[wrong_visits.front()];
    const Visit& last = visits[wrong_visits.back()];
    const auto told = [&](gum::Diagnostic problem) {
        problem.where = "lengths, station " + measurement.stations[station] + ", pass " +
                        measurement.passes[first.pass] + ", " + degrees_text(measurement.angles_deg[first.angle]);
        problem.what = "at " + std::to_string(wrong_visits.size()) + " of the " + std::to_string(visits.size()) +
                       " visits of the station, this one the first and pass " + measurement.passes[last.pass] + ", " +
                       degrees_text(measurement.angles_deg[last.angle]) + " the last, " + problem.what;
        problem.action += ", at these visits";
        return problem;
    };
    if (const std::map<std::size_t, std::size_t> to = interchanges(measurement, station, *reference, wrong);
        !to.empty()) {
        std::map<std::size_t, std::size_t> back;
        for (const auto& [from, reflector] : to) {
            back[reflector] = from;
        }
        const bool closed = back.size() == to.size() &&
                            std::ranges::all_of(back, [&](const auto& one) { return to.contains(one.first); });
        const auto explained =
            std::ranges::count_if(wrong, [&](std::size_t i) { return to.contains(measurement.lengths[i].reflector); });
        if (closed && static_cast<double>(explained) > k_share_of_part * static_cast<double>(wrong.size())) {
            return told(interchanged(measurement, to));
        }
    }
    std::optional<LabelHypothesis> best;
    double most = k_share_of_part;
    for (const LabelHypothesis& hypothesis : label_hypotheses(measurement)) {
        if (hypothesis.axis || hypothesis.first != hypothesis.second) {
            continue;
        }
        const DeviationOfLength read =
            deviations_at(relabelled_in_part(measurement, all, hypothesis), active, station, *reference);
        const auto agreeing = std::ranges::count_if(all, [&](std::size_t i) {
            const auto one = read.find(i);
            return one != read.end() && std::abs(one->second) < reference->limit;
        });
        const double share = static_cast<double>(agreeing) / static_cast<double>(all.size());
        if (share > most) {
            most = share;
            best = hypothesis;
        }
    }
    if (!best) {
        return std::nullopt;
    }
    return told(wrong_labels(measurement, *best, measurement.stations[station]));
}

}  // namespace gumcert::engine
