#pragma once

#include <filesystem>
#include <functional>

namespace gumcert::outputs {

/// Where files of an evaluation are kept of which a document cannot be made: in a folder beside the outputs, so that they
/// stand in no set with documents of an earlier evaluation (docs/adr/0057-records-are-kept.md).
[[nodiscard]] std::filesystem::path kept_place(const std::filesystem::path& output);

/// Makes the documents of what was evaluated. Where one cannot be made, `keep` writes what there is, and the failure
/// becomes that of a file. An input that is refused only now keeps nothing.
/// \throws what `make` throws; gum::StorageError in place of gum::NoResultError: there is a result
void make_or_keep(const std::function<void()>& make, const std::function<void()>& keep);

}  // namespace gumcert::outputs
