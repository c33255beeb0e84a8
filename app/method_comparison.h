#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// One point that both methods measured, in the unit of the comparison.
struct ComparedPoint {
    std::string name = {}, direction = {};
    std::optional<double> angle_deg = {}, position = {};
    double value = 0.0, u = 0.0, U = 0.0, k = 2.0;
    std::optional<double> nu = {};
    double reference_value = 0.0, reference_u = 0.0, reference_U = 0.0, reference_k = 2.0;
    std::optional<double> reference_nu = {};
};

/// A method against a reference method: what the record of a comparison is computed from.
struct MethodComparison {
    std::vector<ComparedPoint> points;
    Eigen::MatrixXd covariance;            ///< m×m, of the values of the method
    Eigen::MatrixXd reference_covariance;  ///< m×m
    Eigen::MatrixXd cross_covariance;      ///< m×m, cov(method i, reference j); empty: nothing is shared
    bool correlation_unknown = false;      ///< both methods may share a standard: E_n for the worst plausible r too
    double coverage_probability = 0.9545;
    bool bias_against_position = false;  ///< else against the reference value
    bool mean_taken_off = false;         ///< of both sides: their covariance says nothing of what all points share
    double audited_factor = 1.0, reference_audited_factor = 1.0;
    std::map<std::string, double> published_mean_abs_En = {};  ///< by direction
    std::string printed_unit = "um";                           ///< as the record writes it; D and U are printed in it
};

/// Fills `points`, `summary` and the remarks that follow from the numbers; the rest of the record is the caller's.
///
/// Directions come in the order of the points, then "all" where there is more than one direction, or one without name.
/// Differences are judged with their full covariance, V + V_ref − C − Cᵀ (gum/comparison/agreement.h).
/// \throws InputError, NoResultError
void compare_methods(reports::Comparison& record, const MethodComparison& comparison);

}  // namespace gumcert::app
