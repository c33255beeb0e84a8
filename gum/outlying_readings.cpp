#include "gum/outlying_readings.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

namespace {

// The others of n readings have n − 2 degrees of freedom: below three readings there is no t to compare with.
constexpr std::size_t k_least_readings = 3;
constexpr std::size_t k_most_suspects = 10;
constexpr std::size_t k_readings_a_suspect = 5;
constexpr int k_most_digits_of_readings = 14;  // beyond, what a double number rounds looks like digits

/// Mean and standard deviation of all but one.
struct Others {
    double mean = 0.0, standard_deviation = 0.0;
};

// Without the suspect, because an outlier makes the standard deviation of all so large that it may hide itself. The
// first of the others is taken off before summing: common digits do not cost any.
Others others_of(const std::vector<double>& readings, std::size_t suspect) {
    const auto m = static_cast<long double>(readings.size() - 1);
    const long double first = readings[suspect == 0 ? 1 : 0];
    long double sum = 0.0L;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        sum += i == suspect ? 0.0L : readings[i] - first;
    }
    const long double mean = sum / m;
    long double squares = 0.0L;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const long double deviation = i == suspect ? 0.0L : (readings[i] - first) - mean;
        squares += deviation * deviation;
    }
    return {static_cast<double>(first + mean), static_cast<double>(std::sqrt(squares / (m - 1.0L)))};
}

/// The reading farthest from the mean of all, the first of several.
std::size_t farthest(const std::vector<double>& readings) {
    long double sum = 0.0L;
    for (const double reading : readings) {
        sum += reading - readings.front();
    }
    const long double mean = readings.front() + sum / static_cast<long double>(readings.size());
    std::size_t suspect = 0;
    for (std::size_t i = 1; i < readings.size(); ++i) {
        // The first of equal distances, so that the result depends on nothing but the readings and their order.
        if (std::fabs(readings[i] - mean) > std::fabs(readings[suspect] - mean)) {
            suspect = i;
        }
    }
    return suspect;
}

/// Grubbs' test of the farthest reading; `least_s` is what rounding leaves of the scatter of the others.
OutlyingReading test_farthest(const std::vector<double>& readings, double least_s) {
    OutlyingReading tested;
    const auto n = static_cast<double>(readings.size());
    tested.position = farthest(readings);
    tested.value = readings[tested.position];
    tested.tested = readings.size();
    const Others others = others_of(readings, tested.position);
    const double deviation = std::fabs(tested.value - others.mean);
    const double s = std::max(others.standard_deviation, least_s);
    if (!(deviation > 0.0)) {
        return tested;
    }
    // With s of the others 0 and no step, the statistic is at its largest value, and the p-value 0.
    const double t = deviation / (s * std::sqrt(n / (n - 1.0)));
    // Mean and squares of all follow from those of the others: x − x̄ = d (n − 1)/n and S = S_others + d² (n − 1)/n. G
    // is what the tables of the test have; the p-value comes from t.
    const double all = std::sqrt(
        ((n - 2.0) * others.standard_deviation * others.standard_deviation + deviation * deviation * (n - 1.0) / n) /
        (n - 1.0));
    tested.G = deviation * (n - 1.0) / n / all;
    using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;  // ADR 0058
    const boost::math::students_t_distribution<double, InDouble> distribution(n - 2.0);
    const double tail = std::isfinite(t) ? boost::math::cdf(boost::math::complement(distribution, t)) : 0.0;
    // The farthest of n readings was chosen after looking at them. n times the tail of one is what chance gives any of
    // them at most (Bonferroni), and both sides count.
    tested.p_value = std::min(1.0, 2.0 * n * tail);
    return tested;
}

}  // namespace

double decimal_step(std::span<const double> readings) {
    double largest = 0.0;
    for (const double reading : readings) {
        largest = std::max(largest, std::fabs(reading));
    }
    if (!(largest > 0.0)) {
        return 1.0;
    }
    // From the first digit of the largest one on, whatever the unit is: readings in A and in fA have the same digits.
    const int first = -static_cast<int>(std::floor(std::log10(largest)));
    for (int decimals = first; decimals < first + k_most_digits_of_readings; ++decimals) {
        const double scale = decimals >= 0 ? std::pow(10.0, decimals) : 1.0 / std::pow(10.0, -decimals);
        const bool fits = std::all_of(readings.begin(), readings.end(), [&](double reading) {
            const double scaled = reading * scale;
            // A decimal reading is not exact in binary: 0.3 times 10 is 3 but for its last bits.
            const double rounding = 4.0 * std::fabs(scaled) * 0x1p-52;
            return std::fabs(scaled - std::round(scaled)) <= rounding;
        });
        if (fits) {
            return decimals > 0 ? 1.0 / scale : std::pow(10.0, -decimals);
        }
    }
    return 0.0;
}

std::vector<OutlyingReading> outlying_readings(std::span<const double> readings, double resolution) {
    for (const double reading : readings) {
        if (!std::isfinite(reading)) {
            throw InputError(Diagnostic{.code = "GC-GUM-0001",
                                        .where = "readings",
                                        .what = "a reading is not finite",
                                        .rule = "must be finite",
                                        .action = "Correct the reading."});
        }
    }
    std::vector<OutlyingReading> found;
    if (readings.size() < k_least_readings) {
        return found;
    }
    // The variance of a rounding step is step²/12. Where many readings are equal their scatter is below what rounding
    // hides, and any other reading would be infinitely improbable.
    const double least_s = std::max(resolution, decimal_step(readings)) / std::sqrt(12.0);
    std::vector<double> left(readings.begin(), readings.end());
    std::vector<std::size_t> position(left.size());
    for (std::size_t i = 0; i < position.size(); ++i) {
        position[i] = i;
    }
    // A fifth at most: where more readings disagree it cannot be told which of them are the good ones.
    const std::size_t suspects =
        std::clamp<std::size_t>(readings.size() / k_readings_a_suspect, std::size_t{1}, k_most_suspects);
    // All suspects are tested: a second outlier may hide the first one. Those before the last that is one are, too.
    std::vector<OutlyingReading> tested;
    std::size_t outliers = 0;
    for (std::size_t i = 0; i < suspects && left.size() >= k_least_readings; ++i) {
        OutlyingReading reading = test_farthest(left, least_s);
        const std::size_t at = reading.position;
        reading.position = position[at];
        outliers = reading.p_value < k_outlier_level ? i + 1 : outliers;
        tested.push_back(reading);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
        position.erase(position.begin() + static_cast<std::ptrdiff_t>(at));
    }
    found.assign(tested.begin(), tested.begin() + static_cast<std::ptrdiff_t>(outliers));
    // A reading that hid behind another one is as unlikely as that one.
    for (std::size_t i = found.size(); i-- > 1;) {
        found[i - 1].p_value = std::min(found[i - 1].p_value, found[i].p_value);
    }
    return found;
}

}  // namespace gumcert::gum
