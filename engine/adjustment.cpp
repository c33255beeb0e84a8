#include "engine/adjustment.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& covariance) {
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    if (factor.info() != Eigen::Success) {
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0001", "adjustment", "the covariance matrix of a group of observations is not positive definite",
            "weights are the inverse of the covariance", "state standard uncertainties greater than 0",
            gum::Severity::error});
    }
    return factor.matrixL();
}

/// L⁻¹ times the rows of `matrix`, in place, by forward substitution. Groups are small and most factors are diagonal:
/// the general triangular solve of Eigen spends its time on packing.
template <typename Rows>
void whiten(const Eigen::MatrixXd& lower, Rows&& matrix) {
    for (Eigen::Index i = 0; i < lower.rows(); ++i) {
        for (Eigen::Index k = 0; k < i; ++k) {
            if (lower(i, k) != 0.0) {
                matrix.row(i) -= lower(i, k) * matrix.row(k);
            }
        }
        matrix.row(i) /= lower(i, i);
    }
}

/// Components of one block as they are: the functional model of a prior.
class ComponentModel final : public ObservationModel {
public:
    ComponentModel(std::vector<int> components, int block_size)
        : components_(std::move(components)), block_size_(block_size) {}

    void predict(const double* const* parameters, double* predicted, double* const* jacobians) const override {
        for (std::size_t i = 0; i < components_.size(); ++i) {
            predicted[i] = parameters[0][components_[i]];
        }
        if (jacobians != nullptr && jacobians[0] != nullptr) {
            Eigen::Map<RowMajorMatrix> jacobian(jacobians[0], static_cast<Eigen::Index>(components_.size()),
                                                block_size_);
            jacobian.setZero();
            for (std::size_t i = 0; i < components_.size(); ++i) {
                jacobian(static_cast<Eigen::Index>(i), components_[i]) = 1.0;
            }
        }
    }

private:
    std::vector<int> components_;
    int block_size_;
};

}  // namespace

/// Residual L⁻¹ (f(x) - l) of one group for Ceres.
class Adjustment::WhitenedCost final : public ceres::CostFunction {
public:
    WhitenedCost(const Group& group, const std::vector<Block>& blocks) : group_(group) {
        set_num_residuals(static_cast<int>(group.observed.size()));
        for (const BlockId block : group.blocks) {
            mutable_parameter_block_sizes()->push_back(static_cast<int>(blocks[block].value.size()));
        }
    }

    bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
        const Eigen::Index n = group_.observed.size();
        group_.model->predict(parameters, residuals, jacobians);
        Eigen::Map<Eigen::VectorXd> residual(residuals, n);
        residual -= group_.observed;
        whiten(group_.cholesky, residual);
        if (jacobians != nullptr) {
            for (std::size_t k = 0; k < parameter_block_sizes().size(); ++k) {
                if (jacobians[k] != nullptr) {
                    whiten(group_.cholesky, Eigen::Map<RowMajorMatrix>(jacobians[k], n, parameter_block_sizes()[k]));
                }
            }
        }
        return residual.allFinite();
    }

private:
    const Group& group_;
};

Adjustment::BlockId Adjustment::add_parameters(std::vector<std::string> names, Eigen::VectorXd start, bool eliminated) {
    // A held parameter keeps its place in its block, so that no model needs to know what is held.
    std::vector<bool> held(names.size(), false);
    blocks_.push_back({std::move(names), std::move(start), std::move(held), eliminated});
    return blocks_.size() - 1;
}

void Adjustment::hold(BlockId block, int component) {
    blocks_[block].held[static_cast<std::size_t>(component)] = true;
}

Adjustment::GroupId Adjustment::add_observations(std::shared_ptr<const ObservationModel> model,
                                                 std::vector<BlockId> blocks, Eigen::VectorXd observed,
                                                 const Eigen::MatrixXd& covariance) {
    // V = L Lᵀ. Residuals and derivatives times L⁻¹ have the variance 1 and no correlation: from here on a correlated
    // group is added up like any other, and V is never inverted.
    groups_.push_back({std::move(model), std::move(blocks), std::move(observed), cholesky_factor(covariance), false});
    return groups_.size() - 1;
}

Adjustment::GroupId Adjustment::add_prior(BlockId block, std::vector<int> components, Eigen::VectorXd observed,
                                          const Eigen::MatrixXd& covariance) {
    const int size = static_cast<int>(blocks_[block].value.size());
    const GroupId group = add_observations(std::make_shared<ComponentModel>(std::move(components), size), {block},
                                           std::move(observed), covariance);
    groups_[group].is_prior = true;
    return group;
}

