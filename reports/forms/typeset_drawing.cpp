#include "reports/forms/typeset_drawing.h"

#include "reports/view/symbols.h"
#include "text/numbers.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

constexpr double k_index_size = 0.72;   // of the size of the text
constexpr double k_index_depth = 0.22;  // below the line, in units of the size of the text

double size_of(std::string_view tag) {
    static constexpr std::string_view k_attribute = "font-size=\"";
    const std::size_t at = tag.find(k_attribute);
    double size = 10.0;
    if (at != std::string_view::npos) {
        const char* const from = tag.data() + at + k_attribute.size();
        std::from_chars(from, tag.data() + tag.size(), size);
    }
    return size;
}

std::string short_number(double v) {
    return text::without_trailing_zeros(text::fixed(v, 2));
}

bool is_latin_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Single letters that a drawing shows as quantities: "x / mm" of an axis, U and θ wherever they stand alone.
std::vector<SymbolPiece> with_letters(const std::string& text, bool begins) {
    static constexpr std::string_view k_theta = "θ";
    std::vector<SymbolPiece> pieces;
    std::string between;
    for (std::size_t at = 0; at < text.size();) {
        const bool theta = std::string_view(text).substr(at).starts_with(k_theta);
        const std::size_t length = theta ? k_theta.size() : 1;
        const auto ends_word = [&](std::size_t i) {
            return i >= text.size() || static_cast<unsigned char>(text[i]) >= 0x80U ||
                   std::string_view(" ,;:()").find(text[i]) != std::string_view::npos;
        };
        const bool alone = (at == 0 || ends_word(at - 1)) && ends_word(at + length);
        const bool axis =
            begins && at == 0 && is_latin_letter(text[0]) && std::string_view(text).substr(1).starts_with(" / ");
        if (alone && (theta || axis || text[at] == 'U')) {
            if (!between.empty()) {
                pieces.push_back({.text = std::exchange(between, {}), .symbol = {}});
            }
            const std::string letter = text.substr(at, length);
            pieces.push_back({.text = letter, .symbol = {.base = letter, .index = {}}});
        } else {
            between += text.substr(at, length);
        }
        at += length;
    }
    if (!between.empty()) {
        pieces.push_back({.text = std::move(between), .symbol = {}});
    }
    return pieces;
}

/// What stands inside of a text element.
std::string typeset_text(const std::string& text, double size, const SymbolFinder& finder) {
    std::vector<SymbolPiece> pieces;
    if (finder.is_letter(text)) {
        pieces.push_back({.text = text, .symbol = {.base = text, .index = {}}});
    } else {
        for (SymbolPiece& piece : finder.pieces(text)) {
            if (!piece.symbol.base.empty()) {
                pieces.push_back(std::move(piece));
                continue;
            }
            std::vector<SymbolPiece> parts = with_letters(piece.text, pieces.empty());
            pieces.insert(pieces.end(), parts.begin(), parts.end());
        }
    }
    std::string out;
    bool is_low = false;  // a shift holds until the next one
    const std::string depth = short_number(k_index_depth * size);
    const auto span = [&](const std::string& attributes, const std::string& content) {
        out += "<tspan" + attributes + (std::exchange(is_low, false) ? " dy=\"-" + depth + "\">" : ">") + content +
               "</tspan>";
    };
    for (const SymbolPiece& piece : pieces) {
        if (!piece.symbol.base.empty()) {
            span(" font-style=\"italic\"", piece.symbol.base);
            if (!piece.symbol.index.empty()) {
                out += "<tspan font-size=\"" + short_number(k_index_size * size) + "\" dy=\"" + depth + "\">" +
                       piece.symbol.index + "</tspan>";
                is_low = true;
            }
        } else if (is_low) {
            span("", piece.text);
        } else {
            out += piece.text;
        }
    }
    return out;
}

std::string typeset_drawing(const std::string& svg, const SymbolFinder& finder) {
    std::string out;
    std::size_t at = 0;
    for (;;) {
        const std::size_t begin = svg.find("<text ", at);
        const std::size_t open = begin == std::string::npos ? begin : svg.find('>', begin);
        const std::size_t end = open == std::string::npos ? open : svg.find("</text>", open);
        if (end == std::string::npos) {
            return out + svg.substr(at);
        }
        const double size = size_of(std::string_view(svg).substr(begin, open - begin));
        out += svg.substr(at, open + 1 - at) + typeset_text(svg.substr(open + 1, end - open - 1), size, finder) +
               "</text>";
        at = end + std::string_view("</text>").size();
    }
}

}  // namespace

std::string typeset_drawing(const std::string& svg, const nlohmann::json& view) {
    return typeset_drawing(svg, SymbolFinder(view));
}

nlohmann::json with_typeset_drawings(nlohmann::json view) {
    const SymbolFinder finder(view);
    const auto sections = view.find("sections");
    if (sections != view.end()) {
        for (nlohmann::json& section : *sections) {
            for (nlohmann::json& block : section.at("blocks")) {
                for (nlohmann::json& figure : block.at("figure")) {
                    figure["svg"] = typeset_drawing(figure.at("svg").get<std::string>(), finder);
                }
            }
        }
    }
    return view;
}

}  // namespace gumcert::reports
