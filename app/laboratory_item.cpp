#include "app/laboratory_item.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "app/comparison_print.h"
#include "app/laboratory_estimates.h"
#include "app/record_parts.h"
#include "certificate/statement_of_uncertainty.h"
#include "gum/comparison/consensus_spread.h"
#include "gum/comparison/proficiency_scheme.h"
#include "gum/comparison/robust_statistics.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rounding.h"

namespace gumcert::app {

namespace {

using engine::SigmaPtMethod;
using reports::ComparisonItemEvaluation;

constexpr int k_digits_of_computed_sigma = 3;
constexpr double k_rounding = 1.0 + 1e-14;  // of u(X)/σ_pt, which is exactly the limit in decimal numbers

const std::string& id_of(const engine::ComparisonJob& job, const LaboratoryData& data, std::size_t position) {
    return job.participants[data.results[position]->participant].id;
}

void describe(const engine::ComparisonJob& job, const LaboratoryData& data, const AssignedValue& assigned,
              ComparisonItemEvaluation& evaluation) {
    const engine::ComparisonItem& item = *data.item;
    evaluation.id = item.id;
    evaluation.name = item.name;
    evaluation.round = data.round;
    evaluation.unit = item.unit.text();
    evaluation.difference_unit = gum::unit_of_difference(item.unit.text());
    evaluation.method = engine::assigned_value_words()[static_cast<std::size_t>(item.assigned_value.method)];
    evaluation.traceability = item.assigned_value.traceability;
    if (data.reference) {
        evaluation.reference_participant = id_of(job, data, *data.reference);
    }
    evaluation.results = static_cast<std::int64_t>(data.size());
    const bool by_results = !data.reference && item.assigned_value.method != engine::AssignedValueMethod::given;
    evaluation.contributing = by_results ? static_cast<std::int64_t>(data.contributing.size()) : data.reference ? 1 : 0;
    evaluation.contributing -= static_cast<std::int64_t>(assigned.not_consistent.size());
    std::vector<bool> present(job.participants.size(), false);
    for (std::size_t i = 0; i < data.size(); ++i) {
        present[data.results[i]->participant] = true;
        if (!data.results[i]->contributes) {
            evaluation.not_contributing.push_back(id_of(job, data, i));
        }
    }
    for (std::size_t p = 0; p < present.size(); ++p) {
        if (!present[p]) {
            evaluation.missing.push_back(job.participants[p].id);
        }
    }
    for (const std::size_t i : assigned.not_consistent) {
        evaluation.not_consistent.push_back(id_of(job, data, i));
    }
    // The value of a reference laboratory has the weight 1, which says nothing.
    for (Eigen::Index i = 0; by_results && i < assigned.weights.size(); ++i) {
        if (assigned.weights[i] != 0.0) {
            const double weight = assigned.weights[i];
            evaluation.weights.push_back(
                {id_of(job, data, static_cast<std::size_t>(i)), weight, gum::round_significant(weight, 3)});
        }
    }
}

std::optional<double> sigma_pt_of(const LaboratoryData& data, double assigned_value) {
    if (!data.item->sigma_pt) {
        return std::nullopt;
    }
    const engine::SigmaPtRequest& request = *data.item->sigma_pt;
    const Eigen::VectorXd x = data.values(data.contributing);
    switch (request.method) {
        case SigmaPtMethod::given:
            return request.value;
        case SigmaPtMethod::percent_of_assigned:
            return request.value / 100.0 * std::abs(assigned_value);
        case SigmaPtMethod::mass_fraction:
            return gum::sigma_pt_of_mass_fraction(assigned_value * request.mass_fraction_per_unit) /
                   request.mass_fraction_per_unit;
        case SigmaPtMethod::precision:
            return gum::sigma_pt_of_precision(request.reproducibility, request.repeatability, request.replicates);
        case SigmaPtMethod::robust:
            return gum::algorithm_a({x.data(), static_cast<std::size_t>(x.size())}).scale;
        case SigmaPtMethod::standard_deviation:
            break;
    }
    // s/√n is the uncertainty of the arithmetic mean; it refuses fewer than two results.
    return gum::arithmetic_mean(x).u * std::sqrt(static_cast<double>(x.size()));
}

const char* word_of(SigmaPtMethod method) {
    switch (method) {
        case SigmaPtMethod::given:
            return "given";
        case SigmaPtMethod::percent_of_assigned:
            return "percent";
        case SigmaPtMethod::mass_fraction:
            return "mass_fraction";
        case SigmaPtMethod::precision:
            return "precision";
        case SigmaPtMethod::robust:
            return "robust";
        case SigmaPtMethod::standard_deviation:
            break;
    }
    return "standard_deviation";
}

void add_sigma_pt(const LaboratoryData& data, ComparisonItemEvaluation& evaluation) {
    evaluation.sigma_pt = sigma_pt_of(data, evaluation.value);
    evaluation.delta_E = data.item->delta_E;
    evaluation.printed.delta_E = printed_as_stated(evaluation.delta_E);
    if (!evaluation.sigma_pt) {
        return;
    }
    if (!(*evaluation.sigma_pt > 0.0)) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-COMPARE-0107",
                                              .where = data.where + ", sigma_pt",
                                              .what = "sigma_pt comes out as 0",
                                              .rule = "z-scores divide by it",
                                              .action = "Give a number that is greater than 0."});
    }
    const SigmaPtMethod method = data.item->sigma_pt->method;
    evaluation.sigma_pt_method = word_of(method);
    evaluation.printed.sigma_pt = method == SigmaPtMethod::given
                                      ? printed_as_stated(evaluation.sigma_pt)
                                      : gum::round_significant(*evaluation.sigma_pt, k_digits_of_computed_sigma);
}

