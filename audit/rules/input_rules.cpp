#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/comment_pieces.h"
#include "audit/row_edits.h"
#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "audit/rules/registry.h"
#include "audit/stated_outcome.h"
#include "text/numbers.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

constexpr double k_root_3 = std::numbers::sqrt3;
constexpr Clause k_type_b_limits{.text = "JCGM 100:2008, 4.3.7", .verified = true};
constexpr Clause k_certificate{.text = "JCGM 100:2008, 4.3.3", .verified = true};

/// What u divided by the number that it was made from may mean.
struct NamedRatio {
    double ratio;
    Sentence name;
};
/// The name of a ratio within 1 % and the digits of u; nullptr for a ratio that none has.
template <std::size_t N>
const NamedRatio* named(const std::array<NamedRatio, N>& ratios, const AuditedRow& row, double base) {
    for (const NamedRatio& one : ratios) {
        if (may_be_u(row, one.ratio * base)) {
            return &one;
        }
    }
    return nullptr;
}

/// What the printed digits of the number that a row starts from leave open, where it is `value`.
double left_open(const AuditedRow& row, double value) {
    return row.stated && is_about(row.stated->value, value, 1e-9) ? row.stated->half_step : 0.0;
}

/// Whether the columns of a table divide as they should and give u: a number of its words that says otherwise is not the
/// one that was divided ("accuracy over 1 year").
bool columns_divide_by(const AuditedRow& row, double divisor) {
    return row.stated && row.divisor &&
           std::abs(row.divisor->value - divisor) <= row.divisor->half_step + 0.01 * divisor &&
           !u_differs(row, std::abs(row.stated->value) / divisor, 0.01, row.stated->half_step / divisor);
}

/// "u = 0.4 µm", and what it comes from.
std::vector<Sentence> evidence_of(const AuditedRow& row, const Sentence& base_name, double base) {
    return {equals("u", in_words(row.used_u, row.unit)), equals(base_name, in_words(base, row.unit))};
}

/// A finding about u that should be another number.
/// \param shape  that u should have been made of
void add_other_u(const RowAt& at, FindingCollector& findings, Sentence what, std::vector<Sentence> evidence,
                 double expected, Shape shape) {
    AuditFinding finding = finding_at(at, "u", std::move(what));
    finding.evidence = std::move(evidence);
    finding.expected = say_number(in_words(expected, at.is.unit));
    finding.actual = say_number(in_words(at.is.used_u, at.is.unit));
    finding.correct = set_u_and_shape(at.row, expected, shape);
    findings.add(std::move(finding));
}

/// What was made of the half-width of a distribution; a shape that is not stated counts as rectangular.
Sentence what_was_done(Shape shape, const std::string& half_width, const Sentence& done) {
    switch (shape) {
        case Shape::triangular:
            return say("the half-width {a:number} of a triangular distribution is {done}", half_width, done);
        case Shape::arcsine:
            return say("the half-width {a:number} of an arcsine distribution is {done}", half_width, done);
        default:
            return say("the half-width {a:number} of a rectangular distribution is {done}", half_width, done);
    }
}

/// U08
void wrong_divisor(const AuditSubject& subject, FindingCollector& findings) {
    static const std::array<NamedRatio, 8> k_ratios = {{
        {1.0, say("not divided at all")},
        {2.0 / k_root_3, say("divided as its double: the whole width stands where the half belongs")},
        {0.5, say("divided by 2")},
        {1.0 / 3.0, say("divided by 3: the root was not taken")},
        {1.0 / std::numbers::sqrt2, say("divided by √2, as an arcsine distribution")},
        {1.0 / std::sqrt(6.0), say("divided by √6, as a triangular distribution")},
        {1.0 / std::sqrt(12.0), say("divided by √12, as if it were the full width")},
        {1.0 / std::sqrt(k_root_3), say("divided by the fourth root of 3: the root was taken twice")},
    }};
    const bool has_formulas = subject.workbook != nullptr;
    for_each_row(subject, [&findings, has_formulas](const RowAt& at) {
        const AuditedRow& row = at.is;
        const bool is_limit = row.origin == Origin::limits || row.origin == Origin::specification;
        const bool may_be =
            is_limit || (row.origin == Origin::not_stated && row.stated && row.shape != Shape::not_stated);
        if (!may_be || row.type_a.value_or(false) || row.cyclic || row.lower_limit || !(row.used_u > 0.0)) {
            return;
        }
        const double half_width = number_divided(row);
        const std::optional<double> of_shape =
            divisor_of_shape(row.shape == Shape::not_stated ? Shape::rectangular : row.shape);
        if (!of_shape || !(half_width > 0.0)) {
            return;  // another shape has no divisor of its own
        }
        const double divisor = *of_shape;
        const double expected = half_width / divisor;
        if (!u_differs(row, expected, 0.01, left_open(row, half_width) / divisor)) {
            return;
        }
        const bool consistent = row.divisor && row.stated &&
                                !u_differs(row, std::abs(row.stated->value / row.divisor->value), 0.003,
                                           std::abs(row.stated->half_step / row.divisor->value));
        const bool slip = mentions(row, {"\u00B1", "+/-"}) && is_slip_of(row, half_width);
        if (consistent && !slip && row.shape != Shape::not_stated &&
            !is_about(row.divisor->value, std::sqrt(12.0), 0.003)) {
            return;  // W02: the table shows the divisor that it used
        }
        if (has_formulas && row.divisor && is_about(half_width / row.used_u, std::pow(3.0, 0.25), 2e-3)) {
            return;  // W01: the formula shows it
        }
        const bool unity = is_about(row.used_u, half_width), half = is_about(row.used_u, 0.5 * half_width);
        if (row.origin == Origin::specification && (unity || half)) {
            return;  // U10 and U24
        }
        // A table may state the full width, unless it says that the number is a half-width.
        const bool full_width = !u_differs(row, half_width / std::sqrt(12.0));
        if (full_width && !mentions(row, {"\u00B1", "+/-", "half-width", "half width", "halbweite", "halbbreite"})) {
            return;
        }
        // The ratio of u to what it was made from says which slip it was: most of them are one division or root too
        // many or too few.
        const NamedRatio* ratio = named(k_ratios, row, half_width);
        // In the words alone a number that no slip makes to u is that of something else: "power supply (230 ± 5) V" in mV.
        const double decades = std::log10(expected / row.used_u);
        const bool is_decimal_slip = std::abs(decades) > 0.5 && std::abs(decades - std::round(decades)) < 0.005;
        const bool is_by_root = is_about(row.used_u, half_width / k_root_3);
        if (ratio == nullptr && !row.stated && !is_decimal_slip && !is_by_root) {
            return;
        }
        const bool right_divisor =
            row.divisor && std::abs(row.divisor->value - divisor) <= row.divisor->half_step + 0.01 * divisor;
        if (!slip && (columns_divide_by(row, divisor) || (right_divisor && ratio == nullptr))) {
            return;
        }
        // Any other divisor may belong to a distribution that nobody states; √12 of a half-width belongs to none.
        if (row.shape == Shape::not_stated && !((unity || full_width) && row.origin == Origin::limits)) {
            return;
        }
        add_other_u(at, findings,
                    what_was_done(row.shape, in_words(half_width, row.unit),
                                  ratio != nullptr ? ratio->name
                                  : slip           ? say("{stated:number} in the column that is divided",
                                                         in_words(std::abs(row.stated->value), row.unit))
                                         : say("divided by {divisor:number}", in_words(half_width / row.used_u))),
                    evidence_of(row, "a", half_width), expected,
                    row.shape == Shape::not_stated ? Shape::rectangular : row.shape);
    });
}

