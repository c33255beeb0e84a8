#include "gum/budget/reported_covariance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "gum/budget/budget_covariance.h"
#include "gum/budget/evaluation_choice.h"
#include "gum/monte_carlo/random_draws.h"
#include "gum/propagation.h"
#include "text/lists.h"

namespace gumcert::gum {

namespace {

constexpr double k_most_products = 2e10;  // of trials and pairs of results, so that points take seconds
constexpr std::uint64_t k_most_together = 200'000;
constexpr Eigen::Index k_rows = 1024;

/// Whether a result that is reported by the law has a variance: an input of t with ν ≤ 2 has none.
bool has_variance(const BudgetPointResult& point, std::size_t output) {
    const BudgetOutputResult& of = point.outputs[output];
    return of.monte_carlo ? of.has_u : inputs_without_variance(point, static_cast<Eigen::Index>(output)).empty();
}

/// u of every result as it is reported; NaN without a variance.
Eigen::VectorXd reported_uncertainties(const BudgetResult& result) {
    std::vector<double> u;
    for (const BudgetPointResult& point : result.points) {
        for (std::size_t i = 0; i < point.outputs.size(); ++i) {
            const BudgetOutputResult& of = point.outputs[i];
            const double stated = of.by_monte_carlo ? of.monte_carlo->standard_uncertainty : of.standard_uncertainty;
            u.push_back(has_variance(point, i) ? stated : std::numeric_limits<double>::quiet_NaN());
        }
    }
    return Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size()));
}

/// Covariance of trials that are drawn of all points at once.
Eigen::MatrixXd drawn_together(const BudgetResult& result, std::uint64_t seed) {
    const auto n = static_cast<Eigen::Index>(budget_result_count(result));
    std::vector<InputDraws> draws;
    for (const BudgetPointResult& point : result.points) {
        // One seed and the streams of each point: what points have in common is drawn once, which makes their
        // correlation.
        draws.emplace_back(point.model->inputs(), seed, point.streams);
    }
    // A coefficient of M trials is known to 1/√M: to 0.2 % of 200 000, to 0.4 % of the 80 000 that 500 results get.
    const double pairs = static_cast<double>(n) * static_cast<double>(n);
    const auto trials =
        static_cast<Eigen::Index>(std::min(static_cast<std::uint64_t>(k_most_products / pairs), k_most_together));
    // Sums are taken about the values of the law of propagation: near enough to the means that Σ d² − (Σ d)²/M does not
    // cancel, and one pass does.
    Eigen::RowVectorXd centre(n);
    Eigen::Index column = 0;
    for (const BudgetPointResult& point : result.points) {
        centre.segment(column, point.propagation.value.size()) = point.propagation.value.transpose();
        column += point.propagation.value.size();
    }
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(n);
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index first = 0; first < trials; first += k_rows) {
        const Eigen::Index count = std::min(k_rows, trials - first);
        Eigen::MatrixXd all(count, n);
        column = 0;
        for (std::size_t p = 0; p < result.points.size(); ++p) {
            Eigen::MatrixXd x(count, draws[p].size());
            Eigen::MatrixXd y(count, static_cast<Eigen::Index>(result.points[p].outputs.size()));
            draws[p].draw(static_cast<std::uint64_t>(first), x);
            result.points[p].model->evaluate_trials(x, y);
            all.middleCols(column, y.cols()) = y;
            column += y.cols();
        }
        all.rowwise() -= centre;
        sum += all.colwise().sum();
        squares.selfadjointView<Eigen::Lower>().rankUpdate(all.transpose());
    }
    // V = (Σ d dᵀ − (Σ d)ᵀ(Σ d)/M)/(M − 1)
    squares.triangularView<Eigen::StrictlyUpper>() = squares.transpose();
    const auto count = static_cast<double>(trials);
    return (squares - sum.transpose() * sum / count) / (count - 1.0);
}

/// The same correlations beside other standard uncertainties.
Eigen::MatrixXd with_uncertainties(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& u) {
    // So the diagonal is the square of the u that is printed, whichever method gave it, and 200 000 trials do not
    // contradict the million that a result rests on.
    const Eigen::MatrixXd R = correlation_matrix(covariance);
    Eigen::MatrixXd scaled(u.size(), u.size());
    for (Eigen::Index j = 0; j < u.size(); ++j) {
        for (Eigen::Index i = 0; i < u.size(); ++i) {
            scaled(i, j) = i == j ? u(i) * u(i) : std::clamp(R(i, j), -1.0, 1.0) * u(i) * u(j);
        }
    }
    return scaled;
}

}  // namespace

bool has_result_of_trials(const BudgetResult& result) {
    return std::any_of(result.points.begin(), result.points.end(), [](const BudgetPointResult& point) {
        return std::any_of(point.outputs.begin(), point.outputs.end(),
                           [](const BudgetOutputResult& output) { return output.by_monte_carlo; });
    });
}

Eigen::MatrixXd reported_covariance(const Budget& budget, const BudgetResult& result) {
    if (!has_result_of_trials(result)) {
        return budget_covariance(result);
    }
    const Eigen::VectorXd u = reported_uncertainties(result);
    Eigen::MatrixXd covariance;
    // One point: the trials of its results are drawn together already.
    if (result.points.size() == 1) {
        covariance = result.points.front().monte_carlo->covariance;
    } else if (static_cast<std::size_t>(u.size()) <= k_most_drawn_together) {
        covariance = drawn_together(result, budget.monte_carlo.value_or(MonteCarloRequest{}).seed);
    }
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
        if (!std::isnan(u(i)) && !std::isfinite(covariance(i, i))) {
            return {};
        }
    }
    return covariance.size() > 0 ? with_uncertainties(covariance, u) : Eigen::MatrixXd();
}

void note_covariance(const Budget& budget, const Eigen::MatrixXd& covariance, BudgetResult& result) {
    if (!has_result_of_trials(result)) {
        return;
    }
    const auto add = [&](const char* code, std::string where, std::string what, std::string rule, std::string action) {
        result.notes.push_back({.code = code,
                                .where = std::move(where),
                                .what = std::move(what),
                                .rule = std::move(rule),
                                .action = std::move(action),
                                .severity = Severity::note});
    };
    if (covariance.size() == 0) {
        add("GC-BUDGET-0041", "covariance of the results", "no covariance is stated",
            "where results are reported by Monte Carlo, it comes from trials that are drawn of all points together, "
            "for "
            "up to 500 results",
            "Split the table of points where the covariance between points is needed.");
        return;
    }
    const std::vector<std::string> names = budget_result_names(budget, result);
    std::vector<std::string> without;
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
        if (std::isnan(covariance(i, i))) {
            without.push_back(names[static_cast<std::size_t>(i)]);
        }
    }
    if (!without.empty()) {
        constexpr std::size_t k_most_names = 5;
        add("GC-BUDGET-0042", (without.size() == 1 ? "result " : "results ") + text::listed(without, k_most_names),
            "left out of the covariance of the results", "a distribution without a variance has no covariance",
            "State the coverage interval.");
    }
}

}  // namespace gumcert::gum
