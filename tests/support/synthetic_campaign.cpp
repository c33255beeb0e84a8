#include "tests/support/synthetic_campaign.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::engine::synthetic {

Eigen::VectorXd Campaign::true_values(bool has_reversal) const {
    const int a = axial_coordinate(measurement.axis);
    const Eigen::Index errors = truth.errors.size();
    Eigen::VectorXd values(errors + 4 + (has_reversal ? 6 : 0));
    values.head(errors) = truth.errors.reshaped();
    for (int c = 0; c < 2; ++c) {
        values[errors + c] = truth.set_up[(a + 1 + c) % 3];
        values[errors + 2 + c] = truth.set_up[3 + (a + 1 + c) % 3];
    }
    if (has_reversal) {
        values.tail<6>() = truth.reversal;
    }
    return values;
}

std::vector<double> full_turn(int count) {
    std::vector<double> angles;
    for (int i = 0; i < count; ++i) {
        angles.push_back(360.0 * i / count);
    }
    return angles;
}

std::vector<double> partial_turn(double last_deg, int count) {
    std::vector<double> angles;
    for (int i = 0; i < count; ++i) {
        angles.push_back(last_deg * i / (count - 1));
    }
    return angles;
}

double rms_length_noise(const CampaignPlan& plan, const Campaign& campaign) {
    double squares = 0.0;
    for (const LengthObservation& length : campaign.measurement.lengths) {
        const double distance = length.length + campaign.truth.dead_paths[static_cast<Eigen::Index>(length.dead_path)];
        squares += plan.u_constant * plan.u_constant + std::pow(plan.u_proportional * distance, 2);
    }
    return std::sqrt(squares / static_cast<double>(campaign.measurement.lengths.size()));
}

Eigen::Matrix3d turn(int axis, double angle) {
    return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

Eigen::Vector3d moved(const Vector6& motion, const Eigen::Vector3d& point) {
    return turn(2, motion[5]) * (turn(1, motion[4]) * (turn(0, motion[3]) * point)) + motion.head<3>();
}

Eigen::Vector3d point_in_table(RotaryAxis axis, double angle_from_home, const Vector6& error, const Vector6& set_up,
                               const Eigen::Vector3d& point) {
    return moved(error, turn(axial_coordinate(axis), angle_from_home) * moved(set_up, point));
}

void obey_datum(Eigen::MatrixXd& errors, RotaryAxis axis, const std::vector<double>& angle_from_home, std::size_t home,
                Datum datum, const Eigen::MatrixX3d& fixture) {
    const Eigen::Index n = errors.cols();
    const int a = axial_coordinate(axis);
    Eigen::MatrixXd turning = Eigen::MatrixXd::Zero(6 * n, 4);
    Eigen::MatrixXd constant(6 * n, 6);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Matrix3d rotation = turn(a, angle_from_home[static_cast<std::size_t>(i)]);
        for (int c = 0; c < 2; ++c) {
            turning.block<3, 1>(6 * i, c) = rotation.col((a + 1 + c) % 3);
            turning.block<3, 1>(6 * i + 3, 2 + c) = rotation.col((a + 1 + c) % 3);
        }
        constant.block<6, 6>(6 * i, 0).setIdentity();
    }
    if (datum == Datum::axis_average_line) {
        Eigen::MatrixXd removed(6 * n, 10);
        removed << constant, turning;
        const Eigen::VectorXd part =
            (removed.transpose() * removed).fullPivLu().solve(removed.transpose() * errors.reshaped());
        errors.reshaped() -= removed * part;
        return;
    }
    const Vector6 at_home = errors.col(static_cast<Eigen::Index>(home));
    errors.colwise() -= at_home;
    Eigen::MatrixXd effect = turning;
    for (Eigen::Index i = 0; i < n; ++i) {
        effect.middleRows<6>(6 * i) -= turning.middleRows<6>(6 * static_cast<Eigen::Index>(home));
    }
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index m = 0; m < fixture.rows(); ++m) {
            const Eigen::Vector3d p =
                turn(a, angle_from_home[static_cast<std::size_t>(i)]) * fixture.row(m).transpose();
            Eigen::Matrix<double, 3, 6> displacement;
            displacement << 1, 0, 0, 0, p[2], -p[1], 0, 1, 0, -p[2], 0, p[0], 0, 0, 1, p[1], -p[0], 0;
            const Eigen::Matrix<double, 3, 4> rows = displacement * effect.middleRows<6>(6 * i);
            normal += rows.transpose() * rows;
            right += rows.transpose() * (displacement * errors.col(i));
        }
    }
    errors.reshaped() -= effect * normal.fullPivLu().solve(right);
}

