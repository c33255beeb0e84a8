#include "reports/forms/template_digest.h"

#include "encoding/file_bytes.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"

#include <cstddef>
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
    const auto refuse = [](const fs::path& place, const std::string& what) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-REPORT-0002",
                            .where = place.string(),
                            .what = what,
                            .rule = "documents are made with the templates of this release",
                            .action = "install the program again, or name the folder of templates"});
    };
    std::set<std::string> names;
    std::error_code failure;
    for (fs::recursive_directory_iterator at(templates, failure), end; !failure && at != end; at.increment(failure)) {
        const fs::path name = at->path().lexically_relative(templates);
        if (at->is_regular_file(failure) && is_of_documents(name)) {
            names.insert(name.generic_string());
        }
    }
    if (failure) {
        refuse(templates, "cannot be read: " + failure.message());
    }
    std::string lines;
    for (const std::string& name : names) {
        constexpr std::size_t k_largest_template = std::size_t{1} << 30U;
        const encoding::FileBytes file = encoding::read_regular_file(templates / name, k_largest_template);
        if (!file.failure.empty() || file.too_long) {
            refuse(templates / name, "missing, empty or not readable");
        }
        lines += encoding::sha256(file.bytes) + "  " + name + "\n";
    }
    return encoding::sha256(lines);
}

}  // namespace gumcert::reports
