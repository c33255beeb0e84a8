#include "engine/rotary_table_evaluation.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Where the iteration of the variance components starts when the job gives no idea: a good commercial table.
constexpr double k_start_linear = 0.2 * gum::k_micrometre;
constexpr double k_start_angular = 0.3 * gum::k_arcsecond;

StochasticModel start_model(const TableRepeatability& table) {
    StochasticModel model;
    if (table.mode == RepeatabilityMode::none) {
        return model;
    }
    const bool guess = table.mode == RepeatabilityMode::estimate;
    const auto square = [guess](double value, double start) {
        const double used = guess && value <= 0.0 ? start : value;
        return used * used;
    };
    model.variance_linear = square(table.u_linear, k_start_linear);
    model.variance_axial = square(table.u_axial, k_start_angular);
    model.variance_tilt = square(table.u_tilt, k_start_angular);
    return model;
}

[[noreturn]] void refuse_rank(const RankReport& rank) {
    std::string names;
    bool station = false;
    bool dead_path = false;
    bool pose = false;
    for (const std::string& name : rank.parameters) {
        names += (names.empty() ? "" : "; ") + name;
        station = station || name.starts_with("station");
        dead_path = dead_path || name.starts_with("dead path");
        pose = pose || name.find(" at angle number ") != std::string::npos;
    }
    std::string rule = "a result needs observations that determine every parameter";
    std::string action = "add stations, reflectors or angles in other directions";
    if (station && dead_path) {
        rule =
            "a station that sees all reflectors on a cone about one line cannot tell a move along that line from a "
            "longer dead path";
        action = "move the station off the rotary axis, or place reflectors at different distances from the axis";
    } else if (pose) {
        rule = "the six error motions of an angle need at least six distances in independent directions";
        action = "measure that angle from more stations or to more reflectors";
    }
    throw gum::NoResultError(
        gum::Diagnostic{"GC-RANK-0001", "adjustment", "not determined: " + names, rule, action, gum::Severity::error});
}

/// Kept in, they would carry the solution away from every other distance.
[[noreturn]] void refuse_gross_errors(const RotaryTableMeasurement& measurement,
                                      const std::vector<std::size_t>& gross) {
    std::vector<gum::Diagnostic> problems;
    for (const std::size_t i : gross) {
        const LengthObservation& length = measurement.lengths[i];
        problems.push_back({"GC-ADJUST-0007",
                            "lengths, line " + std::to_string(length.line) + " (" +
                                measurement.stations[length.station] + " to " +
                                measurement.reflectors[length.reflector] + ")",
                            "the length disagrees with all others of its station by more than centimetres",
                            "no adjustment can keep such a distance",
                            "correct or delete the line, or let the job leave it out with \"outliers\": {\"action\": "
                            "\"remove\"}",
                            gum::Severity::error});
    }
    throw gum::NoResultError(std::move(problems));
}

void require_convergence(const SolveSummary& summary) {
    if (!summary.converged) {
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0005", "adjustment", "did not converge (" + summary.message + ")",
            "a result is the minimum of the weighted squares",
            "check that stations, reflectors and angles of the lengths are not interchanged, and the start values",
            gum::Severity::error});
    }
}

/// The same solution with respect to another T_s, E(home) still zero.
JointAdjustment with_set_up(const JointAdjustment& from, const RigidMotion& set_up, const StochasticModel& stochastic) {
    const RotaryTableMeasurement& measurement = from.measurement();
    // At home the fixture stands at T_s: the table frame moves with it.
    const RigidMotion change = set_up * from.set_up().inverse();
    StartValues start = from.present_values();
    for (Eigen::Vector3d& station : start.stations) {
        station = change * station;
    }
    JointAdjustment result(measurement, from.active(), set_up, start, stochastic);
    const StartValues moved = result.present_values();
    result.copy_parameters_from(from);
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        Eigen::VectorXd block = result.adjustment().parameters(result.station_block(j));
        block.head<3>() = moved.stations[j];
        result.adjustment().set_parameters(result.station_block(j), block);
    }
    const Eigen::MatrixXd poses = from.poses();
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        const RigidMotion turn{nominal_rotation(measurement, i), Eigen::Vector3d::Zero()};
        Vector6 pose = Vector6::Zero();
        if (i != measurement.home) {
            pose = motion_parameters(change * rigid_motion(poses.col(static_cast<Eigen::Index>(i))) * turn *
                                     change.inverse() * turn.inverse());
        }
        result.adjustment().set_parameters(result.pose_block(i), pose);
    }
    result.set_weights(stochastic);
    return result;
}

