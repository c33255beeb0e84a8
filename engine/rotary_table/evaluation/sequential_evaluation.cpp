#include "engine/rotary_table/evaluation/sequential_evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "gum/quantity/dense_factors.h"
#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The input quantities of the method, as numbers.
struct Inputs {
    Eigen::VectorXd lengths;      ///< active lengths, visit by visit, without table and resolution deviations, [m]
    Eigen::VectorXd scale;        ///< s - 1 a station, [1]
    Eigen::MatrixX3d fixture;     ///< [m]
    Eigen::VectorXd temperature;  ///< difference from the reference temperature, a station, [K]
    double expansion = 0.0;       ///< [1/K]
};

/// Position of one reflector at one angle, in the fixture frame at home.
struct PointPosition {
    bool determined = false;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
    std::vector<std::size_t> observations;               ///< indices of its lengths
    Eigen::MatrixXd gain;                                ///< pseudo-inverse of its design, 3×observations
};

struct StationStage {
    Eigen::VectorXd unknowns;               ///< x, y, z, dead paths[, scale deviation]
    std::vector<std::size_t> dead_paths;    ///< which
    std::vector<std::size_t> observations;  ///< its lengths at home
    Eigen::MatrixXd gain;                   ///< pseudo-inverse, unknowns×observations
    double condition_number = 0.0;
};

struct Stages {
    std::vector<StationStage> stations;
    std::vector<std::vector<PointPosition>> points;  ///< by angle, by reflector
    Vector6 set_up = Vector6::Zero();                ///< by eq. (6)
    Eigen::MatrixXd errors;                          ///< 6×angles, zero at home
    DatumSolution datum;
};

/// One active length with its place in the measurement.
struct Distance {
    std::size_t station, reflector, angle, dead_path;
    std::size_t length;     ///< index into the lengths of the measurement
    Eigen::Index path = 0;  ///< of its dead path among those of its station
};

constexpr int k_most_steps_of_a_stage = 50;
constexpr double k_station_step = 1e-12;    // [m]: what is left is rounding
constexpr double k_settled_station = 1e-9;  // [m]: rounding of a station whose place is hardly determined
constexpr double k_point_step = 1e-13;      // [m]

[[noreturn]] void refuse(const std::string& where, const std::string& what, const std::string& action) {
    throw gum::NoResultError(gum::Diagnostic{"GC-SEQUENTIAL-0001", where, what,
                                             "each stage of the sequential method must be determined by itself", action,
                                             gum::Severity::error});
}

