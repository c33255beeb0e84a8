#include "reports/forms/style_sheet.h"

#include "text/small_letters.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <utility>

namespace gumcert::reports {

namespace {

bool is_blank_of_sheet(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f';
}

/// One blank for several, none at the ends.
std::string with_single_blanks(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (!is_blank_of_sheet(c)) {
            out += c;
        } else if (!out.empty() && out.back() != ' ') {
            out += ' ';
        }
    }
    out.erase(out.size() - (out.ends_with(' ') ? 1U : 0U));
    return out;
}

/// The same without blanks beside characters that separate by themselves.
std::string with_needed_blanks(std::string_view text, std::string_view separators) {
    const std::string all = with_single_blanks(text);
    const auto separates = [&](std::size_t at) {
        return at < all.size() && separators.find(all[at]) != std::string_view::npos;
    };
    std::string out;
    for (std::size_t at = 0; at < all.size(); ++at) {
        const bool is_idle = all[at] == ' ' && (separates(at + 1) || (at > 0 && separates(at - 1)));
        out += is_idle ? "" : std::string(1, all[at]);
    }
    return out;
}

/// A comment with braces stays: its block is none that is known, wherever a browser may see its end.
std::string without_comments(std::string_view sheet) {
    std::string out;
    char quote = '\0';
    for (std::size_t at = 0; at < sheet.size();) {
        const char c = sheet[at];
        if (quote == '\0' && sheet.substr(at).starts_with("/*")) {
            const std::size_t end = sheet.find("*/", at + 2);
            const std::size_t behind = end == std::string_view::npos ? sheet.size() : end + 2;
            const std::string_view comment = sheet.substr(at, behind - at);
            out += comment.find_first_of("{}") == std::string_view::npos ? std::string_view(" ") : comment;
            at = behind;
            continue;
        }
        if (quote != '\0' && (c == quote || c == '\n' || c == '\r' || c == '\f')) {
            quote = '\0';
        } else if (quote == '\0' && (c == '"' || c == '\'')) {
            quote = c;
        }
        out += c;
        ++at;
    }
    return out;
}

/// Behind the brace that closes the one at `open`.
std::size_t end_of_block(std::string_view sheet, std::size_t open) {
    std::size_t depth = 0;
    for (std::size_t at = open; at < sheet.size(); ++at) {
        depth += sheet[at] == '{' ? 1U : 0U;
        if (sheet[at] == '}' && --depth == 0) {
            return at + 1;
        }
    }
    return sheet.size();
}

constexpr double k_widest = 1280.0;  // [px]: what is wider puts what stands at its right beyond the page

/// Sizes of a CSS pixel; 0 for a unit that is not known.
double pixels_of(std::string_view unit) {
    static constexpr std::array<std::pair<std::string_view, double>, 9> k_units = {{{"px", 1.0},
                                                                                    {"pt", 96.0 / 72.0},
                                                                                    {"pc", 16.0},
                                                                                    {"in", 96.0},
                                                                                    {"cm", 96.0 / 2.54},
                                                                                    {"mm", 96.0 / 25.4},
                                                                                    {"rem", 16.0},
                                                                                    {"em", 16.0},
                                                                                    {"ch", 8.0}}};
    const auto* const found =
        std::find_if(k_units.begin(), k_units.end(), [&](const auto& known) { return known.first == unit; });
    return found == k_units.end() ? 0.0 : found->second;
}

struct Measure {
    double number = 0.0;
    std::string_view unit;
};

std::optional<Measure> measure_in(std::string_view token) {
    Measure measure;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), measure.number,
                                              std::chars_format::fixed);  // "1e9px" has the unit "e9px"
    if (error != std::errc()) {
        return std::nullopt;
    }
    measure.unit = token.substr(static_cast<std::size_t>(end - token.data()));
    return measure;
}

/// What values a property may have.
struct PlainProperty {
    std::string_view name;   ///< one that ends with '-' stands for all that begin so, and for the one without it
    std::string_view words;  ///< with a blank before and behind each
    double least = 1.0;      ///< lengths [px]; without one where it is more than `most`
    double most = 0.0;
    double most_percent = -1.0;
    double least_number = 1.0;  ///< numbers without a unit, beside the 0 of lengths
    double most_number = 0.0;
};

