#include <libxml/parser.h>
#include <libxml/xmlerror.h>
#include <openssl/err.h>
#include <xmlsec/xmlsec.h>

#include <xmlsec/errors.h>
#include <xmlsec/keys.h>
#include <xmlsec/openssl/app.h>
#include <xmlsec/openssl/crypto.h>
#include <xmlsec/openssl/evp.h>
#include <xmlsec/xmldsig.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "signing/certificates.h"
#include "signing/document_verification.h"
#include "signing/time_texts.h"
#include "signing/xml_tree.h"

namespace gumcert::signing {

namespace {

/// An algorithm of the allow-list: its identifier in XML, and its name for people and for OpenSSL.
struct Algorithm {
    std::string_view identifier;
    const char* name;
};
constexpr std::array<Algorithm, 3> k_canonicalisations = {{{"http://www.w3.org/2001/10/xml-exc-c14n#", "exclusive"},
                                                           {"http://www.w3.org/2006/12/xml-c14n11", "1.1"},
                                                           {"http://www.w3.org/TR/2001/REC-xml-c14n-20010315", "1.0"}}};
constexpr std::array<Algorithm, 3> k_digests = {{{"http://www.w3.org/2001/04/xmlenc#sha256", "SHA2-256"},
                                                 {"http://www.w3.org/2001/04/xmldsig-more#sha384", "SHA2-384"},
                                                 {"http://www.w3.org/2001/04/xmlenc#sha512", "SHA2-512"}}};
constexpr std::array<Algorithm, 6> k_methods = {
    {{"http://www.w3.org/2001/04/xmldsig-more#rsa-sha256", "RSA with SHA-256"},
     {"http://www.w3.org/2001/04/xmldsig-more#rsa-sha384", "RSA with SHA-384"},
     {"http://www.w3.org/2001/04/xmldsig-more#rsa-sha512", "RSA with SHA-512"},
     {"http://www.w3.org/2001/04/xmldsig-more#ecdsa-sha256", "ECDSA with SHA-256"},
     {"http://www.w3.org/2001/04/xmldsig-more#ecdsa-sha384", "ECDSA with SHA-384"},
     {"http://www.w3.org/2001/04/xmldsig-more#ecdsa-sha512", "ECDSA with SHA-512"}}};

template <std::size_t Count>
const char* allowed(const std::array<Algorithm, Count>& list, const std::string& identifier) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Algorithm& a) { return a.identifier == identifier; });
    return found == list.end() ? nullptr : found->name;
}

void start_xmlsec() {
    static std::once_flag started;
    std::call_once(started, [] {
        xmlInitParser();
        xmlSecErrorsDefaultCallbackEnableOutput(0);  // a library never prints
        if (xmlSecInit() < 0 || xmlSecOpenSSLAppInit(nullptr) < 0 || xmlSecOpenSSLInit() < 0) {
            throw std::runtime_error("xmlsec cannot be started");
        }
        xmlSecErrorsDefaultCallbackEnableOutput(0);
    });
}

struct ContextFree {
    void operator()(xmlSecDSigCtx* context) const { xmlSecDSigCtxDestroy(context); }
};

/// Every element of the document, in order.
std::vector<xmlNode*> all_elements(xmlNode* root) {
    std::vector<xmlNode*> all = {root};
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::vector<xmlNode*> children = children_of(all[i]);
        all.insert(all.end(), children.begin(), children.end());
    }
    return all;
}

bool is_inside(const xmlNode* node, const xmlNode* of) {
    while (node != nullptr && node != of) {
        node = node->parent;
    }
    return node != nullptr;
}

bool has_comments(const xmlNode* node) {
    for (const xmlNode* child = node->children; child != nullptr; child = child->next) {
        if (child->type == XML_COMMENT_NODE || (child->type == XML_ELEMENT_NODE && has_comments(child))) {
            return true;
        }
    }
    return false;
}

/// What the text of an element is made of.
struct Pieces {
    int texts = 0;  ///< pieces of text with more than blanks, or of a value
    bool comment = false;
    bool cdata = false;
};

