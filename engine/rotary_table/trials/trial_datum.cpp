#include "engine/rotary_table/trials/trial_datum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/rotation.h"

namespace gumcert::engine {

// A trial keeps the ten conditions of the datum with its exact motions, as the solution does (ADR 0006):
// 1. World and set-up change by the map of the solution, to first order in what the poses of the trial deviate.
// 2. The errors are formed anew with them, E' = W E (R T_old T_new⁻¹ R⁻¹).
// 3. The same map says what these errors still have that the datum forbids; world and set-up change by that, from 2
// again.
// Each round brings down what is forbidden by the size of the motions themselves, which are small: a few of them reach
// the last digits.

TrialDatum::TrialDatum(const JointAdjustment& solved)
    : datum(solved.measurement().datum), home(static_cast<Eigen::Index>(solved.measurement().home)) {
    const RotaryTableMeasurement& measurement = solved.measurement();
    const auto across = across_axis(measurement.axis);
    // Axis first, then the two coordinates across it in right-handed order: a nominal rotation mixes only these two.
    cyclic = {axial_coordinate(measurement.axis), across[0], across[1]};
    for (const double angle : measurement.angles) {
        const double turn = angle - measurement.angles[measurement.home];
        cosine.push_back(std::cos(turn));
        sine.push_back(std::sin(turn));
    }
    // As the difference from the identity, as all rotations here are.
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            set_up_rotation[static_cast<std::size_t>(3 * r + c)] =
                solved.set_up().rotation(r, c) - (r == c ? 1.0 : 0.0);
        }
        set_up_translation[static_cast<std::size_t>(r)] = solved.set_up().translation[r];
    }
    const DatumSolution solution = transform_to_datum(measurement, solved.poses(), solved.set_up(), datum);
    start_world = motion_parameters(solution.world);
    start_set_up = solution.set_up;
    change_map = solution.change_map();
    // The set-up of a trial is changed by its own numbers.
    if (solution.inclined) {
        change_map.bottomRows<4>() = solution.stated_set_up_map();
    }
}

namespace {

using Index = Eigen::Index;

/// C = A B of rotations given by their differences from the identity.
GUMCERT_INLINE void multiply_rotations(const Lanes* a, const Lanes* b, Lanes* product) {
    for (int r = 0; r < 3; ++r) {
        // Rotations are held as R − I. Angles are microradians: beside the 1 on the diagonal an element of 1e-6 would
        // keep ten digits, of its own it keeps all, and (I + A)(I + B) − I = A + B + A B adds small numbers only.
        const Lanes* row = a + 3 * r;
        for (int c = 0; c < 3; ++c) {
            const Lanes* column = b + c;
            Lanes& to = product[3 * r + c];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                to[t] = row[c][t] + column[3 * r][t] +
                        (row[0][t] * column[0][t] + row[1][t] * column[3][t] + row[2][t] * column[6][t]);
            }
        }
    }
}

/// Start of the transformation: rotations of all poses, and the change of datum to first order.
GUMCERT_WIDE_CLONES
void begin_datum(const TrialNetwork& network, const TrialDatum& datum, TrialBatch& batch) {
    std::array<Lanes, 3> angles;
    for (Index i = 0; i < network.angles; ++i) {
        const Index first = network.poses + 6 * i + 3;
        for (int c = 0; c < 3; ++c) {
            const double nominal = network.nominal_at(first + c);
            const Lanes& delta = batch.delta[static_cast<std::size_t>(first + c)];
            Lanes& to = angles[static_cast<std::size_t>(c)];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                to[t] = nominal + delta[t];
            }
        }
        rotation_from_identity(angles.data(), &batch.pose_rotation[static_cast<std::size_t>(9 * i)]);
    }
    for (Lanes& change : batch.change) {
        fill(change, 0.0);
    }
    // The map that is exact to first order at the solution serves for every step: it only has to bring the forbidden
    // part down, which compose_errors() then measures with the exact motions.
    multiply_add(datum.change_map.data(), 10, 6 * network.angles, &batch.delta[static_cast<std::size_t>(network.poses)],
                 batch.change.data());
    for (int c = 0; c < 6; ++c) {
        fill(batch.world[static_cast<std::size_t>(c)], datum.start_world[c]);
        fill(batch.set_up[static_cast<std::size_t>(c)], datum.start_set_up[c]);
    }
    fill(batch.active, 1.0);
}

