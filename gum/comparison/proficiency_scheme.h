#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>

namespace gumcert::gum {

/// Standard deviation for proficiency assessment by the curve of Horwitz as Thompson modified it, as a mass fraction:
/// 0.22 c below 1.2e-7, 0.02 c^0.8495 up to 0.138, 0.01 √c above.                    (ISO 13528:2022, clause 8)
/// \param mass_fraction  c, 0 < c ≤ 1
/// \throws InputError  GC-GUM-0001, -0003; GC-GUM-0112 where c > 1
[[nodiscard]] double sigma_pt_of_mass_fraction(double mass_fraction);

/// σ_pt from the precision of a method: √(σ_R² − σ_r² (1 − 1/m)) for m replicates.    (ISO 13528:2022, clause 8)
/// \param repeatability  σ_r ≥ 0.
/// \param replicates  m ≥ 1; σ_pt is that of their mean
/// \throws InputError  GC-GUM-0001, -0002, -0003; GC-GUM-0110 where σ_r > σ_R; GC-GUM-0111 where m = 0
[[nodiscard]] double sigma_pt_of_precision(double reproducibility, double repeatability, std::size_t replicates);

/// Limit on the standard uncertainty of the assigned value, as a share of σ_pt: above it z' replaces z.
inline constexpr double k_assigned_value_criterion = 0.3;

/// Factors of the expanded criterion of homogeneity for g items in m replicates:
/// F1 = χ²_0.95(g − 1)/(g − 1), F2 = (F_0.95(g − 1, g(m − 1)) − 1)/m.               (ISO 13528:2022, annex B)
struct HomogeneityFactors {
    double f1 = 0.0, f2 = 0.0;
};
/// \throws InputError  GC-GUM-0111 g < 2 or m < 2
[[nodiscard]] HomogeneityFactors homogeneity_factors(std::size_t items, std::size_t replicates);

/// Check of homogeneity of g items in m replicates.                                    (ISO 13528:2022, annex B)
struct HomogeneityCheck {
    std::size_t items = 0, replicates = 0;
    double mean = 0.0;
    double mean_remainder = 0.0;  ///< what the rounding of the mean has cut off
    double s_x = 0.0;             ///< standard deviation of the means of the items
    double s_w = 0.0;             ///< within items
    double s_s = 0.0;             ///< between items, √max(0, s_x² − s_w²/m)
    /// Of s_s², the difference of two estimates, by Welch and Satterthwaite; 1 at least.
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
    double limit = 0.0;                ///< 0.3 σ_pt
    double expanded_limit = 0.0;       ///< √(F1 (0.3 σ_pt)² + F2 s_w²)
    bool sufficient = false;           ///< s_s ≤ limit
    bool sufficient_expanded = false;  ///< s_s ≤ expanded_limit
};
/// \param results  g×m, g ≥ 2, m ≥ 2, row i = item i, in the unit of σ_pt
/// \param sigma_pt  > 0
/// \throws InputError  GC-GUM-0001, GC-GUM-0003 for σ_pt, GC-GUM-0111 too few items or replicates
[[nodiscard]] HomogeneityCheck check_homogeneity(const Eigen::MatrixXd& results, double sigma_pt);

/// Check of stability: mean of items measured again, later, against the mean of the homogeneity check. The difference
/// keeps the digits that the results have, whatever they have in common; one that is at a limit but for the rounding of
/// the two means counts as at it.
struct StabilityCheck {
    double mean = 0.0;
    double difference = 0.0;      ///< |ȳ1 − ȳ2|
    double u_difference = 0.0;    ///< √(u²(ȳ1) + u²(ȳ2)), u of the mean of the item means; 0 with one item
    double limit = 0.0;           ///< 0.3 σ_pt
    double expanded_limit = 0.0;  ///< 0.3 σ_pt + 2 u_difference
    bool stable = false, stable_expanded = false;
};
/// \param results  g×m, g ≥ 1, m ≥ 1, row i = item i
/// \throws InputError  as check_homogeneity()
[[nodiscard]] StabilityCheck check_stability(const HomogeneityCheck& before, const Eigen::MatrixXd& results,
                                             double sigma_pt);

}  // namespace gumcert::gum