/// d where a text says that something is d/√12: "0.0289 = 0.1/sqrt(12)".
std::optional<double> step_in_words(const std::string& text) {
    for (const std::string_view root : {"/sqrt(12)", "/ sqrt(12)", "/√12", "/ √12", "/√(12)", "/wurzel(12)"}) {
        const std::size_t at = text.find(root);
        const std::size_t last = at == std::string::npos || at == 0 ? at : text.find_last_not_of(' ', at - 1);
        if (at == std::string::npos || at == 0 || last == std::string::npos) {
            continue;
        }
        const std::size_t before = text.find_last_not_of("0123456789.,", last);
        const std::size_t begin = before == std::string::npos ? 0 : before + 1;
        if (const std::optional<StatedNumber> step = read_number(text.substr(begin, last + 1 - begin), "")) {
            return step->value;
        }
    }
    return std::nullopt;
}

/// U09 of a row that is called repeatability, and is the step of a display.
void resolution_called_repeatability(const RowAt& at, FindingCollector& findings) {
    const AuditedRow& row = at.is;
    const bool has_readings = row.n || !row.readings.empty() || std::isfinite(row.used_nu);
    const std::optional<double> step = row.contributor == Contributor::repeatability && !has_readings
                                           ? step_in_words(text::in_small_letters(row.comment + " " + row.source))
                                           : std::nullopt;
    if (!step || !(*step > 0.0) || u_differs(row, *step / std::sqrt(12.0))) {
        return;
    }
    AuditFinding finding = finding_at(at, "u",
                                      say("{root:number}/√12 is the standard uncertainty of a step of {step:number}, "
                                          "and the row is called repeatability: no readings stand behind it",
                                          in_words(*step, row.unit), in_words(*step, row.unit)));
    finding.evidence = {equals("u", in_words(row.used_u, row.unit)), equals("√12 u", in_words(*step, row.unit))};
    finding.correction = "Call the row a resolution, and add the repeatability from readings, with its ν.";
    finding.question = "From how many readings does the repeatability come?";
    finding.contribution_missing = true;
    findings.add(std::move(finding));
}

/// U09: d/√12, and √2 d/√12 for a difference of two readings.
void wrong_resolution(const AuditSubject& subject, FindingCollector& findings) {
    static const std::array<NamedRatio, 5> k_ratios = {{
        {1.0, say("the whole step stands as a standard uncertainty")},
        {1.0 / k_root_3, say("the whole step is divided by √3, where half of it is the limit")},
        {0.5, say("half of the step stands as a standard uncertainty")},
        {1.0 / 6.0, say("half of the step is divided by 3: the root was taken twice, or not at all")},
        {0.5 / std::sqrt(12.0), say("half of the step is divided by √12, which belongs to the whole step")},
    }};
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        resolution_called_repeatability(at, findings);
        if (row.origin != Origin::resolution || !row.origin_value || !(*row.origin_value > 0.0) ||
            row.shape == Shape::triangular || row.shape == Shape::arcsine || row.type_a.value_or(false)) {
            return;
        }
        const double step = *row.origin_value;
        const NamedRatio* ratio = named(k_ratios, row, step);
        // A column of half-widths may hold half of the step already.
        // Told only where the ratio is that of a known slip. d/√12 is one reading, √2 d/√12 = d/√6 the difference of
        // two.
        if (ratio == nullptr || !u_differs(row, step / std::sqrt(12.0)) || !u_differs(row, step / std::sqrt(6.0)) ||
            (is_step_of_column(row) && ratio->ratio > 0.5)) {
            return;
        }
        add_other_u(at, findings, say("resolution {step:number}: {ratio}", in_words(step, row.unit), ratio->name),
                    evidence_of(row, say("step"), step), step / std::sqrt(12.0), Shape::rectangular);
    });
}

