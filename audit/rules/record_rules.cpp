#include <utility>

#include "audit/rules/gate_findings.h"
#include "audit/rules/registry.h"

namespace gumcert::audit {
namespace {

constexpr Clause k_amended_records{.text = "ISO/IEC 17025:2017, 7.5.2", .verified = true};
constexpr Clause k_authorised_persons{.text = "ISO/IEC 17025:2017, 6.2.6", .verified = true};
constexpr Clause k_second_person{.text = "ISO/IEC 17025:2017, 7.8.1.1, and the rules of the accreditation body",
                                 .verified = false};
constexpr Clause k_technical_records{.text = "ISO/IEC 17025:2017, 7.5.1", .verified = true};
constexpr Clause k_unique_number{.text = "ISO/IEC 17025:2017, 7.8.2.1 d", .verified = true};
constexpr Clause k_current_method{.text = "ISO/IEC 17025:2017, 7.2.1", .verified = true};
constexpr Clause k_transfers_checked{.text = "ISO/IEC 17025:2017, 7.11.6", .verified = true};
constexpr Clause k_deviations_reported{.text = "ISO/IEC 17025:2017, 7.8.2.1 n and 7.10", .verified = true};

/// P01: a record says what its job gives, or somebody changed it after it was made.
void changed_record(const AuditSubject& subject, FindingCollector& findings) {
    if (subject.disagreements->empty()) {
        return;
    }
    AuditFinding finding;
    finding.where = subject.name;
    finding.what = say("the record says something else than its own job gives: it was changed after it was made");
    finding.evidence = sentences_of(*subject.disagreements);
    findings.add(std::move(finding));
}

}  // namespace

std::vector<Rule> record_rules() {
    return {
        {.id = "P01",
         .title = "Data changed after review",
         .clause = {.text = "ISO/IEC 17025:2017, 7.5.2", .verified = true},
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::recomputed},
         .detection = "the job in a record is evaluated again, and every number, text and verdict compared",
         .correction = "Evaluate the job again, and find out who changed the record, when and why.",
         .question = "Who changed the record after it was made, and what was issued from it?",
         .examine = changed_record},
        {.id = "P02",
         .title = "Change without reason",
         .clause = k_amended_records,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "finding R12 of the gates for the reason of an amendment; a log of events is not read",
         .correction = "State why the certificate was changed.",
         .question = "Who changed it, when, and why?",
         .examine = take_gate_findings},
        {.id = "P03",
         .title = "Person not authorised for the work",
         .clause = k_authorised_persons,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "findings P03, P09, P14 and X10 of the gates: authorisations on the days of work, review and "
                      "authorisation, the list of signatories and the register of the laboratory",
         .correction = "Let an authorised person do it.",
         .question = "Since when and for what is this person authorised?",
         .examine = take_gate_findings},
        {.id = "P04",
         .title = "No independent second person",
         .clause = k_second_person,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::certificate},
         .detection = "findings P04, P06, P07 and P13 of the gates",
         .correction = "Let another person of the laboratory review.",
         .question = "Who reviewed the results?",
         .examine = take_gate_findings},
        {.id = "P05",
         .title = "Dates that are missing or cannot be",
         .clause = k_technical_records,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "findings P05, P10, P11 and P12 of the gates",
         .correction = "Correct the dates.",
         .question = "When was the work done, authorised and issued?",
         .examine = take_gate_findings},
        {.id = "P07",
         .title = "Certificate number used twice",
         .clause = k_unique_number,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection =
             "finding R12 of the gates where a certificate has the number of the one that it replaces; a register "
             "of certificates is not read",
         .correction = "Give the certificate a number of its own.",
         .question = "Which other document has this number?",
         .examine = take_gate_findings},
        {.id = "P08",
         .title = "Version of the method not valid on the day",
         .clause = k_current_method,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "finding P08 of the gates",
         .correction = "State the version that was used.",
         .question = "Which version of the method was used?",
         .examine = take_gate_findings},
        {.id = "P09",
         .title = "Raw data and record differ",
         .clause = k_transfers_checked,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "finding E04 of the gates: the file of the environment against the conditions that are stated",
         .correction = "Correct the condition or the file.",
         .question = "Which of the two was observed?",
         .examine = take_gate_findings},
        {.id = "P10",
         .title = "Item left out without a reason that holds",
         .clause = k_deviations_reported,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::certificate},
         .detection = "finding R16 of the gates: omissions that the standard does not allow, or without reason",
         .correction = "Give the item, or the reason.",
         .question = "Why is the item left out, and where is that said on the certificate?",
         .examine = take_gate_findings},
    };
}

}  // namespace gumcert::audit
