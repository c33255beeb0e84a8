#include "reports/record/make/rotary_table/rotary_evidence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/harmonics.h"
#include "engine/rotary_table/anglewise_map.h"
#include "engine/rotary_table/group_tests.h"
#include "engine/rotary_table/rotary_table_contributions.h"
#include "engine/rotary_table/sense_deviations.h"
#include "gum/coverage.h"
#include "gum/rounding.h"
#include "jobs/rotary_table/rotary_table_words.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/make/rotary_table/document_units.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using engine::Approach;
using engine::GroupKind;
using engine::GroupTest;
using engine::RotaryTableMeasurement;

constexpr int k_most_orders = 10;            // of harmonics
constexpr std::size_t k_most_lengths = 400;  // of a measurement whose annex lists the distances
constexpr double k_degrees = 180.0 / std::numbers::pi;

const char* sign_of(Approach approach) {
    return approach == Approach::positive ? "+" : "-";
}

/// The unit of what a kind estimates: "um", "ppm", or "1" for a number of steps or a ratio; and its value.
std::pair<const char*, double> unit_of_kind(GroupKind kind) {
    switch (kind) {
        case GroupKind::angle_index:
        case GroupKind::succession:
        case GroupKind::station:
        case GroupKind::senses:
            return {"1", 1.0};
        case GroupKind::fixture_scale:
        case GroupKind::station_scale:
        case GroupKind::expansion:  // in a kelvin
            return {"ppm", 1e-6};
        default:
            return {"um", gum::k_micrometre};
    }
}

reports::GroupTestRow group_row(const GroupTest& test, const RotaryTableMeasurement& measurement) {
    reports::GroupTestRow row;
    row.kind = group_kind_name(test.kind);
    row.tests = static_cast<std::int64_t>(test.family);
    const std::vector<std::string> texts =
        gum::round_in_order({test.chi_square, test.critical_value}, 1, &gum::round_to_quantum);
    row.test_value = {test.chi_square, texts[0]};
    row.degrees_of_freedom = test.degrees_of_freedom;
    row.critical_value = {test.critical_value, texts[1]};
    row.p_value = shown_significant(test.p_value, 2);
    const auto name = [](const std::vector<std::string>& names, std::size_t at) {
        return at == GroupTest::k_none ? std::string() : names[at];
    };
    row.station = name(measurement.stations, test.station);
    row.reflector = name(measurement.reflectors, test.reflector);
    if (test.kind != GroupKind::drift) {  // a drift begins at the first visit
        row.pass = name(measurement.passes, test.pass);
        if (test.angle != GroupTest::k_none) {
            const double angle = measurement.angles_deg[test.angle];
            row.angle_deg = {angle, text::shortest(angle)};
        }
        if (test.last_angle != GroupTest::k_none) {
            row.to_angle_deg = measurement.angles_deg[test.last_angle];
        }
    }
    const auto [name_of_unit, unit] = unit_of_kind(test.kind);
    row.unit = name_of_unit;
    if (test.has_size()) {
        row.estimate = shown_plain(test.estimate / unit, 2);
    }
    if (test.minimal_detectable > 0.0) {
        row.minimal_detectable = shown_plain(test.minimal_detectable / unit, 2);
    }
    row.suspicious = test.suspicious;
    return row;
}

/// Of each kind the least probable group, in the order of the engine: suspicious ones first.
void fill_group_tests(reports::RotaryTable& rotary, const engine::GroupTests& groups,
                      const RotaryTableMeasurement& measurement) {
    reports::GroupTestSummary summary;
    summary.alpha = engine::GroupTestOptions{}.alpha;
    summary.scale = shown_to_quantum(groups.scale, 2);
    for (const GroupTest& test : groups.tests) {
        const std::string kind = group_kind_name(test.kind);
        const auto found = std::find_if(summary.kinds.begin(), summary.kinds.end(),
                                        [&](const reports::GroupTestRow& row) { return row.kind == kind; });
        if (found == summary.kinds.end()) {
            summary.kinds.push_back(group_row(test, measurement));
        } else if (test.p_value < found->p_value.number) {
            *found = group_row(test, measurement);
        }
    }
    if (groups.left) {
        summary.unexplained_p_value = groups.left->p_value;
    }
    rotary.group_tests = std::move(summary);
}

