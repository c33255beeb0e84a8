#pragma once

#include <string>
#include <vector>

#include "certificate/certified_results.h"

namespace gumcert::certificate {

/// What cannot be seen from the data alone: that a document is printed in other languages than the certificate names.
///
/// Texts that one of them lacks are findings R17, as for the languages of the data. Where the profile demands a
/// language that is not printed, the finding R13 blocks the certificate and takes the symbol off. A specimen is not
/// issued.
/// \param printed  in place of the languages of the data; empty: those of the data are printed, nothing is done
/// \return whether there are such findings
bool judge_printed_languages(Certificate& certificate, const std::vector<std::string>& printed);

}  // namespace gumcert::certificate