/// U10: a maximum permissible error bounds an instrument that conforms; its standard uncertainty is MPE/√3.
void maximum_permissible_error_as_u(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        if (at.is.origin != Origin::specification || !at.is.origin_value ||
            !is_about(at.is.used_u, *at.is.origin_value) || !may_be_u(at.is, *at.is.origin_value)) {
            return;
        }
        const bool is_other = at.is.shape == Shape::triangular || at.is.shape == Shape::arcsine;
        add_other_u(at, findings,
                    say("the maximum permissible error {limit:number} stands as the standard uncertainty; an "
                        "instrument that conforms lies within ± that limit",
                        in_words(*at.is.origin_value, at.is.unit)),
                    evidence_of(at.is, "MPE", *at.is.origin_value),
                    is_other ? *u_by_words(at.is) : *at.is.origin_value / k_root_3,
                    is_other ? at.is.shape : Shape::rectangular);
    });
}

/// U24
void half_of_permissible_error(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        if (row.origin != Origin::specification || !row.origin_value || !(*row.origin_value > 0.0) ||
            row.certificate_k || row.certificate_probability || row.shape == Shape::triangular ||
            row.shape == Shape::arcsine || !may_be_u(row, 0.5 * *row.origin_value)) {
            return;
        }
        add_other_u(at, findings,
                    say("the maximum permissible error {limit:number} is divided by 2, as if it were an "
                        "expanded uncertainty with k = 2",
                        in_words(*row.origin_value, row.unit)),
                    evidence_of(row, "MPE", *row.origin_value), *row.origin_value / k_root_3, Shape::rectangular);
    });
}

/// U11
void specification_beside_certificate(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        if (row.origin != Origin::specification || !row.certificate_U || !(*row.certificate_U > 0.0)) {
            return;
        }
        const double k = row.certificate_k.value_or(2.0), u = *row.certificate_U / k;
        if (!u_differs(row, u)) {
            return;
        }
        AuditFinding finding =
            finding_at(at, "u",
                       say("the specification is used although a certificate with U = {U:number} is named",
                           in_words(*row.certificate_U, row.unit)));
        finding.evidence = {equals("u", in_words(row.used_u, row.unit)),
                            equals("U", in_words(*row.certificate_U, row.unit)),
                            row.certificate_k ? equals("k", in_words(k)) : say("k = 2 taken, because none is stated")};
        finding.expected = say("{u:number}, with the corrections of the certificate applied", in_words(u, row.unit));
        finding.actual = say_number(in_words(row.used_u, row.unit));
        finding.correct = set_u_and_shape(at.row, u, Shape::normal);
        // The specification is wider than the certificate: the budget is on the safe side, and the finding minor
        // whatever its effect.
        if (u < row.used_u) {
            finding.at_most = FindingSeverity::minor;
        }
        findings.add(std::move(finding));
    });
}

/// U12
void specification_without_evidence(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        if (at.is.origin != Origin::specification ||
            mentions(at.is, {"conform", "verif", "certificate", "cert.", "kalibrierschein", "geprüft", "eich",
                             "zertifikat", "inspect", "checked", "tested"})) {
            return;
        }
        if (!reads_words(at.of, at.is.place, findings)) {
            return;
        }
        AuditFinding finding = finding_at(
            at, "", say("a specification is used, and nothing says that the instrument was found to conform to it"));
        finding.evidence = {equals("u", in_words(at.is.used_u, at.is.unit))};
        if (at.is.origin_value) {
            finding.evidence.push_back(equals(say("limit"), in_words(*at.is.origin_value, at.is.unit)));
        }
        findings.add(std::move(finding));
    });
}

/// Whether a row divides the sum of several equal U, and its words say so: "two weights, U = 0.05 mg each". Of standards that
/// are correlated with r = 1 the uncertainties add up (JCGM 100:2008, 5.2.2, note 1).
bool is_of_several(const AuditedRow& row, double U) {
    constexpr double k_most = 20.0;
    const double times = row.stated ? std::abs(row.stated->value) / U : 0.0;
    return times > 1.5 && times <= k_most && is_about(times, std::round(times)) &&
           mentions(row, {" each", "both ", "two ", "three ", " je ", "jeweils", "beide", "zwei ", "drei ", "cada ",
                          "2 x ", "2 × ", "2×", "2x", "added linearly", "linear addiert"});
}

