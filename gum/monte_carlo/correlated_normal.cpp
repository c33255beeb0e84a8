#include "gum/monte_carlo/correlated_normal.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/special_values.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace gumcert::gum {

namespace {

Eigen::MatrixXd part(const Eigen::MatrixXd& R, const std::vector<Eigen::Index>& rows,
                     const std::vector<Eigen::Index>& columns) {
    Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t j = 0; j < columns.size(); ++j) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = R(rows[i], columns[j]);
        }
    }
    return out;
}

/// Moore–Penrose inverse of a positive semi-definite matrix with the diagonal 1.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& R) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(R);
    // Known quantities may depend on each other linearly, r = ±1: directions without variance say nothing of the
    // others.
    const double tolerance = 100.0 * static_cast<double>(R.rows()) * k_epsilon * eigen.eigenvalues().maxCoeff();
    const Eigen::VectorXd inverse =
        eigen.eigenvalues().unaryExpr([&](double value) { return value > tolerance ? 1.0 / value : 0.0; });
    return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

Eigen::MatrixXd semidefinite_root(const Eigen::MatrixXd& correlation) {
    const Eigen::Index n = correlation.rows();
    const double tolerance = 10.0 * static_cast<double>(n) * k_epsilon;
    Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        double pivot = correlation(j, j);
        for (Eigen::Index k = 0; k < j; ++k) {
            pivot -= L(j, k) * L(j, k);
        }
        // The quantity is a combination of those before it: it has no deviate of its own. A root of what rounding left
        // of the pivot would give it one.
        if (!(pivot > tolerance)) {
            continue;
        }
        const double root = std::sqrt(pivot);
        L(j, j) = root;
        for (Eigen::Index i = j + 1; i < n; ++i) {
            double sum = correlation(i, j);
            for (Eigen::Index k = 0; k < j; ++k) {
                sum -= L(i, k) * L(j, k);
            }
            L(i, j) = sum / root;
        }
    }
    return L;
}

ConditionalNormal conditional_normal(const Eigen::MatrixXd& correlation, const std::vector<bool>& is_given) {
    ConditionalNormal out;
    for (std::size_t i = 0; i < is_given.size(); ++i) {
        (is_given[i] ? out.given : out.others).push_back(static_cast<Eigen::Index>(i));
    }
    const Eigen::MatrixXd across = part(correlation, out.others, out.given);
    // E[others | given] = R_og R_gg⁻¹ z, and what is left scatters with R_oo − R_og R_gg⁻¹ R_go.
    out.coefficients = across * pseudo_inverse(part(correlation, out.given, out.given));
    const Eigen::MatrixXd remainder = part(correlation, out.others, out.others) - out.coefficients * across.transpose();
    // Symmetric but for rounding; the root reads one triangle only.
    out.root = semidefinite_root(0.5 * (remainder + remainder.transpose()));
    return out;
}

}  // namespace gumcert::gum
