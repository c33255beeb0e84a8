#include "app/simulate_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "app/fixture_budget.h"
#include "app/simulation_study.h"
#include "engine/campaign_layout.h"
#include "engine/rotary_table_evaluation.h"
#include "gum/coverage.h"
#include "gum/quantity/units.h"
#include "gum/rounding.h"
#include "reports/record/evaluation_record.h"
#include "reports/svg_plot.h"

namespace gumcert::app {

namespace {

using engine::Datum;
using engine::RotaryTableMeasurement;
using engine::SimulationRequest;
using nlohmann::json;

// What the source paper states of its simulation: largest relative differences, [1].
constexpr double k_paper_offset = 0.045, k_paper_tilt = 0.0435, k_paper_linear = 0.0325, k_paper_angular = 0.0230;
// Rows of the tables: without the sequential method in a datum that its paper does not use. Indices of k_estimators.
constexpr std::array<std::size_t, 3> k_shown{0, 1, 3};
constexpr std::size_t k_most_runs = 1'000'000;

std::string percent_text(double share, int decimals = 2) {
    return gum::round_to_quantum(100.0 * share, decimals);
}

std::string micrometres(double value) {
    return gum::round_significant(value / gum::k_micrometre, 3);
}

std::string arcseconds(double value) {
    return gum::round_significant(value / gum::k_arcsecond, 3);
}

std::string method_text(const Estimator& estimator) {
    return std::string(estimator.method == engine::AdjustmentMethod::joint ? "joint" : "sequential") + ", " +
           (estimator.datum == Datum::axis_average_line ? "axis average line" : "home");
}

const char* method_word(const Estimator& estimator) {
    return estimator.method == engine::AdjustmentMethod::joint ? "joint" : "sequential";
}

const char* datum_word(Datum datum) {
    return datum == Datum::axis_average_line ? "axis_average_line" : "home";
}

/// What relative differences are relative to, by tally.
struct Scales {
    double offset, tilt, linear, angular;

