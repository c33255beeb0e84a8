#include "reports/view/certificate_evidence_sections.h"

#include "gum/quantity/unit.h"
#include "reports/plots/certificate_plots.h"
#include "reports/plots/rotary_evidence_plots.h"
#include "reports/plots/rotary_plots.h"
#include "reports/plots/svg_plot.h"
#include "reports/printable_text.h"
#include "reports/reported_results.h"
#include "reports/result_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

void add_warnings(Facts& rows, const Wording& words, const EvaluationRecord& record) {
    // Messages may name the file of a budget, and with it a laboratory that must not be named.
    const bool is_confidential =
        record.comparison && record.comparison->form == "laboratories" && !record.comparison->names_released;
    std::vector<const gum::Diagnostic*> first;
    std::map<std::string, std::size_t> counts;
    for (const gum::Diagnostic& d : record.diagnostics) {
        if (d.severity == gum::Severity::warning && ++counts[d.code] == 1) {
            first.push_back(&d);
        }
    }
    for (const gum::Diagnostic* d : first) {
        const std::size_t count = counts.at(d->code);
        const Text times = count > 1 ? " (" + std::to_string(count) + " ×)" : "";
        rows.emplace_back(words("value", "severity", "warning") + " " + printable(d->code),
                          (is_confidential ? words("heading", "messages") : words.sentence(d->what)) + times);
    }
}

