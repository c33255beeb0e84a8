#include "engine/rotary_table/studies/measurement_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/geometry_check.h"
#include "engine/rotary_table/reliability.h"
#include "engine/rotary_table/station_covariance.h"
#include "engine/rotary_table/studies/campaign_layout.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Squared pivot of the scaled normal equations below which a parameter counts as not determined; as
// SolverOptions::rank_tolerance.
constexpr double k_pivot_tolerance = 1e-12;

StartValues ideal_values(const RotaryTableMeasurement& measurement) {
    StartValues values;
    for (const auto& position : measurement.station_start) {
        values.stations.push_back(*position);
    }
    values.dead_paths = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(measurement.dead_paths.size()));
    return values;
}

// As the adjustment decides it: one station with one sense only, and no reversal is reported.
bool every_station_has_both_senses(const RotaryTableMeasurement& measurement) {
    std::vector<std::array<bool, 2>> senses(measurement.stations.size(), {false, false});
    for (const LengthObservation& length : measurement.lengths) {
        senses[length.station][length.approach == Approach::positive ? 0 : 1] = true;
    }
    return std::all_of(senses.begin(), senses.end(), [](const auto& s) { return s[0] && s[1]; });
}

/// New index of everything that is kept; k_gone for the rest.
constexpr std::size_t k_gone = static_cast<std::size_t>(-1);

std::vector<std::size_t> renumbered(const std::vector<bool>& keep) {
    std::vector<std::size_t> index(keep.size(), k_gone);
    std::size_t next = 0;
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (keep[i]) {
            index[i] = next++;
        }
    }
    return index;
}

template <typename Value>
std::vector<Value> kept(const std::vector<Value>& values, const std::vector<bool>& keep) {
    std::vector<Value> result;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (keep[i]) {
            result.push_back(values[i]);
        }
    }
    return result;
}

std::vector<Eigen::Index> kept_indices(const std::vector<bool>& keep) {
    std::vector<Eigen::Index> result;
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (keep[i]) {
            result.push_back(static_cast<Eigen::Index>(i));
        }
    }
    return result;
}

/// A part of a measurement; dead paths that no distance has any more are left out with it.
RotaryTableMeasurement part_of(const RotaryTableMeasurement& from, const std::vector<bool>& stations,
                               const std::vector<bool>& reflectors, const std::vector<bool>& angles,
                               const std::vector<bool>* measured = nullptr) {
    RotaryTableMeasurement result = from;
    const auto station = renumbered(stations);
    const auto reflector = renumbered(reflectors);
    const auto angle = renumbered(angles);
    std::vector<bool> paths(from.dead_paths.size(), false);
    result.lengths.clear();
    result.times.clear();
    for (std::size_t i = 0; i < from.lengths.size(); ++i) {
        const LengthObservation& length = from.lengths[i];
        if (stations[length.station] && reflectors[length.reflector] && angles[length.angle] &&
            (measured == nullptr || (*measured)[i])) {
            paths[length.dead_path] = true;
            result.lengths.push_back(length);
        }
    }
    const auto path = renumbered(paths);
    for (LengthObservation& length : result.lengths) {
        length.station = station[length.station];
        length.reflector = reflector[length.reflector];
        length.angle = angle[length.angle];
        length.dead_path = path[length.dead_path];
    }
    result.stations = kept(from.stations, stations);
    result.station_start = kept(from.station_start, stations);
    result.reflectors = kept(from.reflectors, reflectors);
    result.angles = kept(from.angles, angles);
    result.angles_deg = kept(from.angles_deg, angles);
    result.home = angle[from.home];
    result.dead_paths = kept(from.dead_paths, paths);
    const auto station_rows = kept_indices(stations);
    result.temperature_difference = from.temperature_difference(station_rows).eval();
    result.u_temperature = from.u_temperature(station_rows).eval();
    result.fixture = from.fixture(kept_indices(reflectors), Eigen::all).eval();
    // Rows and columns of what is left: the covariance of a part is a part of the covariance.
    std::vector<Eigen::Index> coordinates;
    for (const Eigen::Index m : kept_indices(reflectors)) {
        coordinates.insert(coordinates.end(), {3 * m, 3 * m + 1, 3 * m + 2});
    }
    result.fixture_covariance = from.fixture_covariance(coordinates, coordinates).eval();
    return result;
}

