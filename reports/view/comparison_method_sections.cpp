#include "reports/view/comparison_method_sections.h"

#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/plots/comparison_plots.h"
#include "reports/printed_texts.h"
#include "reports/view/certificate_rotary_sections.h"
#include "reports/view/comparison_parts.h"
#include "reports/view/comparison_sections.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

constexpr const char* k_validated = "validated";

/// Unit of differences and uncertainties, for people: K for °C.
std::string difference_unit(const Comparison& c) {
    return c.unit.empty() ? "" : gum::unit_for_people(gum::unit_of_difference(c.unit));
}

Text direction_name(const Wording& words, const std::string& direction) {
    return direction == "all" ? words("label", "all") : direction.empty() ? words("plot", "all_points") : direction;
}

/// The gravest verdict of all directions: what holds for the method as a whole. Nothing where nothing was judged.
const ComparisonSummary* gravest(const Comparison& c) {
    static constexpr std::array<const char*, 12> k_order = {"disagreement",
                                                            "side_refuted",
                                                            "falls_with_finding",
                                                            "points_above_1",
                                                            "joint_test_open",
                                                            "correlation_unknown",
                                                            "reference_not_better",
                                                            "uncertainty_too_large",
                                                            "agreement_few_points",
                                                            "uncertainty_not_confirmed",
                                                            "agreement_reference_limited",
                                                            k_validated};
    for (const char* code : k_order) {
        const ComparisonSummary* found = nullptr;
        for (const ComparisonSummary& s : c.summary) {
            found = s.verdict == code ? &s : found;  // the last one: "all" tells most
        }
        if (found != nullptr) {
            return found;
        }
    }
    return nullptr;
}

/// "Validated" is said of a method as a whole or not at all: a direction alone has no objection against it.
Text verdict_name(const Wording& words, const Comparison& c, const ComparisonSummary& of) {
    const std::string& verdict = of.verdict;
    if (verdict.empty()) {
        return {};
    }
    const bool alone = verdict == k_validated && gravest(c)->verdict != k_validated;
    const bool lacks_degrees = verdict == "agreement_few_points" && of.power_lacks_degrees;
    return words("comparison_verdict_name", alone ? "no_objection" : lacks_degrees ? "agreement_few_degrees" : verdict);
}

std::string count(const std::optional<std::int64_t>& v) {
    return v ? plain(*v) : "";
}

/// What the verdict shows, what it does not show, and what to do.
Text verdict_sentence(const Wording& words, const ComparisonSummary& s) {
    std::string key = s.verdict;
    if (s.verdict == "disagreement") {
        key = s.verdict_by == "pattern" || s.verdict_by == "bias" ? "disagreement_" + s.verdict_by
              : s.count_above_1 == 0                              ? "disagreement_scatter"
                                                                  : key;
    }
    const bool agreement_falls = s.verdict_audited == "disagreement" || s.verdict_audited == "points_above_1" ||
                                 s.verdict_audited == "joint_test_open";
    if (s.verdict == "falls_with_finding" && !agreement_falls) {
        key = "falls_with_finding_confirmation";
    }
    if (s.verdict == "agreement_few_points" && s.power_lacks_degrees) {
        key = "agreement_few_degrees";
    }
    if (s.verdict == "correlation_unknown" && !s.max_abs_En_worst.number) {
        key = "correlation_unknown_without_limit";
    }
    return words.filled(
        "comparison_verdict", key,
        {{"p_pattern", words.number(s.p_pattern.text)},
         {"p_bias", words.number(s.bias ? s.bias->p_no_bias.text : "")},
         {"audited", count(s.count_above_1_audited)},
         {"largest_audited", words.number(s.max_abs_En_audited.text)},
         {"corrected", s.verdict_audited.empty() ? Text() : words("comparison_verdict_name", s.verdict_audited)},
         {"count", plain(s.count_above_1)},
         {"points", plain(s.points)},
         {"effective", words.number(s.effective_points.text)},
         {"power", words.number(s.power_to_confirm.text)},
         {"largest", words.number(s.max_abs_En.text)},
         {"worst", words.number(s.max_abs_En_worst.text)},
         {"p_low", words.number(s.p_low.text)},
         {"p_high", words.number(s.p_high.text)},
         {"ratio", words.number(s.ratio_reference.text)}});
}

