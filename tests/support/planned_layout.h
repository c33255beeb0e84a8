#pragma once

// Layouts for the tests of plans.

#include <Eigen/Core>

#include <vector>

#include "engine/rotary_table/studies/measurement_plan.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine::planned {

/// The layout of a plan of a campaign, without what its lengths say.
inline RotaryTableMeasurement layout_of(synthetic::CampaignPlan plan) {
    plan.noise = 0.0;
    synthetic::Campaign campaign = synthetic::simulate(plan);
    for (std::size_t j = 0; j < campaign.truth.stations.size(); ++j) {
        campaign.measurement.station_start[j] = campaign.truth.stations[j];
    }
    predict_lengths(campaign.measurement);
    return campaign.measurement;
}

/// All stations close to the x axis.
inline std::vector<Eigen::Vector3d> narrow_cone() {
    // rotary_model_check.py, section D2: directions from the middle of the reflectors drawn towards the x axis.
    const synthetic::CampaignPlan plan;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : plan.reflectors) {
        middle += p / 6.0;
    }
    std::vector<Eigen::Vector3d> stations;
    for (const Eigen::Vector3d& q : plan.stations) {
        const double distance = (q - middle).norm();
        const Eigen::Vector3d direction = Eigen::Vector3d::UnitX() + 0.15 / distance * (q - middle);
        stations.emplace_back(middle + distance * direction.normalized());
    }
    return stations;
}

}  // namespace gumcert::engine::planned
