#include "engine/rotary_table/trials/trial_solution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/rotary_table/trials/trial_kinematics.h"

namespace gumcert::engine {

namespace {

using Index = Eigen::Index;

/// The gradient of the border with the poses adjusted, and of the stretches with the rest of the border adjusted.
GUMCERT_WIDE_CLONES
void reduce_gradient(const TrialNetwork& network, TrialBatch& batch) {
    const auto border = static_cast<Index>(network.border.size());
    for (std::size_t b = 0; b < network.border.size(); ++b) {
        batch.border_gradient[b] = batch.gradient[static_cast<std::size_t>(network.border[b])];
    }
    // Poses first: what the lengths of an angle pull at the border is less what its pose takes up.
    std::array<Lanes, TrialNetwork::k_most_of_pose> own;
    for (const TrialNetwork::Elimination& pose : network.eliminated) {
        for (std::size_t i = 0; i < pose.slots.size(); ++i) {
            own[i] = batch.gradient[static_cast<std::size_t>(pose.slots[i])];
        }
        multiply_add(pose.to_border.data(), border, static_cast<Index>(pose.slots.size()), own.data(),
                     batch.border_gradient.data());
    }
    const Index plain = network.border_covariance.rows();
    multiply_add(network.thermal.from_border.data(), border - plain, plain, batch.border_gradient.data(),
                 batch.border_gradient.data() + plain);
}

/// Solves A x = b in the place of b; A n×n, positive definite, is overwritten.
GUMCERT_INLINE void solve_positive_definite(Lanes* a, std::size_t n, Lanes* b) {
    // No pivots are sought: A is the identity plus a positive semidefinite matrix here, its pivots are 1 or more.
    for (std::size_t k = 0; k < n; ++k) {
        Lanes inverse;
        for (int t = 0; t < k_lanes; ++t) {
            inverse[t] = 1.0 / a[k * n + k][t];
        }
        for (std::size_t i = k + 1; i < n; ++i) {
            Lanes factor;
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                factor[t] = a[i * n + k][t] * inverse[t];
                b[i][t] -= factor[t] * b[k][t];
            }
            for (std::size_t j = k + 1; j < n; ++j) {
#pragma GCC ivdep
                for (int t = 0; t < k_lanes; ++t) {
                    a[i * n + j][t] -= factor[t] * a[k * n + j][t];
                }
            }
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) {
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                b[k][t] -= a[k * n + j][t] * b[j][t];
            }
        }
        for (int t = 0; t < k_lanes; ++t) {
            b[k][t] /= a[k * n + k][t];
        }
    }
}

/// Steps of the stretches, 1 + α ΔT - (1 + α ΔT of the present parameters), to `next_thermal`.
GUMCERT_INLINE void stretch_steps(const TrialNetwork& network, TrialBatch& batch) {
    const TrialNetwork::Thermal& thermal = network.thermal;
    const auto stations = static_cast<std::size_t>(network.stations);
    const Lanes& expansion = batch.next_thermal[stations];
    Lanes* step = batch.border_step.data() + network.border_covariance.rows();
    for (std::size_t j = 0; j < stations; ++j) {
        // (α + δα)(T + δT) − α T = α δT + T δα + δα δT: the last term is what makes it a product, and no linear step
        // knows it.
        const double by_own = thermal.expansion * thermal.u_temperature[j];
        const double by_expansion = thermal.temperature[j] * thermal.u_expansion;
        const double by_both = thermal.u_temperature[j] * thermal.u_expansion;
        const Lanes& own = batch.next_thermal[j];
        const Index slot = TrialNetwork::station_slot(static_cast<Index>(j), TrialNetwork::k_stretch);
        const Lanes& present = batch.delta[static_cast<std::size_t>(slot)];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            step[j][t] = (by_own * own[t] + by_expansion * expansion[t] + by_both * own[t] * expansion[t]) - present[t];
        }
    }
}

