#include <openssl/cms.h>
#include <openssl/err.h>
#include <openssl/ess.h>
#include <openssl/objects.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "signing/certificates.h"
#include "signing/cms_parts.h"
#include "signing/document_limits.h"
#include "signing/document_verification.h"
#include "signing/qpdf_objects.h"
#include "signing/time_texts.h"
#include "text/counts.h"
#include "text/small_letters.h"

namespace gumcert::signing {

namespace {

using Object = QPDFObjectHandle;

/// Takes a stream up to a limit, and stops what unpacks it there: a small file can unpack to any size.
class LimitedText : public Pipeline {
public:
    explicit LimitedText(std::size_t most) : Pipeline("attachment", nullptr), most_(most) {}
    void write(unsigned char const* data, std::size_t size) override {
        too_large_ = too_large_ || size > most_ - text_.size();
        if (too_large_) {
            throw std::length_error("attachment");
        }
        text_.append(reinterpret_cast<const char*>(data), size);
    }
    void finish() override {}
    [[nodiscard]] bool too_large() const { return too_large_; }
    [[nodiscard]] Bytes& text() { return text_; }

private:
    std::size_t most_;
    Bytes text_;
    bool too_large_ = false;
};

struct EssFree {
    void operator()(ESS_SIGNING_CERT_V2* p) const { ESS_SIGNING_CERT_V2_free(p); }
};
struct StackFree {
    void operator()(STACK_OF(X509) * p) const { sk_X509_pop_free(p, X509_free); }
};
using OwnedCertificates = std::unique_ptr<STACK_OF(X509), StackFree>;

/// The positions of a ByteRange: what is before the gap, and what is behind it.
struct Range {
    std::size_t gap_at = 0;
    std::size_t gap_end = 0;
    std::size_t end = 0;
};

/// A PDF may write them with capital letters, too.
std::optional<Bytes> bytes_from_pdf_hexadecimal(std::string_view text) {
    return encoding::bytes_from_hexadecimal(text::in_small_letters(text));
}

bool is_accepted_digest(int nid) {
    return nid == NID_sha256 || nid == NID_sha384 || nid == NID_sha512;
}

std::string digest_text(int nid) {
    return nid == NID_sha256   ? "SHA-256"
           : nid == NID_sha384 ? "SHA-384"
           : nid == NID_sha512 ? "SHA-512"
                               : OBJ_nid2sn(nid);
}

class PdfSignatureCheck {
public:
    PdfSignatureCheck(std::string_view file, Object signature, std::string where)
        : file_(file), signature_(std::move(signature)), where_(std::move(where)) {}

    SignatureReport run(const TrustedMaterial& trusted, std::int64_t now) {
        Object filter = signature_.getKey("/SubFilter");
        const std::string name = filter.isName() ? filter.getName().substr(1) : std::string();
        const bool pades = name == "ETSI.CAdES.detached";
        report_.format = pades ? "PAdES-BASELINE-B" : name;
        if (!pades && name != "adbe.pkcs7.detached") {
            error("GC-SIGN-0140", "a signature of the kind \"" + name + '"',
                  "checked are ETSI.CAdES.detached and adbe.pkcs7.detached", "check it with another program");
        } else if (const std::optional<Range> range = byte_range(); range) {
            check_cms(*range, pades, trusted, now);
        }
        conclude(report_);
        if (!report_.valid) {
            report_.covers.clear();
            report_.not_covered.emplace_back("nothing can be relied on");
        }
        return std::move(report_);
    }

private:
    void error(const char* code, const std::string& what, const char* rule, const char* action = k_ask_again) {
        add_error(report_, code, where_, what, rule, action);
    }

