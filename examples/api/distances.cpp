// A point from four measured distances (H. Wolf, Ausgleichungsrechnung II, 1979, p. 87), and two divided circles that
// calibrate each other by closure, with the harmonics of the deviations that come out.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/circle_closure.h"
#include "engine/distance_network.h"
#include "engine/harmonics.h"
#include "gum/quantity/diagnostic.h"

using namespace gumcert;

int main() try {
    std::vector<engine::NetworkPoint> points(1);
    points[0].name = "P";
    points[0].position = {900.0, 900.0, 1300.0};  // about, [m]
    std::vector<engine::NetworkDistance> distances;
    for (const auto& [from, length] : std::vector<std::pair<Eigen::Vector3d, double>>{{{1200, 900, 900}, 499.99},
                                                                                      {{900, 600, 900}, 500.00},
                                                                                      {{600, 900, 900}, 500.01},
                                                                                      {{900, 1200, 900}, 500.02}}) {
        engine::NetworkPoint& fixed = points.emplace_back();
        fixed.position = from;
        fixed.fixed = true;
        distances.push_back({.from = 0, .to = points.size() - 1, .constant = {}, .length = length, .u = 0.01});
    }
    const engine::NetworkSolution solution =
        engine::adjust_distance_network(points, 0, distances, engine::SolverOptions{});
    const Eigen::Vector3d u = 1e3 * solution.covariances[0].diagonal().cwiseSqrt();
    std::printf("P = %.4f %.4f %.4f m, u = %.1f %.1f %.1f mm\n", solution.positions[0][0], solution.positions[0][1],
                solution.positions[0][2], u[0], u[1], u[2]);

    // A table with deviations of 2" cos(angle) against a polygon of six sides, in all six positions, without noise.
    constexpr double k_arcsecond = std::numbers::pi / 648000.0;
    engine::CircleClosureMeasurement closure;
    closure.steps = 6;
    closure.stated_u = 0.05 * k_arcsecond;
    closure.uses_stated_u = true;
    Eigen::VectorXd angles(6);
    for (std::size_t position = 0; position < 6; ++position) {
        closure.series.push_back({.position = position, .repetition = {}});
        for (std::size_t step = 0; step < 6; ++step) {
            angles[static_cast<Eigen::Index>(step)] = 2.0 * std::numbers::pi * static_cast<double>(step) / 6.0;
            const double of_table = 2.0 * std::cos(angles[static_cast<Eigen::Index>(step)]);
            const double of_polygon = closure.side_at(position, step) % 2 == 0 ? 0.5 : -0.5;
            closure.readings.push_back({position, step, (of_table + of_polygon) * k_arcsecond});
        }
    }
    const engine::CircleClosureSolution circles = engine::solve_circle_closure(closure);
    const double u_step = circles.u_reading * std::sqrt(circles.cofactors(0, 0)) / k_arcsecond;
    std::printf("T_1 = %.3f\", u = %.4f\" with %.0f degrees of freedom\n", circles.deviations[1] / k_arcsecond, u_step,
                circles.degrees_of_freedom);  // u = 0.05" sqrt(6 - 1)/6, (6 - 1)(6 - 2)

    const Eigen::MatrixXd covariance = circles.u_reading * circles.u_reading * circles.cofactors.topLeftCorner(6, 6);
    const engine::HarmonicAnalysis harmonics = engine::analyse_harmonics(
        angles, circles.deviations.head(6),
        [&](const Eigen::MatrixXd& c) -> Eigen::MatrixXd { return c * covariance * c.transpose(); },
        engine::resolved_orders(angles, 3));
    for (const engine::Harmonic& order : harmonics.orders) {
        std::printf("order %d: amplitude %.3f\"\n", order.order, order.amplitude / k_arcsecond);
    }
    return 0;
} catch (const gum::DiagnosedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
