#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gumcert::app {

struct OutputFile {
    std::filesystem::path path;
    std::string bytes;
};

/// Refuses a place that cannot be written before any work is done: an output is a new file or takes the place of a
/// regular one, never of a folder, a device, a pipe or a symbolic link. Creates nothing.
/// \throws gum::StorageError  GC-STORE-0002, -0005
void require_writable(const std::filesystem::path& file);

/// Refuses an output that is one of the inputs, or lies in a folder of them, however either is spelled: through `..`,
/// folders that do not exist yet, hard and symbolic links. Inputs that do not exist are none.
/// \param inputs  files, and folders such as that of the templates
/// \throws gum::StorageError  GC-STORE-0004
void require_not_an_input(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);
void require_not_inputs(const std::vector<std::filesystem::path>& outputs,
                        const std::vector<std::filesystem::path>& inputs);

/// Writes all files or none: each to a new temporary file beside its own, synchronised to the disk, then renamed.
/// Folders that are missing are made. A file that takes the place of another keeps its permissions and, where the
/// system allows it, its owner.
/// \param inputs  as above: looked at again when the folders exist
/// \throws gum::StorageError  with nothing of the new left behind and the old files as they were, unless a rename
///                            itself fails
void write_files(const std::vector<OutputFile>& files, const std::vector<std::filesystem::path>& inputs = {});

}  // namespace gumcert::app
