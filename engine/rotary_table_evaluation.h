#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/datum.h"
#include "engine/reliability.h"
#include "engine/rotary_table_model.h"
#include "engine/variance_components.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// Tolerances of the whole evaluation; written to the record.
struct EvaluationOptions {
    SolverOptions solver;
    int max_component_iterations = 60;
    /// Components count as converged when no variance moves by more than this fraction of its standard uncertainty.
    double component_tolerance = 1e-6;
    int max_outlier_rounds = 200;
    /// Two-sided critical value of the test values, from `OutlierOptions::alpha`; here for 0.0001.
    double critical_value = 3.8905918864131203;
    /// δ0 of the minimal detectable bias: critical value plus the quantile of the detection power; here for 80 %.
    double non_centrality = 4.732213119986034;
};

struct StationEstimate {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in T of the datum, [m]
    Eigen::Vector3d u = Eigen::Vector3d::Zero();         ///< [m]
    double scale_deviation = 0.0, u_scale = 0.0;         ///< s - 1, [1]
};

/// Everything that the adjustment knows of one rotary-table measurement, coherent SI.
struct RotaryTableSolution {
    DatumSolution datum;
    ReportedQuantities quantities;
    Eigen::VectorXd values;      ///< of the reported quantities
    Eigen::MatrixXd covariance;  ///< of the reported quantities, from the normal equations
    std::vector<StationEstimate> stations;
    Eigen::VectorXd dead_paths, u_dead_paths;  ///< [m]
    Eigen::MatrixX3d fixture, u_fixture;       ///< adjusted coordinates at the reference temperature, [m]

    Eigen::Index observations = 0, parameters = 0, degrees_of_freedom = 0;
    int iterations = 0;
    double chi_square = 0.0;
    double condition_number = 0.0;

    StochasticModel stochastic;
    std::vector<VarianceComponent> components;
    std::vector<DistanceReliability> reliability;  ///< one a length of the measurement

    std::shared_ptr<const gum::MeasurementModel> model;  ///< outputs: the reported quantities; for the GUM layer
    std::vector<gum::Diagnostic> notes;                  ///< what a reader must know of this result
};

/// Called now and then with a sentence on what is being done.
using Progress = std::function<void(const std::string&)>;

/// Joint adjustment from start values to the covariance in the datum asked for. The model is a RotaryTableModel.
///
/// Variance components are estimated where the measurement asks for it, outlying distances are found one angle at a
/// time by their test values (each removal can change every other value) and, by `OutlierAction`, left out or kept.
///
/// \throws gum::NoResultError  naming the parameters that are not determined, or when nothing converges
[[nodiscard]] RotaryTableSolution evaluate_jointly(const RotaryTableMeasurement& measurement,
                                                   const EvaluationOptions& options, const Progress& progress = {});

}  // namespace gumcert::engine
