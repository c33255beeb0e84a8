#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::outputs {

struct OutputFile {
    std::filesystem::path path;
    std::string bytes;
};

/// Refuses a place that cannot be written before any work is done: an output is a new file or takes the place of a
/// regular one, never of a folder, a device, a pipe or a symbolic link. Creates nothing.
/// \throws gum::StorageError  GC-STORE-0002, -0004 beside an archive, -0005
void require_writable(const std::filesystem::path& file);

/// Whether a name is one of a file that SQLite keeps beside an archive that is there ("-wal", "-shm", "-journal"): a file of
/// another kind would be taken for it, and removed, by the next who opens the archive.
[[nodiscard]] bool is_beside_an_archive(const std::filesystem::path& file);

/// Refuses an output that is one of the inputs, or lies in a folder of them, however either is spelled: through `..`,
/// folders that do not exist yet, hard and symbolic links. Inputs that do not exist are none.
/// \param inputs  files, and folders such as that of the templates
/// \throws gum::StorageError  GC-STORE-0004
void require_not_an_input(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);
void require_not_inputs(const std::vector<std::filesystem::path>& outputs,
                        const std::vector<std::filesystem::path>& inputs);

/// What stood in the places of outputs when a command began, so that nobody who wrote there meanwhile is overwritten.
class OutputsAtStart {
public:
    OutputsAtStart() = default;
    explicit OutputsAtStart(const std::vector<std::filesystem::path>& outputs);

    /// \throws gum::StorageError  GC-STORE-0008 if the file is another one now
    void require_unchanged(const std::filesystem::path& output) const;

private:
    std::map<std::filesystem::path, std::string> states_;
};

/// Brings folders into order in which a program was interrupted while it wrote: a set that was being put in place is
/// completed, or taken back where a part of it is lost; temporary files are removed. What another process is writing is
/// left alone.
/// \return what was done: GC-STORE-0009
/// \throws gum::StorageError  GC-STORE-0013 if a set can be neither completed nor taken back
std::vector<gum::Diagnostic> restore_outputs(const std::vector<std::filesystem::path>& outputs);

/// Brings to the disk which files a folder has, and by which names: after a file was renamed.
/// \throws gum::StorageError  GC-STORE-0002; not for a file system that cannot synchronise a folder: it does not lose the
///                            file for it
void synchronise_folder(const std::filesystem::path& folder);

/// Writes files of one folder, all or none: each to a new temporary file in the folder, synchronised to the disk, then
/// put in place. Of several files a journal is kept meanwhile, and a manifest with their digests afterwards
/// (outputs/output_set.h, docs/adr/0054-sets-of-outputs.md). A folder that is missing is made. A file that takes the place
/// of another keeps its permissions and, where the system allows it, its owner.
/// \param inputs         as above: looked at again when the folder exists
/// \param at_start       of this command
/// \param with_manifest  false for files that people change: nothing is remembered of them
/// \throws gum::StorageError  with nothing of the new left behind and the old files as they were; GC-STORE-0008 if
///                            another process writes there or has written there meanwhile
void write_files(const std::vector<OutputFile>& files, const std::vector<std::filesystem::path>& inputs = {},
                 const OutputsAtStart& at_start = {}, bool with_manifest = true);

}  // namespace gumcert::outputs
