#include "gum/propagation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "gum/argument_check.h"
#include "gum/coverage.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/distribution_shape.h"
#include "gum/quantity/special_values.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

constexpr double k_symmetry_tolerance = 1e-12;  // relative to u_i u_j: what computing a product A B Aᵀ may leave

/// Rounding that an n×n correlation matrix may carry, relative to its largest eigenvalue.
double rounding_tolerance(Eigen::Index n) {
    return 10.0 * static_cast<double>(n) * k_epsilon;
}

/// V = D R Dᵀ of one group, as the factor F = D L with F Fᵀ = V.
struct GroupFactor {
    Eigen::VectorXd u;                    ///< n, standard uncertainties: the diagonal of D
    std::optional<Eigen::MatrixXd> root;  ///< n×n, L with L Lᵀ = R; none when R is the identity
};

/// Position of a quantity in its group, as a person counts.
std::string ordinal(Eigen::Index index) {
    return "quantity " + std::to_string(index + 1);
}

std::string place_of(const InputGroup& group) {
    return "input group '" + group.name + "'";
}

/// The quantities that the eigenvector of an offending eigenvalue is made of.
std::string causes(const Eigen::VectorXd& eigenvector) {
    const double threshold = 0.5 * eigenvector.cwiseAbs().maxCoeff();
    std::string text;
    int named = 0;
    for (Eigen::Index i = 0; i < eigenvector.size() && named < 6; ++i) {
        if (std::abs(eigenvector(i)) >= threshold) {
            text += text.empty() ? ordinal(i) : ", " + ordinal(i);
            ++named;
        }
    }
    return text;
}

