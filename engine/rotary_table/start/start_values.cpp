#include "engine/rotary_table/start/start_values.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/degrees_text.h"
#include "engine/median.h"
#include "engine/rotary_table/start/common_set_up.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/no_rigid_table.h"
#include "engine/rotary_table/start/open_places.h"
#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/shifted_angles.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/golden_section.h"
#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

// A station that fits this much worse than its neighbours is not what error motions of their table leave; and what no
// error motion of a sound one is.
constexpr double k_worse_than_others = 10.0;
constexpr double k_least_suspicious = 0.02 * gum::k_millimetre;
// And what no wrong label leaves less of: where a station fits better, a layout that determines nothing fits other labels, too.
constexpr double k_least_of_labels = 0.005 * gum::k_millimetre;
// Of distances that a cause explains in a part of the visits: gross errors may be among them.
constexpr double k_share_of_part = 0.85;

// ---- wrong labels ---------------------------------------------------------------------------------------------------

/// What the file may say wrongly of the distances of one station.
struct LabelHypothesis {
    bool other_sense = false;             ///< the table turned the other way
    std::size_t first = 0, second = 0;    ///< reflectors that are interchanged; equal: none
    double lengths = 1.0;                 ///< by which the distances are multiplied
    bool scale = false;                   ///< that factor was looked for, and is none of a list
    double fixture = 1.0;                 ///< the coordinates of the fixture
    double angles = 1.0;                  ///< the angles, from the home angle on
    std::optional<RotaryAxis> axis = {};  ///< about which the table turned
    friend bool operator==(const LabelHypothesis&, const LabelHypothesis&) = default;
};

/// The measurement with the distances of one station as the hypothesis reads them.
RotaryTableMeasurement relabelled(RotaryTableMeasurement measurement, std::size_t station,
                                  const LabelHypothesis& hypothesis) {
    for (LengthObservation& length : measurement.lengths) {
        if (length.station != station) {
            continue;
        }
        if (length.reflector == hypothesis.first) {
            length.reflector = hypothesis.second;
        } else if (length.reflector == hypothesis.second) {
            length.reflector = hypothesis.first;
        }
    }
    if (hypothesis.other_sense) {
        const double home = measurement.angles[measurement.home];
        for (double& angle : measurement.angles) {
            // About the home angle, where the fixture stands in its frame.
            angle = 2.0 * home - angle;
        }
    }
    measurement.axis = hypothesis.axis.value_or(measurement.axis);
    if (hypothesis.angles != 1.0) {
        const double home = measurement.angles[measurement.home];
        for (double& angle : measurement.angles) {
            angle = home + hypothesis.angles * (angle - home);
        }
    }
    if (hypothesis.lengths != 1.0) {
        for (LengthObservation& length : measurement.lengths) {
            length.length *= hypothesis.lengths;
        }
    }
    measurement.fixture *= hypothesis.fixture;
    return measurement;
}

