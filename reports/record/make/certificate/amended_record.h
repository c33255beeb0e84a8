#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What a certificate states otherwise than the one that it amends or replaces (ISO/IEC 17025:2017, 7.8.8.1): numbers
/// as they are printed, coverage, verdicts, and every text of the certificate data. Left out are number, date of issue
/// and the amendment itself, which always differ, the order of rows, and annexes. Values by the order of the amendment, what it
/// lacks last; texts by the order of docs/certificate_data.md.
/// \param earlier, later  certificates
[[nodiscard]] std::vector<certificate::Change> changes_between(const certificate::Certificate& earlier,
                                                               const certificate::Certificate& later);
/// The same of two records, with the titles of the document and of its sections first.
[[nodiscard]] std::vector<certificate::Change> changes_between(const EvaluationRecord& earlier,
                                                               const EvaluationRecord& later);

/// Reads the record of the earlier certificate, where the amendment of a certificate names it, and puts into the
/// certificate what has changed and the digest of that record. Nothing without such a name.
/// \param record  with certificate data, and with the files of its job
/// \throws gum::InputError  those of record_from_json(), GC-CERT-0307 where it is no record of a certificate with that
///                          number, GC-CERT-0308 where nothing has changed
void state_changes(EvaluationRecord& record);

}  // namespace gumcert::reports
