#include "app/rotary_table_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "app/record_parts.h"
#include "gum/comparison.h"
#include "gum/coverage.h"
#include "gum/quantity/units.h"
#include "gum/rounding.h"
#include "gum/type_a.h"
#include "gum/type_b.h"

namespace gumcert::app {

namespace {

using engine::RotaryTableJob;
using engine::RotaryTableSolution;
using reports::Printed;

/// A unit of a document: factor to SI, name in the record, name in print.
struct DocumentUnit {
    double si;
    const char* record;
    const char* print;
};
constexpr DocumentUnit k_um{gum::k_micrometre, "um", "µm"};
constexpr DocumentUnit k_arcsec{gum::k_arcsecond, "arcsec", "″"};
constexpr DocumentUnit k_mm{gum::k_millimetre, "mm", "mm"};

const DocumentUnit& unit_of(const gum::OutputQuantity& quantity) {
    return quantity.unit == "m" ? k_um : k_arcsec;
}

/// Value and expanded uncertainty in a unit of the document. Without uncertainty (the home angle of the home datum)
/// the value is zero by definition.
Printed printed(double value, double U, const DocumentUnit& unit) {
    if (!(U > 0.0)) {
        return {"0", "", unit.print};
    }
    const gum::RoundedPair pair = gum::round_to_uncertainty(value, U);
    return {pair.value, pair.U, unit.print};
}

/// One reported quantity in the unit of the document.
struct Reported {
    double value, u, U, k;
    std::optional<double> nu_eff;
    Printed text;
};

Reported reported(const gum::Propagation& propagation, Eigen::Index i, const DocumentUnit& unit) {
    Reported result;
    result.value = propagation.value[i] / unit.si;
    result.u = propagation.standard_uncertainty[i] / unit.si;
    result.U = propagation.expanded_uncertainty[i] / unit.si;
    result.k = propagation.coverage_factor[i];
    result.nu_eff = finite_or_none(propagation.effective_degrees_of_freedom[i]);
    result.text = printed(result.value, result.U, unit);
    return result;
}

reports::ErrorValue error_value(const Reported& from) {
    return {from.value, from.u, from.U, from.k, from.nu_eff, from.text};
}

std::string angle_text(double angle_deg) {
    return shortest(angle_deg);
}

const std::vector<std::string>& budget_sources() {
    static const std::vector<std::string> sources{"length noise", "scale",           "dead path",
                                                  "fixture CMM",  "fixture thermal", "table repeatability"};
    return sources;
}

/// Shares of one output in the order of `budget_sources`; 0 for a source that the measurement does not have.
std::vector<double> shares_of(const gum::Propagation& propagation, Eigen::Index output) {
    std::vector<double> shares;
    for (const std::string& source : budget_sources()) {
        const auto found = std::find_if(propagation.shares_by_source.begin(), propagation.shares_by_source.end(),
                                        [&](const gum::BudgetContribution& c) { return c.name == source; });
        shares.push_back(found == propagation.shares_by_source.end() ? 0.0 : found->share[output]);
    }
    return shares;
}

/// Unit in which a budget shows an input of a coherent SI unit: µm and arcsec, others as they are.
DocumentUnit budget_unit(const std::string& si_unit) {
    if (si_unit == "m") {
        return k_um;
    }
    return si_unit == "rad" ? k_arcsec : DocumentUnit{1.0, si_unit.c_str(), si_unit.c_str()};
}

reports::Result result_of(const gum::Propagation& propagation, const gum::MeasurementModel& model, Eigen::Index output,
                          const std::string& name, const std::string& description) {
    const DocumentUnit& unit = unit_of(model.outputs()[static_cast<std::size_t>(output)]);
    const Reported numbers = reported(propagation, output, unit);
    reports::Result result;
    result.name = name;
    result.description = description;
    result.value = numbers.value;
    result.unit = unit.record;
    result.u = numbers.u;
    result.nu_eff = numbers.nu_eff;
    result.k = numbers.k;
    result.coverage_probability = propagation.coverage_probability;
    result.U = numbers.U;
    result.distribution = numbers.nu_eff ? "t" : "normal";
    result.printed = numbers.text;
    for (std::size_t g = 0; g < model.inputs().size(); ++g) {
        const gum::InputGroup& group = model.inputs()[g];
        const Eigen::VectorXd variance = group.is_diagonal() ? Eigen::VectorXd(group.covariance.col(0))
                                                             : Eigen::VectorXd(group.covariance.diagonal());
        reports::BudgetRow row;
        row.input = group.name;
        const DocumentUnit input_unit = budget_unit(group.unit);
        row.unit = input_unit.record;
        row.u = std::sqrt(variance.mean()) / input_unit.si;  // of one typical quantity of the group
        row.nu = finite_or_none(group.degrees_of_freedom);
        row.type = type_letter(group.evaluation);
        row.distribution = group.distribution;
        row.contribution = std::sqrt(propagation.budget[g].variance[output]) / unit.si;
        row.share = propagation.budget[g].share[output];
        row.source = group.source;
        if (group.size() == 1) {
            Eigen::Index first = 0;
            for (std::size_t before = 0; before < g; ++before) {
                first += model.inputs()[before].size();
            }
            row.value = group.value[0] / input_unit.si;
            row.sensitivity = propagation.jacobian(output, first) * input_unit.si / unit.si;
        }
        row.printed.u = gum::round_significant(row.u, 2);
        row.printed.contribution = gum::round_significant(row.contribution, 2);
        row.printed.share = gum::percent(row.share);
        result.budget.push_back(std::move(row));
    }
    return result;
}

reports::Comparison comparison_of(const RotaryTableJob& job, const gum::Propagation& displacement) {
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
        point.printed.angle = angle_text(point.angle_deg);
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

const char* action_name(engine::OutlierAction action) {
    return action == engine::OutlierAction::remove ? "remove" : "report";
}

nlohmann::json options_json(const RotaryTableJob& job, const engine::EvaluationOptions& options) {
    const engine::RotaryTableMeasurement& measurement = job.measurement;
    const char* const scale_models[] = {"fixed", "prior", "free"};
    const char* const modes[] = {"estimate", "given", "none"};
    return {{"solver",
             {{"linear_solver", "Ceres, Levenberg-Marquardt with Schur complement, one thread, then Gauss-Newton"},
              {"max_iterations", options.solver.max_iterations},
              {"max_refinements", options.solver.max_refinements},
              {"step_tolerance", options.solver.step_tolerance},
              {"rank_tolerance", options.solver.rank_tolerance}}},
            {"variance_components",
             {{"method", "restricted maximum likelihood, Fisher scoring"},
              {"length_noise", measurement.estimate_length_noise ? "estimate" : "fixed"},
              {"table_repeatability", modes[static_cast<int>(measurement.table_repeatability.mode)]},
              {"max_iterations", options.max_component_iterations},
              {"tolerance", options.component_tolerance}}},
            {"scale_model", scale_models[static_cast<int>(measurement.length_uncertainty.scale_model)]},
            {"outliers",
             {{"test", measurement.outliers.test == engine::OutlierTest::data_snooping ? "data_snooping" : "none"},
              {"alpha", measurement.outliers.alpha},
              {"action", action_name(measurement.outliers.action)},
              {"critical_value", options.critical_value},
              {"non_centrality", options.non_centrality}}}};
}

void fill_set_up(reports::RotaryTable& rotary, const RotaryTableSolution& solution, const gum::Propagation& propagation,
                 engine::RotaryAxis axis) {
    const auto across = engine::across_axis(axis);
    rotary.set_up.printed_O.fill({"0", "", k_um.print});
    rotary.set_up.printed_S.fill({"0", "", k_arcsec.print});
    rotary.axis_in_fixture = rotary.set_up;
    const auto place = [&](Eigen::Index output, const DocumentUnit& unit, std::size_t coordinate, auto value, auto u,
                           auto U, auto text) {
        Reported numbers = reported(propagation, output, unit);
        (rotary.set_up.*value)[coordinate] = numbers.value;
        (rotary.axis_in_fixture.*value)[coordinate] = -numbers.value;  // the axis as seen from the fixture
        for (reports::SetUp* side : {&rotary.set_up, &rotary.axis_in_fixture}) {
            (side->*u)[coordinate] = numbers.u;
            (side->*U)[coordinate] = numbers.U;
            (side->*text)[coordinate] = printed((side->*value)[coordinate], numbers.U, unit);
        }
    };
    const Eigen::Index first = solution.quantities.set_up;
    for (std::size_t c = 0; c < 2; ++c) {
        const auto coordinate = static_cast<std::size_t>(across[c]);
        const auto at = static_cast<Eigen::Index>(c);
        using reports::SetUp;
        place(first + at, k_um, coordinate, &SetUp::O_um, &SetUp::u_O_um, &SetUp::U_O_um, &SetUp::printed_O);
        place(first + 2 + at, k_arcsec, coordinate, &SetUp::S_arcsec, &SetUp::u_S_arcsec, &SetUp::U_S_arcsec,
              &SetUp::printed_S);
    }
    rotary.set_up.k = rotary.axis_in_fixture.k = propagation.coverage_factor.segment<4>(first).maxCoeff();
}

void fill_ranges(reports::RotaryTable& rotary, const gum::Propagation& propagation, Eigen::Index angles) {
    for (Eigen::Index c = 0; c < 6; ++c) {
        const DocumentUnit& unit = c < 3 ? k_um : k_arcsec;
        Eigen::Index lowest = c;
        Eigen::Index highest = c;
        for (Eigen::Index i = 0; i < angles; ++i) {
            lowest = propagation.value[6 * i + c] < propagation.value[lowest] ? 6 * i + c : lowest;
            highest = propagation.value[6 * i + c] > propagation.value[highest] ? 6 * i + c : highest;
        }
        const double variance = propagation.covariance(lowest, lowest) + propagation.covariance(highest, highest) -
                                2.0 * propagation.covariance(lowest, highest);
        const double k = std::max(propagation.coverage_factor[lowest], propagation.coverage_factor[highest]);
        reports::RangeRow row;
        row.name = rotary.error_names[static_cast<std::size_t>(c)];
        row.value = (propagation.value[highest] - propagation.value[lowest]) / unit.si;
        row.U = k * std::sqrt(std::max(0.0, variance)) / unit.si;
        row.printed = printed(row.value, row.U, unit);
        rotary.ranges.push_back(std::move(row));
    }
}

void fill_budget(reports::RotaryTable& rotary, const RotaryTableSolution& solution, const gum::Propagation& propagation,
                 const engine::RotaryTableMeasurement& measurement) {
    rotary.budget_sources = budget_sources();
    const auto angles = static_cast<Eigen::Index>(measurement.angles.size());
    const auto add = [&](Eigen::Index output, const std::string& name, std::optional<double> angle) {
        const DocumentUnit& unit = unit_of(solution.quantities.outputs[static_cast<std::size_t>(output)]);
        rotary.budget.push_back({name, angle, propagation.standard_uncertainty[output] / unit.si, unit.record,
                                 shares_of(propagation, output)});
    };
    for (Eigen::Index i = 0; i < angles; ++i) {
        for (Eigen::Index c = 0; c < 6; ++c) {
            add(6 * i + c, rotary.error_names[static_cast<std::size_t>(c)],
                measurement.angles_deg[static_cast<std::size_t>(i)]);
        }
    }
    const Eigen::Index first = solution.quantities.set_up;
    for (Eigen::Index i = first; i < first + 4; ++i) {
        add(i, solution.quantities.outputs[static_cast<std::size_t>(i)].name, std::nullopt);
    }
    for (Eigen::Index c = 0; c < 6 && solution.quantities.has_reversal; ++c) {
        add(solution.quantities.reversal + c, "reversal of " + rotary.error_names[static_cast<std::size_t>(c)],
            std::nullopt);
    }
    // One row an error motion: variances are averaged over the angles, so the shares are those of the mean variance.
    const auto summary = [&](const std::string& name, const char* unit_name, double si,
                             const std::vector<Eigen::Index>& outputs) {
        reports::BudgetSummaryRow row;
        row.quantity = name;
        row.unit = unit_name;
        row.shares.assign(budget_sources().size(), 0.0);
        double total = 0.0;
        for (const Eigen::Index output : outputs) {
            const double variance = propagation.covariance(output, output);
            total += variance;
            const std::vector<double> shares = shares_of(propagation, output);
            for (std::size_t s = 0; s < shares.size(); ++s) {
                row.shares[s] += shares[s] * variance;
            }
        }
        row.rms_u = std::sqrt(total / static_cast<double>(outputs.size())) / si;
        for (double& share : row.shares) {
            share = total > 0.0 ? share / total : 0.0;
            row.printed_shares.push_back(gum::percent(share));
        }
        row.printed_rms_u = gum::round_significant(row.rms_u, 2);
        rotary.budget_summary.push_back(std::move(row));
    };
    for (Eigen::Index c = 0; c < 6; ++c) {
        std::vector<Eigen::Index> outputs;
        for (Eigen::Index i = 0; i < angles; ++i) {
            outputs.push_back(6 * i + c);
        }
        const DocumentUnit& unit = c < 3 ? k_um : k_arcsec;
        summary(rotary.error_names[static_cast<std::size_t>(c)], unit.record, unit.si, outputs);
    }
    for (Eigen::Index i = first; i < first + 4; ++i) {
        const gum::OutputQuantity& quantity = solution.quantities.outputs[static_cast<std::size_t>(i)];
        summary(quantity.name, unit_of(quantity).record, unit_of(quantity).si, {i});
    }
}

void fill_adjustment(reports::RotaryTable& rotary, const RotaryTableSolution& solution,
                     const engine::RotaryTableMeasurement& measurement, const engine::EvaluationOptions& options,
                     double k) {
    for (std::size_t j = 0; j < solution.stations.size(); ++j) {
        const engine::StationEstimate& from = solution.stations[j];
        reports::Station station;
        station.name = measurement.stations[j];
        for (std::size_t c = 0; c < 3; ++c) {
            const auto at = static_cast<Eigen::Index>(c);
            station.position_mm[c] = from.position[at] / gum::k_millimetre;
            station.u_mm[c] = from.u[at] / gum::k_millimetre;
            const Printed text = printed(station.position_mm[c], k * station.u_mm[c], k_mm);
            station.printed_position.push_back(text.value);
            station.printed_U.push_back(text.U);
        }
        station.scale_deviation = from.scale_deviation;
        station.u_scale = from.u_scale;
        if (from.u_scale > 0.0) {
            const gum::RoundedPair scale =
                gum::round_to_uncertainty(1e6 * from.scale_deviation, 1e6 * k * from.u_scale);
            station.printed_scale = {scale.value, scale.U, "1e-6"};
        }
        rotary.stations.push_back(std::move(station));
    }
    for (std::size_t d = 0; d < measurement.dead_paths.size(); ++d) {
        const auto at = static_cast<Eigen::Index>(d);
        reports::DeadPath path;
        path.name = measurement.dead_paths[d];
        path.value_mm = solution.dead_paths[at] / gum::k_millimetre;
        path.u_mm = solution.u_dead_paths[at] / gum::k_millimetre;
        path.printed = printed(path.value_mm, k * path.u_mm, k_mm);
        rotary.dead_paths.push_back(std::move(path));
    }
    for (std::size_t m = 0; m < measurement.reflectors.size(); ++m) {
        const auto row = static_cast<Eigen::Index>(m);
        reports::Reflector reflector;
        reflector.name = measurement.reflectors[m];
        for (std::size_t c = 0; c < 3; ++c) {
            const auto at = static_cast<Eigen::Index>(c);
            reflector.position_mm[c] = solution.fixture(row, at) / gum::k_millimetre;
            reflector.u_mm[c] = solution.u_fixture(row, at) / gum::k_millimetre;
            reflector.correction_um[c] = (solution.fixture(row, at) - measurement.fixture(row, at)) / gum::k_micrometre;
            const Printed text = printed(reflector.position_mm[c], k * reflector.u_mm[c], k_mm);
            reflector.printed_correction.push_back(gum::round_to_quantum(reflector.correction_um[c], 2));
            reflector.printed_position.push_back(text.value);
            reflector.printed_U.push_back(text.U);
        }
        rotary.reflectors.push_back(std::move(reflector));
    }

    reports::AdjustmentSummary& adjustment = rotary.adjustment;
    adjustment.method = rotary.method;
    adjustment.observations = solution.observations;
    adjustment.parameters = solution.parameters;
    adjustment.degrees_of_freedom = solution.degrees_of_freedom;
    adjustment.iterations = solution.iterations;
    adjustment.chi_square = solution.chi_square;
    const auto nu = static_cast<double>(solution.degrees_of_freedom);
    adjustment.p_value = nu > 0.0 ? gum::chi_square_upper_tail(solution.chi_square, nu) : 1.0;
    adjustment.condition_number = solution.condition_number;
    adjustment.variance_factor = {1.0, nu > 0.0 ? solution.chi_square / nu : 1.0, "a_priori"};
    adjustment.printed.chi_square = gum::round_to_quantum(adjustment.chi_square, 1);
    adjustment.printed.p_value = gum::round_significant(adjustment.p_value, 2);
    adjustment.printed.variance_factor = gum::round_to_quantum(adjustment.variance_factor.a_posteriori, 3);
    adjustment.printed.condition_number = gum::round_significant(adjustment.condition_number, 2);

    for (const engine::VarianceComponent& from : solution.components) {
        const DocumentUnit& unit = from.angular ? k_arcsec : k_um;
        reports::VarianceComponent component;
        component.name = from.name;
        component.value = from.value / unit.si;
        component.u = from.u / unit.si;
        component.unit = unit.record;
        component.redundancy = from.redundancy;
        component.estimated = from.estimated;
        component.printed = component.u > 0.0 ? printed(component.value, component.u, unit)
                                              : Printed{gum::round_significant(component.value, 2), "", unit.print};
        rotary.variance_components.push_back(std::move(component));
    }

    rotary.outlier_critical_value = options.critical_value;
    rotary.outlier_alpha = measurement.outliers.alpha;
    rotary.printed_critical_value = gum::round_to_quantum(options.critical_value, 2);
    for (std::size_t i = 0; i < solution.reliability.size(); ++i) {
        const engine::LengthObservation& length = measurement.lengths[i];
        const engine::DistanceReliability& from = solution.reliability[i];
        reports::ReliabilityRow row;
        row.station = measurement.stations[length.station];
        row.reflector = measurement.reflectors[length.reflector];
        row.pass = measurement.passes[length.pass];
        row.angle_deg = measurement.angles_deg[length.angle];
        row.residual_um = from.residual / gum::k_micrometre;
        row.redundancy_number = from.redundancy_number;
        row.test_value = from.test_value;
        row.minimal_detectable_bias_um = from.minimal_detectable_bias / gum::k_micrometre;
        row.flagged = from.flagged;
        row.removed = from.removed;
        if (from.flagged) {
            rotary.flagged.push_back({row.station, row.reflector, row.pass, angle_text(row.angle_deg),
                                      gum::round_to_quantum(row.residual_um, 2),
                                      gum::round_to_quantum(row.test_value, 1), row.removed});
        }
        rotary.reliability.push_back(std::move(row));
    }
}

}  // namespace

std::string covariance_csv(const RotaryTableJob& job, const engine::ReportedQuantities& quantities,
                           const Eigen::MatrixXd& covariance) {
    std::string text;
    const std::vector<std::string> names = covariance_order(job, quantities);
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += (i == 0 ? "" : ",") + names[i];
    }
    text += '\n';
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
        const double row_unit = unit_of(quantities.outputs[static_cast<std::size_t>(i)]).si;
        for (Eigen::Index j = 0; j < covariance.cols(); ++j) {
            const double column_unit = unit_of(quantities.outputs[static_cast<std::size_t>(j)]).si;
            // Symmetric to the last bit, as a reader may check.
            const double value = 0.5 * (covariance(i, j) + covariance(j, i)) / (row_unit * column_unit);
            text += (j == 0 ? "" : ",") + shortest(value);
        }
        text += '\n';
    }
    return text;
}

