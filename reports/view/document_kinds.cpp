#include "reports/view/document_kinds.h"

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "reports/plots/certificate_plots.h"
#include "reports/plots/svg_plot.h"
#include "reports/printable_text.h"
#include "reports/record/record_kinds.h"
#include "reports/record/record_sections.h"
#include "reports/reported_results.h"
#include "reports/view/certificate_budget_sections.h"
#include "reports/view/certificate_builder.h"
#include "reports/view/certificate_evidence_sections.h"
#include "reports/view/certificate_identity_sections.h"
#include "reports/view/certificate_rotary_sections.h"
#include "reports/view/certificate_view.h"
#include "reports/view/circle_closure_sections.h"
#include "reports/view/comparison_sections.h"
#include "reports/wording.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using nlohmann::json;

std::string coordinate_of(const std::string& axis) {
    return axis == "A" ? "x" : axis == "B" ? "y" : "z";
}

void figure(CertificateBuilder& builder, const Text& caption, const Plot& plot) {
    builder.figure(plot.id, caption, plot.description, svg(plot));
}

/// \param own  facts of this kind of record
void identification(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record,
                    const Facts& own = {}) {
    builder.section(record.certificate ? "evaluation" : "identification");
    Facts rows = {{words("label", "title"), words.localised(title_of(record))},
                  {words("label", "kind"), words("value", "kind", record.kind)}};
    rows.insert(rows.end(), own.begin(), own.end());
    rows.emplace_back(words("label", "coverage"), words.number(record.coverage_probability.text));
    rows.emplace_back(words("label", "software"), record.software.name + " " + record.software.version);
    rows.emplace_back(words("label", "commit"), record.software.commit);
    if (!record.rotary) {  // there, they stand with the tests, on the page before
        add_warnings(rows, words, record);
    }
    builder.definitions(rows);
}

void rotary_identification(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const RotaryTable& r = *record.rotary;
    identification(builder, words, record,
                   {{words("label", "axis"), r.axis},
                    {words("label", "angles"), std::to_string(r.errors.size())},
                    {words("label", "home"), words.number(plain(r.home_angle_deg)) + "°"},
                    {words("label", "datum"), words("value", "datum", r.datum)},
                    {words("label", "method"), words("value", "method", r.method)}});
}

void conventions(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    const std::string coordinate = coordinate_of(r.axis);
    builder.section("conventions");
    builder.paragraph(words("sentence", "datum_" + r.datum));
    builder.paragraph(words.fill("frames", {{"letter", r.axis}, {"coordinate", coordinate}}));
    builder.formula(words.fill("formula_pose", {{"coordinate", coordinate}}));
    builder.formula(words("sentence", "formula_errors"));
    builder.formula(words("sentence", "formula_set_up"));
    builder.formula(words("sentence", "formula_length"));
    builder.paragraph(words("sentence", "signs"));
    static constexpr std::array<const char*, 6> k_symbols = {"d_x", "d_y", "d_z", "e_a", "e_b", "e_c"};
    static constexpr std::array<const char*, 3> k_coordinates = {"x", "y", "z"};
    Facts rows;
    for (std::size_t i = 0; i < 6; ++i) {
        const std::string along = k_coordinates[i % 3];
        const bool axial = along == coordinate;
        const char* kind =
            i < 3 ? (axial ? "linear_along" : "linear_across") : (axial ? "angular_about" : "angular_tilt");
        rows.emplace_back(r.error_names[i],
                          k_symbols[i] + (": " + words.filled("value", kind, {{"coordinate", along}})));
    }
    builder.paragraph(words("sentence", "error_names"));
    builder.definitions(rows);
}

/// U and k of the set-up along a coordinate, "O_y". Those of Monte Carlo where its result is reported; an interval is
/// that of the fixture seen from the table.
std::pair<Text, Text> uncertainty_of_set_up(const EvaluationRecord& record, const std::string& name,
                                            const Printed& printed, const Wording& words) {
    for (const Result& result : record.results) {
        if (result.name == name && result.reported.method == "monte_carlo") {
            return {stated_uncertainty(result.reported, words),
                    result.reported.k ? certificate::printed_coverage_factor(*result.reported.k) : ""};
        }
    }
    return {printed.U, certificate::printed_coverage_factor(record.rotary->set_up.k)};
}

