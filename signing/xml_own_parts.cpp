#include "signing/xml_own_parts.h"

#include <openssl/core_names.h>
#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/objects.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "signing/certificates.h"
#include "signing/xml_algorithms.h"
#include "signing/xml_tree.h"

namespace gumcert::signing {

namespace {

/// What an element within a signature holds beside blanks and other elements. Each is looked at as what it says it is
/// (OwnValues), for any sentence is Base64 by its letters.
enum class TextOf {
    nothing,
    signature_value,
    certificate,
    key_identifier,  ///< of a certificate of the signer's chain, as the three below
    name,            ///< "CN=…,O=…", or one part of it
    serial_number,   ///< decimal
    certificate_digest,
    revocation_list,    ///< by an issuer of the chain
    revocation_answer,  ///< the same
    modulus,            ///< of the signer's key, as the two below
    exponent,
    point,
    time_stamp,
};

/// An element that may stand within a signature, beside what the signature covers.
struct OwnPart {
    const char* name_space;
    std::string_view name;
    std::string_view attributes = "Id";  ///< names, with blanks between
    TextOf text = TextOf::nothing;
};
constexpr std::array<OwnPart, 38> k_own_parts = {{
    {k_dsig_namespace, "Signature"},
    {k_dsig_namespace, "SignatureValue", "Id", TextOf::signature_value},
    {k_dsig_namespace, "KeyInfo"},
    {k_dsig_namespace, "KeyName", "Id", TextOf::name},
    {k_dsig_namespace, "X509Data"},
    {k_dsig_namespace, "X509SubjectName", "", TextOf::name},
    {k_dsig_namespace, "X509IssuerSerial"},
    {k_dsig_namespace, "X509IssuerName", "", TextOf::name},
    {k_dsig_namespace, "X509SerialNumber", "", TextOf::serial_number},
    {k_dsig_namespace, "X509Certificate", "", TextOf::certificate},
    {k_dsig_namespace, "X509SKI", "", TextOf::key_identifier},
    {k_dsig_namespace, "X509CRL", "", TextOf::revocation_list},
    {k_dsig_11_namespace, "X509Digest", "Algorithm", TextOf::certificate_digest},
    {k_dsig_namespace, "KeyValue"},
    {k_dsig_namespace, "RSAKeyValue"},
    {k_dsig_namespace, "Modulus", "", TextOf::modulus},
    {k_dsig_namespace, "Exponent", "", TextOf::exponent},
    {k_dsig_11_namespace, "ECKeyValue"},
    {k_dsig_11_namespace, "NamedCurve", "URI"},
    {k_dsig_11_namespace, "PublicKey", "", TextOf::point},
    {k_dsig_namespace, "Object"},
    {k_xades_namespace, "QualifyingProperties", "Id Target"},
    {k_xades_namespace, "UnsignedProperties"},
    {k_xades_namespace, "UnsignedSignatureProperties"},
    {k_xades_namespace, "SignatureTimeStamp"},
    {k_xades_namespace, "SigAndRefsTimeStamp"},
    {k_xades_namespace, "RefsOnlyTimeStamp"},
    {k_xades_namespace, "ArchiveTimeStamp"},
    {k_xades_141_namespace, "ArchiveTimeStamp"},
    {k_dsig_namespace, "CanonicalizationMethod", "Algorithm"},
    {k_xades_namespace, "EncapsulatedTimeStamp", "Id Encoding", TextOf::time_stamp},
    {k_xades_namespace, "CertificateValues"},
    {k_xades_namespace, "EncapsulatedX509Certificate", "Id Encoding", TextOf::certificate},
    {k_xades_namespace, "RevocationValues"},
    {k_xades_namespace, "CRLValues"},
    {k_xades_namespace, "EncapsulatedCRLValue", "Id Encoding", TextOf::revocation_list},
    {k_xades_namespace, "OCSPValues"},
    {k_xades_namespace, "EncapsulatedOCSPValue", "Id Encoding", TextOf::revocation_answer},
}};

/// Whether two names are one, "CN=A, O=B" and "O=B,CN=A": programs write the parts in either order, with or without blanks.
bool is_same_distinguished_name(std::string_view a, std::string_view b) {
    const auto parts_of = [](std::string_view name) {
        std::vector<std::string> parts(1);
        bool is_escaped = false;
        for (const char c : name) {
            if (c == ',' && !is_escaped) {
                parts.emplace_back();
            } else if (!(c == ' ' && parts.back().empty())) {
                parts.back() += c;
            }
            is_escaped = c == '\\' && !is_escaped;
        }
        std::sort(parts.begin(), parts.end());
        return parts;
    };
    return parts_of(a) == parts_of(b);
}

bool is_among(std::string_view list, std::string_view word) {
    return (' ' + std::string(list) + ' ').find(' ' + std::string(word) + ' ') != std::string::npos;
}

const OwnPart* own_part(const xmlNode* element) {
    const auto* const found = std::find_if(k_own_parts.begin(), k_own_parts.end(), [&](const OwnPart& part) {
        return is_element(element, part.name_space, std::string(part.name).c_str());
    });
    return found == k_own_parts.end() ? nullptr : found;
}

bool is_in_one(const xmlNode* element, const CoveredParts& covered) {
    return std::any_of(covered.begin(), covered.end(),
                       [&](const xmlNode* one) { return one != nullptr && is_inside(element, one); });
}

bool is_known_namespace(const xmlNs* declared) {
    const std::string_view name = declared->href == nullptr ? "" : reinterpret_cast<const char*>(declared->href);
    constexpr std::size_t k_longest_prefix = 16;
    return (name == k_dsig_namespace || name == k_dsig_11_namespace || name == k_xades_namespace ||
            name == k_xades_141_namespace) &&
           (declared->prefix == nullptr ||
            std::string_view(reinterpret_cast<const char*>(declared->prefix)).size() <= k_longest_prefix);
}

/// Bytes of Base64 as programs write it: in one piece or in lines of one length, which may be indented. Words with blanks between
/// them, or each on a line, are none.
std::optional<Bytes> bytes_of_value(std::string_view text) {
    constexpr std::string_view k_blanks = " \t\r";
    constexpr std::size_t k_shortest_line = 40;
    std::string joined;
    std::size_t length = 0;  // of the first line
    bool is_last = false;
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        line.remove_prefix(std::min(line.size(), line.find_first_not_of(k_blanks)));
        line = line.substr(0, line.find_last_not_of(k_blanks) + 1);
        if (line.empty()) {
            is_last = is_last || length != 0;
            continue;
        }
        if (is_last || (length != 0 && line.size() > length)) {
            return std::nullopt;
        }
        length = length == 0 ? line.size() : length;
        is_last = line.size() < std::max(length, k_shortest_line);
        joined += line;
    }
    std::optional<Bytes> bytes = encoding::bytes_from_base64(joined);
    // The same bytes have one text: no blanks within, and no bits behind the last byte.
    const bool is_canonical = bytes && !bytes->empty() && encoding::base64(*bytes) == joined;
    return is_canonical ? std::move(bytes) : std::nullopt;
}

Bytes der_of(X509* certificate) {
    unsigned char* der = nullptr;
    const int size = i2d_X509(certificate, &der);
    Bytes bytes(reinterpret_cast<const char*>(der), size > 0 ? static_cast<std::size_t>(size) : 0);
    OPENSSL_free(der);
    return bytes;
}

/// What the values within one signature may be.
class OwnValues {
public:
    explicit OwnValues(const SignerChain& chain) : chain_(chain) {}

