#include "engine/rotary_table/visit_effects.h"

#include <algorithm>

#include "engine/fixed_parts.h"
#include "gum/quantity/dense_factors.h"

namespace gumcert::engine {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// V⁻¹v and M = V⁻¹ Q_v V⁻¹ of the observations of one group.
struct GroupSpread {
    MatrixXd whitening;  ///< L⁻¹
    VectorXd weighted;   ///< V⁻¹v
    MatrixXd own;        ///< M
};
GroupSpread spread_of(const LinearisedGroup& group, const BorderedCovariance& covariance) {
    const Index n = group.residual.size();
    MatrixXd whitening = MatrixXd::Identity(n, n);
    group.cholesky.triangularView<Eigen::Lower>().solveInPlace(whitening);
    const MatrixXd cofactor = MatrixXd::Identity(n, n) -
                              group.jacobian * covariance(group.columns, group.columns) * group.jacobian.transpose();
    return {whitening, whitening.transpose() * group.residual, whitening.transpose() * cofactor * whitening};
}

}  // namespace

Inverted pseudo_inverse(const MatrixXd& matrix, double least) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(matrix);
    Inverted result{MatrixXd::Zero(matrix.rows(), matrix.cols()), 0};
    for (Index i = 0; i < matrix.rows(); ++i) {
        // What nothing else controls has no residual of its own: below the limit it is rounding, and its inverse would
        // make a large test value of it.
        if (eigen.eigenvalues()[i] > least) {
            ++result.rank;
            result.inverse +=
                eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose() / eigen.eigenvalues()[i];
        }
    }
    return result;
}

VisitEffects::VisitEffects(const JointAdjustment& adjustment, const NormalEquations& normal,
                           const BorderedCovariance& covariance)
    : covariance_(covariance), size_(adjustment.visits().size()), out_(size_, false) {
    for (std::size_t g = 0; g < size_; ++g) {
        groups_.push_back(&normal.groups()[g]);
    }
    groups_.push_back(&normal.groups()[adjustment.fixture_prior()]);
    for (const LinearisedGroup* group : groups_) {
        GroupSpread spread = spread_of(*group, covariance);
        // Relative to the weights of the visit, so that no unit decides what counts as controlled.
        least_.push_back(k_controlled * spread.whitening.squaredNorm());
        weighted_.push_back(std::move(spread.weighted));
        own_.push_back(std::move(spread.own));
        whitening_.push_back(std::move(spread.whitening));
    }
}

void VisitEffects::leave_out(std::size_t g) {
    Effect effect(size_);
    effect[g] = MatrixXd::Identity(own_[g].rows(), own_[g].rows());
    take_away(effect, own_[g].rows());
    out_[g] = true;
}

void VisitEffects::take_away(const std::vector<Column>& columns) {
    take_away(effect_of(columns), static_cast<Index>(columns.size()));
}

void VisitEffects::take_away(const Effect& effect, Index q) {
    const Projection projected = projection(effect, q);
    // C may contain what was taken away before, or what the parameters take up wholly: only the part that is
    // controlled is taken away.
    LeftOut left{columns(effect, q),
                 pseudo_inverse(projected.spread, k_controlled * std::max(projected.weight, 1e-300)).inverse};
    const VectorXd error = left.inverse * projected.weighted;
    for (std::size_t h = 0; h < groups_.size(); ++h) {
        weighted_[h] -= left.columns[h] * error;
        own_[h] -= left.columns[h] * left.inverse * left.columns[h].transpose();
    }
    left_out_.push_back(std::move(left));
}

VisitEffects::Projection VisitEffects::projection(const std::vector<Column>& columns) const {
    return projection(effect_of(columns), static_cast<Index>(columns.size()));
}

