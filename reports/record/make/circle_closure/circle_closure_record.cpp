#include "reports/record/make/circle_closure/circle_closure_record.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "gum/analysis_of_variance.h"
#include "gum/coverage.h"
#include "gum/monte_carlo/convolution.h"
#include "gum/monte_carlo/extreme_uncertainty.h"
#include "gum/propagation.h"
#include "gum/rounding.h"
#include "jobs/circle_closure/circle_closure_statement.h"
#include "reports/record/make/circle_closure/circle_closure_findings.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/make/reported_choice.h"
#include "reports/record/record_kinds.h"
#include "reports/record/reported_result.h"
#include "text/csv_field.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using Eigen::Index;
using engine::CircleClosureMeasurement;
using engine::ClosurePattern;
using jobs::CircleClosureJob;

constexpr double k_accepted_p = 0.001;

Index at(std::size_t i) {
    return static_cast<Index>(i);
}

/// What one output is called.
struct OutputName {
    std::string name, quantity, point, description;
};

std::vector<OutputName> output_names(const CircleClosureJob& job) {
    const std::string table = table_quantity(job);
    std::vector<OutputName> names;
    for (std::size_t j = 0; j < job.measurement.steps; ++j) {
        const std::string point = text::shortest(job.step_angle_deg(j));
        names.push_back({table + "[" + point + "]", table, point, "deviation of the table"});
    }
    for (std::size_t i = 0; i < job.measurement.steps; ++i) {
        const std::string point = text::shortest(job.side_angle_deg(i));
        names.push_back({std::string(k_artefact_quantity) + "[" + point + "]", k_artefact_quantity, point,
                         "deviation of the artefact"});
    }
    for (const auto& [quantity, description] :
         {std::pair(table, "range of the deviations of the table"),
          std::pair(std::string(k_artefact_quantity), "range of the deviations of the artefact")}) {
        const std::string name = "range_" + quantity;
        names.push_back({name, name, "", description});
    }
    return names;
}

/// A row of the budget of one output: a group of inputs.
reports::BudgetRow budget_row(const CircleClosureJob& job, const gum::CircleClosureResult& result, std::size_t group,
                              Index first, Index output) {
    const gum::InputGroup& of = result.model->inputs()[group];
    const gum::Unit own = of.unit == "rad" ? job.unit : gum::Unit();
    const double u = result.propagation.standard_uncertainty(output);
    double contribution = std::sqrt(std::max(result.propagation.budget[group].variance(output), 0.0));
    constexpr double k_rounding = 1e-9;
    if (contribution < k_rounding * u) {
        contribution = 0.0;  // sensitivities that cancel, but for their last digit
    }
    reports::BudgetRow row;
    row.input = of.name;
    row.unit = own.text();
    row.u = shown_significant(own.difference_from_si(std::sqrt(of.covariance.col(0).mean())), k_digits_of_u);
    if (const std::optional<double> nu = finite_or_none(of.degrees_of_freedom)) {
        row.nu = shown_to_quantum(*nu, 0);
    }
    row.type = type_letter(of.evaluation);
    row.distribution = of.distribution;
    row.contribution = shown_significant(job.unit.difference_from_si(contribution), k_digits_of_u);
    row.share = shown_share(contribution * contribution / (u * u));
    row.source = of.source;
    row.role = group == 0 ? "scatter" : "";
    if (of.size() == 1) {
        row.value = shown_significant(own.from_si(of.value(0)), 4);
        row.sensitivity = shown_significant(
            job.unit.difference_from_si(result.propagation.jacobian(output, first)) / own.difference_from_si(1.0), 4);
    }
    return row;
}

/// What it adds to the u of a range that other deviations may be the extreme ones.
reports::BudgetRow row_of_extremes(const CircleClosureJob& job, const gum::Propagation& propagation, Index output) {
    reports::BudgetRow row;
    row.input = row.source = gum::k_which_are_extreme;
    row.unit = job.unit.text();
    row.type = "B";
    row.role = "extremes";
    const double variance = propagation.budget.back().variance(output);
    row.u = row.contribution = shown_significant(job.unit.difference_from_si(std::sqrt(variance)), k_digits_of_u);
    row.share = shown_share(gum::share_of_extremes(propagation, output));
    // The same errors decide it as make the rest of u, so that ν_eff stays: u⁴/ν = u_law⁴/ν + u_x⁴/ν_x of Welch-Satterthwaite.
    const double u2 = std::pow(propagation.standard_uncertainty(output), 2);
    if (const auto nu =
            finite_or_none(propagation.effective_degrees_of_freedom(output) * variance / (2.0 * u2 - variance))) {
        row.nu = shown_to_quantum(*nu, 0);
    }
    return row;
}

