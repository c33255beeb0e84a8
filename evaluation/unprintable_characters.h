#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluation/evaluation_task.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::evaluation {

/// Which of some characters no font has, in their order: reports::characters_without_glyph().
using WithoutGlyph = std::function<std::vector<std::string>(const std::vector<std::string>& characters)>;

/// Warns of characters in the files of a job that no font of its documents has, each with the place where it stands
/// first: GC-REPORT-0045. What is never printed is passed over: comments, `notes`, files that are neither JSON nor CSV.
/// \param without_glyph  is asked once, with every character from U+0100 upwards
[[nodiscard]] std::vector<gum::Diagnostic> unprintable_characters(const ReadJob& job,
                                                                  const WithoutGlyph& without_glyph);

}  // namespace gumcert::evaluation
