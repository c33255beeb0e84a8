#include "engine/rotary_table/joint_adjustment.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/fixed_parts.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

// l = s |E(θ) R(θ) T_s p (1 + α ΔT) − q| − l0, with exact rotations: linearised rows would be off by 0.19 µm at set-up
// errors of 193 µm and 109″, as much as the noise of the lengths (design note rotary-table.md, 1).
// A group of observations is one visit of the table, because its distances share the pose that the table had:
// V = diag(u²) + A Σ Aᵀ, A = ∂l/∂deviation, Σ the repeatability of the table (ADR 0008) at `repeatability_point`.
// What is known beforehand (fixture, expansion, scale, temperature) is a pseudo-observation of its parameter. What is
// stated as exact is held, for a variance of 0 has no weight. Distances do not tell E(θ) from a motion of the world and
// from the set-up of the fixture: E(home) is held at zero, T_s at a preliminary value (ADR 0006).

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Components of a station block.
constexpr int k_scale = 3;
constexpr int k_temperature = 4;
constexpr int k_station_size = 5;

/// Lengths of one visit. Blocks: station, fixture, expansion, reversal, pose, then the dead paths.
class VisitModel final : public ObservationModel {
public:
    VisitModel(Eigen::Matrix3d rotation, RigidMotion set_up, double sense, int pose_size,
               std::vector<std::size_t> reflectors, std::vector<std::size_t> dead_paths, std::size_t dead_path_count,
               Eigen::Index fixture_size)
        : rotation_(std::move(rotation)),
          set_up_(std::move(set_up)),
          sense_(sense),
          pose_size_(pose_size),
          reflectors_(std::move(reflectors)),
          dead_paths_(std::move(dead_paths)),
          dead_path_count_(dead_path_count),
          fixture_size_(fixture_size) {}

