#include "gum/comparison/reference_estimates.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <span>

#include "gum/comparison/consensus_spread.h"
#include "gum/comparison/random_effects.h"
#include "gum/comparison/refusal_place.h"
#include "gum/comparison/robust_statistics.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

namespace {

/// Collects estimates; one that the data do not allow is left out.
class Estimates {
public:
    Estimates(const LaboratoryData& data, const AssignedValue& assigned, double coverage_probability)
        : data_(data), assigned_(assigned), coverage_probability_(coverage_probability) {}

    /// U of an estimate by the scatter of the results.
    void expand(ReferenceEstimate& estimate, const SpreadUncertainty& spread) const {
        // Results that are equal have no scatter to take U from; that says nothing of the value.
        if (estimate.u && spread.u > 0.0) {
            estimate.U = coverage_factor(coverage_probability_, spread.degrees_of_freedom) * spread.u;
            estimate.degrees_of_freedom = spread.degrees_of_freedom;
        }
    }

    void add(const std::string& method, const std::function<void(ReferenceEstimate&)>& evaluate) {
        ReferenceEstimate estimate;
        estimate.method = method;
        estimate.results = data_.contributing.size();
        try {
            evaluate(estimate);
        } catch (const DiagnosedError&) {
            return;  // not possible with these data, and not asked for
        }
        all_.push_back(std::move(estimate));
    }

    void add(AssignedValueMethod method, const std::function<void(ReferenceEstimate&)>& evaluate) {
        add(word_of(method), [&](ReferenceEstimate& estimate) {
            evaluate(estimate);
            if (method == data_.item->assigned_value.method) {  // with all that was asked, trials or constants
                estimate.value = assigned_.value;
                estimate.rest = assigned_.rest;
                estimate.u = assigned_.u;
                estimate.used = true;
            }
            if (data_.item->assigned_value.method == AssignedValueMethod::median &&
                data_.item->assigned_value.median_by_trials && method == AssignedValueMethod::median) {
                // The median by trials has its own interval; U of the plain median does not belong to it.
                estimate.U = std::nullopt;
                estimate.degrees_of_freedom = std::numeric_limits<double>::infinity();
            }
        });
    }

    [[nodiscard]] std::vector<ReferenceEstimate> take() { return std::move(all_); }
    [[nodiscard]] double coverage_probability() const { return coverage_probability_; }

private:
    const LaboratoryData& data_;
    const AssignedValue& assigned_;
    double coverage_probability_;
    std::vector<ReferenceEstimate> all_;
};

void take(ReferenceEstimate& estimate, const ReferenceValue& value) {
    estimate.value = value.value;
    estimate.rest = value.rest;
    estimate.u = value.u;
}

void take_random_effects(ReferenceEstimate& estimate, const ReferenceValue& value) {
    take(estimate, value);
    estimate.between = value.between_standard_deviation;
}

void take_robust(ReferenceEstimate& estimate, const RobustEstimate& value) {
    estimate.value = value.location;
    estimate.rest = value.rest;
    estimate.scale = value.scale;
    if (value.scale > 0.0) {
        estimate.u = value.u;
    }
}

/// What the nearest double leaves of the mean of the two results in the middle.
double rest_of_median(Eigen::VectorXd x, double value) {
    std::sort(x.begin(), x.end());
    const Eigen::Index n = x.size();
    return 0.5 * ((x[(n - 1) / 2] - value) + (x[n / 2] - value));
}

void add_by_uncertainty(Estimates& estimates, const LaboratoryData& data, const LaboratoryResults& results) {
    const AssignedValueRequest& request = data.item->assigned_value;
    // The variance between laboratories, and so all means with τ, is estimated as if results were independent. The
    // largest subset of many laboratories costs too much to stand there unasked.
    const bool independent = results.covariance.size() == 0;
    estimates.add(AssignedValueMethod::weighted_mean,
                  [&](ReferenceEstimate& estimate) { take(estimate, weighted_mean(results)); });
    const bool asked = request.method == AssignedValueMethod::largest_consistent_subset;
    if (asked || (independent && data.contributing.size() <= k_most_laboratories_in_pairs)) {
        estimates.add(AssignedValueMethod::largest_consistent_subset, [&](ReferenceEstimate& estimate) {
            const ConsistentSubset subset = consistent_subset_of(data, request.alpha);
            take(estimate, subset.mean);
            estimate.results = subset.members.size();
        });
    }
    if (independent) {
        const auto add = [&](AssignedValueMethod method, ReferenceValue (*evaluate)(const LaboratoryResults&)) {
            estimates.add(method, [&](ReferenceEstimate& estimate) {
                const ReferenceValue mean = evaluate(results);
                take_random_effects(estimate, mean);
                estimates.expand(estimate, weighted_spread(results.x, mean, estimates.coverage_probability()));
                estimate.u_hartung_knapp = hartung_knapp_u(results, mean);
            });
        };
        add(AssignedValueMethod::dersimonian_laird, dersimonian_laird);
        add(AssignedValueMethod::mandel_paule, mandel_paule);
    }
}

}  // namespace

