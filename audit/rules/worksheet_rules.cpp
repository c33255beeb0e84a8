#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "audit/rules/read_cells.h"
#include "audit/rules/registry.h"
#include "audit/rules/row_edits.h"
#include "audit/rules/stated_outcome.h"
#include "audit/rules/worksheet_view.h"
#include "text/numbers.h"
#include "text/small_letters.h"
#include "workbook/formula_text.h"

namespace gumcert::audit {
namespace {

using workbook::CellKind;
using workbook::CellPlace;
using workbook::CellValue;
using workbook::Formula;
using workbook::FormulaNode;
using workbook::FormulaNodeKind;

constexpr Clause k_data_control{.text = "ISO/IEC 17025:2017, 7.11.2", .verified = true};
constexpr Clause k_data_transfer{.text = "ISO/IEC 17025:2017, 7.11.6", .verified = true};
constexpr Clause k_evaluation{.text = "ISO/IEC 17025:2017, 7.6", .verified = true};
constexpr Clause k_bounds_of_inputs{.text = "JCGM 100:2008, 4.3.7", .verified = true};

/// A finding about a cell.
AuditFinding finding_in(const std::string& place, Sentence what) {
    AuditFinding finding;
    finding.where = place;
    finding.what = std::move(what);
    return finding;
}

bool is_call(const FormulaNode& node, std::initializer_list<std::string_view> names) {
    return node.kind == FormulaNodeKind::call && std::find(names.begin(), names.end(), node.text) != names.end();
}
bool calls(const Formula& formula, std::initializer_list<std::string_view> names) {
    return calls_one_of(formula, names);
}

/// "=SQRT(B3)", as it stands in its cell.
std::string text_of(const WorksheetView& view, const SheetFormula& formula) {
    return "=" + workbook::find_cell(view.workbook().sheets[formula.cell.sheet], formula.cell.address)->formula;
}

bool says(const std::string& text, std::initializer_list<std::string_view> words) {
    const std::string lower = text::in_small_letters(text);
    return std::any_of(words.begin(), words.end(),
                       [&lower](std::string_view word) { return lower.find(word) != std::string::npos; });
}

/// The place of the cell that holds u of a row, or what it was divided from.
std::string place_of(const std::optional<StatedNumber>& number) {
    return number ? number->place : std::string();
}

// W01 -----------------------------------------------------------------------------------------------------------------

/// √ of a cell that is a root already, or of a root itself.
bool takes_root_twice(const WorksheetView& view, const SheetFormula& formula) {
    return std::any_of(formula.formula.nodes.begin(), formula.formula.nodes.end(), [&](const FormulaNode& node) {
        if (!is_call(node, {"SQRT"}) || node.children != 1) {
            return false;
        }
        const FormulaNode& inner = formula.formula.nodes[formula.formula.children_of(node)[0]];
        if (is_call(inner, {"SQRT"})) {
            return true;
        }
        const std::optional<CellPlace> cell = view.cell_of(formula, inner);
        const SheetFormula* read = cell ? view.formula_at(*cell) : nullptr;
        return read != nullptr && is_call(read->formula.nodes[read->formula.root()], {"SQRT"});
    });
}

/// The divisor that a row has: that of its column, or stated/u.
std::optional<double> divisor_of(const AuditedRow& row) {
    if (row.stated && row.used_u > 0.0 && row.stated->value != 0.0) {
        return std::abs(row.stated->value) / row.used_u;
    }
    return row.divisor ? std::optional(row.divisor->value) : std::nullopt;
}

void root_taken_twice(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for_each_row(subject, [&](const RowAt& at) {
        const std::string place = place_of(at.is.u);
        const SheetFormula* formula = view ? view->formula_at(place) : nullptr;
        const bool in_formula = formula != nullptr && takes_root_twice(*view, *formula);
        const std::optional<double> divisor = divisor_of(at.is);
        if (!in_formula) {
            return;
        }
        AuditFinding finding = finding_at(
            at, place.empty() ? "u" : place,
            say("the root of the divisor is taken twice: {divisor:number} divides, where the table says {distribution}",
                in_words(divisor.value_or(std::pow(3.0, 0.25))),
                at.is.shape_text.empty() ? say("nothing") : Sentence(at.is.shape_text)));
        if (at.is.divisor && at.is.stated) {
            const double u = std::abs(at.is.stated->value) / at.is.divisor->value;
            finding.expected = equals("u", in_words(u, at.is.unit));
            finding.correct = set_u(at.row, u);
        } else if (at.is.stated) {
            const double u = std::abs(at.is.stated->value) / std::numbers::sqrt3;
            finding.expected = equals("u", in_words(u, at.is.unit));
            finding.correct = set_u(at.row, u);
        }
        finding.actual = equals("u", in_words(at.is.used_u, at.is.unit));
        finding.evidence = {say("divisor {divisor:number}", in_words(divisor.value_or(0.0))),
                            say("column of divisors: {divisor:number}",
                                at.is.divisor ? Sentence(in_words(at.is.divisor->value)) : say("none"))};
        findings.add(std::move(finding));
    });
}

// W02 -----------------------------------------------------------------------------------------------------------------

struct Divisor {
    double value;
    Sentence name;
};
/// Those whose number does not say by itself what they are.
const std::array<Divisor, 7> k_divisors = {
    Divisor{1.7320508075688772, say("√3 (rectangular)")},  Divisor{2.449489742783178, say("√6 (triangular)")},
    Divisor{1.4142135623730951, say("√2 (arcsine)")},      Divisor{2.0, say("2 (normal, k = 2)")},
    Divisor{3.4641016151377544, say("√12 (a full step)")}, Divisor{2.23606797749979, "√5"},
    Divisor{1.3160740129524924, say("the root of √3")},
};

/// Whether a divisor is √n of readings: of a row of Type A, or where words, ν = n − 1 or a formula that counts say n
/// (JCGM 100:2008, 4.2.3). The distribution that stands beside it is that of their mean.
bool is_root_of_readings(const AuditedRow& row, const SheetFormula* divisor) {
    if (row.type_a.value_or(row.origin == Origin::readings)) {
        return true;
    }
    const double n = row.divisor->value * row.divisor->value;
    const auto is_n = [n](double count) { return is_about(count, n, 0.02); };
    const bool is_counted = divisor != nullptr && calls(divisor->formula, {"COUNT", "COUNTA", "ROWS"});
    return is_counted || (row.n && is_n(static_cast<double>(*row.n))) ||
           (row.averaged && is_n(static_cast<double>(*row.averaged))) ||
           (std::isfinite(row.used_nu) && is_n(row.used_nu + 1.0));
}

/// Whether the formula of what a row divides has divided by the divisor of its distribution already: "=0.006/SQRT(3)".
/// \param expected  divisor of the distribution
bool is_divided_in_formula(const AuditedRow& row, double expected, const std::optional<WorksheetView>& view) {
    const SheetFormula* maker = !view || !row.stated ? nullptr : view->maker_of(row.stated->place);
    if (maker == nullptr) {
        return false;
    }
    const std::vector<FormulaDivision> divisions = divisions_in(*view, *maker);
    return std::any_of(divisions.begin(), divisions.end(), [&](const FormulaDivision& one) {
        return one.by && (is_about(*one.by, expected, 2e-3) ||
                          (row.shape == Shape::rectangular && is_about(*one.by, std::sqrt(12.0), 2e-3)));
    });
}

/// The k that the words of a normal distribution state, "normal (k = 2)", as what is divided by; nothing where the words of
/// the row state U and k (U13), or where it is 1, which is said of what was divided already.
std::optional<double> k_of_distribution(const AuditedRow& row) {
    constexpr double k_none = 1.2;
    const bool has_U = row.origin == Origin::certificate && row.origin_value && row.certificate_k;
    return has_U || !row.distribution_k || *row.distribution_k < k_none ? std::nullopt : row.distribution_k;
}

/// Whether words of a row may say that its number is the distance of two limits.
bool names_a_width(const AuditedRow& row) {
    return says(words_of_row(row) + " " + row.shape_text,
                {"span of", "full width", "whole width", "total width", "full range", "spannweite", "spannbreite",
                 "gesamtbreite", "volle breite"});
}

void divisor_against_label(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for_each_row(subject, [&findings, &view](const RowAt& at) {
        if (!at.is.divisor || !(at.is.divisor->value > 0.0)) {
            return;
        }
        const double divisor = at.is.divisor->value;
        const std::optional<double> k = k_of_distribution(at.is);
        const std::optional<double> expected = k ? k : divisor_of_shape(at.is.shape);
        // 1.732 that is typed for √3 is 3E-5 off, and a cell does not say how many of its digits count.
        const double allowed = std::max(at.is.divisor->half_step, 2e-4 * divisor);
        Sentence known;
        for (const Divisor& other : k_divisors) {
            if (std::abs(other.value - divisor) <= allowed) {
                known = other.name;
            }
        }
        // √12 is right of a full width, and so are 2√6 and 2√2; whether the number is one, U08 asks.
        const std::optional<double> of_half = divisor_of_shape(at.is.shape);
        const bool full_step = of_half && is_about(divisor, 2.0 * *of_half, 2e-4);
        // √6 is right of a whole step where two readings make a difference (U09).
        const bool two_steps = at.is.shape == Shape::rectangular && at.is.origin == Origin::resolution &&
                               at.is.origin_value && at.is.stated && is_about(divisor, std::sqrt(6.0), 2e-4) &&
                               is_about(std::abs(at.is.stated->value), *at.is.origin_value, 1e-9);
        // 1.96 is near enough to a k of 2.
        const double allowed_of_k = std::max(allowed, 0.03 * divisor);
        const bool disagrees =
            expected ? std::abs(*expected - divisor) > (k ? allowed_of_k : allowed) && !full_step && !two_steps
                     : at.is.shape == Shape::normal && !known.empty() &&
                           (known.english().starts_with("√3") || known.english().starts_with("√6"));
        if (!disagrees || is_root_of_readings(at.is, view ? view->formula_at(place_of(at.is.divisor)) : nullptr)) {
            return;
        }
        const bool in_formula = expected && at.is.stated && is_divided_in_formula(at.is, *expected, view);
        const std::optional<double> by_words = expected && at.is.origin_value ? u_by_words(at.is) : std::nullopt;
        // The number of the words itself has not been divided.
        const bool is_number_of_words =
            at.is.stated && at.is.origin_value && is_about(std::abs(at.is.stated->value), *at.is.origin_value, 1e-9);
        const bool is_u_of_words = by_words && !is_number_of_words && may_be_u(at.is, *by_words);
        if (divisor == 1.0 && (is_u_of_words || in_formula)) {
            return;  // a standard uncertainty already: nothing is left to divide
        }
        AuditFinding finding = finding_at(
            at, at.is.divisor->place.empty() ? "divisor" : at.is.divisor->place,
            known.empty()
                ? say("the divisor {divisor:number} is not that of the distribution \"{distribution}\"",
                      in_words(divisor), at.is.shape_text)
                : say("the divisor {divisor:number} is not that of the distribution \"{distribution}\": it is {known}",
                      in_words(divisor), at.is.shape_text, known));
        finding.actual = say_number(in_words(divisor));
        finding.evidence = {equals(say("divisor"), text::shortest(divisor)),
                            say("distribution: {distribution}", at.is.shape_text)};
        // u itself may have been divided by the right number.
        const bool is_divided_so =
            expected && at.is.stated && may_be_u(at.is, std::abs(at.is.stated->value) / *expected);
        if (is_divided_so || is_u_of_words) {
            finding.expected = say_number(text::significant(*expected, 6));
            findings.add(std::move(finding), FindingSeverity::minor);
            return;
        }
        // From what is divided, for a printed u has been rounded; as a factor, for that number may be wrong itself.
        const auto correct = [&at](const std::optional<double>& u, double factor) {
            return u && at.is.used_u > 0.0 ? change_u(at, *u) : scale_u(at.row, factor);
        };
        // The number may be a standard uncertainty already, and k that of the certificate that it comes from; or the whole
        // width of ± U, by the words of the row.
        const bool is_whole_width = k && is_about(divisor, 2.0 * *k, 2e-4) && names_a_width(at.is);
        if (k && (divisor == 1.0 || is_whole_width)) {
            finding.expected = say_number(text::significant(*k, 6));
            findings.add(std::move(finding), FindingSeverity::minor);
            return;
        }
        if (in_formula) {
            finding.expected = say_number("1");
            finding.correct = correct(std::abs(at.is.stated->value), divisor);
        } else if (expected) {
            finding.expected = say_number(text::significant(*expected, 6));
            const std::optional<double> u = u_of_divided(at.is, *expected);
            finding.correct = correct(u, divisor / *expected);
        } else if (at.is.certificate_k && *at.is.certificate_k > 0.0) {
            finding.expected = say("k = {k:number} of the certificate", in_words(*at.is.certificate_k));
            const std::optional<double> u = u_of_divided(at.is, *at.is.certificate_k);
            finding.correct = correct(u, divisor / *at.is.certificate_k);
        } else {
            finding.expected = say("k of the normal distribution, e.g. 2");
        }
        findings.add(std::move(finding));
    });
}

// W03 -----------------------------------------------------------------------------------------------------------------

void volatile_function(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for (const SheetFormula& formula : view->formulas()) {
        // Elsewhere the day of today does no harm: a date of printing, the days left to a calibration.
        if (view->stands_under_results(formula.cell) &&
            calls(formula.formula, {"NOW", "TODAY", "RAND", "RANDBETWEEN"})) {
            AuditFinding finding =
                finding_in(view->place(formula.cell),
                           say("U rests on a function that gives another value each time the file is opened"));
            finding.evidence = {text_of(*view, formula)};
            findings.add(std::move(finding));
        }
    }
}

/// What was left out of formulas that read too much.
void tell_limit(const ReadCells& cells, FindingCollector& findings) {
    if (!cells.is_complete()) {
        findings.leave_unchecked(
            say("formulas read more columns than an audit follows; what stands behind was not looked at"));
    }
}

// W04 -----------------------------------------------------------------------------------------------------------------

bool is_over_readings(const Formula& formula) {
    return calls(formula, {"AVERAGE", "STDEV", "STDEV.S", "STDEVA", "STDEV.P", "STDEVP", "VAR", "VAR.S", "VARP",
                           "VAR.P", "MEDIAN", "DEVSQ", "COUNT"});
}

/// How many cells areas have, blank ones too.
std::size_t cells_in(const WorksheetView& view, const CellPlace& formula, const std::vector<workbook::Area>& areas) {
    constexpr std::size_t k_most_areas = 16, k_most_cells = 10'000;
    std::size_t cells = 0;
    bool overlap = false;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const workbook::CellRange& range = areas[i].range;
        const auto meets = [&](const workbook::Area& other) {
            return other.sheet == areas[i].sheet && other.range.first.row <= range.last.row &&
                   range.first.row <= other.range.last.row && other.range.first.column <= range.last.column &&
                   range.first.column <= other.range.last.column;
        };
        const auto end = areas.begin() + static_cast<std::ptrdiff_t>(std::min(i, k_most_areas));
        overlap = overlap || std::any_of(areas.begin(), end, meets);
        cells += std::size_t{range.last.row - range.first.row + 1} * (range.last.column - range.first.column + 1);
    }
    return overlap ? view.count_of_read(formula, k_most_cells) : cells;
}

/// What stands in the cells that a formula over readings reads.
struct ReadingsRange {
    std::size_t numbers = 0, cells = 0;
    std::vector<CellRun> runs;
    std::string area;
};
Sentence numbers_in_words(const ReadingsRange& range) {
    return say_count(range.numbers, "{count:number} number", "{count:number} numbers");
}
Sentence cells_in_words(const ReadingsRange& range) {
    return say_count(range.cells, "{count:number} cell", "{count:number} cells");
}

ReadingsRange readings_of(const WorksheetView& view, ReadCells& cells, const SheetFormula& formula) {
    ReadingsRange range;
    range.runs = cells.runs(formula.cell);
    for (const CellRun& run : range.runs) {
        range.numbers += cells.numbers(run);
    }
    const std::vector<workbook::Area> areas = view.areas_read(formula.cell);
    range.area = areas.empty() ? "" : workbook::a1_text(areas.front().range);
    range.cells = cells_in(view, formula.cell, areas);
    return range;
}

/// n whose root a formula like SQRT(5) or SQRT(D5) takes.
std::optional<double> rooted_number(const WorksheetView& view, const SheetFormula& formula) {
    const FormulaNode& root = formula.formula.nodes[formula.formula.root()];
    if (!is_call(root, {"SQRT"}) || root.children != 1) {
        return std::nullopt;
    }
    const FormulaNode& inner = formula.formula.nodes[formula.formula.children_of(root)[0]];
    if (inner.kind == FormulaNodeKind::number) {
        return inner.number;
    }
    const std::optional<CellPlace> cell = view.cell_of(formula, inner);
    const CellValue value = cell ? view.value(*cell) : CellValue{};
    return value.kind == CellKind::number ? std::optional(value.number) : std::nullopt;
}

/// Each text among readings is told once, with the first formula that reads it.
void tell_texts(const WorksheetView& view, const ReadCells& cells, const SheetFormula& formula,
                const ReadingsRange& range, CellRun run, workbook::UntakenPlaces& told, FindingCollector& findings) {
    for (run.begin = told.first_from(run.begin); run.begin < run.end; run.begin = told.first_from(run.begin)) {
        const std::uint32_t at = run.begin;
        told.take(at);
        if (cells.texts({.sheet = run.sheet, .begin = at, .end = at + 1}) == 0) {
            continue;
        }
        AuditFinding finding =
            finding_in(view.place(cells.cell(run.sheet, at)),
                       say("text among the readings {area}: mean and standard deviation leave it out", range.area));
        finding.evidence = {say("{cell} reads {area}", view.place(formula.cell), range.area),
                            say("{numbers} of {cells}", numbers_in_words(range), cells_in_words(range))};
        findings.add(std::move(finding));
    }
}

/// Standard deviation of readings about their mean with the divisor n, and how many they are; nothing where the formula reads
/// other than two numbers or more in one range.
struct DeviationByN {
    double s = 0.0, n = 0.0;
};
std::optional<DeviationByN> deviation_by_n_of(const WorksheetView& view, const SheetFormula& formula) {
    constexpr std::size_t k_most = 1000;
    const std::vector<workbook::Area> areas = view.areas_read(formula.cell);
    std::vector<double> values;
    const bool reads_one =
        !areas.empty() && std::all_of(areas.begin(), areas.end(), [&areas](const workbook::Area& area) {
            return area.sheet == areas.front().sheet && area.range == areas.front().range;
        });
    if (!reads_one || view.count_of_read(formula.cell, k_most) == k_most) {
        return std::nullopt;
    }
    const workbook::CellRange& range = areas.front().range;
    for (std::uint32_t row = range.first.row; row <= range.last.row; ++row) {
        for (std::uint32_t column = range.first.column; column <= range.last.column; ++column) {
            const CellValue value =
                view.value({.sheet = areas.front().sheet, .address = {.row = row, .column = column}});
            if (value.kind == CellKind::number) {
                values.push_back(value.number);
            }
        }
    }
    if (values.size() < 2) {
        return std::nullopt;
    }
    const auto n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double sum = 0.0;
    for (const double value : values) {
        sum += (value - mean) * (value - mean);
    }
    return DeviationByN{.s = std::sqrt(sum / n), .n = n};
}

/// W04: the scatter of readings about their own mean is that of n − 1 (JCGM 100:2008, 4.2.2); STDEV.P divides by n. Over
/// √(n − 1) it is s/√n, and right.
void deviation_by_n(const WorksheetView& view, const RowAt& at, FindingCollector& findings) {
    const std::optional<StatedNumber>& number = at.is.stated ? at.is.stated : at.is.u;
    const SheetFormula* maker = number ? view.maker_of(number->place) : nullptr;
    // How a bath or a plate varies over all its places has no n − 1.
    const bool is_scatter = at.is.type_a.value_or(at.is.origin == Origin::readings) ||
                            at.is.contributor == Contributor::repeatability ||
                            at.is.contributor == Contributor::reproducibility;
    if (maker == nullptr || !is_scatter ||
        !calls(maker->formula, {"STDEV.P", "STDEVP", "STDEVPA", "VAR.P", "VARP", "VARPA"})) {
        return;
    }
    const std::optional<DeviationByN> spread = deviation_by_n_of(view, *maker);
    const CellValue made = view.value(maker->cell);
    if (!spread || made.kind != CellKind::number || !(made.number > 0.0)) {
        return;
    }
    constexpr double k_same = 1e-6;
    const double over = spread->s / made.number;  // what the formula divides by
    const bool by_n = is_about(over, 1.0, k_same) || is_about(over, std::sqrt(spread->n), k_same);
    // Without a column of divisors the row divides by what its u is smaller by; two readings need no divisor.
    const bool is_divided = !at.is.divisor && at.is.stated && at.is.used_u > 0.0;
    const double divisor = at.is.divisor ? at.is.divisor->value
                           : is_divided  ? std::abs(at.is.stated->value) / at.is.used_u
                                         : 1.0;
    const bool is_put_right = is_about(over, 1.0, k_same) && is_about(divisor, std::sqrt(spread->n - 1.0), 1e-3);
    if (!by_n || is_put_right) {
        return;
    }
    AuditFinding finding = finding_at(
        at, number->place,
        say("the deviations of {count:number} readings from their own mean are divided by n, and not by n − 1",
            text::shortest(spread->n)));
    finding.evidence = {say_number(text_of(view, *maker)), equals("n", text::shortest(spread->n))};
    finding.expected = say("STDEV.S, which divides by n − 1");
    finding.actual = say("STDEV.P, which divides by n");
    finding.correct = scale_u(at.row, std::sqrt(spread->n / (spread->n - 1.0)));
    findings.add(std::move(finding));
}

/// Whether a node of a formula is a standard deviation of readings: a function of them, or a cell with one or called so.
bool is_deviation(const WorksheetView& view, const SheetFormula& formula, const FormulaNode& node) {
    // Of itself alone: STDEV(…)/SQRT(n) is that of the mean.
    const auto is_function = [](const FormulaNode& of) { return is_call(of, {"STDEV", "STDEV.S", "STDEVA"}); };
    const std::optional<CellPlace> cell = view.cell_of(formula, node);
    if (!cell) {
        return is_function(node);
    }
    const SheetFormula* of_cell = view.formula_at(*cell);
    const std::string label = " " + view.label(*cell);  // "s of" is a word, and no end of "readings of"
    return (of_cell != nullptr && is_function(of_cell->formula.nodes[of_cell->formula.root()])) ||
           (of_cell == nullptr && !says(label, {"mean", "mittel", "average"}) &&
            says(label, {"standard deviation", "standardabweichung", "stdev", "std dev", " s of "}));
}

/// Whether words have a number twice, once of pieces, as those of a row that has n readings of n pieces together: "stack of 10
/// sheets, 10 readings".
bool counts_pieces(const std::string& words, const std::string& number) {
    constexpr std::string_view k_of_numbers = "0123456789.,";
    constexpr std::array k_pieces = {"sheet", "layer", "swing",   "period", "oscillation", "turn",   "revolution",
                                     "piece", "blatt", "blätter", "lage",   "schwing",     "umdreh", "stück"};
    std::size_t times = 0;
    bool of_pieces = false;
    for (std::size_t at = words.find(number); at != std::string::npos; at = words.find(number, at + number.size())) {
        const std::size_t end = at + number.size();
        const bool begins = at == 0 || k_of_numbers.find(words[at - 1]) == std::string_view::npos;
        const bool ends = end == words.size() || words[end] < '0' || words[end] > '9';
        if (begins && ends) {
            ++times;
            // Directly behind the number: "Anlage 5", "return after 5 min" and "Workpiece 5" count nothing.
            const std::string behind = text::in_small_letters(words.substr(end));
            of_pieces = of_pieces || std::any_of(k_pieces.begin(), k_pieces.end(), [&behind](const char* piece) {
                            return behind.starts_with(" " + std::string(piece));
                        });
        }
    }
    return times > 1 && of_pieces;
}

/// A standard deviation of readings over something, as one formula that makes u of a row.
struct DividedDeviation {
    const SheetFormula* maker = nullptr;
    const FormulaNode* spread = nullptr;
    const FormulaNode* by = nullptr;
};

/// Nothing where u is stated or 0, or made in another way.
std::optional<DividedDeviation> divided_deviation(const WorksheetView& view, const RowAt& at) {
    const SheetFormula* maker = at.is.u && !at.is.stated ? view.maker_of(at.is.u->place) : nullptr;
    if (maker == nullptr || !(at.is.used_u > 0.0)) {
        return std::nullopt;
    }
    const FormulaNode& quotient = maker->formula.nodes[maker->formula.root()];
    if (quotient.kind != FormulaNodeKind::divide || quotient.children != 2) {
        return std::nullopt;
    }
    const auto operands = maker->formula.children_of(quotient);
    const FormulaNode &spread = maker->formula.nodes[operands[0]], &by = maker->formula.nodes[operands[1]];
    return is_deviation(view, *maker, spread) ? std::optional(DividedDeviation{maker, &spread, &by}) : std::nullopt;
}

/// W04: s/n in place of s/√n, of a row that says how many readings there are.
void divided_by_n(const WorksheetView& view, const RowAt& at, FindingCollector& findings) {
    const std::optional<DividedDeviation> made = divided_deviation(view, at);
    if (!made) {
        return;
    }
    const SheetFormula* maker = made->maker;
    const FormulaNode& by = *made->by;
    const std::optional<CellPlace> cell = view.cell_of(*maker, by);
    const CellValue value = cell ? view.value(*cell) : CellValue{};
    const double n = by.kind == FormulaNodeKind::number ? by.number
                     : value.kind == CellKind::number   ? value.number
                                                        : 0.0;
    const bool is_count = (at.is.n && static_cast<double>(*at.is.n) == n) || at.is.used_nu + 1.0 == n;
    if (!(n >= 2.0) || !is_count) {
        return;
    }
    AuditFinding finding = finding_at(
        at, at.is.u->place,
        say("the standard deviation of {count:number} readings is divided by n, and not by √n", text::shortest(n)));
    finding.evidence = {say_number(text_of(view, *maker)), equals("n", text::shortest(n))};
    finding.expected = say("√{n:number}", text::shortest(n));
    finding.actual = say_number(text::shortest(n));
    if (counts_pieces(words_of_row(at.is), text::shortest(n))) {  // s of a stack is n times that of a sheet
        findings.add(std::move(finding), FindingSeverity::minor);
        return;
    }
    finding.correct = scale_u(at.row, std::sqrt(n));
    findings.add(std::move(finding));
}

/// What COUNT gives of an area, or COUNTA, which counts words as well; nothing of a large one.
std::optional<std::size_t> counted_in(const WorksheetView& view, const workbook::Area& area, bool with_words) {
    constexpr std::uint64_t k_most = 1000;
    const workbook::CellRange& range = area.range;
    const std::uint64_t rows = range.last.row - range.first.row + 1U,
                        columns = range.last.column - range.first.column + 1U;
    if (rows * columns > k_most) {
        return std::nullopt;
    }
    std::size_t numbers = 0;
    for (std::uint32_t row = range.first.row; row <= range.last.row; ++row) {
        for (std::uint32_t column = range.first.column; column <= range.last.column; ++column) {
            const CellValue value = view.value({.sheet = area.sheet, .address = {.row = row, .column = column}});
            const bool is_counted =
                value.kind == CellKind::number || (with_words && value.kind == CellKind::text && !value.text.empty());
            numbers += is_counted ? 1U : 0U;
        }
    }
    return numbers;
}

/// Areas of several cells that a formula reads, each once.
std::vector<workbook::Area> ranges_read(const WorksheetView& view, const CellPlace& cell) {
    std::vector<workbook::Area> ranges;
    for (const workbook::Area& area : view.areas_read(cell)) {
        const bool is_known = std::any_of(ranges.begin(), ranges.end(), [&area](const workbook::Area& other) {
            return other.sheet == area.sheet && other.range == area.range;
        });
        if (!is_known && !(area.range.first == area.range.last)) {
            ranges.push_back(area);
        }
    }
    return ranges;
}

/// Whether numbers of a range that are no cells of another one are all made by formulas. Typed ones may be readings: s may be that
/// of earlier readings, and the mean that of all (JCGM 100:2008, 4.2.4).
bool has_formulas_only_beyond(const WorksheetView& view, const workbook::Area& whole, const workbook::CellRange& part) {
    for (std::uint32_t row = whole.range.first.row; row <= whole.range.last.row; ++row) {
        for (std::uint32_t column = whole.range.first.column; column <= whole.range.last.column; ++column) {
            const bool is_part = row >= part.first.row && row <= part.last.row && column >= part.first.column &&
                                 column <= part.last.column;
            const CellPlace place{.sheet = whole.sheet, .address = {.row = row, .column = column}};
            if (!is_part && view.value(place).kind == CellKind::number && view.formula_at(place) == nullptr) {
                return false;
            }
        }
    }
    return true;
}

/// W04 of a row whose u is s/√n in one formula: n counts a range that reaches beyond the readings, as over their mean and s below them.
void counted_beyond_readings(const WorksheetView& view, const RowAt& at, FindingCollector& findings) {
    const std::optional<DividedDeviation> made = divided_deviation(view, at);
    if (!made || !is_call(*made->by, {"SQRT"}) || made->by->children != 1) {
        return;
    }
    const SheetFormula* maker = made->maker;
    const FormulaNode &spread = *made->spread, &root = *made->by;
    const FormulaNode& count = maker->formula.nodes[maker->formula.children_of(root)[0]];
    const bool with_words = is_call(count, {"COUNTA"});
    if (!with_words && !is_call(count, {"COUNT"})) {
        return;
    }
    const std::optional<CellPlace> cell = view.cell_of(*maker, spread);
    std::vector<workbook::Area> of_formula = ranges_read(view, maker->cell),
                                of_spread = cell ? ranges_read(view, *cell) : std::vector<workbook::Area>();
    if (!cell && of_formula.size() == 2) {
        of_spread.push_back(of_formula.front());
        of_formula.erase(of_formula.begin());
    }
    if (of_formula.size() != 1 || of_spread.size() != 1) {
        return;
    }
    const workbook::Area &counted = of_formula.front(), &readings = of_spread.front();
    const workbook::CellRange &outer = counted.range, &inner = readings.range;
    const bool reaches_beyond = counted.sheet == readings.sheet && outer.first.row <= inner.first.row &&
                                outer.first.column <= inner.first.column && outer.last.row >= inner.last.row &&
                                outer.last.column >= inner.last.column;
    const std::optional<std::size_t> n = counted_in(view, counted, with_words),
                                     of_readings = counted_in(view, readings, false);
    if (!reaches_beyond || !n || !of_readings || *of_readings < 2 || *n <= *of_readings ||
        !has_formulas_only_beyond(view, counted, inner)) {
        return;
    }
    const auto used = static_cast<double>(*n), right = static_cast<double>(*of_readings);
    const ReadingsRange range{
        .numbers = *of_readings, .cells = *of_readings, .runs = {}, .area = workbook::a1_text(inner)};
    AuditFinding finding =
        finding_at(at, at.is.u->place,
                   say("√{n:number} divides a standard deviation of {area}, which has {numbers} in {cells}",
                       text::shortest(used), range.area, numbers_in_words(range), cells_in_words(range)));
    finding.expected = say("√{n:number}", text::shortest(right));
    finding.actual = say("√{n:number}", text::shortest(used));
    finding.evidence = {say_number(text_of(view, *maker))};
    finding.correct = scale_u(at.row, std::sqrt(used / right));
    findings.add(std::move(finding));
}

void count_of_readings(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    ReadCells cells(*view);
    std::vector<workbook::UntakenPlaces> told;
    for (const workbook::SheetIndex& index : view->indexes()) {
        told.emplace_back(index.places().size());
    }
    for (const SheetFormula& formula : view->formulas()) {
        if (!is_over_readings(formula.formula)) {
            continue;
        }
        const ReadingsRange range = readings_of(*view, cells, formula);
        if (range.numbers < 2) {
            continue;
        }
        for (const CellRun& run : range.runs) {
            tell_texts(*view, cells, formula, range, run, told[run.sheet], findings);
        }
    }
    for_each_row(subject, [&](const RowAt& at) {
        const SheetFormula* stated = view->formula_at(place_of(at.is.stated));
        const SheetFormula* divisor = view->formula_at(place_of(at.is.divisor));
        if (stated == nullptr || divisor == nullptr) {
            return;
        }
        const std::optional<double> n = rooted_number(*view, *divisor);
        // The cell itself, or the one that it passes on.
        const SheetFormula* spread = stated;
        const std::optional<CellPlace> passed_on = view->only_cell_read(stated->cell);
        if (!is_over_readings(spread->formula) && passed_on) {
            spread = view->formula_at(*passed_on);
        }
        if (!n || spread == nullptr || !is_over_readings(spread->formula)) {
            return;
        }
        const ReadingsRange range = readings_of(*view, cells, *spread);
        const auto numbers = static_cast<double>(range.numbers);
        if (range.numbers < 2 || (*n == numbers && range.cells == range.numbers)) {
            return;
        }
        AuditFinding finding =
            finding_at(at, at.is.divisor->place,
                       say("√{n:number} divides a standard deviation of {area}, which has {numbers} in {cells}",
                           text::shortest(*n), range.area, numbers_in_words(range), cells_in_words(range)));
        finding.expected = say("√{n:number}", text::shortest(numbers));
        finding.actual = say("√{n:number}", text::shortest(*n));
        finding.evidence = {say("n of the divisor: {n:number}", text::shortest(*n)),
                            say("numbers in the range: {count:number}", text::shortest(numbers)),
                            say("cells of the range: {count:number}", std::to_string(range.cells))};
        finding.correct = both(scale_u(at.row, std::sqrt(*n / numbers)), set_degrees_of_freedom(at.row, numbers - 1.0));
        findings.add(std::move(finding));
    });
    for_each_row(subject, [&](const RowAt& at) {
        deviation_by_n(*view, at, findings);
        divided_by_n(*view, at, findings);
        counted_beyond_readings(*view, at, findings);
    });
    tell_limit(cells, findings);
}

// W05 -----------------------------------------------------------------------------------------------------------------

bool has_absolute_reference(const Formula& formula) {
    // A relative address moves when its row is copied. An absolute one stays, and the copy reads the cell of the row
    // that it comes from.
    return std::any_of(formula.references.begin(), formula.references.end(), [](const workbook::Reference& reference) {
        return reference.first.row_is_absolute || reference.first.column_is_absolute;
    });
}

/// The formula that gives u of a row, or what it is divided from.
const SheetFormula* formula_of_row(const WorksheetView& view, const AuditedRow& row) {
    return view.formula_at(place_of(row.stated ? row.stated : row.u));
}

/// The row of a budget whose number stands in a cell: what it divides, or its u.
using OwnersOfCells = std::map<CellPlace, std::size_t>;
OwnersOfCells owners_of(const WorksheetView& view, const AuditedBudget& budget) {
    OwnersOfCells owners;
    for (std::size_t r = 0; r < budget.rows.size(); ++r) {
        for (const std::optional<StatedNumber>* number : {&budget.rows[r].stated, &budget.rows[r].u}) {
            const std::optional<CellPlace> cell = view.cell_at(place_of(*number));
            if (cell) {
                owners.emplace(*cell, r);
            }
        }
    }
    return owners;
}

/// The first cell of another row among those that a formula names one by one; nothing where it names one of its own row.
std::optional<CellPlace> number_of_other_row(const WorksheetView& view, const SheetFormula& formula,
                                             const OwnersOfCells& owners, std::size_t row) {
    std::optional<CellPlace> other;
    for (const FormulaNode& node : formula.formula.nodes) {
        const std::optional<CellPlace> cell = view.cell_of(formula, node);
        const auto owner = cell ? owners.find(*cell) : owners.end();
        if (owner == owners.end()) {
            continue;
        }
        if (owner->second == row) {
            return std::nullopt;
        }
        other = other ? other : cell;
    }
    return other;
}

/// W05 of a row that computes u from what another row divides, in place of its own, or passes on the number of another row by
/// an absolute address as its own. One that computes with it, as a drift that is a tenth of U, is another number.
void number_of_another_row(const WorksheetView& view, const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&view, &findings, owners = OwnersOfCells(),
                           of = std::optional<std::size_t>()](const RowAt& at) mutable {
        if (of != at.budget) {
            of = at.budget;
            owners = owners_of(view, at.of);
        }
        const AuditedRow& row = at.is;
        const SheetFormula* of_u = row.stated ? view.formula_at(place_of(row.u)) : nullptr;
        const SheetFormula* of_stated = view.formula_at(place_of(row.stated ? row.stated : row.u));
        const bool copies =
            of_stated != nullptr && of_stated->formula.nodes.size() == 1 && has_absolute_reference(of_stated->formula);
        std::optional<CellPlace> read =
            of_u != nullptr ? number_of_other_row(view, *of_u, owners, at.row) : std::nullopt;
        const SheetFormula* formula = read ? of_u : of_stated;
        const bool in_u = read.has_value();
        if (!read && copies) {
            read = number_of_other_row(view, *of_stated, owners, at.row);
        }
        if (!read) {
            return;
        }
        const AuditedRow& other = at.of.rows[owners.at(*read)];
        AuditFinding finding = finding_at(
            at, view.place(formula->cell),
            in_u ? say("u is computed from {cell}, the number of the row \"{quantity}\", and its own is not read",
                       view.place(*read), other.quantity)
                 : say("passes on {cell}, the number of the row \"{quantity}\", by an absolute address: it counts "
                       "twice, or another cell was meant",
                       view.place(*read), other.quantity));
        finding.evidence = {text_of(view, *formula), equals(view.place(*read), in_words(view.value(*read).number))};
        const std::optional<StatedNumber> quotient = quotient_of_columns(row);
        if (in_u && quotient) {
            finding.expected = equals("u", in_words(quotient->value, row.unit));
            finding.actual = equals("u", in_words(row.used_u, row.unit));
            finding.correct = set_u(at.row, quotient->value);
        } else if (!in_u) {
            finding.correct = leave_out(at.row);
        }
        findings.add(std::move(finding));
    });
}

