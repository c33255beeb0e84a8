#pragma once

#include <filesystem>
#include <vector>

#include "app/cli/terminal.h"
#include "app/output_files.h"

namespace gumcert::cli {

/// Before a command reads anything: brings the folders of its outputs into order, where a program was interrupted
/// there, and says so. Removes temporary folders of programs that were killed.
/// \return how the outputs are now, for write_outputs()
/// \throws gum::StorageError  GC-STORE-0013
[[nodiscard]] app::OutputsAtStart begin_outputs(const std::vector<std::filesystem::path>& outputs,
                                                const CommonOptions& common);

/// app::write_files(), remembered for the words of an interruption.
void write_outputs(const std::vector<app::OutputFile>& files, const std::vector<std::filesystem::path>& inputs,
                   const app::OutputsAtStart& at_start);

}  // namespace gumcert::cli
