#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/forms/render.h"

namespace gumcert::cli {

/// This program's own file.
[[nodiscard]] std::filesystem::path executable();

/// SHA-256 of a file of the program; "unknown" on a system without /proc, or where it was replaced since the program began.
[[nodiscard]] std::string digest_of_program_file(const std::filesystem::path& file);
/// Of this program's own file.
[[nodiscard]] std::string executable_digest();

/// Folder with templates/: share/gumcert of the installation, or the tree that the program was built in.
/// \param given  what --share names; "" = look for it
/// \throws gum::StorageError  GC-STORE-0010
[[nodiscard]] std::filesystem::path share_folder(const std::string& given);

/// The folder of templates: profiles, and the wording of every sentence that a record holds.
/// \throws gum::StorageError  GC-STORE-0010
[[nodiscard]] std::filesystem::path templates_folder(const std::string& given);

/// The folder of examples, where `gumcert init` takes methods from: share/doc/gumcert of the installation, or the tree.
/// \throws gum::StorageError  GC-STORE-0010
[[nodiscard]] std::filesystem::path examples_folder(const std::string& given);

/// The published reference cases of `gumcert self-test`: share/gumcert/reference_cases of the installation, or the tree.
/// \throws gum::StorageError  GC-STORE-0010
[[nodiscard]] std::filesystem::path reference_cases_folder(const std::string& given);

/// Adds the folders that the program itself reads, templates and schemas, to the inputs that no output may overwrite.
void add_program_files(std::vector<std::filesystem::path>& inputs, const std::string& share);

/// What documents are made with.
/// \param languages  to print in; empty: those of the certificate data
[[nodiscard]] reports::RenderAssets render_assets(const std::string& share, std::vector<std::string> languages = {});

}  // namespace gumcert::cli