void set_up(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const RotaryTable& r = *record.rotary;
    builder.section("set_up");
    builder.paragraph(words("sentence", "set_up_signs"));
    static constexpr std::array<const char*, 3> k_coordinates = {"x", "y", "z"};
    Rows rows;
    for (const bool linear : {true, false}) {
        const auto& fixture = linear ? r.set_up.printed_O : r.set_up.printed_S;
        const auto& axis = linear ? r.axis_in_fixture.printed_O : r.axis_in_fixture.printed_S;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string name = std::string(linear ? "O_" : "S_") + k_coordinates[i];
            const auto [U, k] = uncertainty_of_set_up(record, name, fixture[i], words);
            rows.push_back({name, fixture[i].value, axis[i].value, U, fixture[i].unit, k});
        }
    }
    builder.table("set-up", words("heading", "set_up") + ".",
                  {{words("label", "quantity"), ""},
                   {words("label", "set_up"), "", true},
                   {words("label", "axis_in_fixture"), "", true},
                   {words("label", "U"), "", true},
                   {words("label", "unit"), ""},
                   {words("label", "k"), "", true}},
                  rows);
}

/// Why no reversal is stated. Stations that were measured in one sense beside others in both have none either, nor has the
/// sequential method, whose records list no visits.
const char* no_reversal(const RotaryTable& r) {
    const bool one_sense = !r.visits.empty() && std::ranges::all_of(r.visits, [&](const auto& visit) {
        return visit.direction == r.visits.front().direction;
    });
    return one_sense ? "no_reversal" : "no_reversal_of_all";
}

void ranges(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    builder.paragraph(words("sentence", "ranges"));
    const bool by_angle = r.reversal_model && r.reversal_model->model == "by_angle";
    builder.paragraph(words("sentence", r.reversal.empty() ? no_reversal(r)
                                        : by_angle         ? "reversal_by_angle"
                                                           : "reversal"));
    Rows rows;
    for (std::size_t i = 0; i < 6; ++i) {
        std::vector<Text> row = {r.error_names[i], "", "", "", "", gum::unit_for_people(r.error_units[i])};
        for (const RangeRow& range : r.ranges) {
            if (range.name == r.error_names[i]) {
                row[1] = range.stated.printed.value;
                row[2] = stated_uncertainty(range.stated, words);
            }
        }
        for (const Reversal& reversal : r.reversal) {
            if (reversal.name == r.error_names[i]) {
                row[3] = reversal.stated.printed.value;
                row[4] = stated_uncertainty(reversal.stated, words);
            }
        }
        rows.push_back(std::move(row));
    }
    builder.table("ranges", words("label", "range") + ", " + words("label", "reversal") + ".",
                  {{words("label", "quantity"), ""},
                   {words("label", "range"), "", true},
                   {words("label", "U"), "", true},
                   {words("label", "reversal"), "", true},
                   {words("label", "U"), "", true},
                   {words("label", "unit"), ""}},
                  rows);
}

/// Curves of the error motions, of a certificate whose tables and figures show what is certified.
void error_motion_curves(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (!r.sense_curves.empty()) {
        builder.section("error_motions");
        figure(builder, words("sentence", "figure_errors_by_sense"), error_motion_plot(r, words));
    }
}

/// Which of many angles a table lists: at equal steps, and those where an error motion is extreme.
std::vector<bool> listed_angles(const RotaryTable& r) {
    constexpr std::size_t k_most_angles = 120;  // three pages
    constexpr std::size_t k_about = 72;         // five degrees of a full turn
    std::vector<bool> listed(r.errors.size(), r.errors.size() <= k_most_angles);
    if (r.errors.size() <= k_most_angles) {
        return listed;
    }
    const std::size_t step = (r.errors.size() + k_about - 1) / k_about;
    for (std::size_t i = 0; i < r.errors.size(); i += step) {
        listed[i] = true;
    }
    for (std::size_t m = 0; m < 6; ++m) {
        const auto less = [m](const ErrorsAtAngle& a, const ErrorsAtAngle& b) {
            return a.errors[m].value < b.errors[m].value;
        };
        const auto [low, high] = std::minmax_element(r.errors.begin(), r.errors.end(), less);
        listed[static_cast<std::size_t>(low - r.errors.begin())] = true;
        listed[static_cast<std::size_t>(high - r.errors.begin())] = true;
    }
    return listed;
}

