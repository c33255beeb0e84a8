#include "gum/analysis_of_variance.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "gum/argument_check.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {

// Sums of squares are formed from deviations about means, in two passes, never as Σ x² − n x̄² and never as a
// difference of two others: the total is the sum of its parts. A small effect beside large ones, or a scatter of the
// last digits beside a large value, keeps its digits so.
// Why mean squares are compared and subtracted as they are, for I groups of J subgroups of K readings. Their
// expectations:
// within σ_w², between subgroups σ_w² + K σ_s², between groups σ_w² + K σ_s² + J K σ_g².
// Each line holds all that lies below it. It is tested against the next one, and a variance is the difference of two
// lines, which chance can make negative: then it is 0, and said so.

namespace {

// 64 bits of mantissa on x86-64. Differences of observations of similar size about a common centre are exact in it.
using Real = long double;

// An overflow is reported as our own failure, not as an exception of the library. In double throughout: elementary
// functions of long double differ between makers of processors (ADR 0058).
using FPolicy =
    boost::math::policies::policy<boost::math::policies::promote_double<false>,
                                  boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;
using FDistribution = boost::math::fisher_f_distribution<double, FPolicy>;

/// Observations that belong together, about a centre that all groups share.
struct Sample {
    Real size = 0.0L;
    Real mean = 0.0L;            // less the centre
    Real sum_of_squares = 0.0L;  // about the mean
};

Sample sample_of(const std::vector<double>& values, Real centre) {
    Sample sample;
    sample.size = static_cast<Real>(values.size());
    for (const double value : values) {
        sample.mean += (static_cast<Real>(value) - centre) / sample.size;
    }
    Real rest = 0.0L;
    for (const double value : values) {
        const Real deviation = (static_cast<Real>(value) - centre) - sample.mean;
        sample.sum_of_squares += deviation * deviation;
        rest += deviation;
    }
    // What the rounding of the mean leaves is moved into it.
    sample.mean += rest / sample.size;
    sample.sum_of_squares = std::max(sample.sum_of_squares - rest * rest / sample.size, 0.0L);
    return sample;
}

/// Σ n_j (m_j − m)² and m, for samples about one centre.
Sample pooled_of(std::span<const Sample> samples) {
    Sample pooled;
    for (const Sample& sample : samples) {
        // Samples carry their size: of groups of different sizes each observation counts the same, not each group.
        pooled.size += sample.size;
    }
    for (const Sample& sample : samples) {
        pooled.mean += sample.size / pooled.size * sample.mean;
    }
    Real rest = 0.0L;
    for (const Sample& sample : samples) {
        const Real deviation = sample.mean - pooled.mean;
        pooled.sum_of_squares += sample.size * deviation * deviation;
        rest += sample.size * deviation;
    }
    pooled.mean += rest / pooled.size;
    pooled.sum_of_squares = std::max(pooled.sum_of_squares - rest * rest / pooled.size, 0.0L);
    return pooled;
}

/// A line with its mean square before rounding.
struct ExactLine {
    Real sum_of_squares = 0.0L;
    Real degrees_of_freedom = 0.0L;

