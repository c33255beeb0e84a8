#include "reports/record/make/budget/budget_record.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "gum/budget/joint_region.h"
#include "gum/budget/reported_covariance.h"
#include "gum/budget/zero_uncertainty.h"
#include "gum/quantity/decimal_rounding.h"
#include "gum/quantity/special_values.h"
#include "gum/rounding.h"
#include "jobs/budget/budget_results.h"
#include "reports/record/make/budget/budget_findings.h"
#include "reports/record/make/budget/budget_fit_record.h"
#include "reports/record/make/budget/budget_readings.h"
#include "reports/record/make/budget/budget_reported_result.h"
#include "reports/record/make/budget/budget_texts.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/record_kinds.h"
#include "text/csv_field.h"
#include "text/lists.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using gum::BudgetInput;
using gum::StatedQuantity;
using gum::Unit;
using jobs::BudgetJob;
using reports::BudgetRow;
using reports::Printed;

Printed printed_result(double value, std::optional<double> U, double u, const std::string& unit,
                       gum::RoundingMode rounding) {
    const std::string shown = gum::unit_for_people(unit);
    if (U && *U > 0.0) {
        const gum::RoundedPair pair = gum::round_to_uncertainty(value, *U, reports::k_digits_of_u, rounding);
        return {pair.value, pair.U, shown};
    }
    return {printed_estimate(value, u), U ? "0" : "", shown};
}

/// An exact value with the digits that double precision holds: 0.3 for 0.1 + 0.2.
/// \param lost  what the rounding of the numbers that it comes from may be
double held_digits(double value, double lost) {
    constexpr int k_digits = 15;
    int digits = k_digits;
    if (value == 0.0 || value == std::floor(value)) {
        return value;
    }
    if (lost > 0.0) {
        const double count = std::floor(std::log10(std::abs(value))) - std::floor(std::log10(2.0 * lost));
        digits = static_cast<int>(std::clamp(count, 1.0, static_cast<double>(k_digits)));
    }
    const std::string text = gum::round_significant(value, digits);
    double held = value;
    std::from_chars(text.data(), text.data() + text.size(), held);
    return held;
}

/// \param si           of the input or of one of its components
/// \param sensitivity  coherent SI
BudgetRow budget_row(const std::string& name, const Unit& unit, const gum::InputTotal& si, double sensitivity,
                     const Unit& result_unit, double result_u) {
    BudgetRow row;
    row.input = name;
    row.unit = unit.text();
    const double value = unit.from_si(si.value);
    const double u = unit.difference_from_si(si.u);
    row.value = {value, printed_estimate(value, u)};
    row.u = shown_significant(u, reports::k_digits_of_u);
    row.nu = shown_degrees_of_freedom(si.degrees_of_freedom);
    row.sensitivity = shown_significant(result_unit.difference_from_si(sensitivity * unit.difference_to_si(1.0)), 4);
    row.contribution =
        shown_significant(result_unit.difference_from_si(std::abs(sensitivity) * si.u), reports::k_digits_of_u);
    const double ratio = result_u > 0.0 ? std::abs(sensitivity) * si.u / result_u : 0.0;  // nothing to share of 0
    row.share = shown_share(ratio * ratio);
    return row;
}

/// Says of which standard the value of a row is, by which certificate.
const jobs::StandardComponent* name_standard(BudgetRow& row, const StatedQuantity& component, const BudgetJob& job) {
    const auto of = job.standard_components.find({component.name, component.source});
    if (of == job.standard_components.end()) {
        return nullptr;
    }
    row.standard = of->second.standard;
    row.certificate = of->second.certificate;
    return &of->second;
}

/// Says what a component is that the program named.
void name_part(BudgetRow& row, const StatedQuantity& component, const BudgetJob& job) {
    if (const jobs::StandardComponent* const of = name_standard(row, component, job)) {
        row.part = of->kind;
        row.since = of->since;
    } else if (job.own_components.contains(component.name)) {
        row.part = component.name;
    }
}

