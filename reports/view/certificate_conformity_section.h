#pragma once

#include "certificate/certified_results.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// Which specification, or which part of it, a statement is about: document, edition, clause.
[[nodiscard]] std::string document_of(const certificate::AgreedSpecification& specification);

/// What belongs to the rule that was agreed on beside its name (ISO/IEC 17025:2017, 7.8.6.2 c): its parameters, and the
/// alternative, which is a part of it whether a value needs it or not.
[[nodiscard]] Facts conditions_of_rule(const certificate::AgreedSpecification& specification, const Wording& words);

/// Statement of conformity (ISO/IEC 17025:2017, 7.8.6): specification, rule, limits, risks and verdict of every value;
/// or that none was requested.
void conformity_section(CertificateBuilder& builder, const Wording& words, const certificate::Certificate& certificate);

}  // namespace gumcert::reports
