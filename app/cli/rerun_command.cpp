#include "app/cli/rerun_command.h"

#include <algorithm>
#include <filesystem>

#include "app/cli/terminal/interruption.h"
#include "app/cli/terminal/share_folder.h"
#include "evaluation/read_file.h"
#include "evaluation/rerun_record.h"
#include "gum/quantity/diagnostic.h"
#include "text/visible_text.h"

namespace gumcert::cli {

ExitCode rerun_records(const std::vector<std::string>& records, const std::string& format, const std::string& share,
                       const CommonOptions& common) {
    const std::filesystem::path templates = templates_folder(share);
    std::vector<evaluation::RerunRecord> all;
    ExitCode code = done;
    ProgressLine progress(!common.quiet);
    for (const std::string& name : records) {
        const ExitCode one = explained(common, [&] {
            all.push_back(evaluation::rerun_record(
                evaluation::read_file(name), name, static_cast<unsigned>(common.threads), templates,
                progress_within_walls(common, text::one_line(name),
                                      [&](const std::string& text) { progress(name + ": " + text); }, {name})));
            if (all.back().was_ended()) {
                throw gum::StorageError(*all.back().not_evaluated);
            }
            return all.back().is_negative() ? negative_answer : done;
        });
        code = std::max(code, one);
    }
    progress.clear();
    if (format != "json" && format != "csv") {
        write_to_stdout(evaluation::rerun_text(all, records.size() - all.size()));
    } else if (!all.empty()) {
        write_to_stdout(format == "json" ? evaluation::rerun_json(all) : evaluation::rerun_csv(all));
    }
    return code;
}

}  // namespace gumcert::cli
