#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "engine/degrees_text.h"
#include "engine/median.h"
#include "engine/rotary_table/anglewise_map.h"
#include "engine/rotary_table/evaluation/repeatability_check.h"
#include "engine/rotary_table/evaluation/rival_tables.h"
#include "engine/rotary_table/evaluation/scaled_lengths.h"
#include "engine/rotary_table/evaluation/settled_errors.h"
#include "engine/rotary_table/evaluation/stated_positions.h"
#include "engine/rotary_table/evaluation/told_errors.h"
#include "engine/rotary_table/geometry_check.h"
#include "engine/rotary_table/group_notes.h"
#include "engine/rotary_table/start/start_search.h"
#include "engine/rotary_table/station_covariance.h"
#include "gum/quantity/units.h"
#include "text/degrees_of_freedom.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

std::string micrometres(double length, int digits = 3) {
    return text::significant(length / gum::k_micrometre, digits) + " µm";
}

/// Probability that at least `least` of `all` distances are wrong when each is with probability `share`, independently.
double binomial_tail(std::size_t least, std::size_t all, double share) {
    const double odds = share / (1.0 - share);
    double probability = std::pow(1.0 - share, static_cast<double>(all));  // of k wrong ones, from none upwards
    double below = 0.0;
    for (std::size_t k = 0; k < least; ++k) {
        below += probability;
        probability *= odds * static_cast<double>(all - k) / static_cast<double>(k + 1);
    }
    return std::max(0.0, 1.0 - below);
}

/// Whether distances that were left out are so many of one visit, reflector, station, or of one reflector seen from one
/// station, that wrong ones scattered over the measurement would hardly be: then it may be the group that is wrong, and
/// what is left of it does not say so any more.
bool is_concentrated(const RotaryTableMeasurement& measurement, const std::vector<bool>& active) {
    constexpr double k_level = 0.05;  // of all groups of a kind: single blunders come together by chance
    constexpr std::size_t k_fewest = 2;
    struct Count {
        std::size_t out = 0, all = 0;
    };
    using Group = std::pair<std::size_t, std::size_t>;
    std::map<Group, Count> visits, reflectors, stations, pairs;
    std::size_t out = 0;
    for (std::size_t i = 0; i < active.size(); ++i) {
        const LengthObservation& length = measurement.lengths[i];
        const std::size_t is_out = active[i] ? 0 : 1;
        for (Count* count : {&visits[{length.pass, length.angle}], &reflectors[{length.reflector, 0}],
                             &stations[{length.station, 0}], &pairs[{length.station, length.reflector}]}) {
            ++count->all;
            count->out += is_out;
        }
        out += is_out;
    }
    const double share = static_cast<double>(out) / static_cast<double>(active.size());
    return std::ranges::any_of(std::array{&visits, &reflectors, &stations, &pairs}, [&](const auto* groups) {
        return std::ranges::any_of(*groups, [&](const auto& group) {
            const Count& count = group.second;
            return count.out >= k_fewest &&
                   static_cast<double>(groups->size()) * binomial_tail(count.out, count.all, share) < k_level;
        });
    });
}

/// "P1, P4": of the stations where others have both senses of approach; "" where none or all have them.
std::string stations_in_one_sense(const RotaryTableMeasurement& measurement) {
    std::vector<std::array<bool, 2>> senses(measurement.stations.size(), {false, false});
    for (const LengthObservation& length : measurement.lengths) {
        senses[length.station][length.approach == Approach::positive ? 0 : 1] = true;
    }
    std::string stations;
    for (std::size_t j = 0; j < senses.size(); ++j) {
        if (!(senses[j][0] && senses[j][1])) {
            stations += (stations.empty() ? "" : ", ") + measurement.stations[j];
        }
    }
    const bool is_mixed = std::ranges::any_of(senses, [](const auto& both) { return both[0] && both[1]; });
    return is_mixed ? stations : "";
}

/// The distance that fits worst is left out, one after the other: of few distances more than unknowns this can go on until nothing
/// is left that could object, and what remains agrees with itself whichever distances are the wrong ones. A repeatability of the
/// table that is estimated takes up what a false choice leaves: then it is the redundancy of the length noise that could object.
/// \param length_redundancy  [1]; 0: not known
/// \param held_noise         u of a length where it is as stated, [m]; 0: estimated
void require_rest_that_can_object(std::size_t left_out, Eigen::Index degrees_of_freedom, double length_redundancy,
                                  std::size_t lengths, double held_noise) {
    constexpr std::size_t k_several = 2;  // one stands out by itself
    constexpr double k_least_of_each = 2.0;
    const bool is_of_few = static_cast<Eigen::Index>(left_out) > degrees_of_freedom;
    const bool is_taken_up = left_out >= k_several && length_redundancy > 0.0 &&
                             length_redundancy < k_least_of_each * static_cast<double>(left_out);
    if (!is_of_few && !is_taken_up) {
        return;
    }
    throw gum::NoResultError(gum::Diagnostic{
        "GC-ADJUST-0017", "outlying distances",
        std::to_string(left_out) + " of " + std::to_string(lengths) + " distances left out, with " +
            (is_of_few ? text::degrees_of_freedom(std::to_string(degrees_of_freedom)) + " that remain" +
                             (degrees_of_freedom == 1 ? "s" : "")
                       : "a redundancy of " +
                             (length_redundancy < 99.5 ? text::significant(length_redundancy, 2)
                                                       : text::fixed(length_redundancy, 0)) +
                             " that remains to the length noise"),
        is_of_few ? "at least as many degrees of freedom as distances that are left out must remain: with fewer, "
                    "another choice of distances agrees as well"
                  : "a redundancy of the length noise of two must remain for each of several distances that are left "
                    "out: with less, the repeatability of the table makes up for another choice of them",
        "measure more stations, reflectors or passes, or look for the cause of the deviations and correct the "
        "distances" +
            (held_noise > 0.0 ? "; where there is none, see whether the stated standard uncertainty of a length, " +
                                    micrometres(held_noise) + ", is too small"
                              : std::string()),
        gum::Severity::error});
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

void require_convergence(const SolveSummary& summary, const RotaryTableMeasurement& measurement) {
    if (!summary.converged) {
        // In the place of micrometres, a stated uncertainty in millimetres makes the distances a thousand times stiffer than
        // what is known of the fixture, and no step comes to an end.
        const double constant = measurement.length_uncertainty.u_constant;
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0005", "adjustment", "did not converge (" + summary.message + ")",
            "a result is the minimum of the weighted squares",
            "check that stations, reflectors and angles of the lengths are not interchanged, the start values, and the "
            "stated standard uncertainty of a length" +
                // What grows with the distance may be all that is stated.
                (constant > 0.0 ? ", " + micrometres(constant, 6) : std::string()),
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
    result.adjustment().set_workers(from.adjustment().workers());
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
        // E(home) stays zero: it is the datum of the solver, also with the other T_s.
        if (i != measurement.home) {
            pose = motion_parameters(change * rigid_motion(poses.col(static_cast<Eigen::Index>(i))) * turn *
                                     change.inverse() * turn.inverse());
        }
        result.set_pose(i, pose);
    }
    result.set_weights(stochastic);
    return result;
}

JointAdjustment with_active(const JointAdjustment& from, const std::vector<bool>& active,
                            const StochasticModel& stochastic) {
    JointAdjustment result(from.measurement(), active, from.set_up(), from.present_values(), stochastic);
    result.adjustment().set_workers(from.adjustment().workers());
    result.copy_parameters_from(from);
    result.set_weights(stochastic);
    return result;
}

// Mean whitened residual above which something is grossly wrong, and the robust search is asked.
constexpr double k_gross_misfit = 30.0;
// Gauss-Newton steps within which an adjustment without gross errors comes to its end; sound ones need three.
constexpr int k_refinements_without_gross_errors = 8;
// Times that gross errors are looked for, each without those that were found before.
constexpr int k_most_gross_searches = 5;
// Deviation from the others of a visit that no repeatability makes, and that the linear search would not survive.
constexpr double k_gross_deviation = 200.0 * gum::k_micrometre;

/// Of the two middle values of an even number the one nearer to zero: where half of a visit is wrong, the other half is
/// where the other visits put it.
double nearer_median(std::vector<double> values) {
    std::ranges::sort(values);
    const double upper = values[values.size() / 2];
    const double lower = values[(values.size() - 1) / 2];
    return std::abs(lower) < std::abs(upper) ? lower : upper;
}

/// Distances that deviate from the median of their visit by far more than those of the other visits do, at the place
/// where most visits agree, the largest first. The adjustment is left there.
std::vector<std::size_t> find_gross_deviations(JointAdjustment& adjustment, const SolverOptions& solver) {
    constexpr double k_times_scale = 100.0;
    SolverOptions robust = solver;
    robust.robust_scale = k_robust_scale;
    robust.max_iterations = 200;
    if (!adjustment.adjustment().solve(robust).converged) {
        return {};
    }
    std::vector<double> sizes;
    std::vector<std::pair<std::size_t, double>> deviations;
    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        const Eigen::VectorXd residual = adjustment.adjustment().residual(v);
        if (residual.size() < 3) {
            continue;
        }
        const double middle = nearer_median({residual.begin(), residual.end()});
        for (Eigen::Index i = 0; i < residual.size(); ++i) {
            const double size = std::abs(residual[i] - middle);
            sizes.push_back(size);
            deviations.emplace_back(adjustment.visits()[v].observations[static_cast<std::size_t>(i)], size);
        }
    }
    if (sizes.empty()) {
        return {};
    }
    std::ranges::stable_sort(deviations, std::greater{}, &std::pair<std::size_t, double>::second);
    std::vector<std::size_t> found;
    // By the scale of all deviations as well: a table that repeats badly spreads the distances of each visit.
    const double limit = std::max(k_gross_deviation, k_times_scale * upper_median(sizes));
    for (const auto& [length, size] : deviations) {
        if (size > limit) {
            found.push_back(length);
        }
    }
    return found;
}

/// Whether two visits or more were lost whole: it is not their distances that are wrong.
bool has_whole_visits(const RotaryTableMeasurement& measurement, const std::vector<std::size_t>& gross) {
    constexpr std::size_t k_fewest = 2;
    std::map<std::pair<std::size_t, std::size_t>, std::pair<std::size_t, std::size_t>> visits;  // all and gross
    for (const LengthObservation& length : measurement.lengths) {
        ++visits[{length.pass, length.angle}].first;
    }
    for (const std::size_t i : gross) {
        ++visits[{measurement.lengths[i].pass, measurement.lengths[i].angle}].second;
    }
    return std::ranges::count_if(visits, [](const auto& visit) {
               return visit.second.second > 1 && visit.second.second == visit.second.first;
           }) >= static_cast<std::ptrdiff_t>(k_fewest);
}

std::string size_of(const VarianceComponent& component, double value) {
    return component.angular ? text::significant(value / gum::k_arcsecond, 2) + "″" : micrometres(value, 2);
}

