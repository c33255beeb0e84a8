#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/row_meaning.h"
#include "audit/stated_outcome.h"
#include "audit/worksheets/cell_findings.h"
#include "audit/worksheets/worksheet_rules.h"
#include "audit/worksheets/worksheet_view.h"
#include "text/numbers.h"

namespace gumcert::audit {
namespace {

using workbook::CellPlace;
using workbook::FormulaNode;

constexpr Clause k_bounds_of_inputs{.text = "JCGM 100:2008, 4.3.7", .verified = true};

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
    const bool is_counted = divisor != nullptr && calls_one_of(divisor->formula, {"COUNT", "COUNTA", "ROWS"});
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

}  // namespace

std::vector<Rule> worksheet_divisor_rules() {
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
    };
}

}  // namespace gumcert::audit