    void predict(const double* const* parameters, double* predicted, double* const* jacobians) const override {
        const Eigen::Map<const Eigen::Vector3d> station(parameters[0]);
        const double scale = 1.0 + parameters[0][k_scale];
        const double temperature = parameters[0][k_temperature];
        const double expansion = parameters[2][0];
        const bool own_reversal = pose_size_ > 6;
        const Eigen::Map<const Vector6> reversal(own_reversal ? parameters[4] + 6 : parameters[3]);
        const Eigen::Map<const Vector6> mean_pose(parameters[4]);
        // Half of the reversal in each sense: the pose that is reported is the mean of both.
        const Vector6 pose = mean_pose + 0.5 * sense_ * reversal;
        const Eigen::Matrix3d error_rotation = rotation_zyx(pose.tail<3>());
        // E stands left of R: error motions are those in the frame at rest. To the right of R they would turn with the
        // table, which is another quantity (design note rotary-table.md, 4a).
        const Eigen::Matrix3d fixture_to_world = error_rotation * rotation_ * set_up_.rotation;
        const double stretch = 1.0 + expansion * temperature;
        const auto n = static_cast<Eigen::Index>(reflectors_.size());

        std::array<Eigen::Matrix3d, 3> derivative;
        if (jacobians != nullptr) {
            derivative = rotation_zyx_derivatives(pose.tail<3>());
            clear(jacobians, n);
        }
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto at = static_cast<std::size_t>(i);
            const Eigen::Map<const Eigen::Vector3d> point(parameters[1] + 3 * reflectors_[at]);
            const Eigen::Vector3d turned = rotation_ * (set_up_.rotation * (stretch * point) + set_up_.translation);
            const Eigen::Vector3d world = error_rotation * turned + pose.head<3>();
            const Eigen::Vector3d difference = world - station;
            const double distance = difference.norm();
            predicted[i] = scale * distance - parameters[5 + dead_paths_[at]][0];
            if (jacobians == nullptr) {
                continue;
            }
            // ∂l/∂q = −s u, ∂l/∂s = |P − q|, ∂l/∂p = (1 + α ΔT) s uᵀ E R T_s, u the unit vector along the line of
            // sight.
            const Eigen::Vector3d direction = scale / distance * difference;  // s u
            if (jacobians[0] != nullptr) {
                double* row = jacobians[0] + i * k_station_size;
                row[0] = -direction[0];
                row[1] = -direction[1];
                row[2] = -direction[2];
                row[k_scale] = distance;
            }
            // Derivatives by the chain rule along the line of sight, turned into the frame of what moves.
            const Eigen::Vector3d in_fixture = fixture_to_world.transpose() * direction;
            // By the stretch 1 + α ΔT, whose derivatives are α by ΔT and ΔT by α.
            const double along = in_fixture.dot(point);
            if (jacobians[0] != nullptr) {
                jacobians[0][i * k_station_size + k_temperature] = expansion * along;
            }
            if (jacobians[1] != nullptr) {
                Eigen::Map<Eigen::Vector3d> row(jacobians[1] + i * fixture_size_ +
                                                3 * static_cast<Eigen::Index>(reflectors_[at]));
                row = stretch * in_fixture;
            }
            if (jacobians[2] != nullptr) {
                jacobians[2][i] = temperature * along;
            }
            if (jacobians[3] != nullptr || jacobians[4] != nullptr) {
                Vector6 motion;
                // Exact derivatives by the angles of Rz Ry Rx. Those of small turns would be those of another model
                // where error motions are large.
                motion.head<3>() = direction;
                for (int k = 0; k < 3; ++k) {
                    motion[3 + k] = direction.dot(derivative[static_cast<std::size_t>(k)] * turned);
                }
                // A pose is the mean of both senses of approach, so that each sense lies half a reversal to its side.
                if (jacobians[3] != nullptr) {
                    Eigen::Map<Vector6> row(jacobians[3] + 6 * i);
                    row = own_reversal ? Vector6(Vector6::Zero()) : Vector6(0.5 * sense_ * motion);
                }
                if (jacobians[4] != nullptr) {
                    double* const first = jacobians[4] + pose_size_ * i;
                    Eigen::Map<Vector6>{first} = motion;
                    if (own_reversal) {
                        Eigen::Map<Vector6>(first + 6) = 0.5 * sense_ * motion;
                    }
                }
            }
            if (double* const path = jacobians[5 + dead_paths_[at]]; path != nullptr) {
                path[i] = -1.0;
            }
        }
    }

private:
    void clear(double* const* jacobians, Eigen::Index n) const {
        if (jacobians[1] != nullptr) {
            std::fill_n(jacobians[1], n * fixture_size_, 0.0);
        }
        for (std::size_t d = 0; d < dead_path_count_; ++d) {
            if (jacobians[5 + d] != nullptr) {
                std::fill_n(jacobians[5 + d], n, 0.0);
            }
        }
    }

    Eigen::Matrix3d rotation_;
    RigidMotion set_up_;
    double sense_;   ///< +1, -1, or 0 where only one sense of approach was measured
    int pose_size_;  ///< with the reversal of the angle: 12
    std::vector<std::size_t> reflectors_;
    std::vector<std::size_t> dead_paths_;  ///< position of each length's dead path among the blocks of the group
    std::size_t dead_path_count_;
    Eigen::Index fixture_size_;
};

/// What is stated without a point is stated of the error motions, and they are those of the origin.
bool acts_at_origin(const TableRepeatability& table) {
    return !table.axial_position && table.mode == RepeatabilityMode::given;
}

}  // namespace

Eigen::Matrix3d nominal_rotation(const RotaryTableMeasurement& measurement, std::size_t angle) {
    return axis_rotation(axial_coordinate(measurement.axis),
                         measurement.angles[angle] - measurement.angles[measurement.home]);
}

double repeatability_position(const RotaryTableMeasurement& measurement) {
    if (acts_at_origin(measurement.table_repeatability)) {
        return 0.0;
    }
    return measurement.table_repeatability.axial_position.value_or(
        measurement.fixture.col(axial_coordinate(measurement.axis)).mean());
}

