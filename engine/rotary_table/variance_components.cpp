#include "engine/rotary_table/variance_components.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/fixed_parts.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

// Where the iteration starts when the job gives no idea: a good commercial table.
constexpr double k_start_linear = 0.2 * gum::k_micrometre;
constexpr double k_start_angular = 0.3 * gum::k_arcsecond;

constexpr std::size_t k_visit_components = 4;  // whose derivatives live in the visits; the fixture has its own group
constexpr std::size_t k_components = 5;
// Scale of each component, so that the four columns of the Fisher matrix are comparable: (0.1 µm)² and (0.1″)².
constexpr double k_linear_scale = 1e-14;
constexpr double k_angular_scale = 2.350443e-13;
// An estimated variance of the table that is less than this many of its standard uncertainties is not taken at its word:
// above, what is plausible differs from it by less than 4e-5 of it.
constexpr double k_determined = 4.0;
// No table, but what an estimate comes to that the distances do not determine at all.
constexpr double k_most_linear = 1e-4;   // [m]
constexpr double k_most_angular = 1e-3;  // [rad]
// A factor below these would leave nothing to weight by.
constexpr double k_least_length_factor = 1e-6;
constexpr double k_least_fixture_factor = 1e-4;

using Vector4 = Eigen::Matrix<double, 4, 1>;
using Matrix4 = Eigen::Matrix<double, 4, 4>;
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// What is plausible of a variance θ ≥ 0.
struct PlausibleVariance {
    double mean, spread;  ///< expectation, and the standard deviation about it
};

/// An estimate θ̂ ≥ 0 with the standard uncertainty u leaves of θ a normal distribution that is cut off at zero: with
/// x = θ̂/u and λ = φ(x)/Φ(x) it has the mean u (x + λ) and the variance u² (1 − λ (x + λ)). For an estimate of 0 that is
/// 0.80 u, with ν = 2 mean²/variance = 3.5, the fewest that there are (ADR 0071).
PlausibleVariance plausible_variance(double estimate, double u) {
    const double x = estimate / u;
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
    const double ratio = density / (0.5 * std::erfc(-x / std::numbers::sqrt2));
    const double mean = x + ratio;
    return {u * mean, u * std::sqrt(1.0 - ratio * mean)};
}

/// L⁻¹ B_k of the roots of the derivatives V_k = B_k B_kᵀ of the covariance L Lᵀ of a visit, in the scales of the
/// components, side by side: n×(n + 6).
void whitened_roots(const JointAdjustment& adjustment, const NormalEquations& normal, std::size_t visit,
                    Eigen::MatrixXd& roots) {
    const LinearisedGroup& group = normal.groups()[visit];
    const std::size_t block = adjustment.pose_block(adjustment.visits()[visit].angle);
    const Eigen::Index n = group.residual.size();
    const int axial = 3 + axial_coordinate(adjustment.measurement().axis);
    const auto lower = group.cholesky.triangularView<Eigen::Lower>();
    roots.resize(n, n + 6);
    // One factor for the stated noise of a length. Its constant and its proportional part are not told apart by the
    // residuals: their estimates have a correlation of 0.9 (design note rotary-table.md, D4).
    roots.leftCols(n) = adjustment.stated_variance(visit).cwiseSqrt().asDiagonal();
    lower.solveInPlace(roots.leftCols(n));
    std::array<Eigen::Index, 6> to{n, n + 1, n + 2, 0, 0, 0};
    for (std::size_t c = 3, tilt = 4; c < 6; ++c) {
        to[c] = n + static_cast<Eigen::Index>(static_cast<int>(c) == axial ? 3 : tilt++);
    }
    // The derivatives by the pose are in the equations already, but where it is held (at home).
    const Eigen::Index column = normal.column(block, 0);
    Eigen::MatrixXd pose;
    if (column >= 0) {
        const auto at = std::ranges::find(group.columns, column) - group.columns.begin();
        pose.noalias() = group.jacobian.middleCols<6>(at) * adjustment.pose_of_deviation();
    } else {
        pose = adjustment.repeatability_jacobian(visit);
        lower.solveInPlace(pose);
    }
    for (std::size_t c = 0; c < 6; ++c) {
        roots.col(to[c]) = pose.col(static_cast<Eigen::Index>(c));
    }
    roots.middleCols<3>(n) *= std::sqrt(k_linear_scale);
    roots.rightCols<3>() *= std::sqrt(k_angular_scale);
}

