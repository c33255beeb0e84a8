#include "signing/cms_parts.h"

#include <openssl/asn1.h>
#include <openssl/err.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace gumcert::signing {

namespace {

using namespace std::string_view_literals;

/// A value of DER.
struct DerPart {
    unsigned tag = 0;  ///< its first byte: class, form and number
    std::string_view content, whole;
};
constexpr unsigned k_integer = 0x02;
constexpr unsigned k_octets = 0x04;
constexpr unsigned k_sequence = 0x30;
constexpr unsigned k_set = 0x31;
constexpr unsigned k_tagged_0 = 0xA0;
constexpr unsigned k_tagged_1 = 0xA1;
constexpr unsigned k_key_identifier = 0x80;  // of a SignerIdentifier

/// The values that stand one behind the other. What is no DER ends the list with a part that has no tag.
std::vector<DerPart> parts_of(std::string_view bytes) {
    std::vector<DerPart> parts;
    while (!bytes.empty()) {
        const auto* const begin = reinterpret_cast<const unsigned char*>(bytes.data());
        const unsigned char* at = begin;
        long length = 0;
        int tag = 0;
        int type = 0;
        const int answer = ASN1_get_object(&at, &length, &tag, &type, static_cast<long>(bytes.size()));
        constexpr int k_failed = 0x80;
        constexpr int k_indefinite = 0x01;
        if ((answer & (k_failed | k_indefinite)) != 0) {
            ERR_clear_error();
            parts.emplace_back();
            break;
        }
        const auto header = static_cast<std::size_t>(at - begin);
        const std::size_t size = header + static_cast<std::size_t>(length);
        parts.push_back({begin[0], bytes.substr(header, size - header), bytes.substr(0, size)});
        bytes.remove_prefix(size);
    }
    return parts;
}

// Object identifiers in DER.
constexpr std::string_view k_data = "\x06\x09\x2A\x86\x48\x86\xF7\x0D\x01\x07\x01"sv;
constexpr std::array<std::string_view, 3> k_digest_algorithms = {"\x06\x09\x60\x86\x48\x01\x65\x03\x04\x02\x01"sv,
                                                                 "\x06\x09\x60\x86\x48\x01\x65\x03\x04\x02\x02"sv,
                                                                 "\x06\x09\x60\x86\x48\x01\x65\x03\x04\x02\x03"sv};
constexpr std::string_view k_revocation_answer = "\x06\x08\x2B\x06\x01\x05\x05\x07\x10\x02"sv;  // id-ri-ocsp-response
constexpr std::string_view k_signature_time_stamp = "\x06\x0B\x2A\x86\x48\x86\xF7\x0D\x01\x09\x10\x02\x0E"sv;
constexpr std::string_view k_revocation_values = "\x06\x0B\x2A\x86\x48\x86\xF7\x0D\x01\x09\x10\x02\x18"sv;

/// An algorithm without parameters, or with NULL for them.
bool is_algorithm_alone(const DerPart& algorithm) {
    const std::vector<DerPart> parts = parts_of(algorithm.content);
    return algorithm.tag == k_sequence && (parts.size() == 1 || (parts.size() == 2 && parts[1].whole == "\x05\x00"sv));
}

bool is_digest_algorithm(const DerPart& algorithm) {
    return is_algorithm_alone(algorithm) &&
           std::find(k_digest_algorithms.begin(), k_digest_algorithms.end(),
                     parts_of(algorithm.content).front().whole) != k_digest_algorithms.end();
}

/// The parts of a SignedData, in their order.
class CmsReader {
public:
    explicit CmsReader(const SignerChain& chain) : chain_(chain) {}

    CmsParts read(std::string_view der) {
        const std::vector<DerPart> frame = parts_of(der);
        const std::vector<DerPart> info = frame.size() == 1 ? parts_of(frame[0].content) : frame;
        const std::vector<DerPart> wrapped = info.size() == 2 ? parts_of(info[1].content) : info;
        const std::vector<DerPart> parts = wrapped.size() == 1 ? parts_of(wrapped[0].content) : wrapped;
        auto at = parts.begin();
        const auto next = [&](unsigned tag) {
            const bool is_there = at != parts.end() && at->tag == tag;
            return is_there ? *at++ : DerPart();
        };
        require(is_version(next(k_integer)), "a version of its own");
        const std::vector<DerPart> digests = parts_of(next(k_set).content);
        require(digests.size() <= k_digest_algorithms.size() &&
                    std::all_of(digests.begin(), digests.end(), is_digest_algorithm),
                "a digest algorithm other than SHA-256, SHA-384 and SHA-512");
        require(next(k_sequence).content == k_data, "another content than data");
        for (const DerPart& certificate : parts_of(next(k_tagged_0).content)) {
            require(certificate.tag == k_sequence, "a certificate of another kind than X.509");
        }
        for (const DerPart& list : parts_of(next(k_tagged_1).content)) {
            read_revocation(list);
        }
        const std::vector<DerPart> signers = parts_of(next(k_set).content);
        require(signers.size() == 1 && at == parts.end(), "parts of an unknown kind");
        if (found_.foreign.empty()) {
            read_signer(signers.front());
        }
        return std::move(found_);
    }

private:
    void require(bool good, const char* what) {
        if (!good && found_.foreign.empty()) {
            found_.foreign = what;
        }
    }

