#include "reports/dcc/xml_document.h"

#include "reports/printable_text.h"

#include <libxml/SAX2.h>
#include <libxml/parser.h>
#include <libxml/parserInternals.h>
#include <libxml/xmlerror.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <mutex>
#include <new>

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/document_limits.h"
#include "reports/view/certificate_view.h"
#include "text/markup.h"
#include "text/markup_size.h"

namespace gumcert::reports {

namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::string_view bytes_of(const xmlChar* text) {
    return text == nullptr ? std::string_view() : std::string_view(reinterpret_cast<const char*>(text));
}

std::string prefixed(std::string_view space, std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 3> k_prefixes{
        {{"https://ptb.de/dcc", "dcc:"}, {"https://ptb.de/si", "si:"}, {"http://www.w3.org/2000/09/xmldsig#", "ds:"}}};
    for (const auto& [uri, prefix] : k_prefixes) {
        if (space == uri) {
            return std::string(prefix) + std::string(name);
        }
    }
    return space.empty() ? std::string(name) : "{" + std::string(space) + "}" + std::string(name);
}

/// libxml2 hands an ampersand in an attribute over as "&#38;" as long as it does not replace entities, and leaves it to
/// its own trees to undo that.
std::string attribute_value(std::string_view text) {
    constexpr std::string_view k_ampersand = "&#38;";
    std::string out;
    std::size_t done = 0;
    for (std::size_t at = text.find(k_ampersand); at != std::string_view::npos; at = text.find(k_ampersand, done)) {
        out.append(text, done, at + 1 - done);
        done = at + k_ampersand.size();
    }
    return out.append(text, done);
}

/// What the callbacks of the parser work on. They are called from C: none lets an exception through.
struct Reading {
    xmlParserCtxtPtr parser = nullptr;
    std::string file;
    XmlElement root;
    bool has_root = false;
    std::vector<XmlElement*> open;  ///< from the root to the innermost; children of an open element do not move
    std::size_t elements = 0;
    std::vector<XmlNote>* notes = nullptr;
    std::exception_ptr failure;

    void stop(std::exception_ptr with) {
        if (!failure) {
            failure = std::move(with);
        }
        xmlStopParser(parser);
    }

    void refuse(gum::Diagnostic diagnostic) { stop(std::make_exception_ptr(gum::InputError(std::move(diagnostic)))); }

