#include "engine/rotary_table/anglewise_map.h"

#include <utility>

namespace gumcert::engine {

// Whatever grows with the angles is kept as blocks of one angle, and what ties angles to each other has few dimensions:
// the border of the adjustment (stations, dead paths, fixture …) and the ten of the datum (ADR 0032). Only who asks for
// combinations of all quantities gets a matrix of which both sides grow.

namespace {

std::optional<Eigen::Index> reversal_column(const JointAdjustment& adjustment, const NormalEquations& normal) {
    if (!adjustment.has_reversal() || adjustment.reversal_by_angle()) {
        return std::nullopt;
    }
    return normal.column(adjustment.reversal_block(), 0);
}

/// G, m×b: the quantities by the border, the poses following it.
TallMatrix gain_of(const AnglewiseMap& map, const TallMatrix& pose_by_border) {
    // All that ties the angles to each other through the datum are the few numbers of `change`: this keeps costs in
    // proportion to the angles.
    TallMatrix gain = map.by_border;
    gain.noalias() += map.by_change * (map.change * pose_by_border);
    const Eigen::Index q = map.per_angle();
    const Eigen::Index w = map.pose_size();
    for (Eigen::Index i = 0; i < map.angles(); ++i) {
        gain.middleRows(q * i, q).noalias() += map.local.middleRows(q * i, q) * pose_by_border.middleRows(w * i, w);
    }
    return gain;
}

/// The same map for poses with a reversal each, and the means of these behind all other quantities.
AnglewiseMap with_mean_reversal(const AnglewiseMap& map) {
    const Eigen::Index angles = map.angles();
    const Eigen::Index changes = map.change.rows();
    AnglewiseMap result;
    result.local = TallMatrix::Zero(map.local.rows(), 12);
    result.local.leftCols<6>() = map.local;
    result.by_border = TallMatrix::Zero(map.rows() + 6, map.by_border.cols());
    result.by_border.topRows(map.rows()) = map.by_border;
    result.by_change = TallMatrix::Zero(map.rows() + 6, changes + 6);
    result.by_change.topLeftCorner(map.rows(), changes) = map.by_change;
    result.by_change.bottomRightCorner<6, 6>().setIdentity();
    result.change = Eigen::MatrixXd::Zero(changes + 6, 12 * angles);
    for (Eigen::Index i = 0; i < angles; ++i) {
        result.change.block(0, 12 * i, changes, 6) = map.change.middleCols<6>(6 * i);
        // The mean is one more number that all angles share, as the ten of the datum are.
        result.change.block<6, 6>(changes, 12 * i + 6).diagonal().setConstant(1.0 / static_cast<double>(angles));
    }
    return result;
}

}  // namespace

Eigen::MatrixXd AnglewiseMap::combined_by_pose(const Eigen::Ref<const Eigen::MatrixXd>& combination) const {
    // In this order: combinations meet the few columns first.
    Eigen::MatrixXd result = (combination * by_change) * change;
    const Eigen::Index q = per_angle();
    const Eigen::Index w = pose_size();
    for (Eigen::Index i = 0; i < angles(); ++i) {
        result.middleCols(w * i, w).noalias() += combination.middleCols(q * i, q) * local.middleRows(q * i, q);
    }
    return result;
}

Eigen::MatrixXd AnglewiseMap::combined(const Eigen::Ref<const Eigen::MatrixXd>& combination,
                                       const JointAdjustment& adjustment, const NormalEquations& normal) const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(combination.rows(), normal.parameter_count());
    result.leftCols(by_border.cols()).noalias() = combination * by_border;
    const Eigen::MatrixXd by_pose = combined_by_pose(combination);
    const Eigen::Index w = pose_size();
    for (Eigen::Index i = 0; i < angles(); ++i) {
        for (int c = 0; c < w; ++c) {
            const Eigen::Index column = normal.column(adjustment.pose_block(static_cast<std::size_t>(i)), c);
            if (column >= 0) {
                result.col(column) = by_pose.col(w * i + c);
            }
        }
    }
    return result;
}

Eigen::MatrixXd AnglewiseMap::times(const Eigen::Ref<const Eigen::MatrixXd>& by_parameter,
                                    const JointAdjustment& adjustment, const NormalEquations& normal) const {
    Eigen::MatrixXd poses = Eigen::MatrixXd::Zero(change.cols(), by_parameter.cols());
    const Eigen::Index w = pose_size();
    for (Eigen::Index i = 0; i < angles(); ++i) {
        for (int c = 0; c < w; ++c) {
            const Eigen::Index column = normal.column(adjustment.pose_block(static_cast<std::size_t>(i)), c);
            if (column >= 0) {
                poses.row(w * i + c) = by_parameter.row(column);
            }
        }
    }
    Eigen::MatrixXd result = by_border * by_parameter.topRows(by_border.cols());
    result.noalias() += by_change * (change * poses);
    const Eigen::Index q = per_angle();
    for (Eigen::Index i = 0; i < angles(); ++i) {
        result.middleRows(q * i, q).noalias() += local.middleRows(q * i, q) * poses.middleRows(w * i, w);
    }
    return result;
}

