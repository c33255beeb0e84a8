#include "reports/view/certificate_rotary_sections.h"

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/plots/rotary_plots.h"
#include "reports/record/stated_values.h"
#include "reports/reported_results.h"
#include "reports/result_names.h"
#include "reports/view/certificate_evidence_sections.h"
#include "text/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

constexpr std::size_t k_most_listed = 60;  // rows of a list of exceptions; the record holds all

/// A number that has no printed form in the record, with two significant digits and U+2212 as minus sign.
std::string rounded_with_minus(double v) {
    const std::string text = gum::round_significant(v, 2);
    return text.starts_with('-') ? "\u2212" + text.substr(1) : text;
}

/// name, then value and U of each coordinate
std::vector<Text> coordinates(const std::string& name, const std::vector<std::string>& position,
                              const std::vector<std::string>& U) {
    std::vector<Text> row = {name};
    for (std::size_t c = 0; c < 3; ++c) {
        row.push_back(c < position.size() ? position[c] : "");
        row.push_back(c < U.size() ? U[c] : "");
    }
    return row;
}

std::vector<Column> coordinate_columns(const Wording& words, const Text& first) {
    std::vector<Column> columns = {{first, ""}};
    for (const char* c : {"x", "y", "z"}) {
        columns.push_back({c, "mm", true});
        columns.push_back({words("label", "U"), "mm", true});
    }
    return columns;
}

/// A normalised residual, with U+2212 as minus sign.
std::string fixed_signed(double v) {
    const std::string text = text::fixed(std::abs(v), 2);
    return v < 0.0 && text != "0.00" ? "\u2212" + text : text;
}

/// A minimal detectable bias; none where nothing controls the observation.
std::string detectable(double bias_um) {
    return bias_um > 0.0 ? rounded_with_minus(bias_um) : "";
}

/// What Monte Carlo says of a quantity; "" where it was not asked.
Text verdict_of(const std::optional<MonteCarloSummary>& m, const Wording& words) {
    if (!m || !m->validation) {
        return "";
    }
    return words("value", "verdict",
                 !m->validation->precise_enough ? "not_precise"
                 : m->validation->validated     ? "validated"
                                                : "not_validated");
}

bool by_monte_carlo(const StatedValue& q) {
    return q.reported && q.reported->method == "monte_carlo";
}

std::string printed_k(const StatedValue& q) {
    if (!by_monte_carlo(q)) {
        return certificate::printed_coverage_factor(q.k);
    }
    return q.reported->k ? certificate::printed_coverage_factor(*q.reported->k) : "";
}

void parameter_table(CertificateBuilder& builder, const Wording& words, const std::string& id, const Text& caption,
                     const std::string& table, const std::vector<TableParameter>& parameters) {
    const bool compared = std::any_of(parameters.begin(), parameters.end(), [](const TableParameter& p) {
        return p.stated.monte_carlo && p.stated.monte_carlo->validation;
    });
    std::vector<Column> columns = {{words("label", "name"), ""},        {words("label", "meaning"), ""},
                                   {words("label", "value"), "", true}, {words("label", "U"), "", true},
                                   {words("label", "unit"), ""},        {words("label", "k"), "", true},
                                   {words("label", "nu_eff"), "", true}};
    if (compared) {
        columns.push_back({words("label", "verdict"), ""});
    }
    Rows rows;
    for (const TableParameter& p : parameters) {
        const StatedValue& q = p.stated;
        rows.push_back({p.name, result_meaning(table, p.name, p.description, words), q.printed.value,
                        stated_uncertainty(q, words), q.printed.unit, printed_k(q),
                        by_monte_carlo(q) ? Text() : degrees_of_freedom(q.nu_eff, words)});
        if (compared) {
            rows.back().push_back(verdict_of(q.monte_carlo, words));
        }
    }
    builder.table(id, caption, columns, rows);
}

void layout_figure(CertificateBuilder& builder, const Wording& words, const LayoutPlot& plot,
                   const std::string& sentence, double magnification) {
    Text caption = words("sentence", sentence);
    if (magnification > 0.0) {
        caption += " " + words.fill("ellipses", {{"times", words.number(plain(magnification))}});
    }
    builder.figure(plot.id, caption, plot.description, svg(plot));
}

