#pragma once

#include <Eigen/Core>
#include <array>

#include "gum/quantity/distribution.h"

namespace gumcert::gum {

/// How X = G⁻¹(Φ(Z)), Z a standard normal deviate, goes with Z: coefficients of the standardised X in Hermite
/// polynomials of Z. Two quantities whose normal deviates have the correlation ρ have Pearson's r = Σ_k a_k b_k ρ^k, k
/// ≥ 1 (Mehler's formula).
class HermiteProfile {
public:
    /// \param distribution  without a problem (distribution_problem), no constant
    explicit HermiteProfile(const Distribution& distribution);

    /// False where the standard deviation does not exist (t with ν ≤ 2): then nor does Pearson's r.
    [[nodiscard]] bool has_correlation() const { return has_correlation_; }

    /// Smallest and largest Pearson's r of two quantities: of ρ = −1 and ρ = +1.
    [[nodiscard]] static std::array<double, 2> attainable(const HermiteProfile& a, const HermiteProfile& b);

    /// Pearson's r of two quantities whose normal deviates have the correlation ρ, −1 … 1.
    [[nodiscard]] static double pearson(const HermiteProfile& a, const HermiteProfile& b, double rho);

    /// The ρ that gives Pearson's r; −1 or 1 for an r that cannot be attained. 2 sin(πr/6) for two uniform quantities.
    [[nodiscard]] static double normal_correlation(const HermiteProfile& a, const HermiteProfile& b, double r);

private:
    bool has_correlation_ = true;
    Eigen::VectorXd values_;        // of the standardised X at the nodes of Z
    Eigen::VectorXd coefficients_;  // a_1 … a_K
};

}  // namespace gumcert::gum
