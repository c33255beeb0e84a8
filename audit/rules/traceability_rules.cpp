#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/rules/gate_findings.h"
#include "audit/rules/registry.h"
#include "audit/stated_outcome.h"
#include "audit/word_line.h"
#include "certificate/dates.h"
#include "certificate/text_words.h"

namespace gumcert::audit {
namespace {

constexpr Clause k_equipment_valid{.text = "ISO/IEC 17025:2017, 6.4.6 to 6.4.9", .verified = true};
constexpr Clause k_fit_for_use{.text = "ISO/IEC 17025:2017, 6.4.5", .verified = true};
constexpr Clause k_corrections_updated{.text = "ISO/IEC 17025:2017, 6.4.11", .verified = true};
constexpr Clause k_chain{.text = "ISO/IEC 17025:2017, 6.5.1", .verified = true};
constexpr Clause k_routes{.text = "ILAC-P10:07/2020", .verified = false};
constexpr Clause k_equipment_identity{.text = "ISO/IEC 17025:2017, 6.4.13", .verified = true};
constexpr Clause k_points_of_table{.text = "ANAB GD 2702", .verified = false};

using certificate::StandardUsed;

std::u32string identity_of(const StandardUsed& standard) {
    return certificate::letters_of(standard.identification);
}
bool row_names(const AuditedRow& row, const std::string& name) {
    const std::u32string wanted = certificate::letters_of(name);
    // One letter stands in nearly every text.
    return wanted.size() > 1 && certificate::letters_of(words_of_row(row)).find(wanted) != std::u32string::npos;
}

/// T06
void outside_of_calibrated_range(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        if (!WordLine(words_of_row(at.is))
                 .has_any({"extrapol", "outside of the calibrat", "outside the calibrat", "outside calibrat",
                           "beyond the calibrat", "ausserhalb des kalibr", "ausserhalb kalibr"})) {
            return;
        }
        AuditFinding finding =
            finding_at(at, "", say("a value outside of the calibrated range of the standard is used"));
        finding.evidence = {at.is.comment.empty() ? at.is.source : at.is.comment};
        findings.add(std::move(finding));
    });
}

/// T07: the standard's own contribution alone is larger than u_c. What is smaller by its sensitivity, as a mean over
/// independent standards is, or cancels by a correlation, is none.
void smaller_than_the_standard(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const std::optional<double> u_c = stated_u_c(at.of);
        if (at.is.origin != Origin::certificate || !at.is.origin_value || !at.is.certificate_k ||
            !(*at.is.certificate_k > 0.0) || !u_c || !at.of.correlations.empty()) {
            return;
        }
        const double own = std::abs(at.is.used_sensitivity) * *at.is.origin_value / *at.is.certificate_k;
        constexpr double k_rounding = 1.02;
        // Of a budget that was evaluated here the row is in the sum as it stands: what makes u_c smaller is the model, correlations
        // that the job states, or trials where it is not linear.
        const bool is_in_sum = at.of.evaluated_here && own <= k_rounding * contribution_of(at.is);
        if (own <= k_rounding * *u_c || is_in_sum) {
            return;
        }
        AuditFinding finding =
            finding_at(at, "",
                       say("u_c = {u_c:number} is smaller than what the standard alone contributes, {own:number}",
                           in_words(*u_c, at.of.unit), in_words(own, at.of.unit)));
        finding.evidence = {say("U = {U:number}, k = {k:number} of the certificate",
                                in_words(*at.is.origin_value, at.is.unit), in_words(*at.is.certificate_k)),
                            equals("c", in_words(at.is.used_sensitivity))};
        finding.expected = say("u_c of at least {own:number}", in_words(own, at.of.unit));
        finding.actual = say_number(in_words(*u_c, at.of.unit));
        findings.add(std::move(finding));
    });
}

/// T08: a row names the older of two certificates of one standard.
void older_certificate_used(const AuditSubject& subject, FindingCollector& findings) {
    const std::vector<StandardUsed>& standards = subject.certificate->data.standards;
    for (const StandardUsed& older : standards) {
        for (const StandardUsed& newer : standards) {
            if (identity_of(older).empty() || identity_of(older) != identity_of(newer) ||
                !certificate::is_after(newer.calibrated, older.calibrated)) {
                continue;
            }
            for_each_row(subject, [&](const RowAt& at) {
                if (!row_names(at.is, older.certificate) || row_names(at.is, newer.certificate)) {
                    return;
                }
                AuditFinding finding =
                    finding_at(at, "",
                               say("the values of certificate {certificate} of {day} are used, and there is a "
                                   "later one, {later} of {later_day}",
                                   older.certificate, older.calibrated, newer.certificate, newer.calibrated));
                finding.expected = newer.certificate;
                finding.actual = older.certificate;
                findings.add(std::move(finding));
            });
        }
    }
}