/// Rows of the set-up errors across the axis at a point turned to P: eq. (8) times (R - I), 3×4 (the paper's eq. (4)).
Eigen::Matrix<double, 3, 4> set_up_rows(const Eigen::Vector3d& point, const Eigen::Matrix3d& rotation,
                                        const std::array<int, 2>& across) {
    const Eigen::Matrix3d change = rotation - Eigen::Matrix3d::Identity();
    const Eigen::Matrix<double, 3, 6> rows = point_displacement(point);
    Eigen::Matrix<double, 3, 4> result;
    for (int c = 0; c < 2; ++c) {
        const Eigen::Vector3d column = change.col(across[static_cast<std::size_t>(c)]);
        result.col(c) = rows.leftCols<3>() * column;
        result.col(2 + c) = rows.rightCols<3>() * column;
    }
    return result;
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& design, double* condition, bool* full_rank) {
    // Columns of unit length, so that coordinates, dead paths and scale count alike in the rank.
    const Eigen::VectorXd scale = design.colwise().norm().cwiseInverse();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(design * scale.asDiagonal(), Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd& values = svd.singularValues();
    // A singular design is refused by the caller: the values below are then not used.
    *full_rank = design.rows() >= design.cols() && values[values.size() - 1] > 1e-9 * values[0];
    *condition = values[0] / values[values.size() - 1];
    // The matrix itself and not only a step: it is the derivative of a stage by its lengths, and carries uncertainties
    // from one stage to the next.
    return scale.asDiagonal() * svd.matrixV() * values.cwiseInverse().asDiagonal() * svd.matrixU().transpose();
}

class SequentialModel final : public gum::MeasurementModel {
public:
    SequentialModel(RotaryTableMeasurement measurement, const RotaryTableModel& joint)
        : measurement_(std::move(measurement)), quantities_(reported_quantities(measurement_, false)) {
        for (const gum::InputGroup& group : joint.inputs()) {
            if (group.source != "dead path") {  // here a result of the first stage, not an input
                inputs_.push_back(group);
            }
        }
        const std::vector<Visit>& visits = joint.solved().visits();
        for (std::size_t v = 0; v < visits.size(); ++v) {
            visit_pose_.push_back(joint.visit_pose(v));
            for (const std::size_t i : visits[v].observations) {
                const LengthObservation& length = measurement_.lengths[i];
                distances_.push_back({length.station, length.reflector, length.angle, length.dead_path, i});
            }
        }
        for (std::size_t j = 0; j < measurement_.stations.size(); ++j) {
            has_scale_.push_back(joint.solved().scale_prior(j) != JointAdjustment::k_none);
            has_temperature_.push_back(joint.solved().temperature_prior(j) != JointAdjustment::k_none);
        }
        has_expansion_ = joint.solved().expansion_prior() != JointAdjustment::k_none;
        // Dead paths of a station in the order of its distances at home, where the first stage finds them.
        paths_.resize(measurement_.stations.size());
        for (const Distance& distance : distances_) {
            std::vector<std::size_t>& paths = paths_[distance.station];
            if (distance.angle == measurement_.home &&
                std::find(paths.begin(), paths.end(), distance.dead_path) == paths.end()) {
                paths.push_back(distance.dead_path);
            }
        }
        for (Distance& distance : distances_) {
            const std::vector<std::size_t>& paths = paths_[distance.station];
            distance.path = std::find(paths.begin(), paths.end(), distance.dead_path) - paths.begin();
        }
        // Where the joint adjustment ended, of which rivals were asked: a search alone may stand on a false side.
        start_ = joint.solved().present_values();
        const RigidMotion fixture_from_table = joint.solved().set_up().inverse();
        for (Eigen::Vector3d& station : start_.stations) {
            station = fixture_from_table * station;
        }
    }

    [[nodiscard]] const std::vector<gum::InputGroup>& inputs() const override { return inputs_; }
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return quantities_.outputs; }
    [[nodiscard]] const ReportedQuantities& quantities() const { return quantities_; }

    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override {
        return reported(solve(unpack(x)));
    }

    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
        const Inputs in = unpack(x);
        return with_table(reported_derivatives(solve(in), in));
    }

    [[nodiscard]] Stages solve(const Inputs& in) const;
    [[nodiscard]] Inputs unpack(const Eigen::VectorXd& x) const;
    [[nodiscard]] Eigen::VectorXd reported(const Stages& stages) const;
    /// ∂(x, y, z, dead paths[, scale]) of a station, with respect to the inputs without the table.
    [[nodiscard]] Eigen::MatrixXd station_derivatives(const Stages& stages, const Inputs& in,
                                                      std::size_t station) const;
    [[nodiscard]] Eigen::MatrixXd reported_derivatives(const Stages& stages, const Inputs& in) const;
    /// Columns of the table's deviations and of the resolution behind those of the other inputs: they act through the
    /// lengths.
    [[nodiscard]] Eigen::MatrixXd with_table(const Eigen::MatrixXd& derivatives) const;
    /// Largest influence of an undetected bias of one distance on every reported quantity, the biases those of `rows`.
    [[nodiscard]] std::vector<ExternalReliability> external_reliability(
        const Eigen::MatrixXd& derivatives, const std::vector<DistanceReliability>& rows) const;
    /// D V Dᵀ over all inputs.
    [[nodiscard]] Eigen::MatrixXd propagated(const Eigen::MatrixXd& derivatives) const;

private:
    [[nodiscard]] Eigen::Index column_count() const;  ///< inputs without the table and the resolution
    [[nodiscard]] bool has_resolution() const { return measurement_.length_uncertainty.resolution > 0.0; }
    /// ∂f/∂inputs of one distance f = s |P + α ΔT R p - q| - l0 apart from station and point, subtracted from `row`.
    void subtract_direct(const Inputs& in, std::size_t k, const Eigen::Vector3d& direction, double distance,
                         bool coordinates, Eigen::Ref<Eigen::RowVectorXd> row) const;
    [[nodiscard]] double scale_of(const Stages& stages, const Inputs& in, std::size_t station) const {
        return 1.0 + (scale_is_free() ? stages.stations[station].unknowns.tail<1>()[0]
                                      : in.scale[static_cast<Eigen::Index>(station)]);
    }
    [[nodiscard]] bool scale_is_free() const { return measurement_.length_uncertainty.scale_model == ScaleModel::free; }

    RotaryTableMeasurement measurement_;
    ReportedQuantities quantities_;
    std::vector<gum::InputGroup> inputs_;
    std::vector<Distance> distances_;
    std::vector<std::vector<std::size_t>> paths_;  ///< dead paths of every station that were measured at home
    std::vector<Eigen::MatrixXd> visit_pose_;
    std::vector<bool> has_scale_, has_temperature_;
    bool has_expansion_ = false;
    StartValues start_;
};