reports::Result result_of(const CircleClosureJob& job, const gum::CircleClosureResult& result, const OutputName& name,
                          Index output) {
    const gum::Propagation& propagation = result.propagation;
    const gum::ClosureCoverage& coverage = result.coverage[static_cast<std::size_t>(output)];
    reports::Result out;
    out.name = name.name;
    out.quantity = name.quantity;
    out.point = name.point;
    out.description = name.description;
    out.value = job.unit.from_si(propagation.value(output));
    out.unit = job.unit.text();
    out.u = job.unit.difference_from_si(propagation.standard_uncertainty(output));
    out.nu_eff = finite_or_none(propagation.effective_degrees_of_freedom(output));
    out.k = coverage.k;
    out.coverage_probability = job.coverage_probability;
    out.U = job.unit.difference_from_si(coverage.U);
    out.distribution = coverage.coverage;
    out.coverage = coverage.coverage;
    out.coverage_note = coverage.note;
    const gum::RoundedPair pair = gum::round_to_uncertainty(out.value, *out.U, k_digits_of_u);
    out.printed = {pair.value, pair.U, gum::unit_for_people(out.unit)};
    Index first = 0;
    for (std::size_t group = 0; group < result.model->inputs().size(); ++group) {
        out.budget.push_back(budget_row(job, result, group, first, output));
        first += result.model->inputs()[group].size();
    }
    if (gum::share_of_extremes(propagation, output) > 0.0) {
        out.budget.push_back(row_of_extremes(job, propagation, output));
    }
    out.reported = reports::reported_result(out);
    if (result.monte_carlo && !result.is_range(output)) {
        const auto index = static_cast<std::size_t>(output);
        const gum::MonteCarloResult& trials = result.monte_carlo->result;
        out.monte_carlo =
            monte_carlo_summary(trials.outputs[index], *job.monte_carlo, {trials.trials, trials.stabilised},
                                {[&](double value) { return job.unit.from_si(value); },
                                 [&](double difference) { return job.unit.difference_from_si(difference); }},
                                result.monte_carlo->validations[index]);
        report_result(out, job.coverage);
    }
    return out;
}

// ---- the section of its own -----------------------------------------------------------------------------------------

reports::ClosureTestRow test_row(const std::string& name, const engine::ClosureTest& test, double p_value) {
    constexpr double k_least_printed = 1e-4;
    reports::ClosureTestRow row;
    row.name = name;
    row.statistic = shown_significant(test.statistic, 3);
    row.nu = shown_to_quantum(test.nu, 0);
    if (const std::optional<double> nu = finite_or_none(test.nu_reference)) {
        row.nu_reference = shown_to_quantum(*nu, 0);
    }
    row.p_value = {p_value, p_value < k_least_printed
                                ? "< 0.0001"
                                : gum::round_significant_beside(p_value, k_digits_of_u, {k_accepted_p})};
    row.accepted = p_value >= k_accepted_p;
    return row;
}

double p_value_of(const engine::ClosureTest& test) {
    return gum::f_upper_tail(test.statistic, test.nu, test.nu_reference);
}

/// The largest residual, as the square of a t with one degree of freedom less than the residuals have, and its
/// probability among all readings.
std::optional<reports::ClosureTestRow> test_of_readings(const engine::CircleClosureSolution& solution) {
    const double nu = solution.degrees_of_freedom - 1.0;
    const double s = solution.residual_standard_deviation;
    if (!(nu >= 1.0) || !(s > 0.0)) {
        return std::nullopt;
    }
    constexpr double k_least_redundancy = 1e-6;
    double largest = 0.0;
    for (Index r = 0; r < solution.residuals.size(); ++r) {
        if (solution.redundancy(r) > k_least_redundancy) {
            largest = std::max(largest, std::pow(solution.residuals(r) / s, 2) / solution.redundancy(r));
        }
    }
    constexpr double k_most = 1e12;
    const double left = solution.degrees_of_freedom - largest;
    const engine::ClosureTest test{
        .statistic = left > 0.0 ? std::min(largest * nu / left, k_most) : k_most, .nu = 1.0, .nu_reference = nu};
    return test_row("reading", test, std::min(1.0, static_cast<double>(solution.residuals.size()) * p_value_of(test)));
}

