#include "engine/variance_components.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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
// A factor below these would leave nothing to weight by.
constexpr double k_least_length_factor = 1e-6;
constexpr double k_least_fixture_factor = 1e-4;

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// Roots B_k of the derivatives V_k = B_k B_kᵀ of the covariance of a visit, in the scales of the components, side by
/// side: n×(n + 6).
Eigen::MatrixXd covariance_roots(const JointAdjustment& adjustment, std::size_t visit) {
    const Eigen::MatrixXd pose = adjustment.pose_jacobian(visit);
    const int axial = 3 + axial_coordinate(adjustment.measurement().axis);
    const Eigen::Index n = pose.rows();
    Eigen::MatrixXd roots(n, n + 6);
    roots.leftCols(n) = adjustment.stated_variance(visit).cwiseSqrt().asDiagonal();
    roots.middleCols<3>(n) = std::sqrt(k_linear_scale) * pose.leftCols<3>();
    roots.col(n + 3) = std::sqrt(k_angular_scale) * pose.col(axial);
    for (int c = 3, k = 4; c < 6; ++c) {
        if (c != axial) {
            roots.col(n + k++) = std::sqrt(k_angular_scale) * pose.col(c);
        }
    }
    return roots;
}

/// First column of each component in `covariance_roots`, and the end.
std::array<Eigen::Index, k_visit_components + 1> root_columns(Eigen::Index n) {
    return {0, n, n + 3, n + 4, n + 6};
}

/// A symmetric A in the form of the normal equations, with a border and a block for every eliminated pose, and what the
/// traces of its products with the covariance H C Hᵀ + W of the parameters are made of (BorderedCovariance; H = (I,
/// F)).
///
/// tr(Q A Q A') = tr(C S C S') + 2 tr(C T'ᵀ W T) + tr(W A W A') with S = Hᵀ A H, and T = A H of the poses: proportional
/// to the parameters, where the product Q A would have p² elements.
class BorderedForm {
public:
    explicit BorderedForm(const BorderedCovariance& covariance)
        : border_(Eigen::MatrixXd::Zero(covariance.border(), covariance.border())),
          cross_(Eigen::MatrixXd::Zero(covariance.size() - covariance.border(), covariance.border())),
          own_(Eigen::MatrixXd::Zero(covariance.size() - covariance.border(), k_pose)) {}

    /// \param local  part of A over the parameters `columns`, of which those of poses are in one pose
    void add(const BorderedCovariance& covariance, const std::vector<Eigen::Index>& columns,
             const Eigen::MatrixXd& local) {
        const Eigen::Index b = covariance.border();
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double* values = local.col(static_cast<Eigen::Index>(i)).data();  // of a row as well: A is symmetric
            if (columns[i] < b) {
                double* to = border_.col(columns[i]).data();
                for (std::size_t j = 0; j < columns.size(); ++j) {
                    if (columns[j] < b) {
                        to[columns[j]] += values[j];
                    }
                }
                continue;
            }
            double* across = cross_.row(columns[i] - b).data();
            double* own = own_.row(columns[i] - b).data();
            const Eigen::Index first = covariance.first_of(columns[i]);
            for (std::size_t j = 0; j < columns.size(); ++j) {
                if (columns[j] < b) {
                    across[columns[j]] += values[j];
                } else {
                    own[columns[j] - first] += values[j];
                }
            }
        }
    }

    /// Once everything is added.
    void complete(const BorderedCovariance& covariance) {
        const TallMatrix& elimination = covariance.elimination();
        const Eigen::Index b = covariance.border();
        TallMatrix by_border = cross_;  // T
        weighted_.resize(cross_.rows(), b);
        weighted_own_ = TallMatrix::Zero(own_.rows(), k_pose);
        for (Eigen::Index i = 0; i < own_.rows();) {
            const Eigen::MatrixXd& spread = covariance.own(b + i);  // W
            const Eigen::Index size = spread.rows();
            by_border.middleRows(i, size).noalias() += own_.block(i, 0, size, size) * elimination.middleRows(i, size);
            weighted_.middleRows(i, size).noalias() = spread * by_border.middleRows(i, size);
            weighted_own_.block(i, 0, size, size).noalias() = spread * own_.block(i, 0, size, size);
            own_sizes_.push_back(size);
            i += size;
        }
        Eigen::MatrixXd reduced = border_;  // S
        reduced.noalias() += elimination.transpose() * by_border;
        reduced.noalias() += cross_.transpose() * elimination;
        spread_border_.noalias() = covariance.border_covariance() * reduced;
        spread_.noalias() = by_border * covariance.border_covariance();
    }

    /// tr(Q A Q A').
    [[nodiscard]] double trace_with(const BorderedForm& other) const {
        double sum = spread_border_.cwiseProduct(other.spread_border_.transpose()).sum() +
                     2.0 * other.spread_.cwiseProduct(weighted_).sum();
        Eigen::Index first = 0;
        for (const Eigen::Index size : own_sizes_) {
            sum += weighted_own_.block(first, 0, size, size)
                       .cwiseProduct(other.weighted_own_.block(first, 0, size, size).transpose())
                       .sum();
            first += size;
        }
        return sum;
    }

    /// tr(Q A Q A') for an A' that is in the border only.
    /// \param spread  C A', b×b
    [[nodiscard]] double trace_with_border(const Eigen::MatrixXd& spread) const {
        return spread_border_.cwiseProduct(spread.transpose()).sum();
    }