/// Nothing can be stated where the distances leave a table plausible that nobody has.
void require_determined_components(const std::vector<VarianceComponent>& components) {
    std::vector<gum::Diagnostic> problems;
    for (const VarianceComponent& component : components) {
        if (!component.determined) {
            problems.push_back({"GC-VARIANCE-0008", "variance components, " + component.name,
                                std::isfinite(component.u) ? "the distances do not determine it: they leave up to " +
                                                                 size_of(component, component.value) + " plausible"
                                                           : std::string("the distances say nothing of it"),
                                "an uncertainty is stated of components that are given, or that the distances bound",
                                "state the repeatability of the table in table_repeatability with \"mode\": \"given\", "
                                "or measure more "
                                "stations, reflectors or passes",
                                gum::Severity::error});
        }
    }
    if (!problems.empty()) {
        throw gum::NoResultError(std::move(problems));
    }
}

/// Adjustment and weights that agree with each other.
class Iteration {
public:
    Iteration(const EstimatedComponents& estimated, const Progress& progress)
        : progress_(progress), estimated_(estimated) {}

    /// Weights and parameters in turn until no variance moves by more than `tolerance` of its uncertainty.
    void settle(JointAdjustment& adjustment, StochasticModel& stochastic, int max_iterations, double tolerance,
                const SolverOptions& solver) {
        // New weights move the parameters by parts of their uncertainties, where the model is linear: one step each.
        constexpr double k_linear_step = 1.0;
        SolverOptions weights_only = solver;
        weights_only.step_tolerance = std::max(solver.step_tolerance, k_linear_step);
        for (int i = 0; i < max_iterations; ++i) {
            solve(adjustment, i == 0 ? solver : weights_only);
            // Whether the residuals depend on the fixture at all is tested once, at its stated covariance.
            if (estimated_.fixture && !fixture_asked_) {
                fixture_asked_ = true;
                if (fixture_redundancy(adjustment, *normal, covariance) < k_least_component_redundancy) {
                    drop_fixture(stochastic);
                }
            }
            step = estimate_variance_components(adjustment, *normal, covariance, stochastic, estimated_);
            if (i == 0 && !length_asked_) {
                length_asked_ = true;
                if (length_noise_is_weak()) {
                    hold_length_noise(adjustment, stochastic);
                    solve(adjustment, solver);
                    step = estimate_variance_components(adjustment, *normal, covariance, stochastic, estimated_);
                }
            }
            if (!any_estimated() || step.relative_change < tolerance) {
                components_converged = true;
                return;
            }
            components_converged = false;
            stochastic = step.stochastic;
            adjustment.set_weights(stochastic);
            report("variance components, iteration " + std::to_string(++component_iterations));
        }
        solve(adjustment, solver);
    }

    /// Exactly, with weights from derivatives at the very solution, so that weights made again from it are the same.
    void settle_exactly(JointAdjustment& adjustment, StochasticModel& stochastic, const EvaluationOptions& options) {
        settle(adjustment, stochastic, options.max_component_iterations, options.component_tolerance, options.solver);
        if (estimated_.fixture && fixture_is_weak()) {
            drop_fixture(stochastic);
            adjustment.set_weights(stochastic);
            settle(adjustment, stochastic, options.max_component_iterations, options.component_tolerance,
                   options.solver);
        }
        if (length_noise_is_weak()) {
            hold_length_noise(adjustment, stochastic);
            settle(adjustment, stochastic, options.max_component_iterations, options.component_tolerance,
                   options.solver);
        }
        chi_square_of_estimates = normal->chi_square();
        take_plausible(stochastic);
        adjustment.set_weights(stochastic);
        solve(adjustment, options.solver);
        normal.emplace(adjustment.adjustment().linearise());
        covariance = normal->bordered_covariance();
    }

    /// What the residuals leave plausible of components that they hardly determine, instead of their estimates.
    void take_plausible(StochasticModel& stochastic) {
        take_plausible_components(step);
        require_determined_components(step.components);
        for (std::size_t k = table_linear; k <= table_tilt; ++k) {
            if (step.components[k].residuals_give) {
                double& to = k == table_linear  ? stochastic.variance_linear
                             : k == table_axial ? stochastic.variance_axial
                                                : stochastic.variance_tilt;
                to = step.components[k].value * step.components[k].value;
            }
        }
    }

    void report(const std::string& text) const {
        if (progress_) {
            progress_(text);
        }
    }

    [[nodiscard]] const EstimatedComponents& estimated() const { return estimated_; }
    /// True where the estimate of the fixture went to a value at which the distances no longer determine it.
    [[nodiscard]] bool fixture_is_weak() const {
        return step.fixture_at_bound || step.components[fixture_cmm].redundancy < k_least_component_redundancy;
    }
    /// True where too little of the redundancy depends on the length noise: its estimate would be made of the few
    /// residuals that it is then to judge.
    [[nodiscard]] bool length_noise_is_weak() const {
        return estimated_.length && step.length_separable && step.length_redundancy < k_least_length_redundancy;
    }
    [[nodiscard]] bool any_estimated() const { return estimated_.length || estimated_.table || estimated_.fixture; }

    std::optional<NormalEquations> normal;
    BorderedCovariance covariance;
    VarianceComponentStep step;
    int iterations = 0;
    int component_iterations = 0;
    bool components_converged = false;
    double chi_square_of_estimates = 0.0;  // before what is plausible took their place
    bool fixture_separable = true;
    std::optional<double> held_length_redundancy;  ///< of a length noise that was to be estimated and is held as stated

private:
    void solve(JointAdjustment& adjustment, const SolverOptions& solver) {
        normal.emplace();
        const SolveSummary summary = adjustment.adjustment().refine(solver, *normal);
        require_convergence(summary, adjustment.measurement());
        iterations += summary.iterations;
        covariance = normal->bordered_covariance();
    }

    void hold_length_noise(JointAdjustment& adjustment, StochasticModel& stochastic) {
        held_length_redundancy = step.length_redundancy;
        estimated_.length = false;
        stochastic.length_factor = 1.0;
        adjustment.set_weights(stochastic);
    }

    void drop_fixture(StochasticModel& stochastic) {
        estimated_.fixture = false;
        fixture_separable = false;
        stochastic.fixture_factor = 1.0;
    }

    const Progress& progress_;
    EstimatedComponents estimated_;
    bool fixture_asked_ = false, length_asked_ = false;
};

/// Critical value of the test values, and what it rests on.
struct TestLimits {
    double critical_value = 0.0;
    std::optional<double> degrees_of_freedom;  ///< of Pope's tau
    double non_centrality = 0.0;
};

TestLimits test_limits(const EvaluationOptions& options, const VarianceComponent& component) {
    TestLimits limits{options.critical_value, std::nullopt, options.non_centrality};
    // A variance that was estimated from the same residuals makes the largest of them smaller (Pope 1976).
    if (component.estimated && component.redundancy > 2.0 && options.student_critical_value) {
        limits.degrees_of_freedom = component.redundancy;
        limits.critical_value =
            tau_critical_value(options.student_critical_value(component.redundancy - 1.0), component.redundancy);
        limits.non_centrality += limits.critical_value - options.critical_value;
    }
    return limits;
}

// Above this, leaving a distance out moves the solution so far that its second-order effect on the others, about the
// square of this over the length, is more than some nanometres.
constexpr double k_linear_reach = 50.0 * gum::k_micrometre;

/// Errors below this are not told from what a larger one does to the linearised model: the derivatives are taken anew
/// before such a distance is left out.
double second_order_effect(double error) {
    constexpr double k_safety = 10.0;
    constexpr double k_short_length = 0.3;  // [m]
    return k_safety * error * error / k_short_length;
}
// Share of flagged distances above which it is hardly the distances that are wrong.
constexpr double k_many_outliers = 0.05;
// Solver step of adjustments that only check: neither the last digits of the parameters nor of components matter.
constexpr double k_step_of_a_check = 1e-4;
// The same where outliers are all in: they make the steps slow, and test values are asked for no more than two digits.
constexpr double k_step_of_many_outliers = 1e-2;
// Change of a variance, in parts of its uncertainty, at which such an adjustment ends.
constexpr double k_component_of_a_check = 1e-2;
// Probability of warning of a fixture that is as stated: what the tests of groups leave of their level.
constexpr double k_fixture_test_level = 0.001;

/// Of drifts and changes that are not suspicious, the least probable one whose probability is near its level. A single
/// visit is none of them: without the largest of all visits the variances are too small for the others.
const GroupTest* nearly_suspicious(const GroupTests& groups, const GroupTestOptions& options) {
    constexpr double k_near = 30.0;  // times the level
    const GroupTest* nearest = nullptr;
    double least = k_near;
    for (const GroupTest& test : groups.tests) {
        const double level = options.chi_square_upper_tail(test.critical_value, test.degrees_of_freedom);
        if (!test.errors.empty() && test.p_value < least * level) {
            least = test.p_value / level;
            nearest = &test;
        }
    }
    return nearest;
}

/// A measurement of which a group is taken for wrong, by what it is said to be.
/// \param adjustment  whose visits the errors of the group are those of
RotaryTableMeasurement without_group(const GroupTest& group, const JointAdjustment& adjustment) {
    RotaryTableMeasurement corrected = adjustment.measurement();
    for (const auto& [visit, error] : group.errors) {
        for (const std::size_t i : adjustment.visits()[visit].observations) {
            corrected.lengths[i].length -= error;
        }
    }
    return corrected;
}

/// How far a check goes, which tells a cause and gives no result.
SolverOptions solver_of_a_check(const EvaluationOptions& options) {
    SolverOptions solver = options.solver;
    solver.step_tolerance = std::max(solver.step_tolerance, k_step_of_a_check);
    return solver;
}

/// Estimates the variances of a corrected measurement.
void settle_for_a_check(JointAdjustment& without, const EstimatedComponents& estimated, StochasticModel& stochastic,
                        const EvaluationOptions& options) {
    const Progress silent;
    Iteration iteration(estimated, silent);
    iteration.settle(without, stochastic, options.max_component_iterations,
                     std::max(options.component_tolerance, k_component_of_a_check), solver_of_a_check(options));
    iteration.take_plausible(stochastic);
}

/// Variances of a measurement of which a group is taken for wrong, by what it is said to be.
StochasticModel variances_without(const GroupTest& group, const JointAdjustment& adjustment,
                                  const EstimatedComponents& estimated, StochasticModel stochastic,
                                  const EvaluationOptions& options) {
    const RotaryTableMeasurement corrected = without_group(group, adjustment);
    JointAdjustment without(corrected, adjustment.active(), adjustment.set_up(), adjustment.present_values(),
                            stochastic);
    without.adjustment().set_workers(options.workers);
    without.copy_parameters_from(adjustment);
    without.set_weights(stochastic);
    settle_for_a_check(without, estimated, stochastic, options);
    return stochastic;
}

