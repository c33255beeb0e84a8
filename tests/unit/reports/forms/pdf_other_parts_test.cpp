#include "reports/forms/pdf_other_parts.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "reports/forms/qpdf_objects.h"

namespace gumcert::reports {
namespace {

/// A PDF of one page with entries of its own in the catalog and in the page.
std::string pdf_with_parts(const std::string& of_catalog, const std::string& of_page) {
    QPDF pdf;
    pdf.emptyPDF();
    auto page = QPDFObjectHandle::parse("<< /Type /Page /MediaBox [0 0 595 842] /Resources << >> >>");
    page.replaceKey("/Contents", QPDFObjectHandle::newStream(&pdf, "0 0 100 100 re S"));
    pdf.addPage(pdf.makeIndirectObject(page), false);
    const auto add = [&](QPDFObjectHandle to, const std::string& entries) {
        for (const auto& [key, value] : QPDFObjectHandle::parse(&pdf, "<< " + entries + " >>").getDictAsMap()) {
            to.replaceKey(key, value);
        }
    };
    add(pdf.getRoot(), of_catalog);
    add(pdf.getAllPages().front(), of_page);
    QPDFWriter writer(pdf);
    writer.setOutputMemory();
    writer.setStaticID(true);
    writer.write();
    const auto buffer = writer.getBufferSharedPointer();
    return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

TEST(PdfOtherParts, OfAPlainDocumentAreNone) {
    for (const auto& [catalog, page] :
         {std::pair<const char*, const char*>{"", ""},
          {"/OpenAction [0 /Fit]", ""},
          {"/OpenAction << /S /GoTo /D [0 /Fit] >>", ""},
          {"/Names << /Dests << /Names [] >> >>", ""},
          {"", "/Annots []"},
          {"", "/Annots [<< /Subtype /Link /Rect [0 0 9 9] /A << /S /URI /URI (x) >> >>]"},
          {"", "/Annots [<< /Subtype /Link /Rect [0 0 9 9] /Dest [0 /Fit] >>]"},
          {"", "/Annots [<< /Subtype /Widget /FT /Sig /Rect [0 0 0 0] >>]"}}) {
        const PdfOtherParts parts = other_parts_of_pdf(pdf_with_parts(catalog, page));
        EXPECT_EQ(parts.refused, "") << catalog << page;
        EXPECT_EQ(parts.attached_files, 0U);
        EXPECT_FALSE(parts.has_drawn_signature) << catalog << page;
    }
}

// Each of these may show something else than the contents of the page.
TEST(PdfOtherParts, AreToldWhereTheyMayShowSomethingElse) {
    for (const char* const catalog :
         {"/OpenAction << /S /JavaScript /JS (x) >>", "/OpenAction << /S /Launch >>", "/AA << >>",
          "/OpenAction << /S /GoTo /D [0 /Fit] /Next << /S /JavaScript /JS (x) >> >>",
          "/Names << /JavaScript << /Names [] >> >>", "/OCProperties << /OCGs [] >>", "/Collection << >>",
          "/AcroForm << /Fields [] /XFA (x) >>"}) {
        EXPECT_NE(other_parts_of_pdf(pdf_with_parts(catalog, "")).refused, "") << catalog;
    }
    for (const char* const kind : {"Stamp", "FreeText", "Text", "Square", "Highlight", "Ink", "Redact",
                                   "FileAttachment", "Screen", "Movie", "RichMedia", "Watermark", "Popup", "Unknown"}) {
        const std::string page = std::string("/Annots [<< /Subtype /") + kind + " /Rect [0 0 9 9] >>]";
        EXPECT_NE(other_parts_of_pdf(pdf_with_parts("", page)).refused, "") << kind;
    }
    for (const char* const page :
         {"/AA << /O << /S /JavaScript /JS (x) >> >>", "/Annots [<< /Subtype /Widget /FT /Tx /Rect [0 0 9 9] >>]",
          "/Annots [<< /Subtype /Widget /Parent << /FT /Btn >> /Rect [0 0 0 0] >>]", "/Annots [<< /Rect [0 0 9 9] >>]",
          "/Annots [<< /Subtype /Link /Rect [0 0 9 9] /A << /S /JavaScript /JS (x) >> >>]",
          "/Annots [<< /Subtype /Link /Rect [0 0 9 9] /AP << >> >>]"}) {
        EXPECT_NE(other_parts_of_pdf(pdf_with_parts("", page)).refused, "") << page;
    }
}

TEST(PdfOtherParts, CountFilesAndSeeSignaturesThatAreDrawn) {
    const std::string files = "/Names << /EmbeddedFiles << /Names [(a) << /F (a) >> (b) << /F (b) >>] >> >>";
    EXPECT_EQ(other_parts_of_pdf(pdf_with_parts(files, "")).attached_files, 2U);
    const std::string drawn = "/Annots [<< /Subtype /Widget /FT /Sig /Rect [0 0 90 30] >>]";
    EXPECT_TRUE(other_parts_of_pdf(pdf_with_parts("", drawn)).has_drawn_signature);
}

}  // namespace
}  // namespace gumcert::reports