    void bring(const char* what) {
        if (std::find(found_.brought.begin(), found_.brought.end(), what) == found_.brought.end()) {
            found_.brought.emplace_back(what);
        }
    }

    static bool is_version(const DerPart& version) { return version.tag == k_integer && version.content.size() == 1; }

    /// RevocationInfoChoice (RFC 5652, 10.2.1; RFC 5940, 2.1).
    void read_revocation(const DerPart& list) {
        bool good = false;
        if (list.tag == k_sequence) {
            good = is_revocation_list_of(Bytes(list.whole), chain_.issuers());
        } else if (const std::vector<DerPart> other = parts_of(list.content);
                   list.tag == k_tagged_1 && other.size() == 2 && other[0].whole == k_revocation_answer) {
            good = is_revocation_answer_of(Bytes(other[1].whole), chain_.issuers());
        }
        require(good, "a list of revoked certificates that no issuer of the signer has signed");
        bring("lists of revoked certificates");
    }

    void read_signer(const DerPart& signer) {
        const std::vector<DerPart> parts = parts_of(signer.content);
        auto at = parts.begin();
        const auto next = [&](unsigned tag) {
            const bool is_there = at != parts.end() && at->tag == tag;
            return is_there ? *at++ : DerPart();
        };
        require(is_version(next(k_integer)), "a version of its own");
        // Which certificate it names has been looked up.
        require(next(k_sequence).tag == k_sequence || next(k_key_identifier).tag == k_key_identifier,
                "a signer who is not named");
        require(is_digest_algorithm(next(k_sequence)), "parameters of a digest algorithm");
        (void)next(k_tagged_0);  // signed attributes
        require(is_algorithm_alone(next(k_sequence)), "parameters of a signature algorithm");
        require(next(k_octets).tag == k_octets, "no value");
        for (const DerPart& attribute : parts_of(next(k_tagged_1).content)) {
            read_unsigned_attribute(attribute);
        }
        require(at == parts.end(), "parts of an unknown kind");
    }

    void read_unsigned_attribute(const DerPart& attribute) {
        const std::vector<DerPart> parts = parts_of(attribute.content);
        const bool has_form = attribute.tag == k_sequence && parts.size() == 2 && parts[1].tag == k_set;
        const std::string_view kind = has_form ? parts[0].whole : std::string_view();
        const std::vector<DerPart> values = has_form ? parts_of(parts[1].content) : std::vector<DerPart>();
        if (kind == k_signature_time_stamp) {
            require(!values.empty() && std::all_of(values.begin(), values.end(),
                                                   [](const DerPart& one) { return is_time_stamp(Bytes(one.whole)); }),
                    "a time stamp that is none");
            bring("signature-time-stamp");
        } else if (kind == k_revocation_values) {
            for (const DerPart& value : values) {
                read_revocation_values(value);
            }
            bring("revocation-values");
        } else {
            require(false, "an unsigned attribute of another kind than time stamps and revocation values");
        }
    }

    /// RevocationValues (RFC 5126, 6.3.4): lists under [0], answers under [1].
    void read_revocation_values(const DerPart& values) {
        for (const DerPart& group : parts_of(values.content)) {
            const std::vector<DerPart> lists = parts_of(group.content);
            require(
                (group.tag == k_tagged_0 || group.tag == k_tagged_1) && lists.size() == 1 && lists[0].tag == k_sequence,
                "revocation values of another kind");
            for (const DerPart& one : lists.empty() ? lists : parts_of(lists[0].content)) {
                require(group.tag == k_tagged_0 ? is_revocation_list_of(Bytes(one.whole), chain_.issuers())
                                                : is_basic_revocation_answer_of(Bytes(one.whole), chain_.issuers()),
                        "revocation values that no issuer of the signer has signed");
            }
        }
        require(values.tag == k_sequence, "revocation values of another kind");
    }

    const SignerChain& chain_;
    CmsParts found_;
};

}  // namespace

CmsParts cms_parts(CMS_ContentInfo* cms, const SignerChain& chain) {
    // Encoded again: programs write CMS with lengths that are not stated, and nothing of what is read is lost by it.
    unsigned char* der = nullptr;
    const int size = i2d_CMS_ContentInfo(cms, &der);
    const Bytes bytes(reinterpret_cast<const char*>(der), size > 0 ? static_cast<std::size_t>(size) : 0);
    OPENSSL_free(der);
    ERR_clear_error();
    return CmsReader(chain).read(bytes);
}

}  // namespace gumcert::signing
