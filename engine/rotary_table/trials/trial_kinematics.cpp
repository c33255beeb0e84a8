#include "engine/rotary_table/trials/trial_kinematics.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace gumcert::engine {

namespace {

using Index = Eigen::Index;

/// The parameters of the trials where they are needed as such.
GUMCERT_WIDE_CLONES
void prepare(const TrialNetwork& network, TrialBatch& batch) {
    const Lanes* delta = batch.delta.data();
    for (Index j = 0; j < network.stations; ++j) {
        const Index first = network.station_slot(j, 0);
        for (Index c = 0; c < 3; ++c) {
            const double nominal = network.nominal_at(first + c);
            Lanes& place = batch.place[static_cast<std::size_t>(3 * j + c)];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                place[t] = nominal + delta[first + c][t];
            }
        }
        const double nominal_scale = 1.0 + network.nominal_at(first + TrialNetwork::k_scale);
        const double nominal_stretch = 1.0 + network.nominal_at(first + TrialNetwork::k_stretch);
        const Lanes& scale_change = delta[first + TrialNetwork::k_scale];
        const Lanes& stretch_change = delta[first + TrialNetwork::k_stretch];
        Lanes& scale = batch.scale[static_cast<std::size_t>(j)];
        Lanes& stretch = batch.stretch[static_cast<std::size_t>(j)];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            scale[t] = nominal_scale + scale_change[t];
            stretch[t] = nominal_stretch + stretch_change[t];
        }
    }
    for (Index c = 0; c < 3 * network.reflectors; ++c) {
        const double nominal = network.nominal_at(network.fixture + c);
        Lanes& point = batch.point[static_cast<std::size_t>(c)];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            point[t] = nominal + delta[network.fixture + c][t];
        }
    }
    for (Lanes& gradient : batch.gradient) {
        fill(gradient, 0.0);
    }
}

/// 1/√(1 + z) - 1, by its power series up to 2⁻⁹, where the first term left out is below 2⁻⁵⁸ of the sum.
GUMCERT_INLINE double small_inverse_root(double z) {
    return z * (-0.5 + z * (0.375 + z * (-0.3125 + z * (35.0 / 128.0 + z * (-63.0 / 256.0 + z * (231.0 / 1024.0))))));
}

/// Differences, distances and residuals of the lengths of one visit.
///
/// d - d0 comes from the change of P - q by (P - q)² - (P0 - q0)²: no digits are lost to the distance itself.
GUMCERT_INLINE void predict_visit(const TrialNetwork& network, const TrialNetwork::VisitPlan& visit, const Lanes* base,
                                  TrialBatch& batch, Lanes* residuals) {
    constexpr double k_small = 0x1p-9;
    const Lanes& stretch = batch.stretch[static_cast<std::size_t>(visit.station)];
    const Lanes& scale = batch.scale[static_cast<std::size_t>(visit.station)];
    const Index scale_slot = TrialNetwork::station_slot(visit.station, TrialNetwork::k_scale);
    const Lanes& scale_change = batch.delta[static_cast<std::size_t>(scale_slot)];
    for (Index k = 0; k < visit.count; ++k) {
        const TrialNetwork::Length& length = network.lengths[static_cast<std::size_t>(visit.first + k)];
        const Lanes* turned = &batch.turned[static_cast<std::size_t>(3 * length.reflector)];
        const Lanes& path_change = batch.delta[static_cast<std::size_t>(length.path_slot)];
        const Lanes& start = batch.residual_start[static_cast<std::size_t>(visit.first + k)];
        Lanes* difference = &batch.difference[static_cast<std::size_t>(3 * k)];
        Lanes& distance = batch.distance[static_cast<std::size_t>(k)];
        Lanes& inverse = batch.inverse_distance[static_cast<std::size_t>(k)];
        Lanes& residual = residuals[k];
        Lanes growth;  // of the squared distance, in parts of it
        Lanes longer;
        std::int64_t large = 0;
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            const double x = stretch[t] * turned[0][t] + base[0][t];
            const double y = stretch[t] * turned[1][t] + base[1][t];
            const double z = stretch[t] * turned[2][t] + base[2][t];
            difference[0][t] = x;
            difference[1][t] = y;
            difference[2][t] = z;
            // x² − x₀² = (x − x₀)(x + x₀): the change of the squared distance keeps the digits that a difference of
            // squares of metres would lose.
            const double square = (x - length.difference[0]) * (x + length.difference[0]) +
                                  (y - length.difference[1]) * (y + length.difference[1]) +
                                  (z - length.difference[2]) * (z + length.difference[2]);
            const double part = square * length.inverse_square;
            const double shorter = small_inverse_root(part);
            growth[t] = part;
            longer[t] = length.distance * (part + shorter + part * shorter);  // √(1 + z) = (1 + z)/√(1 + z)
            inverse[t] = length.inverse + length.inverse * shorter;
        }
        // Looked at by itself, because a branch in the loop above would keep it out of wide registers. Only lanes that
        // are far from the solution need the root.
        for (int t = 0; t < k_lanes; ++t) {
            large |= growth[t] > k_small || growth[t] < -k_small ? 1 : 0;
        }
        for (int t = 0; t < k_lanes && large != 0; ++t) {
            if (std::abs(growth[t]) > k_small) {
                const double root = std::sqrt(1.0 + growth[t]);
                longer[t] = length.distance * (growth[t] / (1.0 + root));
                inverse[t] = length.inverse / root;
            }
        }
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            distance[t] = length.distance + longer[t];
            // Changes only: start is the residual at the solution with what was drawn.
            residual[t] = start[t] - (scale[t] * longer[t] + scale_change[t] * length.distance - path_change[t]);
        }
    }
}

