#pragma once

#include "tests/support/sample_record.h"

#include <cstddef>
#include <string>

namespace gumcert::test {

/// Counts of a normal distribution in `cells` cells between low and high.
void fill_histogram(reports::MonteCarloSummary& m, double low, double high, int cells);

reports::BudgetRow budget_row(const std::string& input, double value, const std::string& unit, double u,
                              std::optional<double> nu, const std::string& type, const std::string& distribution,
                              double sensitivity, double u_result);

/// Record of kind "budget" with the numbers of JCGM 100:2008, H.1: the end gauge.
reports::EvaluationRecord sample_budget_record();

/// Record of kind "budget" with two correlated results in the manner of JCGM 100:2008, H.2, a fit, repeated readings
/// and an analysis of variance. Numbers that H.2 does not have are made up.
reports::EvaluationRecord sample_two_results_record();

/// The end gauge at a number of points: one result a point, each with its budget and Monte Carlo.
reports::EvaluationRecord sample_points_record(std::size_t count);

}  // namespace gumcert::test
