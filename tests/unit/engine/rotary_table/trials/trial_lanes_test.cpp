#include "engine/rotary_table/trials/trial_lanes.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "engine/rotary_table/rotation.h"

namespace gumcert::engine {
namespace {

/// Lane t holds first + t · step.
Lanes lanes_from(double first, double step) {
    Lanes lanes;
    for (int t = 0; t < k_lanes; ++t) {
        lanes[t] = first + t * step;
    }
    return lanes;
}

TEST(Lanes, CombinationsAreThoseOfTheNaiveLoop) {
    // Whole numbers: no order of the additions changes a bit.
    std::vector<double> coefficients;
    std::vector<Lanes> x;
    for (int i = 0; i < 20; ++i) {
        coefficients.push_back(3.0 - i);
        x.push_back(lanes_from(i * i, 1.0 + i));
    }
    for (Eigen::Index count = 0; count <= 20; ++count) {
        Lanes sum = lanes_from(100.0, 1.0);
        add_combination(coefficients.data(), count, x.data(), sum);
        for (int t = 0; t < k_lanes; ++t) {
            double expected = 100.0 + t;
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
                expected += coefficients[i] * x[i][t];
            }
            EXPECT_EQ(sum[t], expected) << count << " terms, lane " << t;
        }
    }
}

TEST(Lanes, MatricesAreRowMajor) {
    const std::array<double, 6> matrix{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
    const std::array<Lanes, 3> x{lanes_from(1.0, 1.0), lanes_from(0.0, 2.0), lanes_from(-1.0, 0.0)};
    std::array<Lanes, 2> y{lanes_from(10.0, 0.0), lanes_from(20.0, 0.0)};
    multiply_add(matrix.data(), 2, 3, x.data(), y.data());
    for (int t = 0; t < k_lanes; ++t) {
        EXPECT_EQ(y[0][t], 10.0 + x[0][t] + 2.0 * x[1][t] - 3.0);
        EXPECT_EQ(y[1][t], 20.0 + 4.0 * x[0][t] + 5.0 * x[1][t] - 6.0);
    }
}

TEST(Lanes, AnyLaneCounts) {
    Lanes lanes;
    fill(lanes, 0.0);
    EXPECT_FALSE(any(lanes));
    lanes[k_lanes - 1] = 1.0;
    EXPECT_TRUE(any(lanes));
    fill(lanes, -2.5);
    EXPECT_EQ(lanes[7], -2.5);
}

TEST(Lanes, SineAndVersineAreThoseOfTheLibrary) {
    for (const double largest : {1e-12, 1e-5, 0.06, 0.0625, 0.07, 3.0}) {
        const Lanes x = lanes_from(-largest, 2.0 * largest / (k_lanes - 1));
        Lanes sine;
        Lanes versine;
        sine_and_versine(x, sine, versine);
        for (int t = 0; t < k_lanes; ++t) {
            const double half = std::sin(0.5 * x[t]);
            EXPECT_NEAR(sine[t], std::sin(x[t]), 3e-16 * std::abs(x[t])) << x[t];
            EXPECT_NEAR(versine[t], 2.0 * half * half, 5e-16 * x[t] * x[t]) << x[t];
        }
    }
}

TEST(Lanes, RotationsAreThoseOfOneTrial) {
    for (const double size : {1e-9, 1e-4, 0.05, 1.4}) {
        const std::array<Lanes, 3> angles{lanes_from(-size, 0.1 * size), lanes_from(0.7 * size, -0.05 * size),
                                          lanes_from(0.2 * size, 0.04 * size)};
        std::array<Lanes, 9> rotation;
        std::array<Lanes, 3> back;
        rotation_from_identity(angles.data(), rotation.data());
        angles_from_rotation(rotation.data(), back.data());
        for (int t = 0; t < k_lanes; ++t) {
            const Eigen::Vector3d of_trial(angles[0][t], angles[1][t], angles[2][t]);
            const Eigen::Matrix3d expected = rotation_zyx(of_trial) - Eigen::Matrix3d::Identity();
            for (std::size_t k = 0; k < 9; ++k) {
                EXPECT_NEAR(rotation[k][t], expected(static_cast<int>(k / 3), static_cast<int>(k % 3)), 4e-16);
            }
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(back[c][t], of_trial[static_cast<int>(c)], 1e-15 * size) << "no digits are lost";
            }
        }
    }
}

TEST(Lanes, NoLaneDependsOnItsNeighbours) {
    const std::array<Lanes, 3> alike{lanes_from(1e-3, 0.0), lanes_from(-2e-3, 0.0), lanes_from(3e-3, 0.0)};
    std::array<Lanes, 3> mixed = alike;
    mixed[0][0] = 1.0;  // takes the way of large angles
    std::array<Lanes, 9> expected;
    std::array<Lanes, 9> rotation;
    rotation_from_identity(alike.data(), expected.data());
    rotation_from_identity(mixed.data(), rotation.data());
    std::array<Lanes, 3> expected_back;
    std::array<Lanes, 3> back;
    angles_from_rotation(expected.data(), expected_back.data());
    angles_from_rotation(rotation.data(), back.data());
    for (int t = 1; t < k_lanes; ++t) {
        for (std::size_t k = 0; k < 9; ++k) {
            EXPECT_EQ(rotation[k][t], expected[k][t]);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(back[c][t], expected_back[c][t]);
        }
    }
    EXPECT_NE(rotation[4][0], expected[4][0]);
}

}  // namespace
}  // namespace gumcert::engine
