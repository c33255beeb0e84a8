#pragma once

#include <string>
#include <string_view>

#include "laboratory/standard_record.h"

namespace gumcert::laboratory {

/// Whether a standard may be used as calibrated on a day.
enum class CalibrationState { valid, overdue, not_calibrated, unknown };

/// How the calibration of a standard stands on a day. Texts are English, without a full stop.
struct CalibrationOutlook {
    const Calibration* last = nullptr;  ///< up to the day; null: it was not calibrated before
    std::string next;                   ///< day of the next calibration by the plan of the record; "": none can be said
    std::string why;                    ///< the method behind `next`, or why there is none
    CalibrationState state = CalibrationState::unknown;
    std::string because;   ///< of the state
    std::string last_day;  ///< of use: valid_to, or where the register states none the next calibration by the plan; ""
};

/// By the calibrations up to the day. The next calibration is the earliest one that next_calibration() proposes for a line of
/// the last certificate; lines of which nothing can be said are named in `why`.
///
/// overdue: the day is after valid_to, or after the next calibration. valid: one of the two is stated, and neither is past.
/// unknown: neither is.
/// Of a day before the last calibration of the record, staircase and in-use time say nothing: their numbers belong to the last.
/// \param record  must outlive what is returned
/// \param day     "2026-11-21", a date
[[nodiscard]] CalibrationOutlook calibration_outlook(const StandardRecord& record, std::string_view day);

}  // namespace gumcert::laboratory
