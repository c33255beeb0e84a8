#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gumcert::app {

struct OutputFile {
    std::filesystem::path path;
    std::string bytes;
};

/// Refuses a place that cannot be written before any work is done. Creates nothing.
/// \throws gum::StorageError
void require_writable(const std::filesystem::path& file);

/// Refuses an output that is one of the inputs, under whatever name.
/// \throws gum::StorageError
void require_not_an_input(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

/// Writes all files or none: each to a temporary name beside its own, synchronised to the disk, then renamed.
/// Folders that are missing are made.
/// \throws gum::StorageError  with nothing of the new left behind and the old files as they were, unless a rename
///                            itself fails
void write_files(const std::vector<OutputFile>& files);

}  // namespace gumcert::app
