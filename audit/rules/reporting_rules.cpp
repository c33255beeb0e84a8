#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "audit/claims.h"
#include "audit/row_edits.h"
#include "audit/rules/gate_findings.h"
#include "audit/rules/registry.h"
#include "audit/stated_outcome.h"
#include "audit/word_line.h"

namespace gumcert::audit {
namespace {

constexpr Clause k_digits{.text = "ILAC-P14:09/2020, 5.3", .verified = true};
constexpr Clause k_coverage_stated{.text = "ILAC-P14:09/2020, 5.2", .verified = true};
constexpr Clause k_units_stated{.text = "ISO/IEC 17025:2017, 7.8.2.1 m", .verified = true};
constexpr Clause k_report_items{.text = "ISO/IEC 17025:2017, 7.8.2 and 7.8.4", .verified = true};
constexpr Clause k_intervals{.text = "ISO/IEC 17025:2017, 7.8.4.3", .verified = true};
constexpr Clause k_customer_data{.text = "ISO/IEC 17025:2017, 7.8.2.1 p and 7.8.2.2", .verified = true};
constexpr Clause k_clear_reports{.text = "ISO/IEC 17025:2017, 7.8.1.2", .verified = true};
constexpr Clause k_amendments{.text = "ISO/IEC 17025:2017, 7.8.8", .verified = true};

bool is_ascii_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Significant digits of a printed number. Zeros at the end of a whole number are none.
int digits_in(const StatedNumber& number) {
    std::string digits;
    bool decimal = false;
    for (const char c : number.text) {
        if (is_ascii_digit(c)) {
            digits += c;
        } else if ((c == '.' || c == ',') && !digits.empty()) {
            decimal = number.half_step > 0.0;  // else it sets thousands apart
        } else if (!digits.empty() && c != ' ' && c != '\'') {
            break;
        }
    }
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
    while (!decimal && digits.ends_with('0')) {
        digits.pop_back();
    }
    return static_cast<int>(digits.size());
}

/// Cells of a workbook have all digits; how they are printed is not known. Nor is it of one whose formulas were replaced by their numbers.
/// \param most  significant digits that somebody writes: a frequency has more of them than an uncertainty
bool is_printed(const AuditSubject& subject, const std::optional<StatedNumber>& number, int most) {
    return subject.kind != AuditSubject::Kind::workbook && number && !number->text.empty() &&
           digits_in(*number) <= most;
}

constexpr int k_most_of_U = 9, k_most_of_value = 14;  // a double shows 15 at least

/// Unit of the last digit of a printed number.
double last_place(const StatedNumber& number) {
    return number.half_step > 0.0 ? 2.0 * number.half_step : std::abs(number.scale);
}

/// A budget may be careless in its print where a certificate may not.
FindingSeverity milder_in_a_budget(const AuditSubject& subject, FindingSeverity on_a_certificate) {
    const bool budget = subject.kind == AuditSubject::Kind::table || subject.kind == AuditSubject::Kind::workbook;
    return budget ? static_cast<FindingSeverity>(static_cast<int>(on_a_certificate) - 1) : on_a_certificate;
}

/// R01
void too_many_digits(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const std::optional<StatedNumber>& U = subject.budgets[i].claims.U;
        if (!is_printed(subject, U, k_most_of_U) || digits_in(*U) <= 2) {
            continue;
        }
        AuditFinding finding = finding_of(
            subject, i, say("U is stated as {U:number}, with more than two significant digits", text_of_claim(*U)));
        finding.actual = say_number(text_of_claim(*U));
        findings.add(std::move(finding), milder_in_a_budget(subject, FindingSeverity::major));
    }
}

/// R02
void places_differ(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const Claims& claims = subject.budgets[i].claims;
        if (!is_printed(subject, claims.U, k_most_of_U) || !is_printed(subject, claims.value, k_most_of_value) ||
            is_about(last_place(*claims.U), last_place(*claims.value), 1e-6)) {
            continue;
        }
        AuditFinding finding = finding_of(subject, i,
                                          say("value {value:number} and U {U:number} end at different decimal places",
                                              text_of_claim(*claims.value), text_of_claim(*claims.U)));
        finding.actual = say("{value:number} ± {U:number}", text_of_claim(*claims.value), text_of_claim(*claims.U));
        findings.add(std::move(finding), milder_in_a_budget(subject, FindingSeverity::major));
    }
}

