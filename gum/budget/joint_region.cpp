#include "gum/budget/joint_region.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "gum/budget/budget_coverage.h"
#include "gum/coverage.h"
#include "gum/monte_carlo/random_draws.h"
#include "gum/propagation.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/special_values.h"

namespace gumcert::gum {

namespace {

constexpr double k_most_drawn = 1e8;            // values of inputs
constexpr double k_most_region_products = 2e9;  // of trials and pairs of results
constexpr double k_most_region_trials = 1e6;
constexpr double k_least_region_trials = 1e5;
constexpr Eigen::Index k_most_in_drawn_ellipsoid = 100;  // results: a triangular solve a trial
constexpr Eigen::Index k_region_rows = 1024;

/// Correlations and standard uncertainties of V; no root where V is singular.
struct Metric {
    Eigen::VectorXd u;
    Eigen::MatrixXd root;
};

Metric metric_of(const Eigen::MatrixXd& covariance) {
    Metric metric{.u = covariance.diagonal().cwiseSqrt(), .root = {}};
    const Eigen::MatrixXd correlation = correlation_matrix(covariance);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation, Eigen::EigenvaluesOnly);
    if (metric.u.minCoeff() > 0.0 && eigen.eigenvalues()(0) > 1e-12 * static_cast<double>(covariance.rows())) {
        metric.root = Eigen::LLT<Eigen::MatrixXd>(correlation).matrixL();
    }
    return metric;
}

/// A factor that holds a fraction of the trials, with its standard uncertainty.
struct DrawnFactor {
    double value = 0.0, error = 0.0;
};

DrawnFactor factor_of_distances(std::vector<double>& distances, double p) {
    // Rank q = pM + 1/2 (JCGM 102:2011, 7.7); it scatters binomially.
    const auto M = static_cast<double>(distances.size());
    const auto at = [&](double rank) {
        const auto place = distances.begin() + static_cast<std::ptrdiff_t>(std::clamp(rank, 1.0, M) - 1.0);
        std::nth_element(distances.begin(), place, distances.end());
        return *place;
    };
    const double rank = std::floor(p * M + 0.5);
    const double spread = std::sqrt(M * p * (1.0 - p));
    return {.value = at(rank), .error = 0.5 * (at(std::floor(rank + spread)) - at(std::floor(rank - spread)))};
}

struct DrawnRegion {
    std::optional<DrawnFactor> ellipsoid;
    DrawnFactor rectangle;
};

/// \param value  what is reported of each result
DrawnRegion drawn_region(const Budget& budget, const BudgetPointResult& point, const std::vector<bool>& by_monte_carlo,
                         const Eigen::VectorXd& value, const Eigen::MatrixXd& covariance, double p) {
    const InputDraws draws(point.model->inputs(), budget.monte_carlo.value_or(MonteCarloRequest{}).seed, point.streams);
    const Eigen::Index m = value.size();
    const double pairs = static_cast<double>(m) * static_cast<double>(m);
    const auto trials = static_cast<Eigen::Index>(
        std::clamp(std::min(k_most_drawn / static_cast<double>(draws.size()), k_most_region_products / pairs),
                   k_least_region_trials, k_most_region_trials));
    const bool any_of_model = std::find(by_monte_carlo.begin(), by_monte_carlo.end(), true) != by_monte_carlo.end();
    Metric metric = metric_of(covariance);
    if (m > k_most_in_drawn_ellipsoid) {
        metric.root.resize(0, 0);
    }
    const Eigen::VectorXd estimates = input_estimates(*point.model);
    std::vector<double> ellipsoid;
    std::vector<double> rectangle;
    for (Eigen::Index first = 0; first < trials; first += k_region_rows) {
        const Eigen::Index count = std::min(k_region_rows, trials - first);
        Eigen::MatrixXd x(count, draws.size());
        Eigen::MatrixXd y(count, m);
        draws.draw(static_cast<std::uint64_t>(first), x);
        if (any_of_model) {
            point.model->evaluate_trials(x, y);
        }
        x.rowwise() -= estimates.transpose();
        for (Eigen::Index j = 0; j < m; ++j) {
            if (by_monte_carlo[static_cast<std::size_t>(j)]) {
                y.col(j).array() -= value(j);
            } else {
                y.col(j) = x * point.propagation.jacobian.row(j).transpose();
            }
            y.col(j) *= metric.u(j) > 0.0 ? 1.0 / metric.u(j) : 0.0;
        }
        const Eigen::VectorXd largest = y.cwiseAbs().rowwise().maxCoeff();
        rectangle.insert(rectangle.end(), largest.begin(), largest.end());
        if (metric.root.size() > 0) {
            // zᵀ z with L z = (η_j − y_j)/u_j, L Lᵀ the correlation matrix: no inverse is formed.
            const Eigen::MatrixXd z = metric.root.triangularView<Eigen::Lower>().solve(y.transpose());
            const Eigen::VectorXd distance = z.colwise().norm().transpose();
            ellipsoid.insert(ellipsoid.end(), distance.begin(), distance.end());
        }
    }
    DrawnRegion region{.ellipsoid = {}, .rectangle = factor_of_distances(rectangle, p)};
    if (!ellipsoid.empty()) {
        region.ellipsoid = factor_of_distances(ellipsoid, p);
    }
    return region;
}

bool is_normal(const InputGroup& group) {
    return std::isinf(group.degrees_of_freedom) &&
           std::all_of(group.marginals.begin(), group.marginals.end(),
                       [](const Distribution& d) {
                           return d.kind == DistributionKind::normal || d.kind == DistributionKind::constant;
                       }) &&
           (group.size() == 1 || group.is_diagonal() || group.dependence == Dependence::normal);
}

/// Whether all of a group is t about one unknown scale.
bool has_one_scale(const InputGroup& group) {
    return group.dependence == Dependence::student_t && !group.is_estimated_matrix && !group.is_diagonal() &&
           std::all_of(group.marginals.begin(), group.marginals.end(), [&](const Distribution& d) {
               return d.kind == DistributionKind::student_t && d.shape == group.degrees_of_freedom;
           });
}

}  // namespace

