#include "engine/rotary_table/start/closed_solution.h"

#include "gum/quantity/dense_factors.h"

namespace gumcert::engine {

namespace {

constexpr double k_linear_eigenvalue_ratio = 1e-10;

}  // namespace

ClosedSolution closed_solution(const StationDistances& data, const std::vector<Eigen::Vector3d>& points) {
    ClosedSolution result;
    for (const Eigen::Vector3d& point : points) {
        result.centre += point / static_cast<double>(points.size());
    }
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    // l0 and κ are two unknowns of each dead path: fewer than three lengths say nothing of the position.
    for (const std::vector<Eigen::Index>& members : data.members) {
        if (members.size() < 3) {
            continue;
        }
        const auto n = static_cast<Eigen::Index>(members.size());
        Eigen::MatrixXd rows(n, 5);
        for (Eigen::Index k = 0; k < n; ++k) {
            const Eigen::Index i = members[static_cast<std::size_t>(k)];
            const Eigen::Vector3d point = points[static_cast<std::size_t>(i)] - result.centre;
            rows.row(k) << -2.0 * point.transpose(), data.length[i] * data.length[i] - point.squaredNorm(),
                data.length[i];
        }
        // κ is a constant of the dead path: means are taken off. l0 is the factor of l: what is proportional to l
        // is taken off. What is left is linear in q.
        rows.rowwise() -= rows.colwise().mean().eval();
        const double squares = rows.col(4).squaredNorm();
        if (squares > 0.0) {
            const Eigen::RowVector4d share = rows.col(4).transpose() * rows.leftCols<4>() / squares;
            rows.leftCols<4>() -= rows.col(4) * share;
        }
        normal += rows.leftCols<4>().transpose() * rows.leftCols<4>();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal.topLeftCorner<3, 3>());
    const Eigen::Vector3d values = eigen.eigenvalues();
    result.open = eigen.eigenvectors().col(0);
    result.determined = values[0] > k_linear_eigenvalue_ratio * values[2] && values[2] > 0.0;
    result.position = result.centre;
    // In a direction that the rows do not determine the solution stays in the middle of the points, and `open`
    // tells which one it is.
    for (int k = 0; k < 3; ++k) {
        if (values[k] > k_linear_eigenvalue_ratio * values[2]) {
            const Eigen::Vector3d direction = eigen.eigenvectors().col(k);
            result.position += direction * (direction.dot(normal.topRightCorner<3, 1>()) / values[k]);
        }
    }
    return result;
}

}  // namespace gumcert::engine
