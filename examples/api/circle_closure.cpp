// A rotary table and a polygon of six sides that calibrate each other (dual closure): neither of them is known, every side
// stands in the line of sight at every step. What comes out are deviations with their expanded uncertainties.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "gum/circle_closure/evaluate_circle_closure.h"
#include "gum/quantity/diagnostic.h"

using namespace gumcert;

namespace {

constexpr std::size_t k_steps = 6;
constexpr double k_arcsecond = std::numbers::pi / 648000.0;

/// Readings of an autocollimator without noise: the table is off by 2" cos(angle), the sides by 0.5" to either side.
gum::CircleClosureRequest request() {
    gum::CircleClosureRequest request;
    request.unit = gum::Unit::parse("arcsec");
    engine::CircleClosureMeasurement& closure = request.measurement;
    closure.steps = k_steps;
    closure.stated_u = 0.05 * k_arcsecond;  // of one reading, from earlier work
    closure.uses_stated_u = true;
    closure.effects.push_back({.name = "scale",
                               .source = "calibration of the autocollimator",
                               .pattern = engine::ClosurePattern::scale,
                               .u = 0.01,
                               .distribution = gum::Distribution::normal(0.0, 0.01)});
    for (std::size_t position = 0; position < k_steps; ++position) {
        closure.series.push_back({.position = position, .repetition = {}});
        for (std::size_t step = 0; step < k_steps; ++step) {
            const double of_table = 2.0 * std::cos(2.0 * std::numbers::pi * static_cast<double>(step) / 6.0);
            const double of_side = closure.side_at(position, step) % 2 == 0 ? 0.5 : -0.5;
            closure.readings.push_back({position, step, (of_table + of_side) * k_arcsecond});
        }
    }
    return request;
}

}  // namespace

int main() try {
    const gum::CircleClosureResult result = gum::evaluate_circle_closure(request(), 1);
    for (std::size_t i = 0; i < result.coverage.size(); ++i) {  // T, P, and the range of each
        const auto at = static_cast<Eigen::Index>(i);
        std::printf("%s = %.3f\", U = %.3f\" (k = %.2f)\n", result.model->outputs()[i].name.c_str(),
                    result.propagation.value(at) / k_arcsecond, result.coverage[i].U / k_arcsecond,
                    result.coverage[i].k);
    }
    return 0;
} catch (const gum::DiagnosedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
