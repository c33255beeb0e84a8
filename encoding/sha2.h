#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gumcert::encoding {

/// SHA-256 of some bytes, 32 bytes (FIPS 180-4).
[[nodiscard]] std::string sha256_bytes(std::string_view bytes);

/// The same as 64 hexadecimal digits in lower case.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// A digest of the SHA-2 family, as bytes.
/// \param name  as OpenSSL calls it: "SHA2-256", "SHA2-384", "SHA2-512"
[[nodiscard]] std::string sha2_bytes(const char* name, std::string_view bytes);

/// Bytes as hexadecimal digits in lower case.
[[nodiscard]] std::string hexadecimal(std::string_view bytes);

/// The bytes of hexadecimal digits in lower case.
/// \return none where there are others, or an odd number
[[nodiscard]] std::optional<std::string> bytes_from_hexadecimal(std::string_view digits);

/// Whether a text has the form of sha256().
[[nodiscard]] bool is_sha256(std::string_view text);

}  // namespace gumcert::encoding
