#include "gum/comparison/item_result.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "gum/comparison/consensus_spread.h"
#include "gum/comparison/refusal_place.h"
#include "gum/comparison/robust_statistics.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

// The order of the steps is that of what they need: σ_pt may be a percentage of the assigned value; the checks of the
// items need σ_pt; u(X) needs what the checks say of the items; and the score that decides follows from u(X) against
// σ_pt.

namespace {

constexpr double k_rounding_of_criterion = 1.0 + 1e-14;  // of u(X)/σ_pt, which is exactly the limit in decimal numbers

void describe(const ComparisonScheme& scheme, const LaboratoryData& data, const AssignedValue& assigned,
              ItemResult& result) {
    const auto participant = [&](std::size_t position) { return data.results[position]->participant; };
    result.item = data.item_position;
    result.round = data.round;
    result.method = data.item->assigned_value.method;
    const bool given = result.method == AssignedValueMethod::given;
    if (data.reference) {
        result.reference_participant = participant(*data.reference);
    }
    result.results = data.size();
    const bool by_results = !data.reference && !given;
    result.contributing = by_results       ? data.contributing.size() - assigned.not_consistent.size()
                          : data.reference ? 1
                                           : 0;
    std::vector<bool> present(scheme.participants.size(), false);
    for (std::size_t i = 0; i < data.size(); ++i) {
        present[participant(i)] = true;
        if (!data.results[i]->contributes) {
            result.not_contributing.push_back(participant(i));
        }
    }
    for (std::size_t p = 0; p < present.size(); ++p) {
        if (!present[p]) {
            result.missing.push_back(p);
        }
    }
    for (const std::size_t i : assigned.not_consistent) {
        result.not_consistent.push_back(participant(i));
    }
    // The value of a reference laboratory has the weight 1, which says nothing.
    for (Eigen::Index i = 0; by_results && i < assigned.weights.size(); ++i) {
        if (assigned.weights[i] != 0.0) {
            result.weights.push_back({participant(static_cast<std::size_t>(i)), assigned.weights[i]});
        }
    }
    if (!assigned.not_consistent.empty()) {
        result.consistency_of_all = consistency_test(with_items(data.at(data.contributing), data.between_items()),
                                                     data.item->assigned_value.alpha);
    }
    result.subset_unique = assigned.subset_unique;
    result.u_by_statements = assigned.u_by_statements;
    result.leaves_out_degrees = assigned.leaves_out_degrees;
    for (const std::size_t i : assigned.in_another_subset) {
        result.in_another_subset.push_back(participant(i));
    }
    result.correlation_known = assigned.correlation_known;
    result.shares_sources = given && !assigned.covariance.isZero(0.0);
    result.ambiguous_sources = data.ambiguous_sources;
    result.ambiguous_sources.insert(assigned.ambiguous_sources.begin(), assigned.ambiguous_sources.end());
}

/// The scale of algorithm A. Where it has none no other method of the assigned value helps: σ_pt is stated, then.
double robust_sigma_pt(std::span<const double> results) {
    try {
        return algorithm_a(results).scale;
    } catch (const InputError& refused) {
        std::vector<Diagnostic> problems = refused.diagnostics();
        for (Diagnostic& problem : problems) {
            problem.action =
                problem.code == "GC-GUM-0102"
                    ? "Take a value and a limit that need no such scale (sigma_pt or delta_E), or give the "
                      "results with more digits."
                    : problem.action;
        }
        throw InputError(problems);
    }
}

std::optional<double> sigma_pt_of(const LaboratoryData& data, double assigned_value) {
    if (!data.item->sigma_pt) {
        return std::nullopt;
    }
    const SigmaPtRequest& request = *data.item->sigma_pt;
    const Eigen::VectorXd x = data.values(data.contributing);
    switch (request.method) {
        case SigmaPtMethod::given:
            return request.value;
        case SigmaPtMethod::percent_of_assigned:
            if (has_conventional_zero(data.item->unit)) {
                throw InputError(Diagnostic{.code = "GC-COMPARE-0130",
                                            .where = data.where + ", sigma_pt",
                                            .what = "sigma_pt is a percentage of a value in " + data.item->unit.text(),
                                            .rule = "a percentage of such a value depends on where its zero was put",
                                            .action = "State sigma_pt as a number, in the unit of differences."});
            }
            return request.value / 100.0 * std::abs(assigned_value);
        case SigmaPtMethod::mass_fraction:
            // The formula is one of mass fractions, not of their unit: there and back.
            return sigma_pt_of_mass_fraction(assigned_value * request.mass_fraction_per_unit) /
                   request.mass_fraction_per_unit;
        case SigmaPtMethod::precision:
            return sigma_pt_of_precision(request.reproducibility, request.repeatability, request.replicates);
        case SigmaPtMethod::robust:
            return robust_sigma_pt({x.data(), static_cast<std::size_t>(x.size())});
        case SigmaPtMethod::standard_deviation:
            break;
    }
    // s/√n is the uncertainty of the arithmetic mean; it refuses fewer than two results.
    return arithmetic_mean(x).u * std::sqrt(static_cast<double>(x.size()));
}

void add_sigma_pt(const LaboratoryData& data, ItemResult& result) {
    result.sigma_pt = sigma_pt_of(data, result.value);
    result.delta_E = data.item->delta_E;
    if (!result.sigma_pt) {
        return;
    }
    if (!(*result.sigma_pt > 0.0)) {
        throw InputError(Diagnostic{.code = "GC-COMPARE-0107",
                                    .where = data.where + ", sigma_pt",
                                    .what = "sigma_pt comes out as 0",
                                    .rule = "z-scores divide by it",
                                    .action = "Give a number that is greater than 0."});
    }
    result.sigma_pt_method = data.item->sigma_pt->method;
}

/// σ_pt for the checks of the items; a third of δ_E where there is none, for |z| = 3 stands at δ_E then.
double sigma_of_checks(const LaboratoryData& data, const ItemResult& result) {
    if (!result.sigma_pt && !result.delta_E) {
        throw InputError(Diagnostic{.code = "GC-COMPARE-0104",
                                    .where = data.where,
                                    .what = "homogeneity or stability is to be checked, and sigma_pt is not stated",
                                    .rule = "the criteria are 0.3 sigma_pt (ISO 13528:2022, annex B)",
                                    .action = "State sigma_pt or delta_E."});
    }
    return result.sigma_pt ? *result.sigma_pt : *result.delta_E / 3.0;
}

void add_checks(const LaboratoryData& data, ItemResult& result) {
    if (data.item->stability && !data.item->homogeneity) {
        throw InputError(Diagnostic{.code = "GC-COMPARE-0108",
                                    .where = data.where,
                                    .what = "stability without homogeneity",
                                    .rule = "items are measured again, and held against their mean in the first check",
                                    .action = "State the results of the first check as homogeneity."});
    }
    if (!data.item->homogeneity) {
        return;
    }
    const double sigma = sigma_of_checks(data, result);
    const HomogeneityCheck check = check_homogeneity(*data.item->homogeneity, sigma);
    result.homogeneity = check;
    result.u_homogeneity = check.s_s;
    if (!data.item->stability) {
        return;
    }
    const StabilityCheck later = check_stability(check, *data.item->stability, sigma);
    result.stability = later;
    // A drift of up to the difference, in either direction, with equal probability: the standard deviation of a
    // rectangular distribution. A check that is passed adds nothing, for its difference is one that repeatability
    // explains.
    result.u_stability = later.stable_expanded ? 0.0 : later.difference / std::numbers::sqrt3;
}

/// U = t_p(ν) u of the scatter, with what the item adds; k = U/u(X) says how far it is from the usual 2.
void expand_by_scatter(double coverage_probability, const ConsensusScatter& scatter, double of_items,
                       ItemResult& result) {
    // The value alone: the difference from a laboratory that has no uncertainty and no part in it.
    const SpreadUncertainty nothing;
    const SpreadDifference whole =
        spread_difference(nothing, scatter.of_value, of_items, 0.0, 0.0, 1.0, coverage_probability);
    result.U = whole.U;
    result.k = whole.U / *result.u;
    result.degrees_of_freedom = whole.degrees_of_freedom;
    result.expanded_by = ExpandedBy::scatter;
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
    const double tau = median(u);
    // A variance τ² between laboratories adds τ² Σ w² to u²(X).
    if (assigned.weights.size() > 0) {
        variance = assigned.weights.squaredNorm();
    } else {
        variance = (*assigned.u / tau) * (*assigned.u / tau);  // of a median: as its uncertainty grows with u
    }
    const double u_with = std::hypot(*assigned.u, tau * std::sqrt(variance));
    // P(|y − Y| ≤ U) for a normal y with u_with: the square of (y − Y)/u_with is χ² with 1 degree of freedom.
    return chi_square_lower_tail((U / u_with) * (U / u_with), 1.0);
}

void add_uncertainty(const ComparisonScheme& scheme, const LaboratoryData& data, const AssignedValue& assigned,
                     ItemResult& result) {
    result.u_characterisation = assigned.u;
    const double of_items = result.u_of_item();
    const double p_of_scores = en_coverage_probability(scheme.coverage_probability);
    if (assigned.u) {
        result.u = std::hypot(*assigned.u, of_items);
        const std::vector<UncertaintyContribution> parts = {{*assigned.u, assigned.degrees_of_freedom}, {of_items}};
        const double nu =
            *result.u > 0.0 ? effective_degrees_of_freedom(parts) : std::numeric_limits<double>::infinity();
        // What comes from the scatter goes first: k u(X) of few results does not cover what it claims (ADR 0028). A
        // stated U stays as its owner stated it, as long as the items add nothing.
        if (assigned.scatter && *result.u > 0.0) {
            expand_by_scatter(scheme.coverage_probability, *assigned.scatter, of_items, result);
            // E_n of this mean goes by the stated uncertainties, as in the comparisons that it was made for; U(X) on
            // the page comes from the scatter all the same.
            if (assigned.scatter->others.empty()) {
                result.U_of_scores = coverage_factor(p_of_scores, nu) * *result.u;
            }
        } else if (of_items == 0.0 && assigned.stated) {
            result.U = assigned.stated->U;
            result.k = assigned.stated->k;
            result.degrees_of_freedom = nu;
            result.expanded_by = ExpandedBy::statement;
        } else if (*result.u > 0.0) {
            result.k = coverage_factor(scheme.coverage_probability, nu);
            result.U = *result.k * *result.u;
            result.degrees_of_freedom = nu;
            result.expanded_by = assigned.stated ? ExpandedBy::statement : ExpandedBy::uncertainties;
        } else {
            result.U = 0.0;
        }
        if (result.expanded_by == ExpandedBy::uncertainties) {
            result.coverage_with_scatter = coverage_with_scatter(data, assigned, *result.U);
        }
        // E_n takes both sides for one probability of about 95 %. U by the scatter is formed for that probability where
        // a result is scored.
        if (!assigned.scatter && result.k) {
            const EnUncertainty of_scores =
                result.expanded_by == ExpandedBy::statement && of_items == 0.0
                    ? en_uncertainty(*assigned.stated, scheme.coverage_probability)
                    : en_uncertainty(*result.u, *result.U, *result.k, nu, scheme.coverage_probability);
            result.U_of_scores = of_scores.converted ? std::optional(of_scores.U) : std::nullopt;
        }
    }
    // Trials of the value know nothing of the items.
    if (assigned.intervals && of_items == 0.0) {
        result.low = assigned.intervals->low;
        result.high = assigned.intervals->high;
    }
}

/// What the items add to each result. A subset is looked for before a limit for its drift is known.
ItemUncertainty items_of(const LaboratoryData& data, const AssignedValue& assigned, const ItemResult& result) {
    ItemUncertainty items = data.between_items();
    items.drift = assigned.subset ? 0.0 : result.u_stability.value_or(0.0);
    return items;
}

void add_consensus_check(const LaboratoryData& data, ItemResult& result) {
    const ComparisonItem& item = *data.item;
    if (!item.reference_value || !item.u_reference_value || !result.u) {
        return;
    }
    ConsensusCheck check;
    check.reference_value = *item.reference_value;
    check.u_reference = *item.u_reference_value;
    check.consensus = result.value;
    check.u_consensus = *result.u;
    check.difference = (check.consensus - check.reference_value) + result.rest;
    // The reference value is independent of the laboratories; else it could not check their consensus.
    check.u_difference = std::hypot(check.u_consensus, check.u_reference);
    if (!(check.u_difference > 0.0)) {
        return;
    }
    check.ratio = check.difference / check.u_difference;
    check.consistent = std::abs(check.difference) <= 2.0 * check.u_difference;
    result.consensus = check;
}

DecidingScore deciding_score(const LaboratoryData& data, const ItemResult& result) {
    if (result.sigma_pt) {
        // σ_pt is what the scheme asks of its participants, whatever uncertainty they state; so it goes before E_n.
        return result.criterion_met ? DecidingScore::z : DecidingScore::z_prime;
    }
    if (result.u && !data.with_u().empty()) {
        return DecidingScore::en;
    }
    return result.delta_E ? DecidingScore::difference : DecidingScore::none;
}

/// A consensus of results that are equal has no uncertainty: without another limit nothing can be scored.
void require_score(const LaboratoryData& data, const ItemResult& result) {
    if (!result.u && result.score == DecidingScore::none) {
        throw InputError(Diagnostic{
            .code = "GC-COMPARE-0109",
            .where = data.where,
            .what = "more than half of the results are equal: no uncertainty of the assigned value can be stated",
            .rule = "a score needs it, or sigma_pt, or delta_E",
            .action = "Ask for results with more digits, state sigma_pt or delta_E, or give an "
                      "assigned value with its uncertainty."});
    }
}

}  // namespace

double ItemResult::u_of_item() const {
    return std::hypot(u_homogeneity.value_or(0.0), u_stability.value_or(0.0));
}

ItemResult item_result(const ComparisonScheme& scheme, const LaboratoryData& data, const AssignedValue& assigned) {
    ItemResult result;
    result.value = assigned.value;
    result.rest = assigned.rest;
    describe(scheme, data, assigned, result);
    at_place(data.where, [&] {
        add_sigma_pt(data, result);
        add_checks(data, result);
    });
    add_uncertainty(scheme, data, assigned, result);
    if (result.sigma_pt && result.u) {
        result.criterion = *result.u / *result.sigma_pt;
        result.criterion_met = *result.criterion <= k_assigned_value_criterion * k_rounding_of_criterion;
    }
    result.consistency = consistency_of(data, assigned, items_of(data, assigned, result));
    result.estimates = reference_estimates(data, assigned, scheme.coverage_probability);
    result.s_star = robust_standard_deviation(data);
    result.pooled_standard_deviation = pooled_standard_deviation(data);
    add_consensus_check(data, result);
    result.score = deciding_score(data, result);
    require_score(data, result);
    return result;
}

}  // namespace gumcert::gum
