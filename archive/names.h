#pragma once

#include <string>
#include <string_view>

namespace gumcert::archive {

/// The form in which the log compares names of persons: small letters (Latin of ASCII, Latin-1 and Latin Extended-A, Greek,
/// Cyrillic), one blank between words, none around them. tools/verify_archive.py has the same letters.
[[nodiscard]] std::string name_key(std::string_view name);

/// Whether two names may be those of one person: they differ in nothing but capitals, blanks, hyphens, accents, hidden
/// characters, or letters that look alike. What is to be written is held against this; the log is held against name_key().
[[nodiscard]] bool may_be_one_person(std::string_view a, std::string_view b);

/// The form in which numbers of certificates are compared: two with the same one cannot be told apart. Letters that look alike
/// are one, small, hyphens and slashes of all kinds one, full-width characters and signs that are letters plain ones, and blanks and
/// hidden characters nothing.
[[nodiscard]] std::string confusable_form(std::string_view number);

/// Why a text cannot be told from others by who reads it: hidden characters, blanks that are no plain single ones,
/// combining marks beside letters that have a composed form, words of mixed scripts. A phrase for messages; "" where it can.
[[nodiscard]] std::string objection_to_name(std::string_view name);

}  // namespace gumcert::archive