/// Deviations of all visits; those that the tests of groups do not control have none.
void fill_visits(reports::RotaryTable& rotary, const engine::RotaryTableModel& model,
                 const engine::VisitPositionGains& gains, const std::vector<engine::VisitDeviation>& deviations) {
    const RotaryTableMeasurement& measurement = model.measurement();
    const std::vector<engine::Visit>& visits = model.solved().visits();
    const double limit = deviations.empty()
                             ? 0.0
                             : gum::two_sided_normal_critical_value(engine::share_of_level(GroupKind::visit_length) *
                                                                    engine::GroupTestOptions{}.alpha /
                                                                    static_cast<double>(visits.size()));
    auto deviation = deviations.begin();
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const engine::Visit& visit = visits[v];
        reports::VisitRow row;
        row.station = measurement.stations[visit.station];
        row.pass = measurement.passes[visit.pass];
        row.direction = sign_of(visit.approach);
        row.angle_deg = measurement.angles_deg[visit.angle];
        if (deviation != deviations.end() && deviation->visit.pass == visit.pass &&
            deviation->visit.angle == visit.angle) {
            row.deviation_um = deviation->deviation / gum::k_micrometre;
            row.limit_um = limit * deviation->u / gum::k_micrometre;
            ++deviation;
        }
        if (gains.determined(v)) {
            row.axial_arcsec = gains.gains[v].dot(model.solved().adjustment().residual(v)) / gum::k_arcsecond;
        }
        rotary.visits.push_back(std::move(row));
    }
}

void fill_reversal_model(reports::RotaryTable& rotary, const engine::RotaryTableSolution& solution) {
    if (!solution.quantities.has_reversal) {
        return;
    }
    reports::ReversalModel& model = rotary.reversal_model.emplace();
    model.model = jobs::word_of(jobs::k_reversals, solution.reversal_model);
    model.alpha = engine::k_reversal_test_level;
    for (const engine::ReversalTest& test : solution.reversal_tests) {
        const DocumentUnit& unit = test.motion < 3 ? k_um : k_arcsec;
        reports::ReversalTestRow row;
        row.name = rotary.error_names[test.motion];
        row.test_value = shown_significant(test.f, 3);
        row.degrees_of_freedom = test.angles;
        if (std::isfinite(test.residual)) {
            row.residual_degrees_of_freedom = test.residual;
        }
        row.p_value = {test.p_value, test.p_value < 1e-4
                                         ? "< 0.0001"
                                         : gum::round_significant_beside(test.p_value, 2, {model.alpha})};
        row.spread = shown_significant(test.spread / unit.si, 2);
        row.unit = unit.record;
        row.depends_on_angle = test.depends_on_angle;
        model.tests.push_back(std::move(row));
    }
}

/// The poses of both senses at every angle, where the adjustment has them.
void fill_sense_curves_by_angle(reports::RotaryTable& rotary, const engine::RotaryTableModel& model,
                                const gum::RotaryTableResult& result) {
    const gum::UncertaintyBudget& propagation = result.reported.budget;
    const engine::JointAdjustment& solved = model.solved();
    const engine::RotaryTableMeasurement& measurement = model.measurement();
    const engine::AnglewiseMap map =
        engine::map_of_both_senses(engine::reported_map(solved, model.equations(), result.solution.datum));
    const Eigen::VectorXd variance = engine::contributions_of(model, map).covariance.diagonal();
    rotary.sense_curves = {{.direction = "+", .points = {}}, {.direction = "-", .points = {}}};
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        const Eigen::Matrix<double, 6, 1> half = 0.5 * solved.reversal(i);
        for (std::size_t sense = 0; sense < 2; ++sense) {
            reports::SensePoint point;
            point.angle_deg = measurement.angles_deg[i];
            for (std::size_t c = 0; c < 6; ++c) {
                const auto at = static_cast<Eigen::Index>(c);
                const Eigen::Index error = 6 * static_cast<Eigen::Index>(i) + at;
                const double unit = c < 3 ? k_um.si : k_arcsec.si;
                const Eigen::Index row = 12 * static_cast<Eigen::Index>(i) + 6 * static_cast<Eigen::Index>(sense) + at;
                point.value[c] = (propagation.value[error] + (sense == 0 ? half[at] : -half[at])) / unit;
                point.u[c] = std::sqrt(std::max(0.0, variance[row])) / unit;
                point.U[c] = std::max(propagation.coverage_factor[error],
                                      propagation.coverage_factor[result.solution.quantities.reversal + at]) *
                             point.u[c];
            }
            rotary.sense_curves[sense].points.push_back(point);
        }
    }
}