/// σ_pt for the checks of the items; a third of δ_E where there is none, for |z| = 3 stands at δ_E then.
double sigma_of_checks(const LaboratoryData& data, const ComparisonItemEvaluation& evaluation) {
    if (!evaluation.sigma_pt && !evaluation.delta_E) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-COMPARE-0104",
                            .where = data.where,
                            .what = "homogeneity or stability is to be checked, and sigma_pt is not stated",
                            .rule = "the criteria are 0.3 sigma_pt (ISO 13528:2022, annex B)",
                            .action = "State sigma_pt or delta_E."});
    }
    return evaluation.sigma_pt ? *evaluation.sigma_pt : *evaluation.delta_E / 3.0;
}

void print_homogeneity(reports::HomogeneitySummary& summary) {
    summary.printed.mean = printed_value(summary.mean, summary.s_x > 0.0 ? summary.s_x : summary.s_w);
    summary.printed.s_x = printed_uncertainty(summary.s_x);
    summary.printed.s_w = printed_uncertainty(summary.s_w);
    summary.printed.s_s = printed_uncertainty(summary.s_s);
    summary.printed.limit = printed_uncertainty(summary.limit);
    summary.printed.expanded_limit = printed_uncertainty(summary.expanded_limit);
}

void add_checks(const LaboratoryData& data, ComparisonItemEvaluation& evaluation) {
    if (data.item->stability && !data.item->homogeneity) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-COMPARE-0108",
                            .where = data.where,
                            .what = "stability without homogeneity",
                            .rule = "items are measured again, and held against their mean in the first check",
                            .action = "State the results of the first check as homogeneity."});
    }
    if (!data.item->homogeneity) {
        return;
    }
    const double sigma = sigma_of_checks(data, evaluation);
    const gum::HomogeneityCheck check = gum::check_homogeneity(*data.item->homogeneity, sigma);
    reports::HomogeneitySummary summary;
    summary.items = static_cast<std::int64_t>(check.items);
    summary.replicates = static_cast<std::int64_t>(check.replicates);
    summary.mean = check.mean;
    summary.s_x = check.s_x;
    summary.s_w = check.s_w;
    summary.s_s = check.s_s;
    summary.limit = check.limit;
    summary.expanded_limit = check.expanded_limit;
    summary.sufficient = check.sufficient;
    summary.sufficient_expanded = check.sufficient_expanded;
    print_homogeneity(summary);
    evaluation.homogeneity = summary;
    evaluation.u_homogeneity = check.s_s;
    if (!data.item->stability) {
        return;
    }
    const gum::StabilityCheck later = gum::check_stability(check, *data.item->stability, sigma);
    reports::StabilitySummary stability;
    stability.mean = later.mean;
    stability.difference = later.difference;
    stability.u_difference = later.u_difference;
    stability.limit = later.limit;
    stability.expanded_limit = later.expanded_limit;
    stability.stable = later.stable;
    stability.stable_expanded = later.stable_expanded;
    stability.printed.mean = printed_value(later.mean, check.s_x > 0.0 ? check.s_x : check.s_w);
    stability.printed.difference = printed_uncertainty(later.difference);
    stability.printed.limit = printed_uncertainty(later.limit);
    stability.printed.expanded_limit = printed_uncertainty(later.expanded_limit);
    evaluation.stability = stability;
    evaluation.u_stability = later.stable_expanded ? 0.0 : later.difference / std::numbers::sqrt3;
}

