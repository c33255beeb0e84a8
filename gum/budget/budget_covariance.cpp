#include "gum/budget/budget_covariance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "gum/monte_carlo/correlated_normal.h"
#include "gum/propagation.h"

namespace gumcert::gum {

namespace {

constexpr Eigen::Index k_columns = 256;  // of a block of the factor, so that it stays small beside the covariance

/// What a point shares with others: a random deviate, by the stream of its group and its place there.
using Deviate = std::pair<std::uint64_t, Eigen::Index>;

/// How much the outputs of one point move with each deviate: S S'ᵀ of two points is their covariance.
using PointFactor = std::vector<std::pair<Deviate, Eigen::VectorXd>>;

/// How the quantities of a group move with its shared deviates: D L, for quantities that are drawn at this point alone
/// D G L of those that are shared. It is what gum/monte_carlo/random_draws.h draws.
Eigen::MatrixXd shared_root(const InputGroup& group) {
    const Eigen::MatrixXd R = correlation_matrix(group.covariance);
    Eigen::MatrixXd root = group.factor.size() > 0 ? known_correlation_root(group) : semidefinite_root(R);
    if (!group.own_streams.empty()) {
        std::vector<bool> is_given;
        for (const std::uint64_t own : group.own_streams) {
            is_given.push_back(own == InputGroup::k_shared);
        }
        // A quantity that each point states by itself is drawn given those that all points share. Between points only
        // its expectation given the shared ones is common, hence G L in place of L in its row.
        const ConditionalNormal conditional = conditional_normal(R, is_given);
        for (std::size_t i = 0; i < conditional.others.size(); ++i) {
            Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(root.cols());
            for (std::size_t g = 0; g < conditional.given.size(); ++g) {
                row += conditional.coefficients(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(g)) *
                       root.row(conditional.given[g]);
            }
            root.row(conditional.others[i]) = row;
        }
    }
    return group.covariance.diagonal().cwiseSqrt().asDiagonal() * root;
}

PointFactor factor_of(const BudgetPointResult& point, const Eigen::MatrixXd& jacobian) {
    PointFactor factor;
    Eigen::Index column = 0;
    for (std::size_t g = 0; g < point.streams.size(); ++g) {
        const InputGroup& group = point.model->inputs()[g];
        const auto J = jacobian.middleCols(column, group.size());
        column += group.size();
        if (group.size() == 1 || group.is_diagonal()) {
            for (Eigen::Index i = 0; i < group.size(); ++i) {
                const double variance = group.is_diagonal() ? group.covariance(i, 0) : group.covariance(i, i);
                factor.emplace_back(Deviate{point.streams[g], i}, J.col(i) * std::sqrt(variance));
            }
            continue;
        }
        const Eigen::MatrixXd S = J * shared_root(group);
        for (Eigen::Index i = 0; i < group.size(); ++i) {
            factor.emplace_back(Deviate{point.streams[g], i}, S.col(i));
        }
    }
    return factor;
}

/// J V Jᵀ of one point.
Eigen::MatrixXd own_covariance(const BudgetPointResult& point, const Eigen::MatrixXd& jacobian) {
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(jacobian.rows(), jacobian.rows());
    Eigen::Index column = 0;
    for (const InputGroup& group : point.model->inputs()) {
        const auto J = jacobian.middleCols(column, group.size());
        column += group.size();
        if (group.is_diagonal()) {
            covariance += J * group.covariance.col(0).asDiagonal() * J.transpose();
        } else if (group.factor.size() > 0) {
            const Eigen::MatrixXd S = J * group.factor;
            covariance += S * S.transpose();
        } else {
            covariance += J * group.covariance * J.transpose();
        }
    }
    return 0.5 * (covariance + covariance.transpose());
}

/// \param jacobians  one a point
/// \param own        covariance of the results of each point among themselves
Eigen::MatrixXd covariance_of_points(const BudgetResult& result, const std::vector<Eigen::MatrixXd>& jacobians,
                                     const std::vector<Eigen::MatrixXd>& own) {
    std::vector<Eigen::Index> first{0};  // result of each point
    for (const BudgetPointResult& point : result.points) {
        first.push_back(first.back() + static_cast<Eigen::Index>(point.outputs.size()));
    }
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(first.back(), first.back());
    if (result.points.size() > 1) {
        std::vector<PointFactor> factors;
        std::map<Deviate, std::size_t> uses;
        for (std::size_t p = 0; p < result.points.size(); ++p) {
            factors.push_back(factor_of(result.points[p], jacobians[p]));
            for (const auto& [deviate, column] : factors.back()) {
                ++uses[deviate];
            }
        }
        std::map<Deviate, Eigen::Index> shared;
        for (const auto& [deviate, count] : uses) {
            // A deviate of one point alone makes no covariance between points; left out, the factor stays small for
            // long tables.
            if (count > 1) {
                shared.emplace(deviate, static_cast<Eigen::Index>(shared.size()));
            }
        }
        const auto all = static_cast<Eigen::Index>(shared.size());
        // S Sᵀ, a sum of products of one factor with itself: the covariance is positive semi-definite by construction,
        // which sums of pairs of points would not be after rounding.
        for (Eigen::Index block = 0; block < all; block += k_columns) {
            Eigen::MatrixXd S = Eigen::MatrixXd::Zero(first.back(), std::min(k_columns, all - block));
            for (std::size_t p = 0; p < factors.size(); ++p) {
                for (const auto& [deviate, column] : factors[p]) {
                    const auto found = shared.find(deviate);
                    if (found != shared.end() && found->second >= block && found->second < block + S.cols()) {
                        S.block(first[p], found->second - block, column.size(), 1) = column;
                    }
                }
            }
            covariance.selfadjointView<Eigen::Lower>().rankUpdate(S);
        }
        covariance.triangularView<Eigen::StrictlyUpper>() = covariance.transpose();
    }
    for (std::size_t p = 0; p < result.points.size(); ++p) {  // with what is of this point alone
        // The blocks on the diagonal are those of the law of propagation itself, so that their u is the one that is
        // printed.
        covariance.block(first[p], first[p], own[p].rows(), own[p].cols()) = own[p];
    }
    return covariance;
}

}  // namespace

Eigen::MatrixXd budget_covariance(const BudgetResult& result) {
    std::vector<Eigen::MatrixXd> jacobians;
    std::vector<Eigen::MatrixXd> own;
    for (const BudgetPointResult& point : result.points) {
        jacobians.push_back(point.propagation.jacobian);
        own.push_back(point.propagation.covariance);
    }
    return covariance_of_points(result, jacobians, own);
}

Eigen::MatrixXd budget_covariance(const BudgetResult& result, const std::vector<Eigen::MatrixXd>& jacobians) {
    std::vector<Eigen::MatrixXd> own;
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        own.push_back(own_covariance(result.points[p], jacobians[p]));
    }
    return covariance_of_points(result, jacobians, own);
}

}  // namespace gumcert::gum
