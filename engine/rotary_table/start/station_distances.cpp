#include "engine/rotary_table/start/station_distances.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/median.h"

namespace gumcert::engine {

namespace {

constexpr double k_trimmed_share = 0.85;  // of the deviations that the misfit looks at
// Distances beyond the unknowns that a cause takes: fewer agree with any cause.
constexpr std::ptrdiff_t k_least_redundancy = 6;
// Position and set-up of one station.
constexpr std::ptrdiff_t k_unknowns_of_station = 7;

}  // namespace

std::vector<StationDistances> distances_by_station(const RotaryTableMeasurement& measurement,
                                                   const std::vector<bool>& active) {
    std::vector<StationDistances> stations(measurement.stations.size());
    std::vector<std::vector<double>> lengths(stations.size());
    for (std::size_t i = 0; i < measurement.lengths.size(); ++i) {
        if (!active.empty() && !active[i]) {
            continue;
        }
        const LengthObservation& length = measurement.lengths[i];
        StationDistances& data = stations[length.station];
        // Stations look at the fixture at temperatures of their own.
        const double stretch =
            1.0 + measurement.expansion * measurement.temperature_difference[static_cast<Eigen::Index>(length.station)];
        auto found = std::find(data.path_name.begin(), data.path_name.end(), length.dead_path);
        if (found == data.path_name.end()) {
            found = data.path_name.insert(found, length.dead_path);
            data.members.emplace_back();
        }
        const auto path = static_cast<std::size_t>(found - data.path_name.begin());
        data.members[path].push_back(static_cast<Eigen::Index>(data.observation.size()));
        data.path.push_back(path);
        data.observation.push_back(i);
        data.angle.push_back(length.angle);
        data.point.emplace_back(stretch *
                                measurement.fixture.row(static_cast<Eigen::Index>(length.reflector)).transpose());
        lengths[length.station].push_back(length.length);
    }
    for (std::size_t j = 0; j < stations.size(); ++j) {
        stations[j].length =
            Eigen::Map<const Eigen::VectorXd>(lengths[j].data(), static_cast<Eigen::Index>(lengths[j].size()));
    }
    return stations;
}

Deviations deviations_from(const StationDistances& data, const std::vector<Eigen::Vector3d>& points,
                           const Eigen::Vector3d& place) {
    Eigen::VectorXd deviation(data.length.size());
    for (Eigen::Index i = 0; i < deviation.size(); ++i) {
        deviation[i] = (points[static_cast<std::size_t>(i)] - place).norm() - data.length[i];
    }
    // The constant of a dead path moves all its lengths alike: their median takes it out, and single wrong lengths
    // do not move that.
    Eigen::VectorXd centre(static_cast<Eigen::Index>(data.members.size()));
    std::vector<double> values;
    for (std::size_t d = 0; d < data.members.size(); ++d) {
        values.clear();
        for (const Eigen::Index i : data.members[d]) {
            values.push_back(deviation[i]);
        }
        const double middle = median(values);
        centre[static_cast<Eigen::Index>(d)] = middle;
        for (const Eigen::Index i : data.members[d]) {
            deviation[i] -= middle;
        }
    }
    return {deviation, centre};
}

void collect_sizes(const StationDistances& data, const Eigen::VectorXd& deviation, std::vector<double>& sizes) {
    for (const std::vector<Eigen::Index>& members : data.members) {
        for (const Eigen::Index i : members) {
            if (members.size() > 1) {
                sizes.push_back(std::abs(deviation[i]));
            }
        }
    }
}

double misfit_of(const StationDistances& data, const Eigen::VectorXd& deviation) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(deviation.size()));
    collect_sizes(data, deviation, values);
    if (values.empty()) {
        return 0.0;
    }
    const auto kept = static_cast<std::ptrdiff_t>(std::ceil(k_trimmed_share * static_cast<double>(values.size())));
    std::nth_element(values.begin(), values.begin() + kept - 1, values.end());
    double squares = 0.0;
    for (auto value = values.begin(); value != values.begin() + kept; ++value) {
        squares += *value * *value;
    }
    return std::sqrt(squares / static_cast<double>(kept));
}

double median_size(const Eigen::VectorXd& deviation) {
    std::vector<double> sizes;
    for (const double one : deviation) {
        sizes.push_back(std::abs(one));
    }
    return median(sizes);
}

bool tells_causes(const StationDistances& data) {
    std::ptrdiff_t redundancy = -k_unknowns_of_station;
    for (const std::vector<Eigen::Index>& members : data.members) {
        redundancy += std::ssize(members) - 1;  // a single length tells its dead path and nothing else
    }
    return redundancy >= k_least_redundancy;
}

}  // namespace gumcert::engine