Eigen::Vector3d repeatability_point(const RotaryTableMeasurement& measurement, const RigidMotion& set_up) {
    const int axial = axial_coordinate(measurement.axis);
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    if (!acts_at_origin(measurement.table_repeatability)) {
        point = measurement.fixture.colwise().mean().transpose();
        point[axial] = repeatability_position(measurement);
    }
    Eigen::Vector3d foot = Eigen::Vector3d::Zero();
    foot[axial] = (set_up * point)[axial];
    return foot;
}

Eigen::Matrix<double, 6, 6> pose_by_deviation(const Eigen::Vector3d& point) {
    Eigen::Matrix<double, 6, 6> result = Eigen::Matrix<double, 6, 6>::Identity();
    for (int k = 0; k < 3; ++k) {
        result.block<3, 1>(0, 3 + k) = point.cross(Eigen::Vector3d::Unit(k));
    }
    return result;
}

std::vector<Visit> visits_of(const RotaryTableMeasurement& measurement, const std::vector<bool>& active) {
    std::vector<Visit> visits;
    // By pass and angle: within a pass the table comes to each angle once, and what it is off by is in all distances of
    // that visit.
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> index;
    for (std::size_t i = 0; i < measurement.lengths.size(); ++i) {
        if (!active[i]) {
            continue;
        }
        const LengthObservation& length = measurement.lengths[i];
        const auto [found, inserted] = index.try_emplace({length.pass, length.angle}, visits.size());
        if (inserted) {
            visits.push_back({length.station, length.angle, length.pass, length.approach, {}});
        }
        visits[found->second].observations.push_back(i);
    }
    return visits;
}

