// The joint adjustment against an independent program: dense Gauss-Newton in Python, rotation vectors, its own model.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/start/start_values.h"

namespace gumcert::engine {
namespace {

using nlohmann::json;

const std::filesystem::path k_script =
    std::filesystem::path(GUMCERT_SOURCE_DIR) / "tests" / "reference" / "rotary_model_oracle.py";
constexpr const char* k_python = "/usr/bin/python3";  // of the system, where NumPy is a package

Eigen::Vector3d vector3(const json& value) {
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

Eigen::Matrix3d matrix3(const json& value) {
    Eigen::Matrix3d result;
    for (std::size_t i = 0; i < 3; ++i) {
        result.row(static_cast<Eigen::Index>(i)) = vector3(value[i]).transpose();
    }
    return result;
}

/// ω of the small rotation exp(ω×), to first order.
Eigen::Vector3d small_rotation(const Eigen::Matrix3d& rotation) {
    return 0.5 * Eigen::Vector3d(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0),
                                 rotation(1, 0) - rotation(0, 1));
}

/// ∂ω/∂(a, b, c) of a small rotation from the left: columns are those of dR Rᵀ.
Eigen::Matrix3d left_rotation_from_angles(const Eigen::Vector3d& angles) {
    const Eigen::Matrix3d rotation = rotation_zyx(angles);
    const auto derivatives = rotation_zyx_derivatives(angles);
    Eigen::Matrix3d result;
    for (Eigen::Index c = 0; c < 3; ++c) {
        result.col(c) = small_rotation(derivatives[static_cast<std::size_t>(c)] * rotation.transpose());
    }
    return result;
}

RotaryTableMeasurement measurement_of(const json& data) {
    RotaryTableMeasurement measurement;
    measurement.axis = RotaryAxis::a;
    for (const json& angle : data["theta"]) {
        measurement.angles.push_back(angle.get<double>());
        measurement.angles_deg.push_back(angle.get<double>() * 57.29577951308232);
    }
    const std::size_t reflectors = data["fixture"].size();
    const std::size_t stations = data["lengths"][0][0].size();
    measurement.fixture.resize(static_cast<Eigen::Index>(reflectors), 3);
    measurement.fixture_covariance.setZero(3 * static_cast<Eigen::Index>(reflectors),
                                           3 * static_cast<Eigen::Index>(reflectors));
    for (std::size_t m = 0; m < reflectors; ++m) {
        const auto at = static_cast<Eigen::Index>(m);
        measurement.reflectors.push_back("R" + std::to_string(m + 1));
        measurement.fixture.row(at) = vector3(data["fixture"][m]).transpose();
        measurement.fixture_covariance.diagonal().segment<3>(3 * at) = vector3(data["u_fixture"][m]).cwiseAbs2();
    }
    for (std::size_t j = 0; j < stations; ++j) {
        measurement.stations.push_back("P" + std::to_string(j + 1));
        measurement.dead_paths.push_back(measurement.stations.back());
        measurement.passes.push_back(measurement.stations.back());
        measurement.station_start.emplace_back();
        for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
            for (std::size_t m = 0; m < reflectors; ++m) {
                measurement.lengths.push_back(
                    {j, m, j, i, j, Approach::positive, data["lengths"][i][m][j].get<double>(), 0});
            }
        }
    }
    measurement.temperature_difference = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(stations));
    measurement.u_temperature = measurement.temperature_difference;
    measurement.length_uncertainty = {data["u_constant"].get<double>(), data["u_proportional"].get<double>(),
                                      ScaleModel::fixed, 0.0};
    measurement.table_repeatability.mode = RepeatabilityMode::none;
    return measurement;
}

