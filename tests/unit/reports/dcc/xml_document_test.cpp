#include "reports/dcc/xml_document.h"

#include <gtest/gtest.h>

#include <string>

#include "gum/quantity/diagnostic.h"

namespace gumcert::reports {
namespace {

gum::Diagnostic refusal_of(const std::string& xml) {
    try {
        (void)read_xml(xml, "file.xml");
    } catch (const gum::InputError& error) {
        return error.diagnostics().front();
    }
    return {.code = "accepted", .where = "", .what = "", .rule = "", .action = ""};
}

TEST(XmlDocument, ReadsNamesByTheirNamespaceAndKeepsText) {
    const XmlElement root = read_xml(
        "<x:digital xmlns:x='https://ptb.de/dcc' xmlns='https://ptb.de/si' a='1' x:b='2'>\n"
        "  <real> 1.50 </real><foreign xmlns='urn:f'>&lt;&#xB5;<![CDATA[<m>]]></foreign></x:digital>",
        "file.xml");
    EXPECT_EQ(root.name, "dcc:digital");
    EXPECT_EQ(root.attribute("a"), "1");
    EXPECT_EQ(root.attribute("dcc:b"), "2");
    ASSERT_EQ(root.children.size(), 2U);
    EXPECT_EQ(root.children[0].text, " 1.50 ");
    EXPECT_EQ(root.child_text("si:real"), "1.50");
    EXPECT_EQ(root.children[1].name, "{urn:f}foreign");
    EXPECT_EQ(root.children[1].text, "<µ<m>");
    EXPECT_EQ(root.children[0].line, 2U);
    EXPECT_EQ(root.child("si:other"), nullptr);
}

TEST(XmlDocument, RefusesEveryDoctypeBeforeItIsLookedAt) {
    for (const std::string doctype :
         {"<!DOCTYPE a>", "<!DOCTYPE a SYSTEM 'file:///etc/passwd'>",
          "<!DOCTYPE a [<!ENTITY x SYSTEM 'file:///etc/passwd'>]>", "<!DOCTYPE a PUBLIC 'p' 'http://localhost/x.dtd'>",
          "<!DOCTYPE a [<!ENTITY x '1'><!ENTITY y '&x;&x;&x;&x;&x;&x;&x;&x;'><!ENTITY z '&y;&y;&y;&y;&y;&y;'>]>"}) {
        const gum::Diagnostic d = refusal_of("<?xml version='1.0'?>\n" + doctype + "<a>&x;</a>");
        EXPECT_EQ(d.code, "GC-DCC-0002") << doctype;
        EXPECT_EQ(d.where.substr(0, 11), "file.xml:2:") << doctype;
    }
}

TEST(XmlDocument, SaysWhereAFileIsNotWellFormedAndKeepsQuiet) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(refusal_of("<a>\n<b></a>").code, "GC-DCC-0001");
    EXPECT_EQ(refusal_of("<a>\n<b></a>").where, "file.xml:2:8");
    EXPECT_EQ(refusal_of("<a>&x;</a>").code, "GC-DCC-0001");  // no entity but the five of XML
    EXPECT_EQ(refusal_of("<a>\x01</a>").code, "GC-DCC-0001");
    EXPECT_EQ(refusal_of("<a>\xC3\x28</a>").code, "GC-DCC-0001");  // not UTF-8
    EXPECT_EQ(refusal_of("<x:a/>").code, "GC-DCC-0001");           // a prefix without a namespace
    EXPECT_EQ(refusal_of("").code, "GC-DCC-0001");
    EXPECT_EQ(refusal_of("{\"json\": 1}").code, "GC-DCC-0001");
    EXPECT_EQ(refusal_of("<a/><b/>").code, "GC-DCC-0001");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(XmlDocument, LimitsDepthAndSize) {
    std::string deep;
    for (int i = 0; i < 64; ++i) {
        deep = "<a>" + deep + "</a>";
    }
    EXPECT_EQ(refusal_of(deep).code, "accepted");
    EXPECT_EQ(refusal_of("<a>" + deep + "</a>").code, "GC-DCC-0003");
    EXPECT_EQ(refusal_of(std::string((64U << 20U) + 1, ' ')).code, "GC-DCC-0004");
}

TEST(XmlDocument, ReadsOtherEncodings) {
    std::string utf16("\xFF\xFE", 2);
    for (const char c : std::string("<a>x</a>")) {
        utf16 += c;
        utf16 += '\0';
    }
    EXPECT_EQ(read_xml(utf16, "file.xml").text, "x");
    EXPECT_EQ(read_xml("<?xml version='1.0' encoding='ISO-8859-1'?><a>\xB5</a>", "file.xml").text, "µ");
}

TEST(XmlDocument, WritesWhatItReads) {
    const std::string hostile = "</a><script>\"&\x01\xFF ]]> \u202E\n&lt; <!-- ${x} {{y}}";
    XmlWriter writer;
    writer.open("a", {{"key", "\"<&'"}, {"left_out", ""}});
    writer.element("b", hostile);
    writer.close();
    const std::string text = writer.take();
    const XmlElement root = read_xml(text, "written");
    EXPECT_EQ(root.attribute("key"), "\"<&'");
    EXPECT_EQ(root.attributes.size(), 1U);
    ASSERT_EQ(root.children.size(), 1U);
    EXPECT_EQ(root.children[0].text, "</a><script>\"&\uFFFD\uFFFD ]]> \uFFFD\n&lt; <!-- ${x} {{y}}");
    EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(XmlDocument, SplitsLists) {
    EXPECT_EQ(xml_list(" 1  2\n3\t"), (std::vector<std::string>{"1", "2", "3"}));
    EXPECT_TRUE(xml_list(" \n").empty());
    EXPECT_EQ(without_outer_blanks("\t a b \n"), "a b");
}

}  // namespace
}  // namespace gumcert::reports
