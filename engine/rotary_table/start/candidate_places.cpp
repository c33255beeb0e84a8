#include "engine/rotary_table/start/candidate_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "gum/quantity/dense_factors.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

// A mirror image that is this far off before any refinement cannot be brought to explain the distances.
constexpr double k_hopeless_misfit = 2.0 * gum::k_millimetre;
constexpr double k_hopeless_factor = 20.0;

}  // namespace

Eigen::Vector3d mirror_image(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& place) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : points) {
        centre += point / static_cast<double>(points.size());
    }
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& point : points) {
        scatter += (point - centre) * (point - centre).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
    const Eigen::Vector3d normal = eigen.eigenvectors().col(0);
    return place - 2.0 * normal.dot(place - centre) * normal;
}

std::vector<Eigen::Vector3d> all_sides(const Eigen::Vector3d& centre) {
    // How far off matters little: from 0.6 m and from 1.5 m the same were found.
    constexpr double k_distance = 1.0;  // [m]
    std::vector<Eigen::Vector3d> result;
    for (int c = 0; c < 3; ++c) {
        for (const double side : {1.0, -1.0}) {
            result.emplace_back(centre + side * k_distance * Eigen::Vector3d::Unit(c));
        }
    }
    return result;
}

std::vector<Eigen::Vector3d> sphere_grid(const Eigen::Vector3d& centre) {
    constexpr int k_directions = 60;
    std::vector<Eigen::Vector3d> grid;
    // From one to the next by a factor of 1.6 to 2: no station is far from one of them.
    for (const double distance : {0.3, 0.6, 1.0, 1.6, 2.6, 4.2}) {
        for (int k = 0; k < k_directions; ++k) {
            const double z = 1.0 - (2.0 * k + 1.0) / k_directions;
            const double azimuth = std::numbers::pi * (3.0 - std::sqrt(5.0)) * k;
            const double r = std::sqrt(1.0 - z * z);
            grid.emplace_back(centre + distance * Eigen::Vector3d(r * std::cos(azimuth), r * std::sin(azimuth), z));
        }
    }
    return grid;
}

std::vector<Eigen::Vector3d> open_line(const ClosedSolution& closed) {
    std::vector<Eigen::Vector3d> line;
    // Three metres to either side in steps of an eighth: a descent finds the station from a tenth of a metre
    // off (design note rotary-table.md, 4c).
    for (int k = -24; k <= 24; ++k) {
        line.emplace_back(closed.position -
                          closed.open * (closed.open.dot(closed.position - closed.centre) - 0.125 * k));
    }
    return line;
}

std::vector<Eigen::Vector3d> best_of(const StationDistances& data, const std::vector<Eigen::Vector3d>& points,
                                     const std::vector<Eigen::Vector3d>& grid, std::size_t count) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        order.emplace_back(misfit_of(data, deviations_from(data, points, grid[k]).each), k);
    }
    std::sort(order.begin(), order.end());
    std::vector<Eigen::Vector3d> best;
    for (const auto& [value, k] : order) {
        const Eigen::Vector3d& position = grid[k];
        if (best.size() < count && std::all_of(best.begin(), best.end(), [&](const Eigen::Vector3d& other) {
                return (other - position).norm() > 0.2;
            })) {
            best.push_back(position);
        }
    }
    return best;
}

bool is_hopeless(const StationDistances& data, const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& place,
                 double reached) {
    return misfit_of(data, deviations_from(data, points, place).each) >
           std::max(k_hopeless_misfit, k_hopeless_factor * reached);
}

}  // namespace gumcert::engine