std::vector<ReferenceEstimate> reference_estimates(const LaboratoryData& data, const AssignedValue& assigned,
                                                   double coverage_probability) {
    const AssignedValueRequest& request = data.item->assigned_value;
    Estimates estimates(data, assigned, coverage_probability);
    if (data.contributing.size() < 2) {
        return {};
    }
    const Eigen::VectorXd x = data.values(data.contributing);
    const std::span<const double> values(x.data(), static_cast<std::size_t>(x.size()));
    // Means that rest on stated uncertainties need all of them: a laboratory without one would get a weight that nobody
    // stated.
    const bool weighed = data.all_have_u(data.contributing);
    const LaboratoryResults results = data.at(data.contributing);
    estimates.add(AssignedValueMethod::arithmetic_mean, [&](ReferenceEstimate& estimate) {
        const ReferenceValue mean = arithmetic_mean(x);
        estimate.value = mean.value;
        estimate.rest = mean.rest;
        estimate.scale = mean.u * std::sqrt(static_cast<double>(x.size()));  // exactly 0 for equal results
        if (mean.u > 0.0) {
            estimate.u = mean.u;
            estimates.expand(estimate, weighted_spread(x, mean, estimates.coverage_probability()));
        }
    });
    const auto add_robust = [&](AssignedValueMethod method, RobustMean kind, const auto& evaluate) {
        estimates.add(method, [&](ReferenceEstimate& estimate) {
            take_robust(estimate, evaluate());
            estimates.expand(estimate, robust_spread(kind, values));
        });
    };
    add_robust(AssignedValueMethod::median, RobustMean::median, [&] { return median_with_made(values); });
    estimates.add("niqr", [&](ReferenceEstimate& estimate) {
        estimate.value = median(values);
        estimate.rest = rest_of_median(x, estimate.value);
        estimate.scale = normalised_interquartile_range(values);
    });
    add_robust(AssignedValueMethod::algorithm_a, RobustMean::algorithm_a, [&] {
        return algorithm_a(values,
                           request.exact_constants ? AlgorithmAConstants::exact : AlgorithmAConstants::published);
    });
    add_robust(AssignedValueMethod::q_hampel, RobustMean::q_hampel, [&] { return supported_q_hampel(values); });
    if (weighed) {
        add_by_uncertainty(estimates, data, results);
    }
    if (const std::optional<Replicates> stated = replicates(data); stated && results.covariance.size() == 0) {
        estimates.add(AssignedValueMethod::vangel_rukhin, [&](ReferenceEstimate& estimate) {
            const ReferenceValue mean = vangel_rukhin({stated->x, stated->s, stated->observations});
            take_random_effects(estimate, mean);
            estimates.expand(estimate, weighted_spread(stated->x, mean, estimates.coverage_probability()));
        });
    }
    if (weighed && results.covariance.size() == 0) {
        estimates.add(AssignedValueMethod::power_moderated_mean, [&](ReferenceEstimate& estimate) {
            const ReferenceValue mean =
                request.power ? power_moderated_mean(results, *request.power) : power_moderated_mean(results);
            take_random_effects(estimate, mean);
            estimates.expand(estimate, weighted_spread(results.x, mean, estimates.coverage_probability()));
        });
    }
    if (data.item->kernel_bandwidth) {
        estimates.add("kernel_mode", [&](ReferenceEstimate& estimate) {
            estimate.value = kernel_density_mode(values, *data.item->kernel_bandwidth);
            estimate.scale = *data.item->kernel_bandwidth;
        });
    }
    return estimates.take();
}

ConsistentSubset consistent_subset_of(const LaboratoryData& data, double alpha) {
    const LaboratoryResults results = data.at(data.contributing);
    const ItemUncertainty items = data.between_items();
    ConsistentSubset subset = largest_consistent_subset(with_items(results, items), alpha);
    if (items.total() > 0.0) {
        subset.mean = spread_weights(weighted_mean(selected_results(results, subset.members)), subset.members,
                                     data.contributing.size());
        subset.test.of_finite_degrees = results.degrees_of_freedom.size() > 0;
    }
    return subset;
}

