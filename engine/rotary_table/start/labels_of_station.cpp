#include "engine/rotary_table/start/labels_of_station.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/selected_lengths.h"
#include "gum/quantity/golden_section.h"

namespace gumcert::engine {

namespace {

/// What the hypothesis leaves of the distances as they were stated: half of all lengths leaves half of any misfit.
double misfit_with(const RotaryTableMeasurement& measurement, const LabelHypothesis& hypothesis, std::size_t station,
                   const std::vector<bool>& active, bool closely) {
    const RotaryTableMeasurement other = relabelled(measurement, station, hypothesis);
    const double left =
        PlaceSearch(other, active).fit_of(station, closely).upright_misfit() / std::abs(hypothesis.lengths);
    if (hypothesis.fixture == 1.0) {
        return left;
    }
    // Only the ratio counts, but a place is looked for at distances that stations have: whether it is the fixture that
    // has its size or the lengths is not known.
    return std::min(left, misfit_with(measurement, {.lengths = 1.0 / hypothesis.fixture}, station, active, closely));
}

/// Whether the labels as they are stated explain the station from the place that a factor has led to. A station that hardly
/// sees its distances bend has a place at half of them: a reflector that moves along a slant line moves half as far. It is
/// followed as the factor goes to 1.
bool stated_explain_as_well(const RotaryTableMeasurement& measurement, const LabelHypothesis& factor,
                            std::size_t station, const std::vector<bool>& active, double least) {
    constexpr int k_steps = 16;
    if (factor.lengths < 0.0 || (factor.lengths == 1.0 && factor.fixture == 1.0 && factor.angles == 1.0)) {
        return false;
    }
    StationFit fit = PlaceSearch(relabelled(measurement, station, factor), active).fit_of(station, true);
    for (int k = 1; k <= k_steps; ++k) {
        const double part = 1.0 - static_cast<double>(k) / k_steps;
        LabelHypothesis nearer = factor;
        nearer.lengths = std::pow(factor.lengths, part);
        nearer.fixture = std::pow(factor.fixture, part);
        nearer.angles = std::pow(factor.angles, part);
        fit = PlaceSearch(relabelled(measurement, station, nearer), active).fit_near(station, fit);
    }
    return fit.upright_misfit() < least;
}

/// A wrong guess of labels lowers the misfit by chance, and that of a station that fits very badly a good deal. The right
/// one removes nearly all of it, and leaves what error motions do. [m]
double most_with_right_labels(double misfit) {
    return std::min(k_share_with_right_labels * misfit, k_good_misfit);
}

}  // namespace

bool labels_explain_station(const RotaryTableMeasurement& measurement, std::size_t station, double misfit,
                            const LabelHypothesis& labels) {
    const std::vector<bool> active = lengths_of_station(measurement, station);
    return PlaceSearch(measurement, active).tells_causes(station) &&
           misfit_with(measurement, labels, station, active, true) < most_with_right_labels(misfit);
}

std::optional<LabelHypothesis> labels_of_station(const RotaryTableMeasurement& measurement, std::size_t station,
                                                 double misfit) {
    const std::vector<bool> active = lengths_of_station(measurement, station);
    if (!PlaceSearch(measurement, active).tells_causes(station)) {
        return std::nullopt;
    }
    double least = most_with_right_labels(misfit);
    // Some visits tell the labels of all: the time does not grow with the measurement.
    const std::vector<bool> some = lengths_of_some_visits(measurement, active);
    const std::vector<LabelHypothesis> hypotheses = label_hypotheses(measurement);
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < hypotheses.size(); ++k) {
        order.emplace_back(misfit_with(measurement, hypotheses[k], station, some, false), k);
    }
    std::ranges::sort(order);
    std::optional<LabelHypothesis> best;
    constexpr std::size_t k_looked_at_closely = 3;
    for (std::size_t k = 0; k < std::min(k_looked_at_closely, order.size()) && order[k].first < least; ++k) {
        const LabelHypothesis& hypothesis = hypotheses[order[k].second];
        const double reached =
            some == active ? order[k].first : misfit_with(measurement, hypothesis, station, active, true);
        if (reached < least) {
            // Then it is the search that did not find the place, and no other labels are right.
            if (stated_explain_as_well(measurement, hypothesis, station, active, least)) {
                return std::nullopt;
            }
            least = reached;
            best = hypothesis;
        }
    }
    return best;
}

std::optional<LabelHypothesis> scale_of_station(const RotaryTableMeasurement& measurement, std::size_t station,
                                                const StationFit& fit) {
    constexpr double k_most = 1.25;
    constexpr double k_inside =
        0.99;  // of the range: at its end what is left still falls, and the right factor is none of it
    constexpr double k_least = 5e-4;  // below it the tests of groups tell it, and what it is beside its u
    constexpr int k_steps = 40;       // of a golden section: to 2e-9 of the factor
    const std::vector<bool> active = lengths_of_station(measurement, station);
    if (!PlaceSearch(measurement, active).tells_causes(station)) {
        return std::nullopt;
    }
    const double misfit = fit.upright_misfit();
    const std::vector<bool> some = lengths_of_some_visits(measurement, active);
    StationFit best = fit;
    const auto misfit_at = [&](double logarithm) {
        const LabelHypothesis hypothesis{.lengths = std::exp(logarithm), .scale = true};
        const RotaryTableMeasurement other = relabelled(measurement, station, hypothesis);
        const StationFit found = PlaceSearch(other, some).fit_near(station, best);
        if (found.upright_misfit() < best.upright_misfit()) {
            best = found;
        }
        return found.upright_misfit();
    };
    // What is left grows with the distance of the factor from the right one, on both sides.
    const double logarithm = gum::least_by_golden_section(misfit_at, -std::log(k_most), std::log(k_most), k_steps);
    const LabelHypothesis found{.lengths = std::exp(logarithm), .scale = true};
    if (std::abs(found.lengths - 1.0) > k_least && std::abs(logarithm) < k_inside * std::log(k_most) &&
        misfit_with(measurement, found, station, active, true) < most_with_right_labels(misfit) &&
        !stated_explain_as_well(measurement, found, station, active, most_with_right_labels(misfit))) {
        return found;
    }
    return std::nullopt;
}

}  // namespace gumcert::engine