    /// What is signed must be the whole file but for the digits of /Contents.
    std::optional<Range> byte_range() {
        Object array = signature_.getKey("/ByteRange");
        std::array<long long, 4> n{};
        bool good = array.isArray() && array.getArrayNItems() == 4;
        for (int i = 0; good && i < 4; ++i) {
            Object item = array.getArrayItem(i);
            good = item.isInteger();
            n[static_cast<std::size_t>(i)] = good ? item.getIntValue() : 0;
        }
        const auto size = static_cast<long long>(file_.size());
        // Each number is compared before it is reckoned with: they are of the file, and may be the largest there are.
        good = good && n[0] == 0 && n[1] > 0 && n[2] > 1 && n[2] <= size && n[1] < n[2] - 1 && n[3] >= 0 &&
               n[3] <= size - n[2];
        if (!good) {
            error("GC-SIGN-0141", "its ByteRange is no range of this file",
                  "the ranges are the file before and behind the digits of the signature");
            return std::nullopt;
        }
        const Range range{.gap_at = static_cast<std::size_t>(n[1]),
                          .gap_end = static_cast<std::size_t>(n[2]),
                          .end = static_cast<std::size_t>(n[2] + n[3])};
        const std::string_view gap = file_.substr(range.gap_at, range.gap_end - range.gap_at);
        Object contents = signature_.getKey("/Contents");
        std::optional<Bytes> value;
        if (gap.front() == '<' && gap.back() == '>') {
            value = bytes_from_pdf_hexadecimal(gap.substr(1, gap.size() - 2));
        }
        // The range says which bytes are not signed, /Contents says which value is checked. Where they are two
        // different places, one value is checked while something else lies in the bytes that nobody signed.
        if (!value || !contents.isString() || contents.getStringValue() != *value) {
            error("GC-SIGN-0141", "the gap of its ByteRange holds something else than the signature",
                  "nothing can be hidden in what is not signed");
            return std::nullopt;
        }
        cms_bytes_ = *value;
        report_.covers.push_back("the whole file without the digits of this signature: " +
                                 std::to_string(range.gap_at + range.end - range.gap_end) + " of " +
                                 std::to_string(file_.size()) + " bytes");
        // A PDF is changed by adding to its end: a later object takes the place of an earlier one of the same number.
        // The signed bytes stay as they are, and the page shows other values.
        if (range.end != file_.size()) {
            report_.not_covered.push_back(std::to_string(file_.size() - range.end) + " bytes behind what was signed");
            error("GC-SIGN-0142",
                  std::to_string(file_.size() - range.end) + " bytes were added to the file after this signature",
                  "the signature covers the whole file; what came later may change what is shown");
        }
        return range;
    }

