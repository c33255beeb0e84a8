#include "engine/rotary_table/trials/trial_network.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "engine/rotary_table/rotary_table_model.h"
#include "engine/rotary_table/rotation.h"
#include "engine/rotary_table/table_parameters.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

// All that trials have in common, made once at the solution:
// 1. A slot for each parameter, and the visits in an order in which those of one pose follow each other.
// 2. Of each visit the weights V⁻¹ and −A; of each prior its weights. They are held (ADR 0015).
// 3. N = Jᵀ V⁻¹ J, factored: each pose is eliminated alone, N_bb − Σ N_be N_ee⁻¹ N_eb, and what is left, the border, is
// inverted. A trial then takes its steps N⁻¹ Jᵀ V⁻¹ v with products only.
// 4. Where expansion or temperature is uncertain, the same reduced to the stretches of the fixture.

namespace {

using Index = Eigen::Index;

// Component of a station block of the adjustment.
constexpr int k_temperature = 4;

/// V⁻¹ from the Cholesky factor of V, exactly symmetric.
Eigen::MatrixXd weight_matrix(const Eigen::MatrixXd& cholesky) {
    const Eigen::MatrixXd half =
        cholesky.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(cholesky.rows(), cholesky.rows()));
    // L⁻ᵀ L⁻¹: positive semi-definite whatever is rounded.
    Eigen::MatrixXd weight = half.transpose() * half;
    // Trials read it by rows, Eigen stores it by columns.
    weight.triangularView<Eigen::StrictlyUpper>() = weight.transpose();
    return weight;
}

/// Inverse of normal equations, exactly symmetric.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix) {
    // Scaled to a unit diagonal first: metres, radians and scales differ by many powers of ten.
    const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::LLT<Eigen::MatrixXd> factor(Eigen::MatrixXd(scale.asDiagonal() * matrix * scale.asDiagonal()));
    if (!scale.allFinite() || factor.info() != Eigen::Success) {  // the factor lets NaN pass
        throw gum::NoResultError(
            gum::Diagnostic{"GC-ADJUST-0002", "rotary table trials", "the normal equations are singular",
                            "trials can be solved only where the observations determine every parameter",
                            "check the rank report, add stations, reflectors or angles", gum::Severity::error});
    }
    const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.rows()));
    return scale.asDiagonal() * (0.5 * (inverse + inverse.transpose())) * scale.asDiagonal();
}

}  // namespace

TrialNetwork::TrialNetwork(const JointAdjustment& solved, const StochasticModel& stochastic, bool with_positions)
    : least_squares(solved.adjustment()), expansion_block(solved.expansion_block()) {
    const RotaryTableMeasurement& measurement = solved.measurement();
    stations = static_cast<Index>(measurement.stations.size());
    reflectors = static_cast<Index>(measurement.reflectors.size());
    angles = static_cast<Index>(measurement.angles.size());
    const auto append = [&](Adjustment::BlockId block) {
        const Eigen::VectorXd& value = least_squares.parameters(block);
        nominal.insert(nominal.end(), value.begin(), value.end());
    };

    // The normal equations do without expansion and temperatures: the stretches take their place.
    const NormalEquations all = least_squares.linearise();
    Adjustment without_thermal = least_squares;
    const auto uncertainty = [&](Adjustment::BlockId block, int component, double stated) {
        const bool is_free = all.column(block, component) >= 0;
        // Held in the equations: the stretches of the stations stand for them.
        without_thermal.hold(block, component);
        thermal.is_uncertain = thermal.is_uncertain || is_free;
        return is_free ? stated : 0.0;
    };
    thermal.expansion = least_squares.parameters(expansion_block)[0];
    thermal.u_expansion = uncertainty(expansion_block, 0, measurement.u_expansion);
    for (Index j = 0; j < stations; ++j) {
        const Adjustment::BlockId block = solved.station_block(static_cast<std::size_t>(j));
        station_blocks.push_back(block);
        append(block);
        thermal.temperature.push_back(least_squares.parameters(block)[k_temperature]);
        thermal.u_temperature.push_back(uncertainty(block, k_temperature, measurement.u_temperature[j]));
        nominal.back() = thermal.expansion * thermal.temperature.back();  // stretch, in the place of the temperature
    }
    const NormalEquations normal = without_thermal.linearise();

    paths = static_cast<Index>(nominal.size());
    for (std::size_t d = 0; d < measurement.dead_paths.size(); ++d) {
        append(solved.dead_path_block(d));
    }
    fixture = static_cast<Index>(nominal.size());
    append(solved.fixture_block());
    reversal = static_cast<Index>(nominal.size());
    reversal_by_angle = solved.reversal_by_angle();
    for (std::size_t i = 0; i < (reversal_by_angle ? measurement.angles.size() : 1); ++i) {
        const Eigen::Matrix<double, 6, 1> value = solved.reversal(i);
        nominal.insert(nominal.end(), value.begin(), value.end());
    }
    poses = static_cast<Index>(nominal.size());
    const Eigen::MatrixXd motions = solved.poses();
    nominal.insert(nominal.end(), motions.data(), motions.data() + motions.size());

    take_visits(solved, normal, stochastic, with_positions);
    take_priors(solved, normal);
    take_normal_equations(solved, normal);
}

