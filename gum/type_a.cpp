#include "gum/type_a.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "gum/argument_check.h"
#include "gum/quantity/diagnostic.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

// 64 bits of mantissa on x86-64: observations that agree in 7 digits and vary in the 8th keep theirs.
using Real = long double;

/// Sum that carries what each addition loses (Neumaier).
class Sum {
public:
    void add(Real value) {
        const Real next = sum_ + value;
        // What is lost is taken from the smaller of the two, whichever it is. Kahan's sum assumes that the sum is the
        // larger one, and fails where a term exceeds it.
        lost_ += std::abs(sum_) >= std::abs(value) ? (sum_ - next) + value : (value - next) + sum_;
        sum_ = next;
    }
    [[nodiscard]] Real value() const { return sum_ + lost_; }

private:
    Real sum_ = 0.0L;
    Real lost_ = 0.0L;
};

Real mean_of(std::span<const double> values) {
    // About the first observation: a large common value is taken off without rounding.
    const Real origin = values.front();
    Sum sum;
    for (const double value : values) {
        sum.add(static_cast<Real>(value) - origin);
    }
    return origin + sum.value() / static_cast<Real>(values.size());
}

/// Σ (x_k − x̄)(x_{k+lag} − x̄)
Real lagged_sum(std::span<const double> values, Real mean, std::size_t lag) {
    Sum sum;
    for (std::size_t k = 0; k + lag < values.size(); ++k) {
        sum.add((static_cast<Real>(values[k]) - mean) * (static_cast<Real>(values[k + lag]) - mean));
    }
    return sum.value();
}

/// Σ (x_k − x̄)², corrected for the rounding of the mean.
Real sum_of_squares(std::span<const double> values, Real mean) {
    Sum rest;
    for (const double value : values) {
        rest.add(static_cast<Real>(value) - mean);
    }
    return lagged_sum(values, mean, 0) - rest.value() * rest.value() / static_cast<Real>(values.size());
}

void require_series(std::span<const double> observations) {
    if (observations.size() < 2) {
        refuse("GC-GUM-0021", "observations", std::to_string(observations.size()),
               "a standard deviation needs at least 2 observations",
               "Give more observations, or state the uncertainty as a Type B evaluation.");
    }
    for (std::size_t k = 0; k < observations.size(); ++k) {
        require_finite(observations[k], "observation " + std::to_string(k + 1));
    }
}

}  // namespace

double u_of_mean(double standard_deviation, std::size_t observations) {
    require_not_negative(standard_deviation, "standard deviation");
    if (observations == 0) {
        refuse("GC-GUM-0020", "number of observations", "0", "a mean needs at least 1 observation",
               "Give the observations, or state the uncertainty as a Type B evaluation.");
    }
    return standard_deviation / std::sqrt(static_cast<double>(observations));
}

ObservationSummary evaluate_type_a(std::span<const double> observations) {
    require_series(observations);
    const auto n = static_cast<Real>(observations.size());
    const Real mean = mean_of(observations);
    // JCGM 100:2008, 4.2.2 with n − 1; rounded to double only at the end, so that s and s/√n belong to one number.
    const Real s = std::sqrt(std::max(sum_of_squares(observations, mean), 0.0L) / (n - 1.0L));
    ObservationSummary summary;
    summary.observations = observations.size();
    summary.mean = static_cast<double>(mean);
    summary.standard_deviation = static_cast<double>(s);
    summary.standard_deviation_of_mean = static_cast<double>(s / std::sqrt(n));
    summary.degrees_of_freedom = static_cast<double>(n - 1.0L);
    if (!std::isfinite(summary.mean) || !std::isfinite(summary.standard_deviation)) {
        throw NoResultError(Diagnostic{.code = "GC-GUM-0027",
                                       .where = "observations",
                                       .what = "mean or standard deviation is not finite",
                                       .rule = "an estimate is a finite number",
                                       .action = "State the observations in a unit nearer to their size."});
    }
    return summary;
}

std::vector<double> autocorrelation(std::span<const double> observations, std::size_t largest_lag) {
    require_series(observations);
    if (largest_lag >= observations.size()) {
        refuse("GC-GUM-0022", "lag", std::to_string(largest_lag),
               "must be less than the number of observations, " + std::to_string(observations.size()),
               "Ask for a smaller lag.");
    }
    const Real mean = mean_of(observations);
    const Real whole = lagged_sum(observations, mean, 0);
    if (!(whole > 0.0L)) {
        refuse("GC-GUM-0023", "observations", "all equal to " + text::shortest(observations.front()),
               "a correlation needs observations that vary", "Observe with a finer resolution.");
    }
    std::vector<double> coefficients;
    for (std::size_t lag = 0; lag <= largest_lag; ++lag) {
        // Over the whole sum for every lag, as the e-Handbook has it: no coefficient exceeds 1 then, also where only
        // few products are left.
        coefficients.push_back(static_cast<double>(lagged_sum(observations, mean, lag) / whole));
    }
    return coefficients;
}

AutocorrelationCheck autocorrelation_check(std::span<const double> observations) {
    AutocorrelationCheck check;
    check.lag_one = autocorrelation(observations, 1)[1];
    // Coefficients of independent observations scatter by 1/√n; two of that are one false alarm in twenty series.
    check.limit = 2.0 / std::sqrt(static_cast<double>(observations.size()));
    check.independent = std::abs(check.lag_one) <= check.limit;
    return check;
}

