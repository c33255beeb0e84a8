#pragma once

#include <string>
#include <string_view>

namespace gumcert::reports {

/// What a text of a simple type of the DCC or of D-SI has to be, in words, where it is not; "" where it is right, or
/// where the type is not one of these: string, word, country, language, date, dateTime, duration, boolean, uri, base64,
/// integer, decimal, positive, factor, probability, name, names, references.
/// \param version  310 for 3.1.0
[[nodiscard]] std::string text_fault(std::string_view type, std::string_view text, int version);

}  // namespace gumcert::reports