/// Each side that its own evaluation refutes, with what refutes it.
void refuted_sides(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    std::vector<std::pair<std::string, std::string>> sides;
    for (const RefutedSide& by : c.refuted) {
        const std::string id = by.id.empty() ? by.message : by.id;
        auto side = std::find_if(sides.begin(), sides.end(), [&](const auto& s) { return s.first == by.side; });
        if (side == sides.end()) {
            sides.emplace_back(by.side, id);
        } else if (side->second.find(id) == std::string::npos) {
            side->second += ", " + id;
        }
    }
    for (const auto& [side, ids] : sides) {
        builder.paragraph(
            words.filled("comparison", side.empty() ? "refuted_self" : "refuted_side", {{"side", side}, {"ids", ids}}));
    }
}

void verdict(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    const ComparisonSummary* whole = gravest(c);
    if (whole == nullptr) {
        builder.paragraph(words("comparison_verdict", "not_judged"));
        return;
    }
    builder.paragraph(verdict_sentence(words, *whole));
    refuted_sides(builder, words, c);
    if (whole->direction != "all" && c.summary.size() > 1) {
        builder.paragraph(words.filled("comparison", "verdict_of_direction",
                                       {{"direction", direction_name(words, whole->direction)}}));
    }
}

Text correlation_text(const Wording& words, const Comparison& c) {
    if (c.correlation.empty()) {
        return {};
    }
    const Text r = c.correlation_given ? words.number(plain(*c.correlation_given)) : Text();
    return words.filled("comparison_correlation", c.correlation, {{"r", r}});
}

/// One companion number: its name in the wording and its text for a direction.
struct Companion {
    const char* name;
    std::string (*text)(const ComparisonSummary& s);
};

std::string band(const std::string& low, const std::string& high) {
    return low.empty() || high.empty() ? low + high : low + " – " + high;
}

using Summary = ComparisonSummary;
constexpr Companion k_companions[] = {
    {"points", [](const Summary& s) { return plain(s.points); }},
    {"effective_points", [](const Summary& s) { return s.effective_points.text; }},
    {"mean_abs_En", [](const Summary& s) { return s.mean_abs_En.text; }},
    {"published_mean_abs_En", [](const Summary& s) { return s.published_mean_abs_En.text; }},
    {"max_abs_En", [](const Summary& s) { return s.max_abs_En.text; }},
    {"count_above_1", [](const Summary& s) { return plain(s.count_above_1); }},
    {"rms_En", [](const Summary& s) { return s.rms_En.text; }},
    {"rms_band", [](const Summary& s) { return band(s.rms_En_low.text, s.rms_En_high.text); }},
    {"p_low", [](const Summary& s) { return s.p_low.text; }},
    {"p_high", [](const Summary& s) { return s.p_high.text; }},
    {"D_fail", [](const Summary& s) { return s.D_fail.text; }},
    {"D_fail_largest", [](const Summary& s) { return s.D_fail_largest.text; }},
    {"found_with_80_percent", [](const Summary& s) { return s.found_with_80_percent.text; }},
    {"found_with_95_percent", [](const Summary& s) { return s.found_with_95_percent.text; }},
    {"power_to_confirm", [](const Summary& s) { return s.power_to_confirm.text; }},
    {"ratio_reference", [](const Summary& s) { return s.ratio_reference.text; }},
    {"max_abs_En_worst", [](const Summary& s) { return s.max_abs_En_worst.text; }},
    {"count_above_1_worst", [](const Summary& s) { return count(s.count_above_1_worst); }},
    {"mean_abs_En_audited", [](const Summary& s) { return s.mean_abs_En_audited.text; }},
    {"max_abs_En_audited", [](const Summary& s) { return s.max_abs_En_audited.text; }},
    {"count_above_1_audited", [](const Summary& s) { return count(s.count_above_1_audited); }},
    {"vector_En", [](const Summary& s) { return s.vector_En.text; }},
    {"p_mahalanobis", [](const Summary& s) { return s.p_mahalanobis.text; }},
};