std::vector<bool> all_but(std::size_t size, std::size_t left_out) {
    std::vector<bool> keep(size, true);
    if (left_out < size) {
        keep[left_out] = false;
    }
    return keep;
}

RotaryTableMeasurement of_station(const RotaryTableMeasurement& whole, std::size_t station,
                                  const std::vector<bool>& measured) {
    std::vector<bool> stations(whole.stations.size(), false);
    stations[station] = true;
    return part_of(whole, stations, all_but(whole.reflectors.size(), k_gone), all_but(whole.angles.size(), k_gone),
                   &measured);
}

}  // namespace

void predict_lengths(RotaryTableMeasurement& measurement) {
    const auto stations = static_cast<Eigen::Index>(measurement.stations.size());
    if (measurement.temperature_difference.size() == 0) {
        measurement.temperature_difference = Eigen::VectorXd::Zero(stations);
    }
    if (measurement.u_temperature.size() == 0) {
        measurement.u_temperature = Eigen::VectorXd::Zero(stations);
    }
    std::vector<gum::Diagnostic> problems;
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        if (!measurement.station_start[j]) {
            problems.push_back({"GC-PLAN-0001", "station " + measurement.stations[j], "has no position",
                                "a plan needs the position of every station",
                                "state it in the stations file, within a few centimetres", gum::Severity::error});
        }
    }
    if (!problems.empty()) {
        throw gum::InputError(std::move(problems));
    }
    for (LengthObservation& length : measurement.lengths) {
        length.length =
            ideal_distance(measurement, nominal_rotation(measurement, length.angle), length.station, length.reflector);
    }
}

JointAdjustment planned_adjustment(const RotaryTableMeasurement& measurement, const StochasticModel& stochastic) {
    // E and T_s are the identity: variances depend on the geometry, which these change by micrometres. A dead path
    // changes no geometry at all.
    return {measurement, std::vector<bool>(measurement.lengths.size(), true), RigidMotion{}, ideal_values(measurement),
            stochastic};
}

std::optional<gum::Diagnostic> undetermined_by(const RotaryTableMeasurement& measurement,
                                               const StochasticModel& stochastic, const SolverOptions& options) {
    const RankReport rank =
        planned_adjustment(measurement, stochastic).adjustment().linearise().rank(options.rank_tolerance);
    if (!rank.deficient) {
        return std::nullopt;
    }
    return undetermined(measurement, rank, ideal_values(measurement).stations);
}

ExpectedUncertainty expected_uncertainty(const RotaryTableMeasurement& measurement, const StochasticModel& stochastic,
                                         const EvaluationOptions& options) {
    require_enough_angles(measurement);
    const JointAdjustment adjustment = planned_adjustment(measurement, stochastic);
    const NormalEquations normal = adjustment.adjustment().linearise();
    const RankReport rank = normal.rank(options.solver.rank_tolerance);
    if (rank.deficient) {
        refuse_undetermined(measurement, rank, ideal_values(measurement).stations);
    }
    const BorderedCovariance covariance = normal.bordered_covariance();
    const DatumSolution datum =
        transform_to_datum(measurement, adjustment.poses(), adjustment.set_up(), measurement.datum);

    ExpectedUncertainty expected;
    expected.quantities = reported_quantities(measurement, adjustment.has_reversal());
    expected.covariance = covariance_of(reported_map(adjustment, normal, datum), adjustment, normal, covariance);
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        PlannedStation station;
        station.position = *measurement.station_start[j];
        station.covariance = station_covariance(adjustment, normal, covariance, datum, j);
        expected.stations.push_back(station);
    }
    expected.observations = normal.observation_count();
    expected.parameters = normal.parameter_count();
    expected.degrees_of_freedom = expected.observations - expected.parameters;
    expected.condition_number = normal.condition_number();
    const std::vector<DistanceReliability> rows =
        distance_reliability(adjustment, normal, covariance, stochastic, options.non_centrality);
    for (const DistanceReliability& row : rows) {
        expected.mean_redundancy += row.redundancy_number / static_cast<double>(rows.size());
        expected.largest_minimal_detectable_bias =
            std::max(expected.largest_minimal_detectable_bias, row.minimal_detectable_bias);
        // A distance that no other one controls has no detectable bias, for which 0 stands. It is counted apart, since
        // the largest bias does not show it.
        expected.uncontrolled_distances += row.minimal_detectable_bias > 0.0 ? 0U : 1U;
    }
    return expected;
}