void Adjustment::set_covariance(GroupId group, const Eigen::MatrixXd& covariance) {
    groups_[group].cholesky = cholesky_factor(covariance);
}

Eigen::VectorXd Adjustment::residual(GroupId id) const {
    const Group& group = groups_[id];
    std::vector<const double*> parameters;
    for (const BlockId block : group.blocks) {
        parameters.push_back(blocks_[block].value.data());
    }
    Eigen::VectorXd predicted(group.observed.size());
    group.model->predict(parameters.data(), predicted.data(), nullptr);
    return group.observed - predicted;
}

Eigen::MatrixXd Adjustment::jacobian(GroupId id, BlockId wanted) const {
    const Group& group = groups_[id];
    std::vector<const double*> parameters;
    std::vector<double*> jacobians(group.blocks.size(), nullptr);
    RowMajorMatrix result = RowMajorMatrix::Zero(group.observed.size(), blocks_[wanted].value.size());
    for (std::size_t k = 0; k < group.blocks.size(); ++k) {
        parameters.push_back(blocks_[group.blocks[k]].value.data());
        if (group.blocks[k] == wanted) {
            jacobians[k] = result.data();
        }
    }
    Eigen::VectorXd predicted(group.observed.size());
    group.model->predict(parameters.data(), predicted.data(), jacobians.data());
    return result;
}

/// What does not depend on the parameters: columns and the blocks that groups touch.
NormalEquations Adjustment::structure() const {
    NormalEquations normal;
    normal.workers_ = workers_;
    normal.column_of_.resize(blocks_.size());
    std::vector<std::size_t> eliminated_of(blocks_.size(), blocks_.size());
    // Border first, then the eliminated blocks: an index says at once to which of them a parameter belongs.
    for (const bool eliminated : {false, true}) {
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            const Block& block = blocks_[b];
            if (block.eliminated != eliminated) {
                continue;
            }
            const auto first = static_cast<Eigen::Index>(normal.parameters_.size());
            for (std::size_t c = 0; c < block.held.size(); ++c) {
                if (block.held[c]) {
                    normal.column_of_[b].push_back(-1);
                    continue;
                }
                normal.column_of_[b].push_back(static_cast<Eigen::Index>(normal.parameters_.size()));
                normal.parameters_.push_back({b, static_cast<int>(c), block.names[c]});
            }
            const auto size = static_cast<Eigen::Index>(normal.parameters_.size()) - first;
            if (eliminated && size > 0) {
                eliminated_of[b] = normal.blocks_.size();
                NormalEquations::EliminatedBlock& own = normal.blocks_.emplace_back();
                own.first = first;
                own.normal.resize(size, size);
            }
        }
        if (!eliminated) {
            normal.border_ = static_cast<Eigen::Index>(normal.parameters_.size());
        }
    }
    normal.groups_.resize(groups_.size());
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        // A group touches at most one eliminated block (a distance has one pose). On that the block form rests: no
        // product of two eliminated blocks ever appears.
        std::size_t touched = blocks_.size();
        for (const BlockId block : groups_[g].blocks) {
            touched = std::min(touched, eliminated_of[block]);
            for (const Eigen::Index column : normal.column_of_[block]) {
                if (column >= 0) {
                    normal.groups_[g].columns.push_back(column);
                }
            }
        }
        (touched < blocks_.size() ? normal.blocks_[touched].groups : normal.groups_of_border_).push_back(g);
    }
    return normal;
}

NormalEquations Adjustment::linearise() const {
    NormalEquations normal = structure();
    linearise(normal);
    return normal;
}

void Adjustment::linearise(NormalEquations& normal) const {
    // Of a fixed size, which does not depend on the threads: sums of rounded numbers depend on how they are parted.
    constexpr std::size_t k_groups_of_a_part = 256;
    const FixedParts parts(groups_.size(), k_groups_of_a_part);
    parts.run(workers_, [&](std::size_t, std::size_t begin, std::size_t end) {
        std::vector<RowMajorMatrix> raw;
        RowMajorMatrix whitened;
        std::vector<const double*> parameters;
        std::vector<double*> jacobians;
        for (std::size_t g = begin; g < end; ++g) {
            const Group& group = groups_[g];
            const Eigen::Index n = group.observed.size();
            raw.resize(std::max(raw.size(), group.blocks.size()));
            parameters.clear();
            jacobians.clear();
            for (std::size_t k = 0; k < group.blocks.size(); ++k) {
                const Block& block = blocks_[group.blocks[k]];
                raw[k].resize(n, block.value.size());
                parameters.push_back(block.value.data());
                jacobians.push_back(raw[k].data());
            }
            LinearisedGroup& linear = normal.groups_[g];
            linear.residual.resize(n);
            group.model->predict(parameters.data(), linear.residual.data(), jacobians.data());
            linear.residual = group.observed - linear.residual;
            whitened.resize(n, static_cast<Eigen::Index>(linear.columns.size()));
            Eigen::Index column = 0;
            for (std::size_t k = 0; k < group.blocks.size(); ++k) {
                // A held component has no column: its derivatives are left out, and it stays where it is.
                const std::vector<Eigen::Index>& of = normal.column_of_[group.blocks[k]];
                for (std::size_t c = 0; c < of.size(); ++c) {
                    if (of[c] >= 0) {
                        whitened.col(column++) = raw[k].col(static_cast<Eigen::Index>(c));
                    }
                }
            }
            linear.cholesky = group.cholesky;
            whiten(linear.cholesky, whitened);
            whiten(linear.cholesky, linear.residual);
            linear.jacobian = whitened;
        }
    });
    normal.accumulate();
}