bool has_unit(const std::string& companion) {
    return companion == "D_fail" || companion == "D_fail_largest" || companion == "found_with_80_percent" ||
           companion == "found_with_95_percent";
}

/// Largest U / CMC of a direction, "all" being the whole; "" where no capability is stated.
std::string largest_capability_ratio(const Comparison& c, const std::string& direction) {
    std::optional<double> largest;
    for (const ComparisonPoint& p : c.points) {
        if (p.U_over_CMC && (direction == "all" || p.direction == direction)) {
            largest = std::max(largest.value_or(0.0), *p.U_over_CMC);
        }
    }
    return largest ? gum::round_significant(*largest, 2) : "";
}

/// Rows that have a text in any direction, with the names of the numbers for the explanations below.
std::vector<std::pair<std::string, std::vector<std::string>>> companion_rows(const Comparison& c) {
    std::vector<std::pair<std::string, std::vector<std::string>>> rows;
    const auto add = [&](const std::string& name, auto text_of) {
        std::vector<std::string> texts;
        for (const ComparisonSummary& s : c.summary) {
            texts.push_back(text_of(s));
        }
        if (any_of(texts)) {
            rows.emplace_back(name, std::move(texts));
        }
    };
    for (const Companion& companion : k_companions) {
        add(companion.name, companion.text);
        if (std::string(companion.name) == "ratio_reference") {
            add("U_over_CMC", [&](const ComparisonSummary& s) { return largest_capability_ratio(c, s.direction); });
        }
    }
    return rows;
}

/// All companion numbers, one row a number and one column a direction; many directions go into several tables.
void companion_table(CertificateBuilder& builder, const Wording& words, const Comparison& c, const std::string& id) {
    constexpr std::size_t k_most_directions = 6;
    const auto numbers = companion_rows(c);
    const std::string unit = difference_unit(c);
    for (std::size_t from = 0; from < c.summary.size(); from += k_most_directions) {
        const std::size_t to = std::min(c.summary.size(), from + k_most_directions);
        std::vector<Column> columns = {{words("comparison", "number_of_table"), ""}};
        for (std::size_t d = from; d < to; ++d) {
            columns.push_back({direction_name(words, c.summary[d].direction), "", true});
        }
        Rows rows;
        for (const auto& [name, texts] : numbers) {
            const Text label = words("companion", name);
            std::vector<Text> row = {has_unit(name) && !unit.empty() ? label + " / " + unit : label};
            row.insert(row.end(), texts.begin() + static_cast<std::ptrdiff_t>(from),
                       texts.begin() + static_cast<std::ptrdiff_t>(to));
            rows.push_back(std::move(row));
        }
        const std::string table_id = from == 0 ? id : id + "-" + plain(static_cast<std::int64_t>(from));
        builder.table(table_id, words("comparison", "companion_table"), columns, rows);
    }
}

/// One sentence for every number of the table above.
void how_to_read_methods(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    builder.paragraph(words("comparison", "how_to_read"));
    Facts facts;
    for (const auto& [name, texts] : companion_rows(c)) {
        if (words.has("companion_reading", name)) {
            facts.emplace_back(
                words("companion", name),
                words.filled(
                    "companion_reading", name,
                    {{"finding", c.audit_finding.empty() ? words("document", "absent") : Text(c.audit_finding)},
                     {"source", c.published_source.empty() ? words("document", "absent") : Text(c.published_source)}}));
        }
    }
    builder.definitions(facts);
}

void verdict_table(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    Rows rows;
    for (const ComparisonSummary& s : c.summary) {
        rows.push_back({direction_name(words, s.direction), plain(s.points), s.mean_abs_En.text, s.max_abs_En.text,
                        s.rms_En.text, plain(s.count_above_1), verdict_name(words, c, s)});
    }
    table_of_filled_columns(builder, "summary", words("sentence", "comparison_summary"),
                            {{words("label", "direction"), ""},
                             {words("label", "points"), "", true},
                             {words("label", "mean_abs_En"), "", true},
                             {words("label", "max_abs_En"), "", true},
                             {words("label", "rms_En"), "", true},
                             {words("label", "count_above_1"), "", true},
                             {words("comparison", "verdict"), ""}},
                            rows);
}

