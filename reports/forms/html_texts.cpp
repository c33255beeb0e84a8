#include "reports/forms/html_texts.h"

#include "reports/forms/style_sheet.h"
#include "text/small_letters.h"
#include "text/utf8.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

/// The character that "&…;" stands for; "" for one that is not known.
std::string referred(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> k_names = {
        {{"amp", "&"}, {"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"apos", "'"}, {"nbsp", "\u00A0"}, {"shy", "\u00AD"}}};
    for (const auto& [known, character] : k_names) {
        if (name == known) {
            return std::string(character);
        }
    }
    if (!name.starts_with('#')) {
        return {};
    }
    const bool hexadecimal = name.size() > 1 && (name[1] == 'x' || name[1] == 'X');
    const std::string_view digits = name.substr(hexadecimal ? 2 : 1);
    unsigned code = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), code, hexadecimal ? 16 : 10);
    const bool is_code = error == std::errc() && end == digits.data() + digits.size() && code > 0 && code < 0x110000U &&
                         !(code >= 0xD800U && code < 0xE000U);
    return is_code ? text::encode_utf8(code) : std::string();
}

std::string without_references(std::string_view text) {
    constexpr std::size_t k_longest = 10;
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        // Looked for no further than a reference may be long: a page of nothing but "&" is read once, not once a sign.
        const std::size_t length = text[at] == '&' ? text.substr(at, k_longest + 1).find(';') : std::string_view::npos;
        const std::size_t end = at + length;
        const std::string character =
            length != std::string_view::npos ? referred(text.substr(at + 1, length - 1)) : std::string();
        out += character.empty() ? std::string(1, text[at]) : character;
        at = character.empty() ? at + 1 : end + 1;
    }
    return out;
}

/// Where a tag ends: behind a '>' that stands in no quotes.
std::size_t end_of_tag(std::string_view html, std::size_t at) {
    char quote = '\0';
    for (; at < html.size(); ++at) {
        const char c = html[at];
        if (quote != '\0') {
            quote = c == quote ? '\0' : quote;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '>') {
            return at + 1;
        }
    }
    return html.size();
}

/// "p" of "<p class>" and of "</p>".
std::string name_of_tag(std::string_view tag) {
    std::size_t end = 1;
    end += end < tag.size() && tag[end] == '/' ? 1U : 0U;
    const std::size_t from = end;
    while (end < tag.size() && ((tag[end] >= 'a' && tag[end] <= 'z') || (tag[end] >= 'A' && tag[end] <= 'Z') ||
                                (tag[end] >= '0' && tag[end] <= '9'))) {
        ++end;
    }
    return text::in_small_letters(tag.substr(from, end - from));
}

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Elements that stand within a line: what is before and behind their tags belongs together, such as "-" and "4.9".
bool is_within_a_line(std::string_view name) {
    static constexpr std::array<std::string_view, 14> k_names = {"a", "abbr", "b",     "bdi",    "cite", "code", "em",
                                                                 "i", "q",    "small", "strong", "sub",  "sup",  "u"};
    return is_one_of(k_names, name) || name == "span" || name == "wbr" || name == "bdo" || name == "font";
}

/// Where the contents of an element end that are not looked into.
std::size_t end_of_element(std::string_view html, std::string_view small, const std::string& name, std::size_t from) {
    const std::size_t end = small.find("</" + name, from);
    return end == std::string_view::npos ? html.size() : end_of_tag(html, end);
}

}  // namespace

