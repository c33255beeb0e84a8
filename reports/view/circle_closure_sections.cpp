#include "reports/view/circle_closure_sections.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "reports/plots/svg_plot.h"
#include "reports/reported_results.h"
#include "reports/view/certificate_view.h"

namespace gumcert::reports {

namespace {

constexpr std::size_t k_most_series = 80;

/// "0.31 ″"
std::string with_unit(const std::string& number, const CircleClosure& c) {
    return number + "\u00A0" + c.printed_unit;
}

void design(CertificateBuilder& builder, const Wording& words, const CircleClosure& c) {
    builder.paragraph(words.fill("circle_closure", {{"table", c.table}, {"artefact", c.artefact}}));
    builder.paragraph(words("sentence", c.full ? "circle_closure_full" : "circle_closure_partial"));
    std::vector<std::pair<Text, Text>> rows;
    if (!c.artefact_description.empty()) {
        rows.emplace_back(words("label", "closure_artefact"), c.artefact_description);
    }
    rows.emplace_back(words("label", "closure_steps"), plain(c.steps));
    rows.emplace_back(words("label", "closure_positions"), plain(c.positions));
    rows.emplace_back(words("label", "closure_readings"), plain(c.readings));
    rows.emplace_back(words("label", "closure_unknowns"), plain(c.unknowns));
    rows.emplace_back(words("label", "degrees_of_freedom"), plain(static_cast<std::int64_t>(c.degrees_of_freedom)));
    rows.emplace_back(words("label", "closure_numbering"), words("value", "closure_numbering", c.numbering));
    rows.emplace_back(words("label", "closure_drift"), words("value", "closure_drift", c.drift));
    rows.emplace_back(words("label", "residual_standard_deviation"),
                      words.number(with_unit(c.residual_standard_deviation.text, c)));
    rows.emplace_back(words("label", "closure_u_reading"), words.number(with_unit(c.u_reading.text, c)));
    rows.emplace_back(words("label", "closure_u_from"), words("value", "closure_u_from", c.u_reading_from));
    builder.definitions(rows);
}

void tests(CertificateBuilder& builder, const Wording& words, const CircleClosure& c) {
    Rows rows;
    for (const ClosureTestRow& test : c.tests) {
        rows.push_back({words("value", "closure_test", test.name), test.statistic.text, test.nu.text,
                        test.nu_reference.number ? Text(test.nu_reference.text) : words("document", "infinite"),
                        test.p_value.text, words("value", "closure_outcome", test.accepted ? "accepted" : "rejected")});
    }
    if (rows.empty()) {
        return;
    }
    builder.table("closure-tests", words("sentence", "circle_closure_tests"),
                  {{words("label", "closure_test"), ""},
                   {words("label", "F"), "", true},
                   {"ν\u2081", "", true},
                   {"ν\u2082", "", true},
                   {words("label", "p_value_short"), "", true},
                   {words("label", "closure_outcome"), ""}},
                  rows);
}

void series(CertificateBuilder& builder, const Wording& words, const CircleClosure& c) {
    const auto any = [&](const auto& of) { return std::any_of(c.series.begin(), c.series.end(), of); };
    const bool repeated = any([](const ClosureSeriesRow& s) { return !s.repetition.empty(); });
    const bool drifts = any([](const ClosureSeriesRow& s) { return s.drift.number.has_value(); });
    const bool closes = any([](const ClosureSeriesRow& s) { return s.misclosure.number.has_value(); });
    const std::string& unit = c.printed_unit;
    std::vector<Column> columns = {{words("label", "closure_position"), ""}};
    if (repeated) {
        columns.push_back({words("label", "closure_repetition"), ""});
    }
    columns.push_back({words("label", "closure_readings"), "", true});
    columns.push_back({words("label", "closure_zero"), unit, true});
    if (drifts) {
        columns.push_back({words("label", "closure_drift_of_series"), unit, true});
    }
    if (closes) {
        columns.push_back({words("label", "closure_misclosure"), unit, true});
    }
    columns.push_back({words("label", "closure_rms"), unit, true});
    Rows rows;
    for (std::size_t i = 0; i < std::min(c.series.size(), k_most_series); ++i) {
        const ClosureSeriesRow& s = c.series[i];
        std::vector<Text> row = {plain(s.position)};
        if (repeated) {
            row.emplace_back(s.repetition);
        }
        row.emplace_back(plain(s.readings));
        row.emplace_back(s.zero.text);
        if (drifts) {
            row.emplace_back(s.drift.text);
        }
        if (closes) {
            row.emplace_back(s.misclosure.text);
        }
        row.emplace_back(s.residual_rms.text);
        rows.push_back(std::move(row));
    }
    builder.table("closure-series", words("sentence", "circle_closure_series"), columns, rows);
    if (c.series.size() > k_most_series) {
        builder.paragraph(words.fill("more_in_record", {{"count", std::to_string(c.series.size() - k_most_series)}}));
    }
}

/// Deviations of both circles with their U, as printed results.
void deviations(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const CircleClosure& c = *record.circle_closure;
    Plot plot{.id = "plot-closure",
              .title = words("plot", "closure_title").first(),
              .description = words("plot", "closure_description").first(),
              .x_label = words("plot", "closure_angle_axis").first(),
              .panels = {},
              .columns = 1,
              .panel_height = 140.0};
    for (const auto& [name, angles] :
         {std::pair(c.table, &c.step_angles_deg), std::pair(c.artefact, &c.side_angles_deg)}) {
        PlotSeries drawn{.label = "", .points = {}, .marker = PlotMarker::disc, .bars = PlotBars::bars, .joined = true};
        for (const Result& result : record.results) {
            if (result.quantity == name && !result.point.empty() && drawn.points.size() < angles->size()) {
                drawn.points.push_back({.x = (*angles)[drawn.points.size()],
                                        .y = result.reported.value,
                                        .U = result.reported.U.value_or(0.0)});
            }
        }
        plot.panels.push_back(
            {.heading = name, .y_label = name + " / " + c.printed_unit, .series = {std::move(drawn)}, .limits = {}});
    }
    builder.figure(plot.id, words.fill("figure_closure", {{"table", c.table}, {"artefact", c.artefact}}),
                   plot.description, svg(plot));
}

/// All residuals over the steps of the table.
void residuals(CertificateBuilder& builder, const Wording& words, const CircleClosure& c) {
    Plot plot{.id = "plot-closure-residuals",
              .title = words("plot", "closure_residuals_title").first(),
              .description = words("plot", "closure_residuals_description").first(),
              .x_label = words("plot", "closure_step_axis").first(),
              .panels = {},
              .columns = 1,
              .panel_height = 130.0,
              .x_is_angle = false,
              .x_is_number = true};
    PlotSeries drawn{.label = "", .points = {}, .marker = PlotMarker::disc, .bars = PlotBars::none};
    for (const ClosureResidualRow& row : c.residuals) {
        drawn.points.push_back({.x = static_cast<double>(row.step), .y = row.residual.number, .U = 0.0});
    }
    plot.panels.push_back({.heading = "",
                           .y_label = words("label", "residual").first() + " / " + c.printed_unit,
                           .series = {std::move(drawn)},
                           .limits = {}});
    builder.figure(plot.id, words("sentence", "figure_closure_residuals"), plot.description, svg(plot));
}

}  // namespace

void circle_closure_section(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    if (!record.circle_closure) {
        return;
    }
    const CircleClosure& c = *record.circle_closure;
    builder.section("circle_closure");
    design(builder, words, c);
    tests(builder, words, c);
    if (!record.certificate) {
        deviations(builder, words, record);
    }
    residuals(builder, words, c);
    series(builder, words, c);
}

}  // namespace gumcert::reports
