#include "gum/budget/reported_covariance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gum/budget/budget_covariance.h"
#include "gum/monte_carlo/random_draws.h"
#include "gum/propagation.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/distribution.h"
#include "text/lists.h"

namespace gumcert::gum {

namespace {

constexpr double k_most_products = 2e10;  // of trials and pairs of results, so that points take seconds
constexpr std::uint64_t k_most_together = 200'000;
constexpr std::uint64_t k_most_of_one_point = 1'000'000;
constexpr Eigen::Index k_rows = 1024;

/// A result whose covariance the trials give.
struct DrawnResult {
    std::size_t point = 0;
    Eigen::Index output = 0;
    Eigen::Index row = 0;  ///< among all results
    std::vector<bool>
        groups{};             ///< of the inputs of its point: whether the result depends on any quantity of the group
    Eigen::VectorXd slope{};  ///< what of it is linear in the scores of the inputs: n
    std::set<std::uint64_t> streams{};  ///< of the random numbers that it depends on
};

/// The results that are reported by Monte Carlo and have a variance.
std::vector<DrawnResult> drawn_results(const BudgetResult& result) {
    std::vector<DrawnResult> drawn;
    Eigen::Index row = 0;
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        const BudgetPointResult& point = result.points[p];
        for (std::size_t i = 0; i < point.outputs.size(); ++i, ++row) {
            if (!point.outputs[i].by_monte_carlo || !point.outputs[i].has_u) {
                continue;
            }
            DrawnResult& of =
                drawn.emplace_back(DrawnResult{.point = p, .output = static_cast<Eigen::Index>(i), .row = row});
            const std::vector<bool> used = point.model->quantities_of(of.output);
            std::size_t first = 0;
            for (std::size_t g = 0; g < point.streams.size(); ++g) {
                const InputGroup& group = point.model->inputs()[g];
                const auto size = static_cast<std::size_t>(group.size());
                const auto begin = used.begin() + static_cast<std::ptrdiff_t>(first);
                of.groups.push_back(std::find(begin, begin + group.size(), true) != begin + group.size());
                first += size;
                if (of.groups.back()) {
                    of.streams.insert(point.streams[g]);
                }
            }
        }
    }
    return drawn;
}

/// Standard deviation with which each input of a point is drawn; 0 of one that is constant, or has no variance.
Eigen::VectorXd drawn_deviations(const BudgetPointResult& point) {
    std::vector<double> deviations;
    for (const InputGroup& group : point.model->inputs()) {
        for (Eigen::Index i = 0; i < group.size(); ++i) {
            const auto at = static_cast<std::size_t>(i);
            const double variance = group.is_diagonal() ? group.covariance(i, 0) : group.covariance(i, i);
            const double drawn =
                at < group.marginals.size() ? standard_deviation(group.marginals[at]) : std::sqrt(variance);
            deviations.push_back(std::isfinite(drawn) && variance > 0.0 ? drawn : 0.0);
        }
    }
    return Eigen::Map<const Eigen::VectorXd>(deviations.data(), static_cast<Eigen::Index>(deviations.size()));
}

/// Coefficients b with R b = covariance with the scores of the inputs of a point, group by group.
Eigen::VectorXd slope_of(const BudgetPointResult& point, const DrawnResult& of, const Eigen::VectorXd& with_scores) {
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(with_scores.size());
    Eigen::Index first = 0;
    std::size_t g = 0;
    for (const InputGroup& group : point.model->inputs()) {
        const Eigen::Index n = group.size();
        const auto c = with_scores.segment(first, n);
        if (!of.groups[g]) {
            // What a result does not depend on has exactly no part in it, whatever the trials happen to show.
        } else if (n == 1 || group.is_diagonal()) {
            slope.segment(first, n) = c;
        } else if (group.factor.size() > 0 && group.factor.diagonal().minCoeff() > 0.0) {  // regular: no r = ±1
            const Eigen::MatrixXd L = known_correlation_root(group);
            const auto lower = L.triangularView<Eigen::Lower>();
            slope.segment(first, n) = lower.transpose().solve(Eigen::VectorXd(lower.solve(Eigen::VectorXd(c))));
        } else {
            const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation_matrix(group.covariance));
            const double least = 1e-10 * eigen.eigenvalues()(n - 1);  // R may be singular: r = ±1
            const Eigen::VectorXd inverse =
                eigen.eigenvalues().unaryExpr([&](double value) { return value > least ? 1.0 / value : 0.0; });
            slope.segment(first, n) =
                eigen.eigenvectors() * (inverse.asDiagonal() * (eigen.eigenvectors().transpose() * c));
        }
        first += n;
        ++g;
    }
    return slope;
}

