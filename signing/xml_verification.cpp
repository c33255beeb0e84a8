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
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "signing/certificates.h"
#include "signing/document_limits.h"
#include "signing/document_verification.h"
#include "signing/time_texts.h"
#include "signing/xml_algorithms.h"
#include "signing/xml_own_parts.h"
#include "signing/xml_tree.h"
#include "text/counts.h"

namespace gumcert::signing {

namespace {

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

constexpr const char* k_own_parts_alone =
    "a signature holds nothing but its own parts, so that nothing in it can be taken for what was signed";
constexpr std::size_t k_most_named = 20;  // namespaces or identifiers, in a report

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
        check_values_of_own_parts(trusted);
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
            error("GC-SIGN-0112", text::count_of(document_references, "reference") + " to the whole document",
                  "exactly one reference has URI=\"\", so that nothing else can be taken for what was signed");
        }
        if (const std::string foreign = foreign_part(signature_, covered(), used_); !foreign.empty()) {
            error("GC-SIGN-0120", foreign + " within the signature is not covered by it", k_own_parts_alone);
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
        is_exclusive_ = is_exclusive_ || (transforms.size() == 2 && transforms[1] == k_exclusive_c14n);
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

    [[nodiscard]] CoveredParts covered() const {
        return {only_child(signature_, k_dsig_namespace, "SignedInfo"), properties_};
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
        certificates_in(signature_, covered(), k_dsig_namespace, "X509Certificate", chain_, encoded_);
        if (chain_.empty()) {
            error("GC-SIGN-0115", "no certificate of the signer in it",
                  "the signature brings the certificate of the signer (KeyInfo/X509Data/X509Certificate)");
            return;
        }
        if (properties_ != nullptr) {
            choose_by_digest();
        }
        // Those of the unsigned properties come behind: none of them is the signer's.
        certificates_in(signature_, covered(), k_xades_namespace, "EncapsulatedX509Certificate", chain_, encoded_);
        if (chain_.size() > k_most_certificates) {
            error("GC-SIGN-0124", text::count_of(chain_.size(), "certificate"), k_chain_alone);
            chain_.resize(1);
        }
    }

    /// What the signature leaves out of what it covers is of the signer: keys, certificates, lists and names.
    void check_values_of_own_parts(const TrustedMaterial& trusted) {
        if (chain_.empty()) {
            return;
        }
        const SignerChain chain(chain_, trusted.certificates);
        if (const std::string foreign = foreign_value(signature_, covered(), chain); !foreign.empty()) {
            error("GC-SIGN-0120", foreign + " within the signature is not covered by it", k_own_parts_alone);
        }
        unproven_ = unproven_values(signature_, covered(), chain);
    }

    /// Declarations that nothing uses are no part of exclusive canonical XML. (Those within the signature foreign_part() refuses.)
    [[nodiscard]] std::set<std::string> unused_namespaces() const {
        std::set<std::string> unused;
        for (const xmlNode* element : elements_) {
            for (const xmlNs* declared = element->nsDef; declared != nullptr; declared = declared->next) {
                if (!used_.contains(declared) && !is_inside(element, signature_)) {
                    unused.insert(shown_namespace(declared));
                }
            }
        }
        return unused;
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
        const auto listed = [&](const std::string& what, const auto& names) {
            std::size_t told = 0;
            for (const std::string& name : names) {
                report_.not_covered.push_back(what + (told == k_most_named ? "more of them" : name));
                if (told++ == k_most_named) {
                    break;
                }
            }
        };
        if (is_exclusive_) {
            listed("a namespace that nothing uses: ", unused_namespaces());
        }
        listed("an identifier within the signature: ", identifiers_in(signature_, covered()));
        listed("of a certificate that nothing that is trusted vouches for: ", unproven_);
        if (const std::size_t lists = revocation_lists_in(signature_, covered()); lists > 0) {
            report_.not_covered.push_back(lists == 1 ? "a list of revoked certificates within the signature"
                                                     : text::count_of(lists, "list") +
                                                           " of revoked certificates within the signature");
        }
        std::size_t objects = 0;
        for (const xmlNode* object : children_of(signature_, k_dsig_namespace, "Object")) {
            const xmlNode* qualifying = only_child(object, k_xades_namespace, "QualifyingProperties");
            if (qualifying == nullptr || qualifying != properties_parent()) {
                ++objects;
            } else if (only_child(qualifying, k_xades_namespace, "UnsignedProperties") != nullptr) {
                report_.not_covered.push_back(
                    "unsigned properties within the signature:" +
                    names_in(only_child(qualifying, k_xades_namespace, "UnsignedProperties")));
            }
        }
        if (objects > 0) {
            report_.not_covered.push_back(objects == 1 ? "an object within the signature"
                                                       : text::count_of(objects, "object") + " within the signature");
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
    UsedNamespaces used_ = used_namespaces(elements_);
    bool is_exclusive_ = false;          ///< the canonical form of the document
    std::vector<std::string> unproven_;  ///< values of certificates that nobody vouches for
    std::vector<Bytes> encoded_;         ///< DER of the certificates, as they stand in the document
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
        refuse("GC-SIGN-0122", text::count_of(proper.size(), "signature"), "a certificate has one signature or a few");
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