    [[nodiscard]] bool fits(const xmlNode* element, TextOf kind) const {
        if (kind == TextOf::nothing) {
            return true;  // foreign_part() has looked
        }
        if (is_of_certificate(kind)) {
            return is_of(element, kind, chain_.proven()) || is_unproven(element, kind);
        }
        const std::optional<Bytes> bytes = bytes_of_value(text_of(element));
        if (!bytes) {
            return false;
        }
        switch (kind) {
            case TextOf::signature_value:
                return true;  // it is verified
            case TextOf::certificate: {
                const CertificateHandle certificate = certificate_from_der(*bytes);
                return certificate != nullptr && der_of(certificate.get()) == *bytes;
            }
            case TextOf::revocation_list:
                return is_revocation_list_of(*bytes, chain_.issuers());
            case TextOf::revocation_answer:
                return is_revocation_answer_of(*bytes, chain_.issuers());
            case TextOf::modulus:
                return is_number_of_key(OSSL_PKEY_PARAM_RSA_N, *bytes);
            case TextOf::exponent:
                return is_number_of_key(OSSL_PKEY_PARAM_RSA_E, *bytes);
            case TextOf::point:
                return is_point_of_key(*bytes);
            case TextOf::time_stamp:
                return is_time_stamp(*bytes);
            default:
                return false;
        }
    }