/// A quantity of the evaluation that Monte Carlo was compared for.
struct Compared {
    Text group, name;
    Printed law;  ///< value and U of the law of propagation
    const MonteCarloSummary* trials;
};

/// Value and U of the law of propagation as printed, also where Monte Carlo is reported.
Printed printed_law(const StatedValue& q) {
    Printed law = q.printed;
    if (by_monte_carlo(q)) {
        const gum::RoundedPair pair = gum::round_to_uncertainty(q.value, q.U, 2);
        law.value = pair.value;
        law.U = pair.U;
    }
    return law;
}

Text heading_of(const StatedPlace<const StatedValue>& place, const Wording& words) {
    switch (place.group) {
        case StatedGroup::error_motions:
            return place.name;
        case StatedGroup::ranges:
            return words("label", "range");
        case StatedGroup::positioning:
            return words("heading", "positioning");
        default:
            return words("label", group_name(place.group));
    }
}

Text compared_name(const StatedPlace<const StatedValue>& place, const RotaryTable& r, const Wording& words) {
    if (place.group == StatedGroup::error_motions) {
        return place.name + " (" + words.number(r.errors[place.index].angle_deg.text) + "°)";
    }
    const bool of_motion = place.group == StatedGroup::ranges || place.group == StatedGroup::reversal;
    return of_motion ? place.name + ", " + heading_of(place, words) : Text(place.name);
}

std::vector<Compared> all_compared(const Wording& words, const EvaluationRecord& record) {
    std::vector<Compared> all;
    const ConstStatedPlaces places = stated_values(*record.rotary, ErrorOrder::by_motion);
    const auto add_group = [&](StatedGroup group) {
        for (const auto& place : places) {
            if (place.group == group && place.stated.monte_carlo) {
                all.push_back({.group = heading_of(place, words),
                               .name = compared_name(place, *record.rotary, words),
                               .law = printed_law(place.stated),
                               .trials = &*place.stated.monte_carlo});
            }
        }
    };
    add_group(StatedGroup::error_motions);
    for (const Result& result : record.results) {
        if (result.monte_carlo) {
            all.push_back({.group = words("heading", "set_up"),
                           .name = result.name,
                           .law = result.printed,
                           .trials = &*result.monte_carlo});
        }
    }
    for (const StatedGroup group : {StatedGroup::ranges, StatedGroup::reversal, StatedGroup::axis_line,
                                    StatedGroup::location_errors, StatedGroup::positioning}) {
        add_group(group);
    }
    return all;
}

void global_test(CertificateBuilder& builder, const Wording& words, const AdjustmentSummary& a) {
    const GlobalTest& test = a.global_test;
    if (test.lower.text.empty() || test.upper.text.empty()) {
        return;
    }
    const char* verdict = test.accepted                             ? "accepted"
                          : a.chi_square.number < test.lower.number ? "too_small"
                                                                    : "too_large";
    builder.paragraph(
        words.fill(std::string("global_test_") + verdict, {{"chi_square", words.number(a.chi_square.text)},
                                                           {"lower", words.number(test.lower.text)},
                                                           {"upper", words.number(test.upper.text)}}));
    if (!test.meaning.empty()) {
        builder.paragraph(words.sentence(test.meaning));
    }
}