    void check_cms(const Range& range, bool pades, const TrustedMaterial& trusted, std::int64_t now) {
        const auto* at = reinterpret_cast<const unsigned char*>(cms_bytes_.data());
        const Handle<CMS_ContentInfo> cms(d2i_CMS_ContentInfo(nullptr, &at, static_cast<long>(cms_bytes_.size())));
        ERR_clear_error();
        const auto* const end = reinterpret_cast<const unsigned char*>(cms_bytes_.data()) + cms_bytes_.size();
        // The room for the value is made before its length is known, so zeros follow. Anything else behind it is not
        // covered by the signature.
        const bool filled = std::all_of(at, end, [](unsigned char c) { return c == 0; });
        if (!filled || cms == nullptr || OBJ_obj2nid(CMS_get0_type(cms.get())) != NID_pkcs7_signed ||
            CMS_is_detached(cms.get()) != 1) {
            error("GC-SIGN-0143", "its content is no detached CMS signature", "/Contents is CMS (RFC 5652) in DER");
            return;
        }
        STACK_OF(CMS_SignerInfo)* signers = CMS_get0_SignerInfos(cms.get());
        // With two signers the check could pass for the one and the report name the other.
        if (sk_CMS_SignerInfo_num(signers) != 1) {
            error("GC-SIGN-0143", "not exactly one signer", "a PDF signature has one signer");
            return;
        }
        CMS_SignerInfo* info = sk_CMS_SignerInfo_value(signers, 0);
        // Looks the signer's certificate up among those of the CMS, nowhere else.
        const OwnedCertificates certificates(CMS_get1_certs(cms.get()));
        X509* signer = nullptr;
        for (int i = 0; i < sk_X509_num(certificates.get()); ++i) {
            X509* one = sk_X509_value(certificates.get(), i);
            if (signer == nullptr && CMS_SignerInfo_cert_cmp(info, one) == 0) {
                signer = one;
            }
        }
        if (signer == nullptr) {
            error("GC-SIGN-0115", "no certificate of the signer in it",
                  "the signature brings the signer's certificate");
            return;
        }
        // The value is verified with this certificate and no other: two may have the same issuer and serial number.
        CMS_SignerInfo_set1_signer_cert(info, signer);
        std::vector<CertificateHandle> chain;
        X509_up_ref(signer);
        chain.emplace_back(signer);
        for (int i = 0; i < sk_X509_num(certificates.get()); ++i) {
            X509* one = sk_X509_value(certificates.get(), i);
            if (one != signer) {
                X509_up_ref(one);
                chain.emplace_back(one);
            }
        }
        if (chain.size() > k_most_certificates) {
            error("GC-SIGN-0124", text::count_of(chain.size(), "certificate"), k_chain_alone);
            chain.resize(1);
        }
        check_parts(cms.get(), {chain, trusted.certificates});
        check_algorithms(info);
        check_attributes(info, pades, signer, certificates.get());
        // Where the shape is not right, a value that fits would say nothing. Bytes added later are the one exception:
        // it helps to know that the earlier state of the file was signed.
        if (report_.findings.empty() || only_later_bytes()) {
            check_value(cms.get(), range);
        }
        check_times(info, pades);
        check_signer(report_, where_, chain, trusted, claimed_time(info), now);
    }

    /// The gap is not signed, and the CMS in it covers its signed attributes alone.
    void check_parts(CMS_ContentInfo* cms, const SignerChain& chain) {
        const CmsParts parts = cms_parts(cms, chain);
        if (!parts.foreign.empty()) {
            error("GC-SIGN-0148", parts.foreign + " within the signature is not covered by it",
                  "a signature holds nothing but its own parts, time stamps and revocation values");
        }
        for (const std::string& part : parts.brought) {
            report_.not_covered.push_back("unsigned within the signature: " + part);
        }
    }

    /// Two times of one signature: that of the signed attributes, and /M of the signature dictionary.
    void check_times(CMS_SignerInfo* info, bool pades) {
        const std::string attribute = time_of_attributes(info);
        if (attribute.empty()) {
            return;
        }
        if (pades) {
            report_.format = "PAdES";  // ETSI EN 319 142-1 has the time in /M alone, at its baseline levels
        }
        const std::optional<std::int64_t> signed_at = time_from_text(attribute);
        const std::optional<std::int64_t> in_dictionary = time_from_text(time_of_dictionary());
        constexpr std::int64_t k_same_time = 300;  // seconds between the two clock readings of one program
        if (signed_at && in_dictionary && std::abs(*signed_at - *in_dictionary) > k_same_time) {
            add_warning(report_, "GC-SIGN-0147", where_,
                        "it says that it was made at " + time_text(*signed_at) + ", and at " +
                            time_text(*in_dictionary) + " in its dictionary (/M)",
                        "a signature is made at one time", "ask the laboratory which is right");
        }
    }

    [[nodiscard]] bool only_later_bytes() const {
        return report_.findings.size() == 1 && report_.findings[0].code == "GC-SIGN-0142";
    }

