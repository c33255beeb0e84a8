#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/trials/trial_batch.h"
#include "engine/rotary_table/trials/trial_network.h"

namespace gumcert::engine {

/// The datum of the result, laid out for the trials of RotaryTableTrials.
struct TrialDatum {
    explicit TrialDatum(const JointAdjustment& solved);

    Datum datum;
    Eigen::Index home;
    std::array<int, 3> cyclic;                ///< coordinate along the axis, then the two across it
    std::vector<double> cosine, sine;         ///< of the turn to every angle
    std::array<double, 9> set_up_rotation{};  ///< of the solver's T_s, minus the identity
    std::array<double, 3> set_up_translation{};
    Eigen::Matrix<double, 6, 1> start_world, start_set_up;
    TrialNetwork::RowMajorMatrix change_map;  ///< 10×6N: (world, O, O, S, S) that takes away what the datum forbids
};

/// The errors and the set-up of the trials in the datum, as `transform_to_datum` finds them.
void transform_to_datum(const TrialNetwork& network, const TrialDatum& datum, TrialBatch& batch);

}  // namespace gumcert::engine
