#pragma once

#include "reports/record/evaluation_record.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>

namespace gumcert::reports {

/// What a certificate shows, in order, as texts: the one view model behind HTML, PDF and plain text.
///
/// Every leaf is a string; templates place strings and compute nothing. Something optional is an array of none or one.
///
///     language, type, mark, mark_reason, title, running_title, page, of, end_mark, only_items
///     sections[]  id, heading, blocks[]
///     blocks[]    one of  paragraph[] {text} · formula[] {text} · definitions[] {rows[] {label, value}}
///                 · figure[] {id, number, caption, svg, alt} · table[] {…}
///     table[]     id, number, caption, columns[] {head, unit[] {text}, align}, groups[] {text, span}, rows[]
///     rows[]      kind: "plain" | "part" (of the row above) | "closing", cells[]
///     cells[]     text, pad, align: "left" | "number"; `pad` is drawn invisibly behind the text so that the decimal
///                 signs of a column stand below each other
///
/// Numbers are the texts of `printed` in the record, untouched; what has no such text is rounded here, once for all
/// forms. Control and direction characters of texts become U+FFFD.
/// \param wording  labels and sentences, templates/wording/<language>.json
/// \throws gum::StorageError if the wording lacks a text
[[nodiscard]] nlohmann::json certificate_view(const EvaluationRecord& record, const nlohmann::json& wording);

/// A text as it may stand in a document: tab and line feed become blanks; other control characters, characters that
/// change the direction of writing, and bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string printable(const std::string& text);

/// At most `most` characters of a UTF-8 text, with an ellipsis where something was left out.
[[nodiscard]] std::string shortened(const std::string& text, std::size_t most);

}  // namespace gumcert::reports
