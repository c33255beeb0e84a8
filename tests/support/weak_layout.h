// Layouts that hardly determine what is sought: few stations, reflectors and angles, anywhere.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine::synthetic {

/// Three to five stations anywhere beside the table, three to five reflectors and few angles.
inline CampaignPlan weak_layout(std::uint64_t seed) {
    Noise draw(seed + 1000000);  // another series than that of the distances
    const auto between = [&](double low, double high) { return low + (high - low) * draw.uniform(); };
    const auto one_of = [&](std::size_t count) {
        return std::min(count - 1, static_cast<std::size_t>(draw.uniform() * static_cast<double>(count)));
    };
    CampaignPlan plan;
    plan.stations.clear();
    for (std::size_t j = 3 + one_of(3); j > 0; --j) {
        plan.stations.emplace_back(between(0.2, 1.5), between(-1.5, 1.5), between(-0.9, 0.9));
    }
    plan.reflectors.resize(3 + one_of(3));
    const std::size_t angles = std::array<std::size_t, 6>{3, 4, 5, 6, 8, 12}[one_of(6)];
    plan.angles_deg = full_turn(static_cast<int>(angles));
    if (one_of(2) == 1) {
        for (std::size_t i = 1; i < angles; ++i) {
            plan.angles_deg[i] = std::round(between(1.0, 359.0));
        }
        std::ranges::sort(plan.angles_deg);
        plan.angles_deg.erase(std::ranges::unique(plan.angles_deg).begin(), plan.angles_deg.end());
    }
    plan.both_senses = one_of(2) == 1;
    plan.dead_paths = one_of(3) == 0 ? DeadPaths::per_station : DeadPaths::per_station_and_reflector;
    plan.missing_share = one_of(2) == 1 ? 0.08 : 0.0;
    plan.cmm_factor = std::pow(10.0, between(-0.5, 1.3));
    plan.table_linear = std::pow(10.0, between(-7.3, -5.7));
    plan.table_axial = k_arcsec * std::pow(10.0, between(-1.3, 0.3));
    plan.table_tilt = k_arcsec * std::pow(10.0, between(-1.3, 0.3));
    plan.seed = seed;
    return plan;
}

}  // namespace gumcert::engine::synthetic
