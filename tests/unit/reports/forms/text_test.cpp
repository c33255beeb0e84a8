#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "reports/forms/document_forms.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;

json text(const std::string& words) {
    return {{"text", words}, {"also", json::array()}, {"pad", ""}, {"span", "1"}};
}

/// A document with one table.
json view_of_table(const json& columns, const json& rows) {
    json table = {{"caption", "Results."}, {"caption_also", json::array()}, {"number", "Table 1"}};
    table["number_also"] = json::array();
    table["groups"] = json::array();
    table["columns"] = columns;
    table["rows"] = rows;
    json block;
    for (const char* kind : {"paragraph", "formula", "definitions", "table"}) {
        block[kind] = json::array();
    }
    block["table"].push_back(table);
    json view = {{"mark", json::array()}, {"identity", json::array()}, {"closing", json::array()}};
    for (const char* key : {"type", "title", "end_mark"}) {
        view[key] = "Document";
        view[std::string(key) + "_also"] = json::array();
    }
    view["sections"] = {{{"heading", "Results"}, {"heading_also", json::array()}, {"blocks", {block}}}};
    return view;
}

/// A table of standards has eight columns of words: they wrap between words as long as the words fit side by side.
TEST(TextForm, BreaksNoWordOfATableWhereTheWordsFit) {
    std::mt19937_64 drawn(1129);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(drawn() % n); };
    for (int document = 0; document < 200; ++document) {
        json columns = json::array(), cells = json::array();
        std::vector<std::string> words;
        std::size_t needed = 0;
        const auto some = [&](std::size_t longest) {
            std::string text;
            for (std::size_t i = 0; i < 1 + below(6); ++i) {
                words.push_back(std::string(1, static_cast<char>('a' + below(26))) +
                                std::string(1 + below(longest), 'o'));
                text += (text.empty() ? "" : " ") + words.back();
            }
            return text;
        };
        const std::size_t count = 2 + below(7);
        for (std::size_t c = 0; c < count; ++c) {
            const std::size_t longest = 3 + below(12);  // without the first letter
            needed += longest + 2;                      // and the gap
            columns.push_back({{"head", some(longest)}, {"head_also", json::array()}, {"unit", json::array()}});
            columns.back()["align"] = below(4) == 0 ? "number" : "text";
            cells.push_back(text(columns.back()["align"] == "number" ? std::to_string(below(1000)) : some(longest)));
        }
        if (needed > 100) {
            continue;
        }
        const std::string printed = view_as_text(view_of_table(columns, {{{"kind", ""}, {"cells", cells}}}));
        for (const std::string& word : words) {
            ASSERT_NE(printed.find(word), std::string::npos) << word << "\n" << printed;
        }
    }
}

/// A number that is broken into two lines reads as another one.
TEST(TextForm, BreaksNoNumberOfATableHoweverWideItIs) {
    std::mt19937_64 drawn(20261129);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(drawn() % n); };
    for (int document = 0; document < 200; ++document) {
        json columns = json::array();
        const std::size_t count = 1 + below(14);
        for (std::size_t c = 0; c < count; ++c) {
            const bool is_number = c > 0 || below(2) == 0;
            columns.push_back({{"head", below(2) == 0 ? "U" : "Expanded uncertainty"},
                               {"head_also", json::array()},
                               {"unit", below(2) == 0 ? json::array({text("mW")}) : json::array()},
                               {"align", is_number ? "number" : "text"}});
            if (below(3) == 0) {
                columns.back()["head_also"].push_back(text("Erweiterte Messunsicherheit"));
            }
        }
        json rows = json::array();
        for (std::size_t r = 0; r < 3; ++r) {
            json cells = json::array();
            for (std::size_t c = 0; c < count; ++c) {
                std::string digits = std::to_string(1000 * r + c) + "." + std::string(1 + below(12), '5');
                digits += below(5) == 0 ? " × 10⁻⁷" : "";
                cells.push_back(text(columns[c]["align"] == "number" ? digits : "a remark that may be wrapped"));
            }
            rows.push_back({{"kind", ""}, {"cells", cells}});
        }
        const std::string printed = view_as_text(view_of_table(columns, rows));
        for (const json& row : rows) {
            std::size_t from = 0;
            for (std::size_t c = 0; c < count; ++c) {
                if (columns[c]["align"] == "number") {
                    const auto number = row["cells"][c]["text"].get<std::string>();
                    const std::size_t at = printed.find(number, from);
                    ASSERT_NE(at, std::string::npos) << number << "\n" << printed;
                    from = at + number.size();
                }
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