/// One Gauss-Newton step of expansion and temperatures, with what the lengths want of the stretches
/// (`border_gradient`), everything else adjusted, and the values that were drawn for them. All in parts of u.
GUMCERT_WIDE_CLONES
void move_thermal(const TrialNetwork& network, TrialBatch& batch) {
    constexpr double k_tolerance = 1e-7;
    const TrialNetwork::Thermal& thermal = network.thermal;
    const auto stations = static_cast<std::size_t>(network.stations);
    const std::size_t n = stations + 1;
    const Index plain = network.border_covariance.rows();
    const Lanes* wanted = batch.border_gradient.data() + plain;
    const Lanes* stretch_step = batch.border_step.data() + plain;
    const auto misclosure = [&](Index prior, double u, const Lanes& present, Lanes& to) {
        for (int t = 0; t < k_lanes; ++t) {
            // In parts of u the prior has the weight 1: what is missing to the value that was drawn.
            to[t] = (prior < 0 || u <= 0.0 ? 0.0 : batch.prior_observed[static_cast<std::size_t>(prior)][t] / u) -
                    present[t];
        }
    };
    stretch_steps(network, batch);
    const Lanes& expansion = batch.next_thermal[stations];
    for (std::size_t j = 0; j < stations; ++j) {
        const double nominal_expansion = thermal.expansion * thermal.u_temperature[j];
        const double expansion_change = thermal.u_expansion * thermal.u_temperature[j];
        const double nominal_temperature = thermal.temperature[j] * thermal.u_expansion;
        const Lanes& own = batch.next_thermal[j];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            batch.by_own[j][t] = nominal_expansion + expansion_change * expansion[t];
            batch.by_expansion[j][t] = nominal_temperature + expansion_change * own[t];
        }
        misclosure(thermal.temperature_priors[j], thermal.u_temperature[j], own, batch.thermal_step[j]);
    }
    misclosure(thermal.expansion_prior, thermal.u_expansion, expansion, batch.thermal_step[stations]);

    Lanes& of_expansion = batch.thermal_normal[n * n - 1];
    // The prior of each adds 1 to its own diagonal, in parts of u.
    fill(of_expansion, 1.0);
    for (std::size_t i = 0; i < stations; ++i) {
        const double* row = thermal.normal.data() + i * stations;
        Lanes pull = wanted[i];  // on the stretch
        Lanes by_expansion;
        fill(by_expansion, 0.0);
        for (std::size_t j = 0; j < stations; ++j) {
            Lanes& element = batch.thermal_normal[i * n + j];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                pull[t] -= row[j] * stretch_step[j][t];
                by_expansion[t] += row[j] * batch.by_expansion[j][t];
                element[t] = batch.by_own[i][t] * row[j] * batch.by_own[j][t] + (i == j ? 1.0 : 0.0);
            }
        }
        Lanes& right = batch.thermal_normal[i * n + stations];
        Lanes& below = batch.thermal_normal[stations * n + i];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            right[t] = batch.by_own[i][t] * by_expansion[t];
            below[t] = right[t];
            of_expansion[t] += batch.by_expansion[i][t] * by_expansion[t];
            batch.thermal_step[i][t] += batch.by_own[i][t] * pull[t];
            batch.thermal_step[stations][t] += batch.by_expansion[i][t] * pull[t];
        }
    }
    solve_positive_definite(batch.thermal_normal.data(), n, batch.thermal_step.data());
    Lanes largest;
    fill(largest, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            const double step = batch.thermal_step[i][t];
            const double size = std::abs(step);
            batch.next_thermal[i][t] += batch.thermal_moves[t] != 0.0 ? step : 0.0;
            largest[t] = largest[t] >= size ? largest[t] : size;  // NaN does not pass for small
        }
    }
    // A lane that has arrived stands still, whatever its neighbours still need.
    for (int t = 0; t < k_lanes; ++t) {
        batch.thermal_moves[t] = batch.thermal_moves[t] != 0.0 && !(largest[t] <= k_tolerance) ? 1.0 : 0.0;
    }
}

