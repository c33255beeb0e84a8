#include "app/file_digest.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <stdexcept>

#include "gum/quantity/diagnostic.h"

namespace gumcert::app {

std::string sha256(std::string_view bytes) {
    std::array<unsigned char, 32> digest{};
    unsigned int size = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1 ||
        size != digest.size()) {
        throw std::runtime_error("SHA-256 is not available");
    }
    constexpr std::string_view k_digits = "0123456789abcdef";
    std::string text;
    for (const unsigned char byte : digest) {
        text += k_digits[byte >> 4U];
        text += k_digits[byte & 15U];
    }
    return text;
}

std::string read_file(const std::filesystem::path& file) {
    std::error_code error;
    std::ifstream stream;
    if (!std::filesystem::is_directory(file, error)) {
        stream.open(file, std::ios::binary);
    }
    std::string bytes;
    if (stream.is_open()) {
        std::array<char, 65536> buffer{};
        while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0) {
            bytes.append(buffer.data(), static_cast<std::size_t>(stream.gcount()));
        }
    }
    if (!stream.is_open() || stream.bad()) {
        throw gum::StorageError(gum::Diagnostic{"GC-STORE-0001", file.string(), "cannot be read",
                                                "a file is needed that exists and may be read",
                                                "check the name and the access rights", gum::Severity::error});
    }
    return bytes;
}

}  // namespace gumcert::app
