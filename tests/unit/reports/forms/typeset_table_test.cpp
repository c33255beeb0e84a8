#include "reports/forms/typeset_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace gumcert::reports {
namespace {

using nlohmann::json;

json table_cell(const std::string& text, const std::string& align = "number", const std::string& pad = "") {
    return {{"text", text}, {"align", align}, {"pad", pad}, {"also", json::array()}};
}

/// A table whose rows have these cells, in a section of a view, as the template gets it.
json typeset_table(const std::vector<std::vector<json>>& rows, const std::vector<std::string>& columns) {
    json table = {{"columns", json::array()}, {"rows", json::array()}};
    for (const std::string& align : columns) {
        table["columns"].push_back({{"head", "x"}, {"align", align}});
    }
    for (const std::vector<json>& cells : rows) {
        table["rows"].push_back({{"kind", "plain"}, {"cells", cells}});
    }
    const json section = {{"blocks", {{{"table", {table}}}}}};
    const json typeset = with_typeset_tables(
        {{"letters", {{{"text", "t"}}}}, {"sections", {section}}, {"identity", {{{"sections", {section}}}}}});
    EXPECT_EQ(typeset["sections"], typeset["identity"][0]["sections"]);
    return typeset["sections"][0]["blocks"][0]["table"][0];
}

std::string form_of_cell(const json& cell, bool first = false) {
    const json row = typeset_table({{table_cell("a", "left"), cell}}, {"left", "left"})["rows"][0]["cells"][1];
    const json alone = typeset_table({{cell}}, {"left"})["rows"][0]["cells"][0];
    return (first ? alone : row)["form"];
}

TEST(TypesetTable, TellsTheFormOfACell) {
    EXPECT_EQ(form_of_cell(table_cell("−1234.5678")), "digits");
    EXPECT_EQ(form_of_cell(table_cell("12345")), "number");
    EXPECT_EQ(form_of_cell(table_cell("0,12345")), "number");
    EXPECT_EQ(form_of_cell(table_cell("0.12", "number", "345")), "number") << "a gap stands before what is not drawn";
    EXPECT_EQ(form_of_cell(table_cell("0.12", "number", "34")), "digits");
    EXPECT_EQ(form_of_cell(table_cell("5 + 3 %")), "number") << "it may not break";
    EXPECT_EQ(form_of_cell(table_cell("a sentence in a column of numbers")), "words");
    EXPECT_EQ(form_of_cell(table_cell("123", "left")), "short");
    EXPECT_EQ(form_of_cell(table_cell("t", "left"), true), "letter");
    EXPECT_EQ(form_of_cell(table_cell("t", "left")), "short") << "in the first column only";
    EXPECT_EQ(form_of_cell(table_cell("größer als U", "left")), "short") << "12 characters, more bytes";
    EXPECT_EQ(form_of_cell(table_cell("more than twelve", "left")), "words");
    EXPECT_EQ(form_of_cell(table_cell("a " + std::string(30, 'b'), "left")), "long");
    EXPECT_EQ(form_of_cell(table_cell(std::string(29, 'b') + " " + std::string(29, 'b'), "left")), "words");
}

std::string line_of_row(const std::string& text, const std::string& align = "left", const std::string& kind = "plain") {
    json table = {{"columns", json::array()}, {"rows", {{{"kind", kind}, {"cells", {table_cell(text, align)}}}}}};
    return with_typeset_tables(
        {{"sections",
          {{{"blocks", {{{"table", {table}}}}}}}}})["sections"][0]["blocks"][0]["table"][0]["rows"][0]["line"];
}

TEST(TypesetTable, TellsRowsThatAreOneLineAtAnyWidth) {
    for (const char* text :
         {"", "normal", "U_x[2]", "mg g", "µm", "k = 2", "–", "größer", "10\u00A0V\u00A0AC", "0.5\u00A0mm"}) {
        EXPECT_EQ(line_of_row(text), "one") << text;
    }
    for (const char* text : {"DMM-04", "mg/g", "1–2", "a|b", "x}y", "a,(b)", "→", "合格", "soft\u00ADhyphen",
                             "thin\u2009space", "more than twelve"}) {
        EXPECT_EQ(line_of_row(text), "") << text;
    }
    EXPECT_EQ(line_of_row("−3.127\u00A0×\u00A010⁻⁷\u00A0mg/(kg/m³)", "number"), "one") << "a number does not break";
    EXPECT_EQ(line_of_row("12\u00A0公斤", "number"), "") << "another font";
    EXPECT_EQ(line_of_row("12.5 V", "number"), "") << "a blank that breaks";
    EXPECT_EQ(line_of_row("12.5", "number", "closing"), "") << "bold";
    json both = table_cell("pass", "left");
    both["also"] = {{{"text", "bestanden"}}};
    EXPECT_EQ(typeset_table({{both}}, {"left"})["rows"][0]["line"], "");
    EXPECT_EQ(typeset_table({{table_cell("1"), table_cell("more than twelve", "left")}},
                            {"number", "left"})["rows"][0]["line"],
              "");
}

TEST(TypesetTable, KnowsThatWordsAreHyphenatedInATableOfManyColumns) {
    for (const auto& [columns, verdict, line] : {std::tuple{8, "undetermined", "one"},
                                                 {9, "100\u00A0mV\u00A0AC", "one"},
                                                 {9, "undeter\u00A0min", "one"},
                                                 {9, "undetermined", ""},
                                                 {9, "größeres", ""},
                                                 {9, "pass", "one"}}) {
        std::vector<json> row(static_cast<std::size_t>(columns), table_cell("1.5"));
        std::vector<std::string> aligned(row.size(), "number");
        row.back() = table_cell(verdict, "left");
        aligned.back() = "left";
        EXPECT_EQ(typeset_table({row}, aligned)["rows"][0]["line"], line) << columns << " columns, " << verdict;
    }
}

TEST(TypesetTable, NamesTheLongestOfDigitsAloneBesideOthers) {
    const json table =
        typeset_table({{table_cell("−3.127\u00A0×\u00A010⁻⁷")}, {table_cell("−0.03467499")}}, {"number"});
    EXPECT_EQ(table["columns"][0]["longest"],
              json::array({{{"text", "−0.03467499"}}, {{"text", "−3.127\u00A0×\u00A010⁻⁷"}}}))
        << "that of fewer characters is the wider one";
}

TEST(TypesetTable, NamesTheLongestOfAColumn) {
    const json table = typeset_table({{table_cell("one", "left"), table_cell("1.5"), table_cell("–", "left")},
                                      {table_cell("three", "left"), table_cell("−12.5", "number", "00"),
                                       table_cell("not a number but words that are long", "left")},
                                      {table_cell("seven", "left"), table_cell("22.5"), table_cell("33.25")}},
                                     {"left", "number", "number"});
    EXPECT_EQ(table["columns"][0]["longest"], json::array({{{"text", "three"}}, {{"text", "seven"}}}));
    EXPECT_EQ(table["columns"][1]["longest"], json::array({{{"text", "−12.500"}}, {{"text", "22.5"}}}));
    EXPECT_EQ(table["columns"][2]["longest"], json::array({json::object({{"text", "33.25"}})})) << "of its numbers";
    EXPECT_EQ(table["digits"], "43") << "7 and 36, whatever they are";
    json both = table_cell("pass", "left");
    both["also"] = {{{"text", "bestanden"}}};
    EXPECT_EQ(typeset_table({{both}}, {"left"})["columns"][0]["longest"],
              json::array({json::object({{"text", "pass bestanden"}})}))
        << "the second language stands behind the first";
}

/// Law: a number has the form "digits" exactly where none of its groups of digits has more than four.
TEST(TypesetTable, NumbersAreInOnePieceExactlyWithoutGroups) {
    std::mt19937 random(1);  // the same numbers on every run
    const auto draw = [&](int most) { return std::uniform_int_distribution<int>(0, most)(random); };
    for (int i = 0; i < 2000; ++i) {
        const int whole = 1 + draw(7);
        const int fraction = draw(7);
        std::string number = draw(1) == 0 ? "−" : "";
        for (int d = 0; d < whole; ++d) {
            number += static_cast<char>('0' + draw(9));
        }
        if (fraction > 0) {
            number += draw(1) == 0 ? "." : ",";
            for (int d = 0; d < fraction; ++d) {
                number += static_cast<char>('0' + draw(9));
            }
        }
        EXPECT_EQ(form_of_cell(table_cell(number)), std::max(whole, fraction) <= 4 ? "digits" : "number") << number;
    }
}

}  // namespace
}  // namespace gumcert::reports