/// The curves E ± reversal/2 and what the residuals of each sense at each angle add to them.
void fill_sense_curves(reports::RotaryTable& rotary, const engine::RotaryTableModel& model,
                       const gum::RotaryTableResult& result) {
    if (!result.solution.quantities.has_reversal) {
        return;
    }
    if (model.solved().reversal_by_angle()) {
        fill_sense_curves_by_angle(rotary, model, result);
        return;
    }
    const gum::UncertaintyBudget& propagation = result.reported.budget;
    const engine::AnglewiseCovariance& covariance = result.reported.covariance;
    rotary.sense_curves = {{.direction = "+", .points = {}}, {.direction = "-", .points = {}}};
    for (const engine::SenseDeviation& from :
         engine::sense_deviations(model.solved(), model.equations(), model.parameter_covariance())) {
        reports::SensePoint point;
        point.angle_deg = model.measurement().angles_deg[from.angle];
        const double half = from.approach == Approach::positive ? 0.5 : -0.5;
        for (Eigen::Index c = 0; c < 6; ++c) {
            const Eigen::Index error = 6 * static_cast<Eigen::Index>(from.angle) + c;
            const Eigen::Index reversal = result.solution.quantities.reversal + c;
            const double unit = c < 3 ? k_um.si : k_arcsec.si;
            const double variance = covariance(error, error) + 2.0 * half * covariance(error, reversal) +
                                    half * half * covariance(reversal, reversal) + from.covariance(c, c);
            const auto at = static_cast<std::size_t>(c);
            point.value[at] =
                (propagation.value[error] + half * propagation.value[reversal] + from.deviation[c]) / unit;
            point.u[at] = std::sqrt(std::max(0.0, variance)) / unit;
            // The reversal has the degrees of freedom of the curve: both rest on the same residuals.
            point.U[at] =
                std::max(propagation.coverage_factor[error], propagation.coverage_factor[reversal]) * point.u[at];
        }
        rotary.sense_curves[from.approach == Approach::positive ? 0 : 1].points.push_back(point);
    }
}

/// Whole degrees, 0 to 359.
std::string printed_phase(double degrees) {
    const std::string text = gum::round_to_quantum(degrees, 0);
    return text == "360" ? "0" : text;
}

reports::HarmonicRow harmonic_row(const std::string& name, const DocumentUnit& unit,
                                  const engine::HarmonicAnalysis& analysis, double k) {
    reports::HarmonicRow row{
        .name = name, .unit = unit.record, .orders = {}, .rms_rest = shown_significant(analysis.rms_rest / unit.si, 2)};
    for (const engine::Harmonic& from : analysis.orders) {
        reports::HarmonicOrder order;
        order.order = from.order;
        const double amplitude = from.amplitude / unit.si;
        order.u = from.u_amplitude / unit.si;
        const double U = k * order.u;
        const double phase = from.phase * k_degrees;
        const reports::Printed text = printed(amplitude, U, unit);
        order.amplitude = {amplitude, text.value};
        order.U = {U, text.U};
        // Of an amplitude within its uncertainty the phase says nothing.
        order.phase_deg = {phase, amplitude > U ? printed_phase(phase) : ""};
        row.orders.push_back(std::move(order));
    }
    return row;
}