TEST(RotaryModelOracle, SolutionAndUncertaintiesAgree) {
    if (!std::filesystem::exists(k_python)) {
        GTEST_SKIP() << k_python << " absent";
    }
    const std::filesystem::path output =
        std::filesystem::path(::testing::TempDir()) / ("rotary_model_oracle_" + std::to_string(getpid()) + ".json");
    const std::string command = std::string(k_python) + " -B '" + k_script.string() + "' '" + output.string() + "'";
    const int status = std::system(command.c_str());
    if (WIFEXITED(status) && WEXITSTATUS(status) == 77) {
        GTEST_SKIP() << "NumPy absent";
    }
    ASSERT_EQ(status, 0) << command;
    std::ifstream stream(output);
    const json data = json::parse(stream);
    std::filesystem::remove(output);
    const json& expected = data["solution"];

    const RotaryTableMeasurement measurement = measurement_of(data);
    JointAdjustment adjustment(measurement, std::vector<bool>(measurement.lengths.size(), true), RigidMotion{},
                               find_start_values(measurement), StochasticModel{});
    ASSERT_TRUE(adjustment.adjustment().solve(SolverOptions{}).converged);
    double chi_square = 0.0;
    for (int repeat = 0; repeat < 2; ++repeat) {
        adjustment.set_weights(StochasticModel{});
        const SolveSummary summary = adjustment.adjustment().refine(SolverOptions{});
        ASSERT_TRUE(summary.converged);
        chi_square = summary.chi_square;
    }
    const NormalEquations normal = adjustment.adjustment().linearise();
    const Eigen::MatrixXd covariance = normal.covariance();
    EXPECT_EQ(normal.parameter_count(), expected["parameters"].get<Eigen::Index>());
    EXPECT_EQ(normal.observation_count(), expected["observations"].get<Eigen::Index>());
    EXPECT_NEAR(chi_square, expected["chi_square"].get<double>(), 1e-6 * chi_square);

    const auto u = [&](std::size_t block, int component) {
        const Eigen::Index column = normal.column(block, component);
        return std::sqrt(covariance(column, column));
    };
    const auto compare = [](double value, const json& expected_value, double value_u, const json& stated_u,
                            const std::string& what) {
        const auto expected_u = stated_u.get<double>();
        EXPECT_NEAR(value, expected_value.get<double>(), 1e-4 * expected_u) << what;
        EXPECT_NEAR(value_u, expected_u, 1e-4 * expected_u) << "u of " << what;
    };
    const Adjustment& least_squares = adjustment.adjustment();
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        const auto station = adjustment.station_block(j);
        for (std::size_t c = 0; c < 3; ++c) {
            compare(least_squares.parameters(station)[static_cast<Eigen::Index>(c)], expected["stations"][j][c],
                    u(station, static_cast<int>(c)), expected["u_stations"][j][c], measurement.stations[j]);
        }
        const auto path = adjustment.dead_path_block(j);
        compare(least_squares.parameters(path)[0], expected["dead_paths"][j], u(path, 0), expected["u_dead_paths"][j],
                "dead path " + measurement.dead_paths[j]);
    }
    for (std::size_t m = 0; m < measurement.reflectors.size(); ++m) {
        for (std::size_t c = 0; c < 3; ++c) {
            const auto component = static_cast<int>(3 * m + c);
            compare(least_squares.parameters(adjustment.fixture_block())[component], expected["fixture"][m][c],
                    u(adjustment.fixture_block(), component), expected["u_fixture"][m][c], measurement.reflectors[m]);
        }
    }
    // Poses: translation alike; rotation as matrix, its uncertainty as that of a small rotation from the left.
    Eigen::Matrix<double, 6, 6> to_first = Eigen::Matrix<double, 6, 6>::Zero();
    for (std::size_t i = 1; i < measurement.angles.size(); ++i) {
        const auto pose = adjustment.pose_block(i);
        const Eigen::VectorXd& value = least_squares.parameters(pose);
        Eigen::Matrix<double, 6, 6> map = Eigen::Matrix<double, 6, 6>::Identity();
        map.bottomRightCorner<3, 3>() = left_rotation_from_angles(value.tail<3>());
        if (i == 1) {
            to_first = map;
        }
        const Eigen::Index at = normal.column(pose, 0);
        const Eigen::Index first = normal.column(adjustment.pose_block(1), 0);
        const Eigen::Matrix<double, 6, 6> block = map * covariance.block<6, 6>(at, at) * map.transpose();
        const Eigen::Vector3d difference =
            small_rotation(rotation_zyx(value.tail<3>()) * matrix3(expected["rotations"][i]).transpose());
        for (std::size_t c = 0; c < 3; ++c) {
            const auto k = static_cast<Eigen::Index>(c);
            compare(value[k], expected["translations"][i][c], std::sqrt(block(k, k)), expected["u_translations"][i][c],
                    "translation at angle " + std::to_string(i + 1));
            compare(difference[k], 0.0, std::sqrt(block(3 + k, 3 + k)), expected["u_rotations"][i][c],
                    "rotation at angle " + std::to_string(i + 1));
        }
        // And the correlation with the first pose after home, element by element.
        const Eigen::Matrix<double, 6, 6> cross = map * covariance.block<6, 6>(at, first) * to_first.transpose();
        const Eigen::Matrix<double, 6, 6> first_block =
            to_first * covariance.block<6, 6>(first, first) * to_first.transpose();
        for (Eigen::Index r = 0; r < 6; ++r) {
            for (Eigen::Index c = 0; c < 6; ++c) {
                const double product = std::sqrt(block(r, r) * first_block(c, c));
                EXPECT_NEAR(cross(r, c) / product,
                            expected["pose_covariance"][i - 1][static_cast<std::size_t>(r)][static_cast<std::size_t>(c)]
                                    .get<double>() /
                                product,
                            1e-4);
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::engine