/// U of the columns where the words state its k alone, "Standard, certificate (k = 2.65)", and the table divides it by another one:
/// by a usual k that the words do not name. A root is of a limit or of several, k times a number of several; 1 divides what has been
/// divided, and 1.96 is near enough to a k of 2.
std::optional<double> divided_by_other_k(const AuditedRow& row) {
    constexpr double k_near = 0.03, k_digits = 0.002;
    constexpr std::array k_usual{1.645, 1.65, 1.96, 2.0, 2.576, 2.58, 3.0};
    const bool may_be_U = row.shape == Shape::normal || row.shape == Shape::student_t || row.shape == Shape::not_stated;
    if (!row.stated || !row.divisor || !row.certificate_k || !(*row.certificate_k > 0.0) || !may_be_U) {
        return std::nullopt;
    }
    const double divisor = row.divisor->value, k = *row.certificate_k;
    const bool is_usual = std::any_of(k_usual.begin(), k_usual.end(),
                                      [divisor](double usual) { return is_about(divisor, usual, k_digits); });
    const double squared = divisor * divisor / (k * k);
    const bool is_multiple = squared > 1.5 && is_about(squared, std::round(squared), 2.0 * k_digits);
    if (!is_usual || is_multiple || is_about(divisor, k, k_near)) {
        return std::nullopt;
    }
    // Another k, or how one came from the other.
    const Pieces pieces = pieces_of(words_of_row(row) + "; " + row.description, row.decimal_sign);
    const auto symbols =
        std::count_if(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.raw == "k"; });
    const bool is_named = std::any_of(pieces.begin(), pieces.end(), [divisor](const Piece& piece) {
        return piece.is_number() && is_about(std::abs(piece.value), divisor, k_digits);
    });
    constexpr double k_usual_p = 0.96;  // "(k = 2), 99 % limits"
    if (symbols > 1 || is_named || row.certificate_probability.value_or(0.0) > k_usual_p ||
        mentions(row, {"convert", "recalc",  "umgerechn", "umrechn", "halved",  "half",    "halb",  "pair",
                       "paar",    "piece",   "stück",     "mean",    "average", "mittel",  " each", "both",
                       "two ",    "three ",  "zwei ",     "drei ",   "beide",   "jeweils", "share", "anteil",
                       "several", "mehrere", "limit",     "toleran", "grenz"})) {
        return std::nullopt;
    }
    return std::abs(row.stated->value);
}

/// U13
void certificate_by_wrong_k(const AuditSubject& subject, FindingCollector& findings) {
    static const std::array<NamedRatio, 5> k_ratios = {{
        {1.0, say("U stands as a standard uncertainty")},
        {1.0 / k_root_3, say("U is divided by √3, as if it were the limit of a rectangular distribution")},
        {0.5, say("U is divided by 2")},
        {1.0 / 1.96, say("U is divided by 1.96")},
        {1.0 / 3.0, say("U is divided by 3")},
    }};
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        const std::optional<double> stated = row.origin_value ? row.origin_value : divided_by_other_k(row);
        if (row.origin != Origin::certificate || !stated || !row.certificate_k || !(*stated > 0.0) ||
            !(*row.certificate_k > 0.0)) {
            return;
        }
        const double U = *stated, k = *row.certificate_k;
        // U with one digit leaves much open, but not by what the table divides it.
        const bool other_divisor = row.divisor && row.stated && is_about(row.stated->value, U, 1e-9) &&
                                   std::abs(row.divisor->value - k) > row.divisor->half_step + 0.01 * k &&
                                   columns_divide_by(row, row.divisor->value);
        if (!other_divisor && !u_differs(row, U / k, 0.01, left_open(row, U) / k)) {
            return;
        }
        if (columns_divide_by(row, k) && (!is_slip_of(row, U) || is_of_several(row, U))) {
            return;
        }
        const NamedRatio* ratio = named(k_ratios, row, U);
        // The columns have another number with bounds and its divisor: the certificate is named beside it, as evidence of
        // conformity for instance.
        const bool has_other_number = ratio == nullptr && row.stated &&
                                      !is_about(std::abs(row.stated->value), U, 0.01) && !is_slip_of(row, U) &&
                                      ((row.shape == Shape::rectangular && columns_divide_by(row, k_root_3)) ||
                                       (row.shape == Shape::triangular && columns_divide_by(row, std::sqrt(6.0))) ||
                                       (row.shape == Shape::arcsine && columns_divide_by(row, std::numbers::sqrt2)));
        if (has_other_number) {
            return;
        }
        add_other_u(
            at, findings,
            say("{done}; the certificate states k = {k:number}",
                ratio != nullptr ? ratio->name
                                 : say("U is divided by {divisor:number}", in_words(U / std::max(row.used_u, 1e-300))),
                in_words(k)),
            {equals("u", in_words(row.used_u, row.unit)), equals("U", in_words(U, row.unit)), equals("k", in_words(k))},
            U / k, row.shape == Shape::student_t ? Shape::student_t : Shape::normal);
    });
}

/// U14
void certificate_without_k(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        // What a table takes as limits has the divisor of its distribution, and needs no k (JCGM 100:2008, 4.3.7).
        const bool has_limits = row.shape == Shape::rectangular || row.shape == Shape::triangular ||
                                row.shape == Shape::arcsine || row.shape == Shape::trapezoidal;
        if (row.origin != Origin::certificate || row.certificate_k || row.certificate_probability || row.divisor ||
            has_limits) {
            return;
        }
        // What a certificate states as a standard uncertainty has no k, and a drift between two certificates is no U.
        const bool is_standard =
            row.origin_value && is_about(row.used_u, *row.origin_value) &&
            mentions(row, {"standard uncertainty", "standardunsicherheit", "standardmessunsicherheit"});
        if (is_standard || row.contributor == Contributor::reference_drift) {
            return;
        }
        if (!reads_words(at.of, at.is.place, findings)) {
            return;
        }
        const bool halved = row.origin_value && is_about(row.used_u, 0.5 * *row.origin_value);
        AuditFinding finding =
            finding_at(at, "",
                       halved ? say("neither k nor p of the certificate is on record; k = 2 is assumed")
                              : say("neither k nor p of the certificate is on record"));
        finding.evidence = {equals("u", in_words(row.used_u, row.unit))};
        if (row.origin_value) {
            finding.evidence.push_back(equals("U", in_words(*row.origin_value, row.unit)));
        }
        findings.add(std::move(finding));
    });
}