/// Whether a symbol has a row in the budgets of a point: of a section, where its equations use it.
bool has_row(const gum::BudgetPointResult& point, std::size_t symbol) {
    return !point.section || point.model->is_of_symbols() || point.model->uses(symbol);
}

/// The budget of one output at one point: a row an input, with rows of its components inside.
std::vector<BudgetRow> budget_rows(const BudgetJob& job, const gum::BudgetResult& result,
                                   const gum::BudgetPointResult& point, Eigen::Index output, const Unit& unit) {
    // All quantities of a symbol have its sensitivity.
    std::vector<double> sensitivity(result.symbols.size(), 0.0);
    const std::vector<gum::BudgetQuantity>& quantities = point.model->quantities();
    for (std::size_t q = 0; q < quantities.size(); ++q) {
        sensitivity[quantities[q].symbol] = point.propagation.jacobian(output, static_cast<Eigen::Index>(q));
    }
    const double u = point.propagation.standard_uncertainty(output);
    std::vector<BudgetRow> rows;
    for (std::size_t i = 0; i < job.inputs.size(); ++i) {
        if (!has_row(point, i)) {
            continue;
        }
        const BudgetInput& input = gum::input_at(job, i, point.point);
        const gum::InputTotal total = gum::input_total(input);
        const StatedQuantity& first = input.components.front();
        BudgetRow row = budget_row(input.name, input.unit, total, sensitivity[i], unit, u);
        row.type = reports::type_letter(first.evaluation);
        row.source = first.source;
        (void)name_standard(row, first, job);
        row.distribution = std::string(gum::distribution_name(first.distribution.kind));
        if (input.components.size() == 1) {
            row.value = {first.stated_value, printed_estimate(first.stated_value, row.u.number)};
        } else {
            row.distribution = "sum";
            for (const StatedQuantity& component : input.components) {
                const gum::InputTotal alone{component.value, component.u, component.degrees_of_freedom};
                BudgetRow part = budget_row(component.name, input.unit, alone, sensitivity[i], unit, u);
                part.value = {component.stated_value, printed_estimate(component.stated_value, part.u.number)};
                part.type = reports::type_letter(component.evaluation);
                part.source = component.source;
                name_part(part, component, job);
                part.distribution = std::string(gum::distribution_name(component.distribution.kind));
                if (component.evaluation == gum::Evaluation::type_b) {
                    row.type = "B";
                }
                row.components.push_back(std::move(part));
            }
        }
        rows.push_back(std::move(row));
    }
    std::size_t symbol = job.inputs.size();
    for (std::size_t f = 0; f < job.fits.size(); ++f) {
        const auto p = static_cast<Eigen::Index>(job.fits[f].parameters.size());
        const Eigen::VectorXd c = Eigen::Map<const Eigen::VectorXd>(sensitivity.data() + symbol, p);
        bool is_shown = false;
        for (Eigen::Index i = 0; i < p; ++i) {
            is_shown = has_row(point, symbol++) || is_shown;
        }
        if (is_shown) {
            rows.push_back(fit_row(job.fits[f], result.fits[f], c, unit, u));
        }
    }
    if (!point.model->is_of_symbols()) {
        return rows;
    }
    // Without equations a result is one of the inputs, or a parameter: its budget has no other rows.
    const std::string& own = point.outputs[static_cast<std::size_t>(output)].name;
    std::erase_if(rows, [&](const BudgetRow& row) { return row.role.empty() && row.input != own; });
    std::erase_if(rows, [&](const BudgetRow& row) {
        return !row.role.empty() && std::none_of(row.components.begin(), row.components.end(),
                                                 [&](const BudgetRow& part) { return part.input == own; });
    });
    for (BudgetRow& row : rows) {
        std::erase_if(row.components,
                      [&](const BudgetRow& part) { return part.role == "fit_parameter" && part.input != own; });
    }
    return rows;
}

