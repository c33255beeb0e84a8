#include "reports/forms/pdf_conformity.h"

#include "reports/forms/pdf_page_texts.h"
#include "reports/forms/qpdf_objects.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using Object = QPDFObjectHandle;

// The rules are those of ISO 19005-3 (PDF/A-3), level A, that can be seen in the structure of a file.
constexpr const char* k_action = "report this as a defect, and use HTML meanwhile";

bool is_name(Object object, std::string_view name) {
    return object.isNameAndEquals(std::string(name));
}

bool is_dictionary(Object object) {
    return object.isDictionary() || object.isStream();
}

/// The dictionary of a dictionary or stream.
Object dictionary_of(Object object) {
    return object.isStream() ? object.getDict() : object;
}

std::string text_of(Object object) {
    return object.isString() ? object.getUTF8Value() : std::string();
}

/// Whether an object is an element of the structure in its plainest form: names, numbers, references, short texts, lists and
/// dictionaries of them, no key twice, and none of the keys that Check asks for. Nineteen in twenty objects of a tagged
/// document are such elements, and the reader takes most of its time for them. What is written in any other way, or not
/// well, is left to it.
class PlainElement {
public:
    /// \param bytes  of the file from the place of the object on
    static bool is_at(std::string_view bytes, QPDFObjGen number) {
        PlainElement element(bytes);
        return element.takes(std::to_string(number.getObj())) && element.takes(std::to_string(number.getGen())) &&
               element.takes("obj") && element.is_dictionary(0) && element.is_element_ && element.takes("endobj");
    }

private:
    explicit PlainElement(std::string_view bytes) : rest_(bytes) {}

    void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \n\r"), rest_.size())); }

    static bool is_regular(char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
               c == '_';
    }

    /// The regular characters that stand next, behind blanks; "" where there is none.
    std::string_view word() {
        skip_blanks();
        std::size_t length = 0;
        while (length < rest_.size() && is_regular(rest_[length])) {
            ++length;
        }
        const std::string_view taken = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return taken;
    }
    bool takes(std::string_view expected) { return word() == expected; }
    bool takes_sign(std::string_view sign) {
        skip_blanks();
        const bool is_there = rest_.starts_with(sign);
        rest_.remove_prefix(is_there ? sign.size() : 0);
        return is_there;
    }

    bool is_dictionary(int depth) {
        // An action, a font, a file or an image would be told by one of these.
        static constexpr std::array<std::string_view, 9> k_asked_for{"Subtype", "EF",          "JS",     "AA", "XFA",
                                                                     "F",       "Interpolate", "Filter", ""};
        std::vector<std::string_view> keys;
        if (!takes_sign("<<")) {
            return false;
        }
        while (!takes_sign(">>")) {
            if (!takes_sign("/")) {
                return false;
            }
            const std::string_view key = word();
            const auto is_key = [&](std::string_view other) { return key == other; };
            if (std::any_of(k_asked_for.begin(), k_asked_for.end(), is_key) ||
                std::any_of(keys.begin(), keys.end(), is_key) || (depth > 0 && (key == "Type" || key == "S"))) {
                return false;
            }
            keys.push_back(key);
            if (key == "Type") {
                is_element_ = takes_sign("/") && takes("StructElem");
                if (!is_element_) {
                    return false;
                }
            } else if (!is_value(depth + 1)) {
                return false;
            }
        }
        return true;
    }

    bool is_value(int depth) {
        constexpr int k_deepest = 8;
        skip_blanks();
        if (rest_.empty() || depth > k_deepest) {
            return false;
        }
        if (rest_.starts_with("<<")) {
            return is_dictionary(depth);
        }
        if (takes_sign("[")) {
            while (!takes_sign("]")) {
                if (!is_value(depth + 1)) {
                    return false;
                }
            }
            return true;
        }
        if (takes_sign("/")) {
            return !word().empty();
        }
        if (takes_sign("(")) {
            const std::size_t end = rest_.find_first_of("()\\");
            const bool is_text = end != std::string_view::npos && rest_[end] == ')';
            rest_.remove_prefix(is_text ? end + 1 : 0);
            return is_text;
        }
        return is_number(word());
    }

