#include "workbook/xml_events.h"

#include <libxml/SAX2.h>
#include <libxml/parser.h>
#include <libxml/parserInternals.h>
#include <libxml/xmlerror.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <new>

#include "gum/quantity/diagnostic.h"
#include "text/markup_size.h"
#include "text/utf8.h"
#include "text/visible_text.h"
#include "workbook/limits.h"

namespace gumcert::workbook {

namespace {

constexpr std::size_t k_most_attributes = 64;

std::string_view unprefixed(const xmlChar* name) {
    const std::string_view whole(reinterpret_cast<const char*>(name));
    const std::size_t colon = whole.rfind(':');
    return colon == std::string_view::npos ? whole : whole.substr(colon + 1);
}

/// libxml2 hands an ampersand in an attribute over as "&#38;" as long as it does not replace entities, and leaves it to
/// its own trees to undo that.
std::string with_ampersands(std::string text) {
    constexpr std::string_view k_ampersand = "&#38;";
    std::size_t found = text.find(k_ampersand);
    if (found == std::string::npos) {
        return text;
    }
    std::string out;
    std::size_t done = 0;
    for (; found != std::string::npos; found = text.find(k_ampersand, done)) {
        out.append(text, done, found + 1 - done);
        done = found + k_ampersand.size();
    }
    return out.append(text, done);
}

/// What the callbacks of the parser work on. They are called from C: none lets an exception through.
struct XmlReading {
    xmlParserCtxtPtr parser = nullptr;
    const std::string* where = nullptr;
    XmlHandler* handler = nullptr;
    XmlAttributes attributes;
    std::exception_ptr failure;

    void stop(std::exception_ptr with) {
        if (!failure) {
            failure = std::move(with);
        }
        xmlStopParser(parser);
    }

    void refuse(gum::Diagnostic diagnostic) { stop(std::make_exception_ptr(gum::InputError(std::move(diagnostic)))); }