/// Groups of a corrected measurement. The variances were estimated with the errors in, which were charged to some of the
/// components only: at those weights something else would be told that is none.
/// \param without  solved
GroupTests groups_at_own_variances(JointAdjustment& without, const EstimatedComponents& estimated,
                                   StochasticModel stochastic, const EvaluationOptions& options,
                                   const GroupTestOptions& group_options) {
    settle_for_a_check(without, estimated, stochastic, options);
    without.set_weights(stochastic);
    require_convergence(without.adjustment().refine(solver_of_a_check(options)), without.measurement());
    const NormalEquations normal = without.adjustment().linearise();
    return test_groups(without, normal, normal.bordered_covariance(), group_options);
}

/// Scale errors of stations, each its own.
ErrorModel scale_errors(const std::vector<GroupTest>& told) {
    std::vector<std::size_t> stations;
    std::ranges::transform(told, std::back_inserter(stations), &GroupTest::station);
    const auto take_off = [stations](RotaryTableMeasurement& measurement, const Eigen::VectorXd& sizes) {
        for (LengthObservation& length : measurement.lengths) {
            const auto of = std::ranges::find(stations, length.station);
            if (of != stations.end()) {
                length.length /= 1.0 + sizes[of - stations.begin()];
            }
        }
    };
    const auto sizes = [stations](const JointAdjustment& at, const NormalEquations& normal,
                                  const BorderedCovariance& covariance) {
        return SizesLeft{scale_errors_of_stations(at, normal, covariance, stations)};
    };
    return {std::ssize(told), take_off, sizes};
}

/// One of the size of the fixture.
ErrorModel scale_error_of_coordinates() {
    return {1,
            [](RotaryTableMeasurement& measurement, const Eigen::VectorXd& sizes) {
                measurement.fixture /= 1.0 + sizes[0];
            },
            [](const JointAdjustment& at, const NormalEquations& normal, const BorderedCovariance& covariance) {
                return SizesLeft{Eigen::VectorXd::Constant(1, scale_error_of_fixture(at, normal, covariance))};
            }};
}

/// What tests of groups need beside the adjustment.
struct GroupSetting {
    const EstimatedComponents& estimated;
    const StochasticModel& stochastic;
    const EvaluationOptions& options;
    const GroupTestOptions& group_options;
    const std::vector<bool>& but_gross;  ///< distances without gross errors
};

/// A measurement without an error that may be what made single distances outlying: with all of them, and then without those
/// that are outlying still.
std::optional<SettledErrors> settle_with_all(const ErrorModel& model, const JointAdjustment& adjustment,
                                             const GroupSetting& setting) try {
    const SolverOptions solver = solver_of_a_check(setting.options);
    const JointAdjustment whole = with_active(adjustment, setting.but_gross, setting.stochastic);
    std::optional<SettledErrors> settled = settle_errors(model, whole, setting.stochastic, solver);
    const OutlierOptions& outliers = adjustment.measurement().outliers;
    if (!settled || outliers.test != OutlierTest::data_snooping || outliers.action != OutlierAction::remove) {
        return settled;
    }
    const NormalEquations normal = settled->without->adjustment().linearise();
    const BorderedCovariance covariance = normal.bordered_covariance();
    OneAtATime search(*settled->without, normal, covariance);
    std::vector<bool> active = setting.but_gross;
    while (const auto suspect = search.largest(setting.options.critical_value)) {
        search.leave_out(suspect->length);
        active[suspect->length] = false;
    }
    // What is concentrated may be a second cause, and is told by the tests of groups: they need its distances.
    return active == setting.but_gross || is_concentrated(adjustment.measurement(), active)
               ? std::move(settled)
               : settle_errors(model, with_active(adjustment, active, setting.stochastic), setting.stochastic, solver);
} catch (const gum::NoResultError&) {
    return std::nullopt;  // a check, which the result does not need
}

/// Chi-square for each distance.
double mean_misfit(const JointAdjustment& adjustment) {
    const NormalEquations normal = adjustment.adjustment().linearise();
    return normal.chi_square() / static_cast<double>(normal.observation_count());
}

/// Whether nearly all that is wrong goes with errors that are told: then they come first, whatever the linearised model shows
/// beside them.
bool explains_nearly_all(const SettledErrors& settled, const JointAdjustment& adjustment) {
    constexpr double k_share_left = 0.25;
    return mean_misfit(*settled.without) < k_share_left * mean_misfit(adjustment);
}

/// Scale errors below are told by the linearised model as well.
constexpr double k_linear_scale = 5e-5;

/// The scale error of a kind from which the search begins: the least probable group of all, or one of so many ppm that what
/// the linearised model shows in its place says nothing.
const GroupTest* first_scale_error(const GroupTests& groups, GroupKind kind) {
    const auto found = std::ranges::find_if(
        groups.tests, [kind](const GroupTest& test) { return test.suspicious && test.kind == kind; });
    return found != groups.tests.end() && (found == groups.tests.begin() || std::abs(found->estimate) > k_linear_scale)
               ? &*found
               : nullptr;
}

/// Groups beside errors that are told, of the measurement without them; none where they cannot be told.
std::optional<std::vector<GroupTest>> groups_beside(const SettledErrors& settled, const GroupSetting& setting) {
    try {
        JointAdjustment own = *settled.without;  // whose weights stay those of the error
        return groups_at_own_variances(own, setting.estimated, setting.stochastic, setting.options,
                                       setting.group_options)
            .tests;
    } catch (const gum::NoResultError&) {
        return std::nullopt;  // a check, which the result does not need
    }
}

/// Puts what is told before the others. Of those that the linearised model shows beside a large error nothing is told.
void put_first(std::vector<GroupTest>& tests, const std::vector<GroupTest>& told,
               std::optional<std::vector<GroupTest>> others) {
    if (others) {
        tests = std::move(*others);
    } else {
        std::erase_if(tests, &GroupTest::suspicious);
    }
    std::erase_if(tests, [&](const GroupTest& test) {
        return std::ranges::any_of(told, [&](const GroupTest& of) {
            return test.kind == of.kind && (!test.suspicious || test.station == of.station);
        });
    });
    tests.insert(tests.begin(), told.begin(), told.end());
}

/// Groups with scale errors first that are told, with the sizes that the measurement without them confirms.
/// \param first   of the linearised model, which the others follow
/// \param settled  none where no adjustment confirms a size
GroupTests with_scale_errors(GroupTests groups, const GroupTest* first, std::vector<GroupTest> told,
                             const std::optional<SettledErrors>& settled, std::optional<std::vector<GroupTest>> others,
                             const JointAdjustment& adjustment) {
    const bool is_first = first == groups.tests.data();
    if (settled ? !is_first && !explains_nearly_all(*settled, adjustment)
                : !is_first || std::abs(first->estimate) <= k_linear_scale) {
        // What is told before it may be why it does not settle alone.
        for (GroupTest& test : groups.tests) {
            test.is_determined = test.is_determined && (!test.suspicious || test.kind != first->kind ||
                                                        std::abs(test.estimate) <= k_linear_scale);
        }
        return groups;
    }
    for (std::size_t k = 0; k < told.size(); ++k) {
        told[k].is_settled = settled.has_value();
        if (settled) {
            told[k].estimate = settled->sizes[static_cast<Eigen::Index>(k)];
        }
    }
    put_first(groups.tests, told, std::move(others));
    return groups;
}

/// Groups of a measurement whose fixture is larger or smaller than stated: by how much, and what else is suspicious, with
/// coordinates of that size.
GroupTests without_fixture_scale(GroupTests groups, const JointAdjustment& adjustment, const GroupSetting& setting) {
    const GroupTest* const first = first_scale_error(groups, GroupKind::fixture_scale);
    if (first == nullptr) {
        return groups;
    }
    const auto settled = settle_with_all(scale_error_of_coordinates(), adjustment, setting);
    auto others = settled ? groups_beside(*settled, setting) : std::nullopt;
    const std::vector<GroupTest> told{*first};
    return with_scale_errors(std::move(groups), first, told, settled, std::move(others), adjustment);
}

/// Groups of a measurement of which stations have scale errors: how large they are, and what else is suspicious, from the
/// distances without them. An error of many ppm moves the temperature of the fixture at the station so far from what is stated
/// that the linearised tests are not those of the measurement, and the scale of a second station is told as another cause.
GroupTests without_scale_errors(GroupTests groups, const JointAdjustment& adjustment, const GroupSetting& setting) {
    const GroupTest* const first = first_scale_error(groups, GroupKind::station_scale);
    if (first == nullptr) {
        return groups;
    }
    std::vector<GroupTest> told{*first};
    const std::size_t most = adjustment.measurement().stations.size() / 2;  // of more it is the others that are wrong
    auto settled = settle_with_all(scale_errors(told), adjustment, setting);
    auto others = settled ? groups_beside(*settled, setting) : std::nullopt;
    while (others && told.size() < most) {
        const auto next = std::ranges::find_if(*others, [&](const GroupTest& test) {
            return test.suspicious && test.kind == GroupKind::station_scale &&
                   std::ranges::find(told, test.station, &GroupTest::station) == told.end();
        });
        if (next == others->end()) {
            break;
        }
        told.push_back(*next);
        auto jointly = settle_with_all(scale_errors(told), adjustment, setting);
        if (!jointly) {
            told.pop_back();
            break;
        }
        settled = std::move(jointly);
        others = groups_beside(*settled, setting);
    }
    return with_scale_errors(std::move(groups), first, std::move(told), settled, std::move(others), adjustment);
}

/// Whether a group is suspicious and names a cause that can be taken off.
bool is_told_error(const GroupTest& test) {
    return test.suspicious && test.columns.size() > 0;
}

bool is_same_group(const GroupTest& a, const GroupTest& b) {
    return a.kind == b.kind && a.station == b.station && a.reflector == b.reflector && a.pass == b.pass &&
           a.angle == b.angle && a.last_angle == b.last_angle;
}

/// What contradicts a measurement without the errors that are told: by the global test where all variances are stated, which an
/// error that is told may have refuted; else, where that test has nothing to say, a group.
/// \param without  at its own variances
/// \param beside   groups of that measurement
std::optional<ContradictionLeft> contradiction_left(JointAdjustment without, const GroupTests& beside,
                                                    const GroupSetting& setting) {
    constexpr double k_refuting = 0.001;  // as of the global test of a result
    const TableRepeatability& table = without.measurement().table_repeatability;
    if (!setting.estimated.length && table.mode != RepeatabilityMode::estimate) {
        without.set_weights(start_variances(table));
        require_convergence(without.adjustment().refine(solver_of_a_check(setting.options)), without.measurement());
        const NormalEquations normal = without.adjustment().linearise();
        const auto nu = static_cast<double>(normal.observation_count() - normal.parameter_count());
        const double p = nu > 0.0 ? setting.group_options.chi_square_upper_tail(normal.chi_square(), nu) : 1.0;
        return p < k_refuting ? std::optional(ContradictionLeft{.p_value = p}) : std::nullopt;
    }
    const auto worst = std::ranges::find_if(
        beside.tests, [](const GroupTest& test) { return is_told_error(test) && test.p_value < k_refuting; });
    return worst == beside.tests.end()
               ? std::nullopt
               : std::optional(ContradictionLeft{.p_value = worst->p_value, .is_of_a_group = true});
}

