#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/budget_record.h"
#include "app/comparison_print.h"
#include "app/evaluate_budget.h"
#include "app/evaluate_comparison.h"
#include "app/method_comparison.h"
#include "app/record_parts.h"
#include "app/shared_sources.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rounding.h"

namespace gumcert::app {

namespace {

using engine::ComparisonJob;
using engine::ComparisonSide;
using engine::MethodComparisonRequest;
using engine::MethodCorrelation;

// Below it an eigenvalue of a correlation matrix of m quantities is rounding: m times this.
constexpr double k_rounding = 1e-10;
constexpr double k_suspicious_capability_ratio = 2.0;

/// One method at all points of the comparison, in its unit.
struct Side {
    std::vector<double> value;
    std::vector<engine::ResultUncertainty> uncertainty;
    Eigen::MatrixXd covariance;
    std::vector<reports::BudgetRow> budget;
    PointSources sources;  ///< of its budget; empty without one
    std::vector<std::string> remarks;
};

std::string name_of(const engine::MethodPoint& point) {
    return point.direction.empty() ? point.name : point.name + ", direction " + point.direction;
}

[[noreturn]] void refuse_budget(const std::string& code, const ComparisonSide& side, const engine::MethodPoint& point,
                                const std::string& what, const std::string& rule, const std::string& action) {
    throw gum::NoResultError(gum::Diagnostic{.code = code,
                                             .where = side.budget_file + ", point " + name_of(point),
                                             .what = what,
                                             .rule = rule,
                                             .action = action});
}

/// One remark for each kind of note; a budget says the same at many points.
void add_notes(const ComparisonSide& side, const std::vector<gum::Diagnostic>& notes,
               std::vector<std::string>& remarks) {
    std::map<std::string, std::size_t> count;
    for (const gum::Diagnostic& note : notes) {
        ++count[note.code];
    }
    for (const gum::Diagnostic& note : notes) {
        const std::size_t of_kind = std::exchange(count[note.code], 0);
        if (of_kind > 0) {
            remarks.push_back("Budget of " + side.name + ": " + gum::message(note) +
                              (of_kind == 1 ? "" : " (and " + std::to_string(of_kind - 1) + " more of this kind)"));
        }
    }
}

engine::ResultUncertainty uncertainty_of(const ComparisonSide& side, const engine::MethodPoint& point,
                                         const BudgetOutputResult& output, const gum::Unit& unit) {
    if (!output.expanded_uncertainty || !output.coverage_factor) {
        refuse_budget("GC-COMPARE-0205", side, point, "no expanded uncertainty can be stated: " + output.coverage_note,
                      "a comparison needs the expanded uncertainty of both values",
                      "State inputs from which a coverage factor follows.");
    }
    if (!(output.standard_uncertainty > 0.0)) {
        refuse_budget("GC-COMPARE-0206", side, point, "the standard uncertainty is 0",
                      "a measured value has an uncertainty", "State it in the budget.");
    }
    return {.u = unit.difference_from_si(output.standard_uncertainty),
            .U = unit.difference_from_si(*output.expanded_uncertainty),
            .k = *output.coverage_factor,
            .degrees_of_freedom = output.degrees_of_freedom};
}

Side side_of_budget(const ComparisonJob& job, const MethodComparisonRequest& request, const ComparisonSide& side) {
    engine::BudgetJob budget = *side.budget;
    // U of both sides for one probability; Monte Carlo of single points would not be looked at.
    budget.coverage_probability = job.coverage_probability;
    for (engine::BudgetOutput& output : budget.outputs) {
        output.coverage_probability.reset();
    }
    budget.monte_carlo.reset();
    BudgetResult result = evaluate_budget(budget, 1);
    result.output_units.front() = request.unit;  // the rows of its table as well are in the unit of the comparison
    const Eigen::MatrixXd covariance = budget_covariance(result);
    Side evaluated;
    std::vector<Eigen::Index> rows;
    std::size_t largest = 0;
    for (std::size_t i = 0; i < request.points.size(); ++i) {
        const std::size_t at = side.budget_points[i];
        const BudgetPointResult& point = result.points[at];
        rows.push_back(static_cast<Eigen::Index>(at));
        evaluated.value.push_back(request.unit.from_si(point.propagation.value(0)));
        evaluated.uncertainty.push_back(uncertainty_of(side, request.points[i], point.outputs.front(), request.unit));
        evaluated.sources.all.push_back(uncertainty_sources(budget, result, at, 0, request.unit));
        evaluated.sources.common.push_back(uncertainty_sources(budget, result, at, 0, request.unit, true));
        largest = evaluated.uncertainty[i].u > evaluated.uncertainty[largest].u ? i : largest;
    }
    const double scale = request.unit.difference_from_si(1.0);
    evaluated.covariance = covariance(rows, rows) * scale * scale;
    reports::EvaluationRecord of_budget = budget_record(budget, result, {}, {}, "");
    evaluated.budget = std::move(of_budget.results[side.budget_points[largest]].budget);
    evaluated.remarks.push_back(
        "Values and uncertainties of " + side.name + " come from the budget " + side.budget_file +
        (request.points.size() == 1
             ? "."
             : ", evaluated at every point; the table of it is that of the point with the largest uncertainty, " +
                   name_of(request.points[largest]) +
                   ". What its inputs have in common between the points is in "
                   "their covariance."));
    add_notes(side, result.notes, evaluated.remarks);
    return evaluated;
}

Side side_of(const ComparisonJob& job, const MethodComparisonRequest& request, const ComparisonSide& side) {
    if (side.budget) {
        return side_of_budget(job, request, side);
    }
    Side stated;
    stated.value = side.value;
    stated.uncertainty = side.uncertainty;
    stated.covariance = side.covariance;
    return stated;
}

// ---- correlation of both methods ------------------------------------------------------------------------------------

/// Whether values of covariances V and W can have the covariance C with each other.
bool is_possible(const Eigen::MatrixXd& V, const Eigen::MatrixXd& W, const Eigen::MatrixXd& C) {
    const Eigen::Index m = V.rows();
    Eigen::MatrixXd joint(2 * m, 2 * m);
    joint << V, C, C.transpose(), W;
    const Eigen::VectorXd scale =
        joint.diagonal().unaryExpr([](double variance) { return variance > 0.0 ? 1.0 / std::sqrt(variance) : 0.0; });
    joint = scale.asDiagonal() * joint * scale.asDiagonal();
    joint.diagonal().array() += k_rounding * static_cast<double>(2 * m);
    return Eigen::LLT<Eigen::MatrixXd>(joint).info() == Eigen::Success;
}

/// C_ii = r u_i u_ref,i; where the points share so much that this cannot be, C_ij = r u_i u_ref,j.
Eigen::MatrixXd stated_correlation(double r, const MethodComparison& comparison, std::vector<std::string>& remarks) {
    const Eigen::MatrixXd common = r * comparison.covariance.diagonal().cwiseSqrt() *
                                   comparison.reference_covariance.diagonal().cwiseSqrt().transpose();
    const Eigen::MatrixXd apart = common.diagonal().asDiagonal();
    const std::string stated = "The stated correlation " + printed_as_stated(r) + " of both methods ";
    if (is_possible(comparison.covariance, comparison.reference_covariance, apart)) {
        remarks.push_back(stated +
                          "is taken to hold at equal points; different points of the two methods are taken as "
                          "not correlated with each other.");
        return apart;
    }
    if (is_possible(comparison.covariance, comparison.reference_covariance, common)) {
        remarks.push_back(stated +
                          "is taken to come from an effect that all points share: the points of the methods "
                          "share so much that it cannot hold at equal points alone.");
        return common;
    }
    throw gum::InputError(gum::Diagnostic{
        .code = "GC-COMPARE-0204",
        .where = "correlation",
        .what = "the value is " + printed_as_stated(r) +
                ", and neither an effect of each point apart nor one that all points share can have that correlation",
        .rule = "the covariance matrix of both methods together is positive semi-definite",
        .action = "State a smaller correlation, or \"unknown\", or give budgets that name the shared sources."});
}

std::string list_of(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) {
        text += (text.empty() ? "" : ", ") + name;
    }
    return text;
}

/// One entry a source, at the point where it ties both methods most. None where a side has no budget.
std::vector<reports::SharedSource> found_sources(const MethodComparisonRequest& request, const Side& method,
                                                 const Side& reference, const std::vector<std::string>& independent,
                                                 std::vector<std::string>& ambiguous) {
    std::vector<reports::SharedSource> found;
    const std::size_t points = std::min(method.sources.all.size(), reference.sources.all.size());
    for (std::size_t i = 0; i < points; ++i) {
        for (const SourceCovariance& shared :
             shared_covariance(method.sources.all[i], reference.sources.all[i], independent)) {
            auto entry = std::find_if(found.begin(), found.end(), [&](const reports::SharedSource& other) {
                return other.source == shared.source;
            });
            if (entry == found.end()) {
                found.push_back({.source = shared.source,
                                 .first = request.laboratory.name,
                                 .second = request.reference.name,
                                 .covariance = 0.0});
                entry = std::prev(found.end());
            }
            if (shared.ambiguous && std::find(ambiguous.begin(), ambiguous.end(), shared.source) == ambiguous.end()) {
                ambiguous.push_back(shared.source);
            }
            if (std::abs(shared.covariance) > std::abs(entry->covariance)) {
                entry->covariance = shared.covariance;
                entry->correlation = shared.covariance / (method.uncertainty[i].u * reference.uncertainty[i].u);
            }
        }
    }
    for (reports::SharedSource& source : found) {
        source.printed_correlation = printed_score(source.correlation);
    }
    return found;
}

/// Names of the sources that both budgets have, also of those that the job calls independent.
std::vector<std::string> sources_in_both(const MethodComparisonRequest& request, const Side& method,
                                         const Side& reference) {
    std::vector<std::string> ambiguous;
    std::vector<std::string> names;
    for (const reports::SharedSource& source : found_sources(request, method, reference, {}, ambiguous)) {
        names.push_back(source.source);
    }
    return names;
}

/// One budget calls an input the same at all points, and the other one calls it another at each.
[[noreturn]] void refuse_shared_sources(const std::vector<std::string>& names) {
    throw gum::InputError(gum::Diagnostic{
        .code = "GC-COMPARE-0207",
        .where = "correlation",
        .what = "both budgets name " + list_of(names) + ", and what they say of it cannot hold together",
        .rule = "an input whose source both methods share is the same at all points in both budgets, or "
                "\"between_points\": \"independent\" in both",
        .action = "State it alike in both budgets, or list the source in \"independent_sources\"."});
}

void add_shared_sources(const ComparisonJob& job, const Side& method, const Side& reference,
                        MethodComparison& comparison, reports::Comparison& record) {
    const MethodComparisonRequest& request = *job.methods;
    std::vector<std::string> ambiguous;
    record.shared_sources = found_sources(request, method, reference, job.independent_sources, ambiguous);
    std::vector<std::string> names;
    for (const reports::SharedSource& source : record.shared_sources) {
        names.push_back(source.source);
    }
    if (names.empty()) {
        record.remarks.emplace_back(
            "The budgets of both methods name no source in common that is shared; the covariance between the methods "
            "is taken as zero.");
    } else {
        comparison.cross_covariance =
            cross_covariance_of_sources(method.sources, reference.sources, job.independent_sources);
        if (ambiguous.empty() &&
            !is_possible(comparison.covariance, comparison.reference_covariance, comparison.cross_covariance)) {
            refuse_shared_sources(names);
        }
        record.remarks.push_back("Both budgets name " + list_of(names) +
                                 ". The covariance between the methods is computed from what these sources contribute "
                                 "to each of them, with its sign.");
    }
    if (!ambiguous.empty()) {
        record.remarks.push_back("The budgets do not tell which inputs of " + list_of(ambiguous) +
                                 " are the same quantity: the largest covariance that they can have is taken, which "
                                 "makes |En| larger.");
    }
    std::vector<std::string> set_aside;
    for (const std::string& name : sources_in_both(request, method, reference)) {
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            set_aside.push_back(name);
        }
    }
    if (!set_aside.empty()) {
        record.remarks.push_back("Both budgets name " + list_of(set_aside) +
                                 "; the job states that they are independent of each other all the same.");
    }
}

