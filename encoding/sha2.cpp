#include "encoding/sha2.h"

#include <openssl/evp.h>

#include <array>
#include <cstddef>
#include <stdexcept>

namespace gumcert::encoding {

std::string sha2_bytes(const char* name, std::string_view bytes) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> out{};
    std::size_t size = 0;
    if (EVP_Q_digest(nullptr, name, nullptr, bytes.data(), bytes.size(), out.data(), &size) != 1) {
        throw std::runtime_error(std::string("OpenSSL has no digest ") + name);
    }
    return {reinterpret_cast<const char*>(out.data()), size};
}

std::string sha256_bytes(std::string_view bytes) {
    return sha2_bytes("SHA2-256", bytes);
}

std::string sha256(std::string_view bytes) {
    return hexadecimal(sha256_bytes(bytes));
}

std::string hexadecimal(std::string_view bytes) {
    constexpr std::string_view k_digits = "0123456789abcdef";
    std::string text;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        text += k_digits[byte >> 4U];
        text += k_digits[byte & 15U];
    }
    return text;
}

}  // namespace gumcert::encoding
