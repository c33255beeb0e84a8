#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

/// Holds a digital certificate against the one that the record gives now: every element, attribute and text, in their order.
/// Records that another version has made are not evaluated again, and so their documents do not come this far. Left out are
/// signatures, which are made behind the document, and the program that wrote it.
/// \return what differs, for a message; "" where document and record agree
/// \throws gum::InputError  if it cannot be read
[[nodiscard]] std::string disagreement_of_dcc(std::string_view bytes, const std::string& name,
                                              std::string_view made_of_record);

/// The languages of a digital certificate, as it lists them: "de", "en". The first one is binding.
/// \throws gum::InputError  if it cannot be read
[[nodiscard]] std::vector<std::string> languages_of_dcc(std::string_view bytes, const std::string& name);

/// The beginning of the digest of changed templates that a digital certificate says it was made with; "" where it says nothing
/// of them, or something else than such a digest.
/// \throws gum::InputError  if it cannot be read
[[nodiscard]] std::string changed_templates_of_dcc(std::string_view bytes, const std::string& name);

}  // namespace gumcert::reports
