#include "engine/rotary_table/station_covariance.h"

#include <algorithm>

#include "engine/rotary_table/rotation.h"
#include "gum/quantity/dense_factors.h"

namespace gumcert::engine {

namespace {

/// ∂(position of a station in the frame of the datum)/∂(parameters of the solver), 3×p.
Eigen::MatrixXd position_by_parameter(const JointAdjustment& adjustment, const NormalEquations& normal,
                                      const DatumSolution& datum, std::size_t station) {
    const auto block = adjustment.station_block(station);
    const Eigen::Vector3d position = adjustment.adjustment().parameters(block).head<3>();
    // The datum moves the world, and a station with it: its position depends on all poses.
    const Eigen::MatrixXd by_pose = point_displacement(position) * datum.frame_map(adjustment.measurement().axis);
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
    return by_parameter;
}

}  // namespace

Eigen::MatrixXd covariance_of_stations(const JointAdjustment& adjustment, const NormalEquations& normal,
                                       const BorderedCovariance& covariance, const DatumSolution& datum) {
    const std::size_t stations = adjustment.measurement().stations.size();
    Eigen::MatrixXd by_parameter(3 * static_cast<Eigen::Index>(stations), normal.parameter_count());
    for (std::size_t j = 0; j < stations; ++j) {
        by_parameter.middleRows<3>(3 * static_cast<Eigen::Index>(j)) =
            position_by_parameter(adjustment, normal, datum, j);
    }
    return covariance.times_left(by_parameter) * by_parameter.transpose();
}

double largest_share_of_station(const JointAdjustment& adjustment, const NormalEquations& normal,
                                const BorderedCovariance& covariance, const DatumSolution& datum,
                                const AnglewiseMap& map, const Eigen::VectorXd& variances, std::size_t station) {
    const Eigen::MatrixXd by_parameter = position_by_parameter(adjustment, normal, datum, station);
    const Eigen::MatrixXd spread = covariance.times_left(by_parameter);  // 3×p
    // The eigenvector of the largest eigenvalue is the line along which the station is known least.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(Eigen::Matrix3d(spread * by_parameter.transpose()));
    const Eigen::VectorXd cross =
        map.times(spread.transpose() * eigen.eigenvectors().col(2), adjustment, normal);  // of each quantity with it
    double largest = 0.0;
    for (Eigen::Index i = 0; i < cross.size(); ++i) {
        // An error motion at home in its own datum is zero by definition: it has no variance of which a share could be
        // taken.
        if (variances[i] > 0.0) {
            // cov²/(var var): the part of the variance that would go if this coordinate were known.
            largest = std::max(largest, cross[i] * cross[i] / (variances[i] * eigen.eigenvalues()[2]));
        }
    }
    return largest;
}

Eigen::Matrix3d station_covariance(const JointAdjustment& adjustment, const NormalEquations& normal,
                                   const BorderedCovariance& covariance, const DatumSolution& datum,
                                   std::size_t station) {
    const Eigen::MatrixXd by_parameter = position_by_parameter(adjustment, normal, datum, station);
    return covariance.times_left(by_parameter) * by_parameter.transpose();
}

}  // namespace gumcert::engine