JointAdjustment with_active(const JointAdjustment& from, const std::vector<bool>& active,
                            const StochasticModel& stochastic) {
    JointAdjustment result(from.measurement(), active, from.set_up(), from.present_values(), stochastic);
    result.copy_parameters_from(from);
    result.set_weights(stochastic);
    return result;
}

/// Adjustment, weights and test values that agree with each other.
class Iteration {
public:
    Iteration(const RotaryTableMeasurement& measurement, const Progress& progress) : progress_(progress) {
        estimated_.length = measurement.estimate_length_noise;
        estimated_.table = measurement.table_repeatability.mode == RepeatabilityMode::estimate;
    }

    /// Weights and parameters in turn until no variance moves by more than `tolerance` of its uncertainty.
    void settle(JointAdjustment& adjustment, StochasticModel& stochastic, int max_iterations, double tolerance,
                const SolverOptions& solver) {
        for (int i = 0; i < max_iterations; ++i) {
            const SolveSummary summary = adjustment.adjustment().refine(solver);
            require_convergence(summary);
            iterations += summary.iterations;
            normal.emplace(adjustment.adjustment().linearise());
            covariance = normal->covariance();
            step = estimate_variance_components(adjustment, *normal, covariance, stochastic, estimated_);
            if ((!estimated_.length && !estimated_.table) || step.relative_change < tolerance) {
                components_converged = true;
                return;
            }
            components_converged = false;
            stochastic = step.stochastic;
            adjustment.set_weights(stochastic);
            report("variance components, iteration " + std::to_string(++component_iterations));
        }
        require_convergence(adjustment.adjustment().refine(solver));
        normal.emplace(adjustment.adjustment().linearise());
        covariance = normal->covariance();
    }

    void report(const std::string& text) const {
        if (progress_) {
            progress_(text);
        }
    }

    /// Weights from derivatives at the very solution, so that whoever makes them again finds the same.
    void finish(JointAdjustment& adjustment, const StochasticModel& stochastic, const SolverOptions& solver) {
        adjustment.set_weights(stochastic);
        const SolveSummary summary = adjustment.adjustment().refine(solver);
        require_convergence(summary);
        iterations += summary.iterations;
        normal.emplace(adjustment.adjustment().linearise());
        covariance = normal->covariance();
    }

    [[nodiscard]] const EstimatedComponents& estimated() const { return estimated_; }

    std::optional<NormalEquations> normal;
    Eigen::MatrixXd covariance;
    VarianceComponentStep step;
    int iterations = 0;
    int component_iterations = 0;
    bool components_converged = false;

private:
    const Progress& progress_;
    EstimatedComponents estimated_;
};

/// Largest test value above the critical one, at most one an angle: outliers at one angle smear into each other.
std::vector<std::size_t> suspects(const RotaryTableMeasurement& measurement,
                                  const std::vector<DistanceReliability>& rows, const std::vector<bool>& active,
                                  double critical) {
    std::map<std::size_t, std::size_t> worst;
    double largest = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!active[i] || !(std::abs(rows[i].test_value) > critical)) {
            continue;
        }
        largest = std::max(largest, std::abs(rows[i].test_value));
        const auto [found, inserted] = worst.try_emplace(measurement.lengths[i].angle, i);
        if (!inserted && std::abs(rows[i].test_value) > std::abs(rows[found->second].test_value)) {
            found->second = i;
        }
    }
    std::vector<std::size_t> result;
    for (const auto& [angle, i] : worst) {
        // Much smaller ones may be the shadow of the largest through the stations: they get their turn later.
        if (std::abs(rows[i].test_value) > 0.5 * largest) {
            result.push_back(i);
        }
    }
    return result;
}

}  // namespace