std::string text_of_html(std::string_view html) {
    static constexpr std::array<std::string_view, 5> k_unseen = {"head", "style", "script", "svg", "template"};
    const std::string small = text::in_small_letters(html);
    std::string text;
    for (std::size_t at = 0; at < html.size();) {
        const std::size_t tag = html.find('<', at);
        text += without_references(html.substr(at, tag == std::string_view::npos ? tag : tag - at));
        if (tag == std::string_view::npos) {
            break;
        }
        if (html.substr(tag).starts_with("<!--")) {
            const std::size_t end = html.find("-->", tag);
            at = end == std::string_view::npos ? html.size() : end + 3;
            continue;
        }
        at = end_of_tag(html, tag);
        const std::string name = name_of_tag(html.substr(tag, at - tag));
        text += is_within_a_line(name) ? "" : " ";
        if (!html.substr(tag).starts_with("</") && is_one_of(k_unseen, name)) {
            at = end_of_element(html, small, name, at);
        }
    }
    return text;
}

namespace {

std::string without_any_blanks(std::string_view text) {
    std::string out;
    std::copy_if(text.begin(), text.end(), std::back_inserter(out),
                 [](char c) { return c != ' ' && c != '\t' && c != '\r' && c != '\n' && c != '\f'; });
    return out;
}

/// Names in small letters, values as they stand.
std::vector<std::pair<std::string, std::string>> attributes_of(std::string_view tag) {
    const auto is_white = [](char c) {
        return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '/';
    };
    std::vector<std::pair<std::string, std::string>> all;
    std::size_t at = 1 + name_of_tag(tag).size();
    tag = tag.substr(0, tag.ends_with('>') ? tag.size() - 1 : tag.size());
    while (at < tag.size()) {
        while (at < tag.size() && is_white(tag[at])) {
            ++at;
        }
        const std::size_t begin = at;
        while (at < tag.size() && !is_white(tag[at]) && (tag[at] != '=' || at == begin)) {
            ++at;
        }
        if (at == begin) {
            break;
        }
        std::string name = text::in_small_letters(tag.substr(begin, at - begin));
        std::size_t behind = at;
        while (behind < tag.size() && is_white(tag[behind]) && tag[behind] != '/') {
            ++behind;
        }
        std::string_view value;
        if (behind < tag.size() && tag[behind] == '=') {
            at = behind + 1;
            while (at < tag.size() && is_white(tag[at]) && tag[at] != '/') {
                ++at;
            }
            const char quote = at < tag.size() && (tag[at] == '"' || tag[at] == '\'') ? tag[at] : '\0';
            at += quote == '\0' ? 0U : 1U;
            const std::size_t from = at;
            while (at < tag.size() && (quote == '\0' ? !is_white(tag[at]) || tag[at] == '/' : tag[at] != quote)) {
                ++at;
            }
            value = tag.substr(from, at - from);
            at += at < tag.size() && quote != '\0' ? 1U : 0U;
        }
        all.emplace_back(std::move(name), without_references(value));
    }
    return all;
}

/// Texts as structure_of_html() has them: '<' and '>' stand for tags alone.
std::string as_text_between_tags(std::string_view text) {
    std::string out;
    for (const char c : without_references(text)) {
        out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    }
    return out;
}

/// Elements that show what stands in them, and nothing else.
bool is_plain_element(std::string_view name) {
    static constexpr std::array<std::string_view, 49> k_names = {
        "html",     "head",    "meta",  "title", "style",      "body", "main",   "div",        "header",  "footer",
        "section",  "article", "aside", "nav",   "address",    "p",    "h1",     "h2",         "h3",      "h4",
        "h5",       "h6",      "img",   "dl",    "dt",         "dd",   "figure", "figcaption", "table",   "caption",
        "colgroup", "col",     "thead", "tbody", "tfoot",      "tr",   "th",     "td",         "ul",      "ol",
        "li",       "br",      "hr",    "pre",   "blockquote", "svg",  "center", "time",       "!doctype"};
    return is_one_of(k_names, name) || (is_within_a_line(name) && name != "bdo" && name != "font");
}

bool is_plain_drawing(std::string_view name) {
    static constexpr std::array<std::string_view, 16> k_names = {
        "svg",     "g",    "path",  "line",  "rect", "circle", "ellipse",  "polyline",
        "polygon", "text", "tspan", "title", "desc", "defs",   "clippath", "marker"};
    return is_one_of(k_names, name);
}

/// Attributes that neither hide, move or cover what they are of, nor make a text of it; others are refused. Names that begin
/// with "data-" and "aria-" are plain as well.
bool is_plain_attribute(std::string_view name) {
    static constexpr std::array<std::string_view, 35> k_names = {
        "class",    "id",    "lang",    "title", "alt",      "src",     "href",    "style",   "colspan",
        "rowspan",  "scope", "headers", "span",  "role",     "name",    "content", "width",   "viewbox",
        "datetime", "cite",  "abbr",    "type",  "align",    "valign",  "border",  "nowrap",  "rel",
        "target",   "fill",  "stroke",  "xmlns", "tabindex", "summary", "version", "xml:lang"};
    return is_one_of(k_names, name) || name.starts_with("data-") || name.starts_with("aria-") ||
           name == "preserveaspectratio" || name == "shape-rendering";
}

/// Elements that have to be closed in the order in which they were opened: what stands within what is the same for all readers.
bool is_to_be_closed(std::string_view name) {
    static constexpr std::array<std::string_view, 25> k_names = {
        "main", "div",     "header",     "footer", "section", "article", "aside",     "nav", "address",
        "h1",   "h2",      "h3",         "h4",     "h5",      "h6",      "dl",        "ul",  "ol",
        "pre",  "caption", "blockquote", "figure", "table",   "center",  "figcaption"};
    return is_one_of(k_names, name);
}

/// Elements that stand as well within a line as beside others, and have no end of their own here.
bool stands_anywhere(std::string_view name) {
    static constexpr std::array<std::string_view, 9> k_names = {"img",   "br",    "wbr",  "svg",     "time",
                                                                "title", "style", "meta", "!doctype"};
    return is_one_of(k_names, name);
}

/// Names of the classes of an element, in small letters: pages without a document type ask for no more.
std::vector<std::string> classes_in(std::string_view value) {
    std::vector<std::string> names(1);
    for (const char c : text::in_small_letters(value)) {
        if (c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f') {
            names.emplace_back();
        } else {
            names.back() += c;
        }
    }
    return names;
}

/// What the first reference of a text that is none of XML or a number is; browsers know two thousand names.
std::string unknown_reference(std::string_view text) {
    constexpr std::size_t k_longest = 10;
    for (std::size_t at = text.find('&'); at != std::string_view::npos; at = text.find('&', at + 1)) {
        const std::string_view rest = text.substr(at, k_longest + 1);
        const std::size_t end = rest.find(';');
        const char next = rest.size() > 1 ? rest[1] : ' ';
        const bool may_be_one = next == '#' || (next >= 'a' && next <= 'z') || (next >= 'A' && next <= 'Z');
        if (may_be_one && (end == std::string_view::npos || referred(rest.substr(1, end - 1)).empty())) {
            return std::string(rest.substr(0, end == std::string_view::npos ? end : end + 1));
        }
    }
    return {};
}

/// The first character of a text that a reader does not see, and that changes what he sees.
std::string hidden_character(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const text::Character one = text::decode_utf8(text, at);
        const bool is_layout = one.code == '\n' || one.code == '\r' || one.code == '\t' || one.code == 0xAD ||
                               one.code == 0x200B || one.code == 0x2060 || text::is_joiner(one.code);
        if (one.bytes == 0 || (text::is_hidden(one.code) && !is_layout)) {
            constexpr std::size_t k_digits = 8;
            std::array<char, k_digits> digits{};
            const auto end =
                std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<std::uint32_t>(one.code), 16);
            return one.bytes == 0 ? "bytes that are no UTF-8"
                                  : "the character U+" + std::string(digits.data(), end.ptr) + ", which is not seen";
        }
        at += one.bytes;
    }
    return {};
}