void variance_components(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (r.variance_components.empty()) {
        return;
    }
    // Records of earlier releases know neither stated values nor degrees of freedom.
    const bool in_depth = std::any_of(
        r.variance_components.begin(), r.variance_components.end(),
        [](const VarianceComponent& v) { return !v.stated.text.empty() || v.degrees_of_freedom || !v.used; });
    std::vector<Column> columns = {{words("label", "component"), ""},
                                   {words("label", "standard_deviation"), "", true},
                                   {words("label", "its_u"), "", true},
                                   {words("label", "unit"), ""}};
    if (in_depth) {
        columns.push_back({words("label", "stated"), "", true});
        columns.push_back({words("label", "nu"), "", true});
    }
    columns.push_back({words("label", "redundancy"), "", true});
    columns.push_back({words("label", "origin"), ""});
    if (in_depth) {
        columns.push_back({words("label", "use"), ""});
    }
    Rows rows;
    for (const VarianceComponent& v : r.variance_components) {
        std::vector<Text> row = {words.sentence(v.name), v.printed.value, v.printed.U, v.printed.unit};
        if (in_depth) {
            row.push_back(v.stated.text);
            row.push_back(v.degrees_of_freedom ? degrees_of_freedom(v.degrees_of_freedom, words) : Text());
        }
        row.push_back(text::fixed(v.redundancy, 1));
        row.push_back(words("value", v.estimated ? "estimated" : "given"));
        if (in_depth) {
            row.push_back(words("value", v.used ? "used" : "check_only"));
        }
        rows.push_back(std::move(row));
    }
    builder.table("variance-components",
                  words("sentence", in_depth ? "variance_components_in_depth" : "variance_components"), columns, rows);
}

/// What the laboratory left out, with its reasons.
void excluded_distances(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (r.exclusions.empty()) {
        return;
    }
    const std::vector<Column> columns = {{words("label", "station"), ""},
                                         {words("label", "reflector"), ""},
                                         {words("label", "pass"), ""},
                                         {words("label", "direction"), ""},
                                         {words("label", "angle"), "°"},
                                         {words("label", "lines"), ""},
                                         {words("label", "count_left_out"), "", true},
                                         {words("label", "reason"), ""}};
    Rows rows;
    const Text all = words("value", "all");
    for (const ExcludedDistances& e : r.exclusions) {
        const auto named = [&](const std::string& text) { return text.empty() ? all : Text(text); };
        rows.push_back({named(e.station), named(e.reflector), named(e.pass),
                        named(e.direction == "-" ? "−" : e.direction), e.angle.empty() ? all : words.number(e.angle),
                        named(e.lines), std::to_string(e.count), e.reason});
    }
    builder.table("exclusions", words("sentence", "exclusions"), columns, rows);
}

void flagged_distances(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    const Text alpha = words.number(plain(r.outlier_alpha));
    const Text critical = words.number(r.outlier_critical_value.text);
    if (r.flagged.empty()) {
        if (!r.outlier_critical_value.text.empty()) {
            builder.paragraph(words.fill("no_flagged", {{"critical", critical}, {"alpha", alpha}}));
        }
        return;
    }
    const bool in_depth = std::any_of(r.flagged.begin(), r.flagged.end(), [](const FlaggedDistance& f) {
        return !f.found_with.empty() || !f.estimated_error_um.empty();
    });
    std::vector<Column> columns = {{words("label", "station"), ""},
                                   {words("label", "reflector"), ""},
                                   {words("label", "pass"), ""},
                                   {words("label", "angle"), "°", true},
                                   {words("label", "residual"), "µm", true},
                                   {words("label", "test_value"), "", true}};
    if (in_depth) {
        columns.insert(columns.begin(), {words("label", "order"), "", true});
        columns.push_back({words("label", "found_with"), ""});
        columns.push_back({words("label", "estimated_error"), "µm", true});
    }
    columns.push_back({words("label", "action"), ""});
    Rows rows;
    std::vector<std::pair<std::string, std::string>> reasons;  // numbers of the distances, reason
    for (std::size_t i = 0; i < r.flagged.size(); ++i) {
        const FlaggedDistance& f = r.flagged[i];
        std::vector<Text> row = {f.station, f.reflector, f.pass, f.angle, f.residual_um, f.test_value};
        if (in_depth) {
            row.insert(row.begin(), std::to_string(i + 1));
            row.push_back(words.number(f.found_with));
            row.push_back(f.estimated_error_um);
        }
        row.push_back(words("value", f.removed ? "removed" : "kept"));
        rows.push_back(std::move(row));
        if (!f.reason.empty() && reasons.size() < k_most_listed) {
            // The same reason of distances that follow each other is said once.
            const std::string number = std::to_string(i + 1);
            if (!reasons.empty() && reasons.back().second == f.reason) {
                std::string& numbers = reasons.back().first;
                numbers = numbers.substr(0, numbers.find("–")) + "–" + number;
            } else {
                reasons.emplace_back(number, f.reason);
            }
        }
    }
    builder.table("flagged", words.fill("flagged", {{"critical", critical}, {"alpha", alpha}}), columns, rows);
    if (!reasons.empty()) {
        Facts facts;
        for (const auto& [numbers, reason] : reasons) {
            facts.emplace_back(words("label", "order") + " " + numbers, words.sentence(reason));
        }
        builder.definitions(facts);
    }
}

