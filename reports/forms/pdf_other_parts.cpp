#include "reports/forms/pdf_other_parts.h"

#include "reports/forms/qpdf_objects.h"

#include <qpdf/QPDFNameTreeObjectHelper.hh>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

QPDFObjectHandle entry_of(QPDFObjectHandle dictionary, const char* key) {
    return dictionary.isDictionary() ? dictionary.getKey(key) : QPDFObjectHandle::newNull();
}

std::string name_at(QPDFObjectHandle dictionary, const char* key) {
    QPDFObjectHandle found = entry_of(std::move(dictionary), key);
    return found.isName() ? found.getName() : std::string();
}

/// Whether an action does no more than to go to a place of the document, or to open an address.
bool is_plain_action(QPDFObjectHandle action) {
    const std::string kind = name_at(action, "/S");
    return action.isNull() || action.isArray() || action.isName() || action.isString() ||
           ((kind == "/GoTo" || kind == "/URI") && !action.hasKey("/Next"));
}

/// Actions that do more than to go to a place of the document or to open an address, ISO 32000-2:2020, table 201.
bool is_other_action(const std::string& kind) {
    static constexpr std::array<std::string_view, 18> k_kinds = {
        "/GoToR",      "/GoToE",       "/GoToDp",    "/Launch",     "/Thread",     "/Sound",
        "/Movie",      "/Hide",        "/Named",     "/SubmitForm", "/ResetForm",  "/ImportData",
        "/JavaScript", "/SetOCGState", "/Rendition", "/Trans",      "/GoTo3DView", "/RichMediaExecute"};
    return std::find(k_kinds.begin(), k_kinds.end(), kind) != k_kinds.end();
}

/// The first key of a dictionary that is not listed; "" without one.
template <std::size_t N>
std::string other_key(QPDFObjectHandle dictionary, const std::array<std::string_view, N>& keys) {
    if (dictionary.isDictionary()) {
        for (const std::string& key : dictionary.getKeys()) {
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
                return key;
            }
        }
    }
    return {};
}

/// Whether an annotation has a place on the page.
bool has_place(QPDFObjectHandle annotation) {
    constexpr int k_corners = 4;
    QPDFObjectHandle place = entry_of(std::move(annotation), "/Rect");
    if (!place.isArray() || place.getArrayNItems() != k_corners) {
        return true;  // a viewer decides
    }
    std::array<double, k_corners> corner{};
    for (int i = 0; i < k_corners; ++i) {
        QPDFObjectHandle number = place.getArrayItem(i);
        if (!number.isNumber()) {
            return true;
        }
        corner.at(static_cast<std::size_t>(i)) = number.getNumericValue();
    }
    return corner[0] != corner[2] && corner[1] != corner[3];
}

/// The kind of a field, which it may have from one above it.
std::string kind_of_field(QPDFObjectHandle field) {
    constexpr int k_deepest = 32;
    std::string kind = name_at(field, "/FT");
    for (int i = 0; i < k_deepest && kind.empty(); ++i) {
        field = entry_of(field, "/Parent");
        kind = name_at(field, "/FT");
    }
    return kind;
}

class OtherParts {
public:
    explicit OtherParts(std::string_view bytes) {
        pdf_.setSuppressWarnings(true);
        pdf_.setAttemptRecovery(false);
        pdf_.processMemoryFile("PDF", bytes.data(), bytes.size());
    }

    PdfOtherParts found() {
        look_at_document(pdf_.getRoot());
        look_at_properties();
        for (const QPDFObjectHandle& object : pdf_.getAllObjects()) {
            look_at_object(object);
        }
        std::size_t number = 0;
        for (const QPDFObjectHandle& page : pdf_.getAllPages()) {
            look_at_page(page, " on page " + std::to_string(++number));
        }
        for (const QPDFExc& warning : pdf_.getWarnings()) {
            if (std::string_view(warning.what()).find("std::bad_alloc") != std::string_view::npos) {
                throw std::bad_alloc();  // says nothing of the file
            }
        }
        return std::move(parts_);
    }

private:
    QPDF pdf_;
    PdfOtherParts parts_;
    std::set<QPDFObjGen> named_files_;  // streams, of which the contents are known to whoever asks