Eigen::Index NormalEquations::column(std::size_t block, int component) const {
    return column_of_[block][static_cast<std::size_t>(component)];
}

FixedParts NormalEquations::blocks_in_parts() const {
    constexpr std::size_t k_blocks_of_a_part = 64;
    return {blocks_.size(), k_blocks_of_a_part};
}

/// Jᵀ V⁻¹ J and Jᵀ V⁻¹ (observed - predicted) of one group, added where its parameters are.
void NormalEquations::add(const LinearisedGroup& group, EliminatedBlock* block, Sums& sums) {
    sums.product.noalias() = group.jacobian.transpose() * group.jacobian;
    sums.pull.noalias() = group.jacobian.transpose() * group.residual;
    const std::vector<Eigen::Index>& columns = group.columns;
    for (std::size_t j = 0; j < columns.size(); ++j) {
        const double* const values = sums.product.col(static_cast<Eigen::Index>(j)).data();
        if (columns[j] < border_) {
            double* const to = sums.border.col(columns[j]).data();
            for (std::size_t i = 0; i < columns.size(); ++i) {
                if (columns[i] < border_) {
                    to[columns[i]] += values[i];
                }
            }
            sums.gradient[columns[j]] += sums.pull[static_cast<Eigen::Index>(j)];
            continue;
        }
        const Eigen::Index row = columns[j] - block->first;
        double* const across = block->border.row(row).data();
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (columns[i] < border_) {
                across[columns[i]] += values[i];
            } else {
                block->normal(columns[i] - block->first, row) += values[i];
            }
        }
        gradient_[columns[j]] += sums.pull[static_cast<Eigen::Index>(j)];
    }
}

Eigen::Index NormalEquations::first_column(std::size_t block) const {
    const auto free = std::ranges::find_if(column_of_[block], [](Eigen::Index column) { return column >= 0; });
    return free == column_of_[block].end() ? -1 : *free;
}

// Normal equations have the square of the condition number of the design: 3·10³ of a usual measurement becomes 10⁷,
// which leaves nine digits of a standard uncertainty (design note rotary-table.md, 4e). What this cannot carry is found
// by rank() beforehand.
void NormalEquations::accumulate() {
    gradient_ = Eigen::VectorXd::Zero(parameter_count());
    const auto none = [this] {
        return Sums{.border = Eigen::MatrixXd::Zero(border_, border_),
                    .eliminated = Eigen::MatrixXd::Zero(border_, border_),
                    .gradient = Eigen::VectorXd::Zero(border_)};
    };
    const FixedParts parts = blocks_in_parts();
    std::vector<Sums> sums(parts.parts());
    parts.run(workers_, [&](std::size_t part, std::size_t begin, std::size_t end) {
        sums[part] = none();
        const Eigen::Index rows = blocks_[end - 1].first + blocks_[end - 1].normal.rows() - blocks_[begin].first;
        Eigen::MatrixXd halves(border_, rows);  // (L⁻¹ A_eb)ᵀ side by side
        for (std::size_t e = begin; e < end; ++e) {
            EliminatedBlock& block = blocks_[e];
            const Eigen::Index size = block.normal.rows();
            block.normal.setZero();
            block.border.setZero(size, border_);
            for (const std::size_t group : block.groups) {
                add(groups_[group], &block, sums[part]);
            }
            // Schur complement A_bb − A_be A_ee⁻¹ A_eb, block by block. With A_ee = L Lᵀ what is taken off is a product
            // of L⁻¹ A_eb with its own transpose: symmetric to the last bit, and never negative.
            const Eigen::LLT<Eigen::MatrixXd> factor(block.normal);
            block.inverse = factor.solve(Eigen::MatrixXd::Identity(size, size));
            block.elimination = block.border;
            factor.matrixL().solveInPlace(block.elimination);
            halves.middleCols(block.first - blocks_[begin].first, size) = block.elimination.transpose();
            factor.matrixU().solveInPlace(block.elimination);
        }
        sums[part].eliminated.selfadjointView<Eigen::Lower>().rankUpdate(halves);
    });
    Sums all = none();
    for (const std::size_t group : groups_of_border_) {
        add(groups_[group], nullptr, all);
    }
    // In the order of the parts, whichever thread made them.
    for (const Sums& part : sums) {
        all.border += part.border;
        all.eliminated += part.eliminated;
        all.gradient += part.gradient;
    }
    border_normal_ = std::move(all.border);
    gradient_.head(border_) = all.gradient;
    reduced_ = border_normal_ - all.eliminated;
    reduced_.triangularView<Eigen::StrictlyUpper>() = reduced_.transpose();
}