void fill_harmonics(reports::RotaryTable& rotary, const RotaryTableMeasurement& measurement,
                    const gum::QuantityUncertainty& reported) {
    const gum::UncertaintyBudget& propagation = reported.budget;
    const auto count = static_cast<Eigen::Index>(measurement.angles.size());
    const Eigen::VectorXd angles = Eigen::Map<const Eigen::VectorXd>(measurement.angles.data(), count);
    const int orders = engine::resolved_orders(angles, k_most_orders);
    if (orders < 2) {
        return;
    }
    for (Eigen::Index c = 0; c < 6; ++c) {
        const auto of_motion = Eigen::seqN(c, count, 6);
        const auto covariance_of = [&](const Eigen::MatrixXd& combinations) -> Eigen::MatrixXd {
            Eigen::MatrixXd of_all = Eigen::MatrixXd::Zero(combinations.rows(), reported.covariance.rows());
            of_all(Eigen::all, of_motion) = combinations;
            return reported.covariance.of_combinations(of_all);
        };
        const engine::HarmonicAnalysis analysis =
            engine::analyse_harmonics(angles, propagation.value(of_motion), covariance_of, orders);
        const double k = propagation.coverage_factor(of_motion).maxCoeff();
        rotary.harmonics.push_back(
            harmonic_row(rotary.error_names[static_cast<std::size_t>(c)], c < 3 ? k_um : k_arcsec, analysis, k));
    }
}

double largest_distance(const Eigen::MatrixX3d& points) {
    double largest = 0.0;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        for (Eigen::Index j = i + 1; j < points.rows(); ++j) {
            largest = std::max(largest, (points.row(i) - points.row(j)).norm());
        }
    }
    return largest;
}

reports::StationEnvironment environment_of(const jobs::RotaryTableJob& job, std::size_t station,
                                           double largest_distance_um) {
    const RotaryTableMeasurement& measurement = job.measurement;
    const auto at = static_cast<Eigen::Index>(station);
    reports::StationEnvironment row;
    row.station = measurement.stations[station];
    const auto shown = [](const std::optional<double>& v, int decimals) -> Shown<std::optional<double>> {
        return v ? shown_to_quantum(*v, decimals) : Shown<std::optional<double>>();
    };
    const double difference = measurement.temperature_difference[at];
    row.fixture_degC = shown_to_quantum(job.reference_temperature_degC + difference, 3);
    row.u_fixture_K = shown_significant(measurement.u_temperature[at], 2);
    row.air_degC = shown(job.air[station].temperature_degC, 2);
    row.pressure_hPa = shown(job.air[station].pressure_hPa, 1);
    row.humidity_percent = shown(job.air[station].humidity_percent, 0);
    row.expansion_um = shown_to_quantum(measurement.expansion * difference * largest_distance_um, 2);
    return row;
}

void fill_environment(reports::RotaryTable& rotary, const jobs::RotaryTableJob& job) {
    const RotaryTableMeasurement& measurement = job.measurement;
    if (job.air.size() != measurement.stations.size() || job.air.empty()) {
        return;
    }
    reports::Environment environment;
    const double reference = job.reference_temperature_degC;
    environment.reference_degC = {reference, text::shortest(reference)};
    environment.expansion_per_K = {measurement.expansion, gum::round_significant(1e6 * measurement.expansion, 3)};
    environment.u_expansion_per_K = {measurement.u_expansion, gum::round_significant(1e6 * measurement.u_expansion, 2)};
    environment.largest_distance_mm = shown_to_quantum(largest_distance(measurement.fixture) / gum::k_millimetre, 0);
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        environment.stations.push_back(environment_of(job, j, environment.largest_distance_mm.number * 1000.0));
    }
    double largest_share = 0.0;
    const auto source = std::find(rotary.budget_sources.begin(), rotary.budget_sources.end(), "fixture thermal");
    if (source != rotary.budget_sources.end()) {
        const auto at = static_cast<std::size_t>(source - rotary.budget_sources.begin());
        for (std::size_t c = 0; c < std::min<std::size_t>(6, rotary.budget_summary.size()); ++c) {
            largest_share = std::max(largest_share, rotary.budget_summary[c].shares.number[at]);
        }
    }
    const auto [cold, warm] =
        std::minmax_element(environment.stations.begin(), environment.stations.end(),
                            [](const auto& a, const auto& b) { return a.fixture_degC.number < b.fixture_degC.number; });
    environment.printed_lowest = cold->fixture_degC.text;
    environment.printed_highest = warm->fixture_degC.text;
    environment.printed_least_expansion = cold->expansion_um.text;
    environment.printed_most_expansion = warm->expansion_um.text;
    environment.largest_share = shown_share(largest_share);
    rotary.environment = std::move(environment);
}