/// The part of the variance that the rows do not show, where inputs are correlated.
/// \param inputs  of the job
std::optional<reports::CorrelationRow> correlation_row(const gum::BudgetPointResult& point,
                                                       const std::vector<BudgetRow>& rows, std::size_t inputs,
                                                       Eigen::Index output, const Unit& unit) {
    // The row of a fit holds the covariances of its parameters; those of inputs need a row of their own.
    bool correlated = false;
    std::size_t first = 0;
    for (const gum::InputGroup& group : point.model->inputs()) {
        const std::size_t symbol = point.model->quantities()[first].symbol;
        bool is_shown = false;
        for (std::size_t i = first; i < first + static_cast<std::size_t>(group.size()); ++i) {
            is_shown = is_shown || has_row(point, point.model->quantities()[i].symbol);
        }
        correlated = correlated || (symbol < inputs && is_shown && group.size() > 1 && !group.is_diagonal());
        first += static_cast<std::size_t>(group.size());
    }
    if (!correlated) {
        return std::nullopt;
    }
    const double u = unit.difference_from_si(point.propagation.standard_uncertainty(output));
    double shown = 0.0;
    for (const BudgetRow& row : rows) {
        shown += row.contribution.number * row.contribution.number;
    }
    reports::CorrelationRow row;
    row.variance = u * u - shown;
    if (std::abs(row.variance) < 1e-13 * std::max(u * u, shown)) {
        row.variance = 0.0;
    }
    row.share = shown_share(u > 0.0 ? row.variance / (u * u) : 0.0);
    const double root = std::sqrt(std::abs(row.variance));
    row.printed_contribution = (row.variance < 0.0 ? "-" : "") + rounded(root, reports::k_digits_of_u);
    return row;
}

/// Without a derivative no row has a sensitivity, and none has a share.
void without_sensitivities(std::vector<BudgetRow>& rows) {
    for (BudgetRow& row : rows) {
        row.sensitivity = {};
        row.contribution.text.clear();
        row.share.text.clear();
        without_sensitivities(row.components);
    }
}

std::string distribution_of(const gum::BudgetOutputResult& output) {
    if (output.coverage == "convolution") {
        return "convolution";
    }
    return output.coverage == "none" ? "not stated" : output.coverage;
}

std::vector<std::vector<double>> rows_of(const Eigen::MatrixXd& matrix) {
    std::vector<std::vector<double>> rows;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        const Eigen::VectorXd row = matrix.row(i).transpose();
        rows.emplace_back(row.data(), row.data() + row.size());
    }
    return rows;
}

/// A covariance in the products of units from one in coherent SI.
Eigen::MatrixXd in_units(const Eigen::MatrixXd& si, const std::vector<Unit>& units) {
    Eigen::MatrixXd scaled = si;
    for (Eigen::Index i = 0; i < si.rows(); ++i) {
        for (Eigen::Index j = 0; j < si.cols(); ++j) {
            scaled(i, j) = units[static_cast<std::size_t>(i)].difference_from_si(
                units[static_cast<std::size_t>(j)].difference_from_si(si(i, j)));
        }
    }
    return scaled;
}

std::vector<Unit> result_units(const BudgetJob& job, const gum::BudgetResult& result) {
    std::vector<Unit> units;
    for (const gum::BudgetPointResult& point : result.points) {
        for (std::size_t i = 0; i < point.outputs.size(); ++i) {
            units.push_back(jobs::result_unit(job, point, i));
        }
    }
    return units;
}

/// Covariance of the results that have one, with their names and units.
struct NamedCovariance {
    std::vector<std::string> names;
    std::vector<Unit> units;
    std::vector<bool> of_trials;  ///< whether the result is reported by Monte Carlo
    Eigen::MatrixXd matrix;
};

NamedCovariance named(const BudgetJob& job, const gum::BudgetResult& result, const Eigen::MatrixXd& covariance) {
    const std::vector<std::string> names = gum::budget_result_names(job, result);
    const std::vector<Unit> units = result_units(job, result);
    std::vector<bool> of_trials;
    for (const gum::BudgetPointResult& point : result.points) {
        for (const gum::BudgetOutputResult& output : point.outputs) {
            of_trials.push_back(output.by_monte_carlo);
        }
    }
    NamedCovariance all;
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
        if (!std::isnan(covariance(i, i))) {
            rows.push_back(i);
            all.names.push_back(names[static_cast<std::size_t>(i)]);
            all.units.push_back(units[static_cast<std::size_t>(i)]);
            all.of_trials.push_back(of_trials[static_cast<std::size_t>(i)]);
        }
    }
    all.matrix = covariance(rows, rows);
    return all;
}

