#include "app/laboratory_estimates.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "app/comparison_print.h"
#include "app/record_parts.h"
#include "gum/comparison/consensus_spread.h"
#include "gum/comparison/random_effects.h"
#include "gum/comparison/robust_statistics.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rounding.h"

namespace gumcert::app {

namespace {

using engine::AssignedValueMethod;
using reports::ReferenceEstimate;

/// Collects estimates; one that the data do not allow is left out.
class Estimates {
public:
    Estimates(const LaboratoryData& data, const AssignedValue& assigned, double coverage_probability)
        : data_(data), assigned_(assigned), coverage_probability_(coverage_probability) {}

    /// U of an estimate by the scatter of the results.
    void expand(ReferenceEstimate& estimate, const gum::SpreadUncertainty& spread) const {
        if (estimate.u && spread.u > 0.0) {
            estimate.U = gum::coverage_factor(coverage_probability_, spread.degrees_of_freedom) * spread.u;
            estimate.nu = finite_or_none(spread.degrees_of_freedom);
        }
    }

    void add(const std::string& method, const std::function<void(ReferenceEstimate&)>& evaluate) {
        ReferenceEstimate estimate;
        estimate.method = method;
        estimate.results = static_cast<std::int64_t>(data_.contributing.size());
        try {
            evaluate(estimate);
        } catch (const gum::DiagnosedError&) {
            return;  // not possible with these data, and not asked for
        }
        estimate.printed.value = printed_value(estimate.value, estimate.u ? estimate.u : estimate.scale);
        estimate.printed.u = printed_uncertainty(estimate.u);
        estimate.printed.U = printed_uncertainty(estimate.U);
        estimate.printed.scale = printed_uncertainty(estimate.scale);
        estimate.printed.between = printed_uncertainty(estimate.between);
        all_.push_back(std::move(estimate));
    }

