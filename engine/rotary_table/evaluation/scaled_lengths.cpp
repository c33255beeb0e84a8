#include "engine/rotary_table/evaluation/scaled_lengths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/median.h"
#include "engine/rotary_table/evaluation/rival_tables.h"
#include "engine/rotary_table/start/start_search.h"
#include "engine/rotary_table/variance_components.h"

namespace gumcert::engine {

namespace {

struct ScaleFit {
    double chi_square = std::numeric_limits<double>::infinity();  ///< where it does not converge
    std::vector<double> scale_deviations;                         ///< s − 1 of each station
};

ScaleFit scale_fit(const RotaryTableMeasurement& measurement, const CommonFit& places, const std::vector<bool>& active,
                   const SolverOptions& solver, const Workers& workers) {
    const ObservedStations observed(measurement, active);
    PlacedAdjustment placed =
        placed_adjustment(observed, active, places, start_variances(measurement.table_repeatability), workers);
    ScaleFit fit;
    if (placed.adjustment.adjustment().linearise().rank(solver.rank_tolerance).deficient) {
        return fit;
    }
    const SolveSummary summary = placed.adjustment.adjustment().solve(solver);
    if (summary.converged) {
        fit.chi_square = summary.chi_square;
    }
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        fit.scale_deviations.push_back(
            placed.adjustment.adjustment().parameters(placed.adjustment.station_block(j))[3]);
    }
    return fit;
}

}  // namespace

std::vector<gum::Diagnostic> scaled_lengths(const RotaryTableMeasurement& measurement, const CommonFit& places,
                                            const std::vector<bool>& active, const SolverOptions& solver,
                                            const Workers& workers) {
    constexpr double k_share_left = 0.25;
    constexpr double k_least = 2e-5;  // below, the tests of groups tell it
    constexpr double k_most = 0.01;   // above, a search without error motions tells it
    constexpr double k_alike = 0.2;
    if (measurement.length_uncertainty.scale_model == ScaleModel::free) {
        return {};
    }
    RotaryTableMeasurement scaled = measurement;
    scaled.length_uncertainty.scale_model = ScaleModel::free;
    const ScaleFit free = scale_fit(scaled, places, active, solver, workers);
    if (std::isinf(free.chi_square) ||
        !(free.chi_square < k_share_left * scale_fit(measurement, places, active, solver, workers).chi_square)) {
        return {};
    }
    std::vector<double> sizes;
    for (const double deviation : free.scale_deviations) {
        if (std::abs(deviation) > k_most) {
            return {};
        }
        if (std::abs(deviation) > k_least) {
            sizes.push_back(deviation);
        }
    }
    if (sizes.empty()) {
        return {};
    }
    const bool all = sizes.size() == free.scale_deviations.size();
    const double middle = upper_median(sizes);
    std::vector<gum::Diagnostic> causes;
    for (std::size_t j = 0; j < free.scale_deviations.size(); ++j) {
        const double deviation = free.scale_deviations[j];
        const bool has_scale = std::abs(deviation - middle) < k_alike * std::abs(middle);
        if (!has_scale && !(std::abs(deviation) < k_alike * std::abs(middle))) {
            return {};
        }
        if (has_scale && !all) {
            causes.push_back(factor_on_distances(measurement, 1.0 / (1.0 + deviation), measurement.stations[j]));
        }
    }
    if (all) {
        causes.push_back(factor_on_distances(measurement, 1.0 / (1.0 + middle), ""));
    }
    return causes;
}

}  // namespace gumcert::engine