void TrialNetwork::take_visits(const JointAdjustment& solved, const NormalEquations& normal,
                               const StochasticModel& stochastic, bool with_positions) {
    const RotaryTableMeasurement& measurement = solved.measurement();
    const std::vector<Visit>& of_adjustment = solved.visits();
    const VisitPositionGains positions =
        with_positions ? visit_position_gains(solved, stochastic) : VisitPositionGains{};
    const auto order = repeatability_order(measurement.axis);
    const auto half_sense = [&](const Visit& visit) {
        return !solved.has_reversal() ? 0.0 : (visit.approach == Approach::positive ? 0.5 : -0.5);
    };
    std::vector<Index> first_input;
    Index input = 0;
    std::vector<std::size_t> sequence;
    for (std::size_t v = 0; v < of_adjustment.size(); ++v) {
        first_input.push_back(input);
        input += static_cast<Index>(of_adjustment[v].observations.size());
        sequence.push_back(v);
    }
    // Visits of one angle in one sense share pose and rotation, which a trial then forms once for all of them.
    std::stable_sort(sequence.begin(), sequence.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(of_adjustment[a].angle, half_sense(of_adjustment[a])) <
               std::pair(of_adjustment[b].angle, half_sense(of_adjustment[b]));
    });
    for (const std::size_t v : sequence) {
        const Visit& visit = of_adjustment[v];
        const double half = half_sense(visit);
        const Index pose = poses + 6 * static_cast<Index>(visit.angle);
        const Eigen::Matrix3d rotation = nominal_rotation(measurement, visit.angle);
        const Eigen::Matrix3d to_table = rotation * solved.set_up().rotation;
        const Eigen::Vector3d offset = rotation * solved.set_up().translation;
        if (turns.empty() || turns.back().pose != pose || turns.back().half_sense != half) {
            Turn turn{};
            for (int r = 0; r < 3; ++r) {
                for (int c = 0; c < 3; ++c) {
                    turn.to_table[static_cast<std::size_t>(3 * r + c)] = to_table(r, c);
                }
                turn.offset[static_cast<std::size_t>(r)] = offset[r];
            }
            turn.pose = pose;
            turn.reversal = reversal_of(static_cast<Index>(visit.angle));
            turn.half_sense = half;
            turn.begin = visits.size();
            turns.push_back(turn);
        }
        turns.back().end = visits.size() + 1;

        VisitPlan plan{};
        plan.number = v;
        plan.first = static_cast<Index>(lengths.size());
        plan.count = static_cast<Index>(visit.observations.size());
        plan.first_input = first_input[v];
        plan.station = static_cast<Index>(visit.station);
        plan.angle = static_cast<Index>(visit.angle);
        plan.reversal = reversal_of(plan.angle);
        plan.half_sense = half;
        plan.weights = weights.size();
        plan.to_length = to_length.size();
        plan.gain = gains.size();
        const Eigen::MatrixXd weight = weight_matrix(normal.groups()[v].cholesky);
        weights.insert(weights.end(), weight.data(), weight.data() + weight.size());  // symmetric
        // A visit without repeatability of the table has independent distances.
        plan.is_diagonal = weight.isDiagonal(0.0);
        const Eigen::MatrixXd by_pose = solved.repeatability_jacobian(v);
        for (Index k = 0; k < plan.count; ++k) {
            for (const int component : order) {
                // A table that deviates shows lengths that are longer by this much; taken off, they are those of the
                // pose that is asked for, as in the model of propagation.
                to_length.push_back(-by_pose(k, component));
            }
        }
        if (with_positions && positions.determined(v)) {
            plan.is_determined = true;
            gains.insert(gains.end(), positions.gains[v].begin(), positions.gains[v].end());
        }
        largest_visit = std::max(largest_visit, plan.count);

        Eigen::Matrix<double, 6, 1> motion;
        for (int c = 0; c < 6; ++c) {
            motion[c] = nominal_at(pose + c) + half * nominal_at(plan.reversal + c);
        }
        const RigidMotion error = rigid_motion(motion);
        const double stretch = 1.0 + nominal_at(station_slot(plan.station, k_stretch));
        const double scale = 1.0 + nominal_at(station_slot(plan.station, k_scale));
        const Eigen::Vector3d station = nominal_point(station_slot(plan.station, 0));
        const Eigen::VectorXd residual = solved.adjustment().residual(v);
        length_residual.insert(length_residual.end(), residual.begin(), residual.end());
        for (const std::size_t observation : visit.observations) {
            const LengthObservation& observed = measurement.lengths[observation];
            const auto reflector = static_cast<Index>(observed.reflector);
            const Eigen::Vector3d turned = error.rotation * to_table * nominal_point(fixture + 3 * reflector);
            // Temperature stretches the fixture from its own origin, and not the place of the fixture on the table.
            const Eigen::Vector3d difference = stretch * turned + error.rotation * offset + error.translation - station;
            Length length{};
            length.difference = {difference[0], difference[1], difference[2]};
            length.distance = difference.norm();
            length.inverse = 1.0 / length.distance;
            length.inverse_square = 1.0 / difference.squaredNorm();
            length.reflector = reflector;
            length.path_slot = paths + static_cast<Index>(observed.dead_path);
            lengths.push_back(length);
            // ∂l/∂(1 + α ΔT) = s uᵀ E R T_s p
            by_stretch_.push_back(scale * difference.dot(turned) / length.distance);
        }
        visits.push_back(plan);
    }
}