RankReport NormalEquations::rank(double tolerance) const {
    RankReport report;
    report.smallest_to_largest = 1.0;
    const auto add_names = [&](const Eigen::VectorXd& direction, Eigen::Index first) {
        const double largest = direction.cwiseAbs().maxCoeff();
        for (Eigen::Index i = 0; i < direction.size(); ++i) {
            if (std::abs(direction[i]) > 0.05 * largest) {
                report.parameters.push_back(parameters_[static_cast<std::size_t>(first + i)].name);
            }
        }
        report.deficient = true;
    };
    // A pose whose own block is singular cannot be eliminated: name it before looking at the border.
    for (const EliminatedBlock& block : blocks_) {
        const Eigen::VectorXd diagonal = block.normal.diagonal();
        if (!(diagonal.minCoeff() > 0.0)) {
            add_names((diagonal.array() > 0.0).select(Eigen::VectorXd::Zero(diagonal.size()), 1.0), block.first);
            continue;
        }
        // With columns of unit length metres, radians and scales can be compared: without it the unit of a parameter
        // would decide whether it counts as determined.
        const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
            Eigen::MatrixXd(scale.asDiagonal() * block.normal * scale.asDiagonal()));
        const double ratio = eigen.eigenvalues()[0] / eigen.eigenvalues()[diagonal.size() - 1];
        report.smallest_to_largest = std::min(report.smallest_to_largest, ratio);
        if (!(ratio > tolerance)) {
            add_names(eigen.eigenvectors().col(0), block.first);
        }
    }
    // With a singular block the elimination is not defined, and the border says nothing.
    if (report.deficient || border_ == 0) {
        return report;
    }
    const Eigen::VectorXd diagonal = border_normal_.diagonal();
    if (!(diagonal.minCoeff() > 0.0)) {
        add_names((diagonal.array() > 0.0).select(Eigen::VectorXd::Zero(diagonal.size()), 1.0), 0);
        report.smallest_to_largest = 0.0;
        return report;
    }
    const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        Eigen::MatrixXd(scale.asDiagonal() * reduced_ * scale.asDiagonal()));
    // Before the elimination the scaled border has a diagonal of 1. Where the elimination leaves hardly anything of it,
    // the largest eigenvalue is as small as the smallest, and their ratio would look sound.
    const double ratio = eigen.eigenvalues()[0] / std::max(1.0, eigen.eigenvalues()[border_ - 1]);
    report.smallest_to_largest = std::min(report.smallest_to_largest, ratio);
    if (!(ratio > tolerance)) {
        add_names(eigen.eigenvectors().col(0), 0);
    }
    return report;
}

