#include "app/cli/terminal/output_places.h"

#include <system_error>

#include "app/cli/terminal/interruption.h"
#include "gum/quantity/diagnostic.h"
#include "outputs/kept_files.h"
#include "system/temporary.h"

namespace gumcert::cli {

void refuse_stdout(const std::string& option, const std::string& place) {
    if (place == "-") {
        refuse_usage(
            option + " -", "what is written here cannot go to standard output",
            "standard output takes one document of evaluate, render, audit, import, plan, simulate, or archive",
            "name a place; ./- is one with this name");
    }
}

outputs::OutputsAtStart begin_outputs(const std::vector<std::filesystem::path>& outputs, const CommonOptions& common) {
    std::error_code error;
    const std::filesystem::path temporary = std::filesystem::temp_directory_path(error);
    if (!error) {
        (void)system::remove_dead_folders(temporary);
    }
    print_messages(outputs::restore_outputs(outputs), common);
    return outputs::OutputsAtStart(outputs);
}

void write_outputs(const std::vector<outputs::OutputFile>& files, const std::vector<std::filesystem::path>& inputs,
                   const outputs::OutputsAtStart& at_start) {
    outputs::write_files(files, inputs, at_start);
    for (const outputs::OutputFile& file : files) {
        tell_written(file.path);
    }
}

void keep_files(std::vector<outputs::OutputFile> files, const std::vector<std::filesystem::path>& inputs,
                const outputs::OutputsAtStart& at_start, const std::string& what, const std::string& action,
                const CommonOptions& common) {
    (void)explained(common, [&] {
        for (outputs::OutputFile& file : files) {
            file.path = outputs::kept_place(file.path);
        }
        write_outputs(files, inputs, at_start);
        print_message({.code = "GC-STORE-0022",
                       .where = files.front().path.string(),
                       .what = what + ", kept without documents: one of them cannot be made, as the next message says",
                       .rule = "what was evaluated is not lost, and never stands in one folder with documents of "
                               "another evaluation",
                       .action = "mend what the next message says and give the command again, or " + action,
                       .severity = gum::Severity::warning},
                      common);
        return done;
    });
}

void report_kept(const std::filesystem::path& output, const CommonOptions& common) {
    const std::filesystem::path kept = outputs::kept_place(output);
    std::error_code error;
    if (std::filesystem::exists(kept, error)) {
        print_message({.code = "GC-STORE-0023",
                       .where = kept.parent_path().string(),
                       .what = "holds an earlier evaluation of which a document could not be made",
                       .rule = "what stands beside this folder is of the new evaluation",
                       .action = "remove the folder, so that nobody takes it for this evaluation",
                       .severity = gum::Severity::warning},
                      common);
    }
}

}  // namespace gumcert::cli
