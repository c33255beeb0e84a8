#include "app/cli/laboratory_command.h"

#include "app/cli/terminal/clock.h"
#include "evaluation/laboratory_overview.h"

namespace gumcert::cli {

ExitCode show_laboratory(const std::string& folder, const std::string& day, const std::string& format) {
    if (!day.empty() && !evaluation::is_day(day)) {
        refuse_usage("--date " + day, "is no date", "a day is written as 2026-11-21", "correct it");
    }
    const evaluation::LaboratoryOverview overview =
        evaluation::laboratory_overview(folder, day.empty() ? today() : day);
    write_to_stdout(format == "json"  ? evaluation::overview_json(overview)
                    : format == "csv" ? evaluation::overview_csv(overview)
                                      : evaluation::overview_text(overview, folder, day.empty() ? "today by UTC" : ""));
    return overview.is_overdue() ? negative_answer : done;
}

}  // namespace gumcert::cli