    void tell(const char* what, QPDFObjectHandle text, bool replaces = false) {
        if (text.isString()) {
            take_text({what, text.getUTF8Value(), replaces});
        }
    }

    void take_text(PdfTextBesidePages text) {
        refuse(parts_.texts.size() >= k_most_texts, "has more than 5000 texts that no page draws");
        if (parts_.refused.empty()) {
            parts_.texts.push_back(std::move(text));
        }
    }

    /// The dictionary of properties, and the XMP of the document: what it is called, by whom, and what it is about.
    void look_at_properties() {
        QPDFObjectHandle properties = entry_of(pdf_.getTrailer(), "/Info");
        static constexpr std::array<std::string_view, 5> k_of_the_file = {"/Creator", "/Producer", "/CreationDate",
                                                                          "/ModDate", "/Trapped"};
        if (properties.isDictionary()) {
            for (const auto& [key, value] : properties.getDictAsMap()) {
                if (std::find(k_of_the_file.begin(), k_of_the_file.end(), key) == k_of_the_file.end()) {
                    tell("a property", value);
                }
            }
        }
        QPDFObjectHandle metadata = pdf_.getRoot().getKey("/Metadata");
        if (!metadata.isStream()) {
            return;
        }
        if (!metadata.getDict().getKey("/Filter").isNull()) {
            take_text({"metadata", "(packed)", false});
            return;
        }
        const std::shared_ptr<Buffer> bytes = metadata.getRawStreamData();
        const std::string_view xmp(reinterpret_cast<const char*>(bytes->getBuffer()), bytes->getSize());
        refuse(xmp.size() > k_largest_metadata, "has metadata of more than 1 MiB");
        if (xmp.size() > k_largest_metadata) {
            return;
        }
        for (const std::string_view name : {"dc:title", "dc:description", "dc:subject", "dc:creator", "dc:rights",
                                            "pdf:Keywords", "photoshop:Headline", "photoshop:Instructions"}) {
            for (std::size_t at = xmp.find(name); at != std::string_view::npos; at = xmp.find(name, at + 1)) {
                const char before = at == 0 ? ' ' : xmp[at - 1];
                const std::size_t end = before == '<' ? xmp.find("</" + std::string(name), at) : std::string_view::npos;
                if (end != std::string_view::npos) {
                    tell_xmp(xmp.substr(at, end - at));
                    at = end;
                } else if (before == '<') {
                    break;                                                   // nor has any that stands behind it an end
                } else if (xmp.substr(at + name.size()).starts_with("=")) {  // an attribute
                    const std::size_t first = xmp.find_first_of("\"'", at);
                    const std::size_t last = first == std::string_view::npos ? first : xmp.find(xmp[first], first + 1);
                    if (last != std::string_view::npos) {
                        tell_xmp('>' + std::string(xmp.substr(first + 1, last - first - 1)));
                    }
                }
            }
        }
    }

    static std::string without_entities(std::string_view text) {
        std::string plain;
        while (!text.empty()) {
            std::size_t taken = 1;
            char character = text.front();
            for (const auto& [entity, meant] :
                 {std::pair("&lt;", '<'), std::pair("&gt;", '>'), std::pair("&quot;", '"'), std::pair("&apos;", '\''),
                  std::pair("&amp;", '&')}) {
                if (text.starts_with(entity)) {
                    taken = std::string_view(entity).size();
                    character = meant;
                }
            }
            plain += character;
            text.remove_prefix(taken);
        }
        return plain;
    }

    /// The texts of an element without its tags.
    void tell_xmp(std::string_view element) {
        std::string text;
        bool is_in_tag = true;  // its own begins before
        for (const char c : element) {
            is_in_tag = c == '<' || (is_in_tag && c != '>');
            if (!is_in_tag && c != '>') {
                text += c;
            }
        }
        take_text({"metadata", without_entities(text), false});
    }

    void refuse(bool is_there, const std::string& what) {
        if (is_there && parts_.refused.empty()) {
            parts_.refused = what;
        }
    }