/// Checks one group and factors its covariance. Every problem found is appended; the factor is usable if none was.
GroupFactor factor_group(const InputGroup& group, std::vector<Diagnostic>& problems) {
    const auto report = [&](const char* code, std::string what, std::string rule, std::string action) {
        problems.push_back(Diagnostic{.code = code,
                                      .where = place_of(group),
                                      .what = std::move(what),
                                      .rule = std::move(rule),
                                      .action = std::move(action)});
    };
    const Eigen::Index n = group.size();
    GroupFactor factor;

    // NaN says that no degrees of freedom can be stated, and only together with the reason that a report will print.
    // Without one it is a mistake.
    if (!(group.degrees_of_freedom > 0.0) &&
        !(std::isnan(group.degrees_of_freedom) && !group.no_degrees_of_freedom_because.empty())) {
        report("GC-GUM-0005", "degrees of freedom " + text::shortest(group.degrees_of_freedom),
               "must be greater than 0 or infinite", "Correct the value, or leave it out where it is infinite.");
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        if (!std::isfinite(group.value(i))) {
            report("GC-GUM-0050", "estimate of " + ordinal(i) + " is " + text::shortest(group.value(i)),
                   "estimates must be finite", "Correct the estimate.");
            break;
        }
    }
    const Eigen::MatrixXd& V = group.covariance;
    const bool diagonal = V.cols() == 1;
    if (V.rows() != n || (V.cols() != n && !diagonal)) {
        report("GC-GUM-0050",
               "covariance has " + text::count_of(V.rows(), "row") + " and " + text::count_of(V.cols(), "column") +
                   " for " + text::count_of(n, "quantity"),
               "must be n×n, or n×1 for a diagonal", "Give one row for every quantity.");
        return factor;
    }
    if (!V.allFinite()) {
        report("GC-GUM-0050", "covariance holds a number that is not finite", "covariances must be finite",
               "Correct the covariance.");
        return factor;
    }
    const Eigen::VectorXd variance = diagonal ? Eigen::VectorXd(V.col(0)) : Eigen::VectorXd(V.diagonal());
    // A zero variance is a quantity that is known. A negative one has no meaning, and its root would be NaN far from
    // here.
    for (Eigen::Index i = 0; i < n; ++i) {
        if (variance(i) < 0.0) {
            report("GC-GUM-0051", "variance of " + ordinal(i) + " is " + text::shortest(variance(i)),
                   "a variance must not be negative", "Correct the covariance.");
            return factor;
        }
    }
    factor.u = variance.cwiseSqrt();
    if (diagonal) {
        return factor;
    }

    Eigen::MatrixXd R = Eigen::MatrixXd::Identity(n, n);
    const double tolerance = rounding_tolerance(n);
    for (Eigen::Index j = 0; j < n; ++j) {
        for (Eigen::Index i = j + 1; i < n; ++i) {
            // Relative to u_i u_j, because an absolute limit would judge the same matrix differently in another unit.
            const double scale = factor.u(i) * factor.u(j);
            const double lower = V(i, j);
            const double upper = V(j, i);
            if (std::abs(lower - upper) > std::max(k_symmetry_tolerance, tolerance) * scale) {
                report("GC-GUM-0052",
                       "covariance of " + ordinal(i) + " and " + ordinal(j) + " is " + text::shortest(lower) +
                           " below and " + text::shortest(upper) + " above the diagonal",
                       "a covariance matrix is symmetric", "Correct the covariance.");
                return factor;
            }
            const double covariance = 0.5 * (lower + upper);
            if (std::abs(covariance) > (1.0 + tolerance) * scale) {
                report("GC-GUM-0053",
                       "covariance of " + ordinal(j) + " and " + ordinal(i) + " is " + text::shortest(covariance) +
                           " for standard uncertainties " + text::shortest(factor.u(j)) + " and " +
                           text::shortest(factor.u(i)),
                       "a correlation coefficient lies between -1 and 1", "Correct the covariance.");
                return factor;
            }
            // A quantity of uncertainty 0 correlates with nothing; that its covariance is 0 has been asked above.
            R(i, j) = scale > 0.0 ? covariance / scale : 0.0;
            R(j, i) = R(i, j);
        }
    }
    if (group.factor.size() > 0) {
        if (group.factor.rows() != n || group.factor.cols() != n || !group.factor.isLowerTriangular(0.0)) {
            throw std::logic_error("input group: the factor of a covariance is n×n and lower triangular");
        }
        factor.root = known_correlation_root(group);
        return factor;
    }
    // Cholesky succeeds on everything positive definite, at a thirtieth of the cost of the eigenvalues; what it cannot
    // factor is singular (r = 1: allowed) or indefinite (refused), and only the eigenvalues tell which.
    const Eigen::LLT<Eigen::MatrixXd> cholesky(R);
    if (cholesky.info() == Eigen::Success) {
        factor.root = cholesky.matrixL();
        return factor;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(R);
    if (eigen.info() != Eigen::Success) {
        report("GC-GUM-0054", "eigenvalues of the correlation matrix could not be computed",
               "a covariance matrix is positive semi-definite", "Correct the covariance.");
        return factor;
    }
    const double smallest = eigen.eigenvalues()(0);
    if (smallest < -tolerance * eigen.eigenvalues()(n - 1)) {
        report("GC-GUM-0054",
               "correlation matrix has the eigenvalue " + text::shortest(smallest) + ", caused by " +
                   causes(eigen.eigenvectors().col(0)),
               "a covariance matrix is positive semi-definite",
               "Correct the correlations of these quantities; they contradict each other.");
        return factor;
    }
    // Any L with L Lᵀ = R gives the same V_y. Eigenvalues that are negative within rounding are the zeros of a singular
    // matrix, for example of r = 1.
    factor.root = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
    return factor;
}

std::vector<GroupFactor> factor_groups(const std::vector<InputGroup>& groups) {
    std::vector<Diagnostic> problems;
    std::vector<GroupFactor> factors;
    factors.reserve(groups.size());
    for (const InputGroup& group : groups) {
        factors.push_back(factor_group(group, problems));
    }
    if (!problems.empty()) {
        throw InputError(std::move(problems));
    }
    return factors;
}

[[noreturn]] void no_result(const char* code, std::string where, std::string what, std::string rule,
                            std::string action) {
    throw NoResultError(Diagnostic{.code = code,
                                   .where = std::move(where),
                                   .what = std::move(what),
                                   .rule = std::move(rule),
                                   .action = std::move(action)});
}

std::string output_place(const MeasurementModel& model, Eigen::Index output) {
    return "output '" + model.outputs()[static_cast<std::size_t>(output)].name + "'";
}

void require_finite_value(const MeasurementModel& model, const Eigen::VectorXd& value) {
    for (Eigen::Index i = 0; i < value.size(); ++i) {
        // Refused here: a NaN would go through every sum below and come out as an uncertainty.
        if (!std::isfinite(value(i))) {
            no_result("GC-GUM-0055", output_place(model, i), "the model gives " + text::shortest(value(i)),
                      "a measurement model must be finite at the estimates",
                      "Check the estimates for a division by 0 or a function outside its domain.");
        }
    }
}

void require_finite_jacobian(const MeasurementModel& model, const Eigen::MatrixXd& jacobian) {
    if (jacobian.allFinite()) {
        return;
    }
    Eigen::Index first = 0;
    for (const InputGroup& group : model.inputs()) {
        for (Eigen::Index j = first; j < first + group.size(); ++j) {
            for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
                if (!std::isfinite(jacobian(i, j))) {
                    no_result("GC-GUM-0056", output_place(model, i),
                              "the sensitivity coefficient for " + ordinal(j - first) + " of " + place_of(group) +
                                  " is " + text::shortest(jacobian(i, j)),
                              "the law of propagation needs a finite derivative at the estimates",
                              "The model cannot be made linear there: use the Monte Carlo method.");
                }
            }
        }
        first += group.size();
    }
}