    [[nodiscard]] std::string here() const {
        return file + ":" + std::to_string(std::max(xmlSAX2GetLineNumber(parser), 0)) + ":" +
               std::to_string(std::max(xmlSAX2GetColumnNumber(parser), 0));
    }
};

/// What a callback does, as long as nothing has failed.
template <typename Work>
void proceed(void* data, const Work& work) {
    Reading& reading = *static_cast<Reading*>(data);
    if (reading.failure) {
        return;
    }
    try {
        work(reading);
    } catch (...) {
        reading.stop(std::current_exception());
    }
}

void begin_element(Reading& reading, std::string name) {
    if (reading.open.size() >= k_largest_depth || reading.elements >= k_most_elements) {
        const bool deep = reading.open.size() >= k_largest_depth;
        reading.refuse({.code = deep ? "GC-DCC-0003" : "GC-DCC-0004",
                        .where = reading.here(),
                        .what = deep ? "elements more than 64 deep" : "more than 1000000 elements",
                        .rule = "certificates are read up to 64 levels and a million elements",
                        .action = "ask the issuer for a document without deep nesting"});
        return;
    }
    ++reading.elements;
    XmlElement* element = &reading.root;
    if (!reading.open.empty()) {
        element = &reading.open.back()->children.emplace_back();
    }
    reading.has_root = true;
    reading.open.push_back(element);
    element->name = std::move(name);
    element->line = static_cast<std::size_t>(std::max(xmlSAX2GetLineNumber(reading.parser), 0));
    element->column = static_cast<std::size_t>(std::max(xmlSAX2GetColumnNumber(reading.parser), 0));
}

void on_start(void* data, const xmlChar* name, const xmlChar*, const xmlChar* uri, int, const xmlChar**,
              int attribute_count, int, const xmlChar** attributes) {
    proceed(data, [&](Reading& reading) {
        begin_element(reading, prefixed(bytes_of(uri), bytes_of(name)));
        for (int i = 0; i < attribute_count && !reading.failure; ++i) {
            // Five pointers each: name, prefix, namespace, value, end of the value.
            const xmlChar** const at = attributes + static_cast<std::ptrdiff_t>(5) * i;
            const auto* const first = reinterpret_cast<const char*>(at[3]);
            const auto* const last = reinterpret_cast<const char*>(at[4]);
            reading.open.back()->attributes.emplace_back(
                prefixed(bytes_of(at[2]), bytes_of(at[0])),
                attribute_value({first, static_cast<std::size_t>(last - first)}));
        }
    });
}

void on_end(void* data, const xmlChar*, const xmlChar*, const xmlChar*) {
    proceed(data, [](Reading& reading) {
        if (!reading.open.empty()) {
            reading.open.pop_back();
        }
    });
}

void on_text(void* data, const xmlChar* text, int length) {
    proceed(data, [&](Reading& reading) {
        if (!reading.open.empty()) {
            reading.open.back()->text.append(reinterpret_cast<const char*>(text), static_cast<std::size_t>(length));
        }
    });
}

void note(Reading& reading, std::string what) {
    if (reading.notes != nullptr) {
        const int line = xmlSAX2GetLineNumber(reading.parser);
        reading.notes->push_back({std::move(what), static_cast<std::size_t>(std::max(line, 0))});
    }
}

void on_comment(void* data, const xmlChar*) {
    proceed(data, [](Reading& reading) { note(reading, "a comment"); });
}

void on_instruction(void* data, const xmlChar* target, const xmlChar*) {
    proceed(data,
            [&](Reading& reading) { note(reading, "a processing instruction " + std::string(bytes_of(target))); });
}

void on_doctype(void* data, const xmlChar*, const xmlChar*, const xmlChar*) {
    proceed(data, [](Reading& reading) {
        reading.refuse(
            {.code = "GC-DCC-0002",
             .where = reading.here(),
             .what = "a DOCTYPE",
             .rule = "a certificate has no document type: it could name files of this computer or grow without end",
             .action = "ask the issuer for the document without the DOCTYPE"});
    });
}

xmlEntityPtr on_entity(void*, const xmlChar* name) {
    return xmlGetPredefinedEntity(name);  // &lt; &gt; &amp; &quot; &apos;
}

xmlParserInputPtr on_external(void*, const xmlChar*, const xmlChar*) {
    return nullptr;
}

void on_message(void* data, xmlErrorPtr error) {
    if (error == nullptr || error->level < XML_ERR_ERROR) {
        return;
    }
    proceed(data, [error](Reading& reading) {
        if (error->code == XML_ERR_NO_MEMORY) {
            throw std::bad_alloc();  // says nothing of the file
        }
        // Messages of the parser end with a line feed and may quote bytes of the file.
        reading.refuse(
            {.code = "GC-DCC-0001",
             .where = reading.file + ":" + std::to_string(std::max(error->line, 0)) + ":" +
                      std::to_string(std::max(error->int2, 0)),
             .what = error->message == nullptr ? "not well-formed" : printable(without_outer_blanks(error->message)),
             .rule = "a digital certificate is well-formed XML 1.0",
             .action = "ask the issuer for an undamaged file"});
    });
}

xmlSAXHandler handler() {
    xmlSAXHandler sax{};
    sax.initialized = XML_SAX2_MAGIC;  // namespaces, and messages through `serror` instead of stderr
    sax.startElementNs = on_start;
    sax.endElementNs = on_end;
    sax.characters = on_text;
    sax.cdataBlock = on_text;
    sax.comment = on_comment;
    sax.processingInstruction = on_instruction;
    sax.internalSubset = on_doctype;
    sax.getEntity = on_entity;
    sax.resolveEntity = on_external;
    sax.serror = on_message;
    return sax;
}

void start_library() {
    static std::once_flag once;
    std::call_once(once, [] { xmlInitParser(); });
}

struct FreeParser {
    void operator()(xmlParserCtxt* parser) const {
        if (parser->myDoc != nullptr) {
            xmlFreeDoc(parser->myDoc);
            parser->myDoc = nullptr;
        }
        xmlFreeParserCtxt(parser);
    }
};

gum::InputError too_large(const std::string& file, std::size_t size) {
    return gum::InputError(gum::Diagnostic{.code = "GC-DCC-0004",
                                           .where = file,
                                           .what = std::to_string(size) + " bytes",
                                           .rule = "certificates are read up to 64 MiB",
                                           .action = "ask the issuer for a document without large attachments"});
}

gum::InputError not_well_formed(const std::string& file, const std::string& what) {
    return gum::InputError(gum::Diagnostic{.code = "GC-DCC-0001",
                                           .where = file,
                                           .what = what,
                                           .rule = "a digital certificate is well-formed XML 1.0",
                                           .action = "ask the issuer for an undamaged file"});
}

/// Text as it may stand in XML 1.0: no control characters, nothing that is not UTF-8 (U+FFFD instead).
std::string writable(std::string_view text) {
    if (std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; })) {
        return std::string(text);  // nearly all texts are numbers
    }
    std::string out;
    std::size_t begin = 0;
    // printable() makes blanks of line feeds, which are meant in a text of several lines.
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        out += printable(std::string(text.substr(begin, end - begin)));
        if (end < text.size()) {
            out += '\n';
        }
        begin = end + 1;
    }
    return out;
}

}  // namespace

