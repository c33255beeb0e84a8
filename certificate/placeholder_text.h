#pragma once

#include <cstddef>
#include <string_view>

namespace gumcert::certificate {

/// Whether a text stands in the place of a statement and states nothing: it has no letter and no digit ("-"), is one
/// letter again and again ("xxx"), a key of the keyboard after the other ("asdf"), or has words for nothing ("unknown",
/// "see above", "k. A.", "desconocido", "不明", "test") and no others than particles and names of fields ("unknown
/// customer"). Case, accents, spaces and punctuation make no difference; English, German, Spanish and Chinese. A text
/// with any other word states something.
[[nodiscard]] bool is_placeholder(std::string_view text);

/// The same for what names or identifies: "customer", "the device" and "serial number" are the names of fields, too.
[[nodiscard]] bool names_only_a_field(std::string_view text);

/// The same for names: digits and single letters beside such words tell nothing ("Customer A", "Kunde 1", "Mr. X"), nor
/// do the names of nobody ("John Doe", "Sample"). With an initial or a legal form, words that people and firms are called
/// as well are a name: "A. Feld", "Land GmbH".
[[nodiscard]] bool names_nobody(std::string_view text);

/// Whether a text is an article, a preposition or another word that tells nothing by itself: "is", "en", "für".
[[nodiscard]] bool is_particle(std::string_view text);

/// Whether an identification is still to come in part: "EX-2026-tbd", "SN-XXXX", "CP-??".
[[nodiscard]] bool is_still_to_come(std::string_view text);

/// Whether every part of an identification is nothing, zeros or the name of a field: "XX-00-00", "none/none".
[[nodiscard]] bool has_empty_parts_only(std::string_view text);

/// Whether a number says that its document is a draft, a sample or new: "EX-2026-0042 DRAFT", "草稿-0042".
[[nodiscard]] bool is_of_a_draft(std::string_view text);

/// Whether the identification of a method describes what is usual only: "in-house", "wie üblich", "by hand".
[[nodiscard]] bool describes_the_usual(std::string_view text);

/// Whether a text says that a thing is agreed on, and neither by whom nor why: "Divisor agreed."
[[nodiscard]] bool is_consent_of_nobody(std::string_view text);
/// Whether names of fields beside one word that tells something make a sentence: "The device was dead.", "Customer accepts it."
/// Of four words or with a verb; a word for a sample or a draft tells nothing here.
[[nodiscard]] bool is_sentence_of_fields(std::string_view text);

/// How many different words of a text tell something: "because because of" has none.
[[nodiscard]] std::size_t telling_words(std::string_view text);

}  // namespace gumcert::certificate