void runs(CertificateBuilder& builder, const Wording& words, const PositioningAccuracy& p) {
    builder.section("positioning");
    builder.paragraph(words.fill("positioning", {{"up", plain(p.runs_up)}, {"down", plain(p.runs_down)}}));
    if (!p.u_deviation.text.empty()) {
        builder.paragraph(words.fill("u_deviation", {{"u", words.number(p.u_deviation.text)}}));
    }
}

void targets(CertificateBuilder& builder, const Wording& words, const PositioningAccuracy& p) {
    for (const std::string& remark : p.remarks) {
        builder.paragraph(words.sentence(remark));
    }
    constexpr std::size_t k_most_targets = 120;  // the diagram shows more of them than a table of pages
    if (p.targets.size() > k_most_targets) {
        builder.paragraph(words.fill("targets_in_record", {{"count", std::to_string(p.targets.size())}}));
        return;
    }
    if (p.targets.empty()) {
        return;
    }
    Rows rows;
    for (const PositioningTarget& t : p.targets) {
        rows.push_back(
            {t.angle_deg.text, t.mean_up.text, t.mean_down.text, t.s_up.text, t.s_down.text, t.reversal.text});
    }
    builder.table("positioning-targets", words("sentence", "positioning_targets"),
                  {{words("label", "target"), "°", true},
                   {words("label", "mean_up"), "″", true},
                   {words("label", "mean_down"), "″", true},
                   {words("label", "s_up"), "″", true},
                   {words("label", "s_down"), "″", true},
                   {words("label", "reversal_value"), "″", true}},
                  rows);
}

}  // namespace

/// \param unit  of the result, hence of every contribution
void budget_table(CertificateBuilder& builder, const Wording& words, const std::string& id, const Text& caption,
                  const std::vector<BudgetRow>& budget, const std::string& unit) {
    Rows rows;
    for (const BudgetRow& row : budget) {
        rows.push_back({source_name(row.input, words), source_name(row.source, words), row.type,
                        distribution_name(row.distribution, words), degrees_of_freedom(row.nu.number, words),
                        row.u.text, gum::unit_for_people(row.unit), row.contribution.text, row.share.text});
    }
    builder.table(id, caption,
                  {{words("label", "input"), ""},
                   {words("label", "source"), ""},
                   {words("label", "type"), ""},
                   {words("label", "distribution"), ""},
                   {words("label", "nu"), "", true},
                   {words("label", "u"), "", true},
                   {words("label", "unit"), ""},
                   {words("label", "contribution"), unit, true},
                   {words("label", "share"), "%", true}},
                  rows);
}

void axis_line(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (!r.axis_line.empty()) {
        parameter_table(builder, words, "axis-line", words("sentence", "axis_line"), "axis_line", r.axis_line);
    }
}

void location_errors(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (r.location_errors.empty() || !r.machine_frame) {
        return;
    }
    const MachineFrame& frame = *r.machine_frame;
    builder.section("location_errors");
    builder.paragraph(words.fill(frame.by == "stations" ? "machine_by_stations" : "machine_by_probing",
                                 {{"count", std::to_string(frame.points.size())},
                                  {"residual", words.number(frame.printed_residual)},
                                  {"p", words.number(frame.p_value.text)}}));
    parameter_table(builder, words, "location-errors", words("sentence", "location_errors"), "location_errors",
                    r.location_errors);
}

void positioning(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (!r.iso230_2) {
        return;
    }
    runs(builder, words, *r.iso230_2);
    if (!r.iso230_2->parameters.empty()) {
        parameter_table(builder, words, "positioning", words("sentence", "positioning_table"), "positioning",
                        r.iso230_2->parameters);
    }
    positioning_figure(builder, words, r);
    targets(builder, words, *r.iso230_2);
}

