#include "reports/forms/pdf_other_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "reports/forms/qpdf_objects.h"
#include "tests/support/written_pdf.h"

namespace gumcert::reports {
namespace {

/// A PDF of one page with entries of its own in the catalog and in the page.
std::string pdf_with_parts(const std::string& of_catalog, const std::string& of_page) {
    QPDF pdf;
    test::begin_with_page(pdf, "0 0 100 100 re S");
    const auto add = [&](QPDFObjectHandle to, const std::string& entries) {
        for (const auto& [key, value] : QPDFObjectHandle::parse(&pdf, "<< " + entries + " >>").getDictAsMap()) {
            to.replaceKey(key, value);
        }
    };
    add(pdf.getRoot(), of_catalog);
    add(pdf.getAllPages().front(), of_page);
    return test::written_pdf(pdf);
}

TEST(PdfOtherParts, OfAPlainDocumentAreNone) {
    for (const auto& [catalog, page] :
         {std::pair<const char*, const char*>{"", ""},
          {"/OpenAction [0 /Fit]", ""},
          {"/OpenAction << /S /GoTo /D [0 /Fit] >>", ""},
          {"/Names << /Dests << /Names [] >> >>", ""},
          {"/Outlines << /Type /Outlines /First << /Title (x) /Dest [0 /Fit] /Next << /Title (y) >> >> >>", ""},
          {"/Outlines << /First << /A << /S /GoTo /D [0 /Fit] >> /Next << /A << /S /URI /URI (x) >> >> >> >>", ""},
          {"/StructTreeRoot << /K << /S /P /A << /O /Layout /Placement /Block >> >> >>", ""},
          {"/ViewerPreferences << /Direction /L2R >> /Lang (en) /MarkInfo << /Marked true >> /Metadata null", ""},
          {"/AcroForm << /Fields [] /SigFlags 3 >> /DSS << >> /Extensions << >> /Version /2.0", ""},
          {"", "/Tabs /S /Group << /S /Transparency >> /StructParents 0"},
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
          "/AcroForm << /Fields [] /XFA (x) >>", "/Threads []", "/URI << /Base (x) >>", "/Requirements []",
          "/Unknown 1", "/Names << /Pages << /Names [] >> >>", "/ViewerPreferences << /Direction /R2L >>",
          "/Outlines << /First << /A << /S /GoTo /D [0 /Fit] /Next << /S /URI /URI (x) >> >> >> >>"}) {
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
          "/Annots [<< /Subtype /Link /Rect [0 0 9 9] /AP << >> >>]", "/Rotate 180", "/CropBox [0 0 1 1]",
          "/UserUnit 0.01", "/Trans << /S /Fade >>", "/Thumb << >>", "/AF []", "/Unknown 1"}) {
        EXPECT_NE(other_parts_of_pdf(pdf_with_parts("", page)).refused, "") << page;
    }
}

/// A PDF with an object more, which may be one that nothing refers to.
std::string pdf_with_object(const std::string& object, bool in_outlines) {
    QPDF pdf;
    pdf.emptyPDF();
    auto page = QPDFObjectHandle::parse("<< /Type /Page /MediaBox [0 0 595 842] /Resources << >> >>");
    pdf.addPage(pdf.makeIndirectObject(page), false);
    QPDFObjectHandle made = pdf.makeIndirectObject(QPDFObjectHandle::parse(&pdf, object));
    if (in_outlines) {
        pdf.getRoot().replaceKey("/Outlines", QPDFObjectHandle::parse(&pdf, "<< /First << /Title (x) >> >>"));
        pdf.getRoot().getKey("/Outlines").getKey("/First").replaceKey("/A", made);
    } else {
        QPDFObjectHandle first = pdf.getAllPages().front();
        first.getKey("/Resources").replaceKey("/Properties", made);
    }
    return test::written_pdf(pdf);
}

// Law: an action that does more than to go somewhere is found in whatever it stands, at whatever depth; the kinds are those of
// ISO 32000-2:2020, table 201.
TEST(PdfOtherParts, HaveNoOtherActionAnywhere) {
    for (const char* const kind :
         {"GoToR",       "GoToE",     "GoToDp", "Launch",     "Thread",           "URI",        "Sound",
          "Movie",       "Hide",      "Named",  "SubmitForm", "ResetForm",        "ImportData", "JavaScript",
          "SetOCGState", "Rendition", "Trans",  "GoTo3DView", "RichMediaExecute", "GoTo"}) {
        const std::string action = std::string("<< /S /") + kind + " /D [0 /Fit] >>";
        const bool is_plain = kind == std::string("URI") || kind == std::string("GoTo");
        for (const bool in_outlines : {true, false}) {
            std::string object = action;
            for (int depth = 0; depth < 5; ++depth) {
                const std::string refused = other_parts_of_pdf(pdf_with_object(object, in_outlines)).refused;
                EXPECT_EQ(refused.empty(), is_plain) << object << refused;
                object = depth % 2 == 0 ? "[" + object + "]" : "<< /K " + object + " >>";
            }
        }
        EXPECT_NE(other_parts_of_pdf(pdf_with_object("<< /S /GoTo /Next " + action + " >>", true)).refused, "");
        EXPECT_NE(other_parts_of_pdf(pdf_with_object("<< /AA << /O " + action + " >> >>", false)).refused, "");
    }
    EXPECT_NE(other_parts_of_pdf(pdf_with_object("<< /S /Unknown >>", true)).refused, "")
        << "what is none is none of ours";
    EXPECT_NE(other_parts_of_pdf(pdf_with_object("<< /JS (x) >>", false)).refused, "");
}

/// A PDF with a stream that is an attached file, which the catalog names or a part refers to.
std::string pdf_with_file(bool with_name, bool with_type, const std::string& entry) {
    QPDF pdf;
    pdf.emptyPDF();
    auto page = QPDFObjectHandle::parse("<< /Type /Page /MediaBox [0 0 595 842] /Resources << >> >>");
    pdf.addPage(pdf.makeIndirectObject(page), false);
    QPDFObjectHandle stream = QPDFObjectHandle::newStream(&pdf, "<x/>");
    if (with_type) {
        stream.getDict().replaceKey("/Type", QPDFObjectHandle::newName("/EmbeddedFile"));
    }
    auto files = QPDFObjectHandle::parse("<< /F (x) /EF << >> >>");
    files.getKey("/EF").replaceKey("/F", stream);
    files = pdf.makeIndirectObject(files);
    if (with_name) {
        auto names = QPDFObjectHandle::parse("<< /EmbeddedFiles << /Names [(x)] >> >>");
        names.getKey("/EmbeddedFiles").getKey("/Names").appendItem(files);
        pdf.getRoot().replaceKey("/Names", names);
    }
    if (!entry.empty()) {
        auto list = QPDFObjectHandle::newArray();
        list.appendItem(files);
        QPDFObjectHandle first = pdf.getAllPages().front();
        QPDFObjectHandle part = entry == "/Resources" ? first.getKey("/Resources") : pdf.getRoot();
        part.replaceKey("/AF", list);
    }
    return test::written_pdf(pdf);
}

// Law: every attached file is one of those with a name, of which the contents are compared.
TEST(PdfOtherParts, HaveFilesWithNamesAlone) {
    for (const bool with_type : {false, true}) {
        for (const char* const entry : {"", "/AF"}) {
            const PdfOtherParts parts = other_parts_of_pdf(pdf_with_file(true, with_type, entry));
            EXPECT_EQ(parts.refused, "") << entry;
            EXPECT_EQ(parts.attached_files, 1U) << entry;
        }
        EXPECT_NE(other_parts_of_pdf(pdf_with_file(false, with_type, "/AF")).refused, "");
        EXPECT_NE(other_parts_of_pdf(pdf_with_file(true, with_type, "/Resources")).refused, "");
    }
}

TEST(PdfOtherParts, TellTextsThatNoPageDraws) {
    struct Case {
        const char* catalog;
        const char* page;
        const char* told;
    };
    for (const Case& one :
         {Case{"/Outlines << /First << /Title (x, y) /Dest [0 /Fit] >> >>", "", "a bookmark: x, y;"},
          {"/PageLabels << /Nums [0 << /P (x) /S /D >>] >>", "", "a label of pages: x;"},
          {"/StructTreeRoot << /K << /S /P /ActualText (x) >> >>", "", "a text in place of what is drawn: x!;"},
          {"/StructTreeRoot << /K << /S /Figure /Alt <FEFF00E9> /P << >> >> >>", "", "a description: \xC3\xA9;"},
          {"/StructTreeRoot << /K << /Type /StructElem /S /P /T (x) /E (y) >> >>", "",
           "a description: y;a description: x;"},
          {"", "/Annots [<< /Subtype /Link /Rect [0 0 9 9] /Contents (x) >>]", "a description: x;"},
          {"/AcroForm << /Fields [<< /FT /Sig /T (S1) /V << /ByteRange [0 1 2 3] /Reason (x) >> >>] >>", "",
           "what a signature says: x;"},
          {"/PageMode /UseOutlines", "", ""}}) {
        std::string told;
        for (const PdfTextBesidePages& text : other_parts_of_pdf(pdf_with_parts(one.catalog, one.page)).texts) {
            told += std::string(text.what) + ": " + text.text + (text.replaces ? "!;" : ";");
        }
        EXPECT_EQ(told, one.told) << one.catalog << one.page;
    }
    QPDF pdf;
    pdf.emptyPDF();
    const std::string xmp =
        "<x:xmpmeta xmlns:dc=\"x\"><rdf:Description dc:title=\"a &amp; b\"><dc:creator><rdf:Seq><rdf:li>c</rdf:li>"
        "</rdf:Seq></dc:creator><dc:format>d</dc:format></rdf:Description></x:xmpmeta>";
    pdf.getRoot().replaceKey("/Metadata", QPDFObjectHandle::newStream(&pdf, xmp));
    pdf.getTrailer().replaceKey("/Info", pdf.makeIndirectObject(QPDFObjectHandle::parse(
                                             "<< /Title (e) /Company (f) /Producer (g) /CreationDate (h) >>")));
    QPDFWriter writer(pdf);
    writer.setOutputMemory();
    writer.setCompressStreams(false);
    writer.write();
    const auto buffer = writer.getBufferSharedPointer();
    std::vector<std::string> texts;
    for (const PdfTextBesidePages& text :
         other_parts_of_pdf({reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()}).texts) {
        texts.push_back(text.text);
    }
    std::sort(texts.begin(), texts.end());
    EXPECT_EQ(texts, (std::vector<std::string>{"a & b", "c", "e", "f"}));
}

TEST(PdfOtherParts, CountFilesAndSeeSignaturesThatAreDrawn) {
    const std::string files = "/Names << /EmbeddedFiles << /Names [(a) << /F (a) >> (b) << /F (b) >>] >> >>";
    EXPECT_EQ(other_parts_of_pdf(pdf_with_parts(files, "")).attached_files, 2U);
    const std::string drawn = "/Annots [<< /Subtype /Widget /FT /Sig /Rect [0 0 90 30] >>]";
    EXPECT_TRUE(other_parts_of_pdf(pdf_with_parts("", drawn)).has_drawn_signature);
}

}  // namespace
}  // namespace gumcert::reports