AnglewiseMap reported_map(const DatumSolution& datum, Eigen::Index border,
                          std::optional<Eigen::Index> reversal_column) {
    const Eigen::Index errors = datum.motion_map.rows();
    const Eigen::Index rows = errors + 4 + (reversal_column ? 6 : 0);
    AnglewiseMap map;
    map.local = Eigen::MatrixXd::Identity(6, 6).replicate(errors / 6, 1);
    if (datum.zero_angle) {
        // At home in its own datum an error is zero by definition, whatever the pose is.
        map.local.middleRows<6>(6 * *datum.zero_angle).setZero();
    }
    map.by_border = Eigen::MatrixXd::Zero(rows, border);
    if (reversal_column) {
        map.by_border.block<6, 6>(errors + 4, *reversal_column).setIdentity();
    }
    map.by_change = Eigen::MatrixXd::Zero(rows, 10);
    map.by_change.topRows(errors) = datum.motion_map;
    // The change is (six of the world, O, O, S, S): its last four are the set-up, whose reported values move with it.
    map.by_change.block<4, 4>(errors, 6) = datum.set_up_rates;
    map.change = datum.change_map();
    return map;
}

AnglewiseMap reported_map(const JointAdjustment& adjustment, const NormalEquations& normal,
                          const DatumSolution& datum) {
    AnglewiseMap map = reported_map(datum, normal.border_count(), reversal_column(adjustment, normal));
    return adjustment.reversal_by_angle() ? with_mean_reversal(map) : map;
}

AnglewiseMap map_of_both_senses(const AnglewiseMap& reported) {
    const Eigen::Index angles = reported.angles();
    const Eigen::Index rows = 12 * angles;
    AnglewiseMap map;
    map.local.resize(rows, reported.pose_size());
    map.by_border.resize(rows, reported.by_border.cols());
    map.by_change.resize(rows, reported.by_change.cols());
    map.change = reported.change;
    for (Eigen::Index i = 0; i < angles; ++i) {
        for (Eigen::Index sense = 0; sense < 2; ++sense) {
            const Eigen::Index first = 12 * i + 6 * sense;
            map.local.middleRows<6>(first) = reported.local.middleRows<6>(6 * i);
            // A pose is the mean of both senses of approach; each lies half of the reversal beside it.
            map.local.block<6, 6>(first, 6).diagonal().array() += sense == 0 ? 0.5 : -0.5;
            map.by_border.middleRows<6>(first) = reported.by_border.middleRows<6>(6 * i);
            map.by_change.middleRows<6>(first) = reported.by_change.middleRows<6>(6 * i);
        }
    }
    return map;
}

PoseCovariance pose_covariance(const JointAdjustment& adjustment, const NormalEquations& normal,
                               const BorderedCovariance& covariance) {
    const std::size_t angles = adjustment.measurement().angles.size();
    const int w = adjustment.pose_size();
    const Eigen::Index size = w * static_cast<Eigen::Index>(angles);
    PoseCovariance poses{TallMatrix::Zero(size, w), TallMatrix::Zero(size, covariance.border())};
    for (std::size_t i = 0; i < angles; ++i) {
        for (int r = 0; r < w; ++r) {
            const Eigen::Index row = normal.column(adjustment.pose_block(i), r);
            // Held components (home) have no row: they stay 0, do not vary and follow nothing.
            if (row < 0) {
                continue;
            }
            const Eigen::Index at = w * static_cast<Eigen::Index>(i) + r;
            poses.by_border.row(at) = covariance.elimination().row(row - covariance.border());
            const Eigen::Index first = covariance.first_of(row);
            for (int c = 0; c < w; ++c) {
                if (const Eigen::Index column = normal.column(adjustment.pose_block(i), c); column >= 0) {
                    poses.own(at, c) = covariance.own(row)(row - first, column - first);
                }
            }
        }
    }
    return poses;
}

