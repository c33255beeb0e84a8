// Second opinion on the joint adjustment: a network of free points from the same distances, then the poses as rigid
// motions of these points by generalised least squares with their full covariance. The two routes share the
// observations and linear algebra, not the model: no error motions, no set-up and no elimination here.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/distance_network.h"
#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/start/start_values.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::Vector6;

constexpr Eigen::Index k_reflectors = 6;
constexpr Eigen::Index k_route_angles = 12;

/// One axis, 6 stations, 6 reflectors, 12 angles; no table repeatability, scale fixed, no temperature; coordinates of
/// each reflector correlated by the CMM.
Campaign campaign_of(RotaryAxis axis, std::uint64_t seed) {
    CampaignPlan plan;
    plan.axis = axis;
    plan.angles_deg = synthetic::full_turn(static_cast<int>(k_route_angles));
    plan.seed = seed;
    Campaign campaign = simulate(plan);
    for (Eigen::Index m = 0; m < k_reflectors; ++m) {
        auto block = campaign.measurement.fixture_covariance.block<3, 3>(3 * m, 3 * m);
        const Eigen::Vector3d u = block.diagonal().cwiseSqrt();
        block(0, 1) = block(1, 0) = 0.4 * u[0] * u[1];
        block(1, 2) = block(2, 1) = -0.3 * u[1] * u[2];
    }
    return campaign;
}

/// Poses at all angles but home, then the points at home, 6·11 + 3·6, with their covariance.
struct RigidSolution {
    Eigen::VectorXd parameters;
    Eigen::MatrixXd covariance;
};

/// E(θ) R(θ) p with a rotation by Eigen, parameters (x, y, z, a, b, c) of E.
Eigen::Vector3d carried(const Vector6& pose, const Eigen::Matrix3d& turn, const Eigen::Vector3d& point) {
    return synthetic::moved(pose, turn * point);
}

/// Points at all angles (rows angle by angle, 3·6 each) as rigid motions of those at home.
RigidSolution rigid_motions_of(const Eigen::VectorXd& points, const Eigen::MatrixXd& covariance,
                               const std::vector<Eigen::Matrix3d>& turns) {
    const Eigen::Index poses = 6 * (k_route_angles - 1);
    const Eigen::Index size = poses + 3 * k_reflectors;
    // Metres: a unit of a micrometre keeps the factor of the covariance well scaled.
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance * 1e12);
    EXPECT_EQ(factor.info(), Eigen::Success);
    RigidSolution solution;
    solution.parameters = Eigen::VectorXd::Zero(size);
    solution.parameters.tail(3 * k_reflectors) = points.head(3 * k_reflectors);
    const auto predicted = [&](const Eigen::VectorXd& x) {
        Eigen::VectorXd result(points.size());
        for (Eigen::Index i = 0; i < k_route_angles; ++i) {
            const Vector6 pose = i == 0 ? Vector6(Vector6::Zero()) : Vector6(x.segment<6>(6 * (i - 1)));
            for (Eigen::Index m = 0; m < k_reflectors; ++m) {
                result.segment<3>(3 * (k_reflectors * i + m)) =
                    carried(pose, turns[static_cast<std::size_t>(i)], x.segment<3>(poses + 3 * m));
            }
        }
        return result;
    };
    for (int iteration = 0; iteration < 8; ++iteration) {
        Eigen::MatrixXd design(points.size(), size);
        for (Eigen::Index c = 0; c < size; ++c) {
            const double step = 1e-4;  // the motions are trigonometric: the central difference is good to 1e-9
            Eigen::VectorXd up = solution.parameters;
            Eigen::VectorXd down = solution.parameters;
            up[c] += step;
            down[c] -= step;
            design.col(c) = (predicted(up) - predicted(down)) / (2.0 * step);
        }
        const Eigen::MatrixXd whitened = factor.matrixL().solve(design * 1e6);
        const Eigen::VectorXd residual = factor.matrixL().solve((points - predicted(solution.parameters)) * 1e6);
        const Eigen::LDLT<Eigen::MatrixXd> normal(whitened.transpose() * whitened);
        solution.parameters += normal.solve(whitened.transpose() * residual);
        solution.covariance = normal.solve(Eigen::MatrixXd::Identity(size, size));
    }
    return solution;
}