/// Steps of the stretches: expansion and temperatures, whose product they are, adjusted to the very minimum.
void find_stretches(const TrialNetwork& network, TrialBatch& batch) {
    // To the very minimum within each step, which costs little: a system of the stations and one more.
    constexpr int k_most = 50;
    batch.next_thermal = batch.thermal;
    batch.thermal_moves = batch.active;
    for (int number = 0; number < k_most && any(batch.thermal_moves); ++number) {
        move_thermal(network, batch);
    }
    stretch_steps(network, batch);
}

/// The steps of everything else, with those of the stretches known.
GUMCERT_WIDE_CLONES
void find_step(const TrialNetwork& network, TrialBatch& batch) {
    const auto border = static_cast<Index>(network.border.size());
    const Index plain = network.border_covariance.rows();
    for (Index b = 0; b < plain; ++b) {
        fill(batch.border_step[static_cast<std::size_t>(b)], 0.0);
    }
    multiply_add(network.border_covariance.data(), plain, plain, batch.border_gradient.data(),
                 batch.border_step.data());
    for (Index j = 0; j < border - plain; ++j) {
        const double* row = network.thermal.from_border.data() + j * plain;
        const Lanes& stretch = batch.border_step[static_cast<std::size_t>(plain + j)];
        for (Index b = 0; b < plain; ++b) {
            add_combination(row + b, 1, &stretch, batch.border_step[static_cast<std::size_t>(b)]);
        }
    }
    for (std::size_t b = 0; b < network.border.size(); ++b) {
        batch.step[static_cast<std::size_t>(network.border[b])] = batch.border_step[b];
    }
    std::array<Lanes, TrialNetwork::k_most_of_pose> own;
    std::array<Lanes, TrialNetwork::k_most_of_pose> step;
    for (const TrialNetwork::Elimination& pose : network.eliminated) {
        const auto size = static_cast<Index>(pose.slots.size());
        for (std::size_t i = 0; i < pose.slots.size(); ++i) {
            own[i] = batch.gradient[static_cast<std::size_t>(pose.slots[i])];
            fill(step[i], 0.0);
        }
        multiply_add(pose.inverse.data(), size, size, own.data(), step.data());
        multiply_add(pose.to_pose.data(), size, border, batch.border_step.data(), step.data());
        for (std::size_t i = 0; i < pose.slots.size(); ++i) {
            batch.step[static_cast<std::size_t>(pose.slots[i])] = step[i];
        }
    }
}

/// Moves the trials that have not converged yet, and measures the step.
GUMCERT_WIDE_CLONES
void take_step(const TrialNetwork& network, TrialBatch& batch) {
    const Lanes active = batch.active;
    // A trial that has converged is not moved any more: its bits do not depend on its neighbours.
    const auto move = [&](const Lanes& step, Lanes& delta) {
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            delta[t] += active[t] != 0.0 ? step[t] : 0.0;
        }
    };
    for (const Index slot : network.border) {
        move(batch.step[static_cast<std::size_t>(slot)], batch.delta[static_cast<std::size_t>(slot)]);
    }
    for (const TrialNetwork::Elimination& pose : network.eliminated) {
        for (const Index slot : pose.slots) {
            move(batch.step[static_cast<std::size_t>(slot)], batch.delta[static_cast<std::size_t>(slot)]);
        }
    }
    for (std::size_t i = 0; i < batch.thermal.size() && network.thermal.is_uncertain; ++i) {
        const Lanes& next = batch.next_thermal[i];
        Lanes& to = batch.thermal[i];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            to[t] = active[t] != 0.0 ? next[t] : to[t];
        }
    }
    Lanes& largest = batch.size;
    fill(largest, 0.0);
    for (const TrialNetwork::Reported& reported : network.reported) {
        const Lanes& step = batch.step[static_cast<std::size_t>(reported.slot)];
        const double inverse_u = reported.inverse_u;
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            const double size = std::abs(step[t]) * inverse_u;
            largest[t] = largest[t] >= size ? largest[t] : size;  // NaN does not pass for small
        }
    }
}