/// First column of each component in `whitened_roots`, and the end.
std::array<Eigen::Index, k_visit_components + 1> root_columns(Eigen::Index n) {
    return {0, n, n + 3, n + 4, n + 6};
}

/// A symmetric A in the form of the normal equations, with a border and a block for every eliminated pose, and what the
/// traces of its products with the covariance H C Hᵀ + W of the parameters are made of (BorderedCovariance; H = (I,
/// F)).
///
/// tr(Q A Q A') = tr(C S C S') + 2 tr(C T'ᵀ W T) + tr(W A W A') with S = Hᵀ A H, and T = A H of the poses: proportional
/// to the parameters, where the product Q A would have p² elements. The last two terms are sums over the poses.
class BorderedForm {
public:
    explicit BorderedForm(Eigen::Index border) : reduced_(Eigen::MatrixXd::Zero(border, border)) {}

    /// Of the poses that follow.
    void begin(Eigen::Index poses, Eigen::Index size) {
        cross_.setZero(poses, reduced_.cols());
        own_.setZero(poses, size);
    }

    /// \param local  part of A over the parameters `columns`, of which those of poses are in one pose
    /// \param first  parameter of row 0
    void add(const std::vector<Eigen::Index>& columns, Eigen::Index pose, Eigen::Index first,
             const Eigen::MatrixXd& local) {
        const Eigen::Index b = reduced_.cols();
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double* values = local.col(static_cast<Eigen::Index>(i)).data();  // of a row as well: A is symmetric
            if (columns[i] < b) {
                double* to = reduced_.col(columns[i]).data();
                for (std::size_t j = 0; j < columns.size(); ++j) {
                    if (columns[j] < b) {
                        to[columns[j]] += values[j];
                    }
                }
                continue;
            }
            double* across = cross_.row(columns[i] - first).data();
            double* own = own_.row(columns[i] - first).data();
            for (std::size_t j = 0; j < columns.size(); ++j) {
                if (columns[j] < b) {
                    across[columns[j]] += values[j];
                } else {
                    own[columns[j] - pose] += values[j];
                }
            }
        }
    }

    /// Once everything of the poses is added.
    void complete(const BorderedCovariance& covariance, Eigen::Index first) {
        const Eigen::Index b = covariance.border();
        const auto elimination = covariance.elimination().middleRows(first - b, cross_.rows());
        // S = A_bb + Fᵀ(A_ee F + A_eb) + A_be F
        reduced_.noalias() += cross_.transpose() * elimination;
        weighted_.resize(cross_.rows(), b);
        weighted_own_.resize(own_.rows(), own_.cols());
        sizes_.clear();
        for (Eigen::Index i = 0; i < own_.rows();) {
            const Eigen::MatrixXd& spread = covariance.own(first + i);  // W
            const Eigen::Index size = spread.rows();
            cross_.middleRows(i, size).noalias() += own_.block(i, 0, size, size) * elimination.middleRows(i, size);
            weighted_.middleRows(i, size).noalias() = spread * cross_.middleRows(i, size);
            weighted_own_.block(i, 0, size, size).noalias() = spread * own_.block(i, 0, size, size);
            sizes_.push_back(size);
            i += size;
        }
        reduced_.noalias() += elimination.transpose() * cross_;
        spread_.noalias() = cross_ * covariance.border_covariance();  // T C
    }

    /// 2 tr(C T'ᵀ W T) + tr(W A W A') of the poses that are complete.
    [[nodiscard]] double trace_of_poses(const BorderedForm& other) const {
        double sum = 2.0 * other.spread_.cwiseProduct(weighted_).sum();
        Eigen::Index first = 0;
        for (const Eigen::Index size : sizes_) {
            sum += weighted_own_.block(first, 0, size, size)
                       .cwiseProduct(other.weighted_own_.block(first, 0, size, size).transpose())
                       .sum();
            first += size;
        }
        return sum;
    }

    /// S of everything that is complete, b×b.
    [[nodiscard]] const Eigen::MatrixXd& reduced() const { return reduced_; }

