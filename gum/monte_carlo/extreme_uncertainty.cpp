#include "gum/monte_carlo/extreme_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "gum/coverage.h"
#include "gum/monte_carlo/random_draws.h"
#include "gum/quantity/distribution.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

namespace {

using Eigen::Index;

constexpr std::size_t k_draws_at_once = 1024;
// u is that of this probability for larger ones, too: k u is then wider than it need be, and u, and with it what is said of conformity,
// does not depend on the probability for which U is printed.
constexpr double k_probability_of_u = 0.9545;
// From here on the errors are drawn from the normal distribution.
constexpr double k_many_degrees_of_freedom = 1e4;
// A difference larger than this many of its u is never made up by noise.
constexpr double k_clear = 5.0;

double deviation_of_difference(const Eigen::MatrixXd& covariance, Index i, Index j) {
    return std::sqrt(std::max(covariance(i, i) + covariance(j, j) - 2.0 * covariance(i, j), 0.0));
}

/// An estimate that may be extreme, and how far at least its true value is from that of the extreme estimate.
struct Rival {
    Index at = 0;
    double gap = 0.0;
};

/// The estimates that may be the largest (sign 1) or the smallest (sign -1) of some; the extreme one of the estimates stands first.
std::vector<Rival> rivals_among(const std::vector<Index>& some, const ExtremeValues& values, double sign, double c) {
    std::vector<Rival> rivals;
    if (some.empty()) {
        return rivals;
    }
    const Index extreme = *std::max_element(
        some.begin(), some.end(), [&](Index a, Index b) { return sign * values.value[a] < sign * values.value[b]; });
    rivals.push_back({extreme, 0.0});
    for (const Index i : some) {
        const double u = deviation_of_difference(values.covariance, i, extreme);
        const double gap = std::max(0.0, sign * (values.value[extreme] - values.value[i]) - c * u);
        if (i != extreme && gap < k_clear * u) {
            rivals.push_back({i, gap});
        }
    }
    return rivals;
}

/// Of the difference of two rivals, or of one where nothing is taken off.
double deviation_of(const Eigen::MatrixXd& covariance, const Rival& high, const std::vector<Rival>& low,
                    std::size_t j) {
    return low.empty() ? std::sqrt(std::max(covariance(high.at, high.at), 0.0))
                       : deviation_of_difference(covariance, high.at, low[j].at);
}

/// Draws of errors: normal, or of the multivariate t-distribution with this covariance as the square of its scale.
class ErrorDraws {
public:
    ErrorDraws(Eigen::MatrixXd covariance, double degrees_of_freedom)
        : size_(covariance.rows()), draws_(groups_of(std::move(covariance), degrees_of_freedom), k_seed, {}) {}

    /// A row a draw, a column an estimate.
    [[nodiscard]] Eigen::MatrixXd from(std::size_t first) const {
        Eigen::MatrixXd e(static_cast<Index>(k_draws_at_once), draws_.size());
        draws_.draw(first, e);
        if (draws_.size() == size_) {
            return e;
        }
        return e.rightCols(1).cwiseSqrt().cwiseInverse().asDiagonal() * e.leftCols(size_);
    }

private:
    static constexpr std::uint64_t k_seed = 1;  // a digit of U must not change from run to run

    static std::vector<InputGroup> groups_of(Eigen::MatrixXd covariance, double nu) {
        std::vector<InputGroup> groups(nu > k_many_degrees_of_freedom ? 1 : 2);
        groups[0].name = "errors of the estimates";
        groups[0].value = Eigen::VectorXd::Zero(covariance.rows());
        groups[0].covariance = std::move(covariance);
        if (groups.size() > 1) {
            groups[1].name = "their variance";  // χ²/ν, one for all
            groups[1].value = Eigen::VectorXd::Ones(1);
            groups[1].covariance = Eigen::MatrixXd::Constant(1, 1, 2.0 / nu);
            groups[1].marginals = {Distribution{.kind = DistributionKind::gamma, .scale = 2.0 / nu, .shape = 0.5 * nu}};
        }
        return groups;
    }

    Index size_;
    InputDraws draws_;
};

double quantile(std::vector<double>& sample, double p) {
    const auto at = static_cast<std::ptrdiff_t>(p * static_cast<double>(sample.size()));
    std::nth_element(sample.begin(), sample.begin() + at, sample.end());
    return sample[static_cast<std::size_t>(at)];
}

}  // namespace

