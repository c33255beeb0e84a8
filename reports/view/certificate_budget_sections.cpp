#include "reports/view/certificate_budget_sections.h"

#include "certificate/point_names.h"
#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/plots/budget_plots.h"
#include "reports/plots/svg_plot.h"
#include "reports/point_headings.h"
#include "reports/printed_texts.h"
#include "reports/record/record_sections.h"
#include "reports/record/reported_result.h"
#include "reports/reported_results.h"
#include "reports/result_names.h"
#include "text/numbers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

constexpr std::size_t k_most_budgets = 12;
constexpr std::size_t k_most_inputs = 60;
constexpr std::size_t k_most_plots = 4;
constexpr std::size_t k_most_names = 6;
constexpr std::size_t k_most_data = 200;      // rows of the data of a fit
constexpr std::size_t k_most_readings = 500;  // that are listed one by one
constexpr std::size_t k_most_correlated = 8;  // more columns of a matrix do not fit on a page

/// A number that has no printed form in the record, with two significant digits.
std::string rounded(double v) {
    return gum::round_significant(v, 2);
}

/// True for a unit that is one name, without operators and powers.
bool is_simple(const std::string& unit) {
    return !unit.empty() && unit.find_first_of(" /*.()-^0123456789") == std::string::npos &&
           unit.find("·") == std::string::npos && unit.find("⁻") == std::string::npos &&
           unit.find("²") == std::string::npos && unit.find("³") == std::string::npos;
}

/// "25 nm" with a blank that does not break, or the number alone.
/// \param people  a unit for people; "1/K" becomes "K⁻¹", because a 1 would stand beside the number
std::string with_unit(const std::string& number, const std::string& people) {
    if (number.empty() || people.empty()) {
        return number;
    }
    const bool reciprocal = people.starts_with("1/") && is_simple(people.substr(2));
    return number + "\u00A0" + (reciprocal ? people.substr(2) + "⁻¹" : people);
}

/// An equation as a job writes it, with the signs of printed mathematics: "a − b·c" for "a - b*c".
/// Of the whole exponent of a power that begins here, "^2" or "**-1": its superscript and how many signs it has; else none, as of
/// "^2.5" and "^2^x".
std::pair<std::string, std::size_t> whole_exponent(std::string_view equation) {
    static constexpr std::array<const char*, 10> k_superscripts = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::size_t at = equation.starts_with('^') ? 1 : equation.starts_with("**") ? 2 : 0;
    if (at == 0) {
        return {};
    }
    std::string raised;
    if (equation.substr(at).starts_with('-')) {
        raised = "⁻";
        ++at;
    }
    const std::size_t first = at;
    for (; at < equation.size() && equation[at] >= '0' && equation[at] <= '9'; ++at) {
        raised += k_superscripts.at(static_cast<std::size_t>(equation[at] - '0'));
    }
    const std::string_view behind = equation.substr(at);
    const std::string_view next = behind.substr(std::min(behind.find_first_not_of(' '), behind.size()));
    const bool ends = behind.empty() || std::string_view(" +-*/),;=<>").find(behind.front()) != std::string_view::npos;
    const bool is_power_again = next.starts_with('^') || next.starts_with("**");
    return at > first && ends && !is_power_again ? std::pair(raised, at) : std::pair(std::string(), std::size_t{0});
}

std::string equation_for_people(const std::string& equation) {
    std::string out;
    for (std::size_t i = 0; i < equation.size(); ++i) {
        if (const auto [raised, signs] = whole_exponent(std::string_view(equation).substr(i)); signs > 0) {
            out += raised;
            i += signs - 1;
            continue;
        }
        const bool exponent = i > 1 && (equation[i - 1] == 'e' || equation[i - 1] == 'E') && equation[i - 2] >= '0' &&
                              equation[i - 2] <= '9';  // of a number: "1e-5"
        if (equation[i] == '*' && i + 1 < equation.size() && equation[i + 1] == '*') {
            out += equation[i++];  // a power, both stars as they are
            out += equation[i];
        } else if (equation[i] == '*') {
            out += "·";
        } else {
            out += equation[i] == '-' && !exponent ? "\u2212" : std::string(1, equation[i]);
        }
    }
    return out;
}

/// Of "min(1,2)", which would read as 1.2.
bool has_comma_between_digits(const std::string& text) {
    const auto is_digit = [&](std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
    for (std::size_t at = text.find(','); at != std::string::npos; at = text.find(',', at + 1)) {
        if (at > 0 && is_digit(at - 1) && is_digit(at + 1)) {
            return true;
        }
    }
    return false;
}

/// With the decimal sign of the document. Where that is a comma, semicolons part the arguments of a function.
std::string equation_for_people(const std::string& equation, const Wording& words) {
    std::string shown = equation_for_people(equation);
    const bool has_decimals = with_decimal_sign(shown, ",") != shown || has_comma_between_digits(shown);
    if (has_decimals && words.decimal_sign() == ",") {
        std::replace(shown.begin(), shown.end(), ',', ';');
    }
    return with_decimal_sign(shown, words.decimal_sign());
}

/// "K²", "(nm/K)²", "" of a unit for people.
std::string squared(const std::string& people) {
    return people.empty() ? "" : is_simple(people) ? people + "²" : "(" + people + ")²";
}

/// "a, b and 3 more"
Text listed(const std::vector<std::string>& names, const Wording& words) {
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), k_most_names); ++i) {
        text += (i == 0 ? "" : ", ") + names[i];
    }
    return names.size() <= k_most_names
               ? Text(text)
               : words.fill("and_more", {{"names", text}, {"count", std::to_string(names.size() - k_most_names)}});
}

/// Results whose coverage is stated by one sentence.
struct CoverageGroup {
    std::string
        kind;  ///< as `coverage`, but "student_t" for a normal distribution as well, "exact" for U = 0 without k
    double probability = 0.0;
    std::vector<const Result*> results;
};

