#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/localised_text.h"

namespace gumcert::laboratory {

// A measurement standard in the register of a laboratory: what its certificates say, one after the other, and what the
// laboratory decided on drift, interpolation and recalibration. Numbers are in the unit that stands beside them, as on the
// certificate; dates are texts "2026-11-21" (certificate/dates.h).

/// One line of a certificate.
struct CalibrationResult {
    std::string quantity, range, mode;  ///< tell the lines apart; "" where the certificate has one of a kind
    std::optional<double> nominal;      ///< in nominal_unit
    std::string nominal_unit;           ///< "": unit
    std::optional<double> low, high;    ///< values between which the line holds, both or none, in nominal_unit
    double value = 0.0;
    std::string unit;                  ///< of value and U (of a Celsius temperature, U is a difference)
    double U = 0.0;                    ///< expanded uncertainty
    std::optional<double> relative_U;  ///< as the certificate states it, where it does: U is this share of |value|
    std::optional<double> k, p;        ///< coverage factor of U, or its coverage probability; one at least
    std::optional<double> nu;          ///< degrees of freedom; none: infinite
    friend bool operator==(const CalibrationResult&, const CalibrationResult&) = default;
};

struct Calibration {
    std::string calibrated, valid_to;  ///< first and last day of use; valid_to "": not decided
    std::string certificate;
    certificate::LocalisedText issuer;
    std::string issuer_accreditation, route, evidence;  ///< as of certificate::StandardUsed
    std::string sha256;                                 ///< of the certificate, where it is a file
    std::vector<CalibrationResult> results;
};

/// How a standard changes after its calibration.
enum class DriftKind { none, limit_per_year, linear, last_difference };

struct DriftModel {
    DriftKind kind = DriftKind::none;
    std::string reason;  ///< of `none`, or for people
    double limit =
        0.0;           ///< of `limit_per_year`: largest change in a year, in `unit`, or as a share of the nominal value
    std::string unit;  ///< of `limit`
    bool weighted = false;  ///< of `linear`: by 1/u², else all calibrations weigh alike
};

/// What is taken between two calibrated values.
enum class Interpolation { none, nearest, linear };

/// Method of ILAC-G24:2022 / OIML D 10:2022, clause 6, by which recalibration intervals are reviewed.
enum class IntervalMethod { staircase, control_chart, in_use_time };

struct UsageReading {
    std::string date;
    double hours = 0.0;  ///< that the counter shows
};

struct IntervalPlan {
    IntervalMethod method = IntervalMethod::staircase;
    double limit = 0.0;     ///< staircase: largest permissible error; control_chart: largest change that is allowed
    std::string unit;       ///< of `limit`
    long present_days = 0;  ///< staircase: the interval that ended with the last calibration, [d]
    double extend_by = 0.0, reduce_by = 0.0;         ///< staircase: factors above 1 and below 1
    long least_days = 1, most_days = 3653;           ///< of staircase and control_chart, [d]
    double coverage_factor = 2.0;                    ///< control_chart: of the uncertainty of the drift
    double hours = 0.0, hours_at_calibration = 0.0;  ///< in_use_time: allowed between calibrations; counter then, [h]
    std::vector<UsageReading> readings;              ///< of the counter, by date
};

struct StandardRecord {
    std::string id;
    certificate::LocalisedText description;
    std::string manufacturer, type, serial_number;
    std::string role = "working";           ///< or "reference"
    std::vector<Calibration> calibrations;  ///< by date, the earliest first
    DriftModel drift;
    Interpolation interpolation = Interpolation::none;
    std::optional<IntervalPlan> interval;
};

/// Standard uncertainty of a line: U/k, or U over the factor of p and ν (Student's t).
/// \throws gum::InputError  GC-LAB-0010 if neither k nor p is stated
[[nodiscard]] double standard_uncertainty(const CalibrationResult& result);

/// The calibration that was the last one on a day; null where all are later. Of day "", the last one of all.
[[nodiscard]] const Calibration* calibration_on(const StandardRecord& record, std::string_view day);

}  // namespace gumcert::laboratory