Campaign simulate(const CampaignPlan& plan) {
    Campaign campaign;
    RotaryTableMeasurement& measurement = campaign.measurement;
    CampaignTruth& truth = campaign.truth;
    Noise noise(plan.seed);
    const int a = axial_coordinate(plan.axis);
    const auto cyclic = [a](const Eigen::Vector3d& v) {
        Eigen::Vector3d result;
        for (int c = 0; c < 3; ++c) {
            result[(c + a) % 3] = v[c];
        }
        return result;
    };

    measurement.axis = plan.axis;
    measurement.datum = plan.datum;
    measurement.home = plan.home;
    measurement.angles_deg = plan.angles_deg;
    std::vector<double> from_home;
    for (const double angle : plan.angles_deg) {
        measurement.angles.push_back(angle * std::numbers::pi / 180.0);
        from_home.push_back((angle - plan.angles_deg[plan.home]) * std::numbers::pi / 180.0);
    }
    const auto stations = static_cast<Eigen::Index>(plan.stations.size());
    const auto reflectors = static_cast<Eigen::Index>(plan.reflectors.size());
    const auto angles = static_cast<Eigen::Index>(plan.angles_deg.size());
    truth.scale_deviation.resize(stations);
    measurement.temperature_difference.resize(stations);
    measurement.u_temperature = Eigen::VectorXd::Constant(stations, plan.u_temperature);
    Eigen::VectorXd temperature(stations);
    for (Eigen::Index j = 0; j < stations; ++j) {
        measurement.stations.push_back("P" + std::to_string(j + 1));
        truth.stations.push_back(cyclic(plan.stations[static_cast<std::size_t>(j)]));
        measurement.station_start.emplace_back();
        if (plan.start_values) {
            measurement.station_start.back() = truth.stations.back() + Eigen::Vector3d(0.01, -0.005, 0.008);
        }
        truth.scale_deviation[j] = plan.noise * plan.u_scale * noise.normal();
        measurement.temperature_difference[j] = plan.temperature_difference + 0.1 * static_cast<double>(j);
        temperature[j] = measurement.temperature_difference[j] + plan.noise * plan.u_temperature * noise.normal();
    }
    measurement.expansion = plan.expansion;
    measurement.u_expansion = plan.u_expansion;
    const double expansion = plan.expansion + plan.noise * plan.u_expansion * noise.normal();

    truth.fixture.resize(reflectors, 3);
    measurement.fixture.resize(reflectors, 3);
    measurement.fixture_covariance = Eigen::MatrixXd::Zero(3 * reflectors, 3 * reflectors);
    for (Eigen::Index m = 0; m < reflectors; ++m) {
        measurement.reflectors.push_back("R" + std::to_string(m + 1));
        const Eigen::Vector3d p = cyclic(plan.reflectors[static_cast<std::size_t>(m)]);
        truth.fixture.row(m) = p.transpose();
        const double u = plan.cmm_factor * k_um * std::hypot(0.401, 0.332 * p.norm());
        for (int c = 0; c < 3; ++c) {
            measurement.fixture(m, c) = p[c] + plan.noise * u * noise.normal();
            measurement.fixture_covariance(3 * m + c, 3 * m + c) = u * u;
        }
    }

    const Eigen::Vector3d offset = cyclic({0.0, plan.offset[0], plan.offset[1]});
    const Eigen::Vector3d tilt = cyclic({0.0, plan.tilt[0], plan.tilt[1]});
    truth.set_up << offset, tilt;
    truth.reversals = Eigen::MatrixXd::Zero(6, angles);
    for (Eigen::Index i = 0; i < angles && plan.both_senses; ++i) {
        truth.reversals.col(i) =
            plan.reversal + std::sin(2.0 * from_home[static_cast<std::size_t>(i)]) * plan.reversal_second;
    }
    truth.reversal = truth.reversals.rowwise().mean();
    measurement.reversal = plan.reversal_model;
    truth.errors.resize(6, angles);
    for (Eigen::Index i = 0; i < angles; ++i) {
        const double t = from_home[static_cast<std::size_t>(i)];
        const Eigen::Vector3d linear(1.5 * std::sin(t + 0.3) + 0.5 * std::cos(3.0 * t),
                                     2.0 * std::cos(2.0 * t + 1.0) + 0.8 * std::sin(5.0 * t),
                                     1.8 * std::sin(2.0 * t) + 0.6 * std::cos(4.0 * t + 0.5));
        const Eigen::Vector3d angular(12.0 * std::sin(t) + 4.0 * std::sin(2.0 * t + 0.7),
                                      5.0 * std::cos(2.0 * t) + 2.0 * std::sin(3.0 * t),
                                      6.0 * std::sin(2.0 * t + 0.4) + 1.5 * std::cos(3.0 * t));
        truth.errors.col(i) << plan.error_factor * 1e-6 * cyclic(linear), plan.error_factor * 1e-6 * cyclic(angular);
    }
    obey_datum(truth.errors, plan.axis, from_home, plan.home, plan.datum, truth.fixture);

    const bool per_pair = plan.dead_paths == DeadPaths::per_station_and_reflector;
    truth.dead_paths.resize(per_pair ? stations * reflectors : stations);
    for (Eigen::Index j = 0; j < stations; ++j) {
        for (Eigen::Index m = 0; m < (per_pair ? reflectors : 1); ++m) {
            const auto d = static_cast<Eigen::Index>(measurement.dead_paths.size());
            std::string name = measurement.stations[static_cast<std::size_t>(j)];
            if (per_pair) {
                name += "-" + measurement.reflectors[static_cast<std::size_t>(m)];
            }
            measurement.dead_paths.push_back(std::move(name));
            truth.dead_paths[d] = 0.19 + 0.06 * noise.uniform();
        }
    }

    measurement.length_uncertainty = {plan.u_constant, plan.u_proportional, plan.scale_model, plan.u_scale};
    measurement.table_repeatability = {RepeatabilityMode::given, plan.table_linear, plan.table_axial, plan.table_tilt};
    measurement.estimate_length_noise = false;
    measurement.outliers.test = OutlierTest::none;
    // The table deviates about the foot of the centroid of the reflectors on the axis.
    Eigen::Vector3d foot = Eigen::Vector3d::Zero();
    foot[a] = truth.fixture.col(a).mean() + plan.repeatability_off;
    measurement.table_repeatability.axial_position = foot[a];
    Vector6 spread;
    spread << Eigen::Vector3d::Constant(plan.table_linear), Eigen::Vector3d::Constant(plan.table_tilt);
    spread[3 + a] = plan.table_axial;

    for (Eigen::Index j = 0; j < stations; ++j) {
        const auto station = static_cast<std::size_t>(j);
        const std::size_t groups = plan.one_reflector_a_pass ? plan.reflectors.size() : 1;
        for (std::size_t run = 0; run < plan.runs * groups * (plan.both_senses ? 2 : 1); ++run) {
            const bool down = plan.both_senses && run % 2 == 1;
            const std::size_t group = (plan.both_senses ? run / 2 : run) % groups;
            std::size_t pass = measurement.passes.size();
            measurement.passes.push_back(measurement.stations[station] + "/" + std::to_string(run + 1));
            for (Eigen::Index step = 0; step < angles + (plan.closed_runs ? 1 : 0); ++step) {
                if (step == angles) {
                    pass = measurement.passes.size();
                    measurement.passes.push_back(measurement.passes.back() + " closed");
                }
                const Eigen::Index i = down ? angles - 1 - step % angles : step % angles;
                Vector6 pose = truth.errors.col(i) + (down ? -0.5 : 0.5) * truth.reversals.col(i);
                Vector6 deviation;
                for (int c = 0; c < 6; ++c) {
                    deviation[c] = plan.noise * spread[c] * noise.normal();
                }
                pose += deviation;
                pose.head<3>() -= deviation.tail<3>().cross(foot);
                for (Eigen::Index m = 0; m < reflectors; ++m) {
                    if (plan.one_reflector_a_pass && static_cast<std::size_t>(m) != group) {
                        continue;
                    }
                    const Eigen::Vector3d stretched =
                        (1.0 + expansion * temperature[j]) * truth.fixture.row(m).transpose();
                    const double distance = (1.0 + truth.scale_deviation[j]) *
                                            (point_in_table(plan.axis, from_home[static_cast<std::size_t>(i)], pose,
                                                            truth.set_up, stretched) -
                                             truth.stations[station])
                                                .norm();
                    LengthObservation length;
                    length.station = station;
                    length.reflector = static_cast<std::size_t>(m);
                    length.pass = pass;
                    length.angle = static_cast<std::size_t>(i);
                    length.dead_path = per_pair ? station * plan.reflectors.size() + length.reflector : station;
                    length.approach = down ? Approach::negative : Approach::positive;
                    length.length =
                        distance - truth.dead_paths[static_cast<Eigen::Index>(length.dead_path)] +
                        plan.noise * std::hypot(plan.u_constant, plan.u_proportional * distance) * noise.normal();
                    length.line = measurement.lengths.size() + 2;
                    if (!(noise.uniform() < plan.missing_share)) {
                        measurement.lengths.push_back(length);
                    }
                }
            }
        }
    }
    std::vector<bool> wrong(measurement.lengths.size(), false);
    for (std::size_t planted = 0; planted < plan.outliers;) {
        const auto i = static_cast<std::size_t>(noise.uniform() * static_cast<double>(wrong.size()));
        if (!wrong[i]) {
            wrong[i] = true;
            measurement.lengths[i].length += (noise.uniform() < 0.5 ? -1.0 : 1.0) * plan.outlier_size;
            ++planted;
        }
    }
    for (std::size_t i = 0; i < wrong.size(); ++i) {
        if (wrong[i]) {
            truth.outliers.push_back(i);
        }
    }
    return campaign;
}

Vector6 rms_over_angles(const Eigen::VectorXd& values, Eigen::Index angles) {
    const Eigen::MatrixXd curves = values.head(6 * angles).reshaped(6, angles);
    double count = 0.0;
    for (Eigen::Index i = 0; i < angles; ++i) {
        count += curves.col(i).cwiseAbs().maxCoeff() > 0.0 ? 1.0 : 0.0;
    }
    return (curves.array().square().rowwise().sum() / count).sqrt();
}

}  // namespace gumcert::engine::synthetic
