#include "reports/forms/typeset_drawing.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace gumcert::reports {
namespace {

const nlohmann::json& drawing_symbols() {
    static const nlohmann::json view = {
        {"symbols",
         {{{"text", "V_x"}, {"base", "V"}, {"index", "x"}}, {{"text", "theta"}, {"base", "θ"}, {"index", ""}}}},
        {"letters", {{{"text", "t"}}}}};
    return view;
}

std::string typeset_words(const std::string& words) {
    const std::string head = "<text x=\"1\" font-size=\"10\">";
    const std::string out = typeset_drawing(head + words + "</text>\n<path/>", drawing_symbols());
    EXPECT_TRUE(out.starts_with(head)) << out;
    EXPECT_TRUE(out.ends_with("</text>\n<path/>")) << out;
    return out.substr(head.size(), out.size() - head.size() - std::string("</text>\n<path/>").size());
}

TEST(TypesetDrawing, PutsIndicesBelowAndComesBackToTheLine) {
    EXPECT_EQ(typeset_words("V_x / V"),
              "<tspan font-style=\"italic\">V</tspan><tspan font-size=\"7.2\" dy=\"2.2\">x"
              "</tspan><tspan dy=\"-2.2\"> / V</tspan>");
    EXPECT_EQ(typeset_words("theta"), "<tspan font-style=\"italic\">θ</tspan>");
    EXPECT_EQ(typeset_words("V_x, V_x"),
              "<tspan font-style=\"italic\">V</tspan><tspan font-size=\"7.2\" dy=\"2.2\">x</tspan>"
              "<tspan dy=\"-2.2\">, </tspan><tspan font-style=\"italic\">V</tspan>"
              "<tspan font-size=\"7.2\" dy=\"2.2\">x</tspan>");
}

TEST(TypesetDrawing, SetsLettersThatAreQuantitiesOnly) {
    EXPECT_EQ(typeset_words("t"), "<tspan font-style=\"italic\">t</tspan>");
    EXPECT_EQ(typeset_words("x / mm"), "<tspan font-style=\"italic\">x</tspan> / mm");
    EXPECT_EQ(typeset_words("value ± U"), "value ± <tspan font-style=\"italic\">U</tspan>");
    EXPECT_EQ(typeset_words("角度 θ / °"), "角度 <tspan font-style=\"italic\">θ</tspan> / °");
    for (const char* words : {"U-1", "LAB U_2x", "t of a", "A", "12.5", "−3 limit"}) {
        EXPECT_EQ(typeset_words(words), words);
    }
}

TEST(TypesetDrawing, TakesAllDrawingsOfAView) {
    nlohmann::json view = drawing_symbols();
    view["sections"] = {{{"blocks", {{{"figure", {{{"svg", "<text font-size=\"10\">t</text>"}}}}}}}}};
    EXPECT_EQ(with_typeset_drawings(view)["sections"][0]["blocks"][0]["figure"][0]["svg"],
              "<text font-size=\"10\"><tspan font-style=\"italic\">t</tspan></text>");
}

}  // namespace
}  // namespace gumcert::reports