    /// Whether a value is one of a certificate for whose content nobody vouches, and of no other one.
    [[nodiscard]] bool is_unproven(const xmlNode* element, TextOf kind) const {
        return is_of_certificate(kind) && !is_of(element, kind, chain_.proven()) &&
               is_of(element, kind, chain_.unproven());
    }

    /// Attributes that state how a value is to be read.
    [[nodiscard]] bool fits(const xmlNode* element) const {
        const std::string algorithm = attribute(element, "Algorithm");
        const std::string encoding = attribute(element, "Encoding");
        const std::string curve = attribute(element, "URI");
        return (algorithm.empty() || allowed(k_digests, algorithm) != nullptr ||
                allowed(k_canonicalisations, algorithm) != nullptr) &&
               (encoding.empty() || encoding == "http://uri.etsi.org/01903/v1.2.2#DER") &&
               (curve.empty() || curve == curve_of_key());
    }

private:
    static bool is_of_certificate(TextOf kind) {
        return kind == TextOf::name || kind == TextOf::serial_number || kind == TextOf::key_identifier ||
               kind == TextOf::certificate_digest;
    }

    /// Whether a name, number or digest is one of some certificates.
    static bool is_of(const xmlNode* element, TextOf kind, const std::vector<X509*>& certificates) {
        const std::string text = text_of(element);
        const std::optional<Bytes> bytes =
            kind == TextOf::key_identifier || kind == TextOf::certificate_digest ? bytes_of_value(text) : std::nullopt;
        return std::any_of(certificates.begin(), certificates.end(), [&](X509* one) {
            if (kind == TextOf::name) {
                return is_named(one, text);
            }
            if (kind == TextOf::serial_number) {
                return text == serial_of(one);
            }
            if (kind == TextOf::key_identifier) {
                const ASN1_OCTET_STRING* stated = X509_get0_subject_key_id(one);
                return stated != nullptr && bytes &&
                       Bytes(reinterpret_cast<const char*>(ASN1_STRING_get0_data(stated)),
                             static_cast<std::size_t>(ASN1_STRING_length(stated))) == *bytes;
            }
            const char* const name = allowed(k_digests, attribute(element, "Algorithm"));
            return name != nullptr && bytes && encoding::sha2_bytes(name, der_of(one)) == *bytes;
        });
    }

    /// KeyInfo may name the certificate that it brings, as programs of others do.
    static bool is_named(X509* certificate, const std::string& text) {
        const std::vector<std::string> parts = names_of(certificate);
        return is_same_distinguished_name(text, subject_of(certificate)) ||
               is_same_distinguished_name(text, issuer_of(certificate)) ||
               std::find(parts.begin(), parts.end(), text) != parts.end();
    }

    [[nodiscard]] EVP_PKEY* key() const { return X509_get0_pubkey(chain_.signer()); }

    [[nodiscard]] bool is_number_of_key(const char* name, const Bytes& bytes) const {
        BIGNUM* number = nullptr;
        if (key() == nullptr || EVP_PKEY_get_bn_param(key(), name, &number) != 1) {
            ERR_clear_error();
            return false;
        }
        Bytes stated(static_cast<std::size_t>(BN_num_bytes(number)), '\0');
        BN_bn2bin(number, reinterpret_cast<unsigned char*>(stated.data()));
        BN_free(number);
        return bytes == stated || bytes == '\0' + stated;  // with the sign, as some programs write it
    }