class LabelSearch {
public:
    explicit LabelSearch(const RotaryTableMeasurement& measurement) : measurement_(measurement) {
        hypotheses_.push_back({.other_sense = true});
        // A sign, a path that is counted twice or halved; units of length; gon for degrees, ten steps for fifteen. Only a
        // ratio of lengths and fixture can be told: which of them is wrong the message leaves open.
        for (const double factor : {-1.0, 2.0, 0.5}) {
            hypotheses_.push_back({.lengths = factor});
        }
        for (const double factor : {25.4, 1.0 / 25.4, 10.0, 0.1, 1000.0, 0.001}) {
            hypotheses_.push_back({.fixture = factor});
        }
        for (const double factor : {0.9, 1.0 / 0.9, 1.5, 1.0 / 1.5, 2.0, 0.5}) {
            hypotheses_.push_back({.angles = factor});
        }
        for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
            if (axis != measurement.axis) {
                hypotheses_.push_back({.axis = axis});
            }
        }
        for (std::size_t a = 0; a < measurement.reflectors.size(); ++a) {
            for (std::size_t b = a + 1; b < measurement.reflectors.size(); ++b) {
                hypotheses_.push_back({.first = a, .second = b});
            }
        }
    }

    /// Whether a station fits its distances worse than error motions let any fit. The table is the same for all: what
    /// one of them leaves beyond ten times the median of all is no motion of it.
    /// \param limit  [m], of any table
    [[nodiscard]] static bool is_suspicious(double misfit, std::vector<double> misfits, double limit = k_good_misfit) {
        return misfit > limit || (misfit > k_least_suspicious && misfit > k_worse_than_others * median(misfits));
    }

    enum class Asked { suspicious, all };
    /// \param fits  of the stations, each on its own
    /// \param asked  all: of a measurement that has no result, for which lengths in another unit may fit a false place
    void refuse(std::vector<StationFit> fits, Asked asked) const {
        std::vector<double> misfits;
        for (const StationFit& fit : fits) {
            misfits.push_back(fit.upright_misfit());
        }
        for (std::size_t j = 0; j < misfits.size(); ++j) {
            if (fits[j].is_settled() && is_suspicious(misfits[j], misfits)) {
                // The search ended at what error motions may leave: with neighbours that leave far less it goes on.
                fits[j] = PlaceSearch(measurement_, of_station(j, std::nullopt)).fit_from_all_sides(j, fits[j]);
                misfits[j] = fits[j].upright_misfit();
            }
        }
        // One reflector that all stations disagree with is asked for first: it costs least.
        std::vector<std::size_t> open;
        for (std::size_t j = 0; j < misfits.size(); ++j) {
            if (is_suspicious(misfits[j], misfits)) {
                open.push_back(j);
            }
        }
        if (open.size() > 1 && 2 * open.size() > misfits.size()) {
            refuse_wrong_coordinates(open, misfits);
        }
        open.clear();
        std::vector<std::optional<LabelHypothesis>> causes(misfits.size());
        std::vector<gum::Diagnostic> problems;
        std::optional<LabelHypothesis> known;  // what one station has is likely what all have
        // All labels take a while: a rough table, whose stations are all alike, has a result and does not wait for them.
        const double limit = asked == Asked::all ? k_good_misfit : k_wrong_labels;
        for (std::size_t j = 0; j < misfits.size(); ++j) {
            const bool suspicious = is_suspicious(misfits[j], misfits, limit);
            if (suspicious || (asked == Asked::all && misfits[j] > k_least_of_labels)) {
                causes[j] = cause_of(j, misfits[j], known);
                if (!causes[j] && suspicious) {
                    causes[j] = scale_of(j, fits[j]);
                }
                // Labels of some visits are right, where they are: an interchange of two concerns few distances of the others.
                const bool of_some = causes[j] && causes[j]->first != causes[j]->second;
                if (std::optional<gum::Diagnostic> part = of_some ? cause_of_part(j, fits[j]) : std::nullopt) {
                    causes[j].reset();
                    problems.push_back(std::move(*part));
                    continue;
                }
                if (causes[j]) {
                    known = causes[j];
                    continue;
                }
            }
            // Distances that are wrong at some visits leave the station where it is, or take it along.
            if (std::optional<gum::Diagnostic> part = cause_of_part(j, fits[j])) {
                problems.push_back(std::move(*part));
            } else if (suspicious) {
                open.push_back(j);
            }
        }
        if (problems.empty() && std::ranges::none_of(causes, [](const auto& cause) { return cause.has_value(); })) {
            refuse_stray_reflector(fits, asked == Asked::all);
        }
        for (const std::size_t j : open) {
            refuse_two_places(j, misfits[j]);
        }
        const bool common =
            causes[0] && std::ranges::all_of(causes, [&](const auto& cause) { return cause == causes[0]; });
        for (std::size_t j = 0; j < causes.size() && !(common && j > 0); ++j) {
            if (causes[j]) {
                problems.push_back(diagnostic(*causes[j], common ? "" : measurement_.stations[j]));
            }
        }
        if (!problems.empty()) {
            throw gum::NoResultError(std::move(problems));
        }
    }

