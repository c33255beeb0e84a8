// Analytic derivatives of the visit model against automatic differentiation and central differences; sign conventions.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/rotation.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::k_arcsec;
using synthetic::Noise;
using synthetic::Vector6;

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

template <typename T>
Vector3<T> turned(int axis, const T& angle, const Vector3<T>& point) {
    using std::cos;
    using std::sin;
    const int second = (axis + 1) % 3;
    const int third = (axis + 2) % 3;
    Vector3<T> result = point;
    result[second] = cos(angle) * point[second] - sin(angle) * point[third];
    result[third] = sin(angle) * point[second] + cos(angle) * point[third];
    return result;
}

/// Trans(x, y, z) Rz(c) Ry(b) Rx(a) applied to a point; the contract's order, written out once more.
template <typename T>
Vector3<T> moved(const T* motion, const Vector3<T>& point) {
    Vector3<T> result = turned(0, motion[3], point);
    result = turned(1, motion[4], result);
    result = turned(2, motion[5], result);
    return result + Eigen::Map<const Vector3<T>>(motion);
}

struct VisitFacts {
    int axis = 0;
    double angle = 0.0;
    Vector6 set_up = Vector6::Zero();
    double sense = 0.0;
};

/// l = s |P - q| - l0 with P = E(θ) R(θ) T_s p (1 + α ΔT).
template <typename T>
T length(const VisitFacts& facts, const T* station, const T* point, const T& expansion, const T* reversal,
         const T* pose, const T& dead_path) {
    using std::sqrt;
    T error[6];
    for (int c = 0; c < 6; ++c) {
        error[c] = pose[c] + 0.5 * facts.sense * reversal[c];
    }
    T set_up[6];
    for (int c = 0; c < 6; ++c) {
        set_up[c] = T(facts.set_up[c]);
    }
    const T stretch = 1.0 + expansion * station[4];
    const Vector3<T> in_fixture = Eigen::Map<const Vector3<T>>(point) * stretch;
    const Vector3<T> in_world = moved(error, turned(facts.axis, T(facts.angle), moved(set_up, in_fixture)));
    const Vector3<T> difference = in_world - Eigen::Map<const Vector3<T>>(station);
    return (1.0 + station[3]) * sqrt(difference.squaredNorm()) - dead_path;
}

// Local parameters of one distance: station 5, its reflector 3, expansion, reversal 6, pose 6, dead path.
constexpr int k_local = 22;
constexpr int k_point = 5;
constexpr int k_expansion = 8;
constexpr int k_reversal = 9;
constexpr int k_pose = 15;
constexpr int k_path = 21;
using Jet = ceres::Jet<double, k_local>;
using Local = Eigen::Matrix<double, k_local, 1>;

Eigen::RowVectorXd automatic_derivatives(const VisitFacts& facts, const Local& x) {
    Jet parameters[k_local];
    for (int i = 0; i < k_local; ++i) {
        parameters[i] = Jet(x[i], i);
    }
    return length<Jet>(facts, parameters, parameters + k_point, parameters[k_expansion], parameters + k_reversal,
                       parameters + k_pose, parameters[k_path])
        .v.transpose();
}

/// Largest derivative of every column, taken over the columns of its unit: one coordinate may be seen from the side.
Eigen::VectorXd scale_of_columns(const Eigen::MatrixXd& derivative) {
    Eigen::VectorXd scale = derivative.cwiseAbs().colwise().maxCoeff().transpose();
    const Eigen::Index same = derivative.cols() == 5 ? 3 : derivative.cols() == 6 ? 3 : derivative.cols();
    scale.head(same).setConstant(scale.head(same).maxCoeff());
    if (derivative.cols() == 6) {
        scale.tail<3>().setConstant(scale.tail<3>().maxCoeff());
    }
    return scale;
}

enum class Geometry { ordinary, all_zero, very_near_station, coarse_set_up };

