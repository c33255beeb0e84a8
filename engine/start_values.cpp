#include "engine/start_values.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/joint_adjustment.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

StartValues find_start_values(const RotaryTableMeasurement& measurement, const std::vector<bool>& active) {
    StartValues start;
    start.stations.resize(measurement.stations.size());
    start.dead_paths = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(measurement.dead_paths.size()));
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        std::vector<const LengthObservation*> lengths;
        std::vector<Eigen::Vector3d> positions;
        std::vector<std::size_t> paths;  // dead paths of this station
        const double stretch =
            1.0 + measurement.expansion * measurement.temperature_difference[static_cast<Eigen::Index>(j)];
        for (std::size_t i = 0; i < measurement.lengths.size(); ++i) {
            const LengthObservation& length = measurement.lengths[i];
            if (length.station != j || (!active.empty() && !active[i])) {
                continue;
            }
            lengths.push_back(&length);
            positions.emplace_back(
                nominal_rotation(measurement, length.angle) *
                (stretch * measurement.fixture.row(static_cast<Eigen::Index>(length.reflector)).transpose()));
            if (std::find(paths.begin(), paths.end(), length.dead_path) == paths.end()) {
                paths.push_back(length.dead_path);
            }
        }
        // Deviations of the distances from one dead path each: what a position of the station leaves unexplained.
        const auto dead_path_of = [&](const Eigen::Vector3d& station, std::size_t path) {
            double sum = 0.0;
            double count = 0.0;
            for (std::size_t i = 0; i < lengths.size(); ++i) {
                if (lengths[i]->dead_path == path) {
                    sum += (positions[i] - station).norm() - lengths[i]->length;
                    count += 1.0;
                }
            }
            return sum / count;
        };
        const auto misfit = [&](const Eigen::Vector3d& station) {
            double squares = 0.0;
            for (const std::size_t path : paths) {
                const double dead_path = dead_path_of(station, path);
                for (std::size_t i = 0; i < lengths.size(); ++i) {
                    if (lengths[i]->dead_path == path) {
                        squares += std::pow((positions[i] - station).norm() - lengths[i]->length - dead_path, 2);
                    }
                }
            }
            return squares;
        };
        std::optional<Eigen::Vector3d> best = measurement.station_start[j];
        {
            // |P|² - 2 P·q + |q|² = l² + 2 l l0 + l0²: linear in q, l0 and κ = |q|² - l0², one l0 and κ a dead path.
            const auto rows = static_cast<Eigen::Index>(lengths.size());
            const auto unknown = 3 + 2 * static_cast<Eigen::Index>(paths.size());
            Eigen::MatrixXd design = Eigen::MatrixXd::Zero(rows, unknown);
            Eigen::VectorXd right(rows);
            for (Eigen::Index i = 0; i < rows; ++i) {
                const auto at = static_cast<std::size_t>(i);
                const auto path = std::find(paths.begin(), paths.end(), lengths[at]->dead_path) - paths.begin();
                design.row(i).head<3>() = -2.0 * positions[at].transpose();
                design(i, 3 + 2 * path) = -2.0 * lengths[at]->length;
                design(i, 4 + 2 * path) = 1.0;
                right[i] = lengths[at]->length * lengths[at]->length - positions[at].squaredNorm();
            }
            const Eigen::VectorXd scale = design.colwise().norm().cwiseInverse();
            Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor(design * scale.asDiagonal());
            factor.setThreshold(1e-9);
            const Eigen::VectorXd solution = scale.asDiagonal() * factor.solve(right);
            if (factor.rank() == unknown && solution.allFinite()) {
                // A stated position can belong to another home angle or frame; the one that explains more is taken.
                if (!best || misfit(solution.head<3>()) < misfit(*best)) {
                    best = solution.head<3>();
                }
            } else if (!best) {
                throw gum::NoResultError(gum::Diagnostic{
                    "GC-RANK-0001", "station " + measurement.stations[j],
                    "its position and dead path cannot be found from the distances alone: all reflectors are seen on a "
                    "cone about one line, lie in one plane across the axis, or have a dead path each",
                    "on a cone a move along its axis and a longer dead path look the same; from a plane the mirror "
                    "image of the station fits as well",
                    "state the position of the station in the stations file; on a cone, move the station off the "
                    "rotary axis, or place reflectors at different distances from the axis",
                    gum::Severity::error});
            }
        }
        start.stations[j] = *best;
        for (const std::size_t path : paths) {
            start.dead_paths[static_cast<Eigen::Index>(path)] = dead_path_of(start.stations[j], path);
        }
    }
    return start;
}

std::vector<std::size_t> find_gross_errors(const RotaryTableMeasurement& measurement) {
    // Start values know nothing of set-up errors and error motions: a millimetre or two is no sign of a gross error.
    constexpr double k_smallest = 0.02;  // [m]
    constexpr double k_factor = 15.0;    // times the standard deviation that the median absolute deviation stands for
    std::vector<bool> active(measurement.lengths.size(), true);
    std::vector<std::size_t> found;
    const std::size_t most = measurement.lengths.size() / 20;
    const auto median = [](std::vector<double> values) {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    while (found.size() <= most) {
        const StartValues start = find_start_values(measurement, active);
        std::vector<std::vector<std::size_t>> by_path(measurement.dead_paths.size());
        std::vector<double> deviation(measurement.lengths.size(), 0.0);
        for (std::size_t i = 0; i < measurement.lengths.size(); ++i) {
            const LengthObservation& length = measurement.lengths[i];
            const double stretch =
                1.0 +
                measurement.expansion * measurement.temperature_difference[static_cast<Eigen::Index>(length.station)];
            const Eigen::Vector3d position =
                nominal_rotation(measurement, length.angle) *
                (stretch * measurement.fixture.row(static_cast<Eigen::Index>(length.reflector)).transpose());
            deviation[i] = (position - start.stations[length.station]).norm() - length.length;
            if (active[i]) {
                by_path[length.dead_path].push_back(i);
            }
        }
        std::size_t worst = measurement.lengths.size();
        double largest = 1.0;  // deviation against its limit
        for (const std::vector<std::size_t>& members : by_path) {
            if (members.size() < 5) {
                continue;
            }
            std::vector<double> values;
            for (const std::size_t i : members) {
                values.push_back(deviation[i]);
            }
            const double centre = median(values);
            for (double& value : values) {
                value = std::abs(value - centre);
            }
            const double limit = std::max(k_smallest, k_factor * 1.4826 * median(values));
            for (const std::size_t i : members) {
                if (const double ratio = std::abs(deviation[i] - centre) / limit; ratio > largest) {
                    largest = ratio;
                    worst = i;
                }
            }
        }
        if (worst == measurement.lengths.size()) {
            break;
        }
        active[worst] = false;
        found.push_back(worst);
    }
    return found;
}

}  // namespace gumcert::engine