/// U = t_p(ν) u of the scatter, with what the item adds; k = U/u(X) says how far it is from the usual 2.
void expand_by_scatter(double coverage_probability, const ConsensusScatter& scatter, double of_items,
                       ComparisonItemEvaluation& evaluation) {
    const gum::SpreadUncertainty nothing;
    const gum::SpreadDifference whole =
        gum::spread_difference(nothing, scatter.of_value, of_items, 0.0, 0.0, 1.0, coverage_probability);
    evaluation.U = whole.U;
    evaluation.k = whole.U / *evaluation.u;
    evaluation.nu = finite_or_none(whole.degrees_of_freedom);
    evaluation.U_rests_on = "scatter";
}

/// How much of all assigned values y ± U would cover if the laboratories differed by a further τ as large as the median
/// of their u: what the stated uncertainties alone do not know.
std::optional<double> coverage_with_scatter(const LaboratoryData& data, const AssignedValue& assigned, double U) {
    std::vector<double> u;
    double variance = 0.0;
    for (const std::size_t i : data.contributing) {
        if (!data.has_u(i)) {
            return std::nullopt;
        }
        u.push_back(data.u[static_cast<Eigen::Index>(i)]);
    }
    if (u.size() < 2 || !(U > 0.0)) {
        return std::nullopt;
    }
    const double tau = gum::median(u);
    if (assigned.weights.size() > 0) {
        variance = assigned.weights.squaredNorm();
    } else {
        variance = (*assigned.u / tau) * (*assigned.u / tau);  // of a median: as its uncertainty grows with u
    }
    const double u_with = std::hypot(*assigned.u, tau * std::sqrt(variance));
    return gum::chi_square_lower_tail((U / u_with) * (U / u_with), 1.0);
}

void add_uncertainty(const engine::ComparisonJob& job, const LaboratoryData& data, const AssignedValue& assigned,
                     ComparisonItemEvaluation& evaluation) {
    evaluation.u_characterisation = assigned.u;
    const double of_items = std::hypot(evaluation.u_homogeneity.value_or(0.0), evaluation.u_stability.value_or(0.0));
    const double p_of_scores = gum::en_coverage_probability(job.coverage_probability);
    if (assigned.u) {
        evaluation.u = std::hypot(*assigned.u, of_items);
        const std::vector<gum::UncertaintyContribution> parts = {{*assigned.u, assigned.degrees_of_freedom},
                                                                 {of_items}};
        const double nu =
            *evaluation.u > 0.0 ? gum::effective_degrees_of_freedom(parts) : std::numeric_limits<double>::infinity();
        if (assigned.scatter && *evaluation.u > 0.0) {
            expand_by_scatter(job.coverage_probability, *assigned.scatter, of_items, evaluation);
            if (assigned.scatter->others.empty()) {
                evaluation.U_of_scores = gum::coverage_factor(p_of_scores, nu) * *evaluation.u;
            }
        } else if (of_items == 0.0 && assigned.stated) {
            evaluation.U = assigned.stated->U;
            evaluation.k = assigned.stated->k;
            evaluation.nu = finite_or_none(nu);
            evaluation.U_rests_on = "statement";
        } else if (*evaluation.u > 0.0) {
            evaluation.k = gum::coverage_factor(job.coverage_probability, nu);
            evaluation.U = *evaluation.k * *evaluation.u;
            evaluation.nu = finite_or_none(nu);
            evaluation.U_rests_on = assigned.stated ? "statement" : "uncertainties";
        } else {
            evaluation.U = 0.0;
        }
        if (evaluation.U_rests_on == "uncertainties") {
            evaluation.coverage_with_scatter = coverage_with_scatter(data, assigned, *evaluation.U);
        }
        if (!assigned.scatter && evaluation.k) {
            const gum::EnUncertainty of_scores =
                gum::en_uncertainty(*evaluation.u, *evaluation.U, *evaluation.k, nu, job.coverage_probability);
            evaluation.U_of_scores = of_scores.converted ? std::optional(of_scores.U) : std::nullopt;
        }
    }
    if (assigned.intervals && of_items == 0.0) {
        evaluation.low = assigned.intervals->low;
        evaluation.high = assigned.intervals->high;
        evaluation.printed.low = printed_value(*evaluation.low, evaluation.U);
        evaluation.printed.high = printed_value(*evaluation.high, evaluation.U);
    }
    evaluation.printed.nu = evaluation.nu ? certificate::printed_degrees_of_freedom(evaluation.nu) : "";
    evaluation.printed.U_of_scores = printed_uncertainty(evaluation.U_of_scores);
    evaluation.printed.coverage_with_scatter =
        evaluation.coverage_with_scatter ? gum::percent(*evaluation.coverage_with_scatter) + " %" : "";
    evaluation.printed.value = printed_value(evaluation.value, evaluation.U);
    evaluation.printed.u = printed_uncertainty(evaluation.u);
    evaluation.printed.U = printed_uncertainty(evaluation.U);
    evaluation.printed.k = printed_score(evaluation.k);
    evaluation.printed.u_characterisation = printed_uncertainty(evaluation.u_characterisation);
    evaluation.printed.u_homogeneity = printed_uncertainty(evaluation.u_homogeneity);
    evaluation.printed.u_stability = printed_uncertainty(evaluation.u_stability);
}

