#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::outputs {

/// Beside files that were written together: which they are, with their digests. Renamed into its place after them.
inline constexpr const char* k_set_manifest = ".gumcert-set.json";
/// While files that belong together are put in place, and after a crash there: what is to be where.
inline constexpr const char* k_set_journal = ".gumcert-unfinished.json";

struct SetFile {
    std::string name;    ///< in the folder
    std::string sha256;  ///< of its bytes, 64 hexadecimal digits
    std::string part;    ///< in a journal: the name that it has until it is put in place
};
/// Files that one command wrote together, in the order of their names.
using FileSet = std::vector<SetFile>;

struct SetManifest {
    std::vector<FileSet> sets;  ///< no file is in two of them; in the order of their first names
};

/// The same manifest has the same bytes.
[[nodiscard]] std::string to_json(const SetManifest& manifest);

/// \return nothing where the text is no manifest or journal: another schema, a name with a folder in it, a file twice
[[nodiscard]] std::optional<SetManifest> set_manifest_from_json(std::string_view text);

/// A manifest after some files were written. A file that is written alone stays a member of its set; files that are
/// written together are a new set, and sets that had one of them are none any more.
[[nodiscard]] SetManifest with_written(SetManifest manifest, FileSet written);

/// Whether a file is in one of its sets.
[[nodiscard]] bool lists(const SetManifest& manifest, std::string_view name);

/// The manifest in a folder; empty where there is none.
/// \throws gum::StorageError  GC-STORE-0015 where it cannot be read, or is damaged
[[nodiscard]] SetManifest manifest_in(const std::filesystem::path& folder);

/// Holds every set of a folder against its manifest: GC-STORE-0013 a set whose writing was interrupted, -0014 a file
/// that is missing or has other bytes, -0015 no manifest, or one that is damaged.
[[nodiscard]] std::vector<gum::Diagnostic> check_sets(const std::filesystem::path& folder);

/// The same for one file as warnings; nothing where no set has it.
/// \param bytes  of the file, as they were read
[[nodiscard]] std::vector<gum::Diagnostic> doubts_about_set(const std::filesystem::path& file, std::string_view bytes);

}  // namespace gumcert::outputs