    /// A number; of a reference, three words: the others are taken, too.
    bool is_number(std::string_view text) {
        const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
        const std::size_t point = std::min(digits.find('.'), digits.size());
        const auto are_digits = [](std::string_view part) {
            return std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
        };
        if (digits.size() <= (point < digits.size() ? 1U : 0U) || digits.size() > 20 ||
            !are_digits(digits.substr(0, point)) || !are_digits(digits.substr(std::min(point + 1, digits.size())))) {
            return false;
        }
        const std::string_view before = rest_;
        const std::string_view generation = word();
        if (generation.empty() || !are_digits(generation) || !takes("R")) {
            rest_ = before;
        }
        return true;
    }

    std::string_view rest_;
    bool is_element_ = false;
};

class Check {
public:
    Check(std::string_view bytes, std::string_view attachment) : bytes_(bytes), attachment_(attachment) {}

    [[nodiscard]] QPDF& pdf() { return pdf_; }

    std::vector<gum::Diagnostic> findings() {
        check_frame();
        try {
            pdf_.setSuppressWarnings(true);
            pdf_.setAttemptRecovery(false);
            pdf_.processMemoryFile("PDF", bytes_.data(), bytes_.size());
            check_trailer();
            Object catalog = pdf_.getRoot();
            check_metadata(catalog);
            check_output_intent(catalog);
            check_reading(catalog);
            for (const auto& [number, place] : pdf_.getXRefTable()) {
                const bool has_place = place.getType() == 1 && place.getOffset() > 0 &&
                                       static_cast<std::size_t>(place.getOffset()) < bytes_.size();
                if (!has_place ||
                    !PlainElement::is_at(bytes_.substr(static_cast<std::size_t>(place.getOffset())), number)) {
                    check_object(pdf_.getObject(number), 0);
                }
            }
            check_annotations();
            check_attachment(catalog);
            for (const QPDFExc& warning : pdf_.getWarnings()) {
                // qpdf goes on where an allocation failed; what it reads then is not what was written.
                if (std::string_view(warning.what()).find("std::bad_alloc") != std::string_view::npos) {
                    throw std::bad_alloc();
                }
                report("GC-REPORT-0020", warning.what(), "a PDF is read without warnings");
            }
        } catch (const std::bad_alloc&) {
            throw;  // says nothing about the PDF
        } catch (const std::exception& failure) {
            report("GC-REPORT-0020", std::string("cannot be read: ") + failure.what(), "a PDF can be read");
        }
        return std::move(findings_);
    }

private:
    void report(const char* code, std::string what, std::string rule) {
        // The same fault in a hundred fonts is one finding.
        if (seen_.insert(code + what).second) {
            findings_.push_back(gum::Diagnostic{
                .code = code, .where = "PDF", .what = std::move(what), .rule = std::move(rule), .action = k_action});
        }
    }

    void require(bool kept, const char* code, const char* what, const char* rule) {
        if (!kept) {
            report(code, what, rule);
        }
    }

    void check_frame() {
        const auto high = [&](std::size_t at) { return static_cast<unsigned char>(bytes_[at]) > 127; };
        const bool good = bytes_.size() > 14 && bytes_.starts_with("%PDF-1.") && bytes_[7] >= '0' && bytes_[7] <= '7' &&
                          bytes_[8] == '\n' && bytes_[9] == '%' && high(10) && high(11) && high(12) && high(13);
        require(good, "GC-REPORT-0021", "the header is not %PDF-1.n with a comment of four bytes above 127",
                "a PDF/A-3 starts so");
        std::string_view end = bytes_.substr(bytes_.size() < 6 ? 0 : bytes_.size() - 6);
        while (end.ends_with('\n') || end.ends_with('\r')) {
            end.remove_suffix(1);
        }
        require(end.ends_with("%%EOF"), "GC-REPORT-0021", "there is something behind the mark of its end",
                "a PDF/A-3 ends with %%EOF");
    }

    void check_trailer() {
        Object trailer = pdf_.getTrailer();
        Object id = trailer.getKey("/ID");
        const bool good = id.isArray() && id.getArrayNItems() == 2 && id.getArrayItem(0).isString() &&
                          id.getArrayItem(1).isString() && !id.getArrayItem(0).getStringValue().empty();
        require(good, "GC-REPORT-0022", "no identifier /ID", "a PDF/A-3 has an identifier");
        require(!trailer.hasKey("/Encrypt"), "GC-REPORT-0023", "encrypted", "a PDF/A-3 is not encrypted");
    }