RotaryTableMeasurement with_distances(const RotaryTableMeasurement& measurement, const std::vector<bool>& measured) {
    return part_of(measurement, all_but(measurement.stations.size(), k_gone),
                   all_but(measurement.reflectors.size(), k_gone), all_but(measurement.angles.size(), k_gone),
                   &measured);
}

RotaryTableMeasurement without_station(const RotaryTableMeasurement& measurement, std::size_t station) {
    return part_of(measurement, all_but(measurement.stations.size(), station),
                   all_but(measurement.reflectors.size(), k_gone), all_but(measurement.angles.size(), k_gone));
}

RotaryTableMeasurement without_reflector(const RotaryTableMeasurement& measurement, std::size_t reflector) {
    return part_of(measurement, all_but(measurement.stations.size(), k_gone),
                   all_but(measurement.reflectors.size(), reflector), all_but(measurement.angles.size(), k_gone));
}

RotaryTableMeasurement with_every_angle(const RotaryTableMeasurement& measurement, std::size_t stride) {
    std::vector<bool> angles(measurement.angles.size());
    for (std::size_t i = 0; i < angles.size(); ++i) {
        // Counted from home, which stays in the plan whatever the stride is.
        const std::size_t from_home = i > measurement.home ? i - measurement.home : measurement.home - i;
        angles[i] = from_home % stride == 0;
    }
    return part_of(measurement, all_but(measurement.stations.size(), k_gone),
                   all_but(measurement.reflectors.size(), k_gone), angles);
}

RotaryTableMeasurement with_twice_the_angles(const RotaryTableMeasurement& measurement) {
    const std::size_t count = measurement.angles.size();
    // A full turn has about the same step from its last angle to its first one as between the others.
    const double step =
        count > 1 ? (measurement.angles.back() - measurement.angles.front()) / static_cast<double>(count - 1) : 0.0;
    const double gap = 2.0 * std::numbers::pi - (measurement.angles.back() - measurement.angles.front());
    // Half a step of tolerance: steps of a plan need not be equal, and an arc with a gap of two steps is not closed.
    const bool closed = gap > 0.5 * step && gap < 1.5 * step;
    RotaryTableMeasurement result = measurement;
    result.angles.clear();
    result.angles_deg.clear();
    for (std::size_t i = 0; i < count; ++i) {
        result.angles.push_back(measurement.angles[i]);
        result.angles_deg.push_back(measurement.angles_deg[i]);
        if (i + 1 < count) {
            result.angles.push_back(0.5 * (measurement.angles[i] + measurement.angles[i + 1]));
            result.angles_deg.push_back(0.5 * (measurement.angles_deg[i] + measurement.angles_deg[i + 1]));
        } else if (closed) {
            result.angles.push_back(measurement.angles[i] + 0.5 * gap);
            result.angles_deg.push_back(measurement.angles_deg[i] + 0.5 * gap / gum::k_degree);
        }
    }
    result.home = 2 * measurement.home;
    result.lengths.clear();
    result.times.clear();
    for (LengthObservation length : measurement.lengths) {
        length.angle *= 2;
        result.lengths.push_back(length);
        if (length.angle + 1 < result.angles.size()) {
            ++length.angle;
            result.lengths.push_back(length);
        }
    }
    predict_lengths(result);
    return result;
}

// ---------------------------------------------------------------- variances of a layout, station by station

namespace {

/// Normal equations of one pose in units that make their diagonal one, and their Cholesky factor.
struct PoseFactor {
    Eigen::Matrix<double, 6, 1> scale;
    Eigen::LLT<Matrix6> factor;