/// T11: which piece is meant?
void ambiguous_standard(const AuditSubject& subject, FindingCollector& findings) {
    const std::vector<StandardUsed>& standards = subject.certificate->data.standards;
    for (std::size_t i = 0; i < standards.size(); ++i) {
        for (std::size_t j = i + 1; j < standards.size(); ++j) {
            const StandardUsed &a = standards[i], &b = standards[j];
            const bool twins =
                !identity_of(a).empty() && identity_of(a) == identity_of(b) && a.certificate != b.certificate;
            if (twins) {
                AuditFinding finding;
                finding.where = "/standards/" + std::to_string(j) + "/identification";
                finding.what = say("two standards have the identification {identification}", a.identification);
                finding.evidence = {say("certificates {first} and {second}", a.certificate, b.certificate)};
                findings.add(std::move(finding));
                continue;
            }
            if (certificate::letters_of(a.name.in("en")) != certificate::letters_of(b.name.in("en"))) {
                continue;
            }
            for_each_row(subject, [&](const RowAt& at) {
                const auto told = [&](const StandardUsed& s) {
                    return row_names(at.is, s.identification) || row_names(at.is, s.certificate);
                };
                if (row_names(at.is, a.name.in("en")) && !told(a) && !told(b)) {
                    AuditFinding finding =
                        finding_at(at, "",
                                   say("the name \"{name}\" is that of two standards, {first} and {second}",
                                       a.name.in("en"), a.identification, b.identification));
                    findings.add(std::move(finding));
                }
            });
        }
    }
}

/// T12
void nearest_point_used(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const bool interpolated = std::any_of(at.of.rows.begin(), at.of.rows.end(), [](const AuditedRow& row) {
            return row.contributor == Contributor::fit && row.used_u > 0.0;
        });
        if (interpolated || !WordLine(at.is.comment + "; " + at.is.source)
                                 .has_any({"nearest", "next point", "next calibration point", "next higher point",
                                           "next lower point", "nachst"})) {
            return;
        }
        AuditFinding finding = finding_at(
            at, "",
            say("the value of the nearest calibrated point is used, and no contribution of the distance is there"));
        finding.contribution_missing = true;
        findings.add(std::move(finding));
    });
}

}  // namespace

std::vector<Rule> traceability_rules() {
    return {
        {.id = "T01",
         .title = "Calibration of a standard not valid on the day of use",
         .clause = k_equipment_valid,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "findings T01, T05 and T14 of the gates: the day of the calibration, its validity and the plan "
                      "of the register "
                      "against the work",
         .correction = "Use a standard whose calibration is valid.",
         .question = "Until when was the calibration of the standard valid?",
         .examine = take_gate_findings},
        {.id = "T02",
         .title = "Standard calibrated after the work",
         .clause = k_chain,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "finding T02 of the gates",
         .correction = "State the certificate that was valid then.",
         .question = "Which certificate of the standard was valid when the work was done?",
         .examine = take_gate_findings},
        {.id = "T03",
         .title = "Issuer neither national institute nor accredited",
         .clause = k_routes,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "finding T03 of the gates: route of traceability, accreditation of the issuer, evidence",
         .correction = "State route, accreditation or evidence.",
         .question = "Who calibrated the standard, and what shows that they may?",
         .examine = take_gate_findings},
        {.id = "T04",
         .title = "Certificate of a standard without uncertainty",
         .clause = k_chain,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "finding T04 of the gates",
         .correction = "State U and k of the certificate.",
         .question = "Which U and k does the certificate of the standard state?",
         .examine = take_gate_findings},
        {.id = "T05",
         .title = "Chain of calibrations broken or circular",
         .clause = k_chain,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection =
             "findings T06 (no input names the standard), T08 (a standard rests on this certificate), T10 (the "
             "register states something else) and T13 (an input uses a standard that the list leaves out) of the gates",
         .correction = "Name the standard where its value enters; correct the entry.",
         .question = "How does this result come from the standard?",
         .examine = take_gate_findings},
        {.id = "T06",
         .title = "Standard used outside of its calibrated range",
         .clause = k_fit_for_use,
         .severity = FindingSeverity::major,
         .needs = {Need::rows},
         .detection = "a row that speaks of extrapolation, or of values outside of the calibrated range; finding T11 "
                      "of the gates: "
                      "what the register of the laboratory says of day, quantity, range, mode and value",
         .correction = "Have the standard calibrated at the point, or add what the extrapolation contributes.",
         .question = "What is known of the standard at this point?",
         .examine = outside_of_calibrated_range},
        {.id = "T07",
         .title = "Uncertainty smaller than that of the standard",
         .clause = k_chain,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::rows},
         .detection =
             "|c|·U/k of a certificate above u_c by more than 2 %, without correlations; findings T07 and T09 of "
             "the gates. A sensitivity below 1 and differences with a common standard are allowed",
         .correction = "Put the uncertainty of the certificate into the budget.",
         .question = "How can the result be known better than the standard that it comes from?",
         .examine = smaller_than_the_standard},
        {.id = "T08",
         .title = "Values of a standard not the latest",
         .clause = k_corrections_updated,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::rows, Need::certificate},
         .detection = "a row names a certificate, and the same standard has a later one",
         .correction = "Use the values of the latest certificate.",
         .question = "Why are the values of an earlier certificate used?",
         .examine = older_certificate_used},
        {.id = "T11",
         .title = "Identity of a standard ambiguous",
         .clause = k_equipment_identity,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::certificate},
         .detection = "two standards of one identification; a row that names two standards of one name alike; finding "
                      "T12 of the "
                      "gates: a standard that is not in the register of the laboratory",
         .correction = "Name the standard by its identification, and give twins their own values.",
         .question = "Which of the two pieces was used?",
         .examine = ambiguous_standard},
        {.id = "T12",
         .title = "Nearest calibrated point used without a contribution",
         .clause = k_points_of_table,
         .severity = FindingSeverity::major,
         .needs = {Need::rows},
         .detection = "a row that speaks of the nearest or next point, and no row of a fit or an interpolation",
         .correction = "Interpolate, or add what the values of the two points differ by.",
         .question = "How far is the point from the calibrated one, and which way is a tie decided?",
         .examine = nearest_point_used},
    };
}

}  // namespace gumcert::audit