constexpr double k_widest_space = 96.0;      // px: six lines of text
constexpr double k_widest_line = 8.0;        // px: of a border
constexpr double k_least_width = 320.0;      // px: of what has text; narrower ones cut it off where they are scrolled
constexpr double k_smallest_letters = 10.0;  // px
constexpr double k_largest_letters = 64.0;   // px

// What these could do to a text: margins and spaces that are not negative push it by a few lines; sizes are not those of the
// text around them ("em", "%"), which in twenty elements within each other come to nothing.
constexpr std::array<PlainProperty, 26> k_plain_properties = {{
    {"margin-", " auto ", 0.0, k_widest_space, 10.0},
    {"padding-", " ", 0.0, k_widest_space, 10.0},
    {"gap", " normal ", 0.0, k_widest_space},
    {"row-gap", " normal ", 0.0, k_widest_space},
    {"column-gap", " normal ", 0.0, k_widest_space},
    {"border", " none solid dashed dotted double #000 #000000 black ", 0.0, k_widest_line},
    {"border-top", " none solid dashed dotted double #000 #000000 black ", 0.0, k_widest_line},
    {"border-bottom", " none solid dashed dotted double #000 #000000 black ", 0.0, k_widest_line},
    {"border-left", " none solid dashed dotted double #000 #000000 black ", 0.0, k_widest_line},
    {"border-right", " none solid dashed dotted double #000 #000000 black ", 0.0, k_widest_line},
    {"border-collapse", " collapse separate "},
    {"border-spacing", " ", 0.0, k_widest_space},
    {"font-size", " small medium large x-large xx-large ", k_smallest_letters, k_largest_letters},
    {"font-weight", " normal bold bolder lighter ", 1.0, 0.0, -1.0, 100.0, 900.0},
    {"font-style", " normal italic "},
    {"font-variant-numeric", " normal lining-nums tabular-nums proportional-nums "},
    {"line-height", " normal ", 1.0, 0.0, -1.0, 1.0, 3.0},
    {"text-align", " left right center justify start end "},
    {"vertical-align", " top middle bottom baseline "},
    {"white-space", " normal nowrap "},
    {"overflow-wrap", " normal break-word anywhere "},
    {"caption-side", " top bottom "},
    {"break-", " auto avoid page avoid-page "},
    {"page-break-", " auto avoid always "},
    {"width", " auto ", k_least_width, k_widest},
    {"max-width", " none ", k_least_width, k_widest},
}};

/// Fonts that have letters and digits for letters and digits.
bool is_plain_font(std::string_view name) {
    static constexpr std::array<std::string_view, 26> k_fonts = {
        "serif",           "sans-serif",     "monospace",   "system-ui",       "arial",
        "helvetica",       "helvetica neue", "verdana",     "tahoma",          "calibri",
        "segoe ui",        "georgia",        "cambria",     "times",           "times new roman",
        "courier",         "roboto",         "courier new", "libertinus sans", "libertinus serif",
        "libertinus mono", "open sans",      "noto sans",   "noto serif",      "dejavu sans",
        "dejavu serif"};
    const bool is_quoted = name.size() > 1 && (name.front() == '"' || name.front() == '\'') && name.back() == name[0];
    const std::string_view bare = is_quoted ? name.substr(1, name.size() - 2) : name;
    return std::find(k_fonts.begin(), k_fonts.end(), bare) != k_fonts.end();
}

bool is_plain_value(std::string_view token, const PlainProperty& property, bool of_picture) {
    if (property.words.find(' ' + std::string(token) + ' ') != std::string_view::npos) {
        return true;
    }
    const std::optional<Measure> measure = measure_in(token);
    if (!measure) {
        return false;
    }
    const bool is_width = property.name == "width" || property.name == "max-width";
    const bool may_be_narrow = of_picture && is_width;
    const double least = may_be_narrow ? 0.0 : property.least;
    if (measure->unit.empty()) {
        return (measure->number == 0.0 && least == 0.0) ||
               (measure->number >= property.least_number && measure->number <= property.most_number);
    }
    if (measure->unit == "%") {
        const bool is_whole = is_width && least > 0.0 && measure->number == 100.0;
        return is_whole || (may_be_narrow && measure->number >= 0.0 && measure->number <= 100.0) ||
               (measure->number >= 0.0 && measure->number <= property.most_percent);
    }
    // Of the text around it: twice as small in each of twenty elements is not seen.
    const bool is_relative = measure->unit == "em" || measure->unit == "ch";
    const double length = measure->number * pixels_of(measure->unit);
    return pixels_of(measure->unit) > 0.0 && length >= least && length <= property.most &&
           !(is_relative && property.least > 0.0);
}

