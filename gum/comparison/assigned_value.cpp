#include "gum/comparison/assigned_value.h"

#include <algorithm>
#include <cmath>

#include "gum/argument_check.h"
#include "gum/comparison/random_effects.h"
#include "gum/comparison/reference_estimates.h"
#include "gum/comparison/refusal_place.h"
#include "gum/comparison/robust_statistics.h"
#include "gum/comparison/shared_sources.h"
#include "gum/coverage.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"
#include "text/lists.h"

namespace gumcert::gum {

namespace {

bool takes_uncertainties(const AssignedValueRequest& request) {
    switch (request.method) {
        case AssignedValueMethod::weighted_mean:
        case AssignedValueMethod::largest_consistent_subset:
        case AssignedValueMethod::dersimonian_laird:
        case AssignedValueMethod::mandel_paule:
        case AssignedValueMethod::power_moderated_mean:
            return true;
        case AssignedValueMethod::median:
            return request.median_by_trials;
        default:
            return false;
    }
}

bool takes_independent_results(AssignedValueMethod method) {
    return method == AssignedValueMethod::dersimonian_laird || method == AssignedValueMethod::mandel_paule ||
           method == AssignedValueMethod::power_moderated_mean || method == AssignedValueMethod::vangel_rukhin;
}

void require_usable(const ComparisonScheme& scheme, const LaboratoryData& data) {
    const AssignedValueRequest& request = data.item->assigned_value;
    const std::string method = word_of(request.method);
    if (data.contributing.empty()) {
        refuse("GC-COMPARE-0100", data.where, "no result is left that contributes to the assigned value",
               method + " is computed from the results", "Let results contribute, or give an assigned value.");
    }
    if (takes_uncertainties(request) && !data.all_have_u(data.contributing)) {
        constexpr std::size_t k_most_names = 5;
        std::vector<std::string> without;
        for (const std::size_t i : data.contributing) {
            if (!data.has_u(i)) {
                without.push_back(scheme.participants[data.results[i]->participant].id);
            }
        }
        refuse("GC-COMPARE-0101", data.where, "no uncertainty is stated by " + text::listed(without, k_most_names),
               method + " weighs results by their uncertainties",
               "State u, or U and k, let these results not contribute, or take median or algorithm_a.");
    }
    if (takes_independent_results(request.method) && data.at(data.contributing).covariance.size() > 0) {
        refuse("GC-COMPARE-0102", data.where, "results that contribute are correlated with each other",
               method + " takes them as independent, and its uncertainty would be too small",
               "Take weighted_mean or largest_consistent_subset, or let only one of them contribute.");
    }
}

Eigen::Index size_of(const LaboratoryData& data) {
    return static_cast<Eigen::Index>(data.size());
}

/// A value that is linear in the results: weights, and covariance with every result.
AssignedValue linear_value(const LaboratoryData& data, const std::vector<std::size_t>& positions,
                           const ReferenceValue& reference) {
    AssignedValue assigned;
    assigned.value = reference.value;
    assigned.rest = reference.rest;
    assigned.u = reference.u;
    assigned.weights = Eigen::VectorXd::Zero(size_of(data));
    for (std::size_t i = 0; i < positions.size(); ++i) {
        assigned.weights[static_cast<Eigen::Index>(positions[i])] = reference.weights[static_cast<Eigen::Index>(i)];
    }
    assigned.covariance = Eigen::VectorXd::Zero(size_of(data));
    // Only for results with a stated u is a covariance with y known. u_above_scatter() sees to it that it is possible.
    const std::vector<std::size_t> with_u = data.with_u();
    if (!with_u.empty() && reference.u > 0.0) {
        ReferenceValue of_all = reference;
        of_all.weights = assigned.weights(with_u);
        const DegreesOfEquivalence degrees = degrees_of_equivalence(data.at(with_u), of_all);
        for (std::size_t i = 0; i < with_u.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(with_u[i]);
            assigned.covariance[at] = degrees.correlation[static_cast<Eigen::Index>(i)] * data.u[at] * reference.u;
        }
    }
    return assigned;
}

/// ν_eff of a weighted mean of independent results by Welch and Satterthwaite (JCGM 100:2008, G.4.1); infinite where
/// the results are correlated, for which the formula does not hold.
double degrees_of_freedom_of(const LaboratoryData& data, const AssignedValue& mean) {
    if (data.at(data.contributing).covariance.size() > 0) {
        return std::numeric_limits<double>::infinity();
    }
    std::vector<UncertaintyContribution> parts;
    for (const std::size_t i : data.contributing) {
        const auto at = static_cast<Eigen::Index>(i);
        parts.push_back({std::abs(mean.weights[at]) * data.u[at], data.results[i]->uncertainty->degrees_of_freedom});
    }
    return effective_degrees_of_freedom(parts);
}

/// Mean covariance of the contributing results with each other: the part of their uncertainty that no scatter shows.
double common_variance(const LaboratoryData& data) {
    const std::size_t n = data.contributing.size();
    if (data.covariance.size() == 0 || n < 2) {
        return 0.0;
    }
    const Eigen::MatrixXd inside = data.covariance(data.contributing, data.contributing);
    // An effect that all results share moves them together, so the scatter cannot show it and it is added to the
    // scatter. A negative mean is not: it would take something away from the scatter that is seen.
    return std::max(0.0, (inside.sum() - inside.trace()) / static_cast<double>(n * (n - 1)));
}

/// \param of_inside  spread of the others for each contributing result; empty where there are only two
void add_scatter(const LaboratoryData& data, SpreadUncertainty of_value,
                 const std::vector<SpreadUncertainty>& of_inside, const Eigen::VectorXd& shares,
                 AssignedValue& assigned) {
    const double common = std::sqrt(common_variance(data));
    ConsensusScatter scatter;
    scatter.of_value = of_value;
    scatter.of_value.u = std::hypot(of_value.u, common);
    // For a result outside the value all contributing ones are "the others".
    scatter.others.assign(data.size(), scatter.of_value);
    scatter.share = Eigen::VectorXd::Zero(size_of(data));
    scatter.covariance = Eigen::VectorXd::Zero(size_of(data));
    for (std::size_t i = 0; i < data.contributing.size(); ++i) {
        const std::size_t at = data.contributing[i];
        scatter.share[static_cast<Eigen::Index>(at)] = shares[static_cast<Eigen::Index>(i)];
        if (!of_inside.empty()) {
            scatter.others[at] = of_inside[i];
            scatter.others[at].u = std::hypot(of_inside[i].u, common);
        } else {  // of two results one is all the others
            const std::size_t other = data.contributing[data.contributing.size() - 1 - i];
            if (data.has_u(other)) {
                scatter.others[at] = {.u = data.u[static_cast<Eigen::Index>(other)],
                                      .degrees_of_freedom = data.results[other]->uncertainty->degrees_of_freedom};
            }
        }
    }
    // The value of the others is Σ_j≠i w_j x_j / Σ_j≠i w_j; its covariance with x_i is taken with the same weights.
    for (Eigen::Index i = 0; data.covariance.size() > 0 && i < size_of(data); ++i) {
        double rest = 0.0;
        double covariance = 0.0;
        for (std::size_t j = 0; j < data.contributing.size(); ++j) {
            const auto at = static_cast<Eigen::Index>(data.contributing[j]);
            const double share = at == i ? 0.0 : shares[static_cast<Eigen::Index>(j)];
            rest += share;
            covariance += share * data.covariance(i, at);
        }
        scatter.covariance[i] = rest > 0.0 ? covariance / rest : 0.0;
    }
    assigned.scatter = std::move(scatter);
}

/// u of Σ w_i x_i by the stated uncertainties and their covariance, √(wᵀ V w); of results without u, as if it were 0.
/// \param weights  of the contributing results
double u_by_statements(const LaboratoryData& data, const Eigen::VectorXd& weights) {
    double square = 0.0;
    for (std::size_t i = 0; i < data.contributing.size(); ++i) {
        const auto a = static_cast<Eigen::Index>(data.contributing[i]);
        const double w = weights[static_cast<Eigen::Index>(i)];
        if (data.covariance.size() == 0) {
            square += data.has_u(data.contributing[i]) ? w * w * data.u[a] * data.u[a] : 0.0;
            continue;
        }
        for (std::size_t j = 0; j < data.contributing.size(); ++j) {
            const auto b = static_cast<Eigen::Index>(data.contributing[j]);
            square += w * weights[static_cast<Eigen::Index>(j)] * data.covariance(a, b);
        }
    }
    return std::sqrt(std::max(square, 0.0));
}

/// The rule for u of a value whose u comes from the scatter of the results: what the stated uncertainties give it, where
/// that is larger and the results correlate; or where with the smaller u a result would correlate with the value by more
/// than 1. Scatter shows nothing of what all results share. Then |cov(x_i, y)| ≤ u_i u(y) holds (Cauchy and Schwarz).
/// \return nothing where the u of the scatter stays
std::optional<double> u_above_scatter(const LaboratoryData& data, const Eigen::VectorXd& weights, double u_of_scatter) {
    constexpr double k_rounding = 1.0 + 1e-9;
    const double stated = u_by_statements(data, weights);
    if (!(u_of_scatter > 0.0) || !(stated > u_of_scatter)) {
        return std::nullopt;
    }
    bool beyond = data.covariance.size() > 0;
    for (std::size_t i = 0; i < data.contributing.size() && !beyond; ++i) {
        const std::size_t at = data.contributing[i];
        beyond =
            data.has_u(at) && std::abs(weights[static_cast<Eigen::Index>(i)]) * data.u[static_cast<Eigen::Index>(at)] >
                                  u_of_scatter * k_rounding;
    }
    return beyond ? std::optional(stated) : std::nullopt;
}

/// u without the part that add_scatter() adds to every spread.
double without_common(const LaboratoryData& data, double u) {
    return std::sqrt(std::max(u * u - common_variance(data), 0.0));
}

/// A mean whose weights allow for a scatter between laboratories.
AssignedValue scattered_value(const LaboratoryData& data, const ReferenceValue& of_scatter,
                              double coverage_probability) {
    const std::optional<double> stated = u_above_scatter(data, of_scatter.weights, of_scatter.u);
    ReferenceValue reference = of_scatter;
    reference.u = stated.value_or(of_scatter.u);
    AssignedValue assigned = linear_value(data, data.contributing, reference);
    assigned.u_by_statements = stated.has_value();
    reference.u = stated ? without_common(data, *stated) : of_scatter.u;
    const Eigen::VectorXd x = data.values(data.contributing);
    add_scatter(data, weighted_spread(x, reference, coverage_probability), spread_of_others(x, reference.weights),
                reference.weights / reference.weights.sum(), assigned);
    return assigned;
}

/// The covariance of each result with a mean of the contributing ones.
Eigen::VectorXd covariance_with_mean(const LaboratoryData& data) {
    Eigen::VectorXd covariance = Eigen::VectorXd::Zero(size_of(data));
    const auto n = static_cast<double>(data.contributing.size());
    for (const std::size_t i : data.contributing) {
        const auto at = static_cast<Eigen::Index>(i);
        covariance[at] = data.u[at] * data.u[at] / n;
    }
    if (data.covariance.size() > 0) {
        for (Eigen::Index i = 0; i < size_of(data); ++i) {
            covariance[i] = data.covariance(i, data.contributing).sum() / n;
        }
    }
    return covariance;
}

AssignedValue robust_value(const LaboratoryData& data, RobustMean kind, const RobustEstimate& estimate,
                           double coverage_probability) {
    AssignedValue assigned;
    assigned.value = estimate.location;
    assigned.rest = estimate.rest;
    // A scale of 0 says that more than half of the results are equal, not that the value is exactly known.
    assigned.u = estimate.scale > 0.0 ? std::optional(estimate.u) : std::nullopt;
    assigned.correlation_known = false;
    // Exact for normal results of equal uncertainty and any location that moves with them: such a location less their
    // mean does not depend on the mean (theorem of Basu).
    assigned.covariance = covariance_with_mean(data);
    const Eigen::VectorXd x = data.values(data.contributing);
    const std::vector<double> values(x.data(), x.data() + x.size());
    // u²/n is that of the mean. A result with a u far above the others has less of a robust mean than that: where more
    // would be shared than u and u(y) allow, nothing is taken as shared, which changes u(D) by less than u/n.
    constexpr double k_possible = 1.0 + 1e-9;
    for (const std::size_t i : data.contributing) {
        const auto at = static_cast<Eigen::Index>(i);
        if (data.covariance.size() == 0 &&
            assigned.covariance[at] > k_possible * data.u[at] * assigned.u.value_or(0.0)) {
            assigned.covariance[at] = 0.0;
        }
    }
    SpreadUncertainty spread = robust_spread(kind, values);
    const Eigen::VectorXd shares = Eigen::VectorXd::Constant(x.size(), 1.0 / static_cast<double>(x.size()));
    if (const std::optional<double> stated =
            assigned.u && data.covariance.size() > 0 ? u_above_scatter(data, shares, *assigned.u) : std::nullopt) {
        assigned.u = stated;
        assigned.u_by_statements = true;
        // As weighted_spread() does: U(X) is not below k u(X).
        constexpr double k_normal = std::numeric_limits<double>::infinity();
        if (spread.u > 0.0 && coverage_factor(coverage_probability, k_normal) * *stated >
                                  coverage_factor(coverage_probability, spread.degrees_of_freedom) *
                                      std::hypot(spread.u, std::sqrt(common_variance(data)))) {
            spread = {.u = without_common(data, *stated)};
        }
    }
    if (assigned.u && spread.u > 0.0) {
        add_scatter(data, spread, robust_spread_of_others(kind, values), shares, assigned);
        assigned.scatter->factor = kind == RobustMean::median ? median_difference_factor(values.size()) : 1.0;
    } else {
        assigned.u = std::nullopt;
    }
    return assigned;
}

/// cov(x_j, y) of a result outside a value that is made of the contributing ones, V_jC V_CC⁻¹ cov(x_C, y): what a
/// normally distributed x_j has beyond its regression on them is independent of them, and so of any function of them.
void add_results_outside(const LaboratoryData& data, AssignedValue& assigned) {
    if (data.covariance.size() == 0) {
        return;
    }
    const std::vector<std::size_t>& inside = data.contributing;
    const Eigen::VectorXd of_inside = assigned.covariance(inside);
    const Eigen::MatrixXd between = data.covariance(inside, inside);
    // Results with r = 1 make V_CC singular: of all solutions the one of least norm.
    const Eigen::VectorXd solved = between.completeOrthogonalDecomposition().solve(of_inside);
    for (std::size_t j = 0; j < data.size(); ++j) {
        if (!std::binary_search(inside.begin(), inside.end(), j)) {
            const Eigen::RowVectorXd with_inside = data.covariance(static_cast<Eigen::Index>(j), inside);
            assigned.covariance[static_cast<Eigen::Index>(j)] = with_inside.dot(solved);
        }
    }
}

AssignedValue median_by_trials(const ComparisonScheme& scheme, const LaboratoryData& data) {
    const AssignedValueRequest& request = data.item->assigned_value;
    const MedianTrials trials =
        median_trials(data.at(data.contributing), request.trials, request.seed, scheme.coverage_probability);
    AssignedValue assigned;
    assigned.value = trials.median;
    assigned.u = trials.u;
    assigned.degrees_of_freedom = trials.degrees_of_freedom;
    assigned.leaves_out_degrees = trials.leaves_out_degrees;
    assigned.covariance = Eigen::VectorXd::Zero(size_of(data));
    for (std::size_t i = 0; i < data.contributing.size(); ++i) {
        // u²(x_i − y) = u_i² + u²(y) − 2 cov(x_i, y), all three over the same trials.
        const auto at = static_cast<Eigen::Index>(data.contributing[i]);
        const double u_d = trials.u_d[static_cast<Eigen::Index>(i)];
        assigned.covariance[at] = 0.5 * (data.u[at] * data.u[at] + trials.u * trials.u - u_d * u_d);
    }
    add_results_outside(data, assigned);
    TrialIntervals intervals{.low = trials.low, .high = trials.high, .d_low = {}, .d_high = {}};
    intervals.d_low = Eigen::VectorXd::Constant(size_of(data), std::numeric_limits<double>::quiet_NaN());
    intervals.d_high = intervals.d_low;
    for (std::size_t i = 0; i < data.contributing.size(); ++i) {
        intervals.d_low[static_cast<Eigen::Index>(data.contributing[i])] = trials.d_low[static_cast<Eigen::Index>(i)];
        intervals.d_high[static_cast<Eigen::Index>(data.contributing[i])] = trials.d_high[static_cast<Eigen::Index>(i)];
    }
    assigned.intervals = std::move(intervals);
    return assigned;
}

AssignedValue largest_subset(const LaboratoryData& data, double alpha) {
    const ConsistentSubset subset = consistent_subset_of(data, alpha);
    // The method takes those that agree for right and the others for wrong. Where more results contradict the value
    // than support it, the results themselves refute that.
    if (2 * subset.members.size() < data.contributing.size()) {
        throw NoResultError(Diagnostic{
            .code = "GC-COMPARE-0114",
            .where = data.where,
            .what = "the largest consistent subset holds " + std::to_string(subset.members.size()) + " of " +
                    std::to_string(data.contributing.size()) + " results",
            .rule = "at least half of the results must speak for it",
            .action = "Look for groups of results and for what tells them apart; one value does not describe them."});
    }
    AssignedValue assigned = linear_value(data, data.contributing, subset.mean);
    assigned.degrees_of_freedom = degrees_of_freedom_of(data, assigned);
    for (std::size_t i = 0; i < data.contributing.size(); ++i) {
        if (!std::binary_search(subset.members.begin(), subset.members.end(), i)) {
            assigned.not_consistent.push_back(data.contributing[i]);
        }
    }
    assigned.subset = subset.test;
    assigned.subset_unique = subset.unique;
    for (const std::size_t i : subset.in_another) {
        assigned.in_another_subset.push_back(data.contributing[i]);
    }
    return assigned;
}

AssignedValue value_of_reference_laboratory(const LaboratoryData& data) {
    const ParticipantResult& result = *data.results[*data.reference];
    const auto at = static_cast<Eigen::Index>(*data.reference);
    AssignedValue assigned;
    assigned.value = result.value;
    assigned.u = result.uncertainty->u;
    assigned.degrees_of_freedom = result.uncertainty->degrees_of_freedom;
    assigned.stated = result.uncertainty;
    assigned.weights = Eigen::VectorXd::Zero(size_of(data));
    assigned.weights[at] = 1.0;
    assigned.covariance = Eigen::VectorXd::Zero(size_of(data));
    if (data.covariance.size() > 0) {
        assigned.covariance = data.covariance.col(at);
    }
    // The value is this result: u(D) is 0 for the laboratory itself, and what others share with it they share with the
    // value.
    assigned.covariance[at] = data.u[at] * data.u[at];
    return assigned;
}

AssignedValue given_value(const ComparisonScheme& scheme, const LaboratoryData& data) {
    const AssignedValueRequest& request = data.item->assigned_value;
    AssignedValue assigned;
    assigned.value = request.value;
    // A given value without an uncertainty is taken as exactly known, as a definition is.
    assigned.u = request.uncertainty ? request.uncertainty->u : 0.0;
    assigned.stated = request.uncertainty;
    if (request.uncertainty) {
        assigned.degrees_of_freedom = request.uncertainty->degrees_of_freedom;
    }
    assigned.covariance = Eigen::VectorXd::Zero(size_of(data));
    for (std::size_t i = 0; !request.sources.empty() && i < data.size(); ++i) {
        for (const SourceCovariance& shared :
             shared_covariance(data.results[i]->sources, request.sources, scheme.independent_sources)) {
            assigned.covariance[static_cast<Eigen::Index>(i)] += shared.covariance;
            if (shared.ambiguous) {
                assigned.ambiguous_sources.insert(shared.source);
            }
        }
    }
    return assigned;
}

AssignedValue mean_of_replicates(const LaboratoryData& data, double coverage_probability) {
    const std::optional<Replicates> stated = replicates(data);
    if (!stated) {
        refuse("GC-COMPARE-0105", data.where,
               "not every result states the standard deviation s and the number n of its observations",
               "vangel_rukhin is computed from them", "State s and n ≥ 2 of every result, or take mandel_paule.");
    }
    // Only s and n of each laboratory enter, not its stated u: the method estimates the variances itself.
    return scattered_value(data, vangel_rukhin({stated->x, stated->s, stated->observations}), coverage_probability);
}

AssignedValue consensus(const ComparisonScheme& scheme, const LaboratoryData& data) {
    const AssignedValueRequest& request = data.item->assigned_value;
    const std::vector<std::size_t>& chosen = data.contributing;
    const double p = scheme.coverage_probability;
    const Eigen::VectorXd x = data.values(chosen);
    const std::span<const double> values(x.data(), static_cast<std::size_t>(x.size()));
    switch (request.method) {
        case AssignedValueMethod::arithmetic_mean: {
            AssignedValue mean = scattered_value(data, arithmetic_mean(x), p);
            if (!mean.u_by_statements) {
                mean.degrees_of_freedom = static_cast<double>(chosen.size() - 1);
            }
            if (!(*mean.u > 0.0)) {
                // Equal results say that digits are missing, not that the value is exactly known.
                mean.u = std::nullopt;
                mean.scatter = std::nullopt;
            }
            return mean;
        }
        case AssignedValueMethod::median:
            return request.median_by_trials ? median_by_trials(scheme, data)
                                            : robust_value(data, RobustMean::median, median_with_made(values), p);
        case AssignedValueMethod::algorithm_a:
            return robust_value(data, RobustMean::algorithm_a,
                                algorithm_a(values, request.exact_constants ? AlgorithmAConstants::exact
                                                                            : AlgorithmAConstants::published),
                                p);
        case AssignedValueMethod::q_hampel:
            return robust_value(data, RobustMean::q_hampel, supported_q_hampel(values), p);
        case AssignedValueMethod::largest_consistent_subset:
            return largest_subset(data, request.alpha);
        case AssignedValueMethod::dersimonian_laird:
            return scattered_value(data, dersimonian_laird(data.at(chosen)), p);
        case AssignedValueMethod::mandel_paule:
            return scattered_value(data, mandel_paule(data.at(chosen)), p);
        case AssignedValueMethod::vangel_rukhin:
            return mean_of_replicates(data, p);
        case AssignedValueMethod::power_moderated_mean: {
            AssignedValue mean = scattered_value(data,
                                                 request.power ? power_moderated_mean(data.at(chosen), *request.power)
                                                               : power_moderated_mean(data.at(chosen)),
                                                 p);
            mean.scatter->others.clear();  // degrees of equivalence as in the comparisons that this mean is made for
            return mean;
        }
        default: {
            AssignedValue mean = linear_value(data, chosen, weighted_mean(data.at(chosen)));
            mean.degrees_of_freedom = degrees_of_freedom_of(data, mean);
            return mean;
        }
    }
}

}  // namespace

AssignedValue assigned_value(const ComparisonScheme& scheme, const LaboratoryData& data) {
    const AssignedValueMethod method = data.item->assigned_value.method;
    AssignedValue assigned;
    at_place(data.where, [&] {
        if (method == AssignedValueMethod::reference) {
            assigned = value_of_reference_laboratory(data);
        } else if (method == AssignedValueMethod::given) {
            assigned = given_value(scheme, data);
        } else {
            require_usable(scheme, data);
            assigned = consensus(scheme, data);
        }
    });
    return assigned;
}

std::optional<Replicates> replicates(const LaboratoryData& data) {
    Replicates stated;
    const auto n = static_cast<Eigen::Index>(data.contributing.size());
    stated.x.resize(n);
    stated.s.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const ParticipantResult& result = *data.results[data.contributing[static_cast<std::size_t>(i)]];
        if (!result.standard_deviation || !(*result.standard_deviation > 0.0) || result.observations < 2) {
            return std::nullopt;
        }
        stated.x[i] = result.value;
        stated.s[i] = *result.standard_deviation;
        stated.observations.push_back(result.observations);
    }
    return n < 2 ? std::nullopt : std::optional(stated);
}

}  // namespace gumcert::gum
