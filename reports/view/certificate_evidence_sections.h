#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// What an evaluation of any kind warns of, once for each code: a doubt stands on the page that the results stand on, and its
/// message with the others further down.
void add_warnings(Facts& rows, const Wording& words, const EvaluationRecord& record);

// Sections of a rotary table that a machine builder reads, and what the distances say of the measurement. Each one
// writes nothing where the record does not hold what it is about, as records of earlier releases do not.

/// What the table does: ranges, ISO 230-2, axis, the verdicts of the tests, and the curves. The first page of a
/// specimen.
void overview(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

/// The diagram of ISO 230-2: part of the section on positioning.
void positioning_figure(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// Polar plots and harmonics of the error motions.
void harmonics(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// Tests of groups of distances, deviations of the visits, and their scatter.
void group_tests(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// Temperatures and air at the stations, and what the thermal expansion of the fixture did.
void environment(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// The distances of a small measurement as they were read; of a large one where they are.
void distances_as_read(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

}  // namespace gumcert::reports