class VisitJacobian : public testing::TestWithParam<std::tuple<RotaryAxis, Geometry>> {
protected:
    void SetUp() override {
        const auto [axis, geometry] = GetParam();
        CampaignPlan plan;
        plan.axis = axis;
        plan.angles_deg = synthetic::full_turn(7);
        plan.both_senses = true;
        plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
        plan.scale_model = ScaleModel::free;
        plan.reversal << 1e-6, -2e-6, 1.5e-6, 4e-6, -3e-6, 2e-6;
        plan.temperature_difference = 1.5;
        plan.u_temperature = 0.05;
        plan.expansion = 11.5e-6;
        plan.u_expansion = 1e-6;
        double size = 1.0;
        if (geometry == Geometry::all_zero) {
            size = 0.0;
            plan.offset.setZero();
            plan.tilt.setZero();
            plan.error_factor = 0.0;
            plan.reversal.setZero();
            plan.temperature_difference = 0.0;
        } else if (geometry == Geometry::coarse_set_up) {
            plan.offset = {1e-3, -1e-3};
            plan.tilt = {600.0 * k_arcsec, -600.0 * k_arcsec};
            plan.error_factor = 100.0;
        }
        campaign_ = simulate(plan);
        const RotaryTableMeasurement& measurement = campaign_.measurement;
        adjustment_.emplace(measurement, std::vector<bool>(measurement.lengths.size(), true),
                            rigid_motion(campaign_.truth.set_up),
                            StartValues{campaign_.truth.stations, campaign_.truth.dead_paths}, StochasticModel{});
        Adjustment& least_squares = adjustment_->adjustment();
        Noise noise(7);
        for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
            Eigen::VectorXd value = least_squares.parameters(adjustment_->station_block(j));
            value[3] = size * 1e-6 * noise.normal();
            least_squares.set_parameters(adjustment_->station_block(j), value);
        }
        for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
            least_squares.set_parameters(adjustment_->pose_block(i),
                                         campaign_.truth.errors.col(static_cast<Eigen::Index>(i)));
        }
        least_squares.set_parameters(adjustment_->reversal_block(), campaign_.truth.reversal);
        if (geometry == Geometry::very_near_station) {
            // Station P1 two millimetres from its first reflector at angle 3, seen obliquely.
            const Eigen::Vector3d near =
                synthetic::point_in_table(axis, measurement.angles[3], campaign_.truth.errors.col(3),
                                          campaign_.truth.set_up, campaign_.truth.fixture.row(0).transpose());
            Eigen::VectorXd value = least_squares.parameters(adjustment_->station_block(0));
            value.head<3>() = near + 2e-3 * Eigen::Vector3d(1.0, -2.0, 2.0) / 3.0;
            least_squares.set_parameters(adjustment_->station_block(0), value);
        }
    }

    [[nodiscard]] VisitFacts facts(const Visit& visit) const {
        return {axial_coordinate(campaign_.measurement.axis), campaign_.measurement.angles[visit.angle],
                campaign_.truth.set_up, visit.approach == Approach::positive ? 1.0 : -1.0};
    }

    [[nodiscard]] Local local(const Visit& visit, std::size_t observation) const {
        const Adjustment& least_squares = adjustment_->adjustment();
        const LengthObservation& length = campaign_.measurement.lengths[observation];
        Local x;
        x << least_squares.parameters(adjustment_->station_block(visit.station)),
            least_squares.parameters(adjustment_->fixture_block())
                .segment<3>(3 * static_cast<Eigen::Index>(length.reflector)),
            least_squares.parameters(adjustment_->expansion_block()),
            least_squares.parameters(adjustment_->reversal_block()),
            least_squares.parameters(adjustment_->pose_block(visit.angle)),
            least_squares.parameters(adjustment_->dead_path_block(length.dead_path));
        return x;
    }

    Campaign campaign_;
    std::optional<JointAdjustment> adjustment_;
};

TEST_P(VisitJacobian, PredictionIsTheModelOfTheContract) {
    for (std::size_t v = 0; v < adjustment_->visits().size(); ++v) {
        const Visit& visit = adjustment_->visits()[v];
        const Eigen::VectorXd residual = adjustment_->adjustment().residual(v);
        for (std::size_t k = 0; k < visit.observations.size(); ++k) {
            const Local x = local(visit, visit.observations[k]);
            const double expected = length<double>(facts(visit), x.data(), x.data() + k_point, x[k_expansion],
                                                   x.data() + k_reversal, x.data() + k_pose, x[k_path]);
            const double observed = campaign_.measurement.lengths[visit.observations[k]].length;
            ASSERT_NEAR(observed - residual[static_cast<Eigen::Index>(k)], expected, 1e-15) << "visit " << v;
        }
    }
}