/// Calls with each part between separators.
template <class Work>
bool all_parts(std::string_view text, char separator, const Work& work) {
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(separator, at), text.size());
        if (!work(text.substr(at, end - at))) {
            return false;
        }
        at = end + 1;
    }
    return true;
}

bool is_plain_selector(std::string_view selector) {
    return selector.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 .,#:*>+~_-()") ==
           std::string_view::npos;
}

}  // namespace

bool is_plain_declaration(std::string_view declaration, bool of_picture) {
    const std::string all = text::in_small_letters(with_single_blanks(declaration));
    if (all.empty()) {
        return true;
    }
    const std::size_t colon = std::min(all.find(':'), all.size());
    const std::string name = with_single_blanks(std::string_view(all).substr(0, colon));
    const std::string value = with_single_blanks(std::string_view(all).substr(std::min(colon + 1, all.size())));
    if (value.empty()) {
        return false;
    }
    if (name == "font-family") {
        return all_parts(value, ',', [](std::string_view font) { return is_plain_font(with_single_blanks(font)); });
    }
    const auto* const property =
        std::find_if(k_plain_properties.begin(), k_plain_properties.end(), [&](const PlainProperty& known) {
            const bool of_sides = known.name.ends_with('-');
            return known.name == name ||
                   (of_sides && (name.starts_with(known.name) || known.name.substr(0, known.name.size() - 1) == name));
        });
    return property != k_plain_properties.end() &&
           all_parts(value, ' ', [&](std::string_view token) { return is_plain_value(token, *property, of_picture); });
}

std::vector<std::string> style_blocks(std::string_view sheet) {
    const std::string all = without_comments(sheet);
    const std::string_view rest = all;
    std::vector<std::string> blocks;
    constexpr std::string_view k_in_selectors = ",>+~";
    constexpr std::string_view k_in_declarations = "{};:,";
    std::string media;  // what the block stands in
    for (std::size_t at = 0; at < rest.size();) {
        const std::size_t brace = std::min(rest.find_first_of("{}", at), rest.size());
        const std::string before = with_needed_blanks(rest.substr(at, brace - at), k_in_selectors);
        at = std::min(brace + 1, rest.size());
        if (brace == rest.size() || rest[brace] == '}') {
            const bool closes = brace < rest.size() && !media.empty();
            if (!before.empty() || (brace < rest.size() && !closes)) {
                blocks.push_back(media + before + (brace == rest.size() ? "" : "}"));
            }
            media.erase(closes ? 0 : media.size());
        } else if (media.empty() && text::in_small_letters(before).starts_with("@media")) {
            media = before + '|';
        } else {
            at = end_of_block(rest, brace);
            blocks.push_back(media + before + with_needed_blanks(rest.substr(brace, at - brace), k_in_declarations));
        }
    }
    return blocks;
}

bool is_plain_block(std::string_view block) {
    const std::size_t open = block.find('{');
    if (open == std::string_view::npos || !block.ends_with('}')) {
        return false;
    }
    std::string_view selector = block.substr(0, open);
    if (const std::size_t media = selector.find('|'); media != std::string_view::npos) {
        const std::string condition = text::in_small_letters(selector.substr(0, media));
        if (!condition.starts_with("@media ") || !is_plain_selector(std::string_view(condition).substr(1))) {
            return false;
        }
        selector.remove_prefix(media + 1);
    }
    if (!is_plain_selector(selector)) {
        return false;
    }
    return all_parts(block.substr(open + 1, block.size() - open - 2), ';',
                     [](std::string_view declaration) { return is_plain_declaration(declaration); });
}

}  // namespace gumcert::reports
