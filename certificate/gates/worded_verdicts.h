#pragma once

#include "certificate/gates/finding_list.h"

namespace gumcert::certificate {

/// Columns of words that state verdicts of their own, by their heading: what a rule has decided of the same row is said by
/// the certificate itself, and nothing beside it may say otherwise (D12). Words under other headings, such as those of a test of
/// functions, are not looked at.
void worded_verdicts(FindingList& found, const Certificate& certificate);

}  // namespace gumcert::certificate
