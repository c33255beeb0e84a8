#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/fixed_parts.h"
#include "engine/rotary_table/anglewise_covariance.h"
#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/external_reliability.h"
#include "engine/rotary_table/group_tests.h"
#include "engine/rotary_table/reliability.h"
#include "engine/rotary_table/reversal_choice.h"
#include "engine/rotary_table/rotary_table_model.h"
#include "engine/rotary_table/variance_components.h"
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
    /// Two-sided quantile of Student's t for the same probability, by its degrees of freedom. With it a distance is
    /// tested with Pope's tau where the length noise is estimated; without it always with `critical_value`.
    std::function<double(double)> student_critical_value;
    /// Probability above a value of chi-square, by value and degrees of freedom. With it the stated covariance of the
    /// fixture is tested against what the distances say of it (FixtureComponent::check), and groups of distances are
    /// tested; without it they are not.
    std::function<double(double, double)> chi_square_upper_tail;
    /// Probability above a value of the F distribution, by value and both degrees of freedom, of which the second may
    /// be infinite. With it and `chi_square_upper_tail` a reversal that depends on the angle is looked for.
    std::function<double(double, double, double)> fisher_upper_tail;
    /// Threads of large measurements; results are the same bytes for any number.
    Workers workers;
};

struct StationEstimate {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< in T of the datum, [m]
    Eigen::Vector3d u = Eigen::Vector3d::Zero();           ///< [m]
    double scale_deviation = 0.0, u_scale = 0.0;           ///< s - 1, [1]
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the position, [m²]
};

enum class OutlierReason {
    gross_error,    ///< grossly off: left out before the adjustment, which would not survive it
    data_snooping,  ///< largest test value above the critical one
};

/// A distance that was found outlying, in the order found.
struct OutlierFinding {
    std::size_t length = 0;  ///< index into the lengths of the measurement
    OutlierReason reason = OutlierReason::data_snooping;
    double test_value = 0.0;         ///< when it was found; for a gross error at the end, from all others
    double critical_value = 0.0;     ///< that it was compared with
    double redundancy_number = 0.0;  ///< when it was found; 1 for a gross error
    double estimated_error = 0.0;    ///< observed minus what all other distances say, [m]: at the end, else when found
    bool came_back = false;          ///< it agrees with the others after all, and is in the result
    bool removed = false;            ///< it is not in the result
};

enum class VarianceBasis {
    stated,     ///< all variances as stated
    estimated,  ///< variance components estimated from the residuals are in the weights and the uncertainties
};

/// Everything that the adjustment knows of one rotary-table measurement, coherent SI.
struct RotaryTableSolution {
    DatumSolution datum;
    ReportedQuantities quantities;
    Eigen::VectorXd values;          ///< of the reported quantities
    AnglewiseCovariance covariance;  ///< of the reported quantities, from the normal equations
    std::vector<StationEstimate> stations;
    Eigen::MatrixXd station_covariance;  ///< of all positions, x1 y1 z1 x2 …, [m²]; empty with the sequential method
    Eigen::VectorXd dead_paths, u_dead_paths;  ///< [m]
    Eigen::MatrixX3d fixture, u_fixture;       ///< adjusted coordinates at the reference temperature, [m]
    std::vector<Eigen::Matrix3d> fixture_position_covariance;  ///< of each reflector's coordinates, [m²]
    Eigen::MatrixX3d fixture_at_home;  ///< reflectors in T of the datum at home, at the reference temperature, [m]

    Eigen::Index observations = 0, parameters = 0, degrees_of_freedom = 0;
    int iterations = 0;
    double chi_square = 0.0;
    double variance_factor = 1.0;  ///< chi-square per degree of freedom; 1 without redundancy
    VarianceBasis variance_basis = VarianceBasis::stated;
    std::string variance_factor_reason;  ///< for people: why no uncertainty is multiplied by the factor
    double condition_number = 0.0;

    StochasticModel stochastic;
    std::vector<VarianceComponent> components;
    std::vector<DistanceReliability> reliability;            ///< one a length of the measurement
    std::vector<CoordinateReliability> fixture_reliability;  ///< one a coordinate, x1 y1 z1 x2 …
    std::vector<ExternalReliability> external_reliability;   ///< ascending by quantity; none where it is fixed by datum
    std::vector<OutlierFinding> outliers;                    ///< in the order found
    double critical_value = 0.0;                             ///< of the test values, at the end
    std::optional<double> critical_value_degrees_of_freedom;  ///< of Pope's tau; none: normal distribution
    double non_centrality = 0.0;                              ///< δ0 of the minimal detectable biases
    double fixture_critical_value = 0.0;                      ///< the same test for the coordinates of the fixture
    std::optional<GroupTests> groups;                         ///< with EvaluationOptions::chi_square_upper_tail
    ReversalModel reversal_model = ReversalModel::constant;   ///< of the result; constant or by angle
    std::vector<ReversalTest>
        reversal_tests;  ///< of the six motions, where reversals by angle were adjusted; else empty

    std::shared_ptr<const gum::MeasurementModel> model;  ///< outputs: the reported quantities; for the GUM layer
    std::vector<gum::Diagnostic> notes;                  ///< what a reader must know of this result
};

/// Called now and then with a sentence on what is being done.
using Progress = std::function<void(const std::string&)>;

/// Joint adjustment from start values to the covariance in the datum asked for. The model is a RotaryTableModel.
///
/// Variance components are estimated where the measurement asks for it. Outlying distances are found one at a time: the
/// largest test value, an adjustment without it, and again (OneAtATime, at the weights of the last estimation of the
/// components, which is repeated when no more are found, until the exact adjustment finds none). One that agrees with
/// the others at the end comes back; where it is found and agrees once more it stays. A length noise whose redundancy
/// is below k_least_length_redundancy is held as stated, and tested with. By `OutlierAction` they are left out of the result or kept and flagged.
///
/// With ReversalModel::automatic the reversal is one of all angles, unless an adjustment with one at every angle shows
/// that they differ (test_reversals); what remains of the difference would else be taken for repeatability of the
/// table.
///
/// With FixtureComponent::check the weights use the stated covariance of the fixture; its component is estimated with
/// the others in a run of its own, and a warning says when it contradicts what is stated.
///
/// \throws gum::NoResultError  naming the parameters that are not determined, or when nothing converges
/// Accuracy: exact distances give the truth back within 1e-10 m and 1e-9 rad
/// (docs/accuracy.md#covariance-and-trials-of-a-rotary-table).
/// Example: examples/api/simulated_campaign.cpp
[[nodiscard]] RotaryTableSolution evaluate_jointly(const RotaryTableMeasurement& measurement,
                                                   const EvaluationOptions& options, const Progress& progress = {});

}  // namespace gumcert::engine