    void check_metadata(Object catalog) {
        Object metadata = catalog.getKey("/Metadata");
        if (!metadata.isStream()) {
            report("GC-REPORT-0024", "no XMP metadata", "a PDF/A-3 says what it is in XMP");
            return;
        }
        require(!metadata.getDict().hasKey("/Filter"), "GC-REPORT-0024", "the XMP metadata are compressed",
                "metadata of a PDF/A-3 can be read without decoding");
        const std::shared_ptr<Buffer> data = metadata.getRawStreamData();
        const std::string xmp(reinterpret_cast<const char*>(data->getBuffer()), data->getSize());
        const auto states = [&](const std::string& name, const std::string& value) {
            return xmp.find("<pdfaid:" + name + ">" + value + "</pdfaid:" + name + ">") != std::string::npos ||
                   xmp.find("pdfaid:" + name + "=\"" + value + '"') != std::string::npos;
        };
        require(states("part", "3"), "GC-REPORT-0024", "the XMP metadata do not say part 3",
                "a PDF/A-3 says its part of ISO 19005");
        require(states("conformance", "A"), "GC-REPORT-0024", "the XMP metadata do not say conformance A",
                "a PDF/A-3a says its level of conformance");
        require(xmp.find("<dc:title>") != std::string::npos, "GC-REPORT-0031", "no title in the XMP metadata",
                "a document has a title");
    }

    void check_output_intent(Object catalog) {
        Object intents = catalog.getKey("/OutputIntents");
        bool found = false;
        for (int i = 0; intents.isArray() && i < intents.getArrayNItems(); ++i) {
            Object intent = intents.getArrayItem(i);
            if (!intent.isDictionary() || !is_name(intent.getKey("/S"), "/GTS_PDFA1")) {
                continue;
            }
            Object profile = intent.getKey("/DestOutputProfile");
            Object components = profile.isStream() ? profile.getDict().getKey("/N") : Object::newNull();
            found = components.isInteger() && components.getIntValue() == 3;
        }
        require(found, "GC-REPORT-0025", "no output intent GTS_PDFA1 with a colour profile of three components",
                "colours of a PDF/A-3 are defined by a profile inside");
    }

    /// What a reader aloud, or a search, needs.
    void check_reading(Object catalog) {
        Object info = pdf_.getTrailer().getKey("/Info");
        require(info.isDictionary() && !text_of(info.getKey("/Title")).empty(), "GC-REPORT-0031", "no title",
                "a document has a title");
        require(!text_of(catalog.getKey("/Lang")).empty(), "GC-REPORT-0031", "no language",
                "a PDF/A-3a names its language");
        Object marks = catalog.getKey("/MarkInfo");
        Object marked = marks.isDictionary() ? marks.getKey("/Marked") : Object::newNull();
        require(marked.isBool() && marked.getBoolValue() && catalog.getKey("/StructTreeRoot").isDictionary(),
                "GC-REPORT-0031", "not tagged", "a PDF/A-3a has the structure of its content");
    }

    using Entries = std::map<std::string, Object>;

    /// A document has thousands of objects, most of them of its structure: each is unpacked once.
    void check_object(Object object, int depth) {
        constexpr int k_deepest = 100;  // direct objects within each other; ours have less than ten
        if (depth > k_deepest) {
            report("GC-REPORT-0020", "objects are nested too deeply", "a PDF can be read");
        } else if (object.isArray()) {
            for (Object& item : object.getArrayAsVector()) {
                check_direct(item, depth);
            }
        } else if (is_dictionary(object)) {
            Entries entries = dictionary_of(object).getDictAsMap();
            check_dictionary(entries);
            if (object.isStream()) {
                check_filters(entries);
            }
            for (auto& [key, value] : entries) {
                check_direct(value, depth);
            }
        }
    }

    /// Indirect objects are visited by themselves.
    void check_direct(Object& value, int depth) {
        if (!value.isIndirect() && (value.isArray() || value.isDictionary())) {
            check_object(value, depth + 1);
        }
    }