Inputs SequentialModel::unpack(const Eigen::VectorXd& x) const {
    Inputs in;
    const auto n = static_cast<Eigen::Index>(distances_.size());
    const auto stations = static_cast<Eigen::Index>(measurement_.stations.size());
    in.lengths = x.head(n);
    Eigen::Index next = n;
    in.scale = Eigen::VectorXd::Zero(stations);
    for (Eigen::Index j = 0; j < stations; ++j) {
        if (has_scale_[static_cast<std::size_t>(j)]) {
            in.scale[j] = x[next++];
        }
    }
    in.fixture.resize(measurement_.fixture.rows(), 3);
    for (Eigen::Index m = 0; m < in.fixture.rows(); ++m, next += 3) {
        in.fixture.row(m) = x.segment<3>(next).transpose();
    }
    in.temperature = measurement_.temperature_difference;
    for (Eigen::Index j = 0; j < stations; ++j) {
        if (has_temperature_[static_cast<std::size_t>(j)]) {
            in.temperature[j] = x[next++];
        }
    }
    in.expansion = has_expansion_ ? x[next++] : measurement_.expansion;
    const auto visits = static_cast<Eigen::Index>(visit_pose_.size());
    const auto order = repeatability_order(measurement_.axis);
    // Inputs of the resolution and of the table are deviations with the estimate 0: they act through the lengths.
    if (has_resolution()) {
        in.lengths += x.tail(n);
    }
    Eigen::Index row = 0;
    for (Eigen::Index v = 0; v < visits; ++v) {
        Vector6 deviation;
        for (int c = 0; c < 6; ++c) {
            const Eigen::Index at = c < 3    ? next + 3 * v + c
                                    : c == 3 ? next + 3 * visits + v
                                             : next + 4 * visits + 2 * v + c - 4;
            deviation[order[static_cast<std::size_t>(c)]] = x[at];
        }
        const Eigen::MatrixXd& pose = visit_pose_[static_cast<std::size_t>(v)];
        in.lengths.segment(row, pose.rows()) -= pose * deviation;
        row += pose.rows();
    }
    return in;
}

