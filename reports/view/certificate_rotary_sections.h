#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

#include <string>
#include <vector>

namespace gumcert::reports {

/// A budget as a table of its own.
/// \param unit  of the result, hence of every contribution; for people
void budget_table(CertificateBuilder& builder, const Wording& words, const std::string& id, const Text& caption,
                  const std::vector<BudgetRow>& budget, const std::string& unit);

// Sections and parts of sections of a rotary table. Each one writes nothing where the record does not hold what it is
// about, as records of earlier releases do not.

/// The axis average line in the frame of the fixture: part of the section on the set-up.
void axis_line(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);
/// Location errors of the axis in the frame of the machine, with how that frame is known: a section of its own.
void location_errors(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// Accuracy and repeatability of positioning (ISO 230-2).
void positioning(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// Runs and target positions of the positioning (ISO 230-2), without the parameters that are certified.
void positioning_targets(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// Budget by source: part of the section on uncertainty.
void budget_by_source(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// Coordinates of the fixture as they went into the evaluation, and the budget of the largest uncertainty.
void fixture(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// Monte Carlo of the whole measurement, and for which quantities it confirms the law of propagation.
void rotary_monte_carlo(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

/// Global test, variance factors and components, residuals and distances that the outlier test flagged.
void adjustment(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// Redundancy numbers, and what an error that is just too small to be found does to the reported quantities.
void reliability(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

/// Layout, stations, dead paths and reflectors.
void geometry(CertificateBuilder& builder, const Wording& words, const RotaryTable& rotary);

}  // namespace gumcert::reports
