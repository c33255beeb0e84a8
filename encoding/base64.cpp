#include "encoding/base64.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cstddef>

namespace gumcert::encoding {

namespace {

constexpr std::size_t k_longest = 100'000'000;  // characters; the interface of OpenSSL counts in int

const unsigned char* raw(std::string_view bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

}  // namespace

std::string base64(std::string_view bytes) {
    std::string out;
    // A multiple of three bytes has no padding, so that the parts can stand one after the other.
    constexpr std::size_t k_part = 3'000'000;
    for (std::size_t at = 0; at < bytes.size(); at += k_part) {
        const std::string_view part = bytes.substr(at, k_part);
        std::string text((part.size() + 2) / 3 * 4 + 1, '\0');
        const int size =
            EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), raw(part), static_cast<int>(part.size()));
        out.append(text, 0, static_cast<std::size_t>(size));
    }
    return out;
}

std::optional<std::string> bytes_from_base64(std::string_view text) {
    std::string packed;
    for (const char c : text) {
        if (c != ' ' && c != '\n' && c != '\r' && c != '\t') {
            packed += c;
        }
    }
    const std::size_t letters = std::min(packed.find('='), packed.size());
    const std::size_t padding = packed.size() - letters;
    // OpenSSL would take padding anywhere.
    if (packed.size() % 4 != 0 || packed.size() > k_longest || padding > 2 ||
        packed.find_first_not_of('=', letters) != std::string::npos) {
        return std::nullopt;
    }
    std::string out(packed.size() / 4 * 3, '\0');
    const int size =
        EVP_DecodeBlock(reinterpret_cast<unsigned char*>(out.data()), raw(packed), static_cast<int>(packed.size()));
    if (size < 0 || static_cast<std::size_t>(size) != out.size()) {
        return std::nullopt;
    }
    out.resize(out.size() - padding);
    return out;
}

}  // namespace gumcert::encoding