/// U15
void wrong_base(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        const double number = row.stated ? std::abs(row.stated->value) : row.origin_value.value_or(0.0);
        if (!row.relative_uncertainty || !row.full_scale || !row.estimate || !(number > 0.0)) {
            return;
        }
        const double reading = std::abs(row.estimate->value), full = std::abs(*row.full_scale);
        const bool of_full = row.relative_to == RelativeTo::full_scale;
        const double right = of_full ? full : reading, wrong = of_full ? reading : full;
        const double r = *row.relative_uncertainty;
        constexpr double k_same = 0.02;  // both bases agree near the end of the range
        if (row.relative_to == RelativeTo::not_stated || !(right > 0.0) || is_about(right, wrong, k_same) ||
            std::abs(number - r * wrong) > left_open(row, number) + 0.01 * r * wrong) {
            return;
        }
        AuditFinding finding = finding_at(at, "stated",
                                          of_full ? say("a part of the full scale is taken of the reading")
                                                  : say("a part of the reading is taken of the full scale"));
        finding.evidence = {say("{share:number} %", text::significant(100.0 * r, 4)),
                            equals(say("reading"), in_words(reading, row.unit)),
                            equals(say("full scale"), in_words(full, row.unit))};
        finding.expected = say_number(in_words(r * right, row.unit));
        finding.actual = say_number(in_words(number, row.unit));
        finding.correct = scale_u(at.row, right / wrong);
        findings.add(std::move(finding));
    });
}

/// U16
void another_point(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        if (!row.certificate_low || !row.certificate_high || !row.estimate) {
            return;
        }
        const double x = row.estimate->value, low = *row.certificate_low, high = *row.certificate_high;
        // Certificates name their points by nominal values, and the estimate is a measured value near one of them.
        const double near = row.estimate->half_step + 1e-3 * std::max(std::abs(low), std::abs(high));
        // A row of a fit or of an interpolation stands for the way from the calibrated points to this one.
        const bool interpolated = std::any_of(at.of.rows.begin(), at.of.rows.end(), [](const AuditedRow& other) {
            return other.contributor == Contributor::fit && other.in_sum && other.used_u > 0.0;
        });
        if (interpolated || (x >= low - near && x <= high + near)) {
            return;
        }
        AuditFinding finding = finding_at(
            at, "",
            low == high ? say("the certificate holds at {low:number}, and is used at {x:number} without a term of "
                              "interpolation",
                              in_words(low, row.unit), in_words(x, row.unit))
                        : say("the certificate holds from {low:number} to {high:number}, and is used at {x:number}",
                              in_words(low, row.unit), in_words(high, row.unit), in_words(x, row.unit)));
        finding.evidence = {equals("u", in_words(row.used_u, row.unit))};
        finding.contribution_missing = true;
        findings.add(std::move(finding));
    });
}

/// U17
void asymmetric_limits(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        if (!row.lower_limit || !row.upper_limit) {
            return;
        }
        const double below = -*row.lower_limit, above = *row.upper_limit;
        // Rectangular between the two limits (JCGM 100:2008, 4.3.8), whose middle is not the estimate.
        const double expected = (below + above) / std::sqrt(12.0);
        if (!(below > 0.0) || !(above > 0.0) || is_about(below, above, 0.02) || !u_differs(row, expected)) {
            return;
        }
        add_other_u(at, findings,
                    say("the limits are not symmetric about the estimate, and u is not their distance divided by √12"),
                    {equals("u", in_words(row.used_u, row.unit)),
                     say("limits {below:number} and +{above:number} from the estimate", in_words(-below, row.unit),
                         in_words(above, row.unit)),
                     say("middle of the limits {middle:number} beside the estimate",
                         in_words(0.5 * (above - below), row.unit))},
                    expected, Shape::rectangular);
    });
}

/// U18
void impossible_entries(const AuditSubject& subject, FindingCollector& findings) {
    struct Entry {
        const std::optional<StatedNumber>* number;
        const char* column;
        Sentence name;
        bool may_be_negative, may_be_infinite, may_be_zero;
    };
    for_each_row(subject, [&findings](const RowAt& at) {
        const Entry entries[] = {
            {&at.is.u, "u", "u", false, false, true},
            {&at.is.divisor, "divisor", say("divisor"), false, false, false},
            {&at.is.sensitivity, "sensitivity coefficient", say("sensitivity coefficient"), true, false, true},
            {&at.is.nu, "ν", "ν", false, true, false}};
        for (const Entry& entry : entries) {
            if (!*entry.number) {
                continue;
            }
            const double value = (*entry.number)->value;
            const bool negative = !entry.may_be_negative && value < 0.0;
            const bool zero = !entry.may_be_zero && value == 0.0;
            const bool not_finite = std::isnan(value) || (std::isinf(value) && !entry.may_be_infinite);
            if (!negative && !zero && !not_finite) {
                continue;
            }
            AuditFinding finding = finding_at(at, entry.column,
                                              negative ? say("a negative number, which it cannot be")
                                              : zero   ? say("0, which it cannot be")
                                                       : say("no number"));
            finding.evidence = {equals(entry.name, not_finite ? say("not finite") : Sentence(in_words(value)))};
            if (negative && entry.number == &at.is.u) {
                finding.correct = set_u(at.row, -value);
            }
            findings.add(std::move(finding));
        }
    });
}