bool has_bias(const Comparison& c) {
    return std::any_of(c.summary.begin(), c.summary.end(), [](const ComparisonSummary& s) { return s.bias; });
}

void bias_lines(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    const std::string unit = difference_unit(c);
    const std::string position_unit = gum::unit_for_people(c.form == "rotary_table" ? "degree" : c.position_unit);
    Rows rows;
    std::string against;
    for (const ComparisonSummary& s : c.summary) {
        if (s.bias) {
            against = s.bias->against;
            rows.push_back({direction_name(words, s.direction), s.bias->centre.text, s.bias->constant.text,
                            s.bias->U_constant.text, s.bias->slope.text, s.bias->U_slope.text, s.bias->p_no_bias.text,
                            s.bias->p_value.text});
        }
    }
    const bool position = against == "position";
    const std::string t_unit = position ? position_unit : gum::unit_for_people(c.unit);
    const std::string slope_unit = !position ? "" : t_unit.empty() ? unit : unit + "/" + t_unit;
    builder.paragraph(words("comparison", position ? "bias_position" : "bias_reference_value"));
    table_of_filled_columns(builder, "bias", words("comparison", "bias_table"),
                            {{words("label", "direction"), ""},
                             {words("comparison", "centre"), t_unit, true},
                             {words("comparison", "constant"), unit, true},
                             {words("label", "U"), unit, true},
                             {words("comparison", "slope"), slope_unit, true},
                             {words("label", "U"), slope_unit, true},
                             {words("comparison", "p_no_bias"), "", true},
                             {words("label", "p_value_short"), "", true}},
                            rows);
}

/// The points that a table shows: all, or of many those above 1 in the order of the record.
std::vector<const ComparisonPoint*> shown_points(const Comparison& c) {
    std::vector<const ComparisonPoint*> points;
    const bool all = c.points.size() <= k_most_rows;
    for (const ComparisonPoint& p : c.points) {
        if ((all || (p.En.number && (*p.En.number > 1.0 || *p.En.number < -1.0))) && points.size() < k_most_rows) {
            points.push_back(&p);
        }
    }
    return points;
}

void point_table(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    const std::vector<const ComparisonPoint*> points = shown_points(c);
    if (points.size() < c.points.size()) {
        builder.paragraph(words.filled("comparison", points.empty() ? "no_points_above_1" : "points_above_1",
                                       {{"shown", plain(static_cast<std::int64_t>(points.size()))},
                                        {"count", plain(static_cast<std::int64_t>(c.points.size()))}}));
    }
    const std::string unit = gum::unit_for_people(c.unit);
    const std::string difference = difference_unit(c);
    const bool rotary = c.form == "rotary_table";
    Rows rows;
    for (const ComparisonPoint* p : points) {
        const std::string position = rotary ? p->printed_angle : p->position ? plain(*p->position) : "";
        rows.push_back({p->name, p->direction, position, p->value.text, p->U.text, p->reference_value.text,
                        p->reference_U.text, p->D.text, p->U_D.text, p->En.text, p->En_worst.text, p->En_audited.text});
    }
    table_of_filled_columns(
        builder, "comparison-points", words("sentence", "comparison_points"),
        {{words("label", "point"), ""},
         {words("label", "direction"), ""},
         rotary ? Column{words("label", "angle"), "°", true}
                : Column{c.position_name.empty() ? words("comparison", "position") : Text(c.position_name),
                         gum::unit_for_people(c.position_unit), true},
         {words("label", "measured") + " x", unit, true},
         {"U(x)", difference, true},
         {words("label", "reference") + " X", unit, true},
         {"U(X)", difference, true},
         {words("label", "difference"), difference, true},
         {"U(D)", difference, true},
         {words("label", "En"), "", true},
         {words("comparison", "En_worst"), "", true},
         {words("comparison", "En_audited"), "", true}},
        rows);
}

void budgets(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    if (c.method_budget.empty() && c.reference_budget.empty()) {
        return;
    }
    builder.section("comparison_budgets");
    const std::string unit = difference_unit(c);
    if (!c.method_budget.empty()) {
        budget_table(builder, words, "method-budget",
                     words.filled("comparison", "budget_of", {{"name", c.method_name}}), c.method_budget, unit);
    }
    if (!c.reference_budget.empty()) {
        budget_table(builder, words, "reference-budget",
                     words.filled("comparison", "budget_of", {{"name", c.reference_name}}), c.reference_budget, unit);
    }
}

