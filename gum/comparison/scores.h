#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace gumcert::gum {

/// One side of a comparison at one point. All members are in the same unit, the same as on the other side.
struct ComparedValue {
    double value = 0.0;
    double standard_uncertainty = 0.0;  ///< u ≥ 0
    double expanded_uncertainty = 0.0;  ///< U ≥ 0, for a coverage probability of about 95 %
};

/// Scores of one point.
struct ComparisonScore {
    double difference = 0.0;    ///< D = x − X, laboratory minus reference
    double u_difference = 0.0;  ///< standard uncertainty of D
    double U_difference = 0.0;  ///< expanded uncertainty of D: also D_fail, the smallest |D| that fails
    double en = 0.0;            ///< E_n = D / U_difference, [1]
    double zeta = 0.0;          ///< ζ = D / u_difference, [1]
};

/// Uncertainty of a difference x − X of two quantities with correlation r.
///
/// √(u_x² + u_X² − 2 r u_x u_X)                                        (JCGM 100:2008, 5.2.2; u or U alike)
/// \param correlation  r, −1 ≤ r ≤ 1
/// \return never negative, in the unit of the uncertainties; 0 only for r = 1 with equal uncertainties, or both 0
/// \throws InputError  GC-GUM-0001, -0002 for an uncertainty, GC-GUM-0030 for r out of range
[[nodiscard]] double uncertainty_of_difference(double laboratory, double reference, double correlation = 0.0);

/// Expanded uncertainty of a difference of two quantities with correlation r, from both U.
///
/// √(U_x² + U_X² − 2 r U_x U_X), as E_n is defined. Where r is not 0 and the factors U/u of both sides differ by more
/// than k_same_coverage_factor, this is no multiple of the standard uncertainty of the difference that lies between both
/// factors: of what both sides share one part would count with one factor and one with the other. u_D √(ΣU²/Σu²) then,
/// which is the same where r is 0.
/// \throws InputError  as uncertainty_of_difference()
[[nodiscard]] double expanded_uncertainty_of_difference(const ComparedValue& laboratory, const ComparedValue& reference,
                                                        double correlation);
/// Whether two coverage factors U/u differ by more than k_same_coverage_factor; factors of u = 0 do not.
[[nodiscard]] bool have_different_factors(const ComparedValue& first, const ComparedValue& second);

/// (value − reference) / scale as a score. A score that is ±1, ±2 or ±3 but for the rounding of binary numbers is that
/// limit: 10.2 − 10 over 0.1 is 2, which double precision makes 1.999999999999993. All scores below are settled so.
/// \param value, reference  as stated, whose rounding is meant
/// \param scale             > 0, in their unit
/// \param reference_rest    what the reference has beyond `reference`, a part of its last binary digit: SplitNumber
/// \throws InputError  GC-GUM-0001, GC-GUM-0003 for the scale
[[nodiscard]] double settled_score(double value, double reference, double scale, double reference_rest = 0.0);

/// E_n number and ζ-score of a laboratory value against a reference value (ISO 13528:2022; ISO/IEC 17043 for E_n).
///
/// E_n = D / √(U_x² + U_X² − 2 r U_x U_X), see expanded_uncertainty_of_difference(),  ζ = D / √(u_x² + u_X² − 2 r u_x u_X)
/// \param correlation  r between x and X; not 0 where both depend on the same standard, sensor or artefact
/// \throws InputError  for a number that is not finite, a negative uncertainty, r outside [−1, 1] (GC-GUM-0030), or an
///                     uncertainty of the difference that is 0 (GC-GUM-0031): no score exists then
/// Accuracy: relative error below 1e-12; a score that is a limit but for rounding is that limit
/// (docs/accuracy.md#comparisons-and-robust-statistics).
/// Example: examples/api/proficiency_test.cpp
/// |E_n| ≤ 1 says only that |D| is not larger than its expanded uncertainty. An uncertainty stated too large always
/// passes, and a reference with U_X ≥ U_x validates nothing.
[[nodiscard]] ComparisonScore score(const ComparedValue& laboratory, const ComparedValue& reference,
                                    double correlation = 0.0);

/// E_n and ζ of a difference whose uncertainties are known: the one place that forms them, settled.
/// \return nothing where an uncertainty of the difference is not greater than 0: no score exists then
/// \throws InputError  for a number that is not finite
[[nodiscard]] std::optional<ComparisonScore> score_of_difference(double value, double reference, double u_difference,
                                                                 double U_difference, double reference_rest = 0.0);