/// R03: the rows were rounded before they were added up.
void rounded_on_the_way(const AuditSubject& subject, FindingCollector& findings) {
    const auto unrounded = [](AuditedBudget& budget) {
        for (std::size_t r = 0; r < budget.rows.size(); ++r) {
            const AuditedRow& row = budget.rows[r];
            if (!row.stated || !row.divisor || !row.u || !(row.divisor->value > 0.0)) {
                continue;
            }
            const double u = std::abs(row.stated->value / row.divisor->value);
            // A printed u that is not the rounded quotient has another cause than rounding, and other rules tell it.
            if (row.u->interval().contains(u)) {
                unround_u(r, u)(budget);
            }
        }
    };
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        AuditedBudget exact = subject.budgets[i];
        if (exact.within_digits != 1.0) {
            continue;  // the claimed U follows from other digits than the rounded ones
        }
        const std::optional<BudgetOutcome> rounded = outcome_or_none(exact);
        unrounded(exact);
        const std::optional<BudgetOutcome> outcome = outcome_or_none(exact);
        if (!rounded || !outcome || rounded->rounded_U == outcome->rounded_U) {
            continue;
        }
        AuditFinding finding = finding_of(subject, i,
                                          say("U follows from rounded standard uncertainties: {rounded:number}, and "
                                              "{unrounded:number} from the numbers that they were rounded from",
                                              rounded->rounded_U, outcome->rounded_U));
        finding.expected = say_number(outcome->rounded_U);
        finding.actual = say_number(rounded->rounded_U);
        finding.correct = unrounded;
        findings.add(std::move(finding));
    }
}

/// Sentences of one rule that are different matters stay apart where budgets are put together.
AuditFinding matter_of(const AuditSubject& subject, std::size_t budget, const char* kind, Sentence what) {
    AuditFinding finding = finding_of(subject, budget, std::move(what));
    finding.kind = kind;
    return finding;
}

/// R04
void coverage_not_stated(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const Claims& claims = subject.budgets[i].claims;
        if (!claims.U || claims.U->value == 0.0) {  // what is exact by definition has no k
            continue;
        }
        const bool k = claims.k || WordLine(claims.coverage_sentence).has_any({"k ", "factor", "erweiterungsfaktor"});
        const bool p = claims.coverage_probability || claims.coverage_sentence.find('%') != std::string::npos;
        if (!k) {
            findings.add(matter_of(subject, i, "factor",
                                   p ? say("U is stated without its coverage factor")
                                     : say("U is stated without coverage factor and coverage probability")),
                         milder_in_a_budget(subject, FindingSeverity::critical));
        } else if (!p) {
            findings.add(matter_of(subject, i, "probability", say("U is stated without its coverage probability")),
                         milder_in_a_budget(subject, FindingSeverity::major));
        }
    }
}

/// "." or "," where a text has one as its decimal sign; none where it has both or neither.
char decimal_sign_of(const std::optional<StatedNumber>& number) {
    if (!number || number->half_step == 0.0 || number->scale != 1.0) {  // in another unit the digits are ours
        return ' ';
    }
    const bool point = number->text.find('.') != std::string::npos, comma = number->text.find(',') != std::string::npos;
    return point == comma ? ' ' : (point ? '.' : ',');
}

/// R05
void unit_or_sign_unclear(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        if (budget.unit.empty() && (budget.claims.U || budget.claims.u_c)) {
            findings.add(matter_of(subject, i, "unit", say("the result has no unit")));
        }
        std::string point, comma;
        const auto look = [&](const std::optional<StatedNumber>& number) {
            const char sign = decimal_sign_of(number);
            std::string& example = sign == '.' ? point : comma;
            if (sign != ' ' && example.empty()) {
                example = number->text;
            }
        };
        for (const AuditedRow& row : budget.rows) {
            for (const auto* number :
                 {&row.estimate, &row.stated, &row.divisor, &row.u, &row.sensitivity, &row.contribution}) {
                look(*number);
            }
        }
        for (const auto* number : {&budget.claims.value, &budget.claims.u_c, &budget.claims.U}) {
            look(*number);
        }
        if (subject.kind != AuditSubject::Kind::workbook && !point.empty() && !comma.empty()) {
            AuditFinding finding =
                matter_of(subject, i, "sign", say("decimal point and decimal comma stand in one table"));
            finding.evidence = {point, comma};
            findings.add(std::move(finding), FindingSeverity::major);
        }
    }
}

/// "10-6" with a minus sign that was raised once.
bool has_lost_exponent(const std::string& text) {
    for (const std::string sign : {"10-", "10−"}) {
        const std::size_t at = text.find(sign);
        // A digit before it makes another number, as in "2010-6".
        if (at != std::string::npos && at > 0 && at + sign.size() < text.size() &&
            is_ascii_digit(text[at + sign.size()]) && !is_ascii_digit(text[at - 1])) {
            return true;
        }
    }
    return false;
}
bool is_zero_with_minus(const std::string& text) {
    const bool minus = text.starts_with('-') || text.starts_with("−");
    return minus && text.find_first_of("123456789") == std::string::npos && text.find('0') != std::string::npos;
}

