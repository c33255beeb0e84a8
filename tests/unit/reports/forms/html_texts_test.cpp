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
                                     {"<span data-text=\"EX&#45;1\"></span>x", "EX1x"},
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

}  // namespace
}  // namespace gumcert::reports
