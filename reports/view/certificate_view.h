#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/document_kinds.h"
#include "reports/wording.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>

namespace gumcert::reports {

/// What a certificate shows, in order, as texts: the one view model behind HTML, PDF and plain text.
///
/// Every leaf is a string; templates place strings and compute nothing. Something optional is an array of none or one.
/// Texts are in the binding language. Beside a text `t` of which a second language may differ stands the array `t_also`
/// (beside a text called `text`: `also`) of none or one {text, language}; it is always there, because Mustache would
/// look for it in the object outside.
///
///     language, type, title (each with _also), running_title, end_mark (with _also)
///     header_left, header_right, footer_left      running texts of every page
///     pages[]     {page, of, end}, one a language: "page" n "of" N "end"
///     created     {year, month, day} of issue
///     mark[]      {text, also[], reason, reason_also[]}: draft, specimen, superseded; none on one that is issued
///     status[]    {text}: that a certificate is issued, and when; none on others
///     identity[]  the first page of a certificate, none without certificate data: laboratory, number, address[] …,
///                 see identity_page()
///     sections[]  id, heading, heading_also[], kind ("" or "annex"), blocks[]
///     blocks[]    one of  paragraph[] {text, also[]} · formula[] {text} · definitions[] {rows[] {label, value, both
///                 with _also}} · figure[] {id, number, caption, both with _also, svg, alt} · table[] {…}
///     table[]     id, number, caption, both with _also, columns[] {head, head_also[], unit[] {text}, align},
///                 groups[] {cells[] {text, also[], span}}, rows[]
///     rows[]      kind: "plain" | "part" (of the row above) | "closing", cells[]
///     cells[]     text, also[], pad, align: "left" | "number"; `pad` is drawn invisibly behind the text so that the
///                 decimal signs of a column stand below each other
///     closing[]   {text, also[]}: sentences before the end mark
///     attachment[] {name, description}: of a PDF
///     symbols[], letters[]  see symbols_in(): texts that are drawn as symbols
///
/// Numbers are the texts of `printed` in the record with the decimal sign of the language, otherwise untouched; what
/// has no such text is rounded here, once for all forms. Control and direction characters of texts become U+FFFD.
/// \param words  labels and sentences in the languages of the document
/// \param kinds  what records of each kind show
/// \throws gum::StorageError if the wording lacks a text
[[nodiscard]] nlohmann::json certificate_view(const EvaluationRecord& record, const Wording& words,
                                              std::span<const DocumentKind> kinds = document_kinds());

/// The budget report, for the technical manager and the assessor: everything that a certificate states and everything
/// that it is evaluated from, whatever annexes the certificate has, with longer lists and the files of readings. It is
/// no certificate and says so on every page: `identity` is empty, `mark` is that of an internal document.
/// \param record  with results; not of a comparison, whose own report holds its budgets
/// \throws gum::StorageError if the wording lacks a text
[[nodiscard]] nlohmann::json budget_report_view(const EvaluationRecord& record, const Wording& words,
                                                std::span<const DocumentKind> kinds = document_kinds());

}  // namespace gumcert::reports