namespace {

std::string coordinate_along(const std::string& axis) {
    return axis == "A" ? "x" : axis == "B" ? "y" : "z";
}

/// "linear, along x (axial)" of the error motion of that number.
Text meaning_of_motion(const RotaryTable& r, std::size_t motion, const Wording& words) {
    static constexpr std::array<const char*, 3> k_coordinates = {"x", "y", "z"};
    const std::string along = k_coordinates.at(motion % 3);
    const bool axial = along == coordinate_along(r.axis);
    const char* kind =
        motion < 3 ? (axial ? "linear_along" : "linear_across") : (axial ? "angular_about" : "angular_tilt");
    return words.filled("value", kind, {{"coordinate", along}});
}

std::vector<Text> parameter_row(const TableParameter& p, const std::string& table, const Wording& words) {
    return {p.name, result_meaning(table, p.name, p.description, words), p.stated.printed.value,
            stated_uncertainty(p.stated, words), p.stated.printed.unit};
}

void overview_table(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    Rows rows;
    for (const RangeRow& range : r.ranges) {
        const auto at = std::find(r.error_names.begin(), r.error_names.end(), range.name);
        const auto motion = static_cast<std::size_t>(at - r.error_names.begin());
        if (motion < r.error_names.size()) {
            rows.push_back({range.name, words("label", "range") + ", " + meaning_of_motion(r, motion, words),
                            range.stated.printed.value, stated_uncertainty(range.stated, words),
                            range.stated.printed.unit});
        }
    }
    if (r.iso230_2) {
        for (const char* name : {"A", "R", "E"}) {
            for (const TableParameter& p : r.iso230_2->parameters) {
                if (p.name == name) {
                    rows.push_back(parameter_row(p, "positioning", words));
                }
            }
        }
    }
    for (const TableParameter& p : r.location_errors) {
        rows.push_back(parameter_row(p, "location_errors", words));
    }
    // Where the axis is in the machine is known, where it is in the fixture is for the annex.
    for (const TableParameter& p : r.location_errors.empty() ? r.axis_line : std::vector<TableParameter>()) {
        rows.push_back(parameter_row(p, "axis_line", words));
    }
    if (!rows.empty()) {
        builder.table("overview", words("sentence", "overview_table"),
                      {{words("label", "name"), ""},
                       {words("label", "meaning"), ""},
                       {words("label", "value"), "", true},
                       {words("label", "U"), "", true},
                       {words("label", "unit"), ""}},
                      rows);
    }
}

/// What the global test says: residuals that are beyond what 19 of 20 adjustments have are a doubt, and no refutation, until
/// they are beyond what chance explains (refuted_by_residuals). Where the weights come from the same residuals, nothing is
/// tested.
const char* sentence_of_test(const RotaryTable& r) {
    const AdjustmentSummary& a = r.adjustment;
    const bool is_estimated = std::any_of(r.variance_components.begin(), r.variance_components.end(),
                                          [](const VarianceComponent& c) { return c.used && c.estimated; });
    if (a.global_test.accepted) {
        return is_estimated ? "global_test_by_construction" : "global_test_passed";
    }
    if (a.chi_square.number < a.global_test.lower.number) {
        return "global_test_smaller";
    }
    return a.p_value.number < k_refuting_probability ? "global_test_failed" : "global_test_larger";
}

/// What the tests of the evaluation say, one line each.
void verdicts(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const RotaryTable& r = *record.rotary;
    Facts facts;
    if (!r.adjustment.global_test.lower.text.empty()) {
        facts.emplace_back(words("label", "global_test"),
                           words.fill(sentence_of_test(r), {{"p", words.number(r.adjustment.p_value.text)}}));
    }
    if (r.group_tests) {
        const auto suspicious = std::count_if(r.group_tests->kinds.begin(), r.group_tests->kinds.end(),
                                              [](const GroupTestRow& kind) { return kind.suspicious; });
        facts.emplace_back(
            words("label", "group_tests"),
            words.fill(suspicious == 0 ? "no_group_suspicious" : "groups_suspicious",
                       {{"count", std::to_string(suspicious)}, {"all", std::to_string(r.group_tests->kinds.size())}}));
    }
    if (!r.reliability.empty()) {
        const auto removed = std::count_if(r.reliability.begin(), r.reliability.end(),
                                           [](const ReliabilityRow& row) { return row.removed; });
        facts.emplace_back(words("label", "left_out"),
                           words.fill("left_out", {{"count", std::to_string(removed)},
                                                   {"all", std::to_string(r.reliability.size())}}));
    }
    if (r.monte_carlo) {
        facts.emplace_back(words("label", "monte_carlo"),
                           words.fill("monte_carlo_verdict", {{"validated", std::to_string(r.monte_carlo->validated)},
                                                              {"all", std::to_string(r.monte_carlo->compared)}}));
    }
    add_warnings(facts, words, record);
    if (!facts.empty()) {
        builder.definitions(facts);
    }
}

/// Where the largest test value of a kind was found: "station P1, pass P1-1, 20°", "reflector R3".
Text subject_of(const GroupTestRow& row, const Wording& words) {
    if (!row.reflector.empty() && row.to_angle_deg) {
        return words.fill("reflector_at_angles", {{"reflector", row.reflector},
                                                  {"from", words.number(row.angle_deg.text)},
                                                  {"to", words.number(plain(*row.to_angle_deg))}});
    }
    if (!row.reflector.empty() && !row.pass.empty()) {
        return words.fill("reflector_from_visit", {{"reflector", row.reflector},
                                                   {"station", row.station},
                                                   {"pass", row.pass},
                                                   {"angle", words.number(row.angle_deg.text)}});
    }
    if (!row.reflector.empty()) {
        return row.station.empty() ? words("label", "reflector") + " " + row.reflector
                                   : words.fill("one_pair", {{"station", row.station}, {"reflector", row.reflector}});
    }
    if (row.station.empty()) {
        return words("value", "all_stations");
    }
    if (row.pass.empty()) {
        return words("label", "station") + " " + row.station;
    }
    if (row.angle_deg.text.empty()) {
        return words.fill("one_pass", {{"station", row.station}, {"pass", row.pass}});
    }
    return words.fill("one_visit",
                      {{"station", row.station}, {"pass", row.pass}, {"angle", words.number(row.angle_deg.text)}});
}

void group_table(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    Rows rows;
    for (const GroupTestRow& row : r.group_tests->kinds) {
        const Text unit = row.unit == "um" ? " µm" : row.unit == "ppm" ? " · 10⁻⁶" : "";
        const auto with_unit = [&](const std::string& printed) {
            return printed.empty() ? Text() : words.number(printed) + unit;
        };
        rows.push_back({words("value", "group_kind", row.kind), std::to_string(row.tests), subject_of(row, words),
                        row.test_value.text, row.critical_value.text,
                        row.estimate.number ? with_unit(row.estimate.text) : words("value", "size_not_determined"),
                        with_unit(row.minimal_detectable.text),
                        words("value", row.suspicious ? "suspicious" : "not_suspicious")});
    }
    builder.table("group-tests",
                  words.fill("group_tests_table", {{"alpha", words.number(plain(r.group_tests->alpha))}}),
                  {{words("label", "tested_group"), ""},
                   {words("label", "tests"), "", true},
                   {words("label", "largest_at"), ""},
                   {"χ²", "", true},
                   {words("label", "limit"), "", true},
                   {words("label", "size"), ""},
                   {words("label", "smallest_found"), ""},
                   {words("label", "group_verdict"), ""}},
                  rows);
}

void reversal_table(CertificateBuilder& builder, const Wording& words, const ReversalModel& model) {
    Rows rows;
    for (const ReversalTestRow& row : model.tests) {
        rows.push_back({row.name, words.number(row.spread.text), gum::unit_for_people(row.unit), row.test_value.text,
                        row.p_value.text, words("value", row.depends_on_angle ? "depends_on_angle" : "not_refuted")});
    }
    builder.table("reversal-tests", words.fill("reversal_tests_table", {{"alpha", words.number(plain(model.alpha))}}),
                  {{words("label", "reversal"), ""},
                   {words("label", "spread_of_angles"), "", true},
                   {words("label", "unit"), ""},
                   {"F", "", true},
                   {"p", "", true},
                   {words("label", "group_verdict"), ""}},
                  rows);
}

void harmonics_table(CertificateBuilder& builder, const Wording& words, const RotaryTable& r, std::size_t first) {
    std::vector<Column> columns = {{words("label", "harmonic_order"), "", true}};
    std::vector<std::pair<Text, std::size_t>> groups = {{"", 1}};
    Rows rows;
    for (const HarmonicOrder& order : r.harmonics[first].orders) {
        rows.push_back({std::to_string(order.order)});
    }
    rows.push_back({words("label", "rest")});
    std::vector<RowKind> kinds(rows.size(), RowKind::plain);
    kinds.back() = RowKind::closing;
    for (std::size_t m = first; m < first + 3; ++m) {
        const HarmonicRow& motion = r.harmonics[m];
        const std::string unit = gum::unit_for_people(motion.unit);
        groups.emplace_back(motion.name, 3);
        columns.push_back({words("label", "amplitude"), unit, true});
        columns.push_back({words("label", "U"), unit, true});
        columns.push_back({"φ", "°", true});
        for (std::size_t k = 0; k < motion.orders.size(); ++k) {
            const HarmonicOrder& order = motion.orders[k];
            rows[k].insert(rows[k].end(), {order.amplitude.text, order.U.text, order.phase_deg.text});
        }
        rows.back().insert(rows.back().end(), {motion.rms_rest.text, Text(), Text()});
    }
    builder.table(first == 0 ? "harmonics-linear" : "harmonics-angular",
                  words("sentence", first == 0 ? "harmonics_linear" : "harmonics_angular"), columns, rows, groups,
                  kinds);
}

void environment_table(CertificateBuilder& builder, const Wording& words, const Environment& e) {
    Rows rows;
    for (const StationEnvironment& s : e.stations) {
        rows.push_back({std::to_string(rows.size() + 1), s.station, s.fixture_degC.text, s.u_fixture_K.text,
                        s.expansion_um.text, s.air_degC.text, s.pressure_hPa.text, s.humidity_percent.text});
    }
    std::vector<Column> columns = {{words("label", "order"), "", true},
                                   {words("label", "station"), ""},
                                   {words("label", "fixture_temperature"), "°C", true},
                                   {words("label", "u"), "K", true},
                                   {words("label", "expansion"), "µm", true},
                                   {words("label", "air_temperature"), "°C", true},
                                   {words("label", "pressure"), "hPa", true},
                                   {words("label", "humidity"), "%", true}};
    for (std::size_t c = columns.size(); c-- > 5;) {  // what no station has is not printed
        if (std::all_of(rows.begin(), rows.end(), [c](const auto& row) { return row[c].empty(); })) {
            columns.erase(columns.begin() + static_cast<std::ptrdiff_t>(c));
            for (auto& row : rows) {
                row.erase(row.begin() + static_cast<std::ptrdiff_t>(c));
            }
        }
    }
    builder.table("environment", words("sentence", "environment_table"), columns, rows);
}

}  // namespace