    [[nodiscard]] bool is_point_of_key(const Bytes& bytes) const {
        unsigned char* point = nullptr;
        const std::size_t size = key() == nullptr || EVP_PKEY_get_base_id(key()) != EVP_PKEY_EC
                                     ? 0
                                     : EVP_PKEY_get1_encoded_public_key(key(), &point);
        const bool fits = size != 0 && Bytes(reinterpret_cast<const char*>(point), size) == bytes;
        OPENSSL_free(point);
        ERR_clear_error();
        return fits;
    }

    /// "urn:oid:1.2.840.10045.3.1.7"; "" for a key of another kind.
    [[nodiscard]] std::string curve_of_key() const {
        std::array<char, 64> name{};
        std::size_t size = 0;
        if (key() == nullptr || EVP_PKEY_get_group_name(key(), name.data(), name.size(), &size) != 1) {
            ERR_clear_error();
            return {};
        }
        std::array<char, 64> number{};
        constexpr int k_always_as_number = 1;
        const int known = OBJ_txt2nid(name.data());
        const ASN1_OBJECT* object = OBJ_nid2obj(known == NID_undef ? EC_curve_nist2nid(name.data()) : known);
        OBJ_obj2txt(number.data(), static_cast<int>(number.size()), object, k_always_as_number);
        return std::string("urn:oid:") + number.data();
    }

    const SignerChain& chain_;
};

/// Calls for the elements of a signature that it does not cover, in order, until one answers with a text.
template <class Visit>
std::string first_of_own(const xmlNode* element, const CoveredParts& covered, Visit& visit) {
    if (is_in_one(element, covered)) {
        return {};
    }
    if (std::string said = visit(element); !said.empty()) {
        return said;
    }
    for (const xmlNode* child : children_of(element)) {
        if (std::string said = first_of_own(child, covered, visit); !said.empty()) {
            return said;
        }
    }
    return {};
}

}  // namespace

bool is_plain_value(std::string_view value) {
    constexpr std::string_view k_characters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._:/#-";
    constexpr std::size_t k_longest = 200;
    return value.size() <= k_longest && value.find_first_not_of(k_characters) == std::string_view::npos;
}

bool is_inside(const xmlNode* element, const xmlNode* of) {
    while (element != nullptr && element != of) {
        element = element->parent;
    }
    return element != nullptr;
}

UsedNamespaces used_namespaces(const std::vector<xmlNode*>& elements) {
    UsedNamespaces used;
    for (const xmlNode* element : elements) {
        used.insert(element->ns);
        for (const xmlAttr* a = element->properties; a != nullptr; a = a->next) {
            used.insert(a->ns);
        }
    }
    return used;
}

std::string shown_namespace(const xmlNs* declared) {
    const auto text = [](const xmlChar* of) { return of == nullptr ? "" : reinterpret_cast<const char*>(of); };
    return std::string("xmlns") + (declared->prefix == nullptr ? "" : ":") + text(declared->prefix) + '=' +
           text(declared->href);
}

