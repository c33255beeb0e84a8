#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "gum/weighted_chi_square.h"

namespace gumcert::gum {

/// Differences of two methods at m points, with everything that ties the points to each other.
struct MethodDifferences {
    Eigen::VectorXd d;                      ///< m, D = method − reference
    Eigen::MatrixXd covariance;             ///< m×m, of D (standard uncertainties), in the square of the unit of D
    Eigen::VectorXd U;                      ///< m, expanded uncertainty of D: also D_fail of the point
    Eigen::VectorXd U_method, U_reference;  ///< m, expanded uncertainties of both sides
    /// m×m, of the values of each side; empty: U of the method is held against half and twice of all of `covariance`.
    Eigen::MatrixXd method_covariance = {}, reference_covariance = {};
    Eigen::VectorXd degrees_of_freedom = {};  ///< m, ν of u(D); empty: all infinite
    bool one_estimate = false;  ///< finite ν, and the uncertainties of several points come from one estimate
};

/// What m correlated points say together.
struct Agreement {
    std::size_t points = 0;         ///< m
    std::size_t count_above_1 = 0;  ///< |E_n| > 1
    double mean_absolute_en = 0.0, largest_absolute_en = 0.0;
    /// Limit of largest_absolute_en: 1 for one point, else the one that chance exceeds in 1 of 100 comparisons.
    double largest_en_by_chance = 1.0;
    double rms_en = 0.0;
    double rms_en_low = 0.0, rms_en_high = 0.0;  ///< 95 % of all comparisons lie between, uncertainties being right
    double sum_of_squared_zeta = 0.0;
    double p_low = 0.0;   ///< P(a sum as small or smaller) given the covariance; small: uncertainties too large
    double p_high = 0.0;  ///< P(a sum as large or larger); small: uncertainties too small
    double p_low_independent = 0.0, p_high_independent = 0.0;  ///< as if the points were independent of each other
    double effective_points = 0.0;  ///< m² / ΣΣ r_ij²: independent points that would tell as much
    double d_fail_smallest = 0.0, d_fail_largest = 0.0;  ///< of the points
    double mahalanobis_square = 0.0;                     ///< Dᵀ V⁻¹ D with the pseudo-inverse where V is singular
    std::size_t rank = 0;
    double beyond_covariance = 0.0;  ///< size of the vector of ζ outside the range of a singular V, which says it is 0
    double p_mahalanobis = 1.0;      ///< P(χ²_rank ≥ mahalanobis_square)
    /// The same where 5 % of u of each point may be rounding of the stated numbers: what refutes a pattern. It sees what
    /// is beyond a singular V as well.
    double p_pattern = 1.0;
    /// Finite ν together with correlations, or with one estimate behind several points: no exact distribution exists.
    /// p_low, p_high, p_pattern, p_mahalanobis, p_if_… are then the largest of those for infinite ν, for uncertainties
    /// that were estimated each by itself and for one estimate behind all of them, the band is the widest, the power the
    /// smallest; and p_…_least are the smallest.
    bool is_bounded = false;
    double p_low_least = 1.0, p_high_least = 1.0, p_mahalanobis_least = 1.0;
    double vector_en = 0.0;        ///< √mahalanobis_square / k_p, k_p the factor of the joint 95.45 % region (or p)
    double ratio_reference = 0.0;  ///< rms U of the reference / rms U of the method; infinite where that is 0
    double p_if_too_small = 0.0;   ///< P(a Σζ² as small or smaller) if U of the method should be twice as large
    double p_if_too_large = 0.0;   ///< P(a Σζ² as large or larger) if U of the method should be half as large
    /// Probability that Σζ² refutes both, and neither p_low nor p_high is below 0.025, where all uncertainties are
    /// right.
    double power_to_confirm = 0.0;
    /// The power would be enough if all degrees of freedom were infinite: no more points are missing, but better known
    /// uncertainties.
    bool power_lacks_degrees = false;
    std::size_t count_by_chance = 0;  ///< limit of count_above_1 (count_above_1_by_chance())
    std::size_t family = 1;           ///< sets of points of which the gravest verdict counts
    /// Constant deviation that |E_n| > 1 finds at every single point with a probability of 80 % and 95 %:
    /// the largest of U + z u with z = 0.842 and 1.645.
    double found_with_80_percent = 0.0, found_with_95_percent = 0.0;
};

/// \param coverage_probability  of the joint region of vector_en
/// \param family  sets of points that are judged side by side, the directions of a comparison: each is held against
///                limits that right uncertainties of all of them together miss as rarely as those of one alone
/// \throws InputError  GC-GUM-0032 no points; GC-GUM-0001; GC-GUM-0031 an uncertainty of a difference is 0;
///                     GC-GUM-0052 to -0054 for the covariance, -0135 sizes that do not fit, -0141 more than
///                     k_most_points_of_agreement points
/// Directions in which V has no variance (eigenvalue of the correlation matrix below 1e-10 of the largest) are left out
/// of the Mahalanobis numbers, and the rank tells how many remain.
/// Points that do not correlate, with finite ν of their own: Σζ² is a sum of squares of independent t, exactly where
/// the ν are those of the estimates; limits of single |E_n| and deviations that are found are those of t as well.
/// \throws InputError  GC-GUM-0005 for ν
/// Accuracy: probabilities within 1e-9 (docs/accuracy.md#comparisons-and-robust-statistics).
[[nodiscard]] Agreement agreement(const MethodDifferences& differences, double coverage_probability,
                                  std::size_t family = 1);
/// 1 − (1 − p)^(1/n): with this probability each of n independent tests fails by chance where p is that of any of them
/// (Šidák).
[[nodiscard]] double chance_in_family(double chance, std::size_t family);
/// The limit that the largest |E_n| of n points exceeds with probability 1 − p at most where all uncertainties are
/// right: z(1 − p^(1/n)) / z(1 − p), z(α) the two-sided quantile of the normal distribution. 1 for one point.
///
/// It is exactly 1 − p for independent points and less for any correlation (Šidák 1967, Journal of the American
/// Statistical Association 62, 626-633). What correlated points have in common, p_high sees.
/// \param points  n ≥ 1
/// \throws InputError  GC-GUM-0032 no points; -0004 p not between 0 and 1
[[nodiscard]] double largest_en_by_chance(std::size_t points, double coverage_probability);
/// The number of |E_n| > 1 among n points that is exceeded in 1 of 100 comparisons at most where all uncertainties are
/// right: quantile of the binomial distribution of effective_points points, each above 1 with probability 1 − p, in
/// proportion. 0 for one point.
/// \param effective_points  1 … points
/// \param family  as in agreement(): 1 of 100 comparisons exceeds the limit in any of so many sets
/// \throws InputError  as largest_en_by_chance()
[[nodiscard]] std::size_t count_above_1_by_chance(std::size_t points, double effective_points,
                                                  double coverage_probability, std::size_t family = 1);
/// More points are refused: an approximation by the first two moments is wrong by many powers of ten in the lower tail.
inline constexpr std::size_t k_most_points_of_agreement = 3000;

/// Straight line D = a + b (t − t̄) through the differences by generalised least squares with their covariance.
struct BiasLine {
    double centre = 0.0;  ///< t̄, the mean of t, where `constant` holds
    double constant = 0.0, u_constant = 0.0;
    double slope = 0.0, u_slope = 0.0;
    double covariance = 0.0;                 ///< of constant and slope
    double chi_square = 0.0, p_value = 0.0;  ///< of what the line leaves, rank − 2 degrees of freedom
};

/// Generalised least squares line through the differences.
///
/// Where V is singular, directions without variance are left out: the line is unbiased and its uncertainties hold, but
/// it is not the best one.
/// \param t  m, in a unit of its own
/// \return nothing where all t are equal, there are fewer than 3 points, or the rank of V is too small for a line
/// \throws InputError  as agreement()
[[nodiscard]] std::optional<BiasLine> bias_line(const MethodDifferences& differences, const Eigen::VectorXd& t);

/// Whether chance explains the constant and the slope of a bias line.
struct BiasTest {
    int degrees_of_freedom = 0;  ///< 2; 1 where only one of both is tested
    double p = 1.0;              ///< P(a constant and slope as far from 0 or farther)
    double p_least = 1.0;        ///< where no exact distribution exists: the smallest of the bounds, and p the largest
};
/// What a bias is tested for.
struct BiasQuestion {
    bool constant = true, slope = true;
    double slope_of_noise = 0.0;  ///< that the uncertainty of the positions makes: a slope between 0 and it is none
};
/// Wald's test of the bias line. With finite ν of points that do not correlate, the normal scores of ζ have a line in t
/// fitted to them: their weights do not depend on the estimated uncertainties, which makes it exact.
/// \return nothing where there is no line, or nothing is asked
/// \throws InputError  as bias_line()
[[nodiscard]] std::optional<BiasTest> bias_test(const MethodDifferences& differences, const Eigen::VectorXd& t,
                                                const BiasQuestion& question);

/// E_n for a vector of m quantities with covariance V of the difference: √(Dᵀ V⁻¹ D) / k_p, where k_p² is the
/// p quantile of chi-square with m degrees of freedom. For m = 1 it is |E_n|.         (after JCGM 102:2011, 6.5.2)
/// \throws InputError  GC-GUM-0001, -0031 V is singular or has a variance of 0, -0052 to -0054, -0135 as above
[[nodiscard]] double vector_en(const Eigen::VectorXd& d, const Eigen::MatrixXd& covariance,
                               double coverage_probability);

/// What a comparison of methods may be said to show, strongest objection first: the first that holds is the verdict.
/// Limits of p are those of a set of points alone; of a family chance_in_family() of them.
enum class AgreementVerdict {
    /// p_high < 0.025, the largest |E_n| is above what chance makes of so many points, p_pattern < 0.01, or a bias with
    /// p < 0.01.
    disagreement,
    points_above_1,  ///< more points with |E_n| > 1 than chance explains
    joint_test_open,  ///< one of the bounds of a joint test objects, and another does not; or only rounding would have to
    correlation_unknown,          ///< agreement if both methods share nothing, and an objection for a plausible r
    reference_not_better,         ///< U of the reference ≥ U of the method: it cannot validate it
    uncertainty_too_large,        ///< p_low < 0.025
    agreement_few_points,         ///< power_to_confirm < k_least_power_to_confirm: the verdict would be one of chance
    uncertainty_not_confirmed,    ///< a U that is wrong by a factor of 2 is not refuted with 95 %: it cannot be told
    agreement_reference_limited,  ///< U_reference > U_method / 3: agreement, but much of it is the reference's
    validated,
};
/// "Validated" is a test of equivalence: both a U of the method that should be twice as large and one that should be
/// half as large must be refuted, each with an error of 5 % (the largest share of such methods that are validated).
/// It is asked for only where a right U passes it with this power, and so is validated nine times in ten together with
/// the limits on single points: that takes 13 to 15 independent points with a reference that is four times better or
/// more, and 18 with one that is three times better, because the sum of squares of fewer scatters too much.
inline constexpr double k_error_of_confirmation = 0.05;
inline constexpr double k_least_power_to_confirm = 0.92;
/// \param worst_plausible_en  largest |E_n| for the worst plausible correlation; nothing where r is known
/// \param bias  of the bias line; nothing where there is none
[[nodiscard]] AgreementVerdict agreement_verdict(const Agreement& agreement, std::optional<double> worst_plausible_en,
                                                 const std::optional<BiasTest>& bias = std::nullopt);
/// Whether single differences or their sum of squares are too large: a disagreement for no other reason is one of a
/// pattern or of a bias.
[[nodiscard]] bool is_too_large(const Agreement& agreement);
/// Whether p_pattern refutes the covariance.
[[nodiscard]] bool is_refuted_pattern(const Agreement& agreement);
/// Of p of a bias line and of p_pattern: they stand beside p_high, and 1 of 100 comparisons fails each by chance.
inline constexpr double k_chance_of_bias_and_pattern = 0.01;
/// Of p_low and p_high.
inline constexpr double k_chance_of_size = 0.025;

}  // namespace gumcert::gum
