#include "engine/rotary_table/start/wrong_labels.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "engine/median.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/labels_of_station.h"
#include "engine/rotary_table/start/labels_of_visits.h"
#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/selected_lengths.h"
#include "engine/rotary_table/start/shifted_angles.h"
#include "engine/rotary_table/start/two_places.h"
#include "engine/rotary_table/start/wrong_coordinates.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

// A station that fits this much worse than its neighbours is not what error motions of their table leave; and what no
// error motion of a sound one is.
constexpr double k_worse_than_others = 10.0;
constexpr double k_least_suspicious = 0.02 * gum::k_millimetre;
// And what no wrong label leaves less of: where a station fits better, a layout that determines nothing fits other labels, too.
constexpr double k_least_of_labels = 0.005 * gum::k_millimetre;

/// Whether a station fits its distances worse than error motions let any fit. The table is the same for all: what
/// one of them leaves beyond ten times the median of all is no motion of it.
/// \param limit  [m], of any table
bool is_suspicious(double misfit, std::vector<double> misfits, double limit = k_good_misfit) {
    return misfit > limit || (misfit > k_least_suspicious && misfit > k_worse_than_others * median(misfits));
}

/// Which stations are asked. All: of a measurement that has no result, for which lengths in another unit may fit a false
/// place.
enum class Asked { suspicious, all };

/// \param fits  of the stations, each on its own
void refuse(const RotaryTableMeasurement& measurement, std::vector<StationFit> fits, Asked asked) {
    std::vector<double> misfits;
    for (const StationFit& fit : fits) {
        misfits.push_back(fit.upright_misfit());
    }
    for (std::size_t j = 0; j < misfits.size(); ++j) {
        if (fits[j].is_settled() && is_suspicious(misfits[j], misfits)) {
            // The search ended at what error motions may leave: with neighbours that leave far less it goes on.
            fits[j] = PlaceSearch(measurement, lengths_of_station(measurement, j)).fit_from_all_sides(j, fits[j]);
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
        refuse_wrong_coordinates(measurement, open, misfits);
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
            causes[j] = labels_of_station(measurement, j, misfits[j], known);
            if (!causes[j] && suspicious) {
                causes[j] = scale_of_station(measurement, j, fits[j]);
            }
            // Labels of some visits are right, where they are: an interchange of two concerns few distances of the others.
            const bool of_some = causes[j] && causes[j]->first != causes[j]->second;
            if (std::optional<gum::Diagnostic> part =
                    of_some ? labels_of_visits(measurement, j, fits[j]) : std::nullopt) {
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
        if (std::optional<gum::Diagnostic> part = labels_of_visits(measurement, j, fits[j])) {
            problems.push_back(std::move(*part));
        } else if (suspicious) {
            open.push_back(j);
        }
    }
    if (problems.empty() && std::ranges::none_of(causes, [](const auto& cause) { return cause.has_value(); })) {
        refuse_stray_reflector(measurement, fits, asked == Asked::all);
    }
    for (const std::size_t j : open) {
        refuse_two_places(measurement, j, misfits[j]);
    }
    const bool common = causes[0] && std::ranges::all_of(causes, [&](const auto& cause) { return cause == causes[0]; });
    for (std::size_t j = 0; j < causes.size() && !(common && j > 0); ++j) {
        if (causes[j]) {
            problems.push_back(wrong_labels(measurement, *causes[j], common ? "" : measurement.stations[j]));
        }
    }
    if (!problems.empty()) {
        throw gum::NoResultError(std::move(problems));
    }
}

}  // namespace

void refuse_wrong_labels(const RotaryTableMeasurement& measurement) {
    refuse_shifted_angles(measurement);
    refuse(measurement, PlaceSearch(measurement).fit_each(), Asked::all);
}

void refuse_labels_of_suspicious(const RotaryTableMeasurement& measurement, const std::vector<StationFit>& fits) {
    refuse(measurement, fits, Asked::suspicious);
}

}  // namespace gumcert::engine