std::vector<std::string> covariance_order(const RotaryTableJob& job, const engine::ReportedQuantities& quantities) {
    std::vector<std::string> names;
    const auto motions = engine::error_motion_names(job.measurement.axis);
    for (const double angle : job.measurement.angles_deg) {
        for (const std::string& motion : motions) {
            names.push_back(motion + "@" + shortest(angle));
        }
    }
    for (std::size_t i = names.size(); i < quantities.outputs.size(); ++i) {
        names.push_back(quantities.outputs[i].name);
    }
    return names;
}

reports::EvaluationRecord rotary_table_record(const RotaryTableJob& job, const engine::EvaluationOptions& options,
                                              const RotaryTableSolution& solution, const gum::Propagation& propagation,
                                              const gum::Propagation* contact_point,
                                              const std::vector<reports::InputFile>& files,
                                              const std::string& covariance_file) {
    const engine::RotaryTableMeasurement& measurement = job.measurement;
    reports::EvaluationRecord record = record_head("rotary_table",
                                                   {.title = job.title,
                                                    .coverage_probability = job.coverage_probability,
                                                    .document = job.document,
                                                    .warnings = job.warnings,
                                                    .notes = solution.notes},
                                                   options_json(job, options), files);

    const auto across = engine::across_axis(measurement.axis);
    const char letter = static_cast<char>('A' + engine::axial_coordinate(measurement.axis));
    for (std::size_t c = 0; c < 4; ++c) {
        const Eigen::Index output = solution.quantities.set_up + static_cast<Eigen::Index>(c);
        const char coordinate = "xyz"[across[c % 2]];
        const std::string description =
            c < 2 ? std::string("offset of the fixture along ") + coordinate + " from the " + letter + " axis"
                  : std::string("tilt of the fixture about ") + coordinate + " against the " + letter + " axis";
        record.results.push_back(result_of(propagation, *solution.model, output,
                                           solution.quantities.outputs[static_cast<std::size_t>(output)].name,
                                           description));
    }

    reports::RotaryTable rotary;
    rotary.axis = std::string(1, letter);
    rotary.datum = measurement.datum == engine::Datum::home ? "home" : "axis_average_line";
    rotary.method = measurement.method == engine::AdjustmentMethod::joint ? "joint" : "sequential";
    rotary.home_angle_deg = measurement.angles_deg[measurement.home];
    rotary.error_names = engine::error_motion_names(measurement.axis);
    rotary.error_units = {"um", "um", "um", "arcsec", "arcsec", "arcsec"};
    fill_set_up(rotary, solution, propagation, measurement.axis);
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        reports::ErrorsAtAngle row;
        row.angle_deg = measurement.angles_deg[i];
        row.printed_angle = angle_text(row.angle_deg);
        for (std::size_t c = 0; c < 6; ++c) {
            row.errors[c] =
                error_value(reported(propagation, static_cast<Eigen::Index>(6 * i + c), c < 3 ? k_um : k_arcsec));
        }
        rotary.errors.push_back(std::move(row));
    }
    for (std::size_t c = 0; c < 6 && solution.quantities.has_reversal; ++c) {
        rotary.reversal.push_back(
            {rotary.error_names[c],
             error_value(reported(propagation, solution.quantities.reversal + static_cast<Eigen::Index>(c),
                                  c < 3 ? k_um : k_arcsec))});
    }
    fill_ranges(rotary, propagation, static_cast<Eigen::Index>(measurement.angles.size()));
    if (!covariance_file.empty()) {
        rotary.covariance_file = covariance_file;
    }
    rotary.covariance_order = covariance_order(job, solution.quantities);
    rotary.covariance_unit = "um and arcsec: each element in the product of the units of its row and column";
    fill_budget(rotary, solution, propagation, measurement);
    const double k = gum::coverage_factor(job.coverage_probability, std::numeric_limits<double>::infinity());
    fill_adjustment(rotary, solution, measurement, options, k);
    record.rotary = std::move(rotary);
    if (contact_point != nullptr) {
        record.comparison = comparison_of(job, *contact_point);
    }
    return record;
}

}  // namespace gumcert::app