    [[nodiscard]] double of(std::size_t tally) const {
        switch (tally) {
            case k_offset_tally:
                return offset;
            case k_tilt_tally:
                return tilt;
            case k_linear_tally:
                return linear;
            default:
                return angular;
        }
    }
};

std::string relative(double value, double scale) {
    return scale > 0.0 ? percent_text(value / scale) : "";
}

// ---- what is simulated ----------------------------------------------------------------------------------------------

struct Basis {
    RotaryTableMeasurement layout;  ///< with lengths, and a position of every station
    SimulationRequest request;
    engine::TableRepeatability table;
    std::string table_from, stations_from;  ///< for the document
};

bool all_stations_known(const RotaryTableMeasurement& measurement) {
    return std::all_of(measurement.station_start.begin(), measurement.station_start.end(),
                       [](const auto& start) { return start.has_value(); });
}

Basis basis_of(const engine::RotaryTableJob& job, std::optional<std::size_t> runs, std::optional<std::uint64_t> seed,
               const Progress& progress) {
    Basis basis;
    basis.layout = job.measurement;
    basis.request = job.simulation.value_or(SimulationRequest{});
    basis.request.runs = runs.value_or(basis.request.runs);
    basis.request.seed = seed.value_or(basis.request.seed);
    if (basis.request.runs < 1 || basis.request.runs > k_most_runs) {
        throw gum::InputError(gum::Diagnostic{"GC-SIMULATE-0001", "runs", std::to_string(basis.request.runs),
                                              "a study has 1 to 1000000 campaigns", "state another number of runs",
                                              gum::Severity::error});
    }
    RotaryTableMeasurement& layout = basis.layout;
    basis.table = basis.request.table_repeatability.value_or(layout.table_repeatability);
    const bool table_unknown = !basis.request.table_repeatability &&
                               basis.table.mode == engine::RepeatabilityMode::estimate && basis.table.u_linear <= 0.0 &&
                               basis.table.u_axial <= 0.0 && basis.table.u_tilt <= 0.0;
    if (basis.table.mode == engine::RepeatabilityMode::none) {
        basis.table.u_linear = basis.table.u_axial = basis.table.u_tilt = 0.0;
    }
    basis.table_from = basis.request.table_repeatability ? "stated for the simulation" : "stated by the job";
    basis.stations_from = "stations file";
    const bool measured = !layout.lengths.empty();
    if (measured && (table_unknown || !all_stations_known(layout))) {
        if (progress) {
            progress("joint adjustment of the measured lengths");
        }
        RotaryTableMeasurement measurement = layout;
        measurement.method = engine::AdjustmentMethod::joint;
        engine::EvaluationOptions options;
        options.critical_value = gum::two_sided_normal_critical_value(measurement.outliers.alpha);
        const engine::RotaryTableSolution solution = engine::evaluate_jointly(measurement, options);
        if (table_unknown) {
            basis.table.u_linear = std::sqrt(solution.stochastic.variance_linear);
            basis.table.u_axial = std::sqrt(solution.stochastic.variance_axial);
            basis.table.u_tilt = std::sqrt(solution.stochastic.variance_tilt);
            basis.table_from = "estimated from the measured lengths";
        }
        if (!all_stations_known(layout)) {
            for (std::size_t j = 0; j < layout.stations.size(); ++j) {
                layout.station_start[j] = solution.stations[j].position;
            }
            basis.stations_from = "joint adjustment of the measured lengths";
        }
    } else if (table_unknown) {
        basis.table_from = "a perfect table, because the job states none";
    }
    if (!measured) {
        const engine::PlanRequest plan = job.plan.value_or(engine::PlanRequest{});
        if (layout.angles.empty() && !plan.angles_deg.empty()) {
            layout.angles_deg = plan.angles_deg;
            for (const double angle : plan.angles_deg) {
                layout.angles.push_back(angle * gum::k_degree);
            }
        }
        if (layout.angles.empty() && !basis.request.angle_counts.empty()) {
            layout = engine::with_full_turn(layout, basis.request.angle_counts.front());
        }
        engine::lay_out(layout, plan.both_senses, plan.dead_path_per_reflector);
    }
    return basis;
}

// ---- tables ---------------------------------------------------------------------------------------------------------

using reports::StudyColumn;
using reports::StudyTable;

constexpr const char* k_percent = "%";

StudyTable difference_table(const std::string& caption, const std::vector<AngleStudy>& studies, bool noisy,
                            const std::array<std::size_t, 2>& kinds, const std::array<std::string, 2>& names,
                            const std::array<double, 2>& paper, const Scales& scales) {
    StudyTable table;
    table.caption = caption;
    table.columns = {{"angles", "", true}, {"method, datum", "", false}};
    for (const std::string& name : names) {
        for (const char* statistic : {"mean", "rms", "largest"}) {
            table.columns.push_back({name + ", " + statistic, k_percent, true});
        }
    }
    const auto add_row = [&](std::size_t angles, const std::string& method, const Tallies* tallies) {
        std::vector<std::string> row{std::to_string(angles), method};
        for (const std::size_t kind : kinds) {
            const DifferenceTally none;
            const DifferenceTally& tally = tallies != nullptr ? (*tallies)[kind] : none;
            for (const double value : {tally.mean_absolute(), tally.rms(), tally.maximum}) {
                row.push_back(tally.count > 0 ? relative(value, scales.of(kind)) : "");
            }
        }
        table.rows.push_back(std::move(row));
    };
    for (const AngleStudy& study : studies) {
        if (study.evaluated) {
            const CampaignResults& results = noisy ? study.noisy : study.exact;
            for (const std::size_t e : k_shown) {
                add_row(study.angles, method_text(k_estimators[e]), &results.tallies[e]);
            }
        } else if (!noisy) {
            add_row(study.angles, "datum alone, axis average line", study.datum_only.data());
            add_row(study.angles, "datum alone, home", &study.datum_only[1]);
        }
    }
    table.rows.push_back(
        {"not stated", "source paper", "", "", percent_text(paper[0]), "", "", percent_text(paper[1])});
    return table;
}

StudyTable parts_table(const std::vector<AngleStudy>& studies, const Scales& scales) {
    StudyTable table;
    table.caption =
        "Where the differences with measurement noise come from: root mean square of the whole difference, of its "
        "datum "
        "part and of its measurement part, relative as in the tables above";
    table.columns = {{"angles", "", true}, {"method, datum", "", false}};
    for (const char* kind : {"offset", "tilt", "linear", "angular"}) {
        for (const char* part : {"whole", "datum", "measurement"}) {
            table.columns.push_back({std::string(kind) + ", " + part, k_percent, true});
        }
    }
    for (const AngleStudy& study : studies) {
        for (const std::size_t e : k_shown) {
            if (!study.evaluated) {
                continue;
            }
            std::vector<std::string> row{std::to_string(study.angles), method_text(k_estimators[e])};
            for (const std::size_t kind : {k_offset_tally, k_tilt_tally, k_linear_tally, k_angular_tally}) {
                const DifferenceTally& tally = study.noisy.tallies[e][kind];
                for (const double value : {tally.rms(), tally.datum_rms(), tally.measurement_rms()}) {
                    row.push_back(tally.count > 0 ? relative(value, scales.of(kind)) : "");
                }
            }
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

/// Names of the tallies that have one, as people read them.
std::vector<std::pair<std::size_t, std::string>> named_tallies(const RotaryTableMeasurement& layout) {
    std::vector<std::pair<std::size_t, std::string>> names;
    const auto motions = engine::error_motion_names(layout.axis);
    for (std::size_t c = 0; c < motions.size(); ++c) {
        names.emplace_back(c, motions[c]);
    }
    const auto across = engine::across_axis(layout.axis);
    for (std::size_t c = 0; c < 2; ++c) {
        names.emplace_back(6 + c, std::string("O") + "xyz"[across[c]]);
    }
    for (std::size_t c = 0; c < 2; ++c) {
        names.emplace_back(8 + c, std::string("S") + "xyz"[across[c]]);
    }
    return names;
}

bool is_linear(std::size_t tally) {
    return tally < 3 || tally == 6 || tally == 7 || tally == k_linear_tally || tally == k_offset_tally;
}

StudyTable agreement_table(const AngleStudy& study, std::size_t estimator, const RotaryTableMeasurement& layout,
                           double probability) {
    StudyTable table;
    table.caption = std::to_string(study.angles) + " angles, " + method_text(k_estimators[estimator]) +
                    ": errors (estimate minus the truth carried to the datum) against stated uncertainties";
    table.columns = {{"quantity", "", false},
                     {"unit", "", false},
                     {"rms of errors", "", true},
                     {"rms of stated u", "", true},
                     {"rms of error / u", "", true},
                     {"within U", k_percent, true},
                     {"limits if independent", k_percent, false},
                     {"standard error from the scatter of campaigns", k_percent, true}};
    auto names = named_tallies(layout);
    names.emplace_back(k_reversal_tally, "reversal");
    names.emplace_back(k_all_tally, "all");
    for (const auto& [t, name] : names) {
        const DifferenceTally& tally = study.noisy.tallies[estimator][t];
        if (tally.judged == 0) {
            continue;
        }
        const bool mixed = t == k_reversal_tally || t == k_all_tally;
        const auto in_unit = [&, linear = is_linear(t)](double value) {
            return mixed ? std::string() : (linear ? micrometres(value) : arcseconds(value));
        };
        // Normal limits of a binomial share (p = 0.95 of the count), as wide as they can be when p is near 1.
        const double half =
            1.959963984540054 * std::sqrt(probability * (1.0 - probability) / static_cast<double>(tally.judged));
        table.rows.push_back(
            {name, mixed ? "" : (is_linear(t) ? "µm" : "″"), in_unit(tally.measurement_rms()),
             in_unit(tally.stated_rms()), gum::round_to_quantum(tally.normalised_rms(), 3),
             percent_text(tally.coverage()),
             percent_text(probability - half) + " … " + percent_text(std::min(1.0, probability + half)),
             tally.runs > 1 ? percent_text(tally.coverage_standard_error()) : ""});
    }
    return table;
}

StudyTable campaign_table(const std::vector<AngleStudy>& studies) {
    StudyTable table;
    table.caption = "Joint adjustments with measurement noise";
    table.columns = {{"angles", "", true},
                     {"distances a campaign", "", true},
                     {"campaigns with a result", "", true},
                     {"mean chi-square", "", true},
                     {"mean degrees of freedom", "", true},
                     {"planted outliers", "", true},
                     {"found", k_percent, true},
                     {"good distances flagged", k_percent, true},
                     {"sequential with a result", "", true}};
    for (const AngleStudy& study : studies) {
        if (!study.evaluated) {
            continue;
        }
        const CampaignResults& r = study.noisy;
        const auto n = static_cast<double>(r.evaluated[0]);
        const auto share = [](std::size_t part, std::size_t whole) {
            return whole == 0 ? std::string() : percent_text(static_cast<double>(part) / static_cast<double>(whole), 3);
        };
        table.rows.push_back(
            {std::to_string(study.angles), std::to_string(study.lengths), std::to_string(r.evaluated[0]),
             n > 0.0 ? gum::round_to_quantum(r.sum_chi_square / n, 1) : "",
             n > 0.0 ? gum::round_to_quantum(r.sum_degrees_of_freedom / n, 1) : "", std::to_string(r.planted),
             share(r.planted_found, r.planted), share(r.good_flagged, r.good), std::to_string(r.evaluated[1])});
    }
    return table;
}

// ---- figures --------------------------------------------------------------------------------------------------------

std::optional<reports::StudyFigure> parts_figure(const std::vector<AngleStudy>& studies, const Scales& scales) {
    if (studies.size() < 2) {
        return std::nullopt;
    }
    reports::Plot plot{.id = "plot-parts",
                       .title = "Differences from the assumed values against the number of angles",
                       .description = "Root mean square of the datum part and of the measurement part",
                       .x_label = "number of angles",
                       .panels = {},
                       .columns = 2,
                       .panel_height = 150.0,
                       .x_is_angle = false};
    const std::array<std::pair<std::size_t, const char*>, 4> kinds{{{k_offset_tally, "set-up, offset"},
                                                                    {k_tilt_tally, "set-up, tilt"},
                                                                    {k_linear_tally, "error motions, linear"},
                                                                    {k_angular_tally, "error motions, angular"}}};
    for (const auto& [kind, heading] : kinds) {
        if (!(scales.of(kind) > 0.0)) {
            continue;
        }
        reports::PlotSeries home{.label = "datum part, home", .points = {}, .joined = true};
        reports::PlotSeries average{.label = "datum part, axis average line",
                                    .points = {},
                                    .marker = reports::PlotMarker::square,
                                    .joined = true};
        reports::PlotSeries measurement{.label = "measurement part, joint, axis average line",
                                        .points = {},
                                        .marker = reports::PlotMarker::triangle,
                                        .joined = true};
        for (const AngleStudy& study : studies) {
            const auto x = static_cast<double>(study.angles);
            const auto point = [&, scale = scales.of(kind)](double value) {
                return reports::PlotPoint{.x = x, .y = 100.0 * value / scale, .U = 0.0};
            };
            average.points.push_back(point(study.datum_only[0][kind].rms()));
            home.points.push_back(point(study.datum_only[1][kind].rms()));
            if (study.noisy.evaluated[0] > 0) {
                measurement.points.push_back(point(study.noisy.tallies[0][kind].measurement_rms()));
            }
        }
        plot.panels.push_back({.heading = heading,
                               .y_label = "rms / %",
                               .series = {std::move(home), std::move(average), std::move(measurement)},
                               .limits = {{0.0, ""}}});
    }
    if (plot.panels.empty()) {
        return std::nullopt;
    }
    return reports::StudyFigure{
        .caption = "Root mean square of the two parts of the differences against the number of angles",
        .alternative_text =
            "The datum parts fall with the number of angles; the measurement part is far smaller throughout",
        .drawing = reports::svg(plot)};
}

std::optional<reports::StudyFigure> histogram_figure(const std::vector<AngleStudy>& studies) {
    const AngleStudy* chosen = nullptr;
    for (const AngleStudy& study : studies) {
        if (study.noisy.evaluated[0] > 0) {
            chosen = &study;
        }
    }
    if (chosen == nullptr) {
        return std::nullopt;
    }
    double total = 0.0;
    for (const std::size_t cell : chosen->noisy.histogram) {
        total += static_cast<double>(cell);
    }
    reports::DensityPlot plot{.id = "plot-normalised-errors",
                              .title = "Normalised errors",
                              .description = "Histogram of errors divided by their standard uncertainties",
                              .x_label = "error / standard uncertainty",
                              .y_label = "probability density",
                              .low = k_histogram_first,
                              .high = -k_histogram_first,
                              .first_edge = k_histogram_first,
                              .cell_width = k_histogram_width,
                              .cells = {},
                              .cells_label = "campaigns",
                              .curve = {},
                              .curve_label = "standard normal distribution",
                              .intervals = {}};
    for (const std::size_t cell : chosen->noisy.histogram) {
        plot.cells.push_back(static_cast<double>(cell) / (total * k_histogram_width));
    }
    for (int i = -45; i <= 45; ++i) {
        const double z = 0.1 * i;
        plot.curve.push_back({.x = z, .y = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi), .U = 0.0});
    }
    return reports::StudyFigure{
        .caption = "Errors of the six error motions of all campaigns with " + std::to_string(chosen->angles) +
                   " angles, each divided by its standard uncertainty (joint adjustment, axis average line)",
        .alternative_text = "A histogram that follows the standard normal density",
        .drawing = reports::svg(plot)};
}

// ---- the paragraph for people ---------------------------------------------------------------------------------------

std::vector<std::string> conclusion(const std::vector<AngleStudy>& studies, const Scales& scales) {
    std::vector<std::string> paragraphs;
    paragraphs.emplace_back(
        "Distances do not tell error motions that are the same at all angles, or that turn with the table once per "
        "revolution, from another place of the axis or another set-up of the fixture. A datum decides where such a "
        "part "
        "is counted. The assumed error motions are independent random numbers at every angle: by chance they contain "
        "such parts, and every method that states its result in a datum moves them from one quantity to another. A "
        "comparison with the assumed numbers therefore differs even where every distance is exact.");
    for (const AngleStudy& study : studies) {
        std::string text = std::to_string(study.angles) +
                           " angles: carried to the datum of the home position without "
                           "any measurement, the assumed offsets change by " +
                           relative(study.datum_only[1][k_offset_tally].rms(), scales.offset) + " % and the tilts by " +
                           relative(study.datum_only[1][k_tilt_tally].rms(), scales.tilt) +
                           " % of their size (root mean square). ";
        if (!(scales.offset > 0.0) || !(scales.tilt > 0.0)) {
            continue;
        }
        if (study.noisy.evaluated[0] > 0) {
            const Tallies& joint = study.noisy.tallies[1];
            text += "With all measurement noise the joint adjustment differs by " +
                    relative(joint[k_offset_tally].rms(), scales.offset) + " % and " +
                    relative(joint[k_tilt_tally].rms(), scales.tilt) + " %, of which the measurement is " +
                    relative(joint[k_offset_tally].measurement_rms(), scales.offset) + " % and " +
                    relative(joint[k_tilt_tally].measurement_rms(), scales.tilt) + " %.";
        }
        paragraphs.push_back(std::move(text));
    }
    paragraphs.emplace_back(
        "The source paper states set-up differences of at most 4.5 % and 4.35 % and error motion differences of at "
        "most "
        "3.25 % and 2.30 %, without the number of angles and without saying whether mean values or single ones are "
        "meant. "
        "Numbers of this size come from the datum alone, with no measurement at all, for some tens to some hundreds of "
        "angles. Such percentages measure how much of the random numbers happens to look like a set-up error; they do "
        "not measure how well an instrument or a method measures: more angles make them smaller, better instruments do "
        "not. What a measurement can be held to is the difference between its result and the truth in the same datum, "
        "against its stated uncertainty. The tables of agreement below show that.");
    return paragraphs;
}

// ---- data -----------------------------------------------------------------------------------------------------------

json tally_json(const DifferenceTally& tally) {
    json object{
        {"count", tally.count},
        {"difference", {{"mean_absolute", tally.mean_absolute()}, {"rms", tally.rms()}, {"largest", tally.maximum}}},
        {"datum_part_rms", tally.datum_rms()},
        {"measurement_part_rms", tally.measurement_rms()}};
    if (tally.judged > 0) {
        object["judged"] = tally.judged;
        object["stated_u_rms"] = tally.stated_rms();
        object["normalised_rms"] = tally.normalised_rms();
        object["coverage"] = tally.coverage();
        object["coverage_standard_error"] = tally.coverage_standard_error();
    }
    return object;
}

json tallies_json(const Tallies& tallies, const RotaryTableMeasurement& layout) {
    auto names = named_tallies(layout);
    for (const auto& [t, name] :
         {std::pair{k_linear_tally, "error_motions_linear"}, std::pair{k_angular_tally, "error_motions_angular"},
          std::pair{k_offset_tally, "set_up_offset"}, std::pair{k_tilt_tally, "set_up_tilt"}}) {
        names.emplace_back(t, name);
    }
    json list = json::array();
    for (const auto& [t, name] : names) {
        json object = tally_json(tallies[t]);
        object["name"] = name;
        object["unit"] = is_linear(t) ? "m" : "rad";
        list.push_back(std::move(object));
    }
    return list;
}

json results_json(const CampaignResults& results, const RotaryTableMeasurement& layout, bool noisy) {
    json object;
    object["estimators"] = json::array();
    for (std::size_t e = 0; e < k_estimators.size(); ++e) {
        const std::size_t method = e / 2;
        json estimator{{"method", method_word(k_estimators[e])},
                       {"datum", datum_word(k_estimators[e].datum)},
                       {"campaigns", results.evaluated[method]},
                       {"quantities", json::array()}};
        if (results.evaluated[method] > 0) {
            estimator["quantities"] = tallies_json(results.tallies[e], layout);
            if (noisy) {
                const DifferenceTally& all = results.tallies[e][k_all_tally];
                estimator["agreement"] = {{"values", all.judged},
                                          {"normalised_rms", all.normalised_rms()},
                                          {"coverage", all.coverage()},
                                          {"coverage_standard_error", all.coverage_standard_error()}};
            }
        }
        estimator["first_failure"] = results.failure[method] ? json(gum::message(*results.failure[method])) : json();
        object["estimators"].push_back(std::move(estimator));
    }
    if (noisy && results.evaluated[0] > 0) {
        const auto n = static_cast<double>(results.evaluated[0]);
        object["chi_square_mean"] = results.sum_chi_square / n;
        object["degrees_of_freedom_mean"] = results.sum_degrees_of_freedom / n;
        object["outliers"] = {{"planted", results.planted},
                              {"found", results.planted_found},
                              {"good", results.good},
                              {"good_flagged", results.good_flagged}};
        object["histogram"] = {
            {"first_edge", k_histogram_first}, {"cell_width", k_histogram_width}, {"counts", results.histogram}};
    }
    return object;
}

std::string data_json(const std::string& job_name, const engine::RotaryTableJob& job, const Basis& basis,
                      const std::vector<AngleStudy>& studies) {
    const SimulationRequest& request = basis.request;
    const engine::LengthUncertainty& length = basis.layout.length_uncertainty;
    json data{{"schema", "gumcert/simulation/1"},
              {"job", job_name},
              {"title", job.title},
              {"axis", std::string(1, "ABC"[engine::axial_coordinate(basis.layout.axis)])},
              {"runs", request.runs},
              {"seed", request.seed},
              {"coverage_probability", job.coverage_probability}};
    data["assumed"] = {{"set_up_offset", request.set_up_offset},
                       {"set_up_tilt", request.set_up_tilt},
                       {"error_linear", request.error_linear},
                       {"error_angular", request.error_angular},
                       {"outliers", request.outliers},
                       {"outlier_size", request.outlier_size},
                       {"table_u_linear", basis.table.u_linear},
                       {"table_u_axial", basis.table.u_axial},
                       {"table_u_tilt", basis.table.u_tilt},
                       {"length_u_constant", length.u_constant},
                       {"length_u_proportional", length.u_proportional}};
    data["source_paper"] = {{"set_up_offset", k_paper_offset},
                            {"set_up_tilt", k_paper_tilt},
                            {"error_linear", k_paper_linear},
                            {"error_angular", k_paper_angular}};
    data["studies"] = json::array();
    for (const AngleStudy& study : studies) {
        json object{{"angles", study.angles}, {"lengths", study.lengths}};
        object["datum_only"] = json::array();
        for (std::size_t d = 0; d < 2; ++d) {
            object["datum_only"].push_back({{"datum", datum_word(d == 0 ? Datum::axis_average_line : Datum::home)},
                                            {"quantities", tallies_json(study.datum_only[d], basis.layout)}});
        }
        object["without_noise"] = study.evaluated ? results_json(study.exact, basis.layout, false) : json();
        object["with_noise"] = study.evaluated ? results_json(study.noisy, basis.layout, true) : json();
        data["studies"].push_back(std::move(object));
    }
    return reports::canonical_json(data);
}

std::string angle_list(const std::vector<AngleStudy>& studies) {
    std::string text;
    for (const AngleStudy& study : studies) {
        text += (text.empty() ? "" : ", ") + std::to_string(study.angles);
    }
    return text;
}

void require_a_result(const std::vector<AngleStudy>& studies) {
    for (const AngleStudy& study : studies) {
        for (const CampaignResults* results : {&study.exact, &study.noisy}) {
            if (study.evaluated && results->evaluated[0] == 0 && results->failure[0]) {
                throw gum::NoResultError(*results->failure[0]);
            }
        }
    }
}

}  // namespace

reports::StudyDocument simulate_job(const std::filesystem::path& job, std::optional<std::size_t> runs,
                                    std::optional<std::uint64_t> seed, unsigned threads, const Progress& progress) {
    const engine::RotaryTableJob read = engine::read_rotary_table_job(job, engine::JobUse::simulate);
    return simulate_job(read, job.filename().string(), runs, seed, threads, progress);
}

reports::StudyDocument simulate_job(const engine::RotaryTableJob& stated, const std::string& job_name,
                                    std::optional<std::size_t> runs, std::optional<std::uint64_t> seed,
                                    unsigned threads, const Progress& progress) {
    engine::RotaryTableJob job = stated;
    (void)apply_fixture_budget(job);
    const Basis basis = basis_of(job, runs, seed, progress);
    const SimulationRequest& request = basis.request;
    const Scales scales{std::abs(request.set_up_offset), std::abs(request.set_up_tilt), request.error_linear,
                        request.error_angular};
    gum::WorkerThreads workers(threads);
    std::vector<AngleStudy> studies;
    if (request.angle_counts.empty()) {
        studies.push_back(
            study_layout(basis.layout, request, basis.table, job.coverage_probability, 0, workers, progress));
    }
    for (const std::size_t count : request.angle_counts) {
        studies.push_back(study_layout(engine::with_full_turn(basis.layout, count), request, basis.table,
                                       job.coverage_probability, count, workers, progress));
    }
    require_a_result(studies);

    reports::StudyDocument document;
    document.kind = "simulation";
    document.title = job.title.empty() ? job_name : job.title;
    document.subtitle = std::to_string(request.runs) +
                        " simulated campaigns for each number of angles, with known truth, evaluated by the joint "
                        "adjustment and by the sequential method of the source paper";
    const engine::LengthUncertainty& length = basis.layout.length_uncertainty;
    document.facts = {
        {"Job", job_name},
        {"Campaigns", std::to_string(request.runs)},
        {"Seed", std::to_string(request.seed)},
        {"Axis", std::string(1, "ABC"[engine::axial_coordinate(basis.layout.axis)])},
        {"Angles", angle_list(studies)},
        {"Stations and reflectors", std::to_string(basis.layout.stations.size()) + " and " +
                                        std::to_string(basis.layout.reflectors.size()) +
                                        " (stations from: " + basis.stations_from + ")"},
        {"Assumed set-up", micrometres(request.set_up_offset) + " µm and " + arcseconds(request.set_up_tilt) +
                               "″, both directions across the axis"},
        {"Assumed error motions", "uniform within ±" + micrometres(request.error_linear) + " µm and ±" +
                                      arcseconds(request.error_angular) +
                                      "″, independent at every angle, zero at home"},
        {"Noise of a length, standard uncertainty", micrometres(length.u_constant) + " µm and " +
                                                        micrometres(length.u_proportional) +
                                                        " µm per metre, added in squares"},
        {"Table repeatability, standard deviation",
         micrometres(basis.table.u_linear) + " µm, " + arcseconds(basis.table.u_axial) + "″ axial, " +
             arcseconds(basis.table.u_tilt) + "″ tilt (" + basis.table_from + ")"},
        {"Planted outliers", request.outliers == 0 ? std::string("none")
                                                   : std::to_string(request.outliers) + " of ±" +
                                                         micrometres(request.outlier_size) + " µm in every campaign"},
        {"Coverage probability", percent_text(job.coverage_probability) + " %"}};

    reports::StudySection comparison{
        .heading = "Differences from the assumed values, as the source paper states them",
        .paragraphs = {"Set-up: |calculated - assumed| / assumed. Error motions: |calculated - assumed| divided by the "
                       "amplitude of the assumed ones (" +
                       micrometres(request.error_linear) + " µm, " + arcseconds(request.error_angular) +
                       "″). Mean, root mean square and largest over all campaigns, components and angles. The source "
                       "paper states the largest; it does not state the number of angles."},
        .tables = {},
        .figures = {}};
    for (const bool noisy : {false, true}) {
        const std::string noise = noisy ? "with measurement noise" : "without measurement noise";
        comparison.tables.push_back(difference_table("Set-up, " + noise, studies, noisy, {k_offset_tally, k_tilt_tally},
                                                     {"offset", "tilt"}, {k_paper_offset, k_paper_tilt}, scales));
        comparison.tables.push_back(difference_table("Six error motions, " + noise, studies, noisy,
                                                     {k_linear_tally, k_angular_tally}, {"linear", "angular"},
                                                     {k_paper_linear, k_paper_angular}, scales));
    }
    if (std::any_of(studies.begin(), studies.end(), [](const AngleStudy& study) { return !study.evaluated; })) {
        comparison.paragraphs.push_back(
            "Layouts with more than " + std::to_string(k_most_evaluated_angles) +
            " angles are not adjusted: for them the assumed values are carried to the datum "
            "exactly, which is what an exact measurement gives.");
    }
    document.sections.push_back(std::move(comparison));

    reports::StudySection explanation{.heading = "What the differences are made of",
                                      .paragraphs = conclusion(studies, scales),
                                      .tables = {parts_table(studies, scales)},
                                      .figures = {}};
    if (std::optional<reports::StudyFigure> figure = parts_figure(studies, scales)) {
        explanation.figures.push_back(std::move(*figure));
    }
    document.sections.push_back(std::move(explanation));

    reports::StudySection agreement{
        .heading = "Agreement with the stated uncertainties",
        .paragraphs =
            {"Errors are differences from the truth in the datum of the result. The root mean square of error "
             "divided by standard uncertainty should be near 1, and the share within the expanded "
             "uncertainty near " +
             percent_text(job.coverage_probability) +
             " %. Errors within one campaign are correlated: the limits for independent errors are too "
             "narrow, the scatter between campaigns tells the standard error. The sequential method takes "
             "weights, outliers and coverage factors from the joint adjustment of the same campaign."},
        .tables = {campaign_table(studies)},
        .figures = {}};
    for (const AngleStudy& study : studies) {
        if (study.noisy.evaluated[0] > 0) {
            agreement.tables.push_back(agreement_table(study, 0, basis.layout, job.coverage_probability));
        }
        if (study.noisy.evaluated[1] > 0) {
            agreement.tables.push_back(agreement_table(study, 3, basis.layout, job.coverage_probability));
        }
        if (study.noisy.failure[1]) {
            agreement.paragraphs.push_back(std::to_string(study.angles) +
                                           " angles, sequential method: " + gum::message(*study.noisy.failure[1]));
        }
        if (study.noisy.failure[0]) {
            agreement.paragraphs.push_back(
                std::to_string(study.angles) + " angles: " + std::to_string(request.runs - study.noisy.evaluated[0]) +
                " campaigns have no result; the first: " + gum::message(*study.noisy.failure[0]));
        }
    }
    if (std::optional<reports::StudyFigure> figure = histogram_figure(studies)) {
        agreement.figures.push_back(std::move(*figure));
    }
    document.sections.push_back(std::move(agreement));
    document.data_json = data_json(job_name, job, basis, studies);
    return document;
}

}  // namespace gumcert::app