/// R06
void misprinted(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        const auto look = [&](const std::optional<StatedNumber>& number) {
            if (!number) {
                return;
            }
            if (is_zero_with_minus(number->text)) {
                findings.add(matter_of(subject, i, "zero",
                                       say("a zero is printed with a minus sign: {printed:number}", number->text)));
            }
            if (has_lost_exponent(number->text)) {
                findings.add(matter_of(subject, i, "exponent",
                                       say("an exponent is printed as a difference: {printed}", number->text)));
            }
        };
        for (const AuditedRow& row : budget.rows) {
            look(row.estimate);
            look(row.u);
            look(row.sensitivity);
        }
        look(budget.claims.value);
        look(budget.claims.U);
    }
}

}  // namespace

std::vector<Rule> reporting_rules() {
    return {
        {.id = "R01",
         .title = "More than two significant digits in U",
         .clause = k_digits,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::claims},
         .detection = "digits of the printed U; a degree milder in a table, not looked for in a workbook; finding R01 "
                      "of the gates",
         .correction = "Round U to two significant digits at most.",
         .question = "Is this the number on the certificate?",
         .examine = too_many_digits},
        {.id = "R02",
         .title = "Value and U end at different places",
         .clause = k_digits,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::claims},
         .detection = "last places of printed value and U; a degree milder in a table, not looked for in a workbook; "
                      "finding R02 of the gates",
         .correction = "Round the value to the last place of U.",
         .question = "Is this the number on the certificate?",
         .examine = places_differ},
        {.id = "R03",
         .title = "Intermediate rounding",
         .clause = k_digits,
         .severity = FindingSeverity::minor,
         .needs = {Need::rows},
         .detection =
             "U from the printed standard uncertainties, and from what they were divided from; finding M02 of the "
             "gates",
         .correction = "Add up the unrounded numbers, and round at the end only.",
         .question = "Does the sheet round between its steps?",
         .examine = rounded_on_the_way},
        {.id = "R04",
         .title = "Coverage factor or probability not stated",
         .clause = k_coverage_stated,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::claims},
         .detection =
             "U without k in a number or in the sentence beside it; major where the probability alone is missing; "
             "a degree milder in a table or workbook; finding R04 of the gates",
         .correction = "State k and the coverage probability beside U.",
         .question = "Which k and which coverage probability belong to U?",
         .examine = coverage_not_stated},
        {.id = "R05",
         .title = "Unit missing, or decimal signs mixed",
         .clause = k_units_stated,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::claims},
         .detection = "a result without unit; decimal point and comma in one table (major)",
         .correction = "State the unit, and one decimal sign throughout.",
         .question = "In which unit are value and U?",
         .examine = unit_or_sign_unclear},
        {.id = "R06",
         .title = "Negative zero, or an exponent misprinted",
         .clause = k_clear_reports,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::minor,
         .needs = {Need::results},
         .detection = "the texts of the numbers; finding R06 of the gates",
         .correction = "Print zero without a sign, and powers of ten as such.",
         .question = "Which number is meant?",
         .examine = misprinted},
        {.id = "R07",
         .title = "Item of a report missing",
         .clause = k_report_items,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::certificate},
         .detection = "findings R07-b to R07-4d, R14, R15, Q01 and Q02 of the gates, and L01: what the files of the "
                      "laboratory say "
                      "otherwise, with their severity",
         .correction = "State the item.",
         .question = "What stands there on the certificate?",
         .examine = take_gate_findings},
        {.id = "R08",
         .title = "Recalibration date without agreement",
         .clause = k_intervals,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "finding R08 of the gates",
         .correction = "State the agreement with the customer, or leave the date out.",
         .question = "Where did the customer agree on the date?",
         .examine = take_gate_findings},
        {.id = "R09",
         .title = "Data of others not marked",
         .clause = k_customer_data,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::certificate},
         .detection = "finding R09 of the gates",
         .correction = "Mark the results and name who provided them.",
         .question = "Which numbers were provided by somebody else?",
         .examine = take_gate_findings},
        {.id = "R11",
         .title = "Language versions differ",
         .clause = k_clear_reports,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection =
             "findings R13 and R17 of the gates: languages that the profile demands, texts that one version has and "
             "another has not. Numbers come from one record in all languages",
         .correction = "Give the text in all languages of the certificate.",
         .question = "Which version is binding?",
         .examine = take_gate_findings},
        {.id = "R12",
         .title = "Re-issue without reference or changes",
         .clause = k_amendments,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "finding R12 of the gates, but for the reason (P02)",
         .correction = "State the number of the earlier certificate and what was changed.",
         .question = "Which certificate does this one replace, and what is different?",
         .examine = take_gate_findings},
    };
}

}  // namespace gumcert::audit