/// Groups with the sizes of those that are told: of one adjustment with all of them. What the others explain is not told, and a
/// scale that shows itself without them is.
/// \param told  that the search begins with
/// \param at_once  what is added in one round
/// \return none where it comes to no end
std::optional<GroupTests> with_sizes_from(GroupTests groups, std::vector<GroupTest> told, std::size_t at_once,
                                          const JointAdjustment& adjustment, const GroupSetting& setting) try {
    constexpr int k_most_rounds = 8;
    for (int round = 0; round < k_most_rounds; ++round) {
        const auto settled = settle_with_all(errors_of_groups(told), adjustment, setting);
        if (!settled) {
            return std::nullopt;
        }
        JointAdjustment own = *settled->without;
        const GroupTests beside =
            groups_at_own_variances(own, setting.estimated, setting.stochastic, setting.options, setting.group_options);
        const bool are_all = take_joint_sizes(told, adjustment.visits(), settled->taken_off, own,
                                              std::max(1.0, beside.scale), setting.group_options.chi_square_upper_tail);
        std::size_t added = 0;
        for (const GroupTest& test : beside.tests) {
            if (!is_told_error(test) || added == at_once) {
                continue;
            }
            if (std::ranges::any_of(told, [&](const GroupTest& of) { return is_same_group(of, test); })) {
                return std::nullopt;  // the same error once more is none that settled
            }
            // A scale is what the linearised model shows as something else, and hides. Other kinds it would have shown: beside a
            // cause that is not the true one they are parts of what that leaves.
            if (test.kind == GroupKind::fixture_scale || test.kind == GroupKind::station_scale) {
                told.push_back(test);
                ++added;
            }
        }
        if (are_all && added == 0) {
            put_first(groups.tests, told, std::nullopt);
            groups.left = contradiction_left(own, beside, setting);
            return groups;
        }
    }
    return std::nullopt;
} catch (const gum::NoResultError&) {
    return std::nullopt;  // a check, which the result does not need
}

/// The same from all that the linearised model shows, or else from the first of it and one after the other. No size is told of several
/// where neither comes to an end.
GroupTests with_joint_sizes(GroupTests groups, const JointAdjustment& adjustment, const GroupSetting& setting) {
    // What a group does to a distance that was left out is not among its columns, and may contradict the others there: only what
    // is left without these distances, too, counts.
    const GroupSetting of_used{setting.estimated, setting.stochastic, setting.options, setting.group_options,
                               adjustment.active()};
    std::vector<GroupTest> told;
    std::ranges::copy_if(groups.tests, std::back_inserter(told), is_told_error);
    if (told.empty()) {
        return groups;
    }
    for (const bool one_by_one : {false, true}) {
        if (one_by_one) {
            told.resize(1);
        }
        const std::size_t at_once = one_by_one ? 1 : groups.tests.size();
        if (auto found = with_sizes_from(groups, told, at_once, adjustment, setting)) {
            if (found->left) {
                const auto again = with_sizes_from(groups, told, at_once, adjustment, of_used);
                found->left = again ? again->left : std::nullopt;
            }
            // One that is alone has its size already.
            const bool is_as_before = std::ranges::count_if(groups.tests, is_told_error) == 1 &&
                                      std::ranges::count_if(found->tests, is_told_error) == 1 &&
                                      is_same_group(groups.tests.front(), found->tests.front());
            if (is_as_before) {
                groups.left = found->left;
                return groups;
            }
            return std::move(*found);
        }
    }
    if (std::ranges::count_if(groups.tests, is_told_error) > 1) {
        for (GroupTest& test : groups.tests) {
            test.is_determined = test.is_determined && !is_told_error(test);
        }
    }
    return groups;
}

/// Groups at given weights where one is nearly suspicious: of few stations it moves most visits, and the robust scale of all of them
/// hides it. By how much chi-square falls without it, at the scale that is left then. None where it is not suspicious so either.
std::optional<GroupTests> groups_at_scale_without(const GroupTest& near, const GroupTests& groups,
                                                  const JointAdjustment& adjustment, const NormalEquations& normal,
                                                  const StochasticModel& stochastic, const EvaluationOptions& options,
                                                  const GroupTestOptions& group_options) {
    const RotaryTableMeasurement corrected = without_group(near, adjustment);
    JointAdjustment without(corrected, adjustment.active(), adjustment.set_up(), adjustment.present_values(),
                            stochastic);
    without.adjustment().set_workers(options.workers);
    without.copy_parameters_from(adjustment);
    without.set_weights(stochastic);
    require_convergence(without.adjustment().refine(options.solver), corrected);
    const NormalEquations at = without.adjustment().linearise();
    GroupTests others = test_groups(without, at, at.bordered_covariance(), group_options);
    const double scale = std::max(1.0, others.scale);
    GroupTest found = near;
    found.chi_square = (normal.chi_square() - at.chi_square()) / (scale * scale);
    found.p_value = group_options.chi_square_upper_tail(std::max(0.0, found.chi_square), found.degrees_of_freedom);
    found.suspicious =
        found.p_value < group_options.chi_square_upper_tail(found.critical_value, found.degrees_of_freedom);
    if (!found.suspicious) {
        return std::nullopt;
    }
    others.tests.insert(others.tests.begin(), found);
    // What the plots show is the measurement.
    others.visits = groups.visits;
    others.drifts = groups.drifts;
    others.scale = groups.scale;
    return others;
}

/// Whether something is suspicious that names a cause.
bool names_a_cause(const GroupTests& groups) {
    return std::ranges::any_of(groups.tests, [](const GroupTest& test) {
        return test.suspicious && test.kind != GroupKind::succession && test.kind != GroupKind::station;
    });
}

/// Tests of the groups of an adjustment. Its variances were estimated with the group in, which makes them large and all
/// test values small: where a group is nearly suspicious, all are tested once more at the variances without it.
GroupTests groups_of(const JointAdjustment& adjustment, const NormalEquations& normal,
                     const BorderedCovariance& covariance, const GroupSetting& setting) {
    const auto& [estimated, stochastic, options, group_options, but_gross] = setting;
    GroupTests groups =
        without_scale_errors(test_groups(adjustment, normal, covariance, group_options), adjustment, setting);
    groups = without_fixture_scale(std::move(groups), adjustment, setting);
    const GroupTest* const near = nearly_suspicious(groups, group_options);
    if (near == nullptr || names_a_cause(groups)) {
        return with_joint_sizes(std::move(groups), adjustment, setting);
    }
    try {
        if (!estimated.length && !estimated.table) {
            return with_joint_sizes(
                groups_at_scale_without(*near, groups, adjustment, normal, stochastic, options, group_options)
                    .value_or(groups),
                adjustment, setting);
        }
        JointAdjustment again = adjustment;
        const StochasticModel smaller = variances_without(*near, adjustment, estimated, stochastic, options);
        again.set_weights(smaller);
        require_convergence(again.adjustment().refine(options.solver), again.measurement());
        const NormalEquations at = again.adjustment().linearise();
        const GroupSetting of_again{estimated, smaller, options, group_options, but_gross};
        GroupTests closer =
            without_scale_errors(test_groups(again, at, at.bordered_covariance(), group_options), again, of_again);
        closer = without_fixture_scale(std::move(closer), again, of_again);
        if (std::ranges::any_of(closer.tests, &GroupTest::suspicious)) {
            return with_joint_sizes(std::move(closer), again, of_again);
        }
    } catch (const gum::NoResultError&) {
        return groups;  // a check, which the result does not need
    }
    return groups;
}

/// Tests of the groups with the distances that were left out; none where that adjustment does not converge.
std::optional<GroupTests> groups_with_all(const JointAdjustment& adjustment, const std::vector<bool>& active,
                                          const EstimatedComponents& estimated, StochasticModel stochastic,
                                          const EvaluationOptions& options, const GroupTestOptions& group_options) {
    const Progress silent;
    Iteration iteration(estimated, silent);
    try {
        JointAdjustment whole = with_active(adjustment, active, stochastic);
        EvaluationOptions check = options;
        check.solver.step_tolerance = std::max(options.solver.step_tolerance, k_step_of_many_outliers);
        check.component_tolerance = std::max(options.component_tolerance, k_component_of_a_check);
        iteration.settle_exactly(whole, stochastic, check);
        const EstimatedComponents components = iteration.estimated();
        return groups_of(whole, *iteration.normal, iteration.covariance,
                         {components, stochastic, options, group_options, active});
    } catch (const gum::NoResultError&) {
        return std::nullopt;
    }
}

/// The measurement without the errors that tests of groups tell first; none of kinds that have no size to be taken off.
std::optional<RotaryTableMeasurement> without_first_error(const std::vector<GroupTest>& tests,
                                                          const JointAdjustment& whole) {
    const GroupTest& first = tests.front();
    if (!first.errors.empty()) {
        return without_group(first, whole);
    }
    if (!first.is_settled || (first.kind != GroupKind::fixture_scale && first.kind != GroupKind::station_scale)) {
        return std::nullopt;
    }
    std::vector<GroupTest> told;
    std::ranges::copy_if(tests, std::back_inserter(told),
                         [&](const GroupTest& test) { return test.suspicious && test.kind == first.kind; });
    Eigen::VectorXd sizes(std::ssize(told));
    std::ranges::transform(told, sizes.begin(), &GroupTest::estimate);
    RotaryTableMeasurement corrected = whole.measurement();
    const ErrorModel model = first.kind == GroupKind::fixture_scale ? scale_error_of_coordinates() : scale_errors(told);
    model.take_off(corrected, sizes);
    return corrected;
}

/// What made so many distances outlying, where one cause explains nearly all of it; else none, which is no wrong one.
std::optional<gum::Diagnostic> cause_of_outliers(const JointAdjustment& adjustment, const Iteration& main,
                                                 const StochasticModel& stochastic, const std::vector<bool>& but_gross,
                                                 const EvaluationOptions& options) {
    constexpr double k_share_left = 0.25;
    if (!options.chi_square_upper_tail) {
        return std::nullopt;
    }
    const GroupTestOptions group_options{.chi_square_upper_tail = options.chi_square_upper_tail};
    const std::optional<GroupTests> groups =
        groups_with_all(adjustment, but_gross, main.estimated(), stochastic, options, group_options);
    if (!groups || groups->tests.empty() || !groups->tests.front().suspicious) {
        return std::nullopt;
    }
    JointAdjustment whole = with_active(adjustment, but_gross, stochastic);
    const std::optional<RotaryTableMeasurement> corrected = without_first_error(groups->tests, whole);
    if (!corrected) {
        return std::nullopt;
    }
    JointAdjustment without(*corrected, but_gross, adjustment.set_up(), adjustment.present_values(), stochastic);
    without.adjustment().set_workers(options.workers);
    const SolverOptions solver = solver_of_a_check(options);
    if (!without.adjustment().solve(solver).converged) {
        return std::nullopt;
    }
    // What does not converge with the error in is all the worse.
    if (whole.adjustment().solve(solver).converged && mean_misfit(without) > k_share_left * mean_misfit(whole)) {
        return std::nullopt;
    }
    return group_notes({.tests = {groups->tests.front()}, .visits = {}}, adjustment.measurement()).front();
}