std::optional<ResultConsistency> consistency_of(const LaboratoryData& data, const AssignedValue& assigned,
                                                const ItemUncertainty& items) {
    if (data.contributing.size() < 2 || !data.all_have_u(data.contributing)) {
        return std::nullopt;
    }
    const double alpha = data.item->assigned_value.alpha;
    std::vector<std::size_t> tested = data.contributing;
    std::optional<ConsistencyTest> test = assigned.subset;
    if (test) {
        // Pairs are counted among those that the value rests on: those left out are told apart from them already.
        std::erase_if(tested, [&](std::size_t i) {
            return std::find(assigned.not_consistent.begin(), assigned.not_consistent.end(), i) !=
                   assigned.not_consistent.end();
        });
    } else {
        at_place(data.where, [&] { test = consistency_test(data.at(tested), items, alpha); });
    }
    ResultConsistency consistency{.test = *test, .alpha = alpha, .u_items = items.total()};
    if (consistency.u_items > 0.0 && !assigned.subset) {
        consistency.chi_square_of_statements = consistency_test(data.at(tested), alpha).chi_square;
    }
    if (const std::size_t n = tested.size(); n <= k_most_results_of_pair_count) {
        consistency.pairs = n * (n - 1) / 2;
        consistency.incompatible_pairs = incompatible_pairs(with_items(data.at(tested), items));
    }
    return consistency;
}

std::optional<double> robust_standard_deviation(const LaboratoryData& data) {
    constexpr std::size_t k_least_results = 3;
    if (data.contributing.size() < k_least_results) {
        return std::nullopt;
    }
    const Eigen::VectorXd x = data.values(data.contributing);
    try {
        return algorithm_a({x.data(), static_cast<std::size_t>(x.size())}).scale;
    } catch (const DiagnosedError&) {
        return std::nullopt;
    }
}

std::optional<double> pooled_standard_deviation(const LaboratoryData& data) {
    const std::optional<Replicates> stated = replicates(data);
    // Algorithm S has one number of degrees of freedom for all standard deviations.
    if (!stated || std::any_of(stated->observations.begin(), stated->observations.end(),
                               [&](std::size_t n) { return n != stated->observations.front(); })) {
        return std::nullopt;
    }
    try {
        return algorithm_s({stated->s.data(), static_cast<std::size_t>(stated->s.size())},
                           static_cast<double>(stated->observations.front() - 1));
    } catch (const DiagnosedError&) {
        return std::nullopt;
    }
}

std::size_t count_pairs(const LaboratoryData& data) {
    const std::size_t n = data.with_u().size();
    return n < 2 || n > k_most_laboratories_in_pairs ? 0 : n * (n - 1) / 2;
}

std::vector<PairEquivalence> pair_equivalences(const LaboratoryData& data, double coverage_probability,
                                               double u_items) {
    // Of two items, with the factor of a normal quantity.
    const double u_of_both = std::numbers::sqrt2 * u_items;
    const double U_of_both =
        coverage_factor(en_coverage_probability(coverage_probability), std::numeric_limits<double>::infinity()) *
        u_of_both;
    const std::vector<std::size_t> with_u = data.with_u();
    std::vector<PairEquivalence> pairs;
    if (count_pairs(data) == 0) {
        return pairs;
    }
    const LaboratoryResults results = data.at(with_u);
    for (std::size_t i = 0; i < with_u.size(); ++i) {
        for (std::size_t j = i + 1; j < with_u.size(); ++j) {
            const ParticipantResult& first = *data.results[with_u[i]];
            const ParticipantResult& second = *data.results[with_u[j]];
            const PairDifference difference = pair_difference(results, i, j);
            double r = 0.0;
            if (results.covariance.size() > 0) {
                r = results.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) /
                    (first.uncertainty->u * second.uncertainty->u);
            }
            PairEquivalence pair;
            pair.first = first.participant;
            pair.second = second.participant;
            pair.d = difference.d;
            pair.u = std::hypot(difference.u, u_of_both);
            // E_n takes both U for one probability of about 95 %, as that of a laboratory against the value (ADR 0028).
            const auto U_of = [&](const ResultUncertainty& stated) {
                return en_uncertainty(stated, coverage_probability).U;
            };
            // Rounding may take |r| above 1.
            pair.U = std::hypot(
                expanded_uncertainty_of_difference({first.value, first.uncertainty->u, U_of(*first.uncertainty)},
                                                   {second.value, second.uncertainty->u, U_of(*second.uncertainty)},
                                                   std::clamp(r, -1.0, 1.0)),
                U_of_both);
            if (pair.U > 0.0) {
                pair.en = pair.d / pair.U;
            }
            pairs.push_back(pair);
        }
    }
    return pairs;
}

}  // namespace gumcert::gum