void stray_address(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    ReadCells cells(*view);
    number_of_another_row(*view, subject, findings);
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        FirstReaders all, by_absolute_address;
        for (std::size_t r = 0; r < budget.rows.size(); ++r) {
            const SheetFormula* formula = formula_of_row(*view, budget.rows[r]);
            if (formula == nullptr) {
                continue;
            }
            const bool is_absolute = has_absolute_reference(formula->formula);
            const std::vector<CellRun> runs = cells.runs(formula->cell);
            std::optional<FirstReaders::Shared> shared;
            std::size_t sheet = 0;
            for (const CellRun& run : runs) {
                if (!shared) {
                    shared = (is_absolute ? all : by_absolute_address).shared(cells, run);
                    sheet = run.sheet;
                }
                all.add(run, r);
                if (is_absolute) {
                    by_absolute_address.add(run, r);
                }
            }
            if (!shared) {
                continue;
            }
            const CellPlace read = cells.cell(sheet, shared->at);
            const AuditedRow& other = budget.rows[shared->reader];
            const RowAt at{.budget = b, .row = r, .of = budget, .is = budget.rows[r]};
            AuditFinding finding = finding_at(at, view->place(formula->cell),
                                              say("reads the same cell as the row \"{quantity}\" by an absolute "
                                                  "address: {cell} counts twice, or another cell was meant",
                                                  other.quantity, view->place(read)));
            finding.evidence = {equals(view->place(read), in_words(view->value(read).number)),
                                say("read by {first} and {second}", view->place(formula->cell),
                                    view->place(formula_of_row(*view, other)->cell))};
            finding.correct = leave_out(r);
            findings.add(std::move(finding));
        }
    }
    tell_limit(cells, findings);
}

