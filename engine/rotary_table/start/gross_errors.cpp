#include "engine/rotary_table/start/gross_errors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/median.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/start_search.h"

namespace gumcert::engine {

std::vector<std::size_t> gross_errors_of(const ObservedStations& observed, const CommonFit& all) {
    // What the start values leave is error motions: even of a bad table far below this.
    constexpr double k_smallest = 0.02;  // [m]
    constexpr double k_factor = 15.0;    // times the standard deviation that the median absolute deviation stands for
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
    found.resize(std::min(found.size(), observed.measurement().lengths.size() / 20 + 1));
    std::vector<std::size_t> result;
    for (const auto& [size, i] : found) {
        result.push_back(i);
    }
    return result;
}

std::vector<std::size_t> find_gross_errors(const RotaryTableMeasurement& measurement) {
    return StartSearch(measurement).gross_errors();
}

}  // namespace gumcert::engine