    [[nodiscard]] std::string here() const {
        return *where + ":" + std::to_string(std::max(xmlSAX2GetLineNumber(parser), 0)) + ":" +
               std::to_string(std::max(xmlSAX2GetColumnNumber(parser), 0));
    }
};

XmlReading& xml_reading_of(void* data) {
    return *static_cast<XmlReading*>(data);
}

template <typename Tell>
void tell(XmlReading& reading, const Tell& what) {
    if (reading.failure) {
        return;
    }
    try {
        what();
    } catch (...) {
        reading.stop(std::current_exception());
    }
}

void on_xml_start(void* data, const xmlChar* name, const xmlChar** attributes) {
    XmlReading& reading = xml_reading_of(data);
    tell(reading, [&] {
        if (reading.handler->path.size() >= k_deepest_nesting) {
            reading.refuse({.code = "GC-WORKBOOK-0009",
                            .where = reading.here(),
                            .what = "elements more than 64 deep",
                            .rule = "parts of a workbook are at most 64 levels deep, with 64 attributes in a tag",
                            .action = "store the workbook again with a spreadsheet program"});
            return;
        }
        reading.attributes.clear();
        for (const xmlChar** at = attributes; at != nullptr && *at != nullptr; at += 2) {
            reading.attributes.add(unprefixed(at[0]),
                                   with_ampersands(at[1] == nullptr ? "" : reinterpret_cast<const char*>(at[1])));
        }
        reading.handler->path.push_back(unprefixed(name));
        reading.handler->start(reading.handler->path.back(), reading.attributes);
    });
}

void on_xml_end(void* data, const xmlChar*) {
    XmlReading& reading = xml_reading_of(data);
    tell(reading, [&] {
        if (!reading.handler->path.empty()) {
            reading.handler->end(reading.handler->path.back());
            reading.handler->path.pop_back();
        }
    });
}

void on_xml_text(void* data, const xmlChar* text, int length) {
    XmlReading& reading = xml_reading_of(data);
    tell(reading, [&] {
        reading.handler->text({reinterpret_cast<const char*>(text), static_cast<std::size_t>(length)});
    });
}

void on_xml_doctype(void* data, const xmlChar*, const xmlChar*, const xmlChar*) {
    XmlReading& reading = xml_reading_of(data);
    tell(reading, [&] {
        reading.refuse(
            {.code = "GC-WORKBOOK-0008",
             .where = reading.here(),
             .what = "a DOCTYPE",
             .rule =
                 "a part of a workbook has no document type: it could name files of this computer or grow without end",
             .action = "store the workbook again with a spreadsheet program"});
    });
}

xmlEntityPtr on_xml_entity(void*, const xmlChar* name) {
    return xmlGetPredefinedEntity(name);  // &lt; &gt; &amp; &quot; &apos;
}

xmlParserInputPtr on_xml_external(void*, const xmlChar*, const xmlChar*) {
    return nullptr;
}

gum::Diagnostic not_well_formed_part(const std::string& where, const std::string& what) {
    return {.code = "GC-WORKBOOK-0007",
            .where = where,
            .what = what,
            .rule = "parts of a workbook are well-formed XML 1.0 in UTF-8",
            .action = "ask for an undamaged file, or store the workbook again with a spreadsheet program"};
}

gum::Diagnostic not_well_formed_by(const xmlError* error, const std::string& where) {
    if (error == nullptr || error->message == nullptr) {
        return not_well_formed_part(where, "not well-formed");
    }
    // Messages of the parser end with a line feed and may quote bytes of the file.
    std::string what = error->message;
    while (!what.empty() && (what.back() == '\n' || what.back() == ' ')) {
        what.pop_back();
    }
    return not_well_formed_part(
        where + ":" + std::to_string(std::max(error->line, 0)) + ":" + std::to_string(std::max(error->int2, 0)),
        text::visible(what, 200));
}

xmlSAXHandler xml_event_handler() {
    xmlSAXHandler sax{};
    // The first form of the interface: names are handed over as they stand. Whose namespace they are of costs a search
    // through all that are declared, for each of them, and every part has one. No message goes to stderr, for there is no
    // function for it; the last one is asked for at the end.
    sax.initialized = 1;
    sax.startElement = on_xml_start;
    sax.endElement = on_xml_end;
    sax.characters = on_xml_text;
    sax.cdataBlock = on_xml_text;
    sax.internalSubset = on_xml_doctype;
    sax.getEntity = on_xml_entity;
    sax.resolveEntity = on_xml_external;
    return sax;
}

struct FreeXmlParser {
    void operator()(xmlParserCtxt* parser) const {
        if (parser->myDoc != nullptr) {
            xmlFreeDoc(parser->myDoc);
            parser->myDoc = nullptr;
        }
        xmlFreeParserCtxt(parser);
    }
};

}  // namespace

const std::string& XmlAttributes::value(std::string_view name) const {
    static const std::string k_none;
    const auto found = std::find_if(items_.begin(), items_.end(), [&](const auto& item) { return item.first == name; });
    return found == items_.end() ? k_none : found->second;
}

bool XmlAttributes::is_true(std::string_view name) const {
    const std::string& said = value(name);
    return said == "1" || said == "true" || said == "on";
}

void read_xml_events(std::string_view bytes, const std::string& where, XmlHandler& handler) {
    if (bytes.starts_with("\xEF\xBB\xBF")) {
        bytes.remove_prefix(3);
    }
    if (bytes.empty() || bytes.find('\0') != std::string_view::npos || !text::is_utf8(bytes)) {
        throw gum::InputError(not_well_formed_part(where, bytes.empty() ? "an empty part" : "bytes that are no UTF-8"));
    }
    if (text::markup_size(bytes).most_in_tag > k_most_attributes) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-WORKBOOK-0009",
                            .where = where,
                            .what = "a tag of more than 64 attributes",
                            .rule = "parts of a workbook are at most 64 levels deep, with 64 attributes in a tag",
                            .action = "store the workbook again with a spreadsheet program"});
    }
    static std::once_flag once;
    std::call_once(once, [] { xmlInitParser(); });
    const std::unique_ptr<xmlParserCtxt, FreeXmlParser> parser(
        xmlCreateMemoryParserCtxt(bytes.data(), static_cast<int>(bytes.size())));
    if (!parser) {
        throw std::bad_alloc();  // the parser cannot be started: there is no other reason
    }
    XmlReading reading;
    reading.parser = parser.get();
    reading.where = &where;
    reading.handler = &handler;
    handler.path.clear();
    // Set before the callbacks: the parser changes some of them by its options. Never NOENT, DTDLOAD, DTDATTR, XINCLUDE
    // or HUGE. The encoding that a part declares is not believed: its bytes were looked at.
    xmlCtxtUseOptions(parser.get(), XML_PARSE_NONET | XML_PARSE_IGNORE_ENC);
    *parser->sax = xml_event_handler();
    parser->userData = &reading;
    xmlParseDocument(parser.get());
    handler.path.clear();
    if (reading.failure) {
        std::rethrow_exception(reading.failure);
    }
    const xmlError* const error = xmlCtxtGetLastError(parser.get());
    if (parser->errNo == XML_ERR_NO_MEMORY || (error != nullptr && error->code == XML_ERR_NO_MEMORY)) {
        throw std::bad_alloc();  // says nothing of the part
    }
    if (parser->wellFormed == 0) {
        throw gum::InputError(not_well_formed_by(error, where));
    }
}

}  // namespace gumcert::workbook