// W06 -----------------------------------------------------------------------------------------------------------------

/// A run of cells one below the other that pass on single cells of one column.
struct CopiedRun {
    std::vector<const SheetFormula*> formulas;
    std::vector<CellPlace> read;
};

std::vector<CopiedRun> copied_runs(const WorksheetView& view) {
    std::map<std::pair<std::size_t, std::uint32_t>, std::map<std::uint32_t, const SheetFormula*>> columns;
    for (const SheetFormula& formula : view.formulas()) {
        if (formula.formula.nodes.size() == 1 && view.cell_of(formula, formula.formula.nodes[0])) {
            columns[{formula.cell.sheet, formula.cell.address.column}][formula.cell.address.row] = &formula;
        }
    }
    std::vector<CopiedRun> runs;
    for (const auto& [column, formulas] : columns) {
        CopiedRun run;
        std::uint32_t last_row = 0;
        const auto close = [&] {
            // Of two cells nobody can tell whether they are copies of one column.
            if (run.formulas.size() >= 3) {
                runs.push_back(run);
            }
            run = {};
        };
        for (const auto& [row, formula] : formulas) {
            const CellPlace read = *view.cell_of(*formula, formula->formula.nodes[0]);
            const bool goes_on = !run.read.empty() && row == last_row + 1 && read.sheet == run.read.front().sheet &&
                                 read.address.column == run.read.front().address.column;
            if (!goes_on) {
                close();
            }
            run.formulas.push_back(formula);
            run.read.push_back(read);
            last_row = row;
        }
        close();
    }
    return runs;
}