/// The fixture component together with the others, as a check of the stated covariance.
void check_fixture(RotaryTableSolution& solution, const JointAdjustment& adjustment, const Iteration& main,
                   const EvaluationOptions& options, const Progress& progress) {
    VarianceComponent& row = solution.components[fixture_cmm];
    const double redundancy = fixture_redundancy(adjustment, *main.normal, main.covariance);
    const double squares = main.normal->groups()[adjustment.fixture_prior()].residual.squaredNorm();
    EstimatedComponents estimated = main.estimated();
    estimated.fixture = true;
    Iteration iteration(estimated, progress);
    JointAdjustment copy = adjustment;
    StochasticModel stochastic = solution.stochastic;
    SolverOptions solver = options.solver;
    solver.step_tolerance = std::max(solver.step_tolerance, k_step_of_a_check);
    iteration.settle(copy, stochastic, options.max_component_iterations, std::max(options.component_tolerance, 1e-4),
                     solver);
    if (!iteration.fixture_separable || !iteration.components_converged) {
        row.separable = false;
        return;
    }
    const double stated = row.value;
    // An estimate without redundancy has no spread of its own; the squares at the stated covariance tell as well.
    const bool weak = iteration.fixture_is_weak();
    if (weak) {
        row.separable = false;
    } else {
        row = iteration.step.components[fixture_cmm];
        row.used = false;
    }
    if (!options.chi_square_upper_tail) {
        return;
    }
    const double nu = weak ? redundancy : row.degrees_of_freedom;
    // ν times the ratio of the estimated variance to the stated one is χ² with ν degrees of freedom where the stated
    // one is true.
    const double chi_square = weak ? squares : nu * row.value * row.value / (stated * stated);
    const double above = options.chi_square_upper_tail(chi_square, nu);
    if (2.0 * std::min(above, 1.0 - above) < k_fixture_test_level) {
        const bool larger = !weak && row.value > stated;
        solution.notes.push_back(
            {"GC-VARIANCE-0003", "variance components, fixture CMM",
             "the distances suggest " +
                 (weak ? std::string("hardly any standard uncertainty")
                       : "a standard uncertainty of " + micrometres(row.value)) +
                 " for a coordinate of the fixture, " + micrometres(stated) +
                 " is stated; the result rests on the latter",
             "an estimate agrees with what is stated when it passes a two-sided chi-square test at 0.1 %",
             std::string("review the uncertainty budget of the CMM coordinates and their correlations, or set "
                         "\"fixture\": {\"variance_component\": \"estimate\"}") +
                 (larger ? "" : "; the stated value is on the safe side"),
             gum::Severity::warning});
    }
}

/// A repeatability that is given, or said to be none, and that the distances refute; and what they give in its place.
struct RefutedWeights {
    std::vector<RefutedRepeatability> refuted;
    JointAdjustment adjustment;  ///< at the estimated weights
    StochasticModel stochastic;
    Iteration iteration;
    StochasticModel told = {};  ///< what all distances give that have no gross error

    [[nodiscard]] bool larger() const { return std::ranges::any_of(refuted, &RefutedRepeatability::larger); }
};

double variance_of(const StochasticModel& stochastic, ComponentRow row) {
    return row == table_linear  ? stochastic.variance_linear
           : row == table_axial ? stochastic.variance_axial
                                : stochastic.variance_tilt;
}

/// None where the distances do not refute it, or give nothing in its place.
/// \param active, but_gross  distances that take part, and those without gross errors
std::optional<RefutedWeights> check_repeatability(const JointAdjustment& adjustment, const Iteration& main,
                                                  const StochasticModel& stochastic, const std::vector<bool>& active,
                                                  const std::vector<bool>& but_gross, const EvaluationOptions& options,
                                                  const Progress& progress) {
    const TableRepeatability& given = adjustment.measurement().table_repeatability;
    if (given.mode == RepeatabilityMode::estimate || !options.chi_square_upper_tail) {
        return std::nullopt;
    }
    EstimatedComponents estimated = main.estimated();
    estimated.table = true;
    // One step from the given weights decides: sound measurements pay no more.
    std::vector<RefutedRepeatability> refuted = refuted_repeatability(
        estimate_variance_components(adjustment, *main.normal, main.covariance, stochastic, estimated), given,
        options.chi_square_upper_tail);
    if (refuted.empty()) {
        return std::nullopt;
    }
    RefutedWeights result{std::move(refuted), adjustment, stochastic, Iteration(estimated, progress)};
    SolverOptions solver = options.solver;
    solver.step_tolerance = std::max(solver.step_tolerance, k_step_of_a_check);
    const double tolerance = std::max(options.component_tolerance, 1e-4);
    try {
        result.iteration.settle(result.adjustment, result.stochastic, options.max_component_iterations, tolerance,
                                solver);
        result.told = result.stochastic;
        if (active != but_gross) {
            // At weights that are too small good distances are left out, and what is left scatters less than the table does.
            JointAdjustment whole = with_active(adjustment, but_gross, result.told);
            Iteration of_all(estimated, progress);
            of_all.settle(whole, result.told, options.max_component_iterations, tolerance, solver);
        }
    } catch (const gum::NoResultError&) {
        return std::nullopt;  // a check, which the result does not need
    }
    // The step is one from the given weights: where those of another component are wrong, it may point to the wrong side.
    std::erase_if(result.refuted, [&](const RefutedRepeatability& of) {
        return !is_refuted_by(of, std::sqrt(variance_of(result.told, of.row)));
    });
    return result.refuted.empty() ? std::nullopt : std::optional(std::move(result));
}

/// Groups of distances, and of which adjustment: their errors are those of its visits.
struct TestedGroups {
    GroupTests groups;
    bool of_all = false;  ///< with the distances that were left out one by one
};

/// Whether a suspicious group makes the visits scatter, and not the table: without it what is given holds, or all but a tenth of
/// what it is refuted by is gone. The size of a group is an estimate: of a large one what is left of it scatters more than a table.
/// \param but_gross  distances of an adjustment of all
bool is_explained_by(const TestedGroups& tested, const RefutedWeights& check, const std::vector<bool>& but_gross,
                     const EvaluationOptions& options) {
    if (tested.groups.tests.empty() || !tested.groups.tests.front().suspicious) {
        return false;
    }
    const GroupTest& group = tested.groups.tests.front();
    if (group.errors.empty()) {
        return true;  // what its distances are off by is not known
    }
    try {
        const StochasticModel without =
            tested.of_all
                ? variances_without(group, with_active(check.adjustment, but_gross, check.told),
                                    check.iteration.estimated(), check.told, options)
                : variances_without(group, check.adjustment, check.iteration.estimated(), check.stochastic, options);
        const StochasticModel& with = tested.of_all ? check.told : check.stochastic;
        constexpr double k_left = 0.1;
        return std::ranges::all_of(check.refuted, [&](const RefutedRepeatability& of) {
            const auto beyond = [&](const StochasticModel& variances) {
                return variance_of(variances, of.row) - of.given * of.given;
            };
            return !of.larger || !is_refuted_by(of, std::sqrt(variance_of(without, of.row))) ||
                   beyond(without) < k_left * beyond(with);
        });
    } catch (const gum::NoResultError&) {
        return true;
    }
}

void fill_variance_factor(RotaryTableSolution& solution) {
    if (solution.degrees_of_freedom > 0) {
        solution.variance_factor = solution.chi_square / static_cast<double>(solution.degrees_of_freedom);
    }
    std::string names;
    for (const VarianceComponent& component : solution.components) {
        if (component.estimated && component.used) {
            names += (names.empty() ? "" : "; ") + component.name;
        }
    }
    if (names.empty()) {
        solution.variance_basis = VarianceBasis::stated;
        solution.variance_factor_reason =
            "All variances are as stated. Chi-square per degree of freedom tests them; no uncertainty is multiplied by "
            "it.";
    } else {
        // One factor on top of estimated components would count the residuals twice. Without components it would be too
        // large for five error motions and too small for the sixth (ADR 0008).
        solution.variance_basis = VarianceBasis::estimated;
        solution.variance_factor_reason =
            "Variance components estimated from the residuals are in the weights: " + names +
            ". The uncertainties contain them and are not multiplied by a factor";
        constexpr double k_near = 0.1;
        solution.variance_factor_reason += std::abs(solution.variance_factor - 1.0) < k_near
                                               ? "; chi-square per degree of freedom is near 1 by construction."
                                               : ".";
    }
}

void note_outliers(RotaryTableSolution& solution, const RotaryTableMeasurement& measurement, bool settled) {
    if (measurement.outliers.test != OutlierTest::data_snooping) {
        return;
    }
    const auto flagged =
        static_cast<std::size_t>(std::ranges::count_if(solution.reliability, &DistanceReliability::flagged));
    if (static_cast<double>(flagged) > k_many_outliers * static_cast<double>(measurement.lengths.size())) {
        solution.notes.push_back({"GC-OUTLIER-0001", "outlying distances",
                                  std::to_string(flagged) + " of " + std::to_string(measurement.lengths.size()) +
                                      " distances are found outlying",
                                  "more than 5 % of a measurement are hardly single blunders",
                                  "review the stated uncertainty of the lengths, the dead paths and the angles, or let "
                                  "the length noise be estimated with \"variance_components\": \"estimate\"",
                                  gum::Severity::warning});
    }
    if (!settled) {
        solution.notes.push_back(
            {"GC-OUTLIER-0002", "outlying distances",
             "the search did not come to its end; distances that disagree may still be in",
             "the search ends when no test value is above the critical one",
             "review the stated uncertainties, and correct or delete the distances that are flagged",
             gum::Severity::warning});
    }
    // With tests of groups the points of the fixture are tested whole, one at a time: the culprit is named, and not
    // all.
    for (std::size_t k = 0; !solution.groups && k < solution.fixture_reliability.size(); ++k) {
        const CoordinateReliability& row = solution.fixture_reliability[k];
        if (std::abs(row.test_value) > solution.fixture_critical_value) {
            solution.notes.push_back(
                {"GC-OUTLIER-0003", "fixture, reflector " + measurement.reflectors[k / 3] + ", " + "xyz"[k % 3],
                 "the distances put it " + micrometres(std::abs(row.estimated_error)) +
                     " away from its stated coordinate",
                 "a coordinate outlies when its test value is above the critical one, as that of a distance",
                 "measure the reflector again with the CMM, and check that it has not moved in its holder",
                 gum::Severity::warning});
        }
    }
}

