#pragma once

#include "gum/quantity/diagnostic.h"
#include "reports/forms/pdf_drawn_codes.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

class QPDF;

namespace gumcert::reports {

/// The text of every page of a PDF as a reader copies it, by the ToUnicode maps of its fonts, in the order in which it
/// is drawn and without blanks. Texts in pictures are not looked at.
/// \throws std::exception of the reader if the file is no PDF, and where a page or a map of a font is packed more than once,
///                        unpacks to more than 32 MiB, all of them to more than 1 GiB, or the text is longer than 256 MiB;
///                        std::bad_alloc says nothing of the file
[[nodiscard]] std::vector<std::string> texts_of_pages(std::string_view pdf);
/// The same of a file that was read already.
[[nodiscard]] std::vector<std::string> texts_of_pages(QPDF& pdf);

/// Behind every text that is drawn by itself: a cell of a table, a word, a part of a number.
inline constexpr char k_end_of_drawn_text = '\x1F';

/// The same with its blanks and hyphens, and k_end_of_drawn_text.
/// \throws as texts_of_pages()
[[nodiscard]] std::vector<std::string> drawn_texts_of_pages(std::string_view pdf);

/// Texts that the contents of pages state beside what they draw.
/// \throws as texts_of_pages()
[[nodiscard]] std::vector<TextBesideDrawn> texts_beside_drawn(std::string_view pdf);

/// A text without blanks and hyphens, as texts_of_pages() gives it.
[[nodiscard]] std::string without_blanks(const std::string& text);

/// Whether each text stands on every page: the number of a certificate, the mark of a draft or a specimen, the digest of
/// templates that were changed. A template of a laboratory can forget them; then there is no document.
/// \param pages  as of texts_of_pages()
/// \param texts  compared without blanks and hyphens, because a line may break in them; empty ones are left out
[[nodiscard]] std::vector<gum::Diagnostic> check_pages(const std::vector<std::string>& pages,
                                                       const std::vector<std::string>& texts);

/// GC-REPORT-0032 of a text that is not where every page needs it.
/// \param where  "PDF, page 2 of 3", "HTML"
[[nodiscard]] gum::Diagnostic missing_on_a_page(const std::string& where, const std::string& text);

/// Whether the numbers of a view stand in the PDF that a template made of it: the digits of every row of a table, of every
/// value and sentence, in their order. A template that prints another digit gives no document.
/// \param pages  as of texts_of_pages()
/// \param view   as of certificate_view()
[[nodiscard]] std::vector<gum::Diagnostic> check_numbers(const std::vector<std::string>& pages,
                                                         const nlohmann::json& view);

}  // namespace gumcert::reports
