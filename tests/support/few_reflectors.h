// Layouts of few reflectors on dead paths of their own: distances of many places, and of the mirror image of the table, are near.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine::synthetic {

/// A ring of reflectors, stations round it, a fixture that stands millimetres off the axis.
/// \param height       of the reflectors along the axis, from `height[0]` to `height[1]`, [m]
/// \param last_deg     of the angles
/// \param most_offset  of the fixture, [m]
inline CampaignPlan ring_of_few(std::uint64_t seed, std::size_t reflectors, const Eigen::Vector2d& height,
                                double last_deg, double most_offset) {
    Noise draw(seed + 2000000);  // another series than that of the distances
    const auto between = [&](double low, double high) { return low + (high - low) * draw.uniform(); };
    const auto around = [&](double along, double from, double to, double azimuth) {
        const double radius = between(from, to);
        return Eigen::Vector3d(along, radius * std::cos(azimuth), radius * std::sin(azimuth));
    };
    CampaignPlan plan;
    plan.reflectors.clear();
    for (std::size_t k = 0; k < reflectors; ++k) {
        const double even = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(reflectors);
        plan.reflectors.push_back(around(between(height[0], height[1]), 0.06, 0.15, even + between(-0.5, 0.5)));
    }
    plan.stations.clear();
    for (std::size_t j = 3 + static_cast<std::size_t>(6.0 * draw.uniform()); j > 0; --j) {
        plan.stations.push_back(around(between(0.3, 1.2), 0.7, 1.5, between(-1.5, 1.5)));
    }
    plan.angles_deg = partial_turn(last_deg, 5 + static_cast<int>(4.0 * draw.uniform()));
    plan.dead_paths = DeadPaths::per_station_and_reflector;
    plan.offset = {between(-most_offset, most_offset), between(-most_offset, most_offset)};
    plan.tilt = {between(-0.05, 0.05), between(-0.05, 0.05)};
    plan.seed = seed;
    return plan;
}

}  // namespace gumcert::engine::synthetic
