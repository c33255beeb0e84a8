#include "engine/rotary_table/anglewise_covariance.h"

#include <utility>

namespace gumcert::engine {

AnglewiseCovariance::AnglewiseCovariance(TallMatrix shared, TallMatrix half, TallMatrix own)
    : shared_(std::move(shared)), half_(std::move(half)), own_(std::move(own)) {}

// V = 1 (V/2)ᵀ + (V/2) 1ᵀ: a dense covariance in the same form, so that whoever asks need not know which it is.
AnglewiseCovariance::AnglewiseCovariance(const Eigen::Ref<const Eigen::MatrixXd>& dense)
    : shared_(TallMatrix::Identity(dense.rows(), dense.rows())), half_(0.5 * dense), own_(0, 1) {}

// From H, L and O at each call: kept as a matrix, the covariance of a thousand angles would have 36 million elements.
double AnglewiseCovariance::operator()(Eigen::Index row, Eigen::Index column) const {
    double value = shared_.row(row).dot(half_.row(column)) + half_.row(row).dot(shared_.row(column));
    // Own parts of two angles are independent of each other; set-up and reversal, behind the angles, have none.
    if (row < own_.rows() && row / own_.cols() == column / own_.cols()) {
        value += own_(row, column % own_.cols());
    }
    return value;
}

Eigen::MatrixXd AnglewiseCovariance::of(const std::vector<Eigen::Index>& quantities) const {
    const auto n = static_cast<Eigen::Index>(quantities.size());
    Eigen::MatrixXd result(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        result.row(i) = row(quantities[static_cast<std::size_t>(i)])(quantities);
    }
    return result;
}

Eigen::VectorXd AnglewiseCovariance::diagonal() const {
    Eigen::VectorXd result = 2.0 * half_.cwiseProduct(shared_).rowwise().sum();
    for (Eigen::Index i = 0; i < own_.rows(); ++i) {
        result[i] += own_(i, i % own_.cols());
    }
    return result;
}

Eigen::MatrixXd AnglewiseCovariance::of_angle(Eigen::Index angle) const {
    const Eigen::Index size = own_.cols();
    const Eigen::MatrixXd cross =
        half_.middleRows(size * angle, size) * shared_.middleRows(size * angle, size).transpose();
    return cross + cross.transpose() + own_.middleRows(size * angle, size);
}

Eigen::RowVectorXd AnglewiseCovariance::row(Eigen::Index row) const {
    Eigen::RowVectorXd result = shared_.row(row) * half_.transpose();
    result.noalias() += half_.row(row) * shared_.transpose();
    if (row < own_.rows()) {
        result.segment(row - row % own_.cols(), own_.cols()) += own_.row(row);
    }
    return result;
}

Eigen::MatrixXd AnglewiseCovariance::of_combinations(const Eigen::Ref<const Eigen::MatrixXd>& combinations) const {
    const Eigen::MatrixXd cross = (combinations * half_) * (combinations * shared_).transpose();
    // Combinations go through the few columns first: k×m by m×r, and never m×m.
    Eigen::MatrixXd result = cross + cross.transpose();
    const Eigen::Index size = own_.cols();
    for (Eigen::Index i = 0; i < own_.rows(); i += size) {
        const auto of_angle = combinations.middleCols(i, size);
        result.noalias() += of_angle * own_.middleRows(i, size) * of_angle.transpose();
    }
    return result;
}

Eigen::MatrixXd AnglewiseCovariance::dense() const {
    TallMatrix left(rows(), 2 * shared_.cols());
    TallMatrix right(rows(), 2 * shared_.cols());
    left << half_, shared_;
    right << shared_, half_;
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows(), rows());
    // The lower triangle is computed and mirrored: symmetric to the last bit, at half the cost.
    result.triangularView<Eigen::Lower>() += left * right.transpose();
    for (Eigen::Index i = 0; i < own_.rows(); i += own_.cols()) {
        result.block(i, i, own_.cols(), own_.cols()) += own_.middleRows(i, own_.cols());
    }
    result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
    return result;
}

}  // namespace gumcert::engine
