#include "reports/forms/html_texts.h"

#include "reports/forms/pdf_page_texts.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace gumcert::reports {
namespace {

TEST(TextsOfHtml, AreWhatAReaderSees) {
    for (const auto& [html, text] : {std::pair<std::string, std::string>{"<p>1.5 &#181;m</p>", "1.5\u00B5m"},
                                     {"a<b>b</b>&amp;&lt;&gt;&quot;&apos;&#x41;&nbsp;c", "ab&<>\"'Ac"},
                                     {"<head><title>t</title></head><STYLE>s</STYLE><p>x</p>", "x"},
                                     {"<script>if (a < b) {}</script>x<!-- <p>y</p> -->z", "xz"},
                                     {"<svg><text>9</text></svg>x", "x"},
                                     {"<span data-text=\"EX&#45;1\"></span>x", "x"},
                                     {"<p title=\"a > b\">x</p>", "x"},
                                     {"&unknown; &#0; & x", "&unknown;&#0;&x"},
                                     {"<p>x", "x"},
                                     {"x<p", "x"},
                                     {"<!-- x", ""},
                                     {"<svg>x", ""},
                                     {"", ""}}) {
        EXPECT_EQ(without_blanks(text_of_html(html)), text) << html;
    }
}

TEST(TextsOfHtml, OfSignsThatEndNowhereAreThoseSigns) {
    const std::string signs(3'000'000,
                            '&');  // each one looks for its ';' as far as a reference is long, and no further
    EXPECT_EQ(text_of_html(signs), signs);
}

constexpr const char* k_sheet =
    ".page-head { display: none; }\n.pad::after { content: attr(data-pad); visibility: hidden; }";

TEST(TextsOfHtml, HideNothing) {
    for (const char* const page :
         {"<p>x</p>",
          "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>t</title></head><body><p>x &amp; "
          "y &#8722; z</p></body></html>",
          "<style>.page-head { display: none; } p { margin: 0 }</style>x", "<style>.page-head{display:none;}</style>",
          "<img class=\"symbol\" style=\"max-width: 20rem; margin-left: 0\" src=\"data:image/png;base64,AA==\" "
          "alt=\"a\">",
          "<div class=\"page-head\"><div><span data-text=\"x\"></span></div></div><p>y</p>",
          "<svg viewBox=\"0 0 1 1\"><g><text>1</text></g></svg>",
          "<svg x=\"0\" y=\"0\" width=\"9\" height=\"9\" viewBox=\"0 0 9 9\" shape-rendering=\"crispEdges\"></svg>",
          "<!-- remark -->x", "a &lt; b & c", "4.9 \u00D7 10<sup>\u22123</sup>", "4.9\u00B710<sup>3</sup>",
          "m<sup>2</sup>", "<i>R</i><sub>0</sub> = 5", "4.9 <sup>1</sup>", "<p>5</p><sup>2</sup>", ""}) {
        EXPECT_EQ(hidden_part_of_html(page, k_sheet), "") << page;
    }
}

// Each of these shows something else than its text, or does not show it.
TEST(TextsOfHtml, TellWhatMayBeHidden) {
    for (const char* const page : {"<div hidden>4.9</div>",
                                   "<div HIDDEN=\"\">4.9</div>",
                                   "<p style=\"display:none\">4.9</p>",
                                   "<p style='margin: 0; color: #fff'>4.9</p>",
                                   "<p style=\"margin-left: -99rem\">4.9</p>",
                                   "<p style=\"dis&#112;lay:none\">4.9</p>",
                                   "<style>p { display: none }</style>",
                                   "<style>.page-head, p { display: none; }</style>",
                                   "<style>b::before { content: \"\u2212\" }</style>",
                                   "<style>p { dis\\70lay: none }</style>",
                                   "<style>p{font-size:0}</style>",
                                   "<script>f()</script>",
                                   "<details>4.9</details>",
                                   "<dialog>4.9</dialog>",
                                   "<template>4.9</template>",
                                   "<link rel=\"stylesheet\" href=\"x\">",
                                   "<iframe src=\"x\"></iframe>",
                                   "<noscript>4.9</noscript>",
                                   "<del>4.9</del>",
                                   "<font color=\"white\">4.9</font>",
                                   "<td bgcolor=\"black\">4.9</td>",
                                   "<body onload=\"f()\">",
                                   "&minus;4.9",
                                   "&#8722 4.9",
                                   "<b>&minus</b>4.9",
                                   "<div class=\"a page-head\"><div>4.9</div></div>",
                                   "<div class=\"page-head\"><p>4.9</p></div>",
                                   "<section class=\"page-head\">4.9</section>",
                                   "<head><p>4.9</p></head>",
                                   "<head>4.9</head>",
                                   "<svg><style>p { display: none }</style></svg>",
                                   "<svg><foreignObject>4.9</foreignObject></svg>",
                                   "<!--> 4.9 -->",
                                   "<!-- --!> 4.9 -->",
                                   "<? 4.9 >",
                                   "<bdo dir=\"rtl\">9.4</bdo>",
                                   "<p dir=\"rtl\">4.9</p>",
                                   "\u202E9.4",
                                   "\xFF",
                                   "<meta http-equiv=\"refresh\" content=\"0; url=x\">",
                                   "5000<sup>0838</sup>",
                                   "5000<sub>0838</sub>",
                                   "5000<b></b><sup><i>0838</i></sup>",
                                   "10<sup>0838</sup>",
                                   "<sup>\u2212</sup>4.9",
                                   "<sub>5</sub>4.9",
                                   "<ol><s>4.9</s></ol>",
                                   "<div class=\"a\tPage-Head\">4.9</div>",
                                   "<p class=\"symbol\">4.9</p>",
                                   "<p dir=\"RTL\">4.9</p>",
                                   "<style media=\"print\">p { margin: 0 }</style>",
                                   "<meta charset=\"utf-16\">",
                                   "<svg overflow=\"visible\"></svg>",
                                   "<svg transform=\"scale(9)\"></svg>",
                                   "<table border=\"9999\"></table>",
                                   "<table cellpadding=\"9999\"></table>",
                                   "<p style=\"max-width: 1px\">4.9</p>",
                                   "<p style=\"font-weight: bold; border: 99px solid white\">4.9</p>",
                                   "<small><small>4.9</small></small>",
                                   "<small><p>4.9</p></small>",
                                   "<table><tr><td></small><small>4.9</td></tr></table>",
                                   "<b><i>4.9</b></i>",
                                   "<ul></div></ul>"}) {
        EXPECT_NE(hidden_part_of_html(page, k_sheet), "") << page;
    }
}

// Law: what is within something within something comes to an end, whichever elements they are.
TEST(TextsOfHtml, AreWithinFewElements) {
    for (const std::string& name :
         {std::string("div"), std::string("ul"), std::string("blockquote"), std::string("small"), std::string("sub"),
          std::string("span"), std::string("code")}) {
        std::string page = "4.9";
        for (int i = 0; i < 40; ++i) {
            page = "<" + name + ">" + page + "</" + name + ">";
        }
        EXPECT_NE(hidden_part_of_html(page, k_sheet), "") << name;
        EXPECT_EQ(hidden_part_of_html("<" + name + ">4.9</" + name + ">", k_sheet), "") << name;
    }
}

TEST(StructureOfHtml, IsTheSameForPagesThatAreWrittenOtherwise) {
    for (const auto& [one, other] : {std::pair<std::string, std::string>{"<P Class='a'>x</P>", "<p class=\"a\">x</p>"},
                                     {"<p>&#120;<!-- remark --></p>", "<p>x</p>"},
                                     {"<p >x</p >", "<p>x</p>"}}) {
        EXPECT_EQ(without_blanks(structure_of_html(one)), without_blanks(structure_of_html(other))) << one;
    }
}

TEST(StructureOfHtml, IsAnotherForWhateverIsShownOtherwise) {
    for (const auto& [one, other] : {std::pair<std::string, std::string>{"<svg><text>9</text></svg>", "<svg></svg>"},
                                     {"<ol><li>x</li></ol>", "<ol start=51><li>x</li></ol>"},
                                     {"<p>x</p>", "<p title=\"PASS\">x</p>"},
                                     {"<img alt=\"a\">", "<img alt=\"b\">"},
                                     {"<img src=\"a\">", "<img src=\"b\">"},
                                     {"<p>50</p>", "<p>5<sup>0</sup></p>"},
                                     {"<p>&lt;b&gt;x</p>", "<p><b>x</p>"},
                                     {"<title>a</title>", "<title>b</title>"}}) {
        EXPECT_NE(without_blanks(structure_of_html(one)), without_blanks(structure_of_html(other))) << other;
    }
}

TEST(TextsOfHtml, KeepTogetherWhatStandsWithinALine) {
    EXPECT_EQ(text_of_html("m<b></b>N 1<i></i>4.9<sub>x</sub>"), "mN 14.9x");
    EXPECT_EQ(text_of_html("<td>1</td><td>4.9</td>"), " 1  4.9 ");
}

}  // namespace
}  // namespace gumcert::reports
