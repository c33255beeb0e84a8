#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

/// Share of the weight of an effect below which nothing else controls it.
constexpr double k_controlled = 1e-9;

/// A symmetric positive semi-definite matrix inverted where it is not zero.
struct Inverted {
    Eigen::MatrixXd inverse;
    int rank = 0;
};
/// \param least  of an eigenvalue. What nothing else controls has no residual of its own: below the limit it is rounding, and
///               its inverse would make a large test value of it.
[[nodiscard]] Inverted pseudo_inverse(const Eigen::MatrixXd& matrix, double least);

/// What effects do to the distances of all visits of an adjustment: V⁻¹v and the blocks of M = V⁻¹ Q_v V⁻¹ of the visits and
/// of the coordinates of the fixture, from which whole visits and other effects on distances can be left out.
///
/// Leaving out a visit g is estimating an error of each of its distances: V⁻¹v ← V⁻¹v - M_g M_gg⁻¹ (V⁻¹v)_g and
/// M ← M - M_g M_gg⁻¹ M_gᵀ, exact for the linearised model at fixed weights; of an effect C likewise, with M C and Cᵀ M C in
/// place of M_g and M_gg. Adjustment, normal equations and covariance must outlive this.
class VisitEffects {
public:
    /// \param normal, covariance  of the adjustment, at the weights of its result
    VisitEffects(const JointAdjustment& adjustment, const NormalEquations& normal,
                 const BorderedCovariance& covariance);

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool is_out(std::size_t g) const { return out_[g]; }
    [[nodiscard]] const Eigen::VectorXd& weighted(std::size_t g) const { return weighted_[g]; }  ///< V⁻¹v, [1/m]
    [[nodiscard]] const Eigen::MatrixXd& own(std::size_t g) const { return own_[g]; }            ///< M_gg, [1/m²]
    /// Eigenvalue of M_gg below which nothing else controls it, relative to the weights of the visit: no unit decides.
    [[nodiscard]] double least(std::size_t g) const { return least_[g]; }
    /// Of the coordinates of the fixture, x, y, z of one point after the other.
    [[nodiscard]] const Eigen::VectorXd& weighted_fixture() const { return weighted_.back(); }
    [[nodiscard]] const Eigen::MatrixXd& own_fixture() const { return own_.back(); }
    [[nodiscard]] const Eigen::MatrixXd& whitening_fixture() const { return whitening_.back(); }  ///< L⁻¹, V = L Lᵀ

    /// Errors of each distance of a visit on its own.
    void leave_out(std::size_t g);

    /// C: one matrix a visit, distances×q; without elements: no effect.
    using Effect = std::vector<Eigen::MatrixXd>;
    /// Values at visits: the same at all distances of each.
    using Column = std::vector<std::pair<std::size_t, double>>;
    [[nodiscard]] Effect effect_of(const std::vector<Column>& columns) const;

    /// C may contain what was taken away before, or what the parameters take up wholly: only the part that is controlled is
    /// taken away.
    void take_away(const std::vector<Column>& columns);
    void take_away(const Effect& effect, Eigen::Index q);

    /// Cᵀ V⁻¹ v and Cᵀ M C of columns.
    struct Projection {
        Eigen::VectorXd weighted;
        Eigen::MatrixXd spread;
        double weight = 0.0;  ///< largest of the diagonal of Cᵀ V⁻¹ C
    };
    [[nodiscard]] Projection projection(const std::vector<Column>& columns) const;
    [[nodiscard]] Projection projection(const Effect& effect, Eigen::Index q) const;
    /// Cᵀ V⁻¹ v of one column.
    [[nodiscard]] double weighted(const Effect& effect) const;
    /// What effects do to the parameters when they are in the distances, parameters×q.
    [[nodiscard]] Eigen::MatrixXd shift_of_parameters(const Effect& effect, Eigen::Index q) const;
    /// What all that was left out after the first `from` takes from Cᵀ M C.
    [[nodiscard]] Eigen::MatrixXd taken_from(const Effect& effect, Eigen::Index q, std::size_t from) const;
    [[nodiscard]] std::size_t left_out_count() const { return left_out_.size(); }

    /// Rows of the distances of a reflector at one visit.
    struct Seen {
        std::size_t visit = 0;
        std::vector<Eigen::Index> rows;
    };
    using Triple = Eigen::Matrix<double, Eigen::Dynamic, 3>;
    /// Cᵀ V⁻¹ v and Cᵀ M C of three columns C that are not zero at the visits that were added only: of all beginnings of a
    /// sequence of visits they cost no more than of the single ones.
    struct Sum {
        Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
        Eigen::Matrix3d weight = Eigen::Matrix3d::Zero();    ///< Cᵀ V⁻¹ C
        Eigen::Matrix3d of_poses = Eigen::Matrix3d::Zero();  ///< what the poses alone take from it
        Triple carried;                                      ///< Z: what border and left out take from it is Zᵀ Z
        std::size_t distances = 0;

        [[nodiscard]] Sum operator-(const Sum& other) const;
        /// Chi-square of the three, with less than rounding added where nothing controls one of them.
        [[nodiscard]] double chi_square() const;
    };
    /// Before sums are made, and again after something was taken away.
    void prepare_sums(const Workers& workers);
    /// A sum that grows. Poses of one angle are shared by its visits: their part does not add up by visits, but by angles.
    class GrowingSum {
    public:
        /// \param visits  with prepared sums
        /// \param angles  of the measurement
        GrowingSum(const VisitEffects& visits, std::size_t angles);
        /// \param columns  C at the visit, distances×3
        void add(const Seen& seen, std::size_t angle, const Triple& columns);
        [[nodiscard]] const Sum& sum() const { return sum_; }

    private:
        const VisitEffects& visits_;
        std::vector<Triple> pulls_;           ///< Jᵀ V⁻¹ C of the pose of an angle
        std::vector<Eigen::Matrix3d> parts_;  ///< of an angle, of what the poses take
        Sum sum_;
    };

private:
    struct LeftOut {
        Effect columns;           ///< M C at every visit, and at the fixture, when it was left out
        Eigen::MatrixXd inverse;  ///< (Cᵀ M C)⁻¹ then

        /// Cᵀ M of what was left out with another effect.
        [[nodiscard]] Eigen::MatrixXd across(const Effect& effect, Eigen::Index q) const;
    };

    /// Jᵀ V⁻¹ C, parameters×q.
    [[nodiscard]] Eigen::MatrixXd pull_of(const Effect& effect, Eigen::Index q) const;
    /// M C at every visit, and at the fixture.
    [[nodiscard]] Effect columns(const Effect& effect, Eigen::Index q) const;

    const BorderedCovariance& covariance_;
    std::size_t size_;
    std::vector<const LinearisedGroup*> groups_;  ///< the visits, and last the fixture
    std::vector<bool> out_;
    std::vector<Eigen::VectorXd> weighted_;
    std::vector<Eigen::MatrixXd> own_;
    std::vector<Eigen::MatrixXd> whitening_;  ///< L⁻¹
    std::vector<double> least_;
    std::vector<LeftOut> left_out_;
    /// What a distance pulls at the border, and at what was left out, A with Z = Aᵀ C: with the root R of the covariance of the
    /// border, and H from the border to all parameters, V⁻¹ J H R. Empty: not asked for yet.
    std::vector<Eigen::MatrixXd> carried_;
    std::size_t carried_left_out_ = 0;  ///< of what was left out, how many are in
};

}  // namespace gumcert::engine