void add_correlation(const ComparisonJob& job, const Side& method, const Side& reference, MethodComparison& comparison,
                     reports::Comparison& record) {
    const MethodComparisonRequest& request = *job.methods;
    switch (request.correlation) {
        case MethodCorrelation::none:
            record.correlation = "none";
            record.remarks.emplace_back(
                "The job states that both methods have no source of uncertainty in common; the covariance between "
                "them is taken as zero.");
            break;
        case MethodCorrelation::given:
            record.correlation = "given";
            record.correlation_given = request.r;
            comparison.cross_covariance = stated_correlation(request.r, comparison, record.remarks);
            break;
        case MethodCorrelation::unknown:
            record.correlation = "unknown";
            comparison.correlation_unknown = true;
            break;
        case MethodCorrelation::shared_sources:
            record.correlation = "shared_sources";
            add_shared_sources(job, method, reference, comparison, record);
            return;
    }
    const std::vector<std::string> both = sources_in_both(request, method, reference);
    if (!both.empty()) {
        record.remarks.push_back("Both budgets name " + list_of(both) +
                                 "; the covariance that follows from it is not used, because the job states the "
                                 "correlation of the methods.");
    }
}

// ---- the comparison -------------------------------------------------------------------------------------------------

MethodComparison method_comparison(const ComparisonJob& job, const Side& method, const Side& reference) {
    const MethodComparisonRequest& request = *job.methods;
    MethodComparison comparison;
    for (std::size_t i = 0; i < request.points.size(); ++i) {
        const engine::ResultUncertainty& of_method = method.uncertainty[i];
        const engine::ResultUncertainty& of_reference = reference.uncertainty[i];
        comparison.points.push_back({.name = request.points[i].name,
                                     .direction = request.points[i].direction,
                                     .position = request.points[i].position,
                                     .value = method.value[i],
                                     .u = of_method.u,
                                     .U = of_method.U,
                                     .k = of_method.k,
                                     .nu = finite_or_none(of_method.degrees_of_freedom),
                                     .reference_value = reference.value[i],
                                     .reference_u = of_reference.u,
                                     .reference_U = of_reference.U,
                                     .reference_k = of_reference.k});
    }
    comparison.covariance = method.covariance;
    comparison.reference_covariance = reference.covariance;
    comparison.coverage_probability = job.coverage_probability;
    comparison.bias_against_position = request.bias_against_position;
    comparison.audited_factor = request.laboratory.audited_factor;
    comparison.reference_audited_factor = request.reference.audited_factor;
    comparison.printed_unit = request.unit.text();
    return comparison;
}