/// A figure; where its numbers are of a size that no plot can show, a sentence: a sound record is always printed.
template <class AnyPlot>
void draw(CertificateBuilder& builder, const Wording& words, const Text& caption, const AnyPlot& plot) {
    std::string drawing;
    try {
        drawing = svg(plot);
    } catch (const gum::NoResultError& refused) {
        if (refused.diagnostics().front().code != "GC-REPORT-0003") {
            throw;
        }
        builder.paragraph(words.fill("figure_left_out", {{"caption", caption}}));
        return;
    }
    builder.figure(plot.id, caption, plot.description, drawing);
}

/// What the job describes a result as; else what the tables of its certificate call it; "" where nothing does.
Text meaning_of(const Result& r, const EvaluationRecord& record, const Wording& words) {
    if (!r.description_by_language.empty()) {
        return words.localised(r.description_by_language);
    }
    if (!r.description.empty() || !record.certificate) {
        return described_result(r.description, words);
    }
    for (const certificate::CertifiedTable& table : record.certificate->tables) {
        for (std::size_t i = 0; table.layout && i < table.layout->shown.size(); ++i) {
            const certificate::ShownColumn& shown = table.layout->shown[i];
            if (shown.show == "value" && shown.of == r.quantity && !(shown.role.empty() && shown.heading.empty())) {
                return heading_of_shown(table, shown, words);
            }
        }
    }
    return {};
}

/// What the tables of a certificate show at the point of a result in place of its number; "" where they print that.
Text point_in_tables(const Result& r, const EvaluationRecord& record, const Wording& words) {
    if (r.quantity.empty() || !record.certificate) {
        return {};
    }
    const auto points = certificate::identities_of_rows(record.certificate->tables);
    const auto point = points.find(r.point);
    const bool is_named = point != points.end() && point->second.results.contains(r.quantity);
    return is_named ? point_in_words(point->second.name, words) : Text();
}

/// "E[1] (error of indication, 100 mV)": a caption stands for itself.
Text name_in_caption(const Result& r, const EvaluationRecord& record, const Wording& words) {
    Text inside = meaning_of(r, record, words);
    if (const Text point = point_in_tables(r, record, words); !point.empty()) {
        inside += (inside.empty() ? Text() : words("document", "enumeration")) + point;
    }
    return inside.empty() ? Text(r.name) : Text(r.name + " (") + inside + ")";
}

/// Of what is reported: "interval" where Monte Carlo gives one that U cannot stand for.
std::string coverage_kind(const Result& r) {
    const ReportedResult reported = reported_result(r);
    if (reported.method == "monte_carlo") {
        return reported.U ? "monte_carlo" : "interval";
    }
    if (reported.U && !reported.k) {
        return "exact";
    }
    return r.coverage == "normal" ? "student_t" : r.coverage;
}

std::vector<CoverageGroup> coverage_groups(const std::vector<Result>& results) {
    std::vector<CoverageGroup> groups;
    for (const Result& r : results) {
        const std::string kind = coverage_kind(r);
        const auto found = std::find_if(groups.begin(), groups.end(), [&](const CoverageGroup& g) {
            return g.kind == kind && (kind == "none" || g.probability == r.coverage_probability);
        });
        if (found == groups.end()) {
            groups.push_back({.kind = kind, .probability = r.coverage_probability, .results = {&r}});
        } else {
            found->results.push_back(&r);
        }
    }
    return groups;
}

/// "(a)", "(b)" …; "" where one sentence is for all.
std::string mark_of(const Result& r, const std::vector<CoverageGroup>& groups) {
    for (std::size_t i = 0; groups.size() > 1 && i < groups.size(); ++i) {
        if (std::find(groups[i].results.begin(), groups[i].results.end(), &r) != groups[i].results.end()) {
            return i < 26 ? std::string("(") + static_cast<char>('a' + i) + ")" : "(" + std::to_string(i + 1) + ")";
        }
    }
    return "";
}

/// The sentence that says what U means for the results of a group.
Text coverage_sentence(const CoverageGroup& group, const Wording& words) {
    const Text p = words.number(percent_text(group.probability));
    if (group.kind == "none") {
        return words("sentence", "coverage_none");
    }
    if (group.kind == "exact") {
        return words("statement", "exact_values");
    }
    std::optional<double> k_low;
    std::optional<double> k_high;
    std::optional<double> nu_low;
    bool nu_differs = false;
    const Text first_nu = degrees_of_freedom(group.results.front()->nu_eff, words);
    for (const Result* r : group.results) {
        if (const std::optional<double> k = reported_result(*r).k) {
            k_low = k_low ? std::min(*k_low, *k) : *k;
            k_high = k_high ? std::max(*k_high, *k) : *k;
        }
        if (r->nu_eff && r->coverage == "student_t") {
            nu_low = nu_low ? std::min(*nu_low, *r->nu_eff) : *r->nu_eff;
        }
        nu_differs = nu_differs || degrees_of_freedom(r->nu_eff, words) != first_nu;
    }
    Text k = "k";
    if (k_low) {
        const Text low = words.number(certificate::printed_coverage_factor(*k_low));
        const Text high = words.number(certificate::printed_coverage_factor(*k_high));
        k = low == high ? words.fill("k_one", {{"k", low}}) : words.fill("k_between", {{"low", low}, {"high", high}});
    }
    if (group.kind == "monte_carlo") {
        return words.fill("coverage_monte_carlo", {{"p", p}});
    }
    if (group.kind == "interval") {
        const Result& first = *group.results.front();
        return words.filled("statement", "uncertainty_interval",
                            {{"trials", words.number(first.monte_carlo ? first.monte_carlo->trials.text : "")},
                             {"kind", words("statement", "interval_symmetric")},
                             {"p", p}});
    }
    if (group.kind == "convolution") {
        return words.fill("coverage_convolution", {{"k", k}, {"p", p}});
    }
    if (!nu_low) {
        return words.fill("coverage_normal", {{"k", k}, {"p", p}});
    }
    const std::string low =
        nu_differs ? certificate::whole_degrees_of_freedom(*nu_low) : certificate::printed_degrees_of_freedom(nu_low);
    const Text nu = nu_differs && !low.starts_with('>') ? words.fill("nu_between", {{"low", low}})
                                                        : stated_degrees_of_freedom(low, words);
    return words.fill("coverage_student_t", {{"k", k}, {"nu_eff", nu}, {"p", p}});
}

