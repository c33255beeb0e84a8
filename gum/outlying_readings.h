#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gumcert::gum {

/// A reading that does not belong to the others.
struct OutlyingReading {
    std::size_t position = 0;  ///< in the readings, from 0
    double value = 0.0;
    double G = 0.0;          ///< |x − x̄| / s of the readings that were tested (resolution left aside)
    double p_value = 1.0;    ///< upper bound of the probability that any of n normal readings lies as far out
    std::size_t tested = 0;  ///< n, readings that were left when this one was tested
};

/// Level at which a reading is called an outlier: one set of good readings in a hundred has one.
inline constexpr double k_outlier_level = 0.01;

/// Readings that Grubbs' test takes for outliers, the farthest first.
///
/// G = max |x_i − x̄| / s is compared with ((n−1)/√n) √(t²/(n − 2 + t²)), t the upper α/(2n) quantile of Student's t
/// with n − 2 degrees of freedom (two-sided test; NIST/SEMATECH e-Handbook, 1.3.5.17.1; Grubbs 1969, Technometrics 11,
/// 1-21). Told the other way: the deviation of x_i from the mean of the others over their standard deviation and
/// √(n/(n−1)) is t-distributed, and the p-value is n times its two-sided tail at most.
/// Where there are many readings the test is repeated without the outlier, for n/5 suspects at most and never more than
/// 10 (the order of the generalised test for outliers, e-Handbook 1.3.5.17.3): two outliers hide each other from a
/// single test.
///
/// Digital readings are not continuous: the standard deviation of the others is taken as at least step/√12, so that one
/// reading one digit off many equal ones is no outlier.
/// \param readings    x_i; fewer than 3, or all equal: no test, no outlier
/// \param resolution  the step that readings are rounded to, in their unit; at least the last decimal place in which
///                    any of them differs from a whole number is taken
/// \throws InputError  GC-GUM-0001 a reading is not finite
/// Valid for readings of a normal distribution that do not depend on each other. An outlier is a reason to look for its
/// cause, never one to remove it.
[[nodiscard]] std::vector<OutlyingReading> outlying_readings(std::span<const double> readings, double resolution = 0.0);

/// The decimal place in which readings are given: the largest power of ten of which all of them are multiples within the
/// rounding of double numbers, whatever their unit: readings that are multiplied by a power of ten have a step that is.
/// 1 where all are 0; 0 where they have more than 14 digits, from the first one of the largest on.
[[nodiscard]] double decimal_step(std::span<const double> readings);

}  // namespace gumcert::gum
