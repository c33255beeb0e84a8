#pragma once

#include <cstddef>
#include <vector>

#include "engine/rotary_table/anglewise_map.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/reliability.h"

namespace gumcert::engine {

/// External reliability: how much of an error that the tests would just not find reaches a reported quantity.
struct ExternalReliability {
    std::size_t quantity = 0;  ///< index of the reported quantity
    std::size_t length = 0;    ///< index of the distance whose minimal detectable bias changes it most
    double influence = 0.0;    ///< change of the quantity by that bias, [m] or [rad]
};

/// One row a reported quantity that depends on a distance at all, by the gain of the joint estimator: dead paths,
/// stations and fixture are estimated anew from the wrong distance.
///
/// A distance of another angle acts only through what all angles share. Those are looked at in the order of the largest
/// influence that they can have, and only while it is above the largest found: the costs grow with the angles, not with
/// their square, and the row is that of all distances.
///
/// \param sensitivity  of the reported quantities by the distances, with free dead paths
/// \param rows         of `distance_reliability`
[[nodiscard]] std::vector<ExternalReliability> external_reliability(const AnglewiseSensitivity& sensitivity,
                                                                    const JointAdjustment& adjustment,
                                                                    const std::vector<DistanceReliability>& rows);

}  // namespace gumcert::engine