class PointNetworkRoute : public testing::TestWithParam<std::tuple<RotaryAxis, std::uint64_t>> {};

TEST_P(PointNetworkRoute, GivesThePosesAndCovariancesOfTheJointAdjustment) {
    const Campaign campaign = campaign_of(std::get<0>(GetParam()), std::get<1>(GetParam()));
    const RotaryTableMeasurement& measurement = campaign.measurement;

    // (a) The joint adjustment in its own datum: home pose zero, T_s = 1.
    SolverOptions options;
    options.step_tolerance = 1e-7;
    JointAdjustment joint(measurement, std::vector<bool>(measurement.lengths.size(), true), RigidMotion{},
                          find_start_values(measurement), StochasticModel{});
    SolveSummary summary = joint.adjustment().solve(options);
    ASSERT_TRUE(summary.converged) << summary.message;
    joint.set_weights(StochasticModel{});
    summary = joint.adjustment().refine(options);
    ASSERT_TRUE(summary.converged) << summary.message;
    const NormalEquations normal = joint.adjustment().linearise();
    const Eigen::MatrixXd joint_covariance = normal.covariance();

    // (b) Free points: one a reflector and angle; those at home observed by the CMM. Stations and constants free.
    std::vector<NetworkPoint> points;
    std::vector<Eigen::Matrix3d> turns;
    for (Eigen::Index i = 0; i < k_route_angles; ++i) {
        turns.push_back(synthetic::turn(axial_coordinate(measurement.axis),
                                        measurement.angles[static_cast<std::size_t>(i)] - measurement.angles[0]));
        for (Eigen::Index m = 0; m < k_reflectors; ++m) {
            NetworkPoint point;
            point.name = measurement.reflectors[static_cast<std::size_t>(m)] + " at " + std::to_string(i + 1);
            point.position = turns.back() * measurement.fixture.row(m).transpose();
            if (i == 0) {
                point.covariance = measurement.fixture_covariance.block<3, 3>(3 * m, 3 * m);
            }
            point.eliminated = true;
            points.push_back(point);
        }
    }
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        NetworkPoint station;
        station.name = measurement.stations[j];
        station.position = campaign.truth.stations[j] + Eigen::Vector3d(2e-3, -1e-3, 1.5e-3);
        points.push_back(station);
    }
    constexpr double k_nominal_dead_path = 0.22;
    std::vector<NetworkDistance> distances;
    for (std::size_t v = 0; v < joint.visits().size(); ++v) {
        const Visit& visit = joint.visits()[v];
        const Eigen::VectorXd variance = joint.stated_variance(v);
        for (std::size_t k = 0; k < visit.observations.size(); ++k) {
            const LengthObservation& length = measurement.lengths[visit.observations[k]];
            distances.push_back({static_cast<std::size_t>(k_reflectors * k_route_angles) + length.station,
                                 static_cast<std::size_t>(k_reflectors) * length.angle + length.reflector,
                                 length.dead_path, length.length + k_nominal_dead_path,
                                 std::sqrt(variance[static_cast<Eigen::Index>(k)])});
        }
    }
    const NetworkSolution network = adjust_distance_network(points, measurement.dead_paths.size(), distances, options,
                                                            4.13, PointCovariance::joint);
    const Eigen::Index coordinates = 3 * k_reflectors * k_route_angles;
    ASSERT_EQ(network.joint_covariance.rows(), coordinates + 18);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(3 * i);
        EXPECT_EQ((network.joint_covariance.block<3, 3>(at, at)), network.covariances[i]) << points[i].name;
    }
    EXPECT_LT((network.joint_covariance - network.joint_covariance.transpose()).cwiseAbs().maxCoeff(), 1e-24);
    Eigen::VectorXd found(coordinates);
    for (Eigen::Index i = 0; i < coordinates / 3; ++i) {
        found.segment<3>(3 * i) = network.positions[static_cast<std::size_t>(i)];
    }
    const RigidSolution rigid =
        rigid_motions_of(found, network.joint_covariance.topLeftCorner(coordinates, coordinates), turns);

    // Comparison in units of the standard deviations: poses and points at home, with their full covariance.
    std::vector<Eigen::Index> columns;
    Eigen::VectorXd expected(rigid.parameters.size());
    for (Eigen::Index i = 1; i < k_route_angles; ++i) {
        for (int c = 0; c < 6; ++c) {
            const auto block = joint.pose_block(static_cast<std::size_t>(i));
            expected[static_cast<Eigen::Index>(columns.size())] = joint.adjustment().parameters(block)[c];
            columns.push_back(normal.column(block, c));
        }
    }
    for (int c = 0; c < 3 * k_reflectors; ++c) {
        expected[static_cast<Eigen::Index>(columns.size())] = joint.adjustment().parameters(joint.fixture_block())[c];
        columns.push_back(normal.column(joint.fixture_block(), c));
    }
    double worst_value = 0.0;
    double worst_covariance = 0.0;
    for (std::size_t a = 0; a < columns.size(); ++a) {
        const auto row = static_cast<Eigen::Index>(a);
        const double sd = std::sqrt(joint_covariance(columns[a], columns[a]));
        worst_value = std::max(worst_value, std::abs(rigid.parameters[row] - expected[row]) / sd);
        for (std::size_t b = 0; b <= a; ++b) {
            const double other = std::sqrt(joint_covariance(columns[b], columns[b]));
            const double difference =
                rigid.covariance(row, static_cast<Eigen::Index>(b)) - joint_covariance(columns[a], columns[b]);
            worst_covariance = std::max(worst_covariance, std::abs(difference) / (sd * other));
        }
    }
    EXPECT_LT(worst_value, 1e-4);
    EXPECT_LT(worst_covariance, 1e-4);

    // And through the whole evaluation: the same poses carried to the datum of the result.
    RotaryTableMeasurement home = measurement;
    home.datum = Datum::home;
    const RotaryTableSolution evaluated = evaluate_jointly(home, EvaluationOptions{});
    Eigen::MatrixXd poses = Eigen::MatrixXd::Zero(6, k_route_angles);
    poses.rightCols(k_route_angles - 1) =
        rigid.parameters.head(6 * (k_route_angles - 1)).reshaped(6, k_route_angles - 1);
    const DatumSolution datum = transform_to_datum(home, poses, RigidMotion{}, Datum::home);
    Eigen::MatrixXd pose_covariance = Eigen::MatrixXd::Zero(6 * k_route_angles, 6 * k_route_angles);
    pose_covariance.bottomRightCorner(6 * (k_route_angles - 1), 6 * (k_route_angles - 1)) =
        rigid.covariance.topLeftCorner(6 * (k_route_angles - 1), 6 * (k_route_angles - 1));
    const Eigen::MatrixXd by_network = datum.carried(datum.carried(pose_covariance).transpose());
    for (Eigen::Index c = 6; c < 6 * k_route_angles; ++c) {
        const double sd = std::sqrt(evaluated.covariance(c, c));
        EXPECT_NEAR(datum.errors.reshaped()[c], evaluated.values[c], 1e-4 * sd) << c;
        EXPECT_NEAR(std::sqrt(by_network(c, c)) / sd, 1.0, 1e-3) << c;  // linear map at another T_s: 200 µrad
    }
}

INSTANTIATE_TEST_SUITE_P(AxesAndSeeds, PointNetworkRoute,
                         testing::Combine(testing::Values(RotaryAxis::a, RotaryAxis::b, RotaryAxis::c),
                                          testing::Values(1U, 7U)),
                         [](const auto& tested) {
                             return std::string(1, "ABC"[axial_coordinate(std::get<0>(tested.param))]) + "Seed" +
                                    std::to_string(std::get<1>(tested.param));
                         });

}  // namespace
}  // namespace gumcert::engine