JointAdjustment::JointAdjustment(const RotaryTableMeasurement& measurement, std::vector<bool> active,
                                 const RigidMotion& set_up, const StartValues& start, const StochasticModel& stochastic)
    : measurement_(&measurement),
      active_(std::move(active)),
      set_up_(set_up),
      pose_of_deviation_(pose_by_deviation(repeatability_point(measurement, set_up))),
      visits_(visits_of(measurement, active_)) {
    const std::size_t stations = measurement.stations.size();
    const std::size_t reflectors = measurement.reflectors.size();
    const LengthUncertainty& lengths = measurement.length_uncertainty;

    // A reversal is a difference of two visits of one station; a station that saw one sense only cannot tell it from
    // its own position.
    std::vector<std::array<bool, 2>> senses(stations, {false, false});
    for (const Visit& visit : visits_) {
        senses[visit.station][visit.approach == Approach::positive ? 0 : 1] = true;
    }
    has_reversal_ = std::all_of(senses.begin(), senses.end(), [](const auto& s) { return s[0] && s[1]; });
    reversal_by_angle_ = has_reversal_ && measurement.reversal == ReversalModel::by_angle;

    for (std::size_t j = 0; j < stations; ++j) {
        const std::string name = "station " + measurement.stations[j];
        Eigen::VectorXd value(k_station_size);
        value << start.stations[j], 0.0, measurement.temperature_difference[static_cast<Eigen::Index>(j)];
        const auto block = adjustment_.add_parameters(
            {name + ", x", name + ", y", name + ", z", name + ", scale", name + ", fixture temperature"}, value);
        if (lengths.scale_model == ScaleModel::fixed) {
            adjustment_.hold(block, k_scale);
        }
        if (measurement.u_temperature[static_cast<Eigen::Index>(j)] <= 0.0) {
            adjustment_.hold(block, k_temperature);
        }
        station_blocks_.push_back(block);
    }
    // A tracer counts fringes: each time the beam is broken the constant is another one, so that a station may have
    // several.
    for (std::size_t d = 0; d < measurement.dead_paths.size(); ++d) {
        dead_path_blocks_.push_back(
            adjustment_.add_parameters({"dead path " + measurement.dead_paths[d]},
                                       Eigen::VectorXd::Constant(1, start.dead_paths[static_cast<Eigen::Index>(d)])));
    }
    std::vector<std::string> names;
    Eigen::VectorXd fixture(3 * static_cast<Eigen::Index>(reflectors));
    for (std::size_t m = 0; m < reflectors; ++m) {
        for (int c = 0; c < 3; ++c) {
            names.push_back("reflector " + measurement.reflectors[m] + ", " + "xyz"[c]);
            fixture[3 * static_cast<Eigen::Index>(m) + c] = measurement.fixture(static_cast<Eigen::Index>(m), c);
        }
    }
    fixture_block_ = adjustment_.add_parameters(std::move(names), fixture);
    expansion_block_ =
        adjustment_.add_parameters({"expansion of the fixture"}, Eigen::VectorXd::Constant(1, measurement.expansion));
    if (measurement.u_expansion <= 0.0) {
        adjustment_.hold(expansion_block_, 0);
    }
    const auto motions = error_motion_names(measurement.axis);
    std::vector<std::string> reversal_names;
    for (const std::string& motion : motions) {
        reversal_names.push_back("reversal of " + motion);
    }
    reversal_block_ = adjustment_.add_parameters(std::move(reversal_names), Eigen::VectorXd::Zero(6));
    for (int c = 0; c < 6 && (!has_reversal_ || reversal_by_angle_); ++c) {
        adjustment_.hold(reversal_block_, c);
    }
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        std::vector<std::string> pose_names;
        const std::string at_angle = " at angle number " + std::to_string(i + 1);
        for (const std::string& motion : motions) {
            pose_names.push_back(motion + at_angle);
        }
        for (std::size_t c = 0; c < motions.size() && reversal_by_angle_; ++c) {
            pose_names.push_back("reversal of " + motions[c] + at_angle);
        }
        // Eliminated: there are as many poses as angles, and no distance has two.
        const auto block = adjustment_.add_parameters(std::move(pose_names), Eigen::VectorXd::Zero(pose_size()), true);
        // The pose at home is held: distances do not tell it from a motion of the world (ADR 0006).
        for (int c = 0; c < 6 && i == measurement.home; ++c) {
            adjustment_.hold(block, c);
        }
        pose_blocks_.push_back(block);
    }

    for (const Visit& visit : visits_) {
        std::vector<Adjustment::BlockId> blocks{station_blocks_[visit.station], fixture_block_, expansion_block_,
                                                reversal_block_, pose_blocks_[visit.angle]};
        std::vector<std::size_t> seen;       // dead paths of this visit
        std::vector<std::size_t> positions;  // of each length's dead path in `seen`
        std::vector<std::size_t> targets;
        Eigen::VectorXd observed(static_cast<Eigen::Index>(visit.observations.size()));
        for (std::size_t k = 0; k < visit.observations.size(); ++k) {
            const LengthObservation& length = measurement.lengths[visit.observations[k]];
            auto found = std::find(seen.begin(), seen.end(), length.dead_path);
            if (found == seen.end()) {
                blocks.push_back(dead_path_blocks_[length.dead_path]);
                found = seen.insert(seen.end(), length.dead_path);
            }
            positions.push_back(static_cast<std::size_t>(found - seen.begin()));
            targets.push_back(length.reflector);
            observed[static_cast<Eigen::Index>(k)] = length.length;
        }
        const double sense = !has_reversal_ ? 0.0 : (visit.approach == Approach::positive ? 1.0 : -1.0);
        auto model =
            std::make_shared<VisitModel>(nominal_rotation(measurement, visit.angle), set_up_, sense, pose_size(),
                                         std::move(targets), std::move(positions), seen.size(), fixture.size());
        const Eigen::Index n = observed.size();
        // The identity holds the place: weights need the derivatives by the poses, see set_weights().
        adjustment_.add_observations(std::move(model), std::move(blocks), std::move(observed),
                                     Eigen::MatrixXd::Identity(n, n));
    }

    std::vector<int> all(static_cast<std::size_t>(fixture.size()));
    for (std::size_t c = 0; c < all.size(); ++c) {
        all[c] = static_cast<int>(c);
    }
    fixture_prior_ = adjustment_.add_prior(fixture_block_, std::move(all), fixture, measurement.fixture_covariance);
    if (measurement.u_expansion > 0.0) {
        expansion_prior_ =
            adjustment_.add_prior(expansion_block_, {0}, Eigen::VectorXd::Constant(1, measurement.expansion),
                                  Eigen::MatrixXd::Constant(1, 1, measurement.u_expansion * measurement.u_expansion));
    }
    scale_priors_.assign(stations, k_none);
    temperature_priors_.assign(stations, k_none);
    for (std::size_t j = 0; j < stations; ++j) {
        const auto at = static_cast<Eigen::Index>(j);
        // What distances tell of a scale comes from the fixture and is some ppm; the wavelength is known to 0.1 ppm.
        // Free, the scale would be taken from the worse of the two (design note rotary-table.md, 4c).
        if (lengths.scale_model == ScaleModel::prior) {
            scale_priors_[j] =
                adjustment_.add_prior(station_blocks_[j], {k_scale}, Eigen::VectorXd::Zero(1),
                                      Eigen::MatrixXd::Constant(1, 1, lengths.u_scale * lengths.u_scale));
        }
        if (measurement.u_temperature[at] > 0.0) {
            const double u = measurement.u_temperature[at];
            temperature_priors_[j] =
                adjustment_.add_prior(station_blocks_[j], {k_temperature},
                                      Eigen::VectorXd::Constant(1, measurement.temperature_difference[at]),
                                      Eigen::MatrixXd::Constant(1, 1, u * u));
        }
    }
    set_weights(stochastic);
}