void TrialNetwork::take_priors(const JointAdjustment& solved, const NormalEquations& normal) {
    const auto take = [&](std::size_t group, Eigen::VectorXd value, std::vector<Index> of) {
        const auto first = static_cast<Index>(prior_residual.size());
        const Eigen::VectorXd residual = solved.adjustment().residual(group);
        prior_residual.insert(prior_residual.end(), residual.begin(), residual.end());
        priors.push_back(
            {group, first, std::move(value), std::move(of), weight_matrix(normal.groups()[group].cholesky)});
        return first;
    };
    const auto one = [](double value) { return Eigen::VectorXd::Constant(1, value); };
    std::vector<Index> coordinates;
    for (Index c = 0; c < 3 * reflectors; ++c) {
        coordinates.push_back(fixture + c);
    }
    fixture_prior = take(solved.fixture_prior(), solved.adjustment().parameters(solved.fixture_block()), coordinates);
    if (solved.expansion_prior() != JointAdjustment::k_none) {
        thermal.expansion_prior = take(solved.expansion_prior(), one(thermal.expansion), {});
    }
    for (Index j = 0; j < stations; ++j) {
        const auto at = static_cast<std::size_t>(j);
        const Index scale = station_slot(j, k_scale);
        scale_priors.push_back(solved.scale_prior(at) == JointAdjustment::k_none
                                   ? -1
                                   : take(solved.scale_prior(at), one(nominal_at(scale)), {scale}));
        thermal.temperature_priors.push_back(
            solved.temperature_prior(at) == JointAdjustment::k_none
                ? -1
                : take(solved.temperature_prior(at), one(thermal.temperature[at]), {}));
    }
    // A group that a trial does not know would still pull at the solution, and no trial would be at its minimum.
    if (visits.size() + priors.size() != normal.groups().size()) {
        throw std::logic_error("rotary table trials: the adjustment has observations that are not of the measurement");
    }
}

