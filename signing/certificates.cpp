#include "signing/certificates.h"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/rsa.h>
#include <openssl/x509_vfy.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <initializer_list>
#include <memory>
#include <utility>

#include "signing/time_texts.h"

namespace gumcert::signing {

namespace {

std::string name_text(const X509_NAME* name) {
    const Handle<BIO> out(BIO_new(BIO_s_mem()));
    // UTF-8 as it is, but control characters escaped.
    X509_NAME_print_ex(out.get(), name, 0, XN_FLAG_RFC2253 & ~static_cast<unsigned long>(ASN1_STRFLGS_ESC_MSB));
    char* data = nullptr;
    const long size = BIO_get_mem_data(out.get(), &data);
    return size > 0 ? std::string(data, static_cast<std::size_t>(size)) : std::string();
}

std::optional<std::int64_t> seconds_of(const ASN1_TIME* time) {
    std::tm parts{};
    if (time == nullptr || ASN1_TIME_to_tm(time, &parts) != 1) {
        return std::nullopt;
    }
    const auto two = [](int number) { return (number < 10 ? "0" : "") + std::to_string(number); };
    return time_from_text(std::to_string(parts.tm_year + 1900) + two(parts.tm_mon + 1) + two(parts.tm_mday) +
                          two(parts.tm_hour) + two(parts.tm_min) + two(parts.tm_sec));
}

std::string curve_of(EVP_PKEY* key) {
    std::array<char, 64> name{};
    std::size_t size = 0;
    if (EVP_PKEY_get_group_name(key, name.data(), name.size(), &size) != 1) {
        return {};
    }
    return {name.data(), size};
}

gum::Diagnostic finding(const char* code, const std::string& where, std::string what, const char* rule,
                        const char* action) {
    return {.code = code, .where = where, .what = std::move(what), .rule = rule, .action = action};
}

struct UsagesFree {
    void operator()(EXTENDED_KEY_USAGE* p) const { EXTENDED_KEY_USAGE_free(p); }
};

/// Object identifiers of the extended key usage; empty where none is stated, or where it cannot be read.
std::vector<std::string> extended_key_usages(X509* certificate) {
    const std::unique_ptr<EXTENDED_KEY_USAGE, UsagesFree> usages(
        static_cast<EXTENDED_KEY_USAGE*>(X509_get_ext_d2i(certificate, NID_ext_key_usage, nullptr, nullptr)));
    ERR_clear_error();
    std::vector<std::string> all;
    for (int i = 0; i < sk_ASN1_OBJECT_num(usages.get()); ++i) {
        std::array<char, 128> text{};
        constexpr int k_always_as_number = 1;
        OBJ_obj2txt(text.data(), static_cast<int>(text.size()), sk_ASN1_OBJECT_value(usages.get(), i),
                    k_always_as_number);
        all.emplace_back(text.data());
    }
    return all;
}

bool is_for_documents(const std::vector<std::string>& extended_key_usages) {
    const auto has = [&](const char* identifier) {
        return std::find(extended_key_usages.begin(), extended_key_usages.end(), identifier) !=
               extended_key_usages.end();
    };
    constexpr const char* k_document_signing = "1.3.6.1.5.5.7.3.36";
    constexpr const char* k_document_signing_microsoft = "1.3.6.1.4.1.311.10.3.12";
    constexpr const char* k_document_signing_adobe = "1.2.840.113583.1.1.5";
    constexpr const char* k_email = "1.3.6.1.5.5.7.3.4";
    constexpr const char* k_any = "2.5.29.37.0";
    constexpr const char* k_client = "1.3.6.1.5.5.7.3.2";
    constexpr const char* k_web_server = "1.3.6.1.5.5.7.3.1";
    return has(k_document_signing) || has(k_document_signing_microsoft) || has(k_document_signing_adobe) ||
           has(k_email) || has(k_any) || (has(k_client) && !has(k_web_server));
}

}  // namespace

CertificateHandle certificate_from_der(const Bytes& der) {
    const auto* at = reinterpret_cast<const unsigned char*>(der.data());
    const auto* const end = at + der.size();
    CertificateHandle certificate(d2i_X509(nullptr, &at, static_cast<long>(der.size())));
    ERR_clear_error();
    // Bytes behind the certificate would be taken along and never read: the digest that names a certificate is that of
    // all the bytes.
    return at == end ? std::move(certificate) : CertificateHandle();
}

std::vector<Bytes> certificates_from_pem(const std::string& pem) {
    std::vector<Bytes> all;
    const Handle<BIO> in(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
    for (;;) {
        const CertificateHandle certificate(PEM_read_bio_X509(in.get(), nullptr, nullptr, nullptr));
        if (certificate == nullptr) {
            break;
        }
        unsigned char* der = nullptr;
        const int size = i2d_X509(certificate.get(), &der);
        if (size > 0) {
            all.emplace_back(reinterpret_cast<const char*>(der), static_cast<std::size_t>(size));
        }
        OPENSSL_free(der);
    }
    ERR_clear_error();
    return all;
}

std::string subject_of(X509* certificate) {
    return name_text(X509_get_subject_name(certificate));
}
std::string issuer_of(X509* certificate) {
    return name_text(X509_get_issuer_name(certificate));
}

std::string serial_of(X509* certificate) {
    BIGNUM* const number = ASN1_INTEGER_to_BN(X509_get0_serialNumber(certificate), nullptr);
    char* const digits = number == nullptr ? nullptr : BN_bn2dec(number);
    BN_free(number);
    std::string text = digits == nullptr ? std::string() : std::string(digits);
    OPENSSL_free(digits);
    return text;
}

std::vector<std::string> names_of(X509* certificate) {
    std::vector<std::string> names;
    const X509_NAME* subject = X509_get_subject_name(certificate);
    for (const int nid : {NID_commonName, NID_organizationName, NID_organizationalUnitName}) {
        for (int at = X509_NAME_get_index_by_NID(subject, nid, -1); at >= 0;
             at = X509_NAME_get_index_by_NID(subject, nid, at)) {
            unsigned char* utf8 = nullptr;
            const int size = ASN1_STRING_to_UTF8(&utf8, X509_NAME_ENTRY_get_data(X509_NAME_get_entry(subject, at)));
            if (size >= 0) {
                names.emplace_back(reinterpret_cast<const char*>(utf8), static_cast<std::size_t>(size));
                OPENSSL_free(utf8);
            }
        }
    }
    ERR_clear_error();
    return names;
}

std::string weakness_of_issue(X509* certificate) {
    // What a root says of itself proves nothing: it is trusted because it was put into the trust store. So the digest
    // with which it was signed does not matter.
    if (X509_NAME_cmp(X509_get_subject_name(certificate), X509_get_issuer_name(certificate)) == 0) {
        return {};
    }
    int digest = NID_undef;
    int security_bits = 0;
    const bool known = X509_get_signature_info(certificate, &digest, nullptr, &security_bits, nullptr) == 1;
    ERR_clear_error();
    constexpr int k_112_bits_of_security = 112;
    if (known && security_bits >= k_112_bits_of_security) {
        return {};
    }
    return OBJ_nid2ln(digest == NID_undef ? X509_get_signature_nid(certificate) : digest);
}

std::vector<Bytes> revocation_lists_from(const Bytes& file) {
    std::vector<Bytes> all;
    const auto add = [&](X509_CRL* list) {
        unsigned char* der = nullptr;
        const int size = i2d_X509_CRL(list, &der);
        if (size > 0) {
            all.emplace_back(reinterpret_cast<const char*>(der), static_cast<std::size_t>(size));
        }
        OPENSSL_free(der);
    };
    const Handle<BIO> in(BIO_new_mem_buf(file.data(), static_cast<int>(file.size())));
    while (const Handle<X509_CRL> list{PEM_read_bio_X509_CRL(in.get(), nullptr, nullptr, nullptr)}) {
        add(list.get());
    }
    if (all.empty()) {
        const auto* at = reinterpret_cast<const unsigned char*>(file.data());
        if (const Handle<X509_CRL> list{d2i_X509_CRL(nullptr, &at, static_cast<long>(file.size()))}) {
            add(list.get());
        }
    }
    ERR_clear_error();
    return all;
}

namespace {

std::vector<Handle<X509_CRL>> lists_of(const std::vector<Bytes>& ders) {
    std::vector<Handle<X509_CRL>> lists;
    for (const Bytes& der : ders) {
        const auto* at = reinterpret_cast<const unsigned char*>(der.data());
        Handle<X509_CRL> list(d2i_X509_CRL(nullptr, &at, static_cast<long>(der.size())));
        if (list != nullptr) {
            lists.push_back(std::move(list));
        }
    }
    return lists;
}

/// The one of some certificates that has issued a certificate, and has signed the list; null without one.
X509* issuer_of_list(X509_CRL* list, X509* certificate, const std::vector<X509*>& issuers) {
    if (X509_NAME_cmp(X509_CRL_get_issuer(list), X509_get_issuer_name(certificate)) != 0) {
        return nullptr;
    }
    // The name alone is not enough: anybody can write a list with this name.
    const auto found = std::find_if(issuers.begin(), issuers.end(), [&](X509* issuer) {
        return X509_check_issued(issuer, certificate) == X509_V_OK &&
               X509_CRL_verify(list, X509_get0_pubkey(issuer)) == 1;
    });
    return found == issuers.end() ? nullptr : *found;
}

struct ListPartsFree {
    void operator()(ISSUING_DIST_POINT* p) const { ISSUING_DIST_POINT_free(p); }
    void operator()(CRL_DIST_POINTS* p) const { CRL_DIST_POINTS_free(p); }
};

bool is_one_of(int nid, std::initializer_list<int> nids) {
    return std::find(nids.begin(), nids.end(), nid) != nids.end();
}

/// Whether an extension has to be understood, and is not.
bool is_unknown(X509_EXTENSION* extension, std::initializer_list<int> known) {
    return X509_EXTENSION_get_critical(extension) != 0 &&
           !is_one_of(OBJ_obj2nid(X509_EXTENSION_get_object(extension)), known);
}

bool has_unknown_extension(X509_CRL* list) {
    for (int i = 0; i < X509_CRL_get_ext_count(list); ++i) {
        if (is_unknown(X509_CRL_get_ext(list, i),
                       {NID_issuing_distribution_point, NID_delta_crl, NID_authority_key_identifier, NID_crl_number})) {
            return true;
        }
    }
    STACK_OF(X509_REVOKED)* const entries = X509_CRL_get_REVOKED(list);
    for (int i = 0; i < sk_X509_REVOKED_num(entries); ++i) {
        const X509_REVOKED* const entry = sk_X509_REVOKED_value(entries, i);
        for (int k = 0; k < X509_REVOKED_get_ext_count(entry); ++k) {
            if (is_unknown(X509_REVOKED_get_ext(entry, k),
                           {NID_crl_reason, NID_invalidity_date, NID_certificate_issuer})) {
                return true;
            }
        }
    }
    return false;
}

/// Whether both have a name in common; relative names are not compared.
bool share_a_name(const DIST_POINT_NAME* one, const DIST_POINT_NAME* other) {
    constexpr int k_full_name = 0;
    if (one == nullptr || other == nullptr || one->type != k_full_name || other->type != k_full_name) {
        return false;
    }
    for (int i = 0; i < sk_GENERAL_NAME_num(one->name.fullname); ++i) {
        for (int k = 0; k < sk_GENERAL_NAME_num(other->name.fullname); ++k) {
            if (GENERAL_NAME_cmp(sk_GENERAL_NAME_value(one->name.fullname, i),
                                 sk_GENERAL_NAME_value(other->name.fullname, k)) == 0) {
                return true;
            }
        }
    }
    return false;
}

/// Whether a certificate names, as the place of its list, the one of this list.
bool names_place(X509* certificate, const DIST_POINT_NAME* place) {
    const std::unique_ptr<CRL_DIST_POINTS, ListPartsFree> points(
        static_cast<CRL_DIST_POINTS*>(X509_get_ext_d2i(certificate, NID_crl_distribution_points, nullptr, nullptr)));
    for (int i = 0; i < sk_DIST_POINT_num(points.get()); ++i) {
        if (share_a_name(sk_DIST_POINT_value(points.get(), i)->distpoint, place)) {
            return true;
        }
    }
    return false;
}

/// Why a certificate that is not on a list of its issuer may be revoked all the same (RFC 5280, 5.2, 5.3 and 6.3.3); "" where
/// the list speaks of it.
std::string silence_of_list(X509_CRL* list, X509* certificate, X509* issuer, std::int64_t now) {
    const std::unique_ptr<ISSUING_DIST_POINT, ListPartsFree> scope(
        static_cast<ISSUING_DIST_POINT*>(X509_CRL_get_ext_d2i(list, NID_issuing_distribution_point, nullptr, nullptr)));
    const bool has_scope = X509_CRL_get_ext_by_NID(list, NID_issuing_distribution_point, -1) >= 0;
    const bool is_authority = X509_check_ca(certificate) != 0;
    const std::optional<std::int64_t> since = seconds_of(X509_CRL_get0_lastUpdate(list));
    constexpr std::int64_t k_between_clocks = 300;
    int digest = NID_undef;
    OBJ_find_sigid_algs(X509_CRL_get_signature_nid(list), &digest, nullptr);
    const auto applies = [](int flag) { return flag != 0; };  // of ASN.1: absent, true or false
    return X509_CRL_get_ext_by_NID(list, NID_delta_crl, -1) >= 0 ? "it has only what has changed since another list"
           : has_scope && scope == nullptr                       ? "what it is a list of cannot be read"
           : scope && applies(scope->onlyattr)                   ? "it is one of attribute certificates"
           : scope && applies(scope->onlyCA) && !is_authority    ? "it is one of the certificates of authorities"
           : scope && applies(scope->onlyuser) && is_authority   ? "it is one of certificates that are no authority's"
           : scope && scope->onlysomereasons != nullptr          ? "it has only what is revoked for some reasons"
           : scope && scope->distpoint != nullptr && !names_place(certificate, scope->distpoint)
               ? "it is a part of all lists, and the certificate does not name it"
           : has_unknown_extension(list)                     ? "it has a critical extension that is not known here"
           : !since || *since > now + k_between_clocks       ? "it is of a time that has not come"
           : is_one_of(digest, {NID_md5, NID_sha1})          ? "it is signed with " + std::string(OBJ_nid2ln(digest))
           : (X509_get_key_usage(issuer) & KU_CRL_SIGN) == 0 ? "its issuer may not sign such lists"
                                                             : "";
}

}  // namespace

std::vector<gum::Diagnostic> check_revocation(const std::string& where, const std::vector<CertificateHandle>& chain,
                                              const TrustedMaterial& trusted, std::int64_t now) {
    std::vector<gum::Diagnostic> found;
    std::vector<CertificateHandle> roots;
    std::vector<X509*> issuers;
    for (const Bytes& der : trusted.certificates) {
        if (CertificateHandle root = certificate_from_der(der); root != nullptr) {
            issuers.push_back(root.get());
            roots.push_back(std::move(root));
        }
    }
    for (const CertificateHandle& certificate : chain) {
        issuers.push_back(certificate.get());
    }
    // From the signer upwards; what else came with the signature has no say.
    std::vector<X509*> path = {chain.front().get()};
    for (bool longer = true; longer && path.size() <= issuers.size();) {
        const auto next = std::find_if(issuers.begin(), issuers.end(), [&](X509* issuer) {
            return X509_cmp(issuer, path.back()) != 0 && X509_check_issued(issuer, path.back()) == X509_V_OK;
        });
        longer = next != issuers.end();
        if (longer) {
            path.push_back(*next);
        }
    }
    bool signer_checked = false;
    std::vector<std::string> silent;  // why lists of the signer's issuer do not speak of the signer
    for (const Handle<X509_CRL>& list : lists_of(trusted.revocation_lists)) {
        X509* spoken_of = nullptr;  // a certificate of the path that the list is for
        for (X509* const certificate : path) {
            X509* const issuer = issuer_of_list(list.get(), certificate, issuers);
            if (issuer == nullptr) {
                continue;
            }
            const std::string subject = subject_of(certificate);
            if (certificate == path.front()) {
                const std::string silence = silence_of_list(list.get(), certificate, issuer, now);
                signer_checked = signer_checked || silence.empty();
                if (!silence.empty() && std::find(silent.begin(), silent.end(), silence) == silent.end()) {
                    silent.push_back(silence);
                }
            }
            spoken_of = certificate;
            X509_REVOKED* entry = nullptr;
            // The date of revocation is not compared with the time of signing. Whoever has the key can write any time
            // into a signature.
            if (X509_CRL_get0_by_cert(list.get(), &entry, certificate) == 1) {
                const std::optional<std::int64_t> since = seconds_of(X509_REVOKED_get0_revocationDate(entry));
                found.push_back({.code = "GC-SIGN-0137",
                                 .where = where,
                                 .what = "the certificate of " + subject + " is revoked" +
                                         (since ? " since " + time_text(*since) : ""),
                                 .rule =
                                     "a signature by a revoked certificate is not valid; the time that it claims is "
                                     "the signer's own statement",
                                 .action = "ask the laboratory for a document signed anew"});
            }
        }
        const std::optional<std::int64_t> next = seconds_of(X509_CRL_get0_nextUpdate(list.get()));
        // An old list proves that a certificate was revoked, but not that it is still in force.
        if (spoken_of != nullptr && (!next || *next < now)) {
            found.push_back({.code = "GC-SIGN-0138",
                             .where = where,
                             .what = "the list of revoked certificates of " + issuer_of(spoken_of) +
                                     (next ? " was to be replaced by " + time_text(*next) : " has no end"),
                             .rule = "a list of revoked certificates speaks for the time until the next one",
                             .action = "get the present list",
                             .severity = gum::Severity::warning});
        }
    }
    ERR_clear_error();
    if (signer_checked && found.empty()) {
        found.push_back({.code = "GC-SIGN-0139",
                         .where = where,
                         .what = "the certificate of " + subject_of(chain.front().get()) + " is not revoked",
                         .rule = "by the list of its issuer",
                         .action = "nothing",
                         .severity = gum::Severity::note});
    }
    const bool is_revoked = std::any_of(
        found.begin(), found.end(), [](const gum::Diagnostic& one) { return one.severity == gum::Severity::error; });
    for (const std::string& silence : signer_checked || is_revoked ? std::vector<std::string>() : silent) {
        found.push_back({.code = "GC-SIGN-0138",
                         .where = where,
                         .what = "the list of revoked certificates of " + issuer_of(chain.front().get()) +
                                 " does not say whether the signer's certificate is revoked: " + silence,
                         .rule = "a list speaks for the certificates and reasons that it is of (RFC 5280, 6.3.3)",
                         .action = "get the whole and present list of that issuer",
                         .severity = gum::Severity::warning});
    }
    if (!signer_checked && silent.empty() && !trusted.revocation_lists.empty()) {
        found.push_back({.code = "GC-SIGN-0138",
                         .where = where,
                         .what = "none of the lists of revoked certificates is of " + issuer_of(chain.front().get()),
                         .rule = "the issuer of a certificate says whether it is revoked",
                         .action = "get the list of that issuer",
                         .severity = gum::Severity::warning});
    }
    return found;
}

std::string kind_of_key(X509* certificate) {
    EVP_PKEY* key = X509_get0_pubkey(certificate);
    if (key == nullptr) {
        return {};
    }
    return EVP_PKEY_get_base_id(key) == EVP_PKEY_RSA ? "RSA" : EVP_PKEY_get_base_id(key) == EVP_PKEY_EC ? "ECDSA" : "";
}

std::string weakness_of_key(X509* certificate) {
    const std::string kind = kind_of_key(certificate);
    if (kind == "RSA") {
        const int bits = EVP_PKEY_get_bits(X509_get0_pubkey(certificate));
        return bits >= 2048 ? "" : "RSA key of " + std::to_string(bits) + " bits";
    }
    if (kind == "ECDSA") {
        return ecdsa_part_size(certificate) != 0 ? "" : "key on the curve " + curve_of(X509_get0_pubkey(certificate));
    }
    return "key that is neither RSA nor ECDSA";
}

std::string unfitness_for_documents(X509* certificate) {
    const std::uint32_t flags = X509_get_extension_flags(certificate);
    if ((flags & EXFLAG_INVALID) != 0) {
        return "its extensions cannot be read";
    }
    if (X509_check_ca(certificate) != 0) {
        return "it is that of an authority, which may issue certificates";
    }
    // A certificate without these extensions is not restricted by them, so a missing one is no reason to refuse.
    if ((flags & EXFLAG_KUSAGE) != 0 &&
        (X509_get_key_usage(certificate) & (KU_DIGITAL_SIGNATURE | KU_NON_REPUDIATION)) == 0) {
        return "its key usage has neither digitalSignature nor nonRepudiation";
    }
    if ((flags & EXFLAG_XKUSAGE) != 0 && !is_for_documents(extended_key_usages(certificate))) {
        return "its extended key usage is for something else, such as web servers or time stamps";
    }
    return {};
}

std::size_t ecdsa_part_size(X509* certificate) {
    EVP_PKEY* key = X509_get0_pubkey(certificate);
    if (key == nullptr || EVP_PKEY_get_base_id(key) != EVP_PKEY_EC) {
        return 0;
    }
    const std::string curve = curve_of(key);
    return curve == "prime256v1" || curve == "P-256"  ? 32
           : curve == "secp384r1" || curve == "P-384" ? 48
           : curve == "secp521r1" || curve == "P-521" ? 66
                                                      : 0;
}

bool verifies(X509* certificate, const char* digest_name, const Bytes& digest, const Bytes& signature) {
    EVP_PKEY* key = X509_get0_pubkey(certificate);
    if (key == nullptr) {
        return false;
    }
    const Handle<EVP_PKEY_CTX> context(EVP_PKEY_CTX_new_from_pkey(nullptr, key, nullptr));
    bool good = context != nullptr && EVP_PKEY_verify_init(context.get()) == 1;
    if (good && EVP_PKEY_get_base_id(key) == EVP_PKEY_RSA) {
        // Said and not left to the default of the library: a signature of another kind must not pass as this one.
        good = EVP_PKEY_CTX_set_rsa_padding(context.get(), RSA_PKCS1_PADDING) == 1;
    }
    good = good && EVP_PKEY_CTX_set_signature_md(context.get(), EVP_get_digestbyname(digest_name)) == 1 &&
           EVP_PKEY_verify(context.get(), reinterpret_cast<const unsigned char*>(signature.data()), signature.size(),
                           reinterpret_cast<const unsigned char*>(digest.data()), digest.size()) == 1;
    ERR_clear_error();
    return good;
}

std::optional<std::int64_t> end_of_validity(X509* certificate) {
    return seconds_of(X509_get0_notAfter(certificate));
}
std::optional<std::int64_t> start_of_validity(X509* certificate) {
    return seconds_of(X509_get0_notBefore(certificate));
}

std::vector<gum::Diagnostic> check_chain(const std::string& where, const std::vector<CertificateHandle>& chain,
                                         const std::vector<Bytes>& trusted, std::int64_t time) {
    std::vector<gum::Diagnostic> findings;
    X509* const signer = chain.front().get();
    if (const std::string weakness = weakness_of_key(signer); !weakness.empty()) {
        findings.push_back(
            finding("GC-SIGN-0131", where, weakness,
                    "signatures are made with RSA of 2048 bits or more, or ECDSA with P-256, P-384 or P-521",
                    "ask the laboratory for a document signed with such a key"));
    }
    if (const std::string unfitness = unfitness_for_documents(signer); !unfitness.empty()) {
        findings.push_back(
            finding("GC-SIGN-0132", where,
                    "the certificate of " + subject_of(signer) + " is not for signing documents: " + unfitness,
                    "documents are signed with the certificate of a person or a laboratory, made for that",
                    "ask the laboratory which certificate is meant"));
    }

    const Handle<X509_STORE> store(X509_STORE_new());
    for (const Bytes& der : trusted) {
        if (const CertificateHandle root = certificate_from_der(der); root != nullptr) {
            X509_STORE_add_cert(store.get(), root.get());
        }
    }
    const Handle<STACK_OF(X509)> others(sk_X509_new_null());
    for (const CertificateHandle& certificate : chain) {
        sk_X509_push(others.get(), certificate.get());
    }
    const Handle<X509_STORE_CTX> context(X509_STORE_CTX_new());
    X509_STORE_CTX_init(context.get(), store.get(), signer, others.get());
    X509_VERIFY_PARAM* rules = X509_STORE_CTX_get0_param(context.get());
    X509_VERIFY_PARAM_set_time(rules, static_cast<std::time_t>(time));
    // Whoever puts an intermediate authority, or the signer's own certificate, into the trust store trusts that and not
    // the root above it. Without this flag the path would have to go on to a root.
    X509_VERIFY_PARAM_set_flags(rules, X509_V_FLAG_PARTIAL_CHAIN);
    // Level 2 of OpenSSL: it refuses keys of RSA below 2048 bits, and certificates issued with SHA-1 or MD5.
    constexpr int k_112_bits_of_security = 2;
    X509_VERIFY_PARAM_set_auth_level(rules, k_112_bits_of_security);
    const int answer = X509_verify_cert(context.get());
    ERR_clear_error();
    if (answer != 1) {
        const int reason = X509_STORE_CTX_get_error(context.get());
        X509* at = X509_STORE_CTX_get_current_cert(context.get());
        const bool out_of_time = reason == X509_V_ERR_CERT_HAS_EXPIRED || reason == X509_V_ERR_CERT_NOT_YET_VALID;
        findings.push_back(finding(out_of_time ? "GC-SIGN-0133" : "GC-SIGN-0130", where,
                                   "the certificate of " + subject_of(at != nullptr ? at : signer) +
                                       " is not accepted at " + time_text(time) + ": " +
                                       X509_verify_cert_error_string(reason),
                                   "the signer's certificate leads to one of the trust store, and all were in force at "
                                   "the time of signing",
                                   "if you trust the issuer, put its root certificate into the trust store"));
    }
    return findings;
}

}  // namespace gumcert::signing