Eigen::MatrixXd JointAdjustment::pose_jacobian(std::size_t visit) const {
    return adjustment_.jacobian(visit, pose_blocks_[visits_[visit].angle]).leftCols<6>();
}

Eigen::MatrixXd JointAdjustment::repeatability_jacobian(std::size_t visit) const {
    return pose_jacobian(visit) * pose_of_deviation_;
}

Eigen::VectorXd JointAdjustment::stated_variance(std::size_t visit) const {
    const LengthUncertainty& u = measurement_->length_uncertainty;
    const std::vector<std::size_t>& observations = visits_[visit].observations;
    Eigen::VectorXd variance(static_cast<Eigen::Index>(observations.size()));
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const LengthObservation& length = measurement_->lengths[observations[k]];
        // The noise is that of the whole distance; the displayed length lacks the dead path.
        const double distance = length.length + adjustment_.parameters(dead_path_blocks_[length.dead_path])[0];
        // Both parts have causes of their own: they add in squares.
        const double proportional = u.u_proportional * distance;
        variance[static_cast<Eigen::Index>(k)] = u.u_constant * u.u_constant + proportional * proportional;
    }
    return variance;
}

Eigen::MatrixXd JointAdjustment::visit_covariance(std::size_t visit, const StochasticModel& stochastic) const {
    const double resolution = measurement_->length_uncertainty.resolution;
    // A displayed length lies anywhere within one step (JCGM 100:2008, F.2.2.1): known, whatever the noise turns out.
    Eigen::MatrixXd covariance =
        ((stochastic.length_factor * stated_variance(visit)).array() + resolution * resolution / 12.0)
            .matrix()
            .asDiagonal();
    // Axial apart from tilt: a table positions less well than it tilts (ADR 0008).
    Vector6 repeatability;
    repeatability << Eigen::Vector3d::Constant(stochastic.variance_linear),
        Eigen::Vector3d::Constant(stochastic.variance_tilt);
    repeatability[3 + axial_coordinate(measurement_->axis)] = stochastic.variance_axial;
    if (repeatability.maxCoeff() > 0.0) {
        // Left out, it would make the stated uncertainties about three times too small (ADR 0008).
        const Eigen::MatrixXd pose = repeatability_jacobian(visit);
        covariance.noalias() += pose * repeatability.asDiagonal() * pose.transpose();
    }
    return covariance;
}

void JointAdjustment::set_weights(const StochasticModel& stochastic) {
    // Parts of one size, whatever the number of threads.
    constexpr std::size_t k_visits_of_a_part = 256;
    FixedParts(visits_.size(), k_visits_of_a_part)
        .run(adjustment_.workers(), [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) {
                adjustment_.set_covariance(v, visit_covariance(v, stochastic));
            }
        });
    adjustment_.set_covariance(fixture_prior_, stochastic.fixture_factor * measurement_->fixture_covariance);
}

