#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "signing/signer.h"
#include "signing/verify.h"
#include "tests/fuzz/bundle_folder.h"
#include "tests/fuzz/job_targets.h"

namespace gumcert::fuzz {
namespace {

/// A key that is made when the process begins, in PEM, open and closed by the word "secret", and a certificate of it: no key
/// lies in the tree.
struct OwnKey {
    std::string key, encrypted, certificate;
};

std::string pem_of(const auto& write) {
    const std::unique_ptr<BIO, int (*)(BIO*)> out(BIO_new(BIO_s_mem()), BIO_free);
    demand(write(out.get()) == 1, "a key that cannot be written");
    char* text = nullptr;
    const auto size = static_cast<std::size_t>(BIO_get_mem_data(out.get(), &text));
    return {text, size};
}

OwnKey own_key() {
    const std::unique_ptr<EVP_PKEY, void (*)(EVP_PKEY*)> key(EVP_EC_gen("P-256"), EVP_PKEY_free);
    const std::unique_ptr<X509, void (*)(X509*)> certificate(X509_new(), X509_free);
    constexpr long k_years = 30L * 365 * 86400;
    X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -k_years);
    X509_gmtime_adj(X509_getm_notAfter(certificate.get()), k_years);
    X509_set_pubkey(certificate.get(), key.get());
    X509_sign(certificate.get(), key.get(), EVP_sha256());
    const auto write_key = [&](const EVP_CIPHER* cipher) {
        return pem_of([&](BIO* out) {
            char word[] = "secret";
            return PEM_write_bio_PKCS8PrivateKey(out, key.get(), cipher, word, 6, nullptr, nullptr);
        });
    };
    return {write_key(nullptr), write_key(EVP_aes_128_cbc()),
            pem_of([&](BIO* out) { return PEM_write_bio_X509(out, certificate.get()); })};
}

/// A bundle with the own key where it names it.
std::string with_own_key(std::string bundle) {
    static const OwnKey own = own_key();
    for (const auto& [name, text] : {std::pair<std::string_view, const std::string&>{"@KEY@", own.key},
                                     {"@ENCRYPTED_KEY@", own.encrypted},
                                     {"@CERTIFICATE@", own.certificate}}) {
        if (const std::size_t at = bundle.find(name); at != std::string::npos) {
            bundle.replace(at, name.size(), text);
        }
    }
    return bundle;
}

template <class Use>
void used_or_refused(const Use& use) {
    try {
        use();
    } catch (const gum::InputError& error) {
        demand(!error.diagnostics().empty(), "refused without a reason");
        jobs::fuzz::demand_honest(error.diagnostics());
    } catch (const gum::StorageError& error) {
        demand(!error.diagnostics().empty(), "refused without a reason");
        jobs::fuzz::demand_honest(error.diagnostics());
    }
}

void use_signer(const BundleFolder& folder) {
    constexpr std::int64_t k_time = 1774958400;  // 2026-03-31
    const signing::DescribedSigner described = signing::described_signer(folder.file("signer.json"));
    demand(described.signer != nullptr && !described.signer->certificates().empty(), "a signer without a certificate");
    const std::string algorithm = described.signer->algorithm();
    demand(algorithm == "RSA" || algorithm == "ECDSA", "an algorithm");
    demand(described.files.size() >= 2, "files that must not be written");
    jobs::fuzz::demand_honest(described.warnings);
    for (const std::filesystem::path& file : described.files) {
        demand(!file.empty(), "a file without a name");
    }
    signing::require_a_chain(*described.signer, k_time);
}

}  // namespace
}  // namespace gumcert::fuzz

/// The files of a signer, `signer.json` and what it names, are refused or are a signer; no program is started. The same files
/// as a trust store and as lists of revoked certificates.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    static const fuzz::BundleFolder folder("signer");
    folder.fill(fuzz::with_own_key(std::string(data, data + size)));
    fuzz::used_or_refused([] { fuzz::use_signer(folder); });
    fuzz::used_or_refused([] { (void)signing::read_trust_store(folder.file("chain.pem")); });
    fuzz::used_or_refused([] { (void)signing::read_revocation_lists(folder.file("chain.pem")); });
    return 0;
}