/// U19
void reliability_without_nu(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        if (!row.reliability || !(*row.reliability > 0.0) || std::isfinite(row.used_nu)) {
            return;
        }
        // ν = ½ (Δu/u)⁻² (JCGM 100:2008, G.4.2): "reliable to 25 %" is worth 8 degrees of freedom.
        const double nu = 0.5 / (*row.reliability * *row.reliability);
        AuditFinding finding =
            finding_at(at, "ν",
                       say("u is said to be reliable to about {reliability:number} %, and counts as exactly known",
                           text::significant(100.0 * *row.reliability, 3)));
        finding.evidence = {equals("Δu/u", in_words(*row.reliability)), equals("u", in_words(row.used_u, row.unit))};
        finding.expected = equals("ν", in_words(nu));
        finding.actual = say("ν infinite");
        finding.correct = set_degrees_of_freedom(at.row, nu);
        findings.add(std::move(finding));
    });
}

/// U20
void cyclic_quantity(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        const double amplitude = number_divided(row);
        // A quantity that swings as a sine between ± a is longest at its limits: arcsine, u = a/√2. Readings and
        // certificates know more of it than that.
        const bool is_denied =
            mentions(row, {"negligib", "vernachl", "no cyclic", "not cyclic", "keine zyklisch", "nicht zyklisch"});
        if (!row.cyclic || is_denied || row.type_a.value_or(false) || row.origin == Origin::certificate ||
            !(amplitude > 0.0) || row.used_u + row.u_half_step >= 0.99 * amplitude / std::numbers::sqrt2) {
            return;
        }
        add_other_u(at, findings,
                    say("the quantity swings between its limits {amplitude:number} on either side; most of the time it "
                        "is near them",
                        in_words(amplitude, row.unit)),
                    evidence_of(row, "a", amplitude), amplitude / std::numbers::sqrt2, Shape::arcsine);
    });
}

/// U23
void value_as_its_own_uncertainty(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        const bool other_origin = row.origin == Origin::resolution || row.origin == Origin::specification ||
                                  row.origin == Origin::certificate;
        if (!row.estimate || row.estimate->value == 0.0 || other_origin || row.type_a.value_or(false) ||
            row.contributor == Contributor::item_resolution || row.contributor == Contributor::reference_resolution) {
            return;
        }
        // The standard deviation of these is their mean, or follows from a count: JCGM 101:2008, 6.4.10 and 6.4.11.
        if (row.shape_text == "exponential" || row.shape_text == "gamma") {
            return;
        }
        const double x = std::abs(row.estimate->value);
        const bool copied = row.stated ? row.stated->value == x
                                       : is_about(row.used_u, x, 1e-4) || is_about(row.used_u, x / k_root_3, 1e-4);
        // A column of values that says what it limits holds no estimates.
        if (!copied || (row.origin_value && is_about(*row.origin_value, x, 1e-9))) {
            return;
        }
        AuditFinding finding = finding_at(at, "u", say("the value of the quantity stands as its own uncertainty"));
        finding.evidence = {equals(say("estimate"), in_words(row.estimate->value, row.unit)),
                            equals("u", in_words(row.used_u, row.unit))};
        // How well the value is known, nobody but the laboratory can say; U is at least what the other rows give.
        AuditedBudget without = at.of;
        leave_out(at.row)(without);
        if (const std::optional<BudgetOutcome> outcome = outcome_or_none(without)) {
            finding.evidence.push_back(say("without this row U = {U:number}", in_words(outcome->U, at.of.unit)));
        }
        findings.add(std::move(finding));
    });
}

/// Whether the correction of another finding gives the row another u, or what the row contributes with its quotient: what
/// is wrong with it is told then.
bool is_told(const RowAt& at, double quotient, std::span<const AuditFinding> others) {
    return std::any_of(others.begin(), others.end(), [&at, quotient](const AuditFinding& other) {
        const Correction* correction = correction_of(other, at.budget);
        if (correction == nullptr) {
            return false;
        }
        AuditedBudget corrected = at.of;
        (*correction)(corrected);
        const AuditedRow& row = corrected.rows[at.row];
        return row.used_u != at.is.used_u ||
               (row.used_sensitivity != at.is.used_sensitivity &&
                is_about(row.used_sensitivity * row.used_u, at.is.used_sensitivity * quotient));
    });
}