    [[nodiscard]] Real mean_square() const { return sum_of_squares / degrees_of_freedom; }
    [[nodiscard]] VarianceLine rounded() const {
        return {.sum_of_squares = static_cast<double>(sum_of_squares),
                .degrees_of_freedom = static_cast<double>(degrees_of_freedom),
                .mean_square = static_cast<double>(mean_square())};
    }
};

[[noreturn]] void refuse_without_variation(const std::string& what) {
    throw NoResultError(Diagnostic{.code = "GC-GUM-0073",
                                   .where = "analysis of variance",
                                   .what = what,
                                   .rule = "variances are compared by their ratio",
                                   .action = "Give observations of a finer resolution, in a unit near their size."});
}

VarianceRatio ratio_of(const ExactLine& upper, const ExactLine& lower, double alpha) {
    VarianceRatio ratio;
    ratio.numerator_degrees_of_freedom = static_cast<double>(upper.degrees_of_freedom);
    ratio.denominator_degrees_of_freedom = static_cast<double>(lower.degrees_of_freedom);
    // The lower line is the measure of what chance does. It may be 0 where readings are rounded to a coarse step and
    // all readings of a group are equal.
    if (lower.mean_square() > 0.0L) {
        ratio.f = static_cast<double>(upper.mean_square() / lower.mean_square());
    } else {
        // Neither varies: no effect is seen. Only the upper one varies: it exceeds any limit.
        ratio.f = upper.mean_square() > 0.0L ? std::numeric_limits<double>::infinity() : 0.0;
    }
    ratio.p_value = f_upper_tail(ratio.f, ratio.numerator_degrees_of_freedom, ratio.denominator_degrees_of_freedom);
    // 1 − α is rounded; the tail keeps the digits of a small α.
    ratio.critical_value = boost::math::quantile(boost::math::complement(
        FDistribution(ratio.numerator_degrees_of_freedom, ratio.denominator_degrees_of_freedom), alpha));
    ratio.significant = ratio.f > ratio.critical_value;
    return ratio;
}

Real root_of_square(Real square) {
    return std::sqrt(std::max(square, 0.0L));
}

void require_groups(std::size_t groups) {
    if (groups < 2) {
        refuse("GC-GUM-0070", "analysis of variance", text::count_of(groups, "group"),
               "groups are compared with each other: at least 2 are needed", "Give more groups.");
    }
}

[[noreturn]] void refuse_empty_group(std::size_t group) {
    refuse("GC-GUM-0071", "group " + std::to_string(group), "no observations", "a group needs at least 1 observation",
           "Leave out the group, or give its observations.");
}

OneWayAnalysis analyse(std::span<const Sample> samples, Real centre, double alpha) {
    const auto j = static_cast<Real>(samples.size());
    const Sample pooled = pooled_of(samples);
    const Real n = pooled.size;
    // J groups of one reading each leave N − J = 0 degrees of freedom: there is no scatter within them to test against.
    if (!(n > j)) {
        refuse("GC-GUM-0072", "analysis of variance", "every group has a single observation",
               "the scatter within groups is needed to judge the scatter between them",
               "Give at least one group with 2 observations.");
    }
    ExactLine between{.sum_of_squares = pooled.sum_of_squares, .degrees_of_freedom = j - 1.0L};
    ExactLine within{.sum_of_squares = 0.0L, .degrees_of_freedom = n - j};
    Real mean_of_means = 0.0L;
    Real squared_sizes = 0.0L;
    for (const Sample& sample : samples) {
        within.sum_of_squares += sample.sum_of_squares;
        // Two means: of groups of different sizes, the one that counts groups belongs to an effect between them, the
        // other one to none.
        mean_of_means += sample.mean / j;
        squared_sizes += sample.size * sample.size;
    }
    Real spread_of_means = 0.0L;
    // Each group counts once here, whatever its size: with an effect between groups it is the groups that are the
    // sample, and J − 1 the degrees of freedom. Of balanced groups it is √(MS_between / K).
    for (const Sample& sample : samples) {
        spread_of_means += (sample.mean - mean_of_means) * (sample.mean - mean_of_means);
    }
    const ExactLine total{.sum_of_squares = between.sum_of_squares + within.sum_of_squares,
                          .degrees_of_freedom = n - 1.0L};
    if (!std::isfinite(static_cast<double>(total.sum_of_squares))) {
        refuse_without_variation("sums of squares leave the range of numbers");
    }
    if (!(static_cast<double>(total.sum_of_squares) > 0.0)) {
        refuse_without_variation("no observation differs from another");
    }

    OneWayAnalysis result;
    for (const Sample& sample : samples) {
        result.groups.push_back(
            {.observations = static_cast<std::size_t>(sample.size),
             .mean = static_cast<double>(centre + sample.mean),
             .standard_deviation =
                 sample.size > 1.0L ? static_cast<double>(root_of_square(sample.sum_of_squares / (sample.size - 1.0L)))
                                    : 0.0});
    }
    result.observations = static_cast<std::size_t>(n);
    result.balanced = std::all_of(samples.begin(), samples.end(), [&](const Sample& sample) {
        return static_cast<std::size_t>(sample.size) == result.groups.front().observations;
    });
    result.between = between.rounded();
    result.within = within.rounded();
    result.total = total.rounded();
    result.ratio = ratio_of(between, within, alpha);
    result.r_squared = static_cast<double>(between.sum_of_squares / total.sum_of_squares);
    result.mean = static_cast<double>(centre + pooled.mean);
    result.mean_of_group_means = static_cast<double>(centre + mean_of_means);
    // With an effect between groups, more readings in a group do not make the mean better known: only the J group means
    // are independent of each other. Dividing by √N there would understate u.
    const Real of_means = root_of_square(spread_of_means / (j - 1.0L));
    result.standard_deviation_of_group_means = static_cast<double>(of_means);
    result.between_estimate = static_cast<double>(root_of_square(between.mean_square()));
    result.within_standard_deviation = static_cast<double>(root_of_square(within.mean_square()));
    // Of groups of one size it is that size.
    // E(MS_between) = σ_w² + n₀ σ_B².
    const Real effective_size = (n - squared_sizes / n) / (j - 1.0L);
    result.between_variance_clipped = between.mean_square() < within.mean_square();
    result.between_standard_deviation =
        static_cast<double>(root_of_square((between.mean_square() - within.mean_square()) / effective_size));
    result.u_with_between_effect = static_cast<double>(of_means / std::sqrt(j));
    result.u_with_between_effect_degrees_of_freedom = static_cast<double>(j - 1.0L);
    // Without an effect all N readings are one sample: the total line, with N − 1 degrees of freedom, is the best
    // estimate of its variance.
    result.u_without_between_effect = static_cast<double>(root_of_square(total.mean_square() / n));
    result.u_without_between_effect_degrees_of_freedom = static_cast<double>(n - 1.0L);
    return result;
}

void require_f_degrees(double numerator, double denominator) {
    require_positive(numerator, "degrees of freedom of the numerator of F");
    require_positive(denominator, "degrees of freedom of the denominator of F");
}

}  // namespace