/// \param never_read  so many cells are read by no copy
Sentence second_reading(const std::string& cell, std::size_t count, const Sentence& never_read) {
    if (count == 0) {
        return say("reads {cell} a second time", cell);
    }
    return count == 1 ? say("reads {cell} a second time, and {cells} is never read", cell, never_read)
                      : say("reads {cell} a second time, and {cells} are never read", cell, never_read);
}

void reading_read_twice(const AuditSubject& subject, FindingCollector& findings) {
    constexpr std::size_t k_most_named = 6;
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for (const CopiedRun& run : copied_runs(*view)) {
        const std::set<CellPlace> read(run.read.begin(), run.read.end());
        if (read.size() == run.read.size()) {
            continue;
        }
        std::vector<std::string> missing;
        CellPlace expected = *read.begin();
        for (std::size_t i = 0; i < run.read.size(); ++i, ++expected.address.row) {
            if (!read.contains(expected) && view->value(expected).kind == CellKind::number) {
                missing.push_back(view->place(expected));
            }
        }
        const Sentence never_read = listed(sentences_of(missing), k_most_named);
        const Sentence column = say("column of copies {first} to {last}", view->place(run.formulas.front()->cell),
                                    view->place(run.formulas.back()->cell));
        std::set<CellPlace> seen;
        for (std::size_t i = 0; i < run.read.size(); ++i) {
            if (seen.insert(run.read[i]).second) {
                continue;
            }
            AuditFinding finding = finding_in(view->place(run.formulas[i]->cell),
                                              second_reading(view->place(run.read[i]), missing.size(), never_read));
            finding.evidence = {column};
            finding.kind = column.english() + finding.what.english();
            findings.add(std::move(finding));
        }
    }
}