void coverage(CertificateBuilder& builder, const Wording& words, const std::vector<Result>& results,
              const std::vector<CoverageGroup>& groups) {
    for (const CoverageGroup& group : groups) {
        const std::string mark = mark_of(*group.results.front(), groups);
        builder.paragraph((mark.empty() ? mark : mark + " ") + coverage_sentence(group, words));
    }
    for (const Text& sentence : reasons_for_monte_carlo(results, words)) {
        builder.paragraph(sentence);
    }
    std::vector<std::pair<std::string, std::vector<std::string>>> notes;
    for (const Result& r : results) {
        if (r.coverage_note.empty() || reported_result(r).method == "monte_carlo") {
            continue;
        }
        const auto found =
            std::find_if(notes.begin(), notes.end(), [&](const auto& note) { return note.first == r.coverage_note; });
        (found == notes.end() ? notes.emplace_back(r.coverage_note, std::vector<std::string>()) : *found)
            .second.push_back(r.name);
    }
    constexpr std::size_t k_most_notes = 12;
    for (std::size_t i = 0; i < std::min(notes.size(), k_most_notes); ++i) {
        builder.paragraph(words.fill(
            "coverage_note", {{"names", listed(notes[i].second, words)}, {"note", words.sentence(notes[i].first)}}));
    }
    if (notes.size() > k_most_notes) {
        builder.paragraph(words.fill("more_notes", {{"count", std::to_string(notes.size() - k_most_notes)}}));
    }
}

/// Results, or all points of one quantity.
struct ResultList {
    std::string quantity;
    std::vector<const Result*> results;
};

/// \param argument  label of the points, with its unit
void result_table(CertificateBuilder& builder, const Wording& words, const ResultList& list, std::size_t number,
                  const std::vector<CoverageGroup>& groups, const Column& argument) {
    const bool points = !list.quantity.empty();
    const std::string unit = list.results.front()->printed.unit;
    const double p = list.results.front()->coverage_probability;
    bool described = false;
    bool one_unit = points;
    bool without_U = false;
    bool with_U = false;
    bool with_interval = false;
    bool one_p = true;
    std::vector<ReportedResult> reported;
    for (const Result* r : list.results) {
        reported.push_back(reported_result(*r));
        const ReportedResult& of = reported.back();
        described = described || (!points && !r->description.empty());
        one_unit = one_unit && r->printed.unit == unit;
        without_U = without_U || of.printed.U.empty();
        with_U = with_U || !of.printed.U.empty() || of.printed_low.empty();
        with_interval = with_interval || !of.printed_low.empty();
        one_p = one_p && r->coverage_probability == p;
    }
    std::vector<Column> columns = {points ? argument : Column{words("label", "name"), ""}};
    if (described) {
        columns.push_back({words("label", "description"), ""});
    }
    const std::string head_unit = one_unit ? unit : "";
    columns.push_back({words("label", "value"), head_unit, true});
    if (with_U) {
        columns.push_back({words("label", "U"), head_unit, true});
    }
    if (without_U) {
        columns.push_back({words("label", "u"), head_unit, true});
    }
    if (with_interval) {
        columns.push_back({words("label", "low"), head_unit, true});
        columns.push_back({words("label", "high"), head_unit, true});
    }
    if (!one_unit) {
        columns.push_back({words("label", "unit"), ""});
    }
    if (with_U) {
        columns.push_back({words("label", "k"), "", true});
        columns.push_back({words("label", "nu_eff"), "", true});
    }
    if (!one_p) {
        columns.push_back({words("label", "p"), "", true});
    }
    if (groups.size() > 1) {
        columns.push_back({words("label", "coverage_mark"), ""});
    }
    Rows rows;
    for (std::size_t i = 0; i < list.results.size(); ++i) {
        const Result* r = list.results[i];
        const ReportedResult& of = reported[i];
        std::vector<Text> row = {points ? r->point : r->name};
        if (described) {
            row.push_back(r->description_by_language.empty() ? described_result(r->description, words)
                                                             : words.localised(r->description_by_language));
        }
        row.push_back(of.printed.value);
        if (with_U) {
            row.push_back(of.printed.U);
        }
        if (without_U) {
            row.push_back(of.printed_u);
        }
        if (with_interval) {
            row.push_back(of.printed_low);
            row.push_back(of.printed_high);
        }
        if (!one_unit) {
            row.push_back(r->printed.unit);
        }
        if (with_U) {
            row.push_back(of.k ? certificate::printed_coverage_factor(*of.k) : "");
            row.push_back(of.method == "monte_carlo"                      ? Text()
                          : coverage_kind(*r) == "student_t" || r->nu_eff ? degrees_of_freedom(r->nu_eff, words)
                                                                          : Text());
        }
        if (!one_p) {
            row.push_back(percent_text(r->coverage_probability));
        }
        if (groups.size() > 1) {
            row.push_back(mark_of(*r, groups));
        }
        rows.push_back(std::move(row));
    }
    builder.table(
        "results-" + std::to_string(number),
        points ? words.fill("results_points", {{"quantity", list.quantity}}) : words("sentence", "results_list"),
        columns, rows);
}

void results(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    builder.section("results");
    const std::vector<CoverageGroup> groups = coverage_groups(record.results);
    std::vector<ResultList> lists;
    for (const Result& r : record.results) {
        const std::string quantity = r.point.empty() ? "" : r.quantity.empty() ? r.name : r.quantity;
        const auto found =
            std::find_if(lists.begin(), lists.end(), [&](const ResultList& l) { return l.quantity == quantity; });
        (found == lists.end() ? lists.emplace_back(ResultList{.quantity = quantity, .results = {}}) : *found)
            .results.push_back(&r);
    }
    const Column argument = record.circle_closure ? Column{words("label", "angle"), gum::unit_for_people("deg"), true}
                                                  : Column{words("label", "point"), ""};
    for (std::size_t i = 0; i < lists.size(); ++i) {
        result_table(builder, words, lists[i], i, groups, argument);
    }
    coverage(builder, words, record.results, groups);
    builder.paragraph(words("sentence", "validity"));
}