Stages SequentialModel::solve(const Inputs& in) const {
    Stages stages;
    const std::size_t angles = measurement_.angles.size();
    const std::size_t reflectors = measurement_.reflectors.size();

    // Stage 1: every station and its dead paths from the home position, the fixture taken as the CMM measured it.
    // Each station alone: that is the method of the paper, and why its uncertainties are larger than those of the joint
    // adjustment.
    for (std::size_t j = 0; j < measurement_.stations.size(); ++j) {
        StationStage station;
        for (std::size_t k = 0; k < distances_.size(); ++k) {
            if (distances_[k].station == j && distances_[k].angle == measurement_.home) {
                station.observations.push_back(k);
            }
        }
        station.dead_paths = paths_[j];
        for (const Distance& distance : distances_) {
            if (distance.station == j && distance.path == std::ssize(station.dead_paths)) {
                refuse("dead path " + measurement_.dead_paths[distance.dead_path], "has no distance at the home angle",
                       "measure it at home, or use \"method\": \"joint\"");
            }
        }
        const auto paths = static_cast<Eigen::Index>(station.dead_paths.size());
        const Eigen::Index size = 3 + paths + (scale_is_free() ? 1 : 0);
        station.unknowns = Eigen::VectorXd::Zero(size);
        station.unknowns.head<3>() = start_.stations[j];
        for (Eigen::Index d = 0; d < paths; ++d) {
            station.unknowns[3 + d] =
                start_.dead_paths[static_cast<Eigen::Index>(station.dead_paths[static_cast<std::size_t>(d)])];
        }
        // At home the fixture stands as the CMM measured it, but for its temperature.
        const double stretch = 1.0 + in.expansion * in.temperature[static_cast<Eigen::Index>(j)];
        Eigen::MatrixXd design(station.observations.size(), size);
        Eigen::VectorXd misclosure(station.observations.size());
        double last_step = 0.0;
        for (int iteration = 0; iteration < k_most_steps_of_a_stage; ++iteration) {
            const double scale =
                1.0 + (scale_is_free() ? station.unknowns[size - 1] : in.scale[static_cast<Eigen::Index>(j)]);
            design.setZero();
            for (std::size_t row = 0; row < station.observations.size(); ++row) {
                const std::size_t k = station.observations[row];
                const auto at = static_cast<Eigen::Index>(row);
                const Eigen::Vector3d difference =
                    stretch * in.fixture.row(static_cast<Eigen::Index>(distances_[k].reflector)).transpose() -
                    station.unknowns.head<3>();
                const double distance = difference.norm();
                const Eigen::Index path = distances_[k].path;
                design.row(at).head<3>() = -scale / distance * difference.transpose();
                design(at, 3 + path) = -1.0;
                if (scale_is_free()) {
                    design(at, size - 1) = distance;
                }
                misclosure[at] =
                    in.lengths[static_cast<Eigen::Index>(k)] - (scale * distance - station.unknowns[3 + path]);
            }
            bool full_rank = false;
            station.gain = pseudo_inverse(design, &station.condition_number, &full_rank);
            if (!full_rank) {
                refuse("station " + measurement_.stations[j], "is not determined from the home position",
                       "measure more reflectors at home, not on one cone about the line of sight");
            }
            const Eigen::VectorXd step = station.gain * misclosure;
            station.unknowns += step;
            last_step = step.head<3>().norm();
            if (last_step < k_station_step) {
                break;
            }
        }
        if (!(last_step < k_settled_station)) {
            refuse("station " + measurement_.stations[j], "its position does not settle at the home position",
                   "look for interchanged reflectors or a wrong dead path at home, or use \"method\": \"joint\"");
        }
        stages.stations.push_back(std::move(station));
    }

    // Stage 2: every reflector at every angle from the stations, taken as exact.
    stages.points.assign(angles, std::vector<PointPosition>(reflectors));
    for (std::size_t k = 0; k < distances_.size(); ++k) {
        stages.points[distances_[k].angle][distances_[k].reflector].observations.push_back(k);
    }
    for (std::size_t i = 0; i < angles; ++i) {
        const Eigen::Matrix3d rotation = nominal_rotation(measurement_, i);
        for (std::size_t m = 0; m < reflectors; ++m) {
            PointPosition& point = stages.points[i][m];
            const Eigen::Vector3d ideal = rotation * in.fixture.row(static_cast<Eigen::Index>(m)).transpose();
            point.position = ideal;
            // Fewer than three distances do not determine a point; the angle may still have enough others.
            if (point.observations.size() < 3) {
                continue;
            }
            Eigen::MatrixXd design(point.observations.size(), 3);
            Eigen::VectorXd misclosure(point.observations.size());
            for (int iteration = 0; iteration < k_most_steps_of_a_stage; ++iteration) {
                for (std::size_t row = 0; row < point.observations.size(); ++row) {
                    const std::size_t k = point.observations[row];
                    const std::size_t j = distances_[k].station;
                    const StationStage& station = stages.stations[j];
                    const Eigen::Index path = distances_[k].path;
                    const double scale = scale_of(stages, in, j);
                    const Eigen::Vector3d difference =
                        // Each station saw the fixture at a temperature of its own. The point that they share is that
                        // of the reference temperature.
                        point.position + in.expansion * in.temperature[static_cast<Eigen::Index>(j)] * ideal -
                        station.unknowns.head<3>();
                    const double distance = difference.norm();
                    design.row(static_cast<Eigen::Index>(row)) = scale / distance * difference.transpose();
                    misclosure[static_cast<Eigen::Index>(row)] =
                        in.lengths[static_cast<Eigen::Index>(k)] - (scale * distance - station.unknowns[3 + path]);
                }
                double condition = 0.0;
                bool full_rank = false;
                point.gain = pseudo_inverse(design, &condition, &full_rank);
                if (!full_rank) {
                    break;
                }
                const Eigen::Vector3d step = point.gain * misclosure;
                point.position += step;
                if (step.norm() < k_point_step) {
                    point.determined = true;
                    break;
                }
            }
        }
    }

    // Set-up errors, eqs. (2)-(6): ideal positions are the home positions turned; least squares over all points.
    // Linear rows, as the paper has them: with set-up errors of 193 µm and 109″ they leave 0.19 µm, as much as the
    // noise of a length (design note rotary-table.md, 1).
    const std::vector<PointPosition>& home = stages.points[measurement_.home];
    const auto across = across_axis(measurement_.axis);
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < angles; ++i) {
        const Eigen::Matrix3d rotation = nominal_rotation(measurement_, i);
        for (std::size_t m = 0; m < reflectors; ++m) {
            if (i == measurement_.home || !home[m].determined || !stages.points[i][m].determined) {
                continue;
            }
            const Eigen::Vector3d ideal = rotation * home[m].position;
            const Eigen::Matrix<double, 3, 4> rows = set_up_rows(ideal, rotation, across);
            normal += rows.transpose() * rows;
            right += rows.transpose() * (stages.points[i][m].position - ideal);
        }
    }
    const Eigen::Vector4d z = normal.ldlt().solve(right);
    for (int c = 0; c < 2; ++c) {
        stages.set_up[across[static_cast<std::size_t>(c)]] = z[c];
        stages.set_up[3 + across[static_cast<std::size_t>(c)]] = z[2 + c];
    }

    // Six errors of each angle, eqs. (7)-(9), in the stationary frame T.
    const RigidMotion table_from_fixture = rigid_motion(stages.set_up);
    if (const double angle = inclination(measurement_.axis, table_from_fixture); !(angle <= k_small_inclination)) {
        throw gum::NoResultError(gum::Diagnostic{
            "GC-SEQUENTIAL-0003", "sequential method",
            "the fixture is tilted against the axis by " + text::fixed(angle / gum::k_degree, 1) + "°",
            "the equations of the stages are linear in the tilt: up to 10°",
            "use \"method\": \"joint\", or state the coordinates of the fixture in a frame along the axis",
            gum::Severity::error});
    }
    stages.errors = Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(angles));
    for (std::size_t i = 0; i < angles; ++i) {
        if (i == measurement_.home) {
            continue;
        }
        const Eigen::Matrix3d rotation = nominal_rotation(measurement_, i);
        Eigen::Matrix<double, 6, 6> pose_normal = Eigen::Matrix<double, 6, 6>::Zero();
        Vector6 pose_right = Vector6::Zero();
        int used = 0;
        for (std::size_t m = 0; m < reflectors; ++m) {
            if (!home[m].determined || !stages.points[i][m].determined) {
                continue;
            }
            ++used;
            const Eigen::Vector3d expected = rotation * (table_from_fixture * home[m].position);
            const Eigen::Matrix<double, 3, 6> rows = point_displacement(expected);
            pose_normal += rows.transpose() * rows;
            pose_right += rows.transpose() * (table_from_fixture * stages.points[i][m].position - expected);
        }
        // Two points leave a turn about the line through them open.
        if (used < 3) {
            refuse("angle number " + std::to_string(i + 1),
                   std::to_string(used) + " reflectors have a position there and at home, 3 are needed",
                   "measure each reflector from at least three stations, or use \"method\": \"joint\"");
        }
        stages.errors.col(static_cast<Eigen::Index>(i)) = pose_normal.ldlt().solve(pose_right);
    }
    // The stages refer to home already.
    if (measurement_.datum == Datum::home) {
        const Eigen::Index size = stages.errors.size();
        stages.datum.errors = stages.errors;
        stages.datum.set_up = stages.set_up;
        stages.datum.motion_map = Eigen::MatrixXd::Zero(size, 10);
        stages.datum.set_up_map = Eigen::MatrixXd::Zero(4, size);
        stages.datum.world_map = Eigen::MatrixXd::Zero(6, size);
    } else {
        stages.datum = transform_to_datum(measurement_, stages.errors, table_from_fixture, measurement_.datum);
    }
    return stages;
}