/// One trial by Gauss-Newton steps with normal equations of its own.
TrialEnd solve_alone(const TrialNetwork& network, int lane, TrialBatch& batch) {
    Adjustment alone = network.least_squares;
    for (const TrialNetwork::VisitPlan& visit : network.visits) {
        const double scale = 1.0 + network.nominal_at(TrialNetwork::station_slot(visit.station, TrialNetwork::k_scale));
        Eigen::VectorXd observed(visit.count);
        for (Index k = 0; k < visit.count; ++k) {
            const auto at = static_cast<std::size_t>(visit.first + k);
            // The length that was drawn, in full: what the solution predicts, and the difference that the lanes have
            // kept.
            const TrialNetwork::Length& length = network.lengths[at];
            const double predicted = scale * length.distance - network.nominal_at(length.path_slot);
            observed[k] = predicted + batch.residual_start[at][lane];
        }
        alone.set_observed(visit.number, std::move(observed));
    }
    for (const TrialNetwork::Prior& prior : network.priors) {
        Eigen::VectorXd observed = prior.value;
        for (Index i = 0; i < observed.size(); ++i) {
            observed[i] += batch.prior_observed[static_cast<std::size_t>(prior.first + i)][lane];
        }
        alone.set_observed(prior.group, std::move(observed));
    }
    const SolveSummary summary = alone.refine(SolverOptions{});
    // Back as differences from the solution, so that what follows treats all lanes alike.
    for (std::size_t i = 0; i < network.free_slots.size(); ++i) {
        const FreeParameter& parameter = network.free_parameters[i];
        const auto slot = static_cast<std::size_t>(network.free_slots[i]);
        batch.delta[slot][lane] = alone.parameters(parameter.block)[parameter.component] - network.nominal[slot];
    }
    const double expansion = alone.parameters(network.expansion_block)[0];
    for (Index j = 0; j < network.stations; ++j) {
        const auto slot = static_cast<std::size_t>(TrialNetwork::station_slot(j, TrialNetwork::k_stretch));
        const double temperature =
            alone.parameters(network.station_blocks[static_cast<std::size_t>(j)])[TrialNetwork::k_stretch];
        batch.delta[slot][lane] = expansion * temperature - network.nominal[slot];
    }
    return {summary.iterations, summary.converged, true};
}

}  // namespace

std::array<TrialEnd, k_lanes> solve(const TrialNetwork& network, const TrialOptions& options, Index count,
                                    TrialBatch& batch) {
    std::array<TrialEnd, k_lanes> ends;
    // Every trial begins at the solution: none depends on the one before.
    std::fill(batch.delta.begin(), batch.delta.end(), Lanes{});
    std::fill(batch.thermal.begin(), batch.thermal.end(), Lanes{});
    for (int t = 0; t < k_lanes; ++t) {
        batch.active[t] = t < count ? 1.0 : 0.0;
    }
    fill(batch.thermal_moves, 0.0);
    // The derivatives change by some 10⁻⁵ over the uncertainties of a measurement: a step gains four digits or more,
    // and two of them are enough (ADR 0015).
    for (int number = 1; number <= options.most_steps && any(batch.active); ++number) {
        // The gradient is that of the trial at its present parameters, the normal matrix that of the nominal solution
        // for all of them: steps are a little wrong, the solution at which they end is not.
        find_gradient(network, batch);
        reduce_gradient(network, batch);
        if (network.thermal.is_uncertain) {
            find_stretches(network, batch);
        }
        find_step(network, batch);
        take_step(network, batch);
        for (int t = 0; t < k_lanes; ++t) {
            if (batch.active[t] != 0.0 && batch.thermal_moves[t] == 0.0 && batch.size[t] <= options.step_tolerance) {
                batch.active[t] = 0.0;
                ends[static_cast<std::size_t>(t)] = {number, true, false};
            }
        }
    }
    // Chord steps that do not arrive: far from the solution its normal equations are no longer near those of the trial.
    for (int t = 0; t < k_lanes; ++t) {
        if (batch.active[t] != 0.0) {
            TrialEnd& end = ends[static_cast<std::size_t>(t)];
            end = solve_alone(network, t, batch);
            end.steps += options.most_steps;
        }
    }
    return ends;
}

}  // namespace gumcert::engine