reports::ResultCovariance covariance_of(const BudgetJob& job, const gum::BudgetResult& result,
                                        const Eigen::MatrixXd& all, const std::string& file) {
    // With a result of Monte Carlo a coefficient is known to 1/√M of trials, 0.004 at most: two decimals. Where there is
    // nothing in common it is exactly 0.
    constexpr int k_decimals = 3;
    constexpr int k_decimals_of_trials = 2;
    const auto [names, units, of_trials, covariance] = named(job, result, all);
    reports::ResultCovariance out;
    out.names = names;
    for (const Unit& unit : units) {
        out.units.push_back(unit.text());
    }
    out.file = file;
    out.method = gum::has_result_of_trials(result) ? "monte_carlo" : "law_of_propagation";
    if (!file.empty()) {
        return out;
    }
    const Eigen::MatrixXd correlation = gum::correlation_matrix(covariance);
    out.matrix = rows_of(in_units(covariance, units));
    out.correlation.number = rows_of(correlation);
    for (Eigen::Index i = 0; i < correlation.rows(); ++i) {
        std::vector<std::string> row;
        for (Eigen::Index j = 0; j < correlation.cols(); ++j) {
            const bool drawn = i != j && correlation(i, j) != 0.0 &&
                               (of_trials[static_cast<std::size_t>(i)] || of_trials[static_cast<std::size_t>(j)]);
            row.push_back(gum::round_to_quantum(correlation(i, j), drawn ? k_decimals_of_trials : k_decimals));
        }
        out.correlation.text.push_back(std::move(row));
    }
    return out;
}

/// Digits of a factor that draws hold: three, or two where its standard uncertainty is above half of the third.
std::string printed_factor(double factor, double error) {
    constexpr double k_half_of_third_digit = 0.005;  // of 1 to 10
    return rounded(factor, error > k_half_of_third_digit * std::max(1.0, factor / 10.0) ? 2 : 3);
}

/// Joint region of the outputs of the only point.
std::optional<reports::CoverageRegion> region_of(const BudgetJob& job, const gum::BudgetPointResult& point,
                                                 const Eigen::MatrixXd& covariance) {
    const std::optional<gum::JointRegion> found = gum::joint_region(job, point, covariance);
    if (!found) {
        return std::nullopt;
    }
    reports::CoverageRegion region;
    region.coverage_probability = job.coverage_probability;
    region.from = found->of_trials ? "Monte Carlo" : "law of propagation";
    region.degrees_of_freedom = found->degrees_of_freedom;
    region.no_k_p_because = found->no_ellipsoid_because;
    if (found->ellipsoid_factor) {
        region.k_p = {found->ellipsoid_factor, printed_factor(*found->ellipsoid_factor, found->ellipsoid_error)};
    }
    if (found->rectangle_factor) {
        region.k_q = {found->rectangle_factor, printed_factor(*found->rectangle_factor, found->rectangle_error)};
    }
    if (found->of_trials && point.monte_carlo->regions && point.monte_carlo->regions->smallest_cells > 0 &&
        point.monte_carlo->coverage_probability == job.coverage_probability) {
        const gum::MonteCarloRegions& from = *point.monte_carlo->regions;
        region.smallest_region = {.volume = from.smallest_volume,
                                  .probability = from.smallest_probability,
                                  .cells = static_cast<std::int64_t>(from.smallest_cells),
                                  .cells_per_axis = {}};
        for (const gum::BudgetOutputResult& output : point.outputs) {
            region.smallest_region->volume = output.unit.difference_from_si(region.smallest_region->volume);
        }
        for (const int cells : from.cells_per_axis) {
            region.smallest_region->cells_per_axis.push_back(cells);
        }
    }
    if (point.joint_validation) {
        const gum::JointValidation& from = *point.joint_validation;
        const auto numbers = [](const Eigen::VectorXd& v) {
            return std::vector<double>(v.data(), v.data() + v.size());
        };
        region.validation = {.delta = numbers(from.tolerance),
                             .d_value = numbers(from.value_distance),
                             .d_u = numbers(from.u_distance),
                             .delta_eigenvalue = from.eigenvalue_tolerance,
                             .d_eigenvalue = from.eigenvalue_distance,
                             .delta_k_p = from.factor_tolerance,
                             .d_k_p = from.factor_distance,
                             .validated = from.validated};
    }
    return region;
}