Eigen::MatrixXd JointAdjustment::poses() const {
    Eigen::MatrixXd poses(6, static_cast<Eigen::Index>(pose_blocks_.size()));
    for (std::size_t i = 0; i < pose_blocks_.size(); ++i) {
        poses.col(static_cast<Eigen::Index>(i)) = adjustment_.parameters(pose_blocks_[i]).head<6>();
    }
    return poses;
}

Vector6 JointAdjustment::reversal(std::size_t angle) const {
    return reversal_by_angle_ ? adjustment_.parameters(pose_blocks_[angle]).tail<6>()
                              : adjustment_.parameters(reversal_block_).head<6>();
}

Vector6 JointAdjustment::mean_reversal() const {
    if (!reversal_by_angle_) {
        return adjustment_.parameters(reversal_block_);
    }
    Vector6 sum = Vector6::Zero();
    for (std::size_t i = 0; i < pose_blocks_.size(); ++i) {
        sum += reversal(i);
    }
    return sum / static_cast<double>(pose_blocks_.size());
}

void JointAdjustment::set_pose(std::size_t angle, const Vector6& motions) {
    Eigen::VectorXd pose = adjustment_.parameters(pose_blocks_[angle]);
    pose.head<6>() = motions;
    adjustment_.set_parameters(pose_blocks_[angle], std::move(pose));
}

void JointAdjustment::turn_about(const RigidMotion& set_up) {
    const RigidMotion change = set_up * set_up_.inverse();
    for (std::size_t i = 0; i < pose_blocks_.size(); ++i) {
        if (i != measurement_->home) {
            const RigidMotion turn{nominal_rotation(*measurement_, i), Eigen::Vector3d::Zero()};
            set_pose(i, motion_parameters(change.inverse() * turn * change * turn.inverse()));
        }
    }
}

StartValues JointAdjustment::present_values() const {
    StartValues values;
    for (const auto block : station_blocks_) {
        values.stations.emplace_back(adjustment_.parameters(block).head<3>());
    }
    values.dead_paths.resize(static_cast<Eigen::Index>(dead_path_blocks_.size()));
    for (std::size_t d = 0; d < dead_path_blocks_.size(); ++d) {
        values.dead_paths[static_cast<Eigen::Index>(d)] = adjustment_.parameters(dead_path_blocks_[d])[0];
    }
    return values;
}

// With a distance less or more the solution hardly moves: the next adjustment begins where the last one ended.
void JointAdjustment::copy_parameters_from(const JointAdjustment& other) {
    for (std::size_t j = 0; j < station_blocks_.size(); ++j) {
        adjustment_.set_parameters(station_blocks_[j], other.adjustment_.parameters(other.station_blocks_[j]));
    }
    for (std::size_t d = 0; d < dead_path_blocks_.size(); ++d) {
        adjustment_.set_parameters(dead_path_blocks_[d], other.adjustment_.parameters(other.dead_path_blocks_[d]));
    }
    for (std::size_t i = 0; i < pose_blocks_.size(); ++i) {
        Eigen::VectorXd pose(pose_size());
        pose.head<6>() = other.adjustment_.parameters(other.pose_blocks_[i]).head<6>();
        if (reversal_by_angle_) {
            // One reversal of all angles is the start of that of each.
            pose.tail<6>() = other.reversal(i);
        }
        adjustment_.set_parameters(pose_blocks_[i], std::move(pose));
    }
    adjustment_.set_parameters(fixture_block_, other.adjustment_.parameters(other.fixture_block_));
    adjustment_.set_parameters(expansion_block_, other.adjustment_.parameters(other.expansion_block_));
    if (has_reversal_ && !reversal_by_angle_ && other.has_reversal_) {
        adjustment_.set_parameters(reversal_block_, other.mean_reversal());
    }
}

}  // namespace gumcert::engine