private:
    Eigen::MatrixXd reduced_;  ///< the border of A, and S once complete
    TallMatrix cross_, own_;   ///< of the poses: A_eb, then T; and the blocks A_ee one below the other
    TallMatrix spread_;        ///< T C
    TallMatrix weighted_;      ///< W T
    TallMatrix weighted_own_;  ///< W A, the blocks one below the other
    std::vector<Eigen::Index> sizes_;
};

/// What the visits of some angles say of the components of visits.
struct VisitSums {
    Vector4 quadratic = Vector4::Zero();  ///< ṽᵀ Ũ_k ṽ
    Vector4 trace = Vector4::Zero();      ///< tr(R V_k)
    Matrix4 fisher = Matrix4::Zero();     ///< tr(R V_k R V_l) but for tr(C S C S')
    std::vector<BorderedForm> inner;      ///< J̃ᵀ Ũ_k J̃ of the components that are estimated
    double stated = 0.0;                  ///< variances of the lengths, [m²]
    double lengths = 0.0;
};

VisitSums sums_of(const JointAdjustment& adjustment, const NormalEquations& normal,
                  const BorderedCovariance& covariance, const std::vector<std::size_t>& visits,
                  const std::array<bool, k_visit_components>& needed) {
    VisitSums sums;
    sums.inner.assign(k_visit_components, BorderedForm(covariance.border()));
    Eigen::Index first_pose = covariance.size();
    Eigen::Index end_pose = covariance.border();
    Eigen::Index largest = 0;
    for (const std::size_t v : visits) {
        if (const Eigen::Index pose = normal.first_column(adjustment.pose_block(adjustment.visits()[v].angle));
            pose >= 0) {
            const Eigen::Index size = covariance.own(pose).rows();
            first_pose = std::min(first_pose, pose);
            end_pose = std::max(end_pose, pose + size);
            largest = std::max(largest, size);
        }
    }
    const Eigen::Index poses = std::max<Eigen::Index>(0, end_pose - first_pose);
    first_pose = poses > 0 ? first_pose : covariance.border();
    for (BorderedForm& form : sums.inner) {
        form.begin(poses, largest);
    }
    Eigen::MatrixXd roots, by_root, predicted, root_jacobian, root_square, root_predicted, local;
    Eigen::VectorXd root_residual;
    for (const std::size_t v : visits) {
        const LinearisedGroup& group = normal.groups()[v];
        const Eigen::Index n = group.residual.size();
        // Ũ_k = L⁻¹ V_k L⁻ᵀ = B̃_k B̃_kᵀ: everything of a visit follows from the whitened roots.
        whitened_roots(adjustment, normal, v, roots);
        sums.stated += adjustment.stated_variance(v).sum();
        sums.lengths += static_cast<double>(n);
        const auto first = root_columns(n);
        by_root.noalias() = group.jacobian * covariance(group.columns, group.columns);
        predicted.noalias() = by_root * group.jacobian.transpose();
        root_residual.noalias() = roots.transpose() * group.residual;
        root_jacobian.noalias() = roots.transpose() * group.jacobian;
        root_square.noalias() = roots.transpose() * roots;
        by_root.noalias() = predicted * roots;
        root_predicted.noalias() = roots.transpose() * by_root;
        const Eigen::Index pose = normal.first_column(adjustment.pose_block(adjustment.visits()[v].angle));
        for (std::size_t k = 0; k < k_visit_components; ++k) {
            const auto at = static_cast<Eigen::Index>(k);
            const Eigen::Index rank = first[k + 1] - first[k];
            sums.quadratic[at] += root_residual.segment(first[k], rank).squaredNorm();
            sums.trace[at] += root_square.diagonal().segment(first[k], rank).sum() -
                              root_predicted.diagonal().segment(first[k], rank).sum();
            for (std::size_t l = 0; l < k_visit_components; ++l) {
                const auto square = root_square.block(first[k], first[l], rank, first[l + 1] - first[l]);
                const auto spread = root_predicted.block(first[k], first[l], rank, first[l + 1] - first[l]);
                // R̃ = I − P with P = J̃ C J̃ᵀ: tr(Ũ_k R̃ Ũ_l R̃) = tr(Ũ_k Ũ_l) − 2 tr(Ũ_k P Ũ_l) + tr(Ũ_k P Ũ_l P).
                // The first two need the visit alone. The last one ties all visits together, and is added from the
                // bordered forms.
                sums.fisher(at, static_cast<Eigen::Index>(l)) += square.cwiseProduct(square - 2.0 * spread).sum();
            }
            if (needed[k]) {
                const auto rows = root_jacobian.middleRows(first[k], rank);
                local.noalias() = rows.transpose() * rows;
                sums.inner[k].add(group.columns, pose, first_pose, local);
            }
        }
    }
    for (std::size_t k = 0; k < k_visit_components; ++k) {
        if (!needed[k]) {
            continue;
        }
        sums.inner[k].complete(covariance, first_pose);
        for (std::size_t l = 0; l <= k; ++l) {
            if (needed[l]) {
                const double sum = sums.inner[k].trace_of_poses(sums.inner[l]);
                const auto row = static_cast<Eigen::Index>(k);
                const auto column = static_cast<Eigen::Index>(l);
                sums.fisher(row, column) += sum;
                if (row != column) {
                    sums.fisher(column, row) += sum;
                }
            }
        }
    }
    return sums;
}