void fill_runs(reports::RotaryTable& rotary, const engine::TableParameterModel& model) {
    if (!rotary.iso230_2) {
        return;
    }
    const engine::PositioningRuns& runs = model.parameters()->runs();
    const auto deviations = [&](const std::vector<Eigen::Index>& of_target) {
        std::vector<double> all;
        for (const Eigen::Index v : of_target) {
            all.push_back(model.nominal_positions()[v] / gum::k_arcsecond);
        }
        return all;
    };
    for (std::size_t i = 0; i < rotary.iso230_2->targets.size(); ++i) {
        rotary.iso230_2->targets[i].runs_up = deviations(runs.up[i]);
        rotary.iso230_2->targets[i].runs_down = deviations(runs.down[i]);
    }
}

void fill_lengths(reports::RotaryTable& rotary, const RotaryTableMeasurement& measurement) {
    if (measurement.lengths.size() > k_most_lengths || rotary.reliability.size() != measurement.lengths.size()) {
        return;
    }
    for (std::size_t i = 0; i < measurement.lengths.size(); ++i) {
        rotary.reliability[i].printed_length =
            gum::round_to_quantum(measurement.lengths[i].length / gum::k_millimetre, 6);
    }
}

}  // namespace

const char* group_kind_name(GroupKind kind) {
    switch (kind) {
        case GroupKind::visit_length:
            return "visit_length";
        case GroupKind::visit_pose:
            return "visit_pose";
        case GroupKind::dead_path_change:
            return "dead_path_change";
        case GroupKind::station_place:
            return "station_place";
        case GroupKind::pair_length:
            return "pair_length";
        case GroupKind::drift:
            return "drift";
        case GroupKind::angle_index:
            return "angle_index";
        case GroupKind::succession:
            return "succession";
        case GroupKind::station:
            return "station";
        case GroupKind::reflector:
            return "reflector";
        case GroupKind::reflector_at_angles:
            return "reflector_at_angles";
        case GroupKind::reflector_from_visit:
            return "reflector_from_visit";
        case GroupKind::fixture_scale:
            return "fixture_scale";
        case GroupKind::station_scale:
            return "station_scale";
        case GroupKind::fixture_place:
            return "fixture_place";
        case GroupKind::expansion:
            return "expansion";
        case GroupKind::senses:
            return "senses";
    }
    return "";
}

void fill_evidence(reports::RotaryTable& rotary, const jobs::RotaryTableJob& job,
                   const gum::RotaryTableResult& result) {
    const RotaryTableMeasurement& measurement = job.measurement;
    if (result.solution.groups) {
        fill_group_tests(rotary, *result.solution.groups, measurement);
    }
    fill_reversal_model(rotary, result.solution);
    if (const auto model = std::dynamic_pointer_cast<const engine::RotaryTableModel>(result.solution.model)) {
        const std::vector<engine::VisitDeviation> none;
        fill_visits(rotary, *model, result.parameter_model->gains(),
                    result.solution.groups ? result.solution.groups->visits : none);
        fill_sense_curves(rotary, *model, result);
    }
    fill_harmonics(rotary, measurement, result.reported);
    fill_environment(rotary, job);
    fill_runs(rotary, *result.parameter_model);
    fill_lengths(rotary, measurement);
}

}  // namespace gumcert::reports