/// Closing reading less first reading of every series that has both; [rad], in the sense of the table.
std::vector<std::optional<double>> misclosures(const CircleClosureMeasurement& m) {
    std::vector<std::optional<double>> first(m.series.size());
    std::vector<std::optional<double>> last(m.series.size());
    for (const engine::ClosureReading& reading : m.readings) {
        if (reading.step == 0) {
            first[reading.series] = m.sense * reading.value;
        } else if (reading.step == m.steps) {
            last[reading.series] = m.sense * reading.value;
        }
    }
    std::vector<std::optional<double>> all(m.series.size());
    for (std::size_t s = 0; s < all.size(); ++s) {
        if (first[s] && last[s]) {
            all[s] = *last[s] - *first[s];
        }
    }
    return all;
}

/// Whether the mean closing difference is 0, against the scatter of the readings and what the job states of a drift: an effect
/// on the turn is in all series alike, and the results have its uncertainty.
std::optional<reports::ClosureTestRow> test_of_closing(const CircleClosureMeasurement& m,
                                                       const engine::CircleClosureSolution& solution) {
    double sum = 0.0;
    double count = 0.0;
    for (const std::optional<double>& misclosure : misclosures(m)) {
        sum += misclosure.value_or(0.0);
        count += misclosure ? 1.0 : 0.0;
    }
    if (count == 0.0 || m.removes_drift) {
        return std::nullopt;
    }
    const double scatter = 2.0 * solution.u_reading * solution.u_reading / count;
    std::vector<gum::UncertaintyContribution> contributions{{std::sqrt(scatter), solution.nu_reading}};
    double variance = scatter;
    double stated = 0.0;
    for (const engine::ClosureEffect& effect : m.effects) {
        if (effect.pattern == ClosurePattern::turn) {
            stated += m.sense * effect.value;
            variance += effect.u * effect.u;
            contributions.push_back({effect.u, effect.degrees_of_freedom});
        }
    }
    const engine::ClosureTest test{.statistic = std::pow(sum / count - stated, 2) / variance,
                                   .nu = 1.0,
                                   .nu_reference = gum::effective_degrees_of_freedom(contributions)};
    return test_row("misclosure", test, p_value_of(test));
}

void fill_tests(const CircleClosureMeasurement& m, const engine::CircleClosureSolution& solution,
                reports::CircleClosure& closure) {
    if (solution.against_stated) {
        closure.tests.push_back(test_row("stated", *solution.against_stated, p_value_of(*solution.against_stated)));
    }
    if (solution.against_repetition) {
        closure.tests.push_back(
            test_row("repetition", *solution.against_repetition, p_value_of(*solution.against_repetition)));
    }
    for (auto& test : {test_of_readings(solution), test_of_closing(m, solution)}) {
        if (test) {
            closure.tests.push_back(*test);
        }
    }
}

void fill_series(const CircleClosureJob& job, const engine::CircleClosureSolution& solution,
                 reports::CircleClosure& closure) {
    const CircleClosureMeasurement& m = job.measurement;
    const std::vector<std::optional<double>> closing = misclosures(m);
    const auto shown = [&](double si) { return shown_to_quantum(job.unit.difference_from_si(si), 4); };
    for (std::size_t s = 0; s < m.series.size(); ++s) {
        reports::ClosureSeriesRow row;
        row.position = static_cast<std::int64_t>(m.series[s].position);
        row.repetition = m.series[s].repetition;
        row.zero = shown(solution.zero(at(s)));
        if (m.removes_drift) {
            row.drift = shown(solution.drift(at(s)));
        }
        if (closing[s]) {
            row.misclosure = shown(*closing[s]);
        }
        double sum = 0.0;
        for (std::size_t r = 0; r < m.readings.size(); ++r) {
            if (m.readings[r].series == s) {
                ++row.readings;
                sum += std::pow(solution.residuals(at(r)), 2);
            }
        }
        row.residual_rms = shown_significant(
            job.unit.difference_from_si(std::sqrt(sum / static_cast<double>(row.readings))), k_digits_of_u);
        closure.series.push_back(std::move(row));
    }
}

void fill_residuals(const CircleClosureJob& job, const engine::CircleClosureSolution& solution,
                    reports::CircleClosure& closure) {
    const CircleClosureMeasurement& m = job.measurement;
    for (std::size_t r = 0; r < m.readings.size(); ++r) {
        const engine::ClosureReading& reading = m.readings[r];
        const engine::ClosureSeries& series = m.series[reading.series];
        reports::ClosureResidualRow row;
        row.position = static_cast<std::int64_t>(series.position);
        row.repetition = series.repetition;
        row.step = static_cast<std::int64_t>(reading.step);
        row.side = static_cast<std::int64_t>(m.side_at(series.position, reading.step));
        row.reading = {job.unit.from_si(reading.value), job.readings_as_stated[r]};
        row.residual = shown_to_quantum(job.unit.difference_from_si(solution.residuals(at(r))), 4);
        row.redundancy = solution.redundancy(at(r));
        closure.residuals.push_back(std::move(row));
    }
}