/// Jᵀ V⁻¹ v of the lengths of one visit: what they press on each parameter.
///
/// All presses act along lines through the station. So their torque is that of their sum, acting at the station, and
/// what they do to the stretch is what they do to the distances less what they do to the part that is not stretched.
GUMCERT_INLINE void add_visit(const TrialNetwork& network, const TrialNetwork::VisitPlan& visit, const Lanes* pose,
                              const Lanes* base, TrialBatch& batch, Lanes* turn_force, Lanes* turn_torque) {
    const Lanes* place = &batch.place[static_cast<std::size_t>(3 * visit.station)];
    const Lanes& stretch = batch.stretch[static_cast<std::size_t>(visit.station)];
    const Lanes& scale = batch.scale[static_cast<std::size_t>(visit.station)];
    Lanes* gradient = batch.gradient.data();
    std::array<Lanes, 3> space;
    Lanes* const force = space.data();
    Lanes along;
    fill(force[0], 0.0);
    fill(force[1], 0.0);
    fill(force[2], 0.0);
    fill(along, 0.0);
    for (Index k = 0; k < visit.count; ++k) {
        const TrialNetwork::Length& length = network.lengths[static_cast<std::size_t>(visit.first + k)];
        const Lanes& weighted = batch.weighted[static_cast<std::size_t>(k)];
        const Lanes& distance = batch.distance[static_cast<std::size_t>(k)];
        const Lanes& inverse = batch.inverse_distance[static_cast<std::size_t>(k)];
        const Lanes* difference = &batch.difference[static_cast<std::size_t>(3 * k)];
        Lanes* pull = &batch.pull[static_cast<std::size_t>(3 * length.reflector)];
        Lanes& path = gradient[length.path_slot];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            const double press = weighted[t] * scale[t] * inverse[t];
            const double x = press * difference[0][t];
            const double y = press * difference[1][t];
            const double z = press * difference[2][t];
            force[0][t] += x;
            force[1][t] += y;
            force[2][t] += z;
            pull[0][t] += stretch[t] * x;
            pull[1][t] += stretch[t] * y;
            pull[2][t] += stretch[t] * z;
            path[t] -= weighted[t];
            along[t] += weighted[t] * distance[t];
        }
    }
    Lanes* by_station = gradient + TrialNetwork::station_slot(visit.station, 0);
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        const double x = force[0][t];
        const double y = force[1][t];
        const double z = force[2][t];
        // All forces of a visit act along lines through the station: one arm for all of them.
        const double arm_x = place[0][t] - pose[0][t];
        const double arm_y = place[1][t] - pose[1][t];
        const double arm_z = place[2][t] - pose[2][t];
        turn_force[0][t] += x;
        turn_force[1][t] += y;
        turn_force[2][t] += z;
        turn_torque[0][t] += arm_y * z - arm_z * y;
        turn_torque[1][t] += arm_z * x - arm_x * z;
        turn_torque[2][t] += arm_x * y - arm_y * x;
        by_station[0][t] -= x;
        by_station[1][t] -= y;
        by_station[2][t] -= z;
        by_station[TrialNetwork::k_scale][t] += along[t];
        by_station[TrialNetwork::k_stretch][t] +=
            (scale[t] * along[t] - (x * base[0][t] + y * base[1][t] + z * base[2][t])) / stretch[t];
    }
}