/// Results whose digits are lost because double precision cannot hold the numbers that they come from: large values
/// that cancel, among them constants, which have no uncertainty of their own to be held against.
void warn_of_lost_digits(const gum::BudgetResult& result, reports::EvaluationRecord& record) {
    constexpr double k_few_digits = 1e-6;  // of an exact value
    std::vector<std::string> names;
    std::vector<std::string> inexact;
    std::string worst;
    double most = 0.0;
    auto next = record.results.begin();
    for (const gum::BudgetPointResult& point : result.points) {
        const Eigen::VectorXd roundings = point.model->rounding(gum::input_estimates(*point.model));
        for (std::size_t i = 0; i < point.outputs.size(); ++i) {
            const auto index = static_cast<Eigen::Index>(i);
            const double lost = roundings(index);
            const double u = point.propagation.standard_uncertainty(index);
            const std::string& name = (next++)->name;
            if (point.outputs[i].coverage_note == gum::k_exact_by_definition &&
                lost > k_few_digits * std::abs(point.propagation.value(index))) {
                inexact.push_back(name);
            }
            if (!(u > 0.0) || !(lost > 2.0 * gum::k_accepted_rounding * u)) {
                continue;
            }
            names.push_back(name);
            if (lost / u > most) {
                most = lost / u;
                const Unit& unit = point.outputs[i].unit;
                worst = rounded(unit.difference_from_si(lost), 2) + " of " + name +
                        " beside u = " + rounded(unit.difference_from_si(u), 2) + " " +
                        gum::unit_for_people(unit.text());
            }
        }
    }
    if (!names.empty()) {
        record.diagnostics.push_back(
            {.code = "GC-BUDGET-0034",
             .where = (names.size() == 1 ? "result " : "results ") + text::listed(names, 5),
             .what = "the rounding of the numbers that it is computed from may be " + worst,
             .rule = "a number has about 16 digits; what is lost of the inputs and constants must be small beside the "
                     "uncertainty",
             .action =
                 "State a large value as a whole number, a constant, and the difference from it, an input; in the "
                 "model, subtract the whole numbers from each other before the differences are added.",
             .severity = gum::Severity::warning});
    }
    if (!inexact.empty()) {
        record.diagnostics.push_back(
            {.code = "GC-BUDGET-0034",
             .where = (inexact.size() == 1 ? "result " : "results ") + text::listed(inexact, 5),
             .what =
                 "exact by definition, and fewer than six of its digits are held by the numbers that it is computed "
                 "from",
             .rule = "a number has about 16 digits; they are lost where large values cancel",
             .action = "Subtract the whole numbers from each other before the differences are added.",
             .severity = gum::Severity::warning});
    }
}

/// A number that does not exist stands nowhere.
void without_missing_moments(const gum::BudgetOutputResult& from, reports::MonteCarloSummary& trials) {
    if (!from.has_mean) {
        trials.mean = {};
        trials.numerical_error.mean = 0.0;
    }
    if (!from.has_u) {
        trials.u = {};
        trials.numerical_error.u = 0.0;
        trials.numerical_error.mean = 0.0;
    }
}