StandardDeviation pooled_standard_deviation(std::span<const StandardDeviation> series) {
    if (series.empty()) {
        refuse("GC-GUM-0024", "pooled standard deviation", "no series", "needs at least 1 series",
               "Give the standard deviations with their degrees of freedom.");
    }
    Sum degrees;
    double largest = 0.0;
    for (const StandardDeviation& one : series) {
        require_not_negative(one.value, "standard deviation of a series");
        require_positive(one.degrees_of_freedom, "degrees of freedom of a series");
        degrees.add(one.degrees_of_freedom);
        largest = std::max(largest, one.value);
    }
    // Relative to the largest, because squares of uncertainties may leave the range of numbers.
    Sum squares;
    for (const StandardDeviation& one : series) {
        // Series of one dispersion: each s² counts by its degrees of freedom. The mean of the s themselves would be too
        // small, because the root of an unbiased s² is biased.
        const Real ratio = largest > 0.0 ? static_cast<Real>(one.value) / static_cast<Real>(largest) : 0.0L;
        squares.add(static_cast<Real>(one.degrees_of_freedom) * ratio * ratio);
    }
    return {.value = static_cast<double>(static_cast<Real>(largest) * std::sqrt(squares.value() / degrees.value())),
            .degrees_of_freedom = static_cast<double>(degrees.value())};
}

double relative_standard_deviation_of_s(std::size_t observations) {
    if (observations < 2) {
        refuse("GC-GUM-0021", "observations", std::to_string(observations),
               "a standard deviation needs at least 2 observations",
               "Give more observations, or state the uncertainty as a Type B evaluation.");
    }
    if (observations > 2000) {
        // 1 − c₄² loses digits as c₄ comes near 1; its asymptotic series keeps them.
        const double e = 1.0 / (static_cast<double>(observations) - 1.0);
        const double complement = e * (1.0 / 2.0 - e * (1.0 / 8.0 + e * (1.0 / 16.0 - e * 5.0 / 128.0)));
        return std::sqrt(complement / (1.0 - complement));
    }
    // As quotients, because Γ itself overflows from n = 344 on.
    // Γ(n/2) / Γ((n − 1)/2) from n = 2 or 3 upwards.
    Real ratio = observations % 2 == 0 ? std::numbers::inv_sqrtpi_v<Real> : 0.5L / std::numbers::inv_sqrtpi_v<Real>;
    for (std::size_t k = observations % 2 == 0 ? 4 : 5; k <= observations; k += 2) {
        ratio *= static_cast<Real>(k - 2) / static_cast<Real>(k - 3);
    }
    const Real c4_squared = 2.0L / (static_cast<Real>(observations) - 1.0L) * ratio * ratio;
    return static_cast<double>(std::sqrt(1.0L / c4_squared - 1.0L));
}

double degrees_of_freedom_from_reliability(double relative_uncertainty) {
    require_positive(relative_uncertainty, "relative uncertainty of the standard uncertainty");
    return 0.5 / relative_uncertainty / relative_uncertainty;
}

SimultaneousMeans evaluate_simultaneous(const Eigen::MatrixXd& observations) {
    if (observations.cols() == 0) {
        refuse("GC-GUM-0025", "simultaneous observations", "no quantity", "needs at least 1 quantity",
               "Give a column of observations for each quantity.");
    }
    const Eigen::Index q = observations.cols();
    const Eigen::Index n = observations.rows();
    // About the means, in long double: as for a single series the common digits are taken off before products are
    // formed.
    Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> deviation = observations.cast<Real>();
    SimultaneousMeans result;
    result.means.resize(q);
    for (Eigen::Index j = 0; j < q; ++j) {
        const std::span<const double> column(observations.col(j).data(), static_cast<std::size_t>(n));
        require_series(column);
        const Real mean = mean_of(column);
        result.means[j] = static_cast<double>(mean);
        deviation.col(j).array() -= mean;
    }
    result.covariance.resize(q, q);
    result.correlation = Eigen::MatrixXd::Identity(q, q);
    // n − 1 for the deviations about means that come from the same readings, n for the mean of n readings.
    const Real divisor = static_cast<Real>(n) * static_cast<Real>(n - 1);
    for (Eigen::Index i = 0; i < q; ++i) {
        for (Eigen::Index j = 0; j <= i; ++j) {
            Sum sum;
            for (Eigen::Index k = 0; k < n; ++k) {
                sum.add(deviation(k, i) * deviation(k, j));
            }
            result.covariance(i, j) = result.covariance(j, i) = static_cast<double>(sum.value() / divisor);
        }
    }
    for (Eigen::Index i = 0; i < q; ++i) {
        for (Eigen::Index j = 0; j < i; ++j) {
            // Two roots, so that variances of very small units do not underflow. Clamped, because r of proportional
            // columns may exceed 1 by rounding.
            const double product = std::sqrt(result.covariance(i, i)) * std::sqrt(result.covariance(j, j));
            const double r = product > 0.0 ? std::clamp(result.covariance(i, j) / product, -1.0, 1.0) : 0.0;
            result.correlation(i, j) = result.correlation(j, i) = r;
        }
    }
    result.degrees_of_freedom = static_cast<double>(n - 1);
    return result;
}

}  // namespace gumcert::gum
