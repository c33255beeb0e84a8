#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>

#include "engine/adjustment.h"
#include "engine/datum.h"
#include "engine/joint_adjustment.h"

namespace gumcert::engine {

/// Covariance of the reported quantities in the form in which the normal equations give it; its size, and the cost of
/// the variances, are proportional to the angles.
///
/// With the poses e = F b + w of an adjustment (border b with covariance C = R Rᵀ; w independent from angle to angle,
/// with covariance W) and the S-transformation I + D K of the datum, the reported quantities are
///
///   y = (E + D K) e + B b,   G = (E + D K) F + B,
///   V = (G R)(G R)ᵀ + E W Eᵀ + U Dᵀ + D Uᵀ,   U = E W Kᵀ + ½ D K W Kᵀ
///
/// where E puts the poses into the error motions, B takes the reversals from the border, and the rows of D beyond the
/// error motions take the set-up from the changes K e.
class ReportedCovariance {
public:
    using Matrix6 = Eigen::Matrix<double, 6, 6>;

    /// Of no quantities.
    ReportedCovariance() = default;

    /// \param own              W of every angle, 6N×6, one below the other; zero where the pose is held
    /// \param pose_by_border   F, 6N×b
    /// \param border_root      R, b×b
    /// \param reversal_column  first of the six reversals in the border; none where they are not reported
    ReportedCovariance(const Eigen::Ref<const Eigen::MatrixXd>& own, Eigen::MatrixXd pose_by_border,
                       const Eigen::MatrixXd& border_root, std::optional<Eigen::Index> reversal_column,
                       const DatumSolution& datum);
    /// Of an adjustment at its solution.
    ReportedCovariance(const JointAdjustment& adjustment, const NormalEquations& normal,
                       const BorderedCovariance& covariance, const DatumSolution& datum);

    [[nodiscard]] Eigen::Index rows() const { return common_.rows(); }
    /// Of two quantities by their index in ReportedQuantities.
    [[nodiscard]] double operator()(Eigen::Index row, Eigen::Index column) const;
    /// Variances of all quantities, [m²] and [rad²].
    [[nodiscard]] Eigen::VectorXd diagonal() const;
    /// Covariance of the six error motions of one angle.
    [[nodiscard]] Matrix6 of_angle(Eigen::Index angle) const;
    /// All elements; proportional to their number.
    [[nodiscard]] Eigen::MatrixXd dense() const;

private:
    Eigen::MatrixXd common_;  ///< G R, m×b
    Eigen::MatrixXd motion_;  ///< D, m×10
    Eigen::MatrixXd half_;    ///< U, m×10
    Eigen::MatrixXd own_;     ///< W in the datum, 6N×6
};

/// Covariance of the position of a station in the frame of the datum, [m²]: the position of the solver, moved by the
/// motion of the world that the datum makes of the poses.
[[nodiscard]] Eigen::Matrix3d station_covariance(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                 const BorderedCovariance& covariance, const DatumSolution& datum,
                                                 std::size_t station);

}  // namespace gumcert::engine
