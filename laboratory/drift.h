#pragma once

#include <limits>
#include <span>

namespace gumcert::laboratory {

// How far a standard may have moved since its last calibration: a correction that is added to the value of the certificate,
// and its standard uncertainty, which is added to that of the certificate as a contribution of its own.

/// Days in the year of a drift per year: the Julian year.
inline constexpr double k_days_in_year = 365.25;

/// The value of one calibration.
struct SeriesPoint {
    double days = 0.0;  ///< since the last calibration, which has 0; earlier ones are negative, [d]
    double value = 0.0;
    double u = 0.0;  ///< standard uncertainty, in the unit of the value
};

/// In the unit of the series.
struct Drift {
    double value = 0.0;
    double u = 0.0;
    double half_width = 0.0;  ///< of a uniform distribution about `value`; 0: not bounded
    double nu = std::numeric_limits<double>::infinity();
};

/// No more than a stated limit in a year: uniform within ±limit·Δt.         (JCGM 100:2008, 4.3.7)
/// \param days  since the last calibration, at least 0
[[nodiscard]] Drift drift_within_limit(double limit_per_year, double days);

/// No more than was seen between the last two calibrations, in proportion where more time has passed than between them:
/// uniform within ±|y_n − y_(n−1)|·max(1, Δt/(t_n − t_(n−1))).               (JCGM 100:2008, 4.3.7)
/// \param series  two points at least, by time, the last one at 0 days
/// \throws gum::InputError  GC-LAB-0011 for fewer points, or two of one day at the end
[[nodiscard]] Drift drift_as_last_difference(std::span<const SeriesPoint> series, double days);

/// A straight line through the history: D = ŷ(Δt) − y_n with ŷ(t) = ȳ + b(t − t̄), weights w_i, W = Σw_i,
/// S = Σw_i(t_i − t̄)², ν = n − 2.
///
/// Ordinary, w = 1: u² = s²(1 + 1/n + (Δt − t̄)²/S), s² = Σ(residual)²/ν: the prediction of one further value of a
/// regression line, whose parameters and their covariance are those of JCGM 100:2008, H.3.
/// Weighted, w = 1/u_i²: u² = c(1/W + (Δt − t̄)²/S) + (c − 1)u_n², c = max(1, Σw·residual²/ν). The part u_n² of a
/// further value stands in the budget already, as the uncertainty of the last calibration; where the history scatters
/// more than its uncertainties say (c > 1), the rest is added. ν is infinite for c = 1.
///
/// \param series  three points at least, of different days, by time, the last one at 0 days
/// \param weighted  needs u > 0 of every point
/// \throws gum::InputError  GC-LAB-0012 for fewer points or days, or u = 0 among weighted ones
/// Valid while the standard goes on as it did; beyond the length of the history nobody knows.
[[nodiscard]] Drift linear_drift(std::span<const SeriesPoint> series, bool weighted, double days);

}  // namespace gumcert::laboratory