    /// Null where it is not there, or is null, which is the same.
    static Object entry(Entries& entries, const std::string& key) {
        static const Object k_null = Object::newNull();
        const auto found = entries.find(key);
        return found == entries.end() ? k_null : found->second;
    }
    static bool has_entry(Entries& entries, const std::string& key) {
        const auto found = entries.find(key);
        return found != entries.end() && !found->second.isNull();
    }

    void check_dictionary(Entries& entries) {
        Object type = entry(entries, "/Type");
        if (is_name(type, "/Font")) {
            check_font(entries);
        } else if (is_name(type, "/Filespec") || has_entry(entries, "/EF")) {
            check_file_specification(entries);
        }
        check_activity(entries, is_name(type, "/StructElem"));
        Object interpolate = entry(entries, "/Interpolate");
        require(!(interpolate.isBool() && interpolate.getBoolValue()), "GC-REPORT-0029", "an image is interpolated",
                "images of a PDF/A-3 are shown as they are");
    }

    void check_activity(Entries& entries, bool structure) {
        static const std::set<std::string> k_actions = {"/JavaScript",  "/Launch",    "/Movie",     "/Sound",
                                                        "/Rendition",   "/ResetForm", "/Hide",      "/ImportData",
                                                        "/SetOCGState", "/Trans",     "/GoTo3DView"};
        static const std::set<std::string> k_annotations = {"/RichMedia", "/Movie", "/Sound", "/Screen", "/3D"};
        Object action = entry(entries, "/S");
        if (!structure && action.isName() && k_actions.contains(action.getName())) {
            report("GC-REPORT-0028", "an action " + action.getName(), "a PDF/A-3 does nothing by itself");
        }
        Object kind = entry(entries, "/Subtype");
        if (kind.isName() && k_annotations.contains(kind.getName())) {
            report("GC-REPORT-0028", "an annotation " + kind.getName(), "a PDF/A-3 has no rich media");
        }
        for (const char* key : {"/JS", "/AA", "/XFA"}) {
            if (has_entry(entries, key)) {
                report("GC-REPORT-0028", std::string("an entry ") + key, "a PDF/A-3 does nothing by itself");
            }
        }
    }

    void check_filters(Entries& entries) {
        Object filter = entry(entries, "/Filter");
        std::vector<Object> filters = filter.isArray() ? filter.getArrayAsVector() : std::vector<Object>{filter};
        for (Object& one : filters) {
            if (is_name(one, "/LZWDecode") || is_name(one, "/LZW") || is_name(one, "/Crypt")) {
                report("GC-REPORT-0029", "a stream with the filter " + one.getName(),
                       "streams of a PDF/A-3 have no LZW and no encryption");
            }
        }
        require(!has_entry(entries, "/F") || is_name(entry(entries, "/Type"), "/EmbeddedFile"), "GC-REPORT-0029",
                "a stream is in another file", "a PDF/A-3 is complete by itself");
    }

    void check_font(Entries& font) {
        Object kind = entry(font, "/Subtype");
        Object base = entry(font, "/BaseFont");
        const std::string name = base.isName() ? base.getName() : std::string("/without a name");
        // A descendant font is checked as part of its Type0 font; a Type3 font consists of drawings.
        const bool descendant = is_name(kind, "/CIDFontType0") || is_name(kind, "/CIDFontType2");
        if (!descendant && !has_entry(font, "/ToUnicode")) {
            report("GC-REPORT-0026", "the font " + name + " has no ToUnicode",
                   "every character of a PDF/A-3a can be read as Unicode");
        }
        if (is_name(kind, "/Type0")) {
            Object descendants = entry(font, "/DescendantFonts");
            require(descendants.isArray() && descendants.getArrayNItems() == 1, "GC-REPORT-0026",
                    "a composite font without its one descendant", "fonts are complete");
            return;
        }
        if (is_name(kind, "/Type3")) {
            return;
        }
        Object descriptor = entry(font, "/FontDescriptor");
        const bool embedded = descriptor.isDictionary() && (descriptor.getKey("/FontFile").isStream() ||
                                                            descriptor.getKey("/FontFile2").isStream() ||
                                                            descriptor.getKey("/FontFile3").isStream());
        if (!embedded) {
            report("GC-REPORT-0026", "the font " + name + " is not inside", "a PDF/A-3 carries its fonts");
        }
    }

