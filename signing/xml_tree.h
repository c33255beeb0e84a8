#pragma once

#include <libxml/tree.h>
#include <libxml/xmlerror.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signing/signer.h"

namespace gumcert::signing {

inline constexpr const char* k_dsig_namespace = "http://www.w3.org/2000/09/xmldsig#";
inline constexpr const char* k_xades_namespace = "http://uri.etsi.org/01903/v1.3.2#";
inline constexpr const char* k_xades_141_namespace = "http://uri.etsi.org/01903/v1.4.1#";
inline constexpr const char* k_dsig_11_namespace = "http://www.w3.org/2009/xmldsig11#";
inline constexpr const char* k_signed_properties_type = "http://uri.etsi.org/01903#SignedProperties";
inline constexpr const char* k_exclusive_c14n = "http://www.w3.org/2001/10/xml-exc-c14n#";
inline constexpr const char* k_enveloped = "http://www.w3.org/2000/09/xmldsig#enveloped-signature";
inline constexpr const char* k_sha256 = "http://www.w3.org/2001/04/xmlenc#sha256";

struct XmlFree {
    void operator()(xmlDoc* document) const { xmlFreeDoc(document); }
};
using XmlDocument = std::unique_ptr<xmlDoc, XmlFree>;

/// Reads XML without loading anything else.
/// \param name  of the file, for messages
/// \throws gum::InputError  GC-SIGN-0030 if it is not well-formed, has a DOCTYPE, or is not in UTF-8
[[nodiscard]] XmlDocument parse_xml(const Bytes& bytes, const std::string& name);

/// Whether a node is the element of this name and namespace.
[[nodiscard]] bool is_element(const xmlNode* node, const char* name_space, const char* name);

/// Child elements, in order.
[[nodiscard]] std::vector<xmlNode*> children_of(const xmlNode* node);
/// Child elements of one name, in order.
[[nodiscard]] std::vector<xmlNode*> children_of(const xmlNode* node, const char* name_space, const char* name);
/// The only child element of that name; nullptr if there is none or more than one.
[[nodiscard]] xmlNode* only_child(const xmlNode* node, const char* name_space, const char* name);

/// Value of an attribute without namespace; "" where it is missing.
[[nodiscard]] std::string attribute(const xmlNode* node, const char* name);
[[nodiscard]] bool has_attribute(const xmlNode* node, const char* name);

/// Text of an element and all in it.
[[nodiscard]] std::string text_of(const xmlNode* node);

/// Name of an element as the document spells it: "si:value".
[[nodiscard]] std::string name_of(const xmlNode* node);

/// Whether blanks are all that a text has.
[[nodiscard]] bool is_blank(std::string_view text);

/// While it lives, libxml2 keeps what it has to say of its inputs and outputs for itself: a library never prints.
class QuietLibxml {
public:
    QuietLibxml();
    ~QuietLibxml();
    QuietLibxml(const QuietLibxml&) = delete;
    QuietLibxml& operator=(const QuietLibxml&) = delete;

private:
    xmlStructuredErrorFunc before_;
    void* context_before_;
};

/// Exclusive canonical XML 1.0 without comments (W3C, Exclusive XML Canonicalization 1.0) of the document or a part.
/// \param only     the element to take; nullptr: the document
/// \param without  the element to leave out; nullptr: none
[[nodiscard]] Bytes exclusive_canonical_xml(xmlDoc* document, const xmlNode* only, const xmlNode* without);

}  // namespace gumcert::signing
