#include "engine/distance_network.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {
namespace {

constexpr double k_mm = 1e-3;
const std::filesystem::path k_networks = std::filesystem::path(GUMCERT_SOURCE_DIR) / "tests/reference/networks";

double number(const std::string& text) {
    double value = 0.0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    EXPECT_EQ(result.ec, std::errc{}) << text;
    return value;
}

std::vector<std::string> words(const std::string& line, char separator) {
    std::vector<std::string> result;
    std::istringstream stream(line);
    std::string word;
    if (separator == ' ') {
        while (stream >> word) {
            result.push_back(word);
        }
    } else {
        while (std::getline(stream, word, separator)) {
            result.push_back(word);
        }
    }
    return result;
}

/// Stored solution of the synthetic network, an independent program's: positions, standard deviations, [mm].
struct Stored {
    double omega = 0.0;
    std::map<std::string, std::array<double, 6>> points;
};

Stored stored_solution(const std::string& file) {
    Stored stored;
    std::ifstream stream(k_networks / file);
    std::string line;
    std::getline(stream, line);
    const auto start = line.find("omega ") + 6;
    stored.omega = number(line.substr(start, line.find(' ', start) - start));
    std::getline(stream, line);
    while (std::getline(stream, line)) {
        const auto fields = words(line, ',');
        std::array<double, 6> row{};
        for (std::size_t i = 0; i < 6 && i + 1 < fields.size(); ++i) {
            row[i] = fields[i + 1].empty() ? 0.0 : number(fields[i + 1]);
        }
        stored.points[fields[0]] = row;
    }
    return stored;
}

void expect_synthetic_network(bool free_constants) {
    std::vector<NetworkPoint> points;
    std::map<std::string, std::size_t> index;
    std::map<std::string, std::size_t> stations;
    std::vector<NetworkDistance> distances;
    // Subtracted before the adjustment, as the stored solution says.
    const std::array<double, 6> l0_mm{213, 187, 251, 232, 199, 244};
    std::ifstream stream(k_networks / "synthetic_point_network.txt");
    std::string line;
    while (std::getline(stream, line)) {
        const auto fields = words(line, ' ');
        if (fields.empty()) {
            continue;
        }
        if (fields[0] == "D") {
            NetworkDistance distance{index.at(fields[1]), index.at(fields[2]), std::nullopt, number(fields[3]) * k_mm,
                                     number(fields[4]) * k_mm};
            if (free_constants) {
                distance.constant = stations.at(fields[1]);
                distance.length -= l0_mm[*distance.constant] * k_mm;
            }
            distances.push_back(distance);
            continue;
        }
        NetworkPoint point;
        point.name = fields[1];
        point.position = Eigen::Vector3d(number(fields[2]), number(fields[3]), number(fields[4])) * k_mm;
        if (fields[0] == "S") {
            stations[point.name] = stations.size();
        } else if (fields[0] == "C") {
            point.covariance = Eigen::Matrix3d(Eigen::Matrix3d::Identity() * std::pow(number(fields[5]) * k_mm, 2));
        } else {
            point.eliminated = true;
        }
        index[point.name] = points.size();
        points.push_back(point);
    }
    const NetworkSolution solution =
        adjust_distance_network(points, free_constants ? 6 : 0, distances, SolverOptions{});
    const Stored stored = stored_solution(free_constants ? "synthetic_point_network_solution_free_l0.csv"
                                                         : "synthetic_point_network_solution_known_l0.csv");
    EXPECT_NEAR(solution.chi_square, stored.omega, 1e-6);
    EXPECT_EQ(solution.degrees_of_freedom, free_constants ? 642 : 648);
    std::size_t compared = 0;
    for (const auto& [name, row] : stored.points) {
        ++compared;
        if (name.starts_with("L0_")) {
            // Stored as observed = distance + L0; ours is l + l0 = distance.
            const auto i = static_cast<Eigen::Index>(stations.at(name.substr(3)));
            EXPECT_NEAR(-solution.constants[i] / k_mm, row[0], 1e-9) << name << " [mm]";
            EXPECT_NEAR(solution.u_constants[i] / k_mm / row[3], 1.0, 1e-6) << name << " sd";
            continue;
        }
        const auto found = index.find(name);
        ASSERT_NE(found, index.end()) << name;
        const Eigen::Vector3d position = solution.positions[found->second] / k_mm;
        const Eigen::Vector3d u = solution.covariances[found->second].diagonal().cwiseSqrt() / k_mm;
        for (int c = 0; c < 3; ++c) {
            const auto i = static_cast<std::size_t>(c);
            EXPECT_NEAR(position[c], row[i], 1e-9) << name << " coordinate " << c << " [mm]";  // 1e-6 um
            EXPECT_NEAR(u[c] / row[i + 3], 1.0, 1e-6 + 0.5e-9 / row[i + 3]) << name << " sd " << c;
        }
    }
    EXPECT_EQ(compared, points.size() + (free_constants ? 6 : 0));
}

TEST(DistanceNetwork, SyntheticNetworkWithKnownDeadPathsReproducesStoredSolution) {
    expect_synthetic_network(false);
}

TEST(DistanceNetwork, SyntheticNetworkWithFreeDeadPathsReproducesStoredSolution) {
    expect_synthetic_network(true);
}

/// Distances of one free point from fixed points, all with the same standard uncertainty.
NetworkSolution resection(const std::vector<std::pair<Eigen::Vector3d, double>>& observed, double u,
                          const Eigen::Vector3d& start) {
    std::vector<NetworkPoint> points{{"P", start, false, {}, false}};
    std::vector<NetworkDistance> distances;
    for (const auto& [position, length] : observed) {
        points.push_back({"K" + std::to_string(points.size()), position, true, {}, false});
        distances.push_back({0, points.size() - 1, std::nullopt, length, u});
    }
    return adjust_distance_network(points, 0, distances, SolverOptions{});
}

// H. Wolf, Ausgleichungsrechnung II (1979), p. 87: printed 900.0167 899.9833 1300.0062 m, standard deviations
// 11.8 11.8 6.2 mm with the a-priori standard deviation 0.01 m.
TEST(DistanceNetwork, Wolf1979PrintedSolution) {
    const NetworkSolution solution = resection(
        {{{1200, 900, 900}, 499.99}, {{900, 600, 900}, 500.00}, {{600, 900, 900}, 500.01}, {{900, 1200, 900}, 500.02}},
        0.01, {900, 900, 1300});
    EXPECT_NEAR(solution.positions[0][0], 900.0167, 0.5e-4);
    EXPECT_NEAR(solution.positions[0][1], 899.9833, 0.5e-4);
    EXPECT_NEAR(solution.positions[0][2], 1300.0062, 0.5e-4);
    const Eigen::Vector3d u_mm = solution.covariances[0].diagonal().cwiseSqrt() * 1e3;
    EXPECT_NEAR(u_mm[0], 11.8, 0.05);
    EXPECT_NEAR(u_mm[1], 11.8, 0.05);
    EXPECT_NEAR(u_mm[2], 6.2, 0.05);
    EXPECT_EQ(solution.degrees_of_freedom, 1);
}

// Blankenbach and Willert, Robuster räumlicher Bogenschnitt, AVN 8-9 (2009), pp. 320-327: eight real indoor ranges.
struct Range {
    const char* name;
    Eigen::Vector3d position;
    double length;
};
const std::vector<Range> k_indoor_ranges{{"51", {-8.62, 27.42, 10.29}, 8.20},  {"37", {-4.95, 27.30, 10.04}, 3.85},
                                         {"31", {-4.85, 20.69, 10.51}, 4.35},  {"102", {0.52, 22.59, 9.77}, 3.51},
                                         {"331", {-6.12, 25.48, 10.92}, 3.98}, {"35", {0.45, 27.39, 10.75}, 4.37},
                                         {"103", {0.61, 17.19, 9.71}, 8.17},   {"101", {-7.88, 22.45, 10.16}, 5.73}};

TEST(DistanceNetwork, BlankenbachWillert2009AllEightRanges) {
    std::vector<std::pair<Eigen::Vector3d, double>> observed;
    for (const Range& range : k_indoor_ranges) {
        observed.emplace_back(range.position, range.length);
    }
    const NetworkSolution solution = resection(observed, 0.05, {-2.59, 24.22, 9.62});
    EXPECT_NEAR(solution.positions[0][0], -2.3042, 0.5e-4);
    EXPECT_NEAR(solution.positions[0][1], 24.3101, 0.5e-4);
    EXPECT_NEAR(solution.positions[0][2], 9.5248, 0.5e-4);
    // The source states standard deviations with the a-posteriori variance factor: 0.299 0.332 1.194 m.
    const double s0 = std::sqrt(solution.chi_square / static_cast<double>(solution.degrees_of_freedom));
    const Eigen::Vector3d s = s0 * solution.covariances[0].diagonal().cwiseSqrt();
    EXPECT_NEAR(s[0], 0.299, 0.0005);
    EXPECT_NEAR(s[1], 0.332, 0.0005);
    EXPECT_NEAR(s[2], 1.194, 0.0005);
}

TEST(DistanceNetwork, BlankenbachWillert2009BlundersAreNamedOneAtATime) {
    std::vector<Range> kept = k_indoor_ranges;
    std::vector<std::string> removed;
    Eigen::Vector3d position;
    while (true) {
        std::vector<std::pair<Eigen::Vector3d, double>> observed;
        for (const Range& range : kept) {
            observed.emplace_back(range.position, range.length);
        }
        const NetworkSolution solution = resection(observed, 0.05, {-2.59, 24.22, 9.62});
        position = solution.positions[0];
        std::size_t worst = 0;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (std::abs(solution.reliability[i].test_value.value()) >
                std::abs(solution.reliability[worst].test_value.value())) {
                worst = i;
            }
        }
        if (std::abs(solution.reliability[worst].test_value.value()) < 3.29) {
            break;
        }
        removed.push_back(kept[worst].name);
        kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(worst));
    }
    EXPECT_EQ(removed.size(), 2U);
    EXPECT_NE(std::find(removed.begin(), removed.end(), "51"), removed.end());
    EXPECT_NE(std::find(removed.begin(), removed.end(), "103"), removed.end());
    EXPECT_NEAR(position[0], -2.5077, 0.5e-4);
    EXPECT_NEAR(position[1], 24.3202, 0.5e-4);
    EXPECT_NEAR(position[2], 9.7753, 0.5e-4);
}

