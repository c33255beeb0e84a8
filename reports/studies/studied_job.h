#pragma once

#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::reports {

/// What the document of a study says of the job that it studies.
struct StudiedJob {
    std::string name, title;  ///< "": no title
    double coverage_probability = 0.0;
    std::vector<gum::Diagnostic> warnings;
};

}  // namespace gumcert::reports