reports::CircleClosure closure_of(const CircleClosureJob& job, const gum::CircleClosureResult& result) {
    const CircleClosureMeasurement& m = job.measurement;
    const engine::CircleClosureSolution& solution = *result.solution;
    reports::CircleClosure closure;
    closure.table = table_quantity(job);
    closure.artefact = k_artefact_quantity;
    closure.artefact_description = job.artefact;
    closure.unit = job.unit.text();
    closure.numbering = jobs::word_of(jobs::k_closure_numberings, m.against);
    closure.sense = m.sense > 0.0 ? "positive" : "negative";
    closure.drift = m.removes_drift ? "linear" : "none";
    closure.steps = static_cast<std::int64_t>(m.steps);
    std::set<std::size_t> positions;
    for (const engine::ClosureSeries& series : m.series) {
        positions.insert(series.position);
    }
    closure.positions = static_cast<std::int64_t>(positions.size());
    for (std::size_t i = 0; i < m.steps; ++i) {
        closure.step_angles_deg.push_back(job.step_angle_deg(i));
        closure.side_angles_deg.push_back(job.side_angle_deg(i));
    }
    const auto without_closing = std::count_if(m.readings.begin(), m.readings.end(),
                                               [&](const auto& reading) { return reading.step < m.steps; });
    closure.full =
        positions.size() == m.steps && static_cast<std::size_t>(without_closing) == m.series.size() * m.steps;
    closure.readings = static_cast<std::int64_t>(m.readings.size());
    closure.degrees_of_freedom = solution.degrees_of_freedom;
    closure.unknowns = closure.readings - static_cast<std::int64_t>(solution.degrees_of_freedom);
    closure.residual_standard_deviation =
        shown_significant(job.unit.difference_from_si(solution.residual_standard_deviation), k_digits_of_u);
    closure.u_reading = shown_significant(job.unit.difference_from_si(solution.u_reading), k_digits_of_u);
    closure.nu_reading = finite_or_none(solution.nu_reading);
    closure.u_reading_from = m.uses_stated_u ? "stated" : "residuals";
    closure.condition_number = solution.condition_number;
    closure.printed_unit = gum::unit_for_people(closure.unit);
    fill_tests(m, solution, closure);
    fill_series(job, solution, closure);
    fill_residuals(job, solution, closure);
    return closure;
}

// ---- covariance -----------------------------------------------------------------------------------------------------

Eigen::MatrixXd covariance_in_unit(const CircleClosureJob& job, const gum::CircleClosureResult& result) {
    const double scale = job.unit.difference_from_si(1.0);
    const Eigen::MatrixXd& V = result.propagation.covariance;
    return (0.5 * scale * scale) * (V + V.transpose());
}

reports::ResultCovariance covariance_of(const CircleClosureJob& job, const gum::CircleClosureResult& result,
                                        const std::string& file) {
    const auto rows_of = [](const Eigen::MatrixXd& matrix) {
        std::vector<std::vector<double>> rows;
        for (Index i = 0; i < matrix.rows(); ++i) {
            const Eigen::VectorXd row = matrix.row(i).transpose();
            rows.emplace_back(row.data(), row.data() + row.size());
        }
        return rows;
    };
    reports::ResultCovariance out;
    out.names = circle_closure_result_names(job);
    out.units.assign(out.names.size(), job.unit.text());
    out.file = file;
    out.method = "law_of_propagation";
    if (!file.empty()) {
        return out;
    }
    const Eigen::MatrixXd V = covariance_in_unit(job, result);
    const Eigen::MatrixXd correlation = gum::correlation_matrix(V);
    out.matrix = rows_of(V);
    out.correlation.number = rows_of(correlation);
    for (Index i = 0; i < correlation.rows(); ++i) {
        std::vector<std::string> row;
        for (Index j = 0; j < correlation.cols(); ++j) {
            row.push_back(gum::round_to_quantum(correlation(i, j), 3));
        }
        out.correlation.text.push_back(std::move(row));
    }
    return out;
}

/// The equations as a document prints them. m: readings, e: what the effects add to them.
std::vector<std::string> equations_of(const CircleClosureJob& job) {
    const CircleClosureMeasurement& m = job.measurement;
    const std::string corrected = "(1 + c)*m(k, j) - e(k, j)";
    const std::string reading = m.sense > 0.0 ? corrected : "-(" + corrected + ")";
    return {reading + " = " + table_quantity(job) + "(j) " + (m.against ? "- P(k + j)" : "+ P(k - j)") + " + a(k)" +
                (m.removes_drift ? " + b(k)*j/n" : ""),
            "sum " + table_quantity(job) + "(j) = 0, sum P(i) = 0"};
}

