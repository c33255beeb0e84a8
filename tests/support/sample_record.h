#pragma once

#include "reports/record/evaluation_record.h"

#include <string>

namespace gumcert::test {

/// A number with a fixed count of decimals and U+2212 as minus sign, for samples only.
std::string decimals(double v, int count);

/// Value and U with two significant digits of U.
reports::Printed printed(double value, double U, const std::string& unit);

reports::StatedValue stated_value(double value, double u, const std::string& unit);

/// Monte Carlo of one quantity that agrees with the law of propagation, or does not.
reports::MonteCarloSummary trials_of(double value, double u, bool validated = true, bool precise = true);

/// One number derived from the error motions.
reports::TableParameter table_parameter(const std::string& name, const std::string& description, double value, double u,
                                        const std::string& unit);

/// A whole record of a rotary table with plausible numbers: 36 angles, six stations, six reflectors, dial indicator.
/// Every number is made up by a formula, so that a test can tell a misplaced one.
reports::EvaluationRecord sample_record();

}  // namespace gumcert::test
