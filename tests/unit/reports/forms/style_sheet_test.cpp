#include "reports/forms/style_sheet.h"

#include "reports/forms/html_texts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

std::string sheet_of_templates() {
    std::ifstream file(std::filesystem::path(GUMCERT_SOURCE_DIR) / "templates" / "certificate.css");
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string page_with(const std::string& style) {
    return "<!DOCTYPE html><html><head><style>" + style + "</style></head><body><p>4.9</p></body></html>";
}

// A laboratory sets its pages in its own way: what neither hides nor moves is its own affair.
TEST(StyleSheets, MayHavePlainBlocksOfTheirOwn) {
    for (const char* const block :
         {"p { margin: 0 }", "body { font-family: Arial, \"Times New Roman\", sans-serif; font-size: 11pt }",
          "td, th { padding: 2pt 4px; border: 1px solid #000 }", "table { border-collapse: collapse; width: 100% }",
          "h1 { text-align: center; font-weight: 700; font-size: 1.4rem; line-height: 1.2 }",
          "tr { break-inside: avoid; page-break-inside: avoid }", "p{margin:0 auto .5rem;}",
          "@media print { p { margin: 1mm } }", "main { max-width: 50rem }", "", "/* a remark */ p { margin: 0 }"}) {
        EXPECT_EQ(hidden_part_of_html(page_with(block), ""), "") << block;
    }
}

// Each of these, beside the sheet of the templates, shows something else than the text, or does not show it.
TEST(StyleSheets, HideMoveAndAddNothing) {
    for (const char* const rules :
         {"code{color:#fff;font-size:1px}", "td{color:white}", "td{color:rgb(0 0 0/0)}",
          "td{-webkit-text-fill-color:#fff}", "td{color:#000;background:#000}", "body{background:black}",
          "@media print{td{color:#fff}}", "@layer a{td{color:#fff}}", "@layer a{td{margin:0}}",
          "table{& td{color:#fff}}", "td{zoom:0.01}", "td{font-family:Wingdings}",
          "@font-face{font-family:arial;src:url(data:font/woff2;base64,AAAA)}", "td{text-decoration:line-through}",
          "td{text-transform:uppercase}", "td{scale:0}", "td{rotate:180deg}", "td{translate:-999em}",
          "tbody{display:flex;flex-direction:column-reverse}", "tr:first-child{order:9}tbody{display:grid}",
          "td{display:list-item;list-style-type:\"1 nm \"}", "body{background-image:url(\"data:image/svg+xml,x\")}",
          "body{background-image:url(data:image/svg)}", "@keyframes a{to{color:#fff}}td{animation:a 0s forwards}",
          "td{box-shadow:inset 0 0 0 99em #fff}", "td{overflow:clip}", "td{border:99px solid #fff}",
          "td{border:1px solid #fff}", "td{border:99px solid #000}", "p{outline:99em solid white}", "td{font-size:1px}",
          "td{font-size:.1rem}", "td{font-size:.5em}", "td{font-size:50%}", "td{font-size:99rem}", "td{line-height:.1}",
          "td{letter-spacing:-1em}", "td{margin-left:-1px}", "td{margin-left:999em}", "td{max-width:1px}",
          "dd{width:99999rem}", "dd{max-width:1300px}", "div{width:30%}", "td{vertical-align:9em}", "td{font:0/0 a}",
          "td{float:left}", "td{font-variant-numeric:diagonal-fractions}", "td{columns:9}",
          "td{writing-mode:vertical-rl}", "td{display:inline}", "td{all:unset}", "td{margin:0!important}",
          "td{margin:calc(0px - 99em)}", "td{margin:var(--a)}", "td{mar\\67in:0}", "td{color:#000}",
          "::selection{color:#fff}", "@import url(x);", "@import \"x\";p{margin:0}", "@page{size:1mm}",
          "@media print;td{color:#fff}", "td{color:#fff", "}td{color:#fff}", "@media print{p{margin:0}color:#fff}",
          "/* } */td{color:#fff}", "td{color:red;/**/display:none}",
          // Strings that look like the begin of a comment, in a block that is known without it.
          ".mark p{margin:0;x:\"/*\"}td{color:#fff}p{x:\"*/\"}",
          "body { font-family: \"Libertinus/*\"}td{color:#fff}p{x:\"*/ Serif\"}",
          ".mark{margin:0;x:url(/*)}td{color:#fff}p{x:url(*/)}"}) {
        EXPECT_NE(hidden_part_of_html(page_with(sheet_of_templates() + rules), sheet_of_templates()), "") << rules;
    }
}

// Law: whatever is not listed is refused, with whichever value, and what is listed is refused with any word that is not.
TEST(StyleSheets, HaveListedPropertiesWithListedValues) {
    for (const char* const property :
         {"display",    "visibility",   "opacity",   "content",   "clip",         "clip-path",    "transform",
          "position",   "filter",       "direction", "color",     "fill",         "background",   "order",
          "float",      "overflow",     "z-index",   "inset",     "top",          "text-indent",  "zoom",
          "scale",      "rotate",       "translate", "animation", "mask",         "height",       "max-height",
          "font",       "quotes",       "columns",   "flex",      "grid",         "offset",       "perspective",
          "transition", "appearance",   "contain",   "cursor",    "resize",       "hyphens",      "text-align-last",
          "-x",         "--x",          "margin_x",  "all",       "border-image", "border-color", "border-radius",
          "list-style", "counter-reset"}) {
        for (const char* const value : {"0", "none", "auto", "normal", "1px", "100%", "black", "inherit"}) {
            EXPECT_FALSE(is_plain_declaration(std::string(property) + ": " + value)) << property << value;
        }
    }
    for (const char* const property :
         {"margin",          "margin-left",    "padding",     "gap",           "border",       "border-top",
          "border-collapse", "font-size",      "font-weight", "font-style",    "font-family",  "line-height",
          "text-align",      "vertical-align", "white-space", "overflow-wrap", "caption-side", "break-inside",
          "width",           "max-width"}) {
        for (const char* const value :
             {"",         "white",     "#fff",    "transparent",  "inherit", "-1px",     "-5%",   "url(x)",
              "var(--a)", "calc(1px)", "attr(x)", "\"x\"",        "'",       "0;",       "1e9px", "99999px 0",
              "nan",      "inf",       "1vw",     "0 !important", "\\30",    "Wingdings"}) {
            EXPECT_FALSE(is_plain_declaration(std::string(property) + ":" + value)) << property << ":" << value;
        }
    }
}

// Law: a sheet has the blocks of another one where nothing but remarks and blanks differs; one more character is another block.
TEST(StyleSheets, AreKnownBlockByBlock) {
    const std::string sheet = sheet_of_templates();
    const std::vector<std::string> blocks = style_blocks(sheet);
    ASSERT_GT(blocks.size(), 50U);
    EXPECT_EQ(hidden_part_of_html(page_with(sheet), sheet), "");
    EXPECT_TRUE(has_style_of(page_with("/* remark */\r\n" + sheet + "\n"), sheet));
    for (std::size_t at = sheet.find('}'); at != std::string::npos; at = sheet.find('}', at + 1)) {
        std::string other = sheet;
        other.insert(at, ";color:#fff");
        EXPECT_FALSE(has_style_of(page_with(other), sheet));
        EXPECT_NE(hidden_part_of_html(page_with(other), sheet), "") << other.substr(at - 20, 40);
    }
    // What is known within a printed page is not known on a screen, and the other way round.
    EXPECT_NE(hidden_part_of_html(page_with(".page-head { display: table-header-group; break-inside: avoid; }"), sheet),
              "");
    EXPECT_NE(hidden_part_of_html(page_with("@media print { .page-head { display: none; } }"), sheet), "");
    EXPECT_FALSE(has_style_of(page_with(sheet) + "<STYLE>p{margin:0}</STYLE>", sheet));
}

}  // namespace
}  // namespace gumcert::reports
