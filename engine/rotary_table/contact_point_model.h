#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

#include "engine/rotary_table/anglewise_map.h"
#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::engine {

/// Displacement of a point of the table, in x, y and z of T at every angle, as a dial indicator on it would see it.
///
/// D(θ) = d + (Rz(e_c) Ry(e_b) Rx(e_a) - I) c for a contact point that stays at c while the table turns under it (a
/// sphere centred near the axis whose own eccentricity has been taken out of the readings). That eccentricity is what
/// the axis average line leaves out of the error motions, so D is formed with that datum whatever the datum of the
/// certificate. Outputs: angle by angle, x, y, z, [m].
class ContactPointModel final : public gum::MeasurementModel {
public:
    ContactPointModel(std::shared_ptr<const gum::MeasurementModel> table, const RotaryTableMeasurement& measurement,
                      const DatumSolution& datum, const Eigen::Vector3d& contact_point);

    [[nodiscard]] const std::vector<gum::InputGroup>& inputs() const override { return table_->inputs(); }
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override;
    /// The outputs for values of the reported quantities.
    [[nodiscard]] Eigen::VectorXd displacements(const Eigen::VectorXd& reported) const;
    /// Map of the displacements from that of the reported quantities; three an angle, no others.
    [[nodiscard]] AnglewiseMap seen_through(const AnglewiseMap& reported) const;

private:
    [[nodiscard]] DatumSolution on_average_line(const Eigen::VectorXd& reported) const;

    std::shared_ptr<const gum::MeasurementModel> table_;
    const RotaryTableMeasurement& measurement_;
    Eigen::Vector3d contact_point_;
    // ∂D/∂(reported error motions) = blocks of the displacement on the diagonal + motion · change.
    Eigen::Matrix<double, 3, 6> displacement_;
    Eigen::MatrixXd motion_map_;  ///< 3N×10
    Eigen::MatrixXd change_map_;  ///< 10×6N
    std::vector<gum::OutputQuantity> outputs_;
};

}  // namespace gumcert::engine