BorderedCovariance NormalEquations::bordered_covariance() const {
    BorderedCovariance result;
    result.border_covariance_.resize(border_, border_);
    result.border_root_.resize(border_, border_);
    if (border_ > 0) {
        // Scaled to a unit diagonal first: metres, radians and scales differ by many powers of ten.
        const Eigen::VectorXd scale = reduced_.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::LLT<Eigen::MatrixXd> factor(Eigen::MatrixXd(scale.asDiagonal() * reduced_ * scale.asDiagonal()));
        if (!scale.allFinite() || factor.info() != Eigen::Success) {  // the factor lets NaN pass
            throw gum::NoResultError(
                gum::Diagnostic{"GC-ADJUST-0002", "adjustment", "the normal equations are singular",
                                "a covariance exists only where the observations determine every parameter",
                                "check the rank report, add stations, reflectors or angles", gum::Severity::error});
        }
        Eigen::MatrixXd& covariance = result.border_covariance_;
        covariance = factor.solve(Eigen::MatrixXd::Identity(border_, border_));
        covariance = (scale.asDiagonal() * covariance * scale.asDiagonal()).eval();
        // Symmetric to the last bit: what is read above and below the diagonal is the same number.
        covariance = (0.5 * (covariance + covariance.transpose())).eval();
        // N = Uᵀ U of the scaled border, so that U⁻¹ is a root of its inverse. Variances made of a root cannot be
        // negative.
        const Eigen::MatrixXd root = factor.matrixU().solve(Eigen::MatrixXd::Identity(border_, border_));
        result.border_root_ = scale.asDiagonal() * root;
    }
    const Eigen::Index q = parameter_count() - border_;
    result.elimination_.resize(q, border_);
    result.own_of_.resize(static_cast<std::size_t>(q));
    result.cross_.resize(q, border_);
    result.own_.resize(blocks_.size());
    blocks_in_parts().run(workers_, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            const EliminatedBlock& block = blocks_[e];
            const Eigen::Index size = block.normal.rows();
            const Eigen::Index first = block.first - border_;
            result.elimination_.middleRows(first, size) = -block.elimination;
            std::fill_n(result.own_of_.begin() + first, size, e);
        }
        const Eigen::Index first = blocks_[begin].first - border_;
        const Eigen::Index rows = blocks_[end - 1].first + blocks_[end - 1].normal.rows() - border_ - first;
        result.cross_.middleRows(first, rows).noalias() =
            result.elimination_.middleRows(first, rows) * result.border_covariance_;
        for (std::size_t e = begin; e < end; ++e) {
            const Eigen::Index at = blocks_[e].first - border_;
            const Eigen::Index size = blocks_[e].normal.rows();
            BorderedCovariance::Own& own = result.own_[e];
            own.first = blocks_[e].first;
            own.covariance = blocks_[e].inverse;
            const Eigen::MatrixXd spread =
                result.cross_.middleRows(at, size) * result.elimination_.middleRows(at, size).transpose();
            // What a block has of its own, and what the border brings in: A_ee⁻¹ + E C_b Eᵀ.
            own.total = 0.5 * (spread + spread.transpose()) + own.covariance;
            own.total.triangularView<Eigen::StrictlyUpper>() = own.total.transpose();  // symmetric to the last bit
        }
    });
    return result;
}

const Eigen::MatrixXd& BorderedCovariance::own(Eigen::Index parameter) const {
    return own_[own_of_[static_cast<std::size_t>(parameter - border())]].covariance;
}

Eigen::Index BorderedCovariance::first_of(Eigen::Index parameter) const {
    return own_[own_of_[static_cast<std::size_t>(parameter - border())]].first;
}

double BorderedCovariance::operator()(Eigen::Index row, Eigen::Index column) const {
    const Eigen::Index b = border();
    if (row < b && column < b) {
        return border_covariance_(row, column);
    }
    if (row < b || column < b) {
        return cross_(std::max(row, column) - b, std::min(row, column));
    }
    // Two parameters of one block share its own covariance; two of different blocks only what the border brings in.
    const std::size_t block = own_of_[static_cast<std::size_t>(row - b)];
    if (block == own_of_[static_cast<std::size_t>(column - b)]) {
        const Own& own = own_[block];
        return own.total(row - own.first, column - own.first);
    }
    const auto [low, high] = std::minmax(row, column);  // the same bits above and below the diagonal
    return cross_.row(high - b).dot(elimination_.row(low - b));
}

Eigen::MatrixXd BorderedCovariance::operator()(const Indices& rows, const Indices& columns) const {
    const Eigen::Index b = border();
    Eigen::MatrixXd result(rows.size(), columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j) {
        const Eigen::Index column = columns[j];
        double* to = result.col(static_cast<Eigen::Index>(j)).data();
        if (column < b) {
            for (const Eigen::Index row : rows) {
                *to++ = row < b ? border_covariance_(row, column) : cross_(row - b, column);
            }
            continue;
        }
        const double* across = cross_.row(column - b).data();
        for (const Eigen::Index row : rows) {
            *to++ = row < b ? across[row] : (*this)(row, column);
        }
    }
    return result;
}

Eigen::MatrixXd BorderedCovariance::times_left(const Eigen::Ref<const Eigen::MatrixXd>& rows) const {
    const Eigen::Index b = border();
    const Eigen::Index q = elimination_.rows();
    // The rows are carried to the border once. A product with the dense matrix would cost p² for each of them.
    Eigen::MatrixXd to_border = rows.leftCols(b);
    to_border.noalias() += rows.rightCols(q) * elimination_;
    Eigen::MatrixXd result(rows.rows(), b + q);
    result.leftCols(b).noalias() = to_border * border_covariance_;
    result.rightCols(q).noalias() = to_border * cross_.transpose();
    for (const Own& block : own_) {
        const Eigen::Index size = block.covariance.rows();
        result.middleCols(block.first, size).noalias() += rows.middleCols(block.first, size) * block.covariance;
    }
    return result;
}