    [[nodiscard]] Matrix6 inverse() const {
        Matrix6 result = Matrix6::Identity();
        factor.solveInPlace(result);
        return scale.asDiagonal() * result * scale.asDiagonal();
    }
};

/// Nothing where the pose is not determined.
std::optional<PoseFactor> factor_of(const Matrix6& normal) {
    const Eigen::Matrix<double, 6, 1> diagonal = normal.diagonal();
    if (!(diagonal.minCoeff() > 0.0)) {
        return std::nullopt;
    }
    // Metres and radians differ by powers of ten: without a unit diagonal the limit of a pivot would depend on the
    // units.
    PoseFactor result{diagonal.cwiseSqrt().cwiseInverse(), {}};
    result.factor.compute(result.scale.asDiagonal() * normal * result.scale.asDiagonal());
    if (result.factor.info() != Eigen::Success ||
        !(result.factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() > k_pivot_tolerance)) {
        return std::nullopt;
    }
    return result;
}

}  // namespace

LayoutVariances::~LayoutVariances() = default;

LayoutVariances::LayoutVariances(const RotaryTableMeasurement& measurement, const StochasticModel& stochastic)
    : measurement_(measurement), stochastic_(stochastic), has_reversal_(every_station_has_both_senses(measurement)) {
    const LengthUncertainty& lengths = measurement_.length_uncertainty;
    for (std::size_t j = 0; j < measurement_.stations.size(); ++j) {
        border_.stations.push_back(border_.size);
        border_.size += 3 + (lengths.scale_model == ScaleModel::fixed ? 0 : 1) +
                        (measurement_.u_temperature[static_cast<Eigen::Index>(j)] > 0.0 ? 1 : 0);
    }
    for (std::size_t d = 0; d < measurement_.dead_paths.size(); ++d) {
        border_.dead_paths.push_back(border_.size++);
    }
    border_.fixture = border_.size;
    border_.size += 3 * measurement_.fixture.rows();
    border_.expansion = border_.size;
    border_.size += measurement_.u_expansion > 0.0 ? 1 : 0;
    border_.reversal = border_.size;
    border_.size += has_reversal_ ? 6 : 0;

    const auto angles = static_cast<Eigen::Index>(measurement_.angles.size());
    prior_.border = Eigen::MatrixXd::Zero(border_.size, border_.size);
    prior_.poses = Eigen::MatrixXd::Zero(6 * angles, 6);
    prior_.mixed = Eigen::MatrixXd::Zero(6 * angles, border_.size);
    // Fixture and expansion are known once, however many stations there are: their priors are not in the information of
    // any station. Scale and temperature belong to one station, and are.
    const std::unique_ptr<Observer> any = observer(0);
    const NormalEquations normal = any->adjustment_->adjustment().linearise();
    for (const std::size_t group_index : {any->adjustment_->fixture_prior(), any->adjustment_->expansion_prior()}) {
        if (group_index == JointAdjustment::k_none) {
            continue;
        }
        const LinearisedGroup& group = normal.groups()[group_index];
        std::vector<Eigen::Index> columns;
        for (const Eigen::Index column : group.columns) {
            columns.push_back(any->places_[static_cast<std::size_t>(column)].index);
        }
        prior_.border(columns, columns) += group.jacobian.transpose() * group.jacobian;
    }

    datum_ = transform_to_datum(measurement_, Eigen::MatrixXd::Zero(6, angles), RigidMotion{}, measurement_.datum);
    change_ = datum_.change_map();
}

std::unique_ptr<LayoutVariances::Observer> LayoutVariances::observer(std::size_t station) const {
    return observer(station, std::vector<bool>(measurement_.lengths.size(), true));
}

std::unique_ptr<LayoutVariances::Observer> LayoutVariances::observer(std::size_t station,
                                                                     const std::vector<bool>& measured) const {
    return std::make_unique<Observer>(*this, station, measured);
}