OneWayAnalysis one_way_analysis(std::span<const std::vector<double>> groups, double alpha) {
    require_probability(alpha, "alpha");
    require_groups(groups.size());
    for (std::size_t j = 0; j < groups.size(); ++j) {
        if (groups[j].empty()) {
            refuse_empty_group(j + 1);
        }
        for (std::size_t k = 0; k < groups[j].size(); ++k) {
            require_finite(groups[j][k], "group " + std::to_string(j + 1) + ", observation " + std::to_string(k + 1));
        }
    }
    // One observation is as good a centre as any. It takes off the digits that all have in common without rounding.
    const Real centre = groups[0][0];
    std::vector<Sample> samples;
    for (const std::vector<double>& group : groups) {
        samples.push_back(sample_of(group, centre));
    }
    return analyse(samples, centre, alpha);
}

OneWayAnalysis one_way_analysis(std::span<const ObservationGroup> groups, double alpha) {
    require_probability(alpha, "alpha");
    require_groups(groups.size());
    const Real centre = groups[0].mean;
    std::vector<Sample> samples;
    for (std::size_t j = 0; j < groups.size(); ++j) {
        const ObservationGroup& group = groups[j];
        const std::string name = "group " + std::to_string(j + 1);
        if (group.observations == 0) {
            refuse_empty_group(j + 1);
        }
        require_finite(group.mean, name + ", mean");
        require_not_negative(group.standard_deviation, name + ", standard deviation");
        // s² = SS/(n − 1), the other way round.
        const Real s = group.standard_deviation;
        const auto size = static_cast<Real>(group.observations);
        samples.push_back(
            {.size = size, .mean = static_cast<Real>(group.mean) - centre, .sum_of_squares = (size - 1.0L) * s * s});
    }
    return analyse(samples, centre, alpha);
}