void divide_into_shares(BudgetContribution& contribution, const Eigen::VectorXd& total) {
    contribution.share = Eigen::VectorXd::Zero(total.size());
    for (Eigen::Index i = 0; i < total.size(); ++i) {
        // With u(y) = 0 there is nothing to share out.
        if (total(i) > 0.0) {
            contribution.share(i) = contribution.variance(i) / total(i);
        }
    }
}

std::vector<BudgetContribution> add_up_by_source(const std::vector<InputGroup>& groups,
                                                 const std::vector<BudgetContribution>& budget,
                                                 const Eigen::VectorXd& total) {
    std::vector<BudgetContribution> sources;
    std::unordered_map<std::string, std::size_t> index_of;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        // Order of first appearance, not of a hash: the same job gives the same table.
        const std::string& source = groups[g].source.empty() ? groups[g].name : groups[g].source;
        const auto [entry, is_new] = index_of.emplace(source, sources.size());
        if (is_new) {
            sources.push_back(BudgetContribution{.name = source, .variance = budget[g].variance, .share = {}});
        } else {
            sources[entry->second].variance += budget[g].variance;
        }
    }
    for (BudgetContribution& source : sources) {
        divide_into_shares(source, total);
    }
    return sources;
}

/// Sets to 0 what only rounding left of quantities that cancel: 3 a − b with r = 1 and u(b) = 3 u(a). It is no u.
///
/// Coefficients, roots and products are rounded: c L is uncertain by some ε Σ|c_i|u_i where L is known, as it is of stated
/// r = ±1. Where it comes from the covariance, the entries of R are rounded, u² = c R c by some ε (Σ|c_i|u_i)², and u by
/// the root of that: R = 1 − 10⁻¹⁵ must not be taken for 1, nor 1 for it.
/// \param contributions  Σ|c_i|u_i, one an output
/// \param block          c L, a row an output
void clear_rounding(const InputGroup& group, const Eigen::VectorXd& contributions, Eigen::Ref<Eigen::MatrixXd> block) {
    constexpr double k_roundings = 8.0;
    const double relative = group.factor.size() > 0 ? k_roundings * k_epsilon : std::sqrt(k_roundings * k_epsilon);
    for (Eigen::Index i = 0; i < block.rows(); ++i) {
        if (block.row(i).norm() <= relative * contributions(i)) {
            block.row(i).setZero();
        }
    }
}

}  // namespace

