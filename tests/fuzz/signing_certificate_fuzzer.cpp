#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signing/certificates.h"
#include "tests/fuzz/job_targets.h"

/// Any bytes are no certificate of a signer, or one that is described, judged and held against a list of revoked ones, without
/// being trusted for that.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    using namespace gumcert::signing;
    constexpr std::int64_t k_time = 1774958400;  // 2026-03-31
    const std::string bytes(data, data + size);
    const std::vector<Bytes> lists = revocation_lists_from(bytes);
    for (const Bytes& der : certificates_from_pem(bytes)) {
        json::fuzz::demand(certificate_from_der(der) != nullptr, "a certificate that is none");
    }
    CertificateHandle certificate = certificate_from_der(bytes);
    if (!certificate) {
        return 0;
    }
    (void)subject_of(certificate.get());
    (void)issuer_of(certificate.get());
    (void)names_of(certificate.get());
    const std::string kind = kind_of_key(certificate.get());
    json::fuzz::demand(kind.empty() || kind == "RSA" || kind == "ECDSA", "a kind of key");
    json::fuzz::demand(weakness_of_key(certificate.get()).empty() <= !kind.empty(), "a strong key of no kind");
    (void)unfitness_for_documents(certificate.get());
    (void)weakness_of_issue(certificate.get());
    (void)ecdsa_part_size(certificate.get());
    (void)end_of_validity(certificate.get());
    (void)start_of_validity(certificate.get());
    json::fuzz::demand(!verifies(certificate.get(), "SHA2-256", std::string(32, 'd'), bytes), "a signature of nothing");
    std::vector<CertificateHandle> chain;
    chain.push_back(std::move(certificate));
    jobs::fuzz::demand_honest(check_revocation("fuzz", chain, {{bytes}, lists}, k_time));
    json::fuzz::demand(!check_chain("fuzz", chain, {}, k_time).empty(), "trusted without being named");
    jobs::fuzz::demand_honest(check_chain("fuzz", chain, {bytes}, k_time));
    return 0;
}
