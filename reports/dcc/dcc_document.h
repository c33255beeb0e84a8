#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/xml_document.h"
#include "reports/forms/render.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The certificate as DCC 3.3.0 with D-SI 2.2.1. Numbers are the printed texts of the record, so that they are the same
/// ones as in the other forms; covariances are unrounded. The same record gives the same bytes.
///
/// A record without certificate data gives a document marked as a specimen, whose mandatory fields say "not stated".
/// The business rules are checked before anything is returned.
/// \throws gum::StorageError   if wording or reference types are missing
/// \throws gum::NoResultError  GC-DCC-01xx if the document would break a business rule
[[nodiscard]] std::string render_dcc(const EvaluationRecord& record, const RenderAssets& assets);

/// The business rules above the schema, and contradicting_statements(), on any DCC from 3.0 on.
/// \throws gum::InputError  GC-DCC-0001 … if the bytes are not a well-formed DCC, or hold a DOCTYPE
[[nodiscard]] std::vector<gum::Diagnostic> check_dcc(std::string_view bytes, const std::string& file);
/// The same of one that is parsed already.
[[nodiscard]] std::vector<gum::Diagnostic> check_dcc(const XmlElement& root, const std::string& file);

/// What the schema refuses, as schema_breaches(); of version 3.0 what missing_parts() finds.
/// \throws gum::InputError  as check_dcc()
[[nodiscard]] std::vector<gum::Diagnostic> check_dcc_structure(std::string_view bytes, const std::string& file);
[[nodiscard]] std::vector<gum::Diagnostic> check_dcc_structure(const XmlElement& root, const std::string& file);

}  // namespace gumcert::reports
