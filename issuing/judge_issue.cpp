#include "issuing/judge_issue.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "certificate/gates/day_of_issue.h"
#include "certificate/gates/gates.h"
#include "certificate/gates/printed_languages.h"
#include "evaluation/audit_evaluation.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/record_sentences.h"
#include "reports/view/named_tables.h"

namespace gumcert::issuing {

void judge_issue(reports::EvaluationRecord& record, const std::string& today, const reports::RenderAssets& assets) {
    if (!record.certificate) {
        return;
    }
    const bool too_early = certificate::block_issue_ahead_of_time(*record.certificate, today);
    const bool lacking = certificate::judge_printed_languages(*record.certificate, assets.languages);
    std::vector<certificate::Finding> of_tables;
    if (reports::names_tables_before_adjustment(*record.certificate)) {  // their numbers are those of the document
        of_tables = reports::findings_on_named_tables(
            *record.certificate, reports::view_of_document(record, assets),
            assets.languages.empty() ? record.certificate->data.languages : assets.languages);
        certificate::add_findings(*record.certificate, of_tables);
    }
    if (too_early || lacking || !of_tables.empty()) {  // what was found now has to be worded, too
        reports::identify_sentences(record, *reports::read_sentences(assets.templates));
    }
}

bool is_withheld(const reports::EvaluationRecord& record, bool draft) {
    return record.certificate && record.certificate->blocked && !draft;
}

gum::Diagnostic withheld(const std::string& where) {
    return {.code = "GC-CERT-0305",
            .where = where,
            .what = "no document is written: critical findings block the issue of the certificate",
            .rule = "ISO/IEC 17025:2017, 7.8",
            .action = "mend what the findings say, or print a draft with --draft",
            .severity = gum::Severity::error};
}

gum::Diagnostic document_of_earlier(const std::string& file) {
    return {.code = "GC-CERT-0306",
            .where = file,
            .what = "is a document of an earlier evaluation",
            .rule = "the record beside it is the new one",
            .action = "remove it, so that nobody takes it for the document of this record",
            .severity = gum::Severity::warning};
}

bool is_negative(const evaluation::Evaluation& evaluation) {
    return evaluation.negative || evaluation.blocked || evaluation::is_refuted_by_audit(evaluation) ||
           (evaluation.record.certificate && evaluation.record.certificate->blocked);
}

}  // namespace gumcert::issuing