Eigen::VectorXd SequentialModel::reported(const Stages& stages) const {
    const auto across = across_axis(measurement_.axis);
    const Eigen::Index errors = stages.datum.errors.size();
    Eigen::VectorXd values(errors + 4);
    values.head(errors) = stages.datum.errors.reshaped();
    for (int c = 0; c < 2; ++c) {
        values[errors + c] = stages.datum.set_up[across[static_cast<std::size_t>(c)]];
        values[errors + 2 + c] = stages.datum.set_up[3 + across[static_cast<std::size_t>(c)]];
    }
    return values;
}

Eigen::Index SequentialModel::column_count() const {
    return static_cast<Eigen::Index>(distances_.size()) + std::count(has_scale_.begin(), has_scale_.end(), true) +
           3 * measurement_.fixture.rows() + std::count(has_temperature_.begin(), has_temperature_.end(), true) +
           (has_expansion_ ? 1 : 0);
}

void SequentialModel::subtract_direct(const Inputs& in, std::size_t k, const Eigen::Vector3d& direction,
                                      double distance, bool coordinates, Eigen::Ref<Eigen::RowVectorXd> row) const {
    const Distance& at = distances_[k];
    const Eigen::Matrix3d rotation = nominal_rotation(measurement_, at.angle);
    const double temperature = in.temperature[static_cast<Eigen::Index>(at.station)];
    const Eigen::Vector3d point = in.fixture.row(static_cast<Eigen::Index>(at.reflector)).transpose();
    const Eigen::Vector3d in_fixture = rotation.transpose() * direction;  // s Rᵀ u
    auto next = static_cast<Eigen::Index>(distances_.size());
    for (std::size_t j = 0; j < has_scale_.size(); ++j) {
        if (has_scale_[j]) {
            if (j == at.station) {
                row[next] -= distance;
            }
            ++next;
        }
    }
    // At home the position itself is the CMM's; elsewhere only its thermal expansion is.
    const double factor = (coordinates ? 1.0 : 0.0) + in.expansion * temperature;
    row.segment<3>(next + 3 * static_cast<Eigen::Index>(at.reflector)) -= factor * in_fixture.transpose();
    next += 3 * in.fixture.rows();
    for (std::size_t j = 0; j < has_temperature_.size(); ++j) {
        if (has_temperature_[j]) {
            if (j == at.station) {
                row[next] -= in.expansion * in_fixture.dot(point);
            }
            ++next;
        }
    }
    if (has_expansion_) {
        row[next] -= temperature * in_fixture.dot(point);
    }
}

