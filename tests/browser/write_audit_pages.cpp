// Writes the page of a sample audit in each language, for the test in a browser: write_audit_pages FOLDER.

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "reports/audit/audit_html.h"
#include "tests/support/sample_audit.h"

int main(int count, char** arguments) {
    using namespace gumcert;
    if (count != 2) {
        std::cerr << "usage: write_audit_pages FOLDER\n";
        return 2;
    }
    try {
        const std::filesystem::path folder = arguments[1];
        std::vector<audit::AuditReport> reports = {test::sample_audit(), test::sample_audit_of_points()};
        reports.front().subject.waivers = {
            {.finding = "B05", .where = {}, .by = "A. N.", .date = "2026-03-04", .reason = "one operator only"}};
        const reports::AuditView view = reports::make_audit_view(
            reports, test::sample_rules(),
            {.program = "gumcert 0.1.0", .digests = {std::string(64, 'a'), std::string(64, 'b')}});
        reports::RenderAssets assets;
        assets.templates = std::filesystem::path(GUMCERT_SOURCE_DIR) / "templates";
        for (const std::string language : {"en", "de", "es", "zh-Hant"}) {
            assets.languages = {language};
            std::ofstream(folder / (language + ".html"), std::ios::binary) << reports::audit_as_html(view, assets);
        }
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}