Eigen::VectorXd BorderedCovariance::times(const Eigen::Ref<const Eigen::VectorXd>& vector) const {
    const Eigen::Index b = border();
    const Eigen::Index q = elimination_.rows();
    Eigen::VectorXd to_border = vector.head(b);
    to_border.noalias() += elimination_.transpose() * vector.tail(q);
    Eigen::VectorXd result(b + q);
    result.head(b).noalias() = border_covariance_ * to_border;
    result.tail(q).noalias() = cross_ * to_border;
    for (const Own& block : own_) {
        const Eigen::Index size = block.covariance.rows();
        result.segment(block.first, size).noalias() += block.covariance * vector.segment(block.first, size);
    }
    return result;
}

Eigen::MatrixXd BorderedCovariance::dense() const {
    const Eigen::Index b = border();
    const Eigen::Index q = elimination_.rows();
    Eigen::MatrixXd covariance(b + q, b + q);
    covariance.topLeftCorner(b, b) = border_covariance_;
    covariance.bottomLeftCorner(q, b) = cross_;
    covariance.topRightCorner(b, q) = cross_.transpose();
    covariance.bottomRightCorner(q, q).noalias() = cross_ * elimination_.transpose();
    for (const Own& block : own_) {
        const Eigen::Index size = block.covariance.rows();
        covariance.block(block.first, block.first, size, size) += block.covariance;
    }
    return covariance;
}

// Block elimination: the border first, then every eliminated block from the border. Costs grow in proportion to the
// angles.
Eigen::VectorXd NormalEquations::step() const {
    Eigen::VectorXd step(parameter_count());
    Eigen::VectorXd right = gradient_.head(border_);
    for (const EliminatedBlock& block : blocks_) {
        right.noalias() -= block.elimination.transpose() * gradient_.segment(block.first, block.normal.rows());
    }
    if (border_ > 0) {
        const Eigen::VectorXd scale = reduced_.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::LLT<Eigen::MatrixXd> factor(Eigen::MatrixXd(scale.asDiagonal() * reduced_ * scale.asDiagonal()));
        step.head(border_) = scale.asDiagonal() * factor.solve(scale.asDiagonal() * right);
    }
    for (const EliminatedBlock& block : blocks_) {
        const Eigen::Index size = block.normal.rows();
        step.segment(block.first, size).noalias() = block.inverse * gradient_.segment(block.first, size);
        step.segment(block.first, size).noalias() -= block.elimination * step.head(border_);
    }
    return step;
}

// Where the last step is negligible, the linear model knows its residuals without another evaluation. At a minimum the
// gradient is 0.
void NormalEquations::move(const Eigen::VectorXd& step) {
    Eigen::VectorXd local;
    for (LinearisedGroup& group : groups_) {
        local = step(group.columns);
        group.residual.noalias() -= group.jacobian * local;
    }
    gradient_.setZero();
}

Eigen::VectorXd NormalEquations::times(const Eigen::VectorXd& vector) const {
    Eigen::VectorXd result(vector.size());
    result.head(border_).noalias() = border_normal_ * vector.head(border_);
    for (const EliminatedBlock& block : blocks_) {
        const Eigen::Index size = block.normal.rows();
        const auto part = vector.segment(block.first, size);
        result.segment(block.first, size).noalias() = block.border * vector.head(border_) + block.normal * part;
        result.head(border_).noalias() += block.border.transpose() * part;
    }
    return result;
}

namespace {

/// Largest eigenvalue of a symmetric positive definite operator on vectors of `size` elements.
///
/// Lanczos iteration with full reorthogonalisation. The error of an eigenvalue is below the residual of its vector
/// (here to 1e-8 of it), and near the square of that where it stands apart from the next one.
template <typename Operator>
double largest_eigenvalue(const Operator& apply, Eigen::Index size) {
    constexpr Eigen::Index k_most_steps = 400;
    constexpr double k_residual = 1e-8;
    const Eigen::Index most = std::min(size, k_most_steps);
    std::vector<Eigen::VectorXd> basis;
    Eigen::VectorXd diagonal(most);
    Eigen::VectorXd beside(most);
    // A start that is not orthogonal to anything on purpose, and the same every time.
    Eigen::VectorXd next(size);
    std::uint64_t state = 1;
    for (Eigen::Index i = 0; i < size; ++i) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        next[i] = 0.5 + static_cast<double>(state >> 11U) * 0x1p-53;
        next[i] = (state & (std::uint64_t{1} << 63U)) != 0 ? next[i] : -next[i];
    }
    next.normalize();
    double largest = 0.0;
    for (Eigen::Index k = 0; k < most; ++k) {
        basis.push_back(next);
        next = apply(basis.back());
        diagonal[k] = basis.back().dot(next);
        // Twice: what rounding leaves along the earlier vectors after one pass would come back as copies of eigenvalues
        // that were found already.
        for (int repeat = 0; repeat < 2; ++repeat) {
            for (const Eigen::VectorXd& earlier : basis) {
                next -= earlier.dot(next) * earlier;
            }
        }
        const double length = next.norm();
        beside[k] = length;
        const bool last = k + 1 == most || !(length > 0.0);
        // The eigenvalues of the small matrix cost more than a product: they are asked for every fifth step only.
        if (last || k % 5 == 4) {
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
            eigen.computeFromTridiagonal(diagonal.head(k + 1), beside.head(k));
            largest = eigen.eigenvalues()[k];
            if (last || length * std::abs(eigen.eigenvectors()(k, k)) < k_residual * largest) {
                break;
            }
        }
        next /= length;
    }
    return largest;
}

}  // namespace