/// Trials of the points that drawn results belong to, all points at once: what they have in common is equal.
class TrialsOfPoints {
public:
    TrialsOfPoints(const BudgetResult& result, const std::vector<DrawnResult>& drawn, std::uint64_t seed)
        : result_(result) {
        for (const DrawnResult& of : drawn) {
            if (points_.empty() || points_.back() != of.point) {
                const BudgetPointResult& point = result.points[of.point];
                points_.push_back(of.point);
                draws_.emplace_back(point.model->inputs(), seed, point.streams);
                deviations_.push_back(drawn_deviations(point));
            }
        }
        // A coefficient of M trials is known to 1/√M, a few times that where results are products: 0.1 % of 10⁶, 0.2 % of
        // 200 000, 0.4 % of the 80 000 that 500 results get.
        const double pairs = static_cast<double>(drawn.size()) * static_cast<double>(drawn.size());
        const std::uint64_t most = result.points.size() == 1 ? k_most_of_one_point : k_most_together;
        trials_ = static_cast<Eigen::Index>(std::min(static_cast<std::uint64_t>(k_most_products / pairs), most));
    }

    [[nodiscard]] Eigen::Index trials() const { return trials_; }

    /// \param use  called with the place among the points, their number in the result, the scores of the inputs
    ///             (x − x̂)/σ, and the outputs less their values at the estimates; then, after each block, with nothing
    template <class Use, class End>
    void run(const Use& use, const End& end) const {
        for (Eigen::Index first = 0; first < trials_; first += k_rows) {
            const Eigen::Index count = std::min(k_rows, trials_ - first);
            for (std::size_t i = 0; i < points_.size(); ++i) {
                const BudgetPointResult& point = result_.points[points_[i]];
                Eigen::MatrixXd x(count, draws_[i].size());
                Eigen::MatrixXd y(count, static_cast<Eigen::Index>(point.outputs.size()));
                draws_[i].draw(static_cast<std::uint64_t>(first), x);
                point.model->evaluate_trials(x, y);
                // Sums are taken about the values at the estimates: near enough to the means that Σ d² − (Σ d)²/M does
                // not cancel.
                y.rowwise() -= point.propagation.value.transpose();
                x.rowwise() -= input_estimates(*point.model).transpose();
                for (Eigen::Index column = 0; column < x.cols(); ++column) {
                    const double deviation = deviations_[i](column);
                    x.col(column) *= deviation > 0.0 ? 1.0 / deviation : 0.0;
                }
                use(i, points_[i], x, y);
            }
            end(count);
        }
    }

    [[nodiscard]] const std::vector<std::size_t>& points() const { return points_; }
    [[nodiscard]] const Eigen::VectorXd& deviations(std::size_t place) const { return deviations_[place]; }

private:
    const BudgetResult& result_;
    std::vector<std::size_t> points_;
    std::vector<InputDraws> draws_;
    std::vector<Eigen::VectorXd> deviations_;
    Eigen::Index trials_ = 0;
};

/// Finds the linear part of each drawn result: the b that leaves no covariance between the inputs and y − b·scores.
void set_slopes(const BudgetResult& result, const TrialsOfPoints& trials, std::vector<DrawnResult>& drawn) {
    // The derivative at the estimates takes most of it: what is linear then comes out exactly, and the trials decide
    // upon the rest only. Where it misleads (an inflection, a kink) a factor a takes it back.
    struct Sums {
        Eigen::VectorXd gradient;  ///< derivative by the scores
        double y = 0.0, line = 0.0, y_line = 0.0, line_line = 0.0;
        Eigen::VectorXd scores, scores_y, scores_line;
    };
    std::vector<Sums> sums;
    for (const DrawnResult& of : drawn) {
        const BudgetPointResult& point = result.points[of.point];
        const auto place = std::find(trials.points().begin(), trials.points().end(), of.point);
        Sums& mine = sums.emplace_back();
        mine.gradient = point.propagation.jacobian.row(of.output).transpose().cwiseProduct(
            trials.deviations(static_cast<std::size_t>(place - trials.points().begin())));
        mine.scores = mine.scores_y = mine.scores_line = Eigen::VectorXd::Zero(mine.gradient.size());
    }
    trials.run(
        [&](std::size_t /*place*/, std::size_t p, const Eigen::MatrixXd& z, const Eigen::MatrixXd& y) {
            for (std::size_t k = 0; k < drawn.size(); ++k) {
                if (drawn[k].point != p) {
                    continue;
                }
                Sums& mine = sums[k];
                const auto of = y.col(drawn[k].output);
                const Eigen::VectorXd line = z * mine.gradient;
                mine.y += of.sum();
                mine.line += line.sum();
                mine.y_line += of.dot(line);
                mine.line_line += line.squaredNorm();
                mine.scores += z.colwise().sum().transpose();
                mine.scores_y += z.transpose() * of;
                mine.scores_line += z.transpose() * line;
            }
        },
        [](Eigen::Index /*count*/) {});
    const auto M = static_cast<double>(trials.trials());
    for (std::size_t k = 0; k < drawn.size(); ++k) {
        const Sums& mine = sums[k];
        const double variance = mine.line_line - mine.line * mine.line / M;
        const double a = variance > 0.0 ? (mine.y_line - mine.y * mine.line / M) / variance : 0.0;
        const Eigen::VectorXd rest =
            (mine.scores_y - mine.scores * (mine.y / M) - a * (mine.scores_line - mine.scores * (mine.line / M))) /
            (M - 1.0);
        drawn[k].slope = a * mine.gradient + slope_of(result.points[drawn[k].point], drawn[k], rest);
    }
}