Pieces pieces_of(const xmlNode* element) {
    Pieces pieces;
    for (const xmlNode* child = element->children; child != nullptr; child = child->next) {
        const bool cdata = child->type == XML_CDATA_SECTION_NODE;
        if (child->type == XML_COMMENT_NODE) {
            pieces.comment = true;
        } else if ((cdata || child->type == XML_TEXT_NODE) && child->content != nullptr &&
                   !is_blank(reinterpret_cast<const char*>(child->content))) {
            ++pieces.texts;
            pieces.cdata = pieces.cdata || cdata;
        }
    }
    return pieces;
}

/// The first element whose text is in pieces, although it has the canonical form of one piece: a comment stands in it,
/// or a part of it is a CDATA section. Programs that read the first piece only take another value out of it than those
/// that read all.
/// \return nullptr if there is none
const xmlNode* element_with_split_text(const std::vector<xmlNode*>& elements) {
    const auto split = [](const xmlNode* element) {
        const Pieces pieces = pieces_of(element);
        return pieces.texts > 0 && (pieces.comment || (pieces.cdata && pieces.texts > 1));
    };
    const auto found = std::find_if(elements.begin(), elements.end(), split);
    return found == elements.end() ? nullptr : *found;
}

/// Whether an element, or one in it, has an attribute with a namespace. Such a one could be taken for the attribute
/// without: xmlsec looks attributes up by their name alone.
bool has_foreign_attribute(const xmlNode* element) {
    for (const xmlAttr* a = element->properties; a != nullptr; a = a->next) {
        if (a->ns != nullptr) {
            return true;
        }
    }
    const std::vector<xmlNode*> children = children_of(element);
    return std::any_of(children.begin(), children.end(), has_foreign_attribute);
}