private:
    static constexpr Eigen::Index k_pose = 6;
    Eigen::MatrixXd border_;         ///< A: b×b
    TallMatrix cross_, own_;         ///< A: (p-b)×b, and the blocks one below the other
    Eigen::MatrixXd spread_border_;  ///< C S
    TallMatrix spread_;              ///< T C
    TallMatrix weighted_;            ///< W T
    TallMatrix weighted_own_;        ///< W A, the blocks one below the other
    std::vector<Eigen::Index> own_sizes_;
};

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
    const std::array<bool, k_visit_components> needed{estimated.length, estimated.table, estimated.table,
                                                      estimated.table};
    std::vector<BorderedForm> inner(k_visit_components, BorderedForm(covariance));  // J̃ᵀ Ũ_k J̃ of the estimated ones
    Vector5 quadratic = Vector5::Zero();                                            // ṽᵀ Ũ_k ṽ
    Vector5 trace = Vector5::Zero();                                                // tr(R V_k)
    Matrix5 fisher = Matrix5::Zero();                                               // tr(R V_k R V_l)
    bool any_shared_visit = false;
    double mean_stated = 0.0;  // of the lengths, [m²]
    double length_count = 0.0;

    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        const LinearisedGroup& group = normal.groups()[v];
        any_shared_visit = any_shared_visit || group.residual.size() > 1;
        // Ũ_k = L⁻¹ V_k L⁻ᵀ = B̃_k B̃_kᵀ: everything of a visit follows from the whitened roots.
        Eigen::MatrixXd roots = covariance_roots(adjustment, v);
        mean_stated += roots.leftCols(group.residual.size()).squaredNorm();
        length_count += static_cast<double>(group.residual.size());
        group.cholesky.triangularView<Eigen::Lower>().solveInPlace(roots);
        const auto first = root_columns(group.residual.size());
        const Eigen::MatrixXd predicted =
            group.jacobian * covariance(group.columns, group.columns) * group.jacobian.transpose();
        const Eigen::VectorXd root_residual = roots.transpose() * group.residual;
        const Eigen::MatrixXd root_jacobian = roots.transpose() * group.jacobian;
        const Eigen::MatrixXd root_square = roots.transpose() * roots;
        const Eigen::MatrixXd root_predicted = roots.transpose() * predicted * roots;
        for (std::size_t k = 0; k < k_visit_components; ++k) {
            const auto at = static_cast<Eigen::Index>(k);
            const Eigen::Index rank = first[k + 1] - first[k];
            quadratic[at] += root_residual.segment(first[k], rank).squaredNorm();
            trace[at] += root_square.diagonal().segment(first[k], rank).sum() -
                         root_predicted.diagonal().segment(first[k], rank).sum();
            for (std::size_t l = 0; l < k_visit_components; ++l) {
                const auto square = root_square.block(first[k], first[l], rank, first[l + 1] - first[l]);
                const auto spread = root_predicted.block(first[k], first[l], rank, first[l + 1] - first[l]);
                fisher(at, static_cast<Eigen::Index>(l)) += square.cwiseProduct(square - 2.0 * spread).sum();
            }
            if (!needed[k]) {
                continue;
            }
            const auto rows = root_jacobian.middleRows(first[k], rank);
            const Eigen::MatrixXd local = rows.transpose() * rows;
            inner[k].add(covariance, group.columns, local);
        }
    }
    mean_stated /= length_count;
    for (std::size_t k = 0; k < k_visit_components; ++k) {
        if (!needed[k]) {
            continue;
        }
        inner[k].complete(covariance);
        for (std::size_t l = 0; l <= k; ++l) {
            if (needed[l]) {
                const double sum = inner[k].trace_with(inner[l]);
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
            const double sum = inner[k].trace_with_border(spread_fixture);
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
    // Without noise of their own the lengths are still weighted by their resolution.
    const std::array<double, k_components> bound{known > 0.0 ? 0.0 : k_least_length_factor, 0.0, 0.0, 0.0,
                                                 k_least_fixture_factor};
    const std::array<bool, k_components> wanted{estimated.length && any_shared_visit, estimated.table, estimated.table,
                                                estimated.table, estimated.fixture};
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
    const double length_scale =
        lengths.u_constant > 0.0 ? lengths.u_constant * lengths.u_constant : mean_stated;  // of one length, [m²]
    const std::array<double, k_components> scales{length_scale, k_linear_scale, k_angular_scale, k_angular_scale,
                                                  adjustment.measurement().fixture_covariance.diagonal().mean()};
    for (std::size_t k = 0; k < k_components; ++k) {
        const auto at = static_cast<Eigen::Index>(k);
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
        component.redundancy = next[at] * trace[at];
        component.degrees_of_freedom = std::numeric_limits<double>::infinity();
        if (wanted[k]) {
            // At zero the Fisher information of the component alone says how large it could be.
            const double spread =
                variance_of_theta > 0.0 ? std::sqrt(variance_of_theta) : std::sqrt(2.0 / fisher(at, at));
            component.u = next[at] > 0.0
                              ? std::min(0.5 * spread / next[at] * component.value, std::sqrt(spread * scales[k]))
                              : std::sqrt(spread * scales[k]);
            if (next[at] > 0.0) {
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

double fixture_redundancy(const JointAdjustment& adjustment, const NormalEquations& normal,
                          const BorderedCovariance& covariance) {
    const LinearisedGroup& fixture = normal.groups()[adjustment.fixture_prior()];
    return static_cast<double>(fixture.residual.size()) -
           (fixture.jacobian * covariance(fixture.columns, fixture.columns) * fixture.jacobian.transpose()).trace();
}

}  // namespace gumcert::engine
