#pragma once

#include <cstddef>

namespace gumcert::signing {

// Documents whose signatures are checked. `gumcert limits` prints these.

/// More signatures or attachments than this are not looked at one by one: each costs a pass over the whole file.
inline constexpr std::size_t k_most_signatures = 16;
/// Certificates that come with a signature: each is held against all others.
inline constexpr std::size_t k_most_certificates = 16;
inline constexpr std::size_t k_largest_attachments = std::size_t{64} << 20U;  ///< [byte], of all attachments of a PDF
/// A tree takes some hundred bytes for each tag and attribute, and the time to compare those of a tag grows as the square of
/// their number.
inline constexpr std::size_t k_most_in_tag = 64;
inline constexpr std::size_t k_most_parts = 2'000'000;  ///< tags and attributes

}  // namespace gumcert::signing
