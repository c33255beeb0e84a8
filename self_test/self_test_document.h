#pragma once

#include <string>

#include "reports/forms/render.h"
#include "self_test/self_test.h"

namespace gumcert::self_test {

/// The report of a self-test for people, in the language that the assets ask for, else in English: what was tested on what,
/// every case with its source, every value with the digits that it reaches. Names and titles of cases are English.
/// \param digest  SHA-256 of the report as JSON, which stands on every page
/// \throws gum::StorageError  if a template or the wording is missing or damaged
[[nodiscard]] std::string self_test_html(const SelfTest& test, const std::string& digest,
                                         const reports::RenderAssets& assets);

/// The same as PDF/A-3a.
/// \throws gum::StorageError   if node or the Typst package is missing, or the child process fails or takes too long
/// \throws gum::NoResultError  if Typst refuses the document
[[nodiscard]] std::string self_test_pdf(const SelfTest& test, const std::string& digest,
                                        const reports::RenderAssets& assets);

}  // namespace gumcert::self_test
