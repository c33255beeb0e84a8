#include "app/cli/terminal/share_folder.h"

#include <gumcert_templates.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include "encoding/sha2.h"
#include "evaluation/read_file.h"
#include "gum/quantity/diagnostic.h"
#include "reports/forms/template_digest.h"

namespace gumcert::cli {

namespace fs = std::filesystem;

namespace {

fs::path program_on_path(const char* name) {
    const char* const search = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): one thread
    std::error_code error;
    for (std::string rest = search == nullptr ? "" : search; !rest.empty();) {
        const std::size_t end = rest.find(':');
        const fs::path candidate = fs::path(rest.substr(0, end)) / name;
        if (access(candidate.c_str(), X_OK) == 0 && fs::is_regular_file(candidate, error)) {
            return candidate;
        }
        rest = end == std::string::npos ? "" : rest.substr(end + 1);
    }
    return {};
}

}  // namespace

fs::path executable() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error);
}

std::string digest_of_program_file(const fs::path& file) {
    try {
        return encoding::sha256(evaluation::read_file(file));
    } catch (const gum::DiagnosedError&) {
        return "unknown";
    }
}

std::string executable_digest() {
    return digest_of_program_file(executable());
}

namespace {

/// That came with this program; empty where none lies beside it.
fs::path own_share_folder() {
    std::error_code error;
    fs::path folder = executable().parent_path();
    for (int level = 0; level < 6 && !folder.empty(); ++level, folder = folder.parent_path()) {
        for (const fs::path& candidate : {folder / "share" / "gumcert", folder}) {
            if (fs::exists(candidate / "templates" / "certificate.html.mustache", error)) {
                return candidate;
            }
        }
        if (folder == folder.root_path()) {
            break;
        }
    }
    return {};
}

}  // namespace

fs::path share_folder(const std::string& given) {
    std::error_code error;
    if (!given.empty()) {
        if (!fs::exists(fs::path(given) / "templates" / "certificate.html.mustache", error)) {
            throw gum::StorageError(gum::Diagnostic{"GC-STORE-0010", given,
                                                    "has no folder templates with the documents",
                                                    "--share names the folder that holds templates/",
                                                    "correct the folder, or leave --share out", gum::Severity::error});
        }
        return given;
    }
    if (fs::path own = own_share_folder(); !own.empty()) {
        return own;
    }
    throw gum::StorageError(gum::Diagnostic{"GC-STORE-0010", "templates", "the folder of templates was not found",
                                            "documents need the templates that come with the program",
                                            "name it with --share FOLDER", gum::Severity::error});
}

fs::path templates_folder(const std::string& given) {
    return share_folder(given) / "templates";
}

fs::path examples_folder(const std::string& given) {
    const fs::path share = share_folder(given);
    std::error_code error;
    for (const fs::path& candidate : {share / "examples", share.parent_path() / "doc" / "gumcert" / "examples"}) {
        if (fs::exists(candidate / "methods.json", error)) {
            return candidate;
        }
    }
    throw gum::StorageError(gum::Diagnostic{"GC-STORE-0010", "examples", "the folder of methods was not found",
                                            "methods are among the examples that come with the program",
                                            "install the program with its documents", gum::Severity::error});
}

fs::path reference_cases_folder(const std::string& given) {
    const fs::path share = share_folder(given);
    std::error_code error;
    for (const fs::path& candidate : {share / "reference_cases", share / "tests" / "reference" / "cases"}) {
        if (fs::is_directory(candidate, error)) {
            return candidate;
        }
    }
    throw gum::StorageError(
        gum::Diagnostic{"GC-STORE-0010", "reference_cases", "the folder of reference cases was not found",
                        "the published cases come with the program",
                        "install the program as a whole, or name its folder with --share", gum::Severity::error});
}

void add_program_files(std::vector<fs::path>& inputs, const std::string& share) {
    inputs.push_back(executable());
    const fs::path templates = templates_folder(share);
    inputs.push_back(templates);
    inputs.push_back(templates.parent_path() / "schemas");
    inputs.push_back(templates.parent_path() / "node_modules");
}

reports::RenderAssets render_assets(const std::string& share, std::vector<std::string> languages) {
    const fs::path folder = share_folder(share);
    reports::RenderAssets result;
    result.templates = folder / "templates";
    constexpr std::size_t k_shown_digits = 12;
    const std::string digest = reports::template_digest(result.templates);
    result.changed_templates = digest == k_template_digest ? "" : digest.substr(0, k_shown_digits);
    result.node_program = program_on_path("node");
    std::error_code error;
    // Whoever changes templates copies them, and no program: what sets PDFs is the one that came with this program then. Where
    // there is none, the PDF says so; other forms need none.
    const fs::path own = fs::is_directory(folder / "node_modules", error) ? fs::path() : own_share_folder();
    result.node_modules = (own.empty() ? folder : own) / "node_modules";
    const fs::path temporary = fs::temp_directory_path(error);  // only the PDF needs it, and says so when it is missing
    result.temporary_folder = error ? fs::path("/tmp") : temporary;
    result.languages = std::move(languages);
    for (const fs::path& fonts : {folder / "fonts", fs::path("/usr/share/fonts/opentype/noto")}) {
        if (fs::is_directory(fonts, error)) {
            result.fonts.push_back(fonts);
        }
    }
    return result;
}

}  // namespace gumcert::cli