/// Covariance of what the linear parts leave.
Eigen::MatrixXd remainders(const TrialsOfPoints& trials, const std::vector<DrawnResult>& drawn) {
    const auto n = static_cast<Eigen::Index>(drawn.size());
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(n);
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd all(k_rows, n);
    trials.run(
        [&](std::size_t /*place*/, std::size_t p, const Eigen::MatrixXd& z, const Eigen::MatrixXd& y) {
            for (std::size_t k = 0; k < drawn.size(); ++k) {
                if (drawn[k].point == p) {
                    all.col(static_cast<Eigen::Index>(k)).head(z.rows()) = y.col(drawn[k].output) - z * drawn[k].slope;
                }
            }
        },
        [&](Eigen::Index count) {
            sum += all.topRows(count).colwise().sum();
            squares.selfadjointView<Eigen::Lower>().rankUpdate(all.topRows(count).transpose());
        });
    // V = (Σ d dᵀ − (Σ d)ᵀ(Σ d)/M)/(M − 1)
    squares.triangularView<Eigen::StrictlyUpper>() = squares.transpose();
    const auto count = static_cast<double>(trials.trials());
    Eigen::MatrixXd covariance = (squares - sum.transpose() * sum / count) / (count - 1.0);
    bool any_zero = false;
    for (Eigen::Index j = 0; j < n; ++j) {
        for (Eigen::Index i = 0; i < j; ++i) {
            const std::set<std::uint64_t>& a = drawn[static_cast<std::size_t>(i)].streams;
            const std::set<std::uint64_t>& b = drawn[static_cast<std::size_t>(j)].streams;
            if (std::none_of(a.begin(), a.end(), [&](std::uint64_t stream) { return b.contains(stream); })) {
                covariance(i, j) = covariance(j, i) = 0.0;
                any_zero = true;
            }
        }
    }
    if (any_zero && covariance.allFinite()) {
        // Without the noise of the pairs that have none the matrix may miss being positive semi-definite by as much:
        // then all coefficients are made smaller by that, and the zeros stay.
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation_matrix(covariance),
                                                                   Eigen::EigenvaluesOnly);
        const double missed = std::max(0.0, -eigen.eigenvalues()(0));
        const Eigen::VectorXd variances = covariance.diagonal();
        covariance /= 1.0 + missed;
        covariance.diagonal() = variances;
    }
    return covariance;
}

}  // namespace

bool has_result_of_trials(const BudgetResult& result) {
    return std::any_of(result.points.begin(), result.points.end(), [](const BudgetPointResult& point) {
        return std::any_of(point.outputs.begin(), point.outputs.end(),
                           [](const BudgetOutputResult& output) { return output.by_monte_carlo; });
    });
}