class HiddenParts {
public:
    HiddenParts(std::string_view html, std::string_view style)
        : html_(html), small_(text::in_small_letters(html)), known_(style_blocks(style)) {
        std::sort(known_.begin(), known_.end());
    }

    std::string first() {
        for (std::size_t at = 0; at < html_.size() && found_.empty();) {
            const std::size_t tag = std::min(html_.find('<', at), html_.size());
            look_at_text(html_.substr(at, tag - at));
            at = tag == html_.size() || !found_.empty() ? html_.size() : look_at_tag(tag);
        }
        return std::move(found_);
    }

private:
    std::string_view html_;
    std::string small_;
    std::vector<std::string> known_;
    std::string found_;
    bool in_head_ = false;
    std::string line_;               // what was read of it, since the last element that stands not within it
    bool joins_digits_ = false;      // what comes next is raised, lowered, or behind such a part
    std::vector<std::string> open_;  // elements that have to be closed, the innermost last
    std::size_t unseen_depth_ = 0;   // of elements within the heads of printed pages, which a screen does not show

    void tell(const std::string& what) {
        if (found_.empty()) {
            found_ = what;
        }
    }

    static bool is_digit_of_html(char c) { return c >= '0' && c <= '9'; }

    /// "5000<sup>0838</sup>" is read as 50000838 and shown as a power: only a power of ten is one number.
    void look_at_raised(std::string_view name, bool closes) {
        const bool is_behind_digit = !line_.empty() && is_digit_of_html(line_.back());
        const bool is_power = name == "sup" && (line_.ends_with("\u00D710") || line_.ends_with("\u00B710") ||
                                                line_.ends_with("\u22C510"));
        const bool is_behind_sign = line_.ends_with("\u2212") || line_.ends_with('-') || line_.ends_with('+');
        joins_digits_ = closes ? is_behind_digit || is_behind_sign : is_behind_digit && !is_power;
    }