JointRegion law_ellipsoid(const Budget& budget, const BudgetPointResult& point, double coverage_probability) {
    JointRegion region;
    const Eigen::MatrixXd& V = point.propagation.covariance;
    std::vector<const InputGroup*> contributing;
    for (std::size_t g = 0; g < point.propagation.budget.size(); ++g) {
        if (point.propagation.budget[g].variance.maxCoeff() > 0.0) {
            contributing.push_back(&point.model->inputs()[g]);
        }
    }
    const auto m = static_cast<std::size_t>(V.rows());
    const auto all = [&](const auto& holds) {
        return std::all_of(contributing.begin(), contributing.end(),
                           [&](const InputGroup* group) { return holds(*group); });
    };
    const bool is_estimated = std::any_of(contributing.begin(), contributing.end(),
                                          [](const InputGroup* g) { return g->is_estimated_matrix; });
    if (contributing.size() == 1 && (is_estimated || all(has_one_scale))) {
        // The ν that the results are stated with, which may be cut to a whole number.
        double nu = contributing.front()->degrees_of_freedom;
        for (const BudgetOutputResult& output : point.outputs) {
            nu = std::min(nu, output.degrees_of_freedom);
        }
        region.degrees_of_freedom = nu;
    }
    if (metric_of(V).root.size() == 0) {
        region.no_ellipsoid_because = "singular";
        return region;
    }
    if (all(is_normal)) {
        region.ellipsoid_factor = ellipsoid_coverage_factor(coverage_probability, m, k_infinity);
        return region;
    }
    if (region.degrees_of_freedom) {
        const double nu = *region.degrees_of_freedom;
        if (is_estimated && !(nu > static_cast<double>(m) - 1.0)) {
            region.no_ellipsoid_because = "singular";  // the matrix that was estimated
            return region;
        }
        region.ellipsoid_factor = ellipsoid_coverage_factor(
            coverage_probability, m, nu, is_estimated ? EstimatedSpread::matrix : EstimatedSpread::scale);
        return region;
    }
    const bool any_unknown = std::any_of(contributing.begin(), contributing.end(),
                                         [](const InputGroup* g) { return std::isnan(g->degrees_of_freedom); });
    if (is_estimated || any_unknown || V.rows() > k_most_in_drawn_ellipsoid) {
        // Of V alone: how well it is known (Willink and Hall 2002). It gives no factor where other inputs are normal.
        const double nu = joint_effective_degrees_of_freedom(*point.model, point.propagation);
        if (std::isfinite(nu)) {
            region.degrees_of_freedom = nu;
        }
        region.no_ellipsoid_because = "distribution";
        return region;
    }
    const DrawnRegion drawn =
        drawn_region(budget, point, std::vector<bool>(m), point.propagation.value, V, coverage_probability);
    region.ellipsoid_factor = drawn.ellipsoid->value;
    region.ellipsoid_error = drawn.ellipsoid->error;
    return region;
}

