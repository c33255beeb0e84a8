#include "jobs/svg_image.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "text/utf8.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

constexpr std::size_t k_most_svg_elements = 20000;
constexpr std::size_t k_deepest_svg = 32;

constexpr std::array<std::string_view, 17> k_svg_elements{
    "svg",  "g",     "path", "rect",           "circle",         "ellipse", "line",     "polyline", "polygon",
    "defs", "title", "desc", "linearGradient", "radialGradient", "stop",    "clipPath", "style"};

/// What may stand before a parenthesis in an attribute or a style. A url() leads to a part of the drawing.
constexpr std::array<std::string_view, 11> k_svg_functions{"url",   "matrix", "translate", "scale", "rotate", "skewX",
                                                           "skewY", "rgb",    "rgba",      "hsl",   "hsla"};

constexpr std::array<std::string_view, 5> k_svg_entities{"amp;", "lt;", "gt;", "quot;", "apos;"};

constexpr std::string_view k_svg_namespace = "http://www.w3.org/2000/svg";

template <std::size_t n>
bool is_one_of(const std::array<std::string_view, n>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_svg_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_svg_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == ':' ||
           c == '-' || c == '.';
}

/// Reads the drawing from its beginning to its end; the first objection ends it.
class SvgReader {
public:
    explicit SvgReader(std::string_view bytes) : rest_(bytes) {}

    std::string objection() {
        if (!text::is_utf8(rest_) || std::any_of(rest_.begin(), rest_.end(), [](char c) {
                return (static_cast<unsigned char>(c) < 0x20U && !is_svg_space(c)) || c == '\x7F';
            })) {
            return "an SVG drawing that is no text in UTF-8";
        }
        if (rest_.starts_with("\xEF\xBB\xBF")) {
            rest_.remove_prefix(3);
        }
        read_declaration();
        while (objection_.empty() && !rest_.empty()) {
            if (rest_.front() == '<') {
                read_markup();
            } else {
                read_text();
            }
        }
        if (objection_.empty() && (!open_.empty() || elements_ == 0)) {
            object("that is cut off");
        }
        return std::move(objection_);
    }

private:
    void object(const std::string& what) {
        if (objection_.empty()) {
            objection_ = "an SVG drawing " + what;
        }
    }
    void object_with(const std::string& what, std::string_view name) { object(what + " " + text::in_quotes(name)); }

