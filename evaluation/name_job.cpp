#include "evaluation/name_job.h"

#include <string>

namespace gumcert::evaluation {

std::vector<gum::Diagnostic> of_job(std::vector<gum::Diagnostic> diagnostics, const std::filesystem::path& job) {
    const std::string path = job.string();
    const std::string name = job.filename().string();
    for (gum::Diagnostic& diagnostic : diagnostics) {
        std::string& where = diagnostic.where;
        if (where.starts_with(path)) {
            continue;
        }
        if (where == name || where.starts_with(name + '#') || where.starts_with(name + ':')) {
            where.replace(0, name.size(), path);
        } else {
            where = where.empty() ? path : path + ", " + where;
        }
    }
    return diagnostics;
}

}  // namespace gumcert::evaluation
