#include "reports/record/make/rotary_table/rotary_table_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "gum/coverage.h"
#include "gum/rounding.h"
#include "jobs/rotary_table/rotary_table_words.h"
#include "reports/record/make/comparison/refuted_side.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/make/reported_choice.h"
#include "reports/record/make/rotary_table/adjustment_record.h"
#include "reports/record/make/rotary_table/document_units.h"
#include "reports/record/make/rotary_table/location_error_record.h"
#include "reports/record/make/rotary_table/rotary_evidence.h"
#include "reports/record/make/rotary_table/rotary_findings.h"
#include "reports/record/make/rotary_table/rotary_monte_carlo_record.h"
#include "reports/record/make/rotary_table/table_parameter_record.h"
#include "reports/record/record_kinds.h"
#include "reports/record/reported_result.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using engine::RotaryTableSolution;
using jobs::RotaryTableJob;
using reports::Printed;

const std::vector<std::string>& budget_sources() {
    static const std::vector<std::string> sources{"length noise", "scale",           "dead path",
                                                  "fixture CMM",  "fixture thermal", "table repeatability"};
    return sources;
}

/// Shares of one output in the order of `budget_sources`; 0 for a source that the measurement does not have.
std::vector<double> shares_of(const gum::UncertaintyBudget& propagation, Eigen::Index output) {
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

reports::Result result_of(const gum::QuantityUncertainty& uncertainty, const gum::MeasurementModel& model,
                          Eigen::Index output, const std::string& name, const std::string& description) {
    const gum::UncertaintyBudget& propagation = uncertainty.budget;
    const DocumentUnit& unit = unit_of(model.outputs()[static_cast<std::size_t>(output)]);
    const reports::StatedValue numbers = stated_value(propagation, output, unit);
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
    result.distribution = numbers.nu_eff ? "student_t" : "normal";
    result.printed = numbers.printed;
    for (std::size_t g = 0; g < model.inputs().size(); ++g) {
        const gum::InputGroup& group = model.inputs()[g];
        const Eigen::VectorXd variance = group.is_diagonal() ? Eigen::VectorXd(group.covariance.col(0))
                                                             : Eigen::VectorXd(group.covariance.diagonal());
        reports::BudgetRow row;
        row.input = group.name;
        const DocumentUnit input_unit = budget_unit(group.unit);
        row.unit = input_unit.record;
        row.u =
            shown_significant(std::sqrt(variance.mean()) / input_unit.si, 2);  // of one typical quantity of the group
        row.nu.number = finite_or_none(group.degrees_of_freedom);
        row.type = type_letter(group.evaluation);
        row.distribution = group.distribution;
        row.contribution = shown_significant(std::sqrt(propagation.budget[g].variance[output]) / unit.si, 2);
        row.share = shown_share(propagation.budget[g].share[output]);
        row.source = group.source;
        if (group.size() == 1) {
            row.value.number = group.value[0] / input_unit.si;
            row.sensitivity.number = uncertainty.sensitivity[g][output] * input_unit.si / unit.si;
        }
        result.budget.push_back(std::move(row));
    }
    result.reported = reports::reported_result(result);
    return result;
}

nlohmann::json options_json(const RotaryTableJob& job, const engine::EvaluationOptions& options) {
    const engine::RotaryTableMeasurement& measurement = job.measurement;
    using jobs::word_of;
    return {{"solver",
             {{"linear_solver", "Ceres, Levenberg-Marquardt with Schur complement, one thread, then Gauss-Newton"},
              {"max_iterations", options.solver.max_iterations},
              {"max_refinements", options.solver.max_refinements},
              {"step_tolerance", options.solver.step_tolerance},
              {"rank_tolerance", options.solver.rank_tolerance}}},
            {"variance_components",
             {{"method", "restricted maximum likelihood, Fisher scoring"},
              {"length_noise", word_of(jobs::k_length_noises, measurement.estimate_length_noise)},
              {"table_repeatability", word_of(jobs::k_repeatability_modes, measurement.table_repeatability.mode)},
              {"fixture", word_of(jobs::k_fixture_components, measurement.fixture_component)},
              {"max_iterations", options.max_component_iterations},
              {"tolerance", options.component_tolerance}}},
            {"fixture",
             {{"uncertainty", job.fixture_budget ? std::string_view("budget")
                                                 : word_of(jobs::k_fixture_uncertainties, job.source_paper_fixture)},
              {"distribution", word_of(jobs::k_shapes, measurement.fixture_shape)}}},
            {"monte_carlo", monte_carlo_json(job.monte_carlo)},
            {"coverage", gum::coverage_choice_name(job.coverage)},
            {"scale_model", word_of(jobs::k_scale_models, measurement.length_uncertainty.scale_model)},
            {"outliers",
             {{"test", word_of(jobs::k_outlier_tests, measurement.outliers.test)},
              {"alpha", measurement.outliers.alpha},
              {"action", word_of(jobs::k_outlier_actions, measurement.outliers.action)},
              {"critical_value_of_normal_distribution", options.critical_value},
              {"non_centrality", options.non_centrality}}}};
}

void fill_set_up(reports::RotaryTable& rotary, const RotaryTableSolution& solution,
                 const gum::UncertaintyBudget& propagation, engine::RotaryAxis axis) {
    const auto across = engine::across_axis(axis);
    rotary.set_up.printed_O.fill({"0", "", k_um.print});
    rotary.set_up.printed_S.fill({"0", "", k_arcsec.print});
    rotary.axis_in_fixture = rotary.set_up;
    const auto place = [&](Eigen::Index output, const DocumentUnit& unit, std::size_t coordinate, auto value, auto u,
                           auto U, auto text) {
        const reports::StatedValue numbers = stated_value(propagation, output, unit);
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

void fill_budget(reports::RotaryTable& rotary, const RotaryTableSolution& solution,
                 const gum::UncertaintyBudget& propagation, const engine::RotaryTableMeasurement& measurement) {
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
        row.shares.number.assign(budget_sources().size(), 0.0);
        double total = 0.0;
        for (const Eigen::Index output : outputs) {
            const double variance = std::pow(propagation.standard_uncertainty[output], 2);
            total += variance;
            const std::vector<double> shares = shares_of(propagation, output);
            for (std::size_t s = 0; s < shares.size(); ++s) {
                row.shares.number[s] += shares[s] * variance;
            }
        }
        row.rms_u = shown_significant(std::sqrt(total / static_cast<double>(outputs.size())) / si, 2);
        for (double& share : row.shares.number) {
            share = total > 0.0 ? share / total : 0.0;
            row.shares.text.push_back(gum::percent(share));
        }
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

void fill_exclusions(reports::RotaryTable& rotary, const RotaryTableJob& job) {
    for (const jobs::Exclusion& from : job.exclusions) {
        reports::ExcludedDistances row;
        row.station = from.station.value_or("");
        row.reflector = from.reflector.value_or("");
        row.pass = from.pass.value_or("");
        row.direction = from.direction.value_or("");
        row.angle = from.angle_deg ? text::shortest(*from.angle_deg) : "";
        if (from.lines) {
            const auto& [first, last] = *from.lines;
            row.lines = std::to_string(first) + (first == last ? "" : "–" + std::to_string(last));
        }
        row.count = static_cast<std::int64_t>(from.count);
        row.reason = from.reason;
        rotary.exclusions.push_back(std::move(row));
    }
}

/// What a reader must know of outlying distances before the numbers.
void note_outliers(reports::EvaluationRecord& record, const engine::OutlierOptions& options) {
    const std::size_t found = record.rotary->flagged.size();
    if (found == 0) {
        return;
    }
    const bool removed = options.action == engine::OutlierAction::remove;
    record.diagnostics.push_back({removed ? "GC-OUTLIER-0005" : "GC-OUTLIER-0004", "outlying distances",
                                  std::to_string(found) + (found == 1 ? " distance is" : " distances are") +
                                      " outlying, and " + (removed ? "left out of the result" : "used in the result"),
                                  "the largest test value above the critical one marks a distance, one at a time",
                                  removed ? "" : "look for their cause, or set outliers.action to \"remove\"",
                                  removed ? gum::Severity::note : gum::Severity::warning});
}

}  // namespace

std::vector<std::string> covariance_order(const RotaryTableJob& job, const engine::ReportedQuantities& quantities) {
    std::vector<std::string> names;
    const auto motions = engine::error_motion_names(job.measurement.axis);
    for (const double angle : job.measurement.angles_deg) {
        for (const std::string& motion : motions) {
            names.push_back(motion + "@" + text::shortest(angle));
        }
    }
    for (std::size_t i = names.size(); i < quantities.outputs.size(); ++i) {
        names.push_back(quantities.outputs[i].name);
    }
    return names;
}

reports::EvaluationRecord rotary_table_record(const RotaryTableJob& job, const gum::RotaryTableResult& result,
                                              const RotaryRecordParts& parts,
                                              const std::vector<reports::InputFile>& files,
                                              const std::string& covariance_file) {
    const engine::RotaryTableMeasurement& measurement = job.measurement;
    const RotaryTableSolution& solution = result.solution;
    const gum::UncertaintyBudget& propagation = result.reported.budget;
    reports::EvaluationRecord record = record_head(reports::k_rotary_table_kind,
                                                   {.title = job.title,
                                                    .coverage_probability = job.coverage_probability,
                                                    .document = job.document,
                                                    .warnings = job.warnings,
                                                    .notes = solution.notes},
                                                   options_json(job, result.options), files);

    const auto across = engine::across_axis(measurement.axis);
    const char letter = static_cast<char>('A' + engine::axial_coordinate(measurement.axis));
    for (std::size_t c = 0; c < 4; ++c) {
        const Eigen::Index output = solution.quantities.set_up + static_cast<Eigen::Index>(c);
        const char coordinate = "xyz"[across[c % 2]];
        const std::string description =
            c < 2 ? std::string("offset of the fixture along ") + coordinate + " from the " + letter + " axis"
                  : std::string("tilt of the fixture about ") + coordinate + " against the " + letter + " axis";
        record.results.push_back(result_of(result.reported, *solution.model, output,
                                           solution.quantities.outputs[static_cast<std::size_t>(output)].name,
                                           description));
    }

    reports::RotaryTable rotary;
    rotary.axis = std::string(1, letter);
    rotary.datum = jobs::word_of(jobs::k_datums, measurement.datum);
    rotary.method = jobs::word_of(jobs::k_methods, measurement.method);
    rotary.home_angle_deg = measurement.angles_deg[measurement.home];
    rotary.error_names = engine::error_motion_names(measurement.axis);
    rotary.error_units = {"um", "um", "um", "arcsec", "arcsec", "arcsec"};
    fill_set_up(rotary, solution, propagation, measurement.axis);
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        reports::ErrorsAtAngle row;
        row.angle_deg = {measurement.angles_deg[i], text::shortest(measurement.angles_deg[i])};
        for (std::size_t c = 0; c < 6; ++c) {
            row.errors[c] = stated_value(propagation, static_cast<Eigen::Index>(6 * i + c), c < 3 ? k_um : k_arcsec);
        }
        rotary.errors.push_back(std::move(row));
    }
    for (std::size_t c = 0; c < 6 && solution.quantities.has_reversal; ++c) {
        rotary.reversal.push_back(
            {rotary.error_names[c],
             stated_value(propagation, solution.quantities.reversal + static_cast<Eigen::Index>(c),
                          c < 3 ? k_um : k_arcsec)});
    }
    fill_table_parameters(rotary, *result.parameter_model, measurement, result.parameters, result.positioning);
    if (result.location_errors) {
        fill_location_errors(rotary, job, *result.location_errors);
    }
    if (!covariance_file.empty()) {
        rotary.covariance_file = covariance_file;
    }
    rotary.covariance_order = covariance_order(job, solution.quantities);
    rotary.covariance_unit = "um and arcsec: each element in the product of the units of its row and column";
    fill_budget(rotary, solution, propagation, measurement);
    const double k = gum::coverage_factor(job.coverage_probability, std::numeric_limits<double>::infinity());
    fill_adjustment(rotary, solution, measurement, propagation, k);
    rotary.fixture_budget = parts.fixture_budget;
    fill_evidence(rotary, job, result);
    fill_exclusions(rotary, job);
    record.rotary = std::move(rotary);
    record.diagnostics.insert(record.diagnostics.end(), result.fixture.notes.begin(), result.fixture.notes.end());
    if (result.location_errors) {
        const std::vector<gum::Diagnostic>& notes = result.location_errors->notes;
        record.diagnostics.insert(record.diagnostics.end(), notes.begin(), notes.end());
    }
    note_outliers(record, measurement.outliers);
    const std::vector<gum::Diagnostic> remarks = rotary_remarks(record);
    record.diagnostics.insert(record.diagnostics.end(), remarks.begin(), remarks.end());
    record.comparison = parts.comparison;
    if (record.comparison) {
        withhold_agreement(refuted_by(rotary_findings(record), {}, {}), *record.comparison);
    }
    if (result.monte_carlo) {
        fill_monte_carlo(record, job, result);
        report_rotary_results(record, job.coverage);
    }
    return record;
}

}  // namespace gumcert::reports