// W07, W08 ------------------------------------------------------------------------------------------------------------

/// A table of corrections of a standard: heads of a column of corrections and one of their U.
struct StandardTable {
    std::size_t sheet = 0;
    std::uint32_t head_row = 1, correction = 0, U = 0;
};

std::vector<StandardTable> standard_tables(const WorksheetView& view) {
    std::vector<StandardTable> tables;
    for (std::size_t s = 0; s < view.workbook().sheets.size(); ++s) {
        std::map<std::uint32_t, StandardTable> by_row;
        for (const workbook::Cell& cell : view.workbook().sheets[s].cells) {
            if (cell.value.kind != CellKind::text) {
                continue;
            }
            StandardTable& table = by_row[cell.address.row];
            table.sheet = s;
            table.head_row = cell.address.row;
            const std::string& text = cell.value.text;
            if (says(text, {"correction", "korrektion", "korrektur", "deviation", "abweichung", "error", "fehler"})) {
                table.correction = cell.address.column;
            } else if (text.starts_with("U") || says(text, {"uncertainty", "unsicherheit"})) {
                table.U = cell.address.column;
            }
        }
        for (const auto& [row, table] : by_row) {
            if (table.correction != 0 && table.U != 0) {
                tables.push_back(table);
            }
        }
    }
    return tables;
}