UncertaintyBudget uncertainty_budget(const MeasurementModel& model, Eigen::VectorXd value,
                                     std::vector<Eigen::VectorXd> variances, double coverage_probability) {
    require_probability(coverage_probability, "coverage probability");
    const std::vector<InputGroup>& groups = model.inputs();
    UncertaintyBudget result;
    result.coverage_probability = coverage_probability;
    result.value = std::move(value);
    const Eigen::Index m = result.value.size();
    Eigen::VectorXd total = Eigen::VectorXd::Zero(m);
    result.budget.reserve(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        total += variances[g];
        result.budget.push_back(
            BudgetContribution{.name = groups[g].name, .variance = std::move(variances[g]), .share = {}});
    }
    for (Eigen::Index i = 0; i < m; ++i) {
        if (!std::isfinite(total(i))) {
            no_result("GC-GUM-0057", output_place(model, i), "the variance is " + text::shortest(total(i)),
                      "a standard uncertainty must be finite", "Check the input uncertainties and their units.");
        }
    }
    result.standard_uncertainty = total.cwiseSqrt();
    result.effective_degrees_of_freedom.resize(m);
    result.coverage_factor.resize(m);
    std::vector<UncertaintyContribution> contributions(groups.size());
    for (Eigen::Index i = 0; i < m; ++i) {
        bool stated = true;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            // A group enters Welch–Satterthwaite as one contribution, because the formula holds for independent ones,
            // and the quantities in a group are not.
            contributions[g] = {.uncertainty = std::sqrt(result.budget[g].variance(i)),
                                .degrees_of_freedom = groups[g].degrees_of_freedom};
            if (std::isnan(groups[g].degrees_of_freedom)) {
                // A group without degrees of freedom matters only where it contributes; other outputs keep their ν_eff.
                stated = stated && result.budget[g].variance(i) == 0.0;
                contributions[g].degrees_of_freedom = k_infinity;
            }
        }
        result.effective_degrees_of_freedom(i) = stated ? effective_degrees_of_freedom(contributions) : k_nan;
        result.coverage_factor(i) =
            stated ? coverage_factor(coverage_probability, result.effective_degrees_of_freedom(i)) : k_nan;
    }
    result.expanded_uncertainty = result.coverage_factor.cwiseProduct(result.standard_uncertainty);
    for (BudgetContribution& contribution : result.budget) {
        divide_into_shares(contribution, total);
    }
    result.shares_by_source = add_up_by_source(groups, result.budget, total);
    return result;
}

Propagation propagate(const MeasurementModel& model, double coverage_probability) {
    require_probability(coverage_probability, "coverage probability");
    const std::vector<InputGroup>& groups = model.inputs();
    const std::vector<GroupFactor> factors = factor_groups(groups);

    const Eigen::VectorXd x = input_estimates(model);
    const auto m = static_cast<Eigen::Index>(model.outputs().size());
    Eigen::VectorXd value = model.evaluate(x);
    if (value.size() != m) {
        throw std::logic_error("measurement model: evaluate() does not return one value an output");
    }
    require_finite_value(model, value);
    Propagation result;
    result.jacobian = model.jacobian(x);
    if (result.jacobian.rows() != m || result.jacobian.cols() != x.size()) {
        throw std::logic_error("measurement model: jacobian() is not outputs × inputs");
    }
    require_finite_jacobian(model, result.jacobian);

    // S = C F with F Fᵀ = V_x, group by group. Then V_y = S Sᵀ is positive semi-definite by construction and a
    // contribution, being a sum of squares, cannot come out negative.
    Eigen::MatrixXd S = result.jacobian;
    std::vector<Eigen::VectorXd> variances;
    Eigen::Index first = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const Eigen::Index n = groups[g].size();
        auto block = S.middleCols(first, n);
        // First the columns of C times u, then the root of the correlation matrix: quantities of very different size
        // are brought to the unit of y before they are mixed.
        block.array().rowwise() *= factors[g].u.transpose().array();
        const Eigen::VectorXd contributions = block.cwiseAbs().rowwise().sum();
        if (factors[g].root) {
            const Eigen::MatrixXd product = block * *factors[g].root;
            block = product;
            clear_rounding(groups[g], contributions, block);
        }
        variances.emplace_back(block.rowwise().squaredNorm());
        first += n;
    }
    static_cast<UncertaintyBudget&>(result) =
        uncertainty_budget(model, std::move(value), std::move(variances), coverage_probability);
    result.covariance = Eigen::MatrixXd::Zero(m, m);
    result.covariance.selfadjointView<Eigen::Lower>().rankUpdate(S);
    result.covariance.triangularView<Eigen::StrictlyUpper>() = result.covariance.transpose();
    // The same sum as the budget, to the last bit.
    result.covariance.diagonal().setZero();
    for (const BudgetContribution& contribution : result.budget) {
        result.covariance.diagonal() += contribution.variance;
    }
    return result;
}

