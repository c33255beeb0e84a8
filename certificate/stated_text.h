#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "certificate/localised_text.h"

namespace gumcert::certificate {

// Whether a field is filled in. Only what can be seen of the text itself: a wrong name is a name.

/// Whether a text states something: it is no placeholder (certificate/placeholder_text.h). A dash or a blank in a field
/// is an empty field.
[[nodiscard]] bool is_stated(const std::string& text);
/// In every language in which it was given.
[[nodiscard]] bool is_stated(const LocalisedText& text);
/// At least one of a list.
template <class Text>
[[nodiscard]] bool any_stated(const std::vector<Text>& texts) {
    return std::any_of(texts.begin(), texts.end(), [](const Text& text) { return is_stated(text); });
}

/// Whether a text that is given as a reason says something. A reason is in words of a laboratory, of which many stand for nothing in a
/// field ("number not needed", "Gerät nicht erhalten", "error en el número de serie"): nothing is said by a text without a letter
/// ("-", "17"), by one letter again and again ("xxx"), by keys beside each other ("asdf"), and by "n/a", "none", "tbd" and the like
/// as a whole.
[[nodiscard]] bool states_a_reason(const std::string& text);
/// In every language in which it was given.
[[nodiscard]] bool states_a_reason(const LocalisedText& text);

/// A name of a person, an organisation or a thing: stated, of two letters or digits or one ideograph at least, no
/// number, no e-mail address and no address of a site.
[[nodiscard]] bool is_name(const std::string& text);
/// A name, or letters and a number as documents have them: "EN 837-1", "IS 3624", although "en" and "is" alone tell nothing.
[[nodiscard]] bool is_name_of_document(const std::string& text);
[[nodiscard]] bool is_name(const LocalisedText& text);

/// Whether two names are of one person or organisation: both stated, and with the same letters (letters_of()). A space,
/// a full stop or a capital letter makes no other person.
[[nodiscard]] bool is_same_name(const std::string& a, const std::string& b);

/// A number or a mark that identifies something: stated in all of its parts, and not "0", "0000", "9999",
/// "123456", "EX-XXXX" or "SN-tbd".
[[nodiscard]] bool is_identification(const std::string& text);
/// The same of a certificate: no draft, sample or copy.
[[nodiscard]] bool is_document_number(const std::string& text);
/// The same of a method: no words for what is usual.
[[nodiscard]] bool is_method_identification(const std::string& text);

/// A sentence that says something, as a reason has to: stated, of several words and of twelve letters or four
/// ideographs at least, two of the words telling something, or one beside the name of a field in a sentence ("The device was
/// dead"). "x", "n/a", "see above" and "there were no deviations" are
/// none.
[[nodiscard]] bool is_statement(const std::string& text);
[[nodiscard]] bool is_statement(const LocalisedText& text);
template <class Text>
[[nodiscard]] bool any_statement(const std::vector<Text>& texts) {
    return std::any_of(texts.begin(), texts.end(), [](const Text& text) { return is_statement(text); });
}

/// name@domain.country
[[nodiscard]] bool is_email(const std::string& text);

/// Lines of an address to which a letter could be sent: more than a country or one word, with a number or
/// of five words at least.
[[nodiscard]] bool is_postal_address(const std::vector<std::string>& lines);

}  // namespace gumcert::certificate