/// Calls `look` with the correction and U of each row below the heads, until both columns are empty or the next table has
/// its heads there.
void for_each_correction(
    const WorksheetView& view,
    const std::function<void(const CellPlace&, const CellValue&, const CellPlace&, const CellValue&)>& look) {
    constexpr std::uint32_t k_longest = 10'000;
    const std::vector<StandardTable> tables = standard_tables(view);
    std::map<std::tuple<std::size_t, std::uint32_t, std::uint32_t>, std::uint32_t> next_heads;
    std::vector<std::uint32_t> ends(tables.size());
    // From the last table to the first: the heads further down end the table above them, however many rows it has.
    for (std::size_t i = tables.size(); i-- > 0;) {
        std::uint32_t& next =
            next_heads.try_emplace({tables[i].sheet, tables[i].correction, tables[i].U}, workbook::k_most_rows + 1)
                .first->second;
        ends[i] = std::min(next, tables[i].head_row + k_longest);
        next = tables[i].head_row;
    }
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const StandardTable& table = tables[i];
        for (std::uint32_t row = table.head_row + 1; row < ends[i]; ++row) {
            const CellPlace c{.sheet = table.sheet, .address = {.row = row, .column = table.correction}};
            const CellPlace u{.sheet = table.sheet, .address = {.row = row, .column = table.U}};
            const CellValue correction = view.value(c), U = view.value(u);
            if (correction.kind == CellKind::blank && U.kind == CellKind::blank) {
                break;
            }
            look(c, correction, u, U);
        }
    }
}

void correction_without_uncertainty(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for_each_correction(
        *view, [&](const CellPlace& c, const CellValue& correction, const CellPlace& u, const CellValue& U) {
            const auto is_nothing = [](const CellValue& value) {
                return value.kind == CellKind::blank || (value.kind == CellKind::number && value.number == 0.0);
            };
            if (is_nothing(correction) && is_nothing(U)) {
                AuditFinding finding = finding_in(
                    view->place(c), say("a correction of 0 with an uncertainty of 0: cells that were never filled in"));
                finding.evidence = {equals(view->place(c), "0"), equals(view->place(u), "0")};
                finding.kind = finding.what.english();
                findings.add(std::move(finding));
            }
        });
}

void uncertainty_not_positive(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for_each_correction(
        *view, [&](const CellPlace&, const CellValue& correction, const CellPlace& u, const CellValue& U) {
            if (U.kind != CellKind::number || U.number > 0.0 || (U.number == 0.0 && correction.number == 0.0)) {
                return;
            }
            const bool copied = correction.kind == CellKind::number && correction.number == U.number;
            AuditFinding finding = finding_in(
                view->place(u),
                copied ? say("an expanded uncertainty of {U:number}, the number of the column of corrections",
                             in_words(U.number))
                       : say("an expanded uncertainty of {U:number}", in_words(U.number)));
            finding.expected = "U > 0";
            finding.actual = say_number(in_words(U.number));
            findings.add(std::move(finding));
        });
}

// W09 -----------------------------------------------------------------------------------------------------------------

void component_left_out(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        if (at.is.in_sum || !at.of.claims.u_c) {
            return;
        }
        AuditFinding finding = finding_at(
            at, place_of(at.is.contribution),
            say("the combined uncertainty in {place} leaves this contribution out", at.of.claims.u_c->place));
        finding.evidence = {
            equals(say("contribution"), in_words(std::abs(at.is.used_sensitivity) * at.is.used_u, at.of.unit))};
        finding.correct = put_in(at.row);
        findings.add(std::move(finding));
    });
}

// W10 -----------------------------------------------------------------------------------------------------------------

void choice_over_text(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    ReadCells cells(*view);
    for (const SheetFormula& formula : view->formulas()) {
        const FormulaNode& root = formula.formula.nodes[formula.formula.root()];
        if (!is_call(root, {"MAX", "MIN"})) {
            continue;
        }
        const std::vector<CellRun> runs = cells.runs(formula.cell);
        std::size_t numbers = 0;
        Sentence where;
        for (const CellRun& run : runs) {
            numbers += cells.numbers(run);
            if (const std::optional<std::uint32_t> at = cells.text(run); at && where.empty()) {
                const CellPlace text = cells.cell(run.sheet, *at);
                where = say("{cell} = \"{text}\"", view->place(text), view->value(text).text);
            }
        }
        // One number is left to choose from: the other one, the floor, is no number.
        if (numbers != 1) {
            continue;
        }
        for (const workbook::Area& area : view->areas_read(formula.cell)) {
            if (const std::optional<CellPlace> blank = where.empty() ? cells.blank(area) : std::nullopt) {
                where = say("{cell} is empty", view->place(*blank));
            }
        }
        if (where.empty()) {
            continue;
        }
        AuditFinding finding =
            finding_in(view->place(formula.cell),
                       say("{function} chooses between a number and {cell}, which it leaves out: the floor is gone",
                           root.text, where));
        finding.evidence = {where};
        findings.add(std::move(finding));
    }
    tell_limit(cells, findings);
}

// W11, W12 ------------------------------------------------------------------------------------------------------------

void value_of_another_workbook(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for (const SheetFormula& formula : view->formulas()) {
        const auto link =
            std::find_if(formula.formula.references.begin(), formula.formula.references.end(),
                         [](const workbook::Reference& reference) { return !reference.workbook.empty(); });
        if (link != formula.formula.references.end()) {
            AuditFinding finding = finding_in(
                view->place(formula.cell), say("the value comes from another workbook, [{workbook}]", link->workbook));
            finding.kind = finding.what.english();
            findings.add(std::move(finding));
        }
    }
}

/// The first cell of a sheet with something in it that stands in a hidden row or column, and under the results; nothing where there is none.
std::optional<CellPlace> hidden_under_results(const WorksheetView& view, std::size_t sheet) {
    const workbook::Sheet& of = view.workbook().sheets[sheet];
    const auto lies_in = [](const std::vector<workbook::Span>& spans, std::uint32_t at) {
        return std::any_of(spans.begin(), spans.end(),
                           [at](const workbook::Span& span) { return span.first <= at && at <= span.last; });
    };
    for (const workbook::Cell& cell : of.cells) {
        const CellPlace at{.sheet = sheet, .address = cell.address};
        if ((lies_in(of.hidden_rows, cell.address.row) || lies_in(of.hidden_columns, cell.address.column)) &&
            view.stands_under_results(at)) {
            return at;
        }
    }
    return std::nullopt;
}

Sentence error_in_words(bool hidden, bool under_results) {
    if (under_results) {
        return hidden ? say("an error value on a hidden sheet, and U rests on it")
                      : say("an error value, and U rests on it");
    }
    return hidden ? say("an error value on a hidden sheet; no result that we found rests on it")
                  : say("an error value; no result that we found rests on it");
}

