#include "engine/rotary_table/start/gross_errors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/median.h"
#include "engine/rotary_table/start/common_set_up.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/no_rigid_table.h"
#include "engine/rotary_table/start/open_places.h"
#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/wrong_labels.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

namespace {

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

std::vector<std::size_t> find_gross_errors(const RotaryTableMeasurement& measurement) {
    // What the start values leave is error motions: even of a bad table far below this.
    constexpr double k_smallest = 0.02;  // [m]
    constexpr double k_factor = 15.0;    // times the standard deviation that the median absolute deviation stands for
    const PlaceSearch search(measurement);
    const std::vector<StationFit> alone = search.fit_each();
    refuse_labels_of_suspicious(measurement, alone);
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
