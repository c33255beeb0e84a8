#include "reports/forms/pdf_conformity.h"

#include "reports/forms/qpdf_objects.h"

#include <cstddef>
#include <exception>
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

class Check {
public:
    Check(std::string_view bytes, std::string_view attachment) : bytes_(bytes), attachment_(attachment) {}

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
            for (Object& object : pdf_.getAllObjects()) {
                check_object(object, 0);
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

    void check_object(Object object, int depth) {
        constexpr int k_deepest = 100;  // direct objects within each other; ours have less than ten
        if (depth > k_deepest) {
            report("GC-REPORT-0020", "objects are nested too deeply", "a PDF can be read");
        } else if (object.isArray()) {
            for (Object& item : object.getArrayAsVector()) {
                check_direct(item, depth);
            }
        } else if (is_dictionary(object)) {
            Object dictionary = dictionary_of(object);
            check_dictionary(dictionary);
            if (object.isStream()) {
                check_filters(dictionary);
            }
            for (auto& [key, value] : dictionary.getDictAsMap()) {
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

    void check_dictionary(Object dictionary) {
        Object type = dictionary.getKey("/Type");
        if (is_name(type, "/Font")) {
            check_font(dictionary);
        } else if (is_name(type, "/Filespec") || dictionary.hasKey("/EF")) {
            check_file_specification(dictionary);
        }
        check_activity(dictionary, is_name(type, "/StructElem"));
        Object interpolate = dictionary.getKey("/Interpolate");
        require(!(interpolate.isBool() && interpolate.getBoolValue()), "GC-REPORT-0029", "an image is interpolated",
                "images of a PDF/A-3 are shown as they are");
    }

    void check_activity(Object dictionary, bool structure) {
        static const std::set<std::string> k_actions = {"/JavaScript",  "/Launch",    "/Movie",     "/Sound",
                                                        "/Rendition",   "/ResetForm", "/Hide",      "/ImportData",
                                                        "/SetOCGState", "/Trans",     "/GoTo3DView"};
        static const std::set<std::string> k_annotations = {"/RichMedia", "/Movie", "/Sound", "/Screen", "/3D"};
        Object action = dictionary.getKey("/S");
        if (!structure && action.isName() && k_actions.contains(action.getName())) {
            report("GC-REPORT-0028", "an action " + action.getName(), "a PDF/A-3 does nothing by itself");
        }
        Object kind = dictionary.getKey("/Subtype");
        if (kind.isName() && k_annotations.contains(kind.getName())) {
            report("GC-REPORT-0028", "an annotation " + kind.getName(), "a PDF/A-3 has no rich media");
        }
        for (const char* key : {"/JS", "/AA", "/XFA"}) {
            if (dictionary.hasKey(key)) {
                report("GC-REPORT-0028", std::string("an entry ") + key, "a PDF/A-3 does nothing by itself");
            }
        }
    }

    void check_filters(Object dictionary) {
        Object filter = dictionary.getKey("/Filter");
        std::vector<Object> filters = filter.isArray() ? filter.getArrayAsVector() : std::vector<Object>{filter};
        for (Object& one : filters) {
            if (is_name(one, "/LZWDecode") || is_name(one, "/LZW") || is_name(one, "/Crypt")) {
                report("GC-REPORT-0029", "a stream with the filter " + one.getName(),
                       "streams of a PDF/A-3 have no LZW and no encryption");
            }
        }
        require(!dictionary.hasKey("/F") || is_name(dictionary.getKey("/Type"), "/EmbeddedFile"), "GC-REPORT-0029",
                "a stream is in another file", "a PDF/A-3 is complete by itself");
    }

    void check_font(Object font) {
        Object kind = font.getKey("/Subtype");
        Object base = font.getKey("/BaseFont");
        const std::string name = base.isName() ? base.getName() : std::string("/without a name");
        // A descendant font is checked as part of its Type0 font; a Type3 font consists of drawings.
        const bool descendant = is_name(kind, "/CIDFontType0") || is_name(kind, "/CIDFontType2");
        if (!descendant && !font.hasKey("/ToUnicode")) {
            report("GC-REPORT-0026", "the font " + name + " has no ToUnicode",
                   "every character of a PDF/A-3a can be read as Unicode");
        }
        if (is_name(kind, "/Type0")) {
            Object descendants = font.getKey("/DescendantFonts");
            require(descendants.isArray() && descendants.getArrayNItems() == 1, "GC-REPORT-0026",
                    "a composite font without its one descendant", "fonts are complete");
            return;
        }
        if (is_name(kind, "/Type3")) {
            return;
        }
        Object descriptor = font.getKey("/FontDescriptor");
        const bool embedded = descriptor.isDictionary() && (descriptor.getKey("/FontFile").isStream() ||
                                                            descriptor.getKey("/FontFile2").isStream() ||
                                                            descriptor.getKey("/FontFile3").isStream());
        if (!embedded) {
            report("GC-REPORT-0026", "the font " + name + " is not inside", "a PDF/A-3 carries its fonts");
        }
    }

    void check_file_specification(Object specification) {
        require(!text_of(specification.getKey("/F")).empty() && !text_of(specification.getKey("/UF")).empty(),
                "GC-REPORT-0027", "an attachment without its name in /F and /UF", "an attachment has a name");
        require(specification.getKey("/AFRelationship").isName(), "GC-REPORT-0027",
                "an attachment without /AFRelationship", "a PDF/A-3 says how an attachment belongs to it");
        Object streams = specification.getKey("/EF");
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

}  // namespace gumcert::reports
