#include "app/reference_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/document_units.h"
#include "app/record_parts.h"
#include "gum/comparison.h"
#include "gum/coverage.h"
#include "gum/rounding.h"
#include "gum/type_a.h"
#include "gum/type_b.h"

namespace gumcert::app {

using reports::Printed;

reports::Comparison reference_comparison(const engine::RotaryTableJob& job, const gum::Propagation& displacement) {
    const engine::ReferenceMethod& reference = *job.reference;
    reports::Comparison comparison;
    comparison.reference_name = reference.name;
    for (int c = 0; c < 3; ++c) {
        comparison.contact_point_mm.push_back(reference.contact_point[c] / gum::k_millimetre);
    }
    std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> readings;  // by direction and angle
    for (const engine::ReferenceReading& reading : reference.readings) {
        readings[{reading.direction, reading.angle}].push_back(reading.reading);
    }
    std::size_t runs = 0;
    for (const auto& [at, values] : readings) {
        runs = std::max(runs, values.size());
    }
    const double u_mpe = gum::u_from_half_width(reference.maximum_permissible_error);
    const double u_resolution = gum::u_from_resolution(reference.resolution);
    const double k = gum::coverage_factor(job.coverage_probability, std::numeric_limits<double>::infinity());
    const auto u_reference = [&](std::size_t count) {
        return std::hypot(u_mpe, u_resolution, gum::u_of_mean(reference.repeatability, count));
    };
    const auto add_row = [&](const std::string& input, double u, const std::string& type,
                             const std::string& distribution) {
        reports::BudgetRow row;
        row.input = input;
        row.value = 0.0;
        row.unit = "um";
        row.u = u / gum::k_micrometre;
        row.type = type;
        row.distribution = distribution;
        row.sensitivity = 1.0;
        row.contribution = row.u;
        row.share = std::pow(u / u_reference(runs), 2);
        row.source = reference.name;
        row.printed.u = gum::round_significant(row.u, 2);
        row.printed.contribution = gum::round_significant(row.contribution, 2);
        row.printed.share = gum::percent(row.share);
        comparison.reference_budget.push_back(std::move(row));
    };
    add_row("maximum permissible error of the indicator", u_mpe, "B", "uniform");
    add_row("resolution of the indication", u_resolution, "B", "uniform");
    add_row("repeatability, mean of " + std::to_string(runs) + " runs", gum::u_of_mean(reference.repeatability, runs),
            "B", "normal");

    const char* const directions = "xyz";
    std::array<std::vector<gum::ComparisonScore>, 4> scores;  // x, y, z, all
    double largest_U = 0.0;
    double smallest_reference_U = std::numeric_limits<double>::infinity();
    for (const auto& [at, values] : readings) {
        const auto [direction, angle] = at;
        const Reported table = reported(displacement, static_cast<Eigen::Index>(3 * angle + direction), k_um);
        double mean = 0.0;
        for (const double value : values) {
            mean += value / static_cast<double>(values.size());
        }
        reports::ComparisonPoint point;
        point.direction = directions[direction];
        point.angle_deg = job.measurement.angles_deg[angle];
        point.value = table.value;
        point.u = table.u;
        point.U = table.U;
        point.reference_value = mean / gum::k_micrometre;
        point.reference_u = u_reference(values.size()) / gum::k_micrometre;
        point.reference_U = k * point.reference_u;
        const gum::ComparisonScore score =
            gum::score({point.value, point.u, point.U}, {point.reference_value, point.reference_u, point.reference_U});
        point.D = score.difference;
        point.u_D = score.u_difference;
        point.U_D = score.U_difference;
        point.En = score.en;
        point.zeta = score.zeta;
        const Printed reference_text = printed(point.reference_value, point.reference_U, k_um);
        const Printed difference_text = printed(point.D, point.U_D, k_um);
        point.printed.angle = shortest(point.angle_deg);
        point.printed.value = table.text.value;
        point.printed.U = table.text.U;
        point.printed.reference_value = reference_text.value;
        point.printed.reference_U = reference_text.U;
        point.printed.D = difference_text.value;
        point.printed.U_D = difference_text.U;
        point.printed.En = gum::round_to_quantum(point.En, 2);
        scores[direction].push_back(score);
        scores[3].push_back(score);
        largest_U = std::max(largest_U, point.U);
        smallest_reference_U = std::min(smallest_reference_U, point.reference_U);
        comparison.points.push_back(std::move(point));
    }
    for (std::size_t d = 0; d < scores.size(); ++d) {
        if (scores[d].empty()) {
            continue;
        }
        const gum::ComparisonSummary numbers = gum::summarise(scores[d]);
        reports::ComparisonSummary row;
        row.direction = d < 3 ? std::string(1, directions[d]) : "all";
        row.points = static_cast<std::int64_t>(numbers.points);
        row.count_above_1 = static_cast<std::int64_t>(numbers.count_above_1);
        row.mean_abs_En = numbers.mean_absolute_en;
        row.max_abs_En = numbers.largest_absolute_en;
        row.rms_En = numbers.rms_en;
        row.printed.mean_abs_En = gum::round_to_quantum(row.mean_abs_En, 2);
        row.printed.max_abs_En = gum::round_to_quantum(row.max_abs_En, 2);
        row.printed.rms_En = gum::round_to_quantum(row.rms_En, 2);
        comparison.summary.push_back(std::move(row));
    }
    comparison.remarks.push_back(
        "The displacement of the contact point and its uncertainty are computed from the six error motions with "
        "respect "
        "to the axis average line; the readings are compared as they stand.");
    if (smallest_reference_U > largest_U) {
        comparison.remarks.push_back(
            "The expanded uncertainty of the reference method (" + gum::round_significant(smallest_reference_U, 2) +
            " µm) is larger than that of the error motions: |En| at or below 1 shows no contradiction, and cannot "
            "confirm the smaller uncertainty.");
    }
    comparison.remarks.push_back(
        "The points of one direction share the set-up of both methods; they are not independent proofs. No common "
        "source of both methods is known to this job, so the covariance between them is taken as zero.");
    return comparison;
}

}  // namespace gumcert::app