AnglewiseCovariance covariance_of(const AnglewiseMap& map, const PoseCovariance& poses,
                                  const Eigen::MatrixXd& border_root) {
    const Eigen::Index size = map.change.cols();
    const Eigen::Index q = map.per_angle();
    const Eigen::Index changes = map.change.rows();
    Eigen::MatrixXd change_own(changes, size);  // K W
    const Eigen::Index w = map.pose_size();
    for (Eigen::Index i = 0; i < size; i += w) {
        change_own.middleCols(i, w).noalias() = map.change.middleCols(i, w) * poses.own.middleRows(i, w);
    }
    const TallMatrix common = gain_of(map, poses.by_border) * border_root;
    // D (K W Kᵀ) Dᵀ half by half, so that the sum with its transpose is exactly symmetric.
    TallMatrix cross = 0.5 * map.by_change * (change_own * map.change.transpose());  // U
    TallMatrix own(map.local.rows(), q);
    for (Eigen::Index i = 0; i < map.angles(); ++i) {
        const auto local = map.local.middleRows(q * i, q);
        cross.middleRows(q * i, q).noalias() += local * change_own.middleCols(w * i, w).transpose();
        own.middleRows(q * i, q).noalias() = local * poses.own.middleRows(w * i, w) * local.transpose();
    }
    TallMatrix shared(map.rows(), common.cols() + changes);
    TallMatrix half(map.rows(), common.cols() + changes);
    shared << common, map.by_change;
    // R Rᵀ = R (R/2)ᵀ + (R/2) Rᵀ: the part of the border in the same form as that of the datum.
    half << 0.5 * common, cross;
    return {std::move(shared), std::move(half), std::move(own)};
}

AnglewiseCovariance covariance_of(const AnglewiseMap& map, const JointAdjustment& adjustment,
                                  const NormalEquations& normal, const BorderedCovariance& covariance) {
    return covariance_of(map, pose_covariance(adjustment, normal, covariance), covariance.border_root());
}

AnglewiseSensitivity::AnglewiseSensitivity(const AnglewiseMap& map, const JointAdjustment& adjustment,
                                           const NormalEquations& normal, const BorderedCovariance& covariance)
    : map_(map),
      adjustment_(adjustment),
      normal_(normal),
      covariance_(covariance),
      poses_(pose_covariance(adjustment, normal, covariance)),
      shared_(map.rows(), covariance.border() + map.change.rows()) {
    // H = (G, D): all that an observation of one angle does to other angles goes through the border and the datum.
    shared_ << gain_of(map, poses_.by_border), map.by_change;
}

AnglewiseSensitivity::OfVisit AnglewiseSensitivity::of_visit(std::size_t visit) const {
    const LinearisedGroup& group = normal_.groups()[visit];
    OfVisit result;
    result.angle = static_cast<Eigen::Index>(adjustment_.visits()[visit].angle);
    const Eigen::MatrixXd weighted =  // V⁻¹ J, n×columns
        group.cholesky.triangularView<Eigen::Lower>().transpose().solve(group.jacobian);
    const Eigen::Index border = covariance_.border();
    Eigen::MatrixXd by_border = Eigen::MatrixXd::Zero(border, weighted.rows());
    const Eigen::Index w = map_.pose_size();
    Eigen::MatrixXd by_pose = Eigen::MatrixXd::Zero(w, weighted.rows());
    for (std::size_t c = 0; c < group.columns.size(); ++c) {
        const Eigen::Index column = group.columns[c];
        const auto values = weighted.col(static_cast<Eigen::Index>(c)).transpose();
        if (column < border) {
            by_border.row(column) = values;
        } else {
            by_pose.row(normal_.parameters()[static_cast<std::size_t>(column)].component) = values;
        }
    }
    const Eigen::Index first = w * result.angle;
    // ∂b/∂l = C (J_bᵀ + Fᵀ J_eᵀ) V⁻¹ and ∂w/∂l = W J_eᵀ V⁻¹, e = F b + w. A visit has one pose, so that w of one angle
    // alone moves.
    by_border.noalias() += poses_.by_border.middleRows(first, w).transpose() * by_pose;
    const Eigen::MatrixXd pose = poses_.own.middleRows(first, w) * by_pose;
    result.shared.resize(shared_.cols(), weighted.rows());
    result.shared.topRows(border).noalias() = covariance_.border_covariance() * by_border;
    result.shared.bottomRows(map_.change.rows()).noalias() = map_.change.middleCols(first, w) * pose;
    const Eigen::Index q = map_.per_angle();
    result.own.noalias() = map_.local.middleRows(q * result.angle, q) * pose;
    return result;
}

Eigen::MatrixXd AnglewiseSensitivity::of_prior(std::size_t group_index) const {
    const LinearisedGroup& group = normal_.groups()[group_index];
    const Eigen::MatrixXd weighted =
        group.cholesky.triangularView<Eigen::Lower>().transpose().solve(group.jacobian).transpose();
    const Eigen::Index border = covariance_.border();
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(shared_.cols(), weighted.cols());
    // No pose, hence no w: what a prior moves goes through the border alone.
    result.topRows(border).noalias() = covariance_.border_covariance()(Eigen::all, group.columns) * weighted;
    return result;
}

}  // namespace gumcert::engine