Eigen::MatrixXd SequentialModel::station_derivatives(const Stages& stages, const Inputs& in,
                                                     std::size_t station_index) const {
    const StationStage& station = stages.stations[station_index];
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(station.gain.cols(), column_count());
    const double stretch = 1.0 + in.expansion * in.temperature[static_cast<Eigen::Index>(station_index)];
    for (std::size_t row = 0; row < station.observations.size(); ++row) {
        const std::size_t k = station.observations[row];
        const Eigen::Vector3d difference =
            stretch * in.fixture.row(static_cast<Eigen::Index>(distances_[k].reflector)).transpose() -
            station.unknowns.head<3>();
        const double distance = difference.norm();
        Eigen::RowVectorXd line = Eigen::RowVectorXd::Zero(column_count());
        // The residual of each distance moves with its length and against what it is predicted from.
        line[static_cast<Eigen::Index>(k)] = 1.0;
        subtract_direct(in, k, scale_of(stages, in, station_index) / distance * difference, distance, true, line);
        rows.row(static_cast<Eigen::Index>(row)) = line;
    }
    return station.gain * rows;
}

Eigen::MatrixXd SequentialModel::reported_derivatives(const Stages& stages, const Inputs& in) const {
    const std::size_t angles = measurement_.angles.size();
    const std::size_t reflectors = measurement_.reflectors.size();
    const Eigen::Index columns = column_count();
    std::vector<Eigen::MatrixXd> by_station;
    for (std::size_t j = 0; j < measurement_.stations.size(); ++j) {
        by_station.push_back(station_derivatives(stages, in, j));
    }

    // Stage 2: ∂P/∂inputs of every point, directly and through the stations.
    std::vector<std::vector<Eigen::MatrixXd>> by_point(angles, std::vector<Eigen::MatrixXd>(reflectors));
    for (std::size_t i = 0; i < angles; ++i) {
        const Eigen::Matrix3d rotation = nominal_rotation(measurement_, i);
        for (std::size_t m = 0; m < reflectors; ++m) {
            const PointPosition& point = stages.points[i][m];
            if (!point.determined) {
                continue;
            }
            const Eigen::Vector3d ideal = rotation * in.fixture.row(static_cast<Eigen::Index>(m)).transpose();
            Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(point.gain.cols(), columns);
            for (std::size_t row = 0; row < point.observations.size(); ++row) {
                const std::size_t k = point.observations[row];
                const std::size_t j = distances_[k].station;
                const StationStage& station = stages.stations[j];
                const Eigen::Index path = distances_[k].path;
                const Eigen::Vector3d difference = point.position +
                                                   in.expansion * in.temperature[static_cast<Eigen::Index>(j)] * ideal -
                                                   station.unknowns.head<3>();
                const double distance = difference.norm();
                const Eigen::Vector3d direction = scale_of(stages, in, j) / distance * difference;
                // l + l0 = s |P − q|: what moves the station or lengthens its dead path changes the predicted length,
                // and with it the point.
                Eigen::RowVectorXd line =
                    direction.transpose() * by_station[j].topRows<3>() + by_station[j].row(3 + path);
                if (scale_is_free()) {
                    line -= distance * by_station[j].bottomRows<1>();
                }
                line[static_cast<Eigen::Index>(k)] += 1.0;
                subtract_direct(in, k, direction, distance, false, line);
                rows.row(static_cast<Eigen::Index>(row)) = line;
            }
            by_point[i][m].noalias() = point.gain * rows;
        }
    }

    // Set-up and six errors: linear in the positions (second-order effects of the set-up itself are left out).
    const std::vector<PointPosition>& home = stages.points[measurement_.home];
    const auto across = across_axis(measurement_.axis);
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(4, columns);
    for (std::size_t i = 0; i < angles; ++i) {
        const Eigen::Matrix3d rotation = nominal_rotation(measurement_, i);
        for (std::size_t m = 0; m < reflectors; ++m) {
            if (i == measurement_.home || !home[m].determined || !stages.points[i][m].determined) {
                continue;
            }
            const Eigen::Matrix<double, 3, 4> rows = set_up_rows(rotation * home[m].position, rotation, across);
            normal += rows.transpose() * rows;
            // Ideal positions are those of home, turned: an error at home is in every angle.
            right += rows.transpose() * (by_point[i][m] - rotation * by_point[measurement_.home][m]);
        }
    }
    const Eigen::MatrixXd by_set_up = normal.ldlt().solve(right);

    const RigidMotion table_from_fixture = rigid_motion(stages.set_up);
    Eigen::MatrixXd by_error = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(angles), columns);
    for (std::size_t i = 0; i < angles; ++i) {
        if (i == measurement_.home) {
            continue;
        }
        const Eigen::Matrix3d rotation = nominal_rotation(measurement_, i);
        Eigen::Matrix<double, 6, 6> pose_normal = Eigen::Matrix<double, 6, 6>::Zero();
        Eigen::MatrixXd pose_right = Eigen::MatrixXd::Zero(6, columns);
        for (std::size_t m = 0; m < reflectors; ++m) {
            if (!home[m].determined || !stages.points[i][m].determined) {
                continue;
            }
            const Eigen::Vector3d expected = rotation * (table_from_fixture * home[m].position);
            const Eigen::Matrix<double, 3, 6> rows = point_displacement(expected);
            pose_normal += rows.transpose() * rows;
            // Errors of home and of the set-up go into every angle with a correlation that the residuals of a stage
            // cannot show.
            const Eigen::MatrixXd change = table_from_fixture.rotation * by_point[i][m] -
                                           rotation * (table_from_fixture.rotation * by_point[measurement_.home][m]) -
                                           set_up_rows(expected, rotation, across) * by_set_up;
            pose_right += rows.transpose() * change;
        }
        by_error.middleRows<6>(6 * static_cast<Eigen::Index>(i)) = pose_normal.ldlt().solve(pose_right);
    }
    Eigen::MatrixXd result(by_error.rows() + 4, columns);
    result.topRows(by_error.rows()) = stages.datum.carried(by_error);
    result.bottomRows<4>() = by_set_up + stages.datum.set_up_map * by_error;
    return result;
}

