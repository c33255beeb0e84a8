#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gumcert::archive {

/// What an archive is at one moment, in a few lines: kept elsewhere, it proves later that nothing before it was changed
/// or cut off.
struct Head {
    std::string archive;    ///< hash of the first entry: which archive it is; 32 bytes, as all hashes here
    std::int64_t size = 0;  ///< entries
    std::string root;       ///< of the Merkle tree over the hashes of the entries (archive/store/merkle.h)
    std::string chain;      ///< hash of the last entry
    std::string at;         ///< time of the last entry
    struct Signature {
        std::string public_key;  ///< Ed25519, 32 bytes
        std::string value;       ///< 64 bytes, over signed_bytes()
        friend bool operator==(const Signature&, const Signature&) = default;
    };
    std::optional<Signature> signature = {};

    friend bool operator==(const Head&, const Head&) = default;
};

/// Canonical JSON with hashes in hexadecimal, schema "gumcert/archive-head/1".
[[nodiscard]] std::string to_json(const Head& head);
/// \param name  of the file, for messages
/// \throws gum::InputError  GC-ARCHIVE-0049 where it is no head
[[nodiscard]] Head head_from_json(std::string_view text, const std::string& name);

/// What a signature of a head is over: its canonical JSON without the signature.
[[nodiscard]] std::string signed_bytes(const Head& head);

/// The bytes of hexadecimal digits in lower case.
/// \return none where there are others, or an odd number
[[nodiscard]] std::optional<std::string> bytes_from_hexadecimal(std::string_view digits);

}  // namespace gumcert::archive