/// How far the table turned against how far the file says: the slope of a line through the axial motions over the angles,
/// and how much of them it leaves.
struct TurnedFurther {
    double slope = 0.0;
    double over_all = 0.0;    ///< slope times the span of the angles, [rad]
    double share_left = 1.0;  ///< of the root mean square about their mean
};
TurnedFurther turned_further(const std::vector<double>& angles, const std::vector<double>& motions) {
    const auto n = static_cast<Eigen::Index>(angles.size());
    if (n < 4) {
        return {};  // a line through three angles hardly leaves anything
    }
    Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(angles.data(), n);
    Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(motions.data(), n);
    const double span = x.maxCoeff() - x.minCoeff();
    x.array() -= x.mean();
    y.array() -= y.mean();
    const double squares = y.squaredNorm();
    if (!(squares > 0.0) || !(x.squaredNorm() > 0.0)) {
        return {};
    }
    const double slope = x.dot(y) / x.squaredNorm();
    return {slope, slope * span, std::sqrt((y - slope * x).squaredNorm() / squares)};
}

/// An angle at which the table stands far from where the others let expect it: perhaps the file states another angle
/// than the one that was measured. All six error motions of an angle are free, so that nothing else tells.
///
/// Angles that are all stated in another unit or step are motions that grow with the angle: far from the median are then nearly
/// all, and the median deviation is as large as they are. Therefore a limit of its own that no table reaches, and a line.
/// \throws gum::NoResultError  GC-ANGLE-0002 where the angles are off by more than a degree all together
void note_implausible_angles(RotaryTableSolution& solution, const RotaryTableMeasurement& measurement) {
    constexpr double k_smallest = 180.0 * gum::k_arcsecond;
    constexpr double k_of_no_table = 360.0 * gum::k_arcsecond;
    constexpr double k_refused = gum::k_degree;
    constexpr double k_times_median = 20.0;
    constexpr double k_share_left_by_line = 0.2;
    const int axial = 3 + axial_coordinate(measurement.axis);
    std::vector<double> motions;
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        motions.push_back(solution.values[static_cast<Eigen::Index>(6 * i) + axial]);
    }
    const TurnedFurther turned = turned_further(measurement.angles, motions);
    if (std::abs(turned.over_all) > k_of_no_table && turned.share_left < k_share_left_by_line) {
        gum::Diagnostic message{
            "GC-ANGLE-0002",
            "angles",
            "the table turned " + text::significant(1.0 + turned.slope, 5) + " times as far as the file states, by " +
                degrees_text(std::round(std::abs(turned.over_all) / gum::k_degree * 1e4) / 1e4) + " over all angles",
            "angles that are stated in another unit or with another step are taken for an error motion of the table",
            "compare the angles with the protocol, and correct the lengths file",
            gum::Severity::warning};
        if (std::abs(turned.over_all) > k_refused) {
            message.severity = gum::Severity::error;
            throw gum::NoResultError(std::move(message));
        }
        solution.notes.push_back(std::move(message));
        return;
    }
    std::vector<double> sorted = motions;
    const double middle = upper_median(sorted);
    for (double& value : sorted) {
        value = std::abs(value - middle);
    }
    const double of_others = std::max(k_smallest, k_times_median * upper_median(sorted));
    const double limit = std::min(of_others, k_of_no_table);
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const double off = motions[i] - middle;
        if (std::abs(off) > limit) {
            solution.notes.push_back(
                {"GC-ANGLE-0001", degrees_text(measurement.angles_deg[i]),
                 "the table stands " + degrees_text(std::round(off / gum::k_degree * 1e4) / 1e4) +
                     (std::abs(off) > of_others
                          ? " from the angle that the file states, far more than at the other angles"
                          : " from the angle that the file states, farther than a table errs"),
                 "an angle that is stated wrongly at all stations is taken for an error motion of the table",
                 "see whether the angle is mistyped, and correct the lengths file", gum::Severity::warning});
        }
    }
}

/// Components that enter with clearly more than the residuals give. A warning where what is added to a distance is more
/// than its own noise: then U is governed by it.
void note_undetermined_components(RotaryTableSolution& solution, const RotaryTableMeasurement& measurement) {
    constexpr double k_clearly = 1.1;  // a standard deviation that is a tenth larger
    const Eigen::RowVector3d centroid = measurement.fixture.colwise().mean();
    const double lever = (measurement.fixture.rowwise() - centroid).rowwise().norm().maxCoeff();
    const double noise = solution.components[length_noise].value;
    for (std::size_t c = 0; c < solution.components.size(); ++c) {
        const VarianceComponent& component = solution.components[c];
        if (!component.used || !component.residuals_give || component.value < k_clearly * *component.residuals_give) {
            continue;
        }
        const double added =
            std::sqrt(component.value * component.value - *component.residuals_give * *component.residuals_give) *
            (c == table_linear ? 1.0 : lever);
        solution.notes.push_back(
            {"GC-VARIANCE-0007", "variance components, " + component.name,
             "the residuals give " + size_of(component, *component.residuals_give) +
                 ", and hardly determine it: taken is " + size_of(component, component.value) + " with " +
                 text::degrees_of_freedom(text::significant(component.degrees_of_freedom, 2)),
             "a variance below its own uncertainty is not known to be 0: it enters with the mean of what the residuals "
             "leave plausible",
             "state the repeatability of the table where it is known from earlier work (\"mode\": \"given\"), or "
             "measure "
             "more stations, reflectors or passes; either makes U smaller",
             added > noise ? gum::Severity::warning : gum::Severity::note});
    }
}

/// A length noise of nothing, where the residuals are smaller than the resolution alone makes them. Components that enter with what
/// they leave plausible make chi-square smaller still: it is asked before.
void note_refuted_resolution(RotaryTableSolution& solution, const RotaryTableMeasurement& measurement,
                             double chi_square_of_estimates, const EvaluationOptions& options) {
    constexpr double k_level = 0.001;
    const VarianceComponent& noise = solution.components[length_noise];
    const double resolution = measurement.length_uncertainty.resolution;
    if (!options.chi_square_upper_tail || solution.degrees_of_freedom <= 0 || !noise.estimated || noise.value > 0.0 ||
        !(resolution > 0.0)) {
        return;
    }
    const auto nu = static_cast<double>(solution.degrees_of_freedom);
    if (1.0 - options.chi_square_upper_tail(chi_square_of_estimates, nu) < k_level) {
        solution.notes.push_back(
            {"GC-VARIANCE-0009", "variance components, length noise",
             "the residuals are smaller than the resolution of " + micrometres(resolution, 2) +
                 " alone makes them: nothing is left of the length noise",
             "by chance alone this happens less than once in a thousand adjustments",
             "see whether the resolution is stated too large, or the distances were read with more digits",
             gum::Severity::warning});
    }
}

/// A scale error that no adjustment without it confirms has no size that may be told, and whatever else there is to say of
/// the measurement rests on the error.
void refuse_unsettled_errors(const GroupTests& groups, const RotaryTableMeasurement& measurement) {
    GroupTests unsettled;
    std::ranges::copy_if(groups.tests, std::back_inserter(unsettled.tests),
                         [](const GroupTest& test) { return test.suspicious && !test.is_settled; });
    std::vector<gum::Diagnostic> problems = group_notes(unsettled, measurement);
    if (!problems.empty()) {
        for (gum::Diagnostic& problem : problems) {
            problem.severity = gum::Severity::error;
        }
        throw gum::NoResultError(std::move(problems));
    }
}

/// A solution, and whether one with reversals of each angle is worth its time.
struct Adjusted {
    RotaryTableSolution solution;
    bool reversal_may_depend_on_angle = false;
};