    void add(AssignedValueMethod method, const std::function<void(ReferenceEstimate&)>& evaluate) {
        add(std::string(engine::assigned_value_words()[static_cast<std::size_t>(method)]),
            [&](ReferenceEstimate& estimate) {
                evaluate(estimate);
                if (method == data_.item->assigned_value.method) {  // with all that was asked, trials or constants
                    estimate.value = assigned_.value;
                    estimate.u = assigned_.u;
                    estimate.used = true;
                }
                if (data_.item->assigned_value.method == AssignedValueMethod::median &&
                    data_.item->assigned_value.median_by_trials && method == AssignedValueMethod::median) {
                    estimate.U = estimate.nu = std::nullopt;
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

void take(ReferenceEstimate& estimate, const gum::ReferenceValue& value) {
    estimate.value = value.value;
    estimate.u = value.u;
}

void take_random_effects(ReferenceEstimate& estimate, const gum::ReferenceValue& value) {
    take(estimate, value);
    estimate.between = value.between_standard_deviation;
}

void take_robust(ReferenceEstimate& estimate, const gum::RobustEstimate& value) {
    estimate.value = value.location;
    estimate.scale = value.scale;
    if (value.scale > 0.0) {
        estimate.u = value.u;
    }
}

void add_by_uncertainty(Estimates& estimates, const LaboratoryData& data, const gum::LaboratoryResults& results) {
    const engine::AssignedValueRequest& request = data.item->assigned_value;
    const bool independent = results.covariance.size() == 0;
    estimates.add(AssignedValueMethod::weighted_mean,
                  [&](ReferenceEstimate& estimate) { take(estimate, gum::weighted_mean(results)); });
    const bool asked = request.method == AssignedValueMethod::largest_consistent_subset;
    if (asked || (independent && data.contributing.size() <= k_most_laboratories_in_pairs)) {
        estimates.add(AssignedValueMethod::largest_consistent_subset, [&](ReferenceEstimate& estimate) {
            const gum::ConsistentSubset subset = gum::largest_consistent_subset(results, request.alpha);
            take(estimate, subset.mean);
            estimate.results = static_cast<std::int64_t>(subset.members.size());
        });
    }
    if (independent) {
        const auto add = [&](AssignedValueMethod method,
                             gum::ReferenceValue (*evaluate)(const gum::LaboratoryResults&)) {
            estimates.add(method, [&](ReferenceEstimate& estimate) {
                const gum::ReferenceValue mean = evaluate(results);
                take_random_effects(estimate, mean);
                estimates.expand(estimate, gum::weighted_spread(results.x, mean, estimates.coverage_probability()));
                estimate.u_hartung_knapp = gum::hartung_knapp_u(results, mean);
            });
        };
        add(AssignedValueMethod::dersimonian_laird, gum::dersimonian_laird);
        add(AssignedValueMethod::mandel_paule, gum::mandel_paule);
    }
}

std::string printed_chi_square(double chi_square) {
    return gum::round_significant(chi_square, 4);
}

reports::ConsistencySummary summary_of(const gum::ConsistencyTest& test, double alpha) {
    reports::ConsistencySummary summary;
    summary.chi_square = test.chi_square;
    summary.critical_value = test.critical_value;
    summary.p_value = test.p_value;
    summary.alpha = alpha;
    summary.degrees_of_freedom = static_cast<std::int64_t>(test.degrees_of_freedom);
    summary.consistent = test.consistent;
    summary.birge_ratio = test.birge_ratio;
    summary.birge_limit = test.birge_limit;
    summary.printed.chi_square = printed_chi_square(test.chi_square);
    summary.printed.critical_value = printed_chi_square(test.critical_value);
    summary.printed.p_value = printed_probability(test.p_value);
    summary.printed.birge_ratio = printed_score(test.birge_ratio);
    summary.printed.birge_limit = printed_score(test.birge_limit);
    return summary;
}

}  // namespace

std::vector<ReferenceEstimate> reference_estimates(const LaboratoryData& data, const AssignedValue& assigned,
                                                   double coverage_probability) {
    const engine::AssignedValueRequest& request = data.item->assigned_value;
    Estimates estimates(data, assigned, coverage_probability);
    if (data.contributing.size() < 2) {
        return {};
    }
    const Eigen::VectorXd x = data.values(data.contributing);
    const std::span<const double> values(x.data(), static_cast<std::size_t>(x.size()));
    const bool weighed = data.all_have_u(data.contributing);
    const gum::LaboratoryResults results = data.at(data.contributing);
    estimates.add(AssignedValueMethod::arithmetic_mean, [&](ReferenceEstimate& estimate) {
        const gum::ReferenceValue mean = gum::arithmetic_mean(x);
        estimate.value = mean.value;
        estimate.scale = mean.u * std::sqrt(static_cast<double>(x.size()));  // exactly 0 for equal results
        if (mean.u > 0.0) {
            estimate.u = mean.u;
            estimates.expand(estimate, gum::weighted_spread(x, mean, estimates.coverage_probability()));
        }
    });
    const auto add_robust = [&](AssignedValueMethod method, gum::RobustMean kind, const auto& evaluate) {
        estimates.add(method, [&](ReferenceEstimate& estimate) {
            take_robust(estimate, evaluate());
            estimates.expand(estimate, gum::robust_spread(kind, values));
        });
    };
    add_robust(AssignedValueMethod::median, gum::RobustMean::median, [&] { return gum::median_with_made(values); });
    estimates.add("niqr", [&](ReferenceEstimate& estimate) {
        estimate.value = gum::median(values);
        estimate.scale = gum::normalised_interquartile_range(values);
    });
    add_robust(AssignedValueMethod::algorithm_a, gum::RobustMean::algorithm_a, [&] {
        return gum::algorithm_a(
            values, request.exact_constants ? gum::AlgorithmAConstants::exact : gum::AlgorithmAConstants::published);
    });
    add_robust(AssignedValueMethod::q_hampel, gum::RobustMean::q_hampel, [&] { return gum::q_hampel(values); });
    if (weighed) {
        add_by_uncertainty(estimates, data, results);
    }
    if (const std::optional<Replicates> stated = replicates(data); stated && results.covariance.size() == 0) {
        estimates.add(AssignedValueMethod::vangel_rukhin, [&](ReferenceEstimate& estimate) {
            const gum::ReferenceValue mean = gum::vangel_rukhin({stated->x, stated->s, stated->observations});
            take_random_effects(estimate, mean);
            estimates.expand(estimate, gum::weighted_spread(stated->x, mean, estimates.coverage_probability()));
        });
    }
    if (weighed && results.covariance.size() == 0) {
        estimates.add(AssignedValueMethod::power_moderated_mean, [&](ReferenceEstimate& estimate) {
            const gum::ReferenceValue mean =
                request.power ? gum::power_moderated_mean(results, *request.power) : gum::power_moderated_mean(results);
            take_random_effects(estimate, mean);
            estimates.expand(estimate, gum::weighted_spread(results.x, mean, estimates.coverage_probability()));
        });
    }
    if (data.item->kernel_bandwidth) {
        estimates.add("kernel_mode", [&](ReferenceEstimate& estimate) {
            estimate.value = gum::kernel_density_mode(values, *data.item->kernel_bandwidth);
            estimate.scale = *data.item->kernel_bandwidth;
        });
    }
    return estimates.take();
}

std::optional<reports::ConsistencySummary> consistency_of(const LaboratoryData& data, const AssignedValue& assigned) {
    if (data.contributing.size() < 2 || !data.all_have_u(data.contributing)) {
        return std::nullopt;
    }
    const double alpha = data.item->assigned_value.alpha;
    std::vector<std::size_t> tested = data.contributing;
    std::optional<gum::ConsistencyTest> test = assigned.subset;
    if (test) {
        std::erase_if(tested, [&](std::size_t i) {
            return std::find(assigned.not_consistent.begin(), assigned.not_consistent.end(), i) !=
                   assigned.not_consistent.end();
        });
    } else {
        at_place(data.where, [&] { test = gum::consistency_test(data.at(tested), alpha); });
    }
    reports::ConsistencySummary summary = summary_of(*test, alpha);
    if (tested.size() <= k_most_results_of_pair_count) {
        const auto n = static_cast<std::int64_t>(tested.size());
        summary.pairs = n * (n - 1) / 2;
        summary.incompatible_pairs = static_cast<std::int64_t>(gum::incompatible_pairs(data.at(tested)));
    }
    return summary;
}

std::optional<double> robust_standard_deviation(const LaboratoryData& data) {
    constexpr std::size_t k_least_results = 3;
    if (data.contributing.size() < k_least_results) {
        return std::nullopt;
    }
    const Eigen::VectorXd x = data.values(data.contributing);
    try {
        return gum::algorithm_a({x.data(), static_cast<std::size_t>(x.size())}).scale;
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
}

std::optional<double> pooled_standard_deviation(const LaboratoryData& data) {
    const std::optional<Replicates> stated = replicates(data);
    if (!stated || std::any_of(stated->observations.begin(), stated->observations.end(),
                               [&](std::size_t n) { return n != stated->observations.front(); })) {
        return std::nullopt;
    }
    try {
        return gum::algorithm_s({stated->s.data(), static_cast<std::size_t>(stated->s.size())},
                                static_cast<double>(stated->observations.front() - 1));
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
}

std::size_t count_pairs(const LaboratoryData& data) {
    const std::size_t n = data.with_u().size();
    return n < 2 || n > k_most_laboratories_in_pairs ? 0 : n * (n - 1) / 2;
}

std::vector<reports::PairEquivalence> pair_equivalences(const engine::ComparisonJob& job, const LaboratoryData& data) {
    const std::vector<std::size_t> with_u = data.with_u();
    std::vector<reports::PairEquivalence> pairs;
    if (count_pairs(data) == 0) {
        return pairs;
    }
    const gum::LaboratoryResults results = data.at(with_u);
    for (std::size_t i = 0; i < with_u.size(); ++i) {
        for (std::size_t j = i + 1; j < with_u.size(); ++j) {
            const engine::ComparisonResult& first = *data.results[with_u[i]];
            const engine::ComparisonResult& second = *data.results[with_u[j]];
            const gum::PairDifference difference = gum::pair_difference(results, i, j);
            double r = 0.0;
            if (results.covariance.size() > 0) {
                r = results.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) /
                    (first.uncertainty->u * second.uncertainty->u);
            }
            reports::PairEquivalence pair;
            pair.first = job.participants[first.participant].id;
            pair.second = job.participants[second.participant].id;
            pair.d = difference.d;
            pair.u = difference.u;
            const auto U_of = [&](const engine::ResultUncertainty& stated) {
                return gum::en_uncertainty(stated.u, stated.U, stated.k, stated.degrees_of_freedom,
                                           job.coverage_probability)
                    .U;
            };
            pair.U = gum::uncertainty_of_difference(U_of(*first.uncertainty), U_of(*second.uncertainty),
                                                    std::clamp(r, -1.0, 1.0));
            if (pair.U > 0.0) {
                pair.En = pair.d / pair.U;
            }
            pair.printed.d = printed_difference(pair.d, pair.U, std::nullopt);
            pair.printed.U = printed_uncertainty(pair.U);
            pair.printed.En = printed_score(pair.En);
            pairs.push_back(std::move(pair));
        }
    }
    return pairs;
}

}  // namespace gumcert::app