void positioning_targets(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (r.iso230_2) {
        runs(builder, words, *r.iso230_2);
        positioning_figure(builder, words, r);
        targets(builder, words, *r.iso230_2);
    }
}

void budget_by_source(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (r.budget_summary.empty()) {
        return;
    }
    std::vector<Column> columns = {
        {words("label", "quantity"), ""}, {words("label", "rms_u"), "", true}, {words("label", "unit"), ""}};
    for (const std::string& source : r.budget_sources) {
        columns.push_back({source_name(source, words), "%", true});
    }
    Rows rows;
    for (const BudgetSummaryRow& row : r.budget_summary) {
        std::vector<Text> line = {words.sentence(row.quantity), row.rms_u.text, gum::unit_for_people(row.unit)};
        line.insert(line.end(), row.shares.text.begin(), row.shares.text.end());
        rows.push_back(std::move(line));
    }
    builder.table("budget-summary", words("sentence", "budget_summary"), columns, rows);
    const StackedPlot plot = source_plot(r, words);
    builder.figure(plot.id, words("sentence", "figure_sources"), plot.description, svg(plot));
}

void fixture(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    Rows rows;
    for (const Reflector& m : r.reflectors) {
        if (!m.printed_cmm.empty()) {
            rows.push_back(coordinates(m.name, m.printed_cmm, m.printed_U_cmm));
        }
    }
    if (rows.empty() && !r.fixture_budget) {
        return;
    }
    builder.section("fixture");
    if (r.fixture_budget) {
        const FixtureBudget& f = *r.fixture_budget;
        Facts facts = {{words("label", "fixture_method"), words("value", "fixture_method", f.method)}};
        if (!f.file.empty()) {
            facts.emplace_back(words("label", "file"), f.file);
        }
        builder.definitions(facts);
        for (const std::string& remark : f.remarks) {
            builder.paragraph(words.sentence(remark));
        }
    }
    if (!rows.empty()) {
        builder.table("fixture", words("sentence", "fixture_table"),
                      coordinate_columns(words, words("label", "holder")), rows);
    }
    if (r.fixture_budget && !r.fixture_budget->largest.empty()) {
        budget_table(builder, words, "fixture-budget",
                     words.fill("fixture_budget", {{"coordinate", r.fixture_budget->largest_coordinate}}),
                     r.fixture_budget->largest, "µm");
    }
}