nlohmann::json options_json(const BudgetJob& job, const gum::BudgetResult& result) {
    nlohmann::json options;
    options["coverage_probability"] = job.coverage_probability;
    options["law_of_propagation"] = {{"order", 1}, {"second_order_reported_from_relative_change", 0.005}};
    options["reporting"] = {{"degrees_of_freedom", job.truncate_degrees_of_freedom ? "truncated" : "exact"},
                            {"rounding", job.rounding == gum::RoundingMode::up ? "up" : "half_even"}};
    options["coverage"] = gum::coverage_choice_name(job.coverage);
    options["monte_carlo"] =
        reports::monte_carlo_json(job.monte_carlo ? job.monte_carlo : result.automatic_monte_carlo);
    if (!job.monte_carlo && result.automatic_monte_carlo) {
        options["monte_carlo"]["automatic"] = true;
    }
    return options;
}

/// Names of the results of a section.
std::vector<std::string> quantities_of(const gum::BudgetResult& result, std::size_t section) {
    std::vector<std::string> names;
    for (const gum::BudgetPointResult& point : result.points) {
        if (point.section == section) {
            for (const gum::BudgetOutputResult& output : point.outputs) {
                names.push_back(output.name);
            }
            break;
        }
    }
    return names;
}

}  // namespace