Eigen::MatrixXd reported_covariance(const Budget& budget, const BudgetResult& result) {
    Eigen::MatrixXd of_law = budget_covariance(result);
    std::vector<Eigen::Index> by_law;
    Eigen::Index row = 0;
    for (const BudgetPointResult& point : result.points) {
        for (const BudgetOutputResult& output : point.outputs) {
            if (!output.by_monte_carlo) {
                by_law.push_back(row);
                if (of_law(row, row) == 0.0) {
                    // Where the first derivatives vanish u is that of the second-order terms.
                    of_law(row, row) = output.standard_uncertainty * output.standard_uncertainty;
                }
            }
            ++row;
        }
    }
    if (!has_result_of_trials(result)) {
        return of_law;
    }
    std::vector<DrawnResult> drawn = drawn_results(result);
    bool is_known = drawn.size() <= k_most_drawn_together;
    std::vector<Eigen::MatrixXd> jacobians;
    for (const BudgetPointResult& point : result.points) {
        jacobians.push_back(point.propagation.jacobian);
    }
    Eigen::MatrixXd remainder;
    if (is_known && !drawn.empty()) {
        const TrialsOfPoints trials(result, drawn, budget.monte_carlo.value_or(MonteCarloRequest{}).seed);
        set_slopes(result, trials, drawn);
        remainder = remainders(trials, drawn);
        is_known = remainder.allFinite();
        for (const DrawnResult& of : drawn) {
            // As sensitivity coefficients beside the stated u of the inputs: the correlation of an input with a result
            // is that of the trials, also where a t-distribution is drawn wider than u.
            Eigen::Index column = 0;
            for (const InputGroup& group : result.points[of.point].model->inputs()) {
                for (Eigen::Index i = 0; i < group.size(); ++i, ++column) {
                    const double u = std::sqrt(group.is_diagonal() ? group.covariance(i, 0) : group.covariance(i, i));
                    jacobians[of.point](of.output, column) = u > 0.0 ? of.slope(column) / u : 0.0;
                }
            }
        }
    }
    // J V Jᵀ of the results of the law and of the linear parts of the others, then what these have beside: a sum of two
    // positive semi-definite matrices.
    Eigen::MatrixXd covariance = budget_covariance(result, jacobians);
    covariance(by_law, by_law) = of_law(by_law, by_law);  // to the last bit what it is without the others
    constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(covariance.rows());
    row = 0;
    for (const BudgetPointResult& point : result.points) {
        for (const BudgetOutputResult& output : point.outputs) {
            if (output.by_monte_carlo) {
                scale(row) = k_none;
            }
            ++row;
        }
    }
    for (std::size_t k = 0; k < drawn.size() && is_known; ++k) {
        const DrawnResult& of = drawn[k];
        for (std::size_t j = 0; j < drawn.size(); ++j) {
            covariance(of.row, drawn[j].row) += remainder(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j));
        }
        // So the diagonal is the square of the u that is printed, and 200 000 trials do not contradict the million that
        // a result rests on.
        const double u =
            result.points[of.point].outputs[static_cast<std::size_t>(of.output)].monte_carlo->standard_uncertainty;
        const double drawn_u = std::sqrt(covariance(of.row, of.row));
        scale(of.row) = drawn_u > 0.0 ? u / drawn_u : 0.0;
    }
    for (Eigen::Index j = 0; j < covariance.cols(); ++j) {
        for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
            covariance(i, j) *= scale(i) * scale(j);
        }
    }
    row = 0;
    for (const BudgetPointResult& point : result.points) {
        for (const BudgetOutputResult& output : point.outputs) {
            if (output.by_monte_carlo && !std::isnan(scale(row))) {
                covariance(row, row) =
                    output.monte_carlo->standard_uncertainty * output.monte_carlo->standard_uncertainty;
            }
            ++row;
        }
    }
    return covariance;
}

void note_covariance(const Budget& budget, const Eigen::MatrixXd& covariance, BudgetResult& result) {
    const std::vector<std::string> names = budget_result_names(budget, result);
    std::vector<std::string> without;  // a variance
    std::vector<std::string> not_drawn;
    Eigen::Index row = 0;
    for (const BudgetPointResult& point : result.points) {
        for (const BudgetOutputResult& output : point.outputs) {
            if (std::isnan(covariance(row, row))) {
                (output.has_u ? not_drawn : without).push_back(names[static_cast<std::size_t>(row)]);
            }
            ++row;
        }
    }
    constexpr std::size_t k_most_names = 5;
    const auto add = [&](const char* code, const std::vector<std::string>& of, std::string what, std::string rule,
                         std::string action) {
        if (!of.empty()) {
            result.notes.push_back({.code = code,
                                    .where = (of.size() == 1 ? "result " : "results ") + text::listed(of, k_most_names),
                                    .what = std::move(what),
                                    .rule = std::move(rule),
                                    .action = std::move(action),
                                    .severity = Severity::note});
        }
    };
    add("GC-BUDGET-0041", not_drawn, "no covariance is stated",
        "where results are reported by Monte Carlo, it comes from trials that are drawn of all points together, for "
        "up to 500 results",
        "Split the table of points where the covariance between points is needed.");
    add("GC-BUDGET-0042", without, "left out of the covariance of the results",
        "a distribution without a variance has no covariance", "State the coverage interval.");
}

}  // namespace gumcert::gum
