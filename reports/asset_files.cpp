#include "reports/asset_files.h"

#include "gum/quantity/diagnostic.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace gumcert::reports {

std::string read_asset(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream whole;
    whole << stream.rdbuf();
    std::string text = stream ? whole.str() : std::string();
    if (text.empty()) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-REPORT-0002",
                            .where = file.string(),
                            .what = "missing, empty or not readable",
                            .rule = "documents are made with the templates of this release",
                            .action = "install the program again, or name the folder of templates"});
    }
    return text;
}

nlohmann::json read_wording(const RenderAssets& assets) {
    // The language becomes part of a file name: letters and hyphens only.
    const bool plain = !assets.language.empty() &&
                       std::all_of(assets.language.begin(), assets.language.end(),
                                   [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-'; });
    const std::filesystem::path file = assets.templates / "wording" / (assets.language + ".json");
    if (!plain || !std::filesystem::is_regular_file(file)) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0002",
                                                .where = "language",
                                                .what = '"' + assets.language + '"',
                                                .rule = "a document is printed in a language of templates/wording",
                                                .action = "choose another language, e.g. en"});
    }
    nlohmann::json wording = nlohmann::json::parse(read_asset(file), nullptr, false);
    if (!wording.is_object()) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0001",
                                                .where = file.string(),
                                                .what = "not a JSON object",
                                                .rule = "wording files are JSON",
                                                .action = "take the templates of this release"});
    }
    return wording;
}

}  // namespace gumcert::reports
