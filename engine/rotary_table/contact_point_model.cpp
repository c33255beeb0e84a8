#include "engine/rotary_table/contact_point_model.h"

namespace gumcert::engine {

ContactPointModel::ContactPointModel(std::shared_ptr<const gum::MeasurementModel> table,
                                     const RotaryTableMeasurement& measurement, const DatumSolution& datum,
                                     const Eigen::Vector3d& contact_point)
    : table_(std::move(table)), measurement_(measurement), contact_point_(contact_point) {
    const Eigen::Index angles = datum.errors.cols();
    // Whatever the datum of the result: readings of a dial indicator have lost the eccentricity of the sphere, which is
    // what the axis average line leaves out (ADR 0009).
    const DatumSolution average =
        transform_to_datum(measurement, datum.errors, rigid_motion(datum.set_up), Datum::axis_average_line);
    displacement_ = point_displacement(contact_point_);
    change_map_ = average.change_map();
    motion_map_.resize(3 * angles, 10);
    for (Eigen::Index i = 0; i < angles; ++i) {
        motion_map_.middleRows<3>(3 * i).noalias() = displacement_ * average.motion_map.middleRows<6>(6 * i);
        for (int k = 0; k < 3; ++k) {
            outputs_.push_back(
                {std::string("displacement ") + "xyz"[k] + " at angle number " + std::to_string(i + 1), "m"});
        }
    }
}

DatumSolution ContactPointModel::on_average_line(const Eigen::VectorXd& reported) const {
    const auto angles = static_cast<Eigen::Index>(measurement_.angles.size());
    const auto across = across_axis(measurement_.axis);
    Eigen::Matrix<double, 6, 1> set_up = Eigen::Matrix<double, 6, 1>::Zero();
    for (int c = 0; c < 2; ++c) {
        set_up[across[static_cast<std::size_t>(c)]] = reported[6 * angles + c];
        set_up[3 + across[static_cast<std::size_t>(c)]] = reported[6 * angles + 2 + c];
    }
    return transform_to_datum(measurement_, reported.head(6 * angles).reshaped(6, angles), rigid_motion(set_up),
                              Datum::axis_average_line);
}

Eigen::VectorXd ContactPointModel::evaluate(const Eigen::VectorXd& x) const {
    return displacements(table_->evaluate(x));
}

Eigen::VectorXd ContactPointModel::displacements(const Eigen::VectorXd& reported) const {
    const DatumSolution average = on_average_line(reported);
    Eigen::VectorXd displacement(3 * average.errors.cols());
    for (Eigen::Index i = 0; i < average.errors.cols(); ++i) {
        displacement.segment<3>(3 * i) = rigid_motion(average.errors.col(i)) * contact_point_ - contact_point_;
    }
    return displacement;
}

Eigen::MatrixXd ContactPointModel::jacobian(const Eigen::VectorXd& x) const {
    const Eigen::Index size = change_map_.cols();
    const Eigen::MatrixXd table = table_->jacobian(x);
    // The datum follows the error motions, to first order by ten numbers.
    const Eigen::MatrixXd change = change_map_ * table.topRows(size);
    Eigen::MatrixXd result(motion_map_.rows(), table.cols());
    result.noalias() = motion_map_ * change;
    for (Eigen::Index i = 0; i < size / 6; ++i) {
        result.middleRows<3>(3 * i).noalias() += displacement_ * table.middleRows<6>(6 * i);
    }
    return result;
}

AnglewiseMap ContactPointModel::seen_through(const AnglewiseMap& reported) const {
    const Eigen::Index angles = change_map_.cols() / 6;
    const Eigen::Index changes = reported.change.rows();
    const auto errors = Eigen::seqN(0, 6 * angles);
    AnglewiseMap map;
    const Eigen::Index w = reported.pose_size();
    map.local.resize(3 * angles, w);
    map.by_border.noalias() = motion_map_ * (change_map_ * reported.by_border(errors, Eigen::all));
    map.by_change.resize(3 * angles, changes + change_map_.rows());
    map.by_change.leftCols(changes).noalias() = motion_map_ * (change_map_ * reported.by_change(errors, Eigen::all));
    map.by_change.rightCols(change_map_.rows()) = motion_map_;
    map.change.resize(changes + change_map_.rows(), w * angles);
    map.change.topRows(changes) = reported.change;
    for (Eigen::Index i = 0; i < angles; ++i) {
        const auto local = reported.local.middleRows<6>(6 * i);
        map.local.middleRows<3>(3 * i).noalias() = displacement_ * local;
        map.by_border.middleRows<3>(3 * i).noalias() += displacement_ * reported.by_border.middleRows<6>(6 * i);
        map.by_change.block(3 * i, 0, 3, changes).noalias() += displacement_ * reported.by_change.middleRows<6>(6 * i);
        map.change.block(changes, w * i, change_map_.rows(), w).noalias() = change_map_.middleCols<6>(6 * i) * local;
    }
    return map;
}

}  // namespace gumcert::engine