    void take_line(std::string_view text) {
        const std::string written = without_references(text);
        if (joins_digits_ && !written.empty() && is_digit_of_html(written.front())) {
            tell("has digits that are raised or lowered beside others");
        }
        joins_digits_ = joins_digits_ && written.empty();
        constexpr std::size_t k_kept = 8;  // bytes
        line_ += without_any_blanks(written);
        line_ += !written.empty() && written.back() == ' ' && !line_.ends_with("\u00D7") ? " " : "";
        line_.erase(0, line_.size() > k_kept ? line_.size() - k_kept : 0U);
    }

    void look_at_text(std::string_view text) {
        take_line(text);
        if (const std::string reference = unknown_reference(text); !reference.empty()) {
            tell("refers to a character as \"" + reference + '"');
        }
        if (const std::string hidden = hidden_character(without_references(text)); !hidden.empty()) {
            tell("has " + hidden);
        }
        if ((unseen_depth_ > 0 || in_head_) && !without_any_blanks(text).empty()) {
            tell(in_head_ ? "has text in its head"
                          : "has text in the heads of printed pages, which a screen does not show");
        }
    }

    /// \return where to go on
    std::size_t look_at_tag(std::size_t tag) {
        if (html_.substr(tag).starts_with("<!--")) {
            const std::size_t end = html_.find("-->", tag + 4);
            const std::string_view comment = html_.substr(tag + 4, end == std::string_view::npos ? end : end - tag - 4);
            if (end == std::string_view::npos || comment.starts_with('>') || comment.starts_with("->") ||
                comment.find("--!") != std::string_view::npos) {
                tell("has a comment that ends in another place for browsers");
            }
            return end == std::string_view::npos ? html_.size() : end + 3;
        }
        const std::size_t end = end_of_tag(html_, tag);
        const std::string_view whole = html_.substr(tag, end - tag);
        const bool is_doctype = small_.compare(tag, 9, "<!doctype") == 0;
        const std::string name = is_doctype ? "!doctype" : name_of_tag(whole);
        const bool closes = whole.starts_with("</");
        if (name == "sup" || name == "sub") {
            look_at_raised(name, closes);
        } else if (!is_within_a_line(name)) {
            line_.clear();
            joins_digits_ = false;
        }
        if (!is_plain_element(name)) {
            tell("has an element \"" + (name.empty() ? std::string(whole.substr(0, 2)) : name) + '"');
            return end;
        }
        const bool belongs_to_head = name == "head" || name == "meta" || name == "title" || name == "style";
        look_at_nesting(name, closes);
        if (in_head_ && !belongs_to_head) {
            tell("has an element \"" + name + "\" in its head");
        }
        if (name == "head") {
            in_head_ = !closes;
        }
        if (name == "div" && unseen_depth_ > 0) {
            unseen_depth_ = closes ? unseen_depth_ - 1 : unseen_depth_ + 1;
        } else if (name != "span" && unseen_depth_ > 0) {
            tell("has an element \"" + name + "\" in the heads of printed pages, which a screen does not show");
        }
        if (!closes && !is_doctype) {
            look_at_attributes(name, whole);
        }
        if (closes || is_doctype) {
            return end;
        }
        if (name == "style" || name == "title") {
            const std::size_t close = std::min(small_.find("</" + name, end), html_.size());
            if (name == "style") {
                look_at_style(html_.substr(end, close - end));
            }
            return end_of_tag(html_, close);
        }
        return name == "svg" ? look_at_drawing(end) : end;
    }

