#include "signing/xml_tree.h"

#include <libxml/c14n.h>
#include <libxml/parser.h>
#include <libxml/xmlIO.h>

#include <climits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "gum/quantity/diagnostic.h"
#include "signing/document_limits.h"
#include "text/file_guess.h"
#include "text/markup_size.h"

namespace gumcert::signing {

namespace {

const xmlChar* xml(const char* text) {
    return reinterpret_cast<const xmlChar*>(text);
}
std::string_view view(const xmlChar* text) {
    return text == nullptr ? std::string_view() : std::string_view(reinterpret_cast<const char*>(text));
}

struct XmlTextFree {
    void operator()(xmlChar* text) const { xmlFree(text); }
};
using XmlText = std::unique_ptr<xmlChar, XmlTextFree>;

struct ParserFree {
    void operator()(xmlParserCtxt* parser) const { xmlFreeParserCtxt(parser); }
};

[[noreturn]] void refuse(const std::string& name, const std::string& what, const char* rule,
                         const std::string& action) {
    throw gum::InputError(
        gum::Diagnostic{.code = "GC-SIGN-0030", .where = name, .what = what, .rule = rule, .action = action});
}

struct Part {
    const xmlNode* only;
    const xmlNode* without;
};

/// Called by libxml2 for each node; for attributes and namespaces with their element as `parent`.
int is_in_part(void* user_data, xmlNodePtr node, xmlNodePtr parent) {
    const Part& part = *static_cast<const Part*>(user_data);
    const bool of_an_element = node->type == XML_NAMESPACE_DECL || node->type == XML_ATTRIBUTE_NODE;
    bool in = part.only == nullptr;
    for (const xmlNode* at = of_an_element ? parent : node; at != nullptr; at = at->parent) {
        if (at == part.without) {
            return 0;
        }
        in = in || at == part.only;
    }
    return in ? 1 : 0;
}

}  // namespace

XmlDocument parse_xml(const Bytes& bytes, const std::string& name) {
    if (bytes.size() > INT_MAX) {
        refuse(name, "larger than 2 GB", "a document is read whole", "attach large files beside the certificate");
    }
    const std::optional<text::FileGuess> guess = text::guess_file(bytes);
    if (guess && guess->form != text::FileGuess::Form::xml) {
        refuse(name, "it is " + guess->what + ", and no XML", "a digital certificate is XML 1.0 with namespaces",
               guess->action);
    }
    const text::MarkupSize size = text::markup_size(bytes);
    if (size.most_in_tag > k_most_in_tag || size.tags + size.attributes > k_most_parts) {
        refuse(name,
               size.most_in_tag > k_most_in_tag ? "a tag of more than 64 attributes"
                                                : "more than 2000000 tags and attributes",
               "a digital certificate has at most 64 attributes in a tag, and two million tags and attributes",
               "ask for the document without what is no certificate");
    }
    const QuietLibxml quiet;
    const std::unique_ptr<xmlParserCtxt, ParserFree> parser(xmlNewParserCtxt());
    XmlDocument document(parser == nullptr
                             ? nullptr
                             : xmlCtxtReadMemory(parser.get(), bytes.data(), static_cast<int>(bytes.size()), nullptr,
                                                 nullptr, XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING));
    // A prefix without its namespace is well-formed XML 1.0, but means nothing to those who read by namespaces.
    if (document == nullptr || parser->nsWellFormed == 0 || xmlDocGetRootElement(document.get()) == nullptr) {
        const xmlError* error = xmlGetLastError();
        if (parser == nullptr || (error != nullptr && error->code == XML_ERR_NO_MEMORY)) {
            throw std::bad_alloc();  // says nothing of the document
        }
        const std::string line = error == nullptr ? "" : ":" + std::to_string(error->line);
        xmlResetLastError();
        refuse(name + line, "not well-formed XML", "a digital certificate is XML 1.0 with namespaces",
               "ask for the file again");
    }
    if (document->intSubset != nullptr || document->extSubset != nullptr) {
        refuse(name, "it has a DOCTYPE", "what is signed must not depend on declarations and entities",
               "ask for a document without DOCTYPE");
    }
    const std::string_view encoding = view(document->encoding);
    if (!encoding.empty() && encoding != "UTF-8" && encoding != "utf-8" && encoding != "US-ASCII") {
        refuse(name, "its encoding is not UTF-8", "digital certificates are written in UTF-8",
               "convert it before signing");
    }
    return document;
}

bool is_element(const xmlNode* node, const char* name_space, const char* name) {
    return node != nullptr && node->type == XML_ELEMENT_NODE && view(node->name) == name && node->ns != nullptr &&
           view(node->ns->href) == name_space;
}

std::vector<xmlNode*> children_of(const xmlNode* node) {
    std::vector<xmlNode*> all;
    for (xmlNode* child = node == nullptr ? nullptr : node->children; child != nullptr; child = child->next) {
        if (child->type == XML_ELEMENT_NODE) {
            all.push_back(child);
        }
    }
    return all;
}

std::vector<xmlNode*> children_of(const xmlNode* node, const char* name_space, const char* name) {
    std::vector<xmlNode*> all;
    for (xmlNode* child : children_of(node)) {
        if (is_element(child, name_space, name)) {
            all.push_back(child);
        }
    }
    return all;
}

xmlNode* only_child(const xmlNode* node, const char* name_space, const char* name) {
    const std::vector<xmlNode*> all = children_of(node, name_space, name);
    return all.size() == 1 ? all.front() : nullptr;
}

std::string attribute(const xmlNode* node, const char* name) {
    const XmlText value(node == nullptr ? nullptr : xmlGetNoNsProp(node, xml(name)));
    return std::string(view(value.get()));
}

bool has_attribute(const xmlNode* node, const char* name) {
    const XmlText value(node == nullptr ? nullptr : xmlGetNoNsProp(node, xml(name)));
    return value != nullptr;
}

std::string text_of(const xmlNode* node) {
    const XmlText value(node == nullptr ? nullptr : xmlNodeGetContent(node));
    return std::string(view(value.get()));
}

std::string name_of(const xmlNode* node) {
    const std::string_view prefix = node->ns == nullptr ? std::string_view() : view(node->ns->prefix);
    return std::string(prefix) + (prefix.empty() ? "" : ":") + std::string(view(node->name));
}

bool is_blank(std::string_view text) {
    return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

QuietLibxml::QuietLibxml() : before_(xmlStructuredError), context_before_(xmlStructuredErrorContext) {
    xmlSetStructuredErrorFunc(nullptr, [](void* /*context*/, xmlErrorPtr /*error*/) {});
}

QuietLibxml::~QuietLibxml() {
    xmlSetStructuredErrorFunc(context_before_, before_);
}

Bytes exclusive_canonical_xml(xmlDoc* document, const xmlNode* only, const xmlNode* without) {
    const QuietLibxml quiet;
    Part part{.only = only, .without = without};
    xmlOutputBuffer* const buffer = xmlAllocOutputBuffer(nullptr);
    const int size = buffer == nullptr
                         ? -1
                         : xmlC14NExecute(document, is_in_part, &part, XML_C14N_EXCLUSIVE_1_0, nullptr, 0, buffer);
    Bytes bytes;
    if (size >= 0) {
        bytes.assign(reinterpret_cast<const char*>(xmlOutputBufferGetContent(buffer)), xmlOutputBufferGetSize(buffer));
    }
    if (buffer != nullptr) {
        xmlOutputBufferClose(buffer);
    }
    if (size < 0) {
        throw std::runtime_error("libxml2 could not bring the document into canonical form");
    }
    return bytes;
}

}  // namespace gumcert::signing
