#include "engine/reported_covariance.h"

#include "engine/rotation.h"

#include <utility>

namespace gumcert::engine {

namespace {

/// W of every angle, 6N×6, from the blocks of the adjustment.
Eigen::MatrixXd own_blocks(const JointAdjustment& adjustment, const NormalEquations& normal,
                           const BorderedCovariance& covariance) {
    const std::size_t angles = adjustment.measurement().angles.size();
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(angles), 6);
    for (std::size_t i = 0; i < angles; ++i) {
        for (int r = 0; r < 6; ++r) {
            const Eigen::Index row = normal.column(adjustment.pose_block(i), r);
            for (int c = 0; c < 6 && row >= 0; ++c) {
                if (const Eigen::Index column = normal.column(adjustment.pose_block(i), c); column >= 0) {
                    const Eigen::Index first = covariance.first_of(row);
                    own(6 * static_cast<Eigen::Index>(i) + r, c) = covariance.own(row)(row - first, column - first);
                }
            }
        }
    }
    return own;
}

/// F, 6N×b.
Eigen::MatrixXd poses_by_border(const JointAdjustment& adjustment, const NormalEquations& normal,
                                const BorderedCovariance& covariance) {
    const std::size_t angles = adjustment.measurement().angles.size();
    Eigen::MatrixXd poses = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(angles), covariance.border());
    for (std::size_t i = 0; i < angles; ++i) {
        for (int c = 0; c < 6; ++c) {
            if (const Eigen::Index column = normal.column(adjustment.pose_block(i), c); column >= 0) {
                poses.row(6 * static_cast<Eigen::Index>(i) + c) =
                    covariance.elimination().row(column - covariance.border());
            }
        }
    }
    return poses;
}

std::optional<Eigen::Index> reversal_column(const JointAdjustment& adjustment, const NormalEquations& normal) {
    if (!adjustment.has_reversal()) {
        return std::nullopt;
    }
    return normal.column(adjustment.reversal_block(), 0);
}

}  // namespace

ReportedCovariance::ReportedCovariance(const Eigen::Ref<const Eigen::MatrixXd>& own, Eigen::MatrixXd pose_by_border,
                                       const Eigen::MatrixXd& border_root, std::optional<Eigen::Index> reversal_column,
                                       const DatumSolution& datum)
    : own_(own) {
    const Eigen::Index size = pose_by_border.rows();
    const Eigen::Index border = pose_by_border.cols();
    const Eigen::Index rows = size + 4 + (reversal_column ? 6 : 0);
    const Eigen::MatrixXd change = datum.change_map();  // K
    Eigen::MatrixXd change_own(10, size);               // K W
    for (Eigen::Index i = 0; i < size; i += 6) {
        change_own.middleCols<6>(i).noalias() = change.middleCols<6>(i) * own.middleRows<6>(i);
    }
    const Eigen::MatrixXd change_covariance = change_own * change.transpose();  // K W Kᵀ
    const Eigen::MatrixXd change_by_border = change * pose_by_border;           // K F
    if (datum.zero_angle) {
        const Eigen::Index zero = 6 * *datum.zero_angle;
        own_.middleRows<6>(zero).setZero();
        change_own.middleCols<6>(zero).setZero();
        pose_by_border.middleRows<6>(zero).setZero();
    }
    motion_ = Eigen::MatrixXd::Zero(rows, 10);
    motion_.topRows(size) = datum.motion_map;
    motion_.block<4, 4>(size, 6).setIdentity();
    Eigen::MatrixXd gain = Eigen::MatrixXd::Zero(rows, border);  // G
    gain.topRows(size) = pose_by_border;
    gain.noalias() += motion_ * change_by_border;
    if (reversal_column) {
        gain.block<6, 6>(size + 4, *reversal_column).setIdentity();
    }
    common_.noalias() = gain * border_root;
    half_ = Eigen::MatrixXd::Zero(rows, 10);
    half_.topRows(size) = change_own.transpose();
    half_.noalias() += 0.5 * motion_ * change_covariance;
}

ReportedCovariance::ReportedCovariance(const JointAdjustment& adjustment, const NormalEquations& normal,
                                       const BorderedCovariance& covariance, const DatumSolution& datum)
    : ReportedCovariance(own_blocks(adjustment, normal, covariance), poses_by_border(adjustment, normal, covariance),
                         covariance.border_root(), engine::reversal_column(adjustment, normal), datum) {}

double ReportedCovariance::operator()(Eigen::Index row, Eigen::Index column) const {
    double value = common_.row(row).dot(common_.row(column)) + half_.row(row).dot(motion_.row(column)) +
                   motion_.row(row).dot(half_.row(column));
    if (row < own_.rows() && row / 6 == column / 6) {
        value += own_(row, column % 6);
    }
    return value;
}

Eigen::VectorXd ReportedCovariance::diagonal() const {
    Eigen::VectorXd result = common_.rowwise().squaredNorm() + 2.0 * half_.cwiseProduct(motion_).rowwise().sum();
    for (Eigen::Index i = 0; i < own_.rows(); ++i) {
        result[i] += own_(i, i % 6);
    }
    return result;
}

ReportedCovariance::Matrix6 ReportedCovariance::of_angle(Eigen::Index angle) const {
    const auto common = common_.middleRows<6>(6 * angle);
    const Matrix6 cross = half_.middleRows<6>(6 * angle) * motion_.middleRows<6>(6 * angle).transpose();
    return common * common.transpose() + cross + cross.transpose() + own_.middleRows<6>(6 * angle);
}

Eigen::MatrixXd ReportedCovariance::dense() const {
    const Eigen::Index border = common_.cols();
    Eigen::MatrixXd left(rows(), border + 20);
    Eigen::MatrixXd right(rows(), border + 20);
    left << common_, half_, motion_;
    right << common_, motion_, half_;
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows(), rows());
    result.triangularView<Eigen::Lower>() += left * right.transpose();
    for (Eigen::Index i = 0; i < own_.rows(); i += 6) {
        result.block<6, 6>(i, i) += own_.middleRows<6>(i);
    }
    result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
    return result;
}

Eigen::Matrix3d station_covariance(const JointAdjustment& adjustment, const NormalEquations& normal,
                                   const BorderedCovariance& covariance, const DatumSolution& datum,
                                   std::size_t station) {
    const auto block = adjustment.station_block(station);
    const Eigen::Vector3d position = adjustment.adjustment().parameters(block).head<3>();
    const Eigen::MatrixXd by_pose = point_displacement(position) * datum.world_map;
    Eigen::MatrixXd by_parameter = Eigen::MatrixXd::Zero(3, normal.parameter_count());
    for (int c = 0; c < 3; ++c) {
        by_parameter.col(normal.column(block, c)) += Eigen::Vector3d::Unit(c);
    }
    for (Eigen::Index i = 0; i < by_pose.cols() / 6; ++i) {
        for (int c = 0; c < 6; ++c) {
            const Eigen::Index column = normal.column(adjustment.pose_block(static_cast<std::size_t>(i)), c);
            if (column >= 0) {
                by_parameter.col(column) += by_pose.col(6 * i + c);
            }
        }
    }
    return covariance.times_left(by_parameter) * by_parameter.transpose();
}

}  // namespace gumcert::engine
