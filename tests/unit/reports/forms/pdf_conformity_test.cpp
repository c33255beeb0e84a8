#include "reports/forms/pdf_conformity.h"
#include "reports/forms/pdf_page_texts.h"
#include "reports/forms/qpdf_objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {
namespace {

using Object = QPDFObjectHandle;

const std::string k_attachment = "<dcc/>";

Object stream(QPDF& pdf, const std::string& dictionary, const std::string& data) {
    Object made = Object::newStream(&pdf, data);
    made.replaceDict(Object::parse(dictionary));
    made.replaceStreamData(data, Object::newNull(), Object::newNull());
    return made;
}

std::string xmp(const std::string& part = "3", const std::string& conformance = "A") {
    return "<x:xmpmeta><dc:title>Certificate</dc:title><pdfaid:part>" + part + "</pdfaid:part><pdfaid:conformance>" +
           conformance + "</pdfaid:conformance></x:xmpmeta>";
}

/// A small document with everything that is looked for, for the tests to damage.
struct Sample {
    QPDF pdf;
    Object root, page, font, descriptor, specification, file;

    Sample() {
        pdf.emptyPDF();
        root = pdf.getRoot();
        page =
            pdf.makeIndirectObject(Object::parse("<< /Type /Page /MediaBox [0 0 595 842] /Annots [ << /Type /Annot "
                                                 "/Subtype /Link /Rect [0 0 1 1] /F 4 >> ] >>"));
        pdf.addPage(page, true);
        page = pdf.getAllPages().at(0);
        root.replaceKey("/Lang", Object::newString("en"));
        root.replaceKey("/MarkInfo", Object::parse("<< /Marked true >>"));
        root.replaceKey("/StructTreeRoot", Object::parse("<< /Type /StructTreeRoot >>"));
        root.replaceKey("/Metadata", stream(pdf, "<< /Type /Metadata /Subtype /XML >>", xmp()));
        Object intent = Object::parse("<< /Type /OutputIntent /S /GTS_PDFA1 >>");
        intent.replaceKey("/DestOutputProfile", stream(pdf, "<< /N 3 >>", "profile"));
        root.replaceKey("/OutputIntents", Object::newArray({intent}));
        Object info = Object::newDictionary();
        info.replaceKey("/Title", Object::newString("Certificate"));
        pdf.getTrailer().replaceKey("/Info", pdf.makeIndirectObject(info));
        add_font();
        add_attachment();
    }

    void add_font() {
        descriptor = pdf.makeIndirectObject(Object::parse("<< /Type /FontDescriptor >>"));
        descriptor.replaceKey("/FontFile3", stream(pdf, "<< /Subtype /CIDFontType0C >>", "font"));
        Object part = Object::parse("<< /Type /Font /Subtype /CIDFontType0 /BaseFont /ABCDEF+Serif >>");
        part.replaceKey("/FontDescriptor", descriptor);
        font = pdf.makeIndirectObject(Object::parse("<< /Type /Font /Subtype /Type0 /BaseFont /ABCDEF+Serif >>"));
        font.replaceKey("/DescendantFonts", Object::newArray({pdf.makeIndirectObject(part)}));
        font.replaceKey("/ToUnicode", stream(pdf, "<< >>", "map"));
        page.replaceKey("/Resources", Object::parse("<< /Font << >> >>"));
        page.getKey("/Resources").getKey("/Font").replaceKey("/F1", font);
    }

    void add_attachment() {
        file = stream(pdf, "<< /Type /EmbeddedFile /Subtype /application#2fxml >>", k_attachment);
        specification = pdf.makeIndirectObject(Object::parse(
            "<< /Type /Filespec /F (certificate.xml) /UF (certificate.xml) /AFRelationship /Source /EF << >> >>"));
        specification.getKey("/EF").replaceKey("/F", file);
        specification.getKey("/EF").replaceKey("/UF", file);
        root.replaceKey("/AF", Object::newArray({specification}));
        root.replaceKey("/Names", Object::parse("<< /EmbeddedFiles << /Names [] >> >>"));
        Object names = root.getKey("/Names").getKey("/EmbeddedFiles").getKey("/Names");
        names.appendItem(Object::newString("certificate.xml"));
        names.appendItem(specification);
    }

