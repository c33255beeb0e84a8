#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "evaluation/laboratory_overview.h"
#include "gum/quantity/diagnostic.h"
#include "tests/fuzz/bundle_folder.h"

/// Any files as the folder of a laboratory are refused, or there is an overview of what runs out.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    static const fuzz::BundleFolder folder("laboratory");
    folder.fill({reinterpret_cast<const char*>(data), size});
    try {
        const evaluation::LaboratoryOverview overview = evaluation::laboratory_overview(folder.path(), "2026-11-24");
        (void)evaluation::overview_text(overview, "laboratory", "");
        (void)evaluation::overview_csv(overview);
        fuzz::demand(!nlohmann::json::parse(evaluation::overview_json(overview), nullptr, false).is_discarded(),
                     "an overview that is no JSON");
        for (const evaluation::OverviewRow& row : overview.standards) {
            fuzz::demand(!row.id.empty() && !row.state.empty(), "a standard without a state");
        }
    } catch (const gum::DiagnosedError& error) {
        fuzz::demand(!error.diagnostics().empty(), "refused without a reason");
        jobs::fuzz::demand_honest(error.diagnostics());
    }
    return 0;
}
