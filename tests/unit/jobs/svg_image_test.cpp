#include "jobs/svg_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "jobs/image_format.h"
#include "tests/fuzz/svg_image_target.h"

namespace gumcert::jobs {
namespace {

using testing::HasSubstr;

std::string drawing_of(const std::string& inside,
                       const std::string& head = R"(xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 20")") {
    return "<svg " + head + ">" + inside + "</svg>";
}

TEST(SvgImage, AcceptsPlainShapes) {
    const std::vector<std::string> drawings{
        drawing_of(""),
        "\xEF\xBB\xBF<?xml version='1.0' encoding='utf-8'?>\n<!-- <script> in a comment acts on nothing -->\n" +
            drawing_of("<title>Müller &amp; Söhne (1 &lt; 2)</title><rect width=\"1\" height='2'/>\n") + "\n",
        drawing_of(R"x(<style>.a{fill:#fff;stroke:rgba(1, 2, 3, .5)}</style><g class="a" transform="rotate (3)"/>)x"),
        drawing_of(R"x(<path d="M0,0 L1e-3,-2z" fill="url( '#g' )" clip-path="url(#c)"/>)x"),
        drawing_of("<defs><linearGradient id=\"g\" href=\"#h\" xlink:href=\"#h\"><stop offset=\"0\"/>"
                   "</linearGradient></defs>",
                   R"(xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
                      xml:space="preserve" width="60mm" viewBox=" -1,-2 60.5 2e1 ")"),
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1 1'/>"};
    for (const std::string& drawing : drawings) {
        EXPECT_EQ(svg_objection(drawing), "") << drawing;
        EXPECT_TRUE(looks_like_svg(drawing));
        EXPECT_EQ(image_format(drawing).media_type, "image/svg+xml");
    }
}

TEST(SvgImage, RefusesWhatActsOrRefersOrGrows) {
    std::string deep;
    for (int i = 0; i < 40; ++i) {
        deep += "<g>";
    }
    std::string many;
    for (int i = 0; i < 20001; ++i) {
        many += "<g/>";
    }
    const std::vector<std::pair<std::string, std::string>> bad{
        {drawing_of("<script>alert(1)</script>"), "the element \"script\""},
        {drawing_of("<SCRIPT/>"), "the element \"SCRIPT\""},
        {drawing_of("<image href=\"a.png\"/>"), "the element \"image\""},
        {drawing_of("<foreignObject/>"), "the element \"foreignObject\""},
        {drawing_of("<use href=\"#a\"/>"), "the element \"use\""},
        {drawing_of("<text>A</text>"), "the element \"text\""},
        {drawing_of("<animate/>"), "the element \"animate\""},
        {drawing_of("<svg:rect/>"), "the element \"svg:rect\""},
        {drawing_of("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1 1'/>"), "in or behind another one"},
        {drawing_of("") + drawing_of(""), "in or behind another one"},
        {drawing_of("") + "<g/>", "in or behind another one"},
        {"<g/>", "in or behind another one"},
        {drawing_of("<g onclick=\"a()\"/>"), "the attribute \"onclick\""},
        {drawing_of("<g ONCLICK=\"a\"/>"), "the attribute \"ONCLICK\""},
        {drawing_of("<g inkscape:label=\"a\"/>"), "the attribute \"inkscape:label\""},
        {drawing_of("<g xml:base=\"http:a\"/>"), "the attribute \"xml:base\""},
        {drawing_of("<g xmlns=\"http://www.w3.org/1999/xhtml\"/>"), "the attribute \"xmlns\""},
        {drawing_of("<linearGradient xlink:href=\"b.svg#a\"/>"), "refers to \"b.svg#a\""},
        {drawing_of("<g fill=\"url(b.svg#a)\"/>"), "refers to \"b.svg#a\""},
        {drawing_of("<g style=\"fill: url ( 'data:a' )\"/>"), "refers to \"data:a'"},
        {drawing_of("<g style=\"fill:u\\72l(a)\"/>"), "that has \"\\\""},
        {drawing_of("<style>@import 'a'</style>"), "that has \"@\""},
        {drawing_of("<style>a{b:image-set('c')}</style>"), "the function \"image-set\""},
        {drawing_of("<style>a{b:url/**/(c)}</style>"), "that has \"/*\""},
        {drawing_of("<g a=\"https://example.org\"/>"), "that has \"//\""},
        {drawing_of("<g fill=\"&#117;rl(a)\"/>"), "the entity \"#117\""},
        {drawing_of("<title>&a;</title>"), "the entity \"a\""},
        {"<!DOCTYPE svg [<!ENTITY a 'b'>]>" + drawing_of(""), "a document type, an entity"},
        {drawing_of("<![CDATA[a]]>"), "a CDATA section"},
        {"<?xml-stylesheet href='a'?>" + drawing_of(""), "a processing instruction"},
        {"<?xml version='1.0' encoding='UTF-16'?>" + drawing_of(""), "not in UTF-8"},
        {"<?xml version='1.0' e<text encoding='UTF-8'?>" + drawing_of(""), "XML declaration"},
        {"<?xml encoding='UTF-8'?>" + drawing_of(""), "XML declaration"},
        {"<?xml version='1.0\" encoding='UTF-8'?>" + drawing_of(""), "XML declaration"},
        {drawing_of("\xFF"), "no text in UTF-8"},
        {drawing_of(std::string(1, '\0')), "no text in UTF-8"},
        {drawing_of("words"), "text outside of title"},
        {drawing_of("<g></rect>"), "not closed in their order"},
        {drawing_of("<g>"), "not closed in their order"},
        {drawing_of("</g>"), "not closed in their order"},
        {drawing_of("<g a/>"), "not written as one"},
        {drawing_of("<g a=b/>"), "not written as one"},
        {drawing_of("<g a=\"1\"b =\"2\"/>"), "not written as one"},
        {drawing_of("<g a=\"1\" a=\"2\"/>"), "states twice the attribute \"a\""},
        {drawing_of("<g a=\"1"), "cut off"},
        {"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1\"><g/>", "cut off"},
        {"<?xml version='1.0'?>", "cut off"},
        {"<?xml version='1.0'", "cut off"},
        {drawing_of("", "viewBox=\"0 0 1 1\""), "without its namespace"},
        {drawing_of("", "xmlns=\"http://www.w3.org/2000/svg\" width=\"10\" height=\"10\""), "without a viewBox"},
        {drawing_of("", "xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1\""), "without a viewBox"},
        {drawing_of("", "xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 0 1\""), "without a viewBox"},
        {drawing_of("", "xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 21\""), "without a viewBox"},
        {drawing_of("", "xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1 1\""), "without a viewBox"},
        {drawing_of("", "xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 inf 1\""), "without a viewBox"},
        {drawing_of(deep), "of more than 20000 elements, or 32 within each other"},
        {drawing_of(many), "of more than 20000 elements, or 32 within each other"}};
    for (const auto& [drawing, objection] : bad) {
        EXPECT_THAT(svg_objection(drawing), HasSubstr(objection)) << drawing.substr(0, 200);
        EXPECT_THAT(svg_objection(drawing), testing::StartsWith("an SVG drawing"));
        EXPECT_EQ(image_format(drawing).media_type, "") << drawing.substr(0, 200);
    }
}

/// Every beginning of a drawing, and every drawing with one byte changed, gets an answer that the fuzz target accepts.
TEST(SvgImage, AnswersForSeedsAndTheirMutations) {
    std::size_t accepted = 0;
    std::size_t seeds = 0;
    for (const auto& entry : std::filesystem::directory_iterator(GUMCERT_SOURCE_DIR "/tests/fuzz/corpus/svg_image")) {
        std::ifstream stream(entry.path(), std::ios::binary);
        const std::string seed{std::istreambuf_iterator<char>(stream), {}};
        ++seeds;
        accepted += fuzz::svg_image(seed) ? 1U : 0U;
        for (std::size_t i = 0; i < seed.size(); ++i) {
            (void)fuzz::svg_image(std::string_view(seed).substr(0, i));
            for (const char c : {'<', '>', '"', '&', '(', 'o', '\0'}) {
                std::string changed = seed;
                changed[i] = c;
                (void)fuzz::svg_image(changed);
            }
        }
    }
    EXPECT_GE(seeds, 4U);
    EXPECT_EQ(accepted, 1U);
}

}  // namespace
}  // namespace gumcert::jobs
