#include "app/cli/fonts_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "app/cli/terminal/share_folder.h"
#include "reports/forms/pdf_worker.h"

namespace gumcert::cli {

ExitCode list_fonts(const std::string& share) {
    struct Family {
        std::string name, from, styles;
    };
    std::vector<Family> families;
    const reports::RenderAssets assets = render_assets(share);
    for (const reports::TemplateFont& font : reports::PdfWorker(assets).fonts()) {
        const auto known = std::find_if(families.begin(), families.end(), [&](const Family& family) {
            return family.name == font.family && family.from == font.from;
        });
        if (known == families.end()) {
            families.push_back({.name = font.family, .from = font.from, .styles = font.style});
        } else {
            known->styles += ", " + font.style;
        }
    }
    for (const Family& family : families) {
        const bool further = std::any_of(assets.fonts.begin(), assets.fonts.end(), [&](const auto& folder) {
            return std::filesystem::absolute(folder).string() == family.from;
        });
        print_to_stdout("{}: {}\n    {}{}\n", family.name, family.styles,
                        family.from.empty() ? "inside of the program" : family.from,
                        further ? ", for documents with Chinese, Japanese or Korean characters" : "");
    }
    return done;
}

}  // namespace gumcert::cli