void error_in_chain(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    // Where an error reaches a result, nothing is claimed.
    const bool any_broken = std::any_of(subject.budgets.begin(), subject.budgets.end(),
                                        [](const AuditedBudget& budget) { return budget.claims.broken.any(); });
    for (std::size_t s = 0; s < view->workbook().sheets.size(); ++s) {
        const workbook::Sheet& sheet = view->workbook().sheets[s];
        const bool hidden = sheet.state != workbook::SheetState::visible;
        for (const workbook::Cell& cell : sheet.cells) {
            const CellPlace at{.sheet = s, .address = cell.address};
            const CellValue value = view->value(at);
            const SheetFormula* formula = view->formula_at(at);
            const bool broken =
                value.kind == CellKind::error ||
                (formula != nullptr &&
                 std::any_of(formula->formula.nodes.begin(), formula->formula.nodes.end(),
                             [](const FormulaNode& node) { return node.kind == FormulaNodeKind::error; }));
            if (!broken) {
                continue;
            }
            const bool under_results = view->stands_under_results(at);
            AuditFinding finding = finding_in(view->place(at), error_in_words(hidden, under_results));
            finding.kind = finding.what.english();
            findings.add(std::move(finding),
                         any_broken && under_results ? FindingSeverity::critical : FindingSeverity::minor);
        }
        const bool used = std::any_of(sheet.cells.begin(), sheet.cells.end(), [&](const workbook::Cell& cell) {
            return view->stands_under_results({.sheet = s, .address = cell.address});
        });
        if (hidden && used) {
            findings.add(finding_in(sheet.name, say("U rests on a hidden sheet")));
        } else if (const std::optional<CellPlace> first = hidden_under_results(*view, s)) {
            findings.add(finding_in(view->place(*first), say("U rests on a hidden row or column")));
        }
    }
}

// W13 -----------------------------------------------------------------------------------------------------------------

bool is_rate_per_year(const std::string& label) {
    return says(label, {"per year", "je jahr", "/yr", "/year", "p.a.", "pro jahr", "/a", "/jahr", "annual"});
}

/// Whether a formula has days: a function of dates, or the difference of two cells that hold days of the last or this
/// century as spreadsheets count them.
bool counts_days(const WorksheetView& view, const SheetFormula& formula) {
    constexpr double k_first_day = 18'000.0, k_last_day = 80'000.0;  // 1949 to 2119
    if (calls(formula.formula, {"NOW", "TODAY", "DATEVALUE", "DATE", "DAYS"})) {
        return true;
    }
    const auto is_day = [&](const FormulaNode& node) {
        const std::optional<CellPlace> cell = view.cell_of(formula, node);
        const CellValue value = cell ? view.value(*cell) : CellValue{};
        return value.kind == CellKind::number && value.number >= k_first_day && value.number <= k_last_day;
    };
    return std::any_of(formula.formula.nodes.begin(), formula.formula.nodes.end(), [&](const FormulaNode& node) {
        if (node.kind != FormulaNodeKind::subtract || node.children != 2) {
            return false;
        }
        const auto operands = formula.formula.children_of(node);
        return is_day(formula.formula.nodes[operands[0]]) && is_day(formula.formula.nodes[operands[1]]);
    });
}

bool is_of_year(double days) {
    return days >= 360.0 && days <= 366.0;
}

/// Whether one of the cells that a formula reads holds a rate per year.
/// \param labels_left  how many labels may be looked at; none is left where that was not enough
bool reads_rate_per_year(const WorksheetView& view, ReadCells& cells, const SheetFormula& formula,
                         std::size_t& labels_left) {
    for (const CellRun& run : cells.runs(formula.cell)) {
        for (std::uint32_t at = run.begin; at < run.end && labels_left > 0; ++at, --labels_left) {
            if (is_rate_per_year(view.label(cells.cell(run.sheet, at)))) {
                return true;
            }
        }
    }
    return false;
}

void time_units(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    ReadCells cells(*view);
    std::size_t labels_left = 1'000'000;
    std::map<std::string, std::pair<std::size_t, std::size_t>> row_of_place;  // budget and row
    for_each_row(subject, [&row_of_place](const RowAt& at) {
        for (const std::optional<StatedNumber>* number : {&at.is.stated, &at.is.u}) {
            if (*number) {
                row_of_place[(*number)->place] = {at.budget, at.row};
            }
        }
    });
    for (const SheetFormula& formula : view->formulas()) {
        if (!counts_days(*view, formula)) {
            continue;
        }
        const std::string place = view->place(formula.cell);
        const auto of_row = row_of_place.find(place);
        const auto says_rate = [&] {  // of the row itself, where the rate stands in the formula
            return of_row != row_of_place.end() &&
                   is_rate_per_year(text_of_row(subject.budgets[of_row->second.first].rows[of_row->second.second]));
        };
        const std::vector<workbook::FormulaLiteral> literals = workbook::literal_numbers(formula.formula);
        const auto divides = [&formula](const workbook::FormulaLiteral& literal) {
            return formula.formula.nodes[literal.parent].kind == FormulaNodeKind::divide && literal.argument == 1;
        };
        const bool closes = std::any_of(literals.begin(), literals.end(),
                                        [](const auto& literal) { return is_of_year(literal.number); });
        for (const workbook::FormulaLiteral& literal : literals) {
            if (closes || !divides(literal) ||
                !(says_rate() || reads_rate_per_year(*view, cells, formula, labels_left))) {
                continue;
            }
            AuditFinding finding = finding_in(
                place,
                say("a rate per year times days divided by {divisor}: the units of time do not close", literal.text));
            finding.expected = say("days/365");
            finding.actual = say("days/{divisor}", literal.text);
            finding.evidence = {text_of(*view, formula)};
            if (of_row != row_of_place.end()) {
                finding.budgets = {of_row->second.first};
                finding.correct = scale_u(of_row->second.second, literal.number / 365.0);
            }
            findings.add(std::move(finding));
            break;  // what else divides belongs to something else
        }
    }
    if (labels_left == 0) {
        findings.leave_unchecked(say("formulas with days read more cells than an audit looks at the labels of"));
    }
    tell_limit(cells, findings);
}

// W14 -----------------------------------------------------------------------------------------------------------------

/// The rows of the tables of a subject, as sheet and row, and the cells of their own numbers.
struct CellsOfTables {
    std::set<std::pair<std::size_t, std::uint32_t>> rows;
    std::set<CellPlace> numbers;
    /// Contributions of rows that a sum, which follows from all rows, takes from their other cells: √SUMPRODUCT(u²; c²).
    std::set<CellPlace> shown_alone;
};
CellsOfTables cells_of_tables(const WorksheetView& view, const AuditSubject& subject) {
    CellsOfTables cells;
    for_each_row(subject, [&](const RowAt& at) {
        if (const std::optional<CellPlace> cell = view.cell_at(at.is.place)) {
            cells.rows.emplace(cell->sheet, cell->address.row);
        }
        for (const std::optional<StatedNumber>* number : {&at.is.estimate, &at.is.stated, &at.is.divisor, &at.is.u,
                                                          &at.is.sensitivity, &at.is.contribution, &at.is.nu}) {
            if (const std::optional<CellPlace> cell = view.cell_at(place_of(*number))) {
                cells.numbers.insert(*cell);
            }
        }
        const std::optional<CellPlace> contribution = view.cell_at(place_of(at.is.contribution));
        const std::optional<CellPlace> u = view.cell_at(place_of(at.is.u)),
                                       stated = view.cell_at(place_of(at.is.stated));
        if (contribution && at.is.in_sum && at.of.u_c_over_rows == 1.0 &&
            ((u && view.stands_under_results(*u)) || (stated && view.stands_under_results(*stated)))) {
            cells.shown_alone.insert(*contribution);
        }
    });
    return cells;
}

/// Cells of u_c and U that a subject claims. What is made of the value or of k is no result of the rows.
std::set<CellPlace> cells_of_claims(const WorksheetView& view, const AuditSubject& subject) {
    std::set<CellPlace> cells;
    for (const AuditedBudget& budget : subject.budgets) {
        for (const std::optional<StatedNumber>* claim : {&budget.claims.u_c, &budget.claims.U}) {
            if (const std::optional<CellPlace> cell = view.cell_at(place_of(*claim))) {
                cells.insert(*cell);
            }
        }
    }
    return cells;
}