/// Lengths of all visits of one angle in one sense: residuals, or residuals and gradient.
GUMCERT_WIDE_CLONES
void add_turn(const TrialNetwork& network, const TrialNetwork::Turn& turn, bool with_gradient, TrialBatch& batch) {
    std::array<Lanes, 42> space;
    Lanes* const pose = space.data();
    Lanes* const rotation = pose + 6;      // of E
    Lanes* const to_world = rotation + 9;  // from the fixture
    Lanes* const shift = to_world + 9;
    Lanes* const force = shift + 3;
    Lanes* const torque = force + 3;
    Lanes* const base = torque + 3;
    Lanes* const motion = base + 3;
    const Lanes* delta = batch.delta.data();
    for (int c = 0; c < 6; ++c) {
        const double nominal =
            network.nominal_at(turn.pose + c) + turn.half_sense * network.nominal_at(turn.reversal + c);
        const Lanes& change = delta[turn.pose + c];
        const Lanes& reversal = delta[turn.reversal + c];
        Lanes& to = pose[c];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            to[t] = nominal + (change[t] + turn.half_sense * reversal[t]);
        }
    }
    rotation_from_identity(pose + 3, rotation);
    // Metres are turned here, hence whole rotations; predict_visit() forms their differences without losing digits.
    for (const std::size_t diagonal : {std::size_t{0}, std::size_t{4}, std::size_t{8}}) {
        for (int t = 0; t < k_lanes; ++t) {
            rotation[diagonal][t] += 1.0;
        }
    }
    for (std::size_t r = 0; r < 3; ++r) {
        const Lanes* row = &rotation[3 * r];
        for (std::size_t c = 0; c < 3; ++c) {
            const double q0 = turn.to_table[c];
            const double q1 = turn.to_table[3 + c];
            const double q2 = turn.to_table[6 + c];
            Lanes& to = to_world[3 * r + c];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                to[t] = row[0][t] * q0 + row[1][t] * q1 + row[2][t] * q2;
            }
        }
        const double b0 = turn.offset[0];
        const double b1 = turn.offset[1];
        const double b2 = turn.offset[2];
        const Lanes& translation = pose[r];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            shift[r][t] = row[0][t] * b0 + row[1][t] * b1 + row[2][t] * b2 + translation[t];
        }
    }
    // Each reflector is turned once for all stations that see it at this angle and in this sense.
    for (std::size_t m = 0; m < batch.point.size(); m += 3) {
        const Lanes* point = &batch.point[m];
        for (std::size_t r = 0; r < 3; ++r) {
            const Lanes* row = &to_world[3 * r];
            Lanes& to = batch.turned[m + r];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                to[t] = row[0][t] * point[0][t] + row[1][t] * point[1][t] + row[2][t] * point[2][t];
            }
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        fill(force[c], 0.0);
        fill(torque[c], 0.0);
    }
    for (Lanes& pull : batch.pull) {
        fill(pull, 0.0);
    }

    for (std::size_t v = turn.begin; v < turn.end; ++v) {
        const TrialNetwork::VisitPlan& visit = network.visits[v];
        const Lanes* place = &batch.place[static_cast<std::size_t>(3 * visit.station)];
        for (std::size_t c = 0; c < 3; ++c) {
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                base[c][t] = shift[c][t] - place[c][t];
            }
        }
        Lanes* residual =
            with_gradient ? batch.misclosure.data() : &batch.residual[static_cast<std::size_t>(visit.first)];
        predict_visit(network, visit, base, batch, residual);
        if (!with_gradient) {
            continue;
        }
        const double* weights = &network.weights[visit.weights];
        for (Index k = 0; k < visit.count; ++k) {
            Lanes& weighted = batch.weighted[static_cast<std::size_t>(k)];
            fill(weighted, 0.0);
            // Without repeatability of the table V is diagonal: n products in place of n².
            if (visit.is_diagonal) {
                add_combination(weights + k * (visit.count + 1), 1, residual + k, weighted);
            } else {
                add_combination(weights + k * visit.count, visit.count, residual, weighted);
            }
        }
        add_visit(network, visit, pose, base, batch, force, torque);
    }
    if (!with_gradient) {
        return;
    }

    // Rotations turn about the axes Rz(c) Ry(b) x, Rz(c) y and z, all through the origin of the table: the torque about
    // each is the derivative.
    Lanes sine;
    Lanes versine;
    sine_and_versine(pose[5], sine, versine);
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        motion[0][t] = force[0][t];
        motion[1][t] = force[1][t];
        motion[2][t] = force[2][t];
        motion[3][t] = rotation[0][t] * torque[0][t] + rotation[3][t] * torque[1][t] + rotation[6][t] * torque[2][t];
        motion[4][t] = (1.0 - versine[t]) * torque[1][t] - sine[t] * torque[0][t];
        motion[5][t] = torque[2][t];
    }
    for (int c = 0; c < 6; ++c) {
        Lanes& by_pose = batch.gradient[static_cast<std::size_t>(turn.pose + c)];
        Lanes& by_reversal = batch.gradient[static_cast<std::size_t>(turn.reversal + c)];
        const Lanes& from = motion[c];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            by_pose[t] += from[t];
            by_reversal[t] += turn.half_sense * from[t];
        }
    }
    for (std::size_t m = 0; m < batch.pull.size(); m += 3) {
        const Lanes* pull = &batch.pull[m];
        for (std::size_t c = 0; c < 3; ++c) {
            Lanes& to = batch.gradient[static_cast<std::size_t>(network.fixture) + m + c];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                to[t] +=
                    to_world[c][t] * pull[0][t] + to_world[3 + c][t] * pull[1][t] + to_world[6 + c][t] * pull[2][t];
            }
        }
    }
}