reports::EvaluationRecord budget_record(const BudgetJob& job, const gum::BudgetResult& result,
                                        const std::vector<reports::InputFile>& files, const Eigen::MatrixXd& covariance,
                                        const std::string& covariance_file) {
    reports::EvaluationRecord record = reports::record_head(reports::k_budget_kind,
                                                            {.title = job.title,
                                                             .coverage_probability = job.coverage_probability,
                                                             .document = job.document,
                                                             .warnings = job.warnings,
                                                             .notes = result.notes},
                                                            options_json(job, result), files);
    for (const BudgetInput& input : job.inputs) {
        const auto described = job.input_descriptions.find(input.name);
        record.inputs.push_back({.name = input.name,
                                 .description = described == job.input_descriptions.end() ? certificate::LocalisedText()
                                                                                          : described->second,
                                 .unit = input.unit.text()});
    }
    if (!job.model.empty()) {
        record.model.emplace();
        for (const gum::EquationText& equation : job.model) {
            record.model->equations.push_back(equation.text);
        }
        for (const gum::UnknownSymbol& unknown : job.unknowns) {
            record.model->unknowns.push_back(unknown.name);
        }
    }

    for (std::size_t i = 0; i < job.sections.size(); ++i) {
        const gum::BudgetSection& section = job.sections[i];
        record.sections.push_back({.name = section.name,
                                   .title = job.section_titles[i],
                                   .equations = static_cast<std::int64_t>(section.equations),
                                   .unknowns = static_cast<std::int64_t>(section.unknowns),
                                   .points = static_cast<std::int64_t>(section.points),
                                   .quantities = quantities_of(result, i)});
    }
    if (!job.point_columns.empty() || !job.tables.empty() || !job.sections.empty()) {
        record.points.emplace();
        for (const gum::BudgetPoint& point : job.points) {
            record.points->points.push_back(point.name);
        }
        record.points->columns = job.point_columns;
        record.points->tables = job.tables;
    }

    const gum::MonteCarloRequest asked =
        job.monte_carlo.value_or(result.automatic_monte_carlo.value_or(gum::MonteCarloRequest{}));
    const std::vector<std::string> names = gum::budget_result_names(job, result);
    auto name = names.begin();
    for (const gum::BudgetPointResult& point : result.points) {
        const Eigen::VectorXd roundings = point.model->rounding(gum::input_estimates(*point.model));
        for (std::size_t i = 0; i < point.outputs.size(); ++i) {
            const auto index = static_cast<Eigen::Index>(i);
            const gum::BudgetOutputResult& from = point.outputs[i];
            const Unit& unit = jobs::result_unit(job, point, i);
            reports::Result out;
            out.name = *name++;
            out.quantity = from.name;
            out.point = point.point ? job.points[*point.point].name : "";
            if (const auto described = job.output_descriptions.find(out.quantity);
                described != job.output_descriptions.end()) {
                out.description = described->second.in("en");
                if (!described->second.by_language.empty()) {
                    out.description_by_language = described->second;
                }
            }
            out.value = recorded_value(point.propagation.value(index), roundings(index), unit);
            if (from.coverage_note == gum::k_exact_by_definition) {
                out.value = held_digits(out.value, unit.difference_from_si(roundings(index)));
            }
            out.unit = unit.text();
            out.u = unit.difference_from_si(from.standard_uncertainty);
            out.nu_eff = reports::finite_or_none(from.degrees_of_freedom);
            out.k = from.coverage_factor;
            out.k_numerical_error = from.k_numerical_error;
            out.coverage_probability = from.coverage_probability;
            if (from.expanded_uncertainty) {
                out.U = unit.difference_from_si(*from.expanded_uncertainty);
            }
            out.distribution = distribution_of(from);
            out.coverage = from.coverage;
            out.coverage_note = from.coverage_note;
            out.printed = printed_result(out.value, out.U, out.u, out.unit, job.rounding);
            out.reported = reported_of(from, out.value, unit, job);
            out.budget = budget_rows(job, result, point, index, unit);
            if (i < point.without_derivative.size() && point.without_derivative[i]) {
                without_sensitivities(out.budget);
            } else if (!point.model->is_of_symbols()) {
                out.correlation = correlation_row(point, out.budget, job.inputs.size(), index, unit);
            }
            if (from.second_order_matters) {
                const auto shown = [&](double si) {
                    return shown_significant(unit.difference_from_si(si), reports::k_digits_of_u);
                };
                out.second_order = {.first_order_u = shown(point.propagation.standard_uncertainty(index)),
                                    .u = shown(point.second_order->standard_uncertainty(index)),
                                    .shift = shown(point.second_order->shift(index))};
            }
            if (from.monte_carlo) {
                out.monte_carlo = reports::monte_carlo_summary(
                    *from.monte_carlo, asked, {from.trials, from.stabilised},
                    {[&](double value) { return unit.from_si(value); },
                     [&](double difference) { return unit.difference_from_si(difference); }},
                    from.validation);
                without_missing_moments(from, *out.monte_carlo);
            }
            record.results.push_back(std::move(out));
        }
    }
    if (record.results.size() > 1 && covariance.size() > 0) {
        record.covariance = covariance_of(job, result, covariance, covariance_file);
        if (record.covariance->names.size() < 2) {
            record.covariance.reset();
        }
    }
    // Trials without a variance have no region that is measured by it.
    const bool any_without =
        std::any_of(result.points.front().outputs.begin(), result.points.front().outputs.end(),
                    [](const gum::BudgetOutputResult& output) { return output.by_monte_carlo && !output.has_u; });
    if (job.sections.empty() && result.points.front().outputs.size() > 1 && job.points.empty() && !job.model.empty() &&
        !any_without) {
        record.region = region_of(job, result.points.front(), covariance);
    }
    for (std::size_t f = 0; f < job.fits.size(); ++f) {
        record.fits.push_back(fit_summary(job.fits[f], result.fits[f]));
    }
    add_readings(job, record);
    warn_of_lost_digits(result, record);
    const std::vector<gum::Diagnostic> remarks = budget_remarks(record);
    record.diagnostics.insert(record.diagnostics.end(), remarks.begin(), remarks.end());
    return record;
}

std::string budget_covariance_csv(const BudgetJob& job, const gum::BudgetResult& result,
                                  const Eigen::MatrixXd& covariance) {
    const auto [names, units, of_trials, matrix] = named(job, result, covariance);
    const Eigen::MatrixXd scaled = in_units(matrix, units);
    std::string csv = "result";
    for (const std::string& name : names) {
        csv += "," + text::csv_field(name);
    }
    csv += "\n";
    for (Eigen::Index i = 0; i < scaled.rows(); ++i) {
        csv += text::csv_field(names[static_cast<std::size_t>(i)]);
        for (Eigen::Index j = 0; j < scaled.cols(); ++j) {
            csv += "," + text::shortest(scaled(i, j));
        }
        csv += "\n";
    }
    return csv;
}

}  // namespace gumcert::reports