void model(CertificateBuilder& builder, const Wording& words, const ModelSummary& m,
           const std::vector<SectionSummary>& sections) {
    builder.section("model");
    builder.paragraph(words("sentence", m.equations.size() == 1 ? "model_one" : "model"));
    std::size_t section = 0;
    std::int64_t left = 0;  // equations of the section
    for (const std::string& equation : m.equations) {
        while (left == 0 && section < sections.size()) {
            const SectionSummary& next = sections[section++];
            left = next.equations;
            if (left > 0) {
                builder.paragraph(words.localised(title_of(next)) + ":");
            }
        }
        --left;
        builder.formula(equation_for_people(equation, words));
    }
    if (!m.unknowns.empty()) {
        std::string names;
        for (const std::string& unknown : m.unknowns) {
            names += (names.empty() ? "" : ", ") + unknown;
        }
        builder.paragraph(words.fill("unknowns", {{"names", names}}));
    }
}

/// The input quantities with what they are. A budget names them by their symbols only.
void input_quantities(CertificateBuilder& builder, const Wording& words, const std::vector<InputQuantity>& inputs) {
    const bool described =
        std::any_of(inputs.begin(), inputs.end(), [](const InputQuantity& q) { return !q.description.empty(); });
    if (!described) {
        return;
    }
    builder.section("input_quantities");
    Rows rows;
    const std::size_t most = builder.most(k_most_inputs);
    for (std::size_t i = 0; i < std::min(inputs.size(), most); ++i) {
        const std::string unit = gum::unit_for_people(inputs[i].unit);
        rows.push_back({inputs[i].name, words.localised(inputs[i].description), unit.empty() ? "1" : unit});
    }
    builder.table("input-quantities", words("sentence", "input_quantities"),
                  {{words("label", "quantity"), ""}, {words("label", "description"), ""}, {words("label", "unit"), ""}},
                  rows);
    if (inputs.size() > most) {
        builder.paragraph(words.fill("more_in_record", {{"count", std::to_string(inputs.size() - most)}}));
    }
}

/// Unit of a difference; a unit that nothing is known of stays as it is.
std::string difference_unit(const std::string& unit) {
    return unit == "degC" || unit == "celsius" || unit == "Celsius" || unit == "°C" ? "K"
           : unit == "degF"                                                         ? "delta_degF"
                                                                                    : unit;
}

/// Unit of a sensitivity coefficient, for people: what the unit of the result is to that of the input.
std::string sensitivity_unit(const std::string& result, const std::string& input) {
    const std::string of = difference_unit(result);
    const std::string by = difference_unit(input);
    const auto is_one = [](const std::string& unit) { return unit.empty() || unit == "1"; };
    if (of == by) {
        return "";
    }
    const std::string above = gum::unit_for_people(of);
    const std::string below = gum::unit_for_people(by);
    if (is_one(by)) {
        return above;
    }
    if (by.starts_with("1/") && is_simple(by.substr(2))) {
        const std::string factor = gum::unit_for_people(by.substr(2));
        return is_one(of) ? factor : above + "·" + factor;
    }
    if (!is_one(of) && by.starts_with(of + "/") && is_simple(by.substr(of.size() + 1))) {
        return gum::unit_for_people(by.substr(of.size() + 1));
    }
    return (is_one(of)         ? "1"
            : is_simple(above) ? above
                               : "(" + above + ")") +
           "/" + (is_simple(below) ? below : "(" + below + ")");
}

/// "A", "B", or "A, B" of an input that is a sum.
std::string type_of(const BudgetRow& row) {
    std::set<std::string> types;
    for (const BudgetRow& part : row.components) {
        types.insert(part.type);
    }
    return types.size() > 1 ? "A, B" : row.type;
}

std::vector<Text> budget_line(const BudgetRow& row, const Result& result, bool part, const Wording& words) {
    const auto bracketed = [&](const std::string& text) { return part && !text.empty() ? "(" + text + ")" : text; };
    return {name_of_budget_row(row, words),
            with_unit(row.value.text, gum::unit_for_people(row.unit)),
            with_unit(row.u.text, gum::unit_for_people(difference_unit(row.unit))),
            distribution_name(row.distribution, words),
            type_of(row),
            row.nu.text.empty() ? degrees_of_freedom(row.nu.number, words) : Text(row.nu.text),
            with_unit(row.sensitivity.text, sensitivity_unit(result.unit, row.unit)),
            bracketed(row.contribution.text),
            bracketed(row.share.text)};
}

/// \param name  of the result, for the caption
void budget(CertificateBuilder& builder, const Wording& words, const Result& result, const Text& name,
            std::size_t number) {
    Rows rows;
    std::vector<RowKind> kinds;
    for (const BudgetRow& row : result.budget) {
        rows.push_back(budget_line(row, result, false, words));
        kinds.push_back(RowKind::plain);
        for (const BudgetRow& part : row.components) {
            rows.push_back(budget_line(part, result, true, words));
            kinds.push_back(RowKind::part);
        }
    }
    if (result.correlation) {
        rows.push_back({words("label", "correlation"), "", "", "", "", "", "", result.correlation->printed_contribution,
                        result.correlation->share.text});
        kinds.push_back(RowKind::plain);
    }
    const bool nu_known = coverage_kind(result) == "student_t" || result.nu_eff;
    rows.push_back({result.name, with_unit(result.printed.value, result.printed.unit), "",
                    distribution_name(result.distribution, words), "",
                    nu_known ? degrees_of_freedom(result.nu_eff, words) : Text(), "", rounded(result.u), "100"});
    kinds.push_back(RowKind::closing);
    builder.table("budget-" + std::to_string(number), words.fill("budget_result", {{"name", name}}),
                  {{words("label", "quantity_x"), ""},
                   {words("label", "estimate_x"), "", true},
                   {words("label", "u_x"), "", true},
                   {words("label", "distribution"), ""},
                   {words("label", "type"), ""},
                   {words("label", "nu_x"), "", true},
                   {words("label", "c_x"), "", true},
                   {words("label", "u_y"), result.printed.unit, true},
                   {words("label", "share"), "%", true}},
                  rows, {}, kinds);
}

