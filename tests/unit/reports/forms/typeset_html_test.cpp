#include "reports/forms/typeset_html.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace gumcert::reports {
namespace {

std::string typeset(const std::string& body) {
    const nlohmann::json view = {
        {"symbols",
         {{{"text", "T_L"}, {"base", "T"}, {"index", "L"}}, {{"text", "ν_eff"}, {"base", "ν"}, {"index", "eff"}}}},
        {"letters", {{{"text", "l"}}}}};
    return typeset_html("<head>T_L</head><body>" + body, view).substr(std::string("<head>T_L</head><body>").size());
}

TEST(TypesetHtml, DrawsSymbolsWhereverTheyStand) {
    EXPECT_EQ(typeset("<p>T_L = 5, T_LX, XT_L, 以T_L表</p>"),
              "<p><i>T</i><sub>L</sub> = 5, T_LX, XT_L, 以<i>T</i><sub>L</sub>表</p>");
    EXPECT_EQ(typeset("<p>ν_eff, ν_effective</p>"), "<p><i>ν</i><sub>eff</sub>, ν_effective</p>");
    EXPECT_EQ(typeset("<tr><td class=\"left\">l</td><td>l</td></tr><p>l</p>"),
              "<tr><td class=\"left\"><i>l</i></td><td>l</td></tr><p>l</p>");
    EXPECT_EQ(typeset("<img alt=\"T_L\"><svg><text>T_L</text></svg>"), "<img alt=\"T_L\"><svg><text>T_L</text></svg>");
}

TEST(TypesetHtml, SetsLettersOfAFormula) {
    EXPECT_EQ(typeset("<p class=\"formula\">C = 2.5·exp(l) − α·T_L</p><p>C</p>"),
              "<p class=\"formula\"><i>C</i> = 2.5·exp(<i>l</i>) − <i>α</i>·<i>T</i><sub>L</sub></p><p>C</p>");
}

TEST(TypesetHtml, LeavesNumbersInOnePiece) {
    const std::string cells =
        "<td class=\"number\">−50000838</td><p>l = 50838\u00A0nm</p><td class=\"number\">0.1234567</td>";
    EXPECT_EQ(typeset(cells), cells);
}

}  // namespace
}  // namespace gumcert::reports
