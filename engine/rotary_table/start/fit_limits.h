#pragma once

#include "gum/quantity/units.h"

namespace gumcert::engine {

// Limits of what a fit of a station leaves, for all searches of this layer.

/// With the set-up found, what remains is the error motions: micrometres. A station above this needs a closer search. [m]
constexpr double k_good_misfit = 0.1 * gum::k_millimetre;
/// What a rigid body leaves of the distances of a station: error motions and set-up errors. Labels that are wrong leave
/// centimetres; with the right ones next to nothing of that is left. [m]
constexpr double k_wrong_labels = 1.0 * gum::k_millimetre;
constexpr double k_share_with_right_labels = 0.05;
/// Standard deviation by median absolute deviation, of a normal distribution.
constexpr double k_mad_to_deviation = 1.4826;
/// A rival with less than this times the misfit explains as much.
constexpr double k_rival_factor = 2.0;
/// Two places nearer to each other than that are one. [m]
constexpr double k_rival_distance = 0.01;

}  // namespace gumcert::engine