/// Where the uncertainties of the inputs come from: standards, instruments, certificates.
void sources(CertificateBuilder& builder, const Wording& words, const std::vector<const Result*>& shown) {
    Facts all;
    const auto add = [&](const Text& name, const Text& source) {
        const std::pair<Text, Text> entry(name, source);
        if (!source.empty() && std::find(all.begin(), all.end(), entry) == all.end()) {
            all.push_back(entry);
        }
    };
    for (const Result* result : shown) {
        for (const BudgetRow& row : result->budget) {
            add(name_of_budget_row(row, words), source_of_budget_row(row, words));
            for (const BudgetRow& part : row.components) {
                add(Text(row.input + ": ") + name_of_budget_row(part, words), source_of_budget_row(part, words));
            }
        }
    }
    if (!all.empty()) {
        builder.paragraph(words("sentence", "sources"));
        builder.definitions(all);
    }
}

/// \param tables_only  without figures and sources
void budgets(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record, bool tables_only) {
    std::vector<const Result*> with_budget;
    bool parts = false;
    bool fitted = false;
    bool correlated = false;
    for (const Result& r : record.results) {
        if (!r.budget.empty()) {
            with_budget.push_back(&r);
            correlated = correlated || r.correlation.has_value();
            for (const BudgetRow& row : r.budget) {
                parts = parts || !row.components.empty();
                fitted = fitted || row.role == "fit";
            }
        }
    }
    if (with_budget.empty()) {
        return;
    }
    builder.section("uncertainty");
    builder.paragraph(words("sentence", "budget"));
    if (parts) {
        builder.paragraph(words("sentence", "budget_parts"));
    }
    if (fitted) {
        builder.paragraph(words("sentence", "budget_fit"));
    }
    if (correlated) {
        builder.paragraph(words("sentence", "budget_correlation"));
    }
    const std::size_t count = with_budget.size();
    const std::size_t most = builder.most(k_most_budgets);
    if (count > most) {
        with_budget.resize(most);
        builder.paragraph(
            words.fill("first_budgets", {{"shown", std::to_string(most)}, {"count", std::to_string(count)}}));
    }
    for (std::size_t i = 0; i < with_budget.size(); ++i) {
        const Text name = name_in_caption(*with_budget[i], record, words);
        budget(builder, words, *with_budget[i], name, i);
        if (!tables_only && i < k_most_plots && with_budget[i]->budget.size() > 1) {
            // An input whose first derivative vanishes has no share by the law, and may be most of what trials give.
            const bool by_trials = reported_result(*with_budget[i]).method == "monte_carlo";
            draw(builder, words, words.fill(by_trials ? "figure_shares_of_law" : "figure_shares", {{"name", name}}),
                 share_plot(*with_budget[i], words, "plot-shares-" + std::to_string(i)));
        }
    }
    if (!tables_only) {
        sources(builder, words, with_budget);
    }
}

void second_order(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    Rows rows;
    for (const Result& r : record.results) {
        if (r.second_order) {
            rows.push_back({r.name, r.second_order->first_order_u.text, r.second_order->u.text,
                            r.second_order->shift.text, r.printed.unit});
        }
    }
    if (rows.empty()) {
        return;
    }
    builder.section("second_order");
    builder.paragraph(words("sentence", "second_order"));
    builder.table("second-order", words("sentence", "second_order_table"),
                  {{words("label", "name"), ""},
                   {words("label", "u_first"), "", true},
                   {words("label", "u_second"), "", true},
                   {words("label", "shift"), "", true},
                   {words("label", "unit"), ""}},
                  rows);
}

const char* verdict_of(const GufValidation& v) {
    return !v.precise_enough ? "not_precise" : v.validated ? "validated" : "not_validated";
}

/// \param name  of the result, for captions
void monte_carlo_of(CertificateBuilder& builder, const Wording& words, const Result& result, const Text& name,
                    std::size_t number) {
    const MonteCarloSummary& m = *result.monte_carlo;
    const auto& error = m.numerical_error;
    const Text p = words.number(percent_text(result.coverage_probability));
    const std::string id = std::to_string(number);
    builder.table(
        "monte-carlo-" + id,
        words.fill(
            "monte_carlo_table",
            {{"name", name}, {"trials", words.number(m.trials.text)}, {"seed", std::to_string(m.seed)}, {"p", p}}),
        {{words("label", "quantity"), ""},
         {words("label", "value"), result.printed.unit, true},
         {words("label", "numerical_error"), result.printed.unit, true}},
        {{words("label", "mean_trials"), m.mean.text, m.mean.number && m.u.number ? rounded(error.mean) : ""},
         {words("label", "u_trials"), m.u.text, m.u.number ? rounded(error.u) : ""},
         {words("label", "symmetric_low"), m.symmetric.text[0], rounded(error.symmetric[0])},
         {words("label", "symmetric_high"), m.symmetric.text[1], rounded(error.symmetric[1])},
         {words("label", "shortest_low"), m.shortest.text[0], rounded(error.shortest[0])},
         {words("label", "shortest_high"), m.shortest.text[1], rounded(error.shortest[1])}});
    if (!m.u.number) {
        const bool by_trials = reported_result(result).method == "monte_carlo";
        builder.paragraph(words("sentence", by_trials ? "no_moments" : "no_moments_beside"));
    }
    if (m.adaptive) {
        builder.paragraph(words("sentence", m.stabilised ? "stabilised" : "not_stabilised"));
    }
    if (m.validation) {
        const GufValidation& v = *m.validation;
        builder.paragraph(
            words.fill(verdict_of(v), {{"name", result.name},
                                       {"d_low", words.number(with_unit(v.d_low.text, result.printed.unit))},
                                       {"d_high", words.number(with_unit(v.d_high.text, result.printed.unit))},
                                       {"delta", words.number(with_unit(v.delta.text, result.printed.unit))},
                                       {"digits", std::to_string(v.digits)},
                                       {"interval", words("value", "interval", v.interval)}}));
    }
    if (!m.histogram.empty() && number < k_most_plots) {
        draw(builder, words, words.fill("figure_monte_carlo", {{"name", name}}),
             monte_carlo_plot(result, words, "plot-monte-carlo-" + id));
    }
}

