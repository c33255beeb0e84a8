#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/terminal/terminal.h"
#include "outputs/output_files.h"

namespace gumcert::cli {

/// Where - is no place: of several files, of a file that is opened again, of a folder. Taken for a name it would become a
/// file or folder that no other command can easily name.
/// \param option  that names the place, "-o"
/// \throws gum::UsageError  where the place is standard output
void refuse_stdout(const std::string& option, const std::string& place);

/// Before a command reads anything: brings the folders of its outputs into order, where a program was interrupted
/// there, and says so. Removes temporary folders of programs that were killed.
/// \return how the outputs are now, for write_outputs()
/// \throws gum::StorageError  GC-STORE-0013
[[nodiscard]] outputs::OutputsAtStart begin_outputs(const std::vector<std::filesystem::path>& outputs,
                                                    const CommonOptions& common);

/// outputs::write_files(), remembered for the words of an interruption.
void write_outputs(const std::vector<outputs::OutputFile>& files, const std::vector<std::filesystem::path>& inputs,
                   const outputs::OutputsAtStart& at_start);

/// Writes files into the places that outputs::kept_place() says, and says so: GC-STORE-0022. A failure is told, and not thrown.
/// \param what    "is the record of this evaluation"
/// \param action  in which other way a document can be made
void keep_files(std::vector<outputs::OutputFile> files, const std::vector<std::filesystem::path>& inputs,
                const outputs::OutputsAtStart& at_start, const std::string& what, const std::string& action,
                const CommonOptions& common);

/// Says of what keep_files() wrote that it is older than the outputs beside it: GC-STORE-0023.
void report_kept(const std::filesystem::path& output, const CommonOptions& common);

}  // namespace gumcert::cli