    void look_at_document(QPDFObjectHandle catalog) {
        refuse(!is_plain_action(entry_of(catalog, "/OpenAction")) || catalog.hasKey("/AA"),
               "has an action that begins when it is opened");
        QPDFObjectHandle names = entry_of(catalog, "/Names");
        refuse(names.isDictionary() && names.hasKey("/JavaScript"), "has JavaScript");
        refuse(entry_of(catalog, "/OCProperties").isDictionary(), "has layers, which a reader can hide");
        refuse(catalog.hasKey("/Collection"), "is a collection of files");
        QPDFObjectHandle form = entry_of(catalog, "/AcroForm");
        refuse(form.isDictionary() && form.hasKey("/XFA"), "has a form");
        QPDFObjectHandle files = entry_of(names, "/EmbeddedFiles");
        if (files.isDictionary()) {
            QPDFNameTreeObjectHelper tree(files, pdf_, false);
            for (auto file = tree.begin(); file != tree.end() && parts_.attached_files < k_most_files; ++file) {
                ++parts_.attached_files;
                // As signing reads them: the stream of the one key, or of the other one.
                QPDFObjectHandle of_file = entry_of((*file).second, "/EF");
                QPDFObjectHandle stream = entry_of(of_file, "/UF");
                stream = stream.isStream() ? stream : entry_of(of_file, "/F");
                named_files_.insert(stream.getObjGen());
            }
        }
        // What a viewer does with a document begins here: what is not listed may be anything.
        static constexpr std::array<std::string_view, 22> k_keys = {
            "/Type",     "/Version",    "/Extensions", "/Pages",         "/PageLabels",        "/Names",
            "/PageMode", "/PageLayout", "/Outlines",   "/OpenAction",    "/ViewerPreferences", "/AcroForm",
            "/Metadata", "/MarkInfo",   "/Lang",       "/OutputIntents", "/StructTreeRoot",    "/AF",
            "/DSS",      "/Perms",      "/Dests",      "/PieceInfo"};
        static constexpr std::array<std::string_view, 2> k_names = {"/Dests", "/EmbeddedFiles"};
        const std::string other = other_key(catalog, k_keys);
        refuse(!other.empty(), "has \"" + other + "\" in its catalog");
        const std::string other_name = other_key(names, k_names);
        refuse(!other_name.empty(), "has \"" + other_name + "\" among its names");
        refuse(name_at(entry_of(catalog, "/ViewerPreferences"), "/Direction") == "/R2L", "is read from right to left");
    }

    /// An object and what stands within it, not what it refers to.
    void look_at_object(const QPDFObjectHandle& object) {
        std::vector<QPDFObjectHandle> left{object};
        while (!left.empty() && parts_.refused.empty()) {
            QPDFObjectHandle one = left.back();
            left.pop_back();
            if (one.isStream()) {
                look_at_file(one, one.getDict().getKey("/Type").isNameAndEquals("/EmbeddedFile"));
                one = one.getDict();
                refuse(one.hasKey("/F"), "has a stream in another file");
            }
            std::vector<QPDFObjectHandle> within;
            if (one.isDictionary()) {
                look_at_dictionary(one);
                for (const auto& [key, value] : one.getDictAsMap()) {
                    within.push_back(value);
                }
            } else if (one.isArray()) {
                within = one.getArrayAsVector();
            }
            for (QPDFObjectHandle& value : within) {
                if (!value.isIndirect()) {
                    left.push_back(value);
                }
            }
        }
    }

