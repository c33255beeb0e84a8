#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/adjustment.h"

namespace gumcert::engine {

/// Covariance of quantities of which q belong to each angle, angle by angle, and the others stand behind them, in a
/// form whose size is proportional to the angles:
///
///   V = H Lᵀ + L Hᵀ + O
///
/// with H and L of a few columns and O zero but for a block q×q of every angle.
class AnglewiseCovariance {
public:
    /// Of no quantities.
    AnglewiseCovariance() = default;
    /// \param shared  H, m×r
    /// \param half    L, m×r
    /// \param own     the blocks of O one below the other, qN×q
    AnglewiseCovariance(TallMatrix shared, TallMatrix half, TallMatrix own);
    /// Of any covariance; its size and costs are then those of the matrix.
    explicit AnglewiseCovariance(const Eigen::Ref<const Eigen::MatrixXd>& dense);

    [[nodiscard]] Eigen::Index rows() const { return shared_.rows(); }
    /// Of two quantities.
    [[nodiscard]] double operator()(Eigen::Index row, Eigen::Index column) const;
    /// Of some quantities with each other, n×n.
    [[nodiscard]] Eigen::MatrixXd of(const std::vector<Eigen::Index>& quantities) const;
    /// Variances of all quantities.
    [[nodiscard]] Eigen::VectorXd diagonal() const;
    /// Covariance of the quantities of one angle, q×q.
    [[nodiscard]] Eigen::MatrixXd of_angle(Eigen::Index angle) const;
    /// All elements of one row, m.
    [[nodiscard]] Eigen::RowVectorXd row(Eigen::Index row) const;
    /// Covariance of combinations C of the quantities, k×m: C V Cᵀ, k×k.
    [[nodiscard]] Eigen::MatrixXd of_combinations(const Eigen::Ref<const Eigen::MatrixXd>& combinations) const;
    /// All elements; proportional to their number.
    [[nodiscard]] Eigen::MatrixXd dense() const;

    [[nodiscard]] const TallMatrix& shared() const { return shared_; }  ///< H
    [[nodiscard]] const TallMatrix& half() const { return half_; }      ///< L
    [[nodiscard]] const TallMatrix& own() const { return own_; }        ///< the blocks of O

private:
    TallMatrix shared_, half_, own_;
};

}  // namespace gumcert::engine