    /// What stands before a mark, which is taken away with it; nothing, and an objection, where there is no mark.
    std::optional<std::string_view> up_to(std::string_view mark) {
        const std::size_t end = rest_.find(mark);
        if (end == std::string_view::npos) {
            object("that is cut off");
            return std::nullopt;
        }
        const std::string_view before = rest_.substr(0, end);
        rest_.remove_prefix(end + mark.size());
        return before;
    }
    void skip_spaces() {
        while (!rest_.empty() && is_svg_space(rest_.front())) {
            rest_.remove_prefix(1);
        }
    }
    std::string_view take_name() {
        const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_svg_name);
        const std::string_view name = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
        rest_.remove_prefix(name.size());
        return name;
    }

    void read_declaration() {
        if (!rest_.starts_with("<?xml") || rest_.size() < 6 || !is_svg_space(rest_[5])) {
            return;
        }
        const auto declaration = up_to("?>");
        if (!declaration) {
            return;
        }
        // XML 1.0, production 23: version, encoding and standalone in this order, and nothing else.
        std::string_view rest = declaration->substr(5);
        const auto version = taken_value(rest, "version");
        const auto encoding = taken_value(rest, "encoding");
        (void)taken_value(rest, "standalone");
        if (!version || !std::all_of(rest.begin(), rest.end(), is_svg_space)) {
            object("with a malformed XML declaration");
        } else if (encoding && *encoding != "UTF-8" && *encoding != "utf-8") {
            object("that is not in UTF-8");
        }
    }
    /// The value of ` name="value"` at the beginning of a text, which is taken away with it; nothing where it is not there.
    static std::optional<std::string_view> taken_value(std::string_view& text, std::string_view name) {
        std::string_view rest = text;
        const auto skip = [&rest] { rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size())); };
        const auto take = [&](std::string_view mark) {
            skip();
            const bool is_there = rest.starts_with(mark);
            rest.remove_prefix(is_there ? mark.size() : 0);
            return is_there;
        };
        if (rest.empty() || !is_svg_space(rest.front()) || !take(name) || !take("=")) {
            return std::nullopt;
        }
        const std::string_view quote = take("'") ? "'" : take("\"") ? "\"" : "";
        const std::size_t end = quote.empty() ? std::string_view::npos : rest.find(quote);
        const std::string_view value = rest.substr(0, end);
        if (end == std::string_view::npos || !std::all_of(value.begin(), value.end(), is_svg_name)) {
            return std::nullopt;
        }
        text = rest.substr(end + 1);
        return value;
    }

    void read_markup() {
        if (rest_.starts_with("<!--")) {
            rest_.remove_prefix(4);
            (void)up_to("-->");
        } else if (rest_.starts_with("<!")) {
            object("with a document type, an entity or a CDATA section");
        } else if (rest_.starts_with("<?")) {
            object("with a processing instruction");
        } else if (rest_.starts_with("</")) {
            rest_.remove_prefix(2);
            const std::string_view name = take_name();
            skip_spaces();
            if (!rest_.starts_with('>') || open_.empty() || open_.back() != name) {
                object("whose elements are not closed in their order");
                return;
            }
            rest_.remove_prefix(1);
            open_.pop_back();
        } else {
            rest_.remove_prefix(1);
            read_element();
        }
    }

    void read_element() {
        const std::string_view name = take_name();
        if (!is_one_of(k_svg_elements, name)) {
            object_with("with the element", name);
            return;
        }
        const bool is_root = elements_ == 0;
        if ((name == "svg") != is_root || (!is_root && open_.empty())) {
            object("with one drawing in or behind another one");
            return;
        }
        if (++elements_ > k_most_svg_elements || open_.size() == k_deepest_svg) {
            object("of more than " + std::to_string(k_most_svg_elements) + " elements, or " +
                   std::to_string(k_deepest_svg) + " within each other");
            return;
        }
        std::vector<std::string_view> names;
        bool has_namespace = false;
        bool has_view_box = false;
        while (objection_.empty()) {
            const std::size_t before = rest_.size();
            skip_spaces();
            if (rest_.starts_with("/>") || rest_.starts_with('>')) {
                break;
            }
            const bool is_apart = rest_.size() < before;
            const std::string_view attribute = take_name();
            skip_spaces();
            if (attribute.empty() || !is_apart || !rest_.starts_with('=')) {
                object("with an attribute that is not written as one");
                return;
            }
            rest_.remove_prefix(1);
            skip_spaces();
            const char quote = rest_.empty() ? '\0' : rest_.front();
            if (quote != '"' && quote != '\'') {
                object("with an attribute that is not written as one");
                return;
            }
            rest_.remove_prefix(1);
            const auto value = up_to(std::string_view(&quote, 1));
            if (!value) {
                return;
            }
            if (is_one_of_names(names, attribute)) {
                object_with("that states twice the attribute", attribute);
            }
            names.push_back(attribute);
            has_namespace = has_namespace || (attribute == "xmlns" && *value == k_svg_namespace);
            has_view_box = has_view_box || (attribute == "viewBox" && is_view_box(*value));
            check_attribute(attribute, *value);
        }
        if (is_root && !(has_namespace && has_view_box)) {
            object(has_namespace ? "without a viewBox of four numbers, width and height above 0 and sides within 1:20"
                                 : "without its namespace " + std::string(k_svg_namespace));
        }
        if (!objection_.empty()) {
            return;
        }
        if (rest_.starts_with("/>")) {
            rest_.remove_prefix(2);
        } else {
            rest_.remove_prefix(1);
            open_.push_back(name);
        }
    }

    static bool is_one_of_names(const std::vector<std::string_view>& names, std::string_view name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    }

    void check_attribute(std::string_view name, std::string_view value) {
        if (name == "xmlns" ? value == k_svg_namespace : name.starts_with("xmlns:")) {
            // It names a vocabulary, which is used by nothing here.
            if (value.find_first_of("<&") != std::string_view::npos) {
                object_with("with the attribute", name);
            }
            return;
        }
        const bool is_reference = name == "href" || name == "xlink:href";
        if (name == "xmlns" || (name.find(':') != std::string_view::npos && !is_reference && name != "xml:space")) {
            object_with("with the attribute", name);
        } else if (name.size() > 2 && (name[0] == 'o' || name[0] == 'O') && (name[1] == 'n' || name[1] == 'N')) {
            object_with("with the attribute", name);
        } else if (is_reference && !value.starts_with('#')) {
            object_with("that refers to", value);
        } else {
            check_value(value);
        }
    }

    /// A value of an attribute, or a style sheet: no escapes, no rules that fetch, no functions but those of shapes.
    void check_value(std::string_view value) {
        check_entities(value);
        for (const std::string_view mark : {"\\", "@", "//", "/*", "<"}) {
            if (value.find(mark) != std::string_view::npos) {
                object_with("with an attribute or a style that has", mark);
            }
        }
        for (std::size_t at = value.find('('); at != std::string_view::npos; at = value.find('(', at + 1)) {
            std::size_t end = at;
            while (end > 0 && is_svg_space(value[end - 1])) {
                --end;
            }
            std::size_t begin = end;
            while (begin > 0 && is_svg_name(value[begin - 1]) && value[begin - 1] != ':') {
                --begin;
            }
            const std::string_view function = value.substr(begin, end - begin);
            if (!is_one_of(k_svg_functions, function)) {
                object_with("with the function", function);
            } else if (function == "url") {
                std::string_view inside = value.substr(at + 1);
                while (!inside.empty() && (is_svg_space(inside[0]) || inside[0] == '"' || inside[0] == '\'')) {
                    inside.remove_prefix(1);
                }
                if (!inside.starts_with('#')) {
                    object_with("that refers to", inside.substr(0, inside.find(')')));
                }
            }
        }
    }

    /// An entity of a document type may hold anything, and a character by its number may hide what is looked for.
    void check_entities(std::string_view value) {
        for (std::size_t at = value.find('&'); at != std::string_view::npos; at = value.find('&', at + 1)) {
            const std::string_view after = value.substr(at + 1);
            if (std::none_of(k_svg_entities.begin(), k_svg_entities.end(),
                             [&](std::string_view entity) { return after.starts_with(entity); })) {
                object_with("with the entity", after.substr(0, std::min<std::size_t>(after.find(';'), 20)));
            }
        }
    }

    void read_text() {
        const std::size_t end = std::min(rest_.find('<'), rest_.size());
        const std::string_view content = rest_.substr(0, end);
        rest_.remove_prefix(end);
        if (std::all_of(content.begin(), content.end(), is_svg_space)) {
            return;
        }
        const std::string_view in = open_.empty() ? std::string_view() : open_.back();
        if (in == "style") {
            check_value(content);
        } else if (in == "title" || in == "desc") {
            check_entities(content);
        } else {
            object("with text outside of title, desc and style");
        }
    }

    static bool is_view_box(std::string_view value) {
        constexpr double k_most_slender = 20.0;
        std::array<double, 4> numbers{};
        for (double& number : numbers) {
            const std::size_t begin = value.find_first_not_of(" \t\r\n,");
            value.remove_prefix(std::min(begin, value.size()));
            const auto [next, error] = std::from_chars(value.data(), value.data() + value.size(), number);
            if (error != std::errc() || !std::isfinite(number)) {
                return false;
            }
            value.remove_prefix(static_cast<std::size_t>(next - value.data()));
        }
        const auto [x, y, width, height] = numbers;
        return std::all_of(value.begin(), value.end(), is_svg_space) && width > 0.0 && height > 0.0 &&
               width <= k_most_slender * height && height <= k_most_slender * width;
    }

    std::string_view rest_;
    std::vector<std::string_view> open_;  ///< names of the elements that are not closed
    std::size_t elements_ = 0;
    std::string objection_;
};

}  // namespace

std::string svg_objection(std::string_view bytes) {
    return SvgReader(bytes).objection();
}

bool looks_like_svg(std::string_view bytes) {
    constexpr std::size_t k_beginning = 4096;
    return bytes.substr(0, k_beginning).find("<svg") != std::string_view::npos || bytes.starts_with("<?xml");
}

}  // namespace gumcert::jobs
