#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "engine/rotary_table/trials/trial_lanes.h"
#include "engine/rotary_table/trials/trial_network.h"

namespace gumcert::engine {

/// Space for 16 trials that are computed side by side.
struct TrialBatch {
    explicit TrialBatch(const TrialNetwork& network)
        : residual_start(network.lengths.size()),
          prior_observed(network.prior_residual.size()),
          axial_deviation(network.visits.size()),
          delta(network.nominal.size()),
          thermal(static_cast<std::size_t>(network.stations + 1)),
          gradient(delta.size()),
          step(delta.size()),
          next_thermal(thermal.size()),
          residual(network.lengths.size()),
          place(3 * static_cast<std::size_t>(network.stations)),
          scale(static_cast<std::size_t>(network.stations)),
          stretch(static_cast<std::size_t>(network.stations)),
          point(3 * static_cast<std::size_t>(network.reflectors)),
          turned(point.size()),
          pull(point.size()),
          difference(3 * static_cast<std::size_t>(network.largest_visit)),
          distance(static_cast<std::size_t>(network.largest_visit)),
          inverse_distance(distance.size()),
          weighted(distance.size()),
          misclosure(std::max<std::size_t>(distance.size(), point.size())),
          border_gradient(network.border.size()),
          border_step(network.border.size()),
          thermal_normal(thermal.size() * thermal.size()),
          thermal_step(thermal.size()),
          by_own(thermal.size()),
          by_expansion(thermal.size()),
          pose_rotation(9 * static_cast<std::size_t>(network.angles)),
          errors(6 * static_cast<std::size_t>(network.angles)) {}

    // What is drawn.
    std::vector<Lanes> residual_start;   ///< observed - predicted at the solution
    std::vector<Lanes> prior_observed;   ///< minus the value at the solution
    std::vector<Lanes> axial_deviation;  ///< one a visit

    // Where the trials are.
    std::vector<Lanes> delta;    ///< slots, from the solution
    std::vector<Lanes> thermal;  ///< temperatures and expansion from the solution, in parts of their u
    Lanes active{};              ///< 1: not converged yet

    // The next step.
    std::vector<Lanes> gradient, step;  ///< slots
    std::vector<Lanes> next_thermal;
    Lanes size{};  ///< largest step of a reported component, in parts of its standard uncertainty

    // Kinematics.
    std::vector<Lanes> residual;                                                      ///< of the lengths
    std::vector<Lanes> place, scale, stretch;                                         ///< of the stations
    std::vector<Lanes> point, turned, pull;                                           ///< of the reflectors, 3 each
    std::vector<Lanes> difference, distance, inverse_distance, weighted, misclosure;  ///< of one visit

    // Normal equations.
    std::vector<Lanes> border_gradient, border_step;
    std::vector<Lanes> thermal_normal, thermal_step;
    std::vector<Lanes> by_own, by_expansion;  ///< ∂stretch/∂(its temperature), ∂stretch/∂expansion, in parts of u
    Lanes thermal_moves{};                    ///< 1: expansion and temperatures not found yet

    // Change of datum.
    std::vector<Lanes> pose_rotation;  ///< 9 an angle, minus the identity
    std::vector<Lanes> errors;         ///< 6 an angle, in the datum
    std::array<Lanes, 10> change{};
    std::array<Lanes, 6> world{}, set_up{};
};

}  // namespace gumcert::engine
