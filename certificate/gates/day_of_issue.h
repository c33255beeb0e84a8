#pragma once

#include <string_view>

#include "certificate/certified_results.h"

namespace gumcert::certificate {

/// What cannot be seen from the data alone: that a certificate is dated later than the day on which it is issued. The
/// record does not depend on that day; it is looked at where documents are made, and the day comes from the caller.
///
/// One day more is allowed, because a day begins earlier in the east than by UTC. Where the date lies further ahead,
/// the finding P12 is put to the others, the certificate is blocked and the symbol taken off. A specimen is not issued.
/// \param today  "2026-11-22"; "" or no date: nothing is done
/// \return whether there is such a finding
bool block_issue_ahead_of_time(Certificate& certificate, std::string_view today);

}  // namespace gumcert::certificate