/// \param measurement   ReversalModel::automatic is one reversal of all angles
/// \param start_search  of the measurement, or of one that has another reversal: start values do not depend on it
Adjusted adjust_and_test(const RotaryTableMeasurement& measurement, StartSearch& start_search,
                         const EvaluationOptions& options, const Progress& progress) {
    const FixtureComponent fixture_component = measurement.fixture_component;
    const EstimatedComponents estimated{measurement.estimate_length_noise,
                                        measurement.table_repeatability.mode == RepeatabilityMode::estimate,
                                        fixture_component == FixtureComponent::estimate};
    Iteration iteration(estimated, progress);
    StochasticModel stochastic = start_variances(measurement.table_repeatability);
    const OutlierOptions& outliers = measurement.outliers;
    const bool snooping = outliers.test == OutlierTest::data_snooping;

    const std::vector<bool> all(measurement.lengths.size(), true);
    std::vector<bool> active = all;
    // A length that is off by centimetres carries the solution away, and comes back as a rank defect of another
    // station.
    const std::vector<std::size_t>& gross = start_search.gross_errors();
    if (!gross.empty() && (!snooping || outliers.action == OutlierAction::report)) {
        refuse_gross_errors(measurement, gross);
    }
    // Two whole visits lost are no single errors: before anything is left out, interrupted beams are looked for.
    if (has_whole_visits(measurement, gross)) {
        start_search.refuse_interrupted_beams();
    }
    std::vector<OutlierFinding> found;
    const auto set_aside = [&](std::size_t i) {
        active[i] = false;
        OutlierFinding finding;
        finding.length = i;
        finding.reason = OutlierReason::gross_error;
        finding.redundancy_number = 1.0;
        found.push_back(finding);
    };
    std::ranges::for_each(gross, set_aside);
    const ObservedStations observed(measurement, active);
    PlacedAdjustment placed =
        placed_adjustment(observed, active, start_search.places(active), stochastic, options.workers);
    refuse_inclined_fixture(measurement.axis, placed.start.set_up);
    // Before the adjustment, which would not converge, or would name parameters that do not show the cause.
    if (const std::optional<gum::Diagnostic> line = stations_on_one_line(placed.start.stations)) {
        start_search.refuse_no_rigid_table();
        throw gum::NoResultError(*line);
    }
    JointAdjustment& first = placed.adjustment;
    Eigen::Index degrees_of_freedom = 0;
    const auto require_rank = [&](const JointAdjustment& adjustment) {
        const NormalEquations normal = adjustment.adjustment().linearise();
        degrees_of_freedom = normal.observation_count() - normal.parameter_count();
        const RankReport rank = normal.rank(options.solver.rank_tolerance);
        if (rank.deficient) {
            refuse_undetermined(measurement, rank, adjustment.present_values().stations);
        }
    };
    try {
        require_rank(first);
    } catch (const gum::NoResultError&) {
        start_search.refuse_no_rigid_table();
        throw;
    }
    iteration.report("joint adjustment");
    // While an outlier may still be in, the last digits of the solution are not worth their steps.
    SolverOptions rough = options.solver;
    rough.step_tolerance = 1e-3;
    // Gross errors make the last steps slow. Where there may be some, they are searched for before those steps are taken.
    const bool may_leave_out = snooping && outliers.action == OutlierAction::remove;
    SolverOptions first_steps = rough;
    if (may_leave_out) {
        first_steps.max_refinements = std::min(k_refinements_without_gross_errors, rough.max_refinements);
    }
    SolveSummary& summary = placed.summary;
    summary = first.adjustment().solve(first_steps);
    settle_rival_tables(observed, active, stochastic, first_steps, static_cast<double>(degrees_of_freedom), placed);
    const auto is_grossly_wrong = [&] {
        const double misfit = std::sqrt(summary.chi_square / static_cast<double>(measurement.lengths.size()));
        return !summary.converged || misfit > k_gross_misfit;
    };
    // What is largest hides what is smaller: the search goes on while it finds something.
    for (int search = 0; search < k_most_gross_searches && may_leave_out && is_grossly_wrong(); ++search) {
        JointAdjustment robust =
            search == 0 ? adjustment_from_start(measurement, active, placed.set_up, placed.start, stochastic)
                        : JointAdjustment(measurement, active, placed.set_up, first.present_values(), stochastic);
        const std::vector<std::size_t> deviating = find_gross_deviations(robust, rough);
        if (search > 0 && deviating.empty()) {
            break;
        }
        std::ranges::for_each(deviating, set_aside);
        first = JointAdjustment(measurement, active, placed.set_up, robust.present_values(), stochastic);
        first.adjustment().set_workers(options.workers);
        first.copy_parameters_from(robust);
        first.set_weights(stochastic);
        require_rank(first);
        summary = first.adjustment().solve(rough);
    }
    require_convergence(summary, measurement);
    require_rank(first);
    iteration.iterations += summary.iterations;

    // The linear maps of the datum are exact for a T_s that is already that of the result.
    const DatumSolution preliminary = transform_to_datum(measurement, first.poses(), first.set_up(), measurement.datum);
    JointAdjustment adjustment = with_set_up(first, rigid_motion(preliminary.set_up), stochastic);

    std::vector<bool> reinserted(all.size(), false);
    std::vector<bool> for_good(all.size(), false);  // came back twice
    const auto hold_in = [&](OneAtATime& search) {
        for (std::size_t i = 0; i < for_good.size(); ++i) {
            if (for_good[i] && active[i]) {
                search.hold(i);
            }
        }
    };
    std::vector<DistanceReliability> rows;
    TestLimits limits;
    const auto leave_out = [&](const OneAtATime::Suspect& suspect) {
        active[suspect.length] = false;
        OutlierFinding finding;
        finding.length = suspect.length;
        finding.test_value = suspect.test_value;
        finding.critical_value = limits.critical_value;
        finding.redundancy_number = suspect.redundancy_number;
        finding.estimated_error = suspect.estimated_error;
        found.push_back(finding);
        const LengthObservation& length = measurement.lengths[suspect.length];
        iteration.report("distance " + measurement.stations[length.station] + "–" +
                         measurement.reflectors[length.reflector] + " found outlying");
    };
    bool settled = false;
    for (int round = 0; round < options.max_outlier_rounds && !settled; ++round) {
        bool changed = false;
        if (snooping) {
            // Rough weights are enough to see outliers; the last rounds are exact.
            iteration.settle(adjustment, stochastic, 3, 0.05, rough);
            limits = test_limits(options, iteration.step.components[length_noise]);
            OneAtATime search(adjustment, *iteration.normal, iteration.covariance);
            hold_in(search);
            double largest = 0.0;
            while (const auto suspect = search.largest(limits.critical_value)) {
                const double size = std::abs(suspect->estimated_error);
                largest = std::max(largest, size);
                // Second-order effects of the errors found so far are as large as this one: after a new linearisation
                // it may not be an outlier at all.
                if (changed && largest > k_linear_reach && size < second_order_effect(largest)) {
                    break;
                }
                leave_out(*suspect);
                search.leave_out(suspect->length);
                changed = true;
            }
        }
        if (!changed) {
            iteration.settle_exactly(adjustment, stochastic, options);
            limits = test_limits(options, iteration.step.components[length_noise]);
            rows = distance_reliability(adjustment, *iteration.normal, iteration.covariance, stochastic,
                                        limits.non_centrality);
            if (!snooping) {
                settled = true;
                break;
            }
            // At weights that have settled. The rough ones above may have let one pass.
            OneAtATime search(adjustment, *iteration.normal, iteration.covariance);
            hold_in(search);
            if (const auto suspect = search.largest(limits.critical_value)) {
                leave_out(*suspect);
                changed = true;
            } else {
                // Distances that were left out in the shadow of larger ones come back when they agree after all. What is
                // then found again and agrees again is in for good: the test says of no distance that is left out that
                // it agrees.
                for (OutlierFinding& finding : found) {
                    const std::size_t i = finding.length;
                    if (!active[i] && std::abs(rows[i].test_value) <= limits.critical_value) {
                        active[i] = true;
                        for_good[i] = reinserted[i];
                        reinserted[i] = true;
                        finding.came_back = true;
                        changed = true;
                    }
                }
            }
        }
        if (changed) {
            adjustment = with_active(adjustment, active, stochastic);
            require_rank(adjustment);
        } else {
            settled = true;
        }
    }
    std::vector<bool> flagged(active.size());
    for (std::size_t i = 0; i < active.size(); ++i) {
        flagged[i] = !active[i];
    }
    for (OutlierFinding& finding : found) {
        // What a left-out distance is off by is known best at the end, from everything that is in the result.
        if (settled && !finding.came_back) {
            finding.estimated_error = rows[finding.length].estimated_error;
            if (finding.reason == OutlierReason::gross_error) {
                finding.test_value = rows[finding.length].test_value;
                finding.critical_value = limits.critical_value;
            }
        }
        finding.removed = !finding.came_back && outliers.action == OutlierAction::remove;
    }
    // Reported only: then the outliers stay in, and the weights have to be those of all distances.
    const bool kept = outliers.action == OutlierAction::report && active != all;
    if (kept || !settled) {
        if (kept) {
            active = all;
            adjustment = with_active(adjustment, active, stochastic);
        }
        iteration.settle_exactly(adjustment, stochastic, options);
        limits = test_limits(options, iteration.step.components[length_noise]);
        rows = distance_reliability(adjustment, *iteration.normal, iteration.covariance, stochastic,
                                    limits.non_centrality);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].flagged = flagged[i];
        rows[i].removed = !active[i];
    }

    RotaryTableSolution solution;
    solution.reliability = std::move(rows);
    const NormalEquations& normal = *iteration.normal;
    const BorderedCovariance& covariance = iteration.covariance;
    solution.datum = transform_to_datum(measurement, adjustment.poses(), adjustment.set_up(), measurement.datum);
    solution.quantities = reported_quantities(measurement, adjustment.has_reversal());
    solution.values = reported_values(adjustment, solution.datum);
    const AnglewiseMap map = reported_map(adjustment, normal, solution.datum);
    solution.covariance = covariance_of(map, adjustment, normal, covariance);

    // Of the stations with each other: whoever fits a frame through them needs more than the covariance of each.
    solution.station_covariance = covariance_of_stations(adjustment, normal, covariance, solution.datum);
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        const auto block = adjustment.station_block(j);
        const Eigen::VectorXd& value = adjustment.adjustment().parameters(block);
        const auto at = 3 * static_cast<Eigen::Index>(j);
        StationEstimate station;
        station.position = solution.datum.world * value.head<3>();
        station.covariance = solution.station_covariance.block<3, 3>(at, at);
        station.u = station.covariance.diagonal().cwiseSqrt();
        station.scale_deviation = value[3];
        // A scale that is held has no column: it is taken as exact, and its uncertainty stays 0.
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
        // From this adjustment and not from the model, which holds the dead paths as inputs (ADR 0007).
        solution.u_dead_paths[d] = std::sqrt(covariance(column, column));
    }
    solution.fixture.resize(measurement.fixture.rows(), 3);
    solution.u_fixture.resize(measurement.fixture.rows(), 3);
    solution.fixture_at_home.resize(measurement.fixture.rows(), 3);
    for (Eigen::Index m = 0; m < measurement.fixture.rows(); ++m) {
        std::vector<Eigen::Index> columns;
        for (int c = 0; c < 3; ++c) {
            const int component = static_cast<int>(3 * m) + c;
            const Eigen::Index column = normal.column(adjustment.fixture_block(), component);
            solution.fixture(m, c) = adjustment.adjustment().parameters(adjustment.fixture_block())[component];
            solution.u_fixture(m, c) = std::sqrt(covariance(column, column));
            columns.push_back(column);
        }
        solution.fixture_position_covariance.emplace_back(covariance(columns, columns));
        solution.fixture_at_home.row(m) =
            (solution.datum.world * (adjustment.set_up() * solution.fixture.row(m).transpose())).transpose();
    }

    solution.observations = normal.observation_count();
    solution.parameters = normal.parameter_count();
    solution.degrees_of_freedom = solution.observations - solution.parameters;
    // Lengths that single tests left out stay in for the group tests: they may be signs of a fault of a whole group.
    std::vector<bool> but_gross = all;
    for (const OutlierFinding& finding : found) {
        but_gross[finding.length] = but_gross[finding.length] && finding.reason != OutlierReason::gross_error;
    }
    try {
        require_rest_that_can_object(
            static_cast<std::size_t>(std::ranges::count_if(solution.reliability,
                                                           [](const DistanceReliability& row) { return row.removed; })),
            solution.degrees_of_freedom, iteration.step.length_redundancy, measurement.lengths.size(),
            iteration.step.components[length_noise].estimated ? 0.0 : iteration.step.components[length_noise].value);
    } catch (const gum::NoResultError& error) {
        std::vector<gum::Diagnostic> problems = error.diagnostics();
        if (const auto cause = cause_of_outliers(adjustment, iteration, stochastic, but_gross, options)) {
            problems.push_back(*cause);
        }
        throw gum::NoResultError(std::move(problems));
    }
    solution.iterations = iteration.iterations;
    solution.chi_square = normal.chi_square();
    solution.condition_number = normal.condition_number();
    solution.stochastic = stochastic;
    solution.components = iteration.step.components;
    solution.components[fixture_cmm].separable = iteration.fixture_separable;
    const TestLimits fixture_limits = test_limits(options, solution.components[fixture_cmm]);
    solution.fixture_reliability = fixture_reliability(adjustment, normal, covariance, fixture_limits.non_centrality);
    solution.fixture_critical_value = fixture_limits.critical_value;
    solution.external_reliability = external_reliability(AnglewiseSensitivity(map, adjustment, normal, covariance),
                                                         adjustment, solution.reliability);
    solution.outliers = std::move(found);
    solution.critical_value = limits.critical_value;
    solution.critical_value_degrees_of_freedom = limits.degrees_of_freedom;
    solution.non_centrality = limits.non_centrality;
    fill_variance_factor(solution);
    bool may_depend = false;
    if (adjustment.reversal_by_angle()) {
        solution.reversal_model = ReversalModel::by_angle;
        if (options.fisher_upper_tail) {
            solution.reversal_tests =
                test_reversals(adjustment, normal, covariance, solution.components, options.fisher_upper_tail);
        }
    } else if (options.chi_square_upper_tail && options.fisher_upper_tail) {
        // One linear step decides whether the expensive adjustment is worth its time: sound measurements pay little
        // (ADR 0035).
        may_depend = may_depend_on_angle(adjustment, active, stochastic, options.solver.rank_tolerance,
                                         options.chi_square_upper_tail);
    }

    std::optional<RefutedWeights> refuted =
        check_repeatability(adjustment, iteration, stochastic, active, but_gross, options, progress);
    if (options.chi_square_upper_tail) {
        iteration.report("groups of distances");
        const GroupTestOptions group_options{.chi_square_upper_tail = options.chi_square_upper_tail};
        const auto groups_at = [&](const JointAdjustment& at, const Iteration& of, const StochasticModel& weights) {
            std::optional<GroupTests> groups;
            if (is_concentrated(measurement, active) && active != but_gross) {
                groups = groups_with_all(at, but_gross, of.estimated(), weights, options, group_options);
            }
            const bool of_all = groups.has_value();
            if (!groups) {
                const EstimatedComponents components = of.estimated();
                groups =
                    groups_of(at, *of.normal, of.covariance, {components, weights, options, group_options, but_gross});
            }
            return TestedGroups{std::move(*groups), of_all};
        };
        // A repeatability that is given too small makes groups of distances suspicious, and the reversal seem to depend on
        // the angle: both are judged at what the distances give. What is suspicious then makes the visits scatter, perhaps.
        if (refuted && refuted->larger()) {
            TestedGroups as_given = groups_at(adjustment, iteration, stochastic);
            // A change that explains the scatter is hidden by variances that hold it.
            const bool is_change = !as_given.groups.tests.empty() && !as_given.groups.tests.front().errors.empty();
            bool is_explained = is_change && is_explained_by(as_given, *refuted, but_gross, options);
            if (!is_explained) {
                TestedGroups at_estimates = groups_at(refuted->adjustment, refuted->iteration, refuted->stochastic);
                is_explained = is_explained_by(at_estimates, *refuted, but_gross, options);
                solution.groups = std::move(at_estimates.groups);
            }
            if (is_explained) {
                solution.groups = std::move(as_given.groups);
                refuted.reset();
            } else if (adjustment.reversal_by_angle() && options.fisher_upper_tail) {
                solution.reversal_tests =
                    test_reversals(refuted->adjustment, *refuted->iteration.normal, refuted->iteration.covariance,
                                   refuted->iteration.step.components, options.fisher_upper_tail);
            }
        }
        if (!solution.groups) {
            solution.groups = groups_at(adjustment, iteration, stochastic).groups;
        }
        refuse_unsettled_errors(*solution.groups, measurement);
    }

    const auto nu = [&](std::size_t k) { return solution.components[k].degrees_of_freedom; };
    solution.model = std::make_shared<RotaryTableModel>(
        measurement, adjustment, stochastic,
        SourceDegreesOfFreedom{nu(length_noise), nu(table_linear), nu(table_axial), nu(table_tilt), nu(fixture_cmm)});
    if (fixture_component == FixtureComponent::check) {
        check_fixture(solution, adjustment, iteration, options, progress);
    }

    if (!iteration.components_converged && iteration.any_estimated()) {
        solution.notes.push_back(
            {"GC-VARIANCE-0001", "variance components",
             "did not settle within " + std::to_string(iteration.component_iterations) + " iterations",
             "the stated uncertainties rest on the last values",
             "give the repeatability of the table instead of estimating it", gum::Severity::warning});
    }
    note_undetermined_components(solution, measurement);
    note_refuted_resolution(solution, measurement, iteration.chi_square_of_estimates, options);
    if (iteration.estimated().length && !iteration.step.length_separable) {
        solution.notes.push_back({"GC-VARIANCE-0002", "variance components",
                                  "one distance a visit of the table: the length noise is kept as stated",
                                  "a single distance does not separate its own noise from the repeatability of the "
                                  "table; their sum is estimated",
                                  "", gum::Severity::note});
    }
    if (iteration.held_length_redundancy) {
        solution.components[length_noise].separable = false;
        solution.notes.push_back(
            {"GC-VARIANCE-0005", "variance components, length noise",
             "kept as stated: its redundancy is " + text::significant(*iteration.held_length_redundancy, 2),
             "below a redundancy of 30 the estimate is made of the few residuals that the test of outlying distances "
             "is to judge with it",
             "measure more reflectors, angles or stations where the length noise is to be estimated",
             gum::Severity::note});
    }
    if (!solution.components[fixture_cmm].separable) {
        solution.notes.push_back(
            {"GC-VARIANCE-0004", "variance components, fixture CMM",
             "cannot be estimated from this measurement: the covariance of the fixture is used as stated and not "
             "checked",
             "the redundancy of its coordinates must be at least 2 and its estimate greater than 0",
             "measure more reflectors, or rely on the uncertainty budget of the CMM", gum::Severity::note});
    }
    if (refuted) {
        for (const RefutedRepeatability& of : refuted->refuted) {
            solution.notes.push_back(repeatability_note(of, std::sqrt(variance_of(refuted->told, of.row))));
        }
    }
    note_outliers(solution, measurement, settled);
    note_implausible_angles(solution, measurement);
    if (solution.groups) {
        std::ranges::move(group_notes(*solution.groups, measurement), std::back_inserter(solution.notes));
    }
    if (!adjustment.has_reversal()) {
        const std::string stations = stations_in_one_sense(measurement);
        solution.notes.push_back({"GC-REVERSAL-0001", "reversal",
                                  stations.empty() ? "not reported"
                                                   : "not reported: measured in one sense of approach alone, and "
                                                     "the others in both: " +
                                                         stations,
                                  "every station must be measured in both senses of approach to separate it", "",
                                  gum::Severity::note});
    }
    std::vector<Eigen::Vector3d> positions;
    for (const StationEstimate& station : solution.stations) {
        positions.push_back(station.position);
    }
    // A place that is badly known along one line is no harm where the others carry the results.
    constexpr double k_harm = 0.19;  // of a variance: U would be a tenth smaller
    const Eigen::VectorXd variances = solution.covariance.diagonal();
    const auto harms = [&](std::size_t station) {
        return largest_share_of_station(adjustment, normal, covariance, solution.datum, map, variances, station) >
               k_harm;
    };
    std::ranges::move(geometry_notes(measurement, positions, harms), std::back_inserter(solution.notes));
    std::ranges::move(stated_position_notes(measurement, positions), std::back_inserter(solution.notes));
    if (const auto inclined = inclination_note(measurement.axis, rigid_motion(solution.datum.set_up))) {
        solution.notes.push_back(*inclined);
    }
    return {std::move(solution), may_depend};
}