/// Changes world and set-up of the trials that have not converged yet.
GUMCERT_WIDE_CLONES
void change_datum(const TrialDatum& datum, TrialBatch& batch) {
    const Lanes active = batch.active;
    const auto add = [&](const Lanes& change, Lanes& to) {
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            // A trial that has converged is left as it is: its bits must not depend on how long its neighbours take.
            to[t] += active[t] != 0.0 ? change[t] : 0.0;
        }
    };
    for (std::size_t c = 0; c < 6; ++c) {
        add(batch.change[c], batch.world[c]);
    }
    for (std::size_t c = 0; c < 2; ++c) {
        const auto across = static_cast<std::size_t>(datum.cyclic[1 + c]);
        add(batch.change[6 + c], batch.set_up[across]);
        add(batch.change[8 + c], batch.set_up[3 + across]);
    }
}

/// Error motions with respect to the present world and set-up, world E turn (set-up change)⁻¹ turn⁻¹, and the change
/// that they ask for.
GUMCERT_WIDE_CLONES
void compose_errors(const TrialNetwork& network, const TrialDatum& datum, TrialBatch& batch) {
    std::array<Lanes, 81> space;
    Lanes* const world = space.data();
    Lanes* const new_set_up = world + 9;
    Lanes* const old_set_up = new_set_up + 9;
    Lanes* const inverse = old_set_up + 9;
    Lanes* const back = inverse + 9;  // old set-up times the inverse of the new one
    Lanes* const back_shift = back + 9;
    Lanes* const turned = back_shift + 3;  // `back` seen from the fixture at this angle
    Lanes* const turned_shift = turned + 9;
    Lanes* const moved = turned_shift + 3;
    Lanes* const moved_shift = moved + 9;
    Lanes* const result = moved_shift + 3;
    const Lanes* const world_motion = batch.world.data();
    const Lanes* const set_up = batch.set_up.data();
    rotation_from_identity(world_motion + 3, world);
    rotation_from_identity(set_up + 3, new_set_up);
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
            fill(old_set_up[3 * r + c], datum.set_up_rotation[3 * r + c]);
            inverse[3 * r + c] = new_set_up[3 * c + r];
        }
    }
    multiply_rotations(old_set_up, inverse, back);
    for (std::size_t r = 0; r < 3; ++r) {
        // old − R new with R = I + back is (old − new) − back new: nearly equal numbers are subtracted first, and what
        // is left is a product of small ones.
        const double old = datum.set_up_translation[r];
        const Lanes* row = &back[3 * r];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            back_shift[r][t] =
                (old - set_up[r][t]) - (row[0][t] * set_up[0][t] + row[1][t] * set_up[1][t] + row[2][t] * set_up[2][t]);
        }
    }
    const auto a = static_cast<std::size_t>(datum.cyclic[0]);
    const auto p = static_cast<std::size_t>(datum.cyclic[1]);
    const auto q = static_cast<std::size_t>(datum.cyclic[2]);
    for (Index i = 0; i < network.angles; ++i) {
        // R(θ) X R(θ)ᵀ with a rotation about one coordinate: rows and columns across the axis turn, nothing is
        // multiplied by 0 and 1.
        const double c = datum.cosine[static_cast<std::size_t>(i)];
        const double s = datum.sine[static_cast<std::size_t>(i)];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            turned[3 * a + a][t] = back[3 * a + a][t];
            turned[3 * a + p][t] = c * back[3 * a + p][t] - s * back[3 * a + q][t];
            turned[3 * a + q][t] = s * back[3 * a + p][t] + c * back[3 * a + q][t];
            turned[3 * p + a][t] = c * back[3 * p + a][t] - s * back[3 * q + a][t];
            turned[3 * q + a][t] = s * back[3 * p + a][t] + c * back[3 * q + a][t];
            const double pp = c * back[3 * p + p][t] - s * back[3 * q + p][t];
            const double pq = c * back[3 * p + q][t] - s * back[3 * q + q][t];
            const double qp = s * back[3 * p + p][t] + c * back[3 * q + p][t];
            const double qq = s * back[3 * p + q][t] + c * back[3 * q + q][t];
            turned[3 * p + p][t] = c * pp - s * pq;
            turned[3 * p + q][t] = s * pp + c * pq;
            turned[3 * q + p][t] = c * qp - s * qq;
            turned[3 * q + q][t] = s * qp + c * qq;
            turned_shift[a][t] = back_shift[a][t];
            turned_shift[p][t] = c * back_shift[p][t] - s * back_shift[q][t];
            turned_shift[q][t] = s * back_shift[p][t] + c * back_shift[q][t];
        }
        const Index pose = network.poses + 6 * i;
        multiply_rotations(world, &batch.pose_rotation[static_cast<std::size_t>(9 * i)], moved);
        const Lanes* delta = &batch.delta[static_cast<std::size_t>(pose)];
        const double x = network.nominal_at(pose);
        const double y = network.nominal_at(pose + 1);
        const double z = network.nominal_at(pose + 2);
        for (std::size_t r = 0; r < 3; ++r) {
            const Lanes* row = &world[3 * r];
            const double own = network.nominal_at(pose + static_cast<Index>(r));
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                moved_shift[r][t] =
                    world_motion[r][t] + (own + delta[r][t]) +
                    (row[0][t] * (x + delta[0][t]) + row[1][t] * (y + delta[1][t]) + row[2][t] * (z + delta[2][t]));
            }
        }
        multiply_rotations(moved, turned, result);
        Lanes* errors = &batch.errors[static_cast<std::size_t>(6 * i)];
        for (std::size_t r = 0; r < 3; ++r) {
            const Lanes* row = &moved[3 * r];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                errors[r][t] =
                    moved_shift[r][t] + turned_shift[r][t] +
                    (row[0][t] * turned_shift[0][t] + row[1][t] * turned_shift[1][t] + row[2][t] * turned_shift[2][t]);
            }
        }
        angles_from_rotation(result, errors + 3);
    }
    for (Lanes& change : batch.change) {
        fill(change, 0.0);
    }
    multiply_add(datum.change_map.data(), 10, 6 * network.angles, batch.errors.data(), batch.change.data());
}

}  // namespace