    void check_algorithms(CMS_SignerInfo* info) {
        X509_ALGOR* digest_algorithm = nullptr;
        X509_ALGOR* signature_algorithm = nullptr;
        CMS_SignerInfo_get0_algs(info, nullptr, nullptr, &digest_algorithm, &signature_algorithm);
        const ASN1_OBJECT* digest_object = nullptr;
        const ASN1_OBJECT* signature_object = nullptr;
        X509_ALGOR_get0(&digest_object, nullptr, nullptr, digest_algorithm);
        X509_ALGOR_get0(&signature_object, nullptr, nullptr, signature_algorithm);
        const int digest_nid = OBJ_obj2nid(digest_object);
        const int signature_nid = OBJ_obj2nid(signature_object);
        int within_digest = NID_undef;
        int key = NID_undef;
        const bool rsa_alone = signature_nid == NID_rsaEncryption;
        // Some programs write rsaEncryption, which names no digest; others name the digest twice, and then both must be
        // the same.
        const bool known = rsa_alone || OBJ_find_sigid_algs(signature_nid, &within_digest, &key) == 1;
        const bool rsa = rsa_alone || key == NID_rsaEncryption;
        const bool ecdsa = key == NID_X9_62_id_ecPublicKey;
        report_.algorithm = std::string(rsa     ? "RSA"
                                        : ecdsa ? "ECDSA"
                                                : OBJ_nid2sn(signature_nid)) +
                            " with " + digest_text(digest_nid);
        if (!known || !(rsa || ecdsa) || !is_accepted_digest(digest_nid) ||
            (!rsa_alone && within_digest != digest_nid)) {
            error("GC-SIGN-0111", "signature method " + report_.algorithm,
                  "accepted are RSA (PKCS #1 v1.5) and ECDSA with SHA-256, SHA-384 or SHA-512");
        }
    }

    void check_attributes(CMS_SignerInfo* info, bool pades, X509* signer, STACK_OF(X509) * others) {
        const auto* type = static_cast<const ASN1_OBJECT*>(
            CMS_signed_get0_data_by_OBJ(info, OBJ_nid2obj(NID_pkcs9_contentType), -3, V_ASN1_OBJECT));
        if (type == nullptr || OBJ_obj2nid(type) != NID_pkcs7_data) {
            error("GC-SIGN-0144", "the signed attributes do not say that data were signed",
                  "content-type and message-digest are signed (RFC 5652, 11)");
        }
        if (!pades) {
            return;
        }
        const auto* encoded = static_cast<const ASN1_STRING*>(
            CMS_signed_get0_data_by_OBJ(info, OBJ_nid2obj(NID_id_smime_aa_signingCertificateV2), -3, V_ASN1_SEQUENCE));
        std::unique_ptr<ESS_SIGNING_CERT_V2, EssFree> named;
        if (encoded != nullptr) {
            const unsigned char* at = ASN1_STRING_get0_data(encoded);
            named.reset(d2i_ESS_SIGNING_CERT_V2(nullptr, &at, ASN1_STRING_length(encoded)));
        }
        const Handle<STACK_OF(X509)> chain(sk_X509_new_null());
        sk_X509_push(chain.get(), signer);
        for (int i = 0; i < sk_X509_num(others); ++i) {
            if (sk_X509_value(others, i) != signer) {
                sk_X509_push(chain.get(), sk_X509_value(others, i));
            }
        }
        if (named == nullptr || OSSL_ESS_check_signing_certs(nullptr, named.get(), chain.get(), 1) <= 0) {
            error("GC-SIGN-0116", "the certificate is not the one that the signed attributes name",
                  "a PAdES signature states the digest of the signer's certificate (signing-certificate-v2)");
        }
        ERR_clear_error();
    }