double NormalEquations::condition_number() const {
    const Eigen::Index p = parameter_count();
    Eigen::VectorXd scale(p);
    scale.head(border_) = border_normal_.diagonal().cwiseSqrt().cwiseInverse();
    for (const EliminatedBlock& block : blocks_) {
        scale.segment(block.first, block.normal.rows()) = block.normal.diagonal().cwiseSqrt().cwiseInverse();
    }
    if (!scale.allFinite()) {
        return std::numeric_limits<double>::infinity();
    }
    std::optional<BorderedCovariance> covariance;
    try {
        covariance = bordered_covariance();
    } catch (const gum::NoResultError&) {
        return std::numeric_limits<double>::infinity();
    }
    const Eigen::VectorXd inverse_scale = scale.cwiseInverse();
    // Largest eigenvalues of N and of N⁻¹ with a unit diagonal, from products with vectors: no p×p matrix is made. The
    // root, because N holds the squares of the singular values of the design.
    const double largest = largest_eigenvalue(
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return scale.cwiseProduct(times(scale.cwiseProduct(v))); },
        p);
    const double inverse_smallest = largest_eigenvalue(
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
            return inverse_scale.cwiseProduct(covariance->times(inverse_scale.cwiseProduct(v)));
        },
        p);
    const double square = largest * inverse_smallest;
    return square > 0.0 && std::isfinite(square) ? std::sqrt(square) : std::numeric_limits<double>::infinity();
}

// Residuals are whitened: the sum of their squares is vᵀ V⁻¹ v, priors included.
double NormalEquations::chi_square() const {
    double sum = 0.0;
    for (const LinearisedGroup& group : groups_) {
        sum += group.residual.squaredNorm();
    }
    return sum;
}

Eigen::Index NormalEquations::observation_count() const {
    Eigen::Index count = 0;
    for (const LinearisedGroup& group : groups_) {
        count += group.residual.size();
    }
    return count;
}

void Adjustment::apply(const NormalEquations& normal, const Eigen::VectorXd& step) {
    const std::vector<FreeParameter>& parameters = normal.parameters();
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        blocks_[parameters[i].block].value[parameters[i].component] += step[static_cast<Eigen::Index>(i)];
    }
}

SolveSummary Adjustment::refine(const SolverOptions& options) {
    NormalEquations last;
    return refine(options, last);
}

SolveSummary Adjustment::refine(const SolverOptions& options, NormalEquations& normal) {
    SolveSummary summary;
    summary.message = "the steps allowed were used up";
    normal = structure();
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < options.max_refinements; ++iteration) {
        linearise(normal);
        const Eigen::VectorXd step = normal.step();
        if (!step.allFinite()) {
            summary.message = "the normal equations are singular";
            return summary;
        }
        // δᵀ N δ = δᵀ g bounds every (δ_i / σ_i)², so no covariance is needed to judge convergence.
        const double size = std::sqrt(std::max(0.0, step.dot(normal.gradient_)));
        apply(normal, step);
        ++summary.iterations;
        // Residuals far above their standard deviations (an outlier still in) carry rounding of their own size: the
        // step is judged against what they would make of the uncertainties. With sound observations the factor is one.
        const double spread =
            std::max(1.0, std::sqrt(normal.chi_square() / static_cast<double>(normal.observation_count())));
        normal.move(step);
        if (size < options.step_tolerance * spread) {
            summary.converged = true;
            summary.message.clear();
            break;
        }
        // The first steps may grow while the parameters come near. Near a minimum they shrink; where they do not, there
        // is none.
        if (iteration > 5 && size > last) {
            summary.message = "Gauss-Newton steps grow";
            break;
        }
        last = size;
    }
    summary.chi_square = normal.chi_square();
    return summary;
}