/// Whether the noise that is left is many times what is stated, and no scale of a station or of the fixture is told in its
/// place.
bool is_hardly_noise(const RotaryTableSolution& solution) {
    constexpr double k_times = 4.0;
    const VarianceComponent& noise = solution.components[length_noise];
    return noise.estimated && noise.stated && noise.value > k_times * *noise.stated && solution.groups &&
           std::ranges::none_of(solution.groups->tests, [](const GroupTest& test) {
               return test.suspicious &&
                      (test.kind == GroupKind::fixture_scale || test.kind == GroupKind::station_scale);
           });
}

/// The reversal of all angles, or that of each where the measurement or the distances ask for it.
RotaryTableSolution adjust_with_reversal(const RotaryTableMeasurement& measurement, StartSearch& start_search,
                                         const EvaluationOptions& options, const Progress& progress) {
    Adjusted adjusted = adjust_and_test(measurement, start_search, options, progress);
    if (!adjusted.reversal_may_depend_on_angle) {
        return std::move(adjusted.solution);
    }
    if (progress) {
        progress("reversal at every angle");
    }
    RotaryTableMeasurement by_angle = measurement;
    by_angle.reversal = ReversalModel::by_angle;
    RotaryTableSolution each;
    try {
        each = adjust_and_test(by_angle, start_search, options, progress).solution;
    } catch (const gum::NoResultError&) {
        return std::move(adjusted.solution);  // only asked, not needed
    }
    // The tests come from the adjustment with reversals of each angle: variances of the other one hold what is asked
    // for, and the test would lose its power (ADR 0035).
    const std::optional<gum::Diagnostic> refuted = reversal_note(each.reversal_tests, measurement);
    const bool adopted = refuted && measurement.reversal == ReversalModel::automatic;
    RotaryTableSolution& solution = adopted ? each : adjusted.solution;
    if (refuted) {
        solution.notes.push_back(*refuted);
    }
    if (!adopted) {
        // A reversal of all angles that the distances refute makes the visits scatter, and not the table.
        const auto is_of_repeatability = [](const gum::Diagnostic& note) {
            return note.code == k_repeatability_too_small;
        };
        if (refuted && std::ranges::none_of(each.notes, is_of_repeatability)) {
            std::erase_if(solution.notes, is_of_repeatability);
        }
        solution.reversal_tests = std::move(each.reversal_tests);
    }
    return std::move(solution);
}

}  // namespace

RotaryTableSolution evaluate_jointly(const RotaryTableMeasurement& measurement, const EvaluationOptions& options,
                                     const Progress& progress) {
    require_enough_angles(measurement);
    if (progress) {
        progress("start values");
    }
    StartSearch start_search(measurement);
    const auto refuse_scaled = [&] {
        std::vector<gum::Diagnostic> causes;
        try {
            std::vector<bool> active(measurement.lengths.size(), true);
            for (const std::size_t i : start_search.gross_errors()) {
                active[i] = false;
            }
            causes = scaled_lengths(measurement, start_search.places(active), active, options.solver, options.workers);
        } catch (const gum::NoResultError&) {
            return;  // that is what is refused already
        }
        if (!causes.empty()) {
            throw gum::NoResultError(std::move(causes));
        }
    };
    try {
        RotaryTableSolution solution = adjust_with_reversal(measurement, start_search, options, progress);
        if (is_hardly_noise(solution)) {
            refuse_scaled();
        }
        return solution;
    } catch (const gum::NoResultError& error) {
        // Wrong labels and an interrupted beam look like a station whose place is open, like one that fits no table, like
        // an adjustment that goes astray, like a table that nobody has, or like many outlying distances.
        if (std::ranges::any_of(error.diagnostics(), [](const gum::Diagnostic& problem) {
                return problem.code == "GC-ADJUST-0005" || problem.code == "GC-ADJUST-0015" ||
                       problem.code == "GC-ADJUST-0016" || problem.code == "GC-ADJUST-0017" ||
                       problem.code == "GC-RANK-0001" || problem.code == "GC-VARIANCE-0008" ||
                       problem.code == k_suspicious_group;
            })) {
            start_search.refuse_wrong_labels();
            if (std::ranges::any_of(error.diagnostics(), [](const gum::Diagnostic& problem) {
                    return problem.code == "GC-ADJUST-0005" || problem.code == "GC-ADJUST-0017" ||
                           problem.code == k_suspicious_group;
                })) {
                refuse_scaled();
            }
            start_search.refuse_interrupted_beams();
            // Neither what is open nor how far an adjustment came says anything of distances that fit no place.
            start_search.refuse_no_rigid_table();
        }
        throw;
    }
}

}  // namespace gumcert::engine
