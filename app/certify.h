#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "certificate/certificate_data.h"
#include "gum/monte_carlo/trial_distribution.h"
#include "gum/rounding.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// Values of an input of a budget, for the capabilities that depend on it.
struct InputValues {
    std::string unit;            ///< UDUNITS-2
    std::vector<double> values;  ///< in `unit`, one a point of the table, or one for all
};

/// What the evaluation knows beside its record.
struct CapabilityInputs {
    std::map<std::string, InputValues> values;  ///< by the name of the input
    /// P(Y ≤ x) of results whose k comes from a convolution, by Result::name; x in the unit of the result.
    std::map<std::string, std::function<double(double)>> distributions;
    /// P(Y < x) of the same results, where it differs: where single values have a probability of their own.
    std::map<std::string, std::function<double(double)>> distributions_below;
    /// Trials of results whose U comes from Monte Carlo, by Result::name. Counted where a decision needs them, one
    /// result after the other: they take memory.
    std::map<std::string, gum::TrialsOfOutput> trials = {};
    gum::RoundingMode rounding = gum::RoundingMode::half_even;  ///< of U, as the job asks for it
};

/// Makes a record a certificate: puts its results into certified tables, prints every value with its capability as the
/// floor and by the profile, decides on conformity, passes the three gates. Printed texts elsewhere in the record
/// (Result::printed, StatedValue::printed …) become the same ones, so that no two places of a document disagree.
///
/// The rounding of a budget job (`reporting.rounding`: up) stays in force where the profile rounds half-even.
/// \throws gum::InputError  GC-GUM-.. if a number of the record cannot be printed
void certify(reports::EvaluationRecord& record, certificate::CertificateData data, certificate::Profile profile,
             const CapabilityInputs& inputs = {});

}  // namespace gumcert::app