TEST_P(VisitJacobian, AnalyticEqualsAutomatic) {
    for (std::size_t v = 0; v < adjustment_->visits().size(); ++v) {
        const Visit& visit = adjustment_->visits()[v];
        const Adjustment& least_squares = adjustment_->adjustment();
        const auto n = static_cast<Eigen::Index>(visit.observations.size());
        // Expected derivatives of the visit, put together from those of its distances.
        std::map<Adjustment::BlockId, Eigen::MatrixXd> expected;
        const auto part = [&](Adjustment::BlockId block) -> Eigen::MatrixXd& {
            return expected.try_emplace(block, Eigen::MatrixXd::Zero(n, least_squares.parameters(block).size()))
                .first->second;
        };
        for (Eigen::Index k = 0; k < n; ++k) {
            const std::size_t observation = visit.observations[static_cast<std::size_t>(k)];
            const LengthObservation& distance = campaign_.measurement.lengths[observation];
            const Eigen::RowVectorXd row = automatic_derivatives(facts(visit), local(visit, observation));
            part(adjustment_->station_block(visit.station)).row(k) = row.head<5>();
            part(adjustment_->fixture_block()).row(k).segment<3>(3 * static_cast<Eigen::Index>(distance.reflector)) =
                row.segment<3>(k_point);
            part(adjustment_->expansion_block())(k, 0) = row[k_expansion];
            part(adjustment_->reversal_block()).row(k) = row.segment<6>(k_reversal);
            part(adjustment_->pose_block(visit.angle)).row(k) = row.segment<6>(k_pose);
            part(adjustment_->dead_path_block(distance.dead_path))(k, 0) = row[k_path];
        }
        for (const auto& [block, derivative] : expected) {
            const Eigen::MatrixXd analytic = least_squares.jacobian(v, block);
            ASSERT_EQ(analytic.rows(), derivative.rows());
            ASSERT_EQ(analytic.cols(), derivative.cols());
            const Eigen::VectorXd scale = scale_of_columns(derivative);
            for (Eigen::Index c = 0; c < derivative.cols(); ++c) {
                EXPECT_LE((analytic.col(c) - derivative.col(c)).cwiseAbs().maxCoeff(), 1e-12 * scale[c])
                    << "visit " << v << ", block " << block << ", component " << c;
            }
        }
        // What the weights are made of is the same matrix.
        const Eigen::MatrixXd pose = adjustment_->pose_jacobian(v);
        EXPECT_EQ(pose, least_squares.jacobian(v, adjustment_->pose_block(visit.angle)));
    }
}