/// U26 of one row.
void add_other_quotient(const RowAt& at, std::span<const AuditFinding> others, FindingCollector& findings) {
    const AuditedRow& row = at.is;
    const StatedNumber quotient = *quotient_of_columns(row);
    const double u = std::abs(row.u->value), stated = std::abs(row.stated->value);
    const std::optional<double> by_words = u_by_words(row);
    const bool is_of_words = by_words && !u_differs(row, *by_words);
    const bool is_told_of_divisor = std::any_of(others.begin(), others.end(), [&row, &at](const AuditFinding& other) {
        return other.rule == "W02" && other.where.starts_with(row.place + " (") &&
               std::find(other.budgets.begin(), other.budgets.end(), at.budget) != other.budgets.end();
    });
    if (is_of_words && is_told_of_divisor) {
        return;
    }
    const bool is_summed = u_differs(row, u, 1e-9) && is_about(row.used_u, quotient.value, 1e-9);
    AuditFinding finding = finding_at(
        at, "u",
        is_of_words && !is_summed
            ? say("u = {u:number} is what the words of the row give, and not what is divided over the divisor, "
                  "{stated:number}/{divisor:number}",
                  in_words(u, row.unit), in_words(stated), in_words(row.divisor->value))
        : is_summed
            ? say("u = {u:number} is not what is divided over the divisor, {stated:number}/{divisor:number}; the "
                  "sum was made of the latter",
                  in_words(u, row.unit), in_words(stated), in_words(row.divisor->value))
            : say("u = {u:number} is not what is divided over the divisor, {stated:number}/{divisor:number}",
                  in_words(u, row.unit), in_words(stated), in_words(row.divisor->value)));
    finding.evidence = {equals("u", in_words(u, row.unit)),
                        say("{stated:number}/{divisor:number} = {quotient:number}", in_words(stated),
                            in_words(row.divisor->value), in_words(quotient.value, row.unit))};
    finding.expected = say_number(in_words(quotient.value, row.unit));
    finding.actual = say_number(in_words(u, row.unit));
    if (is_of_words || is_summed) {
        findings.add(std::move(finding), FindingSeverity::minor);  // the result has the right u
        return;
    }
    finding.correct = set_u(at.row, quotient.value);
    findings.add(std::move(finding));
}

/// U26: the arithmetic of a row, whatever its words say.
void u_is_no_quotient(const AuditSubject& subject, std::span<const AuditFinding> others, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        std::vector<std::size_t> apart;
        std::size_t columns = 0;
        for (std::size_t r = 0; r < budget.rows.size() && !budget.evaluated_here; ++r) {
            columns += budget.rows[r].u && quotient_of_columns(budget.rows[r]) ? 1U : 0U;
            if (u_is_not_the_quotient(budget.rows[r])) {
                apart.push_back(r);
            }
        }
        // Columns that agree in hardly any row are not what their heads say, such as those of another unit.
        if (apart.size() > 1 && 2 * apart.size() > columns) {
            findings.leave_unchecked(
                say("{table}: in most rows u is not what is divided over the divisor; columns of "
                    "another unit or meaning are not held against each other",
                    budget.place));
            continue;
        }
        for (const std::size_t r : apart) {
            const RowAt at{.budget = b, .row = r, .of = budget, .is = budget.rows[r]};
            if (!is_told(at, quotient_of_columns(at.is)->value, others)) {
                add_other_quotient(at, others, findings);
            }
        }
    }
}