void overview(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const RotaryTable& r = *record.rotary;
    builder.section("overview");
    overview_table(builder, words, r);
    verdicts(builder, words, record);
    const Plot plot = error_motion_plot(r, words);
    builder.figure(plot.id, words("sentence", r.sense_curves.empty() ? "figure_errors" : "figure_errors_by_sense"),
                   plot.description, svg(plot));
}

void positioning_figure(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    const auto has_runs = [](const PositioningTarget& t) { return !t.runs_up.empty() || !t.runs_down.empty(); };
    if (r.iso230_2 && std::any_of(r.iso230_2->targets.begin(), r.iso230_2->targets.end(), has_runs)) {
        const Plot plot = positioning_plot(r, words);
        builder.figure(plot.id, words("sentence", "figure_positioning"), plot.description, svg(plot));
    }
}

void harmonics(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (r.harmonics.size() != 6) {
        return;
    }
    builder.section("harmonics");
    const PolarPlot plot = error_polar_plot(r, words);
    builder.figure(plot.id, words("sentence", "figure_polar"), plot.description, svg(plot));
    builder.paragraph(words("sentence", "harmonics"));
    harmonics_table(builder, words, r, 0);
    harmonics_table(builder, words, r, 3);
}

void group_tests(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (!r.group_tests) {
        return;
    }
    builder.section("group_tests");
    builder.paragraph(words("sentence", "group_tests"));
    group_table(builder, words, r);
    if (r.reversal_model && !r.reversal_model->tests.empty()) {
        reversal_table(builder, words, *r.reversal_model);
    }
    if (std::any_of(r.visits.begin(), r.visits.end(), [](const VisitRow& v) { return v.deviation_um.has_value(); })) {
        const Plot plot = visit_plot(r, words);
        builder.figure(plot.id, words("sentence", "figure_visits"), plot.description, svg(plot));
    }
    if (std::any_of(r.visits.begin(), r.visits.end(), [](const VisitRow& v) { return v.axial_arcsec.has_value(); })) {
        const Plot plot = visit_scatter_plot(r, words);
        Text caption = words("sentence", "figure_visit_scatter");
        if (r.stations.size() > k_most_residual_panels) {
            caption += " " + words.fill("first_stations", {{"shown", std::to_string(k_most_residual_panels)},
                                                           {"count", std::to_string(r.stations.size())}});
        }
        builder.figure(plot.id, caption, plot.description, svg(plot));
    }
}