TEST_P(VisitJacobian, AnalyticEqualsCentralDifferences) {
    Adjustment& least_squares = adjustment_->adjustment();
    const bool near = std::get<1>(GetParam()) == Geometry::very_near_station;
    const double metre = near ? 2e-7 : 2e-6;
    const double radian = near ? 2e-6 : 2e-5;
    Eigen::VectorXd station_steps(5);
    station_steps << metre, metre, metre, 1e-4, near ? 0.2 : 10.0;
    Eigen::VectorXd motion_steps(6);
    motion_steps << metre, metre, metre, radian, radian, radian;
    for (std::size_t v = 0; v < adjustment_->visits().size(); v += 3) {
        const Visit& visit = adjustment_->visits()[v];
        std::vector<std::pair<Adjustment::BlockId, Eigen::VectorXd>> blocks{
            {adjustment_->station_block(visit.station), station_steps},
            {adjustment_->fixture_block(), Eigen::VectorXd::Constant(18, metre)},
            {adjustment_->expansion_block(), Eigen::VectorXd::Constant(1, near ? 2e-6 : 2e-5)},
            {adjustment_->reversal_block(), motion_steps},
            {adjustment_->pose_block(visit.angle), motion_steps}};
        for (const std::size_t observation : visit.observations) {
            blocks.emplace_back(adjustment_->dead_path_block(campaign_.measurement.lengths[observation].dead_path),
                                Eigen::VectorXd::Constant(1, 1e-4));
        }
        for (const auto& [block, steps] : blocks) {
            const Eigen::MatrixXd analytic = least_squares.jacobian(v, block);
            const Eigen::VectorXd scale = scale_of_columns(analytic);
            const Eigen::VectorXd value = least_squares.parameters(block);
            for (Eigen::Index c = 0; c < value.size(); ++c) {
                Eigen::VectorXd changed = value;
                changed[c] = value[c] + steps[c];
                least_squares.set_parameters(block, changed);
                const Eigen::VectorXd above = least_squares.residual(v);
                changed[c] = value[c] - steps[c];
                least_squares.set_parameters(block, changed);
                const Eigen::VectorXd below = least_squares.residual(v);
                least_squares.set_parameters(block, value);
                const Eigen::VectorXd numeric = (below - above) / (2.0 * steps[c]);
                EXPECT_LE((analytic.col(c) - numeric).cwiseAbs().maxCoeff(), 1e-6 * scale[c])
                    << "visit " << v << ", block " << block << ", component " << c;
            }
        }
    }
}

std::string case_name(const testing::TestParamInfo<std::tuple<RotaryAxis, Geometry>>& info) {
    const std::array<const char*, 4> geometries{"Ordinary", "AllZero", "VeryNearStation", "CoarseSetUp"};
    return std::string(1, "ABC"[axial_coordinate(std::get<0>(info.param))]) +
           geometries[static_cast<std::size_t>(std::get<1>(info.param))];
}

INSTANTIATE_TEST_SUITE_P(AxesAndGeometries, VisitJacobian,
                         testing::Combine(testing::Values(RotaryAxis::a, RotaryAxis::b, RotaryAxis::c),
                                          testing::Values(Geometry::ordinary, Geometry::all_zero,
                                                          Geometry::very_near_station, Geometry::coarse_set_up)),
                         case_name);

/// One distance at home and one after a quarter turn of a C axis; everything worked out by hand below.
struct HandExample {
    HandExample() {
        measurement.axis = RotaryAxis::c;
        measurement.stations = {"P1"};
        measurement.reflectors = {"R1"};
        measurement.passes = {"1"};
        measurement.dead_paths = {"P1"};
        measurement.angles = {0.0, std::numbers::pi / 2.0};
        measurement.angles_deg = {0.0, 90.0};
        measurement.fixture.resize(1, 3);
        measurement.fixture << 0.1, 0.0, 0.02;
        measurement.fixture_covariance = 1e-12 * Eigen::Matrix3d::Identity();
        measurement.station_start = {std::nullopt};
        measurement.temperature_difference = Eigen::VectorXd::Zero(1);
        measurement.u_temperature = Eigen::VectorXd::Zero(1);
        measurement.length_uncertainty = {1e-7, 0.0, ScaleModel::fixed, 0.0};
        measurement.lengths.resize(2);  // displayed lengths 0: the residual is minus the predicted length
        measurement.lengths[1].angle = 1;
    }

    /// Predicted distance |P - q| of the second visit.
    [[nodiscard]] double distance(const Vector6& set_up, const Vector6& error, const Eigen::Vector3d& station) const {
        JointAdjustment adjustment(measurement, {true, true}, rigid_motion(set_up),
                                   StartValues{{station}, Eigen::VectorXd::Zero(1)}, StochasticModel{});
        adjustment.adjustment().set_parameters(adjustment.pose_block(1), error);
        return -adjustment.adjustment().residual(1)[0];
    }

    RotaryTableMeasurement measurement;
};