VisitEffects::Projection VisitEffects::projection(const Effect& effect, Index q) const {
    Projection result{VectorXd::Zero(q), MatrixXd::Zero(q, q), 0.0};
    for (std::size_t g = 0; g < size_; ++g) {
        if (effect[g].size() > 0) {
            const MatrixXd whitened = whitening_[g] * effect[g];
            result.weighted.noalias() += effect[g].transpose().lazyProduct(weighted_[g]);
            result.spread.noalias() += whitened.transpose().lazyProduct(whitened);
        }
    }
    result.weight = result.spread.diagonal().maxCoeff();
    const MatrixXd pull = pull_of(effect, q);
    // Cᵀ M C = C̃ᵀ C̃ − pᵀ Q p with C̃ = L⁻¹ C and p = J̃ᵀ C̃, less what was left out. M itself, distances ×
    // distances, is never formed.
    for (Index k = 0; k < q; ++k) {
        result.spread.col(k) -= pull.transpose() * covariance_.times(pull.col(k));
    }
    result.spread -= taken_from(effect, q, 0);
    return result;
}

MatrixXd VisitEffects::taken_from(const Effect& effect, Index q, std::size_t from) const {
    MatrixXd taken = MatrixXd::Zero(q, q);
    for (std::size_t i = from; i < left_out_.size(); ++i) {
        const MatrixXd across = left_out_[i].across(effect, q);
        taken += across.transpose() * left_out_[i].inverse * across;
    }
    return taken;
}

VisitEffects::Sum VisitEffects::Sum::operator-(const Sum& other) const {
    return {weighted - other.weighted, weight - other.weight, of_poses - other.of_poses, carried - other.carried,
            distances - other.distances};
}

double VisitEffects::Sum::chi_square() const {
    Eigen::Matrix3d spread = weight - of_poses - carried.transpose().lazyProduct(carried);
    spread.diagonal().array() += k_controlled * weight.diagonal().maxCoeff();
    return weighted.dot(spread.inverse() * weighted);
}

VisitEffects::GrowingSum::GrowingSum(const VisitEffects& visits, std::size_t angles)
    : visits_(visits), pulls_(angles), parts_(angles, Eigen::Matrix3d::Zero()) {
    sum_.carried = Triple::Zero(visits.carried_.front().cols(), 3);
}

void VisitEffects::GrowingSum::add(const Seen& seen, std::size_t angle, const Triple& columns) {
    const std::size_t g = seen.visit;
    const MatrixXd& whitening = visits_.whitening_[g];
    const LinearisedGroup& group = *visits_.groups_[g];
    const Index border = visits_.covariance_.border();
    Triple whitened = Triple::Zero(whitening.rows(), 3);
    for (const Index i : seen.rows) {
        sum_.weighted += visits_.weighted_[g][i] * columns.row(i).transpose();
        sum_.carried.noalias() += visits_.carried_[g].row(i).transpose() * columns.row(i);
        whitened.noalias() += whitening.col(i) * columns.row(i);
    }
    sum_.weight.noalias() += whitened.transpose().lazyProduct(whitened);
    sum_.distances += seen.rows.size();
    Index first = -1;
    for (std::size_t c = 0; c < group.columns.size(); ++c) {
        const Index parameter = group.columns[c];
        if (parameter < border) {
            continue;
        }
        if (first < 0) {
            first = visits_.covariance_.first_of(parameter);
            if (pulls_[angle].size() == 0) {
                pulls_[angle] = Triple::Zero(visits_.covariance_.own(first).rows(), 3);
            }
        }
        pulls_[angle].row(parameter - first) += group.jacobian.col(static_cast<Index>(c)).transpose() * whitened;
    }
    if (first >= 0) {
        const Eigen::Matrix3d part = pulls_[angle].transpose() * (visits_.covariance_.own(first) * pulls_[angle]);
        sum_.of_poses += part - parts_[angle];
        parts_[angle] = part;
    }
}