std::string foreign_part(const xmlNode* element, const CoveredParts& covered, const UsedNamespaces& used) {
    const bool is_covered = is_in_one(element, covered);
    const OwnPart* const own = own_part(element);
    if (!is_covered && own == nullptr) {
        return "the element " + name_of(element);
    }
    for (const xmlNs* declared = element->nsDef; declared != nullptr; declared = declared->next) {
        // Exclusive canonical XML leaves out what nothing uses, of the covered parts too.
        if (!is_known_namespace(declared) && !(is_covered && used.contains(declared))) {
            return "the namespace " + shown_namespace(declared) + " of " + name_of(element);
        }
    }
    for (const xmlAttr* a = is_covered ? nullptr : element->properties; a != nullptr; a = a->next) {
        const std::string name = reinterpret_cast<const char*>(a->name);
        if (a->ns != nullptr || !is_among(own->attributes, name) || !is_plain_value(attribute(element, name.c_str()))) {
            return "the attribute " + name + " of " + name_of(element);
        }
    }
    for (const xmlNode* child = element->children; child != nullptr; child = child->next) {
        switch (child->type) {
            case XML_ELEMENT_NODE:
                if (std::string found = foreign_part(child, covered, used); !found.empty()) {
                    return found;
                }
                break;
            case XML_TEXT_NODE: {
                const std::string_view text =
                    child->content == nullptr ? "" : reinterpret_cast<const char*>(child->content);
                if (!is_covered && own->text == TextOf::nothing && !is_blank(text)) {
                    return "text in " + name_of(element);
                }
                break;
            }
            default:
                return std::string(child->type == XML_COMMENT_NODE ? "a comment"
                                   : child->type == XML_PI_NODE    ? "a processing instruction"
                                                                   : "text of another form") +
                       " in " + name_of(element);
        }
    }
    return {};
}

std::string foreign_value(const xmlNode* signature, const CoveredParts& covered, const SignerChain& chain) {
    const OwnValues values(chain);
    const auto visit = [&](const xmlNode* element) -> std::string {
        const OwnPart* const own = own_part(element);
        if (own == nullptr) {
            return {};  // foreign_part() has told it
        }
        if (!values.fits(element)) {
            return "an attribute of " + name_of(element) + " that is not of its key or value";
        }
        const bool is_of_certificate = own->text == TextOf::name || own->text == TextOf::serial_number;
        return values.fits(element, own->text) ? ""
               : is_of_certificate             ? "text in " + name_of(element) + " that names none of its certificates"
                                               : "text in " + name_of(element) + " that is not what the element says";
    };
    return first_of_own(signature, covered, visit);
}

std::vector<std::string> unproven_values(const xmlNode* signature, const CoveredParts& covered,
                                         const SignerChain& chain) {
    const OwnValues values(chain);
    std::vector<std::string> all;
    std::set<std::string> told;
    const auto visit = [&](const xmlNode* element) -> std::string {
        const OwnPart* const own = own_part(element);
        if (own != nullptr && values.is_unproven(element, own->text)) {
            if (std::string text = text_of(element); told.insert(text).second) {
                all.push_back(std::move(text));
            }
        }
        return {};
    };
    (void)first_of_own(signature, covered, visit);
    return all;
}

std::size_t revocation_lists_in(const xmlNode* signature, const CoveredParts& covered) {
    std::size_t count = 0;
    const auto visit = [&](const xmlNode* element) -> std::string {
        count += is_element(element, k_dsig_namespace, "X509CRL") ? 1U : 0U;
        return {};
    };
    (void)first_of_own(signature, covered, visit);
    return count;
}

void certificates_in(const xmlNode* signature, const CoveredParts& covered, const char* name_space, const char* name,
                     std::vector<CertificateHandle>& certificates, std::vector<Bytes>& bytes) {
    const auto visit = [&](const xmlNode* element) -> std::string {
        if (is_element(element, name_space, name)) {
            const std::optional<Bytes> der = encoding::bytes_from_base64(text_of(element));
            CertificateHandle certificate = der ? certificate_from_der(*der) : CertificateHandle();
            if (certificate != nullptr) {
                // The digest of the signed properties is of these bytes. A certificate that is encoded again could
                // differ from them.
                bytes.push_back(*der);
                certificates.push_back(std::move(certificate));
            }
        }
        return {};
    };
    (void)first_of_own(signature, covered, visit);
}

std::vector<std::string> identifiers_in(const xmlNode* signature, const CoveredParts& covered) {
    std::vector<std::string> all;
    std::set<std::string> known;
    const auto visit = [&](const xmlNode* element) -> std::string {
        const std::string id = attribute(element, "Id");
        if (!id.empty() && element != signature && known.insert(id).second) {
            all.push_back(id);
        }
        return {};
    };
    (void)first_of_own(signature, covered, visit);
    return all;
}

}  // namespace gumcert::signing
