#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gum/expression/name_spelling.h"
#include "gum/rounding.h"
#include "reports/record/make/comparison/compared_job_side.h"
#include "reports/record/make/comparison/comparison_print.h"
#include "reports/record/make/comparison/evaluate_comparison.h"
#include "reports/record/make/comparison/method_correlation.h"
#include "reports/record/make/comparison/method_record.h"
#include "reports/record/make/comparison/method_side.h"
#include "reports/record/make/record_parts.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using jobs::ComparisonJob;
using jobs::ComparisonSide;
using jobs::MethodComparisonRequest;

constexpr double k_suspicious_capability_ratio = 2.0;

std::string name_of(const jobs::MethodPoint& point) {
    return point.direction.empty() ? point.name : point.name + ", direction " + point.direction;
}

MethodSide side_of(const ComparisonJob& job, const MethodComparisonRequest& request, const ComparisonSide& side,
                   const JobJudges& judges) {
    if (side.has_job()) {
        return side_of_job(side, request.unit, job.coverage_probability, judges);
    }
    if (side.budget) {
        MethodBudget budget{*side.budget, side.budget_file, side.name, side.budget_points, {}};
        for (const jobs::MethodPoint& point : request.points) {
            budget.name.push_back(name_of(point));
        }
        return side_of_budget(budget, request.unit, job.coverage_probability);
    }
    MethodSide stated;
    stated.value = side.value;
    stated.uncertainty = side.uncertainty;
    stated.covariance = side.covariance;
    return stated;
}

gum::MethodComparison method_comparison(const ComparisonJob& job, const MethodSide& method,
                                        const MethodSide& reference) {
    const MethodComparisonRequest& request = *job.methods;
    gum::MethodComparison comparison;
    for (std::size_t i = 0; i < request.points.size(); ++i) {
        const gum::ResultUncertainty& of_method = method.uncertainty[i];
        const gum::ResultUncertainty& of_reference = reference.uncertainty[i];
        comparison.points.push_back({.name = request.points[i].name,
                                     .direction = request.points[i].direction,
                                     .position = request.points[i].position,
                                     .value = method.value[i],
                                     .u = of_method.u,
                                     .U = of_method.U,
                                     .k = of_method.k,
                                     .nu = reports::finite_or_none(of_method.degrees_of_freedom),
                                     .reference_value = reference.value[i],
                                     .reference_u = of_reference.u,
                                     .reference_U = of_reference.U,
                                     .reference_k = of_reference.k,
                                     .reference_nu = reports::finite_or_none(of_reference.degrees_of_freedom),
                                     .p = of_method.coverage_probability,
                                     .reference_p = of_reference.coverage_probability,
                                     .of_scores = of_method.of_scores,
                                     .reference_of_scores = of_reference.of_scores});
    }
    comparison.covariance = method.covariance;
    comparison.reference_covariance = reference.covariance;
    comparison.coverage_probability = job.coverage_probability;
    comparison.bias_against_position = request.bias_against_position;
    comparison.audited_factor = request.laboratory.audited_factor;
    comparison.reference_audited_factor = request.reference.audited_factor;
    return comparison;
}

std::set<std::string> source_names(const std::vector<const MethodSide*>& sides) {
    std::set<std::string> names;
    for (const MethodSide* side : sides) {
        for (const std::vector<gum::UncertaintySource>& of_point : side->sources.all) {
            for (const gum::UncertaintySource& source : of_point) {
                names.insert(source.source);
            }
        }
    }
    return names;
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
        point.U_over_CMC = *point.U.number / *side.cmc_U;
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

/// Angles of both sides that lie a full turn apart.
void note_turns(const gum::MethodComparison& comparison, const MethodComparisonRequest& request,
                std::vector<gum::Diagnostic>& notes) {
    const auto is_apart = [&](const gum::ComparedPoint& point) {
        return is_turn_apart(point.value, point.reference_value, request.unit);
    };
    const auto first = std::find_if(comparison.points.begin(), comparison.points.end(), is_apart);
    if (first == comparison.points.end()) {
        return;
    }
    const auto [low, high] = std::minmax(first->value, first->reference_value);
    const std::string unit = gum::unit_for_people(request.unit.text());
    notes.push_back({.code = k_turn_apart,
                     .where = "comparison",
                     .what = "angles from " + text::shortest(low) + " to " + text::shortest(high) +
                             (unit.empty() ? "" : " " + unit) + " lie a full turn apart, or nearly",
                     .rule = k_turn_rule,
                     .action = k_turn_action,
                     .severity = gum::Severity::warning});
}

}  // namespace

reports::Comparison evaluate_methods(const ComparisonJob& job, std::vector<gum::Diagnostic>* notes,
                                     const JobJudges& judges) {
    const MethodComparisonRequest& request = *job.methods;
    MethodSide method = side_of(job, request, request.laboratory, judges);
    MethodSide reference = side_of(job, request, request.reference, judges);
    const bool takes_mean_off = request.laboratory.has_job() || request.reference.has_job();
    if (takes_mean_off) {
        take_off_mean(method, job.coverage_probability);
        take_off_mean(reference, job.coverage_probability);
        reference.remarks.push_back("The mean of the " + std::to_string(request.points.size()) +
                                    " compared angles was taken off both sides, with its covariance: the zero of a "
                                    "deviation of an angle is a convention, and so is a constant difference.");
    }
    gum::MethodComparison comparison = method_comparison(job, method, reference);
    comparison.mean_taken_off = takes_mean_off;

    reports::Comparison record;
    record.form = "methods";
    record.method_name = request.laboratory.name;
    record.reference_name = request.reference.name;
    record.unit = request.unit.text();
    record.position_name = request.position_name;
    record.position_unit = request.position_unit ? request.position_unit->text() : "";
    record.organiser = job.organiser;
    record.audit_finding = audit_finding(request);
    record.tolerance = shown(request.tolerance, printed_as_stated);
    record.method_budget = std::move(method.budget);
    record.reference_budget = std::move(reference.budget);
    for (const MethodSide* side : {&method, &reference}) {
        if (!side->origin.empty()) {
            record.remarks.push_back(side->origin);
        }
        record.remarks.insert(record.remarks.end(), side->remarks.begin(), side->remarks.end());
    }
    if (notes != nullptr) {
        *notes = gum::similar_source_names(source_names({&method, &reference}), job.different_sources);
        for (const MethodSide* side : {&method, &reference}) {
            notes->insert(notes->end(), side->warnings.begin(), side->warnings.end());
        }
    }
    if (notes != nullptr) {
        note_turns(comparison, request, *notes);
    }
    add_correlation(job, method, reference, comparison, record);
    add_method_comparison(comparison, request.unit.text(), record);
    add_capability(request.laboratory, record);
    withhold_agreement(method.refuted, record);
    withhold_agreement(reference.refuted, record);
    return record;
}

}  // namespace gumcert::reports