void computed_and_not_used(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    const std::set<CellPlace> claims = cells_of_claims(*view, subject);
    // What a page of results shows of U is made of U, and nobody has to read it.
    const auto shows_result = [&](const CellPlace& cell) {
        constexpr std::size_t k_most = 50;
        const std::vector<CellPlace> read = view->cells_read(cell, k_most);
        return std::any_of(read.begin(), read.end(), [&claims](const CellPlace& one) { return claims.contains(one); });
    };
    const std::vector<CellPlace> unread = view->unread_cells();
    const CellsOfTables tables = cells_of_tables(*view, subject);
    for (const SheetFormula& formula : view->formulas()) {
        const bool visible = view->workbook().sheets[formula.cell.sheet].state == workbook::SheetState::visible;
        if (!visible || view->stands_under_results(formula.cell) || tables.shown_alone.contains(formula.cell) ||
            !std::binary_search(unread.begin(), unread.end(), formula.cell)) {
            continue;
        }
        const std::string label = view->label(formula.cell);
        // In a row of a budget, what is no number of the row is of another column, and only its head says of what: a share
        // of the variance belongs to the drift, and is none.
        const bool is_beside = tables.rows.contains({formula.cell.sheet, formula.cell.address.row}) &&
                               !tables.numbers.contains(formula.cell);
        // Many cells are read by nobody, notes and checks for instance. Only these words tell that something is missing
        // in the result.
        if (is_beside ? says(view->head(formula.cell),
                             {"correction", "korrektion", "korrektur", "drift", "deviation", "abweichung"})
                      : says(label, {"correction", "korrektion", "korrektur", "drift", "deviation", "abweichung",
                                     "uncertainty", "unsicherheit"})) {
            const bool is_of_result = !is_beside && !says(label, {"correction", "korrektion", "korrektur", "drift",
                                                                  "deviation", "abweichung"});
            if (is_of_result && shows_result(formula.cell)) {
                continue;
            }
            AuditFinding finding =
                finding_in(view->place(formula.cell), say("computed, and never used: \"{label}\"", label));
            finding.kind = finding.what.english();
            findings.add(std::move(finding));
        }
    }
}

// W16 -----------------------------------------------------------------------------------------------------------------

void not_protected(const AuditSubject& subject, FindingCollector& findings) {
    const workbook::Workbook& workbook = subject.workbook->workbook;
    const bool any = workbook.metadata.structure_is_protected ||
                     std::any_of(workbook.sheets.begin(), workbook.sheets.end(),
                                 [](const workbook::Sheet& sheet) { return sheet.is_protected; });
    if (!any) {
        findings.add(finding_in(
            subject.name, say("no sheet is protected, and nothing says which version of the workbook was validated")));
    }
}

}  // namespace

std::vector<Rule> worksheet_rules() {
    return {
        {.id = "W01",
         .title = "Root taken twice",
         .clause = k_bounds_of_inputs,
         .needs = {Need::workbook},
         .detection = "a formula takes the root of a cell that is a root already (without formulas: U08)",
         .correction = "Divide by the divisor of the table itself.",
         .question = "The divisor is a root already: why is its root taken again?",
         .examine = root_taken_twice},
        {.id = "W02",
         .title = "Divisor and stated distribution disagree",
         .clause = k_bounds_of_inputs,
         .needs = {Need::rows},
         .detection =
             "the divisor is not that of the named distribution, beyond its printed digits: √3, √6, √2, k; √n of "
             "readings is that of their mean; not where divisor 1 stands beside what was divided so already; beside a "
             "stated k, \"normal (k = 2)\", the divisor 1 is asked about, and 2 k where words may speak of a whole "
             "width",
         .correction =
             "Divide by the divisor of the distribution, or name the distribution that the divisor belongs to.",
         .question = "Which of the two is meant, the distribution or the divisor?",
         .examine = divisor_against_label},
        {.id = "W03",
         .title = "Volatile function under U",
         .clause = k_data_control,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::workbook},
         .detection = "NOW, TODAY, RAND or RANDBETWEEN in a cell on which a result stands",
         .correction = "Type the date of the calibration into a cell, and compute with that.",
         .question = "For which day was the issued uncertainty computed, and how is it found again?",
         .examine = volatile_function},
        {.id = "W04",
         .title = "Numbers of readings differ",
         .clause = {.text = "JCGM 100:2008, 4.2.3", .verified = true},
         .needs = {Need::workbook},
         .detection = "text among readings; n of the divisor is not the number of readings in the range; STDEV.P of "
                      "readings about their own mean, unless √(n − 1) divides it; s/n of n readings, asked where these "
                      "are of n pieces together",
         .correction = "Correct the reading, and divide by the root of the number of readings that count.",
         .question = "How many readings were taken, and which of them count?",
         .examine = count_of_readings},
        {.id = "W05",
         .title = "One cell feeds two rows by an absolute address",
         .clause = {.text = "JCGM 100:2008, 4.3.10", .verified = true},
         .needs = {Need::workbook},
         .detection =
             "two rows of a budget read the same number, one of them by an absolute address; u of a row computed "
             "from what another row divides; the number of another row passed on by an absolute address",
         .correction = "Let each row read its own cell, or leave the second row out.",
         .question = "Which cell was the second row meant to read?",
         .examine = stray_address},
        {.id = "W06",
         .title = "A reading is read twice, another never",
         .clause = k_data_transfer,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::workbook},
         .detection = "a column of copies of readings reads one cell twice",
         .correction = "Copy each reading once.",
         .question = "Which readings belong to the result?",
         .examine = reading_read_twice},
        {.id = "W07",
         .title = "Correction 0 with U 0",
         .clause = {.text = "ISO/IEC 17025:2017, 6.4.11", .verified = true},
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::workbook},
         .detection = "both columns of a table of a standard hold 0 or nothing",
         .correction = "Fill in the certificate, or take the point out of the table.",
         .question = "What does the certificate of the standard state at this point?",
         .examine = correction_without_uncertainty},
        {.id = "W08",
         .title = "Uncertainty of a standard not above 0",
         .clause = {.text = "ISO/IEC 17025:2017, 6.4.11", .verified = true},
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::workbook},
         .detection = "U ≤ 0 in a table of a standard",
         .correction = "Take U from the certificate of the standard.",
         .question = "What does the certificate of the standard state as U at this point?",
         .examine = uncertainty_not_positive},
        {.id = "W09",
         .title = "Component not in the sum",
         .clause = {.text = "JCGM 100:2008, 5.1.2", .verified = true},
         .needs = {Need::workbook},
         .detection = "the formula of u_c reads the contributions of other rows, and not this one",
         .correction = "Let the sum reach over all contributions.",
         .question = "Is the row left out on purpose, and why does it stand in the table?",
         .examine = component_left_out},
        {.id = "W10",
         .title = "MAX or MIN over text or nothing",
         .clause = k_data_control,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::workbook},
         .detection = "MAX or MIN over one number and cells with text or nothing",
         .correction = "Put the number that is meant into the cell, and let the formula fail where there is none.",
         .question = "Which floor should hold here, and since when has it been missing?",
         .examine = choice_over_text},
        {.id = "W11",
         .title = "Value of another workbook",
         .clause = k_data_transfer,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::workbook},
         .detection = "a formula names another workbook",
         .correction = "Bring the value into this workbook, with its source and version.",
         .question = "Which version of the other workbook was read, and who controls it?",
         .examine = value_of_another_workbook},
        {.id = "W12",
         .title = "Error value, or something hidden",
         .clause = k_data_control,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::minor,
         .needs = {Need::workbook},
         .detection = "#REF!, #VALUE! and their like, on any sheet, critical where a result is one; a hidden sheet, "
                      "row or column under a "
                      "result",
         .correction = "Repair or remove the cell; show what a result rests on.",
         .question = "What did the cell hold, and what still reads it?",
         .examine = error_in_chain},
        {.id = "W13",
         .title = "Units of time do not close",
         .clause = {.text = "JCGM 100:2008, 5.1.3", .verified = false},
         .needs = {Need::workbook},
         .detection =
             "a rate per year times days (of a function of dates, or a difference of two cells with dates), divided "
             "by something else than 365",
         .correction = "Divide days by 365.",
         .question = "Is the age of the calibration meant in days, months or years?",
         .examine = time_units},
        {.id = "W14",
         .title = "Computed and never used",
         .clause = k_evaluation,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::workbook},
         .detection = "a correction, drift or uncertainty that no formula reads and no result stands on",
         .correction = "Use it, or say why it does not count.",
         .question = "Was the correction meant to be applied?",
         .examine = computed_and_not_used},
        {.id = "W16",
         .title = "Workbook not protected",
         .clause = k_data_control,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::minor,
         .needs = {Need::workbook},
         .detection = "no sheet and no structure is protected",
         .correction = "Protect the cells with formulas, and note version and validation.",
         .question = "How is it made sure that the formulas are those that were validated?",
         .examine = not_protected},
        stored_value_rule(),
    };
}

}  // namespace gumcert::audit
