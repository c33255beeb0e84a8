#include "engine/rotary_table/sense_deviations.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "gum/quantity/dense_factors.h"

namespace gumcert::engine {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Of the eigenvalues of the scaled normal equations of the pose: below it the lengths do not see one of the six.
constexpr double k_least_eigenvalue = 1e-6;

std::vector<Index> columns_of(const NormalEquations& normal, const std::vector<std::size_t>& visits) {
    std::vector<Index> columns;
    for (const std::size_t v : visits) {
        columns.insert(columns.end(), normal.groups()[v].columns.begin(), normal.groups()[v].columns.end());
    }
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    return columns;
}

/// \return whether the visits determine all six
bool fill(SenseDeviation& result, const std::vector<std::size_t>& visits, const JointAdjustment& adjustment,
          const NormalEquations& normal, const BorderedCovariance& covariance) {
    const std::vector<Index> columns = columns_of(normal, visits);
    Matrix6 information = Matrix6::Zero();
    Vector6 pull = Vector6::Zero();
    MatrixXd by_parameter = MatrixXd::Zero(6, static_cast<Index>(columns.size()));
    for (const std::size_t v : visits) {
        const LinearisedGroup& group = normal.groups()[v];
        const MatrixXd pose = group.cholesky.triangularView<Eigen::Lower>().solve(adjustment.pose_jacobian(v));
        information += pose.transpose() * pose;
        pull += pose.transpose() * group.residual;
        const MatrixXd part = pose.transpose() * group.jacobian;
        for (std::size_t c = 0; c < group.columns.size(); ++c) {
            const auto at = std::lower_bound(columns.begin(), columns.end(), group.columns[c]);
            by_parameter.col(std::distance(columns.begin(), at)) += part.col(static_cast<Index>(c));
        }
    }
    if (!(information.diagonal().minCoeff() > 0.0)) {
        return false;
    }
    // To a unit diagonal, because translations and rotations have different units.
    const Vector6 scale = information.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(Matrix6(scale.asDiagonal() * information * scale.asDiagonal()));
    if (!(solver.eigenvalues()[0] > k_least_eigenvalue)) {
        return false;
    }
    const Matrix6 inverse = scale.asDiagonal() * solver.eigenvectors() *
                            solver.eigenvalues().cwiseInverse().asDiagonal() * solver.eigenvectors().transpose() *
                            scale.asDiagonal();
    const MatrixXd gain = inverse * by_parameter;
    result.deviation = inverse * pull;
    // J C Jᵀ is taken off: what the adjustment has used of the residuals is not free any more.
    result.covariance = inverse - gain * covariance(columns, columns) * gain.transpose();
    // The only visits of an angle have no residual of their own: what is left is rounding.
    result.covariance.diagonal() = result.covariance.diagonal().cwiseMax(0.0);
    return true;
}

}  // namespace

std::vector<SenseDeviation> sense_deviations(const JointAdjustment& adjustment, const NormalEquations& normal,
                                             const BorderedCovariance& covariance) {
    std::vector<std::array<std::vector<std::size_t>, 2>> visits(adjustment.measurement().angles.size());
    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        const Visit& visit = adjustment.visits()[v];
        visits[visit.angle][visit.approach == Approach::positive ? 0 : 1].push_back(v);
    }
    std::vector<SenseDeviation> result;
    for (std::size_t i = 0; i < visits.size(); ++i) {
        for (const Approach approach : {Approach::positive, Approach::negative}) {
            SenseDeviation one{.angle = i, .approach = approach};
            if (fill(one, visits[i][approach == Approach::positive ? 0 : 1], adjustment, normal, covariance)) {
                result.push_back(one);
            }
        }
    }
    return result;
}

}  // namespace gumcert::engine