RotaryTableSolution evaluate_jointly(const RotaryTableMeasurement& measurement, const EvaluationOptions& options,
                                     const Progress& progress) {
    Iteration iteration(measurement, progress);
    StochasticModel stochastic = start_model(measurement.table_repeatability);
    const OutlierOptions& outliers = measurement.outliers;
    const double critical = options.critical_value;
    const double non_centrality = options.non_centrality;

    iteration.report("start values");
    const std::vector<bool> all(measurement.lengths.size(), true);
    std::vector<bool> active = all;
    const std::vector<std::size_t> gross = find_gross_errors(measurement);
    if (!gross.empty() && (outliers.test == OutlierTest::none || outliers.action == OutlierAction::report)) {
        refuse_gross_errors(measurement, gross);
    }
    for (const std::size_t i : gross) {
        active[i] = false;
    }
    const StartValues start = find_start_values(measurement, active);
    JointAdjustment first(measurement, active, RigidMotion{}, start, stochastic);
    const RankReport geometry = first.adjustment().linearise().rank(options.solver.rank_tolerance);
    if (geometry.deficient) {
        refuse_rank(geometry);
    }
    iteration.report("joint adjustment");
    // While an outlier may still be in, the last digits of the solution are not worth their steps.
    SolverOptions rough = options.solver;
    rough.step_tolerance = 1e-3;
    const SolveSummary summary = first.adjustment().solve(rough);
    require_convergence(summary);
    const RankReport rank = first.adjustment().linearise().rank(options.solver.rank_tolerance);
    if (rank.deficient) {
        refuse_rank(rank);
    }
    iteration.iterations += summary.iterations;

    // The linear maps of the datum are exact for a T_s that is already that of the result.
    const DatumSolution preliminary = transform_to_datum(measurement, first.poses(), first.set_up(), measurement.datum);
    JointAdjustment adjustment = with_set_up(first, rigid_motion(preliminary.set_up), stochastic);

    std::vector<bool> reinserted(all.size(), false);
    std::vector<DistanceReliability> rows;
    for (int round = 0; round < options.max_outlier_rounds; ++round) {
        // Rough weights are enough to see gross outliers; the last rounds are exact.
        iteration.settle(adjustment, stochastic, 3, 0.05, rough);
        rows = distance_reliability(adjustment, *iteration.normal, iteration.covariance, stochastic, non_centrality);
        std::vector<std::size_t> worst;
        if (outliers.test == OutlierTest::data_snooping) {
            worst = suspects(measurement, rows, active, critical);
        }
        if (worst.empty()) {
            iteration.settle(adjustment, stochastic, options.max_component_iterations, options.component_tolerance,
                             options.solver);
            rows =
                distance_reliability(adjustment, *iteration.normal, iteration.covariance, stochastic, non_centrality);
            if (outliers.test == OutlierTest::data_snooping) {
                worst = suspects(measurement, rows, active, critical);
            }
        }
        bool changed = false;
        for (const std::size_t i : worst) {
            if (!reinserted[i]) {
                active[i] = false;
                changed = true;
                iteration.report("distance " + measurement.stations[measurement.lengths[i].station] + "–" +
                                 measurement.reflectors[measurement.lengths[i].reflector] + " found outlying");
            }
        }
        if (!changed) {
            // A distance that was left out in the shadow of a larger one comes back when it agrees after all.
            for (std::size_t i = 0; i < active.size(); ++i) {
                if (!active[i] && std::abs(rows[i].test_value) <= critical) {
                    active[i] = true;
                    reinserted[i] = true;
                    changed = true;
                }
            }
        }
        if (!changed) {
            break;
        }
        adjustment = with_active(adjustment, active, stochastic);
        const RankReport still = adjustment.adjustment().linearise().rank(options.solver.rank_tolerance);
        if (still.deficient) {
            refuse_rank(still);
        }
    }
    std::vector<bool> flagged(active.size());
    for (std::size_t i = 0; i < active.size(); ++i) {
        flagged[i] = !active[i];
    }
    if (outliers.action == OutlierAction::report && active != all) {
        active = all;
        adjustment = with_active(adjustment, active, stochastic);
        iteration.settle(adjustment, stochastic, options.max_component_iterations, options.component_tolerance,
                         options.solver);
        rows = distance_reliability(adjustment, *iteration.normal, iteration.covariance, stochastic, non_centrality);
    }
    iteration.finish(adjustment, stochastic, options.solver);
    rows = distance_reliability(adjustment, *iteration.normal, iteration.covariance, stochastic, non_centrality);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].flagged = flagged[i];
        rows[i].removed = !active[i];
    }

    RotaryTableSolution solution;
    const NormalEquations& normal = *iteration.normal;
    const Eigen::MatrixXd& covariance = iteration.covariance;
    solution.datum = transform_to_datum(measurement, adjustment.poses(), adjustment.set_up(), measurement.datum);
    solution.quantities = reported_quantities(measurement, adjustment.has_reversal());
    solution.values = reported_values(adjustment, solution.datum);
    const Eigen::MatrixXd map = reported_map(adjustment, normal, solution.datum);
    solution.covariance.noalias() = map * covariance * map.transpose();

    const auto pose_columns = [&](Eigen::MatrixXd& rows_of, const Eigen::MatrixXd& by_pose) {
        for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
            for (int c = 0; c < 6; ++c) {
                const Eigen::Index column = normal.column(adjustment.pose_block(i), c);
                if (column >= 0) {
                    rows_of.col(column) += by_pose.col(6 * static_cast<Eigen::Index>(i) + c);
                }
            }
        }
    };
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        const auto block = adjustment.station_block(j);
        const Eigen::VectorXd& value = adjustment.adjustment().parameters(block);
        StationEstimate station;
        station.position = solution.datum.world * value.head<3>();
        Eigen::Matrix<double, 3, 6> by_world;  // of a small motion of the world: [I, -q×]
        by_world << Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero();
        by_world.rightCols<3>() << 0.0, value[2], -value[1], -value[2], 0.0, value[0], value[1], -value[0], 0.0;
        Eigen::MatrixXd by_parameter = Eigen::MatrixXd::Zero(3, normal.parameter_count());
        for (int c = 0; c < 3; ++c) {
            by_parameter.col(normal.column(block, c)) += Eigen::Vector3d::Unit(c);
        }
        pose_columns(by_parameter, by_world * solution.datum.world_map);
        station.u = (by_parameter * covariance * by_parameter.transpose()).diagonal().cwiseSqrt();
        station.scale_deviation = value[3];
        if (const Eigen::Index column = normal.column(block, 3); column >= 0) {
            station.u_scale = std::sqrt(covariance(column, column));
        }
        solution.stations.push_back(station);
    }
    const auto paths = static_cast<Eigen::Index>(measurement.dead_paths.size());
    solution.dead_paths.resize(paths);
    solution.u_dead_paths.resize(paths);
    for (Eigen::Index d = 0; d < paths; ++d) {
        const auto block = adjustment.dead_path_block(static_cast<std::size_t>(d));
        const Eigen::Index column = normal.column(block, 0);
        solution.dead_paths[d] = adjustment.adjustment().parameters(block)[0];
        solution.u_dead_paths[d] = std::sqrt(covariance(column, column));
    }
    solution.fixture.resize(measurement.fixture.rows(), 3);
    solution.u_fixture.resize(measurement.fixture.rows(), 3);
    for (Eigen::Index m = 0; m < measurement.fixture.rows(); ++m) {
        for (int c = 0; c < 3; ++c) {
            const int component = static_cast<int>(3 * m) + c;
            const Eigen::Index column = normal.column(adjustment.fixture_block(), component);
            solution.fixture(m, c) = adjustment.adjustment().parameters(adjustment.fixture_block())[component];
            solution.u_fixture(m, c) = std::sqrt(covariance(column, column));
        }
    }

    solution.observations = normal.observation_count();
    solution.parameters = normal.parameter_count();
    solution.degrees_of_freedom = solution.observations - solution.parameters;
    solution.iterations = iteration.iterations;
    solution.chi_square = normal.chi_square();
    solution.condition_number = normal.condition_number();
    solution.stochastic = stochastic;
    solution.components = iteration.step.components;
    solution.reliability = std::move(rows);

    const auto nu = [&](std::size_t k) { return solution.components[k].degrees_of_freedom; };
    solution.model = std::make_shared<RotaryTableModel>(measurement, adjustment, stochastic,
                                                        SourceDegreesOfFreedom{nu(0), nu(1), nu(2), nu(3)});

    if (!iteration.components_converged && (iteration.estimated().length || iteration.estimated().table)) {
        solution.notes.push_back(
            {"GC-VARIANCE-0001", "variance components",
             "did not settle within " + std::to_string(iteration.component_iterations) + " iterations",
             "the stated uncertainties rest on the last values",
             "give the repeatability of the table instead of estimating it", gum::Severity::warning});
    }
    if (iteration.estimated().length && !iteration.step.length_separable) {
        solution.notes.push_back({"GC-VARIANCE-0002", "variance components",
                                  "one distance a visit of the table: the length noise is kept as stated",
                                  "a single distance does not separate its own noise from the repeatability of the "
                                  "table; their sum is estimated",
                                  "", gum::Severity::note});
    }
    if (!adjustment.has_reversal()) {
        solution.notes.push_back({"GC-REVERSAL-0001", "reversal", "not reported",
                                  "every station must be measured in both senses of approach to separate it", "",
                                  gum::Severity::note});
    }
    return solution;
}

}  // namespace gumcert::engine