private:
    /// What the hypothesis leaves of the distances as they were stated: half of all lengths leaves half of any misfit.
    [[nodiscard]] double misfit_with(const LabelHypothesis& hypothesis, std::size_t station,
                                     const std::vector<bool>& active, bool closely) const {
        const RotaryTableMeasurement other = relabelled(measurement_, station, hypothesis);
        const double left =
            PlaceSearch(other, active).fit_of(station, closely).upright_misfit() / std::abs(hypothesis.lengths);
        if (hypothesis.fixture == 1.0) {
            return left;
        }
        // Only the ratio counts, but a place is looked for at distances that stations have: whether it is the fixture that
        // has its size or the lengths is not known.
        return std::min(left, misfit_with({.lengths = 1.0 / hypothesis.fixture}, station, active, closely));
    }

    /// The hypothesis with the smallest misfit, where that is small enough.
    /// \param known  is tried first, and is it where it leaves what a right one does
    [[nodiscard]] std::optional<LabelHypothesis> cause_of(std::size_t station, double misfit,
                                                          const std::optional<LabelHypothesis>& known) const {
        const std::vector<bool> active = of_station(station, std::nullopt);
        if (!PlaceSearch(measurement_, active).tells_causes(station)) {
            return std::nullopt;
        }
        // A wrong guess of labels lowers the misfit by chance, and that of a station that fits very badly a good deal. The
        // right one removes nearly all of it, and leaves what error motions do.
        double least = std::min(k_share_with_right_labels * misfit, k_good_misfit);
        if (known && misfit_with(*known, station, active, true) < least) {
            return known;
        }
        // Some visits tell the labels of all: the time does not grow with the measurement.
        const std::vector<bool> some = some_visits(active);
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t k = 0; k < hypotheses_.size(); ++k) {
            order.emplace_back(misfit_with(hypotheses_[k], station, some, false), k);
        }
        std::ranges::sort(order);
        std::optional<LabelHypothesis> best;
        constexpr std::size_t k_looked_at_closely = 3;
        for (std::size_t k = 0; k < std::min(k_looked_at_closely, order.size()) && order[k].first < least; ++k) {
            const LabelHypothesis& hypothesis = hypotheses_[order[k].second];
            const double reached = some == active ? order[k].first : misfit_with(hypothesis, station, active, true);
            if (reached < least) {
                least = reached;
                best = hypothesis;
            }
        }
        return best;
    }

    /// The factor on the distances of a station that makes its misfit vanish.
    [[nodiscard]] std::optional<LabelHypothesis> scale_of(std::size_t station, const StationFit& fit) const {
        constexpr double k_most = 1.25;
        constexpr double k_least = 5e-4;  // below it the tests of groups tell it, and what it is beside its u
        constexpr int k_steps = 40;       // of a golden section: to 2e-9 of the factor
        const std::vector<bool> active = of_station(station, std::nullopt);
        if (!PlaceSearch(measurement_, active).tells_causes(station)) {
            return std::nullopt;
        }
        const double misfit = fit.upright_misfit();
        const std::vector<bool> some = some_visits(active);
        StationFit best = fit;
        const auto misfit_at = [&](double logarithm) {
            const LabelHypothesis hypothesis{.lengths = std::exp(logarithm), .scale = true};
            const RotaryTableMeasurement other = relabelled(measurement_, station, hypothesis);
            const StationFit found = PlaceSearch(other, some).fit_near(station, best);
            if (found.upright_misfit() < best.upright_misfit()) {
                best = found;
            }
            return found.upright_misfit();
        };
        // What is left grows with the distance of the factor from the right one, on both sides.
        const double logarithm = gum::least_by_golden_section(misfit_at, -std::log(k_most), std::log(k_most), k_steps);
        const LabelHypothesis found{.lengths = std::exp(logarithm), .scale = true};
        if (std::abs(found.lengths - 1.0) > k_least &&
            misfit_with(found, station, active, true) < std::min(k_share_with_right_labels * misfit, k_good_misfit)) {
            return found;
        }
        return std::nullopt;
    }

    // ---- in a part of the visits ----

    struct StationVisit {
        std::size_t pass = 0, angle = 0;
        std::vector<std::size_t> lengths;
    };
    [[nodiscard]] std::vector<StationVisit> visits_of(std::size_t station) const {
        std::vector<StationVisit> visits;
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> places;
        for (std::size_t i = 0; i < measurement_.lengths.size(); ++i) {
            const LengthObservation& length = measurement_.lengths[i];
            if (length.station == station) {
                const auto [place, is_new] = places.try_emplace({length.pass, length.angle}, visits.size());
                if (is_new) {
                    visits.push_back({length.pass, length.angle, {}});
                }
                visits[place->second].lengths.push_back(i);
            }
        }
        return visits;
    }

    /// Place, set-up and dead paths of a station from some of its visits.
    struct Reference {
        StationFit fit;
        std::map<std::size_t, double> dead_paths;
        double limit = 0.0;        ///< within which a distance agrees, [m]
        std::size_t agreeing = 0;  ///< distances of all visits
    };
    using Deviations = std::map<std::size_t, double>;  ///< by length

    /// |P - q| - l - l0 of the distances of a station whose dead path is known.
    [[nodiscard]] static Deviations deviations_at(const RotaryTableMeasurement& measurement,
                                                  const std::vector<bool>& active, std::size_t station,
                                                  const Reference& reference) {
        const PlaceSearch search(measurement, active);
        const auto [deviation, centre] = search.deviations(station, reference.fit);
        const StationDistances& data = search.distances(station);
        Deviations result;
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
    [[nodiscard]] std::optional<Reference> reference_of(std::size_t station, const std::vector<StationVisit>& visits,
                                                        const StationFit& whole) const {
        constexpr double k_times_deviation = 10.0;
        const std::vector<bool> all = of_station(station, std::nullopt);
        std::vector<std::vector<bool>> parts{all};
        for (std::size_t pass = 0; pass < measurement_.passes.size(); ++pass) {
            std::vector<bool> part = of_station(station, pass);
            if (std::ranges::find(part, true) != part.end() && part != all) {
                parts.push_back(std::move(part));
            }
        }
        for (const std::size_t share : {std::size_t{2}, std::size_t{3}}) {
            for (const bool first : {true, false}) {
                std::vector<bool> part(measurement_.lengths.size(), false);
                for (std::size_t v = 0; v < visits.size(); ++v) {
                    const std::size_t from_end = first ? v : visits.size() - 1 - v;
                    for (const std::size_t i : visits[v].lengths) {
                        part[i] = from_end * share < visits.size();
                    }
                }
                parts.push_back(std::move(part));
            }
        }
        std::optional<Reference> best;
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const PlaceSearch search(measurement_, parts[p]);
            if (!search.tells_causes(station)) {
                continue;
            }
            Reference reference;
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
            std::vector<double> sizes;
            for (const double one : deviation) {
                sizes.push_back(std::abs(one));
            }
            reference.limit = std::max(k_good_misfit, k_times_deviation * k_mad_to_deviation * median(sizes));
            const Deviations of_all = deviations_at(measurement_, all, station, reference);
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
    [[nodiscard]] RotaryTableMeasurement relabelled_in_part(const std::vector<std::size_t>& part,
                                                            const LabelHypothesis& hypothesis) const {
        RotaryTableMeasurement other = measurement_;
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
    [[nodiscard]] std::map<std::size_t, std::size_t> interchanges(std::size_t station, const Reference& reference,
                                                                  const std::vector<std::size_t>& part) const {
        const std::vector<bool> active = of_station(station, std::nullopt);
        std::map<std::size_t, std::size_t> path_of;  // of a reflector, where its own is known
        std::map<std::size_t, std::pair<double, std::map<std::size_t, std::size_t>>>
            counts;  // all, and by what they are
        const Deviations stated = deviations_at(measurement_, active, station, reference);
        for (const auto& [i, deviation] : stated) {
            if (std::abs(deviation) < reference.limit) {
                path_of[measurement_.lengths[i].reflector] = measurement_.lengths[i].dead_path;
            }
        }
        for (const std::size_t i : part) {
            counts[measurement_.lengths[i].reflector].first += 1.0;
        }
        for (std::size_t to = 0; to < measurement_.reflectors.size(); ++to) {
            std::vector<std::size_t> agreeing;
            for (const bool with_path : {false, true}) {
                if (with_path && !path_of.contains(to)) {
                    continue;
                }
                RotaryTableMeasurement other = measurement_;
                for (const std::size_t i : part) {
                    other.lengths[i].reflector = to;
                    // The name of a dead path may go with that of its reflector.
                    other.lengths[i].dead_path = with_path ? path_of.at(to) : other.lengths[i].dead_path;
                }
                const Deviations deviations = deviations_at(other, active, station, reference);
                for (const std::size_t i : part) {
                    const auto one = deviations.find(i);
                    if (one != deviations.end() && std::abs(one->second) < reference.limit &&
                        std::ranges::find(agreeing, i) == agreeing.end()) {
                        agreeing.push_back(i);
                    }
                }
            }
            for (const std::size_t i : agreeing) {
                ++counts[measurement_.lengths[i].reflector].second[to];
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

    /// What is wrong with the labels of some visits of a station: the others tell its place.
    [[nodiscard]] std::optional<gum::Diagnostic> cause_of_part(std::size_t station, const StationFit& whole) const {
        constexpr std::size_t k_fewest_visits = 2;
        constexpr std::size_t k_fewest_of_visit = 2;
        constexpr double k_times_limit = 5.0;  // a distance that is off by this much is wrong, and not a little off
        const std::vector<StationVisit> visits = visits_of(station);
        const std::optional<Reference> reference = reference_of(station, visits, whole);
        if (!reference) {
            return std::nullopt;
        }
        const std::vector<bool> active = of_station(station, std::nullopt);
        const Deviations stated = deviations_at(measurement_, active, station, *reference);
        std::vector<std::size_t> wrong_visits;
        std::vector<std::size_t> wrong;  // distances that are off
        std::vector<std::size_t> all;    // of these visits
        for (std::size_t v = 0; v < visits.size(); ++v) {
            std::vector<std::size_t> off;
            for (const std::size_t i : visits[v].lengths) {
                const auto one = stated.find(i);
                if (one != stated.end() && std::abs(one->second) > k_times_limit * reference->limit) {
                    off.push_back(i);
                }
            }
            if (off.size() >= k_fewest_of_visit) {
                wrong_visits.push_back(v);
                wrong.insert(wrong.end(), off.begin(), off.end());
                all.insert(all.end(), visits[v].lengths.begin(), visits[v].lengths.end());
            }
        }
        if (wrong_visits.size() < k_fewest_visits) {
            return std::nullopt;
        }
        const StationVisit& first = visits[wrong_visits.front()];
        const StationVisit& last = visits[wrong_visits.back()];
        const auto told = [&](gum::Diagnostic problem) {
            problem.where = "lengths, station " + measurement_.stations[station] + ", pass " +
                            measurement_.passes[first.pass] + ", " + degrees_text(measurement_.angles_deg[first.angle]);
            problem.what = "at " + std::to_string(wrong_visits.size()) + " of the " + std::to_string(visits.size()) +
                           " visits of the station, this one the first and pass " + measurement_.passes[last.pass] +
                           ", " + degrees_text(measurement_.angles_deg[last.angle]) + " the last, " + problem.what;
            problem.action += ", at these visits";
            return problem;
        };
        if (const std::map<std::size_t, std::size_t> to = interchanges(station, *reference, wrong); !to.empty()) {
            std::map<std::size_t, std::size_t> back;
            for (const auto& [from, reflector] : to) {
                back[reflector] = from;
            }
            const bool closed = back.size() == to.size() &&
                                std::ranges::all_of(back, [&](const auto& one) { return to.contains(one.first); });
            const auto explained = std::ranges::count_if(
                wrong, [&](std::size_t i) { return to.contains(measurement_.lengths[i].reflector); });
            if (closed && static_cast<double>(explained) > k_share_of_part * static_cast<double>(wrong.size())) {
                return told(interchanged(to));
            }
        }
        std::optional<LabelHypothesis> best;
        double most = k_share_of_part;
        for (const LabelHypothesis& hypothesis : hypotheses_) {
            if (hypothesis.axis || hypothesis.first != hypothesis.second) {
                continue;
            }
            const Deviations read = deviations_at(relabelled_in_part(all, hypothesis), active, station, *reference);
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
        return told(diagnostic(*best, measurement_.stations[station]));
    }

    /// Of reflectors whose names are exchanged among each other.
    [[nodiscard]] gum::Diagnostic interchanged(const std::map<std::size_t, std::size_t>& to) const {
        std::string names;
        std::string others;
        std::size_t k = 0;
        for (const auto& [from, reflector] : to) {
            ++k;
            const std::string before = k == 1 ? "" : (k == to.size() ? " and " : ", ");
            names += before + measurement_.reflectors[from];
            others += before + measurement_.reflectors[reflector];
        }
        return {"GC-ADJUST-0013",
                "",
                "the distances agree when the reflectors " + names +
                    (to.size() == 2 ? " are interchanged" : " are " + others),
                "a reflector has the same name in the lengths and in the coordinates of the fixture",
                to.size() == 2 ? "interchange the names in the lengths of this station"
                               : "correct the names in the lengths of this station",
                gum::Severity::error};
    }

    // ---- a coordinate of the fixture ----

    /// The reflector without which the distances of all stations that fit no place fit one: its coordinates are wrong.
    void refuse_wrong_coordinates(const std::vector<std::size_t>& stations, const std::vector<double>& misfits) const {
        constexpr std::size_t k_fewest_reflectors = 4;  // three that are left make a frame
        if (measurement_.reflectors.size() < k_fewest_reflectors) {
            return;
        }
        std::optional<std::size_t> wrong;
        std::vector<StationFit> fits(measurement_.stations.size());
        double least = 1.0;
        for (std::size_t m = 0; m < measurement_.reflectors.size(); ++m) {
            std::vector<bool> others;
            for (const LengthObservation& length : measurement_.lengths) {
                others.push_back(length.reflector != m);
            }
            const PlaceSearch search(measurement_, others);
            std::vector<StationFit> found(measurement_.stations.size());
            double largest = 0.0;  // of all stations, as a part of what is allowed
            for (const std::size_t j : stations) {
                if (!search.tells_causes(j)) {
                    continue;
                }
                found[j] = search.fit_of(j, false);
                largest = std::max(largest, found[j].upright_misfit() /
                                                std::min(k_share_with_right_labels * misfits[j], k_good_misfit));
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
        if (!wrong || cause_of(stations.front(), misfits[stations.front()], std::nullopt)) {
            return;
        }
        refuse_coordinates(*wrong, place_of_reflector(*wrong, stations, fits));
    }
    /// One reflector of many, which most distances agree without: the places of the stations are right, and it strays alone.
    void refuse_stray_reflector(const std::vector<StationFit>& fits, bool has_no_result) const {
        constexpr double k_times_deviation = 20.0;
        constexpr double k_least = 0.05 * gum::k_millimetre;
        constexpr double k_least_way = 0.5 * gum::k_millimetre;  // below it the tests of groups tell it, with its u
        constexpr double k_share_of_stray = 0.3;
        constexpr double k_share_of_others = 0.1;
        const std::vector<bool> all(measurement_.lengths.size(), true);
        const PlaceSearch search(measurement_, all);
        std::vector<std::size_t> strays(measurement_.reflectors.size(), 0);  // stations that say so
        std::size_t asked = 0;
        for (std::size_t j = 0; j < fits.size(); ++j) {
            if (!fits[j].is_settled() || !search.tells_causes(j)) {
                continue;
            }
            ++asked;
            // Shares of the distances of each reflector that are off.
            const auto off_at = [&](const StationFit& fit) {
                const Eigen::VectorXd deviation = search.deviations(j, fit).each;
                std::vector<double> sizes;
                for (const double one : deviation) {
                    sizes.push_back(std::abs(one));
                }
                const double limit = std::max(k_least, k_times_deviation * k_mad_to_deviation * median(sizes));
                std::vector<double> off(measurement_.reflectors.size(), 0.0);
                std::vector<double> of = off;
                for (std::size_t k = 0; k < search.distances(j).observation.size(); ++k) {
                    const std::size_t m = measurement_.lengths[search.distances(j).observation[k]].reflector;
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
        std::vector<bool> others;
        for (const LengthObservation& length : measurement_.lengths) {
            others.push_back(length.reflector != m);
        }
        const PlaceSearch without(measurement_, others);
        std::vector<std::size_t> stations;
        std::vector<StationFit> found = fits;
        for (std::size_t j = 0; j < fits.size(); ++j) {
            found[j] = without.fit_near(j, fits[j]);
            if (found[j].is_settled() && without.tells_causes(j)) {
                stations.push_back(j);
            }
        }
        const std::optional<Eigen::Vector3d> place = place_of_reflector(m, stations, found);
        // Without one place it is no coordinate but a reflector that moves: the tests of groups name it, where there is a
        // result.
        if (place ? (*place - measurement_.fixture.row(static_cast<Eigen::Index>(m)).transpose()).norm() > k_least_way
                  : has_no_result) {
            refuse_coordinates(m, place);
        }
    }
    [[noreturn]] void refuse_coordinates(std::size_t m, const std::optional<Eigen::Vector3d>& place) const {
        std::string what = "the distances of the stations agree when this reflector is left out";
        if (place) {
            const Eigen::Vector3d way = *place - measurement_.fixture.row(static_cast<Eigen::Index>(m)).transpose();
            what = "the distances put it near (" + coordinate(place->x()) + ", " + coordinate(place->y()) + ", " +
                   coordinate(place->z()) + ") mm in the fixture, " + coordinate(way.norm()) +
                   " mm away from its stated coordinates";
        }
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0013", "fixture, reflector " + measurement_.reflectors[m], what,
            "a reflector stands in the fixture where its coordinates say",
            "compare its coordinates with the report of the CMM, digit by digit and with their signs, and see whether "
            "its name in the lengths is that of another point and whether it was moved",
            gum::Severity::error});
    }
    [[nodiscard]] static std::string coordinate(double value) {
        const double rounded = std::round(value / gum::k_millimetre * 10.0) / 10.0;
        return text::fixed(rounded == 0.0 ? 0.0 : rounded, 1);
    }

    /// Where the distances put a reflector in the fixture, from stations whose places the other reflectors tell.
    [[nodiscard]] std::optional<Eigen::Vector3d> place_of_reflector(std::size_t reflector,
                                                                    const std::vector<std::size_t>& stations,
                                                                    const std::vector<StationFit>& fits) const {
        constexpr int k_most_steps = 30;
        constexpr double k_step = 1e-5;  // [m], of the derivatives
        constexpr double k_end = 1e-6;   // [m]
        const auto row = static_cast<Eigen::Index>(reflector);
        const std::vector<bool> all(measurement_.lengths.size(), true);
        RotaryTableMeasurement moved = measurement_;
        const auto deviations_from = [&](const Eigen::Vector3d& place) {
            moved.fixture.row(row) = place.transpose();
            const PlaceSearch search(moved, all);
            std::vector<double> values;
            for (const std::size_t j : stations) {
                if (!std::isfinite(fits[j].misfit)) {
                    continue;
                }
                const Eigen::VectorXd deviation = search.deviations(j, fits[j]).each;
                const StationDistances& data = search.distances(j);
                for (std::size_t k = 0; k < data.observation.size(); ++k) {
                    if (measurement_.lengths[data.observation[k]].reflector == reflector) {
                        values.push_back(deviation[static_cast<Eigen::Index>(k)]);
                    }
                }
            }
            return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(values.data(), std::ssize(values)));
        };
        const auto squares = [&](const Eigen::Vector3d& at) { return deviations_from(at).squaredNorm(); };
        Eigen::Vector3d place = measurement_.fixture.row(row).transpose();
        const Eigen::Vector3d stated = place;
        double least = squares(place);
        // A sign or two coordinates that are exchanged are farther off than a descent sees.
        for (int signs = 0; signs < 8; ++signs) {
            for (int turn = 0; turn < 6; ++turn) {
                Eigen::Vector3d from(stated[turn % 3], stated[(turn + (turn < 3 ? 1 : 2)) % 3],
                                     stated[(turn + (turn < 3 ? 2 : 1)) % 3]);
                for (int c = 0; c < 3; ++c) {
                    from[c] *= (signs >> c) % 2 == 0 ? 1.0 : -1.0;
                }
                if (const double left = squares(from); left < least) {
                    least = left;
                    place = from;
                }
            }
        }
        Eigen::VectorXd deviation = deviations_from(place);
        double damping = 1e-6;
        for (int step = 0; step < k_most_steps && deviation.size() > 3; ++step) {
            Eigen::MatrixXd derivatives(deviation.size(), 3);
            for (int c = 0; c < 3; ++c) {
                derivatives.col(c) = (deviations_from(place + k_step * Eigen::Vector3d::Unit(c)) - deviation) / k_step;
            }
            Eigen::Matrix3d normal = derivatives.transpose() * derivatives;
            normal.diagonal() *= 1.0 + damping;
            const Eigen::Vector3d change = normal.ldlt().solve(-derivatives.transpose() * deviation);
            const Eigen::VectorXd after = deviations_from(place + change);
            if (change.allFinite() && after.squaredNorm() < deviation.squaredNorm()) {
                place += change;
                deviation = after;
                damping = std::max(1e-12, 0.1 * damping);
                if (change.norm() < k_end) {
                    break;
                }
            } else {
                damping = std::max(1e-6, 10.0 * damping);
            }
        }
        std::vector<double> sizes;
        for (const double one : deviation) {
            sizes.push_back(std::abs(one));
        }
        if (sizes.size() > 3 && median(sizes) < k_good_misfit) {
            return place;
        }
        return std::nullopt;
    }

    /// Of the visits of one station as many as tell its labels, evenly over all of them.
    [[nodiscard]] std::vector<bool> some_visits(const std::vector<bool>& active) const {
        constexpr std::size_t k_visits = 24;
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> visits;  // numbered in their order
        for (std::size_t i = 0; i < active.size(); ++i) {
            if (active[i]) {
                visits.try_emplace({measurement_.lengths[i].pass, measurement_.lengths[i].angle}, visits.size());
            }
        }
        if (visits.size() <= k_visits) {
            return active;
        }
        std::vector<bool> kept(visits.size(), false);
        for (std::size_t k = 0; k < k_visits; ++k) {
            kept[k * visits.size() / k_visits] = true;
        }
        std::vector<bool> some = active;
        for (std::size_t i = 0; i < active.size(); ++i) {
            if (active[i]) {
                some[i] = kept[visits.at({measurement_.lengths[i].pass, measurement_.lengths[i].angle})];
            }
        }
        return some;
    }

    /// Passes of a station that each have a place of their own.
    void refuse_two_places(std::size_t station, double misfit) const {
        constexpr double k_same_place = 0.02;  // [m]
        // From one place with dead paths of each pass, as after an interruption between them: places that a weak layout
        // hardly tells apart are not two.
        RotaryTableMeasurement split = measurement_;
        for (LengthObservation& length : split.lengths) {
            length.dead_path += length.pass * measurement_.dead_paths.size();
        }
        if (PlaceSearch(split, of_station(station, std::nullopt)).fit_of(station, true).upright_misfit() <
            k_share_with_right_labels * misfit) {
            return;
        }
        std::optional<std::pair<std::size_t, Eigen::Vector3d>> first;
        for (std::size_t pass = 0; pass < measurement_.passes.size(); ++pass) {
            const std::vector<bool> active = of_station(station, pass);
            const PlaceSearch search(measurement_, active);
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
                    "GC-ADJUST-0013", "lengths, station " + measurement_.stations[station],
                    "its passes were measured from places that are " + size_text(fit.position - first->second) +
                        " apart: " + measurement_.passes[first->first] + " and " + measurement_.passes[pass],
                    "a station stands in one place",
                    "see whether stations are interchanged in one of the passes, or "
                    "give the place of its own a station name of its own",
                    gum::Severity::error});
            }
        }
    }

    [[nodiscard]] std::vector<bool> of_station(std::size_t station, std::optional<std::size_t> pass) const {
        std::vector<bool> active;
        for (const LengthObservation& length : measurement_.lengths) {
            active.push_back(length.station == station && (!pass || length.pass == *pass));
        }
        return active;
    }

    [[nodiscard]] static std::string size_text(const Eigen::Vector3d& way) {
        return std::to_string(std::llround(way.norm() / gum::k_millimetre)) + " mm";
    }

    /// \param station  "" for all
    [[nodiscard]] gum::Diagnostic diagnostic(const LabelHypothesis& cause, const std::string& station) const {
        const std::string where = station.empty() ? "lengths" : "lengths, station " + station;
        if (cause.other_sense) {
            return {"GC-ADJUST-0013",
                    where,
                    "the distances agree with a table that turns the other way than the angles say",
                    "angles are positive about the axis of the table frame by the right-hand rule",
                    "reverse the sign of the angles, or see whether the coordinates of the fixture are those of a "
                    "right-handed frame",
                    gum::Severity::error};
        }
        if (cause.axis) {
            const auto coordinate = [](RotaryAxis axis) { return std::string(1, "xyz"[axial_coordinate(axis)]); };
            return {"GC-GEOMETRY-0007",
                    station.empty() ? "fixture" : "fixture, seen from station " + station,
                    "the distances agree with a table that turns about " + coordinate(*cause.axis) +
                        " of the fixture coordinates, and not about " + coordinate(measurement_.axis),
                    "the axis lies along the coordinate of the fixture that has its letter, within 45°: error motions "
                    "are named after these coordinates",
                    "correct the letter of the axis, or state the coordinates in a frame with " +
                        coordinate(measurement_.axis) + " along the axis",
                    gum::Severity::error};
        }
        if (cause.scale) {
            return {"GC-ADJUST-0013",
                    where,
                    "the distances agree when they are multiplied by about " + text::fixed(cause.lengths, 4),
                    "a distance grows as the reflector moves away from the station, by as much as it moves",
                    station.empty() ? "see in which unit distances and coordinates of the fixture were written, which "
                                      "refractive index of the air the distances were made with, and at which "
                                      "temperature the coordinates hold"
                                    : "see in which unit the distances were written, and which refractive index of the "
                                      "air and which wavelength they were made with",
                    gum::Severity::error};
        }
        if (cause.lengths != 1.0) {
            return {"GC-ADJUST-0013",
                    where,
                    cause.lengths < 0.0
                        ? std::string("the distances agree when they have the other sign")
                        : "the distances agree when they are multiplied by " + text::significant(cause.lengths, 3),
                    "a distance grows as the reflector moves away from the station, by as much as it moves",
                    cause.lengths < 0.0 ? "reverse the sign of the distances"
                    : cause.lengths == 2.0 || cause.lengths == 0.5
                        ? "see whether the path of the beam was counted twice or halved, and correct the "
                          "distances"
                        : "see in which unit they were written, and correct the distances",
                    gum::Severity::error};
        }
        if (cause.fixture != 1.0 && !station.empty()) {
            // The other stations agree with the fixture, or have a factor of their own: it is the distances.
            return diagnostic({.lengths = 1.0 / cause.fixture}, station);
        }
        if (cause.fixture != 1.0) {
            return {"GC-ADJUST-0013",
                    where,
                    "the distances agree with a fixture whose coordinates are multiplied by " +
                        text::significant(cause.fixture, 3),
                    "distances and coordinates of the fixture are stated in millimetres",
                    "see in which unit each of them was measured, and correct the one that is not in millimetres",
                    gum::Severity::error};
        }
        if (cause.angles != 1.0) {
            return {"GC-ADJUST-0013",
                    where,
                    "the distances agree with a table that turned " + text::significant(cause.angles, 3) +
                        " times as far as the angles say",
                    "angles are stated in degrees, as far as the table turned",
                    std::abs(cause.angles - 0.9) < 0.01
                        ? "the angles seem to be gon: multiply them by 0.9"
                        : "see in which unit and in which steps the angles were written",
                    gum::Severity::error};
        }
        const std::string a = measurement_.reflectors[cause.first];
        const std::string b = measurement_.reflectors[cause.second];
        return {"GC-ADJUST-0013",
                where,
                "the distances agree when the reflectors " + a + " and " + b + " are interchanged",
                "a reflector has the same name in the lengths and in the coordinates of the fixture",
                station.empty() ? "interchange the names in the fixture file or in the lengths"
                                : "interchange the names in the lengths of this station",
                gum::Severity::error};
    }

    const RotaryTableMeasurement& measurement_;
    std::vector<LabelHypothesis> hypotheses_;
};

/// All stations with one set-up, from where each was found on its own.
CommonFit fit_of_all(const RotaryTableMeasurement& measurement, const ObservedStations& observed,
                     const std::vector<StationFit>& alone) {
    const std::optional<gum::Diagnostic> no_table = no_rigid_table(measurement, alone);
    CommonFit found = fit_together(observed, alone);
    try {
        settle_open_places(observed, found);
    } catch (const gum::NoResultError&) {
        // Places that fit alike badly, and a place far away where all reflectors lie on a cone, are what a search comes to
        // that has nothing to find: they say nothing of the layout.
        if (no_table) {
            throw gum::NoResultError(*no_table);
        }
        throw;
    }
    return found;
}

}  // namespace

StartValues find_start_values(const RotaryTableMeasurement& measurement, const std::vector<bool>& active) {
    const PlaceSearch search(measurement, active);
    const ObservedStations& observed = search.observed();
    CommonFit found = fit_together(observed, search.fit_each());
    settle_open_places(observed, found);
    StartValues start;
    start.dead_paths = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(measurement.dead_paths.size()));
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

void refuse_wrong_labels(const RotaryTableMeasurement& measurement) {
    refuse_shifted_angles(measurement);
    LabelSearch(measurement).refuse(PlaceSearch(measurement).fit_each(), LabelSearch::Asked::all);
}

std::vector<std::size_t> find_gross_errors(const RotaryTableMeasurement& measurement) {
    // What the start values leave is error motions: even of a bad table far below this.
    constexpr double k_smallest = 0.02;  // [m]
    constexpr double k_factor = 15.0;    // times the standard deviation that the median absolute deviation stands for
    const PlaceSearch search(measurement);
    const std::vector<StationFit> alone = search.fit_each();
    LabelSearch(measurement).refuse(alone, LabelSearch::Asked::suspicious);
    const ObservedStations& observed = search.observed();
    const CommonFit all = fit_of_all(measurement, observed, alone);
    std::vector<std::pair<double, std::size_t>> found;  // negative size first, so that the largest comes first
    for (std::size_t j = 0; j < observed.stations().size(); ++j) {
        const StationDistances& data = observed.stations()[j];
        const Eigen::VectorXd deviation = observed.deviations(j, all.set_up, all.stations[j].position).each;
        std::vector<double> values;
        for (const std::vector<Eigen::Index>& members : data.members) {
            for (const Eigen::Index i : members) {
                // Which one of two lengths is wrong cannot be told: each is as far from their median.
                if (members.size() > 2) {
                    values.push_back(std::abs(deviation[i]));
                }
            }
        }
        if (values.empty()) {
            continue;
        }
        const double limit = std::max(k_smallest, k_factor * k_mad_to_deviation * median(values));
        for (const std::vector<Eigen::Index>& members : data.members) {
            for (const Eigen::Index i : members) {
                if (members.size() > 2 && std::abs(deviation[i]) > limit) {
                    found.emplace_back(-std::abs(deviation[i]), data.observation[static_cast<std::size_t>(i)]);
                }
            }
        }
    }
    std::sort(found.begin(), found.end());
    // More than one in twenty are no gross errors of single distances, but something else.
    found.resize(std::min(found.size(), measurement.lengths.size() / 20 + 1));
    std::vector<std::size_t> result;
    for (const auto& [size, i] : found) {
        result.push_back(i);
    }
    return result;
}

}  // namespace gumcert::engine