TEST(SignConventions, QuarterTurnOfCAxisCarriesXToY) {
    const HandExample example;
    // R_z(90°) (0.1, 0, 0.02) = (0, 0.1, 0.02): seen from (0, 1.1, 0.02) it is 1 m away, from (1, 0.1, 0.02) too.
    EXPECT_NEAR(example.distance(Vector6::Zero(), Vector6::Zero(), {0.0, 1.1, 0.02}), 1.0, 1e-15);
    EXPECT_NEAR(example.distance(Vector6::Zero(), Vector6::Zero(), {1.0, 0.1, 0.02}), 1.0, 1e-15);
}

TEST(SignConventions, SetUpIsTheFixtureInTableCoordinates) {
    const HandExample example;
    Vector6 set_up = Vector6::Zero();
    set_up[0] = 10e-6;  // O_x: the fixture stands at +x; the quarter turn carries that to +y
    EXPECT_NEAR(example.distance(set_up, Vector6::Zero(), {0.0, 1.1, 0.02}), 1.0 - 10e-6, 1e-14);
    set_up = Vector6::Zero();
    set_up[1] = 20e-6;  // O_y: carried to -x
    EXPECT_NEAR(example.distance(set_up, Vector6::Zero(), {1.0, 0.1, 0.02}), 1.0 + 20e-6, 1e-14);
    set_up = Vector6::Zero();
    set_up[4] =
        30e-6;  // S_y turns x towards -z: the reflector goes down by 0.1 m · 30 µrad, and x by +0.02 m · 30 µrad
    EXPECT_NEAR(example.distance(set_up, Vector6::Zero(), {0.0, 0.1 + 0.6e-6, 1.02}), 1.0 + 3e-6, 1e-10);
    set_up = Vector6::Zero();
    set_up[3] = 30e-6;  // S_x turns y towards z and z towards -y: -0.6 µm in y, carried to +0.6 µm in x
    EXPECT_NEAR(example.distance(set_up, Vector6::Zero(), {1.0, 0.1, 0.02}), 1.0 - 0.6e-6, 1e-10);
}

TEST(SignConventions, ErrorMotionsAreInTheStationaryFrame) {
    const HandExample example;
    // The reflector is at (0, 0.1, 0.02) after the turn. Every error motion by its sign:
    const Eigen::Vector3d along_x(1.0, 0.1, 0.02);
    const Eigen::Vector3d along_y(0.0, 1.1, 0.02);
    const Eigen::Vector3d along_z(0.0, 0.1, 1.02);
    const auto error = [](int component, double value) {
        Vector6 result = Vector6::Zero();
        result[component] = value;
        return result;
    };
    const Vector6 none = Vector6::Zero();
    EXPECT_NEAR(example.distance(none, error(0, 5e-6), along_x), 1.0 - 5e-6, 1e-14);  // EXC towards +x
    EXPECT_NEAR(example.distance(none, error(1, 5e-6), along_y), 1.0 - 5e-6, 1e-14);  // EYC towards +y, not -x
    EXPECT_NEAR(example.distance(none, error(2, 5e-6), along_z), 1.0 - 5e-6, 1e-14);  // EZC towards +z
    EXPECT_NEAR(example.distance(none, error(3, 40e-6), along_z), 1.0 - 4e-6, 1e-9);  // EAC: y to z, 0.1 m · 40 µrad
    EXPECT_NEAR(example.distance(none, error(3, 40e-6), along_y), 1.0 + 0.8e-6, 1e-9);  // EAC: z to -y, 0.02 m
    EXPECT_NEAR(example.distance(none, error(4, 40e-6), along_x), 1.0 - 0.8e-6, 1e-9);  // EBC: z to x
    EXPECT_NEAR(example.distance(none, error(5, 40e-6), along_x), 1.0 + 4e-6, 1e-9);    // ECC: y to -x
}