void environment(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (!r.environment) {
        return;
    }
    const Environment& e = *r.environment;
    builder.section("environment");
    builder.paragraph(words.fill("environment", {{"lowest", words.number(e.printed_lowest)},
                                                 {"highest", words.number(e.printed_highest)},
                                                 {"reference", words.number(e.reference_degC.text)},
                                                 {"distance", words.number(e.largest_distance_mm.text)},
                                                 {"least", words.number(e.printed_least_expansion)},
                                                 {"most", words.number(e.printed_most_expansion)},
                                                 {"expansion", words.number(e.expansion_per_K.text)},
                                                 {"u", words.number(e.u_expansion_per_K.text)},
                                                 {"share", words.number(e.largest_share.text)}}));
    environment_table(builder, words, e);
    const Plot plot = temperature_plot(e, words);
    builder.figure(plot.id, words("sentence", "figure_temperatures"), plot.description, svg(plot));
}

void distances_as_read(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    Rows rows;
    for (const ReliabilityRow& row : r.reliability) {
        if (!row.printed_length.empty()) {
            rows.push_back({row.station, row.reflector, row.pass, plain(row.angle_deg), row.printed_length,
                            words("value", row.removed ? "removed" : "kept")});
        }
    }
    if (rows.empty()) {
        return;
    }
    builder.section("distances");
    builder.table("distances", words("sentence", "distances"),
                  {{words("label", "station"), ""},
                   {words("label", "reflector"), ""},
                   {words("label", "pass"), ""},
                   {words("label", "angle"), "°", true},
                   {words("label", "distance"), "mm", true},
                   {words("label", "action"), ""}},
                  rows);
}

}  // namespace gumcert::reports
