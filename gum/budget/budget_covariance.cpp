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
    Eigen::MatrixXd root = semidefinite_root(R);
    if (!group.own_streams.empty()) {
        std::vector<bool> is_given;
        for (const std::uint64_t own : group.own_streams) {
            is_given.push_back(own == InputGroup::k_shared);
        }
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

PointFactor factor_of(const BudgetPointResult& point) {
    PointFactor factor;
    Eigen::Index column = 0;
    for (std::size_t g = 0; g < point.streams.size(); ++g) {
        const InputGroup& group = point.model->inputs()[g];
        const auto J = point.propagation.jacobian.middleCols(column, group.size());
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

}  // namespace

Eigen::MatrixXd budget_covariance(const BudgetResult& result) {
    const auto m = static_cast<Eigen::Index>(result.output_names.size());
    const auto points = static_cast<Eigen::Index>(result.points.size());
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(m * points, m * points);
    if (points > 1) {
        std::vector<PointFactor> factors;
        std::map<Deviate, std::size_t> uses;
        for (const BudgetPointResult& point : result.points) {
            factors.push_back(factor_of(point));
            for (const auto& [deviate, column] : factors.back()) {
                ++uses[deviate];
            }
        }
        std::map<Deviate, Eigen::Index> shared;
        for (const auto& [deviate, count] : uses) {
            if (count > 1) {
                shared.emplace(deviate, static_cast<Eigen::Index>(shared.size()));
            }
        }
        const auto all = static_cast<Eigen::Index>(shared.size());
        for (Eigen::Index first = 0; first < all; first += k_columns) {
            Eigen::MatrixXd S = Eigen::MatrixXd::Zero(m * points, std::min(k_columns, all - first));
            for (Eigen::Index p = 0; p < points; ++p) {
                for (const auto& [deviate, column] : factors[static_cast<std::size_t>(p)]) {
                    const auto found = shared.find(deviate);
                    if (found != shared.end() && found->second >= first && found->second < first + S.cols()) {
                        S.block(p * m, found->second - first, m, 1) = column;
                    }
                }
            }
            covariance.selfadjointView<Eigen::Lower>().rankUpdate(S);
        }
        covariance.triangularView<Eigen::StrictlyUpper>() = covariance.transpose();
    }
    for (Eigen::Index p = 0; p < points; ++p) {  // with what is of this point alone
        covariance.block(p * m, p * m, m, m) = result.points[static_cast<std::size_t>(p)].propagation.covariance;
    }
    return covariance;
}

}  // namespace gumcert::gum
