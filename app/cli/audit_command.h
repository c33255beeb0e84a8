#pragma once

#include <string>
#include <vector>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// What `gumcert audit` is asked for.
struct AuditOptions {
    std::string output;                  ///< file or folder; "" and "-": standard output, of HTML and PDF a file beside
    std::string format;                  ///< "json", "sarif", "html", "pdf", "text"; "": by the ending of the output
    std::vector<std::string> languages;  ///< the first one is used
    std::string waivers;                 ///< file with waivers of findings; "" none
    std::string share;
    std::string laboratory;  ///< --laboratory
    bool verbose = false;    ///< the text names each rule that was not checked
};

/// Audits files and folders. A file that is refused is reported, and the others are audited all the same.
/// \return negative_answer where a finding is critical; the highest code of all files
[[nodiscard]] ExitCode audit_files(const std::vector<std::string>& files, const AuditOptions& options,
                                   const CommonOptions& common);

}  // namespace gumcert::cli
