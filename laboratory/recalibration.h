#pragma once

#include <optional>
#include <span>
#include <string>

#include "laboratory/drift.h"
#include "laboratory/standard_record.h"

namespace gumcert::laboratory {

// When a standard is calibrated again: three of the methods of ILAC-G24:2022 / OIML D 10:2022, clause 6. The guide gives
// the idea of each and leaves its numbers to the laboratory; so they are stated, not assumed.

/// Method 1, "staircase" (6.2): the interval is extended where the standard was found well within its limit, within
/// 80 % of it, shortened where it was found outside, and kept between the two.
/// \param found  how far the standard was from its last known value, in the unit of the limit
/// \param scale  how large the values are of which it is the difference: their digits decide, not those of binary numbers
/// \return whole days, between least_days and most_days
[[nodiscard]] long staircase_interval(const IntervalPlan& plan, double found, double scale = 0.0);

/// Method 2, control chart (6.3): the largest number of days after which |D| + k·u(D) of the drift is still within the
/// limit, where D is the straight line through the history (linear_drift).
/// \param limit  in the unit of the series, like k_u of the drift
/// \return between 0 and most_days; 0 where the limit is not kept on the day of the calibration
/// \throws gum::InputError  GC-LAB-0012
[[nodiscard]] long control_chart_interval(std::span<const SeriesPoint> series, bool weighted, double limit,
                                          double coverage_factor, long most_days);

/// Method 3, in-use time (6.4): hours of use in place of days.
struct TimeInUse {
    double used = 0.0,
           left = 0.0;  ///< since the calibration, and until the next one, [h]; left is negative when overdue
    std::optional<long> days_left;  ///< from the last reading, at the rate since the calibration; none: not used so far
};
/// \param days  from the calibration to the last reading
[[nodiscard]] TimeInUse time_in_use(const IntervalPlan& plan, double last_reading, double days);

/// When a record proposes its next calibration.
struct Recalibration {
    std::string due;      ///< day; "" where no day can be said
    long days = 0;        ///< after the last calibration
    std::string because;  ///< English, without a full stop
};
/// By the plan of the record, for one line of its last calibration; nothing where the record has no plan.
/// \throws gum::InputError  GC-LAB-0011, -0012, -0013
[[nodiscard]] std::optional<Recalibration> next_calibration(const StandardRecord& record,
                                                            const CalibrationResult& result);

/// The day so many days after another one; "" where that is no date.
[[nodiscard]] std::string days_after(std::string_view day, long days);

}  // namespace gumcert::laboratory