TEST(SignConventions, LengthPlusDeadPathIsScaledDistanceOfTheWarmReflector) {
    HandExample example;
    example.measurement.length_uncertainty.scale_model = ScaleModel::free;
    example.measurement.temperature_difference[0] = 2.0;
    example.measurement.u_temperature[0] = 0.1;
    example.measurement.expansion = 10e-6;
    JointAdjustment adjustment(example.measurement, {true, true}, RigidMotion{},
                               StartValues{{{0.0, 1.1, 0.02}}, Eigen::VectorXd::Constant(1, 0.25)}, StochasticModel{});
    Eigen::Matrix<double, 5, 1> station = adjustment.adjustment().parameters(adjustment.station_block(0));
    station[3] = 3e-6;
    adjustment.adjustment().set_parameters(adjustment.station_block(0), station);
    // 20 µm/m warmer: the reflector is 2 µm further out; l = (1 + 3e-6)(1 m - 2 µm) - 0.25 m.
    EXPECT_NEAR(-adjustment.adjustment().residual(1)[0], 0.75 + 3e-6 - 2e-6, 1e-11);
}

TEST(Rotation, ElementaryRotationsAreRightHanded) {
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Matrix3d quarter = axis_rotation(axis, std::numbers::pi / 2.0);
        EXPECT_LT((quarter * Eigen::Vector3d::Unit((axis + 1) % 3) - Eigen::Vector3d::Unit((axis + 2) % 3)).norm(),
                  1e-15);
        EXPECT_LT((quarter * Eigen::Vector3d::Unit(axis) - Eigen::Vector3d::Unit(axis)).norm(), 1e-15);
        for (const double angle : {-3.0, -1e-9, 0.0, 0.3, 2.5}) {
            EXPECT_LT((axis_rotation(axis, angle) - synthetic::turn(axis, angle)).cwiseAbs().maxCoeff(), 1e-15);
        }
    }
}

TEST(Rotation, OrderIsAboutXFirstAndZLast) {
    const double quarter = std::numbers::pi / 2.0;
    // y → z by a, z → x by b, x → y by c.
    EXPECT_LT((rotation_zyx({quarter, quarter, quarter}) * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitY()).norm(),
              1e-15);
    const Eigen::Vector3d angles(0.2, -0.5, 1.1);
    EXPECT_LT((rotation_zyx(angles) - synthetic::turn(2, 1.1) * synthetic::turn(1, -0.5) * synthetic::turn(0, 0.2))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-15);
}

TEST(Rotation, DerivativesAgainstCentralDifferences) {
    for (const Eigen::Vector3d& angles :
         {Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(1e-5, -2e-5, 3e-5), Eigen::Vector3d(0.4, -1.2, 2.9)}) {
        const auto derivatives = rotation_zyx_derivatives(angles);
        for (int c = 0; c < 3; ++c) {
            const double step = 1e-5;
            const Eigen::Matrix3d numeric = (rotation_zyx(angles + step * Eigen::Vector3d::Unit(c)) -
                                             rotation_zyx(angles - step * Eigen::Vector3d::Unit(c))) /
                                            (2.0 * step);
            EXPECT_LT((derivatives[static_cast<std::size_t>(c)] - numeric).cwiseAbs().maxCoeff(), 1e-10)
                << "component " << c;
        }
    }
}

TEST(Rotation, MotionParametersInvertRigidMotion) {
    Noise noise(3);
    for (const double angle : {0.0, 1e-9, 1e-5, 3e-3, 0.5, 1.4}) {
        for (int k = 0; k < 20; ++k) {
            Vector6 parameters;
            for (int c = 0; c < 6; ++c) {
                parameters[c] = (c < 3 ? 1.0 : angle) * (2.0 * noise.uniform() - 1.0);
            }
            const Vector6 back = motion_parameters(rigid_motion(parameters));
            EXPECT_EQ(back.head<3>(), parameters.head<3>());
            // Near b = π/2 the angles are ill-conditioned; the rotation itself must come back.
            EXPECT_LT((back - parameters).cwiseAbs().maxCoeff(), 2e-15 * (angle > 1.0 ? 10.0 : 1.0));
            const RigidMotion motion = rigid_motion(parameters);
            const RigidMotion unity = motion * motion.inverse();
            EXPECT_LT((unity.rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-15);
            EXPECT_LT(unity.translation.norm(), 1e-15);
            const Eigen::Vector3d point(0.3, -0.2, 0.7);
            EXPECT_LT((motion * point - synthetic::moved(parameters, point)).norm(), 1e-15);
        }
    }
}

}  // namespace
}  // namespace gumcert::engine