ExtremeValues range_of(Eigen::VectorXd value, Eigen::MatrixXd covariance) {
    std::vector<Index> all(static_cast<std::size_t>(value.size()));
    std::iota(all.begin(), all.end(), Index{0});
    return {.value = std::move(value), .covariance = std::move(covariance), .upper = all, .lower = all};
}

ExtremeUncertainty extreme_uncertainty(const ExtremeValues& values, double coverage_probability,
                                       double degrees_of_freedom, std::size_t draws) {
    const double p = std::min(coverage_probability, k_probability_of_u);
    // The extreme one may be any of n, so that n (n - 1) differences are to be held, each on one side; of one value there is none.
    const auto n = static_cast<double>(values.value.size());
    const double missed = n > 1.0 ? 2.0 * (1.0 - p) / (n * (n - 1.0)) : 1.0;
    const double c = missed < 1.0 ? coverage_factor(1.0 - missed, degrees_of_freedom) : 0.0;
    const std::vector<Rival> high = rivals_among(values.upper, values, 1.0, c);
    const std::vector<Rival> low = rivals_among(values.lower, values, -1.0, c);
    ExtremeUncertainty result;
    result.law_u = result.u = deviation_of(values.covariance, high.front(), low, 0);
    if (high.size() == 1 && low.size() <= 1) {
        return result;
    }
    // Only what may be extreme is drawn.
    std::vector<Index> drawn;
    for (const std::vector<Rival>* of : {&high, &low}) {
        for (const Rival& rival : *of) {
            drawn.push_back(rival.at);
        }
    }
    std::sort(drawn.begin(), drawn.end());
    drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
    const auto place = [&](Index i) { return std::lower_bound(drawn.begin(), drawn.end(), i) - drawn.begin(); };
    const ErrorDraws errors(values.covariance(drawn, drawn), degrees_of_freedom);
    std::vector<double> of_law;
    std::vector<double> of_all;
    for (std::size_t first = 0; first < draws; first += k_draws_at_once) {
        const Eigen::MatrixXd e = errors.from(first);
        Eigen::VectorXd top = e.col(place(high.front().at));
        Eigen::VectorXd bottom = Eigen::VectorXd::Zero(e.rows());
        if (!low.empty()) {
            bottom = e.col(place(low.front().at));
        }
        for (Index r = 0; r < e.rows(); ++r) {
            of_law.push_back(std::abs(top[r] - bottom[r]));
        }
        for (const Rival& rival : high) {
            top = top.cwiseMax((e.col(place(rival.at)).array() - rival.gap).matrix());
        }
        for (const Rival& rival : low) {
            bottom = bottom.cwiseMin((e.col(place(rival.at)).array() + rival.gap).matrix());
        }
        for (Index r = 0; r < e.rows(); ++r) {
            of_all.push_back(std::abs(top[r] - bottom[r]));
        }
    }
    const double by_law = quantile(of_law, p);
    const double by_draws = quantile(of_all, p);
    // Largest and smallest may be one value, as where all are equal.
    result.u = by_law > 0.0 ? result.law_u * std::max(1.0, by_draws / by_law)
                            : by_draws / coverage_factor(p, degrees_of_freedom);
    return result;
}

namespace {

bool holds_extremes(const UncertaintyBudget& budget) {
    return !budget.budget.empty() && budget.budget.back().name == k_which_are_extreme;
}

}  // namespace

double share_of_extremes(const UncertaintyBudget& budget, Index output) {
    return holds_extremes(budget) ? budget.budget.back().share[output] : 0.0;
}

void state_extreme(UncertaintyBudget& budget, Index output, const ExtremeUncertainty& extreme) {
    if (!(extreme.u > extreme.law_u)) {
        return;
    }
    if (!holds_extremes(budget)) {
        const Eigen::VectorXd none = Eigen::VectorXd::Zero(budget.value.size());
        budget.budget.push_back({.name = k_which_are_extreme, .variance = none, .share = none});
        budget.shares_by_source.push_back(budget.budget.back());
    }
    const double variance = extreme.u * extreme.u - extreme.law_u * extreme.law_u;
    const double of_law = budget.standard_uncertainty[output] * budget.standard_uncertainty[output];
    const double u = std::sqrt(of_law + variance);
    for (std::vector<BudgetContribution>* of : {&budget.budget, &budget.shares_by_source}) {
        of->back().variance[output] = variance;
        for (BudgetContribution& contribution : *of) {
            contribution.share[output] = contribution.variance[output] / (u * u);
        }
    }
    budget.standard_uncertainty[output] = u;
    budget.expanded_uncertainty[output] = budget.coverage_factor[output] * u;
}

}  // namespace gumcert::gum
