#pragma once

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "signing/signer.h"

// Keys and certificates made on the fly: no key lies in the tree.

namespace gumcert::signing::test {

struct FreeKey {
    void operator()(EVP_PKEY* p) const { EVP_PKEY_free(p); }
    void operator()(X509* p) const { X509_free(p); }
    void operator()(BIO* p) const { BIO_free_all(p); }
};
using Key = std::shared_ptr<EVP_PKEY>;
using Certificate = std::shared_ptr<X509>;

inline constexpr std::int64_t k_signing_time = 1774958400;  // 2026-03-31T12:00:00Z
inline constexpr std::int64_t k_now = k_signing_time + 86400;
inline constexpr std::int64_t k_day = 86400;

inline Key rsa_key(unsigned bits = 2048) {
    return {EVP_RSA_gen(bits), FreeKey()};
}
inline Key ec_key(const char* curve = "P-256") {
    return {EVP_EC_gen(curve), FreeKey()};
}

/// A certificate and its key, and who issued it.
struct Identity {
    Key key;
    Certificate certificate;
};

struct CertificateOptions {
    std::string name = "Example Calibration Laboratory";
    const char* key_usage = "critical,digitalSignature";  ///< "": none
    const char* extended_key_usage = "";                  ///< "": none
    bool authority = false;                               ///< may issue certificates, if its key usage says so
    const EVP_MD* digest = EVP_sha256();                  ///< that the issuer signs it with
    std::int64_t from = k_signing_time - 100 * k_day;
    std::int64_t to = k_signing_time + 300 * k_day;
};

inline void add_extension(X509* certificate, int nid, const char* value) {
    X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, nullptr, nid, value);
    ASSERT_NE(extension, nullptr);
    X509_add_ext(certificate, extension, -1);
    X509_EXTENSION_free(extension);
}

/// \param issuer  nullptr: signed by itself
inline Identity make_identity(Key key, const CertificateOptions& options = {}, const Identity* issuer = nullptr) {
    static long serial = 1;
    Certificate certificate(X509_new(), FreeKey());
    X509_set_version(certificate.get(), X509_VERSION_3);
    ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), serial++);
    ASN1_TIME_set(X509_getm_notBefore(certificate.get()), options.from);
    ASN1_TIME_set(X509_getm_notAfter(certificate.get()), options.to);
    X509_set_pubkey(certificate.get(), key.get());
    X509_NAME* name = X509_get_subject_name(certificate.get());
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8, reinterpret_cast<const unsigned char*>(options.name.c_str()),
                               -1, -1, 0);
    X509_set_issuer_name(certificate.get(),
                         issuer == nullptr ? name : X509_get_subject_name(issuer->certificate.get()));
    add_extension(certificate.get(), NID_basic_constraints, options.authority ? "critical,CA:TRUE" : "CA:FALSE");
    const std::string usage = options.key_usage;
    if (!usage.empty()) {
        add_extension(certificate.get(), NID_key_usage, usage.c_str());
    }
    if (*options.extended_key_usage != '\0') {
        add_extension(certificate.get(), NID_ext_key_usage, options.extended_key_usage);
    }
    X509_sign(certificate.get(), issuer == nullptr ? key.get() : issuer->key.get(), options.digest);
    return {.key = key, .certificate = certificate};
}