SolveSummary Adjustment::solve(const SolverOptions& options) {
    // A library does not print: its failures are in the summary. Once, as campaigns are solved in several threads.
    [[maybe_unused]] static const bool is_quiet = (FLAGS_minloglevel = google::GLOG_FATAL, true);
    ceres::Problem::Options problem_options;
    problem_options.cost_function_ownership = ceres::TAKE_OWNERSHIP;
    ceres::Problem problem(problem_options);
    auto* ordering = new ceres::ParameterBlockOrdering;
    bool any_eliminated = false;
    // Ceres orders blocks by their addresses. One array in the order of the blocks keeps that order, and with it every
    // rounding, independent of where the heap happens to lie.
    std::vector<std::size_t> first(blocks_.size());
    std::size_t size = 0;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        first[b] = size;
        size += static_cast<std::size_t>(blocks_[b].value.size());
    }
    std::vector<double> values(size);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        std::copy(blocks_[b].value.begin(), blocks_[b].value.end(),
                  values.begin() + static_cast<std::ptrdiff_t>(first[b]));
    }
    std::vector<bool> used(blocks_.size(), false);
    for (const Group& group : groups_) {
        std::vector<double*> pointers;
        for (const BlockId block : group.blocks) {
            pointers.push_back(values.data() + first[block]);
            used[block] = true;
        }
        // A prior is what is known beforehand. The loss looks for readings that disagree, and a prior is none.
        const bool robust = options.robust_scale > 0.0 && !group.is_prior;
        problem.AddResidualBlock(new WhitenedCost(group, blocks_),
                                 robust ? new ceres::CauchyLoss(options.robust_scale) : nullptr, pointers);
    }
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        double* const pointer = values.data() + first[b];
        if (!used[b]) {
            continue;
        }
        std::vector<int> held;
        for (std::size_t c = 0; c < block.held.size(); ++c) {
            if (block.held[c]) {
                held.push_back(static_cast<int>(c));
            }
        }
        const bool constant = held.size() == block.held.size();
        if (constant) {
            problem.SetParameterBlockConstant(pointer);
        } else if (!held.empty()) {
            problem.SetManifold(pointer, new ceres::SubsetManifold(static_cast<int>(block.held.size()), held));
        }
        ordering->AddElementToGroup(pointer, block.eliminated ? 0 : 1);
        any_eliminated = any_eliminated || (block.eliminated && !constant);
    }

    // Every tolerance is set: the general solver only brings the parameters into the reach of refine().
    ceres::Solver::Options solver;
    solver.linear_solver_ordering.reset(ordering);
    // The border is dense and small. Eigen, unlike SuiteSparse with a BLAS that is chosen at run time, rounds the same on
    // every machine.
    // Factorisations only: an iterative solver without a preconditioner comes to a stop before the minimum at these
    // condition numbers (design note rotary-table.md, 4f).
    solver.linear_solver_type = any_eliminated ? ceres::DENSE_SCHUR : ceres::SPARSE_NORMAL_CHOLESKY;
    solver.dense_linear_algebra_library_type = ceres::EIGEN;
    solver.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    solver.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
    // A very large region: the first step is that of Gauss and Newton. The region shrinks where a step does not lower
    // the sum.
    solver.initial_trust_region_radius = 1e12;
    solver.max_trust_region_radius = 1e20;
    solver.max_num_iterations = options.max_iterations;
    solver.function_tolerance = 1e-6;
    // Gradients of metres, radians and kelvin have no common scale: no criterion is taken from them.
    solver.gradient_tolerance = 1e-300;
    solver.parameter_tolerance = 1e-14;
    solver.num_threads = 1;  // the same bytes for any machine
    solver.jacobi_scaling = true;
    solver.logging_type = ceres::SILENT;
    solver.minimizer_progress_to_stdout = false;
    ceres::Solver::Summary ceres_summary;
    ceres::Solve(solver, &problem, &ceres_summary);

    SolveSummary summary;
    summary.iterations = static_cast<int>(ceres_summary.iterations.size());
    if (!ceres_summary.IsSolutionUsable()) {
        summary.message = ceres_summary.message;
        return summary;
    }
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first[b]), blocks_[b].value.size(),
                    blocks_[b].value.begin());
    }
    if (options.robust_scale > 0.0) {
        summary.converged = true;
        return summary;
    }
    const SolveSummary refined = refine(options);
    summary.converged = refined.converged;
    summary.iterations += refined.iterations;
    summary.chi_square = refined.chi_square;
    summary.message = refined.message;
    return summary;
}

}  // namespace gumcert::engine