    void check_value(CMS_ContentInfo* cms, const Range& range) {
        const Bytes data =
            Bytes(file_.substr(0, range.gap_at)) + Bytes(file_.substr(range.gap_end, range.end - range.gap_end));
        const Handle<BIO> in(BIO_new_mem_buf(data.data(), static_cast<int>(data.size())));
        const int done = CMS_verify(cms, nullptr, nullptr, in.get(), nullptr, CMS_BINARY | CMS_NO_SIGNER_CERT_VERIFY);
        const unsigned long reason = ERR_peek_error();
        ERR_clear_error();
        if (done != 1) {
            const bool changed =
                ERR_GET_LIB(reason) == ERR_LIB_CMS && ERR_GET_REASON(reason) == CMS_R_VERIFICATION_FAILURE;
            error(changed ? "GC-SIGN-0117" : "GC-SIGN-0118",
                  changed ? "the file was changed after signing, or the value of the signature does not fit"
                          : "the value of the signature does not fit the certificate",
                  "what was signed is unchanged");
        }
    }

    /// The time of the signed attributes, or that of the signature dictionary, which is within the signed bytes.
    std::string claimed_time(CMS_SignerInfo* info) {
        const std::string attribute = time_of_attributes(info);
        return attribute.empty() ? time_of_dictionary() : attribute;
    }

    std::string time_of_dictionary() {
        Object time = signature_.getKey("/M");
        return time.isString() ? time.getStringValue() : std::string();
    }

    static std::string time_of_attributes(CMS_SignerInfo* info) {
        const int at = CMS_signed_get_attr_by_NID(info, NID_pkcs9_signingTime, -1);
        const X509_ATTRIBUTE* attribute = at < 0 ? nullptr : CMS_signed_get_attr(info, at);
        const ASN1_TYPE* value =
            attribute == nullptr ? nullptr : X509_ATTRIBUTE_get0_type(const_cast<X509_ATTRIBUTE*>(attribute), 0);
        if (value != nullptr && (value->type == V_ASN1_UTCTIME || value->type == V_ASN1_GENERALIZEDTIME)) {
            std::tm parts{};
            if (ASN1_TIME_to_tm(value->value.asn1_string, &parts) == 1) {
                const auto two = [](int number) { return (number < 10 ? "0" : "") + std::to_string(number); };
                return std::to_string(parts.tm_year + 1900) + two(parts.tm_mon + 1) + two(parts.tm_mday) +
                       two(parts.tm_hour) + two(parts.tm_min) + two(parts.tm_sec);
            }
        }
        return {};
    }