Eigen::MatrixXd SequentialModel::with_table(const Eigen::MatrixXd& derivatives) const {
    const auto visits = static_cast<Eigen::Index>(visit_pose_.size());
    const Eigen::Index first = derivatives.cols();
    const auto order = repeatability_order(measurement_.axis);
    const Eigen::Index resolutions = has_resolution() ? std::ssize(distances_) : 0;
    Eigen::MatrixXd result(derivatives.rows(), first + 6 * visits + resolutions);
    result.leftCols(first) = derivatives;
    result.rightCols(resolutions) = derivatives.leftCols(resolutions);
    Eigen::Index row = 0;
    for (Eigen::Index v = 0; v < visits; ++v) {
        const Eigen::MatrixXd& pose = visit_pose_[static_cast<std::size_t>(v)];
        const Eigen::MatrixXd by_pose = -derivatives.middleCols(row, pose.rows()) * pose;
        for (int c = 0; c < 6; ++c) {
            const Eigen::Index at = c < 3    ? first + 3 * v + c
                                    : c == 3 ? first + 3 * visits + v
                                             : first + 4 * visits + 2 * v + c - 4;
            result.col(at) = by_pose.col(order[static_cast<std::size_t>(c)]);
        }
        row += pose.rows();
    }
    return result;
}

Eigen::MatrixXd SequentialModel::propagated(const Eigen::MatrixXd& derivatives) const {
    // By groups with their full covariances: the correlations between the stages are what the paper leaves out (ADR
    // 0010).
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(derivatives.rows(), derivatives.rows());
    Eigen::Index first = 0;
    for (const gum::InputGroup& group : inputs_) {
        const auto part = derivatives.middleCols(first, group.size());
        if (group.is_diagonal()) {
            covariance += part * group.covariance.col(0).asDiagonal() * part.transpose();
        } else {
            covariance += part * group.covariance * part.transpose();
        }
        first += group.size();
    }
    return covariance;
}

std::vector<ExternalReliability> SequentialModel::external_reliability(
    const Eigen::MatrixXd& derivatives, const std::vector<DistanceReliability>& rows) const {
    std::vector<ExternalReliability> worst(static_cast<std::size_t>(derivatives.rows()));
    for (std::size_t k = 0; k < distances_.size(); ++k) {
        const double bias = rows[distances_[k].length].minimal_detectable_bias;
        for (std::size_t q = 0; q < worst.size(); ++q) {
            const double influence = derivatives(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(k)) * bias;
            if (std::abs(influence) > std::abs(worst[q].influence)) {
                worst[q] = {q, distances_[k].length, influence};
            }
        }
    }
    std::erase_if(worst, [](const ExternalReliability& row) { return row.influence == 0.0; });
    return worst;
}

}  // namespace

