#pragma once

#include <string>

#include "evaluation/evaluation_task.h"
#include "gum/quantity/diagnostic.h"
#include "reports/forms/render.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::issuing {

/// Judges of a certificate what its record cannot know, because it is the same on every day: whether it is dated later than
/// the day of its issue, whether it can be printed in the languages that are asked for, and whether texts name tables that
/// its document has. What is found are findings of the record from then on; of another record nothing is done.
/// \param today   "2026-11-22"; the caller says which day it is, as libraries read no clock
/// \param assets  of its documents: templates and languages
/// \throws gum::StorageError  if the wording is missing or damaged
void judge_issue(reports::EvaluationRecord& record, const std::string& today, const reports::RenderAssets& assets);

/// Whether no document is made of a record, because critical findings block the issue of its certificate.
/// \param draft  drafts may be printed of it all the same
[[nodiscard]] bool is_withheld(const reports::EvaluationRecord& record, bool draft);

/// What is said of a record that is withheld: GC-CERT-0305.
/// \param where  the job or the record
[[nodiscard]] gum::Diagnostic withheld(const std::string& where);

/// What is said of a document that stands beside it and is older: GC-CERT-0306.
[[nodiscard]] gum::Diagnostic document_of_earlier(const std::string& file);

/// Whether the answer of an evaluation is no, after judge_issue(): by the job, the gates of the certificate or the audit.
[[nodiscard]] bool is_negative(const evaluation::Evaluation& evaluation);

}  // namespace gumcert::issuing