void add_consensus_check(const LaboratoryData& data, ComparisonItemEvaluation& evaluation) {
    const engine::ComparisonItem& item = *data.item;
    if (!item.reference_value || !item.u_reference_value || !evaluation.u) {
        return;
    }
    reports::ConsensusCheck check;
    check.reference_value = *item.reference_value;
    check.u_reference = *item.u_reference_value;
    check.consensus = evaluation.value;
    check.u_consensus = *evaluation.u;
    check.difference = check.consensus - check.reference_value;
    check.u_difference = std::hypot(check.u_consensus, check.u_reference);
    if (!(check.u_difference > 0.0)) {
        return;
    }
    check.ratio = check.difference / check.u_difference;
    check.consistent = std::abs(check.difference) <= 2.0 * check.u_difference;
    check.printed.reference_value = printed_value(check.reference_value, check.u_reference);
    check.printed.consensus = printed_value(check.consensus, check.u_consensus);
    check.printed.difference = printed_value(check.difference, check.u_difference);
    check.printed.u_difference = printed_uncertainty(check.u_difference);
    check.printed.ratio = printed_score(check.ratio);
    evaluation.consensus = check;
}

/// Three decimals, or as many more as it takes to see that the limit is exceeded.
std::string printed_criterion(double criterion, bool met) {
    constexpr int k_decimals = 3;
    constexpr int k_most_decimals = 12;
    int decimals = k_decimals;
    while (!met && decimals < k_most_decimals &&
           gum::round_to_quantum(criterion, decimals) ==
               gum::round_to_quantum(gum::k_assigned_value_criterion, decimals)) {
        ++decimals;
    }
    return gum::round_to_quantum(criterion, decimals);
}

/// The score that decides: z where the scheme has a σ_pt, z' where the assigned value is too uncertain for it; E_n of
/// stated uncertainties else; D where there is only a limit.
std::string deciding_score(const LaboratoryData& data, const ComparisonItemEvaluation& evaluation) {
    if (evaluation.sigma_pt) {
        return evaluation.criterion_met.value_or(true) ? "z" : "z_prime";
    }
    if (evaluation.u && !data.with_u().empty()) {
        return "En";
    }
    return evaluation.delta_E ? "D" : "";
}

/// A consensus of results that are equal has no uncertainty: without another limit nothing can be scored.
void require_score(const LaboratoryData& data, const ComparisonItemEvaluation& evaluation) {
    if (!evaluation.u && evaluation.score.empty()) {
        throw gum::InputError(gum::Diagnostic{
            .code = "GC-COMPARE-0109",
            .where = data.where,
            .what = "more than half of the results are equal: no uncertainty of the assigned value can be stated",
            .rule = "a score needs it, or sigma_pt, or delta_E",
            .action = "Ask for results with more digits, state sigma_pt or delta_E, or give an "
                      "assigned value with its uncertainty."});
    }
}

}  // namespace

ComparisonItemEvaluation item_evaluation(const engine::ComparisonJob& job, const LaboratoryData& data,
                                         const AssignedValue& assigned) {
    ComparisonItemEvaluation evaluation;
    evaluation.value = assigned.value;
    describe(job, data, assigned, evaluation);
    at_place(data.where, [&] {
        add_sigma_pt(data, evaluation);
        add_checks(data, evaluation);
    });
    add_uncertainty(job, data, assigned, evaluation);
    if (evaluation.sigma_pt && evaluation.u) {
        evaluation.criterion = *evaluation.u / *evaluation.sigma_pt;
        evaluation.criterion_met = *evaluation.criterion <= gum::k_assigned_value_criterion * k_rounding;
        evaluation.printed.criterion = printed_criterion(*evaluation.criterion, *evaluation.criterion_met);
    }
    evaluation.consistency = consistency_of(data, assigned);
    evaluation.estimates = reference_estimates(data, assigned, job.coverage_probability);
    evaluation.s_star = robust_standard_deviation(data);
    evaluation.printed.s_star = printed_uncertainty(evaluation.s_star);
    evaluation.pooled_standard_deviation = pooled_standard_deviation(data);
    evaluation.printed.pooled_standard_deviation = printed_uncertainty(evaluation.pooled_standard_deviation);
    add_consensus_check(data, evaluation);
    evaluation.score = deciding_score(data, evaluation);
    require_score(data, evaluation);
    return evaluation;
}

}  // namespace gumcert::app
