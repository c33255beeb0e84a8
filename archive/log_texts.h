#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "archive/archive.h"

/// What is in an archive, for people and for programs. Every text in it is one that somebody wrote: for people none of them
/// brings a line of its own.
namespace gumcert::archive {

/// The certificates whose number, state, time or item contain each of some words, in small letters or in capitals.
[[nodiscard]] std::vector<ListedCertificate> with_words(std::vector<ListedCertificate> certificates,
                                                        const std::vector<std::string>& words);

/// A line for each.
[[nodiscard]] std::string list_text(const std::vector<ListedCertificate>& certificates);
/// Schema "gumcert/archive-list/1".
[[nodiscard]] nlohmann::json list_json(const std::vector<ListedCertificate>& certificates);

/// What became of a certificate, and every entry of the log on it.
/// \throws gum::InputError  GC-ARCHIVE-0026 where it is not in the archive
[[nodiscard]] std::string history_text(Archive& archive, const std::string& number);
/// The same, schema "gumcert/archive-certificate/1".
[[nodiscard]] nlohmann::json history_json(Archive& archive, const std::string& number);

}  // namespace gumcert::archive