    std::string_view file_;
    Object signature_;
    std::string where_;
    SignatureReport report_;
    Bytes cms_bytes_;
};

/// Dictionaries with a ByteRange, wherever they are.
std::vector<Object> signatures_of(QPDF& pdf) {
    std::vector<Object> found;
    // Not the fields of the form alone: a signature that no field names would not be checked, but some readers would
    // show it.
    for (Object object : pdf.getAllObjects()) {
        if (!object.isDictionary()) {
            continue;
        }
        if (object.hasKey("/ByteRange")) {
            found.push_back(object);
        }
        Object value = object.getKey("/V");
        if (!value.isIndirect() && value.isDictionary() && value.hasKey("/ByteRange")) {
            found.push_back(value);
        }
    }
    return found;
}

Object entry(Object dictionary, const char* key) {
    return dictionary.isDictionary() ? dictionary.getKey(key) : Object::newNull();
}

/// The contents of attached files, or what stands in their place; at most one more than are looked at. (The helper of
/// qpdf for attachments prints where a file is damaged.)
std::vector<Object> attached_streams(QPDF& pdf) {
    std::vector<Object> streams;
    Object names = entry(entry(pdf.getRoot(), "/Names"), "/EmbeddedFiles");
    if (!names.isDictionary()) {
        return streams;
    }
    constexpr bool k_without_repair = false;
    QPDFNameTreeObjectHelper tree(names, pdf, k_without_repair);
    for (const auto& [name, specification] : tree) {
        Object of_file = entry(specification, "/EF");
        Object stream = entry(of_file, "/UF");
        streams.push_back(stream.isStream() ? stream : entry(of_file, "/F"));
        if (streams.size() > k_most_signatures) {
            break;
        }
    }
    return streams;
}

/// What is packed twice can unpack to nothing, and take any time for it.
int number_of_filters(Object& stream) {
    Object filters = stream.getDict().getKey("/Filter");
    return filters.isArray() ? filters.getArrayNItems() : filters.isName() ? 1 : 0;
}

std::vector<SignatureReport> attachment_reports(QPDF& pdf, const std::string& name, const TrustedMaterial& trusted,
                                                std::int64_t now, std::vector<Bytes>& documents) {
    std::vector<SignatureReport> reports;
    const std::vector<Object> files = attached_streams(pdf);
    if (files.size() > k_most_signatures) {
        SignatureReport report;
        add_error(report, "GC-SIGN-0145", name,
                  "more than " + std::to_string(k_most_signatures) + " files are attached",
                  "a certificate has one attachment or a few", k_ask_again);
        reports.push_back(std::move(report));
        return reports;
    }
    // One limit for all of them: a limit for each would be multiplied by their number.
    std::size_t left = k_largest_attachments;
    for (Object stream : files) {
        if (!stream.isStream()) {
            continue;
        }
        const std::string where = name + ", attachment";
        LimitedText content(left);
        const bool is_packed_twice = number_of_filters(stream) > 1;
        if (!is_packed_twice) {
            stream.pipeStreamData(&content, 0, qpdf_dl_all, true);
        }
        left -= content.text().size();
        const bool xml = content.text().substr(0, 100).find('<') != Bytes::npos;
        if (is_packed_twice || content.too_large()) {
            SignatureReport report;
            add_error(report, "GC-SIGN-0145", where,
                      is_packed_twice ? "packed more than once" : "larger than 64 MiB with those before it",
                      "attachments are packed at most once, and read up to 64 MiB together", k_ask_again);
            reports.push_back(std::move(report));
        } else if (xml) {
            documents.push_back(std::move(content.text()));
            try {
                for (SignatureReport& report : verify_xml(documents.back(), where, trusted, now)) {
                    reports.push_back(std::move(report));
                }
            } catch (const gum::InputError& refused) {
                SignatureReport report;
                report.findings = refused.diagnostics();
                reports.push_back(std::move(report));
            }
        }
    }
    return reports;
}

}  // namespace

Verification verify_pdf(const Bytes& pdf, const std::string& name, const TrustedMaterial& trusted, std::int64_t now) {
    Verification verification;
    QPDF document;
    document.setSuppressWarnings(true);
    // A damaged file can be repaired in more than one way. What is checked here must be what another program shows.
    document.setAttemptRecovery(false);
    try {
        document.processMemoryFile("PDF", pdf.data(), pdf.size());
        if (document.isEncrypted()) {
            throw std::runtime_error("it is encrypted");
        }
        std::vector<Object> signatures = signatures_of(document);
        // One that is not valid is enough for the answer.
        signatures.resize(std::min(signatures.size(), k_most_signatures));
        for (const Object& signature : signatures) {
            const std::string where = name + ", signature " + std::to_string(verification.signatures.size() + 1);
            verification.signatures.push_back(PdfSignatureCheck(pdf, signature, where).run(trusted, now));
        }
        verification.attachment_signatures = attachment_reports(document, name, trusted, now, verification.attachments);
        if (Object keywords = entry(document.getTrailer().getKey("/Info"), "/Keywords"); keywords.isString()) {
            verification.pdf_keywords = keywords.getUTF8Value();
        }
        require_whole_memory(document);
    } catch (const gum::DiagnosedError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;  // says nothing about the PDF
    } catch (const std::exception& failure) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-SIGN-0052",
                            .where = name,
                            .what = shown_text(std::string("the PDF cannot be read: ") + failure.what()),
                            .rule = "signatures are checked in sound PDF files",
                            .action = k_ask_again});
    }
    return verification;
}

}  // namespace gumcert::signing