nlohmann::json options_json(const CircleClosureJob& job) {
    const CircleClosureMeasurement& m = job.measurement;
    return {{"closure",
             {{"method", "least squares, the zeros of the series eliminated, eigenvalues of the normal equations"},
              {"drift", m.removes_drift ? "linear" : "none"},
              {"u_reading", m.uses_stated_u ? "stated" : "residuals"},
              {"least_p_value", k_accepted_p}}},
            {"monte_carlo", monte_carlo_json(job.monte_carlo)},
            {"coverage", gum::coverage_choice_name(job.coverage)}};
}

}  // namespace

std::string table_quantity(const CircleClosureJob& job) {
    return job.axis ? std::string("E") + *job.axis + *job.axis : "T";
}

std::vector<std::string> circle_closure_result_names(const CircleClosureJob& job) {
    std::vector<std::string> names;
    for (const OutputName& output : output_names(job)) {
        names.push_back(output.name);
    }
    return names;
}

reports::EvaluationRecord circle_closure_record(const CircleClosureJob& job, const gum::CircleClosureResult& result,
                                                const std::vector<reports::InputFile>& files,
                                                const std::string& covariance_file) {
    reports::EvaluationRecord record = record_head(reports::k_circle_closure_kind,
                                                   {.title = job.title,
                                                    .coverage_probability = job.coverage_probability,
                                                    .document = job.document,
                                                    .warnings = job.warnings,
                                                    .notes = {}},
                                                   options_json(job), files);
    record.model = reports::ModelSummary{.equations = equations_of(job), .unknowns = {}};
    const std::vector<OutputName> names = output_names(job);
    for (std::size_t i = 0; i < names.size(); ++i) {
        record.results.push_back(result_of(job, result, names[i], at(i)));
    }
    record.covariance = covariance_of(job, result, covariance_file);
    record.circle_closure = closure_of(job, result);
    const bool states_drift =
        std::any_of(job.measurement.effects.begin(), job.measurement.effects.end(),
                    [](const engine::ClosureEffect& effect) { return effect.pattern == ClosurePattern::turn; });
    const std::vector<gum::Diagnostic> remarks = circle_closure_remarks(record, states_drift);
    record.diagnostics.insert(record.diagnostics.end(), remarks.begin(), remarks.end());
    return record;
}

std::map<std::string, std::function<certificate::ResultDistribution()>> circle_closure_distributions(
    const CircleClosureJob& job, const gum::CircleClosureResult& result) {
    std::map<std::string, std::function<certificate::ResultDistribution()>> distributions;
    const std::vector<std::string> names = circle_closure_result_names(job);
    const auto propagation = std::make_shared<const gum::Propagation>(result.propagation);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool is_convolution = result.coverage[i].coverage == "convolution";
        if (!is_convolution && gum::is_normal_or_student(*result.model, *propagation, at(i))) {
            continue;
        }
        if (gum::share_of_extremes(*propagation, at(i)) > 0.0) {
            continue;  // the convolution is that of the two deviations that are extreme in the estimates
        }
        const auto make = [model = result.model, propagation, i, unit = job.unit]() -> certificate::ResultDistribution {
            const auto terms = gum::convolution_terms(*model, *propagation, at(i));
            if (!terms) {
                return {};
            }
            const gum::ConvolutionDistribution distribution(*terms);
            const double centre = propagation->value(at(i));
            return {.function = [=](double x) { return distribution(unit.to_si(x) - centre); },
                    .below = {},
                    .least_probability = distribution.least_probability()};
        };
        distributions.emplace(names[i], make);
    }
    return distributions;
}

std::string circle_closure_covariance_csv(const CircleClosureJob& job, const gum::CircleClosureResult& result) {
    const std::vector<std::string> names = circle_closure_result_names(job);
    const Eigen::MatrixXd V = covariance_in_unit(job, result);
    std::string csv = "result";
    for (const std::string& name : names) {
        csv += "," + text::csv_field(name);
    }
    csv += "\n";
    for (Index i = 0; i < V.rows(); ++i) {
        csv += text::csv_field(names[static_cast<std::size_t>(i)]);
        for (Index j = 0; j < V.cols(); ++j) {
            csv += "," + text::shortest(V(i, j));
        }
        csv += "\n";
    }
    return csv;
}

}  // namespace gumcert::reports
