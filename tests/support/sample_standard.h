#pragma once

#include <string>
#include <utility>

#include "laboratory/standard_record.h"

namespace gumcert::test {

/// One line of a certificate.
inline laboratory::CalibrationResult line_at(double nominal, double value, double U = 0.2, double k = 2.0) {
    laboratory::CalibrationResult line;
    line.nominal = nominal;
    line.value = value;
    line.unit = "V";
    line.U = U;
    line.k = k;
    return line;
}

/// A calibration of one line, valid for two years.
inline laboratory::Calibration calibration_of(const std::string& day, const std::string& valid_to,
                                              laboratory::CalibrationResult line) {
    laboratory::Calibration calibration;
    calibration.calibrated = day;
    calibration.valid_to = valid_to;
    calibration.certificate = "C-" + day;
    calibration.results.push_back(std::move(line));
    return calibration;
}

/// A voltage of 10 V, calibrated in three years, that rose by 1 V and 2 V.
inline laboratory::StandardRecord three_calibrations() {
    laboratory::StandardRecord record;
    record.id = "STD-1";
    record.description = "Voltage standard";
    record.drift = {laboratory::DriftKind::none, "reason", 0.0, "", false};
    record.calibrations = {calibration_of("2024-01-01", "2025-12-31", line_at(10.0, 7.0)),
                           calibration_of("2025-01-01", "2026-12-31", line_at(10.0, 8.0)),
                           calibration_of("2026-01-01", "2027-12-31", line_at(10.0, 10.0))};
    return record;
}

}  // namespace gumcert::test