void VisitEffects::prepare_sums(const Workers& workers) {
    if (carried_.empty()) {
        carried_.resize(size_);
        const MatrixXd& root = covariance_.border_root();
        const MatrixXd of_poses = covariance_.elimination() * root;
        FixedParts(size_, 16).run(workers, [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t g = begin; g < end; ++g) {
                const std::vector<Index>& parameters = groups_[g]->columns;
                MatrixXd rows(parameters.size(), root.cols());
                for (std::size_t c = 0; c < parameters.size(); ++c) {
                    const Index at = parameters[c] - covariance_.border();
                    rows.row(static_cast<Index>(c)) = at < 0 ? root.row(parameters[c]) : of_poses.row(at);
                }
                carried_[g].noalias() = whitening_[g].transpose() * (groups_[g]->jacobian * rows);
            }
        });
    }
    for (; carried_left_out_ < left_out_.size(); ++carried_left_out_) {
        const LeftOut& left = left_out_[carried_left_out_];
        const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(left.inverse);
        const MatrixXd root = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
        for (std::size_t g = 0; g < size_; ++g) {
            const Index before = carried_[g].cols();
            carried_[g].conservativeResize(Eigen::NoChange, before + root.cols());
            carried_[g].rightCols(root.cols()).noalias() = left.columns[g] * root;
        }
    }
}

double VisitEffects::weighted(const Effect& effect) const {
    double sum = 0.0;
    for (std::size_t g = 0; g < size_; ++g) {
        sum += effect[g].size() > 0 ? effect[g].col(0).dot(weighted_[g]) : 0.0;
    }
    return sum;
}

MatrixXd VisitEffects::LeftOut::across(const Effect& effect, Index q) const {
    MatrixXd sum = MatrixXd::Zero(inverse.rows(), q);
    for (std::size_t g = 0; g < effect.size(); ++g) {
        if (effect[g].size() > 0) {
            sum.noalias() += columns[g].transpose().lazyProduct(effect[g]);
        }
    }
    return sum;
}

VisitEffects::Effect VisitEffects::effect_of(const std::vector<Column>& columns) const {
    const auto q = static_cast<Index>(columns.size());
    Effect effect(size_);
    for (Index k = 0; k < q; ++k) {
        for (const auto& [g, value] : columns[static_cast<std::size_t>(k)]) {
            if (effect[g].size() == 0) {
                effect[g] = MatrixXd::Zero(own_[g].rows(), q);
            }
            effect[g].col(k).array() += value;
        }
    }
    return effect;
}

MatrixXd VisitEffects::pull_of(const Effect& effect, Index q) const {
    MatrixXd pull = MatrixXd::Zero(covariance_.size(), q);
    for (std::size_t g = 0; g < size_; ++g) {
        if (effect[g].size() > 0) {
            pull(groups_[g]->columns, Eigen::all) += groups_[g]->jacobian.transpose() * (whitening_[g] * effect[g]);
        }
    }
    return pull;
}

MatrixXd VisitEffects::shift_of_parameters(const Effect& effect, Index q) const {
    const MatrixXd pull = pull_of(effect, q);
    MatrixXd shift(covariance_.size(), q);
    for (Index k = 0; k < q; ++k) {
        shift.col(k) = covariance_.times(pull.col(k));
    }
    return shift;
}

VisitEffects::Effect VisitEffects::columns(const Effect& effect, Index q) const {
    const MatrixXd shift = shift_of_parameters(effect, q);
    Effect result;
    for (std::size_t h = 0; h < groups_.size(); ++h) {
        const LinearisedGroup& group = *groups_[h];
        MatrixXd part = -(group.jacobian * shift(group.columns, Eigen::all));
        if (h < size_ && effect[h].size() > 0) {
            part += whitening_[h] * effect[h];
        }
        result.emplace_back(whitening_[h].transpose() * part);
    }
    for (const LeftOut& left : left_out_) {
        const MatrixXd error = left.inverse * left.across(effect, q);
        for (std::size_t h = 0; h < groups_.size(); ++h) {
            result[h] -= left.columns[h] * error;
        }
    }
    return result;
}

}  // namespace gumcert::engine