void rotary_monte_carlo(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    if (!record.rotary || !record.rotary->monte_carlo) {
        return;
    }
    const RotaryMonteCarlo& m = *record.rotary->monte_carlo;
    builder.section("monte_carlo");
    builder.paragraph(words("sentence", "rotary_monte_carlo"));
    if (!m.statement.empty()) {
        builder.paragraph(words.sentence(m.statement));
    }
    builder.definitions(
        {{words("label", "trials"), plain(m.trials)},
         {words("label", "seed"), plain(m.seed)},
         {words("label", "steps"),
          words.fill("steps", {{"mean", words.number(text::fixed(m.mean_steps, 2))}, {"most", plain(m.most_steps)}})}});
    const std::vector<Compared> all = all_compared(words, record);
    struct Counts {
        Text group;
        std::int64_t compared = 0, validated = 0, not_validated = 0, not_precise = 0;
    };
    std::vector<Counts> groups;
    Rows exceptions;
    std::size_t left_out = 0;
    for (const Compared& c : all) {
        if (!c.trials->validation) {
            continue;
        }
        const GufValidation& v = *c.trials->validation;
        auto found = std::find_if(groups.begin(), groups.end(), [&](const Counts& g) { return g.group == c.group; });
        if (found == groups.end()) {
            found = groups.insert(groups.end(), Counts{.group = c.group});
        }
        ++found->compared;
        ++(!v.precise_enough ? found->not_precise : v.validated ? found->validated : found->not_validated);
        // Where the trials are too few to say, the count says so; hundreds of rows without an answer help nobody.
        if (!v.precise_enough || v.validated) {
            continue;
        }
        if (exceptions.size() == builder.most(k_most_listed)) {
            ++left_out;
            continue;
        }
        exceptions.push_back({c.name, c.law.value, c.law.U, c.trials->mean.text, c.trials->u.text,
                              c.trials->symmetric.text[0], c.trials->symmetric.text[1], c.trials->shortest.text[0],
                              c.trials->shortest.text[1], c.law.unit, verdict_of(*c.trials, words)});
    }
    if (groups.empty()) {
        builder.paragraph(words("sentence", "nothing_compared"));
        return;
    }
    Rows rows;
    for (const Counts& g : groups) {
        rows.push_back({g.group, plain(g.compared), plain(g.validated), plain(g.not_validated), plain(g.not_precise)});
    }
    builder.table("monte-carlo-groups", words("sentence", "monte_carlo_groups"),
                  {{words("label", "quantities"), ""},
                   {words("label", "compared"), "", true},
                   {words("value", "verdict", "validated"), "", true},
                   {words("value", "verdict", "not_validated"), "", true},
                   {words("value", "verdict", "not_precise"), "", true}},
                  rows);
    const bool undecided = std::any_of(groups.begin(), groups.end(), [](const Counts& g) { return g.not_precise > 0; });
    if (undecided) {
        builder.paragraph(words("sentence", "monte_carlo_undecided"));
    }
    if (exceptions.empty()) {
        if (!undecided) {
            builder.paragraph(words("sentence", "all_validated"));
        }
        return;
    }
    builder.table("monte-carlo-exceptions",
                  words.fill("monte_carlo_exceptions", {{"p", words.number(record.coverage_probability.text)}}),
                  {{words("label", "quantity"), ""},
                   {words("label", "value"), "", true},
                   {words("label", "U"), "", true},
                   {words("label", "mean_short"), "", true},
                   {words("label", "u"), "", true},
                   {words("label", "low"), "", true},
                   {words("label", "high"), "", true},
                   {words("label", "low"), "", true},
                   {words("label", "high"), "", true},
                   {words("label", "unit"), ""},
                   {words("label", "verdict"), ""}},
                  exceptions,
                  {{"", 1},
                   {words("label", "law_of_propagation"), 2},
                   {words("label", "monte_carlo"), 2},
                   {words("label", "symmetric"), 2},
                   {words("label", "shortest"), 2},
                   {"", 2}});
    if (left_out > 0) {
        builder.paragraph(words.fill("more_in_record", {{"count", std::to_string(left_out)}}));
    }
}

void adjustment(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    const AdjustmentSummary& a = r.adjustment;
    builder.section("adjustment");
    builder.paragraph(words("sentence", "adjustment"));
    Facts facts = {{words("label", "method"), words("value", "method", a.method)},
                   {words("label", "observations"), plain(a.observations)},
                   {words("label", "parameters"), plain(a.parameters)},
                   {words("label", "degrees_of_freedom"), plain(a.degrees_of_freedom)},
                   {words("label", "chi_square"), words.number(a.chi_square.text)}};
    if (!a.global_test.lower.text.empty()) {
        facts.emplace_back(words("label", "chi_square_limits"),
                           words.fill("chi_square_limits", {{"lower", words.number(a.global_test.lower.text)},
                                                            {"upper", words.number(a.global_test.upper.text)},
                                                            {"p", words.number(plain(a.global_test.probability))}}));
    }
    facts.emplace_back(words("label", "p_value"), words.number(a.p_value.text));
    facts.emplace_back(words("label", "variance_factor_stated"), words.number(plain(a.variance_factor.a_priori)));
    facts.emplace_back(words("label", "variance_factor"), words.number(a.variance_factor.a_posteriori.text));
    facts.emplace_back(words("label", "variance_factor_used"),
                       words("value", "variance_factor", a.variance_factor.used));
    if (!a.variance_factor.reason.empty()) {
        facts.emplace_back(words("label", "variance_factor_reason"), words.sentence(a.variance_factor.reason));
    }
    facts.emplace_back(words("label", "condition_number"), words.number(a.condition_number.text));
    facts.emplace_back(words("label", "iterations"), plain(a.iterations));
    builder.definitions(facts);
    global_test(builder, words, a);
    variance_components(builder, words, r);
    if (!r.reliability.empty() && !r.stations.empty()) {
        const Plot plot = station_residual_plot(r, words);
        Text caption = words("sentence", "figure_station_residuals");
        if (r.stations.size() > k_most_residual_panels) {
            caption += " " + words.fill("first_stations", {{"shown", std::to_string(k_most_residual_panels)},
                                                           {"count", std::to_string(r.stations.size())}});
        }
        builder.figure(plot.id, caption, plot.description, svg(plot));
    }
    excluded_distances(builder, words, r);
    flagged_distances(builder, words, r);
}