std::vector<Rule> type_b_rules() {
    using enum SeverityPolicy;
    using enum FindingSeverity;
    return {
        {.id = "U08",
         .title = "Divisor does not belong to the distribution",
         .clause = k_type_b_limits,
         .needs = {Need::rows},
         .detection = "a half-width a and a stated shape, and u other than a/√3 (rectangular), a/√6 (triangular), a/√2 "
                      "(arcsine); the ratio u/a says what was done",
         .correction = "Divide the half-width by the root that belongs to its distribution, once.",
         .question =
             "The number and its distribution give another standard uncertainty than the table has. Which of the "
             "two is meant, the divisor or the distribution?",
         .examine = wrong_divisor},
        {.id = "U09",
         .title = "Resolution divided by the wrong number, or called repeatability",
         .clause = {.text = "JCGM 100:2008, F.2.2.1", .verified = true},
         .needs = {Need::rows},
         .detection =
             "a row of a resolution d with u = d, d/√3, d/2, d/6 or d/(2√12); d/√12, and √2 d/√12 of a difference, are "
             "right; a repeatability without readings whose words say that it is d/√12",
         .correction = "u = d/√12 of a display with the step d; √2 times that for a difference of two readings.",
         .question = "Is the number in the table the step of the display, or half of it?",
         .examine = wrong_resolution},
        {.id = "U10",
         .title = "Maximum permissible error used as a standard uncertainty",
         .clause = k_type_b_limits,
         .needs = {Need::rows},
         .detection = "a row that comes from a specification, with u equal to the maximum permissible error",
         .correction = "Divide the maximum permissible error by √3, or state why another distribution is known.",
         .question = "Is the number the limit of a specification or a standard uncertainty, and who verified that the "
                     "instrument conforms?",
         .examine = maximum_permissible_error_as_u},
        {.id = "U11",
         .title = "Specification used although a certificate states U",
         .clause = {.text = "ISO/IEC 17025:2017, 6.4.11", .verified = false},
         .severity = minor,
         .needs = {Need::rows},
         .detection = "a row that comes from a specification, and names a certificate with U",
         .correction = "Use value and U of the certificate, and apply its corrections.",
         .question = "The certificate says more about this instrument than its specification. Why is the specification "
                     "used, and are the corrections of the certificate within it?",
         .examine = specification_beside_certificate},
        {.id = "U12",
         .title = "Specification without evidence of conformity",
         .clause = {.text = "ISO/IEC 17025:2017, A.2.3", .verified = false},
         .policy = fixed,
         .severity = major,
         .needs = {Need::rows},
         .detection = "a row that comes from a specification, whose words name no certificate, test or verification",
         .correction = "Name the document that states conformity, with its decision rule.",
         .question =
             "A limit says something about an instrument that was found within it. Which document states that, and "
             "by which decision rule?",
         .examine = specification_without_evidence},
        {.id = "U13",
         .title = "U of a certificate divided by another number than its k",
         .clause = k_certificate,
         .needs = {Need::rows},
         .detection = "u k ≠ U of the certificate, beyond the printed digits and 1 %",
         .correction = "Divide U by the coverage factor that the certificate states.",
         .question = "The certificate states U and k. Why is U divided by another number?",
         .examine = certificate_by_wrong_k},
        {.id = "U14",
         .title = "Coverage factor of a certificate not on record",
         .clause = k_certificate,
         .policy = fixed,
         .severity = major,
         .needs = {Need::rows},
         .detection = "a row that comes from a certificate, without k, p, a divisor or a distribution with limits",
         .correction = "Record k (or p and ν_eff) of the certificate.",
         .question = "Which coverage factor does the certificate state?",
         .examine = certificate_without_k},
        {.id = "U15",
         .title = "Relative uncertainty of the wrong base",
         .clause = {.text = "ISO/IEC 17025:2017, 7.8.4.1 a", .verified = false},
         .severity = critical,
         .needs = {Need::rows},
         .detection = "a percentage of full scale that was taken of the reading, or the reverse",
         .correction = "Multiply the percentage with the base that certificate or data sheet name.",
         .question = "Of what is the percentage a part: of the reading or of the full scale?",
         .examine = wrong_base},
        {.id = "U16",
         .title = "Certificate used at another point",
         .clause = {.text = "ISO/IEC 17025:2017, 7.6.1", .verified = false},
         .policy = fixed,
         .severity = major,
         .needs = {Need::rows},
         .detection =
             "an estimate outside of the points that the comment names of the certificate, and no row of a fit or "
             "interpolation",
         .correction = "Add a term for interpolation or extrapolation, or have the standard calibrated at the point.",
         .question = "How does the standard behave between and beyond its calibrated points, and where is that in the "
                     "budget?",
         .examine = another_point},
        {.id = "U17",
         .title = "Asymmetric limits treated as symmetric",
         .clause = {.text = "JCGM 100:2008, 4.3.8", .verified = true},
         .severity = minor,
         .needs = {Need::rows},
         .detection =
             "two limits at different distances from the estimate, and u other than their distance divided by √12",
         .correction = "u = (b₊ + b₋)/√12; better, move the estimate to where the value is expected.",
         .question = "The limits say that the value is rather on one side. Why is the estimate not in their middle?",
         .examine = asymmetric_limits},
        {.id = "U18",
         .title = "Impossible entry",
         .clause = {.text = "JCGM 100:2008, 4.3.1", .verified = false},
         .severity = critical,
         .needs = {Need::rows},
         .detection = "negative or missing numbers among u, divisor, sensitivity coefficient and ν",
         .correction = "Enter the number that was meant.",
         .question = "Which number was meant?",
         .examine = impossible_entries},
        {.id = "U19",
         .title = "Reliability stated, degrees of freedom infinite",
         .clause = {.text = "JCGM 100:2008, G.4.2", .verified = true},
         .severity = minor,
         .needs = {Need::rows},
         .detection = "words on the reliability of u, with ν infinite",
         .correction = "ν = ½ (Δu/u)⁻².",
         .question = "The sheet says how well u is known, and then counts it as exact. Which of the two is meant?",
         .examine = reliability_without_nu},
        {.id = "U20",
         .title = "Swinging quantity with too narrow a distribution",
         .clause = {.text = "JCGM 100:2008, H.1.3.4", .verified = false},
         .severity = information,
         .needs = {Need::rows},
         .detection = "a quantity that is said to swing in cycles, with u below a/√2",
         .correction = "Use the arcsine distribution, u = a/√2.",
         .question =
             "A quantity that swings is near its limits most of the time. Was that looked at, or is the record of "
             "the sensor at hand?",
         .examine = cyclic_quantity},
        {.id = "U23",
         .title = "Value used as its own uncertainty",
         .clause = {.text = "JCGM 100:2008, 4.3.1", .verified = false},
         .severity = major,
         .needs = {Need::rows},
         .detection = "u, or what is divided, is the estimate of the quantity itself",
         .correction = "State how well the quantity is known, and where that comes from.",
         .question = "The uncertainty of this quantity is its own value. How well is it really known?",
         .examine = value_as_its_own_uncertainty},
        {.id = "U24",
         .title = "Maximum permissible error divided by 2",
         .clause = k_type_b_limits,
         .needs = {Need::rows},
         .detection = "a row that comes from a specification, with u equal to half of the maximum permissible error",
         .correction = "Divide the maximum permissible error by √3, or record the k that belongs to it.",
         .question = "A limit has no coverage factor. Where does the 2 come from?",
         .examine = half_of_permissible_error},
        {.id = "U26",
         .title = "u is not what is divided over its divisor",
         .clause = {.text = "ISO/IEC 17025:2017, 7.11.6", .verified = false},
         .severity = major,
         .needs = {Need::rows},
         .detection =
             "what is divided, divisor and u of a row, with u other than their quotient beyond the printed "
             "digits and 1 %, whatever the words of the row say; not where another finding has the row already",
         .correction = "Compute u again from what is divided and its divisor, or correct these two.",
         .question = "Which of the three numbers was typed: what is divided, the divisor, or u?",
         .examine_rest = u_is_no_quotient},
    };
}

}  // namespace

std::vector<Rule> input_rules() {
    std::vector<Rule> all = type_a_rules(), type_b = type_b_rules();
    all.insert(all.end(), std::make_move_iterator(type_b.begin()), std::make_move_iterator(type_b.end()));
    std::sort(all.begin(), all.end(), [](const Rule& a, const Rule& b) { return a.id < b.id; });
    return all;
}

}  // namespace gumcert::audit
