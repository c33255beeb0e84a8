#pragma once

#include "certificate/certified_results.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// Statement of conformity (ISO/IEC 17025:2017, 7.8.6): specification, rule, limits, risks and verdict of every value;
/// or that none was requested.
/// Which specification, or which part of it, a statement is about: document, edition, clause.
[[nodiscard]] std::string document_of(const certificate::AgreedSpecification& specification);

void conformity_section(CertificateBuilder& builder, const Wording& words, const certificate::Certificate& certificate);

}  // namespace gumcert::reports