void method_figure(CertificateBuilder& builder, const Wording& words, const Comparison& c, const std::string& id,
                   const char* plot, const Text& caption,
                   std::string (*draw)(const Comparison&, const std::string&, const Wording&)) {
    figure_if_any(builder, id, caption, words("plot", std::string(plot) + "_description"), draw(c, id, words));
}

}  // namespace

void method_answer(CertificateBuilder& builder, const Wording& words, const Comparison& c, Facts facts,
                   const Facts& conventions) {
    builder.section("answer");
    verdict(builder, words, c);
    facts.insert(facts.begin(), {words("comparison", "compared"),
                                 words.filled("comparison", "method_and_reference",
                                              {{"method", c.method_name}, {"reference", c.reference_name}})});
    add_fact(facts, words("comparison", "correlation"), correlation_text(words, c));
    add_fact(facts, words("comparison", "tolerance"), printed_quantity(words, c.tolerance.text, difference_unit(c)));
    facts.insert(facts.end(), conventions.begin(), conventions.end());
    builder.definitions(facts);
    if (!c.points.empty()) {
        method_figure(builder, words, c, "plot-en", "method_scores", words("comparison", "figure_method_scores"),
                      method_scores_plot);
    }
    verdict_table(builder, words, c);
    builder.paragraph(words("comparison", "En_says"));
}

void method_sections_of_comparison(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    builder.section("companion");
    companion_table(builder, words, c, "companion");
    how_to_read_methods(builder, words, c);
    shared_sources_table(builder, words, c);
    remarks_section(builder, words, c);
    builder.section("bias");
    if (has_bias(c)) {
        bias_lines(builder, words, c);
        method_figure(builder, words, c, "plot-bias", "bias", words("comparison", "figure_bias"), bias_plot);
    } else {
        builder.paragraph(words("comparison", "no_bias_line"));
    }
    budgets(builder, words, c);
    builder.section("points");
    if (!c.points.empty()) {
        method_figure(builder, words, c, "plot-values", "method_values", words("comparison", "figure_method_values"),
                      method_values_plot);
    }
    point_table(builder, words, c);
}

void reference_comparison_section(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    builder.section("comparison");
    builder.paragraph(words("sentence", "comparison"));
    Facts rows = {{words("label", "reference_method"), c.reference_name}};
    if (c.contact_point_mm.size() == 3) {
        const Text separator = words("document", "separator");
        const auto coordinate = [&](std::size_t i) { return words.number(plain(c.contact_point_mm[i])); };
        rows.emplace_back(words("label", "contact_point"),
                          "(" + coordinate(0) + separator + coordinate(1) + separator + coordinate(2) + ") mm");
    }
    // A certificate for another probability prints U(x) for that one beside U(D) for this one.
    if (std::any_of(c.points.begin(), c.points.end(),
                    [](const ComparisonPoint& p) { return p.U_of_scores.number || p.reference_U_of_scores; })) {
        add_probability_of_differences(rows, words, c);
    }
    builder.definitions(rows);
    if (gravest(c) != nullptr) {
        verdict(builder, words, c);
    }
    companion_table(builder, words, c, "comparison-summary");
    for (const std::string& remark : c.remarks) {
        builder.paragraph(words.sentence(remark));
    }
    if (!c.points.empty()) {
        method_figure(builder, words, c, "plot-en", "method_scores", words("sentence", "figure_En"),
                      method_scores_plot);
        method_figure(builder, words, c, "plot-displacement", "method_values", words("sentence", "figure_displacement"),
                      method_values_plot);
    }
    shared_sources_table(builder, words, c);
    if (has_bias(c)) {
        bias_lines(builder, words, c);
    }
    if (!c.reference_budget.empty()) {
        budget_table(builder, words, "reference-budget", words("sentence", "reference_budget"), c.reference_budget,
                     "µm");
    }
}

void reference_comparison_points(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    if (!c.points.empty()) {
        builder.section("comparison_points");
        point_table(builder, words, c);
    }
}

}  // namespace gumcert::reports