LayoutVariances::Observer::Observer(const LayoutVariances& layout, std::size_t station,
                                    const std::vector<bool>& measured)
    : stochastic_(layout.stochastic_), border_size_(layout.border_.size) {
    const RotaryTableMeasurement& whole = layout.measurement_;
    std::vector<bool> only(whole.lengths.size());
    for (std::size_t i = 0; i < only.size(); ++i) {
        only[i] = measured[i] && whole.lengths[i].station == station;
    }
    measurement_ = of_station(whole, station, only);
    adjustment_ = std::make_unique<JointAdjustment>(planned_adjustment(measurement_, stochastic_));
    // A station alone may have both senses where another one has not: the layout has no reversal then.
    for (int c = 0; c < 6 && adjustment_->has_reversal() && !layout.has_reversal_; ++c) {
        adjustment_->adjustment().hold(adjustment_->reversal_block(), c);
    }
    for (const Visit& visit : adjustment_->visits()) {
        Eigen::VectorXd observed(static_cast<Eigen::Index>(visit.observations.size()));
        for (std::size_t k = 0; k < visit.observations.size(); ++k) {
            observed[static_cast<Eigen::Index>(k)] = measurement_.lengths[visit.observations[k]].length;
        }
        observed_.push_back(std::move(observed));
    }

    // part_of() keeps the order of the dead paths.
    std::vector<std::size_t> path_in_layout;
    std::vector<bool> used(whole.dead_paths.size(), false);
    for (std::size_t i = 0; i < only.size(); ++i) {
        used[whole.lengths[i].dead_path] = used[whole.lengths[i].dead_path] || only[i];
    }
    for (std::size_t d = 0; d < used.size(); ++d) {
        if (used[d]) {
            path_in_layout.push_back(d);
        }
    }
    const NormalEquations normal = adjustment_->adjustment().linearise();
    places_.resize(static_cast<std::size_t>(normal.parameter_count()));
    const auto place = [&](Adjustment::BlockId block, int size, Eigen::Index first, bool pose) {
        for (int c = 0; c < size; ++c) {
            if (const Eigen::Index column = normal.column(block, c); column >= 0) {
                places_[static_cast<std::size_t>(column)] = {pose, first++};
            } else if (pose) {
                // A held component of a pose keeps its place in the block of 6; in the border held parameters have
                // none.
                ++first;
            }
        }
    };
    const Border& border = layout.border_;
    place(adjustment_->station_block(0), 5, border.stations[station], false);
    for (std::size_t d = 0; d < path_in_layout.size(); ++d) {
        place(adjustment_->dead_path_block(d), 1, border.dead_paths[path_in_layout[d]], false);
    }
    place(adjustment_->fixture_block(), static_cast<int>(3 * whole.fixture.rows()), border.fixture, false);
    place(adjustment_->expansion_block(), 1, border.expansion, false);
    place(adjustment_->reversal_block(), 6, border.reversal, false);
    for (std::size_t i = 0; i < whole.angles.size(); ++i) {
        place(adjustment_->pose_block(i), 6, 6 * static_cast<Eigen::Index>(i), true);
    }
}

void LayoutVariances::Observer::stand_at(const Eigen::Vector3d& position) {
    Adjustment& adjustment = adjustment_->adjustment();
    Eigen::VectorXd station = adjustment.parameters(adjustment_->station_block(0));
    station.head<3>() = position;
    adjustment.set_parameters(adjustment_->station_block(0), station);
    // The proportional part of the length noise goes with the distance.
    const std::vector<Visit>& visits = adjustment_->visits();
    for (std::size_t v = 0; v < visits.size(); ++v) {
        // observed − (observed − predicted): the length that the ideal table shows from the new place.
        const Eigen::VectorXd predicted = observed_[v] - adjustment.residual(v);
        for (std::size_t k = 0; k < visits[v].observations.size(); ++k) {
            measurement_.lengths[visits[v].observations[k]].length = predicted[static_cast<Eigen::Index>(k)];
        }
    }
}