/// E_n with all that the smaller uncertainty can hold in common: r = min(U_x, U_X) / max(U_x, U_X), the correlation
/// where the whole of the smaller uncertainty comes from a source that both sides share with unit sensitivity. Where
/// both methods may share a standard and nobody knows, E_n lies between this one and that for r = 0.
/// E_n = D / √|U_x² − U_X²|
/// \throws InputError  as score()
/// \return nothing where the two uncertainties are equal: then no finite E_n bounds what a shared source can do
[[nodiscard]] std::optional<double> worst_plausible_en(const ComparedValue& laboratory, const ComparedValue& reference);

/// z = (x − X) / σ_pt.                                                                 (ISO 13528:2022, clause 9)
/// \throws InputError  GC-GUM-0001, GC-GUM-0003 for σ_pt
[[nodiscard]] double z_score(double value, double assigned_value, double sigma_pt, double assigned_rest = 0.0);
/// z' = (x − X) / √(σ_pt² + u²(X)).                                                    (ISO 13528:2022, clause 9)
[[nodiscard]] double z_prime_score(double value, double assigned_value, double sigma_pt, double u_assigned_value,
                                   double assigned_rest = 0.0);
/// D% = 100 (x − X) / |X|; nothing where X is 0. Only for quantities on a ratio scale.
/// \throws InputError  GC-GUM-0001
[[nodiscard]] std::optional<double> percent_difference(double value, double assigned_value, double assigned_rest = 0.0);
/// P_A = 100 (x − X) / δ_E, D as percentage of the largest error allowed.
/// \throws InputError  GC-GUM-0001, GC-GUM-0003 for δ_E
[[nodiscard]] double percent_of_allowed(double value, double assigned_value, double largest_allowed,
                                        double assigned_rest = 0.0);

/// An expanded uncertainty as E_n takes it. E_n is defined for about 95 % on both sides, and two factors that mean
/// different probabilities must not meet in it.
struct EnUncertainty {
    double U = 0.0;
    double k = 2.0;
    bool converted = false;  ///< U = t_p(ν) u in place of the one that was stated
};
/// U as stated where its factor is t_p(ν) within k_same_coverage_factor, so that k = 2 stands for 95 % as for 95.45 %.
/// \param coverage_probability  of the comparison; see en_coverage_probability()
/// \throws InputError  GC-GUM-0001, -0002, -0003 for k; those of coverage_factor()
[[nodiscard]] EnUncertainty en_uncertainty(double u, double U, double k, double degrees_of_freedom,
                                           double coverage_probability);
inline constexpr double k_same_coverage_factor = 0.025;
/// The probability p of E_n: that of the comparison where it is about 95 % (0.94 to 0.96), else 0.9545.
[[nodiscard]] double en_coverage_probability(double coverage_probability);

/// The normal quantity with the same two-sided tail and sign as a t with ν degrees of freedom.
/// \throws InputError  GC-GUM-0001; those of two_sided_tail_of_t()
[[nodiscard]] double normal_score(double t, double degrees_of_freedom);

/// What a score calls for: |z|, |z'| and |ζ| warn above 2 and act from 3 (2.0 is acceptable, 3.0 is not); |E_n| acts
/// above 1 and |D| above δ_E.
enum class Signal { none, warning, action };
[[nodiscard]] Signal signal_of_z(double score);
[[nodiscard]] Signal signal_of_en(double score);

/// Counts and sizes of |E_n|.
struct EnVariant {
    std::size_t count_above_1 = 0;
    double mean_absolute_en = 0.0, largest_absolute_en = 0.0;
};

/// Companion numbers of the scores of several points.
struct ComparisonSummary {
    std::size_t points = 0;         ///< m
    std::size_t count_above_1 = 0;  ///< points with |E_n| > 1
    double mean_absolute_en = 0.0;
    double largest_absolute_en = 0.0;
    double rms_en = 0.0;               ///< √(Σ E_n² / m); about 0.5 where uncertainties are right and k = 2
    double sum_of_squared_zeta = 0.0;  ///< Σ ζ²
    double p_low = 0.0;                ///< P(χ²_m ≤ Σ ζ²); small: uncertainties too large, or points correlated
    double p_high = 0.0;               ///< P(χ²_m ≥ Σ ζ²); small: uncertainties too small
};

/// \throws InputError  GC-GUM-0032 for no points; GC-GUM-0001 for a score that is not finite
/// p_low and p_high hold for points that are independent of each other. Points measured with one set-up share effects
/// and are not so many independent proofs.
[[nodiscard]] ComparisonSummary summarise(std::span<const ComparisonScore> scores);

}  // namespace gumcert::gum
