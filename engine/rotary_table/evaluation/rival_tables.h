#pragma once

#include <vector>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/start/common_set_up.h"

namespace gumcert::engine {

/// A joint adjustment that begins with places of the stations.
struct PlacedAdjustment {
    CommonFit places;    ///< found without error motions
    RigidMotion set_up;  ///< T_s that the adjustment holds: 1, or of an inclined fixture where it was found
    StartValues start;   ///< made of the places
    JointAdjustment adjustment;
    SolveSummary summary = {};  ///< of the adjustment, once it was solved
};

// Whitened residual of a visit, together, above which a robust search lets it count less.
constexpr double k_robust_scale = 10.0;

/// Not solved. It begins where the start values are, the table turning about the axis that they have.
/// \param set_up  T_s that it holds
/// \param start   positions with that T_s
[[nodiscard]] JointAdjustment adjustment_from_start(const RotaryTableMeasurement& measurement,
                                                    const std::vector<bool>& active, const RigidMotion& set_up,
                                                    const StartValues& start, const StochasticModel& stochastic);

/// Not solved.
/// \param observed  of the same distances
/// \param active    one flag a length: false = left out
[[nodiscard]] PlacedAdjustment placed_adjustment(const ObservedStations& observed, const std::vector<bool>& active,
                                                 CommonFit places, const StochasticModel& stochastic,
                                                 const Workers& workers);

/// Of tables that the distances may mean as well, the one that they fit best.
///
/// A search without error motions hardly tells them apart; the adjustment does. The mirror image of the table is asked wherever its
/// distances are near (mirrored_table()). Where far more is left than noise and a table that repeats well leave, the stations are
/// looked for once more, within reach (fit_within_reach()) and by turns (fit_by_turns()), and where it is more than any table leaves
/// on the other sides of all planes (fit_on_other_side()): few reflectors on dead paths of their own, seen over part of a turn, lead
/// a search to places at which error motions that nobody has make up for the rest. With fewer than 100 degrees of freedom all of it
/// is asked whatever fits. A fixture inclined by more than 10° is no rival of one that is less, nor is a table whose stations stand
/// a decimetre farther from where they are stated, nor one that fits as well by error motions five times as large.
///
/// Compared are costs by Cauchy's function, in which gross errors hardly count; with none of them they are chi-squares. What counts
/// as gross is judged by the noise that is left, as a stated one may be far too small; the better one is so with the stated one as
/// well. Clearly better is an odds ratio of 1 : 20000. Where neither is clearly better stated positions decide.
///
/// \param solver              for all
/// \param degrees_of_freedom  of each
/// \param placed              solved; becomes the better one
/// \throws gum::NoResultError  GC-RANK-0001 where two fit alike, and no position is stated; GC-ADJUST-0016 where the distances
///                             speak against stated positions; GC-ADJUST-0018 where these are those of the mirror image of all
void settle_rival_tables(const ObservedStations& observed, const std::vector<bool>& active,
                         const StochasticModel& stochastic, const SolverOptions& solver, double degrees_of_freedom,
                         PlacedAdjustment& placed);

}  // namespace gumcert::engine
