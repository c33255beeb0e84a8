#include "engine/variance_components.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <limits>

namespace gumcert::engine {

namespace {

constexpr std::size_t k_components = 4;
// Scale of each component, so that the four columns of the Fisher matrix are comparable: (0.1 µm)² and (0.1″)².
constexpr double k_linear_scale = 1e-14;
constexpr double k_angular_scale = 2.350443e-13;

/// Derivatives of the covariance of a visit with respect to the four components, in their scales.
std::array<Eigen::MatrixXd, k_components> covariance_derivatives(const JointAdjustment& adjustment, std::size_t visit) {
    const Eigen::MatrixXd pose = adjustment.pose_jacobian(visit);
    const int axial = 3 + axial_coordinate(adjustment.measurement().axis);
    Eigen::MatrixXd tilt(pose.rows(), 2);
    for (int c = 3, k = 0; c < 6; ++c) {
        if (c != axial) {
            tilt.col(k++) = pose.col(c);
        }
    }
    return {Eigen::MatrixXd(adjustment.stated_variance(visit).asDiagonal()),
            k_linear_scale * pose.leftCols<3>() * pose.leftCols<3>().transpose(),
            k_angular_scale * pose.col(axial) * pose.col(axial).transpose(), k_angular_scale * tilt * tilt.transpose()};
}

}  // namespace

VarianceComponentStep estimate_variance_components(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                   const Eigen::MatrixXd& covariance, const StochasticModel& present,
                                                   const EstimatedComponents& estimated) {
    const Eigen::Index p = normal.parameter_count();
    std::array<Eigen::MatrixXd, k_components> inner;  // J̃ᵀ Ũ_k J̃
    inner.fill(Eigen::MatrixXd::Zero(p, p));
    Eigen::Vector4d quadratic = Eigen::Vector4d::Zero();  // ṽᵀ Ũ_k ṽ
    Eigen::Vector4d trace = Eigen::Vector4d::Zero();      // tr(R V_k)
    Eigen::Matrix4d fisher = Eigen::Matrix4d::Zero();     // tr(R V_k R V_l)
    bool any_shared_visit = false;

    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        const LinearisedGroup& group = normal.groups()[v];
        any_shared_visit = any_shared_visit || group.residual.size() > 1;
        const auto derivatives = covariance_derivatives(adjustment, v);
        const auto lower = group.cholesky.triangularView<Eigen::Lower>();
        std::array<Eigen::MatrixXd, k_components> whitened;  // L⁻¹ V_k L⁻ᵀ
        std::array<Eigen::MatrixXd, k_components> product;   // Ũ_k J̃
        for (std::size_t k = 0; k < k_components; ++k) {
            const Eigen::MatrixXd half = lower.solve(derivatives[k]);
            whitened[k] = lower.solve(half.transpose());
            product[k].noalias() = whitened[k] * group.jacobian;
            const auto at = static_cast<Eigen::Index>(k);
            quadratic[at] += group.residual.dot(whitened[k] * group.residual);
            trace[at] += whitened[k].trace();
            const Eigen::MatrixXd local = group.jacobian.transpose() * product[k];
            for (std::size_t i = 0; i < group.columns.size(); ++i) {
                for (std::size_t j = 0; j < group.columns.size(); ++j) {
                    inner[k](group.columns[i], group.columns[j]) +=
                        local(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
                }
            }
        }
        Eigen::MatrixXd local_covariance(group.columns.size(), group.columns.size());
        for (std::size_t i = 0; i < group.columns.size(); ++i) {
            for (std::size_t j = 0; j < group.columns.size(); ++j) {
                local_covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                    covariance(group.columns[i], group.columns[j]);
            }
        }
        for (std::size_t k = 0; k < k_components; ++k) {
            const Eigen::MatrixXd spread = product[k] * local_covariance;
            for (std::size_t l = 0; l < k_components; ++l) {
                fisher(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) +=
                    whitened[k].cwiseProduct(whitened[l]).sum() - 2.0 * spread.cwiseProduct(product[l]).sum();
            }
        }
    }
    std::array<Eigen::MatrixXd, k_components> outer;  // C J̃ᵀ Ũ_k J̃
    for (std::size_t k = 0; k < k_components; ++k) {
        outer[k].noalias() = covariance * inner[k];
        trace[static_cast<Eigen::Index>(k)] -= outer[k].trace();
    }
    for (std::size_t k = 0; k < k_components; ++k) {
        for (std::size_t l = 0; l < k_components; ++l) {
            fisher(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) +=
                outer[k].cwiseProduct(outer[l].transpose()).sum();
        }
    }

    VarianceComponentStep step;
    step.length_separable = any_shared_visit;
    Eigen::Vector4d theta(present.length_factor, present.variance_linear / k_linear_scale,
                          present.variance_axial / k_angular_scale, present.variance_tilt / k_angular_scale);
    std::array<bool, k_components> wanted{estimated.length && any_shared_visit, estimated.table, estimated.table,
                                          estimated.table};
    // A component that stands at zero and whose likelihood falls from there stays at zero.
    std::array<bool, k_components> active = wanted;
    for (std::size_t k = 0; k < k_components; ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        if (active[k] && theta[at] <= 0.0 && quadratic[at] <= trace[at]) {
            active[k] = false;
        }
    }
    Eigen::Matrix4d inverse = Eigen::Matrix4d::Zero();
    Eigen::Vector4d next = theta;
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
                next[static_cast<Eigen::Index>(k)] = 0.0;
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
            next[free[static_cast<std::size_t>(i)]] = theta[free[static_cast<std::size_t>(i)]] + change[i];
            if (next[free[static_cast<std::size_t>(i)]] < 0.0) {
                worst = free[static_cast<std::size_t>(i)];
            }
        }
        if (worst < 0) {
            break;
        }
        if (worst == 0) {
            next[0] = 0.1 * theta[0];  // lengths without any noise of their own would leave nothing to weight by
            break;
        }
        active[static_cast<std::size_t>(worst)] = false;
    }

    const std::array<const char*, k_components> names{"length noise", "table linear", "table angular, axial",
                                                      "table angular, tilt"};
    const double length_u = adjustment.measurement().length_uncertainty.u_constant;
    const std::array<double, k_components> scales{length_u * length_u, k_linear_scale, k_angular_scale,
                                                  k_angular_scale};
    for (std::size_t k = 0; k < k_components; ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        const double variance_of_theta = 2.0 * inverse(at, at);
        VarianceComponent component;
        component.name = names[k];
        component.angular = k >= 2;
        component.value = std::sqrt(next[at] * scales[k]);
        component.estimated = wanted[k];
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
    return step;
}

}  // namespace gumcert::engine
