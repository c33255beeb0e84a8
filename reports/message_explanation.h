#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "reports/message_register.h"

namespace gumcert::reports {

/// What a code means, as text for a terminal: severity and what follows for the result, meaning, usual cause, what to do,
/// and the rules that its messages state.
/// \param code  one of the register
[[nodiscard]] std::string explanation_of_code(const MessageRegister& all, std::string_view code);

/// The codes of a family, each with the first sentence of its meaning.
/// \param family  one of the register
[[nodiscard]] std::string list_of_codes(const MessageRegister& all, std::string_view family);

/// All families, with the number of their codes.
[[nodiscard]] std::string list_of_families(const MessageRegister& all);

/// A text in lines of at most `width` characters, those after the first one indented. A word that is longer stays whole.
[[nodiscard]] std::string in_lines(std::string_view text, std::size_t width, std::size_t indent);

}  // namespace gumcert::reports
