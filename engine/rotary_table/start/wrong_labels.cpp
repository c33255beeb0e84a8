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

}  // namespace

WrongLabels::WrongLabels(const RotaryTableMeasurement& measurement, std::vector<StationFit> alone)
    : measurement_(measurement),
      fits_(std::move(alone)),
      tried_labels_(fits_.size(), false),
      tried_two_places_(fits_.size(), false) {
    for (const StationFit& fit : fits_) {
        misfits_.push_back(fit.upright_misfit());
    }
}

/// A search that ended at what error motions may leave goes on where the neighbours leave far less.
void WrongLabels::look_closer() {
    for (std::size_t j = 0; j < misfits_.size() && !looked_closer_; ++j) {
        if (fits_[j].is_settled() && is_suspicious(misfits_[j], misfits_)) {
            fits_[j] = PlaceSearch(measurement_, lengths_of_station(measurement_, j)).fit_from_all_sides(j, fits_[j]);
            misfits_[j] = fits_[j].upright_misfit();
        }
    }
    looked_closer_ = true;
}

void WrongLabels::refuse(Asked asked) {
    look_closer();
    // One reflector that all stations disagree with is asked for first: it costs least.
    std::vector<std::size_t> open;
    for (std::size_t j = 0; j < misfits_.size(); ++j) {
        if (is_suspicious(misfits_[j], misfits_)) {
            open.push_back(j);
        }
    }
    if (!tried_visits_ && open.size() > 1 && 2 * open.size() > misfits_.size()) {
        refuse_wrong_coordinates(measurement_, open, misfits_);
    }
    open.clear();
    std::vector<std::optional<LabelHypothesis>> causes(misfits_.size());
    std::vector<gum::Diagnostic> problems;
    std::optional<LabelHypothesis> known;  // what one station has is likely what all have
    const auto labels_of_visits_of = [&](std::size_t j) {
        return tried_visits_ ? std::nullopt : labels_of_visits(measurement_, j, fits_[j]);
    };
    // All labels take a while: a rough table, whose stations are all alike, has a result and does not wait for them.
    const double limit = asked == Asked::all ? k_good_misfit : k_wrong_labels;
    for (std::size_t j = 0; j < misfits_.size(); ++j) {
        const bool suspicious = is_suspicious(misfits_[j], misfits_, limit);
        if (suspicious || (asked == Asked::all && misfits_[j] > k_least_of_labels)) {
            if (known && labels_explain_station(measurement_, j, misfits_[j], *known)) {
                causes[j] = known;
            } else if (!tried_labels_[j]) {
                causes[j] = labels_of_station(measurement_, j, misfits_[j]);
                if (!causes[j] && suspicious) {
                    causes[j] = scale_of_station(measurement_, j, fits_[j]);
                }
                tried_labels_[j] = !causes[j] && suspicious;
            }
            // Labels of some visits are right, where they are: an interchange of two concerns few distances of the others.
            const bool of_some = causes[j] && causes[j]->first != causes[j]->second;
            if (std::optional<gum::Diagnostic> part = of_some ? labels_of_visits_of(j) : std::nullopt) {
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
        if (std::optional<gum::Diagnostic> part = labels_of_visits_of(j)) {
            problems.push_back(std::move(*part));
        } else if (suspicious) {
            open.push_back(j);
        }
    }
    if (problems.empty() && std::ranges::none_of(causes, [](const auto& cause) { return cause.has_value(); })) {
        refuse_stray_reflector(measurement_, fits_, asked == Asked::all);
    }
    for (const std::size_t j : open) {
        if (!tried_two_places_[j]) {
            refuse_angles_of_pass(measurement_, j, misfits_[j]);
            refuse_two_places(measurement_, j, misfits_[j]);
            tried_two_places_[j] = true;
        }
    }
    const bool common = causes[0] && std::ranges::all_of(causes, [&](const auto& cause) { return cause == causes[0]; });
    for (std::size_t j = 0; j < causes.size() && !(common && j > 0); ++j) {
        if (causes[j]) {
            problems.push_back(wrong_labels(measurement_, *causes[j], common ? "" : measurement_.stations[j]));
        }
    }
    if (!problems.empty()) {
        throw gum::NoResultError(std::move(problems));
    }
    // Without a cause all stations were asked for wrong labels at some of their visits.
    tried_visits_ = true;
}

void WrongLabels::refuse_suspicious() {
    refuse(Asked::suspicious);
}

void WrongLabels::refuse_all() {
    refuse_shifted_angles(measurement_);
    refuse(Asked::all);
}

}  // namespace gumcert::engine
