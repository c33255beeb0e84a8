#pragma once

#include <string_view>

namespace gumcert::reports {

/// What may stand where in a DCC of version 3.1 to 3.3 with its D-SI, as facts in a notation of our own; the schemas
/// themselves are not part of this program. One type a line, which goes on in lines that begin with a blank:
///
///     contact [id refId@330] = name:text eMail:word@-319 eMail:word?@320 location:location
///
/// Attributes stand in brackets (a bang: must be there). Children follow in their order: `element:type`, with ? (may
/// be left out), * (any number), + (at least one), | between alternatives, & between children in any order, and
/// parentheses. `@320` means since version 3.2.0, `@-319` before it. Types with "si." hold elements of D-SI, the others
/// such of the DCC; `si:real` is the element of D-SI with the type si.real.
/// `type ~ words` is a text that is one of these words; `type[]` is a list. The types of texts that no line names are
/// those of dcc_text_types.h.
[[nodiscard]] std::string_view dcc_schema_facts();

}  // namespace gumcert::reports