    /// Small letters within small letters are not seen in the end, and margins within margins are beside the paper.
    void look_at_nesting(const std::string& name, bool closes) {
        constexpr std::size_t k_most_within_a_line = 5;
        constexpr std::size_t k_most_within_each_other = 16;
        const bool is_within = is_within_a_line(name);
        if (stands_anywhere(name)) {
            return;
        }
        if (!is_within && !open_.empty() && is_within_a_line(open_.back())) {
            tell("has an element \"" + name + "\" within or behind \"" + open_.back() + "\", which is not closed");
        }
        if (!is_within && !is_to_be_closed(name)) {
            return;
        }
        if (closes) {
            if (open_.empty() || open_.back() != name) {
                tell("closes an element \"" + name + "\" where another one is open");
            } else {
                open_.pop_back();
            }
            return;
        }
        open_.push_back(name);
        const auto within = static_cast<std::size_t>(
            std::count_if(open_.begin(), open_.end(), [](const std::string& one) { return is_within_a_line(one); }));
        const auto alike = static_cast<std::size_t>(std::count(open_.begin(), open_.end(), name));
        if (within > k_most_within_a_line || open_.size() > k_most_within_each_other + within ||
            (is_within && alike > (name == "span" ? 2U : 1U))) {
            tell("has an element \"" + name + "\" within too many others");
        }
    }

    void look_at_attributes(const std::string& element, std::string_view tag) {
        if (const std::string reference = unknown_reference(tag); !reference.empty()) {
            tell("refers to a character as \"" + reference + '"');
        }
        for (const auto& [name, value] : attributes_of(tag)) {
            const bool is_picture = element == "svg" || element == "img";
            const std::string small = text::in_small_letters(value);
            // The place of a drawing is one within another drawing, and says nothing on a page.
            const bool is_of_picture = is_picture && (name == "height" || name == "x" || name == "y");
            const bool is_known = is_plain_attribute(name) || is_of_picture || (name == "dir" && small == "ltr") ||
                                  (name == "charset" && small == "utf-8") ||
                                  (name == "http-equiv" && small == "content-security-policy");
            constexpr std::size_t k_digits_of_border = 2;
            if (!is_known || (name == "border" && value.size() > k_digits_of_border)) {
                tell("has an element \"" + element + "\" with \"" + name + '"');
            }
            for (const std::string& one : name == "class" ? classes_in(value) : std::vector<std::string>()) {
                if (one == "page-head") {
                    element == "div" ? void(unseen_depth_ += unseen_depth_ == 0 ? 1U : 0U)
                                     : tell("has an element \"" + element + "\" that a screen does not show");
                }
                if (one == "symbol" && element != "img") {
                    tell("has an element \"" + element + "\" with the height of a symbol");
                }
            }
            for (std::size_t at = 0; name == "style" && at < value.size();) {
                const std::size_t end = std::min(value.find(';', at), value.size());
                if (!is_plain_declaration(std::string_view(value).substr(at, end - at), element == "img")) {
                    tell("has an element \"" + element + "\" with the style \"" + value.substr(at, end - at) + '"');
                }
                at = end + 1;
            }
        }
    }