/// What the text of an element within a signature may be, beside blanks.
enum class TextOf {
    nothing,
    base64,
    certificate,  ///< a name or a number of a certificate of the signature, which says nothing that it does not say
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
    {k_dsig_namespace, "SignatureValue", "Id", TextOf::base64},
    {k_dsig_namespace, "KeyInfo"},
    {k_dsig_namespace, "KeyName", "Id", TextOf::certificate},
    {k_dsig_namespace, "X509Data"},
    {k_dsig_namespace, "X509SubjectName", "", TextOf::certificate},
    {k_dsig_namespace, "X509IssuerSerial"},
    {k_dsig_namespace, "X509IssuerName", "", TextOf::certificate},
    {k_dsig_namespace, "X509SerialNumber", "", TextOf::certificate},
    {k_dsig_namespace, "X509Certificate", "", TextOf::base64},
    {k_dsig_namespace, "X509SKI", "", TextOf::base64},
    {k_dsig_namespace, "X509CRL", "", TextOf::base64},
    {k_dsig_11_namespace, "X509Digest", "Algorithm", TextOf::base64},
    {k_dsig_namespace, "KeyValue"},
    {k_dsig_namespace, "RSAKeyValue"},
    {k_dsig_namespace, "Modulus", "", TextOf::base64},
    {k_dsig_namespace, "Exponent", "", TextOf::base64},
    {k_dsig_11_namespace, "ECKeyValue"},
    {k_dsig_11_namespace, "NamedCurve", "URI"},
    {k_dsig_11_namespace, "PublicKey", "", TextOf::base64},
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
    {k_xades_namespace, "EncapsulatedTimeStamp", "Id Encoding", TextOf::base64},
    {k_xades_namespace, "CertificateValues"},
    {k_xades_namespace, "EncapsulatedX509Certificate", "Id Encoding", TextOf::base64},
    {k_xades_namespace, "RevocationValues"},
    {k_xades_namespace, "CRLValues"},
    {k_xades_namespace, "EncapsulatedCRLValue", "Id Encoding", TextOf::base64},
    {k_xades_namespace, "OCSPValues"},
    {k_xades_namespace, "EncapsulatedOCSPValue", "Id Encoding", TextOf::base64},
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

bool is_base64_or_blank(std::string_view text) {
    constexpr std::string_view k_characters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/= \t\r\n";
    return text.find_first_not_of(k_characters) == std::string_view::npos;
}

/// Whether a value is an identifier or an address, and not a sentence.
bool is_plain_value(std::string_view value) {
    constexpr std::string_view k_characters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._:/#-";
    constexpr std::size_t k_longest = 200;
    return value.size() <= k_longest && value.find_first_not_of(k_characters) == std::string_view::npos;
}

bool is_among(std::string_view list, std::string_view word) {
    return (' ' + std::string(list) + ' ').find(' ' + std::string(word) + ' ') != std::string::npos;
}

/// The first part of a signature that is none of a signature's, in words. The signature leaves itself out of what it covers,
/// so anything could have been put there later: elements and attributes are those of the list, texts are Base64 or name a
/// certificate (check_names), and there is
/// no comment and no processing instruction, which canonical XML may leave out of what is covered, too.
/// \param covered  parts that it covers nevertheless
/// \return "" if there is none
std::string foreign_part(const xmlNode* element, const std::array<const xmlNode*, 2>& covered) {
    const bool is_covered = std::find(covered.begin(), covered.end(), element) != covered.end() ||
                            std::any_of(covered.begin(), covered.end(),
                                        [&](const xmlNode* one) { return one != nullptr && is_inside(element, one); });
    const auto* const own = std::find_if(k_own_parts.begin(), k_own_parts.end(), [&](const OwnPart& part) {
        return is_element(element, part.name_space, std::string(part.name).c_str());
    });
    if (!is_covered && own == k_own_parts.end()) {
        return "the element " + name_of(element);
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
                if (std::string found = foreign_part(child, covered); !found.empty()) {
                    return found;
                }
                break;
            case XML_TEXT_NODE: {
                const std::string_view text =
                    child->content == nullptr ? "" : reinterpret_cast<const char*>(child->content);
                if (!is_covered && own->text != TextOf::certificate &&
                    !(own->text == TextOf::base64 ? is_base64_or_blank(text) : is_blank(text))) {
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

/// How many elements bear this value as identifier, whatever the spelling of the attribute.
int count_of_id(const std::vector<xmlNode*>& elements, const std::string& value) {
    int count = 0;
    for (const xmlNode* element : elements) {
        for (const xmlAttr* a = element->properties; a != nullptr; a = a->next) {
            const std::string_view name(reinterpret_cast<const char*>(a->name));
            if ((name == "Id" || name == "ID" || name == "id") && a->children != nullptr &&
                text_of(reinterpret_cast<const xmlNode*>(a)) == value) {
                ++count;
            }
        }
    }
    return count;
}

/// Checks one signature: first its shape, by our own rules, so that nothing of what XML signatures can do besides is
/// left; then its values, by xmlsec; then its signer.
class XmlSignatureCheck {
public:
    XmlSignatureCheck(xmlNode* signature, const std::vector<xmlNode*>& elements, std::string where)
        : signature_(signature), elements_(elements), where_(std::move(where)) {}

    SignatureReport run(const TrustedMaterial& trusted, std::int64_t now) {
        report_.format = "XMLDSig";
        check_shape();
        find_certificate();
        check_names();
        if (report_.findings.empty()) {
            check_values();
        }
        if (!chain_.empty()) {
            // A time and a certificate that the values do not protect are worth nothing.
            const bool protects = report_.findings.empty() && properties_ != nullptr;
            check_signer(report_, where_, chain_, trusted, protects ? claimed_time() : std::string(), now);
        }
        conclude(report_);
        if (report_.valid) {
            say_what_is_covered();
        } else {
            report_.not_covered.emplace_back("nothing can be relied on");
        }
        return std::move(report_);
    }

private:
    void error(const char* code, const std::string& what, const char* rule, const char* action = k_ask_again) {
        add_error(report_, code, where_, what, rule, action);
    }

    void check_shape() {
        const xmlNode* info = only_child(signature_, k_dsig_namespace, "SignedInfo");
        if (info == nullptr || only_child(signature_, k_dsig_namespace, "SignatureValue") == nullptr) {
            error("GC-SIGN-0110", "SignedInfo or SignatureValue is missing or there more than once",
                  "a signature has one of each");
            return;
        }
        // Canonical XML leaves comments out, so one can be put in after signing and the digest still fits.
        if (const xmlNode* split = element_with_split_text(elements_); split != nullptr) {
            error("GC-SIGN-0121",
                  "the text of the element " + name_of(split) + " in line " + std::to_string(xmlGetLineNo(split)) +
                      " is split by a comment or a CDATA section, which may have been put in after signing",
                  "every program reads the same value; comments are not covered by the signature");
        }
        if (has_foreign_attribute(info)) {
            error("GC-SIGN-0110", "SignedInfo has an attribute of another namespace",
                  "the attributes of SignedInfo are those of XML signatures alone");
        }
        check_method(info);
        // The known attack (signature wrapping) keeps the signed part under its identifier in another place, and puts a
        // part that nobody signed where programs read. A reference to the whole document, and to nothing by a name of
        // the author's choice, leaves no such place.
        int document_references = 0;
        for (const xmlNode* reference : children_of(info, k_dsig_namespace, "Reference")) {
            if (has_attribute(reference, "URI") && attribute(reference, "URI").empty()) {
                ++document_references;
                check_document_reference(reference);
            } else if (attribute(reference, "Type") == k_signed_properties_type && properties_ == nullptr) {
                check_properties_reference(reference);
            } else {
                error("GC-SIGN-0112", "it refers to " + attribute(reference, "URI"),
                      "a signature covers the whole document and its own properties, and nothing else");
            }
        }
        if (document_references != 1) {
            error("GC-SIGN-0112", std::to_string(document_references) + " references to the whole document",
                  "exactly one reference has URI=\"\", so that nothing else can be taken for what was signed");
        }
        if (const std::string foreign = foreign_part(signature_, {info, properties_}); !foreign.empty()) {
            error(
                "GC-SIGN-0120", foreign + " within the signature is not covered by it",
                "a signature holds nothing but its own parts, so that nothing in it can be taken for what was signed");
        }
    }

    void check_method(const xmlNode* info) {
        const xmlNode* canonicalisation = only_child(info, k_dsig_namespace, "CanonicalizationMethod");
        const xmlNode* method = only_child(info, k_dsig_namespace, "SignatureMethod");
        if (allowed(k_canonicalisations, attribute(canonicalisation, "Algorithm")) == nullptr) {
            error("GC-SIGN-0111", "canonicalisation " + attribute(canonicalisation, "Algorithm"),
                  "canonical XML is 1.0, 1.1 or exclusive, without comments");
        }
        const std::string identifier = attribute(method, "Algorithm");
        if (const char* name = allowed(k_methods, identifier); name != nullptr) {
            report_.algorithm = name;
        } else {
            report_.algorithm = identifier;
            error("GC-SIGN-0111", "signature method " + identifier,
                  "accepted are RSA (PKCS #1 v1.5) and ECDSA with SHA-256, SHA-384 or SHA-512");
        }
    }

    void check_digest(const xmlNode* reference) {
        const std::string identifier = attribute(only_child(reference, k_dsig_namespace, "DigestMethod"), "Algorithm");
        if (allowed(k_digests, identifier) == nullptr) {
            error("GC-SIGN-0111", "digest method " + identifier, "accepted are SHA-256, SHA-384 and SHA-512");
        }
    }

    static std::vector<std::string> transforms_of(const xmlNode* reference) {
        std::vector<std::string> all;
        for (const xmlNode* list : children_of(reference, k_dsig_namespace, "Transforms")) {
            for (const xmlNode* transform : children_of(list)) {
                all.push_back(attribute(transform, "Algorithm"));
            }
        }
        return all;
    }

    void check_document_reference(const xmlNode* reference) {
        const std::vector<std::string> transforms = transforms_of(reference);
        const bool good = !transforms.empty() && transforms[0] == k_enveloped && transforms.size() <= 2 &&
                          (transforms.size() == 1 || allowed(k_canonicalisations, transforms[1]) != nullptr);
        if (!good) {
            error("GC-SIGN-0113", "transforms of the document other than leaving out the signature and canonical XML",
                  "every other transform could leave out a part of the document");
        }
        check_digest(reference);
    }

    void check_properties_reference(const xmlNode* reference) {
        for (const xmlNode* object : children_of(signature_, k_dsig_namespace, "Object")) {
            const xmlNode* qualifying = only_child(object, k_xades_namespace, "QualifyingProperties");
            if (xmlNode* found = only_child(qualifying, k_xades_namespace, "SignedProperties"); found != nullptr) {
                properties_ = found;
                check_target(qualifying);
            }
        }
        const std::string id = attribute(properties_, "Id");
        // Where an identifier is there twice, xmlsec and the reader of the properties may each take another of the two.
        if (id.empty() || attribute(reference, "URI") != '#' + id || count_of_id(elements_, id) != 1) {
            error("GC-SIGN-0114", "the signed properties are not found by their identifier, or it is there twice",
                  "the second reference points to the properties within the same signature");
            return;
        }
        const std::vector<std::string> transforms = transforms_of(reference);
        if (transforms.size() > 1 ||
            (transforms.size() == 1 && allowed(k_canonicalisations, transforms[0]) == nullptr)) {
            error("GC-SIGN-0113", "transforms of the signed properties other than canonical XML",
                  "every other transform could leave out a part of them");
        }
        check_digest(reference);
    }

    /// The properties say which signature they belong to (ETSI EN 319 132-1, QualifyingProperties/@Target).
    void check_target(const xmlNode* qualifying) {
        const std::string id = attribute(signature_, "Id");
        if (id.empty() || attribute(qualifying, "Target") != '#' + id || count_of_id(elements_, id) != 1) {
            error("GC-SIGN-0123",
                  "the properties are of the signature \"" + attribute(qualifying, "Target") +
                      "\", and this one is \"" + id + '"',
                  "the signed properties name the signature that they stand in, which is there once");
        }
    }

    [[nodiscard]] const xmlNode* signature_properties() const {
        return only_child(properties_, k_xades_namespace, "SignedSignatureProperties");
    }

    [[nodiscard]] std::string claimed_time() const {
        const xmlNode* time = only_child(signature_properties(), k_xades_namespace, "SigningTime");
        return time == nullptr ? std::string() : text_of(time);
    }

    /// The certificates of KeyInfo, the signer's first: with XAdES the one whose digest is among the signed properties.
    void find_certificate() {
        for (const xmlNode* key_info : children_of(signature_, k_dsig_namespace, "KeyInfo")) {
            for (const xmlNode* data : children_of(key_info, k_dsig_namespace, "X509Data")) {
                for (const xmlNode* element : children_of(data, k_dsig_namespace, "X509Certificate")) {
                    const std::optional<Bytes> der = encoding::bytes_from_base64(text_of(element));
                    CertificateHandle certificate = der ? certificate_from_der(*der) : CertificateHandle();
                    if (certificate != nullptr) {
                        // The digest of the signed properties is of these bytes. A certificate that is encoded again
                        // could differ from them.
                        encoded_.push_back(*der);
                        chain_.push_back(std::move(certificate));
                    }
                }
            }
        }
        if (chain_.empty()) {
            error("GC-SIGN-0115", "no certificate of the signer in it",
                  "the signature brings the certificate of the signer (KeyInfo/X509Data/X509Certificate)");
            return;
        }
        if (properties_ != nullptr) {
            choose_by_digest();
        }
    }

    /// KeyInfo may name the certificate that it brings, as programs of others do: a text that names none of the
    /// certificates is none of a signature's.
    void check_names() {
        for (const xmlNode* element : elements_) {
            if (!is_inside(element, signature_) || chain_.empty()) {
                continue;
            }
            const auto is = [&](const char* name) { return is_element(element, k_dsig_namespace, name); };
            const bool is_name = is("KeyName") || is("X509SubjectName") || is("X509IssuerName");
            if (!is_name && !is("X509SerialNumber")) {
                continue;
            }
            const std::string text = text_of(element);
            const bool fits = std::any_of(chain_.begin(), chain_.end(), [&](const CertificateHandle& certificate) {
                const std::vector<std::string> parts = names_of(certificate.get());
                return is_name ? is_same_distinguished_name(text, subject_of(certificate.get())) ||
                                     is_same_distinguished_name(text, issuer_of(certificate.get())) ||
                                     std::find(parts.begin(), parts.end(), text) != parts.end()
                               : text == serial_of(certificate.get());
            });
            if (!fits) {
                error("GC-SIGN-0120",
                      "text in " + name_of(element) + " that names none of its certificates is not covered by it",
                      "a signature holds nothing but its own parts, so that nothing in it can be taken for what was "
                      "signed");
            }
        }
    }

    void choose_by_digest() {
        const xmlNode* all = only_child(signature_properties(), k_xades_namespace, "SigningCertificateV2");
        const bool newer = all != nullptr;
        if (!newer) {
            all = only_child(signature_properties(), k_xades_namespace, "SigningCertificate");
        }
        const std::vector<xmlNode*> certificates = children_of(all, k_xades_namespace, "Cert");
        const xmlNode* stated =
            certificates.empty() ? nullptr : only_child(certificates.front(), k_xades_namespace, "CertDigest");
        const char* name =
            allowed(k_digests, attribute(only_child(stated, k_dsig_namespace, "DigestMethod"), "Algorithm"));
        const std::optional<Bytes> value =
            encoding::bytes_from_base64(text_of(only_child(stated, k_dsig_namespace, "DigestValue")));
        for (std::size_t i = 0; name != nullptr && value && i < chain_.size(); ++i) {
            if (encoding::sha2_bytes(name, encoded_[i]) == *value) {
                // KeyInfo is not signed, so its order says nothing about which certificate is the signer's.
                std::swap(chain_[0], chain_[i]);
                report_.format = newer && !claimed_time().empty() ? "XAdES-BASELINE-B" : "XAdES";
                return;
            }
        }
        error("GC-SIGN-0116", "the certificate is not the one that the signed properties name",
              "the signer states the digest of the certificate with SHA-256, SHA-384 or SHA-512");
    }

    void check_values() {
        start_xmlsec();
        const QuietLibxml quiet;
        if (properties_ != nullptr) {
            xmlAttr* id = xmlHasProp(properties_, reinterpret_cast<const xmlChar*>("Id"));
            const std::string value = attribute(properties_, "Id");
            // Without a schema or a DOCTYPE the parser does not know that "Id" is an identifier, and the reference
            // would find nothing.
            xmlAddID(nullptr, signature_->doc, reinterpret_cast<const xmlChar*>(value.c_str()), id);
        }
        // No store of keys is given, so nothing but the key set below can be used.
        const std::unique_ptr<xmlSecDSigCtx, ContextFree> context(xmlSecDSigCtxCreate(nullptr));
        if (context == nullptr) {
            throw std::runtime_error("xmlsec has no memory");
        }
        // The key is the certificate's, which is then checked against the trust store; KeyInfo has no say.
        context->signKey = key_of(chain_.front().get());
        context->enabledReferenceUris =
            static_cast<xmlSecTransformUriType>(xmlSecTransformUriTypeEmpty | xmlSecTransformUriTypeSameDocument);
        const bool done = context->signKey != nullptr && xmlSecDSigCtxVerify(context.get(), signature_) >= 0;
        if (!done || context->status != xmlSecDSigStatusSucceeded) {
            // Two different things can have happened: another content, or another key. The laboratory is asked for
            // something else in each case.
            const bool changed = done && a_reference_differs(*context);
            error(changed ? "GC-SIGN-0117" : "GC-SIGN-0118",
                  changed ? "the document or the signed properties were changed after signing (the digest differs)"
                          : "the value of the signature does not fit the certificate",
                  "what was signed is unchanged");
        }
        ERR_clear_error();
        xmlResetLastError();
    }

    static bool a_reference_differs(xmlSecDSigCtx& context) {
        const xmlSecSize count = xmlSecPtrListGetSize(&context.signedInfoReferences);
        for (xmlSecSize i = 0; i < count; ++i) {
            const auto* reference =
                static_cast<xmlSecDSigReferenceCtxPtr>(xmlSecPtrListGetItem(&context.signedInfoReferences, i));
            if (reference != nullptr && reference->status == xmlSecDSigStatusInvalid) {
                return true;
            }
        }
        return false;
    }

    /// \return owned by who asks; nullptr for a kind of key that xmlsec does not take
    static xmlSecKeyPtr key_of(X509* certificate) {
        EVP_PKEY* key = X509_get_pubkey(certificate);
        xmlSecKeyDataPtr data = key == nullptr ? nullptr : xmlSecOpenSSLEvpKeyAdopt(key);
        if (data == nullptr) {
            EVP_PKEY_free(key);
            return nullptr;
        }
        xmlSecKeyPtr whole = xmlSecKeyCreate();
        if (whole == nullptr || xmlSecKeySetValue(whole, data) < 0) {
            xmlSecKeyDataDestroy(data);
            if (whole != nullptr) {
                xmlSecKeyDestroy(whole);
            }
            return nullptr;
        }
        return whole;
    }

    void say_what_is_covered() {
        report_.covers.emplace_back("the whole document without this signature");
        if (properties_ != nullptr) {
            report_.covers.emplace_back("the signed properties: time of signing and certificate of the signer");
        }
        if (has_comments(reinterpret_cast<const xmlNode*>(signature_->doc))) {
            report_.not_covered.emplace_back("comments of the XML");
        }
        for (const xmlNode* object : children_of(signature_, k_dsig_namespace, "Object")) {
            const xmlNode* qualifying = only_child(object, k_xades_namespace, "QualifyingProperties");
            if (qualifying == nullptr || qualifying != properties_parent()) {
                report_.not_covered.emplace_back("an object within the signature");
            } else if (only_child(qualifying, k_xades_namespace, "UnsignedProperties") != nullptr) {
                report_.not_covered.push_back(
                    "unsigned properties within the signature:" +
                    names_in(only_child(qualifying, k_xades_namespace, "UnsignedProperties")));
            }
        }
    }

    /// Of the properties of a list, "xades:SignatureTimeStamp", each once.
    static std::string names_in(const xmlNode* unsigned_properties) {
        std::string names;
        for (const xmlNode* list : children_of(unsigned_properties)) {
            for (const xmlNode* property : children_of(list)) {
                if (const std::string name = ' ' + name_of(property);
                    (names + ' ').find(name + ' ') == std::string::npos) {
                    names += name;
                }
            }
        }
        return names.empty() ? " none" : names;
    }

    [[nodiscard]] const xmlNode* properties_parent() const {
        return properties_ == nullptr ? nullptr : properties_->parent;
    }

    xmlNode* signature_;
    const std::vector<xmlNode*>& elements_;
    std::string where_;
    SignatureReport report_;
    xmlNode* properties_ = nullptr;
    std::vector<CertificateHandle> chain_;
    std::vector<Bytes> encoded_;  ///< DER of the certificates, as they stand in the document
};

}  // namespace

std::vector<SignatureReport> verify_xml(const Bytes& xml, const std::string& name, const TrustedMaterial& trusted,
                                        std::int64_t now) {
    const XmlDocument document = parse_xml(xml, name);
    xmlNode* root = xmlDocGetRootElement(document.get());
    const std::vector<xmlNode*> elements = all_elements(root);
    std::vector<xmlNode*> proper = children_of(root, k_dsig_namespace, "Signature");
    std::vector<SignatureReport> reports;
    const auto refuse = [&](const char* code, const std::string& what, const char* rule) {
        SignatureReport report;
        report.format = "XMLDSig";
        add_error(report, code, name, what, rule, k_ask_again);
        reports.push_back(std::move(report));
    };
    if (proper.size() > k_most_signatures) {
        refuse("GC-SIGN-0122", std::to_string(proper.size()) + " signatures",
               "a certificate has one signature or a few");
        return reports;
    }
    for (xmlNode* signature : proper) {
        const std::string where = name + ", signature " + std::to_string(reports.size() + 1);
        reports.push_back(XmlSignatureCheck(signature, elements, where).run(trusted, now));
    }
    const auto misplaced = [&](const xmlNode* element) {
        return is_element(element, k_dsig_namespace, "Signature") &&
               std::none_of(proper.begin(), proper.end(),
                            [&](const xmlNode* signature) { return is_inside(element, signature); });
    };
    // It covers "the whole document" by its own words, but a program may take it as the signature of the part that it
    // stands in.
    if (std::any_of(elements.begin(), elements.end(), misplaced)) {
        refuse("GC-SIGN-0119", "a signature that is not a child of the root element",
               "the signature of a digital certificate stands at the end of its root element");
    }
    return reports;
}

}  // namespace gumcert::signing