void reliability(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    if (r.fixture_reliability.empty() && r.external_reliability.empty()) {
        return;  // records of earlier releases
    }
    builder.section("reliability");
    builder.paragraph(words("sentence", "reliability"));
    const ReliabilityRow* least = nullptr;
    const ReliabilityRow* largest = nullptr;
    for (const ReliabilityRow& row : r.reliability) {
        if (!row.removed) {
            least = least == nullptr || row.redundancy_number < least->redundancy_number ? &row : least;
            largest = largest == nullptr || row.minimal_detectable_bias_um > largest->minimal_detectable_bias_um
                          ? &row
                          : largest;
        }
    }
    Facts facts;
    const auto distance = [&](const ReliabilityRow& row) {
        return words.fill("one_distance", {{"station", row.station},
                                           {"reflector", row.reflector},
                                           {"pass", row.pass},
                                           {"angle", words.number(plain(row.angle_deg))}});
    };
    if (least != nullptr && largest != nullptr) {
        facts.emplace_back(words("label", "least_redundancy"),
                           words.number(text::fixed(least->redundancy_number, 3)) + " (" + distance(*least) + ")");
        facts.emplace_back(
            words("label", "largest_bias"),
            words.number(rounded_with_minus(largest->minimal_detectable_bias_um)) + " µm (" + distance(*largest) + ")");
    }
    const FixtureReliabilityRow* least_fixture = nullptr;
    const FixtureReliabilityRow* largest_fixture = nullptr;
    for (const FixtureReliabilityRow& row : r.fixture_reliability) {
        least_fixture =
            least_fixture == nullptr || row.redundancy_number < least_fixture->redundancy_number ? &row : least_fixture;
        largest_fixture =
            largest_fixture == nullptr || row.minimal_detectable_bias_um > largest_fixture->minimal_detectable_bias_um
                ? &row
                : largest_fixture;
    }
    if (least_fixture != nullptr) {
        const auto coordinate = [&](const FixtureReliabilityRow& row) {
            return words.fill("one_coordinate", {{"coordinate", row.coordinate}, {"reflector", row.reflector}});
        };
        facts.emplace_back(
            words("label", "least_redundancy_fixture"),
            words.number(text::fixed(least_fixture->redundancy_number, 3)) + " (" + coordinate(*least_fixture) + ")");
        facts.emplace_back(words("label", "largest_bias_fixture"),
                           words.number(rounded_with_minus(largest_fixture->minimal_detectable_bias_um)) + " µm (" +
                               coordinate(*largest_fixture) + ")");
    }
    builder.definitions(facts);
    if (least != nullptr) {
        const HistogramPlot plot = redundancy_plot(r, words);
        builder.figure(plot.id, words("sentence", "figure_redundancy"), plot.description, svg(plot));
    }
    // Of every error motion the worst angle; the other quantities have one row each.
    std::vector<const ExternalReliability*> worst;
    for (const ExternalReliability& e : r.external_reliability) {
        const auto found =
            std::find_if(worst.begin(), worst.end(), [&](const auto* w) { return w->quantity == e.quantity; });
        if (found == worst.end()) {
            worst.push_back(&e);
        } else if (std::abs(e.ratio_to_U) > std::abs((*found)->ratio_to_U)) {
            *found = &e;
        }
    }
    if (!worst.empty()) {
        Rows rows;
        for (const ExternalReliability* e : worst) {
            rows.push_back({words.sentence(e->quantity), e->angle_deg ? plain(*e->angle_deg) : "",
                            rounded_with_minus(e->influence), gum::unit_for_people(e->unit),
                            rounded_with_minus(e->ratio_to_U), e->station, e->reflector, e->pass,
                            plain(e->at_angle_deg), detectable(e->minimal_detectable_bias_um)});
        }
        builder.table("external-reliability", words("sentence", "external_reliability"),
                      {{words("label", "quantity"), ""},
                       {words("label", "angle"), "°", true},
                       {words("label", "influence"), "", true},
                       {words("label", "unit"), ""},
                       {words("label", "ratio_to_U"), "", true},
                       {words("label", "station"), ""},
                       {words("label", "reflector"), ""},
                       {words("label", "pass"), ""},
                       {words("label", "angle"), "°", true},
                       {words("label", "detectable"), "µm", true}},
                      rows, {{words("label", "affected"), 5}, {words("label", "by_distance"), 5}});
    }
    if (!r.fixture_reliability.empty()) {
        const std::size_t most = builder.most(k_most_listed);
        Rows rows;
        for (const FixtureReliabilityRow& row : r.fixture_reliability) {
            if (rows.size() == most) {
                break;
            }
            rows.push_back({row.reflector, row.coordinate, rounded_with_minus(row.residual_um),
                            text::fixed(row.redundancy_number, 3), fixed_signed(row.test_value),
                            detectable(row.minimal_detectable_bias_um)});
        }
        builder.table("fixture-reliability", words("sentence", "fixture_reliability"),
                      {{words("label", "reflector"), ""},
                       {words("label", "coordinate"), ""},
                       {words("label", "residual"), "µm", true},
                       {words("label", "redundancy_number"), "", true},
                       {words("label", "test_value"), "", true},
                       {words("label", "detectable"), "µm", true}},
                      rows);
        if (r.fixture_reliability.size() > most) {
            builder.paragraph(
                words.fill("more_in_record", {{"count", std::to_string(r.fixture_reliability.size() - most)}}));
        }
    }
}