RotaryTableSolution evaluate_sequentially(const RotaryTableMeasurement& measurement, const EvaluationOptions& options,
                                          const Progress& progress) {
    // Of the joint adjustment come components, outliers and reliability; positions and error motions are replaced
    // below.
    RotaryTableMeasurement of_all_angles = measurement;  // its stages know one reversal only
    of_all_angles.reversal = ReversalModel::constant;
    RotaryTableSolution solution = evaluate_jointly(of_all_angles, options, progress);
    if (progress) {
        progress("sequential method");
    }
    const auto joint = std::static_pointer_cast<const RotaryTableModel>(solution.model);
    const auto model = std::make_shared<SequentialModel>(measurement, *joint);
    const Eigen::VectorXd x = gum::input_estimates(*model);
    const Inputs in = model->unpack(x);
    const Stages stages = model->solve(in);

    solution.datum = stages.datum;
    solution.quantities = model->quantities();
    solution.values = model->reported(stages);
    const Eigen::MatrixXd derivatives = model->reported_derivatives(stages, in);
    solution.covariance = AnglewiseCovariance(model->propagated(model->with_table(derivatives)));
    solution.external_reliability = model->external_reliability(derivatives, solution.reliability);
    // The largest of the stages: they have no system of equations in common.
    solution.condition_number = 0.0;
    const RigidMotion table_from_fixture = rigid_motion(stages.set_up);
    for (std::size_t j = 0; j < stages.stations.size(); ++j) {
        const StationStage& station = stages.stations[j];
        const Eigen::MatrixXd covariance =
            model->propagated(model->with_table(model->station_derivatives(stages, in, j)));
        StationEstimate& estimate = solution.stations[j];
        // Found in the frame of the fixture at home, stated in that of the datum.
        estimate.position = stages.datum.world * (table_from_fixture * station.unknowns.head<3>());
        const Eigen::Matrix3d turned = stages.datum.world.rotation * table_from_fixture.rotation;
        estimate.covariance = turned * covariance.topLeftCorner<3, 3>() * turned.transpose();
        estimate.u = estimate.covariance.diagonal().cwiseSqrt();
        const bool free = measurement.length_uncertainty.scale_model == ScaleModel::free;
        estimate.scale_deviation = free ? station.unknowns.tail<1>()[0] : in.scale[static_cast<Eigen::Index>(j)];
        estimate.u_scale = free ? std::sqrt(covariance.diagonal().tail<1>()[0])
                           : measurement.length_uncertainty.scale_model == ScaleModel::prior
                               ? measurement.length_uncertainty.u_scale
                               : 0.0;
        for (std::size_t d = 0; d < station.dead_paths.size(); ++d) {
            const auto path = static_cast<Eigen::Index>(station.dead_paths[d]);
            const auto at = static_cast<Eigen::Index>(3 + d);
            solution.dead_paths[path] = station.unknowns[at];
            solution.u_dead_paths[path] = std::sqrt(covariance(at, at));
        }
        solution.condition_number = std::max(solution.condition_number, station.condition_number);
    }
    solution.fixture = measurement.fixture;
    const double fixture_factor = solution.stochastic.fixture_factor;
    for (Eigen::Index m = 0; m < measurement.fixture.rows(); ++m) {
        for (int c = 0; c < 3; ++c) {
            solution.u_fixture(m, c) = std::sqrt(fixture_factor * measurement.fixture_covariance(3 * m + c, 3 * m + c));
        }
        solution.fixture_position_covariance[static_cast<std::size_t>(m)] =
            fixture_factor * measurement.fixture_covariance.block<3, 3>(3 * m, 3 * m);
        solution.fixture_at_home.row(m) =
            (stages.datum.world * (table_from_fixture * measurement.fixture.row(m).transpose())).transpose();
    }

    // Misfit of the sequential solution to the same distances with the same weights.
    StartValues found;
    for (const StationEstimate& station : solution.stations) {
        found.stations.push_back(stages.datum.world.inverse() * station.position);
    }
    found.dead_paths = solution.dead_paths;
    JointAdjustment misfit(measurement, joint->solved().active(), table_from_fixture, found, solution.stochastic);
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        misfit.set_pose(i, stages.errors.col(static_cast<Eigen::Index>(i)));
    }
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        Eigen::VectorXd block = misfit.adjustment().parameters(misfit.station_block(j));
        block[3] = solution.stations[j].scale_deviation;
        misfit.adjustment().set_parameters(misfit.station_block(j), block);
    }
    misfit.set_weights(solution.stochastic);
    const NormalEquations normal = misfit.adjustment().linearise();
    // Chi-square, its degrees of freedom and the variance factor stay those of the joint adjustment: these are no residuals
    // of a least-squares adjustment, and no chi-square distribution is theirs (ADR 0010).
    double squares = 0.0;
    for (std::size_t v = 0; v < misfit.visits().size(); ++v) {
        squares += normal.groups()[v].residual.squaredNorm();
    }
    solution.model = model;
    solution.notes.push_back(
        {"GC-SEQUENTIAL-0002", "sequential method",
         "chi-square, variance components, outlying distances and reliability are those of the "
         "joint adjustment of the same distances; the weighted squares of the sequential solution are " +
             text::significant(squares, 4),
         "the stages have no least-squares residuals of their own: their weighted squares have no "
         "chi-square distribution and test nothing",
         "use \"method\": \"joint\" for a certificate: its uncertainties are smaller", gum::Severity::note});
    return solution;
}

}  // namespace gumcert::engine
