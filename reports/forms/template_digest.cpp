#include "reports/forms/template_digest.h"

#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"

#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

namespace gumcert::reports {

namespace {

namespace fs = std::filesystem;

bool is_of_documents(const fs::path& name) {
    const std::string folder = name.begin()->string();
    if (name.has_parent_path()) {
        return folder == "pdf" || folder == "wording";
    }
    const std::string ending = name.extension().string();
    return name.string().starts_with("certificate.") || ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

}  // namespace

std::string template_digest(const fs::path& templates) {
    std::set<std::string> names;
    std::error_code failure;
    for (fs::recursive_directory_iterator at(templates, failure), end; !failure && at != end; at.increment(failure)) {
        const fs::path name = at->path().lexically_relative(templates);
        if (at->is_regular_file(failure) && is_of_documents(name)) {
            names.insert(name.generic_string());
        }
    }
    std::string lines;
    for (const std::string& name : names) {
        std::ifstream file(templates / name, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        if (!file) {
            throw gum::StorageError(
                gum::Diagnostic{.code = "GC-REPORT-0002",
                                .where = (templates / name).string(),
                                .what = "missing, empty or not readable",
                                .rule = "documents are made with the templates of this release",
                                .action = "install the program again, or name the folder of templates"});
        }
        lines += encoding::sha256(bytes) + "  " + name + "\n";
    }
    return encoding::sha256(lines);
}

}  // namespace gumcert::reports