void monte_carlo(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    std::vector<const Result*> all;
    for (const Result& r : record.results) {
        if (r.monte_carlo) {
            all.push_back(&r);
        }
    }
    if (all.empty()) {
        return;
    }
    builder.section("monte_carlo");
    builder.paragraph(words("sentence", "monte_carlo"));
    const bool few = all.size() <= builder.most(k_most_budgets);
    for (std::size_t i = 0; i < (few ? all.size() : 0); ++i) {
        monte_carlo_of(builder, words, *all[i], name_in_caption(*all[i], record, words), i);
    }
    if (few) {
        return;
    }
    Rows rows;
    std::map<std::string, std::size_t> verdicts;
    for (const Result* r : all) {
        const MonteCarloSummary& m = *r->monte_carlo;
        const std::string verdict = m.validation ? verdict_of(*m.validation) : "";
        ++verdicts[verdict];
        rows.push_back({r->name, m.trials.text, m.mean.text, m.u.text, m.symmetric.text[0], m.symmetric.text[1],
                        m.shortest.text[0], m.shortest.text[1], r->printed.unit,
                        verdict.empty() ? Text() : words("value", "verdict", verdict)});
    }
    builder.table("monte-carlo", words("sentence", "monte_carlo_list"),
                  {{words("label", "name"), ""},
                   {words("label", "trials"), "", true},
                   {words("label", "mean_short"), "", true},
                   {words("label", "u"), "", true},
                   {words("label", "low"), "", true},
                   {words("label", "high"), "", true},
                   {words("label", "low"), "", true},
                   {words("label", "high"), "", true},
                   {words("label", "unit"), ""},
                   {words("label", "verdict"), ""}},
                  rows, {{"", 4}, {words("label", "symmetric"), 2}, {words("label", "shortest"), 2}, {"", 2}});
    if (verdicts.size() > 1 || !verdicts.contains("")) {
        builder.paragraph(words.fill("verdict_counts", {{"validated", std::to_string(verdicts["validated"])},
                                                        {"not_validated", std::to_string(verdicts["not_validated"])},
                                                        {"not_precise", std::to_string(verdicts["not_precise"])}}));
    }
}

void region(CertificateBuilder& builder, const Wording& words, const CoverageRegion& r) {
    builder.paragraph(words.fill("region", {{"p", words.number(percent_text(r.coverage_probability))},
                                            {"from", words("value", "region_from", r.from)}}));
    Facts rows = {{words("label", "ellipsoid"),
                   r.k_p.number ? words.fill("ellipsoid", {{"k_p", words.number(r.k_p.text)}})
                                : words("sentence", r.no_k_p_because == "distribution" ? "no_ellipsoid_distribution"
                                                                                       : "no_ellipsoid")},
                  {words("label", "parallelepiped"),
                   r.k_q.number ? words.fill("parallelepiped", {{"k_q", words.number(r.k_q.text)}})
                                : words("sentence", "no_parallelepiped")}};
    if (r.degrees_of_freedom) {
        rows.emplace_back(words("label", "region_nu"), degrees_of_freedom(r.degrees_of_freedom, words));
    }
    if (r.smallest_region) {
        rows.emplace_back(
            words("label", "smallest_region"),
            words.fill("smallest_region", {{"volume", words.number(rounded(r.smallest_region->volume))},
                                           {"cells", std::to_string(r.smallest_region->cells)},
                                           {"p", words.number(percent_text(r.smallest_region->probability))}}));
    }
    builder.definitions(rows);
    if (r.validation) {
        builder.paragraph(words("sentence", r.validation->validated ? "jointly_validated" : "not_jointly_validated"));
    }
}

void joint(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    if (!record.covariance && !record.region) {
        return;
    }
    builder.section("joint");
    if (record.covariance) {
        const ResultCovariance& c = *record.covariance;
        if (!c.file.empty()) {
            builder.paragraph(words.fill("covariance", {{"file", c.file}}));
        } else if (c.names.size() > k_most_correlated) {
            builder.paragraph(words.fill("covariance_in_record", {{"count", std::to_string(c.names.size())}}));
        } else {
            std::vector<Column> columns = {{words("label", "name"), ""}};
            Rows rows;
            for (std::size_t i = 0; i < c.names.size(); ++i) {
                columns.push_back({c.names[i], "", true});
                rows.push_back({c.names[i]});
                rows.back().insert(rows.back().end(), c.correlation.text[i].begin(), c.correlation.text[i].end());
            }
            builder.table("correlation", words("sentence", "correlation_table"), columns, rows);
        }
    }
    if (record.region) {
        region(builder, words, *record.region);
    }
}

