#include "engine/rotary_table/start/place_of_reflector.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/place_search.h"

namespace gumcert::engine {

std::optional<Eigen::Vector3d> place_of_reflector(const RotaryTableMeasurement& measurement, std::size_t reflector,
                                                  const std::vector<std::size_t>& stations,
                                                  const std::vector<StationFit>& fits) {
    constexpr int k_most_steps = 30;
    constexpr double k_step = 1e-5;  // [m], of the derivatives
    constexpr double k_end = 1e-6;   // [m]
    const auto row = static_cast<Eigen::Index>(reflector);
    RotaryTableMeasurement moved = measurement;
    const auto deviations_from = [&](const Eigen::Vector3d& place) {
        moved.fixture.row(row) = place.transpose();
        const PlaceSearch search(moved);
        std::vector<double> values;
        for (const std::size_t j : stations) {
            if (!std::isfinite(fits[j].misfit)) {
                continue;
            }
            const Eigen::VectorXd deviation = search.deviations(j, fits[j]).each;
            const std::vector<std::size_t>& observation = search.distances(j).observation;
            for (std::size_t k = 0; k < observation.size(); ++k) {
                if (measurement.lengths[observation[k]].reflector == reflector) {
                    values.push_back(deviation[static_cast<Eigen::Index>(k)]);
                }
            }
        }
        return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(values.data(), std::ssize(values)));
    };
    const auto squares = [&](const Eigen::Vector3d& at) { return deviations_from(at).squaredNorm(); };
    Eigen::Vector3d place = measurement.fixture.row(row).transpose();
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
    if (deviation.size() > 3 && median_size(deviation) < k_good_misfit) {
        return place;
    }
    return std::nullopt;
}

}  // namespace gumcert::engine