const XmlElement* XmlElement::child(std::string_view child_name) const {
    const auto found =
        std::find_if(children.begin(), children.end(), [&](const XmlElement& e) { return e.name == child_name; });
    return found == children.end() ? nullptr : &*found;
}

std::vector<const XmlElement*> XmlElement::children_named(std::string_view child_name) const {
    std::vector<const XmlElement*> found;
    for (const XmlElement& e : children) {
        if (e.name == child_name) {
            found.push_back(&e);
        }
    }
    return found;
}

std::string XmlElement::child_text(std::string_view child_name) const {
    const XmlElement* const found = child(child_name);
    return found == nullptr ? "" : found->trimmed();
}

std::string XmlElement::attribute(std::string_view attribute_name) const {
    const auto found = std::find_if(attributes.begin(), attributes.end(),
                                    [&](const auto& attribute) { return attribute.first == attribute_name; });
    return found == attributes.end() ? "" : found->second;
}

std::string XmlElement::trimmed() const {
    return without_outer_blanks(text);
}

XmlElement read_xml(std::string_view bytes, const std::string& file, std::vector<XmlNote>* notes) {
    if (bytes.size() > k_largest_document) {
        throw too_large(file, bytes.size());
    }
    if (bytes.empty()) {
        throw not_well_formed(file, "an empty file");
    }
    if (text::markup_size(bytes).most_in_tag > k_most_attributes) {  // libxml2 compares each of them with all before it
        throw gum::InputError(gum::Diagnostic{.code = "GC-DCC-0004",
                                              .where = file,
                                              .what = "a tag of more than 64 attributes",
                                              .rule = "certificates are read up to 64 attributes in a tag",
                                              .action = "ask the issuer for a document in the form of the DCC schema"});
    }
    start_library();
    const std::unique_ptr<xmlParserCtxt, FreeParser> parser(
        xmlCreateMemoryParserCtxt(bytes.data(), static_cast<int>(bytes.size())));
    if (!parser) {
        throw std::bad_alloc();  // the parser cannot be started: there is no other reason
    }
    Reading reading;
    reading.parser = parser.get();
    reading.file = file;
    reading.notes = notes;
    // Set before the callbacks: the parser changes some of them by its options. Never NOENT, DTDLOAD, DTDATTR, XINCLUDE
    // or HUGE.
    xmlCtxtUseOptions(parser.get(), XML_PARSE_NONET);
    *parser->sax = handler();
    parser->userData = &reading;
    xmlParseDocument(parser.get());
    if (reading.failure) {
        std::rethrow_exception(reading.failure);
    }
    if (parser->wellFormed == 0 || !reading.has_root) {
        throw not_well_formed(file, "not well-formed");
    }
    return std::move(reading.root);
}

std::string place_of(const XmlElement& element, const std::string& file) {
    return file + ":" + std::to_string(element.line) + ":" + std::to_string(element.column);
}

std::vector<std::string> xml_list(std::string_view text) {
    std::vector<std::string> words;
    std::size_t at = 0;
    while (at < text.size()) {
        if (is_blank(text[at])) {
            ++at;
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && !is_blank(text[end])) {
            ++end;
        }
        words.emplace_back(text.substr(at, end - at));
        at = end;
    }
    return words;
}

std::string without_outer_blanks(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_blank(text.back())) {
        text.remove_suffix(1);
    }
    return std::string(text);
}

XmlWriter::XmlWriter() : out_("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n") {}

void XmlWriter::start_tag(const std::string& name, const Attributes& attributes) {
    out_.append(2 * open_.size(), ' ');
    out_ += "<" + name;
    for (const auto& [key, value] : attributes) {
        if (!value.empty()) {
            out_ += " " + key + "=\"";
            out_ += text::escaped_markup(printable(value));
            out_ += "\"";
        }
    }
    out_ += ">";
}

void XmlWriter::open(const std::string& name, const Attributes& attributes) {
    start_tag(name, attributes);
    out_ += "\n";
    open_.push_back(name);
}

void XmlWriter::close() {
    const std::string name = open_.back();
    open_.pop_back();
    out_.append(2 * open_.size(), ' ');
    out_ += "</" + name + ">\n";
}

void XmlWriter::element(const std::string& name, const std::string& text, const Attributes& attributes) {
    start_tag(name, attributes);
    out_ += text::escaped_markup(writable(text));
    out_ += "</" + name + ">\n";
}

std::string XmlWriter::take() {
    return std::move(out_);
}

}  // namespace gumcert::reports