inline Bytes der(const Identity& identity) {
    unsigned char* data = nullptr;
    const int size = i2d_X509(identity.certificate.get(), &data);
    Bytes bytes(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
    OPENSSL_free(data);
    return bytes;
}

/// A list of revoked certificates by an issuer, DER.
inline Bytes revocation_list(const Identity& issuer, const std::vector<const Identity*>& revoked,
                             std::int64_t next_update = k_now + 7 * k_day) {
    X509_CRL* const list = X509_CRL_new();
    X509_CRL_set_version(list, 1);
    X509_CRL_set_issuer_name(list, X509_get_subject_name(issuer.certificate.get()));
    ASN1_TIME* const time = ASN1_TIME_set(nullptr, k_signing_time - 10 * k_day);
    X509_CRL_set1_lastUpdate(list, time);
    for (const Identity* one : revoked) {
        X509_REVOKED* const entry = X509_REVOKED_new();
        X509_REVOKED_set_serialNumber(entry, X509_get_serialNumber(one->certificate.get()));
        X509_REVOKED_set_revocationDate(entry, time);
        X509_CRL_add0_revoked(list, entry);
    }
    ASN1_TIME_set(time, next_update);
    X509_CRL_set1_nextUpdate(list, time);
    ASN1_TIME_free(time);
    X509_CRL_sort(list);
    X509_CRL_sign(list, issuer.key.get(), EVP_sha256());
    unsigned char* data = nullptr;
    const int size = i2d_X509_CRL(list, &data);
    Bytes bytes(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
    OPENSSL_free(data);
    X509_CRL_free(list);
    return bytes;
}

inline std::string text_of(BIO* bio) {
    char* data = nullptr;
    const long size = BIO_get_mem_data(bio, &data);
    return {data, static_cast<std::size_t>(size)};
}

inline std::string pem(const Identity& identity) {
    const std::unique_ptr<BIO, FreeKey> out(BIO_new(BIO_s_mem()));
    PEM_write_bio_X509(out.get(), identity.certificate.get());
    return text_of(out.get());
}

inline std::string key_pem(const Identity& identity, const std::string& passphrase = {}) {
    const std::unique_ptr<BIO, FreeKey> out(BIO_new(BIO_s_mem()));
    PEM_write_bio_PKCS8PrivateKey(out.get(), identity.key.get(), passphrase.empty() ? nullptr : EVP_aes_256_cbc(),
                                  passphrase.empty() ? nullptr : passphrase.data(), static_cast<int>(passphrase.size()),
                                  nullptr, nullptr);
    return text_of(out.get());
}

/// A folder of the test, removed at its end.
class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::path(testing::TempDir()) / "signing-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] std::filesystem::path path() const { return path_; }
    std::filesystem::path put(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / name, std::ios::binary) << text;
        return path_ / name;
    }

private:
    std::filesystem::path path_;
};

/// A laboratory with its own root: the certificate to trust, and a signer from files.
struct Laboratory {
    Identity root;
    Identity own;
    Folder folder;
    std::unique_ptr<Signer> signer;

    explicit Laboratory(Key key, const CertificateOptions& options = {})
        : root(make_identity(ec_key(),
                             {.name = "Example Root", .key_usage = "critical,keyCertSign", .authority = true})),
          own(make_identity(std::move(key), options, &root)) {
        signer = signer_from_files(folder.put("key.pem", key_pem(own)), folder.put("chain.pem", pem(own) + pem(root)));
    }
    [[nodiscard]] std::vector<Bytes> trusted() const { return {der(root)}; }
};

/// Signs with whatever it is given, as the program of somebody else would. It shows `decoy` when it is asked first:
/// then sign_dcc() and sign_pdf() find a certificate in force.
class CarelessSigner : public Signer {
public:
    CarelessSigner(Key key, std::vector<Identity> chain, const Identity* decoy = nullptr) : key_(std::move(key)) {
        for (const Identity& identity : chain) {
            chain_.push_back(der(identity));
        }
        decoy_ = decoy == nullptr ? chain_ : std::vector<Bytes>{der(*decoy)};
    }
    [[nodiscard]] const std::vector<Bytes>& certificates() const override { return asked_++ == 0 ? decoy_ : chain_; }
    [[nodiscard]] std::string algorithm() const override {
        return EVP_PKEY_get_base_id(key_.get()) == EVP_PKEY_RSA ? "RSA" : "ECDSA";
    }
    [[nodiscard]] Bytes sign_sha256(const Bytes& digest) const override {
        EVP_PKEY_CTX* context = EVP_PKEY_CTX_new(key_.get(), nullptr);
        EVP_PKEY_sign_init(context);
        EVP_PKEY_CTX_set_signature_md(context, EVP_sha256());
        std::size_t size = 1024;
        Bytes signature(size, '\0');
        EVP_PKEY_sign(context, reinterpret_cast<unsigned char*>(signature.data()), &size,
                      reinterpret_cast<const unsigned char*>(digest.data()), digest.size());
        EVP_PKEY_CTX_free(context);
        signature.resize(size);
        return signature;
    }

private:
    Key key_;
    std::vector<Bytes> chain_, decoy_;
    mutable int asked_ = 0;
};

inline bool program_exists(const std::string& name) {
    return std::filesystem::exists(std::filesystem::path("/usr/bin") / name);
}

/// What a command prints, both streams. The words are of the test itself.
inline std::string output_of(const std::string& command, int* status = nullptr) {
    std::array<char, 4096> part{};
    std::string all;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    while (std::fgets(part.data(), part.size(), pipe) != nullptr) {
        all += part.data();
    }
    const int ended = pclose(pipe);
    if (status != nullptr) {
        *status = ended;
    }
    return all;
}

inline std::string file_text(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The code of the first finding that makes a signature invalid.
template <class Report>
std::string first_error(const Report& report) {
    for (const gum::Diagnostic& finding : report.findings) {
        if (finding.severity == gum::Severity::error) {
            return finding.code;
        }
    }
    return "";
}

}  // namespace gumcert::signing::test
