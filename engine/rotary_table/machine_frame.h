#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/rotation.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::engine {

/// What the reference frame of the machine is known by: the same points in it and in a frame of the measurement.
enum class MachineFramePoints {
    reflectors,  ///< probed by the machine axes while the table is at its home angle
    stations     ///< of the tracer, located by the machine axes
};

/// The reference frame of a machine, as a job states it.
struct MachineFrame {
    MachineFramePoints by = MachineFramePoints::reflectors;
    std::vector<std::size_t> points;  ///< reflectors or stations of the measurement, at least 3
    Eigen::MatrixXd coordinates;      ///< n×3, in the frame of the machine, [m]
    Eigen::VectorXd u;                ///< n, standard uncertainty of each coordinate, independent, [m]
    /// Where the axis should be: a point on it, and the place along the axis where its position is stated, [m].
    Eigen::Vector3d nominal_point = Eigen::Vector3d::Zero();
    std::string source;  ///< how the coordinates were found, free text
};

/// The rigid motion that carries points of the measurement to the machine, by weighted least squares.
struct MachineFrameFit {
    RigidMotion motion;                      ///< machine from the frame of the points
    Eigen::Vector3d centre;                  ///< of the points, in the frame of the machine, [m]
    Eigen::Matrix<double, 6, 6> covariance;  ///< of a shift and a turn about the centre, [m²], [m·rad], [rad²]
    Eigen::MatrixXd residuals;               ///< n×3, machine - carried, [m]
    double chi_square = 0.0;                 ///< rᵀ Σ⁻¹ r
    double degrees_of_freedom = 0.0;         ///< 3n - 6
};

/// \param points      n×3, the points in the frame of the measurement, in the order of `frame.points`, [m]
/// \param covariance  of them, 3n×3n in the order x1 y1 z1 x2 …, [m²]; the coordinates in the machine are independent
/// of
///                    it
/// \throws gum::InputError  GC-FRAME-0001 where the points leave a rotation undetermined (fewer than three, or on a
/// line)
[[nodiscard]] MachineFrameFit fit_machine_frame(const Eigen::MatrixXd& points, const Eigen::MatrixXd& covariance,
                                                const MachineFrame& frame);

/// Location errors of the axis of rotation in the reference frame of the machine (ISO 230-7): EY0A EZ0A EB0A EC0A of A,
/// EX0B EZ0B EA0B EC0B of B, EX0C EY0C EA0C EB0C of C. A position is where the axis pierces the plane across the axis
/// through the nominal point, less that point; an angle is the right-handed tilt of the axis about a coordinate axis of
/// the machine.
///
/// Inputs, uncorrelated, with estimate 0 and standard uncertainty 1, of which roots of the covariances make positions
/// and angles: ten "pose of the fixture at home" where the points are reflectors, and six "machine frame", for a shift
/// and a turn about the centre of the points. The axis is that of the table frame, which the datum of the axis average
/// line makes the axis average line; reflectors stand in that frame by P = E(home) T_s p.
class LocationErrorModel final : public gum::MeasurementModel {
public:
    using Vector10 = Eigen::Matrix<double, 10, 1>;

    /// \param home                the six error motions at the home angle, and (O, O, S, S) across the axis in the
    /// order
    ///                            of `across_axis`, in the datum of the axis average line, [m] and [rad]
    /// \param home_covariance     10×10
    /// \param degrees_of_freedom  of these
    LocationErrorModel(RotaryAxis axis, const MachineFrame& frame, const MachineFrameFit& fit, const Vector10& home,
                       const Eigen::Matrix<double, 10, 10>& home_covariance, double degrees_of_freedom);
    /// Of points that are stations.
    LocationErrorModel(RotaryAxis axis, const MachineFrame& frame, const MachineFrameFit& fit);

    [[nodiscard]] const std::vector<gum::InputGroup>& inputs() const override { return inputs_; }
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    /// By central differences over one standard uncertainty: the model bends by less than 1e-9 of it.
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override;

    /// Angle between the axis and the coordinate axis of the machine that has its letter, [rad].
    [[nodiscard]] double angle_to_machine_axis() const;

private:
    struct Line {
        Eigen::Vector3d point, direction;
    };

    void add_frame();
    [[nodiscard]] Line line_in_machine(const Eigen::Ref<const Eigen::VectorXd>& x) const;

    RotaryAxis axis_;
    Eigen::Vector3d nominal_point_;
    MachineFrameFit fit_;
    Vector10 home_ = Vector10::Zero();
    Eigen::Matrix<double, 10, 10> home_root_ = Eigen::Matrix<double, 10, 10>::Zero();
    Eigen::Matrix<double, 6, 6> motion_root_;
    std::vector<gum::InputGroup> inputs_;
    std::vector<gum::OutputQuantity> outputs_;
};

/// "EX0C", "EY0C", "EA0C", "EB0C"
[[nodiscard]] std::array<std::string, 4> location_error_names(RotaryAxis axis);

}  // namespace gumcert::engine
