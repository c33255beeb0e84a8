#pragma once

#include <Eigen/Core>

#include <optional>

#include "engine/adjustment.h"
#include "engine/rotary_table/anglewise_covariance.h"
#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

/// Derivatives of quantities z by the parameters of an adjustment, poses e and border b, in the form in which a datum
/// makes them; q of the quantities belong to each angle, the others stand behind them. A pose has w parameters, 6 or
/// with a reversal of its own 12 (JointAdjustment::pose_size):
///
///   ∂z = L_a ∂e_a + B ∂b + D (K ∂e)
///
/// where a is the angle of the quantity. Everything that only some quantities depend on is zero in the rows of others.
struct AnglewiseMap {
    TallMatrix local;        ///< L, the blocks of all angles one below the other, qN×w
    TallMatrix by_border;    ///< B, m×b
    TallMatrix by_change;    ///< D, m×s
    Eigen::MatrixXd change;  ///< K, s×wN

    [[nodiscard]] Eigen::Index rows() const { return by_change.rows(); }
    /// Quantities of each angle, q.
    [[nodiscard]] Eigen::Index per_angle() const { return local.rows() / angles(); }
    [[nodiscard]] Eigen::Index angles() const { return change.cols() / local.cols(); }
    /// Parameters of a pose, w.
    [[nodiscard]] Eigen::Index pose_size() const { return local.cols(); }
    /// c ∂z/∂(poses) for any combinations c of the quantities, k×wN.
    [[nodiscard]] Eigen::MatrixXd combined_by_pose(const Eigen::Ref<const Eigen::MatrixXd>& combination) const;
    /// c ∂z/∂x for the free parameters x of an adjustment, k×p.
    [[nodiscard]] Eigen::MatrixXd combined(const Eigen::Ref<const Eigen::MatrixXd>& combination,
                                           const JointAdjustment& adjustment, const NormalEquations& normal) const;
    /// (∂z/∂x) X for any X with a row for each free parameter of an adjustment, p×k; m×k.
    [[nodiscard]] Eigen::MatrixXd times(const Eigen::Ref<const Eigen::MatrixXd>& by_parameter,
                                        const JointAdjustment& adjustment, const NormalEquations& normal) const;
};

/// Map of the reported quantities (ReportedQuantities) in a datum.
/// \param border           number of border parameters
/// \param reversal_column  first of the six reversals in the border; none where they are not reported
[[nodiscard]] AnglewiseMap reported_map(const DatumSolution& datum, Eigen::Index border,
                                        std::optional<Eigen::Index> reversal_column);
[[nodiscard]] AnglewiseMap reported_map(const JointAdjustment& adjustment, const NormalEquations& normal,
                                        const DatumSolution& datum);

/// The poses with the positive and with the negative approach, six and six of each angle, of an adjustment with a
/// reversal at every angle: E ± reversal/2 from the map of the reported quantities.
[[nodiscard]] AnglewiseMap map_of_both_senses(const AnglewiseMap& reported);

/// The poses of an adjustment in the form of the normal equations, all wN; held components are zero.
struct PoseCovariance {
    TallMatrix own;        ///< W of every angle, one below the other, wN×w
    TallMatrix by_border;  ///< F, wN×b
};
[[nodiscard]] PoseCovariance pose_covariance(const JointAdjustment& adjustment, const NormalEquations& normal,
                                             const BorderedCovariance& covariance);

/// Covariance of the quantities of a map. With e = F b + w, b with covariance C = R Rᵀ and w with W,
///
///   V = (G R)(G R)ᵀ + L W Lᵀ + U Dᵀ + D Uᵀ,   G = L F + B + D K F,   U = L W Kᵀ + ½ D K W Kᵀ.
///
/// \param border_root  R, b×b
[[nodiscard]] AnglewiseCovariance covariance_of(const AnglewiseMap& map, const PoseCovariance& poses,
                                                const Eigen::MatrixXd& border_root);
[[nodiscard]] AnglewiseCovariance covariance_of(const AnglewiseMap& map, const JointAdjustment& adjustment,
                                                const NormalEquations& normal, const BorderedCovariance& covariance);

/// ∂z/∂l of the quantities of a map by the observations of an adjustment, made when it is asked for:
///
///   ∂z/∂l_v = H T_v + O_v   (O_v only in the rows of the angle of visit v),   H = (G, D)
///
/// so that sums of products over all observations cost the square of the few columns of H each, and no matrix has a
/// row a quantity and a column an observation.
class AnglewiseSensitivity {
public:
    /// Refers to the map, the adjustment and its equations: they must outlive this.
    AnglewiseSensitivity(const AnglewiseMap& map, const JointAdjustment& adjustment, const NormalEquations& normal,
                         const BorderedCovariance& covariance);

    struct OfVisit {
        Eigen::Index angle = 0;
        Eigen::MatrixXd shared;  ///< T, r×n
        Eigen::MatrixXd own;     ///< O, q×n
    };

    [[nodiscard]] const TallMatrix& shared() const { return shared_; }  ///< H, m×r
    [[nodiscard]] OfVisit of_visit(std::size_t visit) const;
    /// T of a group that no pose takes part in (a prior), r×n.
    [[nodiscard]] Eigen::MatrixXd of_prior(std::size_t group) const;

private:
    const AnglewiseMap& map_;
    const JointAdjustment& adjustment_;
    const NormalEquations& normal_;
    const BorderedCovariance& covariance_;
    PoseCovariance poses_;
    TallMatrix shared_;
};

}  // namespace gumcert::engine