namespace {

/// The covariance matrix of all inputs, n×n.
/// \pre the groups are those of a propagation, hence checked
Eigen::MatrixXd input_covariance(const MeasurementModel& model, Eigen::Index n) {
    Eigen::MatrixXd V = Eigen::MatrixXd::Zero(n, n);
    Eigen::Index first = 0;
    for (const InputGroup& group : model.inputs()) {
        const Eigen::Index size = group.size();
        if (group.is_diagonal()) {
            V.diagonal().segment(first, size) = group.covariance.col(0);
        } else {
            V.block(first, first, size, size) = group.covariance;
        }
        first += size;
    }
    return V;
}

/// F with F Fᵀ = V of all inputs, n×n; empty where no factor is known better than V itself.
/// \pre the groups are those of a propagation, hence checked
Eigen::MatrixXd input_factor(const MeasurementModel& model, Eigen::Index n) {
    const std::vector<InputGroup>& groups = model.inputs();
    if (std::none_of(groups.begin(), groups.end(), [](const InputGroup& group) { return group.factor.size() > 0; })) {
        return {};
    }
    const std::vector<GroupFactor> factors = factor_groups(groups);
    Eigen::MatrixXd F = Eigen::MatrixXd::Zero(n, n);
    Eigen::Index first = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const Eigen::Index size = groups[g].size();
        F.diagonal().segment(first, size) = factors[g].u;
        if (factors[g].root) {
            F.block(first, first, size, size) = factors[g].u.asDiagonal() * *factors[g].root;
        }
        first += size;
    }
    return F;
}

/// Total variance of the distinct elements of a covariance matrix that is known with one degree of freedom.
double total_variance(const Eigen::MatrixXd& V) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < V.cols(); ++j) {
        // Var(v_ij) of a covariance matrix that is known with ν degrees of freedom is (v_ii v_jj + v_ij²)/ν.
        for (Eigen::Index i = 0; i <= j; ++i) {
            sum += V(i, i) * V(j, j) + V(i, j) * V(i, j);
        }
    }
    return sum;
}

