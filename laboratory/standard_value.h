#pragma once

#include <optional>
#include <string>
#include <vector>

#include "laboratory/applicability.h"
#include "laboratory/drift.h"
#include "laboratory/standard_record.h"

namespace gumcert::laboratory {

/// What a standard is worth in a use. Numbers are in `unit`.
struct StandardValue {
    const Calibration* calibration = nullptr;
    const CalibrationResult* result = nullptr;  ///< the line of the certificate, between two the nearer one
    const CalibrationResult* other = nullptr;   ///< between two whose uncertainties both count, the farther one
    std::string unit;
    double value = 0.0;  ///< as calibrated; the drift is not in it
    double U = 0.0;      ///< as on the certificate; between two values a standard uncertainty with k = 1
    std::optional<double> k, p, nu;
    double interpolation_half_width = 0.0;  ///< of a uniform distribution; 0: a calibrated value was used
    Drift drift;
    double days = 0.0;  ///< from the calibration to the use
};

/// The history of one line: its value in the calibrations up to `last`, by time, in the unit of the line.
/// \throws gum::InputError  GC-LAB-0013 if an earlier one is in a unit of another dimension
[[nodiscard]] std::vector<SeriesPoint> history_of(const StandardRecord& record, const Calibration& last,
                                                  const CalibrationResult& result);

/// A largest change of a value: in its unit, or relative, as a share of its nominal value.
struct StatedChange {
    double size = 0.0;
    std::string unit;
    std::string called;  ///< in messages: drift, limit
};

/// The change in the unit of the line.
/// \throws gum::InputError  GC-LAB-0013 if it is neither in a unit of the value nor relative, or is relative and the line has no
///                          nominal value, one of 0, or a temperature
[[nodiscard]] double change_in_unit_of(const StandardRecord& record, const CalibrationResult& result,
                                       const StatedChange& change);

/// Drift of one line by the model of the record.
/// \param days  since `last`, at least 0
/// \throws gum::InputError  GC-LAB-0011, -0012, -0013
[[nodiscard]] Drift drift_of(const StandardRecord& record, const Calibration& last, const CalibrationResult& result,
                             double days);

/// Value and uncertainty of a standard in a use, by the calibration that was the last one on the day of use.
///
/// At a calibrated value, or within the limits of a line: the line. Between two calibrated values x0 < x < x1, with c the
/// value less its nominal value (the value itself where the two have different units):
/// nearest: c of the nearer one (the value itself where values change less from one to the other than c: an error); uniform within ±|c1 − c0|·d/(x1 − x0), d the distance to it.
/// linear: c = (1 − λ)c0 + λc1, u = (1 − λ)u0 + λu1 as the lines of one certificate have their errors in common; uniform
/// within ±|(x − x0)(x − x1)|·M, the remainder of linear interpolation, with M the larger one of the second divided
/// differences of c with the neighbours.
///
/// \throws gum::InputError  GC-LAB-0014 if the use does not say which line it means, or means none; -0015 if three
///                          calibrated values are not there for a linear interpolation; those of drift_of()
/// Example: examples/laboratory/README.md
[[nodiscard]] StandardValue value_of_standard(const StandardRecord& record, const StandardUse& use);

}  // namespace gumcert::laboratory