std::string audit_finding(const MethodComparisonRequest& request) {
    std::string text;
    for (const ComparisonSide* side : {&request.laboratory, &request.reference}) {
        if (!side->audit_finding.empty()) {
            text += (text.empty() ? "" : "; ") + side->name + ": " + side->audit_finding;
        }
    }
    return text;
}

void add_capability(const ComparisonSide& side, reports::Comparison& record) {
    if (!side.cmc_U) {
        return;
    }
    double largest = 0.0;
    std::size_t below = 0;
    for (reports::ComparisonPoint& point : record.points) {
        point.U_over_CMC = *point.U / *side.cmc_U;
        largest = std::max(largest, *point.U_over_CMC);
        below += *point.U_over_CMC < 1.0 ? 1U : 0U;
    }
    if (below > 0) {
        record.remarks.push_back("The expanded uncertainty of " + side.name + " is below its stated capability at " +
                                 std::to_string(below) + " of " + std::to_string(record.points.size()) + " points.");
    }
    if (largest > k_suspicious_capability_ratio) {
        record.remarks.push_back("The expanded uncertainty of " + side.name + " is up to " +
                                 gum::round_significant(largest, 2) +
                                 " times its stated capability: agreement at such uncertainties does not support the "
                                 "capability.");
    }
}

}  // namespace

reports::Comparison evaluate_methods(const ComparisonJob& job) {
    const MethodComparisonRequest& request = *job.methods;
    Side method = side_of(job, request, request.laboratory);
    Side reference = side_of(job, request, request.reference);
    MethodComparison comparison = method_comparison(job, method, reference);

    reports::Comparison record;
    record.form = "methods";
    record.method_name = request.laboratory.name;
    record.reference_name = request.reference.name;
    record.unit = request.unit.text();
    record.position_name = request.position_name;
    record.position_unit = request.position_unit ? request.position_unit->text() : "";
    record.organiser = job.organiser;
    record.audit_finding = audit_finding(request);
    record.tolerance = request.tolerance;
    record.printed_tolerance = printed_as_stated(request.tolerance);
    record.method_budget = std::move(method.budget);
    record.reference_budget = std::move(reference.budget);
    record.remarks = method.remarks;
    record.remarks.insert(record.remarks.end(), reference.remarks.begin(), reference.remarks.end());
    add_correlation(job, method, reference, comparison, record);
    compare_methods(record, comparison);
    add_capability(request.laboratory, record);
    return record;
}

}  // namespace gumcert::app