    void look_at_style(std::string_view style) {
        for (const std::string& block : style_blocks(style)) {
            if (!std::binary_search(known_.begin(), known_.end(), block) && !is_plain_block(block)) {
                constexpr std::size_t k_shown = 200;  // bytes
                tell("has \"" + block.substr(0, k_shown) + "\" in its style sheet");
            }
        }
    }

    /// \return behind it
    std::size_t look_at_drawing(std::size_t from) {
        const std::size_t close = std::min(small_.find("</svg", from), html_.size());
        for (std::size_t tag = html_.find('<', from); tag < close; tag = html_.find('<', tag + 1)) {
            constexpr std::size_t k_longest_name = 20;
            const std::string_view start = html_.substr(tag, k_longest_name);
            if (const std::string name = name_of_tag(start); !is_plain_drawing(name)) {
                tell("has a drawing with \"" + (name.empty() ? std::string(start.substr(0, 2)) : name) + '"');
            }
        }
        return end_of_tag(html_, close);
    }
};

}  // namespace

std::string structure_of_html(std::string_view html) {
    std::string structure;
    for (std::size_t at = 0; at < html.size();) {
        const std::size_t tag = std::min(html.find('<', at), html.size());
        structure += as_text_between_tags(html.substr(at, tag - at));
        if (tag == html.size()) {
            break;
        }
        if (html.substr(tag).starts_with("<!--")) {
            const std::size_t end = html.find("-->", tag);
            at = end == std::string_view::npos ? html.size() : end + 3;
            continue;
        }
        at = end_of_tag(html, tag);
        const std::string_view whole = html.substr(tag, at - tag);
        const std::string name = name_of_tag(whole);
        const bool closes = whole.starts_with("</");
        structure += closes ? "</" + name : '<' + (name.empty() ? as_text_between_tags(whole.substr(1)) : name);
        if (!closes && !name.empty()) {
            for (const auto& [attribute, value] : attributes_of(whole)) {
                std::string written = as_text_between_tags(value);
                std::replace_if(
                    written.begin(), written.end(), [](char c) { return c == ' ' || c == '\n' || c == '\t'; }, '~');
                structure += ' ' + attribute + "=\"" + written + '"';
            }
        }
        structure += '>';
    }
    return structure;
}

std::string hidden_part_of_html(std::string_view html, std::string_view style) {
    return HiddenParts(html, style).first();
}

std::vector<std::string> languages_of_html(std::string_view html) {
    constexpr std::string_view k_attribute = " lang=\"";
    std::vector<std::string> languages;
    for (std::size_t at = html.find(k_attribute); at != std::string_view::npos; at = html.find(k_attribute, at + 1)) {
        const std::size_t from = at + k_attribute.size();
        std::string language(html.substr(from, std::min(html.find('"', from), html.size()) - from));
        if (std::find(languages.begin(), languages.end(), language) == languages.end()) {
            languages.push_back(std::move(language));
        }
    }
    return languages;
}

bool has_style_of(std::string_view html, std::string_view style) {
    const std::size_t open = html.find("<style>");
    const std::size_t close = html.find("</style>");
    if (open == std::string_view::npos || close == std::string_view::npos || close < open + 7 ||
        text::in_small_letters(html).find("<style", open + 1) != std::string::npos) {
        return false;
    }
    return style_blocks(html.substr(open + 7, close - open - 7)) == style_blocks(style);
}

}  // namespace gumcert::reports