void error_motions(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    builder.section("error_motions");
    ranges(builder, words, r);
    std::vector<Column> columns = {{words("label", "angle"), "°", true}};
    std::vector<std::pair<Text, std::size_t>> groups = {{"", 1}};
    for (std::size_t i = 0; i < 6; ++i) {
        const std::string unit = gum::unit_for_people(r.error_units[i]);
        columns.push_back({words("label", "value"), unit, true});
        columns.push_back({words("label", "U"), unit, true});
        groups.emplace_back(r.error_names[i], 2);
    }
    Rows rows;
    const std::vector<bool> listed = listed_angles(r);
    for (std::size_t i = 0; i < r.errors.size(); ++i) {
        if (!listed[i]) {
            continue;
        }
        const ErrorsAtAngle& at = r.errors[i];
        std::vector<Text> row = {at.angle_deg.text};
        for (const StatedValue& e : at.errors) {
            row.push_back(e.printed.value);
            row.push_back(stated_uncertainty(e, words));
        }
        rows.push_back(std::move(row));
    }
    const bool thinned = rows.size() < r.errors.size();
    const Text caption = !thinned ? words("sentence", "table_errors")
                                  : words("sentence", "table_errors") + " " +
                                        words.fill("thinned_angles", {{"listed", std::to_string(rows.size())},
                                                                      {"all", std::to_string(r.errors.size())}});
    builder.table("errors", caption, columns, rows, groups);
}

/// Least and greatest coverage factor and effective degrees of freedom of everything that is reported.
struct CoverageWords {
    double k_low = 0.0, k_high = 0.0;
    std::optional<double> nu_low, nu_high;  ///< none = infinite
    bool any = false;

    void add(double k, const std::optional<double>& nu) {
        const auto less = [](const std::optional<double>& a, const std::optional<double>& b) {
            return a && (!b || *a < *b);
        };
        if (!any) {
            k_low = k_high = k;
            nu_low = nu_high = nu;
        }
        any = true;
        k_low = std::min(k_low, k);
        k_high = std::max(k_high, k);
        nu_low = less(nu, nu_low) ? nu : nu_low;
        nu_high = less(nu_high, nu) ? nu : nu_high;
    }
};

/// What U means, for a record without certificate data; with them closing_sections() says it.
void uncertainty_statement(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    CoverageWords coverage;
    if (record.rotary) {
        for (const ErrorsAtAngle& at : record.rotary->errors) {
            for (const StatedValue& e : at.errors) {
                if (!e.printed.U.empty() && (!e.reported || e.reported->method != "monte_carlo")) {
                    coverage.add(e.k, e.nu_eff);
                }
            }
        }
    }
    for (const Result& r : record.results) {
        if (r.k && r.reported.method != "monte_carlo") {
            coverage.add(*r.k, r.nu_eff);
        }
    }
    if (coverage.any) {
        const std::string low = certificate::printed_coverage_factor(coverage.k_low);
        const std::string high = certificate::printed_coverage_factor(coverage.k_high);
        const Text nu_low = degrees_of_freedom(coverage.nu_low, words);
        const Text nu_high = degrees_of_freedom(coverage.nu_high, words);
        const Text k = low == high
                           ? words.fill("k_one", {{"k", words.number(low)}})
                           : words.fill("k_between", {{"low", words.number(low)}, {"high", words.number(high)}});
        const std::string least = certificate::printed_degrees_of_freedom(coverage.nu_low);
        const Text nu_eff = nu_low == nu_high || least.starts_with('>')
                                ? stated_degrees_of_freedom(least, words)
                                : words.fill("nu_between", {{"low", nu_low}, {"high", nu_high}});
        const Text reason = coverage.nu_low ? words.fill("student", {{"nu_eff", nu_eff}}) : words("sentence", "normal");
        builder.paragraph(
            words.fill("uncertainty",
                       {{"k", k}, {"reason", reason}, {"coverage", words.number(record.coverage_probability.text)}}));
    }
    for (const Text& sentence : reasons_for_monte_carlo(record, words)) {
        builder.paragraph(sentence);
    }
    builder.paragraph(words("sentence", "validity"));
}

void uncertainty(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    builder.section("uncertainty");
    if (!record.certificate) {
        uncertainty_statement(builder, words, record);
    }
    if (record.rotary) {
        budget_by_source(builder, words, *record.rotary);
    }
    for (std::size_t i = 0; i < record.results.size(); ++i) {
        if (!record.results[i].budget.empty()) {
            budget_table(builder, words, "budget-" + std::to_string(i),
                         words.fill("budget_result", {{"name", record.results[i].name}}), record.results[i].budget,
                         gum::unit_for_people(record.results[i].unit));
        }
    }
    if (record.rotary && record.rotary->covariance_file) {
        builder.paragraph(words.fill("covariance", {{"file", *record.rotary->covariance_file}}));
    }
}

// ---- a rotary table -----------------------------------------------------------------------------------------------

