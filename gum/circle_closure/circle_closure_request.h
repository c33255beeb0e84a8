#pragma once

#include <optional>

#include "engine/circle_closure.h"
#include "gum/monte_carlo/monte_carlo_request.h"
#include "gum/quantity/unit.h"

namespace gumcert::gum {

/// Two divided circles that were compared with each other (gum/circle_closure/evaluate_circle_closure.h): the measurement
/// in radians, and what is asked for.
struct CircleClosureRequest {
    double coverage_probability = 0.9545;  ///< [1]
    Unit unit;                             ///< an angle: validation compares results as they are stated in it
    engine::CircleClosureMeasurement measurement;
    std::optional<MonteCarloRequest> monte_carlo;
};

}  // namespace gumcert::gum