void LayoutVariances::Observer::pose_information(const Eigen::Vector3d& position, Eigen::MatrixXd& result) {
    stand_at(position);
    result.setZero(6 * static_cast<Eigen::Index>(measurement_.angles.size()), 6);
    const std::vector<Visit>& visits = adjustment_->visits();
    for (std::size_t v = 0; v < visits.size(); ++v) {
        // E(home) is held: the visit tells of the border alone.
        if (visits[v].angle == measurement_.home) {
            continue;
        }
        const Eigen::LLT<Eigen::MatrixXd> factor(adjustment_->visit_covariance(v, stochastic_));
        const Eigen::MatrixXd whitened = factor.matrixL().solve(adjustment_->pose_jacobian(v));
        result.middleRows<6>(6 * static_cast<Eigen::Index>(visits[v].angle)).noalias() +=
            whitened.transpose() * whitened;
    }
}

void LayoutVariances::Observer::information(const Eigen::Vector3d& position, Information& result) {
    stand_at(position);
    adjustment_->set_weights(stochastic_);
    const std::vector<Visit>& visits = adjustment_->visits();
    const NormalEquations normal = adjustment_->adjustment().linearise();

    const auto angles = static_cast<Eigen::Index>(measurement_.angles.size());
    result.border.setZero(border_size_, border_size_);
    result.poses.setZero(6 * angles, 6);
    result.mixed.setZero(6 * angles, border_size_);
    Eigen::MatrixXd product;
    const auto add_group = [&](const LinearisedGroup& group) {
        const auto size = static_cast<Eigen::Index>(group.columns.size());
        product.noalias() = group.jacobian.transpose() * group.jacobian;
        for (Eigen::Index j = 0; j < size; ++j) {
            const Place right = places_[static_cast<std::size_t>(group.columns[static_cast<std::size_t>(j)])];
            for (Eigen::Index i = 0; i < size; ++i) {
                const Place left = places_[static_cast<std::size_t>(group.columns[static_cast<std::size_t>(i)])];
                // A visit has one angle: two columns of poses are of the same block. Border by pose is the transpose of
                // pose by border and is not kept.
                if (!left.pose && !right.pose) {
                    result.border(left.index, right.index) += product(i, j);
                } else if (left.pose && !right.pose) {
                    result.mixed(left.index, right.index) += product(i, j);
                } else if (left.pose) {
                    result.poses(left.index, right.index % 6) += product(i, j);
                }
            }
        }
    };
    for (std::size_t v = 0; v < visits.size(); ++v) {
        add_group(normal.groups()[v]);
    }
    // Of the priors only those of the station itself. Fixture and expansion are known once, however many stations there
    // are: these are in prior().
    for (const std::size_t prior : {adjustment_->scale_prior(0), adjustment_->temperature_prior(0)}) {
        if (prior != JointAdjustment::k_none) {
            add_group(normal.groups()[prior]);
        }
    }
}

void add(LayoutVariances::Information& sum, const LayoutVariances::Information& part) {
    sum.border += part.border;
    sum.poses += part.poses;
    sum.mixed += part.mixed;
}