/// The data that a fit rests on, one observation a row.
void fit_data(CertificateBuilder& builder, const Wording& words, const FitSummary& f, const std::string& id) {
    const std::size_t n = f.y.text.size();
    if (n == 0) {
        return;
    }
    std::vector<Column> columns = {{"i", "", true}};
    std::vector<const std::vector<std::string>*> cells;
    const auto add = [&](const Text& head, const std::string& unit, const std::vector<std::string>& printed) {
        if (!printed.empty()) {
            columns.push_back({head, gum::unit_for_people(unit), true});
            cells.push_back(&printed);
        }
    };
    const auto add_with_u = [&](const std::string& name, const std::string& unit,
                                const std::vector<std::string>& values, const std::vector<std::string>& u) {
        add(name, unit, values);
        add(words.filled("label", "u_of", {{"name", name}}), difference_unit(unit), u);
    };
    add_with_u(f.x_name, f.x_unit, f.x.text, f.u_x.text);
    for (const FitSummary::Regressor& regressor : f.regressors) {
        add(regressor.name, regressor.unit, regressor.values.text);
    }
    add_with_u(f.y_name, f.y_unit, f.y.text, f.u_y.text);
    add(words("label", "residual_short"), difference_unit(f.y_unit), f.residual.text);
    Rows rows;
    const std::size_t most = builder.most(k_most_data);
    for (std::size_t i = 0; i < std::min(n, most); ++i) {
        std::vector<Text> row = {std::to_string(i + 1)};
        for (const std::vector<std::string>* column : cells) {
            row.emplace_back((*column)[i]);
        }
        rows.push_back(std::move(row));
    }
    builder.table("fit-data-" + id, words.fill("fit_data", {{"name", f.name}}), columns, rows);
    if (n > most) {
        builder.paragraph(
            words.fill("fit_data_first", {{"shown", std::to_string(most)}, {"count", std::to_string(n)}}));
    }
}

void fit(CertificateBuilder& builder, const Wording& words, const FitSummary& f, std::size_t number) {
    const bool weighted = f.method != "ordinary";
    builder.paragraph(words.fill("fit", {{"name", f.name}, {"method", words("value", "fit_method", f.method)}}));
    builder.formula(equation_for_people(f.equation, words));
    std::vector<Column> columns = {{words("label", "parameter"), ""},
                                   {words("label", "value"), "", true},
                                   {words("label", "u"), "", true},
                                   {words("label", "unit"), ""}};
    const bool correlated = f.parameters.size() > 1 && f.parameters.size() <= k_most_correlated - 2;
    Rows rows;
    for (std::size_t i = 0; i < f.parameters.size(); ++i) {
        const FitSummary::Parameter& parameter = f.parameters[i];
        rows.push_back({parameter.name, parameter.value.text, parameter.u.text, parameter.printed_unit});
        if (correlated) {
            columns.push_back({words.filled("label", "r_with", {{"name", parameter.name}}), "", true});
            for (std::size_t j = 0; j < f.parameters.size(); ++j) {
                rows.back().push_back(i == j ? "1" : gum::round_to_quantum(f.correlation[i][j], 4));
            }
        }
    }
    const std::string id = std::to_string(number);
    builder.table("fit-" + id, words.fill("fit_table", {{"name", f.name}}), columns, rows);
    const std::string y_unit = gum::unit_for_people(f.y_unit);
    Facts facts = {{words("label", "observations_of_fit"), std::to_string(f.y.number.size())},
                   {words("label", "degrees_of_freedom"), text::fixed(f.degrees_of_freedom, 0)},
                   {words("label", weighted ? "residual_factor" : "residual_standard_deviation"),
                    words.number(with_unit(f.residual_standard_deviation.text, weighted ? "" : y_unit))},
                   {words("label", weighted ? "chi_square" : "sum_of_squares"),
                    words.number(with_unit(f.sum_of_squares.text, weighted ? "" : squared(y_unit)))}};
    if (f.p_value.number) {
        facts.emplace_back(words("label", "p_value"), words.number(f.p_value.text));
    }
    if (!f.consistency.empty()) {
        facts.emplace_back(words("label", "test_of_fit"), words("value", "consistency", f.consistency));
    }
    if (!f.r_squared.text.empty()) {
        facts.emplace_back(words("label", "r_squared"), words.number(f.r_squared.text));
    }
    facts.emplace_back(words("label", "fit_uncertainty"),
                       words("value", f.covariance_scaled ? "scaled_by_residuals" : "as_stated_uncertainties"));
    builder.definitions(facts);
    if (f.consistency == "refuted") {
        Text scaled;
        for (const FitSummary::Parameter& parameter : f.parameters) {
            scaled += (scaled.empty() ? Text() : words("document", "enumeration")) + "u(" + parameter.name +
                      ") = " + words.number(with_unit(parameter.scaled_u.text, parameter.printed_unit));
        }
        builder.paragraph(words.fill(
            "fit_refuted", {{"factor", words.number(f.residual_standard_deviation.text)}, {"scaled", scaled}}));
    }
    fit_data(builder, words, f, id);
    if (!f.residual.number.empty()) {
        draw(builder, words, words.fill("figure_residuals", {{"name", f.name}}),
             residual_plot(f, words, "plot-residuals-" + id));
    }
}

void fits(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    if (record.fits.empty()) {
        return;
    }
    builder.section("fits");
    for (std::size_t i = 0; i < record.fits.size(); ++i) {
        fit(builder, words, record.fits[i], i);
    }
}

std::string part_name(const std::string& input, const std::string& component) {
    return component.empty() ? input : input + ": " + component;
}

/// True where some points of a table state the readings themselves: each line names its point then.
template <typename Summary>
bool at_points(const std::vector<Summary>& all) {
    return std::any_of(all.begin(), all.end(), [](const Summary& r) { return !r.point.empty(); });
}

/// Readings of the job itself hold at all points that state none of their own.
Text point_name(const std::string& point, const Wording& words) {
    return point.empty() ? words("label", "other_points") : Text(point);
}

/// "x", "x: drift", "x, A" with the point where points state readings
Text set_name(const std::string& input, const std::string& component, const std::string& point, bool points,
              const Wording& words) {
    const Text name = part_name(input, component);
    return points ? name + words("document", "enumeration") + point_name(point, words) : name;
}

/// The readings one by one, unless there are too many for a document.
void readings_list(CertificateBuilder& builder, const Wording& words, const std::vector<ReadingsSummary>& all) {
    std::size_t count = 0;
    Facts facts;
    const bool points = at_points(all);
    for (const ReadingsSummary& r : all) {
        count += r.observations.size();
        std::string text;
        for (const std::string& reading : r.observations) {
            text += (text.empty() ? "" : "; ") + reading;
        }
        facts.emplace_back(set_name(r.input, r.component, r.point, points, words),
                           words.number(with_unit(text, gum::unit_for_people(r.unit))));
    }
    if (count > 0 && count <= builder.most(k_most_readings)) {
        builder.paragraph(words("sentence", "readings_list"));
        builder.definitions(facts);
    }
}

