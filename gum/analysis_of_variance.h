#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace gumcert::gum {

/// One line of a table of analysis of variance.
struct VarianceLine {
    double sum_of_squares = 0.0;      ///< [unit²]
    double degrees_of_freedom = 0.0;  ///< > 0
    double mean_square = 0.0;         ///< sum_of_squares / degrees_of_freedom, [unit²]
};

/// Ratio of two mean squares and what it says. Under the hypothesis of no effect F follows Snedecor's distribution.
struct VarianceRatio {
    double f = 0.0;               ///< infinite where the lower mean square is 0
    double p_value = 0.0;         ///< P(F ≥ f) without an effect
    double critical_value = 0.0;  ///< F_{1−α}
    double numerator_degrees_of_freedom = 0.0;
    double denominator_degrees_of_freedom = 0.0;
    bool significant = false;  ///< f > critical_value: the effect is taken to exist
};

/// A group of observations, as far as an analysis of variance needs it.
struct ObservationGroup {
    std::size_t observations = 0;     ///< n_j ≥ 1
    double mean = 0.0;                ///< V̄_j
    double standard_deviation = 0.0;  ///< s_j of one observation; 0 with a single one
};

/// One-way analysis of variance of J groups, and the two evaluations of the uncertainty of the mean that it decides
/// between (JCGM 100:2008, H.5). Units: that of the observations, or its square.
struct OneWayAnalysis {
    std::vector<ObservationGroup> groups;  ///< in the order given
    std::size_t observations = 0;          ///< N = Σ n_j
    bool balanced = false;                 ///< all n_j equal

    VarianceLine between;    ///< J − 1 degrees of freedom
    VarianceLine within;     ///< N − J
    VarianceLine total;      ///< N − 1
    VarianceRatio ratio;     ///< between over within
    double r_squared = 0.0;  ///< between sum of squares over total; 0 where nothing varies

    double mean = 0.0;                 ///< of all observations, each counting the same
    double mean_of_group_means = 0.0;  ///< each group counting the same; equal to mean when balanced
    /// s(V̄_j), of the group means about their mean, each group counting the same. Its square times K is the estimate of
    /// the within variance "a" of the GUM when balanced, J − 1 degrees of freedom.
    double standard_deviation_of_group_means = 0.0;
    /// √(between mean square): √K s(V̄_j) when balanced, s_a of H.5.2.2.
    double between_estimate = 0.0;
    /// s_pooled = √(within mean square), s_b of H.5.2.2: one observation within a group (repeatability).
    double within_standard_deviation = 0.0;
    /// s_B, between groups, beside what the scatter within them explains: s_B² = (MS_between − MS_within) / n₀, not
    /// less than 0, with n₀ = (N − Σ n_j²/N) / (J − 1), which is K when balanced.
    double between_standard_deviation = 0.0;
    bool between_variance_clipped = false;  ///< MS_between < MS_within: s_B was set to 0

    /// u of the mean where an effect between groups exists: s(V̄_j)/√J, J − 1 degrees of freedom. It belongs to
    /// mean_of_group_means.
    double u_with_between_effect = 0.0;
    double u_with_between_effect_degrees_of_freedom = 0.0;
    /// u of the mean where none exists: all observations are one sample, √(total mean square / N), N − 1 degrees of
    /// freedom. It belongs to mean.
    double u_without_between_effect = 0.0;
    double u_without_between_effect_degrees_of_freedom = 0.0;
};

/// \name One-way analysis of variance
/// Between: Σ n_j (V̄_j − V̄)²; within: Σ_j Σ_k (V_jk − V̄_j)²                          (JCGM 100:2008, H.5.2; balanced
/// there)
/// \param alpha  probability of finding an effect where there is none, 0 < α < 1, e.g. 0.05
/// \throws InputError GC-GUM-0001, -0002, -0004; GC-GUM-0070 fewer than two groups, -0071 a group without observations,
///     -0072 no group with two observations
/// \throws NoResultError  GC-GUM-0073 nothing varies, or squares leave the range of numbers
/// Valid for observations that are independent and of one dispersion within the groups; normal for the p-value.
/// Accuracy: two passes in long double about a common centre; 15 digits of the observations in, and what their rounding
/// to double leaves, out (docs/accuracy.md#analysis-of-variance).
/// Example: examples/api/observations.cpp
/// @{

/// From the observations, V_jk; groups may differ in size.
[[nodiscard]] OneWayAnalysis one_way_analysis(std::span<const std::vector<double>> groups, double alpha = 0.05);

/// From means, standard deviations and sizes of the groups, as a paper prints them.
[[nodiscard]] OneWayAnalysis one_way_analysis(std::span<const ObservationGroup> groups, double alpha = 0.05);
/// @}

/// Balanced two-stage nested design: I groups (days) of J subgroups (set-ups) of K readings.
struct NestedAnalysis {
    std::size_t groups = 0;     ///< I
    std::size_t subgroups = 0;  ///< J, in each group
    std::size_t readings = 0;   ///< K, in each subgroup
    double mean = 0.0;

    VarianceLine between_groups;     ///< I − 1 degrees of freedom
    VarianceLine between_subgroups;  ///< within groups, I (J − 1)
    VarianceLine within_subgroups;   ///< I J (K − 1)
    VarianceRatio group_ratio;       ///< between groups over between subgroups
    VarianceRatio subgroup_ratio;    ///< between subgroups over within subgroups

    double within_standard_deviation = 0.0;            ///< of one reading, √MS_within
    double between_subgroup_standard_deviation = 0.0;  ///< √((MS_subgroups − MS_within) / K), not less than 0
    double between_group_standard_deviation = 0.0;     ///< √((MS_groups − MS_subgroups) / (J K)), not less than 0
    bool between_subgroup_variance_clipped = false;
    bool between_group_variance_clipped = false;

    /// √(MS_groups / (I J K)): standard deviation of the mean of all readings, whatever effects exist; I − 1 degrees of
    /// freedom.
    double u_of_mean = 0.0;
};

/// \param readings  [group][subgroup][reading], all of one shape, I ≥ 2, J ≥ 2, K ≥ 2
/// \param alpha     as above
/// \throws InputError  GC-GUM-0001, -0004; GC-GUM-0074 shape
/// \throws NoResultError  GC-GUM-0073
[[nodiscard]] NestedAnalysis nested_analysis(std::span<const std::vector<std::vector<double>>> readings,
                                             double alpha = 0.05);

/// P(F ≥ f) of Snedecor's F distribution.
/// \param f  ≥ 0; infinity gives 0
/// \param numerator_degrees_of_freedom    > 0, finite
/// \param denominator_degrees_of_freedom  > 0; infinity, as of a known variance, leaves chi-square over its degrees
/// \throws InputError  for an argument out of range
[[nodiscard]] double f_upper_tail(double f, double numerator_degrees_of_freedom, double denominator_degrees_of_freedom);

/// c with P(F ≤ c) = p, the critical value of a one-sided test at α = 1 − p.
/// \param probability  p, 0 < p < 1, e.g. 0.95
/// \throws InputError  for an argument out of range
/// \throws NoResultError  GC-GUM-0010 if c is too large to be represented
[[nodiscard]] double f_critical_value(double probability, double numerator_degrees_of_freedom,
                                      double denominator_degrees_of_freedom);

}  // namespace gumcert::gum