/// What the moments of inputs that are not normal add to the variance of second order, m values.
///
/// The formula of JCGM 100:2008, 5.1.2 note, holds for normal inputs. An input of its own with another distribution, of
/// skewness γ and kurtosis κ (a t counts as normal with its u), adds c H_ii γ u³ + [¼ H_ii² + ⅓ c ∂³f/∂x_i³] (κ − 3)
/// u⁴, from the variance of the Taylor series to the same order: x² at 0, uniform on −1 … 1, has u² = 1/5 − 1/9 = 4/45.
Eigen::VectorXd moments_beyond_normal(const MeasurementModel& model, const Propagation& first_order,
                                      const Eigen::VectorXd& x, const std::vector<Eigen::MatrixXd>& H) {
    constexpr double k_step = 0.1;  // of u: between the rounding of third differences and their truncation
    const Eigen::Index m = first_order.value.size();
    Eigen::VectorXd added = Eigen::VectorXd::Zero(m);
    struct Input {
        Eigen::Index column = 0;
        double u = 0.0, skewness = 0.0, excess = 0.0;
    };
    std::vector<Input> inputs;
    Eigen::Index column = 0;
    for (const InputGroup& group : model.inputs()) {
        // Only inputs of their own: the moments of correlated ones beyond the covariance are not known.
        if (group.size() == 1 && group.marginals.size() == 1 && group.covariance(0, 0) > 0.0) {
            const Distribution& marginal = group.marginals.front();
            const double skew = skewness(marginal);
            const double excess = kurtosis(marginal) - 3.0;
            // A t has an infinite kurtosis for ν ≤ 4, hence the exception.
            if (marginal.kind != DistributionKind::student_t && std::isfinite(skew) && std::isfinite(excess) &&
                (skew != 0.0 || excess != 0.0)) {
                inputs.push_back({column, std::sqrt(group.covariance(0, 0)), skew, excess});
            }
        }
        column += group.size();
    }
    if (inputs.empty()) {
        return added;
    }
    Eigen::MatrixXd points = x.transpose().replicate(4 * static_cast<Eigen::Index>(inputs.size()), 1);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        constexpr std::array<double, 4> k_steps{-2.0, -1.0, 1.0, 2.0};
        for (std::size_t s = 0; s < k_steps.size(); ++s) {
            points(static_cast<Eigen::Index>(4 * i + s), inputs[i].column) += k_steps[s] * k_step * inputs[i].u;
        }
    }
    Eigen::MatrixXd y(points.rows(), m);
    model.evaluate_trials(points, y);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const Input& input = inputs[i];
        const auto at = static_cast<Eigen::Index>(4 * i);
        const double u = input.u;
        for (Eigen::Index k = 0; k < m; ++k) {
            const double c = first_order.jacobian(k, input.column);
            const double h = H[static_cast<std::size_t>(k)](input.column, input.column);
            // Third central difference, 2 h³ f‴. Below the rounding of the four values it is noise, and the division
            // would make 500 times as much of it.
            double third = y(at + 3, k) - 2.0 * y(at + 2, k) + 2.0 * y(at + 1, k) - y(at, k);
            const double rounding = 32.0 * k_epsilon * y.col(k).segment(at, 4).cwiseAbs().maxCoeff();
            // Times u³; not finite where a step leaves the domain of the model.
            third = std::abs(third) <= rounding ? 0.0 : third / (2.0 * k_step * k_step * k_step);
            added(k) += c * h * input.skewness * u * u * u +
                        (0.25 * h * h * u * u * u * u + c * u * third / 3.0) * input.excess;
        }
    }
    return added;
}

}  // namespace

double joint_effective_degrees_of_freedom(const MeasurementModel& model, const Propagation& propagation) {
    // Relative to the largest uncertainty among the outputs of the same unit: fourth powers leave the range of double,
    // and an output in nanometres must not drown beside one in radians. Outputs of one unit keep their proportions,
    // because the total variance of Willink and Hall depends on them.
    std::unordered_map<std::string, double> largest;
    const auto m = static_cast<std::size_t>(propagation.value.size());
    for (std::size_t i = 0; i < m; ++i) {
        double& most = largest[model.outputs()[i].unit];
        most = std::max(most, propagation.standard_uncertainty(static_cast<Eigen::Index>(i)));
    }
    Eigen::VectorXd weight(static_cast<Eigen::Index>(m));
    for (std::size_t i = 0; i < m; ++i) {
        const double most = largest[model.outputs()[i].unit];
        weight(static_cast<Eigen::Index>(i)) = most > 0.0 ? 1.0 / most : 0.0;
    }
    const Eigen::MatrixXd C = weight.asDiagonal() * propagation.jacobian;
    double denominator = 0.0;
    Eigen::Index first = 0;
    for (const InputGroup& group : model.inputs()) {
        const Eigen::Index size = group.size();
        const auto c = C.middleCols(first, size);
        first += size;
        // A covariance that is known adds nothing to the denominator.
        if (std::isinf(group.degrees_of_freedom)) {
            continue;
        }
        const Eigen::MatrixXd S = group.factor.size() > 0 ? Eigen::MatrixXd(c * group.factor) : Eigen::MatrixXd();
        const Eigen::MatrixXd V = S.size() > 0 ? Eigen::MatrixXd(S * S.transpose())
                                  : group.is_diagonal()
                                      ? Eigen::MatrixXd(c * group.covariance.col(0).asDiagonal() * c.transpose())
                                      : Eigen::MatrixXd(c * group.covariance * c.transpose());
        const double variance = total_variance(V);
        if (variance == 0.0) {
            continue;
        }
        denominator += variance / group.degrees_of_freedom;  // NaN where none can be stated
    }
    const double numerator = total_variance(weight.asDiagonal() * propagation.covariance * weight.asDiagonal());
    return denominator == 0.0 ? k_infinity : numerator / denominator;
}