std::optional<Eigen::VectorXd> LayoutVariances::variances(const Information& information) const {
    const auto angles = static_cast<Eigen::Index>(measurement_.angles.size());
    const Eigen::Index size = 6 * angles;
    Eigen::MatrixXd reduced = information.border;
    Eigen::MatrixXd gain = Eigen::MatrixXd::Zero(size, border_.size);  // F_i = D_i⁻¹ B_i; poses = −F · border
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(size, 6);              // D_i⁻¹
    Eigen::MatrixXd half(6, border_.size);
    for (Eigen::Index i = 0; i < angles; ++i) {
        if (static_cast<std::size_t>(i) == measurement_.home) {
            continue;
        }
        const std::optional<PoseFactor> pose = factor_of(information.poses.middleRows<6>(6 * i));
        if (!pose) {
            return std::nullopt;
        }
        // No distance joins two poses: each is eliminated alone, by a factor of 6×6. Only the border is factored as a
        // whole.
        half = pose->scale.asDiagonal() * information.mixed.middleRows<6>(6 * i);
        pose->factor.matrixL().solveInPlace(half);
        // N_b − Σ B_iᵀ D_i⁻¹ B_i, with D_i = L_i L_iᵀ as (L_i⁻¹ B_i)ᵀ(L_i⁻¹ B_i).
        reduced.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose(), -1.0);
        pose->factor.matrixU().solveInPlace(half);
        gain.middleRows<6>(6 * i) = pose->scale.asDiagonal() * half;
        own.middleRows<6>(6 * i) = pose->inverse();
    }
    Eigen::VectorXd diagonal = information.border.diagonal();
    for (const Eigen::Index path : border_.dead_paths) {
        // A dead path that no distance has says nothing, and nothing depends on it.
        if (diagonal[path] == 0.0) {
            diagonal[path] = reduced(path, path) = 1.0;
        }
    }
    if (!(diagonal.minCoeff() > 0.0)) {
        return std::nullopt;
    }
    const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
    reduced = (scale.asDiagonal() * reduced * scale.asDiagonal()).eval();
    const Eigen::LLT<Eigen::MatrixXd, Eigen::Lower> factor(reduced);
    if (factor.info() != Eigen::Success ||
        !(factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() > k_pivot_tolerance)) {
        return std::nullopt;
    }

    Eigen::MatrixXd root = Eigen::MatrixXd::Identity(border_.size, border_.size);  // of the covariance of the border
    // N = L Lᵀ, so that L⁻ᵀ is a root of N⁻¹.
    factor.matrixU().solveInPlace(root);
    root = (scale.asDiagonal() * root).eval();
    // With the poses eliminated, the covariance is made of the border and of 6×6 blocks as that of an evaluation is.
    const AnglewiseMap map = reported_map(datum_, border_.size,
                                          has_reversal_ ? std::optional<Eigen::Index>(border_.reversal) : std::nullopt);
    return covariance_of(map, {own, -gain}, root).diagonal();
}

std::optional<Eigen::VectorXd> LayoutVariances::variances() const {
    Information sum = prior_;
    Information part;
    for (std::size_t j = 0; j < measurement_.stations.size(); ++j) {
        observer(j)->information(*measurement_.station_start[j], part);
        add(sum, part);
    }
    return variances(sum);
}

std::optional<Eigen::VectorXd> LayoutVariances::least_variances(const Eigen::MatrixXd& poses) const {
    // With everything else known the poses are independent of each other. Knowing more can only lower a variance, so
    // that this is a bound from below.
    // (I + D K) W (I + D K)ᵀ angle by angle, as covariance_of does it.
    using Change = Eigen::Matrix<double, 10, 10>;
    const auto angles = static_cast<Eigen::Index>(measurement_.angles.size());
    TallMatrix own = TallMatrix::Zero(6 * angles, 6);     // W
    TallMatrix cross = TallMatrix::Zero(6 * angles, 10);  // W Kᵀ
    Change change = Change::Zero();                       // K W Kᵀ
    for (Eigen::Index i = 0; i < angles; ++i) {
        if (static_cast<std::size_t>(i) == measurement_.home) {
            continue;
        }
        const std::optional<PoseFactor> pose = factor_of(poses.middleRows<6>(6 * i));
        if (!pose) {
            return std::nullopt;
        }
        const Eigen::Matrix<double, 10, 6> by_pose = change_.middleCols<6>(6 * i);
        const Matrix6 covariance = pose->inverse();
        const Eigen::Matrix<double, 6, 10> spread = covariance * by_pose.transpose();
        own.middleRows<6>(6 * i) = covariance;
        cross.middleRows<6>(6 * i) = spread;
        change += by_pose * spread;
    }
    Eigen::VectorXd variances(6 * angles);
    for (Eigen::Index i = 0; i < angles; ++i) {
        const Eigen::Matrix<double, 6, 10> map = datum_.motion_map.middleRows<6>(6 * i);
        const double local = datum_.zero_angle == i ? 0.0 : 1.0;
        const Eigen::Matrix<double, 6, 10> carried = map * change;
        for (Eigen::Index c = 0; c < 6; ++c) {
            variances[6 * i + c] = local * (own(6 * i + c, c) + 2.0 * map.row(c).dot(cross.row(6 * i + c))) +
                                   carried.row(c).dot(map.row(c));
        }
    }
    return variances;
}

}  // namespace gumcert::engine
