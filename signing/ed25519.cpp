#include "signing/ed25519.h"

#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>

#include <cstddef>

#include "signing/openssl_handles.h"
#include "signing/signing_files.h"

namespace gumcert::signing {

namespace {

constexpr std::size_t k_public_key_bytes = 32;
constexpr std::size_t k_ed25519_bytes = 64;

const unsigned char* octets(const Bytes& bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

[[noreturn]] void refuse_key(const std::filesystem::path& file, const char* what) {
    ERR_clear_error();
    throw gum::InputError(
        gum::Diagnostic{.code = "GC-SIGN-0060",
                        .where = file.string(),
                        .what = what,
                        .rule = "heads of an archive are signed with Ed25519, with a key in a PEM file",
                        .action = "make one with openssl genpkey -algorithm ed25519, and its public "
                                  "key with openssl pkey -pubout"});
}

Bytes raw_public_key(EVP_PKEY* key) {
    Bytes bytes(k_public_key_bytes, '\0');
    std::size_t size = bytes.size();
    if (EVP_PKEY_get_raw_public_key(key, reinterpret_cast<unsigned char*>(bytes.data()), &size) != 1) {
        size = 0;
    }
    bytes.resize(size);
    return bytes;
}

/// No passphrase: a key that asks for one is refused and does not stop the program at a terminal.
int no_passphrase(char* /*buffer*/, int /*size*/, int /*writing*/, void* /*data*/) {
    return -1;
}

}  // namespace

Ed25519Signature sign_ed25519(const Bytes& message, const std::filesystem::path& key) {
    const std::string pem = read_signing_file(key);
    const Handle<BIO> in(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
    const KeyHandle own(PEM_read_bio_PrivateKey(in.get(), nullptr, no_passphrase, nullptr));
    if (own == nullptr || EVP_PKEY_is_a(own.get(), "ED25519") != 1) {
        refuse_key(key, "no private key of kind Ed25519 in it that opens without a passphrase");
    }
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
    Ed25519Signature signature{raw_public_key(own.get()), Bytes(k_ed25519_bytes, '\0')};
    std::size_t size = signature.value.size();
    if (EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, own.get()) != 1 ||
        EVP_DigestSign(context.get(), reinterpret_cast<unsigned char*>(signature.value.data()), &size, octets(message),
                       message.size()) != 1) {
        refuse_key(key, "OpenSSL could not sign with it");
    }
    return signature;
}

bool is_signed_ed25519(const Bytes& message, const Ed25519Signature& signature) {
    const KeyHandle key(EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, octets(signature.public_key),
                                                    signature.public_key.size()));
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
    const bool good = key != nullptr &&
                      EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key.get()) == 1 &&
                      EVP_DigestVerify(context.get(), octets(signature.value), signature.value.size(), octets(message),
                                       message.size()) == 1;
    ERR_clear_error();
    return good;
}

Bytes ed25519_public_key(const std::filesystem::path& file) {
    const std::string pem = read_signing_file(file);
    const Handle<BIO> in(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
    const KeyHandle key(PEM_read_bio_PUBKEY(in.get(), nullptr, no_passphrase, nullptr));
    if (key == nullptr || EVP_PKEY_is_a(key.get(), "ED25519") != 1) {
        refuse_key(file, "no public key of kind Ed25519 in it");
    }
    return raw_public_key(key.get());
}

}  // namespace gumcert::signing