void geometry(CertificateBuilder& builder, const Wording& words, const RotaryTable& r) {
    builder.section("geometry");
    if (const std::optional<LayoutPlot> plot = layout_plot(r, words)) {
        layout_figure(builder, words, *plot, "figure_layout", layout_magnification(*plot).stations);
    }
    Rows rows;
    for (const Station& s : r.stations) {
        rows.push_back(coordinates(s.name, s.printed_position, s.printed_U));
        rows.back().push_back(s.printed_scale.value);
        rows.back().push_back(s.printed_scale.U);
    }
    std::vector<Column> columns = coordinate_columns(words, words("label", "station"));
    columns.push_back({words("label", "scale"), "10⁻⁶", true});
    columns.push_back({words("label", "U"), "10⁻⁶", true});
    builder.table("stations", words("sentence", "stations"), columns, rows);

    rows.clear();
    for (const DeadPath& d : r.dead_paths) {
        rows.push_back({d.name, d.printed.value, d.printed.U});
    }
    builder.table("dead-paths", words("sentence", "dead_paths"),
                  {{words("label", "dead_path"), ""}, {"l0", "mm", true}, {words("label", "U"), "mm", true}}, rows);

    if (const std::optional<LayoutPlot> plot = reflector_plot(r, words)) {
        layout_figure(builder, words, *plot, "figure_reflectors", layout_magnification(*plot).reflectors);
    }
    rows.clear();
    for (const Reflector& m : r.reflectors) {
        rows.push_back(coordinates(m.name, m.printed_position, m.printed_U));
        for (std::size_t c = 0; c < 3; ++c) {
            rows.back().push_back(c < m.printed_correction.size() ? m.printed_correction[c] : "");
        }
    }
    columns = coordinate_columns(words, words("label", "reflector"));
    for (const char* c : {"Δx", "Δy", "Δz"}) {
        columns.push_back({c, "µm", true});
    }
    builder.table("reflectors", words("sentence", "reflectors"), columns, rows);
}

}  // namespace gumcert::reports