namespace {

/// Whether the trials are about what is reported, within what is not seen in three digits of a factor: then the region
/// of the trials is that of the results, whichever method they are reported by.
bool trials_are_about(const MonteCarloResult& trials, const Eigen::VectorXd& value, const Eigen::MatrixXd& covariance) {
    constexpr double k_same = 0.01;
    const Eigen::Index m = value.size();
    if (covariance.rows() != m || trials.covariance.rows() != m || !covariance.allFinite()) {
        return false;
    }
    const Eigen::VectorXd u = covariance.diagonal().cwiseSqrt();
    for (Eigen::Index i = 0; i < m; ++i) {
        if (!(std::abs(trials.outputs[static_cast<std::size_t>(i)].mean - value(i)) <= k_same * u(i))) {
            return false;
        }
        for (Eigen::Index j = 0; j < m; ++j) {
            if (!(std::abs(trials.covariance(i, j) - covariance(i, j)) <= k_same * u(i) * u(j))) {
                return false;
            }
        }
    }
    return true;
}

JointRegion region_of_trials(const MonteCarloRegions& from) {
    JointRegion region;
    region.of_trials = true;
    region.ellipsoid_factor = from.ellipsoid_factor;
    region.rectangle_factor = from.parallelepiped_factor;
    region.no_ellipsoid_because = from.ellipsoid_factor ? "" : "singular";
    return region;
}

}  // namespace

std::optional<JointRegion> joint_region(const Budget& budget, const BudgetPointResult& point,
                                        const Eigen::MatrixXd& covariance) {
    const double p = budget.coverage_probability;
    const auto m = static_cast<Eigen::Index>(point.outputs.size());
    std::vector<bool> by_monte_carlo;
    Eigen::VectorXd value = point.propagation.value;
    for (Eigen::Index j = 0; j < m; ++j) {
        const BudgetOutputResult& output = point.outputs[static_cast<std::size_t>(j)];
        by_monte_carlo.push_back(output.by_monte_carlo);
        if (output.by_monte_carlo) {
            value(j) = output.monte_carlo->mean;
        }
    }
    const auto of_trials = std::count(by_monte_carlo.begin(), by_monte_carlo.end(), true);
    const bool has_regions =
        point.monte_carlo && point.monte_carlo->regions && point.monte_carlo->coverage_probability == p;
    if (has_regions && (of_trials == m || trials_are_about(*point.monte_carlo, value, covariance))) {
        return region_of_trials(*point.monte_carlo->regions);
    }
    if (of_trials == 0) {
        JointRegion region = law_ellipsoid(budget, point, p);
        BudgetPointResult asked = point;
        asked.propagation.coverage_probability = 1.0 - (1.0 - p) / static_cast<double>(m);
        double largest = 0.0;
        bool is_known = true;
        for (Eigen::Index j = 0; j < m; ++j) {
            BudgetOutputResult output;
            output.coverage_probability = asked.propagation.coverage_probability;
            expand_by_propagation(budget, asked, j, output);
            if (point.propagation.standard_uncertainty(j) > 0.0 || output.standard_uncertainty > 0.0) {
                is_known = is_known && output.coverage_factor.has_value();
                largest = std::max(largest, output.coverage_factor.value_or(0.0));
            }
        }
        if (is_known && largest > 0.0) {
            region.rectangle_factor = largest;
        }
        return region;
    }
    JointRegion region;
    region.of_trials = true;
    if (!budget.simultaneous.empty() || covariance.rows() != m || !covariance.allFinite()) {
        return std::nullopt;
    }
    const DrawnRegion drawn = drawn_region(budget, point, by_monte_carlo, value, covariance, p);
    region.rectangle_factor = drawn.rectangle.value;
    region.rectangle_error = drawn.rectangle.error;
    if (drawn.ellipsoid) {
        region.ellipsoid_factor = drawn.ellipsoid->value;
        region.ellipsoid_error = drawn.ellipsoid->error;
    } else {
        region.no_ellipsoid_because = metric_of(covariance).root.size() > 0 ? "distribution" : "singular";
    }
    return region;
}

}  // namespace gumcert::gum