/// The visits, those of some angles together in each part.
std::vector<std::vector<std::size_t>> visits_by_parts(const JointAdjustment& adjustment) {
    constexpr std::size_t k_angles_of_a_part = 64;
    const std::size_t angles = adjustment.measurement().angles.size();
    std::vector<std::vector<std::size_t>> parts((angles + k_angles_of_a_part - 1) / k_angles_of_a_part);
    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        parts[adjustment.visits()[v].angle / k_angles_of_a_part].push_back(v);
    }
    return parts;
}

}  // namespace

StochasticModel start_variances(const TableRepeatability& table) {
    StochasticModel model;
    if (table.mode == RepeatabilityMode::none) {
        return model;
    }
    const bool guess = table.mode == RepeatabilityMode::estimate;
    const auto square = [guess](double value, double start) {
        const double used = guess && value <= 0.0 ? start : value;
        return used * used;
    };
    model.variance_linear = square(table.u_linear, k_start_linear);
    model.variance_axial = square(table.u_axial, k_start_angular);
    model.variance_tilt = square(table.u_tilt, k_start_angular);
    return model;
}

VarianceComponentStep estimate_variance_components(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                   const BorderedCovariance& covariance, const StochasticModel& present,
                                                   const EstimatedComponents& estimated) {
    // Components that are held need no Fisher information with the others.
    const std::array<bool, k_visit_components> needed{estimated.length, estimated.table, estimated.table,
                                                      estimated.table};
    const std::vector<std::vector<std::size_t>> parts = visits_by_parts(adjustment);
    std::vector<VisitSums> sums(parts.size());
    // Parts that do not depend on the number of threads, added in their order: the same sum to the last bit.
    FixedParts(parts.size(), 1).run(adjustment.adjustment().workers(), [&](std::size_t part, std::size_t, std::size_t) {
        sums[part] = sums_of(adjustment, normal, covariance, parts[part], needed);
    });
    Vector5 quadratic = Vector5::Zero();                            // ṽᵀ Ũ_k ṽ
    Vector5 trace = Vector5::Zero();                                // tr(R V_k)
    Matrix5 fisher = Matrix5::Zero();                               // tr(R V_k R V_l)
    std::array<Eigen::MatrixXd, k_visit_components> spread_border;  // C S_k
    double mean_stated = 0.0;                                       // of the lengths, [m²]
    double length_count = 0.0;
    for (const VisitSums& part : sums) {
        quadratic.head<4>() += part.quadratic;
        trace.head<4>() += part.trace;
        fisher.topLeftCorner<4, 4>() += part.fisher;
        mean_stated += part.stated;
        length_count += part.lengths;
    }
    mean_stated /= length_count;
    // With one distance a visit its noise and the linear repeatability act alike: only their sum is seen (ADR 0008).
    const bool any_shared_visit =
        std::ranges::any_of(adjustment.visits(), [](const Visit& visit) { return visit.observations.size() > 1; });
    for (std::size_t k = 0; k < k_visit_components; ++k) {
        if (!needed[k]) {
            continue;
        }
        Eigen::MatrixXd reduced = sums.front().inner[k].reduced();
        for (std::size_t part = 1; part < sums.size(); ++part) {
            reduced += sums[part].inner[k].reduced();
        }
        spread_border[k].noalias() = covariance.border_covariance() * reduced;
        for (std::size_t l = 0; l <= k; ++l) {
            if (needed[l]) {
                const double sum = spread_border[k].cwiseProduct(spread_border[l].transpose()).sum();
                const auto row = static_cast<Eigen::Index>(k);
                const auto column = static_cast<Eigen::Index>(l);
                fisher(row, column) += sum;
                if (row != column) {
                    fisher(column, row) += sum;
                }
            }
        }
    }

    // The fixture: Ũ = 1/θ of its own whitened group, whose columns are the coordinates.
    // Few redundant coordinates: with six reflectors the estimate is known to 21 %, and what all coordinates share does
    // not show in it at all. So it is a check as a rule (ADR 0016).
    const LinearisedGroup& fixture = normal.groups()[adjustment.fixture_prior()];
    const double fixture_factor = present.fixture_factor;
    const Eigen::MatrixXd fixture_cofactor =
        fixture.jacobian * covariance(fixture.columns, fixture.columns) * fixture.jacobian.transpose();  // J̃ C J̃ᵀ
    const auto coordinates = fixture.residual.size();
    constexpr auto k_fixture = static_cast<Eigen::Index>(ComponentRow::fixture_cmm);
    quadratic[k_fixture] = fixture.residual.squaredNorm() / fixture_factor;
    trace[k_fixture] = (static_cast<double>(coordinates) - fixture_cofactor.trace()) / fixture_factor;
    // tr(R V₅ R V₅) = tr((I - J̃ C J̃ᵀ)²)/θ²: everything of the fixture is in one group.
    fisher(k_fixture, k_fixture) =
        (Eigen::MatrixXd::Identity(coordinates, coordinates) - fixture_cofactor).squaredNorm() /
        (fixture_factor * fixture_factor);
    if (estimated.fixture) {
        Eigen::MatrixXd fixture_normal = Eigen::MatrixXd::Zero(covariance.border(), covariance.border());
        fixture_normal(fixture.columns, fixture.columns) =
            fixture.jacobian.transpose() * fixture.jacobian / fixture_factor;
        const Eigen::MatrixXd spread_fixture = covariance.border_covariance() * fixture_normal;
        for (std::size_t k = 0; k < k_visit_components; ++k) {
            if (!needed[k]) {
                continue;
            }
            const double sum = spread_border[k].cwiseProduct(spread_fixture.transpose()).sum();
            fisher(static_cast<Eigen::Index>(k), k_fixture) = sum;
            fisher(k_fixture, static_cast<Eigen::Index>(k)) = sum;
        }
    }

    VarianceComponentStep step;
    step.length_separable = any_shared_visit;
    Vector5 theta;
    theta << present.length_factor, present.variance_linear / k_linear_scale, present.variance_axial / k_angular_scale,
        present.variance_tilt / k_angular_scale, fixture_factor;
    const LengthUncertainty& lengths = adjustment.measurement().length_uncertainty;
    const double known = lengths.resolution * lengths.resolution / 12.0;
    // What the display rounds away is known, and controls the lengths as well as noise of their own does.
    step.length_redundancy = (theta[0] + known / mean_stated) * trace[0];
    // Without noise of their own the lengths are still weighted by their resolution.
    const std::array<double, k_components> bound{known > 0.0 ? 0.0 : k_least_length_factor, 0.0, 0.0, 0.0,
                                                 k_least_fixture_factor};
    const std::array<bool, k_components> wanted{estimated.length && any_shared_visit, estimated.table, estimated.table,
                                                estimated.table, estimated.fixture};
    step.expected_degrees_of_freedom.assign(k_components, std::numeric_limits<double>::infinity());
    step.expected_spread.assign(k_components, 0.0);
    step.form_degrees_of_freedom.assign(k_components, 0.0);
    const std::array<double, k_components> units{1.0, k_linear_scale, k_angular_scale, k_angular_scale, 1.0};
    std::vector<Eigen::Index> asked;
    for (std::size_t k = 0; k < k_components; ++k) {
        if (wanted[k]) {
            asked.push_back(static_cast<Eigen::Index>(k));
        }
    }
    if (!asked.empty()) {
        const auto n = static_cast<Eigen::Index>(asked.size());
        const Eigen::MatrixXd all = Eigen::MatrixXd(fisher(asked, asked)).ldlt().solve(Eigen::MatrixXd::Identity(n, n));
        for (Eigen::Index i = 0; i < n; ++i) {
            const Eigen::Index at = asked[static_cast<std::size_t>(i)];
            const auto row = static_cast<std::size_t>(at);
            step.expected_degrees_of_freedom[row] = theta[at] * theta[at] / all(i, i);
            step.expected_spread[row] = all(i, i) > 0.0 ? units[row] * std::sqrt(2.0 * all(i, i)) : 0.0;
            step.form_degrees_of_freedom[row] = fisher(at, at) > 0.0 ? trace[at] * trace[at] / fisher(at, at) : 0.0;
        }
    }
    // A component that stands at its bound and whose likelihood falls from there stays at it.
    std::array<bool, k_components> active = wanted;
    for (std::size_t k = 0; k < k_components; ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        if (active[k] && theta[at] <= bound[k] && quadratic[at] <= trace[at]) {
            active[k] = false;
        }
    }
    Matrix5 inverse = Matrix5::Zero();
    Vector5 next = theta;
    // A variance cannot be negative. Components that a step would carry below their bound are held there one at a time,
    // and the step of the others is found again.
    while (true) {
        std::vector<Eigen::Index> free;
        for (std::size_t k = 0; k < k_components; ++k) {
            if (active[k]) {
                free.push_back(static_cast<Eigen::Index>(k));
            }
        }
        next = theta;
        for (std::size_t k = 0; k < k_components; ++k) {
            if (wanted[k] && !active[k]) {
                next[static_cast<Eigen::Index>(k)] = bound[k];
            }
        }
        inverse.setZero();
        if (free.empty()) {
            break;
        }
        const Eigen::MatrixXd information = fisher(free, free);
        const Eigen::MatrixXd information_inverse =
            information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.rows()));
        inverse(free, free) = information_inverse;
        // What the clamped components give up belongs to the right-hand side of the others.
        Eigen::VectorXd gradient = quadratic(free) - trace(free) - fisher(free, Eigen::all) * (next - theta);
        const Eigen::VectorXd change = information_inverse * gradient;
        Eigen::Index worst = -1;
        for (Eigen::Index i = 0; i < change.size(); ++i) {
            const Eigen::Index at = free[static_cast<std::size_t>(i)];
            next[at] = theta[at] + change[i];
            if (next[at] < bound[static_cast<std::size_t>(at)]) {
                worst = at;
            }
        }
        if (worst < 0) {
            break;
        }
        const bool factor = worst == 0 || worst == k_fixture;
        // A factor on a stated variance is mostly overshot: it comes down by tens, not to nothing at once.
        if (factor && 0.1 * theta[worst] > bound[static_cast<std::size_t>(worst)] &&
            !(worst == 0 && 0.1 * theta[0] * mean_stated < 0.01 * known)) {
            next[worst] = 0.1 * theta[worst];
            for (std::size_t k = 0; k < k_components; ++k) {
                next[static_cast<Eigen::Index>(k)] =
                    std::max(next[static_cast<Eigen::Index>(k)], wanted[k] ? bound[k] : 0.0);
            }
            break;
        }
        active[static_cast<std::size_t>(worst)] = false;
    }
    step.fixture_at_bound = wanted[k_fixture] && !active[k_fixture];

    const std::array<const char*, k_components> names{"length noise", "table linear", "table angular, axial",
                                                      "table angular, tilt", "fixture CMM"};
    const TableRepeatability& table = adjustment.measurement().table_repeatability;
    const std::array<double, 3> table_stated{table.u_linear, table.u_axial, table.u_tilt};
    // One factor multiplies both parts of the stated noise: of two parts the constant one alone would be no noise that any
    // length has. [m²]
    const double length_scale = lengths.u_proportional > 0.0 ? mean_stated : lengths.u_constant * lengths.u_constant;
    const std::array<double, k_components> scales{length_scale, k_linear_scale, k_angular_scale, k_angular_scale,
                                                  adjustment.measurement().fixture_covariance.diagonal().mean()};
    for (std::size_t k = 0; k < k_components; ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        // Var(θ) = 2 S⁻¹ for normal residuals.
        const double variance_of_theta = 2.0 * inverse(at, at);
        VarianceComponent component;
        component.name = names[k];
        component.angular = k == ComponentRow::table_axial || k == ComponentRow::table_tilt;
        component.value = std::sqrt(next[at] * scales[k]);
        component.estimated = wanted[k];
        component.separable = k != ComponentRow::length_noise || any_shared_visit || !estimated.length;
        if (k == ComponentRow::length_noise || k == ComponentRow::fixture_cmm) {
            component.stated = std::sqrt(scales[k]);
        } else if (table.mode == RepeatabilityMode::given) {
            component.stated = table_stated[k - 1];
        }
        // θ tr(R V_k): the part of the redundancy that goes to the component; they add up to the degrees of freedom.
        component.redundancy = next[at] * trace[at];
        component.degrees_of_freedom = std::numeric_limits<double>::infinity();
        if (wanted[k]) {
            // At zero the Fisher information of the component alone says how large it could be.
            double spread = std::numeric_limits<double>::infinity();
            if (variance_of_theta > 0.0) {
                spread = std::sqrt(variance_of_theta);
            } else if (fisher(at, at) > 0.0) {
                spread = std::sqrt(2.0 / fisher(at, at));
            }
            // Of what the distances say nothing of, the information is rounding, of either sign.
            component.determined = std::isfinite(spread);
            // u(√θ) = u(θ)/(2 √θ) grows without limit towards 0; √u(θ) is what a component near 0 may be as large as.
            component.u = next[at] > 0.0
                              ? std::min(0.5 * spread / next[at] * component.value, std::sqrt(spread * scales[k]))
                              : std::sqrt(spread * scales[k]);
            if (next[at] > 0.0) {
                // A χ² with ν degrees of freedom has the variance 2 θ²/ν about θ: ν is found from that of the estimate.
                component.degrees_of_freedom = 2.0 * next[at] * next[at] / (spread * spread);
                step.relative_change = std::max(step.relative_change, std::abs(next[at] - theta[at]) / spread);
            } else if (theta[at] > 0.0) {
                step.relative_change = std::max(step.relative_change, theta[at] / spread);
            }
        }
        step.components.push_back(component);
    }
    step.stochastic.length_factor = next[0];
    step.stochastic.variance_linear = next[1] * k_linear_scale;
    step.stochastic.variance_axial = next[2] * k_angular_scale;
    step.stochastic.variance_tilt = next[3] * k_angular_scale;
    step.stochastic.fixture_factor = next[4];
    return step;
}

