#include "app/cli/output_places.h"

#include <system_error>

#include "app/cli/interruption.h"
#include "system/temporary.h"

namespace gumcert::cli {

app::OutputsAtStart begin_outputs(const std::vector<std::filesystem::path>& outputs, const CommonOptions& common) {
    std::error_code error;
    const std::filesystem::path temporary = std::filesystem::temp_directory_path(error);
    if (!error) {
        (void)system::remove_dead_folders(temporary);
    }
    print_messages(app::restore_outputs(outputs), common);
    return app::OutputsAtStart(outputs);
}

void write_outputs(const std::vector<app::OutputFile>& files, const std::vector<std::filesystem::path>& inputs,
                   const app::OutputsAtStart& at_start) {
    app::write_files(files, inputs, at_start);
    for (const app::OutputFile& file : files) {
        tell_written(file.path);
    }
}

}  // namespace gumcert::cli