std::optional<SecondOrderPropagation> propagate_to_second_order(const MeasurementModel& model,
                                                                const Propagation& first_order) {
    const Eigen::VectorXd x = input_estimates(model);
    const std::vector<Eigen::MatrixXd> H = model.hessians(x);
    if (H.empty()) {
        return std::nullopt;
    }
    const Eigen::MatrixXd V = input_covariance(model, x.size());
    const Eigen::MatrixXd F = input_factor(model, x.size());
    const Eigen::VectorXd u = V.diagonal().cwiseSqrt();
    const Eigen::Index m = first_order.value.size();
    SecondOrderPropagation result{.standard_uncertainty = Eigen::VectorXd::Zero(m), .shift = Eigen::VectorXd::Zero(m)};
    const Eigen::VectorXd beyond_normal = moments_beyond_normal(model, first_order, x, H);
    for (Eigen::Index k = 0; k < m; ++k) {
        // ½ tr(H V H V) is the variance, ½ tr(H V) the mean of the quadratic term of normal inputs, correlated or not.
        const Eigen::MatrixXd& Hk = H[static_cast<std::size_t>(k)];
        const Eigen::MatrixXd HV = F.size() > 0 ? Eigen::MatrixXd(F.transpose() * Hk * F) : Eigen::MatrixXd(Hk * V);
        const double u1 = first_order.standard_uncertainty(k);
        double variance = u1 * u1 + 0.5 * (HV * HV).trace();
        result.shift(k) = 0.5 * HV.trace();
        // Derivative of tr(H V) along V cᵀ, whose length is a standard deviation of the inputs times u(y): a step of a
        // fraction of that, not of the inputs themselves, which may be 0.
        const Eigen::VectorXd c = first_order.jacobian.row(k).transpose();
        const Eigen::VectorXd direction =
            F.size() > 0 ? Eigen::VectorXd(F * (F.transpose() * c)) : Eigen::VectorXd(V * c);
        if (u1 > 0.0 && direction.allFinite() && !direction.isZero(0.0)) {
            constexpr double k_step = 1e-3;
            const auto trace_at = [&](double step) {
                const std::vector<Eigen::MatrixXd> there = model.hessians(x + (step / u1) * direction);
                const Eigen::MatrixXd& H_there = there[static_cast<std::size_t>(k)];
                return F.size() > 0 ? (F.transpose() * H_there * F).trace() : H_there.cwiseProduct(V).sum();
            };
            // Error of the fourth order in the step: differences at one and two steps.
            const double one = (trace_at(k_step) - trace_at(-k_step)) / (2.0 * k_step);
            const double two = (trace_at(2.0 * k_step) - trace_at(-2.0 * k_step)) / (4.0 * k_step);
            variance += u1 * (4.0 * one - two) / 3.0;
        }
        if (std::isfinite(beyond_normal(k))) {  // not where a step leaves the domain of the model
            variance += beyond_normal(k);
        }
        if (!std::isfinite(variance)) {
            return std::nullopt;
        }
        result.standard_uncertainty(k) = std::sqrt(std::max(0.0, variance));
    }
    return result;
}

Eigen::MatrixXd known_correlation_root(const InputGroup& group) {
    const Eigen::VectorXd u = group.covariance.diagonal().cwiseSqrt();
    return u.unaryExpr([](double of) { return of > 0.0 ? 1.0 / of : 0.0; }).asDiagonal() * group.factor;
}

Eigen::MatrixXd correlation_matrix(const Eigen::MatrixXd& covariance) {
    const Eigen::Index m = covariance.rows();
    Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(m, m);
    for (Eigen::Index j = 0; j < m; ++j) {
        for (Eigen::Index i = 0; i < m; ++i) {
            // Two roots and no root of a product: a product of variances in m² may leave the range of double.
            const double scale = std::sqrt(covariance(i, i)) * std::sqrt(covariance(j, j));
            if (i != j) {
                correlation(i, j) = scale > 0.0 ? std::clamp(covariance(i, j) / scale, -1.0, 1.0) : 0.0;
            }
        }
    }
    return correlation;
}

}  // namespace gumcert::gum