    std::string bytes() {
        QPDFWriter writer(pdf);
        writer.setOutputMemory();
        writer.setStaticID(true);
        writer.setStreamDataMode(qpdf_s_preserve);
        writer.setMinimumPDFVersion("1.7");
        writer.write();
        const auto buffer = writer.getBufferSharedPointer();
        return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
    }
};

std::vector<std::string> codes(const std::string& pdf, const std::string& attachment = k_attachment) {
    std::vector<std::string> all;
    for (const gum::Diagnostic& finding : check_pdf(pdf, attachment)) {
        EXPECT_EQ(finding.severity, gum::Severity::error);
        EXPECT_FALSE(finding.rule.empty());
        all.push_back(finding.code + ": " + finding.what);
    }
    return all;
}

TEST(PdfConformity, ASoundDocumentHasNoFindings) {
    Sample sample;
    EXPECT_THAT(codes(sample.bytes()), testing::IsEmpty());
}

struct Damage {
    std::string name;
    std::string code;
    std::function<void(Sample&)> apply;
};

void PrintTo(const Damage& damage, std::ostream* out) {
    *out << damage.name;
}

class PdfConformityDamage : public testing::TestWithParam<Damage> {};

TEST_P(PdfConformityDamage, IsFoundAndIsTheOnlyFinding) {
    Sample sample;
    GetParam().apply(sample);
    const std::vector<std::string> found = codes(sample.bytes());
    ASSERT_EQ(found.size(), 1U) << testing::PrintToString(found);
    EXPECT_THAT(found[0], testing::StartsWith(GetParam().code));
}

void set(Object object, const std::string& key, const std::string& value) {
    object.replaceKey(key, Object::parse(value));
}

const std::vector<Damage> k_damages = {
    {"NoMetadata", "GC-REPORT-0024", [](Sample& s) { s.root.removeKey("/Metadata"); }},
    {"Part2", "GC-REPORT-0024",
     [](Sample& s) { s.root.replaceKey("/Metadata", stream(s.pdf, "<< /Type /Metadata >>", xmp("2"))); }},
    {"ConformanceB", "GC-REPORT-0024",
     [](Sample& s) { s.root.replaceKey("/Metadata", stream(s.pdf, "<< /Type /Metadata >>", xmp("3", "B"))); }},
    {"NoIntent", "GC-REPORT-0025", [](Sample& s) { s.root.removeKey("/OutputIntents"); }},
    {"IntentOfFourColours", "GC-REPORT-0025",
     [](Sample& s) {
         set(s.root.getKey("/OutputIntents").getArrayItem(0).getKey("/DestOutputProfile").getDict(), "/N", "4");
     }},
    {"NoToUnicode", "GC-REPORT-0026", [](Sample& s) { s.font.removeKey("/ToUnicode"); }},
    {"NoFontFile", "GC-REPORT-0026", [](Sample& s) { s.descriptor.removeKey("/FontFile3"); }},
    {"StandardFont", "GC-REPORT-0026",
     [](Sample& s) {
         s.page.getKey("/Resources")
             .getKey("/Font")
             .replaceKey("/F2", Object::parse("<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /ToUnicode 1 >>"));
     }},
    {"NoRelationship", "GC-REPORT-0027", [](Sample& s) { s.specification.removeKey("/AFRelationship"); }},
    {"NoUnicodeName", "GC-REPORT-0027", [](Sample& s) { s.specification.removeKey("/UF"); }},
    {"NoName", "GC-REPORT-0027", [](Sample& s) { set(s.specification, "/F", "()"); }},
    {"NotAssociated", "GC-REPORT-0027", [](Sample& s) { s.root.removeKey("/AF"); }},
    {"AttachmentIsText", "GC-REPORT-0027", [](Sample& s) { set(s.file.getDict(), "/Subtype", "/text#2fplain"); }},
    {"OtherAttachment", "GC-REPORT-0027",
     [](Sample& s) { s.file.replaceStreamData("<dcc />", Object::newNull(), Object::newNull()); }},
    {"NotAttached", "GC-REPORT-0027", [](Sample& s) { s.root.removeKey("/Names"); }},
    {"JavaScript", "GC-REPORT-0028",
     [](Sample& s) { set(s.root, "/OpenAction", "<< /Type /Action /S /JavaScript >>"); }},
    {"Launch", "GC-REPORT-0028", [](Sample& s) { set(s.root, "/OpenAction", "<< /S /Launch /Win << >> >>"); }},
    {"AdditionalActions", "GC-REPORT-0028", [](Sample& s) { set(s.page, "/AA", "<< >>"); }},
    {"RichMedia", "GC-REPORT-0028",
     [](Sample& s) { set(s.page, "/Annots", "[ << /Subtype /RichMedia /Rect [0 0 1 1] /F 4 >> ]"); }},
    {"Lzw", "GC-REPORT-0029",
     [](Sample& s) {
         s.page.replaceKey("/Contents", Object::newStream(&s.pdf));
         s.page.getKey("/Contents")
             .replaceStreamData("\x80\x0b\x60\x50\x22\x0c\x0c\x85\x01", Object::newName("/LZWDecode"),
                                Object::newNull());
     }},
    {"ExternalStream", "GC-REPORT-0029",
     [](Sample& s) { s.page.replaceKey("/Contents", stream(s.pdf, "<< /F (other.bin) >>", "")); }},
    {"Interpolation", "GC-REPORT-0029",
     [](Sample& s) {
         set(s.page.getKey("/Resources"), "/XObject", "<< >>");
         s.page.getKey("/Resources")
             .getKey("/XObject")
             .replaceKey("/I", stream(s.pdf, "<< /Type /XObject /Subtype /Image /Interpolate true >>", "x"));
     }},
    {"NotPrinted", "GC-REPORT-0030",
     [](Sample& s) { set(s.page, "/Annots", "[ << /Subtype /Link /Rect [0 0 1 1] >> ]"); }},
    {"Hidden", "GC-REPORT-0030",
     [](Sample& s) { set(s.page, "/Annots", "[ << /Subtype /Link /Rect [0 0 1 1] /F 6 >> ]"); }},
    {"NoTitle", "GC-REPORT-0031", [](Sample& s) { s.pdf.getTrailer().getKey("/Info").removeKey("/Title"); }},
    {"NoLanguage", "GC-REPORT-0031", [](Sample& s) { s.root.removeKey("/Lang"); }},
    {"NotTagged", "GC-REPORT-0031", [](Sample& s) { s.root.removeKey("/StructTreeRoot"); }},
    {"Unmarked", "GC-REPORT-0031", [](Sample& s) { set(s.root, "/MarkInfo", "<< /Marked false >>"); }},
};

INSTANTIATE_TEST_SUITE_P(Each, PdfConformityDamage, testing::ValuesIn(k_damages),
                         [](const auto& test) { return test.param.name; });

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string with_element(const std::string& element) {
    Sample sample;
    Object made = sample.pdf.makeIndirectObject(Object::parse(element));
    sample.root.getKey("/StructTreeRoot").replaceKey("/K", Object::newArray({made}));
    return sample.bytes();
}

// Elements of the structure in their plainest form are not read one by one; in any other form they are.
TEST(PdfConformity, ElementsOfTheStructureDoNothing) {
    const std::string begin = "<< /Type /StructElem /S /TD /K [1 2 -3.5] /ID (element-7) ";
    for (const char* plain : {">>", "/A [<< /O /Layout /Placement /Block /BorderColor [0 0 .5] >> << /O /Table >>] >>",
                              "/Alt (an \\(other\\) text) >>", "/K2 << /Type /MCR /MCID 3 >> >>"}) {
        EXPECT_THAT(codes(with_element(begin + plain)), testing::IsEmpty()) << plain;
    }
    for (const auto& [active, code] : std::initializer_list<std::pair<const char*, const char*>>{
             {"/AA << >> >>", "GC-REPORT-0028"},
             {"/A << /O /Layout /JS (x) >> >>", "GC-REPORT-0028"},
             {"/A [[<< /S /JavaScript >>]] >>", "GC-REPORT-0028"},
             {"/A << /Subtype /RichMedia >> >>", "GC-REPORT-0028"},
             {"/Interpolate true >>", "GC-REPORT-0029"},
             {"/EF << >> >>", "GC-REPORT-0027"},
             {"/A << /Type /Font /Subtype /Type1 /ToUnicode 0 >> >>", "GC-REPORT-0026"}}) {
        const std::vector<std::string> found = codes(with_element(begin + active));
        ASSERT_FALSE(found.empty()) << active;
        EXPECT_THAT(found[0], testing::StartsWith(code)) << active;
    }
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string bytes = with_element(begin + ">>");
        return codes(bytes.replace(bytes.find(from), from.size(), to));
    };
    EXPECT_THAT(changed("/ID (element-7)", "/#4aS (ment-7) "), testing::Contains(testing::StartsWith("GC-REPORT-0028")))
        << "a name may be written otherwise";
    EXPECT_THAT(changed("(element-7)", "(element-7 "), testing::Contains(testing::StartsWith("GC-REPORT-0020")));
    EXPECT_THAT(changed("/ID (element-7)", "/S /TH /A null "), testing::Contains(testing::StartsWith("GC-REPORT-0020")))
        << "a key that is there twice";
}