void TrialNetwork::take_normal_equations(const JointAdjustment& solved, const NormalEquations& normal) {
    // Where each free parameter is: slot, and angle of the pose that it belongs to or -1, and place in there.
    std::vector<Index> slot(static_cast<std::size_t>(normal.parameter_count()), -1);
    std::vector<Index> angle(slot.size(), -1);
    std::vector<Index> place(slot.size(), -1);
    const auto locate = [&](Adjustment::BlockId block, Index first, int size, Index of_angle, int component = 0) {
        for (int c = 0; c < size; ++c) {
            if (const Index column = normal.column(block, component + c); column >= 0) {
                slot[static_cast<std::size_t>(column)] = first + c;
                angle[static_cast<std::size_t>(column)] = of_angle;
            }
        }
    };
    for (Index j = 0; j < stations; ++j) {
        locate(solved.station_block(static_cast<std::size_t>(j)), station_slot(j, 0), k_temperature, -1);
    }
    for (Index d = 0; d < fixture - paths; ++d) {
        locate(solved.dead_path_block(static_cast<std::size_t>(d)), paths + d, 1, -1);
    }
    locate(solved.fixture_block(), fixture, static_cast<int>(3 * reflectors), -1);
    locate(solved.reversal_block(), reversal, 6, -1);
    for (Index i = 0; i < angles; ++i) {
        const Adjustment::BlockId block = solved.pose_block(static_cast<std::size_t>(i));
        locate(block, poses + 6 * i, 6, i);
        if (reversal_by_angle) {
            locate(block, reversal_of(i), 6, i, 6);
        }
    }
    std::vector<Index> size(static_cast<std::size_t>(angles), 0);
    for (std::size_t column = 0; column < slot.size(); ++column) {
        if (angle[column] < 0) {
            place[column] = static_cast<Index>(border.size());
            border.push_back(slot[column]);
        } else {
            place[column] = size[static_cast<std::size_t>(angle[column])]++;
        }
    }
    const auto plain = static_cast<Index>(border.size());  // without the stretches
    // Columns for the stretches behind the rest of the border, so that they can be split off as a block.
    for (Index j = 0; j < stations && thermal.is_uncertain; ++j) {
        border.push_back(station_slot(j, k_stretch));
    }

    const auto border_size = static_cast<Index>(border.size());
    // Jᵀ V⁻¹ J in three parts: of the border, of each pose alone, and between both. No observation joins two poses.
    Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(border_size, border_size);
    std::vector<Eigen::MatrixXd> own;
    std::vector<Eigen::MatrixXd> cross;
    for (const Index n : size) {
        own.emplace_back(Eigen::MatrixXd::Zero(n, n));
        cross.emplace_back(Eigen::MatrixXd::Zero(n, border_size));
    }
    for (const LinearisedGroup& group : normal.groups()) {
        const Eigen::MatrixXd product = group.jacobian.transpose() * group.jacobian;
        for (Index k = 0; k < product.cols(); ++k) {
            const auto ck = static_cast<std::size_t>(group.columns[static_cast<std::size_t>(k)]);
            for (Index i = 0; i < product.rows(); ++i) {
                const auto ci = static_cast<std::size_t>(group.columns[static_cast<std::size_t>(i)]);
                if (angle[ci] < 0 && angle[ck] < 0) {
                    reduced(place[ci], place[ck]) += product(i, k);
                } else if (angle[ci] >= 0 && angle[ck] < 0) {
                    cross[static_cast<std::size_t>(angle[ci])](place[ci], place[ck]) += product(i, k);
                } else if (angle[ci] >= 0 && angle[ck] >= 0) {
                    own[static_cast<std::size_t>(angle[ci])](place[ci], place[ck]) += product(i, k);
                }
            }
        }
    }
    // The stretch of a station has no column in the adjustment. Its products are added here, whitened by the same
    // factors.
    for (std::size_t v = 0; v < visits.size() && thermal.is_uncertain; ++v) {
        const VisitPlan& visit = visits[v];
        const LinearisedGroup& group = normal.groups()[visit.number];
        const Eigen::VectorXd whitened = group.cholesky.triangularView<Eigen::Lower>().solve(
            Eigen::Map<const Eigen::VectorXd>(&by_stretch_[static_cast<std::size_t>(visit.first)], visit.count));
        const Eigen::VectorXd product = group.jacobian.transpose() * whitened;
        const Index stretch = plain + visit.station;
        reduced(stretch, stretch) += whitened.squaredNorm();
        for (Index i = 0; i < product.size(); ++i) {
            const auto ci = static_cast<std::size_t>(group.columns[static_cast<std::size_t>(i)]);
            if (angle[ci] < 0) {
                reduced(place[ci], stretch) += product[i];
                reduced(stretch, place[ci]) += product[i];
            } else {
                cross[static_cast<std::size_t>(angle[ci])](place[ci], stretch) += product[i];
            }
        }
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (size[i] == 0) {
            continue;
        }
        Elimination elimination;
        // Made once, at the solution: trials begin there and take their steps with these matrices. One that needs more
        // than a few steps is solved alone with matrices of its own (TrialOptions::most_steps).
        elimination.inverse = inverse_of(own[i]);
        // Poses follow the border by −N_ee⁻¹ N_eb.
        elimination.to_pose = -(elimination.inverse * cross[i]);
        elimination.to_border = elimination.to_pose.transpose();
        reduced += elimination.to_border * cross[i];
        eliminated.push_back(std::move(elimination));
    }
    border_covariance = RowMajorMatrix(0, 0);
    if (plain > 0) {
        border_covariance = inverse_of(reduced.topLeftCorner(plain, plain));
    }
    const Eigen::MatrixXd across = reduced.bottomLeftCorner(border_size - plain, plain);
    // The border without the stretches is eliminated from the equations of the stretches: N_ss − N_sb N_bb⁻¹ N_bs. N_bb
    // is that of the border at known stretches.
    thermal.from_border = -(across * border_covariance);
    thermal.normal = reduced.bottomRightCorner(border_size - plain, border_size - plain);
    thermal.normal += thermal.from_border * across.transpose();
    thermal.normal = (0.5 * (thermal.normal + thermal.normal.transpose())).eval();

    for (Index b = 0; b < plain; ++b) {
        const Index at = border[static_cast<std::size_t>(b)];
        free_slots.push_back(at);
        // Slots of the reversal and the poses stand last: what is reported of the border is the reversal.
        if (at >= reversal) {
            // Only what is reported decides on convergence: steps are measured in parts of these standard
            // uncertainties.
            reported.push_back({at, 1.0 / std::sqrt(border_covariance(b, b))});
        }
    }
    std::size_t next = 0;
    auto column = static_cast<std::size_t>(plain);  // the poses follow the border, angle by angle
    for (const Index n : size) {
        if (n == 0) {
            continue;
        }
        Elimination& elimination = eliminated[next++];
        const RowMajorMatrix by_border = elimination.to_pose.leftCols(plain);
        // W + F C Fᵀ: the variance of a pose with that of the border in it.
        const RowMajorMatrix spread = by_border * border_covariance;
        for (Index c = 0; c < n; ++c, ++column) {
            elimination.slots.push_back(slot[column]);
            free_slots.push_back(slot[column]);
            const double variance = elimination.inverse(c, c) + spread.row(c).dot(by_border.row(c));
            reported.push_back({slot[column], 1.0 / std::sqrt(variance)});
        }
    }
    free_parameters = normal.parameters();
}

}  // namespace gumcert::engine