void take_plausible_components(VarianceComponentStep& step) {
    const std::array<double*, 3> variances{&step.stochastic.variance_linear, &step.stochastic.variance_axial,
                                           &step.stochastic.variance_tilt};
    for (std::size_t k = table_linear; k <= table_tilt; ++k) {
        VarianceComponent& component = step.components[k];
        if (!component.estimated || component.residuals_give) {
            continue;
        }
        const double variance = component.value * component.value;
        // Var(θ) = 2 θ²/ν; at zero, `u` is the root of the standard uncertainty of the variance.
        const double u = std::isfinite(component.degrees_of_freedom)
                             ? variance * std::sqrt(2.0 / component.degrees_of_freedom)
                             : component.u * component.u;
        if (!component.determined || !(variance < k_determined * u)) {
            continue;
        }
        const PlausibleVariance plausible = plausible_variance(variance, u);
        component.residuals_give = component.value;
        component.value = std::sqrt(plausible.mean);
        component.u = 0.5 * plausible.spread / component.value;
        component.degrees_of_freedom = 2.0 * std::pow(plausible.mean / plausible.spread, 2);
        component.determined = component.value < (component.angular ? k_most_angular : k_most_linear);
        *variances[k - table_linear] = plausible.mean;
    }
}

double fixture_redundancy(const JointAdjustment& adjustment, const NormalEquations& normal,
                          const BorderedCovariance& covariance) {
    const LinearisedGroup& fixture = normal.groups()[adjustment.fixture_prior()];
    return static_cast<double>(fixture.residual.size()) -
           (fixture.jacobian * covariance(fixture.columns, fixture.columns) * fixture.jacobian.transpose()).trace();
}

}  // namespace gumcert::engine