TEST(PdfConformity, TextsAreThoseOfThePages) {
    Sample sample;
    const std::string bytes = sample.bytes();
    const CheckedPdf checked = check_and_read_pdf(bytes, k_attachment);
    EXPECT_THAT(checked.findings, testing::IsEmpty());
    EXPECT_EQ(checked.page_texts, texts_of_pages(bytes));
    EXPECT_THAT(check_and_read_pdf(bytes, "").page_texts, testing::IsEmpty());
}

TEST(PdfConformity, DamagedBytesAreFound) {
    Sample sample;
    const std::string good = sample.bytes();
    const auto first = [&](const std::string& pdf) {
        const std::vector<std::string> found = codes(pdf);
        return found.empty() ? std::string() : found[0].substr(0, 14);
    };
    EXPECT_EQ(first(replaced(good, "%PDF-1.7", "%PDF-2.0")), "GC-REPORT-0021");
    EXPECT_EQ(first(replaced(good, "%\xbf\xf7\xa2\xfe", "%abcd")), "GC-REPORT-0021");
    EXPECT_EQ(first(replaced(good, "/Subtype /XML", "/Filter [   ]")), "GC-REPORT-0024") << "compressed metadata";
    EXPECT_EQ(first(good + "more"), "GC-REPORT-0021");
    EXPECT_EQ(first(replaced(good, "/ID [", "/XX [")), "GC-REPORT-0022");
    EXPECT_EQ(first(good.substr(0, good.size() / 2)), "GC-REPORT-0021");
    EXPECT_EQ(first(""), "GC-REPORT-0021");
    EXPECT_EQ(first(replaced(good, "startxref\n", "startxref\n9")), "GC-REPORT-0020");
}

TEST(PdfConformity, EncryptionIsFound) {
    Sample sample;
    QPDFWriter writer(sample.pdf);
    writer.setOutputMemory();
    writer.setR6EncryptionParameters("", "owner", true, true, true, true, true, true, qpdf_r3p_full, true);
    writer.write();
    const auto buffer = writer.getBufferSharedPointer();
    const std::vector<std::string> found =
        codes({reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()});
    EXPECT_THAT(found, testing::Contains(testing::StartsWith("GC-REPORT-0023")));
}

TEST(PdfConformity, NothingIsAttachedUnasked) {
    Sample sample;
    const std::vector<std::string> found = codes(sample.bytes(), "");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(found[0], testing::StartsWith("GC-REPORT-0027"));
}

}  // namespace
}  // namespace gumcert::reports