void transform_to_datum(const TrialNetwork& network, const TrialDatum& datum, TrialBatch& batch) {
    // A billionth of what an error motion is known to.
    constexpr double k_negligible = 1e-16;  // [m] and [rad]
    begin_datum(network, datum, batch);
    change_datum(datum, batch);
    // As of the solution: beyond it the conditions of the datum do not hold.
    constexpr double k_holds = 1e-12;
    std::array<double, k_lanes> forbidden{};
    for (int iteration = 0; iteration < 20; ++iteration) {
        compose_errors(network, datum, batch);
        for (int t = 0; t < k_lanes; ++t) {
            double& largest = forbidden[static_cast<std::size_t>(t)];
            largest = 0.0;
            for (const Lanes& change : batch.change) {
                largest = std::max(largest, std::abs(change[t]));
            }
            // NaN compares as false and ends the lane: its trial has no value, and must not keep the others waiting.
            batch.active[t] = batch.active[t] != 0.0 && largest >= k_negligible ? 1.0 : 0.0;
        }
        if (!any(batch.active)) {
            break;
        }
        change_datum(datum, batch);
    }
    // A trial that is not in the datum has no value: Monte Carlo ends and names it.
    for (int t = 0; t < k_lanes; ++t) {
        if (forbidden[static_cast<std::size_t>(t)] >= k_holds) {
            for (Lanes& error : batch.errors) {
                error[t] = std::numeric_limits<double>::quiet_NaN();
            }
        }
    }
    // Zero by definition and not by what the last step leaves.
    if (datum.datum == Datum::home) {
        for (Index c = 0; c < 6; ++c) {
            fill(batch.errors[static_cast<std::size_t>(6 * datum.home + c)], 0.0);
        }
    }
}

}  // namespace gumcert::engine
