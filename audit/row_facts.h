#pragma once

#include <string>
#include <string_view>

#include "audit/audited_budget.h"

namespace gumcert::audit {

/// Reads what quantity, source and comment of a row say beside its columns, English or German, for readers of tables
/// after the row is filled. Sets only what is not set yet:
///
/// relative_uncertainty, relative_to, full_scale   "0.5 % of full scale, FS = 10 bar", "0,5 % v.E.", "1 % of reading"
/// certificate_low, certificate_high               "calibrated at 20 °C", "calibrated from 0 to 100 mm"
/// lower_limit, upper_limit                        "+0.3/-0.1"
/// reliability                                     "reliability about 25 %", "auf 25 % zuverlässig"
/// cyclic                                          "cyclic", "sinusoidal", "zyklisch", "two-point control"
/// unapplied_correction                            "correction -0.05 not applied", "Korrektion 0,02 nicht angebracht"
/// averaged                                        "mean of 5 readings", "Mittel aus 5"
/// limit_constant, limit_per_length                "MPE 0.4 + 1.2E-6 L", with origin and its value
///
/// A number with a unit other than that of the row belongs to something else and is not taken. Texts longer than 400
/// bytes are not read.
void note_row_facts(AuditedRow& row);

}  // namespace gumcert::audit