TEST(DistanceNetwork, ADistanceThatNoOtherControlsIsNotTested) {
    const std::vector<Eigen::Vector3d> fixed{{1.0, 0.1, 0.0}, {0.0, 1.2, 0.1}, {0.2, 0.0, 0.9}, {-0.8, 0.3, 0.2}};
    for (const std::size_t seen : {3U, 4U}) {
        std::vector<NetworkPoint> points{{"P", {0.1, 0.1, 0.1}, false, {}, false}};
        std::vector<NetworkDistance> distances;
        for (std::size_t i = 0; i < seen; ++i) {
            points.push_back({"R" + std::to_string(i), fixed[i], true, {}, false});
            distances.push_back({0, i + 1, {}, fixed[i].norm() + 1e-6 * static_cast<double>(i), 1e-6});
        }
        for (const NetworkReliability& row :
             adjust_distance_network(points, 0, distances, SolverOptions{}).reliability) {
            EXPECT_EQ(row.test_value.has_value(), seen == 4);
            EXPECT_EQ(row.minimal_detectable_bias.has_value(), seen == 4);
            EXPECT_TRUE(!row.test_value || std::isfinite(*row.test_value));
        }
    }
}

TEST(DistanceNetwork, PointSeenOnAConeWithAnAdditiveConstantIsRefused) {
    // Six fixed points on a ring, the station on the axis of the ring: x and the constant cannot be told apart.
    std::vector<NetworkPoint> points{{"S", {1.0, 0.0, 0.0}, false, {}, false}};
    std::vector<NetworkDistance> distances;
    for (int i = 0; i < 6; ++i) {
        const double a = i * std::acos(-1.0) / 3.0;
        points.push_back({"R" + std::to_string(i), {0.1, 0.12 * std::cos(a), 0.12 * std::sin(a)}, true, {}, false});
        distances.push_back(
            {0, points.size() - 1, 0, (points.back().position - points[0].position).norm() - 0.2, 1e-7});
    }
    try {
        (void)adjust_distance_network(points, 1, distances, SolverOptions{});
        FAIL() << "a rank-deficient network gave a result";
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics()[0].code, "GC-ADJUST-0003");
        EXPECT_NE(error.diagnostics()[0].what.find("S, x"), std::string::npos) << error.what();
        EXPECT_NE(error.diagnostics()[0].what.find("additive constant 1"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace gumcert::engine
