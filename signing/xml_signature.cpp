#include <openssl/ecdsa.h>
#include <openssl/err.h>

#include <stdexcept>
#include <utility>

#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "signing/certificates.h"
#include "signing/checked_signature.h"
#include "signing/signer.h"
#include "signing/time_texts.h"
#include "signing/xml_tree.h"

namespace gumcert::signing {

namespace {

constexpr const char* k_dcc_namespace = "https://ptb.de/dcc";
// Names of the parts of a signature within the document (xs:ID).
constexpr const char* k_signature_id = "gumcert-signature";
constexpr const char* k_document_id = "gumcert-signed-document";
constexpr const char* k_properties_id = "gumcert-signed-properties";

[[noreturn]] void refuse_certificate(const char* code, std::string what, const char* rule, const char* action) {
    throw gum::InputError(
        gum::Diagnostic{.code = code, .where = "DCC", .what = std::move(what), .rule = rule, .action = action});
}

/// 3.2 was the first version whose schema has a place for a signature.
void require_version(const std::string& version) {
    const auto digit = [&](std::size_t at) { return at < version.size() && version[at] >= '0' && version[at] <= '9'; };
    const bool good = digit(0) && version.size() > 2 && version[1] == '.' && digit(2) &&
                      (version[0] > '3' || (version[0] == '3' && (version[2] >= '2' || digit(3))));
    if (!good) {
        refuse_certificate("GC-SIGN-0031", "schemaVersion " + version,
                           "the schema of a DCC has a signature from 3.2 onwards", "write the certificate as DCC 3.3");
    }
}

void require_unsigned_dcc(const XmlDocument& document) {
    const xmlNode* root = xmlDocGetRootElement(document.get());
    if (!is_element(root, k_dcc_namespace, "digitalCalibrationCertificate")) {
        refuse_certificate("GC-SIGN-0031", "the root element is not dcc:digitalCalibrationCertificate",
                           "sign_dcc signs a DCC", "name a digital calibration certificate");
    }
    require_version(attribute(root, "schemaVersion"));
    if (!children_of(root, k_dsig_namespace, "Signature").empty()) {
        refuse_certificate("GC-SIGN-0032", "it is signed already",
                           "a second signature inside would make the first invalid, for it covers the whole document",
                           "sign the document before any signature, once");
    }
}

std::string element(const char* name, const std::string& text) {
    return std::string("<") + name + '>' + text + "</" + name + '>';
}

std::string digest_elements(const std::string& value) {
    return std::string("<ds:DigestMethod Algorithm=\"") + k_sha256 + "\"/>" + element("ds:DigestValue", value);
}

std::string transform(const char* algorithm) {
    return std::string("<ds:Transform Algorithm=\"") + algorithm + "\"/>";
}

std::string signed_info(const std::string& algorithm, const std::string& document_digest,
                        const std::string& properties_digest) {
    const std::string method = algorithm == "RSA" ? "http://www.w3.org/2001/04/xmldsig-more#rsa-sha256"
                                                  : "http://www.w3.org/2001/04/xmldsig-more#ecdsa-sha256";
    return std::string("<ds:SignedInfo><ds:CanonicalizationMethod Algorithm=\"") + k_exclusive_c14n +
           "\"/><ds:SignatureMethod Algorithm=\"" + method + "\"/><ds:Reference Id=\"" + k_document_id +
           "\" URI=\"\">" + element("ds:Transforms", transform(k_enveloped) + transform(k_exclusive_c14n)) +
           digest_elements(document_digest) + "</ds:Reference><ds:Reference Type=\"" + k_signed_properties_type +
           "\" URI=\"#" + k_properties_id + "\">" + element("ds:Transforms", transform(k_exclusive_c14n)) +
           digest_elements(properties_digest) + "</ds:Reference></ds:SignedInfo>";
}

/// ETSI EN 319 132-1: what a baseline-B signature says about itself, protected by the second reference.
std::string qualifying_properties(const Signer& signer, std::int64_t signing_time) {
    return std::string("<ds:Object><xades:QualifyingProperties xmlns:xades=\"") + k_xades_namespace + "\" Target=\"#" +
           k_signature_id + "\"><xades:SignedProperties Id=\"" + k_properties_id +
           "\"><xades:SignedSignatureProperties>" + element("xades:SigningTime", time_text(signing_time)) +
           "<xades:SigningCertificateV2><xades:Cert>" +
           element("xades:CertDigest",
                   digest_elements(encoding::base64(encoding::sha256_bytes(signer.certificates().front())))) +
           "</xades:Cert></xades:SigningCertificateV2></xades:SignedSignatureProperties>"
           "<xades:SignedDataObjectProperties><xades:DataObjectFormat ObjectReference=\"#" +
           k_document_id +
           "\"><xades:MimeType>text/xml</xades:MimeType></xades:DataObjectFormat></xades:SignedDataObjectProperties>"
           "</xades:SignedProperties></xades:QualifyingProperties></ds:Object>";
}

std::string key_info(const Signer& signer) {
    std::string certificates;
    for (const Bytes& certificate : signer.certificates()) {
        certificates += element("ds:X509Certificate", encoding::base64(certificate));
    }
    return element("ds:KeyInfo", element("ds:X509Data", certificates));
}

/// XML signatures have r and s side by side, each as long as the curve (RFC 4050, 3.3), where DER has them as integers.
Bytes signature_value(const Signer& signer, const Bytes& signature) {
    if (signer.algorithm() == "RSA") {
        return signature;
    }
    const auto* at = reinterpret_cast<const unsigned char*>(signature.data());
    const Handle<ECDSA_SIG> pair(d2i_ECDSA_SIG(nullptr, &at, static_cast<long>(signature.size())));
    const std::size_t size = ecdsa_part_size(certificate_from_der(signer.certificates().front()).get());
    Bytes value(2 * size, '\0');
    auto* out = reinterpret_cast<unsigned char*>(value.data());
    const int width = static_cast<int>(size);
    if (pair == nullptr || BN_bn2binpad(ECDSA_SIG_get0_r(pair.get()), out, width) != width ||
        BN_bn2binpad(ECDSA_SIG_get0_s(pair.get()), out + width, width) != width) {
        ERR_clear_error();
        throw std::runtime_error("an ECDSA signature that was verified cannot be taken apart");
    }
    return value;
}

/// The signature as the last child of the root; every other byte of the document stays.
Bytes with_signature(const Bytes& dcc, const std::string& info, const std::string& value, const std::string& rest) {
    // The document is not written anew from its tree: blanks within tags, quotation marks and character references
    // could change, and the laboratory would sign another file than the one that it checked.
    const std::size_t end = dcc.rfind("</");
    return dcc.substr(0, end) + "<ds:Signature xmlns:ds=\"" + k_dsig_namespace + "\" Id=\"" + k_signature_id + "\">" +
           info + element("ds:SignatureValue", value) + rest + "</ds:Signature>" + dcc.substr(end);
}

const xmlNode* signature_in(const XmlDocument& document) {
    const std::vector<xmlNode*> all = children_of(xmlDocGetRootElement(document.get()));
    if (all.empty() || !is_element(all.back(), k_dsig_namespace, "Signature")) {
        refuse_certificate("GC-SIGN-0033", "the end of the root element was not found",
                           "the signature stands at the end of the root element",
                           "remove what stands behind the root element");
    }
    return all.back();
}

}  // namespace

Bytes sign_dcc(const Bytes& dcc, const Signer& signer, std::int64_t signing_time) {
    require_in_force(signer, signing_time);
    require_unsigned_dcc(parse_xml(dcc, "DCC"));
    const std::string rest = key_info(signer) + qualifying_properties(signer, signing_time);

    // The digests are of the document as it will be; the values inside of the signature do not enter them.
    const Bytes draft = with_signature(dcc, signed_info(signer.algorithm(), "", ""), "", rest);
    const XmlDocument draft_tree = parse_xml(draft, "DCC");
    const xmlNode* signature = signature_in(draft_tree);
    const xmlNode* properties = only_child(
        only_child(only_child(signature, k_dsig_namespace, "Object"), k_xades_namespace, "QualifyingProperties"),
        k_xades_namespace, "SignedProperties");
    // First the two digests, then the value: SignedInfo holds the digests, and the value is of SignedInfo. The
    // canonical form is taken from the whole tree and not from a piece of text, since the namespaces in force depend on
    // where an element stands.
    const std::string info = signed_info(
        signer.algorithm(),
        encoding::base64(encoding::sha256_bytes(exclusive_canonical_xml(draft_tree.get(), nullptr, signature))),
        encoding::base64(encoding::sha256_bytes(exclusive_canonical_xml(draft_tree.get(), properties, nullptr))));

    // The first reference leaves out the signature, the second is of the properties alone: putting the digests into
    // SignedInfo changes neither of them.
    const XmlDocument whole = parse_xml(with_signature(dcc, info, "", rest), "DCC");
    const xmlNode* whole_info = only_child(signature_in(whole), k_dsig_namespace, "SignedInfo");
    const Bytes digest = encoding::sha256_bytes(exclusive_canonical_xml(whole.get(), whole_info, nullptr));
    const Bytes value = signature_value(signer, checked_signature(signer, digest));
    return with_signature(dcc, info, encoding::base64(value), rest);
}

}  // namespace gumcert::signing