/// The same of the prior values.
GUMCERT_WIDE_CLONES
void add_priors(const TrialNetwork& network, TrialBatch& batch) {
    for (const TrialNetwork::Prior& prior : network.priors) {
        const std::size_t size = prior.slots.size();
        for (std::size_t i = 0; i < size; ++i) {
            const Lanes& observed = batch.prior_observed[static_cast<std::size_t>(prior.first) + i];
            const Lanes& delta = batch.delta[static_cast<std::size_t>(prior.slots[i])];
            Lanes& misclosure = batch.misclosure[i];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                misclosure[t] = observed[t] - delta[t];
            }
        }
        for (std::size_t i = 0; i < size; ++i) {
            add_combination(prior.weights.data() + i * size, static_cast<Index>(size), batch.misclosure.data(),
                            batch.gradient[static_cast<std::size_t>(prior.slots[i])]);
        }
    }
}

}  // namespace

void find_gradient(const TrialNetwork& network, TrialBatch& batch) {
    prepare(network, batch);
    for (const TrialNetwork::Turn& turn : network.turns) {
        add_turn(network, turn, true, batch);
    }
    add_priors(network, batch);
}

void find_residuals(const TrialNetwork& network, TrialBatch& batch) {
    prepare(network, batch);
    for (const TrialNetwork::Turn& turn : network.turns) {
        add_turn(network, turn, false, batch);
    }
}

}  // namespace gumcert::engine
