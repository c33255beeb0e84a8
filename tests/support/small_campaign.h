// A simulated rotary table that is searched in a moment, and what a search says of it, for tests.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine::synthetic {

/// Six stations, six reflectors, twelve angles in both senses, a dead path of each station.
inline CampaignPlan small_plan(std::uint64_t seed = 1) {
    CampaignPlan plan;
    plan.angles_deg = full_turn(12);
    plan.both_senses = true;
    plan.seed = seed;
    return plan;
}

/// The same without noise, error motions and set-up errors: distances of the stations in the plan.
inline CampaignPlan exact_plan() {
    CampaignPlan plan = small_plan();
    plan.noise = 0.0;
    plan.error_factor = 0.0;
    plan.offset.setZero();
    plan.tilt.setZero();
    return plan;
}

/// The problems with which something is refused; none where it is not.
inline std::vector<gum::Diagnostic> problems_of(const std::function<void()>& ask) {
    try {
        ask();
    } catch (const gum::NoResultError& error) {
        return error.diagnostics();
    }
    return {};
}

}  // namespace gumcert::engine::synthetic