    void check_file_specification(Entries& specification) {
        require(!text_of(entry(specification, "/F")).empty() && !text_of(entry(specification, "/UF")).empty(),
                "GC-REPORT-0027", "an attachment without its name in /F and /UF", "an attachment has a name");
        require(entry(specification, "/AFRelationship").isName(), "GC-REPORT-0027",
                "an attachment without /AFRelationship", "a PDF/A-3 says how an attachment belongs to it");
        Object streams = entry(specification, "/EF");
        Object stream = streams.isDictionary() ? streams.getKey("/F") : Object::newNull();
        require(stream.isStream() && stream.getDict().getKey("/Subtype").isName(), "GC-REPORT-0027",
                "an attachment without MIME type", "a PDF/A-3 says what an attachment is");
    }

    void check_annotations() {
        for (Object page : pdf_.getAllPages()) {
            Object annotations = page.getKey("/Annots");
            for (int i = 0; annotations.isArray() && i < annotations.getArrayNItems(); ++i) {
                Object annotation = annotations.getArrayItem(i);
                if (!annotation.isDictionary() || is_name(annotation.getKey("/Subtype"), "/Popup")) {
                    continue;
                }
                constexpr long long k_print = 4;
                constexpr long long k_unseen = 1 | 2 | 32;  // invisible, hidden, not viewed
                Object flags = annotation.getKey("/F");
                const long long set = flags.isInteger() ? flags.getIntValue() : 0;
                require((set & k_print) != 0 && (set & k_unseen) == 0, "GC-REPORT-0030",
                        "an annotation that is not printed or not seen",
                        "annotations of a PDF/A-3 are seen and printed");
            }
        }
    }

    void check_attachment(Object catalog) {
        QPDFEmbeddedFileDocumentHelper helper(pdf_);
        const auto files = helper.getEmbeddedFiles();
        if (attachment_.empty()) {
            require(files.empty(), "GC-REPORT-0027", "a file is attached", "nothing was to be attached");
            return;
        }
        if (files.size() != 1) {
            report("GC-REPORT-0027", std::to_string(files.size()) + " files are attached",
                   "the digital certificate is attached, and nothing else");
            return;
        }
        Object specification = files.begin()->second->getObjectHandle();
        Object associated = catalog.getKey("/AF");
        bool listed = false;
        for (int i = 0; associated.isArray() && i < associated.getArrayNItems(); ++i) {
            listed = listed || associated.getArrayItem(i).getObjGen() == specification.getObjGen();
        }
        require(listed, "GC-REPORT-0027", "the attachment is not listed in /AF of the document",
                "an attachment belongs to the document");
        Object stream = files.begin()->second->getEmbeddedFileStream();
        bool same = false;
        if (stream.isStream()) {
            require(is_name(stream.getDict().getKey("/Subtype"), "/application/xml") ||
                        is_name(stream.getDict().getKey("/Subtype"), "/text/xml"),
                    "GC-REPORT-0027", "the attachment is not said to be XML",
                    "a digital certificate is application/xml");
            const std::shared_ptr<Buffer> data = stream.getStreamData(qpdf_dl_all);
            same = std::string_view(reinterpret_cast<const char*>(data->getBuffer()), data->getSize()) == attachment_;
        }
        require(same, "GC-REPORT-0027", "the attached file is not the digital certificate, byte for byte",
                "the attachment is the digital certificate itself");
    }

    std::string_view bytes_;
    std::string_view attachment_;
    QPDF pdf_;
    std::set<std::string> seen_;
    std::vector<gum::Diagnostic> findings_;
};

}  // namespace

std::vector<gum::Diagnostic> check_pdf(std::string_view pdf, std::string_view attachment) {
    return Check(pdf, attachment).findings();
}

CheckedPdf check_and_read_pdf(std::string_view pdf, std::string_view attachment) {
    Check check(pdf, attachment);
    CheckedPdf checked{.findings = check.findings(), .page_texts = {}};
    if (checked.findings.empty()) {
        checked.page_texts = texts_of_pages(check.pdf());
    }
    return checked;
}

}  // namespace gumcert::reports
