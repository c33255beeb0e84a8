#include "reports/forms/pdf_other_parts.h"

#include "reports/forms/qpdf_objects.h"

#include <qpdf/QPDFNameTreeObjectHelper.hh>

#include <array>
#include <new>
#include <set>
#include <string>
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
            }
        }
    }

    void look_at_page(QPDFObjectHandle page, const std::string& where) {
        refuse(page.hasKey("/AA"), "has an action" + where);
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
};

}  // namespace

PdfOtherParts other_parts_of_pdf(std::string_view pdf) {
    return OtherParts(pdf).found();
}

}  // namespace gumcert::reports