NestedAnalysis nested_analysis(std::span<const std::vector<std::vector<double>>> readings, double alpha) {
    require_probability(alpha, "alpha");
    NestedAnalysis result;
    result.groups = readings.size();
    result.subgroups = readings.empty() ? 0 : readings[0].size();
    result.readings = result.subgroups == 0 ? 0 : readings[0][0].size();
    // The expectations of the mean squares, on which the tests and the differences rest, are those of equal numbers.
    bool even = true;
    for (const auto& group : readings) {
        even = even && group.size() == result.subgroups;
        for (const std::vector<double>& subgroup : group) {
            even = even && subgroup.size() == result.readings;
        }
    }
    if (!even || result.groups < 2 || result.subgroups < 2 || result.readings < 2) {
        refuse("GC-GUM-0074", "nested analysis of variance",
               even ? text::count_of(result.groups, "group") + " of " + std::to_string(result.subgroups) +
                          " subgroups of " + std::to_string(result.readings) + " readings"
                    : "groups or subgroups of different sizes",
               "needs at least 2 groups of at least 2 subgroups of at least 2 readings, the same number in each",
               "Complete the design, or take the means of subgroups and analyse these one-way.");
    }
    for (std::size_t i = 0; i < readings.size(); ++i) {
        for (std::size_t j = 0; j < readings[i].size(); ++j) {
            for (const double value : readings[i][j]) {
                require_finite(value, "group " + std::to_string(i + 1) + ", subgroup " + std::to_string(j + 1));
            }
        }
    }

    const Real centre = readings[0][0][0];
    const auto i_count = static_cast<Real>(result.groups);
    const auto j_count = static_cast<Real>(result.subgroups);
    const auto k_count = static_cast<Real>(result.readings);
    ExactLine groups{.sum_of_squares = 0.0L, .degrees_of_freedom = i_count - 1.0L};
    ExactLine subgroups{.sum_of_squares = 0.0L, .degrees_of_freedom = i_count * (j_count - 1.0L)};
    ExactLine within{.sum_of_squares = 0.0L, .degrees_of_freedom = i_count * j_count * (k_count - 1.0L)};
    std::vector<Sample> group_samples;
    for (const auto& group : readings) {
        std::vector<Sample> samples;
        for (const std::vector<double>& subgroup : group) {
            samples.push_back(sample_of(subgroup, centre));
            within.sum_of_squares += samples.back().sum_of_squares;
        }
        group_samples.push_back(pooled_of(samples));
        subgroups.sum_of_squares += group_samples.back().sum_of_squares;
    }
    const Sample pooled = pooled_of(group_samples);
    // The groups are compared by their means about the mean of all: J K readings stand behind each, which pooled_of()
    // puts into the sum of squares.
    groups.sum_of_squares = pooled.sum_of_squares;
    const auto total = static_cast<double>(groups.sum_of_squares + subgroups.sum_of_squares + within.sum_of_squares);
    if (!std::isfinite(total)) {
        refuse_without_variation("sums of squares leave the range of numbers");
    }
    if (!(total > 0.0)) {
        refuse_without_variation("no reading differs from another");
    }

    result.mean = static_cast<double>(centre + pooled.mean);
    result.between_groups = groups.rounded();
    result.between_subgroups = subgroups.rounded();
    // Days are tested against set-ups, not against readings: set-ups that differ would make days look different, too.
    result.within_subgroups = within.rounded();
    result.group_ratio = ratio_of(groups, subgroups, alpha);
    result.subgroup_ratio = ratio_of(subgroups, within, alpha);
    const Real of_groups = groups.mean_square();
    const Real of_subgroups = subgroups.mean_square();
    const Real of_readings = within.mean_square();
    result.within_standard_deviation = static_cast<double>(root_of_square(of_readings));
    result.between_subgroup_standard_deviation =
        static_cast<double>(root_of_square((of_subgroups - of_readings) / k_count));
    result.between_group_standard_deviation =
        static_cast<double>(root_of_square((of_groups - of_subgroups) / (j_count * k_count)));
    result.between_subgroup_variance_clipped = of_subgroups < of_readings;
    result.between_group_variance_clipped = of_groups < of_subgroups;
    // σ_g²/I + σ_s²/(I J) + σ_w²/(I J K) is the expectation of MS_groups divided by I J K: no single variance is
    // needed.
    result.u_of_mean = static_cast<double>(root_of_square(of_groups / (i_count * j_count * k_count)));
    return result;
}

double f_upper_tail(double f, double numerator_degrees_of_freedom, double denominator_degrees_of_freedom) {
    const bool is_known = denominator_degrees_of_freedom == std::numeric_limits<double>::infinity();
    require_f_degrees(numerator_degrees_of_freedom, is_known ? 1.0 : denominator_degrees_of_freedom);
    if (f == std::numeric_limits<double>::infinity()) {
        return 0.0;
    }
    require_not_negative(f, "F");
    // Lower variance known: ν₁ F is χ² with ν₁ degrees of freedom.
    if (is_known) {
        return chi_square_upper_tail(numerator_degrees_of_freedom * f, numerator_degrees_of_freedom);
    }
    return boost::math::cdf(
        boost::math::complement(FDistribution(numerator_degrees_of_freedom, denominator_degrees_of_freedom), f));
}

double f_critical_value(double probability, double numerator_degrees_of_freedom,
                        double denominator_degrees_of_freedom) {
    require_probability(probability, "probability");
    require_f_degrees(numerator_degrees_of_freedom, denominator_degrees_of_freedom);
    double critical = std::numeric_limits<double>::infinity();
    try {
        critical = boost::math::quantile(FDistribution(numerator_degrees_of_freedom, denominator_degrees_of_freedom),
                                         probability);
    } catch (const std::runtime_error&) {
        // The iteration of the library did not end: the same refusal as for an overflow.
    }
    if (!std::isfinite(critical)) {
        throw NoResultError(Diagnostic{.code = "GC-GUM-0010",
                                       .where = "critical value of F",
                                       .what = "no finite value for probability " + text::shortest(probability) + ", " +
                                               text::shortest(numerator_degrees_of_freedom) + " and " +
                                               text::shortest(denominator_degrees_of_freedom) + " degrees of freedom",
                                       .rule = "a test needs a finite critical value",
                                       .action = "Choose a probability that is farther from 1."});
    }
    return critical;
}

}  // namespace gumcert::gum