/// First what a machine builder looks for, then how it was found.
void rotary_specimen(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const RotaryTable& r = *record.rotary;
    overview(builder, words, record);
    error_motions(builder, words, r);
    location_errors(builder, words, r);
    positioning(builder, words, r);
    harmonics(builder, words, r);
    rotary_identification(builder, words, record);
    conventions(builder, words, r);
    set_up(builder, words, record);
    axis_line(builder, words, r);
    uncertainty(builder, words, record);
}

void rotary_conventions(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    conventions(builder, words, *record.rotary);
}

void rotary_evaluation(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    rotary_identification(builder, words, record);
    error_motion_curves(builder, words, *record.rotary);
    positioning_targets(builder, words, *record.rotary);
    harmonics(builder, words, *record.rotary);
    uncertainty(builder, words, record);
}

void rotary_summary(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    rotary_identification(builder, words, record);
    if (!record.rotary->budget_summary.empty()) {
        builder.section("uncertainty");
        budget_by_source(builder, words, *record.rotary);
    }
}

void rotary_evidence(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const RotaryTable& r = *record.rotary;
    fixture(builder, words, r);
    rotary_monte_carlo(builder, words, record);
    environment(builder, words, r);
    adjustment(builder, words, r);
    group_tests(builder, words, r);
    reliability(builder, words, r);
    geometry(builder, words, r);
    if (record.comparison) {
        reference_comparison_section(builder, words, *record.comparison);
    }
}

void rotary_values(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    builder.annexes(record.certificate && record.certificate->symbol);
    if (record.comparison) {
        reference_comparison_points(builder, words, *record.comparison);
    }
    distances_as_read(builder, words, *record.rotary);
}

// ---- a comparison -------------------------------------------------------------------------------------------------

void comparison_report(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    comparison_report_sections(builder, words, record);
    identification(builder, words, record);
}

/// Head and foot of the pages of a comparison report.
json comparison_running_texts(const Wording& words, const EvaluationRecord& record) {
    const ComparisonIssuer issuer = record.comparison->issuer.value_or(ComparisonIssuer{});
    const Text type = words("document", "comparison_type");
    const Text head = issuer.number.empty() ? type
                                            : words.filled("certificate", "certificate_of_head",
                                                           {{"type", type}, {"number", issuer.number}});
    const Text laboratory = words.localised(issuer.laboratory);
    const std::string name = laboratory.empty() ? record.comparison->organiser : laboratory.first();
    const std::string title = shortened(printable(words.localised(title_of(record)).first()), 80);
    return {{"header_left", name.empty() ? title : shortened(printable(name), 80)},
            {"header_right", printable(head.first()) + superseded_in_head(words, record)},
            {"footer_left", "gumcert-comparison-1 · " + record.software.name + " " + record.software.version}};
}

bool holds_rotary_table(const EvaluationRecord& record) {
    return record.rotary.has_value();
}

bool holds_comparison(const EvaluationRecord& record) {
    return record.comparison.has_value();
}

// The first row needs nothing but results.
constexpr std::array<DocumentKind, 4> k_kinds{{
    {.word = k_budget_kind},
    {.word = k_rotary_table_kind,
     .holds = holds_rotary_table,
     .specimen = rotary_specimen,
     .conventions = rotary_conventions,
     .evaluation = rotary_evaluation,
     .summary = rotary_summary,
     .evidence = rotary_evidence,
     .measured_values = rotary_values},
    {.word = k_circle_closure_kind, .evidence = circle_closure_section},
    {.word = k_comparison_kind,
     .holds = holds_comparison,
     .report = "comparison_",
     .running_texts = comparison_running_texts,
     .specimen = comparison_report},
}};

}  // namespace

void specimen_of_results(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    identification(builder, words, record);
    if (record.results.empty()) {
        uncertainty(builder, words, record);
        return;
    }
    budget_results(builder, words, record);
    budget_sections(builder, words, record);
}

void evaluation_of_results(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    identification(builder, words, record);
    if (record.results.empty()) {
        uncertainty(builder, words, record);
    } else {
        budget_sections(builder, words, record);
    }
}

void summary_of_results(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    identification(builder, words, record);
    if (record.results.empty()) {
        uncertainty(builder, words, record);
    } else {
        budget_tables(builder, words, record);
    }
}

std::span<const DocumentKind> document_kinds() {
    return k_kinds;
}

const DocumentKind& document_kind(const EvaluationRecord& record, std::span<const DocumentKind> kinds) {
    const auto found = std::ranges::find(kinds, record.kind, &DocumentKind::word);
    return found != kinds.end() && found->holds(record) ? *found : k_kinds.front();
}

}  // namespace gumcert::reports