    void look_at_dictionary(QPDFObjectHandle dictionary) {
        const std::string kind = name_at(dictionary, "/S");
        QPDFObjectHandle action = entry_of(dictionary, "/A");
        refuse(is_other_action(kind), "has an action \"" + (kind.empty() ? kind : kind.substr(1)) + '"');
        refuse((kind == "/GoTo" || kind == "/URI") && dictionary.hasKey("/Next"), "has an action behind another one");
        refuse(action.isDictionary() && action.hasKey("/S") && !is_plain_action(action), "has an action");
        refuse(dictionary.hasKey("/AA"), "has an action that begins by itself");
        QPDFObjectHandle script = entry_of(dictionary, "/JS");
        refuse(script.isString() || script.isStream(), "has JavaScript");
        const bool is_signature = dictionary.hasKey("/ByteRange");
        const bool is_properties = dictionary.isSameObjectAs(entry_of(pdf_.getTrailer(), "/Info"));
        if (!is_properties) {
            tell("a bookmark", entry_of(dictionary, "/Title"));
        }
        tell("a label of pages", entry_of(dictionary, "/P"));
        tell("a text in place of what is drawn", entry_of(dictionary, "/ActualText"), true);
        tell("a description", entry_of(dictionary, "/Alt"));
        tell("a description", entry_of(dictionary, "/E"));
        if (name_at(dictionary, "/Type") == "/StructElem") {
            tell("a description", entry_of(dictionary, "/T"));
        }
        if (name_at(dictionary, "/Type") == "/Annot" || dictionary.hasKey("/Subtype")) {
            tell("a description", entry_of(dictionary, "/Contents"));
            tell("a description", entry_of(dictionary, "/TU"));
        }
        for (const char* const key : {"/Reason", "/Location", "/ContactInfo"}) {
            tell("what a signature says", is_signature ? entry_of(dictionary, key) : QPDFObjectHandle::newNull());
        }
        QPDFObjectHandle files = entry_of(dictionary, "/EF");
        if (files.isDictionary()) {
            for (const auto& [key, file] : files.getDictAsMap()) {
                look_at_file(file, true);
            }
        }
        const bool is_catalog = dictionary.isSameObjectAs(pdf_.getRoot());
        refuse(!is_catalog && dictionary.hasKey("/AF") && !entry_of(dictionary, "/AF").isNull(),
               "has a file that is attached to a part of it");
    }

    void look_at_file(QPDFObjectHandle stream, bool is_file) {
        refuse(is_file && !named_files_.contains(stream.getObjGen()),
               "has an attached file that is not among those with a name");
    }

    void look_at_page(QPDFObjectHandle page, const std::string& where) {
        refuse(page.hasKey("/AA"), "has an action" + where);
        // Not those that turn a page, show a part of it, or show it in another size, nor those above it, which it takes over.
        static constexpr std::array<std::string_view, 15> k_keys = {
            "/Type",  "/Parent",  "/Resources", "/MediaBox", "/Contents",     "/StructParents", "/Annots",   "/Tabs",
            "/Group", "/TrimBox", "/BleedBox",  "/ArtBox",   "/LastModified", "/Metadata",      "/PieceInfo"};
        static constexpr std::array<std::string_view, 6> k_keys_above = {"/Type",  "/Parent",    "/Kids",
                                                                         "/Count", "/Resources", "/MediaBox"};
        const std::string other = other_key(page, k_keys);
        refuse(!other.empty(), "has \"" + other + '"' + where);
        QPDFObjectHandle above = entry_of(page, "/Parent");
        for (int i = 0; i < k_most_levels && above.isDictionary(); ++i) {
            const std::string other_above = other_key(above, k_keys_above);
            refuse(!other_above.empty(), "has \"" + other_above + "\" above" + where.substr(3));
            above = entry_of(above, "/Parent");
        }
        QPDFObjectHandle annotations = entry_of(page, "/Annots");
        for (int i = 0; annotations.isArray() && i < annotations.getArrayNItems(); ++i) {
            look_at_annotation(annotations.getArrayItem(i), where);
        }
    }

    void look_at_annotation(QPDFObjectHandle annotation, const std::string& where) {
        if (annotation.isNull()) {
            return;
        }
        const std::string kind = name_at(annotation, "/Subtype");
        refuse(!is_plain_action(entry_of(annotation, "/A")) || (annotation.isDictionary() && annotation.hasKey("/AA")),
               "has an action" + where);
        if (kind == "/Widget") {
            const bool is_signature = kind_of_field(annotation) == "/Sig";
            refuse(!is_signature, "has a field of a form" + where);
            parts_.has_drawn_signature = parts_.has_drawn_signature || (is_signature && has_place(annotation));
            return;
        }
        refuse(kind != "/Link", "has an annotation" + (kind.empty() ? "" : " \"" + kind.substr(1) + '"') + where);
        refuse(kind == "/Link" && annotation.hasKey("/AP"), "has a link with a picture of its own" + where);
    }

    static constexpr std::size_t k_most_files = 100;
    static constexpr std::size_t k_most_texts = 5000;
    static constexpr std::size_t k_largest_metadata = std::size_t{1} << 20U;
    static constexpr int k_most_levels = 32;
};

}  // namespace

PdfOtherParts other_parts_of_pdf(std::string_view pdf) {
    return OtherParts(pdf).found();
}

}  // namespace gumcert::reports