void outliers(CertificateBuilder& builder, const Wording& words, const std::vector<OutlyingReading>& all) {
    if (all.empty()) {
        return;
    }
    Rows rows;
    const bool points = at_points(all);
    for (const OutlyingReading& r : all) {
        const std::string number = (r.group > 0 ? std::to_string(r.group) + "." : "") + std::to_string(r.position);
        rows.push_back({set_name(r.input, r.component, r.point, points, words), number,
                        with_unit(r.value.text, gum::unit_for_people(r.unit)), r.G.text, r.p_value.text});
    }
    builder.table("outliers", words("sentence", "outliers"),
                  {{words("label", "input"), ""},
                   {"i", "", true},
                   {words("label", "value"), "", true},
                   {"G", "", true},
                   {words("label", "p_value_short"), "", true}},
                  rows);
}

void readings(CertificateBuilder& builder, const Wording& words, const std::vector<ReadingsSummary>& all) {
    const bool pooled =
        std::any_of(all.begin(), all.end(), [](const auto& r) { return r.pooled_standard_deviation.has_value(); });
    const bool points = at_points(all);
    Rows rows;
    for (const ReadingsSummary& r : all) {
        std::vector<Text> row = {part_name(r.input, r.component),
                                 plain(r.n),
                                 r.mean.text,
                                 r.standard_deviation.text,
                                 r.standard_deviation_of_mean.text,
                                 gum::unit_for_people(r.unit),
                                 r.printed_r1,
                                 r.autocorrelation_limit.text,
                                 words("value", r.dependent ? "dependent" : "independent")};
        if (pooled) {
            row.insert(row.begin() + 5, r.pooled_standard_deviation ? rounded(*r.pooled_standard_deviation) : "");
        }
        if (points) {
            row.insert(row.begin() + 1, point_name(r.point, words));
        }
        rows.push_back(std::move(row));
    }
    std::vector<Column> columns = {
        {words("label", "input"), ""},    {words("label", "n"), "", true},        {words("label", "mean"), "", true},
        {words("label", "s"), "", true},  {words("label", "s_mean"), "", true},   {words("label", "unit"), ""},
        {words("label", "r1"), "", true}, {words("label", "r1_limit"), "", true}, {words("label", "dependence"), ""}};
    if (pooled) {
        columns.insert(columns.begin() + 5, {words("label", "s_pooled"), "", true});
    }
    if (points) {
        columns.insert(columns.begin() + 1, {words("label", "point"), ""});
    }
    builder.table("readings", words("sentence", "readings"), columns, rows);
    readings_list(builder, words, all);
}

void variance_analysis(CertificateBuilder& builder, const Wording& words, const VarianceAnalysis& v, std::size_t number,
                       bool points) {
    const std::string unit = gum::unit_for_people(v.unit);
    builder.table(
        "anova-" + std::to_string(number),
        words.fill("anova", {{"name", set_name(v.input, v.component, v.point, points, words)},
                             {"groups", plain(v.groups)},
                             {"readings", plain(v.readings)}}),
        {{words("label", "variation"), ""},
         {words("label", "sum_of_squares_short"), squared(unit), true},
         {words("label", "nu"), "", true},
         {words("label", "mean_square"), squared(unit), true},
         {words("label", "F"), "", true},
         {words("label", "F_critical"), "", true},
         {words("label", "p_value_short"), "", true}},
        {{words("label", "between"), rounded(v.sum_of_squares_between),
          certificate::whole_degrees_of_freedom(v.degrees_of_freedom_between), v.printed_mean_square[0], v.F.text,
          v.F_critical.text, v.p_value.text},
         {words("label", "within"), rounded(v.sum_of_squares_within),
          certificate::whole_degrees_of_freedom(v.degrees_of_freedom_within), v.printed_mean_square[1], "", "", ""}});
    builder.definitions(
        {{words("label", "mean"), words.number(with_unit(v.mean.text, unit))},
         {words("label", "s_within"), words.number(with_unit(v.standard_deviation_within.text, unit))},
         {words("label", "s_group_means"), words.number(with_unit(v.standard_deviation_of_group_means.text, unit))},
         {words("label", "s_between"), words.number(with_unit(v.standard_deviation_between.text, unit))},
         {words("label", "u_with_between"), words.number(with_unit(rounded(v.u_with_between_effect), unit))},
         {words("label", "u_without_between"), words.number(with_unit(rounded(v.u_without_between_effect), unit))}});
    builder.paragraph(words("sentence", v.conclusion == "significant" ? "anova_significant" : "anova_not_significant"));
}

void type_a(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    if (record.readings.empty() && record.variance_analyses.empty()) {
        return;
    }
    builder.section("type_a");
    if (!record.readings.empty()) {
        readings(builder, words, record.readings);
    }
    const std::size_t analyses = record.variance_analyses.size();
    const std::size_t most = builder.most(k_most_budgets);
    for (std::size_t i = 0; i < std::min(analyses, most); ++i) {
        variance_analysis(builder, words, record.variance_analyses[i], i, at_points(record.variance_analyses));
    }
    if (analyses > most) {
        builder.paragraph(
            words.fill("anova_first", {{"shown", std::to_string(most)}, {"count", std::to_string(analyses)}}));
    }
    outliers(builder, words, record.outliers);
}

}  // namespace

void budget_results(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    results(builder, words, record);
}

void budget_tables(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    budgets(builder, words, record, true);
}

void budget_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    input_quantities(builder, words, record.inputs);
    if (record.model) {
        model(builder, words, *record.model, record.sections);
    }
    budgets(builder, words, record, false);
    second_order(builder, words, record);
    monte_carlo(builder, words, record);
    joint(builder, words, record);
    fits(builder, words, record);
    type_a(builder, words, record);
}

}  // namespace gumcert::reports
