#include "engine/rotary_table/start/start_search.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/rotary_table/start/gross_errors.h"
#include "engine/rotary_table/start/interrupted_beams.h"
#include "engine/rotary_table/start/label_hypothesis.h"
#include "engine/rotary_table/start/no_rigid_table.h"
#include "engine/rotary_table/start/open_places.h"
#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/wrong_labels.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

struct StartSearch::Found {
    explicit Found(const RotaryTableMeasurement& of)
        : measurement(of), search(of), alone(search.fit_each()), labels(of, alone) {}

    /// All stations with one set-up, from where each was found on its own, the places that are open settled.
    [[nodiscard]] const CommonFit& together() {
        if (!settled) {
            settled = settled_places(search.observed(), alone);
        }
        return *settled;
    }

    const RotaryTableMeasurement& measurement;
    PlaceSearch search;
    std::vector<StationFit> alone;
    WrongLabels labels;
    std::optional<CommonFit> settled;
    std::optional<std::vector<std::size_t>> gross;
    bool tried_interruptions = false;
};

StartSearch::StartSearch(const RotaryTableMeasurement& measurement) : found_(std::make_unique<Found>(measurement)) {}
StartSearch::~StartSearch() = default;

const std::vector<std::size_t>& StartSearch::gross_errors() {
    if (!found_->gross) {
        found_->labels.refuse_suspicious();
        try {
            found_->gross = gross_errors_of(found_->search.observed(), found_->together());
        } catch (const gum::NoResultError&) {
            // Places that fit alike badly, and a place far away where all reflectors lie on a cone, are what a search comes
            // to that has nothing to find: they say nothing of the layout.
            refuse_no_rigid_table();
            throw;
        }
    }
    return *found_->gross;
}

CommonFit StartSearch::places(const std::vector<bool>& active) {
    if (std::ranges::find(active, false) == active.end()) {
        return found_->together();
    }
    const PlaceSearch without(found_->measurement, active);
    return settled_places(without.observed(), without.fit_each());
}

void StartSearch::refuse_no_rigid_table() const {
    if (std::optional<gum::Diagnostic> none = no_rigid_table(found_->measurement, found_->alone)) {
        throw gum::NoResultError(std::move(*none));
    }
}

void StartSearch::refuse_wrong_labels() {
    found_->labels.refuse_all();
}

void StartSearch::refuse_interrupted_beams() {
    if (!found_->tried_interruptions) {
        engine::refuse_interrupted_beams(found_->measurement);
        found_->tried_interruptions = true;
    }
}

gum::Diagnostic factor_on_distances(const RotaryTableMeasurement& measurement, double factor,
                                    const std::string& station) {
    return wrong_labels(measurement, {.lengths = factor, .scale = true}, station);
}

}  // namespace gumcert::engine
